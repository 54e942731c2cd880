#!/bin/sh
# Signatures and matches from outside. Pictures are drawn here; expected numbers are worked out by hand.
first_argument=
. tests/outside

draw() { # draw FILE WIDTH ROW... : '#' white, '.' black
    drawing=$1; width=$2; shift 2
    { printf 'P5\n%d %d\n255\n' "$width" $#; printf '%s' "$@" | tr '.#' '\000\377'; } > "$drawing"
}
says() { # says NAME TEXT : the last output has TEXT
    grep -qF -- "$2" out; say $? "$1"
}
draw square.pgm 12 ............ .#####...... .#####...... .#####...... .#####...... .#####....#. ............
draw empty.pgm 5 ..... .....
mkdir models
draw models/el-1.pgm 16 ................ .####........... .####........... .####........... .####........... \
    .####........... .##############. .##############. .##############. .##############. ................
draw models/el-2.pgm 16 ................ .###............ .###............ .###............ .###............ \
    .###............ .###............ .##############. .##############. .##############. ................
draw models/bar-1.pgm 16 ................ .##############. .##############. .##############. ................
draw turned.pgm 11 ........... .#########. .#########. .#########. .#########. .####...... .####...... .####...... \
    .####...... .####...... .####...... .####...... .####...... .####...... .####...... ...........

works "signature" signature --samples 4 square.pgm
says "where from" 'square.pgm: from 3.0,3.0, longest 2.5 pixels, 0 of 4 rays missing, area 25'
says "the table" '    90.00     2.50       1.000'
works "--json" signature --samples 8 --json square.pgm
says "the numbers" '"x":3,"y":3,"longest":3.536,"step_deg":45,"missing":0,"samples":[0.70709,1,0.70709,1,0.70709,1,0.70709,1],"cx":3,"cy":3,"area":25,"hu":[0.16,0,0,0,0,0,0]'
works "--point and --crossing" signature --samples 4 --crossing last --point 1,3 --json square.pgm
says "from there" '"x":1,"y":3,"longest":4.5,"step_deg":90,"missing":0,"samples":[1,0.55554,0.11111,0.55554]'
works "a point outside of the silhouette" signature --samples 4 --point 0,0 --json square.pgm
says "rays that meet nothing" '"missing":4,"samples":[null,null,null,null]'
works "the plot" signature square.pgm -o plot.bmp
works "is a picture" info --json plot.bmp
says "its size" '"width":810,"height":334'
refuses "no silhouette" 1 "empty.pgm: nothing is white" signature empty.pgm
refuses "--samples" 2 "a number from 4 to 720, not '3'" signature --samples 3 square.pgm
refuses "--crossing" 2 "first or last, not 'all'" signature --crossing all square.pgm
refuses "--point" 2 "x,y in pixels, not '3'" signature --point 3 square.pgm
refuses "--point beyond" 2 "outside of the picture of 12x7 pixels" signature --point 12,3 square.pgm

works "match" match --models models --json turned.pgm
says "the class" '"class":"el","model":"models/el-1.pgm"'
says "not unlike" '"score":0.'
works "for people" match --models models turned.pgm
says "one line" 'turned.pgm: el, score 0.'
for method in height radial moments; do
    works "--method $method" match --models models --method $method --self --json models/bar-1.pgm
    says "$method: the very same" '"class":"bar","model":"models/bar-1.pgm","score":1,'
done
says "moments tell no angle" '"angle_deg":null'
works "a model among the inputs" match --models models --json models/el-1.pgm
says "matches another one" '"class":"el","model":"models/el-2.pgm"'
works "--least" match --models models --least 1 --json models/el-1.pgm
says "unknown" '"class":null,"model":"models/el-2.pgm"'
works "--no-mirror" match --models models --no-mirror --json models/el-1.pgm
says "is not mirrored" '"mirrored":0'
works "nothing" match --models models --json empty.pgm
says "no class" '"class":null,"model":null,"score":0,"angle_deg":null,"mirrored":0}'
works "several, and a file as the models" match --models models/bar-1.pgm --json models turned.pgm
[ "$(wc -l < out)" -eq 4 ]; say $? "one object each"
says "no other model" '"file":"models/bar-1.pgm","width":16,"height":5,"kind":"gray","class":null,"model":null'
works "-o" match --models models turned.pgm -o overlay.bmp
works "a picture of the same size" info --json overlay.bmp
says "in color" '"width":11,"height":16,"bits":24,"kind":"color"'
refuses "no --models" 2 "is needed: a folder" match turned.pgm
refuses "a folder that is not there" 1 "nowhere" match --models nowhere turned.pgm
refuses "--method" 2 "height, radial, or moments, not 'best'" match --models models --method best turned.pgm
refuses "--least" 2 "a score from 0 to 1, such as 0.5, not '2'" match --models models --least 2 turned.pgm
cp empty.pgm models/dark-1.pgm
refuses "a model without a silhouette" 1 "models/dark-1.pgm: nothing is white: no model" match --models models turned.pgm

if [ -d "$data/shapes/mpeg7" ]; then
    run match --models "$data/shapes/mpeg7" --json "$data/shapes/mpeg7"
    [ "$(sed 's|.*/\([a-z]*\)-[0-9]*.bmp","width".*"class":"\([a-z]*\)".*|\1 \2|' out | awk '$1 == $2' | wc -l)" -ge 26 ]
    say $? "at least 26 of 30 real silhouettes"
fi
