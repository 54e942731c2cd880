#!/bin/sh
# Two cameras from outside: calibrated as a pair, their pictures rectified, and depths from them.
first_argument=
. tests/outside

near() { # near KEY VALUE TOLERANCE : the number behind the first "KEY": in out
    grep -Eo "\"$1\":\[*[-0-9.]*" out | sed -n '1s/.*[^-0-9.]//p' | awk -v want="$2" -v most="$3" '
        $1 ~ /^[-0-9.]+$/ { d = $1 - want; good = d <= most && -d <= most }
        END { exit !good }'
    say $? "$1 within $3 of $2"
}

# Pictures of 160x120. Left: focal length 160, k1 = -0.1. Right: 150, turned to the left by 0.1, at (20, 1, -1).
cat > cameras.awk <<'END'
function left(x, y, z) { u = x / z; v = y / z; d = 1 - 0.1 * (u * u + v * v); u = 80 + 160 * u * d; v = 60 + 160 * v * d }
function right(x, y, z,  c, s, p, q) {
    x -= 20; y -= 1; z += 1; c = cos(0.1); s = sin(0.1); p = c * x + s * z; q = c * z - s * x
    u = 78 + 150 * p / q; v = 61 + 150 * y / q }
END
cat > lists.awk <<'END'
BEGIN { for (n = 0; n < 8; n++) { a = 0.8 * n; c = cos(0.5); s = sin(0.5); p = cos(a); q = sin(a)
    for (j = 0; j < 5; j++) for (i = 0; i < 7; i++) {
        x = 10 * i - 30; y = 10 * j - 20; along = p * x + q * y; across = q * x - p * y
        X = 10 + 12 * q + p * along + q * across * c; Y = 9 * p + q * along - p * across * c; Z = 110 + across * s
        left(X, Y, Z);  printf "%.9f %.9f\n", u, v > "left" n ".txt"
        right(X, Y, Z); printf "%.9f %.9f\n", u, v > "right" n ".txt" } } }
END
awk "$(cat cameras.awk lists.awk)"
board="--board 7x5 --square 10mm"

works "calibrate pair" calibrate pair $board --image-size 160x120 --corners-left left?.txt --corners-right right?.txt -o rig.pair
grep -q '^8 views, off by 0.0000 pixels' out && grep -q '^turn y .*5.729.*degrees$' out && grep -q '^place x  *20  +- .*mm$' out &&
    grep -q '^left7.txt, right7.txt: 0.0000 and 0.0000 pixels$' out; say $? "in words"
[ "$(head -3 rig.pair | tr '\n' ' ')" = "iris pair 1 left size 160 120 " ] && grep -q '^right$' rig.pair && grep -q '^check ' rig.pair
say $? "the pair file"
works "calibrate pair --json" calibrate pair $board --image-size 160x120 --json --corners-left left?.txt --corners-right right?.txt
near turn 0 0.00001; near place 20 0.0001; near baseline 20.04994 0.0001; near rms_px 0 0.00001; near R 0.995004 0.00001
grep -q '"deviations":{"turn":\[.*\],"place":\[.*"verdict":\[.*"views":\[{"left":"left0.txt","right":"right0.txt","left_px":' out
say $? "--json: its keys"
for side in left right; do
    "$iris" calibrate board $board --image-size 160x120 --corners $side?.txt -o $side.camera > /dev/null
