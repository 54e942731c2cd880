#!/bin/sh
# Straight lines from outside. Pictures are drawn here.
first_argument=
. tests/outside

level() { # level COUNT OCTAL : so many bytes
    head -c "$1" /dev/zero | tr '\000' "\\$2"
}
band() { # band FILE OCTAL TOP ROWS LEFT COLUMNS : a rectangle on dark ground, 100x100
    { printf 'P5\n100 100\n255\n'; level $((100 * $3)) 000
      i=0; while [ $i -lt "$4" ]; do level "$5" 000; level "$6" "$2"; level $((100 - $5 - $6)) 000; i=$((i + 1)); done
      level $((100 * (100 - $3 - $4))) 000; } > "$1"
}
has() { # has NAME TEXT : the text stands in the output
    grep -qF -e "$2" out; say $? "$1"
}
counts() { # counts NAME NUMBER : so many segments in the JSON of the output
    [ "$(grep -o '"rho"' out | wc -l)" -eq "$2" ]; say $? "$1"
}
band square.pgm 310 30 40 30 40
band upright.pgm 377 10 80 40 1
band empty.pgm 000 0 100 0 100
"$iris" threshold --value 127 upright.pgm -o upright.bmp

works "lines" lines square.pgm
has "people read what was found" "square.pgm: 4 lines in 4 segments"
has "and each segment" "  rho "
works "--json" lines --json square.pgm
counts "the sides of a square" 4
works "--count" lines --json --count 2 square.pgm
counts "two of them" 2
works "--angles" lines --json --angles -20,20 square.pgm
counts "the upright ones" 2
works "--angles through the level lines" lines --json --angles 70,-70 square.pgm
counts "the level ones" 2
works "--votes" lines --json --votes 60 square.pgm
counts "none that is so long" 0
works "--min-length" lines --json --min-length 60 square.pgm
counts "none of that length" 0
works "--high" lines --json --low 2000 --high 3000 square.pgm
counts "no edge that is so strong" 0
works "--full-circle" lines --json --full-circle --angles 340,20 square.pgm
counts "one side gets brighter to the right" 1
works "--full-circle, the other way" lines --json --full-circle --angles 160,200 square.pgm
counts "one side gets brighter to the left" 1
has "theta up to 360" '"theta_deg":180'
works "a mask" lines --json upright.bmp
has "its line, and its lower end first" '"lines":[{"rho":-9.5,"theta_deg":0,"votes":80,"x0":40,"y0":89,"x1":40,"y1":10}]'
works "--mask" lines --json --mask --angles -5,5 --theta-bins 10 --rho-step 2 upright.pgm
has "the same line" '{"rho":-9.5,"theta_deg":0,"votes":80,"x0":40,"y0":89,"x1":40,"y1":10}'
works "--full-circle of a mask" lines --json --full-circle upright.bmp
has "rho is not negative" '"lines":[{"rho":9.5,"theta_deg":180,"votes":80,"x0":40,"y0":89,"x1":40,"y1":10}]'
works "--roi" lines --json --roi 20,20,50,60 --mask upright.pgm
has "ends in the whole picture, rho from the middle of the part" '{"rho":-4.5,"theta_deg":0,"votes":60,"x0":40,"y0":79,"x1":40,"y1":20}'
works "nothing" lines --json empty.pgm
has "an empty list" '"lines":[]'
works "-o" lines --mask upright.pgm -o out.ppm
head -c 10 out.ppm | grep -q 'P6' && [ "$(wc -c < out.ppm)" -eq 30015 ]; say $? "an overlay of the picture's size"
[ "$(tail -c 29850 out.ppm | head -c 150 | tr -d '\000' | wc -c)" -eq 0 ]; say $? "nothing is drawn beyond the ends"
works "--accumulator" lines --mask --accumulator votes.pgm upright.pgm
[ "$(head -n 2 votes.pgm | tail -n 1)" = "142 180" ]; say $? "a row for each angle, a column for each rho"
[ "$(tail -c $((142 * 90)) votes.pgm | head -c 142 | tr -d '\377' | wc -c)" -eq 141 ]; say $? "the upright line is its brightest bin"
works "in a pipe" pipe "threshold --value 127 | lines" upright.pgm -o out.ppm

refuses "--votes" 2 "a whole number from 1 to 65535, not '0'" lines --votes 0 square.pgm
refuses "--angles" 2 "LO,HI, whole degrees from -90 to 90, not '5'" lines --angles 5 square.pgm
refuses "--angles too far" 2 "from -90 to 90, not '0,100'" lines --angles 0,100 square.pgm
refuses "--rho-step" 2 "1, 2, 4, 8, 16, 32, or 64 pixels, not 3" lines --rho-step 3 square.pgm
refuses "--low above --high" 2 "at most --high, not 50 above 40" lines --low 50 --high 40 square.pgm
refuses "--sigma" 2 "0, or 0.1 to 40 pixels, not '90'" lines --sigma 90 square.pgm
refuses "--accumulator of two" 2 "only with one picture" lines --accumulator votes.pgm square.pgm upright.pgm
refuses "--theta-bins" 2 "a whole number from 1 to 4096, not '5000'" lines --theta-bins 5000 square.pgm
refuses "--min-length" 2 "a whole number from 1 to 32767, not 'x'" lines --min-length x square.pgm
