#!/bin/sh
# demo.sh : the closed loop. The robot gets around by its camera, on other floors too, and does not without it.
demo=${OUT:?set by make}/iris-demo
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
say() { # say CODE NAME; a failure shows what the demo said
    [ "$1" -eq 0 ] && echo "ok - $2" && return
    echo "not ok - $2"
    sed 's/^/# /' "$root/log"
}
"$demo" --out "$root/pictures/new" > "$root/log" 2>&1 && grep -q '^PASSED' "$root/log"
say $? "two laps within half the robot's width"
[ "$(ls "$root/pictures/new" | tr '\n' ' ')" = \
    "frame-1.bmp frame-2.bmp frame-3.bmp frame-4.bmp frame-5.bmp frame-6.bmp frames.bmp track.bmp " ]
say $? "the pictures are there"
for seed in 2 3 4; do
    "$demo" --quick --seed $seed > "$root/log" 2>&1
    say $? "one lap on floor $seed"
done
grep -v '^library' "$root/log" > "$root/first"
"$demo" --quick --floor > "$root/log" 2>&1 && grep -q '^steering  by millimeters' "$root/log"
say $? "one lap by millimeters"
"$demo" --quick --seed 4 2>&1 | grep -v '^library' > "$root/log"
cmp -s "$root/first" "$root/log"
say $? "the same drive again, to the last digit"
for turn in t:left t:right left:left left:straight right:right right:straight y:left y:right \
    crossing:left crossing:right crossing:straight; do
    for seed in 1 2; do
        "$demo" --junction ${turn%:*} --take ${turn#*:} --seed $seed > "$root/log" 2>&1
        say $? "over a junction ($turn, floor $seed)"
    done
done
for robot in over ahead slow; do
    for turn in left:left left:straight right:right right:straight crossing:left crossing:right t:left y:right; do
        for seed in 3 4; do
            "$demo" --junction ${turn%:*} --take ${turn#*:} --robot $robot --seed $seed > "$root/log" 2>&1
            say $? "over a junction ($turn, floor $seed, robot $robot)"
        done
    done
done
for seed in 1 2 3; do
    "$demo" --walls --quick --seed $seed > "$root/log" 2>&1 && grep -q '^PASSED' "$root/log"
    say $? "a walled course mapped, and the robot found in it (noise $seed)"
done
"$demo" --walls --out "$root/walls" > "$root/log" 2>&1 && [ "$(ls "$root/walls")" = map.bmp ]
say $? "the map is there"
"$demo" --junction t --take left --robot none > "$root/log" 2>&1
[ $? -eq 2 ]
say $? "a robot that does not exist"
"$demo" --junction t --take straight > "$root/log" 2>&1
[ $? -eq 2 ]
say $? "a turn that a junction does not have"
"$demo" --quick --blank > "$root/log" 2>&1
[ $? -eq 1 ] && grep -q '^laps      0.00' "$root/log" && grep -q '^FAILED' "$root/log"
say $? "with a covered lens it fails, and stays where it is"
"$demo" --quick --out "$root/first/x" > "$root/log" 2>&1
say $? "--quick writes no pictures"
"$demo" --out "$root/first/x" > "$root/log" 2>&1
[ $? -eq 1 ] && grep -q 'cannot make' "$root/log"
say $? "a folder that cannot be made is an error"
"$demo" --laps 0 > "$root/log" 2>&1
[ $? -eq 2 ]
say $? "a bad option is exit code 2"
