#!/bin/sh
# Convolution, blurs, median, and unsharp mask from outside. Pictures are made by hand here; expected bytes are written out.
first_argument=
. tests/outside

same() { # same NAME FILE HEX
    [ "$(od -An -v -tx1 "$2" | tr -d ' \n')" = "$3" ]
    say $? "$1"
}
square=50350a3320330a3235350a # P5 3 3 255
wide=50350a3520350a3235350a   # P5 5 5 255
printf 'P5\n3 3\n255\n\000\020\040\000\020\040\000\020\041' > ramp.pgm
printf 'P5\n5 5\n255\n\0\0\0\0\0\0\0\0\0\0\0\0\001\0\0\0\0\0\0\0\0\0\0\0\0' > dot.pgm
printf 'P6\n3 1\n255\n\012\310\036\012\310\036\377\000\000' > color.ppm

# --- convolve ---
works "convolve" convolve --mask "3 3 1 2 1 2 4 2 1 2 1 / 16" ramp.pgm -o out.pgm
same "convolve, pixels" out.pgm ${square}04101c04101c04101d
works "a dot becomes the mask" convolve --mask "2 3 1 2 3 4 5 6" dot.pgm -o out.pgm
same "a dot becomes the mask, pixels" out.pgm ${wide}00000000000001020300000405060000000000000000000000
works "a dot by correlation" convolve --mask "2 3 1 2 3 4 5 6" --correlate dot.pgm -o out.pgm
same "a dot by correlation, pixels" out.pgm ${wide}00000000000006050400000302010000000000000000000000
works "negative values become black" convolve --mask "1 3 -1 0 1" --correlate ramp.pgm -o out.pgm
same "negative values become black, pixels" out.pgm ${square}102010102010102111
works "convolution turns them" convolve --mask "1 3 -1 0 1" ramp.pgm -o out.pgm
same "convolution turns them, pixels" out.pgm ${square}000000000000000000
works "--absolute" convolve --mask "1 3 -1 0 1" --absolute ramp.pgm -o out.pgm
same "--absolute, pixels" out.pgm ${square}102010102010102111
works "--signed" convolve --mask "1 3 -1 0 1" --signed ramp.pgm -o out.pgm
same "--signed, pixels" out.pgm ${square}787078787078787078
works "--bias" convolve --mask "1 1 1 / 2" --bias -3 ramp.pgm -o out.pgm
same "--bias, pixels" out.pgm ${square}00050d00050d00050e
works "--border skip" convolve --mask "1 3 1 1 1" --border skip ramp.pgm -o out.pgm
same "--border skip, pixels" out.pgm ${square}003020003020003121
works "--border skip, signed" convolve --mask "3 1 1 0 1" --border skip --signed ramp.pgm -o out.pgm
same "--border skip, signed, pixels" out.pgm ${square}0010208090a1001021
works "--border constant" convolve --mask "1 3 0 0 1" --correlate --border constant:9 ramp.pgm -o out.pgm
same "--border constant, pixels" out.pgm ${square}102009102009102109
works "--roi" convolve --mask "1 1 2" --roi 1,1,2,2 ramp.pgm -o out.pgm
same "--roi, pixels" out.pgm ${square}001020002040002042
works "each channel" convolve --mask "1 3 1 1 0" --correlate --border constant color.ppm -o out.ppm
same "each channel, pixels" out.ppm 50360a3320310a3235350a0ac81e14ff3cffc81e
works "each channel, signed" convolve --mask "1 3 -1 1 0" --correlate --border constant --signed color.ppm -o out.ppm
same "each channel, signed, pixels" out.ppm 50360a3320310a3235350a85e48f808080fb1c71
works "--lightness of gray" convolve --mask "1 1 1 / 2" --lightness ramp.pgm -o out.pgm
same "--lightness of gray, pixels" out.pgm ${square}000810000810000811
works "--lightness keeps what it must" convolve --mask "1 3 0 1 0" --lightness --border skip color.ppm -o out.ppm
[ "$(od -An -v -tx1 out.ppm | tr -d ' \n' | cut -c23-28,35-40)" = 0ac81eff0000 ]; say $? "pixels that are not evaluated"
works "--lightness" convolve --mask "1 1 1 / 2" --lightness color.ppm -o out.ppm
same "--lightness: red gets darker, and stays red" out.ppm "$(od -An -v -tx1 out.ppm | tr -d ' \n' | cut -c1-34)800000"
works "in a pipe" pipe "convolve --mask '1 1 2' | convolve --mask '1 1 1 /2'" ramp.pgm -o out.pgm
same "in a pipe, pixels" out.pgm ${square}001020001020001021
ones=$(i=0; while [ $i -lt 961 ]; do printf ' 1'; i=$((i + 1)); done)
works "the largest mask" convolve --mask "31 31$ones / 961" ramp.pgm -o out.pgm
for wrong in "" "3" "0 3" "3 32 1" "3 3 1 2" "1 1 x" "1 1 1x" "1 1 1 2" "1 1 1 /" "1 1 1 / 0" "1 1 1 / 1 2" "1 1 1 / 4194305" \
    "1 1 8421505" "1 1 99999999999" "-1 1 1" "1 1 1 / 2 /" "1,1,1"; do
    refuses "mask '$wrong'" 2 "^iris convolve: --mask: " convolve --mask "$wrong" ramp.pgm -o no.pgm
