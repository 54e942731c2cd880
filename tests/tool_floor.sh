#!/bin/sh
# The floor from outside: marks, floor files, bird's-eye views.
first_argument=
. tests/outside

# A camera 200 mm above the floor, 45 degrees down, of 161x121: x = 80 + 160 X / (Y + 200), y = 60 + 160 (200 - Y) / (Y + 200).
printf '%s\n' '# x y X Y' '40 60 -100 200' '120 60 100 200' '60 -20 -100 600' '100 -20 100 600' '' '80 60 0 200 # middle' > marks.txt
works "floor" floor --points marks.txt --size 161x121 -o a.floor
grep -q '5 points, off by 0.00 pixels and 0.0 mm' out; say $? "exact marks fit"
[ "$(head -1 a.floor)" = "iris floor 1" ] && grep -q '^size 161 121$' a.floor && grep -q '^# point 80 60 at 0 200 mm' a.floor
say $? "the floor file"
works "floor --json" floor --points marks.txt --size 161x121 --json
grep -q '"width":161,"height":121,"rms_px":0,"max_px":0,.*"points":\[{"line":2,"off_px":0' out; say $? "--json"
works "floor -o -" floor --points marks.txt --size 161x121 -o -
cmp -s out a.floor; say $? "the floor on standard output alone"
printf 'P5\n161 121\n255\n' > frame.pgm
head -c 19481 /dev/zero | tr '\000' '\144' >> frame.pgm
works "floor --image" floor --points marks.txt --image frame.pgm -o b.floor
cmp -s a.floor b.floor; say $? "--image knows the size"
sed 's/^80 60/84 60/' marks.txt > off.txt
works "a mark that is off" floor --points off.txt --size 161x121
grep -q '^worst: line [0-9]*, by [1-3]\.' out; say $? "is told"

# A gray ramp: the floor's middle line is at column 80, 100 mm to the right of it at 200 mm ahead is column 120.
{ printf 'P5\n161 121\n255\n'; for y in 1 2 3 4 5 6 7 8 9 10 11; do for k in 1 2 3 4 5 6 7 8 9 10 11; do
    i=0; while [ $i -le 160 ]; do printf "\\$(printf %03o $i)"; i=$((i + 1)); done; done; done; } > ramp.pgm
works "birdseye" birdseye --floor a.floor --window -101,190,101,210 --scale 2 ramp.pgm -o map.pgm
[ "$(head -2 map.pgm | tail -1)" = "101 10" ]; say $? "its size"
set -- $(tail -c 505 map.pgm | od -An -v -tu1 | tr -s ' \n' '  ')
[ "$1" = 40 ] && [ "${51}" = 80 ] && [ "${101}" = 120 ]; say $? "its pixels: 40, 80, 120, not $1, ${51}, ${101}"
works "birdseye --json" birdseye --floor a.floor --window -101,190,101,1000 --scale 2 --fill 7 ramp.pgm -o map.bmp --json
grep -q '"width":101,"height":405,"kind":"gray","mm_per_pixel":2,"corner_x_mm":-100,"corner_y_mm":999}' out; say $? "--json"
works "in a pipe" pipe "negative | birdseye --floor a.floor --window 0,190,10,210" ramp.pgm -o map.pgm

# Tape of 20 mm that runs straight ahead, 40 mm to the right.
awk 'BEGIN { printf "P5 161 121 255\n"
    for (y = 0; y < 121; y++) for (x = 0; x < 161; x++) {
        off = x - 80 - 0.1 * (y + 100)
        printf "%s", off * off < 0.000625 * (y + 100) * (y + 100) ? " " : "~" } }' > tape.pgm
near() { # near KEY VALUE TOLERANCE : in out
    sed -n "s/.*\"$1\":\([^,}]*\).*/\1/p" out | awk -v want="$2" -v most="$3" '
        $1 ~ /^[-0-9.]+$/ { d = $1 - want; good = d <= most && -d <= most }
        END { exit !good }'
    say $? "$1 within $3 of $2"
}
works "follow --floor" follow --floor a.floor --json tape.pgm
near offset_mm 40 1.5; near distance_mm 200 0.5; near heading_deg 0 1; near steer 0.15 0.01
grep -q '"segments_mm":\[{"x0":[34]' out; say $? "segments in millimeters"
works "follow --lookahead --radius --axle" follow --floor a.floor --lookahead 300 --radius 150 --axle -50 --json tape.pgm
near offset_mm 40 1.5; near distance_mm 300 0.5; near steer 0.133 0.01
works "follow --floor in words" follow --floor a.floor tape.pgm
grep -Eq '  at  200 mm +[+](39|40|41) mm  heading ' out; say $? "millimeters in words"
works "follow without" follow --json tape.pgm
! grep -q _mm out; say $? "has no millimeters"
refuses "follow --radius alone" 2 "radius: only together with --floor" follow --radius 75 tape.pgm
refuses "follow --lookahead" 2 "10 to 10000 millimeters, not '9'" follow --floor a.floor --lookahead 9 tape.pgm
refuses "follow with a damaged floor" 1 "line 2: not a floor" follow --floor marks.txt tape.pgm
{ printf 'P5\n160 120\n255\n'; tail -c 19200 tape.pgm; } > small.pgm
refuses "follow another size" 1 "small.pgm: 160x120 pixels, but the floor file was made for pictures of 161x121" follow --floor a.floor small.pgm

