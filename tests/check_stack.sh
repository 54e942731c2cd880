#!/bin/sh
# check_stack.sh FOLDER : every stack frame of the library in this build folder is at most 1 KiB, and known when compiling. Prints TAP.
limit=1024
case $1 in *mingw* | *s390x*) limit=$((limit + 160)) ;; esac # what their calling conventions keep of registers in a frame
frames=$(find "$1" \( -path '*/src/*' -o -path '*/port/*' \) -name '*.su' -exec cat {} +)
bad=$(echo "$frames" | awk -F'\t' -v limit=$limit '$3 == "dynamic" || $2 > limit')
largest=$(echo "$frames" | awk -F'\t' '$2 > most { most = $2; sub(/.*:/, "", $1); name = $1 } END { print most " bytes in " name }')
[ -z "$bad" ] && echo "ok - stack frames at most $limit bytes (largest $largest)" && exit 0
echo "not ok - stack frames at most $limit bytes"
echo "$bad" | sed 's/^/# /'