done
refuses "no mask" 2 "^iris convolve: no --mask" convolve ramp.pgm -o no.pgm
refuses "a bias too large" 2 "^iris convolve: --mask: too large" convolve --mask "1 1 1 / 1000" --bias 2147484 ramp.pgm -o no.pgm
refuses "no bias" 2 "^iris convolve: --bias: " convolve --mask "1 1 1" --bias 1.5 ramp.pgm -o no.pgm
refuses "two ways to write" 2 "^iris convolve: either" convolve --mask "1 1 1" --absolute --signed ramp.pgm -o no.pgm

# --- blur ---
works "a small sigma changes nothing" blur --sigma 0.2 ramp.pgm -o out.pgm
same "a small sigma changes nothing, pixels" out.pgm ${square}001020001020001021
printf 'P5\n5 1\n255\n\0\0\377\0\0' > line.pgm
works "blur by sigma" blur --sigma 0.8 --border constant line.pgm -o out.pgm
same "blur by sigma, pixels" out.pgm 50350a3520310a3235350a031d3f1d03
works "blur by a box" blur --box 3 ramp.pgm -o out.pgm
same "blur by a box, pixels" out.pgm ${square}05101b05101b05101b
works "blur by an even box" blur --box 2 dot.pgm -o out.pgm
works "blur color" blur --box 3 --border reflect color.ppm -o out.ppm
same "blur color, pixels" out.ppm 50360a3320310a3235350a0ac81e5c85145c8514
refuses "neither sigma nor box" 2 "^iris blur: either" blur ramp.pgm -o no.pgm
refuses "sigma and box" 2 "^iris blur: either" blur --sigma 1 --box 3 ramp.pgm -o no.pgm
for wrong in 0 0.0999 40.1 -1 x ""; do
    refuses "sigma '$wrong'" 2 "^iris blur: --sigma: " blur --sigma "$wrong" ramp.pgm -o no.pgm
done
for wrong in 0 256 3.5 x; do
    refuses "box '$wrong'" 2 "^iris blur: --box: " blur --box "$wrong" ramp.pgm -o no.pgm
done

# --- median ---
works "median" median ramp.pgm -o out.pgm
same "median, pixels" out.pgm ${square}001020001020001020
works "median takes a dot away" median --size 5 dot.pgm -o out.pgm
same "median takes a dot away, pixels" out.pgm ${wide}00000000000000000000000000000000000000000000000000
works "a mask" convert --format mask line.pgm -o mask.bmp
works "median of a mask" median mask.bmp -o out.bmp
[ "$(tail -c 4 out.bmp | od -An -tx1 | tr -d ' ')" = 00000000 ] && "$iris" info out.bmp | grep -q mask
say $? "median of a mask is a mask"
refuses "another size" 2 "^iris median: --size: 3 or 5" median --size 4 ramp.pgm -o no.pgm

# --- unsharp ---
printf 'P5\n8 1\n255\n\144\144\144\144\214\214\214\214' > step.pgm
works "unsharp" unsharp --sigma 0.8 --amount 2 step.pgm -o out.pgm
same "unsharp, pixels" out.pgm 50350a3820310a3235350a64646250a08e8c8c
works "unsharp with a threshold" unsharp --sigma 0.8 --amount 2 --threshold 1 step.pgm -o out.pgm
same "unsharp with a threshold, pixels" out.pgm 50350a3820310a3235350a64646450a08c8c8c
works "more decimals than count" unsharp --sigma 0.800000000000000000001 --amount 2.00000000000 step.pgm -o out.pgm
same "more decimals than count, pixels" out.pgm 50350a3820310a3235350a64646250a08e8c8c
refuses "sigma of unsharp" 2 "^iris unsharp: --sigma: " unsharp --sigma 0 step.pgm -o no.pgm
refuses "amount of unsharp" 2 "^iris unsharp: --amount: " unsharp --amount 17 step.pgm -o no.pgm
refuses "threshold of unsharp" 2 "^iris unsharp: --threshold: " unsharp --threshold 256 step.pgm -o no.pgm

# --- the examples of the help texts, on real pictures ---
for command in convolve blur median unsharp; do
    run $command --help
    example=$(sed -n 's/^example: iris //p' out | sed 's/ [a-z]*\.\(pgm\|bmp\) -o.*//')
    [ -n "$example" ]; say $? "$command has an example"
    [ -f "$data/edges/bsds/3063.bmp" ] || { echo "ok - $command on a real picture # SKIP no data"; continue; }
    eval "works '$command on a real picture' $example '$data/edges/bsds/3063.bmp' -o $command.bmp"
done
