/* A floor as text: see floor.h for the format. */
#include "../../foundation/text_lines.h"
#include "floor_parts.h"

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
    char *at = iris_text_put_word(made, "iris floor 1\nsize ");
    at = iris_text_put_number(at, good.size.w, ' ');
    at = iris_text_put_number(at, good.size.h, '\n');
    at = iris_text_put_word(at, "image_from_floor_q32\n");
    for (int i = 0; i < 9; i++) {
        at = iris_text_put_number(at, good.to_image_q32[i], i % 3 == 2 ? '\n' : ' ');
    }
    const iris_text_made whole = {made, at, check_of(good.size, good.to_image_q32)};
    return iris_text_finish(text, capacity, length, &whole);
}

typedef struct {
    int64_t w, h;
    iris_q32 m[9];
} content;

static int take_line(void *user, iris_text_lines *r, int i)
{
    content *c = user;
    if (i == 0) {
        return iris_text_take_word(r, "size") && iris_text_take_number(&c->w, r) &&
               iris_text_take_number(&c->h, r) && c->w > 0 && c->w <= IRIS_SIDE_MAX && c->h > 0 &&
               c->h <= IRIS_SIDE_MAX;
    }
    if (i == 1) {
        return iris_text_take_word(r, "image_from_floor_q32");
    }
    for (int k = 0; k < 3; k++) {
        if (!iris_text_take_number(&c->m[3 * (i - 2) + k], r)) {
            return 0;
        }
    }
    return 1;
}

iris_status iris_floor_read_text(iris_floor *floor, int32_t *line, const char *text, size_t bytes)
{
    static const iris_text_form form = {"floor", 5, take_line};
    if (!floor || !line || (!text && bytes > 0)) {
        return IRIS_ERR_ARG;
    }
    content c = {.w = 0};
    iris_text_source source = {.text = text, .bytes = bytes};
    iris_status status = iris_text_read(&c, &source, &form);
    const iris_size size = {(int32_t)c.w, (int32_t)c.h};
    if (status == IRIS_OK && ((source.has_check && source.check != check_of(size, c.m)) ||
                              iris_floor_init(floor, size, c.m) != IRIS_OK)) {
        status = IRIS_ERR_DATA;
    }
    if (status != IRIS_OK) {
        *line = source.line;
    }
    return status;
}
