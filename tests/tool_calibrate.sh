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
refuses "no kind" 2 "circus: scene .*is to stand behind calibrate" circus

if [ -d "$data/calib/scene3d" ]; then
    works "20 points of a course" scene "$data/calib/scene3d/pts3d-norm.txt" "$data/calib/scene3d/pts2d-norm-pic_a.txt" --json
    near residual 0.04455 0.00005; near center -1.51267725 0.001
else
    echo "ok - 20 points of a course # SKIP no data (IRIS_DATA)"
fi
