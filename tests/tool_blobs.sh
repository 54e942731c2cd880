#!/bin/sh
# Blobs from outside. Pictures are drawn here; expected numbers are worked out by hand.
first_argument=
. tests/outside

draw() { # draw FILE WIDTH ROW... : '#' white, '.' black
    drawing=$1; width=$2; shift 2
    { printf 'P5\n%d %d\n255\n' "$width" $#; printf '%s' "$@" | tr '.#' '\000\377'; } > "$drawing"
}
draw parts.pgm 12 ............ .###....#... .#.#.....#.. .###........ ............ ......#####. ............
draw empty.pgm 5 ..... .....

says() { # says NAME TEXT : the last output has TEXT
    grep -qF -- "$2" out; say $? "$1"
}
works "blobs" blobs --json parts.pgm
says "count and the largest first" '"count":3,"blobs":[{"id":1,"x":1,"y":1,"w":3,"h":3,"cx":2,"cy":2,"area":8,'
says "its shape" '"elongation":1,"length":3.16,"breadth":3.16,"perimeter":12.95,"edges":16,"holes":1,"mean":255}'
says "a level bar" '{"id":2,"x":6,"y":5,"w":5,"h":1,"cx":8,"cy":5,"area":5,"angle_deg":-90,"elongation":5,"length":5,"breadth":1,'
says "a corner joins" '{"id":3,"x":8,"y":1,"w":2,"h":2,"cx":8.5,"cy":1.5,"area":2,"angle_deg":-45,'
works "--connectivity 4" blobs --connectivity 4 --json parts.pgm
says "corners do not join" '"count":4,'
works "--count" blobs --count 1 --json parts.pgm
says "the largest alone" '"holes":1,"mean":255}]}'
says "the count is that of all" '"count":3,'
works "for people" blobs parts.pgm
says "how many" 'parts.pgm: 3 blobs'
says "where" '  2: area 5, center 8.0,5.0, box 6,5,5,1, angle -90.0, elongation 5.00, holes 0'
works "nothing" blobs --json empty.pgm
says "no blobs" '"count":0,"blobs":[]}'

filtered() { # filtered COUNT OPTION... : so many pass
    wanted=$1; shift
    works "$*" blobs "$@" --json parts.pgm
    says "$* lets $wanted through" "\"count\":$wanted,"
}
filtered 2 --min-area 3
filtered 1 --min-area 3 --max-area 5
filtered 2 --width 3-5
filtered 1 --width 5
filtered 1 --height 1
filtered 1 --fill 1000
filtered 2 --fill 0-900
filtered 1 --elongation 3-10
filtered 2 --holes 0
filtered 1 --center 0,0,5,5
filtered 3 --inside
works "--roi" blobs --json --roi 5,0,7,7 parts.pgm
says "places in the whole picture" '"count":2,"blobs":[{"id":1,"x":6,"y":5,'
works "--roi and --center" blobs --json --roi 1,1,11,6 --center 8,5,1,1 parts.pgm
says "the center, too" '"count":1,"blobs":[{"id":1,"x":6,"y":5,'
works "overlay" blobs parts.pgm -o out.bmp
works "in color" info out.bmp
says "of the input's size" '12x7'
printf 'P6\n2 1\n255\n\310\226\144\000\000\000' > color.ppm
works "mean of color" blobs --json color.ppm
says "the pixel's color" '"mean":[200,150,100]}'
works "in a pipe" pipe "threshold --value 127 | blobs" parts.pgm -o out.bmp

refuses "--connectivity" 2 "4 or 8, not '6'" blobs --connectivity 6 parts.pgm
refuses "--min-area" 2 "a number from 0 on, not '-1'" blobs --min-area -1 parts.pgm
refuses "--count" 2 "a number from 1 on, not '0'" blobs --count 0 parts.pgm
refuses "--width" 2 "a number or A-B, such as 10-50, not '9-3'" blobs --width 9-3 parts.pgm
refuses "--elongation" 2 "A-B, such as 2.5-100, not 'x'" blobs --elongation x parts.pgm
