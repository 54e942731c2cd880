#!/bin/sh
# Operations from outside: chains in one process, regions of interest, and masks as they pass through.
first_argument=
. tests/outside

bytes() { # bytes FILE : as hexadecimal digits
    od -An -v -tx1 "$1" | tr -d ' \n'
}
same() { # same NAME FILE HEX
    [ "$(bytes "$2")" = "$3" ]
    say $? "$1"
}
printf 'P5\n4 2\n255\n\000\143\144\145\377\144\000\310' > gray.pgm
printf 'P6\n2 1\n255\n\012\310\036\377\000\000' > color.ppm
printf 'P6\n2 2\n255\n\012\310\036\377\000\000\000\000\377\001\002\003' > square.ppm

# --- pipe ---
works "two operations" pipe "gray | threshold --value 100" color.ppm -o two.pgm
same "two operations, pixels" two.pgm 50350a3220310a3235350aff00
works "no blanks, quotes, and three operations" pipe "convert --crop '0,0,1,1'|gray|threshold --value \"100\"" color.ppm -o three.pgm
same "no blanks, quotes, and three operations, pixels" three.pgm 50350a3120310a3235350aff
works "one operation" pipe gray color.ppm -o one.pgm
same "one operation, pixels" one.pgm 50350a3220310a3235350a7c4d
works "a quoted quote and bar" pipe "gray --method 'lum''a'" color.ppm -o one.pgm
works "what the last one found" pipe --json "gray | threshold --value 100" color.ppm -o two.pgm
[ "$(cat out)" = '{"file":"color.ppm","output":"two.pgm","width":2,"height":1,"kind":"mask","threshold":100}' ]
say $? "what the last one found, as JSON"
works "the last one found nothing" pipe --json "threshold --value 100 | gray" color.ppm -o two.pgm
[ "$(cat out)" = '{"file":"color.ppm","output":"two.pgm","width":2,"height":1,"kind":"gray"}' ]
say $? "only the last one reports"
mkdir folder
works "several into a folder" pipe "gray | threshold --value 100" gray.pgm color.ppm -o folder
[ "$(ls folder | tr '\n' ' ')" = "color.pgm gray.pgm " ]; say $? "the folder has both"
cat gray.pgm color.ppm | "$iris" pipe "gray | convert --format rgb" - -o - 2> err | "$iris" info - > out
[ "$(cut -d' ' -f2,3,6 out | tr '\n' ' ')" = "BMP 4x2, color, BMP 2x1, color, " ] && [ ! -s err ]
say $? "a stream of pictures"
refuses "no such operation" 2 "^iris pipe: no such operation: 'sepia'" pipe "gray | sepia" gray.pgm -o no.pgm
refuses "a command that is no operation" 2 "^iris pipe: no such operation: 'follow'" pipe "follow" gray.pgm -o no.pgm
refuses "an operation's own complaint" 2 "^iris pipe: threshold: --value: " pipe "gray | threshold --value 256" gray.pgm -o no.pgm
refuses "-o among the operations" 2 "^iris pipe: gray: unknown option -o" pipe "gray -o no.pgm" gray.pgm -o no.pgm
refuses "an input among the operations" 2 "^iris pipe: gray: inputs stand behind" pipe "gray gray.pgm" -o no.pgm
for wrong in "" "|" "gray |" "| gray" "gray || gray" "gray 'a" 'gray "' "gray | | threshold --otsu"; do
    refuses "operations: $wrong" 2 "^iris pipe: " pipe "$wrong" gray.pgm -o no.pgm
done
refuses "no input" 2 "^iris pipe: no input" pipe gray -o no.pgm
refuses "no operations" 2 "^iris pipe: no operations" pipe -o no.pgm

