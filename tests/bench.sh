#!/bin/sh
# bench.sh : what `make bench` and `make bench-peers` stand on. The numbers of a machine are not tested, but that all come.
out=${OUT:?set by make}
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
say() { # say CODE NAME; a failure shows what was printed
    [ "$1" -eq 0 ] && echo "ok - $2" && return
    echo "not ok - $2"
    sed 's/^/# /' "$root/log"
}

# A program of known samples: what it says does not depend on a clock.
printf '#!/bin/sh\necho "5 0.5 $1 some operation"\necho "1 0.5 $1 some operation"\necho "2.25 0.5 $1 some operation"\n' > "$root/known"
printf '#!/bin/sh\necho "4 0.5 $1 some operation"\n' > "$root/other"
chmod +x "$root/known" "$root/other"
tools/bench/times "$root/json" 8x4 '' "one=$root/known" "two=$root/other" > "$root/log" 2>&1
say $? "the ports take turns"
grep -q '^some operation  *0.5  *1.000  *2.250  *4.000  *4.000$' "$root/log"
say $? "minimum and median in the table"
cat > "$root/json.right" << 'END'
[
 {"operation": "some operation", "size": "8x4", "port": "one", "minimum_ns": 1.0000, "median_ns": 2.2500, "working_bytes": 0.5},
 {"operation": "some operation", "size": "8x4", "port": "two", "minimum_ns": 4.0000, "median_ns": 4.0000, "working_bytes": 0.5}
]
END
cmp "$root/json" "$root/json.right" > "$root/log" 2>&1
say $? "minimum and median in the JSON"
printf '#!/bin/sh\nexit 3\n' > "$root/known"
tools/bench/times "$root/json" 8x4 '' "one=$root/known" > "$root/log" 2>&1
[ $? -eq 3 ]
say $? "a program that fails ends it"

tools/bench/times "$root/json" 32x16,48x32 'mask, 3x3' "here=$out/bench-time" > "$root/log" 2> "$root/err"
say $? "operations by a part of their names, at two sizes"
[ ! -s "$root/err" ]
say $? "no progress in a pipe"
[ "$(grep -c '"operation": "\(dilate\|open\) a mask, 3x3", "size": "\(32x16\|48x32\)", "port": "here", "minimum_ns": [0-9.]*[1-9][0-9]*, ' \
    "$root/json")" -eq 4 ] && [ "$(wc -l < "$root/json")" -eq 6 ]
say $? "a line of JSON for each"
tools/bench/times "$root/json" 32x16 'no such thing' "here=$out/bench-time" > "$root/log" 2>&1
[ $? -eq 2 ] && grep -q 'no operation' "$root/log"
say $? "no operation of that name is exit code 2"
for size in 5 0x9 640x480x1 640x99999; do
    tools/bench/times "$root/json" $size dilate "here=$out/bench-time" > "$root/log" 2>&1
    [ $? -eq 2 ] && grep -q "$size: a size is" "$root/log"
    say $? "no size: $size"
done

# IRIS's side of the comparison with a peer: a picture goes in, its result comes out.
printf 'abcdefghijklmnopqrstuvwxyzABCDEF01234567890123456789012345678901' > "$root/gray"
printf 'FEDCBAzyxwvutsrqponmlkjihgfedcba10987654321098765432109876543210' > "$root/want"
printf 'case 32 2|%s|-|-|mirror\nrun 3\nresult %s\n' "$root/gray" "$root/got" | "$out/bench-peers" > "$root/log" 2>&1
say $? "a case is run"
[ "$(sed -n '1p;3p' "$root/log" | tr '\n' ' ')" = 'ok 32 2 1 ' ] && sed -n 2p "$root/log" | grep -q '^[0-9]*$'
say $? "each line has its answer"
cmp "$root/got" "$root/want" > "$root/log" 2>&1
say $? "the result is that of the picture"
printf 'case 32 2|-|-|-|no such case\n' | "$out/bench-peers" > "$root/log" 2>&1
[ $? -eq 1 ] && grep -q 'no such case' "$root/log"
say $? "a case that does not exist is an error"
