#!/bin/sh
# Quadtrees from outside. Expected pixels and numbers are worked out by hand.
first_argument=
. tests/outside

gray() { # gray FILE WIDTH HEIGHT LEVEL... : a PGM
    file=$1; head=$2' '$3; shift 3
    { printf 'P5\n%s\n255\n' "$head"; for level; do printf "\\$(printf %03o "$level")"; done; } > "$file"
}
shows() { # shows NAME LEVEL... : the pixels of out.pgm, 4x2
    name=$1; shift
    gray wanted.pgm 4 2 "$@"
    cmp -s wanted.pgm out.pgm; say $? "$name"
}
has() { # has NAME TEXT : the text stands in the output
    grep -qF "$2" out; say $? "$1"
}
gray in.pgm 4 2 10 10 200 200 10 10 200 100
printf 'P6\n2 1\n255\n\377\000\000\000\000\377' > in.ppm

works "quadtree" quadtree in.pgm -o out.pgm
shows "blocks down to one pixel" 10 10 200 200 10 10 200 100
works "--min" quadtree --min 2 in.pgm -o out.pgm
shows "blocks of 2x2 with their means" 10 10 175 175 10 10 175 175
works "--tolerance" quadtree --tolerance 190 in.pgm -o out.pgm
shows "one block" 93 93 93 93 93 93 93 93
works "--grid" quadtree --tolerance 190 --grid in.pgm -o out.pgm
shows "edges of a dark block halfway to white" 174 174 174 174 174 93 93 93
works "--grid --min" quadtree --min 2 --grid in.pgm -o out.pgm
shows "edges of a bright block halfway to black" 132 132 87 87 132 10 87 175
works "--show regions" quadtree --show regions --area 2 in.pgm -o out.pgm
shows "small regions join a neighbor" 10 10 175 175 10 10 175 175
works "--show regions --merge" quadtree --show regions --area 0 --merge 190 in.pgm -o out.pgm
shows "all merged" 93 93 93 93 93 93 93 93
works "--roi" quadtree --roi 2,0,2,2 --min 2 in.pgm -o out.pgm
shows "what is outside of --roi stays" 10 10 175 175 10 10 175 175
works "in a pipe" pipe "quadtree --min 2 | negative" in.pgm -o out.pgm
shows "in a pipe, pixels" 245 245 80 80 245 245 80 80

works "--json" quadtree --area 0 --json in.pgm
has "--json, leaves" '"leaves":[{"x":0,"y":0,"w":2,"h":1,"mean":10,"region":0},{"x":2,"y":0,"w":2,"h":1,"mean":200,"region":1},{"x":0,"y":1,"w":2,"h":1,"mean":10,"region":0},{"x":2,"y":1,"w":1,"h":1,"mean":200,"region":1},{"x":3,"y":1,"w":1,"h":1,"mean":100,"region":2}]'
has "--json, regions" '"regions":[{"mean":10,"area":4,"leaves":2,"x":0,"y":0,"w":2,"h":2},{"mean":200,"area":3,"leaves":2,"x":2,"y":0,"w":2,"h":2},{"mean":100,"area":1,"leaves":1,"x":3,"y":1,"w":1,"h":1}]}'
works "--json --roi" quadtree --area 0 --json --roi 2,0,2,2 in.pgm
has "places are those in the whole picture" '"regions":[{"mean":200,"area":3,"leaves":3,"x":2,"y":0,"w":2,"h":2},{"mean":100,"area":1,"leaves":1,"x":3,"y":1,"w":1,"h":1}]}'
works "--json of color" quadtree --json --area 0 in.ppm -o out.bmp
has "three means" '"leaves":[{"x":0,"y":0,"w":1,"h":1,"mean":[255,0,0],"region":0},{"x":1,"y":0,"w":1,"h":1,"mean":[0,0,255],"region":1}]'
works "a mask" threshold --value 127 in.pgm -o mask.bmp
works "--json of a mask" quadtree --json --area 0 mask.bmp
has "a mask is black and white" '"regions":[{"mean":0,"area":4,"leaves":2,"x":0,"y":0,"w":2,"h":2},{"mean":255,"area":3,'

refuses "--tolerance" 2 "tolerance: 0 to 255, not '256'" quadtree --tolerance 256 in.pgm -o out.pgm
refuses "--min" 2 "min: 1 to 32767, not '0'" quadtree --min 0 in.pgm -o out.pgm
refuses "--merge" 2 "merge: 0 to 255, not 'x'" quadtree --merge x in.pgm -o out.pgm
refuses "--area" 2 "area: 0 to 2147483647, not '-1'" quadtree --area -1 in.pgm -o out.pgm
refuses "--show" 2 "means or regions, not 'grid'" quadtree --show grid in.pgm -o out.pgm
