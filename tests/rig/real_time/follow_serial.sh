#!/bin/sh
# iris follow over serial ports behind real drivers: what the robot reads at the far end.
first_argument=follow
. tests/outside

# frame LEFT : 64x48 PGM with a line 8 wide from that column on
frame() {
    awk -v left="$1" 'BEGIN { printf "P5 64 48 255\n"
        for (y = 0; y < 48; y++) for (x = 0; x < 64; x++) printf "%s", (x >= left && x < left + 8) ? " " : "~" }'
}
frame 40 > right.pgm
frame 16 > left.pgm
# sentences FILE : a line for each, "broken" for one whose check does not fit; what has no end yet is left out
sentences() {
    xxd -p "$1" | tr -d '\n' | awk '
        function value(h) { return index("0123456789abcdef", substr(h, 1, 1)) * 16 + index("0123456789abcdef", substr(h, 2, 1)) - 17 }
        function exclusive(a, b,   bit, all) { all = 0
            for (bit = 1; bit < 256; bit *= 2) if (int(a / bit) % 2 != int(b / bit) % 2) all += bit
            return all }
        { for (i = 1; i < length($0); i += 2) { c = value(substr($0, i, 2))
            if (c == 36) { body = ""; sum = 0; star = 0 }
            else if (c == 13) { print (toupper(check) == sprintf("%02X", sum)) ? body : "broken"; check = "" }
            else if (c == 42) { star = 1; check = "" }
            else if (star) check = check sprintf("%c", c)
            else if (c != 10) { body = body sprintf("%c", c); sum = exclusive(sum, c) } } }'
}
whole() { # whole FILE FIRST LAST : good sentences alone, numbered from FIRST or later to LAST, in order
    sentences "$1" > said
    awk -F, -v first="$2" -v last="$3" '
        $1 != "PIRIS" || $2 < first || (NR > 1 && $2 <= before) { bad = 1 } { before = $2 } END { exit bad || before != last }' said
}
for port in serial usb; do
    device=$RIG_SERIAL
    [ $port = usb ] && device=$RIG_USB_SERIAL
    for baud in 9600 115200; do
        rig clear $port
        works "$port at $baud" --serial "$device" --baud $baud --rate 20 --watchdog 10s right.pgm left.pgm right.pgm left.pgm
        rig received $port 100 1000 > far
        whole far 0 4; say $? "$port at $baud: whole sentences in order, the last one last"
        [ "$(wc -l < said)" -eq 5 ]; say $? "$port at $baud: one for each frame, and the stop"
        awk -F, 'NR == 1 && $4 <= 0 || NR == 2 && $4 >= 0 || NR == 5 && ($4 != 0 || $5 != 0) { bad = 1 }
            END { exit bad || NR != 5 }' said
        say $? "$port at $baud: right, left, and standing still"
    done
done

# Frames come until the port has been away and is back, and a second longer.
feed() {
    fed=0
    for more in still 20; do
        until [ $more = still ] && [ -e plugged ] || [ $more = 0 ]; do
            cat right.pgm
            fed=$((fed + 1))
            [ $more = still ] || more=$((more - 1))
            sleep 0.05
        done
    done
    echo $fed > fed
}
rig clear usb
: > out
(until [ -s out ]; do sleep 0.1; done; sleep 1; rig unplug; sleep 1; rig plug; touch plugged) &
feed | timeout 100 "$iris" follow --serial "$RIG_USB_SERIAL" - > out 2> err
code=$?
wait $!
fed=$(cat fed)
[ $code -eq 0 ]; say $? "unplugged and plugged: the drive goes on to its end"
[ "$(wc -l < out)" -eq "$fed" ]; say $? "unplugged and plugged: an answer for every frame"
grep /dev/ttyUSB err > about # and not what the watchdog says of frames that came late
[ "$(wc -l < about)" -eq 2 ] && sed -n 1p about | grep -q 'going on without it$' && sed -n 2p about | grep -q 'works again$'
say $? "unplugged and plugged: each said once"
rig received usb 0 > far
sentences far > said
awk -F, -v fed="$fed" '$1 != "PIRIS" { broken++; next } before != "" && $2 < before { bad = 1 } $2 > before + 3 { gaps++ } { before = $2; speed = $5 }
    END { exit !(broken <= 1 && !bad && gaps >= 1 && before >= fed - 1 && speed == 0) }' said
say $? "unplugged and plugged: a gap in the sentences, and the stop at the end"

refuses "a port without hardware" 1 '^iris follow: /dev/ttyS[0-9]: no device behind this name$' --serial "$RIG_BARE_SERIAL" right.pgm
