#include "rows.h"

#include <string.h>

/* The samples of row y of src, into a slot. */
static void copy_samples(uint8_t *to, const iris_rows *rows, int32_t y)
{
    const uint8_t *from = (const uint8_t *)iris_image_row(rows->src, y);
    if (rows->src->format != IRIS_HSL24) {
        memcpy(to, from, rows->row_bytes);
        return;
    }
    for (int32_t x = 0; x < rows->src->w; x++) {
        to[x] = from[3 * x + 2];
    }
}

/* Continues a mask's row to both sides, whole words at a time where all pixels there are the same. */
static void continue_mask(uint32_t *row, const iris_rows *rows)
{
    int32_t w = rows->src->w, last = (w + rows->window.right - 1) >> 5;
    iris_border border = rows->border;
    if (border.rule == IRIS_BORDER_REFLECT101) {
        int32_t left = rows->window.left;
        for (int32_t x = left > 0 ? -left : w; x < w + rows->window.right; x = x == -1 ? w : x + 1) {
            int32_t index = iris_border_index(x, w, border.rule);
            uint32_t bit = row[index / 32] >> index % 32 & 1;
            row[x >> 5] = (row[x >> 5] & ~((uint32_t)1 << (x & 31))) | bit << (x & 31);
        }
        return;
    }
    uint32_t first = row[0] & 1, end = row[(w - 1) / 32] >> (w - 1) % 32 & 1;
    if (border.rule == IRIS_BORDER_CONSTANT) {
        first = end = border.value != 0;
    }
    for (int32_t i = (-rows->window.left) >> 5; i < 0; i++) {
        row[i] = 0 - first;
    }
    if (w % 32 != 0) {
        uint32_t beyond = ~0u << w % 32;
        row[w / 32] = (row[w / 32] & ~beyond) | ((0 - end) & beyond);
    }
    for (int32_t i = (w + 31) / 32; i <= last; i++) {
        row[i] = 0 - end;
    }
}

/* Pixel x of a slot's row, outside the picture, gets what stands for it. */
static void continue_at(uint8_t *row, const iris_rows *rows, int32_t x)
{
    int32_t channels = rows->channels;
    int32_t index = iris_border_index(x, rows->src->w, rows->border.rule);
    for (int32_t c = 0; c < channels; c++) {
        row[x * channels + c] = index < 0 ? rows->border.value : row[index * channels + c];
    }
}

static void continue_row(uint8_t *row, const iris_rows *rows)
{
    if (rows->src->format == IRIS_MASK1) {
        continue_mask((uint32_t *)(void *)row, rows);
        return;
    }
    if (rows->channels == 1 && rows->border.rule != IRIS_BORDER_REFLECT101) {
        int constant = rows->border.rule == IRIS_BORDER_CONSTANT;
        uint8_t *end = row + rows->src->w;
        memset(row - rows->window.left, constant ? rows->border.value : row[0], (size_t)rows->window.left);
        memset(end, constant ? rows->border.value : end[-1], (size_t)rows->window.right);
        return;
    }
    if (rows->channels == 1 && rows->window.left < rows->src->w && rows->window.right < rows->src->w) {
        uint8_t *end = row + rows->src->w - 1;
        for (int32_t x = 1; x <= rows->window.left; x++) {
            row[-x] = row[x];
        }
        for (int32_t x = 1; x <= rows->window.right; x++) {
            end[x] = end[-x];
        }
        return;
    }
    for (int32_t x = -rows->window.left; x < 0; x++) {
        continue_at(row, rows, x);
    }
    for (int32_t x = 0; x < rows->window.right; x++) {
        continue_at(row, rows, rows->src->w + x);
    }
}

static void load_next(iris_rows *rows)
{
    rows->last = rows->last + 1 < rows->slots ? rows->last + 1 : 0;
    uint8_t *row = rows->ring + (size_t)rows->last * rows->slot_bytes;
    if (rows->source.make) {
        rows->source.make(rows->source.user, row, rows->loaded);
    } else {
        copy_samples(row, rows, rows->loaded);
    }
    continue_row(row, rows);
    rows->loaded++;
}

iris_status iris_rows_begin(iris_rows *rows, const iris_image *src, iris_rows_window window,
                            iris_border border, iris_scratch *scratch)
{
    return iris_rows_begin_from(rows, &(iris_rows_source){.shape = src}, window, border, scratch);
}

iris_status iris_rows_begin_from(iris_rows *rows, const iris_rows_source *source, iris_rows_window window,
                                 iris_border border, iris_scratch *scratch)
{
    const iris_image *src = source->shape;
    int32_t mask = src->format == IRIS_MASK1;
    int32_t channels = src->format == IRIS_RGB888 || src->format == IRIS_BGR888 ? 3 : 1;
    int32_t reach = window.above > window.below ? window.above : window.below;
    size_t before = IRIS_SCRATCH_ROUND(mask ? (window.left + 7) / 8 : window.left * channels);
    size_t from_0 = (size_t)src->w + (size_t)window.right;
    from_0 = mask ? (from_0 + 31) / 32 * 4 : from_0 * (size_t)channels;
    uint8_t *memory = (uint8_t *)iris_scratch_take(scratch, IRIS_BORDER_ROWS_BYTES(from_0, before, 0, reach));
    if (!memory) {
        return IRIS_ERR_SCRATCH;
    }
    *rows = (iris_rows){.src = src, .window = window, .border = border, .channels = channels, .reach = reach};
    rows->source = *source;
    rows->slots = 2 * reach + 1;
    rows->last = -1;
    rows->row_bytes = iris_format_row_bytes(src->format, src->w);
    rows->slot_bytes = IRIS_SCRATCH_ROUND(before + from_0);
    rows->level = memory + before;
    rows->ring = rows->level + rows->slot_bytes;
    memset(memory, mask && border.value != 0 ? 255 : border.value, rows->slot_bytes);
    while (rows->loaded < src->h && rows->loaded <= reach) {
        load_next(rows);
    }
    return IRIS_OK;
}

void iris_rows_next(iris_rows *rows)
{
    rows->y++;
    if (rows->loaded < rows->src->h) {
        load_next(rows);
    }
}

/* A border rule never takes two rows farther apart than they were, so that what stands for row y + dy is at most `reach`
 * rows from y and still in the ring. */
const uint8_t *iris_rows_at(const iris_rows *rows, int32_t dy)
{
    int32_t row = rows->y + dy;
    if (row < 0 || row >= rows->src->h) {
        row = iris_border_index(row, rows->src->h, rows->border.rule);
    }
    if (row < 0) {
        return rows->level;
    }
    int32_t slot = rows->last - (rows->loaded - 1 - row);
    return rows->ring + (size_t)(slot < 0 ? slot + rows->slots : slot) * rows->slot_bytes;
}

int iris_rows_span(int32_t *first, int32_t *end, const iris_rows *rows)
{
    int32_t w = rows->src->w, h = rows->src->h;
    *first = 0;
    *end = w;
    if (rows->border.rule != IRIS_BORDER_SKIP) {
        return 1;
    }
    *first = rows->window.left;
    *end = w - rows->window.right;
    return *first < *end && rows->y >= rows->window.above && rows->y < h - rows->window.below;
}
