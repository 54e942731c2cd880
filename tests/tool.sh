#!/bin/sh
# The command line tool from outside: what it writes, what it says, and what it leaves behind. Pictures are made by hand
# here; expected bytes are written out.
first_argument=
. tests/outside

bytes() { # bytes FILE : as hexadecimal digits
    od -An -v -tx1 "$1" | tr -d ' \n'
}
same() { # same NAME FILE HEX
    [ "$(bytes "$2")" = "$3" ]
    say $? "$1"
}
# Pictures: 4x2 gray, 2x1 color, 2x2 color BMP bottom-up (red green / blue white), 3x1 black and white.
printf 'P5\n4 2\n255\n\000\143\144\145\377\144\000\310' > gray.pgm
printf 'P6\n2 1\n255\n\012\310\036\377\000\000' > color.ppm
{
    printf 'BM\106\000\000\000\000\000\000\000\066\000\000\000\050\000\000\000\002\000\000\000\002\000\000\000'
    printf '\001\000\030\000\000\000\000\000\020\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000'
    printf '\377\000\000\377\377\377\000\000\000\000\377\000\377\000\000\000'
} > color.bmp
mkdir folder

# --- help and options ---
works "--help" --help
grep -q threshold out && grep -q example: out; say $? "--help lists the commands"
works "--version" --version
grep -Eq '^iris [0-9]+\.[0-9]+\.[0-9]+$' out; say $? "--version prints one number"
works "help" help
for command in $("$iris" --help | sed -n 's/^  \([a-z]*\)   *[a-z].*/\1/p'); do
    works "$command --help" "$command" --help
    grep -q "^example: iris $command" out; say $? "$command --help has an example"
    mv out first
    works "help $command" help "$command"
    cmp -s first out; say $? "help $command is the same"
    refuses "$command refuses an unknown option" 2 "^iris $command: .*--wrong" "$command" --wrong gray.pgm
    [ "$command" = cameras ] || refuses "$command needs an input" 2 "^iris $command: " "$command"
done
run; [ $code -eq 2 ] && [ -s err ] && [ ! -s out ]; say $? "no command is a wrong call"
refuses "an unknown command" 2 "^iris: frobnicate: " frobnicate
refuses "help for an unknown command" 2 "^iris: frobnicate: " help frobnicate
refuses "an unknown letter" 2 "^iris gray: .*-x" gray -x gray.pgm
refuses "an option without its value" 2 "^iris gray: .*--method" gray gray.pgm --method
refuses "an option with two values" 2 "^iris gray: option --method is given twice\$" gray gray.pgm --method red --method=green
refuses "an option with two values, one by its letter" 2 "^iris gray: option --output is given twice\$" gray gray.pgm -o a --output a
refuses "a flag with a value" 2 "^iris info: .*--json" info --json=yes gray.pgm
refuses "no output on a terminal or beside --json" 2 "^iris gray: " gray --json gray.pgm
works "--name=value, -oFILE, and options behind operands" gray color.ppm --method=green -ofirst.pgm
works "--name value and --output" gray --method green --output second.pgm -- color.ppm
cmp -s first.pgm second.pgm; say $? "both spellings do the same"
cp gray.pgm ./--json
works "-- ends the options" info -- --json
rm ./--json

