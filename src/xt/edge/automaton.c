#include "iris/xt/automaton.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "../../foundation/rows.h"
#include "../../foundation/views.h"
#include "edge_rows.h"

void iris_automaton_defaults(iris_automaton_config *config)
{
    if (config) {
        *config = (iris_automaton_config){30, 1};
    }
}

/* The cells that live and may change, of a mask that has other bits beside them. */
typedef struct {
    const iris_image *mask;
    const uint32_t *part; /* of each word of a row */
    int32_t words;
    int32_t top, bottom; /* rows top to bottom - 1 */
} cells;

static void births(const cells *c, iris_rows *rows, uint32_t *bits, uint8_t threshold)
{
    for (; rows->y < c->mask->h; iris_rows_next(rows)) {
        if (rows->y < c->top || rows->y >= c->bottom) {
            continue;
        }
        const uint8_t *const around[3] = {iris_rows_at(rows, -1), iris_rows_at(rows, 0),
                                          iris_rows_at(rows, 1)};
        uint32_t *row = (uint32_t *)iris_image_row(c->mask, rows->y);
        iris_row_unlike_u8(bits, around, threshold, c->mask->w);
        for (int32_t word = 0; word < c->words; word++) {
            row[word] = (row[word] & ~c->part[word]) | (bits[word] & c->part[word]);
        }
    }
}

/* Of the neighbors counted so far: has a cell one, and two? */
typedef struct {
    uint32_t one, two;
} count;

static inline count add(count so_far, uint32_t bits)
{
    return (count){so_far.one | bits, so_far.two | (so_far.one & bits)};
}

/* The neighbors to the left and right in a row of cells. */
static inline count add_sides(count so_far, const uint32_t *row, int32_t word, int32_t last)
{
    uint32_t left = row[word] << 1 | (word > 0 ? row[word - 1] >> 31 : 0);
    uint32_t right = row[word] >> 1 | (word < last ? row[word + 1] << 31 : 0);
    return add(add(so_far, left), right);
}

static void copy_cells(uint32_t *to, const cells *c, int32_t y)
{
    if (y >= c->bottom) {
        memset(to, 0, sizeof *to * (size_t)c->words);
        return;
    }
    const uint32_t *row = (const uint32_t *)iris_image_row(c->mask, y);
    for (int32_t word = 0; word < c->words; word++) {
        to[word] = row[word] & c->part[word];
    }
}

/* One generation. rows: three of cells as they were, `step` words apart. */
static void solitude(const cells *c, uint32_t *rows, size_t step)
{
    uint32_t *above = rows, *here = rows + step, *below = rows + 2 * step;
    memset(above, 0, sizeof *above * (size_t)c->words);
    copy_cells(here, c, c->top);
    for (int32_t y = c->top; y < c->bottom; y++) {
        uint32_t *row = (uint32_t *)iris_image_row(c->mask, y);
        copy_cells(below, c, y + 1);
        for (int32_t word = 0; word < c->words; word++) {
            count n = add((count){above[word], 0}, below[word]);
            n = add_sides(n, above, word, c->words - 1);
            n = add_sides(n, here, word, c->words - 1);
            n = add_sides(n, below, word, c->words - 1);
            row[word] &= n.two | ~c->part[word];
        }
        uint32_t *passed = above;
        above = here;
        here = below;
        below = passed;
    }
}

static iris_status check(const iris_image *mask, const iris_image *src, const iris_automaton_config *config,
                         iris_border border)
{
    iris_status status = iris_views_check(mask, src, border);
    if (status == IRIS_ERR_ARG || config->generations < 0 ||
        config->generations > IRIS_AUTOMATON_GENERATIONS_MAX) {
        return IRIS_ERR_ARG;
    }
    return mask->format != IRIS_MASK1 || src->format != IRIS_GRAY8 ? IRIS_ERR_FORMAT : status;
}

iris_status iris_automaton(const iris_image *mask, const iris_image *src, const iris_automaton_config *config,
                           iris_border border, iris_scratch *scratch)
{
    iris_automaton_config by;
    iris_automaton_defaults(&by);
    if (config) {
        by = *config;
    }
    iris_status status = check(mask, src, &by, border);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    const int32_t words = (src->w + 31) / 32, beyond = border.rule == IRIS_BORDER_SKIP ? 1 : 0;
    const size_t step = IRIS_SCRATCH_ROUND(4u * (size_t)words) / 4u;
    size_t mark = iris_scratch_mark(scratch);
    uint32_t *memory = (uint32_t *)iris_scratch_take(scratch, 16u * step);
    iris_rows rows;
    status = memory ? iris_rows_begin(&rows, src, (iris_rows_window){1, 1, 1, 1}, border, scratch)
                    : IRIS_ERR_SCRATCH;
    if (status == IRIS_OK) {
        for (int32_t word = 0; word < words; word++) {
            memory[word] = iris_mask_part(word, beyond, src->w - beyond);
        }
        const cells all = {mask, memory, words, beyond, src->h - beyond};
        births(&all, &rows, memory + step, by.threshold);
        for (int32_t i = 0; i < by.generations && all.top < all.bottom; i++) {
            solitude(&all, memory + step, step);
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}
