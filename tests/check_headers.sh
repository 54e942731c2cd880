#!/bin/sh
# check_headers.sh : each public header compiles alone (and twice in a row) as C99 and as C++. Prints TAP.
compile() { # compile HEADER LANGUAGE COMPILER...
    header=$1 language=$2
    shift 2
    if errors=$(printf '#include "%s"\n#include "%s"\nextern int one_declaration;\n' "$header" "$header" |
                "$@" -Iinclude -pedantic -Wall -Wextra -Wshadow -Werror -fsyntax-only -x "$language" - 2>&1); then
        echo "ok - $header as $language"
    else
        echo "not ok - $header as $language"
        echo "$errors" | head -10 | sed 's/^/# /'
    fi
}
if ! command -v g++ > /dev/null; then
    echo "ok - headers as C++ # SKIP no g++ (make deps)"
fi
for header in $(cd include && find iris -name '*.h' | sort); do
    compile "$header" c gcc -std=c99
    command -v g++ > /dev/null && compile "$header" c++ g++ -std=c++11
done
