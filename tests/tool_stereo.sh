#!/bin/sh
# Stereo from outside: two pictures in, disparities, a preview, and figures out.
first_argument=stereo
. tests/outside

# dots SHIFT : PGM of 40x20 random dots, from column SHIFT of them on
dots() {
    awk -v shift="$1" 'BEGIN { srand(7)
        printf "P5 40 20 255\n"
        for (y = 0; y < 20; y++) {
            row = ""
            for (x = 0; x < 60; x++) row = row sprintf("%c", 33 + int(rand() * 90))
            printf "%s", substr(row, 1 + shift, 40) } }'
}
dots 0 > left.pgm
dots 3 > right.pgm
echo "this is none" > text
dots 0 | sed '1s/.*/P5 20 40 255/' > turned.pgm

works "disparities" left.pgm right.pgm --method block --max-disparity 8 -o d.pgm --preview seen.bmp
grep -q '^left.pgm: 100.0 % matched, disparities' out; say $? "how many matches"
[ "$(head -3 d.pgm | tr '\n' ' ')" = "P5 40 20 65535 " ] && [ "$(wc -c < d.pgm)" -eq 1615 ]; say $? "a PGM of 16 bits"
[ "$(tail -c 1600 d.pgm | od -An -v -tu1 -w80 | awk '{ for (i = 41; i < 80; i += 2) {
    d = $i * 256 + $(i + 1); n += d > 768 - 128 && d < 768 + 128 } } END { print n }')" = 400 ]
say $? "of 3 pixels"
"$iris" info seen.bmp | grep -q '40x20.*color\|40x20'; say $? "a preview"
works "--json" left.pgm right.pgm --json
grep -q '"method":"semiglobal","width":40,"height":20,"matched":1,"mean":[0-9.]*,"least":[0-9.]*,"most":[0-9.]*}' out
say $? "its figures"
cp d.pgm wanted
works "semi-global" left.pgm right.pgm --method semiglobal --max-disparity 8 -o s.pgm
[ "$(wc -c < s.pgm)" -eq 1615 ] && ! cmp -s s.pgm d.pgm; say $? "another method"
works "a quadtree" left.pgm right.pgm --method quadtree --max-disparity 8 -o q.pgm
[ "$(wc -c < q.pgm)" -eq 1615 ] && ! cmp -s q.pgm d.pgm; say $? "a third method"
works "half the resolution" left.pgm right.pgm --method quadtree --max-disparity 8 --scale 2 -o half.pgm
[ "$(head -3 half.pgm | tr '\n' ' ')" = "P5 20 10 65535 " ]; say $? "its size"
[ "$(tail -c 400 half.pgm | od -An -v -tu1 -w40 | awk '{ for (i = 21; i < 40; i += 2) {
    d = $i * 256 + $(i + 1); n += d > 512 && d < 1024 } } END { print n }')" -gt 75 ]; say $? "its disparities"
works "a sixteenth" left.pgm right.pgm --method quadtree --scale 16 -o least.pgm
[ "$(head -3 least.pgm | tr '\n' ' ')" = "P5 3 2 65535 " ]; say $? "its size"
works "the right picture's" left.pgm right.pgm --method quadtree --max-disparity 8 --of right -o r.pgm
! cmp -s r.pgm q.pgm; say $? "are others"
works "planes" left.pgm right.pgm --method quadtree --max-disparity 8 --planes -o planes.pgm
nothing() { tail -c 1600 "$1" | od -An -v -tu2 -w2 | awk '$1 == 0 { n++ } END { print n + 0 }'; } # places without a match
works "--no-fill" left.pgm right.pgm --method block --max-disparity 8 --no-fill -o open.pgm
[ "$(nothing d.pgm)" -eq 0 ] && [ "$(nothing open.pgm)" -gt 0 ] && grep -q 'left.pgm: [0-9][0-9]*.[0-9] % matched' out && ! grep -q 100.0 out
say $? "leaves places that one camera alone sees"
works "--no-fill, semi-global" left.pgm right.pgm --max-disparity 8 --no-fill -o opens.pgm
[ "$(nothing opens.pgm)" -gt 0 ]; say $? "leaves them, too"
works "--unique" left.pgm right.pgm --method block --max-disparity 8 --no-fill --unique 90 -o unique.pgm
[ "$(nothing unique.pgm)" -gt "$(nothing open.pgm)" ]; say $? "leaves what is doubtful"
works "--speckle" left.pgm right.pgm --method block --max-disparity 8 --speckle 801 -o specks.pgm
[ "$(nothing specks.pgm)" -eq 800 ]; say $? "takes away what is smaller"
# Red at 255 is the largest disparity; 3 of 6 is green, whatever is found.
works "a preview of half" left.pgm right.pgm --method block --max-disparity 6 --preview half.ppm
works "a preview of a little" left.pgm right.pgm --method block --max-disparity 30 --preview little.ppm
middle() { tail -c 2400 "$1" | od -An -v -tu1 -w3 | sed -n 421p; } # the pixel at 20, 10
[ "$(middle half.ppm | awk '{ print ($2 == 255 && $1 < 200 && $3 < 200) }')" = 1 ]; say $? "is green"
[ "$(middle little.ppm | awk '{ print ($3 == 255 && $1 == 0) }')" = 1 ]; say $? "is blue"
works "-o -" left.pgm right.pgm --method block --max-disparity 8 -o -
cmp -s out wanted; say $? "disparities on standard output alone"
works "--help" --help
grep -q -- '--method block|quadtree|semiglobal' out; say $? "its methods"

refuses "one picture" 2 'LEFT RIGHT' left.pgm
refuses "three pictures" 2 'LEFT RIGHT' left.pgm right.pgm left.pgm
refuses "no such method" 2 "method: .*not 'magic'" left.pgm right.pgm --method magic
refuses "no disparities" 2 'max-disparity' left.pgm right.pgm --max-disparity 0
refuses "too many disparities" 2 'max-disparity' left.pgm right.pgm --max-disparity 256
refuses "no such scale" 2 'scale: .*not 3' left.pgm right.pgm --method quadtree --scale 3
refuses "scale of another method" 2 'quadtree' left.pgm right.pgm --scale 2
refuses "--no-fill of a quadtree" 2 'no-fill.*block and semiglobal' left.pgm right.pgm --method quadtree --no-fill
refuses "more than unique" 2 'unique' left.pgm right.pgm --unique 100
refuses "a negative area" 2 'speckle' left.pgm right.pgm --speckle=-1
refuses "one name for two" 2 'same.pgm: is named for two' left.pgm right.pgm -o same.pgm --preview same.pgm
refuses "a scale of no depth" 2 'depth-scale: is of --depth' left.pgm right.pgm --depth-scale 2 --calib none.pair
refuses "scale of depths" 2 'calib: .*scale' left.pgm right.pgm --method quadtree --scale 2 --calib none.pair
refuses "no such side" 2 "of: .*not 'both'" left.pgm right.pgm --method quadtree --of both
refuses "a BMP of 16 bits" 2 'd.bmp: .*pgm' left.pgm right.pgm -o d.bmp
refuses "an unknown preview" 2 'seen.gif' left.pgm right.pgm --preview seen.gif
refuses "two things on standard output" 2 'only' left.pgm right.pgm --json -o -
refuses "sizes that differ" 1 'turned.pgm: 20x40 pixels' left.pgm turned.pgm
refuses "a missing file" 1 'none.pgm' none.pgm right.pgm
refuses "no picture" 1 'text' left.pgm text
refuses "a folder that is not there" 1 'nowhere/d.pgm' left.pgm right.pgm -o nowhere/d.pgm
