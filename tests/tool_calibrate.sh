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
awk 'BEGIN { for (i = 0; i < 20; i++) { x = (i * 7) % 5 - 2; y = (i * 3) % 7 - 3; z = (i * 11) % 6 - 2; bad = i % 5 == 1 || i % 5 == 3
    print x, y, z > "s20.txt"; print bad ? i * 37 % 100 : 50 + 100 * x / (z + 10), bad ? i * 53 % 90 : 40 + 100 * y / (z + 10) > "i20.txt" } }'
refuses "eight wrong points of twenty" 1 "s20.txt: .*; or too many points disagree: at most three of ten" scene s20.txt i20.txt
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
refuses "no kind" 2 "circus: scene, board, pair, rotation, translation, or motion is to stand behind calibrate" circus

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
for v in 0 1 2 3 4; do echo "# view$v.pgm"; cat view$v.txt; done > all.txt
works "several lists in a file" board --board 8x6 --square 25mm --corners --json all.txt
near fx 600 0.001; grep -q '"file":"all.txt, list 5"' out; say $? "views of it are named"
sed 30d all.txt > odd.txt
refuses "a list too short among them" 1 "odd.txt: 239 corners, but the board has 48" board --board 8x6 --corners odd.txt
sed '7s/.*/1e8 20/' view2.txt > huge.txt
refuses "absurd numbers" 1 "huge.txt: line 7: no corner of a picture is at 1e.08 20" board --board 8x6 --corners view0.txt view1.txt huge.txt
sed '7s/.*/700 20/' view2.txt > wide.txt
refuses "a corner outside of the picture" 1 "wide.txt: line 7: no corner of a picture of --image-size is at 700 20" board --board 8x6 --image-size 640x480 --corners view0.txt view1.txt wide.txt
works "a large picture" board --board 8x6 --image-size 1600x1200 --corners view?.txt
grep -q 'cover little of the picture' out; say $? "is covered little"
awk 'BEGIN { for (j = 0; j < 6; j++) for (i = 0; i < 8; i++) print 100 + 40 * i, 100 + 40 * j }' > facing.txt
refuses "a board that faces the camera" 1 "calibrate: the board faces the camera in all views" board --board 8x6 --corners facing.txt facing.txt
refuses "one view that does" 1 "facing.txt: one view, .* is too few: add views" board --board 8x6 --corners facing.txt
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

