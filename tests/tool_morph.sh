#!/bin/sh
# Morphology, hit-or-miss, and distances from outside. Pictures are made by hand here; expected bytes are written out.
first_argument=
. tests/outside

same() { # same NAME FILE HEX
    [ "$(od -An -v -tx1 "$2" | tr -d ' \n')" = "$3" ]
    say $? "$1"
}
rows() { # rows FILE : the rows of a 1-bit BMP of at most 8 pixels a row, last row first
    tail -c +63 "$1" | od -An -v -tx1 -w4 | cut -d' ' -f2 | tr '\n' ' '
}
header=50350a3420330a3235350a # P5 4 3 255
printf 'P5\n4 3\n255\n\001\002\003\004\005\006\007\010\011\012\013\014' > gray.pgm
printf 'P6\n2 1\n255\n\012\310\036\377\000\000' > color.ppm
# A mask of 8x5, a dot in the middle and one in a corner.
printf 'P5\n8 5\n255\n\377\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\377\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0' > dots.pgm
works "a mask" convert --format mask dots.pgm -o dots.bmp
[ "$(rows dots.bmp)" = "00 00 10 00 80 " ]; say $? "a mask, pixels"

# --- gray ---
works "dilate" dilate gray.pgm -o out.pgm
same "dilate, pixels" out.pgm ${header}060708080a0b0c0c0a0b0c0c
works "erode" erode gray.pgm -o out.pgm
same "erode, pixels" out.pgm ${header}010102030101020305050607
works "dilate by an even size" dilate --size 2x1 gray.pgm -o out.pgm
same "dilate by an even size looks to the left" out.pgm ${header}0102030405060708090a0b0c
works "erode by an even size" erode --size 2x1 --border constant:3 gray.pgm -o out.pgm
same "erode by an even size looks to the right" out.pgm ${header}0102030305060703090a0b03
works "erode by a cross" erode --shape cross --border constant gray.pgm -o out.pgm
same "erode by a cross, pixels" out.pgm ${header}000000000002030000000000
works "--exclude-center" dilate --exclude-center --border skip gray.pgm -o out.pgm
same "--exclude-center, and the edge stays" out.pgm ${header}01020304050b0c08090a0b0c
works "gradient" gradient --size 3x1 gray.pgm -o out.pgm
same "gradient, pixels" out.pgm ${header}010202010102020101020201
works "open" open gray.pgm -o out.pgm
same "open, pixels" out.pgm ${header}010203030506070705060707

# --- color: each channel; masks: each bit ---
works "dilate color" dilate color.ppm -o out.ppm
same "dilate color, pixels" out.ppm 50360a3220310a3235350affc81effc81e
works "dilate a mask" dilate dots.bmp -o out.bmp
[ "$(rows out.bmp)" = "00 38 38 f8 c0 " ]; say $? "dilate a mask, pixels"
works "dilate a mask by a cross" dilate --shape cross --size 5x3 dots.bmp -o out.bmp
[ "$(rows out.bmp)" = "00 10 7c 90 e0 " ]; say $? "dilate a mask by a cross, pixels"
works "dilate a part of a mask" dilate --roi 3,2,4,3 dots.bmp -o out.bmp
[ "$(rows out.bmp)" = "00 18 18 00 80 " ]; say $? "dilate a part of a mask, pixels"
works "close" close --size 5x1 --border constant dots.bmp -o out.bmp
[ "$(rows out.bmp)" = "00 00 10 00 00 " ]; say $? "close, with black beyond the edge"
works "tophat" tophat dots.bmp -o out.bmp
[ "$(rows out.bmp)" = "00 00 10 00 80 " ]; say $? "tophat takes the dots"
works "blackhat" pipe "convert --format mask | blackhat" dots.pgm -o out.bmp
[ "$(rows out.bmp)" = "00 00 00 00 00 " ]; say $? "blackhat takes nothing"
works "hitmiss" hitmiss --pattern 000/010/000 --border constant dots.bmp -o out.bmp
[ "$(rows out.bmp)" = "00 00 10 00 80 " ]; say $? "hitmiss finds the dots"
works "hitmiss of gray" hitmiss --pattern 000/010/000 --border skip dots.pgm -o out.bmp
[ "$(rows out.bmp)" = "00 00 10 00 00 " ]; say $? "hitmiss, and nothing at the edge"

# --- distance: 1 2 3 4 / 5 6 7 8 / 9 10 11 12 with the 7 alone black, and all white ---
printf 'P5\n4 3\n255\n\377\377\377\377\377\377\000\377\377\377\377\377' > room.pgm
works "distance" distance --json room.pgm -o out.pgm
[ "$(cat out)" = '{"file":"room.pgm","output":"out.pgm","width":4,"height":3,"kind":"gray","maximum":3}' ]
say $? "distance as JSON"
same "distance, pixels" out.pgm ${header}ffaa55aaaa550055ffaa55aa
works "distance --metric chamfer" distance --metric chamfer --json room.pgm
[ "$(cat out)" = '{"file":"room.pgm","width":4,"height":3,"kind":"gray","maximum":2.33}' ]
say $? "distance --metric chamfer as JSON"
works "distance --metric chamfer to a picture" distance --metric chamfer room.pgm -o out.pgm
same "distance --metric chamfer, pixels" out.pgm ${header}ff926d92db6d006dff926d92
printf 'P5\n1 1\n255\n\377' > white.pgm
works "distance from nothing" distance --json white.pgm -o out.pgm
grep -q '"maximum":null}' out; say $? "distance from nothing as JSON"
same "distance from nothing, pixels" out.pgm 50350a3120310a3235350aff
printf 'P5\n1 1\n255\n\000' > black.pgm
works "distance within nothing" distance --json black.pgm -o out.pgm
grep -q '"maximum":0}' out; say $? "distance within nothing as JSON"

# --- wrong calls ---
for wrong in 0 1024 3x0 x3 3x3x3 -1 two ""; do
    refuses "--size $wrong" 2 "^iris dilate: --size: N or WxH" dilate "--size=$wrong" gray.pgm -o no.pgm
done
refuses "--shape" 2 "^iris open: --shape: square or cross" open --shape disk gray.pgm -o no.pgm
refuses "--exclude-center of nothing" 2 "^iris erode: --exclude-center: " erode --size 1 --exclude-center gray.pgm -o no.pgm
refuses "no --pattern" 2 "^iris hitmiss: no --pattern" hitmiss dots.bmp -o no.bmp
for wrong in "" "11/1" "1 1" "/" "111111111" "1/1/1/1/1/1/1/1/1"; do
    refuses "--pattern $wrong" 2 "^iris hitmiss: --pattern: " hitmiss "--pattern=$wrong" dots.bmp -o no.bmp
done
refuses "--metric" 2 "^iris distance: --metric: l1 or chamfer" distance --metric euclid room.pgm -o no.pgm
[ ! -e no.pgm ] && [ ! -e no.bmp ]; say $? "wrong calls write nothing"
