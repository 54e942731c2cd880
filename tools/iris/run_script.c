#include "run_script.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "floor_file.h"

#define SECONDS_MAX 86400

/* A time in seconds, with up to three places behind its point; *at goes behind it. 0 when it is none. */
static int take_time(uint32_t *ms, const char **at, const char *end)
{
    const char *c = *at;
    uint32_t whole = 0, part = 0, place = 100;
    int digits = 0;
    for (; c < end && *c >= '0' && *c <= '9' && whole <= SECONDS_MAX; c++, digits++) {
        whole = whole * 10 + (uint32_t)(*c - '0');
    }
    if (c < end && *c == '.') {
        for (c++; c < end && *c >= '0' && *c <= '9' && place > 0; c++, digits++, place /= 10) {
            part += place * (uint32_t)(*c - '0');
        }
    }
    if (digits == 0 || whole > SECONDS_MAX || (c < end && *c != ' ' && *c != '\t')) {
        return 0;
    }
    *ms = whole * 1000 + part;
    *at = c;
    return 1;
}

static int wrong(const char *path, int line, ptrdiff_t column, const char *what)
{
    char place[1200];
    snprintf(place, sizeof place, "%.1150s:%d:%d", path, line, (int)column);
    complain(place, "%s", what);
    return 0;
}

static int add(run_script *script, run_script_line one, const char *path)
{
    run_script_line *more = realloc(script->lines, (size_t)(script->count + 1) * sizeof *more);
    if (!more) {
        complain(path, "not enough memory");
        return 0;
    }
    script->lines = more;
    script->lines[script->count++] = one;
    return 1;
}

static int read_line(run_script *script, const char *path, int line, const char *start, const char *end)
{
    run_script_line one = {0, {IRIS_ORDER_NONE, 0, 0}};
    int32_t column = 0;
    const char *at = start;
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) {
        at++;
    }
    if (at == end || *at == '#') {
        return 1;
    }
    if (!take_time(&one.at_ms, &at, end)) {
        return wrong(path, line, at - start + 1, "expected seconds, such as 2.5, before an order");
    }
    if (script->count > 0 && one.at_ms < script->lines[script->count - 1].at_ms) {
        return wrong(path, line, 1, "expected a time that is not before the line above");
    }
    const iris_status status = iris_order_read(&one.order, &column, at, (size_t)(end - at));
    if (status != IRIS_OK) {
        return wrong(path, line, at - start + (column > 0 ? column : 1),
                     status == IRIS_ERR_RANGE ? "expected a number within its range"
                                              : "expected an order, such as go 500");
    }
    return add(script, one, path);
}

int run_script_read(run_script *script, const char *path)
{
    static char text[TEXT_FILE_BYTES];
    size_t bytes = 0;
    int line = 1;
    if (!text_file_read(text, sizeof text, &bytes, path)) {
        return 0;
    }
    for (const char *at = text, *all = text + bytes; at < all; line++) {
        const char *end = memchr(at, '\n', (size_t)(all - at));
        end = end ? end : all;
        if (!read_line(script, path, line, at, end)) {
            return 0;
        }
        at = end + 1;
    }
    return 1;
}