# --- a scene that nobody has measured: focal length 600, principal point (319.5, 239.5) ---
matches() { # matches PAN TILT ROLL X Y Z : what a camera that turns so (degrees about y, x, z) and then has moved so shows of 60 points
    awk -v p="$1" -v t="$2" -v r="$3" -v x="$4" -v y="$5" -v z="$6" 'BEGIN { d = 3.14159265358979 / 180; p *= d; t *= d; r *= d
        for (i = 0; n < 60 && i < 5000; i++) {
            u = (i * 157) % 640; v = (i * 89 + int(i / 7) * 31) % 480; depth = 400 + (i * 211) % 1700
            a = (u - 319.5) / 600 * depth; b = (v - 239.5) / 600 * depth; c = depth
            h = a * cos(p) + c * sin(p); c = -a * sin(p) + c * cos(p); a = h
            h = b * cos(t) - c * sin(t); c = b * sin(t) + c * cos(t); b = h
            h = a * cos(r) - b * sin(r); b = a * sin(r) + b * cos(r); a = h
            a += x; b += y; c += z
            if (c <= 0) continue
            a = 319.5 + 600 * a / c; b = 239.5 + 600 * b / c
            if (a < 0 || a > 639 || b < 0 || b > 479) continue
            printf "%.9g %.9g, %.9f %.9f\n", u, v, a, b; n++ } }'
}
matches 15 3 -2 0 0 0 > pan.txt; matches -4 12 5 0 0 0 > tilt.txt; matches 8 -10 15 0 0 0 > both.txt
works "rotation" rotation --image-size 640x480 pan.txt tilt.txt both.txt -o turned.camera
grep -q '^3 pairs, off by 0.0000 pixels' out && grep -Eq '^fx  *600  \+- ' out && grep -q '^skew .* not looked for$' out && grep -q '^pan.txt: turned by 15\.' out
say $? "in words"
grep -q '^size 640 480$' turned.camera && grep -Eq '^focal (600.000|599.999)' turned.camera; say $? "its camera file"
works "rotation --json" rotation --json --model center,aspect,skew pan.txt tilt.txt both.txt
near fx 600 0.001; near fy 600 0.001; near skew 0 0.001; near u0 319.5 0.001; near v0 239.5 0.001; near rms_px 0 0.0001
grep -q '"deviations":{"fx":.*},"pairs":\[{"file":"pan.txt","rms_px":[^,]*,"turn":\[' out; say $? "--json: its keys"
works "one pair" rotation --json --image-size 640x480 pan.txt
near fx 600 0.001; near u0 319.5 0
matches 0 0 20 0 0 0 > roll.txt
refuses "a roll" 1 "the camera turns about its optical axis alone" rotation --image-size 640x480 roll.txt
refuses "a pan, and its aspect" 1 "leave open what is looked for" rotation --image-size 640x480 --model aspect,center,skew pan.txt
awk '{ print $1, $2, $1, $2 }' pan.txt > still.txt
refuses "no turn" 1 "hardly moves" rotation --image-size 640x480 still.txt
head -3 pan.txt > three.txt
refuses "three matches" 1 "three.txt: too few matches" rotation pan.txt three.txt
awk '{ print $1, $1, $3, $3 }' pan.txt > row.txt
refuses "matches on a line" 1 "row.txt: the matches are on one line" rotation pan.txt row.txt
refuses "three numbers" 1 "line 1: expected are 4 numbers" rotation space.txt
refuses "no matches" 2 "1 to 64 texts of matches are needed" rotation
refuses "rotation --model" 2 "model: any of center, aspect, skew with" rotation --model lever pan.txt
refuses "rotation -o without a size" 2 "image-size WxH" rotation pan.txt -o x.camera
matches 0 0 0 -20 10 -150 > ahead.txt; matches 0 0 0 20 -10 150 > back.txt
works "translation" translation --image-size 640x480 ahead.txt back.txt
grep -q '^ahead.txt: the camera moves to what is at 399.50 199.50 ' out && grep -q '^back.txt: the camera moves away from what is at 399.50 199.50 ' out
say $? "in words"
works "translation --json" translation --json ahead.txt
near x 399.5 0.001; near y 199.5 0.001; grep -q '"moves":"to","deviation_x":' out; say $? "--json: its keys"
matches 0 0 0 30 -40 0 > side.txt; matches 0 0 0 -50 0 0 > left.txt
works "sideways" translation --image-size 640x480 side.txt left.txt
grep -Eq '^side.txt: the camera moves sideways, .*: -0.(600|599)[0-9]* to the right, 0.(800|799)[0-9]* down' out && grep -Eq '^left.txt: .*: (1.000|0.999)[0-9]* to the right, -?0.000' out && ! grep -q 214748 out
say $? "which way"
works "sideways --json" translation --json side.txt
grep -q '"x":null,"y":null,' out; say $? "has no place"
refuses "a turn is no translation" 1 "no such motion" translation roll.txt
refuses "no translation" 1 "hardly moves" translation still.txt
# A robot whose camera looks ahead, 30 degrees down, at its middle: it drives 150 mm, and turns by 15 degrees to the left.
matches 0 0 0 0 75 -129.9038106 > drive.txt
awk 'BEGIN { d = 3.14159265358979 / 180; t = 30 * d; w = 15 * d
    for (i = 0; n < 60 && i < 5000; i++) {
        u = (i * 157) % 640; v = (i * 89 + int(i / 7) * 31) % 480
        a = (u - 319.5) / 600; b = (v - 239.5) / 600
        h = b * cos(t) + sin(t); f = cos(t) - b * sin(t)      # down, and ahead
        x = a * cos(w) + f * sin(w); f = -a * sin(w) + f * cos(w)
        b = h * cos(t) - f * sin(t); c = h * sin(t) + f * cos(t)
        if (c <= 0) continue
        x = 319.5 + 600 * x / c; b = 239.5 + 600 * b / c
        if (x < 0 || x > 639 || b < 0 || b > 479) continue
        printf "%.9g %.9g %.9f %.9f\n", u, v, x, b; n++ } }' > turn.txt
printf '%s\n' '# RX RY RZ X Y Z' '0 0 0  0 150 0' '0 0 15  0 0 0' > moves.txt
works "motion" motion --height 1 --tilt 20 --image-size 640x480 moves.txt drive.txt turn.txt
grep -q '^2 pairs, off by 0.0000' out && grep -q '^mounted with tilt 30.000, pan -*0.000, roll -*0.000 degrees' out; say $? "in words"
works "motion --json" motion --height 1 --tilt 20 --image-size 640x480 --model none --json moves.txt drive.txt turn.txt
near fx 600 0.01; near tilt 30 0.001; near pan 0 0.001; near roll 0 0.001
refuses "motions of one pair too few" 1 "moves.txt: 2 motions, but there are 1 texts" motion --height 1 --tilt 20 moves.txt drive.txt
refuses "motion without a mount" 2 "height MM is needed" motion moves.txt drive.txt turn.txt
head -2 moves.txt > straight.txt
refuses "straight ahead alone" 1 "leave open what is looked for" motion --height 1 --tilt 20 straight.txt drive.txt

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
