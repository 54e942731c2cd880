#!/bin/sh
# iris undistort from outside.
first_argument=
. tests/outside

# 9 x 9, the middle white: at the principal point nothing moves.
{ printf 'P5\n9 9\n255\n'; head -c 40 /dev/zero; printf '\377'; head -c 40 /dev/zero; } > dot.pgm
works "undistort without a lens" undistort --camera 10,10,4,4 --lens 0 dot.pgm -o out.pgm
cmp -s dot.pgm out.pgm; say $? "without a lens nothing changes"
works "undistort" undistort --camera 10,10,4,4 --lens -0.3,0.1,0,0,0.01 dot.pgm -o out.pgm
[ "$(od -An -v -tu1 -j 51 -N 1 out.pgm | tr -d ' ')" = 255 ]; say $? "the principal point stays"
# A pixel 4 pixels from the axis, which is 0.4 focal lengths: k1 = 1 shows it at 0.4 (1 + 0.16), 4.64 pixels away. So what is seen at
# 4 pixels (column 8) lies between 3 and 4 in the new picture: column 7 takes it from 7 + 3 * 0.09 = 7.27: 0.27 of 255 is 69.
{ printf 'P5\n9 9\n255\n'; head -c 44 /dev/zero; printf '\377'; head -c 36 /dev/zero; } > edge.pgm
works "undistort a bent row" undistort --camera 10,10,4,4 --lens 1 edge.pgm -o out.pgm
seen=$(od -An -v -tu1 -j 54 -N 1 out.pgm | tr -d ' ')
[ "$seen" -ge 66 ] && [ "$seen" -le 72 ]; say $? "a bent row, column 7: $seen"
works "undistort in JSON" undistort --json --fill 9 --camera 10,10,4,4,0.5 --lens 1 dot.pgm -o out.bmp
grep -q '"width":9,"height":9' out; say $? "size in JSON"
works "undistort in a pipe" pipe "gray | undistort --camera 10,10,4,4 --lens 0 | negative" dot.pgm -o out.pgm
for wrong in "" "--camera 10,10,4,4" "--lens 0" "--camera 10,10,4 --lens 0" "--camera 0,10,4,4 --lens 0" "--camera 10,10,4,4 --lens 1,2,3" \
    "--camera 10,10,4,4 --lens x" "--camera 10,10,4,4 --lens nan" "--camera 10,10,4,4 --lens 1e300" \
    "--camera 10,10,4,4 --lens 1,2,3,4,5,6" "--camera 10,10,4,4 --lens 0 --fill 256" "--camera 10,10,4,4 --lens 0 --roi 0,0,1,1"; do
    # shellcheck disable=SC2086
    refuses "undistort $wrong" 2 '^iris undistort: ' undistort $wrong dot.pgm -o out.pgm
done
# --calib: a camera file instead, made from views of a board by a camera of focal length 600, principal point (320, 240), k1 = -0.2.
awk 'BEGIN { for (v = 0; v < 5; v++) { a = 1.2566 * v; t = 0.5; c = cos(t); s = sin(t); p = cos(a); q = sin(a)
    for (j = 0; j < 6; j++) for (i = 0; i < 8; i++) {
        x = 25 * i - 87.5; y = 25 * j - 62.5; along = p * x + q * y; across = q * x - p * y
        u = p * along + q * across * c; w = q * along - p * across * c; z = 300 + across * s
        u /= z; w /= z; d = 1 - 0.2 * (u * u + w * w)
        printf "%.9g %.9g\n", 320 + 600 * u * d, 240 + 600 * w * d > "view" v ".txt" } } }'
run calibrate board --board 8x6 --model none --image-size 640x480 --corners view?.txt -o a.camera
{ printf 'P5\n640 480\n255\n'; awk 'BEGIN { for (i = 0; i < 307200; i++) printf "%c", 33 + (int(i % 640 / 9) * 37 + int(i / 5760) * 11) % 90 }'; } > busy.pgm
works "undistort --calib" undistort --calib a.camera busy.pgm -o out.pgm
works "undistort by the same numbers" undistort --camera 600,600,320,240 --lens -0.2 busy.pgm -o same.pgm
[ "$(cmp -l out.pgm same.pgm | wc -l)" -lt 3000 ]; say $? "--calib is --camera and --lens"
refuses "undistort --calib, another size" 1 "dot.pgm: 9x9 pixels, but the camera was calibrated with pictures of 640x480" undistort --calib a.camera dot.pgm -o out.pgm
refuses "undistort --calib with --lens" 2 "calib: not together with" undistort --calib a.camera --lens 0 busy.pgm -o out.pgm
sed 's/^skew 0/skew 1/' a.camera > bad.camera
refuses "undistort with a damaged camera" 1 "bad.camera: line 10: not a camera file, or damaged" undistort --calib bad.camera busy.pgm -o out.pgm
head -4 a.camera > short.camera
refuses "undistort with half a camera" 1 "short.camera: line 5: ends early" undistort --calib short.camera busy.pgm -o out.pgm
sed 's/^iris camera 1/iris camera 2/' a.camera > later.camera
refuses "undistort with a later camera" 1 "later.camera: line 1: a later version" undistort --calib later.camera busy.pgm -o out.pgm
refuses "undistort without a camera file" 1 "nowhere.camera: " undistort --calib nowhere.camera busy.pgm -o out.pgm
