#!/bin/sh
# iris run from outside.
first_argument=run
here=$PWD
. tests/outside

robots=$here/examples/robots worlds=$here/examples/worlds
rover=$robots/rover.robot
field() { # field NAME : its number in the JSON of out
    sed -n "s/.*\"$1\":\(-\{0,1\}[0-9.]*\).*/\1/p" out
}
near() { # near A B MOST
    awk -v a="$1" -v b="$2" -v m="$3" 'BEGIN { exit !(a != "" && a - b <= m && b - a <= m) }'
}

# What is ordered is done, whatever drives.
printf '0 go 500\n0 turn 90 # to the right\n0 go 300\n' > square.script
for robot in rover car omni; do
    works "$robot: ahead, right, ahead" --robot "$robots/$robot.robot" --script square.script --json
    if [ $robot = car ]; then near "$(field heading)" -90 8; else
        near "$(field x_mm)" 505 25 && near "$(field y_mm)" -300 25 && near "$(field heading)" -90 6; fi
    say $? "$robot: it is where that leads"
    [ "$(grep -o '"event":"reached"' out | wc -l)" -eq 3 ]; say $? "$robot: each is told to be reached"
    printf '0 goto 5000 3400\n' > goto.script
    works "$robot: to a place around two walls" --robot "$robots/$robot.robot" --world "$worlds/room.world" --script goto.script \
        --time 100 --json
    near "$(field x_mm)" 5000 150 && near "$(field y_mm)" 3400 150; say $? "$robot: it comes there"
    printf '0 follow\n' > follow.script
    works "$robot: a course" --robot "$robots/$robot.robot" --world "$worlds/course.world" --script follow.script --time 45 --json
    ! grep -q 'line end' out; say $? "$robot: its line does not end"
done

# A journal replayed gives the same commands, bit for bit. What it holds is read here by other means.
printf '0 detect\n0 map\n0 follow\n4 drive 200 -20\n5.5 reset\n6 explore\n20 goto 2000 2500\n' > long.script
works "a session" --robot "$rover" --world "$worlds/room.world" --script long.script --time 40 --seed 7 --journal a.journal --json \
    -o live.ppm
cp out live.json
works "its replay" --robot "$rover" --replay a.journal
grep '^M' a.journal | sed 's/^M //; s/\*.*//' > recorded
sed '$d; s/^[0-9.]* //' out > replayed
[ "$(wc -l < recorded)" -gt 300 ] && cmp -s recorded replayed; say $? "the same commands, bit for bit"
tail -1 out | grep -q "^replayed: the same $(wc -l < recorded) commands, bit for bit\$"; say $? "and it says so"
works "its replay in JSON" --robot "$rover" --replay a.journal --json -o replay.ppm
grep -q '"same":1' out; say $? "the same in JSON"
[ "$(grep -o '"check":"[0-9A-F]*"' out)" = "$(grep -o '"check":"[0-9A-F]*"' live.json)" ]; say $? "the same check of all commands"
[ "$(grep -o '"events":.*' out)" = "$(grep -o '"events":.*' live.json)" ]; say $? "the same events"
works "the session again" --robot "$rover" --world "$worlds/room.world" --script long.script --time 40 --seed 7 --journal b.journal
cmp -s a.journal b.journal; say $? "a session with the same seed is the same"
works "with another seed" --robot "$rover" --world "$worlds/room.world" --script long.script --time 40 --seed 8 --journal b.journal
! cmp -s a.journal b.journal; say $? "with another seed it is not"
head -c 2 live.ppm | grep -q P6 && [ "$(wc -c < live.ppm)" -gt 100000 ]; say $? "a picture of the path"

# Damage is found, by its line.
lines=$(wc -l < a.journal)
sed '100s/[0-9]/x/' a.journal > damaged
run --robot "$rover" --replay damaged
[ $code -eq 1 ] && grep -q '^iris run: damaged: line 100: damaged' err; say $? "a line that is damaged"
sed '200d' a.journal > damaged
run --robot "$rover" --replay damaged
[ $code -eq 1 ] && grep -q 'line 200: damaged, or not the line' err; say $? "a line that is missing"
head -n 300 a.journal > damaged
run --robot "$rover" --replay damaged
[ $code -eq 1 ] && grep -q 'line 301: the journal ends early' err; say $? "a journal that ends early"
head -c 5000 a.journal > damaged
run --robot "$rover" --replay damaged
[ $code -eq 1 ] && grep -q "line $(($(head -c 5000 a.journal | wc -l) + 1)): the journal ends early" err; say $? "in the middle of a line"
echo "S 1*00000000" | cat a.journal - > damaged
run --robot "$rover" --replay damaged
[ $code -eq 1 ] && grep -q "line $lines: damaged" err; say $? "something behind the end"
run --robot "$robots/car.robot" --replay a.journal
[ $code -eq 1 ] && grep -q 'line 2: recorded with another robot file' err; say $? "another robot"

