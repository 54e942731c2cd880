#!/bin/sh
# A team of robots in a simulated world, from outside: how it ends, where everybody went, and what they told each other.
here=$PWD
first_argument=swarm
. tests/outside

scripts=$here/examples/scripts worlds=$here/examples/worlds robots=$here/examples/robots
line="-2600 -1400 -400 -1400 100 -1250 500 -900 700 -400 700 400 500 900 100 1250 -200 1400" # of the room that is built in
object="1900 500"

# Of the JSON in out: team.txt (ref unit state x y), path.txt (ref unit seconds x y), signals.txt (seconds ref unit signal from
# from_unit x y, - where there is none).
take_apart() {
    sed 's/^{"robots":\[//; s/\],"time_s".*//; s/},{"unit"/}\n{"unit"/g' out > robots.json
    sed -E 's/.*"unit":([0-9]+),"ref":([0-9]+),"state":"([a-z ]+)","x_mm":(-?[0-9]+),"y_mm":(-?[0-9]+),.*/\2 \1 \3 \4 \5/' robots.json > team.txt
    step=$(sed -E 's/.*"path_step_s":([0-9.]+).*/\1/' out)
    sed -E 's/.*"unit":([0-9]+),"ref":([0-9]+),.*"path":\[(.*)\]\}/\2 \1 \3/; s/\],\[/ /g; s/[][]//g' robots.json |
        awk -v step="$step" '{ for (i = 3; i <= NF; i++) { split($i, at, ","); print $1, $2, (i - 3) * step, at[1], at[2] } }' > path.txt
    sed 's/.*"signals":\[//; s/\]}$//; s/},{/}\n{/g' out | sed -E 's/"x_mm":(-?[0-9]+),"y_mm":(-?[0-9]+),/& \1 \2 /
        s/.*"at_s":([0-9.]+),"unit":([0-9]+),"ref":([0-9]+),"from":([0-9]+),"from_unit":([0-9]+),(.*"y_mm":[-0-9]+, (-?[0-9]+) (-?[0-9]+) )?"signal":"([A-Z_]+)"\}/\1 \3 \2 \9 \4 \5 \7 \8/' > signals.txt
}
# How far the path of ref unit is from the polyline X Y X Y ... at most until a time, in mm.
off_line() { # off_line REF UNIT UNTIL "X Y X Y ..."
    awk -v ref="$1" -v unit="$2" -v until="$3" -v line="$4" '
        function off(x, y, x0, y0, x1, y1,   dx, dy, t) {
            dx = x1 - x0; dy = y1 - y0; t = dx * dx + dy * dy > 0 ? ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy) : 0
            t = t < 0 ? 0 : t > 1 ? 1 : t; x -= x0 + t * dx; y -= y0 + t * dy; return sqrt(x * x + y * y) }
        BEGIN { n = split(line, p, " ") }
        $1 == ref && $2 == unit && $3 <= until { least = 1e9
            for (i = 1; i + 3 <= n; i += 2) { d = off($4, $5, p[i], p[i + 1], p[i + 2], p[i + 3]); least = d < least ? d : least }
            most = least > most ? least : most; sum += least; count++ }
        END { printf "%d %d %d\n", most, count ? sum / count : -1, count }' path.txt
}

