#!/bin/sh
# check_layers.sh : who includes whom. Every #include "..." is resolved to a file, every file has a layer, and only the
# arrows below are allowed; src/, include/ and port/cpu take a few standard headers and no other. A port overrides what
# kernel.h declares: a misspelt name compiles, and is never called. Prints TAP.
files=$(find include src port tools examples tests -name '*.[ch]' -o -name '*.[ch]pp' 2>/dev/null | sort)
found=$(awk '
    function allow(layer, list,   n, parts, i) { n = split(list, parts, " "); for (i = 1; i <= n; i++) arrow[layer, parts[i]] = 1 }
    BEGIN {
        allow("foundation", "foundation kernel")
        allow("kernel", "foundation kernel port")
        allow("xt", "xt foundation kernel")
        allow("3d", "3d xt foundation kernel")
        allow("osiris", "osiris foundation")
        allow("runtime", "runtime osiris foundation")
        allow("borg", "borg runtime osiris foundation")
        allow("port", "port kernel")
        allow("os", "os foundation xt 3d osiris runtime borg linux")
        allow("linux", "linux foundation xt 3d osiris runtime borg")
        allow("user", "user foundation xt 3d osiris runtime borg linux")
    }
    function layer_of(path,   source) {
        if (path ~ /^src\/foundation\/kernel[a-z_0-9]*\.[ch]$/)  return "kernel"
        if (match(path, /^(src|include\/iris)\/(foundation|xt|3d|osiris|runtime|borg|linux)[\/.]/)) {
            sub(/^(src|include\/iris)\//, "", path); sub(/[\/.].*/, "", path); return path }
        if (path ~ /^include\/iris\/[a-z0-9_]+\.h$/) {
            source = path; gsub(/.*\/|\.h$/, "", source)
            return exists("port/os/linux/" source ".c") || exists("port/os/linux/" source "0/" source ".c") ? "linux" : "foundation" }
        if (path ~ /^port\/cpu\//)                          return "port"
        if (path ~ /^port\/os\//)                           return "os"
        if (path ~ /^(tools|examples|tests)\//)             return "user"
        return "nowhere"
    }
    function exists(path,   line) { if ((getline line < path) >= 0) { close(path); return 1 } return 0 }
    function resolve(name, folder,   path) {
        if (name == "iris_port.h") return "port/cpu/generic/iris_port.h"
        path = folder name
        while (sub(/[^\/]+\/\.\.\//, "", path)) {}
        if (exists(path)) return path
        if (exists("include/" name)) return "include/" name
        if (exists("src/foundation/" name)) return "src/foundation/" name
        if (exists("tests/" name)) return "tests/" name
        if (exists("tests/target/" name)) return "tests/target/" name
        if (exists("tools/bench/" name)) return "tools/bench/" name
        return ""
    }
    FNR == 1 { from = layer_of(FILENAME); folder = FILENAME; sub(/[^\/]*$/, "", folder) }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        name = $0; sub(/^[^"]*"/, "", name); sub(/".*/, "", name)
        path = resolve(name, folder)
        if (path == "") { if (name != "unity.h") print FILENAME ": " name " is not found"; next }
        to = layer_of(path)
        if (FILENAME ~ /^tests\/(check_kernels\.c$|kernels\/)/ && (to == "kernel" || to == "port")) next
        if (FILENAME == "tests/kernels/gain.c" && path == "tools/bench/markers.h") next
        if (!((from, to) in arrow)) print FILENAME " (" from ") includes " path " (" to ")"
        if (from == "user" && to == "user" && substr(FILENAME, 1, 5) != substr(path, 1, 5))
            print FILENAME " includes " path
    }
    /^[ \t]*#[ \t]*include[ \t]*</ && FILENAME ~ /^(src|include|port\/cpu)\// {
        name = $0; sub(/^[^<]*</, "", name); sub(/>.*/, "", name)
        if (name ~ /^(stddef|stdint|stdbool|limits|string)\.h$/) next
        if (FILENAME ~ /^port\/cpu\// && name ~ /^([a-z]?mmintrin|immintrin|arm_neon|arm_acle|arm_mve)\.h$/) next
        print FILENAME " includes <" name ">"
    }
    /^[ \t]*#[ \t]*(el)?if.*(__ARM|__arm|__aarch|__SSE|__AVX|__x86|__i386|__linux|__unix|_WIN32|__APPLE)/ && FILENAME ~ /^src\// {
        print FILENAME ":" FNR ": asks for a processor or system"
    }' $files)
if [ -z "$found" ]; then
    echo "ok - include layering ($(echo "$files" | wc -l) files)"
else
    echo "not ok - include layering"
    echo "$found" | sed 's/^/# /'
fi

unknown=$(sed -nE 's/^# *(define|undef) +(iris_row_[a-z0-9_]+)( .*)?$/\2/p' port/cpu/*/iris_port.h | sort -u |
    while read -r name; do grep -q "^#ifndef $name\$" src/foundation/kernel.h || echo "$name"; done)
if [ -z "$unknown" ]; then
    echo "ok - ports override kernels of kernel.h"
else
    echo "not ok - ports override kernels of kernel.h"
    echo "$unknown" | sed 's/^/# /'
fi