done
works "calibrate pair --left --right" calibrate pair $board --left left.camera --right right.camera --corners-left left0.txt left1.txt --corners-right right0.txt right1.txt -o -
head -1 out | grep -q '^iris pair 1$'; say $? "the pair on standard output alone"
works "views that are interchanged" calibrate pair $board --left left.camera --right right.camera --corners-left left0.txt left1.txt --corners-right right1.txt right0.txt
grep -q '^corners are off by more than a pixel' out && ! grep -q '^good' out; say $? "are told"
refuses "one camera's lists" 2 'a list of corners is needed .*, not 8 and 0' calibrate pair $board --image-size 160x120 --corners-left left?.txt
refuses "a list too few" 2 'not 2 and 1' calibrate pair $board --image-size 160x120 --corners-left left0.txt left1.txt --corners-right right0.txt
refuses "no cameras" 2 'the cameras are needed once' calibrate pair $board --corners-left left0.txt --corners-right right0.txt
refuses "one camera file" 2 'the cameras are needed once' calibrate pair $board --left left.camera --corners-left left0.txt --corners-right right0.txt
refuses "no board" 2 'the board is needed once' calibrate pair --left left.camera --right right.camera --corners-left left0.txt --corners-right right0.txt
head -34 right0.txt > short.txt
refuses "a list that is short" 1 'short.txt: 34 corners, but the board has 35' calibrate pair $board --left left.camera --right right.camera --corners-left left0.txt --corners-right short.txt
awk '{ print $1, $1 }' right1.txt > line.txt
refuses "corners on a line" 1 'left0.txt: the corners are on one line' calibrate pair $board --left left.camera --right right.camera --corners-left left0.txt --corners-right line.txt
refuses "no camera file" 1 'left0.txt: line 1: not a camera file' calibrate pair $board --left left0.txt --right right.camera --corners-left left0.txt --corners-right right0.txt

# White squares at (x, y, z) = (0, 0, 90), (-20, 15, 150), (25, -12, 120).
cat > squares.awk <<'END'
function square(  i, j) { for (j = -1; j < 2; j++) for (i = -1; i < 2; i++) lit[int(v + 0.5) + j, int(u + 0.5) + i] = 1 }
function see(x, y, z) { if (side == "left") left(x, y, z); else right(x, y, z); square() }
BEGIN { see(0, 0, 90); see(-20, 15, 150); see(25, -12, 120); printf "P5 160 120 255\n"
    for (j = 0; j < 120; j++) { row = ""; for (i = 0; i < 160; i++) row = row ((j, i) in lit ? "w" : "!"); printf "%s", row } }
END
for side in left right; do awk -v side=$side "$(cat cameras.awk squares.awk)" > $side.pgm; done

works "rectify" rectify left.pgm right.pgm --calib rig.pair -o flat --lines seen.bmp
grep -q '^160x120 pixels, focal length .* baseline 20.0499: z = ' out; say $? "in words"
[ -s flat/left.pgm ] && [ -s flat/right.pgm ] && "$iris" info seen.bmp | grep -q 320x120; say $? "two pictures, and one with lines"
works "rectify --json" rectify left.pgm right.pgm --calib rig.pair --json
near baseline 20.04994 0.0001; near width 160 0; near height 120 0
focal=$(sed 's/.*"focal":\([0-9.]*\).*/\1/' out)
# marks FILE : the middles of its squares, x and y, from the left
marks() {
    tail -c 19200 "$1" | od -An -v -tu1 -w160 | awk '{ for (i = 1; i <= 160; i++) if ($i > 60) {
        for (k = 1; k <= n; k++) if ((x[k] / s[k] - i) ^ 2 + (y[k] / s[k] - NR) ^ 2 < 36) break
        if (k > n) n = k; w = $i - 33; x[k] += w * i; y[k] += w * NR; s[k] += w } }
        END { for (k = 1; k <= n; k++) print x[k] / s[k], y[k] / s[k] }' | sort -n
}
marks flat/left.pgm > l; marks flat/right.pgm > r
paste l r | awk -v bf="$(awk "BEGIN { print 20.04994 * $focal }")" '{ n++; d = $1 - $3; off = $2 - $4; z = bf / d
    print "square: rows", off, "apart, depth", z > "/dev/stderr"
    bad += off > 0.7 || off < -0.7 || d < 10 } END { exit bad || n != 3 }' 2> rows
