#include "morph_step.h"

#include <string.h>

#include "../../foundation/kernel.h"

static const uint32_t *words_of(const uint8_t *row)
{
    return (const uint32_t *)(const void *)row;
}

static void join_any(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n)
{
    iris_row_join_rows_mask((uint32_t *)(void *)dst, words_of(a), words_of(b), words_of(c), 0, n / 4);
}

static void join_all(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n)
{
    iris_row_join_rows_mask((uint32_t *)(void *)dst, words_of(a), words_of(b), words_of(c), ~0u, n / 4);
}

/* Samples from..last around each sample, in pixels, are joined. Returns `to`, or the row itself where one pixel alone is
 * looked at. */
static const uint8_t *join_span(iris_morph_step *step, uint8_t *to, const uint8_t *row, int32_t first,
                                int32_t last)
{
    int32_t w = step->rows.src->w, count = last - first + 1;
    if (step->rows.src->format == IRIS_MASK1) {
        iris_mask_join_span((uint32_t *)(void *)to, (const uint32_t *)(const void *)row,
                            (iris_mask_span){w, first, last, step->erodes}, (uint32_t *)(void *)step->run);
        return to;
    }
    int32_t channels = step->rows.channels, length = 1;
    const uint8_t *run = row + first * channels;
    if (count == 1) {
        return run;
    }
    for (; 3 * length < count; length *= 3) {
        step->join(step->run, run, run + length * channels, run + 2 * length * channels,
                   (w + count - 3 * length) * channels);
        run = step->run;
    }
    int32_t rest = count - length;
    step->join(to, run, run + (length < rest ? length : rest) * channels, run + rest * channels,
               w * channels);
    return to;
}

/* The run of 3^level lines that ends `back` lines before the latest one. */
static uint8_t *run_at(const iris_morph_step *step, int32_t level, int32_t back)
{
    int32_t slot = step->levels[level].last - back;
    slot = slot < 0 ? slot + step->levels[level].slots : slot;
    return step->levels[level].ring + (size_t)slot * (size_t)step->line_bytes;
}

/* The line of the lowest row that is looked at, and the runs that end with it. */
static void add_line(iris_morph_step *step, const uint8_t *row)
{
    step->lines++;
    for (int32_t level = 0; level <= step->top; level++) {
        int32_t next = step->levels[level].last + 1;
        step->levels[level].last = next < step->levels[level].slots ? next : 0;
    }
    uint8_t *line = run_at(step, 0, 0);
    int cross = step->element.shape == IRIS_MORPH_CROSS;
    const uint8_t *made = join_span(step, line, row, cross ? 0 : -step->left, cross ? 0 : step->right);
    if (made != line) {
        memcpy(line, made, (size_t)step->row_bytes);
    }
    int32_t length = 1;
    for (int32_t level = 0; level < step->top; level++, length *= 3) {
        if (step->lines >= 3 * length) {
            step->join(run_at(step, level + 1, 0), run_at(step, level, 0), run_at(step, level, length),
                       run_at(step, level, 2 * length), step->row_bytes);
        }
    }
}

/* Rings of runs: level 0 is kept until the anchor's row has been made of it, the others until the next level and, the
 * last one, all of the element have been. */
static void divide_rings(iris_morph_step *step, uint8_t *memory)
{
    int32_t h = step->element.h;
    step->longest = 1;
    for (step->top = 0; 3 * step->longest <= (h - 1) / 2; step->top++) {
        step->longest *= 3;
    }
    int32_t length = 1;
    for (int32_t level = 0; level <= step->top; level++, length *= 3) {
        int32_t slots = level == step->top ? h - length + 1 : level == 0 ? h / 2 + 1 : 2 * length + 1;
        step->levels[level].ring = memory;
        step->levels[level].slots = slots;
        step->levels[level].last = -1;
        memory += (size_t)slots * (size_t)step->line_bytes;
    }
}

