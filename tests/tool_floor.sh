#!/bin/sh
# The floor from outside: marks, floor files, bird's-eye views.
first_argument=
. tests/outside

# A camera 200 mm above the floor, 45 degrees down, of 161x121: x = 80 + 160 X / (Y + 200), y = 60 + 160 (200 - Y) / (Y + 200).
printf '%s\n' '# x y X Y' '40 60 -100 200' '120 60 100 200' '48 28 -100 300' '112 28 100 300' '' '80 60 0 200 # middle' > marks.txt
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

# --- the same camera by its file and its mounting: focal length 160 / sqrt(2) = 113.137, principal point (80, 60) ---
board() { # board K1 FILE : a camera file from five views through a lens
    awk -v k="$1" 'BEGIN { for (v = 0; v < 5; v++) { a = 1.2566 * v; t = 0.5; c = cos(t); s = sin(t); p = cos(a); q = sin(a)
        for (j = 0; j < 6; j++) for (i = 0; i < 8; i++) {
            x = 25 * i - 87.5; y = 25 * j - 62.5; along = p * x + q * y; across = q * x - p * y
            u = p * along + q * across * c; w = q * along - p * across * c; z = 300 + across * s
            u /= z; w /= z; d = 1 + k * (u * u + w * w); f = 160 / sqrt(2)
            printf "%.9g %.9g\n", 80 + f * u * d, 60 + f * w * d > "view" v ".txt" } } }'
    run calibrate board --board 8x6 --model none --image-size 161x121 --corners view?.txt -o "$2"
}
board 0 flat.camera
works "floor --calib" floor --calib flat.camera --height 200 --tilt 45 -o mounted.floor
grep -q "^the picture's middle sees: [+-]0 mm to the right, 200 mm ahead$" out; say $? "in words"
works "birdseye of that floor" birdseye --floor mounted.floor --window -101,190,101,210 --scale 2 ramp.pgm -o map.pgm
set -- $(tail -c 505 map.pgm | od -An -v -tu1 | tr -s ' \n' '  ')
[ "$1" = 40 ] && [ "${51}" = 80 ] && [ "${101}" = 120 ]; say $? "its pixels: 40, 80, 120, not $1, ${51}, ${101}"
works "birdseye --calib" birdseye --calib flat.camera --height 200 --tilt 45 --window -101,190,101,210 --scale 2 ramp.pgm -o map.pgm
set -- $(tail -c 505 map.pgm | od -An -v -tu1 | tr -s ' \n' '  ')
[ "$1" = 40 ] && [ "${51}" = 80 ] && [ "${101}" = 120 ]; say $? "its pixels: 40, 80, 120, not $1, ${51}, ${101}"
works "floor --calib --json" floor --calib flat.camera --height 200 --tilt 45 --ahead 50 --right -7 --json
grep -Eq '"output":null,"width":161,"height":121,"near_mm":\[-7,[0-9.]*\],"middle_mm":\[-7,250\],"lens_px":0}$' out; say $? "--json of a mounting"
works "a level camera by --calib" floor --calib flat.camera --height 200 --tilt 0 --json
grep -q '"middle_mm":null' out; say $? "its middle is on the horizon"
board -0.3 bent.camera
run floor --calib bent.camera --height 200 --tilt 45 -o bent.floor
[ $code -eq 0 ] && grep -q 'bent.camera: warning: the lens bends by up to [0-9.]* pixels: .* after iris undistort' err; say $? "a lens that bends is told"
# What is 40 pixels beside the axis without it, 0.354 focal lengths, is at 0.354 (1 - 0.3 * 0.125) = 0.340 through it: column 118.5.
works "birdseye --calib through a lens" birdseye --calib bent.camera --height 200 --tilt 45 --window -101,199,101,201 --scale 2 ramp.pgm -o map.pgm
set -- $(tail -c 101 map.pgm | od -An -v -tu1 | tr -s ' \n' '  ')
[ "${51}" = 80 ] && [ "${101}" -ge 118 ] && [ "${101}" -le 119 ]; say $? "its pixels: 80, 118.5, not ${51}, ${101}"
for wrong in "--calib flat.camera" "--calib flat.camera --height 200" "--height 200 --tilt 45" "--calib flat.camera --height 0 --tilt 45" \
    "--calib flat.camera --height 200 --tilt 91" "--calib flat.camera --height x --tilt 45" "--calib flat.camera --height 200 --tilt 45 --pan 200" \
    "--points marks.txt --size 161x121 --tilt 45"; do
    # shellcheck disable=SC2086
    refuses "floor $wrong" 2 '^iris floor: ' floor $wrong
