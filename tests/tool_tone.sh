#!/bin/sh
# Tones, histograms, and equalization from outside. Expected bytes are worked out by hand.
first_argument=
. tests/outside

bytes() { # bytes FILE : as hexadecimal digits
    od -An -v -tx1 "$1" | tr -d ' \n'
}
same() { # same NAME FILE HEX
    [ "$(bytes "$2")" = "$3" ]
    say $? "$1"
}
# Gray 4x2: 0 99 100 101 / 255 100 0 200. Color 2x1: 10 200 30, 255 0 0.
printf 'P5\n4 2\n255\n\000\143\144\145\377\144\000\310' > gray.pgm
printf 'P6\n2 1\n255\n\012\310\036\377\000\000' > color.ppm
gray=50350a3420320a3235350a
color=50360a3220310a3235350a

works "negative of gray" negative gray.pgm -o out.pgm
same "negative of gray, pixels" out.pgm ${gray}ff9c9b9a009bff37
works "negative of color" negative color.ppm -o out.ppm
same "negative of color, pixels" out.ppm ${color}f537e100ffff
works "a mask" threshold --value 100 gray.pgm -o mask.bmp
works "negative of a mask" negative mask.bmp -o not.bmp
"$iris" info not.bmp | grep -q "1 bit, mask"; say $? "negative of a mask is a mask"
[ "$(tail -c 8 not.bmp | od -An -v -tx1 | tr -d ' ')" = 60000000e0000000 ]; say $? "negative of a mask, pixels"
works "negative of a part" negative --roi 1,0,2,1 gray.pgm -o out.pgm
same "negative of a part, pixels" out.pgm ${gray}009c9b65ff6400c8

works "adjust red, green, blue" adjust --red 250 --green -201 --blue=5 color.ppm -o out.ppm
same "adjust red, green, blue, pixels" out.ppm ${color}ff0023ff0005
works "adjust hue" adjust --hue 120 color.ppm -o out.ppm # of 10 200 30: red sinks to blue's place
same "adjust hue, pixels" out.ppm ${color}1e0ac800ff00
works "adjust saturation" adjust --saturation -100 color.ppm -o out.ppm # half of 10 + 200, of 255 + 0 half up
same "adjust saturation, pixels" out.ppm ${color}696969808080
works "adjust lightness" adjust --lightness 20 color.ppm -o out.ppm # 105 + 51 = 156 of 255; chroma 190/210 of 198 is 179.1
same "adjust lightness, pixels" out.ppm ${color}42f655ff6666
works "adjust lightness of gray" adjust --lightness 10 gray.pgm -o out.pgm # 25.5 more, half up
same "adjust lightness of gray, pixels" out.pgm ${gray}1a7d7e7fff7e1ae2
works "adjust nothing" adjust gray.pgm -o out.pgm
cmp -s out.pgm gray.pgm; say $? "adjust nothing, pixels"
for wrong in "--red 256" "--hue x" "--saturation 101" "--lightness -101" "--lightness 1.5"; do
    refuses "adjust $wrong" 2 "^iris adjust: ${wrong%% *}: a whole number from" adjust $wrong gray.pgm -o no.pgm
done

# 255 / ln 256 ln(1 + p): 99 211.77, 100 212.23, 101 212.68, 200 243.88
works "compress" compress gray.pgm -o out.pgm
same "compress, pixels" out.pgm ${gray}00d4d4d5ffd400f4
works "compress --constant" compress --constant 10.5 gray.pgm -o out.pgm # 48.35 48.46 48.56 58.22 55.68
same "compress --constant, pixels" out.pgm ${gray}003030313a300038
refuses "compress --constant -1" 2 "^iris compress: --constant: 0 to 32767" compress --constant -1 gray.pgm -o no.pgm

# Segments from 85 and 170: 99 is 42.5 + 28, 100 72.5, 101 74.5, 200 212.5 + 15
works "stretch" stretch --json gray.pgm -o out.pgm
same "stretch, pixels" out.pgm ${gray}0047494bff4900e4
grep -q '"low":85,"high":170}$' out; say $? "stretch, JSON"
works "stretch between other levels" stretch --low 100 --high 101 --slopes 0,-3.5,260 gray.pgm -o out.pgm
same "stretch between other levels, pixels" out.pgm ${gray}00000000ff0000ff
works "stretch by percent" stretch --percent 25 --json gray.pgm -o out.pgm # a quarter of 8 are the zeros, six are at most 101
grep -q '"low":0,"high":101}$' out; say $? "stretch by percent, JSON"
same "stretch by percent, pixels" out.pgm ${gray}00fafcfffffc00ff
works "stretch of color by percent" stretch --percent 0 --json color.ppm -o out.ppm
cmp -s out.ppm color.ppm; say $? "stretch of color counts all channels"
for wrong in "--low 171" "--low -1" "--high 84" "--high 256" "--slopes 1,2" "--slopes 1,2,3,4" "--slopes 1,,3" \
    "--percent 50" "--percent -1" "--percent 1 --low 5"; do
    refuses "stretch $wrong" 2 "^iris stretch: " stretch $wrong gray.pgm -o no.pgm
