#!/bin/sh
# check_sizes.sh : the sizes and names that keep the project livable. Prints TAP and the ten longest functions.
# A function starts at column 0 and its body is a { and a } at column 0 (clang-format sees to that).
files=$(find include src port tools examples tests \( -name '*.[ch]' -o -name '*.[ch]pp' \) ! -name '*_table.c' 2>/dev/null | sort)
verdict() {
    if [ -z "$2" ]; then
        echo "ok - $1"
    else
        echo "not ok - $1"
        echo "$2" | sed 's/^/# /'
    fi
}
functions=$(awk '
    FNR == 1            { head = ""; inside = 0 }
    inside && /^}/      { print FNR - first + 1, FILENAME ":" first, name, parameters; inside = 0; head = ""; next }
    inside              { next }
    /^{/ && head ~ /\)[ ]*$/ {
        name = head; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name)
        depth = 0; parameters = 1
        for (i = length(name) + index(head, name "("); i <= length(head); i++) {
            c = substr(head, i, 1)
            if (c == "(") depth++; if (c == ")") depth--; if (c == "," && depth == 1) parameters++
        }
        inside = 1; next }
    /^[a-zA-Z_]/        { head = $0; first = FNR; next }
    /^[ \t]/ && head != "" && head !~ /[;)]$/ { head = head " " $0; next }
                        { head = "" }' $files)
verdict "functions at most 60 lines" "$(echo "$functions" | awk '$1 > 60')"
verdict "at most six parameters" "$(echo "$functions" | awk '$4 > 6 { print $2, $3, $4 " parameters" }')"
verdict "files at most 600 lines" "$(wc -l $files | awk '$2 != "total" && $1 > 600')"
verdict "examples under 120 lines" "$(wc -l /dev/null $(echo "$files" | grep '^examples/') | awk '$2 != "total" && $1 >= 120')"
verdict "no type name ends in _t" "$(awk '/^(typedef|}).*[a-z0-9]_t;/ { print FILENAME ":" FNR ": " $0 }' $files)"
verdict "no file named after nothing" "$(echo "$files" |
    grep -E '/(utils?|common|misc|helpers?)(\.[a-z]+)?$')"
verdict "the top level" "$(git ls-files 2>/dev/null | sed 's|/.*||' | sort -u |
    grep -vxE 'README.md|LICENSE|Makefile|\.ci|\.clang-format|\.clang-tidy|\.gitignore|include|src|port|tools|examples|tests')"
echo "#: the ten longest functions (lines, place, name):"
echo "$functions" | sort -n -r | head -10 | awk '{ print "#:   " $1, $2, $3 }'