done
refuses "floor --calib with --size" 2 "without --size" floor --calib flat.camera --height 200 --tilt 45 --size 161x121
refuses "floor of a camera that is none" 1 "marks.txt: line 2: not a camera file" floor --calib marks.txt --height 200 --tilt 45
refuses "birdseye --floor with --calib" 2 "floor: not together" birdseye --floor a.floor --calib flat.camera --window 0,190,10,210 ramp.pgm -o map.pgm

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

# --- points files as others write them, and marks to be warned of ---
warns() { # warns NAME PATTERN ARGUMENT... : exit 0, one line on standard error that matches
    name=$1; pattern=$2; shift 2; run "$@"
    [ $code -eq 0 ] && [ "$(wc -l < err)" -eq 1 ] && grep -Eq "$pattern" err; say $? "$name"
}
sed 's/ *#.*//; s/ /,/g; s/$/\r/' marks.txt > commas.csv
sed '1d; s/ *#.*//; s/ /; /g' marks.txt > semicolons.csv
tr ' ' '\t' < marks.txt > tabs.txt
{ printf '\357\273\277'; sed 1d commas.csv; } > bom.csv
for file in commas.csv semicolons.csv tabs.txt bom.csv; do
    works "$file" floor --points $file --size 161x121 -o c.floor
    cmp -s a.floor c.floor; say $? "$file: the same floor"
done
printf '1 2 3 1,5 7\n' > five.txt
refuses "a comma in a number" 1 "line 1: expected are x y X_mm Y_mm: .* commas, or semicolons between" floor --points five.txt --size 161x121
warns "a mark outside" "marks.txt: warning: line 2: 40 60 is outside of the picture of 161x60 pixels, and it is not the only one" floor --points marks.txt --size 161x60
printf '%s\n' '66 12 -50 371.42857 # beside' '94 12 50 371.42857' >> marks.txt
sed '$s/94 12/124 12/' marks.txt > odd.txt
warns "a mark read off wrongly" "odd.txt: warning: line 9 does not fit the others: 30.0 pixels" floor --points odd.txt --size 161x121
[ -s out ]; say $? "and the floor is there"
head -7 marks.txt | sed '$s/80 60/80 85/' > bad5.txt
warns "five marks that do not fit" "warning: the points do not fit each other: off by [0-9.]* pixels .*, line [0-9]+ the most" floor --points bad5.txt --size 161x121
works "good marks" floor --points marks.txt --size 161x121

