#include "rows.h"

#include <string.h>

/* The samples of row y of src, into a slot. */
static void copy_samples(uint8_t *to, const iris_rows *rows, int32_t y)
{
    const uint8_t *from = (const uint8_t *)iris_image_row(rows->src, y);
    if (rows->src->format != IRIS_HSL24) {
        memcpy(to, from, (size_t)rows->src->w * (size_t)rows->channels);
        return;
    }
    for (int32_t x = 0; x < rows->src->w; x++) {
        to[x] = from[3 * x + 2];
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

static void load_next(iris_rows *rows)
{
    uint8_t *row = rows->ring + (size_t)(rows->loaded % rows->slots) * rows->slot_bytes;
    copy_samples(row, rows, rows->loaded);
    for (int32_t x = -rows->window.left; x < 0; x++) {
        continue_at(row, rows, x);
    }
    for (int32_t x = 0; x < rows->window.right; x++) {
        continue_at(row, rows, rows->src->w + x);
    }
    rows->loaded++;
}

iris_status iris_rows_begin(iris_rows *rows, const iris_image *src, iris_rows_window window,
                            iris_border border, iris_scratch *scratch)
{
    int32_t channels = src->format == IRIS_RGB888 || src->format == IRIS_BGR888 ? 3 : 1;
    int32_t reach = window.above > window.below ? window.above : window.below;
    size_t before = IRIS_SCRATCH_ROUND(window.left * channels);
    size_t samples = (size_t)src->w * (size_t)channels;
    size_t after = (size_t)window.right * (size_t)channels;
    size_t bytes = IRIS_BORDER_ROWS_BYTES(samples, before, after, reach);
    uint8_t *memory = (uint8_t *)iris_scratch_take(scratch, bytes);
    if (!memory) {
        return IRIS_ERR_SCRATCH;
    }
    *rows = (iris_rows){.src = src, .window = window, .border = border, .channels = channels, .reach = reach};
    rows->slots = 2 * reach + 1;
    rows->slot_bytes = IRIS_SCRATCH_ROUND(before + samples + after);
    rows->level = memory + before;
    rows->ring = rows->level + rows->slot_bytes;
    memset(memory, border.value, rows->slot_bytes);
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
    int32_t row = iris_border_index(rows->y + dy, rows->src->h, rows->border.rule);
    return row < 0 ? rows->level : rows->ring + (size_t)(row % rows->slots) * rows->slot_bytes;
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
