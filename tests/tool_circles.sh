#!/bin/sh
# Circles from outside. The picture is drawn here: a bright disc at 40,30 with radius 16, a dark one at 85,40 with radius 10.
first_argument=
. tests/outside

says() { # says NAME PATTERN : the last output has it
    grep -Eq -- "$2" out; say $? "$1"
}
draw() { # draw FILE GROUND ONE OTHER : letters that stand for levels
    { printf 'P5\n120 70\n255\n'
      awk -v g="$2" -v a="$3" -v b="$4" 'BEGIN { for (y = 0; y < 70; y++) for (x = 0; x < 120; x++)
          printf "%s", ((x - 40) ^ 2 + (y - 30) ^ 2 <= 260 ? a : (x - 85) ^ 2 + (y - 40) ^ 2 <= 104 ? b : g) }'
    } > "$1"
}
draw discs.pgm P z ' '
draw faint.pgm P f P
draw empty.pgm P P P

works "circles" circles --radius 8-20 --json discs.pgm
says "the bright one first" '"circles":\[\{"x":(39.9[0-9]?|40|40.0[0-9]?),"y":(29.9[0-9]?|30|30.0[0-9]?),"r":(15\.[89]|16)[.0-9]*,"votes":1[0-2][0-9]\},'
says "the dark one behind it" '\},\{"x":(84.9[0-9]?|85|85.0[0-9]?),"y":(39.9[0-9]?|40|40.0[0-9]?),"r":(9\.[89]|10)[.0-9]*,"votes":[678][0-9]\}\]\}'
works "one radius" circles --radius 10 --json discs.pgm
says "that one alone" '"circles":\[\{"x":8[45][^{]*\}\]\}'
works "--polarity" circles --radius 8-20 --polarity bright --json discs.pgm
says "the bright one alone" '"circles":\[\{"x":(39|40)[^{]*\}\]\}'
works "--count" circles --radius 8-20 --count 1 --json discs.pgm
says "the best alone" '"circles":\[\{"x":(39|40)[^{]*\}\]\}'
works "--votes" circles --radius 8-20 --votes 90 --json discs.pgm
says "the larger alone" '"circles":\[\{"x":(39|40)[^{]*\}\]\}'
works "--distance" circles --radius 8-20 --distance 60 --json discs.pgm
says "the better of two" '"circles":\[\{"x":(39|40)[^{]*\}\]\}'
works "--roi" circles --radius 8-20 --roi 60,10,60,60 --json discs.pgm
says "places are those of the whole picture" '"circles":\[\{"x":(84.9[0-9]?|85|85.0[0-9]?),"y":(39.9[0-9]?|40|40.0[0-9]?),[^{]*\}\]\}'
works "a part of it" circles --radius 8-20 --roi 40,0,40,70 --json discs.pgm
says "half a disc" '"circles":\[\{"x":(39|40)[^{]*\}\]\}'
works "--share" circles --radius 8-20 --share 700 --roi 40,0,40,70 --json discs.pgm
says "half a disc is not enough" '"circles":\[\]\}'
works "faint" circles --radius 8-20 --json faint.pgm
says "is found" '"circles":\[\{"x":(39|40)[^{]*\}\]\}'
works "with thresholds as asked for" circles --radius 8-20 --low 400 --high 500 --json faint.pgm
says "is not found" '"circles":\[\]\}'
works "nothing" circles --radius 8-20 --json empty.pgm
says "no circles" '"circles":\[\]\}'
works "for people" circles --radius 8-20 discs.pgm
says "how many" '^discs.pgm: 2 circles$'
says "where" '^  center (39.9|40.0)[0-9],(29.9|30.0)[0-9], radius 1[56]\.[0-9]+, [0-9]+ votes$'
works "-o and --accumulator" circles --radius 8-20 --accumulator votes.pgm discs.pgm -o out.ppm
[ "$(head -c 15 out.ppm | tr '\n' ' ')" = "P6 120 70 255 " ] || [ "$(head -c 2 out.ppm)" = P6 ]; say $? "an overlay in color"
[ "$(head -2 votes.pgm | tr '\n' ' ')" = "P5 60 35 " ]; say $? "a pixel for each cell"
works "--accumulator of one radius" circles --radius 16 --accumulator votes.pgm discs.pgm
brightest=$(tail -c 2100 votes.pgm | od -An -v -tu1 -w1 | awk '$1 > m { m = $1; at = NR - 1 } END { print m, at % 60, int(at / 60) }')
case $brightest in 255\ 20\ 1[45] | 255\ 19\ 1[45]) true ;; *) false ;; esac
say $? "bright at the center of that disc"
works "in a pipe" pipe "blur --sigma 1 | circles --radius 8-20" discs.pgm -o out.bmp

refuses "without --radius" 2 "missing: how large" circles discs.pgm
refuses "--radius" 2 "3 to 1023 pixels, such as 10-50, not '2-9'" circles --radius 2-9 discs.pgm
refuses "--radius the wrong way round" 2 "not '9-5'" circles --radius 9-5 discs.pgm
refuses "--radius too large" 2 "not '5-1024'" circles --radius 5-1024 discs.pgm
refuses "--polarity" 2 "bright, dark, or either, not 'red'" circles --radius 9 --polarity red discs.pgm
refuses "--share" 2 "from 1 to 1000, not '0'" circles --radius 9 --share 0 discs.pgm
refuses "--sigma" 2 "0.1 to 40 pixels" circles --radius 9 --sigma 0.01 discs.pgm
refuses "--low above --high" 2 "at most --high" circles --radius 9 --low 50 --high 40 discs.pgm
refuses "--accumulator of several" 2 "only with one picture" circles --radius 9 --accumulator votes.pgm discs.pgm faint.pgm