# The report's example: told by its end, its paths, and its signals.
explores() { # explores NAME OPTION...
    what=$1; shift
    works "$what" "$scripts/explore.borg" --simulate --json "$@"
    take_apart
    [ "$(cut -d ' ' -f 1,2 team.txt | tr '\n' ,)" = "10 1,20 1,20 2,20 3,20 4," ]; say $? "$what: five robots"
    seen=$(awk '$2 == 10 && $4 == "OBJ_DETECT_TRUE" { print $1; exit }' signals.txt)
    [ -n "$seen" ] && off_line 10 1 "$seen" "$line" > off && awk '{ exit !($1 <= 60 && $3 > 10) }' off
    say $? "$what: unit 1 keeps to its line (mm off it at most, on the average: $(cut -d ' ' -f 1,2 off)) until it sees the object ($seen s)"
    [ "$(awk '$2 == 20 && $4 == "OBJ_DETECT_TRUE" && $5 == 10 && $6 == 1 { print $3 }' signals.txt | sort -u | wc -l)" -eq 4 ]
    say $? "$what: all four are told"
    [ "$(awk '$4 == "VOTE_WIN" { print $3 }' signals.txt | sort | uniq -c | awk '{ print $1 }' | tr '\n' ,)" = "1,1," ]
    say $? "$what: exactly two are chosen, once each"
    # Those two are the nearest where they were then; bids are of a moment's difference, in which a robot moves.
    awk -v seen="$seen" -v object="$object" 'BEGIN { split(object, o, " ") }
        FNR == NR { if ($4 == "VOTE_WIN") won[$3] = 1; next }
        $1 == 20 && $3 <= seen { far[$2] = sqrt(($4 - o[1]) ^ 2 + ($5 - o[2]) ^ 2) }
        END { for (u in far) { if (u in won) { most = far[u] > most ? far[u] : most } else if (least == "" || far[u] < least) least = far[u] }
              printf "%d %d\n", most, least; exit !(most < least + 250) }' signals.txt path.txt > distances
    say $? "$what: the nearest two (the farther one and the nearest other: $(cat distances) mm)"
    awk -v object="$object" 'BEGIN { split(object, o, " ") }
        FNR == NR { if ($4 == "VOTE_WIN") won[$3] = 1; next }
        $1 == 20 && $2 in won { n++; d = sqrt(($4 - o[1]) ^ 2 + ($5 - o[2]) ^ 2); far = d > far ? d : far; bad += $3 != "reached" || d > 500 }
        ($1 == 10 || !($2 in won)) && $3 != "stopped" { bad++ }
        END { printf "%d\n", far; exit !(n == 2 && !bad) }' signals.txt team.txt > far
    say $? "$what: both reach it (within $(cat far) mm), and all others are stopped"
    awk '$4 == "TIME_OUT" { out[$2 " " $3] = $1 } $4 == "START" { n++ } $4 == "OBJ_DETECT_TRUE" && $2 == 10 && !s { s = $1 }
        END { for (r in out) { m++; bad += r == "10 1" && (out[r] < s + 59.9 || out[r] > s + 60.5) } exit !(n == 5 && m == 5 && !bad) }' signals.txt
    say $? "$what: every one is timed out, 60 s after its clock was reset"
    awk '{ r = $1 " " $2; if (r != was) { was = r; n = 0 } x[r, n] = $4; y[r, n++] = $5; last[r] = n - 1 }
        END { for (r in last) { k = last[r]; bad += k < 6 || x[r, k] != x[r, k - 6] || y[r, k] != y[r, k - 6] } exit bad }' path.txt
    say $? "$what: and stands"
}
for seed in 1 2 3; do explores "explore, seed $seed" --seed $seed; done
for seed in 1 4 5 6; do explores "explore with 30 % lost, seed $seed" --seed $seed --loss 30; done
explores "explore with half of all lost" --seed 7 --loss 50

# The same seed is the same run, and what changes the script changes what they do.
works "a run" "$scripts/explore.borg" --simulate --json --loss 30; mv out first
works "the same again" "$scripts/explore.borg" --simulate --json --loss 30
cmp -s first out; say $? "the same seed is the same run, bit for bit"
works "another seed" "$scripts/explore.borg" --simulate --json --loss 30 --seed 2
cmp -s first out; [ $? -eq 1 ]; say $? "another seed is another run"
sed 's/UNITS(2 OF 4)/UNITS(3 OF 4)/' "$scripts/explore.borg" > three.borg
works "three of four" three.borg --simulate --json
take_apart
[ "$(awk '$4 == "VOTE_WIN" { print $3 }' signals.txt | sort -u | wc -l)" -eq 3 ]; say $? "then three are chosen"
sed '/^030/,/^060/d' "$scripts/explore.borg" > nobody.borg
works "nobody goes" nobody.borg --simulate --json --timeout 20
take_apart
[ "$(awk '$3 == "stopped"' team.txt | wc -l)" -eq 5 ] && ! grep -q VOTE signals.txt; say $? "where no line says so, nobody goes"
grep -Eq '"time_s":(2[0-9]|3[0-9])[.,]' out; say $? "--timeout is the script's"

works "patrol" "$scripts/patrol.borg" --simulate --world "$worlds/patrol.world" --json
take_apart
[ "$(wc -l < team.txt)" -eq 5 ]; say $? "five robots patrol"
awk '$4 == "VOTE_WIN" { n++; if (!at) at = $1 } $4 == "OBJ_DETECT_TRUE" && $2 == 10 && $5 == 0 && !seen { seen = $1 } END { exit !(n > 0 && at > seen && seen > 0) }' signals.txt
say $? "one of three goes once a patrol has seen the object"
awk '{ if ($4 == "VOTE_WIN" && $1 < 30) n++ } END { exit n != 1 }' signals.txt; say $? "exactly one, before anything else happens"
[ "$(awk '$3 == "following"' team.txt | wc -l)" -eq 2 ]; say $? "both patrols go on"
awk '$4 == "VOTE_WIN" { n++ } END { exit n < 3 }' signals.txt; say $? "and one goes each time that they see the object anew"

