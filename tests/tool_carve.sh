#!/bin/sh
# Carving from outside: cameras and silhouettes in, a cloud of points and figures out.
first_argument=carve
. tests/outside

# Cameras 1000 away along z, x, and y, 200 pixels for 2 units: a rectangle each, of 100 x 60, in the middle of 200 x 200.
awk 'BEGIN { k = "100000 0 99.5 0 100000 99.5 0 0 1"; print 3
    print "top.png", k, "1 0 0 0 1 0 0 0 1", "0 0 1000"
    print "side.png", k, "0 1 0 0 0 1 1 0 0", "0 0 1000"
    print "side2.png", k, "0 0 1 1 0 0 0 1 0", "0 0 1000" }' > cameras.txt
rectangle() { # rectangle W H : white in the middle of a black PGM
    awk -v w="$1" -v h="$2" 'BEGIN { printf "P5 200 200 255\n"
        for (y = 0; y < 200; y++) for (x = 0; x < 200; x++)
            printf "%s", (x >= 100 - w / 2 && x < 100 + w / 2 && y >= 100 - h / 2 && y < 100 + h / 2 ? "~" : "!") }' > plain.pgm
    "$iris" threshold --value 64 plain.pgm -o "$3"
}
rectangle 100 60 top_mask.bmp  # x, y
rectangle 60 80 side_mask.bmp  # y, z
rectangle 80 100 side2_mask.bmp # z, x
box=--box=-1,-1,-1,1,1,1

works "carve" cameras.txt side2_mask.bmp top_mask.bmp side_mask.bmp $box --voxels 20 -o model.ply
grep -q '^cameras.txt: 3 views by name, 480 of 20x20x20 voxels left, 288 at the surface$' out; say $? "what is left"
grep -q '^  from -0.5 -0.3 -0.4 to 0.5 0.3 0.4$' out; say $? "where it is"
[ "$(sed -n 3p model.ply)" = "element vertex 288" ] && [ "$(wc -l < model.ply)" -eq 295 ] && grep -q '^-0.450000000 -0.250000000 -0.350000000$' model.ply
say $? "a PLY file"
works "-o -" cameras.txt side2_mask.bmp top_mask.bmp side_mask.bmp $box --voxels 20 -o -
cmp -s out model.ply; say $? "the model on standard output alone"
works "--json" cameras.txt top_mask.bmp side_mask.bmp $box --voxels 20 --json
grep -qx '{"counts":\[20,20,20\],"views":2,"matched":"name","photos":0,"removed":0,"rounds":0,"voxels":480,"surface":[0-9]*,"pieces":1,"largest":480,"box":\[-0.5,-0.3,-0.4,0.5,0.3,0.4\]}' out
say $? "its figures"
mkdir ordered; cp top_mask.bmp ordered/1.bmp; cp side_mask.bmp ordered/2.bmp; cp side2_mask.bmp ordered/3.bmp
works "a folder, by order" cameras.txt ordered --box=-1,-1,-1,1,1,0 --voxels 20 --json
grep -q '"counts":\[20,20,10\],"views":3,"matched":"order",.*"voxels":240,' out; say $? "voxels are cubes"
rectangle 0 0 top_black.bmp
works "an empty silhouette" cameras.txt top_black.bmp $box --voxels 8 --json
grep -q '"voxels":0,"surface":0,"pieces":0,"largest":0,"box":null}' out; say $? "leaves nothing"

# A third of a turn to the side of the camera above: two views of the same gray, or not.
awk 'BEGIN { k = "100000 0 99.5 0 100000 99.5 0 0 1"; print 2
    print "top.png", k, "1 0 0 0 1 0 0 0 1", "0 0 1000"
    print "tilted.png", k, "1 0 0 0 0.8 0.6 0 -0.6 0.8", "0 0 1000" }' > two.txt
