#!/bin/sh
# iris pyramid from outside. Expected bytes are worked out by hand.
first_argument=
. tests/outside

bytes() { # bytes FILE : as hexadecimal digits
    od -An -v -tx1 "$1" | tr -d ' \n'
}
same() { # same NAME FILE HEX
    [ "$(bytes "$2")" = "$3" ]
    say $? "$1"
}
# 0 100 200 40; level 1: (11 * 0 + 4 * 100 + 200) / 16 = 37.5, (0 + 400 + 1200 + 4 * 40 + 40) / 16 = 112.5;
# level 2: (11 * 38 + 5 * 113) / 16 = 61.4
printf 'P5\n4 1\n255\n\000\144\310\050' > row.pgm
printf 'P6\n4 1\n255\n\000\000\000\144\000\144\310\000\310\050\000\050' > row.ppm
works "pyramid --level 1" pyramid --level 1 row.pgm -o out.pgm
same "pyramid --level 1, pixels" out.pgm 50350a3220310a3235350a2671
works "pyramid --level 2" pyramid --level 2 row.ppm -o out.ppm
same "pyramid --level 2, pixels" out.ppm 50360a3120310a3235350a3d003d
works "pyramid --level 0" pyramid --level 0 row.pgm -o out.pgm
cmp -s row.pgm out.pgm; say $? "level 0 is the picture"
works "pyramid --levels 3" pyramid --levels 3 --json row.pgm -o out.pgm
[ "$(cat out)" = '{"file":"row.pgm","output":"out.pgm","width":6,"height":2,"kind":"gray","levels":[{"level":0,"x":0,"y":0,"w":4,"h":1},{"level":1,"x":4,"y":0,"w":2,"h":1},{"level":2,"x":4,"y":1,"w":1,"h":1}]}' ]
say $? "places of the levels"
same "pyramid --levels 3, pixels" out.pgm 50350a3620320a3235350a0064c8282671000000003d00
works "pyramid" pyramid --json row.pgm -o out.pgm
grep -q '"width":6,"height":3,.*"level":3' out; say $? "four levels if nothing is said"
works "pyramid by another border" pyramid --level 1 --border constant:16 row.pgm -o out.pgm
# The row's sums are 680 and 1776, those of the rows beyond 256: (6 * 680 + 10 * 256) / 256 = 25.9, 51.6
same "pyramid by another border, pixels" out.pgm 50350a3220310a3235350a1a34
printf 'P5\n2 1\n255\n\012\132' > two.pgm
works "pyramid --up" pyramid --up two.pgm -o out.pgm
same "pyramid --up, pixels" out.pgm 50350a3420320a3235350a1432505a1432505a
works "pyramid in a pipe" pipe "gray | pyramid --level 1 | pyramid --up" row.ppm -o out.pgm
works "a mask" threshold --value 50 row.pgm -o mask.bmp
works "pyramid of a mask" pyramid --level 1 mask.bmp -o out.pgm
same "pyramid of a mask, pixels" out.pgm 50350a3220310a3235350a509f
for wrong in "--levels 0" "--levels 17" "--levels x" "--level -1" "--level 16" "--level" "--level 1 --levels 2" \
    "--up --level 1" "--border skip" "--roi 0,0,1,1"; do
    refuses "pyramid $wrong" 2 "^iris pyramid: " pyramid $wrong row.pgm -o no.pgm
done
[ ! -e no.pgm ]; say $? "no output file remains after a failure"