# --- places in millimeters: a level camera whose horizon is row 20: x = 80 + 100 X / (Y + 100), y = 20 + 16000 / (Y + 100) ---
printf '%s\n' '30 100 -100 100' '130 100 100 100' '55 60 -100 300' '105 60 100 300' > level.txt
works "a level camera" floor --points level.txt --size 161x121 -o level.floor
picture() { # picture CONDITION : 161x121, black where it holds of x and y, white elsewhere
    awk "BEGIN { printf \"P5 161 121 255\\n\"
        for (y = 0; y < 121; y++) for (x = 0; x < 161; x++) printf \"%s\", ($1) ? \" \" : \"~\" }" |
        tr '~' '\377'
}
# places : for each object of out with x0..true_deg: is it what double precision makes of its ends? null above the horizon
places() {
    tr '{' '\n' < out | sed -n 's/.*"x0":\([^,]*\),"y0":\([^,]*\),"x1":\([^,]*\),"y1":\([^,}]*\).*"x0_mm":\([^,]*\),"y0_mm":\([^,]*\),"x1_mm":\([^,]*\),"y1_mm":\([^,]*\),"length_mm":\([^,]*\),"true_deg":\([^,}]*\)}.*/\1 \2 \3 \4 \5 \6 \7 \8 \9/p' > ends
    tr '{' '\n' < out | sed -n 's/.*"true_deg":\([^,}]*\)}.*/\1/p' | paste -d ' ' ends - | awk '
        function off(a, b) { return a - b > 0.06 || b - a > 0.06 }
        function place(x, y) { depth = 16000 / (y - 20); X = (x - 80) * depth / 100; Y = depth - 100 }
        function end(x, y, a, b) {
            if (y <= 20) { bad += a != "null" || b != "null"; none = 1; return }
            place(x, y); bad += off(X, a) || off(Y, b) }
        { none = 0; end($1, $2, $5, $6); X0 = X; Y0 = Y; end($3, $4, $7, $8); dX = X - X0; dY = Y - Y0
          if (none) bad += $9 != "null" || $10 != "null"
          else bad += off(sqrt(dX * dX + dY * dY), $9) || off(atan2(dX, dY) * 57.29577951, $10) }
        END { exit bad || NR != '"$1"' }'
    say $? "$1 places in millimeters, angles and lengths as double precision has them"
}
picture '!(x - 80 + 5 * (y - 20) / 8 < 0.5 && x - 80 + 5 * (y - 20) / 8 >= -0.5 && y >= 50 && y < 111)' > white.pgm
works "lines --floor" lines --mask --floor level.floor --json white.pgm
places 1; near true_deg 0 1.5; near x0_mm -100 2; near length_mm 355.5 8
works "lines --floor --roi" lines --mask --floor level.floor --json --roi 10,40,100,70 white.pgm
places 1; near true_deg 0 1.5
works "lines --floor in words" lines --mask --floor level.floor white.pgm
grep -Eq ', on the floor -(99|10[01]),[0-9]+ to -(99|10[01]),[0-9]+ mm, length 3[0-9]+ mm, angle [-+][01]\.[0-9]$' out; say $? "millimeters in words"
picture '!(x >= 40 && x < 43 && y >= 5 && y < 60)' > up.pgm
works "lines through the horizon" lines --mask --floor level.floor --json up.pgm
places 1; grep -q '"x1_mm":null,"y1_mm":null,"length_mm":null,"true_deg":null}' out; say $? "null beyond"
works "in words" lines --mask --floor level.floor up.pgm
grep -q ', on the floor not wholly in sight$' out; say $? "not wholly in sight"
picture 'x - 80 + 5 * (y - 20) / 8 < 4 && x - 80 + 5 * (y - 20) / 8 >= -4 && y >= 50' > tape.pgm
works "paths --floor" paths --floor level.floor --json tape.pgm
places 1; near true_deg 0 4
works "paths --floor in words" paths --floor level.floor tape.pgm
grep -q ', on the floor -[0-9]*,[0-9]* to ' out; say $? "millimeters in words"
picture '!(x >= 60 && x < 70 && ((y >= 90 && y < 100) || (y >= 5 && y < 11)))' > parts.pgm
works "blobs --floor" blobs --floor level.floor --json parts.pgm
grep -q '"id":1,.*"x_mm":-31.2,"y_mm":101.3},{"id":2,.*"x_mm":null,"y_mm":null}' out; say $? "where it stands, and null"
works "blobs --floor --roi" blobs --floor level.floor --json --roi 50,80,60,40 parts.pgm
grep -q '"count":1,.*"x_mm":-31.2,"y_mm":101.3}' out; say $? "the same in a part"
works "blobs --floor in words" blobs --floor level.floor parts.pgm
[ "$(grep -c ', stands at -31,101 mm$' out)" = 1 ]; say $? "where it stands in words"
works "blobs without" blobs --json parts.pgm
! grep -q _mm out; say $? "has no millimeters"
for command in "blobs" "lines" "paths" "blobs --roi 0,0,100,60"; do
    refuses "$command of another size" 1 "small.pgm: 160x120 pixels, but the floor file was made for pictures of 161x121" $command --floor level.floor --json small.pgm
    refuses "$command with a damaged floor" 1 "line 1: not a floor file" $command --floor level.txt --json parts.pgm
