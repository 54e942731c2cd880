#!/bin/sh
# Cameras from known points, from outside.
first_argument=calibrate
. tests/outside

near() { # near KEY VALUE TOLERANCE : the number behind the first "KEY": in out
    grep -Eo "\"$1\":\[*[-0-9.]*" out | sed -n '1s/.*[^-0-9.]//p' | awk -v want="$2" -v most="$3" '
        $1 ~ /^[-0-9.]+$/ { d = $1 - want; good = d <= most && -d <= most }
        END { exit !good }'
    say $? "$1 within $3 of $2"
}

# A camera at (0, 0, -10), focal length 100, principal point (50, 40).
awk 'BEGIN { for (i = 0; i < 14; i++) { x = (i * 7) % 5 - 2; y = (i * 3) % 7 - 3; z = (i * 11) % 6 - 2
    print x, y, z > "space.txt"; printf "%.12g, %.12e # point\n", 50 + 100 * x / (z + 10), 40 + 100 * y / (z + 10) > "image.txt" } }'
works "scene" scene space.txt image.txt
grep -q '^space.txt: 14 points$' out && grep -q '^refined: residual ' out && grep -q 'focal length 100 100' out; say $? "in words"
works "scene --json" scene space.txt image.txt --json
grep -q '^{"M":\[\[.*"K":\[\[.*"R":\[\[.*"t":\[.*"center":\[.*"residual":.*"refined":{"M":.*"points":14,"left_out":\[\]}$' out
say $? "--json: its keys"
near M 100 0.0001; near K 100 0.0001; near R 1 0.00001; near t 0 0.00001; near center 0 0.00001; near residual 0 0.00001
sed '5s/^[^,]*/400/; 9s/^[^,]*/-77/' image.txt > wrong.txt
works "scene with wrong points" scene space.txt wrong.txt
grep -q 'far off and left out: line 5, 9$' out; say $? "names them"
run scene - image.txt < space.txt
printf '1 2 3\n4 5\n' > short.txt
refuses "two numbers" 1 "short.txt: line 2: expected are 3 numbers" scene short.txt image.txt
for word in nan inf 0x10 1e 1.2.3 1e99 --1; do
    printf '1 %s 3\n' "$word" > odd.txt
    refuses "$word is no number" 1 "odd.txt: line 1: expected are 3 numbers" scene odd.txt image.txt
done
head -9 image.txt > nine.txt
refuses "unequal counts" 1 "nine.txt: 9 points, but there are 14 in space.txt" scene space.txt nine.txt
head -5 image.txt > i5.txt; head -5 space.txt > s5.txt
refuses "five points" 1 "s5.txt: six different points are needed" scene s5.txt i5.txt
: > empty.txt
refuses "no points" 1 "empty.txt: six different points are needed" scene empty.txt empty.txt
awk '{ print $1, $2, $1 + $2 }' space.txt > flat.txt
refuses "a plane" 1 "flat.txt: all points but one are on one plane" scene flat.txt image.txt
sort image.txt | head -11 > sorted.txt; head -11 space.txt > s11.txt
refuses "lines in another order" 1 "s11.txt: " scene s11.txt sorted.txt
awk '{ print -$1, $2, $3 }' s11.txt > mirror.txt; head -11 image.txt > i11.txt
refuses "a mirror" 1 "mirror.txt: only a mirror" scene mirror.txt i11.txt
refuses "one file" 2 "scene takes two files" scene space.txt
refuses "no such file" 1 "nowhere.txt: " scene nowhere.txt image.txt
refuses "no kind" 2 "circus: scene or board is to stand behind calibrate" circus

if [ -d "$data/calib/scene3d" ]; then
    works "20 points of a course" scene "$data/calib/scene3d/pts3d-norm.txt" "$data/calib/scene3d/pts2d-norm-pic_a.txt" --json
    near residual 0.04455 0.00005; near center -1.51267725 0.001