# One behavior on three drives: the same course, by the line and by places.
cat > line.borg <<'END_OF_SCRIPT'
000 START TIMEOUT=45
010 UNITS=1: LineFollow(200);
020 IF (REF(10):UNITS(1).TimeOut==TRUE) [ REF(10):UNITS(1).Stop; ]
030 END
END_OF_SCRIPT
cat > places.borg <<'END_OF_SCRIPT'
000 START TIMEOUT=120
010 UNITS=1: Go(3000, 500), Go(3400, 1700), Go(1500, 2200), Go(700, 1500);
020 IF (REF(10):UNITS(1).TimeOut==TRUE) [ REF(10):UNITS(1).Stop; ]
030 END
END_OF_SCRIPT
course=$(sed -n 's/^line //p' "$worlds/course.world")
for kind in rover car omni; do
    works "$kind follows the line" line.borg --simulate --world "$worlds/course.world" --robots "$robots/$kind.robot" --json -o "$kind.bmp"
    take_apart
    cp path.txt "$kind.line"
    off_line 10 1 1000 "$course" > off
    awk '{ exit !($1 < 80 && $2 < 25) }' off; say $? "$kind: off the course by $(cut -d ' ' -f 1 off) mm at most, $(cut -d ' ' -f 2 off) on the average"
    works "$kind goes from place to place" places.borg --simulate --world "$worlds/course.world" --robots "$robots/$kind.robot" --json
    take_apart
    [ "$(grep -c REACHED signals.txt)" -eq 4 ]; say $? "$kind: all four are reached"
    cp path.txt "$kind.places"
done
for kind in car omni; do
    for what in line places; do
        cp "$kind.$what" path.txt
        off_line 10 1 1000 "$(cut -d ' ' -f 4,5 "rover.$what" | tr '\n' ' ')" > off
        awk -v what=$what '{ exit !($1 < (what == "line" ? 80 : 250) && $2 < (what == "line" ? 30 : 100)) }' off
        say $? "$kind: off the rover's way ($what) by $(cut -d ' ' -f 1 off) mm at most, $(cut -d ' ' -f 2 off) on the average"
    done
done

# Pictures and texts.
works "all outputs" "$scripts/explore.borg" --simulate -o paths.bmp --timeline signals.ppm
grep -Eq '^20/[1-4] +reached +at \(' out && grep -Eq '^[0-9.]+ s, [0-9]+ signals$' out; say $? "a line for each robot"
"$iris" info paths.bmp signals.ppm > sizes && grep -q '960x' sizes; say $? "two pictures"
works "a timeline as JSON" "$scripts/explore.borg" --simulate --timeline signals.json
grep -q '"signal":"VOTE_WIN"' signals.json; say $? "JSON by its name"
works "a timeline as a text" "$scripts/explore.borg" --simulate --timeline signals.txt
grep -Eq '^ +[0-9.]+ s  20/[1-4] +OBJ_DETECT_TRUE from 10/1 at \(' signals.txt; say $? "a line for each signal"
works "a team of different robots" "$scripts/explore.borg" --simulate --robots "$robots/rover.robot,$robots/omni.robot" --json
works "another world" "$scripts/explore.borg" --simulate --world "$worlds/room.world" --json

refuses "no script" 2 'one script is needed' --simulate
refuses "without --simulate" 2 '^iris swarm: --simulate: is needed' "$scripts/explore.borg"
refuses "a loss of all" 2 'loss' "$scripts/explore.borg" --simulate --loss 100
refuses "no time" 2 'timeout' "$scripts/explore.borg" --simulate --timeout 0
refuses "a picture that is none" 2 'a picture.s name ends' "$scripts/explore.borg" --simulate -o paths.txt
refuses "no such script" 1 'nowhere.borg' nowhere.borg --simulate
sed 's/UNITS=4/UNITS=1/' "$scripts/explore.borg" > few.borg
refuses "a bad script" 1 '^iris swarm: few.borg:6:6: expected no more winners' few.borg --simulate
echo 'wall 0 0' > bad.world
refuses "a bad world" 1 '^iris swarm: bad.world:1: ' "$scripts/explore.borg" --simulate --world bad.world
echo 'robot' > bad.robot
refuses "a bad robot" 1 '^iris swarm: bad.robot:1: ' "$scripts/explore.borg" --simulate --robots "$robots/rover.robot,bad.robot"
printf '000 START\n010 UNITS=200: Stop END\n' > many.borg
refuses "too many robots" 1 '1 to 64' many.borg --simulate
refuses "a picture nowhere" 1 'nowhere/paths.bmp' "$scripts/explore.borg" --simulate -o nowhere/paths.bmp