mkdir agree differ
printf 'P5 1 1 255\n2' | "$iris" convert --resize 200x200 - -o agree/top.pgm
cp agree/top.pgm agree/tilted.pgm; cp agree/top.pgm differ/top.pgm
"$iris" negative agree/top.pgm -o differ/tilted.pgm
works "photos that agree" two.txt top_mask.bmp --photos agree $box --voxels 20 -o points.ply --mesh mesh.ply --json
grep -q '"photos":2,"removed":0,"rounds":1,"voxels":1200,' out; say $? "take nothing away"
grep -q '^property uchar blue$' points.ply && grep -q ' 50 50 50$' points.ply; say $? "points have their color"
grep -q '^element face [1-9]' mesh.ply && grep -q ' 50 50 50$' mesh.ply && grep -q '^3 [0-9]* [0-9]* [0-9]*$' mesh.ply
say $? "a mesh has it, too"
works "photos that differ" two.txt top_mask.bmp --photos differ/top.pgm differ/tilted.pgm $box --voxels 20
grep -q '^  2 photos took [1-9][0-9]* away' out; say $? "take away"
works "a difference that is let pass" two.txt top_mask.bmp --photos differ --levels 255 $box --voxels 20
grep -q '^  2 photos took 0 away' out; say $? "takes nothing"
works "photos without silhouettes" two.txt $box --voxels 8 --json --photos agree
grep -q '"views":0,"matched":"name","photos":2,"removed":0,' out; say $? "are enough"
works "a mesh without photos" cameras.txt top_mask.bmp side_mask.bmp $box --voxels 20 --mesh plain.ply
grep -q '^element face' plain.ply && ! grep -q uchar.red plain.ply; say $? "has no colors"
{ printf 'P5 200 200 255\n'; awk 'BEGIN { for (i = 0; i < 40000; i++) printf "%s", ((i % 200 < 60 || i % 200 > 140) && i % 200 > 40 && i % 200 < 160 ? "~" : "!") }'; } > two.pgm
"$iris" threshold --value 64 two.pgm -o top_two.bmp
works "two pieces" cameras.txt top_two.bmp $box --voxels 20
grep -q '^  2 pieces, the largest of 800 voxels$' out && grep -q '^  from -0.6 -1 -1 to -0.4 1 1$' out; say $? "the box is that of one"
works "--help" --help
grep -q -- '--voxels N' out; say $? "its options"

