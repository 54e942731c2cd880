#!/bin/sh
# iris follow from outside: frames of known lines in, answers out. The frames are text: the floor is ~ (126), a line is a
# space (32), so the expected numbers can be read off.
first_argument=follow
. tests/outside
LC_ALL=C
export LC_ALL

field() { # field KEY [LINE] : its value in that line of out
    sed -n "${2:-1}s/.*\"$1\":\([^,}]*\).*/\1/p" out
}
is() { # is NAME KEY VALUE [LINE]
    [ "$(field "$2" "$4")" = "$3" ]; say $? "$1: $2 $3"
}
near() { # near NAME KEY VALUE TOLERANCE [LINE]
    field "$2" "$5" | awk -v want="$3" -v most="$4" '
        $1 ~ /^[-0-9.]+$/ { d = $1 - want; good = d <= most && -d <= most }
        END { exit !good }'
    say $? "$1: $2 within $4 of $3"
}
states() { # the states in out
    sed 's/.*"state":"\([a-z]*\)".*/\1/' out | tr '\n' ' '
}
# gray LEFT LEAN [MIRROR] : 64x48 PGM; the line's left column at the bottom, columns to the right per row upwards; 8 wide
gray() {
    awk -v left="$1" -v lean="$2" -v mirror="$3" 'BEGIN {
        printf "P5 64 48 255\n"
        for (y = 0; y < 48; y++) for (x = 0; x < 64; x++) {
            at = (mirror ? 63 - x : x) - left - int(lean * (47 - y))
            printf "%s", (at >= 0 && at < 8) ? " " : "~" } }'
}
gray 40 0 > right.pgm
gray 40 0 1 > left.pgm
gray 20 0.5 > lean.pgm
gray 20 0.5 1 > mirrored.pgm
gray 100 0 > empty.pgm
{ printf 'P5 64 48 255\n'; tail -c 3072 right.pgm | tr ' ' '\377'; } > bright.pgm
# A red line: 120 32 32 is hue 0, saturation 88 / 152, lightness 152 / 510
{ printf 'P6 64 48 255\n'; tail -c 3072 right.pgm | sed 's/~/~~~/g; s/ /x  /g' | tr -d '\n'; } > red.ppm
awk 'BEGIN { printf "P5 64 48 255\n"; for (y = 0; y < 48; y++) for (x = 0; x < 64; x++)
    printf "%s", ((x >= 18 && x < 22) || (x >= 50 && x < 54)) ? " " : "~" }' > lane.pgm
"$iris" convert right.pgm -o right.bmp
"$iris" convert --resize 128x96 --nearest right.pgm -o twice.pgm