# --- info ---
works "info" info gray.pgm color.ppm color.bmp
[ "$(cat out)" = "gray.pgm: PGM 4x2, 8 bits, gray, raw, top-down
color.ppm: PPM 2x1, 24 bits, color, raw, top-down
color.bmp: BMP 2x2, 24 bits, color, raw, bottom-up" ]; say $? "info in words"
works "info --json" info --json gray.pgm color.bmp
[ "$(cat out)" = '{"file":"gray.pgm","format":"PGM","width":4,"height":2,"bits":8,"kind":"gray","coding":"raw","rows":"top-down"}
{"file":"color.bmp","format":"BMP","width":2,"height":2,"bits":24,"kind":"color","coding":"raw","rows":"bottom-up"}' ]
say $? "info as JSON"
odd=$(printf 'a"b\\c\td\377e\303\244.pgm')
cp gray.pgm "$odd"
works "an odd file name" info --json "$odd"
[ "$(cut -d, -f1 out)" = "$(printf '{"file":"a\\"b\\\\c\\u0009d\\ufffde\303\244.pgm"')" ]; say $? "an odd file name is good JSON"
rm "$odd"
refuses "a line break in a value" 2 "^iris gray: --method: .*'a\?b'\$" gray --method "$(printf 'a\nb')" gray.pgm
broken=$(printf 'a\n\033[7m.pgm')
cp gray.pgm "$broken"
works "a line break in the name of a picture" info "$broken"
[ "$(cut -d: -f1 out)" = 'a??[7m.pgm' ]; say $? "an odd file name stays on its line"
rm "$broken"
refuses "a line break in a name" 1 '^iris info: a\?b.pgm: No such file' info "$(printf 'a\nb.pgm')"
cat gray.pgm color.bmp color.ppm gray.pgm | "$iris" info - > out 2> err
[ $? -eq 0 ] && [ "$(cut -d' ' -f2,3 out | tr '\n' ' ')" = "PGM 4x2, BMP 2x2, PPM 2x1, PGM 4x2, " ]
say $? "several pictures in standard input"

# --- gray: 10 200 30 is 123.8 (luma), 80 (average), 200 (green); 255 0 0 is 76.2, 85, 0 ---
for case in luma:7c4d average:5055 green:c800; do
    works "gray --method ${case%:*}" gray --method "${case%:*}" color.ppm -o out.pgm
    same "gray --method ${case%:*}, pixels" out.pgm "50350a3220310a3235350a${case#*:}"
done
refuses "an unknown method" 2 "^iris gray: --method: .*sepia" gray --method sepia color.ppm -o no.pgm
works "gray to BMP" gray gray.pgm -o out.bmp
[ "$(bytes out.bmp | cut -c 1-4)" = 424d ] && [ "$(bytes out.bmp | tail -c 16)" = ff6400c800636465 ]
say $? "gray BMP, bottom-up rows"
works "a name without extension is a BMP" gray gray.pgm -o plain
cmp -s plain out.bmp; say $? "BMP if no extension"

# --- threshold: p > 100 of 0 99 100 101 / 255 100 0 200 ---
works "threshold --value" threshold --value 100 gray.pgm -o mask.pgm
same "threshold --value, pixels" mask.pgm 50350a3420320a3235350a000000ffff0000ff
works "threshold --invert" threshold --value 100 --invert gray.pgm -o mask.pgm
same "threshold --invert, pixels" mask.pgm 50350a3420320a3235350affffff0000ffff00
works "threshold to BMP" threshold --value=100 gray.pgm -o mask.bmp
[ "$(bytes mask.bmp | tail -c 16)" = 9000000010000000 ]; say $? "1-bit BMP, pixels"
run info mask.bmp
[ "$(cat out)" = "mask.bmp: BMP 4x2, 1 bit, mask, palette, bottom-up" ]; say $? "1-bit BMP, header"
works "a mask to PPM" threshold --value 100 gray.pgm -o mask.ppm
same "a mask to PPM, pixels" mask.ppm 50360a3420320a3235350a000000000000000000ffffffffffff000000000000ffffff
printf 'P5 6 1 255 \062\064\063\310\311\312' > two.pgm
works "threshold --otsu" threshold --otsu --json two.pgm -o mask.pgm
[ "$(cat out)" = '{"file":"two.pgm","output":"mask.pgm","width":6,"height":1,"kind":"mask","threshold":125}' ]
say $? "threshold --otsu, the middle of 52 to 199"
same "threshold --otsu, pixels" mask.pgm 50350a3620310a3235350a000000ffffff
# Window 3 of 50 50 50 200 50 50 (the ends repeated): means 50 50 100 100 100 50
printf 'P5 6 1 255 222\31022' > bump.pgm
works "threshold --adaptive" threshold --adaptive 1,0 bump.pgm -o mask.pgm
same "threshold --adaptive, pixels" mask.pgm 50350a3620310a3235350a000000ff0000
works "threshold --adaptive with C" threshold --adaptive 1,1 bump.pgm -o mask.pgm
same "threshold --adaptive with C, pixels" mask.pgm 50350a3620310a3235350affff00ff00ff
works "threshold of color, negative C" threshold --adaptive 1,-1 --json color.bmp -o mask.pgm
grep -q '"kind":"mask","threshold":null}$' out; say $? "an adaptive threshold is no number"
for wrong in "" "--value 5 --otsu" "--value 256" "--value -1" "--value x" "--value 5x" "--value 99999999999999999999" \
    "--adaptive 1" "--adaptive 1,2,3" "--adaptive -1,0" "--adaptive 1024,0" "--adaptive 3,256" "--adaptive 3,"; do
    refuses "threshold $wrong" 2 "^iris threshold: " threshold $wrong gray.pgm -o no.pgm
done

# --- convert ---
works "convert --crop" convert --crop 1,0,2,2 gray.pgm -o part.pgm
same "convert --crop, pixels" part.pgm 50350a3220320a3235350a63646400
works "convert --resize --nearest" convert --resize 4x4 --nearest color.bmp -o big.ppm
same "convert --resize --nearest, pixels" big.ppm 50360a3420340a3235350a$(
    for i in 1 2; do printf ff0000ff000000ff0000ff00; done; for i in 1 2; do printf 0000ff0000ffffffffffffff; done)
works "convert --crop and --resize, bilinear" convert --crop 0,1,2,1 --resize 1x1 gray.pgm -o one.pgm
same "half of 255 and 100, half up" one.pgm 50350a3120310a3235350ab2
works "convert by extension: color to PGM" convert color.ppm -o out.pgm
same "color to PGM, pixels" out.pgm 50350a3220310a3235350a7c4d
works "convert by extension: gray to PPM" convert gray.pgm -o out.ppm
same "gray to PPM, pixels" out.ppm 50360a3420320a3235350a000000636363646464656565ffffff646464000000c8c8c8
works "convert --format gray" convert --format gray color.bmp -o out.bmp
[ "$(bytes out.bmp | tail -c 16)" = 1dff00004d950000 ]; say $? "gray BMP of color, pixels"
works "convert --format mask" convert --format mask color.bmp -o mask.pgm
same "convert --format mask, pixels" mask.pgm 50350a3220320a3235350a00ff00ff
works "convert --format mask, resized color" convert --resize 2x1 --nearest --format mask color.ppm -o mask.pgm
works "convert --format rgb" convert --format rgb gray.pgm -o out.pnm
[ "$(bytes out.pnm | cut -c 1-4)" = 5036 ]; say $? ".pnm takes what fits"
works "BMP to PPM and back" convert color.bmp -o back.ppm
works "BMP to PPM and back" convert back.ppm -o back.bmp
[ "$(bytes back.bmp | tail -c 32)" = "$(bytes color.bmp | tail -c 32)" ]; say $? "BMP to PPM and back, pixels"
works "in place" convert --crop 0,0,1,1 back.ppm -o back.ppm
same "in place, pixels" back.ppm 50360a3120310a3235350aff0000
for wrong in "--crop 0,0,5,1" "--crop 3,0,2,1" "--crop 0,0,2147483647,1" "--crop 0,0,0,1" "--crop -1,0,1,1" "--crop 1,1,1" \
    "--resize 5" "--resize 0x5" "--resize 40000x1" "--resize 5x5x5" "--nearest" "--format cmyk"; do
    refuses "convert $wrong" 2 "^iris convert: " convert $wrong gray.pgm -o no.pgm
done
refuses "an extension that cannot be written" 2 "^iris convert: no.png: " convert gray.pgm -o no.png

# --- standard input and output ---
"$iris" gray - < color.ppm 2> err | "$iris" threshold --value 100 - 2>> err | "$iris" convert - -o piped.pgm 2>> err
[ ! -s err ]; say $? "a pipe of three commands"
same "a pipe of three commands, pixels" piped.pgm 50350a3220310a3235350aff00
cat gray.pgm color.bmp gray.pgm | "$iris" gray - -o - 2> err | "$iris" info - > out
[ "$(cut -d' ' -f2,3 out | tr '\n' ' ')" = "BMP 4x2, BMP 2x2, BMP 4x2, " ] && [ ! -s err ]
say $? "a stream of pictures through a pipe"
mkfifo pipe
"$iris" info - < pipe > out 2> err &
child=$!
exec 3> pipe
cat gray.pgm >&3
for i in 1 2 3 4 5 6 7 8 9 10; do [ -s out ] && break; sleep 0.5; done
[ "$(wc -l < out)" -eq 1 ]; say $? "a picture in a pipe is answered before the next one comes"
printf 'garbage' >&3
exec 3>&-
wait $child
[ $? -eq 1 ] && grep -q '^iris info: -: neither BMP nor' err; say $? "garbage ends a stream with exit 1"
{ cat gray.pgm; head -c 15 gray.pgm; } | "$iris" info - > out 2> err
[ $? -eq 1 ] && [ "$(wc -l < out)" -eq 1 ] && grep -q 'too early' err; say $? "a stream that ends within a picture"

# --- several inputs ---
works "several into a folder" gray gray.pgm color.ppm color.bmp -o folder
[ "$(ls folder | tr '\n' ' ')" = "color.bmp color.pgm gray.pgm " ]; say $? "names and extensions in the folder"
rm folder/*
head -c 15 gray.pgm > short.pgm
refuses "one bad among several" 1 "^iris gray: short.pgm: ends too early" gray gray.pgm short.pgm color.bmp -o folder
[ "$(ls folder | tr '\n' ' ')" = "color.bmp gray.pgm " ]; say $? "the others were written, nothing else"
rm folder/*
mkdir in other
cp gray.pgm in/b.pgm; cp color.bmp in/a.bmp; cp short.pgm in/notes.txt
works "a folder of pictures" info in
[ "$(cut -d: -f1 out | tr '\n' ' ')" = "in/a.bmp in/b.pgm " ]; say $? "a folder in the order of names"
works "a folder into a folder" convert --format rgb in -o folder/
[ "$(ls folder | tr '\n' ' ')" = "a.bmp b.ppm " ]; say $? "a color picture of a PGM becomes a PPM"
refuses "an empty folder" 1 "^iris info: other: " info other
cp gray.pgm other/b.pgm
refuses "two inputs of one name" 2 "folder/b.pgm: more than one" gray in/b.pgm other/b.pgm -o folder
refuses "several inputs into one file" 1 "^iris gray: one.pgm: Not a directory" gray gray.pgm color.ppm -o one.pgm
refuses "several inputs into no folder" 1 "^iris gray: nowhere: No such file" gray gray.pgm color.ppm -o nowhere

# --- bad input: one line, exit 1, no output ---
bad() { # bad NAME PATTERN FILE : for every command that reads
    refuses "$1: info" 1 "^iris info: $3: $2" info "$3"
    refuses "$1: gray" 1 "^iris gray: $3: $2" gray "$3" -o no.bmp
    refuses "$1: threshold" 1 "^iris threshold: $3: $2" threshold --otsu "$3" -o no.bmp
    refuses "$1: convert" 1 "^iris convert: $3: $2" convert "$3" -o no.bmp
}
head -c 60 color.bmp > short.bmp
head -c 30 color.bmp > header.bmp
head -c 5 gray.pgm > header.pgm
: > empty.bmp
echo 'This is no picture.' > text.bmp
printf 'P5\n0 2\n255\n' > zero.pgm
printf 'P5\n4 2\n65535\n0123456701234567' > deep.pgm
printf 'P5\n40000 2\n255\n' > wide.pgm
printf 'P6\n32767 32767\n255\n' > absurd.ppm
{ head -c 18 color.bmp; printf '\000\000\000\000'; tail -c +23 color.bmp; } > zero.bmp
{ head -c 18 color.bmp; printf '\377\177\000\000\377\177\000\000'; tail -c +27 color.bmp; } > absurd.bmp
{ head -c 18 color.bmp; printf '\377\377\377\177\377\377\377\177'; tail -c +27 color.bmp; } > giant.bmp
bad "truncated PGM" "ends too early" short.pgm
bad "truncated BMP" "ends too early" short.bmp
bad "truncated BMP header" "ends too early" header.bmp
bad "truncated PGM header" "ends too early" header.pgm
bad "an empty file" "is empty" empty.bmp
bad "no picture" "neither BMP nor PGM/PPM" text.bmp
bad "zero size PGM" "." zero.pgm
bad "zero size BMP" "." zero.bmp
bad "16-bit PGM" "." deep.pgm
bad "a side too long" "a side above 32767" wide.pgm
bad "a BMP of gigapixels" "a side above 32767" giant.bmp
bad "no such file" "No such file" missing.bmp
bad "a device that cannot be read" "Input/output error" /proc/self/mem
bad "no such device" "No such file" /dev/video-none
for file in absurd.ppm absurd.bmp; do
    refuses "3 GiB of pixels in $file" 1 "^iris gray: $file: 32767x32767 pixels would take more than 1 GiB" gray $file -o no.bmp
done
refuses "3 GiB by --resize" 1 "more than 1 GiB" convert --resize 32767x32767 --format gray color.bmp -o no.bmp
refuses "a pipe that ends" 1 "^iris gray: -: is empty" gray - -o no.bmp
[ -z "$(ls no.* 2> /dev/null)" ]; say $? "no output file remains after a failure"

# --- memory: what is refused was never asked for; what is not, fits 1 GiB and the program ---
printf 'P5\n32767 32767\n255\n' > large.pgm
if sh -c "ulimit -v 1200000 && exec '$iris' --version" > out 2> err; then
    sh -c "ulimit -v 1200000; exec '$iris' convert large.pgm -o no.bmp" > out 2> err
    [ $? -eq 1 ] && grep -q "ends too early" err; say $? "1 GiB less a little is within ulimit -v 1200000"
    { printf 'P5 300 300 255 '; head -c 90000 /dev/zero; } > small.pgm
    sh -c "ulimit -v 1200000; exec '$iris' convert --resize 32767x32767 small.pgm -o no.bmp" > out 2> err
    [ $? -eq 1 ] && [ "$(wc -l < err)" -eq 1 ] && grep -q "more than 1 GiB" err
    say $? "all pictures together stay below 1 GiB"
    sh -c "ulimit -v 100000; exec '$iris' convert large.pgm -o no.bmp" > out 2> err
    [ $? -eq 1 ] && grep -q "not enough memory" err; say $? "too little memory is said"
else
    echo "ok - memory # SKIP a build that needs terabytes of addresses (sanitizer)"
fi
[ ! -e no.bmp ]; say $? "no output file remains after these"

# --- outputs that cannot be written ---
refuses "no such output folder" 1 "^iris gray: nowhere/a.pgm: No such file" gray gray.pgm -o nowhere/a.pgm
# Devices of our own where possible: a broken tool that runs as root would replace those of the machine.
full=/dev/full
null=/dev/null
if [ -w /dev ]; then
    full=$root/full
    null=$root/null
    mknod full c 1 7 && mknod null c 1 3
fi
if [ "$(head -c 1 "$full" 2> err | wc -c)" -eq 1 ] && : 2> err > "$null"; then
    refuses "a full device" 1 "^iris gray: $full: No space left" gray gray.pgm -o "$full"
    [ -c "$full" ]; say $? "the device is still a device"
    works "an output to a device" gray gray.pgm -o "$null"
    [ -c "$null" ]; say $? "that device is still a device"
else
    echo "ok - devices as outputs # SKIP root without devices of its own"
fi
"$iris" info gray.pgm > /dev/full 2> err
[ $? -eq 1 ] && grep -q '^iris info: standard output: ' err; say $? "a full standard output"
"$iris" gray gray.pgm > /dev/full 2> err
[ $? -eq 1 ] && [ "$(wc -l < err)" -eq 1 ]; say $? "a full standard output for a picture, said once"

"$iris" info gray.pgm >&- 2> err
[ $? -eq 1 ] && [ "$(wc -l < err)" -eq 1 ] && grep -q '^iris info: standard output: ' err; say $? "a closed standard output"
"$iris" info - <&- > out 2> err
[ $? -eq 1 ] && [ ! -s out ] && grep -q '^iris info: -: Bad file' err; say $? "a closed standard input"

# --- an existing output is replaced whole or not at all ---
echo precious > kept.pgm
refuses "truncated input, existing output" 1 "too early" gray short.pgm -o kept.pgm
[ "$(cat kept.pgm)" = precious ]; say $? "an existing output is kept when the input is bad"
: > err
( ulimit -f 0; exec "$iris" gray gray.pgm -o kept.pgm ) > out 2> /dev/null
[ $? -eq 1 ] && [ "$(cat kept.pgm)" = precious ]; say $? "an existing output is kept when writing fails"
[ -z "$(ls -A | grep '^\.iris')" ]; say $? "no temporary file remains"
long=$(printf '%0251d.pgm' 0)
works "a name of 255 bytes" gray gray.pgm -o "$long"
works "a name of 255 bytes is replaced" gray gray.pgm -o "$long"
refuses "a name of 256 bytes" 1 'File name too long$' gray gray.pgm -o "0$long"
rm "$long"
if [ "$(id -u)" -ne 0 ]; then
    chmod 444 kept.pgm
    refuses "a write-protected output" 1 '^iris gray: kept.pgm: Permission denied' gray gray.pgm -o kept.pgm
else
    echo "ok - a write-protected output # SKIP root may write it"
fi
chmod 640 kept.pgm
ln -s kept.pgm link.pgm
works "an existing output is replaced" gray gray.pgm -o link.pgm
same "through a link" kept.pgm "$(bytes gray.pgm)"
[ -L link.pgm ] && [ "$(stat -c %a kept.pgm)" = 640 ]; say $? "the link and the permissions stay"
( umask 027; exec "$iris" gray gray.pgm -o fresh.pgm )
[ "$(stat -c %a fresh.pgm)" = 640 ]; say $? "a new file has the permissions of the umask"

# --- progress: on a terminal (works() has seen to it that a pipe is silent) ---
if command -v script > /dev/null; then
    timeout 30 script -qec "'$iris' gray gray.pgm color.ppm -o folder" /dev/null > out 2> err < /dev/null
    grep -q 'gray 1/2 gray.pgm' out; say $? "progress on a terminal"
    timeout 30 script -qec "'$iris' gray gray.pgm" /dev/null > out 2> err < /dev/null
    grep -q 'no output' out; say $? "no picture is written to a terminal"
else
    echo "ok - progress on a terminal # SKIP no script(1)"
fi

# --- real pictures ---
if [ -d "$data/line/black_tape" ]; then
    works "all frames of black_tape" info "$data/line/black_tape"
    [ "$(grep -c 'BMP 320x240, 24 bits, color' out)" -eq 11 ]; say $? "11 frames of 320x240"
    mkdir masks
    works "adaptive masks of black_tape" threshold --adaptive 60,15 --invert "$data/line/black_tape" -o masks
    [ "$(ls masks | wc -l)" -eq 11 ]; say $? "11 masks"
else
    echo "ok - frames of black_tape # SKIP no data (IRIS_DATA)"
fi
