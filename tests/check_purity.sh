#!/bin/sh
# check_purity.sh LIBIRIS [SHIMS] : what the archives may not contain, whatever the sources look like. Prints TAP.
#   every archive: no writable global, no allocation, no stdio, no floating-point instruction
#   (libiris-libcamera.a is not one of them: libcamera allocates by its nature, and so does what speaks to it)
#   LIBIRIS:       refers to nothing outside itself but mem*, and the compiler's integer helpers
# CROSS_COMPILE names the tools.
nm=${CROSS_COMPILE}nm objdump=${CROSS_COMPILE}objdump
allowed='^(memcpy|memset|memmove|memcmp|__aeabi_(mem(cpy|set|clr|move)[48]?|u?idiv(mod)?|u?ldivmod|lmul|llsl|llsr|lasr|lcmp|ulcmp|u?idiv0)|__gnu_thumb1_case_(uqi|sqi|uhi|shi|si)|__(clz|ctz|popcount)[sd]i2|__(u?div|u?mod)[dt]i[34]|__multi3|_GLOBAL_OFFSET_TABLE_|__stack_chk_(fail|guard))$'
forbidden='^(malloc|calloc|realloc|free|alloca|posix_memalign|aligned_alloc|strdup|f?printf|v?s?n?printf|fopen|fclose|fread|fwrite|fputs|fgets|puts|putchar|perror|std(in|out|err))$'
# Floating-point arithmetic, comparison and conversion; plain moves of vector registers stay allowed.
x86='v?(add|sub|mul|div|sqrt|rsqrt|rcp|min|max|cmp[a-z]*|u?comi|round|hadd|hsub|addsub|dp|fn?m(add|sub)[0-9]*)[sp][sd]|v?cvt[a-z0-9]+|f[a-z0-9]+'
a64='f(abs|add|ccmp|cmp|cm|cvt|div|madd|max|min|ml|msub|mul|neg|nm|rec|rint|rsqrt|sqrt|sub|ac)[a-z0-9]*|[su]cvtf'
a32='v[a-z]+\.f(16|32|64)(\.[a-z0-9]+)?|vcvt[a-z0-9.]*'

verdict() { # verdict ARCHIVE WHAT FOUND
    if [ -z "$(echo $3)" ]; then
        echo "ok - $2 in $1"
    else
        echo "not ok - $2 in $1"
        echo "$3" | head -10 | sed 's/^/# /'
    fi
}

for archive in "$@"; do
    name=${archive##*/}
    outside=$({ $nm -u "$archive" | awk '$1 ~ /^[Uw]$/ { print "u", $2 }'
                $nm --defined-only "$archive" | awk 'NF == 3 { print "d", $3 }'; } |
              awk '$1 == "d" { here[$2] = 1 } $1 == "u" { used[$2] = 1 } END { for (s in used) if (!(s in here)) print s }')
    verdict "$name" "no allocation and no stdio" "$(echo "$outside" | grep -E "$forbidden")"
    [ "$name" = libiris.a ] && verdict "$name" "no foreign symbol" "$(echo "$outside" | grep -v '^$' | grep -vE "$allowed")"
    verdict "$name" "no writable global" "$($objdump -h "$archive" | awk '
        / file format / { file = $1 }
        $2 ~ /^\.(data|bss|tdata|tbss)/ && $2 !~ /^\.data\.rel\.ro/ && $3 !~ /^0+$/ { print file, $2, $3 }')
$($nm "$archive" | awk '$2 == "C" { print }')"
    case $($objdump -f "$archive" | sed -n 's/^architecture: \([^,]*\).*/\1/p' | head -1) in
    i386*) float=$x86 ;;
    aarch64) float=$a64 ;;
    *) float=$a32 ;;
    esac
    verdict "$name" "no floating-point instruction" "$($objdump -d --no-show-raw-insn "$archive" | awk -v float="^($float)\$" '
        / file format /     { file = $1; next }
        /^[0-9a-f]+ <.*>:$/ { place = $2; next }
        $2 == "vmov.f16" && $3 ~ /^(r|s)[0-9]+,$/ && $4 ~ /^(r|s)[0-9]+$/ { next } # bits go to another register, as they are
        $1 ~ /:$/ && $2 ~ float { print file, place, $0 }')"
done