code=$?; cat rows | sed 's/^/#: /'; say $code "what both see is in one row of both"
works "rectify --keep all" rectify left.pgm right.pgm --calib rig.pair --keep all --json
[ "$(sed 's/.*"focal":\([0-9]*\).*/\1/' out)" -lt "${focal%.*}" ]; say $? "shows more"
works "rectified again" rectify flat/left.pgm flat/right.pgm --calib flat/rectified.pair -o again
cmp -s flat/left.pgm again/left.pgm && cmp -s flat/right.pgm again/right.pgm; say $? "is the same"
# On to disparities and a map: the pair's own baseline is as good as the same one said.
echo 0 0 0 > one.txt
works "stereo of what is flat" stereo flat/left.pgm flat/right.pgm -o flat/d.pgm
works "a map by the rectified pair" map flat/d.pgm --camera flat/rectified.pair --poses one.txt --json
cp out by.pair
works "the same with its baseline" map flat/d.pgm --camera flat/rectified.pair --baseline 20.04994 --poses one.txt --json
cmp -s out by.pair; say $? "is the same"
works "another baseline" map flat/d.pgm --camera flat/rectified.pair --baseline 400 --poses one.txt --json
! cmp -s out by.pair; say $? "is another map"
refuses "a map by a pair that is not rectified" 1 'rig.pair: this pair is not rectified: take the rectified.pair' map flat/d.pgm --camera rig.pair --poses one.txt
refuses "a map by a camera with a lens" 1 'left.camera: this camera has a lens.*iris rectify' map flat/d.pgm --camera left.camera --baseline 20 --poses one.txt
refuses "no pair file" 2 'LEFT RIGHT --calib PAIR' rectify left.pgm right.pgm
refuses "one picture" 2 'LEFT RIGHT --calib PAIR' rectify left.pgm --calib rig.pair
refuses "a camera file" 1 'left.camera: line 1: not a pair file' rectify left.pgm right.pgm --calib left.camera
refuses "-o with a picture's name" 2 'out.pgm: .*folder' rectify left.pgm right.pgm --calib rig.pair -o out.pgm
refuses "--keep" 2 "keep: valid or all, not 'some'" rectify left.pgm right.pgm --calib rig.pair --keep some
refuses "two things on standard output" 2 'only' rectify left.pgm right.pgm --calib rig.pair --json --lines -
awk "$(sed 's/x -= 20; y -= 1; z += 1;//' cameras.awk; cat lists.awk)"
refuses "cameras at one place" 1 'the cameras are at one place' calibrate pair $board --left left.camera --right right.camera --corners-left left?.txt --corners-right right?.txt -o one.pair
[ ! -e one.pair ]; say $? "of which there is no file"
sed 's/^place.*/place 0.0000000000 0.0000000000 0.0000000000/' rig.pair > odd.pair
refuses "a file that was changed" 1 'odd.pair: line 22: not a pair file, or damaged' rectify left.pgm right.pgm --calib odd.pair
awk "$(cat cameras.awk lists.awk)"
"$iris" calibrate pair $board --left right.camera --right left.camera --corners-left right?.txt --corners-right left?.txt -o swapped.pair > told
grep -q '^the left camera is on the right' told; say $? "a left camera on the right is told"
refuses "left is right" 1 'the left camera is on the right' rectify right.pgm left.pgm --calib swapped.pair
head -c 3000 left.pgm > cut.pgm
refuses "a picture that is cut" 1 'cut.pgm: ' rectify cut.pgm right.pgm --calib rig.pair
printf 'P5 8 8 255\n%64s' '' > small.pgm
refuses "a picture of another size" 1 'small.pgm: 8x8 pixels, but the camera' rectify left.pgm small.pgm --calib rig.pair

