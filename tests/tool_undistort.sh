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
