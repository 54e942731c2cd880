#!/bin/sh
# make install puts a usable library there (a program is built with pkg-config alone and run), and uninstall leaves nothing.
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
say() { # say CODE NAME
    [ "$1" -eq 0 ] && echo "ok - $2" || echo "not ok - $2"
}
make -s install DESTDIR="$root" PREFIX=/opt/iris > "$root/log" 2>&1
say $? "install"
cat > "$root/program.c" <<'END'
#include "iris/status.h"
#include "iris/version.h"
#include <stdio.h>
int main(void)
{
    printf("%s %s\n", IRIS_VERSION_TEXT, iris_status_text(IRIS_OK));
    return 0;
}
END
if command -v pkg-config > /dev/null; then
    export PKG_CONFIG_PATH="$root/opt/iris/lib/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$root"
    gcc "$root/program.c" -o "$root/program" $(pkg-config --cflags --libs iris) && [ "$("$root/program")" = \
        "$(pkg-config --modversion iris) done" ]
    say $? "a program builds with pkg-config and runs"
else
    echo "ok - a program builds with pkg-config and runs # SKIP no pkg-config"
fi
if [ -e tools/iris/main.c ]; then
    "$root/opt/iris/bin/iris" --help > /dev/null
    say $? "the installed tool runs"
fi
make -s uninstall DESTDIR="$root" PREFIX=/opt/iris
[ -z "$(find "$root/opt" ! -type d)" ]
say $? "uninstall leaves nothing"