# --- the answer ---
number='(null|-?[0-9]+(\.[0-9]+)?)'
row="\{\"y\":[0-9]+,\"left\":$number,\"right\":$number,\"center\":$number\}"
segment="\{\"x0\":$number,\"y0\":$number,\"x1\":$number,\"y1\":$number\}"
object="^\{\"file\":\"[^\"]*\",\"frame\":[0-9]+,\"state\":\"(found|stale|lost)\",\"angle_deg\":$number,\"offset\":$number,"
object="$object\"lookahead_offset\":$number,\"next_angle_deg\":$number,\"width_px\":$number,\"confidence\":$number,"
object="$object\"steer\":$number,\"steer_deg\":$number,\"speed\":$number,"
object="$object\"rows\":\[($row(,$row)*)?\],\"segments\":(null|\[$segment(,$segment)*\])\}\$"
well_formed() { # every line is one object with these keys in this order
    [ -s out ] && ! grep -Evq "$object" out
}
works "a straight line" --json --rows 0,20,47 right.pgm
well_formed; say $? "JSON as documented"
is "columns 40 to 47" file '"right.pgm"'
is "columns 40 to 47" frame 1
is "columns 40 to 47" state '"found"'
near "columns 40 to 47" angle_deg 0 0.3
near "columns 40 to 47" offset 0.375 0.02
near "columns 40 to 47" lookahead_offset 0.375 0.02
is "columns 40 to 47" next_angle_deg null
is "columns 40 to 47" width_px 8
grep -q '"rows":\[{"y":0,.*{"y":20,"left":40,"right":47,"center":43.5},{"y":47,"left":40,"right":47,"center":43.5}\]' out
say $? "columns 40 to 47: rows in the order asked for"
steer=$(field steer)
awk -v s="$steer" -v d="$(field steer_deg)" 'BEGIN { e = d - 45 * s; exit !(s > 0.05 && s <= 1 && e < 0.05 && e > -0.05) }'
say $? "steers right, steer_deg is 45 degrees of it"
works "the same mirrored" --json left.pgm
near "mirrored" offset -0.375 0.02
near "mirrored" steer "-$steer" 0.03
works "a leaning line" --json lean.pgm
near "leans right" angle_deg 26.57 1.5
near "leans right" offset "$(awk 'BEGIN { print (23.5 - 31.5) / 32 }')" 0.05
steer=$(field steer)
works "a leaning line mirrored" --json mirrored.pgm
near "leans left" angle_deg -26.57 1.5
awk -v a="$steer" -v b="$(field steer)" 'BEGIN { d = a + b; exit !(d < 0.05 && d > -0.05 && a * b < 0) }'
say $? "mirrored frames flip the sign of steer"
works "the default rows" --json right.pgm
[ "$(grep -o '"y":[0-9]*' out | tr -d '"y:' | tr '\n' ' ')" = "15 24 47 " ]; say $? "look-ahead, middle, bottom"
works "an empty floor" --json empty.pgm
well_formed && grep -q '"state":"lost","angle_deg":null,"offset":null,"lookahead_offset":null,"next_angle_deg":null,"width_px":null,"confidence":null,"steer":0,"steer_deg":0,"speed":0,' out &&
    grep -q '"rows":\[{"y":15,"left":null,"right":null,"center":null},.*\],"segments":null}$' out
say $? "lost: everything null, and a robot that stands still"
works "text" right.pgm empty.pgm lean.pgm
[ "$(wc -l < out)" -eq 3 ] && grep -Eq '^ +1 right.pgm +found +angle .*offset +\+0\.3[789] .*steer \+0.* deg +speed 0\.[0-9]+$' out
say $? "text: one line per frame"
[ "$(awk '{ print index($0, "steer") }' out | sort -u | wc -l)" -eq 1 ]; say $? "text: columns are aligned"
works "text with rows" --stills --rows 20,47 right.pgm empty.pgm
grep -q '20:  40-47  *47:  40-47' out && grep -q '20:    -  *47:    -' out; say $? "text with rows: edges"

# --- the kind of line ---
works "a bright line" --json --line bright bright.pgm
near "bright" offset 0.375 0.02
works "a bright line is not dark" --json bright.pgm
is "not dark" state '"lost"'
works "a red line" --json --line hsl:350-10:50-65:25-35 red.ppm
near "red, through 0 degrees" offset 0.375 0.02
cp out colons
works "a red line, by commas" --json --line hsl:350-10,50-65,25-35 red.ppm
cmp -s out colons; say $? "commas are as good as colons"
works "no green line" --json --line hsl:90-150:20-100:20-70 red.ppm
is "green" state '"lost"'
works "a gray line by color" --json --line=hsl:0-360:0-10:0-20 right.pgm
near "dark gray by lightness" offset 0.375 0.02
works "a lane" --json --lane --rows 20 lane.pgm
near "between 18-21 and 50-53" offset "$(awk 'BEGIN { print (35.5 - 31.5) / 32 }')" 0.02
grep -q '{"y":20,"left":22,"right":49,"center":35.5}' out; say $? "the lane's rows are the floor between the lines"

works "by regression" --json --estimator regression lean.pgm
cp out regression
works "by Hough transform" --json --estimator hough lean.pgm twice.pgm lean.pgm
near "by Hough transform" angle_deg 26.57 2
near "by Hough transform, after frames of another size" angle_deg 26.57 2 3
! head -1 out | cmp -s - regression; say $? "the estimators are not the same"

# --- a sequence ---
works "a line that goes away" --json right.pgm empty.pgm empty.pgm empty.pgm empty.pgm empty.pgm empty.pgm empty.pgm
[ "$(states)" = "found stale stale stale stale stale stale lost " ]; say $? "stale for 200 ms at 30 frames per second"
[ "$(field offset 7)" = "$(field offset)" ] && [ "$(field width_px 7)" = 8 ]; say $? "stale repeats the last result"
sed -n 7p out | grep -q '"y":47,"left":null,"right":null,"center":null' && ! sed -n 7p out | grep -q '"left":[0-9]'
say $? "stale has no rows"
is "lost, but known where it was" steer 1 8
awk -v s="$(field speed 8)" 'BEGIN { exit !(s > 0) }'; say $? "lost: it searches"
works "--rate" --json --rate 10 right.pgm empty.pgm empty.pgm empty.pgm
[ "$(states)" = "found stale stale lost " ]; say $? "stale for 200 ms at 10 frames per second"
works "--stills" --json --stills right.pgm empty.pgm left.pgm
[ "$(states)" = "found lost found " ] && [ "$(field steer 2)" = 0 ]; say $? "stills have nothing to do with each other"
mkdir frames
cp right.pgm frames/2.pgm; cp empty.pgm frames/1.pgm; cp right.bmp frames/3.bmp; echo notes > frames/notes.txt
works "a folder" --json frames
[ "$(states)" = "lost found found " ] && [ "$(field file 2)" = '"frames/2.pgm"' ] && [ "$(field frame 3)" = 3 ]
say $? "a folder in the order of its names"
works "frames of another size" --json right.pgm twice.pgm red.ppm right.pgm
[ "$(states)" = "found found found found " ] && well_formed; say $? "frames of another size are answered"
near "twice as large" offset 0.375 0.02 2

# --- standard input ---
stream() { # stream ARGUMENT... : what is in the file frames.all
    timeout 30 "$iris" follow "$@" - < frames.all > out 2> err
    code=$?
}
cat right.pgm right.bmp red.ppm empty.pgm lean.pgm > frames.all; stream --json
[ $code -eq 0 ] && [ ! -s err ] && [ "$(states)" = "found found found stale found " ] && well_formed
say $? "BMP, PGM, and PPM in one stream"
[ "$(field file 2)" = '"-"' ] && [ "$(field frame 5)" = 5 ]; say $? "a stream's file is -, its frames are counted"
works "the same as files" --json right.pgm right.bmp red.ppm empty.pgm lean.pgm
sed 's/"file":"[^"]*"//' out > files
cat right.pgm right.bmp red.ppm empty.pgm lean.pgm > frames.all; stream --json
sed 's/"file":"[^"]*"//' out | cmp -s - files; say $? "a stream and files are answered alike"
answered() { # answered N : waits until out has N lines
    for i in $(seq 100); do
        [ "$(wc -l < out)" -ge "$1" ] && break
        sleep 0.1
    done
    [ "$(wc -l < out)" -eq "$1" ]
}
mkfifo pipe
for form in "" --json; do
    : > out
    "$iris" follow $form - < pipe > out 2> err &
    child=$!
    exec 3> pipe
    cat right.pgm >&3; answered 1; first=$?
    cat right.bmp >&3; answered 2; second=$?
    cat lean.pgm >&3; answered 3; third=$?
    exec 3>&-
    wait $child
    [ "$?$first$second$third" = 0000 ]; say $? "every frame is answered before the next one comes $form"
done
{ cat right.pgm; printf garbage; cat right.pgm; } > frames.all; stream --json
[ $code -eq 1 ] && [ "$(states)" = "found " ] && [ "$(cat err)" = "iris follow: -: neither BMP nor PGM/PPM" ]
say $? "garbage behind a frame: one answer, one error, exit 1"
{ cat right.bmp; head -c 2000 right.pgm; } > frames.all; stream --json
[ $code -eq 1 ] && [ "$(states)" = "found " ] && [ "$(cat err)" = "iris follow: -: ends too early" ]
say $? "a stream that ends within a frame"
head -c 30 right.bmp > frames.all; stream
[ $code -eq 1 ] && [ ! -s out ] && grep -q 'ends too early' err; say $? "a stream that ends within a header"
refuses "an empty stream" 1 '^iris follow: -: is empty$' -

# --- bad frames ---
head -c 1000 right.pgm > short.pgm
echo 'This is no picture.' > text.bmp
: > empty.bmp
printf 'P5 9000 8 255\n' > wide.pgm
head -c 72000 /dev/zero >> wide.pgm
printf 'P5 7 48 255\n' > narrow.pgm
head -c 336 /dev/zero >> narrow.pgm
printf 'P5 32767 32767 255\n' > absurd.pgm
refuses "a truncated frame" 1 '^iris follow: short.pgm: ends too early$' short.pgm
refuses "no picture" 1 '^iris follow: text.bmp: neither BMP nor PGM/PPM$' --json text.bmp
refuses "an empty file" 1 '^iris follow: empty.bmp: is empty$' empty.bmp
refuses "no such file" 1 '^iris follow: missing.bmp: No such file' missing.bmp
refuses "a side above 8191" 1 '^iris follow: wide.pgm: 9000x8 pixels' wide.pgm
refuses "a side below 8" 1 '^iris follow: narrow.pgm: 7x48 pixels' narrow.pgm
refuses "gigabytes of pixels" 1 '^iris follow: absurd.pgm: 32767x32767 pixels' absurd.pgm
run --json right.pgm short.pgm narrow.pgm left.pgm
[ $code -eq 1 ] && [ "$(states)" = "found found " ] && [ "$(wc -l < err)" -eq 2 ] && [ "$(field frame 2)" = 4 ]
say $? "a bad frame among good ones: no answer, but its place in time"
run --json right.pgm narrow.pgm empty.pgm
[ $code -eq 1 ] && [ "$(states)" = "found stale " ]; say $? "a frame that cannot be followed forgets nothing"
refuses "a folder without pictures" 1 '^iris follow: hollow: ' "$(mkdir hollow; echo hollow)"
"$iris" follow right.pgm > /dev/full 2> err
[ $? -eq 1 ] && [ "$(wc -l < err)" -eq 1 ] && grep -q '^iris follow: standard output: ' err; say $? "a full standard output"

# --- wrong calls ---
refuses "no input" 2 '^iris follow: no input'
refuses "an unknown option" 2 '^iris follow: unknown option --speed' --speed 5 right.pgm
for wrong in "" red Dark dark, hsl hsl: hsl:1-2 hsl:1-2:3-4 hsl:1-2:3-4:5 hsl:1-2:3-4:5-6:7-8 hsl:1-2:3-4:5-6x hsl:1:3-4:5-6 \
    hsl:0-361:0-100:0-100 hsl:-1-20:0-100:0-100 hsl:0-20:0-101:0-100 hsl:0-20:60-40:0-100 hsl:0-20:0-100:70-30 \
    hsl:a-b:0-100:0-100 hsl:0.5-20:0-100:0-100 hsl:00000000000000000000000000000001-2:3-4:5-6 hsl:0-20:0-100:0-99999999999; do
    refuses "--line '$wrong'" 2 '^iris follow: --line: ' --line "$wrong" right.pgm
done
for wrong in "" Hough least-squares; do
    refuses "--estimator '$wrong'" 2 '^iris follow: --estimator: ' --estimator "$wrong" right.pgm
done
for wrong in "" x 1, ,1 1,,2 -1 1,-2 1.5 8191 99999999999 "1 2" "$(seq -s, 2000)"; do
    refuses "--rows '$(echo "$wrong" | cut -c 1-20)'" 2 '^iris follow: --rows: ' --rows "$wrong" right.pgm
done
refuses "a row outside of the frame" 2 '^iris follow: --rows: row 48 is outside of right.pgm \(64x48\)$' --rows 20,48 right.pgm
works "a row outside of a later, smaller frame" --json --stills --rows 90 twice.pgm right.pgm
sed -n 2p out | grep -q '"y":90,"left":null'; say $? "which has nothing in it"
for wrong in 0 -5 1001 x 29.97 ""; do
    refuses "--rate '$wrong'" 2 '^iris follow: --rate: ' --rate "$wrong" right.pgm
done
refuses "--baud 12345" 2 '^iris follow: --baud: 12345 ' --serial /dev/null --baud 12345 right.pgm
refuses "--baud fast" 2 '^iris follow: --baud: ' --serial /dev/null --baud fast right.pgm

# A line of 80 on a floor of 150: 47 % darker, and 48 % are asked for by default.
{ printf 'P5 64 48 255\n'; tail -c 3072 right.pgm | tr ' ~' '\120\226'; } > faint.pgm
works "a faint line" --json faint.pgm
is "is lost by default" state '"lost"'
works "--contrast" --json --contrast 25 faint.pgm
is "is found" state '"found"'
near "is found" width_px 8 0
works "--contrast 90" --json --contrast 90 right.pgm
is "asks for more" state '"lost"'
works "--contrast --junctions" --json --contrast 10 --junctions faint.pgm
for n in 9 91 x; do
    refuses "--contrast $n" 2 "^iris follow: --contrast: 10 to 90, not '$n'" --contrast $n right.pgm
done
refuses "--contrast of a color" 2 "^iris follow: --contrast: only for dark and bright lines" --contrast 20 --line hsl:0-9:0-9:0-9 red.ppm
refuses "--baud without --serial" 2 '^iris follow: --baud: only together with --serial$' --baud 9600 right.pgm
refuses "standard input twice" 2 '^iris follow: -: standard input is given twice$' - right.pgm -

# --- overlays ---
works "--overlay" --overlay new/seen right.pgm red.ppm empty.pgm
[ "$(ls new/seen | tr '\n' ' ')" = "empty.bmp red.bmp right.bmp " ]; say $? "the folder is made, with a BMP per frame"
"$iris" info new/seen/right.bmp > out
[ "$(cat out)" = "new/seen/right.bmp: BMP 320x240, 24 bits, color, raw, bottom-up" ]; say $? "a small frame is enlarged"
"$iris" convert new/seen/right.bmp -o seen.ppm
# pixel X Y : of seen.ppm (320x240, header of 15 bytes), in hexadecimal
pixel() {
    tail -c +$((16 + 3 * (320 * $2 + $1))) seen.ppm | head -c 3 | od -An -tx1 | tr -d ' '
}
[ "$(pixel 202 150)" = 00ff5a ] && [ "$(pixel 237 150)" = 00ff5a ] && [ "$(pixel 195 150)" = 7e7e7e ]
say $? "the edges are drawn where the line begins and ends"
[ "$(pixel 217 150)" = ff00c8 ] || [ "$(pixel 222 150)" = ff00c8 ]; say $? "the segment is drawn in the middle"
[ "$(pixel 319 2)" = 1f1f1f ]; say $? "the numbers have a dark backing"
cat right.pgm right.bmp > frames.all; stream --overlay numbered
[ $code -eq 0 ] && [ "$(ls numbered | tr '\n' ' ')" = "frame_00001.bmp frame_00002.bmp " ]; say $? "frames of a stream are numbered"
"$iris" convert --resize 640x480 right.pgm -o large.pgm
works "a large frame" --overlay seen large.pgm
"$iris" info seen/large.bmp > out
grep -q 640x480 out; say $? "keeps its size"
echo precious > file
refuses "an overlay into a file" 1 '^iris follow: file: Not a directory$' --overlay file right.pgm
refuses "an overlay below a file" 1 '^iris follow: file/below: Not a directory$' --overlay file/below right.pgm
refuses "an overlay without a name" 1 '^iris follow: : No such file' --overlay "" right.pgm
[ "$(cat file)" = precious ]; say $? "the file is as it was"
refuses "an overlay over its input" 2 '^iris follow: ./right.bmp: .*replace the input' --overlay . right.bmp
refuses "two overlays of one name" 2 '^iris follow: seen/right.bmp: more than one' --overlay seen right.pgm right.bmp
mkdir seen/right.bmp
run --overlay seen right.pgm left.pgm
[ $code -eq 1 ] && [ "$(wc -l < out)" -eq 2 ] && [ "$(wc -l < err)" -eq 1 ] && [ -f seen/left.bmp ]
say $? "an overlay that cannot be written: said, and the others go on"

# --- serial: what is no port; the ports themselves need a terminal pair, which Python has ---
refuses "--serial without a device" 1 '^iris follow: /dev/none: no such device$' --serial /dev/none right.pgm
refuses "--serial on a file" 1 '^iris follow: file: not a serial port$' --serial file right.pgm
refuses "--serial on a folder" 1 '^iris follow: frames: not a serial port$' --serial frames right.pgm
if ! python3 -c 'import pty' 2> /dev/null; then
    echo "ok - commands over a serial port # SKIP no python3"
else
    cat > port.py <<'END'
import os, pty, signal, subprocess, sys, threading, time, tty
iris = sys.argv[1]
frame, empty = open("right.pgm", "rb").read(), open("empty.pgm", "rb").read()
def say(good, name, seen=""):
    print(("ok - " if good else "not ok - ") + name + ("" if good else "\n# " + repr(seen)))
def port():
    master, slave = pty.openpty()
    tty.setraw(slave)
    return master, slave, os.ttyname(slave)
def start(name, *words):
    return subprocess.Popen([iris, "follow", "--serial", name, "--watchdog", "5s", *words], stdin=subprocess.PIPE,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
def sentences(master):
    os.set_blocking(master, False)
    text = b""
    try:
        while True:
            text += os.read(master, 4096)
    except OSError:
        pass
    return text.decode().split("\r\n")
def fields(sentence):
    body, _, check = sentence[1:].partition("*")
    total = 0
    for c in body.encode():
        total ^= c
    return body.split(",") if "%02X" % total == check else ["broken"]

master, slave, name = port()
began = time.time()
p = start(name, "--rate", "20", "right.pgm", "left.pgm", "empty.pgm", "right.pgm")
out, err = p.communicate(timeout=20)
took, seen = time.time() - began, sentences(master)
got = [fields(s) for s in seen[:-1]]
say(p.returncode == 0 and err == b"" and seen[-1] == "", "files over a port", (err, seen))
say([g[:3] for g in got] == [["PIRIS", str(i), s] for i, s in enumerate("FFSFL")], "a good sentence per frame", seen)
say(int(got[0][3]) > 0 > int(got[1][3]) and abs(int(got[0][6]) - 375) < 20, "which says where to steer", seen)
say(got[-1][3:5] == ["0", "0"] and int(got[-2][4]) > 0, "at the end the robot is stopped", seen)
say(took > 0.14, "files are paced at --rate", took)

master, slave, name = port()
for closed in ">&-", "2>&-", "<&- >&- 2>&-":
    command = "exec '%s' follow --serial %s right.pgm missing.pgm %s" % (iris, name, closed)
    code = subprocess.run(command, shell=True, capture_output=True, timeout=20).returncode
    got = sentences(master)
    say(code == 1 and len(got) == 3 and all(fields(s)[0] == "PIRIS" for s in got[:2]),
        "neither answers nor complaints go to the robot with " + closed, (code, got))

master, slave, name = port()
p = start(name, "-")
p.stdin.write(frame)
p.stdin.flush()
p.stdout.readline()
p.send_signal(signal.SIGTERM)
code = p.wait(timeout=20)
got = [fields(s) for s in sentences(master)[:-1]]
say(code == -signal.SIGTERM and got[-1][2:5] == ["L", "0", "0"], "a signal stops the robot too", (code, got))

master, slave, name = port()
link = os.path.join(os.getcwd(), "robot") # a name that nobody else gets meanwhile
os.symlink(name, link)
p = start(link, "-")
for i in range(8):
    if i == 3:
        os.unlink(link)
        os.close(slave)
        os.close(master)
    p.stdin.write(frame)
    p.stdin.flush()
    p.stdout.readline()
out, err = p.communicate(timeout=20)
lines = err.decode().splitlines()
say(p.returncode == 1 and len(lines) == 2 and "going on without it" in lines[0] and "stop" in lines[1],
    "a port that goes away is said once; the frames go on", (p.returncode, lines))

master, slave, name = port()
os.symlink(name, link)
p = start(link, "-")
for i in range(12):
    if i == 3:
        os.unlink(link)
        os.close(slave)
        os.close(master)
    if i == 6:
        master, slave, name = port()
        os.symlink(name, link)
        time.sleep(0.5)
    p.stdin.write(frame)
    p.stdin.flush()
    p.stdout.readline()
    time.sleep(0.02) # of commands that come faster the newest wins
out, err = p.communicate(timeout=20)
lines, got = err.decode().splitlines(), [fields(s) for s in sentences(master)[:-1]]
say(p.returncode == 0 and len(lines) == 2 and "going on" in lines[0] and lines[1].endswith("works again"),
    "a port that comes back is said once", (p.returncode, lines))
say(int(got[0][1]) in range(6, 10) and got[-1][3:5] == ["0", "0"], "and gets commands again, up to the stop", got)

master, slave, name = port()
p = start(name, "-")
end = time.time() + 2.5
drain = threading.Thread(target=p.stdout.read)
drain.start()
while time.time() < end:
    p.stdin.write(frame)
    p.stdin.flush()
    time.sleep(0.0005)
p.stdin.close()
err = p.stderr.read().decode().splitlines()
code = p.wait(timeout=20)
drain.join()
say(code == 1 and len(err) == 2 and "blocked" in err[0] and "stop" in err[1],
    "a port that takes nothing is said once, and nothing hangs", (code, err))
END
    timeout 120 python3 port.py "$iris" 2> err || { cat err | sed 's/^/# /'; echo "not ok - commands over a serial port"; }
fi

# --- progress: on a terminal, when the answers go elsewhere ---
if command -v script > /dev/null; then
    timeout 30 script -qec "'$iris' follow right.pgm left.pgm > answers" /dev/null > out 2> err < /dev/null
    grep -q 'follow 1/2 right.pgm' out && [ "$(wc -l < answers)" -eq 2 ]; say $? "progress on a terminal"
    timeout 30 script -qec "'$iris' follow right.pgm left.pgm" /dev/null > out 2> err < /dev/null
    ! grep -q '1/2' out; say $? "no progress between answers on a terminal"
else
    echo "ok - progress on a terminal # SKIP no script(1)"
fi

# --- real frames ---
if [ -d "$data/line/black_tape" ]; then
    works "black_tape" --json --stills --rows 40,120,200 --overlay tape "$data/line/black_tape"
    well_formed && [ "$(wc -l < out)" -eq 11 ] && [ "$(ls tape | wc -l)" -eq 11 ]; say $? "11 answers, 11 overlays"
    grep -q 'line2_304.bmp","frame":7,"state":"lost"' out; say $? "a floor without a line is never found"
    works "yellow_dashes" --json --stills --line hsl:50-90:20-100:20-70 "$data/line/yellow_dashes"
    [ "$(states)" = "found found found found " ]; say $? "every frame of yellow_dashes"
    works "tape_lane" --json --stills --lane --line hsl:0-360:0-45:15-45 "$data/line/tape_lane"
    [ "$(states)" = "found found found " ]; say $? "every frame of tape_lane"
else
    echo "ok - real frames # SKIP no data (IRIS_DATA)"
fi

# A T of strokes of 9 pixels: from below, to the left and the right.
awk 'BEGIN { printf "P5 160 120 255\n"; for (y = 0; y < 120; y++) for (x = 0; x < 160; x++)
    printf "%s", (y >= 56 && y < 65) || (x >= 76 && x < 85 && y >= 56) ? " " : "~" }' > t.pgm
works "--junctions" --junctions --json --stills --overlay seen_t t.pgm right.pgm
grep -q '"junctions":\[{"type":"T","x":8[01][.0-9]*,"y":[56][.0-9]*,"branches_deg":\[-180,-90,90\],"distance_rows":[56][0-9],"confidence":1}\]' out
say $? "a T, its place and its branches"
sed -n 2p out | grep -q '"junctions":\[\]'; say $? "none on a straight line"
[ -s seen_t/t.bmp ]; say $? "--junctions draws"
works "--junctions, text" --junctions --stills t.pgm
grep -q '  T 8[01],[56][0-9] ' out; say $? "a T in the text"
works "follow without --junctions" --json --stills t.pgm
grep -q junctions out; [ $? -eq 1 ]; say $? "nothing about junctions without the option"
works "--take" --junctions --take left,right --json t.pgm t.pgm t.pgm t.pgm
is "--take left" next_angle_deg -90 4
[ "$(grep -o '"take":{[^}]*}' out | tr '\n' ' ')" = "$(for s in waiting waiting approaching approaching; do
    printf '"take":{"turn":"left","state":"%s"} ' $s; done)" ]
say $? "--take tells its state"
works "--take, text" --junctions --take left t.pgm t.pgm t.pgm
sed -n 3p out | grep -q '  take left: approaching'; say $? "and in the text"
works "--take right" --junctions --take right --json t.pgm t.pgm t.pgm t.pgm
near "--take right" next_angle_deg 90 1 4
refuses "--take alone" 2 "only together with --junctions" --take left t.pgm
refuses "--take elsewhere" 2 "left, right, or straight, with commas between them, not 'back'" --junctions --take back t.pgm
