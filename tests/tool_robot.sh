#!/bin/sh
# iris robot from outside.
first_argument=robot
here=$PWD
. tests/outside

robots=$here/examples/robots
worlds=$here/examples/worlds
for robot in rover car omni; do
    works "--check $robot" --check "$robots/$robot.robot"
    grep -Eq "$robot.robot: [0-9]+ devices, nothing wrong" out; say $? "$robot is good"
    works "$robot" "$robots/$robot.robot"
    for world in room course; do
        works "$robot in $world" "$robots/$robot.robot" --world "$worlds/$world.world"
        grep -q '^nothing ahead within\|^nearest obstacle ahead' out && grep -q '^line: [0-9]* mm' out; say $? "$robot answers in $world"
    done
done
works "in words" "$robots/car.robot"
grep -q 'car, 400x190 mm, ackermann, 800 mm/s, curves from 489 mm$' out && grep -q '^ranges that look ahead within 30 degrees: front left right$' out
say $? "the drive, and what looks ahead, the straightest first"
{ cat "$robots/omni.robot"; echo 'camera two facing 180'; } > two.robot
cat > near.world <<'END'
wall 400 -500 400 500
object -300 0 radius 20 color blue
line -100 30 300 30
END
works "in a world of its own" two.robot --world near.world --json
sed 's/.*"answers"://' out | grep -Eq '^\{"obstacle":2[678][0-9],"object":\[-(29|30)[0-9],-?[0-9]+\],"line":-(2|3)[0-9],"battery":(1|0.9[0-9]+)\}\}$'
say $? "what is 280 mm ahead of its edge, behind it, and under it"
grep -q '^{"name":"omni","drive":"omni","length":240,"width":240,"radius":0,"devices":\[{"name":"drive","kind":"drive"' out; say $? "the robot in JSON"
works "a picture" "$robots/rover.robot" -o rover.ppm
[ "$(head -c 15 rover.ppm | tr '\n' ' ')" = "P6 720 720 255 " ]; say $? "its picture"
sed 's/^range front .*/range front cone 400/' "$robots/omni.robot" > bad.robot
sed -i 's/^bump .*/bump ring cone 400/' bad.robot
refuses "a cone of 400 degrees" 1 '^iris robot: bad.robot:[0-9]*: expected cone in degrees' --check bad.robot
echo 'floor 1 2' > bad.world
refuses "a bad world" 1 '^iris robot: bad.world:1: expected wall, line, object, or start' "$robots/omni.robot" --world bad.world
refuses "no such file" 1 'nowhere.robot' nowhere.robot
refuses "nothing" 2 'one robot file'
refuses "two files" 2 'one robot file' a b
refuses "--check and a picture" 2 'check: not with' --check a -o b.bmp
works "help" --help