sed 's/^tilted.*/tilted.png 1 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 0 1 0 0 9/' two.txt > flat.txt
cp agree/top.pgm other.pgm
"$iris" convert --resize 100x100 differ/top.pgm -o top_small.pgm
refuses "a photo of another size" 1 'top_small.pgm: 100x100 pixels, but its silhouette has 200x200' two.txt top_mask.bmp --photos top_small.pgm $box
refuses "no photo" 2 'photos: is given once, with pictures' two.txt top_mask.bmp $box --photos
refuses "--photos twice" 2 'photos: is given once' two.txt top_mask.bmp $box --photos agree --photos differ
refuses "levels out of range" 2 'levels' two.txt top_mask.bmp $box --photos agree --levels 256
refuses "a mesh on standard output" 2 'mesh: a file' two.txt top_mask.bmp $box --mesh -
refuses "a photo of no camera" 1 'other.pgm' two.txt top_mask.bmp $box --photos agree/top.pgm other.pgm
refuses "cameras that are none" 1 'flat.txt: line 3: camera 2 of 2 .tilted.png.: K is to be fx s u0' flat.txt top_mask.bmp $box --photos agree
refuses "no silhouette" 2 'CAMERAS and a SILHOUETTE' cameras.txt $box
refuses "no box" 2 'box: x0,y0,z0' cameras.txt top_mask.bmp
refuses "a box of five numbers" 2 'box: x0,y0,z0' cameras.txt top_mask.bmp --box=0,0,0,1,1
refuses "a box inside out" 2 'box: x0,y0,z0' cameras.txt top_mask.bmp --box=0,0,0,1,-1,1
refuses "no voxels" 2 'voxels' cameras.txt top_mask.bmp $box --voxels 0
refuses "too many voxels" 2 'voxels' cameras.txt top_mask.bmp $box --voxels 1025
refuses "two things on standard output" 2 'only' cameras.txt top_mask.bmp $box --json -o -
refuses "one camera twice" 1 'top_black.bmp: top_mask.bmp is of the same camera: top.png' cameras.txt top_mask.bmp top_black.bmp $box
cp top_mask.bmp other.bmp
refuses "a name of no camera" 1 'other.bmp: named after no camera' cameras.txt other.bmp side_mask.bmp $box
refuses "an order that does not fit" 1 'cameras.txt: 3 cameras, but 1 silhouette' cameras.txt other.bmp $box
refuses "no camera file" 1 'none.txt' none.txt top_mask.bmp $box
echo 3 > short.txt
refuses "a camera file that ends early" 1 'short.txt: camera 1 of 3: its name is missing' short.txt top_mask.bmp $box
sed 's/ 1000$//' cameras.txt > fewer.txt
refuses "a number too few" 1 'fewer.txt: camera 1 of 3 .top.png.: expected are 21 numbers' fewer.txt top_mask.bmp $box
(cat cameras.txt; echo more) > more.txt
refuses "more behind the end" 1 'more.txt: more stands behind' more.txt top_mask.bmp $box
refuses "text for a camera file" 1 'first line is to say how many' top_mask.bmp top_mask.bmp $box
sed '3s/ 0 1 0 0 0 1 1 0 0 / 0 0 0 0 0 0 0 0 0 /' cameras.txt > nothing.txt
refuses "a rotation of zeros" 1 'nothing.txt: line 3: camera 2 of 3 .side.png.: R is no rotation' nothing.txt top_mask.bmp $box
sed '2s/ 1 0 0 0 1 0 0 0 1 / 1 0 0 0 1 0 0 0 -1 /' cameras.txt > mirror.txt
refuses "a mirror" 1 'mirror.txt: line 2: camera 1 of 3 .top.png.: R is no rotation' mirror.txt top_mask.bmp $box
sed '2s/ 1 0 0 0 1 0 0 0 1 / 1 0 0 0 0.997 0.07 0 -0.07 0.997 /' cameras.txt > long.txt
refuses "rows that are too long" 1 'long.txt: line 2: .*R is no rotation' long.txt top_mask.bmp $box
sed '2s/ 1 0 0 0 1 0 0 0 1 / 1 0 0 0 0.9976 0.07 0 -0.07 0.9976 /' cameras.txt > rounded.txt
works "a rotation that is rounded" rounded.txt top_mask.bmp $box --voxels 20
sed '4s/ 100000 / 0 /' cameras.txt > blind.txt
refuses "no focal length" 1 'blind.txt: line 4: camera 3 of 3 .side2.png.: focal lengths' blind.txt top_mask.bmp $box
sed 's/ 1000$/ -1000/' cameras.txt > behind.txt
refuses "cameras that look away" 1 'behind.txt: no view shows any of the box' behind.txt side2_mask.bmp top_mask.bmp side_mask.bmp $box
refuses "a box that no camera sees" 1 'cameras.txt: no view shows any of the box' cameras.txt top_mask.bmp --box=5,5,5,6,6,6 -o never.ply
[ ! -e never.ply ]; say $? "writes nothing"
refuses "the same by photos" 1 'two.txt: no view shows any of the box' two.txt --box=5,5,5,6,6,6 --photos agree
"$iris" convert --resize 2x2 top_mask.bmp -o top_tiny.bmp
refuses "a silhouette of a corner" 1 "no view shows any" cameras.txt top_tiny.bmp --box=-0.5,-0.5,-0.5,0.5,0.5,0.5
sed '2s/ 1000$/ -1000/' cameras.txt > one.txt
run one.txt side2_mask.bmp top_mask.bmp side_mask.bmp $box --voxels 20
[ $code -eq 0 ] && [ "$(wc -l < err)" -eq 1 ] && grep -q 'top_mask.bmp: warning: by its camera (top.png) it shows nothing' err
say $? "a view that looks away is named"
{ printf 'P5 200 200 255\n'; awk 'BEGIN { for (i = 0; i < 40000; i++) printf "%c", 33 + i % 90 }'; } > top_gray.pgm
refuses "a photograph as a silhouette" 1 'top_gray.pgm: a silhouette is black and white.*iris threshold' cameras.txt top_gray.pgm $box
refuses "no picture" 1 'top_text' cameras.txt top_text $box
refuses "a folder that is not there" 1 'nowhere/m.ply' cameras.txt top_mask.bmp $box --voxels 8 -o nowhere/m.ply

if [ -d "$data/carve/dinoSparseRing" ]; then
    works "a dinosaur" "$data/carve/dinoSparseRing/dinoSR_par.txt" "$data"/carve/dinoSparseRing/*_sil.bmp --box=-0.07,-0.03,-0.07,0.02,0.08,0.025 --json
    grep -q '"counts":\[90,110,95\],"views":16,"matched":"name",.*"voxels":12[0-9]*,' out; say $? "its voxels"
else
    echo "ok - a dinosaur # SKIP no data (IRIS_DATA)"
fi