refuses "no points" 2 "points FILE is needed" floor --size 161x121
refuses "no size" 2 "size WxH or --image IN" floor --points marks.txt
refuses "two sizes" 2 "size WxH or --image IN" floor --points marks.txt --size 9x9 --image ramp.pgm
refuses "--size" 2 "WxH in pixels, not '9'" floor --points marks.txt --size 9
refuses "an operand" 2 "no operand is expected" floor --points marks.txt --size 9x9 marks.txt
refuses "points that are not there" 1 "none.txt: No such file" floor --points none.txt --size 9x9
refuses "a picture as points" 1 "line 1: four numbers" floor --points ramp.pgm --size 9x9
printf '1 2 3 4\n1 2 3\n' > bad.txt
refuses "three numbers" 1 "bad.txt: line 2: four numbers" floor --points bad.txt --size 9x9
head -4 marks.txt > few.txt
refuses "three marks" 1 "four different points are needed at least \(3 points\)" floor --points few.txt --size 161x121
printf '%s\n' '40 60 -100 200' '80 60 0 200' '120 60 100 200' '60 -20 -100 600' > line.txt
refuses "three in a line" 1 "on one line" floor --points line.txt --size 161x121 -o no.floor
[ ! -e no.floor ]; say $? "and no file"
sed 's/^\(4\|6\)0 \(60\|-20\) -100/\10 \2 +/; s/^\(12\|10\)0 \(60\|-20\) 100/\10 \2 -100/; s/+/100/' marks.txt > mirror.txt
refuses "a mirror" 1 "a mirror.s view" floor --points mirror.txt --size 161x121
printf '%s\n' '120 60 -100 200' '40 60 100 200' '60 -20 -100 600' '100 -20 100 600' > bow.txt
refuses "two interchanged" 1 "may be interchanged" floor --points bow.txt --size 161x121
{ printf 'P5\n160 120\n255\n'; tail -c 19200 ramp.pgm; } > small.pgm
refuses "another size" 1 "160x120 pixels, but the floor file was made for pictures of 161x121" birdseye --floor a.floor --window 0,1,2,3 small.pgm -o x.pgm
refuses "no floor" 2 "floor: is needed" birdseye --window 0,1,2,3 ramp.pgm -o x.pgm
refuses "no window" 2 "window: is needed" birdseye --floor a.floor ramp.pgm -o x.pgm
refuses "--window" 2 "left below right and near below far, not '0,3,2,1'" birdseye --floor a.floor --window 0,3,2,1 ramp.pgm -o x.pgm
refuses "too large" 2 "pixels at this --scale" birdseye --floor a.floor --window -9000,0,9000,9000 --scale 0.1 ramp.pgm -o x.pgm
refuses "--scale" 2 "millimeters per pixel, not '0'" birdseye --floor a.floor --window 0,1,2,3 --scale 0 ramp.pgm -o x.pgm
refuses "--fill" 2 "0 to 255, not '256'" birdseye --floor a.floor --window 0,1,2,3 --fill 256 ramp.pgm -o x.pgm
sed 's/^size 161/size 162/' a.floor > damaged.floor
refuses "a damaged floor" 1 "damaged.floor: line 7: not a floor file, or damaged" birdseye --floor damaged.floor --window 0,1,2,3 ramp.pgm -o x.pgm
head -3 a.floor > short.floor
refuses "half a floor" 1 "short.floor: line 4: ends early" birdseye --floor short.floor --window 0,1,2,3 ramp.pgm -o x.pgm
sed 's/floor 1/floor 2/' a.floor > later.floor
refuses "a later floor" 1 "line 1: a later version" birdseye --floor later.floor --window 0,1,2,3 ramp.pgm -o x.pgm
