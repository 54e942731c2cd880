#!/bin/sh
# iris borg from outside.
first_argument=borg
here=$PWD
. tests/outside

scripts=$here/examples/scripts
works "check" check "$scripts/explore.borg"
grep -q 'explore.borg: 2 groups, nothing wrong' out; say $? "check says so"
works "check in JSON" check --json "$scripts/explore.borg"
grep -q '"groups":\[{"ref":10,"units":1,"timeout_s":60,"bytes":60},{"ref":20,"units":4,"timeout_s":60,"bytes":81}\]' out
say $? "groups, and what their chunks cost, in JSON"
works "a time-out" check --json --timeout 7 "$scripts/explore.borg"
grep -q '"ref":20,"units":4,"timeout_s":7,' out; say $? "--timeout where the script names none"
works "another time-out" check --json --timeout 7 "$scripts/patrol.borg"
grep -q '"ref":10,"units":2,"timeout_s":120,.*"ref":20,"units":3,"timeout_s":120,' out; say $? "what the script names stays"
number() { sed -n 's/.*"script":\([0-9]*\).*/\1/p' out; }
{ echo '// mine'; cat "$scripts/explore.borg"; } > commented.borg
works "a comment" check --json commented.borg
commented=$(number)
works "none" check --json "$scripts/explore.borg"
[ -n "$commented" ] && [ "$(number)" = "$commented" ]; say $? "comments do not change a script's number"
works "another script" check --json --timeout 59 commented.borg
[ "$(number)" != "$commented" ]; say $? "time-outs do"
works "decompose" decompose "$scripts/explore.borg"
cat > wanted <<'END'
// Chunk 1: 60 bytes of bytecode
010 UNITS=1
[
    Signal(START): ResetTime,LineFollow,ObjDetect;
    Signal(OBJ_DETECT_TRUE,010): ResetTime,Multicast(OBJ_DETECT_TRUE,010);
    Signal(TIME_OUT): Stop;
];

// Chunk 2: 81 bytes of bytecode
020 UNITS=4
[
    Signal(START): ResetTime,AutoExplore,MapBuild;
    Signal(OBJ_DETECT_TRUE,010): UNITS=2
    [
        Signal(VOTE_WIN): ResetTime,Go(OBJ_DETECT_TRUE.Target,010(1));
        Signal(REACHED): Stop;
    ];
    Signal(TIME_OUT): Stop;
];
END
cmp -s wanted out; say $? "the chunks of the report"
works "decompose in JSON" decompose --json "$scripts/explore.borg"
grep -q '"chunks":\[{"ref":10,.*"bytes":60,"text":"010 UNITS=1\\u000a' out; say $? "chunks in JSON"
for script in "$scripts"/*.borg; do
    name=${script##*/}
    works "decompose $name" decompose "$script" -o chunks.txt
    works "bytecode of $name" decompose --bytecode "$script" -o a.bytes
    works "bytecode of its chunks" decompose --chunks --bytecode chunks.txt -o b.bytes
    cmp -s a.bytes b.bytes; say $? "$name: chunks as a text are the same bytes"
    works "format $name" format "$script" -o formatted.borg
    works "format it again" format formatted.borg
    cmp -s formatted.borg out; say $? "$name: formatted stays formatted"
    works "decompose it" decompose --bytecode formatted.borg -o b.bytes
    cmp -s a.bytes b.bytes; say $? "$name: formatted means the same"
done
sed 's/020 UNITS=4/020 UNITS=1/' "$scripts/explore.borg" > few.borg
refuses "more winners than units" 1 '^iris borg: few.borg:6:6: expected no more winners' check few.borg
sed 's/REF(20):UNITS(4/REF(25):UNITS(4/' "$scripts/explore.borg" > unknown.borg
refuses "an unknown REF" 1 '^iris borg: unknown.borg:11:6: expected the line of a group' decompose unknown.borg
{ cat "$scripts/explore.borg"; echo '130 REF(10):UNITS(1).Stop'; } > behind.borg
refuses "a line behind END" 1 '^iris borg: behind.borg:14:5: .*never run' format behind.borg
{ printf '000 START\n010 UNITS=1: Stop'; for i in $(seq 60); do printf ',Go(%d,0)' "$i"; done; echo ' END'; } > long.borg
refuses "a chunk that is too long" 1 '^iris borg: long.borg:2:5: expected less' check long.borg
cat chunks.txt chunks.txt > twice.txt
refuses "a group named twice" 1 'twice.txt: chunk 3: .*named once' decompose --chunks twice.txt
: > nothing.txt
refuses "no chunks" 1 'nothing.txt: chunk 1: no chunks' decompose --chunks nothing.txt
refuses "no script" 1 'nothing.txt:1:1: expected START' check nothing.txt
refuses "a file that is not there" 1 'nowhere.borg: ' check nowhere.borg
head -c 70000 /dev/zero > large.borg
refuses "a large file" 1 'large.borg: longer than' check large.borg
for wrong in "" "check" "run" "walk few.borg" "check a b" "check --bytecode a" "format --chunks a" "format --json a" "check -o x a" \
    "decompose --json --bytecode a" "check --timeout 0 a" "check --timeout 65536 a" "format --timeout 9 a" \
    "decompose --chunks --timeout 9 a"; do
    # shellcheck disable=SC2086
    refuses "borg $wrong" 2 '^iris borg: ' $wrong
done
works "help" --help