else
    echo "ok - 20 points of a course # SKIP no data (IRIS_DATA)"
fi

# --- board: views of it by a camera of focal length 600, principal point (320, 240), k1 = -0.2 ---
awk 'BEGIN { for (v = 0; v < 5; v++) { a = 1.2566 * v; t = 0.5; c = cos(t); s = sin(t); p = cos(a); q = sin(a)
    for (j = 0; j < 6; j++) for (i = 0; i < 8; i++) {
        x = 25 * i - 87.5; y = 25 * j - 62.5; along = p * x + q * y; across = q * x - p * y
        u = p * along + q * across * c; w = q * along - p * across * c; z = 300 + across * s
        u /= z; w /= z; d = 1 - 0.2 * (u * u + w * w)
        printf "%.9g %.9g\n", 320 + 600 * u * d, 240 + 600 * w * d > "view" v ".txt" } } }'
works "board" board --board 8x6 --square 25mm --image-size 640x480 --corners view?.txt
grep -q '^5 views, off by 0.0000 pixels' out && grep -q '^fx  *600  ' out && grep -q '^view4.txt: .* mm away$' out; say $? "in words"
grep -q '^good: ' out; say $? "its verdict"
works "board -o" board --board 8x6 --square 25mm --image-size 640x480 --corners view?.txt -o a.camera
[ "$(head -2 a.camera | tr '\n' ' ')" = "iris camera 1 size 640 480 " ] && grep -Eq '^focal (600.000|599.999)' a.camera && grep -q '^# 5 views, off by 0.0000' a.camera
say $? "the camera file"
works "board -o -" board --board 8x6 --square 25mm --image-size 640x480 --corners view?.txt -o -
cmp -s out a.camera; say $? "the camera on standard output alone"
refuses "-o without a size" 2 "o: the size of the pictures is needed" board --board 8x6 --corners view0.txt -o b.camera
refuses "-o - with --json" 2 "o: not to standard output" board --board 8x6 --image-size 640x480 --json --corners view0.txt -o -
works "board --json" board --board 8x6 --square 2.5cm --corners --json view?.txt
near fx 600 0.001; near fy 600 0.001; near skew 0 0; near u0 320 0.001; near v0 240 0.001; near k1 -0.2 0.0001; near rms_px 0 0.00001
grep -q '^{"fx":.*"rms_px":.*"deviations":{"fx":.*"skew":null,.*"verdict":\[\],"views":\[{"file":"view0.txt","rms_px":[^,]*,"turn":\[.*"shift":\[.*,"corners":\[\[[0-9.]*,[0-9.]*\],' out
say $? "--json: its keys"
works "board --model" board --board 8x6 --model skew,tangential --corners --json view?.txt
grep -q '"k3":0,.*"deviations":{.*"skew":[0-9].*"k3":null,"p1":[0-9]' out; say $? "looks for what it names"
awk 'BEGIN { for (j = 0; j < 6; j++) for (i = 0; i < 8; i++) print 25 * i "," 25 * j }' > board.csv
works "board --points" board --points board.csv --corners --json view?.txt
near fx 600 0.001
awk '{ print $1 + 3 * (NR % 2), $2 }' view3.txt > rough.txt
works "a view that does not fit" board --board 8x6 --corners view0.txt view1.txt view2.txt view4.txt rough.txt view0.txt view1.txt view2.txt view4.txt view0.txt view1.txt view2.txt view4.txt
grep -q '^rough.txt does not fit the other views: ' out && ! grep -q '^good' out; say $? "is told"
works "a large picture" board --board 8x6 --image-size 1600x1200 --corners view?.txt
grep -q 'cover little of the picture' out; say $? "is covered little"
awk 'BEGIN { for (j = 0; j < 6; j++) for (i = 0; i < 8; i++) print 100 + 40 * i, 100 + 40 * j }' > facing.txt
refuses "a board that faces the camera" 1 "calibrate: the board faces the camera in all views" board --board 8x6 --corners facing.txt facing.txt
head -47 view0.txt > few.txt
refuses "a corner too few" 1 "few.txt: 47 corners, but the board has 48" board --board 8x6 --corners view1.txt few.txt
sort -n view0.txt > sorted.txt
refuses "corners in another order" 1 "few views|sorted.txt: |faces" board --board 8x6 --corners sorted.txt
awk '{ print $1, $1 }' view0.txt > line.txt
refuses "corners on a line" 1 "line.txt: the corners are on one line" board --board 8x6 --corners view0.txt line.txt
refuses "no board" 2 "the board is needed once" board --corners view0.txt
refuses "--board" 2 "board: CxR, .*, not '9'" board --board 9 --corners view0.txt
refuses "--square" 2 "square: a length .*, not '25ft'" board --board 8x6 --square 25ft --corners view0.txt
refuses "--model" 2 "model: any of .*, not 'k4'" board --board 8x6 --model k4 --corners view0.txt
refuses "--image-size" 2 "image-size: WxH" board --board 8x6 --image-size 640 --corners view0.txt
refuses "no lists" 2 "board takes pictures, or lists of corners behind --corners" board --board 8x6 --corners
refuses "no pictures" 2 "board takes pictures, or lists of corners behind --corners" board --board 8x6
refuses "a list without --corners" 1 "view0.txt: neither BMP nor PGM/PPM" board --board 8x6 view0.txt
refuses "--points with pictures" 2 "points: only with lists of corners" board --points board.csv view0.txt
refuses "a board too small for pictures" 2 "board: CxR, .*, not '2x6'" board --board 2x6 view0.txt
{ printf 'P5 40 30 255\n'; yes 99 | head -c 1200; } > gray.pgm
refuses "a picture without a board" 1 "gray.pgm: no board is seen" board --board 8x6 gray.pgm