# A wall of dots at z = 100, which the cameras of one focal length (60), 10 apart, see 6 pixels from each other.
cat > wall.awk <<'END'
BEGIN { for (n = 0; n < 5; n++) { a = 1.2566 * n; c = cos(0.5); s = sin(0.5); p = cos(a); q = sin(a)
    for (j = 0; j < 5; j++) for (i = 0; i < 7; i++) {
        x = 10 * i - 30; y = 10 * j - 20; along = p * x + q * y; across = q * x - p * y
        X = p * along + q * across * c; Y = q * along - p * across * c; Z = 110 + across * s
        printf "%.9f %.9f\n", 40 + 60 * X / Z, 20 + 60 * Y / Z > "a" n ".txt"
        printf "%.9f %.9f\n", 40 + 60 * (X - 10) / Z, 20 + 60 * Y / Z > "b" n ".txt" } }
    srand(7)
    for (j = 0; j < 40; j++) { row = ""; for (i = 0; i < 90; i++) row = row sprintf("%c", 33 + int(rand() * 90)); all[j] = row }
    printf "P5 80 40 255\n" > "a.pgm"; printf "P5 80 40 255\n" > "b.pgm"
    for (j = 0; j < 40; j++) { printf "%s", substr(all[j], 1, 80) > "a.pgm"; printf "%s", substr(all[j], 7, 80) > "b.pgm" } }
END
awk "$(cat wall.awk)"
"$iris" calibrate pair $board --image-size 80x40 --corners-left a?.txt --corners-right b?.txt -o wall.pair > told
works "stereo --calib" stereo a.pgm b.pgm --calib wall.pair --max-disparity 12 --depth depth.pgm --depth-scale 10 --points wall.ply
grep -q ' matched, disparities .*, depths ' out; say $? "depths in words"
tail -c 6400 depth.pgm | od -An -v -tu1 -w160 | awk '{ for (i = 41; i < 140; i += 2) { n++; d = $i * 256 + $(i + 1); good += d > 970 && d < 1030 } }
    END { exit good < 0.97 * n }'; say $? "the wall is 100 away, in tenths"
awk '/^end_header/ { on = 1; next } on { n++; good += $3 > 97 && $3 < 103 && NF == 6 } END { exit n < 2500 || good < 0.9 * n }' wall.ply
say $? "and so are its points"
works "filled disparities" stereo a.pgm b.pgm --calib wall.pair --max-disparity 12 -o filled.pgm --depth beside.pgm --depth-scale 10
zeros() { tail -c 6400 "$1" | od -An -v -tu2 -w2 | awk '$1 == 0 { n++ } END { print n + 0 }'; }
[ "$(zeros filled.pgm)" -eq 0 ] && [ "$(zeros beside.pgm)" -gt 0 ] && cmp -s beside.pgm depth.pgm; say $? "are not depths"
[ "$(sed -n 's/^element vertex //p' wall.ply)" -eq $((3200 - $(zeros depth.pgm))) ]; say $? "nor points"
works "depths beyond 16 bits" stereo a.pgm b.pgm --calib wall.pair --max-disparity 12 --depth far.pgm --depth-scale 60000
[ "$(zeros far.pgm)" -eq 3200 ] && grep -q ", $((3200 - $(zeros depth.pgm))) beyond 65535 left out" out; say $? "are not known, and told"
works "stereo --calib --json" stereo a.pgm b.pgm --calib wall.pair --max-disparity 12 --json
near baseline 10 0.0001; grep -q '"focal":.*"u0":.*"v0":.*"nearest":[0-9.]*,"farthest":[0-9.]*}$' out; say $? "its keys"
works "--points -" stereo a.pgm b.pgm --calib wall.pair --max-disparity 12 --points -
cmp -s out wall.ply; say $? "points on standard output alone"
refuses "--depth without cameras" 2 'depth: the cameras are needed' stereo a.pgm b.pgm --depth d.pgm
refuses "--points without cameras" 2 'points: the cameras are needed' stereo a.pgm b.pgm --points p.ply
refuses "--depth of 8 bits" 2 'd.bmp: .*pgm' stereo a.pgm b.pgm --calib wall.pair --depth d.bmp
refuses "--depth-scale" 2 'depth-scale' stereo a.pgm b.pgm --calib wall.pair --depth d.pgm --depth-scale 0
refuses "no such pair file" 1 'none.pair' stereo a.pgm b.pgm --calib none.pair
