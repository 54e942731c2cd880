#!/bin/sh
# The whole main job on real drivers: rendered frames of the course go into the virtual driver's output, come out of its camera,
# are followed, and what the robot reads at the far end of the serial port, and on the GPIO lines, is what it gets from files.
first_argument=follow
. tests/outside
if [ -z "$RIG_LOOP_IN" ]; then
    echo "ok - the main job # SKIP the rig has no loop"
    exit
fi
hold=700 # ms for each picture: every one is seen, on a slow machine too

# Seven frames from the course, in the order of their steering, the leftmost last.
cp "$OUT"/host/course/large/0*.pgm .
"$iris" follow --stills --json 0*.pgm > answers
[ "$(grep -c '"state":"found"' answers)" -ge 5 ]; say $? "rendered frames with a line"
leftmost_last=$(sed 's/.*"file":"\([^"]*\)".*"steer":\([^,]*\),.*/\2 \1/' answers | sort -rn | cut -d ' ' -f 2)
rightmost_last=$(sed 's/.*"file":"\([^"]*\)".*"steer":\([^,]*\),.*/\2 \1/' answers | sort -n | cut -d ' ' -f 2)

# What the robot read: each command once, without its number and check; the last one is the stop of the end.
commands() {
    tr -d '\r' < "$1" | sed 's/^\$PIRIS,[0-9]*,//; s/\*..$//' | uniq
}
line() { # line NUMBER : what the kernel says that it is
    cat "$RIG_GPIO_SYSFS/sim_gpio$1/value"
}
gpio=
[ -z "$RIG_GPIO" ] || gpio="--gpio $RIG_GPIO:left=4,right=5,stop=6,heartbeat=7"

said_once() { # that frames are lost, and then that they are there again: one after the other
    awk '/stands still until/ { bad = bad || lost; lost = 1; n++ } /: frames again$/ { bad = bad || !lost; lost = 0 } END { exit bad || !n }' err
}
await() { # await COMMAND... : until it is true, for 20 seconds at most
    turn=0
    until "$@" || [ $turn -eq 100 ]; do
        turn=$((turn + 1))
        sleep 0.2
    done
}
push() { # push FOURCC FILE... : into the loop; $pusher is who does it
    fourcc=$1
    shift
    "$OUT/tests/rig/push_frames" "$RIG_LOOP_OUT" "$RIG_LOOP_IN" "$fourcc" $hold "$@" > pushed &
    pusher=$!
    await grep -q ready pushed
}

job() { # job FOURCC FORMAT LEFT RIGHT FILE... : the lines that are on at the last picture
    four=$1 format=$2 left=$3 right=$4
    shift 4
    rig clear serial
    run --stills --rate 10 --serial "$RIG_SERIAL" "$@"
    rig received serial 0 1000 > far
    commands far > wanted
    [ "$(wc -l < wanted)" -ge 5 ]; say $? "$format: commands from files"
    rig clear serial
    push "$four" "$@"
    # shellcheck disable=SC2086
    "$iris" follow --stills --camera "$RIG_LOOP_IN" --size 640x480 --format "$format" --json --timing \
        --serial "$RIG_SERIAL" $gpio --watchdog 5s > out 2> err &
    follower=$!
    await grep -q found out # the first picture
    sleep 1
    kill -USR1 $pusher
    await grep -q last pushed
    sleep 2
    if [ -n "$gpio" ]; then
        [ "$(line 4) $(line 5) $(line 6)" = "$left $right 0" ]; say $? "$format: the lines of the last picture"
    else
        echo "ok - $format: the lines of the last picture # SKIP the rig has no GPIO"
    fi
    kill $follower
    wait $follower
    say $? "$format: ends when told to"
    kill $pusher
    wait $pusher
    rig received serial 0 1000 > far
    # before the first picture the camera may have shown something else
    commands far | awk -v first="$(head -1 wanted)" '$0 == first { begun = 1 } begun' > said
    cmp -s wanted said; say $? "$format: the same commands as from files"
    cmp -s wanted said || diff wanted said | sed 's/^/# /'
    [ "$(tail -1 said)" = L,0,0,0,0,0 ]; say $? "$format: the last one is to stop"
    grep -q '"frame":[0-9]*,"state":"found"' out; say $? "$format: answers"
    tail -1 out | sed -n 's/^{"frame_to_command":/#: the main job, frame to command: /p'
}
# shellcheck disable=SC2086
job GREY gray 1 0 $leftmost_last
# shellcheck disable=SC2086
job YUYV yuyv 0 1 $rightmost_last

# --- the camera goes away and comes back: the robot stands still meanwhile, which is said once ---
# shellcheck disable=SC2086
push GREY $leftmost_last
rig clear serial
# shellcheck disable=SC2086
"$iris" follow --camera "$RIG_LOOP_IN" --size 640x480 --format gray --serial "$RIG_SERIAL" $gpio --watchdog 5s > out 2> err &
follower=$!
await grep -q found out
"$iris" controls --device "$RIG_LOOP_IN" percentage-of-dropped-buffers=100 > /dev/null
sleep 2
[ -z "$gpio" ] || { [ "$(line 4) $(line 5) $(line 6)" = "0 0 1" ]; say $? "frames stay away: the lines say stop"; }
rig received serial 0 500 > far
[ "$(commands far | tail -1)" = L,0,0,0,0,0 ]; say $? "frames stay away: the robot is told to stop"
said_once; say $? "frames stay away: said once"
"$iris" controls --device "$RIG_LOOP_IN" percentage-of-dropped-buffers=0 > /dev/null
sleep 2
grep -q ': frames again$' err; say $? "frames come again"
rig received serial 0 500 > far
[ "$(commands far | tail -1)" != L,0,0,0,0,0 ]; say $? "frames come again: the robot goes on"
"$iris" controls --device "$RIG_LOOP_IN" disconnect=1 > /dev/null 2>&1
kill $pusher # the driver comes back when nobody has it open
wait $pusher
await grep -q 'frames again' err
sleep 3
grep -q 'is gone.*; the robot stands still' err && tail -1 err | grep -q ': frames again$' && said_once
say $? "unplugged and back: each said once"
kill $follower
wait $follower
say $? "unplugged and back: ends when told to"
