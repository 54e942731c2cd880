#!/bin/sh
# Cameras from outside, with recordings as cameras: what needs a kernel's driver is in tests/rig/guest.
. tests/outside
LC_ALL=C
export LC_ALL

# picture COLUMN [W] : PGM of 64x48 (W) pixels with a dark line, 8 wide, from that column on
picture() {
    awk -v left="$1" -v w="${2:-64}" 'BEGIN {
        printf "P5 %d 48 255\n", w
        for (y = 0; y < 48; y++) for (x = 0; x < w; x++) printf "%s", (x >= left && x < left + 8) ? " " : "~" }'
}
mkdir frames empty
for k in 0 1 2 3 4 5 6 7 8 9; do
    picture $((20 + 2 * k)) > "frames/f$k.pgm"
done
cat frames/*.pgm > all.pgm
answers() { # the answers in a file, without the name of their source
    sed 's/"file":"[^"]*",//' "$1"
}
first_argument=follow

# --- the same answers as from files ---
run --json frames
cp out files
works "a folder as a camera" --json --camera frames
answers files > wanted
answers out | cmp -s - wanted; say $? "a folder as a camera: the same answers as from files"
works "a file as a camera" --json --camera all.pgm
answers out | cmp -s - wanted; say $? "a file of several pictures as a camera: the same answers"
"$iris" follow --json --camera - < all.pgm 2> err | sed 's/"file":"[^"]*",//' > out
cmp -s out wanted; say $? "standard input as a camera: the same answers"
works "in gray" --json --camera frames --format gray
answers out | cmp -s - wanted; say $? "in gray: the same answers"
works "in color" --json --camera frames --format rgb
answers out | cmp -s - wanted; say $? "in color: the same answers"
works "junctions" --json --junctions --camera frames
grep -q '"junctions":' out; say $? "junctions through a camera"
works "an overlay of each frame" --camera frames --overlay seen
[ "$(ls seen | tr '\n' ' ')" = "$(for k in 01 02 03 04 05 06 07 08 09 10; do printf 'frame_000%s.bmp ' $k; done)" ]
say $? "overlays are numbered"

# --- rate, frames, timing ---
works "three frames" --json --camera frames --frames 3
[ "$(wc -l < out)" -eq 3 ]; say $? "three frames: three answers"
start=$(date +%s%N)
works "at 20 a second" --json --camera frames --rate 20 --timing
[ $(($(date +%s%N) - start)) -ge 440000000 ]; say $? "at 20 a second: ten frames take 0.45 s"
[ "$(wc -l < out)" -eq 11 ] && tail -1 out |
    grep -Eq '^\{"frame_to_command":\{"frames":10,"p50_us":[0-9]+,"p90_us":[0-9]+,"p99_us":[0-9]+,"max_us":[0-9]+\}\}$'
say $? "timing in JSON"
tail -1 out | sed 's/p[0-9]*_us//g' | tr -dc '0-9,' | awk -F, '{ exit !($2 <= $3 && $3 <= $4 && $4 <= $5 && $5 < 1000000) }'
say $? "timing: percentiles in order"
run --camera frames --timing
[ $code -eq 0 ] && grep -Eq '^frame to command, us: p50 [0-9]+  p90 [0-9]+  p99 [0-9]+  max [0-9]+  \(10 frames\)$' err
say $? "timing in text"
(cat all.pgm; sleep 1.5; cat all.pgm) | timeout 10 "$iris" follow --camera - --rate 1000 > out 2> err
grep -q '^iris follow: -: no frame comes; the robot stands still until there are frames again$' err &&
    grep -q '^iris follow: -: frames again$' err
say $? "frames that stay away are said, and that they are back"

# --- what is wrong ---
refuses "a camera that is not there" 1 '^iris follow: /dev/video250: ' --camera /dev/video250
refuses "a recording that is not there" 1 '^iris follow: nothing: no such file or folder$' --camera nothing
refuses "a folder without pictures" 1 '^iris follow: empty: no .bmp, ' --camera empty
refuses "a device that is no camera" 1 '^iris follow: /dev/null: ' --camera /dev/null
refuses "a size that is none" 2 '^iris follow: --size: WxH' --camera frames --size 320
refuses "a format that is none" 2 '^iris follow: --format: gray, ' --camera frames --format mjpg
refuses "a format that no recording has" 1 '^iris follow: frames: a recording gives ' --camera frames --format yuyv
refuses "no frames" 2 '^iris follow: --frames: ' --camera frames --frames 0
refuses "a camera and files" 2 '^iris follow: --camera: either ' --camera frames all.pgm
for option in "--size 64x48" "--format gray" "--frames 3" --timing; do
    # shellcheck disable=SC2086
    refuses "${option% *} without a camera" 2 "^iris follow: ${option% *}: only together with --camera\$" $option frames
done
echo text > frames/f3a.pgm
run --json --camera frames
[ $code -eq 1 ] && [ "$(wc -l < out)" -eq 10 ] && grep -q '^iris follow: frames: 10 frames, 0 dropped, 0 skipped, 1 damaged,' err
say $? "a bad picture is counted, the others go on, and it shows in the end"
first_argument=capture
run --device frames -o damaged
[ $code -eq 1 ] && [ "$(ls damaged | wc -l)" -eq 10 ] && grep -q ' 10 frames, 0 dropped, 0 skipped, 1 damaged,' out &&
    grep -q '^iris capture: frames: 1 frames damaged; f3a.pgm: neither BMP nor PGM/PPM$' err
say $? "capture, too, ends badly with a bad picture"
first_argument=follow
rm frames/f3a.pgm
{ cat all.pgm; echo garbage; } | timeout 10 "$iris" follow --json --camera - > out 2> err
[ $? -eq 1 ] && [ "$(wc -l < out)" -eq 10 ] && grep -q '^iris follow: -: neither BMP nor PGM/PPM$' err
say $? "garbage behind the pictures"

few=150000 # KiB
(ulimit -v $few && "$iris" follow --json --camera frames > out 2> err)
[ $? -eq 0 ] && [ ! -s err ] && answers out | cmp -s - wanted; say $? "with little memory"
printf 'P6 8192 8192 255\n' > large.ppm
(ulimit -v $few && "$iris" follow --camera large.ppm > out 2> err)
[ $? -eq 1 ] && grep -q '^iris follow: large.ppm: out of memory$' err; say $? "with too little memory"

# --- iris capture ---
first_argument=capture
works "frames into a folder" --device frames -o seen/new
[ "$(ls seen/new | wc -l)" -eq 10 ] && grep -q '^frames  64x48 gray  10 frames, 0 dropped, 0 skipped, 0 damaged,' out
say $? "frames into a folder: what was granted and counted"
"$iris" convert seen/new/frame_000003.bmp -o three.pgm && "$iris" convert frames/f2.pgm -o two.pgm && cmp -s two.pgm three.pgm
say $? "frames into a folder: the same pixels"
works "two frames in JSON" --json --device frames --frames 2 --rate 100 -o seen/two
[ "$(wc -l < out)" -eq 3 ] && [ "$(ls seen/two | wc -l)" -eq 2 ] &&
    sed -n 2p out | grep -Eq '^\{"frame":2,"time_us":[0-9]+,"file":"seen/two/frame_000002.bmp"\}$' &&
    tail -1 out | grep -q '^{"granted":{"w":64,"h":48,"format":"gray","stride":64,"rate":100,"matrix":null,"range":"full"},"frames":2,"dropped":0,'
say $? "two frames in JSON: each, and what was granted"
"$iris" capture --device frames -o - 2> err > out
[ "$(sed -n 1p out)" = P5 ] && [ "$(wc -c < out)" -eq $((10 * (3072 + 13))) ]
say $? "frames to standard output"
"$iris" capture --device frames -o - 2> err | "$iris" follow --json - 2>> err | sed 's/"file":"[^"]*",//' > out
cmp -s out wanted && [ ! -s err ]; say $? "capture through a pipe into follow"
works "in color" --device frames --format rgb --frames 1 --raw -o seen/raw
[ "$(wc -c < seen/raw/frame_000001.raw)" -eq 9216 ]; say $? "raw bytes in color"
"$iris" convert --raw rgb:64x48 seen/raw/frame_000001.raw -o raw.ppm && "$iris" gray raw.ppm -o raw.pgm
"$iris" convert frames/f0.pgm -o first.pgm && cmp -s raw.pgm first.pgm; say $? "raw bytes are read back"
refuses "capture without a camera" 2 '^iris capture: no --device ' -o seen
refuses "capture without an output" 2 '^iris capture: no output ' --device frames
refuses "capture with inputs" 2 '^iris capture: the camera is given by --device$' --device frames -o seen frames
refuses "JSON among pictures" 2 '^iris capture: --json: not together with -o -' --json --device frames -o -
refuses "a rate that is none" 2 '^iris capture: --rate: frames per second, ' --device frames --rate 0 -o seen
refuses "a timeout that is none" 2 '^iris capture: --timeout: ' --device frames --timeout 0 -o seen
refuses "one picture for all frames" 2 '^iris capture: -o: a folder ' --device frames -o one.bmp
: > plain
refuses "an output that is a file" 1 "^iris capture: plain: " --device frames -o plain
refuses "capture of nothing" 1 '^iris capture: empty: no .bmp, ' --device empty -o none
[ ! -e none ]; say $? "capture of nothing: no folder"
mkdir -p seen/taken/frame_000003.bmp
run --device frames -o seen/taken
[ $code -eq 1 ] && grep -q '^frames  64x48 gray  2 frames, ' out; say $? "capture counts what it has written"
mkfifo silent
exec 4<> silent
cat all.pgm >&4
timeout 10 "$iris" capture --device - --timeout 300 -o seen/silent < silent > out 2> err
[ $? -eq 1 ] && grep -q '^iris capture: -: no frame for 300 ms$' err && [ "$(ls seen/silent | wc -l)" -eq 10 ]
say $? "frames that do not come end the capture"
exec 4>&-

# --- iris cameras, iris controls: what there is without any, or with whatever this machine has ---
first_argument=cameras
refuses "cameras takes no input" 2 '^iris cameras: x: ' x
run --json
{ [ $code -eq 0 ] && grep -q '^{"device":"' out; } || { [ $code -eq 1 ] && grep -q '^iris cameras: no camera is there ' err; }
say $? "cameras, or that there is none"
first_argument=controls
refuses "controls of nothing" 2 '^iris controls: no --device ' gain=1
refuses "controls of no camera" 1 '^iris controls: /dev/null: ' --device /dev/null
refuses "controls of what is not there" 1 '^iris controls: /dev/video250: ' --device /dev/video250
for word in gain gain= =3; do
    refuses "controls: '$word'" 2 "^iris controls: $word: NAME=VALUE" --device /dev/video250 "$word"
done
first_argument=

# --- it ends when it is told to; `hold` is a pipe that does not end ---
mkfifo hold
exec 3<> hold
for signal in INT TERM; do
    cat all.pgm >&3
    timeout --preserve-status -k 5 -s $signal 1.5 "$iris" follow --camera - < hold > out 2> err
    [ $? -eq 0 ] && [ "$(wc -l < out)" -eq 10 ]; say $? "SIG$signal ends it cleanly"
done
