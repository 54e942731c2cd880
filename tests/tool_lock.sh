#!/bin/sh
# iris lock from outside: frames with a red square whose place is known.
first_argument=lock
. tests/outside
LC_ALL=C
export LC_ALL

# frame X Y [COLOR] : 64x48 PPM of gray (~), a square of 10 pixels of COLOR (three letters; red: x and two blanks) at X, Y
frame() {
    awk -v left="$1" -v top="$2" -v color="${3:-x  }" 'BEGIN {
        printf "P6 64 48 255\n"
        for (y = 0; y < 48; y++) for (x = 0; x < 64; x++)
            printf "%s", (x >= left && x < left + 10 && y >= top && y < top + 10) ? color : "~~~" }'
}
frame 10 20 > 1.ppm
frame 14 20 > 2.ppm
frame 18 21 > 3.ppm
frame 99 99 > empty.ppm
frame 22 21 > 5.ppm
frame 30 20 "  x" > blue.ppm
field() { # field KEY [LINE] : its value in that line of out
    sed -n "${2:-1}s/.*\"$1\":\([^,}]*\).*/\1/p" out
}
all() { # all KEY : its values in out
    sed "s/.*\"$1\":\([^,}]*\).*/\1/" out | tr -d '"' | tr '\n' ' '
}

number='(null|-?[0-9]+(\.[0-9]+)?)'
object="^\{\"file\":\"[^\"]*\",\"frame\":[0-9]+,\"x\":$number,\"y\":$number,\"w\":$number,\"h\":$number,\"cx\":$number,\"cy\":$number,"
object="$object\"area\":$number,\"id\":$number,\"age\":$number,\"state\":\"(found|lost)\",\"score\":$number\}\$"
well_formed() {
    [ -s out ] && ! grep -Evq "$object" out
}
works "taught" --teach 10,20,10,10 --json 1.ppm 2.ppm 3.ppm empty.ppm 5.ppm
well_formed; say $? "JSON as documented"
[ "$(all state)" = "found found found lost found " ]; say $? "one object for each frame, the first included"
[ "$(all x)" = "10 14 18 null 22 " ] && [ "$(all y)" = "20 20 21 null 21 " ]; say $? "boxes"
[ "$(all w)" = "10 10 10 null 10 " ] && [ "$(all area)" = "100 100 100 null 100 " ]; say $? "sizes"
[ "$(field cx 2)" = 18.5 ] && [ "$(field cy 2)" = 24.5 ]; say $? "centers"
[ "$(all id)" = "1 1 1 1 1 " ] && [ "$(all age)" = "1 2 3 4 5 " ]; say $? "identity and age"
cp out taught
works "by a rectangle that is a little off" --teach 8,21,10,11 --json 1.ppm 2.ppm 3.ppm
[ "$(all cx)" = "14.5 18.5 22.5 " ]; say $? "the same places"
works "by its color" --signature hsl:350-10,50-70,20-40 --json 1.ppm 2.ppm 3.ppm empty.ppm 5.ppm
cmp -s out taught; say $? "the same by its color"
works "colons, too" --signature=hsl:350-10:50-70:20-40 --json 1.ppm 2.ppm 3.ppm empty.ppm 5.ppm
cmp -s out taught; say $? "the same with colons"
[ "$(all frame)" = "1 2 3 4 5 " ] && [ "$(field score)" = 1 ] && [ "$(field score 4)" = null ]; say $? "numbers and scores"
works "nothing of that color" --signature hsl:90-150,50-100,20-70 --json 1.ppm blue.ppm
[ "$(all state)" = "lost lost " ] && [ "$(all id)" = "null null " ] && well_formed; say $? "nothing yet"
works "another color is not it" --teach 10,20,10,10 --json 1.ppm blue.ppm
[ "$(all state)" = "found lost " ]; say $? "blue is not red"
works "text" --teach 10,20,10,10 1.ppm empty.ppm
[ "$(wc -l < out)" -eq 2 ] && grep -q '^1.ppm  found  at 14.5,24.5  box 10,20,10,10  area 100  id 1  age 1' out &&
    grep -q '^empty.ppm  lost   near 14.5,24.5 for 1  id 1  age 2' out
say $? "text: one line per frame"

# --- folders and streams ---
mkdir frames
cp 1.ppm 2.ppm 3.ppm frames
works "a folder" --teach 10,20,10,10 --json frames
[ "$(all x)" = "10 14 18 " ] && [ "$(field file 2)" = '"frames/2.ppm"' ]; say $? "a folder in the order of its names"
cat 1.ppm 2.ppm 3.ppm | timeout 30 "$iris" lock --teach 10,20,10,10 --json -o stream - > out 2> err
[ $? -eq 0 ] && [ "$(all x)" = "10 14 18 " ] && [ "$(all frame)" = "1 2 3 " ]; say $? "a stream"
[ "$(ls stream | tr '\n' ' ')" = "frame_00001.bmp frame_00002.bmp frame_00003.bmp " ]; say $? "overlays of a stream"
works "overlays" --teach 10,20,10,10 --json -o seen frames empty.ppm
[ "$(ls seen | tr '\n' ' ')" = "1.bmp 2.bmp 3.bmp empty.bmp " ] &&
    "$iris" info seen/1.bmp | grep -q 320x240; say $? "overlays: a picture of each frame, enlarged"

# --- a part is taught ---
run --teach 13,23,4,4 --json 1.ppm 2.ppm
[ $code -eq 0 ] && [ "$(all w)" = "10 10 " ] && [ "$(wc -l < err)" -eq 1 ] &&
    grep -q 'the color goes on outside the rectangle: locked on to 10,20,10,10' err; say $? "a part is taught: all of it"

# --- what is wrong ---
for picture in one.bmp one.PPM; do
    refuses "a picture for all frames ($picture)" 2 "a folder for the pictures of all frames, not '$picture'" \
        --teach 10,20,10,10 -o $picture 1.ppm
    [ ! -e $picture ]; say $? "no folder $picture"
done
refuses "no object" 2 'one of them' 1.ppm
refuses "two ways" 2 'one of them' --teach 1,2,3,4 --signature hsl:0-10,0-10,0-10 1.ppm
refuses "no input" 2 'no input' --teach 1,2,3,4
refuses "a rectangle outside" 2 'not wholly inside of 1.ppm .64x48' --teach 60,20,10,10 1.ppm 2.ppm
refuses "no rectangle" 2 'x,y,w,h in pixels' --teach 1,2,3 1.ppm
refuses "no color" 2 'hsl:H0-H1,S0-S1,L0-L1' --signature red 1.ppm
refuses "half a color" 2 'whole numbers' --signature hsl:0-10,0-10 1.ppm
refuses "a bad hue" 2 '0 to 360' --signature hsl:0-400,0-10,0-10 1.ppm
refuses "a bad saturation" 2 'saturation' --signature hsl:0-40,20-10,0-10 1.ppm
refuses "no first frame" 1 'missing.ppm' --teach 1,2,3,4 missing.ppm 2.ppm
run --teach 10,20,10,10 --json 1.ppm missing.ppm 2.ppm
[ $code -eq 1 ] && [ "$(all x)" = "10 14 " ] && [ "$(wc -l < err)" -eq 1 ]; say $? "a frame that is missing: the others go on"
"$iris" convert --resize 32x24 2.ppm -o small.ppm
run --teach 10,20,10,10 --json 1.ppm small.ppm 2.ppm
[ $code -eq 1 ] && grep -q 'small.ppm: 32x24 pixels, but the frames before have 64x48' err && [ "$(all x)" = "10 14 " ]
say $? "a frame of another size: the others go on"
