#!/bin/sh
# check_digests.sh COMMAND... : COMMAND prints `operation digest` lines; each must be the line of tests/digest/golden.txt.
# With GOLDEN=write the list is written instead (make golden): read the difference before committing it.
golden=tests/digest/golden.txt
if [ "$GOLDEN" = write ]; then
    "$@" > $golden
    exit
fi
timeout 300 "$@" 2>&1 | awk -v golden=$golden '
    BEGIN { while ((getline line < golden) > 0) { split(line, field, " "); want[field[1]] = field[2] } }
    { sub(/\r$/, "") }
    NF != 2            { print "# " $0; next }
    !($1 in want)      { print "not ok - digest " $1 " is not in " golden " (make golden)"; next }
    $2 != want[$1]     { print "not ok - digest " $1 " is " $2 ", golden " want[$1]; delete want[$1]; next }
                       { print "ok - digest " $1; delete want[$1] }
    END { for (name in want) print "not ok - digest " name " was not printed" }'