done

refuses "stretch --high below --low" 2 "^iris stretch: --low: at most --high, but they are 85 and 60$" stretch --high 60 gray.pgm -o no.pgm

works "gamma" gamma --gamma 2 gray.pgm -o out.pgm # p^2 / 255: 38.4, 39.2, 40.004, 156.9
same "gamma, pixels" out.pgm ${gray}00262728ff27009d
works "gamma brightens" gamma --gamma 0.5 gray.pgm -o out.pgm # sqrt(255 p): 158.9 159.7 160.5 225.8
same "gamma brightens, pixels" out.pgm ${gray}009fa0a0ffa000e2
refuses "gamma is missing" 2 "^iris gamma: --gamma is missing" gamma gray.pgm -o no.pgm
for wrong in 0 -1 0.0001 1001 x; do
    refuses "gamma $wrong" 2 "^iris gamma: --gamma: 0.001 to 1000" gamma --gamma $wrong gray.pgm -o no.pgm
done

# Levels 0 99 100 101 200 255, twice 0 and 100: cdf 2 3 5 6 7 8, less 2, times 255 / 6
works "equalize" equalize gray.pgm -o out.pgm
same "equalize, pixels" out.pgm ${gray}002b80aaff8000d5
works "equalize a flat part" equalize --roi 2,0,1,2 gray.pgm -o out.pgm # 100 and 0
same "equalize a flat part, pixels" out.pgm ${gray}0063ff65ff6400c8
works "equalize --local with one tile" equalize --local 1,0 gray.pgm -o out.pgm # cdf times 255 / 8
same "equalize --local with one tile, pixels" out.pgm ${gray}40609fbfff9f40df
works "equalize color" equalize color.ppm -o out.ppm # lightness 105 becomes black, 127.5 half way to white
same "equalize color, pixels" out.ppm ${color}000000$(printf ff0000)
works "equalize --local of color" equalize --local 1,2.5 color.ppm -o out.ppm
for wrong in 0,1 65,1 8 8,-1 8,257 x,1 8,1,1 ,; do
    refuses "equalize --local $wrong" 2 "^iris equalize: --local: " equalize --local $wrong gray.pgm -o no.pgm
done
refuses "more tiles than rows" 2 "^iris equalize: gray.pgm: --local: .* 4x2" equalize --local 3,2 gray.pgm -o no.pgm

works "histogram --json" histogram --json --roi 0,0,2,2 gray.pgm # 0 99 255 100: mean 113.5, variance 34041 / 4 + ...
zeros() { # zeros N : N times ",0"
    i=0; while [ $i -lt "$1" ]; do printf ',0'; i=$((i + 1)); done
}
[ "$(cat out)" = '{"file":"gray.pgm","width":4,"height":2,"kind":"gray","channels":{"gray":{"count":4,"mean":113.5,"variance":8324.25,"min":0,"max":255,"median":99,"otsu":177,"percentiles":{"1":0,"5":0,"25":0,"50":99,"75":100,"95":255,"99":255},"counts":[1'"$(zeros 98),1,1$(zeros 154)"',1]}}}' ]
say $? "histogram --json, numbers"
works "histogram of color" histogram --json color.ppm
[ "$(tr -d '\n' < out | sed 's/"counts":[^]]*]/./g; s/"percentiles":{[^}]*},//g')" = '{"file":"color.ppm","width":2,"height":1,"kind":"color","channels":{"red":{"count":2,"mean":132.5,"variance":15006.25,"min":10,"max":255,"median":10,"otsu":132,.},"green":{"count":2,"mean":100,"variance":10000,"min":0,"max":200,"median":0,"otsu":99,.},"blue":{"count":2,"mean":15,"variance":225,"min":0,"max":30,"median":0,"otsu":14,.}}}' ]
say $? "histogram of color, numbers"
works "histogram of a mask" histogram --json --roi 1,0,3,2 mask.bmp
grep -q '"kind":"mask","channels":{"mask":{"count":6,"mean":0.3333,"variance":0.2222,.*"counts":\[4,2\]}' out; say $? "histogram of a mask, numbers"
works "a picture of a histogram" histogram color.ppm -o chart.bmp
"$iris" info chart.bmp | grep -q "24 bits, color"; say $? "three curves"
refuses "histogram of a part that is not there" 2 "^iris histogram: gray.pgm: --roi" histogram --json --roi 3,0,2,1 gray.pgm
works "in a pipe" pipe "stretch --percent 1 | gamma --gamma 0.7 | equalize | negative | histogram" color.ppm -o chart.ppm
