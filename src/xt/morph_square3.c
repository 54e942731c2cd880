#include <string.h>

#include "../foundation/kernel.h"
#include "morph_step.h"

typedef struct {
    const uint8_t *rows[3];
    const uint8_t *level; /* a row of the border's value; null: what is beyond is a copy of what is within */
    int32_t channels;
    int erodes;
} square3;

static void join(const square3 *square, uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c)
{
    (square->erodes ? iris_row_min3_u8 : iris_row_max3_u8)(dst, a, b, c, square->channels);
}

/* The pixel whose samples are from `at` on, at the left or right edge; its neighbor within is at `beside`. */
static void join_edge(uint8_t *to, const square3 *square, int32_t at, int32_t beside)
{
    uint8_t column[4], column_beside[4];
    const uint8_t *const *rows = square->rows;
    join(square, column, rows[0] + at, rows[1] + at, rows[2] + at);
    join(square, column_beside, rows[0] + beside, rows[1] + beside, rows[2] + beside);
    join(square, to + at, column, column_beside, square->level ? square->level : column);
}

static void join_inner(uint8_t *to, const square3 *square, int32_t n)
{
    int32_t channels = square->channels;
    const uint8_t *inner[3];
    for (int k = 0; k < 3; k++) {
        inner[k] = square->rows[k] + channels;
    }
    (square->erodes ? iris_row_min9_u8 : iris_row_max9_u8)(to + channels, inner, channels, n - 2 * channels);
}

void iris_morph_square3(const iris_image *dst, const iris_image *src, int erodes, iris_border border,
                        uint8_t *level)
{
    int32_t channels = src->format == IRIS_GRAY8 ? 1 : 3, n = src->w * channels;
    int32_t skipped = border.rule == IRIS_BORDER_SKIP ? 1 : 0;
    square3 square = {.channels = channels, .erodes = erodes};
    if (border.rule == IRIS_BORDER_CONSTANT) {
        memset(level, border.value, (size_t)n);
        square.level = level;
    }
    for (int32_t y = skipped; y < src->h - skipped; y++) {
        uint8_t *to = (uint8_t *)iris_image_row(dst, y);
        for (int32_t k = 0; k < 3; k++) {
            int32_t row = iris_border_index(y + k - 1, src->h, border.rule);
            square.rows[k] = row < 0 ? level : (const uint8_t *)iris_image_row(src, row);
        }
        if (n > 2 * channels) {
            join_inner(to, &square, n);
        }
        if (!skipped) {
            int32_t beside = src->w > 1 ? channels : 0;
            join_edge(to, &square, 0, beside);
            join_edge(to, &square, n - channels, n - channels - beside);
        }
    }
}