if [ -d "$data/calib/chessboard" ]; then
    works "13 corner lists" board --board 9x6 --square 25mm --image-size 640x480 --json --corners "$data"/calib/chessboard/*_corners.txt
    near rms_px 0.195419 0.00002; near fx 532.8272 0.05; near v0 233.85575 0.05
    near 'deviations":."fx' 0.437896 0.0005; grep -q '"k1":0.00542[0-9]*,"k2":0.0415[0-9]*,"k3":0.0887' out; say $? "deviations as OpenCV's"
    works "4 pictures" board --board 9x6 --square 25mm --json "$data"/calib/chessboard/left*.pgm -o seen.camera
    near rms_px 0.2 0.02; near fx 534.7 2; near fy 535 2; near u0 345.5 3; near v0 234 3
    [ "$(grep -o '"file":' out | wc -l)" -eq 4 ] && grep -q '^size 640 480' seen.camera; say $? "and their size, found"
    run board --board 9x6 --square 25mm "$data/calib/chessboard/left01.pgm" gray.pgm "$data/calib/chessboard/left05.pgm" nowhere.pgm "$data/calib/chessboard/left08.pgm"
    [ $code -eq 1 ] && [ "$(wc -l < err)" -eq 2 ] && grep -q 'nowhere.pgm: ' err && grep -q 'gray.pgm: 40x30 pixels, but the first picture has 640x480' err && grep -q '^3 views, off by 0\.' out
    say $? "what cannot be used is told, the others calibrate"
    works "Zhang's five views" board --points "$data/calib/zhang/Model.txt" --model skew --json --corners "$data"/calib/zhang/data?.txt
    near fx 832.5 0.01; near skew 0.204494 0.001; near u0 303.959 0.001; near v0 206.585 0.001; near k1 -0.228601 0.00001; near k2 0.190353 0.0001
else
    echo "ok - chessboards, and Zhang's views # SKIP no data (IRIS_DATA)"
fi
