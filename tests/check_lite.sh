#!/bin/sh
# check_lite.sh LIBIRIS FUNCTION... -- OTHER... : the archive of PROFILE=lite has every function promised, none of the others,
# and all that these call. Prints TAP.
archive=$1
shift
program=$(mktemp)
trap 'rm -f "$program" "$program.o"' EXIT
echo 'int main(void) { return 0; }' | ${CC:-cc} -c -x c -o "$program.o" -
has() { # has FUNCTION : does a program that calls it link?
    ${CC:-cc} -o "$program" "$program.o" -Wl,--require-defined="$1" "$archive" > "$program.log" 2>&1
}
[ $# -gt 100 ] && echo "ok - Lite promises $# functions" || echo "not ok - Lite promises $# functions"
missing= surplus= wanted=yes
for name in "$@"; do
    [ "$name" = -- ] && wanted= && continue
    if has "$name"; then
        [ $wanted ] || surplus="$surplus $name"
    else
        [ $wanted ] && missing="$missing $name"
    fi
done
rm -f "$program.log"
[ -z "$missing" ] && echo "ok - every function of Lite links" || echo "not ok - every function of Lite links:$missing"
[ -z "$surplus" ] && echo "ok - Lite has nothing else" || echo "not ok - Lite has nothing else:$surplus"
open=$(${CROSS_COMPILE}nm "$archive" 2> /dev/null | awk '$1 == "U" && $2 ~ /^iris_/ { used[$2] } NF == 3 { here[$3] }
    END { for (s in used) if (!(s in here)) print s }')
[ -z "$open" ] && echo "ok - Lite calls nothing outside itself" || echo "not ok - Lite calls nothing outside itself:" $open