done
# A T at 120,60: straight down in the picture is 0.4 to the left for each 1 back.
picture '(y >= 56 && y < 65) || (x >= 116 && x < 125 && y >= 56)' > t.pgm
works "follow --junctions --floor" follow --junctions --floor level.floor --json t.pgm
grep -q '"junctions":\[{"type":"T",[^]]*\],"distance_rows":[^}]*,"branches_true_deg":\[-158[.0-9]*,-90[.0-9]*,\(90\|89\)[.0-9]*\]}\]' out; say $? "a T with true angles"
near x_mm 160 1.5; near y_mm 300 3
works "in words" follow --junctions --floor level.floor t.pgm
grep -Eq '  T 120,60 -180/-90/\+90 \((159|160|161),(299|300|301) mm -158/-90/\+(89|90)\)' out; say $? "millimeters and true angles in words"
picture '(y >= 8 && y < 17) || (x >= 76 && x < 85 && y >= 8)' > high.pgm
works "a T beyond the horizon" follow --junctions --floor level.floor --json high.pgm
grep -q '"type":"T",[^}]*"x_mm":null,"y_mm":null,"branches_true_deg":null}' out; say $? "null"

refuses "no points" 2 "points FILE is needed" floor --size 161x121
refuses "no size" 2 "size WxH or --image IN" floor --points marks.txt
refuses "two sizes" 2 "size WxH or --image IN" floor --points marks.txt --size 9x9 --image ramp.pgm
refuses "--size" 2 "WxH in pixels, not '9'" floor --points marks.txt --size 9
refuses "an operand" 2 "no operand is expected" floor --points marks.txt --size 9x9 marks.txt
refuses "points that are not there" 1 "none.txt: No such file" floor --points none.txt --size 9x9
refuses "a picture as points" 1 "line 1: expected are x y X_mm Y_mm: four numbers within 32767 with blanks, commas, or semicolons" floor --points ramp.pgm --size 9x9
printf '1 2 3 4\n1 2 3\n' > bad.txt
refuses "three numbers" 1 "bad.txt: line 2: expected are" floor --points bad.txt --size 9x9
head -4 marks.txt > few.txt
refuses "three marks" 1 "four different points are needed at least \(3 points\)" floor --points few.txt --size 161x121
printf '%s\n' '40 60 -100 200' '80 60 0 200' '120 60 100 200' '48 28 -100 300' > line.txt
refuses "three in a line" 1 "on one line" floor --points line.txt --size 161x121 -o no.floor
[ ! -e no.floor ]; say $? "and no file"
awk 'NF > 3 && $1 != "#" { $3 = -$3 } { print }' marks.txt > mirror.txt
refuses "a mirror" 1 "a mirror.s view" floor --points mirror.txt --size 161x121
printf '%s\n' '120 60 -100 200' '40 60 100 200' '48 28 -100 300' '112 28 100 300' > bow.txt
refuses "two interchanged" 1 "may be interchanged" floor --points bow.txt --size 161x121
{ printf 'P5\n160 120\n255\n'; tail -c 19200 ramp.pgm; } > small.pgm
refuses "another size" 1 "160x120 pixels, but the floor file was made for pictures of 161x121" birdseye --floor a.floor --window 0,1,2,3 small.pgm -o x.pgm
refuses "no floor" 2 "floor FLOOR, or --calib, --height, and --tilt, is needed" birdseye --window 0,1,2,3 ramp.pgm -o x.pgm
refuses "no window" 2 "window x0,y0,x1,y1 is needed" birdseye --floor a.floor ramp.pgm -o x.pgm
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