# --- regions of interest: the rest stays ---
works "--roi" threshold --value 100 --roi 1,0,2,2 gray.pgm -o part.pgm
same "--roi, pixels" part.pgm 50350a3420320a3235350a00000065ff0000c8
works "--roi on color" gray --method green --roi 1,0,1,2 square.ppm -o part.ppm
same "--roi on color, pixels" part.ppm 50360a3220320a3235350a0ac81e0000000000ff020202
works "--roi keeps a mask" pipe "threshold --value 100 | blur --box 3 --roi 0,0,2,2" gray.pgm -o part.bmp # 57 28 / 113 57
"$iris" info part.bmp | grep -q mask; say $? "--roi keeps a mask, kind"
[ "$(bytes part.bmp | tail -c 16)" = 1000000010000000 ]; say $? "--roi keeps a mask, pixels"
works "--roi keeps gray" adjust --red 100 --roi 0,0,1,1 gray.pgm -o part.pgm # 77 of 256 times 100
same "--roi keeps gray, pixels" part.pgm 50350a3420320a3235350a1e636465ff6400c8
works "--roi of everything" threshold --value 100 --roi 0,0,4,2 gray.pgm -o part.pgm
same "--roi of everything, pixels" part.pgm 50350a3420320a3235350a000000ffff0000ff
works "--roi within a pipe" pipe "gray --roi 0,0,1,2 | threshold --value 100 --roi 0,0,1,1" square.ppm -o part.ppm
same "--roi within a pipe, pixels" part.ppm 50360a3220320a3235350affffffff00001d1d1d010203
for wrong in "3,0,2,1" "0,0,5,1" "0,0,4,3" "2147483647,0,1,1" "0,0,2147483647,1" "0,0,0,1" "-1,0,1,1" "1,1,1" "x"; do
    refuses "--roi $wrong" 2 "^iris gray: .*--roi" gray --roi "$wrong" gray.pgm -o no.pgm
done
refuses "--roi without width" 2 "^iris gray: --roi: x,y,w,h in pixels, w and h at least 1, not '1,1,0,1'$" gray --roi 1,1,0,1 gray.pgm -o no.pgm
refuses "--roi where the size changes" 2 "unknown option --roi" convert --roi 0,0,1,1 gray.pgm -o no.pgm

# --- every operation takes --border and --roi, on any kind and size of picture ---
printf 'P5\n1 1\n255\n\200' > dot.pgm
works "a mask of one pixel" threshold --value 100 dot.pgm -o dot.bmp
works "a column" convert --crop 0,0,1,2 square.ppm -o column.ppm
while read -r call; do
    eval "set -- $call"
    failed=
    for rule in skip replicate reflect constant constant:255; do
        for picture in gray.pgm square.ppm column.ppm dot.pgm dot.bmp; do
            run "$@" --border $rule --roi 0,0,1,1 $picture -o any.bmp
            [ $code -eq 0 ] && [ ! -s err ] || failed="$failed $rule $picture"
        done
    done
    [ -z "$failed" ]; say $? "$call: --border and --roi$failed"
    refuses "$1 --border none" 2 "^iris $1: --border: skip, .* not 'none'" "$@" --border none gray.pgm -o no.pgm
done << END
gray
threshold --adaptive 1,0
negative
adjust
compress
stretch
gamma --gamma 2
histogram
equalize --local 1,2
convolve --mask '1 1 1'
blur --box 3
median
unsharp
edge --operator canny
dilate
erode
open
close
gradient
tophat
blackhat
hitmiss --pattern 1
distance
skeleton
quadtree
END
refuses "--border of convert" 2 "^iris convert: unknown option --border" convert --border skip gray.pgm -o no.pgm

# --- masks stay masks ---
works "a mask" threshold --value 100 gray.pgm -o mask.bmp
works "a mask is converted to a mask" convert mask.bmp -o again.bmp
[ "$(bytes again.bmp | tail -c 16)" = 9000000010000000 ]; say $? "1 bit remains"
works "a part of a mask" convert --crop 2,0,2,2 mask.bmp -o part.bmp
[ "$(bytes part.bmp | tail -c 16)" = 4000000040000000 ]; say $? "a part of a mask, pixels"
works "a mask turns gray" gray mask.bmp -o gray_of_mask.pgm
same "a mask turns gray, pixels" gray_of_mask.pgm 50350a3420320a3235350a000000ffff0000ff
works "a mask inverted in part" threshold --value 100 --invert --roi 1,1,3,1 mask.bmp -o part.bmp
[ "$(bytes part.bmp | tail -c 16)" = e000000010000000 ]; say $? "a mask inverted in part, pixels"
works "a mask resized" convert --resize 8x4 --nearest mask.bmp -o large.bmp
[ "$(bytes large.bmp | tail -c 32)" = c3000000c30000000300000003000000 ]; say $? "a mask resized, pixels"
