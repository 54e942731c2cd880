/* A floor as text: see floor.h for the format. */
#include <string.h>

#include "../../foundation/text_lines.h"
#include "floor_parts.h"

#define LINES 7 /* of a floor's text that count */

static uint32_t check_of(iris_size size, const iris_q32 m[9])
{
    const int64_t sides[2] = {size.w, size.h};
    return iris_text_check(iris_text_check(IRIS_TEXT_CHECK, sides, 2), m, 9);
}

iris_status iris_floor_write_text(char *text, size_t capacity, size_t *length, const iris_floor *floor)
{
    iris_floor good;
    if (!text || !length || !floor) {
        return IRIS_ERR_ARG;
    }
    if (iris_floor_init(&good, floor->size, floor->to_image_q32) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    char made[IRIS_FLOOR_TEXT_BYTES];
    char *at = iris_text_put_bytes(made, "iris floor 1\nsize ", sizeof "iris floor 1\nsize " - 1);
    at = iris_text_put_number(at, good.size.w, ' ');
    at = iris_text_put_number(at, good.size.h, '\n');
    at = iris_text_put_bytes(at, "image_from_floor_q32\n", sizeof "image_from_floor_q32\n" - 1);
    for (int i = 0; i < 9; i++) {
        at = iris_text_put_number(at, good.to_image_q32[i], i % 3 == 2 ? '\n' : ' ');
    }
    at = iris_text_put_check(at, check_of(good.size, good.to_image_q32));
    *at++ = 0;
    size_t bytes = (size_t)(at - made);
    if (bytes > capacity) {
        return IRIS_ERR_RANGE;
    }
    memcpy(text, made, bytes);
    *length = bytes - 1;
    return IRIS_OK;
}

/* What the lines said so far. */
typedef struct {
    int64_t version, w, h;
    iris_q32 m[9];
    uint32_t check;
} content;

/* Line `i` of those that count. */
static int take_line(content *c, iris_text_lines *r, int i)
{
    switch (i) {
    case 0:
        return iris_text_take_word(r, "iris") && iris_text_take_word(r, "floor") &&
               iris_text_take_number(&c->version, r);
    case 1:
        return iris_text_take_word(r, "size") && iris_text_take_number(&c->w, r) &&
               iris_text_take_number(&c->h, r) && c->w > 0 && c->w <= IRIS_SIDE_MAX && c->h > 0 &&
               c->h <= IRIS_SIDE_MAX;
    case 2:
        return iris_text_take_word(r, "image_from_floor_q32");
    case 6:
        return iris_text_take_check(&c->check, r);
    default:
        for (int k = 0; k < 3; k++) {
            if (!iris_text_take_number(&c->m[3 * (i - 3) + k], r)) {
                return 0;
            }
        }
        return 1;
    }
}

static iris_status read(iris_floor *floor, iris_text_lines *r)
{
    content c = {.version = 1};
    for (int i = 0; i < LINES; i++) {
        if (!iris_text_next_line(r)) {
            r->line += r->line < INT32_MAX;
            return IRIS_ERR_TRUNCATED;
        }
        if (!take_line(&c, r, i) || c.version < 1 || (c.version == 1 && r->at < r->end)) {
            return IRIS_ERR_DATA;
        }
        if (c.version > 1) {
            return IRIS_ERR_UNSUPPORTED;
        }
    }
    iris_size size = {(int32_t)c.w, (int32_t)c.h};
    if (c.check != check_of(size, c.m) || iris_floor_init(floor, size, c.m) != IRIS_OK ||
        iris_text_next_line(r)) {
        return IRIS_ERR_DATA;
    }
    return IRIS_OK;
}

iris_status iris_floor_read_text(iris_floor *floor, int32_t *line, const char *text, size_t bytes)
{
    if (!floor || !line || (!text && bytes > 0)) {
        return IRIS_ERR_ARG;
    }
    if (bytes > 0 && text[bytes - 1] == 0) {
        bytes--;
    }
    iris_floor made;
    iris_text_lines r = {.next = text, .text_end = bytes > 0 ? text + bytes : text};
    iris_status status = read(&made, &r);
    if (status == IRIS_OK) {
        *floor = made;
    } else {
        *line = r.line;
    }
    return status;
}
