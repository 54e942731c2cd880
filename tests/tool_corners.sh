#!/bin/sh
# Corners of chessboards in pictures, from outside.
first_argument=corners
. tests/outside

# A board of 5x4 corners, squares of 16 pixels, the first corner between the pixels 39 and 40, 29 and 30; in a gray picture.
board() { # board WIDTH HEIGHT
    LC_ALL=C awk -v w="$1" -v h="$2" 'BEGIN { print "P5", w, h, 255
        for (y = 0; y < h; y++) { for (x = 0; x < w; x++) {
            i = int((x + 24) / 16) - 4; j = int((y + 34) / 16) - 4
            inside = i >= -1 && j >= -1 && i < 5 && j < 4
            printf("%c", inside ? ((i + j) % 2 == 0 ? 30 : 120) : x > 12 && y > 4 && x < 140 && y < 110 ? 120 : 70) } } }'
}
board 160 120 > board.pgm
works "corners" --board 5x4 board.pgm
awk '{ d = $1 - 39.5 - 16 * ((NR - 1) % 5); e = $2 - 29.5 - 16 * int((NR - 1) / 5); if (d * d + e * e > 0.01) bad = 1 }
    END { exit bad || NR != 20 }' out
say $? "a line for each, in order"
cp out list.txt
works "--json" --board 5x4 --json board.pgm
grep -Eq '"corners":\[\[39\.[0-9]*,29\.[0-9]*\],\[55\.' out; say $? "has corners"
works "-o" --board 5x4 board.pgm -o drawn.ppm
[ "$(head -c 2 drawn.ppm)" = P6 ]; say $? "a picture in color"
works "--roi" --board 5x4 --roi 8,2,150,110 board.pgm
awk 'NR == FNR { x[NR] = $1; y[NR] = $2; next } { d = $1 - x[FNR]; e = $2 - y[FNR]; if (d * d + e * e > 0.0001) bad = 1 }
    END { exit bad || FNR != 20 }' list.txt out
say $? "places are those of the whole picture"
cp board.pgm again.pgm
works "two pictures" --board 5x4 board.pgm again.pgm
[ "$(grep -c '^#' out)" -eq 2 ] && [ "$(grep -vc '^#' out)" -eq 40 ] && sed -n 1p out | grep -q '^# board.pgm$'; say $? "each with its name"
board 80 120 > cut.pgm
refuses "a part of it" 1 "corners: cut.pgm: no board of 5x4 corners: [0-9]* are seen, over [0-9x]*; the rest is beyond the picture's edge" --board 5x4 cut.pgm
refuses "a larger board" 1 "board.pgm: no board of 4x4 corners: 20 are seen, over 5x4; that board is larger" --board 4x4 board.pgm
refuses "a smaller board" 1 "board.pgm: no board of 6x4 corners: 20 are seen, over 5x4; the rest is covered" --board 6x4 board.pgm
{ printf 'P5 40 30 255\n'; yes 99 | head -c 1200; } > gray.pgm
refuses "no board" 1 "gray.pgm: no board is seen" --board 5x4 gray.pgm
run --board 5x4 gray.pgm board.pgm cut.pgm
[ $code -eq 1 ] && [ "$(wc -l < err)" -eq 2 ] && [ "$(grep -vc '^#' out)" -eq 20 ]; say $? "the others go on"
refuses "--board is needed" 2 "board: missing: inner corners" board.pgm
for word in 9 9x 2x6 9x65 9x6x1 x -9x6; do
    refuses "--board $word" 2 "board: CxR, .*, not '$word'" "--board=$word" board.pgm
done

# 5x4 circles of radius 5, 20 pixels apart, the first at 30, 25; and 3x5 shifted ones, the first at 25, 25.
circles() { # circles SHIFTED
    LC_ALL=C awk -v shifted="$1" 'BEGIN { print "P5 160 120 255"
        for (y = 0; y < 120; y++) { for (x = 0; x < 160; x++) { level = 120
            for (r = 0; r < 4 + shifted; r++) for (c = 0; c < 5 - 2 * shifted; c++) {
                u = shifted ? 25 + 36 * c + 18 * (r % 2) : 30 + 20 * c; v = shifted ? 25 + 18 * r : 25 + 20 * r
                d = (x - u) ^ 2 + (y - v) ^ 2; level = d < 25 ? 30 : d == 25 ? 75 : level }
            printf("%c", level) } } }'
}
circles 0 > circles.pgm
works "--circles" --board 5x4 --circles circles.pgm
awk '{ d = $1 - 30 - 20 * ((NR - 1) % 5); e = $2 - 25 - 20 * int((NR - 1) / 5); if (d * d + e * e > 0.001) bad = 1 }
    END { exit bad || NR != 20 }' out
say $? "their centers, in order"
circles 1 > shifted.pgm
works "--shifted-circles" --board 3x5 --shifted-circles shifted.pgm
awk '{ r = int((NR - 1) / 3); d = $1 - 25 - 36 * ((NR - 1) % 3) - 18 * (r % 2); e = $2 - 25 - 18 * r; if (d * d + e * e > 0.001) bad = 1 }
    END { exit bad || NR != 15 }' out
say $? "their centers, row by row"
refuses "circles are no corners" 1 "no board is seen, of 5x4 or any other corners" --board 5x4 circles.pgm
refuses "more circles" 1 "no board of 6x4 circles: 20 are seen, over 5x4" --board 6x4 --circles circles.pgm
refuses "either circles" 2 "circles: not together with --shifted-circles" --board 3x5 --circles --shifted-circles shifted.pgm

if [ -d "$data/calib/chessboard" ]; then
    for n in 01 05 08 14; do
        works "left$n" --board 9x6 "$data/calib/chessboard/left$n.pgm"
        cp out "left$n.txt"
        paste out "$data/calib/chessboard/left${n}_corners.txt" |
            awk '{ d = ($1 - $3) ^ 2 + ($2 - $4) ^ 2; if (d > 0.16) bad = 1 } END { exit bad || NR != 54 }'
        say $? "near OpenCV's"
    done
    timeout 30 "$iris" calibrate board --board 9x6 --square 25mm --corners left??.txt > out 2> err
    grep -q '^4 views, off by 0\.1' out; say $? "calibrate board reads them"
else
    echo "ok - a real chessboard # SKIP no data (IRIS_DATA)"
fi
