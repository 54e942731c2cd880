#!/bin/sh
# iris convert from outside: mirror images, turns, sizes by area, and the raw bytes of cameras. Expected bytes are
# written out.
first_argument=
. tests/outside

bytes() { # bytes FILE : as hexadecimal digits
    od -An -v -tx1 "$1" | tr -d ' \n'
}
same() { # same NAME FILE HEX
    [ "$(bytes "$2")" = "$3" ]
    say $? "$1"
}
# abc / def, in gray, in color (each letter's channels are x, x + 16, x + 32), and as a mask: #.. / ##.
printf 'P5\n3 2\n255\nabcdef' > gray.pgm
printf 'P6\n3 2\n255\naq\201br\202cs\203dt\204eu\205fv\206' > color.ppm
printf 'P5\n3 2\n255\n\377\000\000\377\377\000' > mask.pgm
"$iris" threshold --value 100 mask.pgm -o mask.bmp

# --- flips and turns ---
turned() { # turned OPTIONS HEX-OF-PIXELS WxH
    works "convert $1" convert $1 gray.pgm -o out.pgm
    same "convert $1, pixels" out.pgm "50350a$(printf '%s' "$3" | sed 's/x/ /' | od -An -tx1 | tr -d ' \n')0a3235350a$2"
}
turned "--flip horizontal" 636261666564 3x2
turned "--flip vertical" 646566616263 3x2
turned "--turn 180" 666564636261 3x2
turned "--turn 90" 646165626663 2x3
turned "--turn 270" 636662656164 2x3
turned "--flip horizontal --turn 90" 666365626461 2x3
turned "--turn 90 --flip vertical" 616462656366 2x3
turned "--flip horizontal --turn 180" 646566616263 3x2
turned "--flip vertical --turn 270" 666365626461 2x3
turned "--crop 1,0,2,2 --turn 90" 65626663 2x2
works "a turn of color" convert --turn 90 color.ppm -o out.ppm
same "a turn of color, pixels" out.ppm 50360a3220330a3235350a647484617181657585627282667686637383
works "a turn of a mask" convert --turn 90 mask.bmp -o out.bmp
[ "$(bytes out.bmp | tail -c 24)" = 0000000080000000c0000000 ]; say $? "a turn of a mask, pixels from the bottom: .. #. ##"
works "a turn in a pipe" pipe "gray | convert --turn 180" color.ppm -o out.pgm
works "a turn of a mask and everything else" convert --crop 0,0,2,2 --flip vertical --turn 90 --resize 4x4 --area \
    --format rgb mask.bmp -o out.ppm

# --- sizes by area: abc / def is 97 98 99 / 100 101 102 ---
works "--area" convert --resize 1x1 --area gray.pgm -o out.pgm
same "--area, 99.5 rounded up" out.pgm 50350a3120310a3235350a64
works "--area to two columns" convert --resize 2x1 --area gray.pgm -o out.pgm
same "--area to two columns, 98.83 and 100.17" out.pgm 50350a3220310a3235350a6364

# --- raw bytes ---
raw() { # raw FORMAT:WxH HEX-OF-PIXELS PRINTF-TEXT
    printf "$3" > raw
    works "--raw $1" convert --raw "$1" raw -o out.pnm
    [ "$(bytes out.pnm | tail -c ${#2})" = "$2" ]; say $? "--raw $1, pixels"
}
raw gray:2x2 01020304 '\001\002\003\004'
[ "$(bytes out.pnm)" = 50350a3220320a3235350a01020304 ]; say $? "raw gray is gray"
raw rgb:2x1 010203040506 '\001\002\003\004\005\006'
[ "$(bytes out.pnm)" = 50360a3220310a3235350a010203040506 ]; say $? "raw color is color"
raw bgr:2x1 030201060504 '\001\002\003\004\005\006'
raw rgba:2x1 010203050607 '\001\002\003\004\005\006\007\010'
raw rgb565:2x1 ff00000000ff '\000\370\037\000'
raw rgb565-be:2x1 ff00000000ff '\370\000\000\037'
raw yuyv:2x1 000000ffffff '\020\200\353\200'
raw uyvy:2x1 000000ffffff '\200\020\200\353'
raw nv12:2x2 000000ffffffffffff000000 '\020\353\353\020\200\200'
raw nv12:4x2 000000ffffffff0000ff0000ffffff000000ff0000ff0000 '\020\353\121\121\353\020\121\121\200\200\132\360'
# One color behind each filter: red 10, green 20, blue 30.
raw bayer-rggb:2x2 0a141e0a141e0a141e0a141e '\012\024\024\036'
raw bayer-grbg:2x2 0a141e0a141e0a141e0a141e '\024\012\036\024'
raw bayer-gbrg:2x2 0a141e0a141e0a141e0a141e '\024\036\012\024'
raw bayer-bggr:2x2 0a141e0a141e0a141e0a141e '\036\024\024\012'
printf '\020\200\353\200\353\200\020\200' | "$iris" convert --raw yuyv:2x1 --format gray - -o - 2> err | "$iris" info - > out
[ "$(cut -d' ' -f2,3 out | tr '\n' ' ')" = "BMP 2x1, BMP 2x1, " ] && [ ! -s err ]; say $? "a stream of raw frames"
printf '\020\200\353\200' > raw
works "raw frames through a pipe" pipe --raw yuyv:2x1 "gray | threshold --value 128" raw -o out.pgm
same "raw frames through a pipe, pixels" out.pgm 50350a3220310a3235350a00ff
works "a frame from the file that holds two" convert --raw yuyv:2x1 --json raw -o out.ppm
grep -q '"width":2,"height":1,"kind":"color"' out; say $? "raw frames in JSON"
refuses "a frame cut short" 1 "^iris convert: raw: ends too early" convert --raw yuyv:2x2 raw -o no.ppm
: > empty
refuses "no frame" 1 "^iris convert: empty: is empty" convert --raw yuyv:2x2 empty -o no.ppm
refuses "3 GiB of raw pixels" 1 "more than 1 GiB" convert --raw rgb:32767x32767 raw -o no.ppm
[ -z "$(ls no.* 2> /dev/null)" ]; say $? "no output file remains after a failure"

# --- wrong calls ---
for wrong in "--flip up" "--flip" "--turn 45" "--turn 0" "--turn 90.0" "--area" "--resize 2x2 --area --nearest" \
    "--raw yuyv" "--raw yuyv:3x2" "--raw nv12:2x3" "--raw yuy:2x2" "--raw :2x2" "--raw yuyv:0x2" "--raw yuyv:40000x2" \
    "--raw yuyv:2x2x2"; do
    refuses "convert $wrong" 2 "^iris convert: " convert $wrong gray.pgm -o no.pgm
done
refuses "--raw within a pipe" 2 "^iris pipe: convert: --raw: .*before" pipe "convert --raw gray:1x1" gray.pgm -o no.pgm
refuses "--raw before a pipe, wrong" 2 "^iris pipe: --raw: " pipe --raw gray:1 "gray" gray.pgm -o no.pgm
