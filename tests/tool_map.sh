#!/bin/sh
# Maps from outside: the demo's disparities and poses in, a map and poses out.
demo=$(realpath "${OUT:?set by make}/iris-demo") || exit 1
first_argument=map
. tests/outside

"$demo" --walls --quick --frames frames > log 2>&1; say $? "two laps of a walled course"
camera="--camera frames/camera.txt --baseline 150 --height 300 --tilt 8 --ahead 120"

works "a map" frames/first $camera --poses frames/first/truth.txt -o floor.yaml --ply space.ply
grep -Eq '^floor.yaml: [0-9]+ pictures, [0-9]+x[0-9]+ cells of 50 mm, [0-9]+ occupied, [0-9]+ free$' out; say $? "what is told"
grep -q '^image: floor.pgm$' floor.yaml && grep -q '^resolution: 0.050$' floor.yaml && [ "$(head -c 2 floor.pgm)" = P5 ]; say $? "a map server's files"
count() { sed -n 's/^element vertex //p' space.ply; }
[ "$(count)" -gt 1000 ] && [ "$(wc -l < space.ply)" -eq $(($(count) + 7)) ]; say $? "a cloud of points"
works "the same in JSON" frames/first $camera --poses frames/first/truth.txt --json
grep -Eq '^\{"frames":[0-9]+,"left_out":0,"occupied":[0-9]{3,},"free":[0-9]{4,},"cells":\[[0-9]+,[0-9]+\],"origin":\[-[0-9]+,-[0-9]+\]\}$' out
say $? "its figures"
# A lap by odometry that is off by 80 cm at its end: each found pose beside the true one.
works "--localize" frames/second $camera --poses frames/second/odometry.txt --localize floor.yaml
paste -d ' ' out frames/second/truth.txt | awk '{ dx = $1 - $8; dy = $2 - $9; e = sqrt(dx * dx + dy * dy); if (e > most) most = e; n++ }
    END { print n, most; exit !(n > 100 && most < 50) }' > most; say $? "poses within a cell: $(cat most)"
works "--localize --json" frames/second $camera --poses frames/second/odometry.txt --localize floor.yaml --json
head -1 out | grep -Eq '^\{"frame":"frames/second/0000.pgm","x":-?[0-9]+,"y":-?[0-9]+,"heading":[-0-9.]+,"verdict":"found","score":0.[0-9]+,"spread":[0-9]+\}$'
say $? "a pose in JSON"
awk 'BEGIN { printf "P5\n160 120\n65535\n"; for (i = 0; i < 19200; i++) printf "%c%c", 7, 7 }' > wall.pgm # all at 1.8 m
echo 0 0 0 > one.txt
works "--depth" wall.pgm --camera frames/camera.txt --depth --poses one.txt --json
grep -q '"frames":1,"left_out":0,' out; say $? "one picture"
works "--help" --help
grep -q -- '--localize MAP.yaml' out; say $? "its options"

refuses "no pictures" 2 'expected are pictures' $camera --poses one.txt
refuses "no camera" 2 'camera CAMERA is needed' wall.pgm --baseline 150 --poses one.txt
refuses "no poses" 2 'poses POSES is needed' wall.pgm $camera
refuses "neither baseline nor depths" 2 'one of --baseline MM and --depth' wall.pgm --camera frames/camera.txt --poses one.txt
refuses "a map's name without .yaml" 2 'map.pgm: a map.s name ends with .yaml' wall.pgm $camera --poses one.txt -o map.pgm
refuses "a map while looking for poses" 2 'localize makes no map' wall.pgm $camera --poses one.txt --localize floor.yaml -o a.yaml
refuses "a band upside down" 2 'band: LOW,HIGH' wall.pgm $camera --poses one.txt --band 100,50
refuses "a tilt of 90 degrees" 2 'tilt: -80 to 80' wall.pgm --camera frames/camera.txt --baseline 150 --tilt 90 --poses one.txt
refuses "cells of nothing" 2 'cell' wall.pgm $camera --poses one.txt --cell 0
refuses "cells that are too small" 1 'cell: .* cells would be needed' wall.pgm $camera --poses one.txt --cell 2
refuses "poses for other pictures" 1 'truth.txt: [0-9]+ poses, but 1 pictures' wall.pgm $camera --poses frames/first/truth.txt
echo 0 0 > two.txt
refuses "a pose of two numbers" 1 'two.txt: line 1: expected are 3 numbers' wall.pgm $camera --poses two.txt
echo 0 1e8 0 > far.txt
works "a pose 100 km away" wall.pgm $camera --poses far.txt --json
echo 0 2e8 0 > far.txt
refuses "a pose farther away" 1 'far.txt: pose 1 is farther away' wall.pgm $camera --poses far.txt
head -c 1000 wall.pgm > short.pgm
{ head -3 wall.pgm; head -c $(($(wc -c < wall.pgm) - $(head -3 wall.pgm | wc -c))) /dev/zero; } > blank.pgm
refuses "a picture without a match" 1 'one.txt: no picture has a match' blank.pgm $camera --poses one.txt -o blank.yaml
[ ! -e blank.yaml ]; say $? "of which there is no map"
refuses "a picture that ends early" 1 'short.pgm: ends early, in row' short.pgm $camera --poses one.txt
printf 'P5\n160 120\n255\n' > eight.pgm
refuses "a picture of 8 bits" 1 'eight.pgm: expected is a PGM of 16 bits' eight.pgm $camera --poses one.txt
printf 'P5\n99999 1\n65535\n' > wide.pgm
refuses "a picture that is too wide" 1 'wide.pgm: expected is a PGM' wide.pgm $camera --poses one.txt
printf 'P5\n2 1\n65535\nabcd' > small.pgm
refuses "a picture of another size" 1 'small.pgm: 2x1 pixels, but the camera' small.pgm $camera --poses one.txt
refuses "no camera file" 1 'one.txt: line 1: not a camera file' wall.pgm --camera one.txt --baseline 150 --poses one.txt
refuses "no map" 1 'one.txt: line 1: image, resolution, or origin' wall.pgm $camera --poses one.txt --localize one.txt
sed 's/0.050/0.0125/' floor.yaml > odd.yaml
refuses "cells of 12.5 mm" 1 'odd.yaml: line 2: cells are to be whole millimeters' wall.pgm $camera --poses one.txt --localize odd.yaml
sed 's/floor.pgm/gone.pgm/' floor.yaml > gone.yaml
refuses "a map without its picture" 1 'gone.pgm' wall.pgm $camera --poses one.txt --localize gone.yaml
head -c 500 floor.pgm > half.pgm; sed 's/floor.pgm/half.pgm/' floor.yaml > half.yaml
refuses "a map with half a picture" 1 'half.pgm' wall.pgm $camera --poses one.txt --localize half.yaml
refuses "a folder that is not there" 1 'nowhere/m' wall.pgm $camera --poses one.txt -o nowhere/m.yaml
