#!/bin/sh
# iris paths from outside: a T of strokes, drawn here.
first_argument=
. tests/outside

awk 'BEGIN { printf "P5 160 120 255\n"; for (y = 0; y < 120; y++) for (x = 0; x < 160; x++)
    printf "%s", (y >= 30 && y < 39) || (x >= 76 && x < 85 && y >= 36) ? " " : "~" }' > t.pgm
awk 'BEGIN { printf "P5 160 120 255\n"; for (y = 0; y < 120; y++) for (x = 0; x < 160; x++)
    printf "%s", (x >= 40 && x < 49 && y >= 20) || (x >= 110 && x < 120) ? " " : "~" }' > two.pgm
works "paths" paths --json t.pgm
grep -q '"count":2,"paths":\[{"x0":[01],"y0":34,"x1":15[89],"y1":34,"width":9,"angle_deg":-\{0,1\}90,"length":1[56][0-9]},{"x0":80,"y0":11[89],' out
say $? "the bar of a T, then its stem"
works "paths, text" paths t.pgm
grep -q '^2 lines' out; say $? "counted in the text"
works "paths -o" paths t.pgm -o out.ppm
[ -s out.ppm ]; say $? "the overlay"
works "--method quadtree" paths --method quadtree --json two.pgm
grep -q '"count":2,' out; say $? "two lines by blocks"
works "--roi" paths --json --roi 96,0,64,120 two.pgm
grep -q '"count":1,"paths":\[{"x0":11[45],' out; say $? "the line of a part, in places of the whole"
works "nothing" paths --line bright --json two.pgm
refuses "--method" 2 "skeleton or quadtree, not 'fast'" paths --method fast t.pgm
refuses "--line" 2 "dark or bright, not 'red'" paths --line red t.pgm