iris_status iris_morph_step_begin(iris_morph_step *step, const iris_rows_source *source,
                                  const iris_morph_element *element, iris_border border,
                                  iris_scratch *scratch)
{
    int32_t w = source->shape->w, far = element->w / 2, high = element->h / 2;
    iris_format format = source->shape->format;
    int mask = format == IRIS_MASK1, erodes = step->erodes;
    size_t row_bytes = iris_format_row_bytes(format, w), line_bytes = IRIS_SCRATCH_ROUND(row_bytes);
    iris_status status =
        iris_rows_begin_from(&step->rows, source, (iris_rows_window){far, far, high, high}, border, scratch);
    uint8_t *rings = (uint8_t *)iris_scratch_take(scratch, line_bytes * IRIS_MORPH_COLUMN_ROWS(element->h));
    step->run = (uint8_t *)iris_scratch_take(scratch, IRIS_MORPH_ROW_BYTES(format, w + element->w - 1) +
                                                          (mask ? 4u : 0u));
    if (status != IRIS_OK || !rings || !step->run) {
        return IRIS_ERR_SCRATCH;
    }
    step->element = *element;
    step->left = erodes ? (element->w - 1) / 2 : far;
    step->right = erodes ? far : (element->w - 1) / 2;
    step->above = erodes ? (element->h - 1) / 2 : high;
    step->below = erodes ? high : (element->h - 1) / 2;
    step->join = mask ? (erodes ? join_all : join_any) : erodes ? iris_row_min3_u8 : iris_row_max3_u8;
    step->is_near = iris_morph_is_near(element);
    step->near = iris_morph_near_of(source->shape, element, erodes, border);
    step->row_bytes = (int32_t)row_bytes;
    step->line_bytes = (int32_t)line_bytes;
    step->lines = 0;
    divide_rings(step, rings);
    for (int32_t y = -step->above; y < step->below && !step->is_near; y++) {
        add_line(step, iris_rows_at(&step->rows, y));
    }
    return IRIS_OK;
}

/* Adds the runs that overlap to `lines` lines, the last of which is `back` lines before the latest. Returns how many parts
 * there are then. */
static int add_runs(const uint8_t **parts, int count, const iris_morph_step *step, int32_t back,
                    int32_t lines)
{
    for (int32_t before = 0; before < lines; before += step->longest) {
        int32_t more = before < lines - step->longest ? before : lines - step->longest;
        parts[count++] = run_at(step, step->top, back + more);
    }
    return count;
}

/* Adds the pixels of the anchor's row; without the anchor itself only one side of two. */
static int add_center(const uint8_t **parts, int count, iris_morph_step *step)
{
    const uint8_t *row = iris_rows_at(&step->rows, 0);
    if (!step->element.exclude_center) {
        parts[count++] = step->element.shape == IRIS_MORPH_CROSS
                             ? join_span(step, step->run, row, -step->left, step->right)
                             : run_at(step, 0, step->below);
    } else if (step->left > 0) {
        parts[count++] = join_span(step, step->run, row, -step->left, -1);
    } else if (step->right > 0) {
        parts[count++] = join_span(step, step->run, row, 1, step->right);
    }
    return count;
}

void iris_morph_step_row(iris_morph_step *step, uint8_t *to, int32_t from, int32_t n)
{
    if (step->is_near) { /* of a mask from word 0 on */
        const uint8_t *rows[3];
        for (int k = 0; k < 3; k++) {
            rows[k] = iris_rows_at(&step->rows, k - 1) + from;
        }
        iris_morph_near_row(to, rows, &step->near, n);
        return;
    }
    const uint8_t *row = iris_rows_at(&step->rows, 0);
    const uint8_t *parts[8]; /* one to three runs above, as many below, and the center */
    parts[0] = row;
    add_line(step, iris_rows_at(&step->rows, step->below));
    int count = add_runs(parts, 0, step, step->below + 1, step->above);
    count = add_runs(parts, count, step, 0, step->below);
    count = add_center(parts, count, step);
    const uint8_t *joined = parts[0] + from;
    for (int i = 1; i == 1 || i < count; i += 2) {
        const uint8_t *next = parts[i < count ? i : 0] + from;
        step->join(to, joined, next, i + 1 < count ? parts[i + 1] + from : next, n);
        joined = to;
    }
    if (step->element.exclude_center && step->left > 0 && step->right > 0) {
        const uint8_t *other = join_span(step, step->run, row, 1, step->right) + from;
        step->join(to, to, other, other, n);
    }
}
