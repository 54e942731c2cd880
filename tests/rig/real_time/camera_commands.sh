#!/bin/sh
# The commands for cameras on the kernel's virtual webcam: what there is, what it lets be set, and its frames in files.
. tests/outside
if [ -z "$RIG_WEBCAM" ]; then
    echo "ok - commands on a camera # SKIP the rig has no webcam"
    exit
fi
camera=$RIG_WEBCAM

# --- iris cameras ---
first_argument=cameras
works "cameras"
grep -Eq "^$camera  vivid \(vivid, platform:vivid-000\)\$" out; say $? "cameras: the webcam by its name"
grep -Eq '^  YUYV +yuyv ' out && grep -Eq '^  NV12 +nv12 ' out && grep -Eq '^  GREY +gray ' out &&
    grep -Eq '^  YU12 +not read ' out
say $? "cameras: what is read and what is not"
grep -Eq '^      640x360  at [0-9., ]+$' out; say $? "cameras: sizes and rates"
works "cameras in JSON" --json
grep -q "^{\"device\":\"$camera\",\"name\":\"vivid\",\"driver\":\"vivid\",\"bus\":\"platform:vivid-000\",\"problem\":null,\"formats\":\[{\"fourcc\":" out &&
    grep -q '"fourcc":"YUYV","format":"yuyv",' out && grep -q '"sizes":\[{"w":[0-9]*,"h":[0-9]*,"rates":\[[0-9]' out
say $? "cameras in JSON: formats, sizes, and rates"
if [ -z "$RIG_MEDIA_CAMERA" ]; then
    echo "ok - cameras behind libcamera # SKIP the rig has no camera for libcamera"
else
    grep -Eq '^\{"device":"libcamera:[^"]*vimc[^"]*","name":"Sensor B","driver":"libcamera","bus":null,"problem":null,"formats":\[\{"fourcc":"[A-Z0-9]+","format":"[a-z0-9-]+","description":null,"sizes":\[\{"w":[0-9]+,"h":[0-9]+,.*"rates":\[\]\}' out
    say $? "cameras behind libcamera in JSON: formats and sizes"
    run
    sed -n '/^libcamera:/,$p' out > behind
    grep -Eq '^  [A-Z0-9]+ +(rgb|bgr|nv12)$' behind && grep -Eq '^      [0-9]+x[0-9]+' behind
    say $? "cameras behind libcamera: formats and sizes"
fi

# --- iris controls ---
first_argument=controls
works "controls" --device "$camera"
grep -Eq '^brightness +[0-9]+  \(default 128, 0 to 255\)$' out && grep -Eq '^gain-auto +(on|off)  ' out
say $? "controls: a number and a switch"
works "controls are set" --device "$camera" brightness=99 gain-auto=off gain=42
[ "$(cut -c 1-34 out | tr -s ' ' | cut -d ' ' -f 1,2 | tr '\n' ' ')" = "brightness 99 gain-auto off gain 42 " ]
say $? "controls: what the camera made of it, in order"
works "controls stay" --json --device "$camera"
grep -q '^{"name":"brightness","label":"Brightness","kind":"number","value":99,"minimum":0,"maximum":255,"step":1,"default":128,' out
say $? "controls in JSON"
refuses "a value outside its range" 2 '^iris controls: brightness: .*255' --device "$camera" brightness=256
refuses "a control that it has not" 1 '^iris controls: warp: ' --device "$camera" warp=1
refuses "a word for a number" 2 '^iris controls: brightness: a whole number, not ' --device "$camera" brightness=light
works "a menu by the name of a choice" --device "$camera" "test-pattern=$(
    "$iris" controls --json --device "$camera" | sed -n '/"name":"test-pattern"/s/.*"choices":\[{"value":0,"name":"\([^"]*\)".*/\1/p')"
works "a choice that is a number, and a decimal one" --device "$camera" integer-menu=8 brightness=010 brightness=0x10
[ "$(tr -s ' ' < out | cut -d ' ' -f 1,2 | tr '\n' ' ')" = "integer-menu 8 brightness 10 brightness 16 " ]
say $? "a choice that is a number, and a decimal one: as they were meant"
works "the last number of a menu" --device "$camera" integer-menu=42
refuses "a number that the menu has not" 2 '^iris controls: integer-menu: no single choice .* 42' --device "$camera" integer-menu=1
works "a choice by its first words" --device "$camera" test-pattern=75
grep -Eq '^test-pattern +75-colorbar ' out; say $? "a choice by its first words: that one"
refuses "words with which several begin" 2 '^iris controls: menu: no single choice ' --device "$camera" menu=menu-item
works "the former values" --device "$camera" brightness=128 gain-auto=on

# --- iris capture ---
first_argument=capture
works "ten frames" --device "$camera" --size 640x360 --format yuyv --rate 15 --frames 10 -o seen
[ "$(ls seen | wc -l)" -eq 10 ] && grep -Eq "^$camera  640x360 yuyv at 1[45][0-9.]*  10 frames, " out; say $? "ten frames in a folder"
"$iris" info "seen/$(ls seen | head -1)" | grep -q '640x360.*24'; say $? "frames in color"
works "frames in JSON" --json --device "$camera" --size 640x360 --format gray --frames 3 -o seen
[ "$(wc -l < out)" -eq 4 ] && tail -1 out |
    grep -q '^{"granted":{"w":640,"h":360,"format":"gray","stride":640,"rate":.*},"frames":3,"dropped":[0-9]*,"skipped":0,"damaged":0,"restarts":0,"returns":0}$'
say $? "frames in JSON: what was granted, and counters"
for format in bgr rgb565-be uyvy nv12 bayer-grbg; do
    works "bytes of $format" --raw --device "$camera" --size 640x360 --format $format --frames 1 -o "$format.raw"
    "$iris" convert --raw $format:640x360 "$format.raw"/*.raw -o raw.bmp 2> err &&
        "$iris" info raw.bmp | grep -q 640x360
    say $? "bytes of $format are read back"
done
works "frames of nv12 in color" --device "$camera" --size 640x360 --format nv12 --frames 1 -o seen
"$iris" capture --device "$camera" --size 640x360 --frames 5 -o - 2> err | "$iris" follow --json - > out
[ "$(wc -l < out)" -eq 5 ] && [ ! -s err ]; say $? "frames through a pipe into the follower"
"$iris" capture --device "$camera" --latest --json --size 320x180 --format gray --rate 5 -o endless > out 2> err &
sleep 2
kill $!
wait $!
[ $? -eq 0 ] && [ "$(ls endless | wc -l)" -gt 0 ] && tail -1 out | grep -q '^{"granted":'; say $? "until a signal"
first_argument=capture
refuses "a format that it has not" 1 "^iris capture: $camera: " --device "$camera" --format rgba --frames 1 -o seen
"$iris" controls --device "$camera" percentage-of-dropped-buffers=100 > out 2> err
refuses "a camera without frames" 1 "^iris capture: $camera: no frame for 1000 ms\$" --device "$camera" --timeout 1000 -o seen
"$iris" controls --device "$camera" percentage-of-dropped-buffers=0 > out 2> err
say $? "the camera as it was"
