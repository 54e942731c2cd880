#!/bin/sh
# Skeletons from outside. Pictures are drawn here; expected pixels are written out.
first_argument=
. tests/outside

draw() { # draw FILE WIDTH ROW... : '#' white, '.' black
    drawing=$1; width=$2; shift 2
    { printf 'P5\n%d %d\n255\n' "$width" $#; printf '%s' "$@" | tr '.#' '\000\377'; } > "$drawing"
}
shows() { # shows NAME FILE WIDTH ROW... : the pixels of a PGM
    draw wanted.pgm "$3" "$4" "$5" "$6" "$7" "$8"
    cmp -s wanted.pgm "$2"; say $? "$1"
}
draw bar.pgm 10 .......... .########. .########. .########. ..........
draw tree.pgm 10 ..#....... ..#....... '##.####.##' .......#.. .......#..

works "skeleton" skeleton bar.pgm -o out.pgm
shows "the middle row of a bar" out.pgm 10 .......... .......... .########. .......... ..........
works "a skeleton of a skeleton" skeleton tree.pgm -o out.pgm
cmp -s tree.pgm out.pgm; say $? "a skeleton stays as it is"
works "--prune" skeleton --prune 2 tree.pgm -o out.pgm
shows "branches of one pixel are taken away" out.pgm 10 .......... ..#....... '##.####.##' .......#.. ..........
works "--show ends" skeleton --show ends tree.pgm -o out.pgm
shows "four ends" out.pgm 10 ..#....... .......... '#........#' .......... .......#..
works "--show branches" skeleton --show branches tree.pgm -o out.pgm
shows "two branch points" out.pgm 10 .......... ..#....... .......... .......#.. ..........
works "--show overlay" skeleton --show overlay bar.pgm -o out.ppm
[ "$(tail -c 150 out.ppm | od -An -v -tx1 | tr -d ' \n' | cut -c 61-240)" = "000000$(printf '606060%.0s' 1 2 3 4 5 6 7 8)00000000000000ff00$(printf 'ffffff%.0s' 1 2 3 4 5 6)00ff00000000000000$(printf '606060%.0s' 1 2 3 4 5 6 7 8)000000" ]
say $? "shape gray, skeleton white, ends green"
works "--roi" skeleton --roi 0,0,10,3 bar.pgm -o out.pgm
shows "what is outside of --roi stays" out.pgm 10 .......... .......... .########. .########. ..........
works "--json" skeleton --json tree.pgm
grep -q '"pixels":12,"ends":4,"branches":2,"passes":1}' out; say $? "--json counts"
works "--method zhang-suen" skeleton --method zhang-suen bar.pgm -o out.pgm
shows "Zhang-Suen, pixels" out.pgm 10 .......... .......... ..#####... .......... ..........
works "in a pipe" pipe "threshold --value 127 | skeleton | dilate --size 3x1" bar.pgm -o out.pgm
shows "in a pipe, pixels" out.pgm 10 .......... .......... '##########' .......... ..........

refuses "--method" 2 "exact or zhang-suen, not 'fast'" skeleton --method fast bar.pgm -o out.pgm
refuses "--prune" 2 "a number of pixels, not '-1'" skeleton --prune -1 bar.pgm -o out.pgm
refuses "--prune of Zhang-Suen" 2 "only with --method exact" skeleton --prune 4 --method zhang-suen bar.pgm -o out.pgm
refuses "--show" 2 "skeleton, ends, branches, or overlay, not 'all'" skeleton --show all bar.pgm -o out.pgm
