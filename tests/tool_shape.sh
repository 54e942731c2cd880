#!/bin/sh
# Shapes from outside: a silhouette is drawn here, taught, and found in pictures that are drawn here, too.
first_argument=shape
. tests/outside

# scene FILE SHIFT_X SHIFT_Y WHITE BLACK : an L with a slanting foot, 100x80 pixels
scene() {
    { printf 'P5\n100 80\n255\n'
      awk -v sx="$2" -v sy="$3" -v white="$4" -v black="$5" 'BEGIN {
          for (y = 0; y < 80; y++) for (x = 0; x < 100; x++) {
              u = x - sx; v = y - sy
              on = (u >= 0 && u < 10 && v >= 0 && v < 40) || (u >= 0 && u < 30 && v >= 28 + u / 5 && v < 40)
              printf "%c", on ? white : black
          } }'; } > "$1"
}
member() { # member KEY : its first value in out
    sed "s/.*\"shapes\":\[{[^}]*\"$1\":\([-0-9.]*\).*/\1/" out
}
near() { # near NAME VALUE EXPECTED TOLERANCE
    awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { exit !(a != "" && a - b <= t && b - a <= t) }'; say $? "$1 is $3: $2"
}
scene template.pgm 20 20 '*' '+'
# white and black alone: a silhouette
LC_ALL=C tr '*+' '\377\000' < template.pgm > silhouette.pgm
scene gray.pgm 20 20 'd' '('
scene dark.pgm 45 30 '(' 'x'
scene none.pgm 200 200 '(' 'x'

works "teach" teach --reference 20,20 l.rtable silhouette.pgm
grep -Eq 'outline of [0-9]+ points, [0-9]+ kept; reference point 20.0, 20.0; [0-9]+ bytes' out
say $? "teach says what it has made"
[ "$(head -c 5 l.rtable | od -An -tx1 | tr -d ' ')" = 4952534801 ]; say $? "a table begins as the header says"
works "find" find --json l.rtable dark.pgm
near "x" "$(member x)" 45 0.7
near "y" "$(member y)" 30 0.7
near "angle_deg" "$(member angle_deg)" 0 1
near "scale" "$(member scale)" 1 0.025
works "a picture with the shape in" find l.rtable dark.pgm -o seen.ppm
cmp -s seen.ppm dark.pgm; [ $? -eq 1 ]; say $? "is another picture"
works "in text" find --count 1 l.rtable dark.pgm
grep -q '^dark.pgm: 1 shape$' out && grep -q 'scale' out; say $? "says what it has found"
works "nothing there" find --json l.rtable none.pgm
grep -q '"shapes":\[\]' out; say $? "finds nothing"
works "--polarity" find --json --polarity same --scales 1 l.rtable dark.pgm
grep -q '"shapes":\[\]' out; say $? "dark is not bright"
works "--polarity reversed" find --json --polarity reversed --scales 1 l.rtable dark.pgm
near "one size" "$(member scale)" 1 0.025
works "--scales without a step" find --json --scales 0.9-1.1 l.rtable dark.pgm
near "x by steps of 0.1" "$(member x)" 45 0.7
works "--roi" find --json --roi 32,16,64,60 l.rtable dark.pgm
near "x in the whole picture" "$(member x)" 45 0.7
works "a gray template" teach --json --entries 60 gray.rtable gray.pgm
grep -Eq '"x":[0-9.]+,"y":[0-9.]+,"points":[0-9]+,"entries":[0-9]+,"bytes":[0-9]+}' out; say $? "teach --json"
works "several pictures" find --json l.rtable dark.pgm none.pgm
[ "$(wc -l < out)" -eq 2 ]; say $? "one object each"

head -c 100 l.rtable > cut.rtable
refuses "no verb" 2 "teach or find"
refuses "another verb" 2 "teach or find" search
refuses "teach without a template" 2 "two files" teach l.rtable
refuses "an empty template" 1 "no shape to teach" teach e.rtable none.pgm
[ ! -e e.rtable ]; say $? "no table is left"
refuses "a template without edges" 1 "edge points, 8 are needed" teach e.rtable none.pgm
refuses "a far --reference" 1 "farther than 2047 pixels.*nearer --reference" teach --reference 3000,5 e.rtable silhouette.pgm
refuses "find without pictures" 2 "a table and pictures" find l.rtable
refuses "no table" 1 "No such file" find nowhere.rtable dark.pgm
refuses "half a table" 1 "damaged" find cut.rtable dark.pgm
refuses "a picture for a table" 1 "no table" find dark.pgm dark.pgm
refuses "--angles" 2 "0.5 to 360 degrees, not '0'" find --angles 0 l.rtable dark.pgm
refuses "--scales" 2 "A-B:STEP" find --scales 2-1:0.1 l.rtable dark.pgm
refuses "--score" 2 "0.001 to 1, not '2'" find --score 2 l.rtable dark.pgm
refuses "--count" 2 "from 1 to 32" find --count 0 l.rtable dark.pgm
refuses "--polarity" 2 "either, same, or reversed" find --polarity any l.rtable dark.pgm
refuses "--low above --high" 2 "at most --high" find --low 50 --high 40 l.rtable dark.pgm
refuses "--reference" 2 "x,y in pixels" teach --reference 5 l.rtable silhouette.pgm
refuses "--entries" 2 "from 8 to 1024" teach --entries 5 l.rtable silhouette.pgm