# Stop wins: over everything that waits, from the one that is obeyed last, too.
printf '0 go 400\n0 go 400\n0 turn 90\n1 stop\n' > stop.script
works "stop" --robot "$rover" --script stop.script --json
grep -q '"event":"stopped"' out && ! grep -q reached out && near "$(field x_mm)" 200 60; say $? "what waited is gone"
awk 'BEGIN { for (i = 0; i < 200; i++) print "drive 300 0"; print "stop" }' > orders
timeout 30 "$iris" run --robot "$rover" --console --speed 100 --json < orders > out 2> err
grep -q '"event":"stopped"' out && [ "$(field x_mm)" = 0 ]; say $? "a person's stop behind two hundred orders"

# Leases: whoever is gone does not drive on.
printf '0 drive 200 0\n' > drive.script
works "a lease that nobody renews" --robot "$rover" --script drive.script --lease 0.5 --json
grep -q '"at_s":0.5,"event":"expired"' out && near "$(field x_mm)" 90 30; say $? "all stops when it ends"
works "without a lease" --robot "$rover" --script drive.script --time 5 --json
near "$(field x_mm)" 990 60; say $? "it drives on"
timeout 30 "$iris" run --robot "$rover" --console --speed 100 --json > out 2> err << END
drive 200 0
END
[ "$(field x_mm)" -lt 100 ]; say $? "a console that ends stops what has no end"

# A person's orders, and what is wrong with them.
printf 'go 100\n\nfly\nturn 9999999\n' | timeout 30 "$iris" run --robot "$rover" --console --speed 100 > out 2> err
code=$?
[ $code -eq 0 ] && [ "$(grep -c 'column 1: expected an order' err)" -eq 1 ] && [ "$(grep -c 'column 6' err)" -eq 1 ] &&
    grep -q reached out; say $? "orders from standard input"
if [ -z "$NOT_HERE" ]; then
    printf '0 explore\n' > explore.script
    "$iris" run --robot "$rover" --world "$worlds/room.world" --script explore.script --speed 20 --journal c.journal > out 2> err &
    pid=$!
    tries=0
    while [ $tries -lt 100 ] && [ ! -s c.journal ]; do sleep 0.1; tries=$((tries + 1)); done
    kill -TERM $pid
    wait $pid
    code=$?
    [ $code -eq 0 ] && grep -q 'stopped by console' out && tail -1 c.journal | grep -q '^Z'; say $? "a signal stops the robot, then the program"
    works "what the signal did is replayed" --robot "$rover" --replay c.journal
fi

printf '0 go 100\nsoon stop\n' > wrong.script
refuses "a script without a time" 1 '^iris run: wrong.script:2:1: expected seconds' --robot "$rover" --script wrong.script
printf '3 go 100\n2 stop\n' > wrong.script
refuses "a script that goes back" 1 'wrong.script:2:1: expected a time that is not before' --robot "$rover" --script wrong.script
printf '\n 1.5 go 1 x\n' > wrong.script
refuses "a script with a wrong order" 1 'wrong.script:2:11: expected an order' --robot "$rover" --script wrong.script
printf 'robot\n' > wrong.robot
refuses "a wrong robot file" 1 'wrong.robot:1: ' --robot wrong.robot --script drive.script
refuses "a wrong world" 1 'wrong.robot:1: ' --robot "$rover" --world wrong.robot --script drive.script
refuses "no journal" 1 'nowhere: ' --robot "$rover" --replay nowhere
: > empty.journal
run --robot "$rover" --replay empty.journal
[ $code -eq 1 ] && grep -q 'line 1: the journal ends early' err; say $? "an empty journal"
refuses "a picture that is none" 2 'a picture.s name ends' --robot "$rover" --script drive.script -o path.txt
refuses "no robot" 2 '^iris run: --robot: ' --script drive.script
refuses "nobody who orders" 2 'nobody gives orders' --robot "$rover"
if [ -z "$NOT_HERE" ]; then
    sed 's|/dev/ttyUSB0|nowhere|' "$robots/car.robot" > away.robot
    refuses "hardware that is away" 1 '^iris run: nowhere: ' --robot away.robot --real --script drive.script
    refuses "hardware of a robot that has none" 1 '^iris run: here: a driver of the simulator' --robot "$robots/omni.robot" --real \
        --script drive.script
fi
refuses "hardware in a world" 2 '^iris run: --real: ' --robot "$rover" --real --world w --script drive.script
refuses "an operand" 2 'takes no operands' --robot "$rover" --console drive.script
refuses "a wrong lease" 2 '^iris run: --lease: ' --robot "$rover" --console --lease 0
refuses "a world for a replay" 2 '^iris run: --replay: ' --robot "$rover" --replay a.journal --world w
