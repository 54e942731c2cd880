#include "iris/xt/blur.h"

#include "../../foundation/kernel.h"
#include "../../foundation/rows.h"
#include "../../foundation/views.h"

/* The sums of a window above row 0: it moves down when that row is made. */
static void start(uint16_t *columns, const iris_rows *rows, iris_rows_window window, int32_t n)
{
    int32_t before = window.left * rows->channels;
    for (int32_t i = 0; i < n; i++) {
        columns[i] = 0;
    }
    for (int32_t dy = -window.above - 1; dy < window.below; dy++) {
        const uint8_t *row = iris_rows_at(rows, dy) - before;
        for (int32_t i = 0; i < n; i++) {
            columns[i] = (uint16_t)(columns[i] + row[i]);
        }
    }
}

/* The row that the window is around. Nine samples are added anew, more by what enters the window and what leaves it. */
static void make_row(const iris_image *dst, const iris_rows *rows, int32_t side, uint16_t *columns)
{
    const iris_rows_window *window = &rows->window;
    const int32_t channels = rows->channels, before = window->left * channels;
    int32_t first, end;
    if (side != 3) {
        iris_row_slide_u16(columns, iris_rows_at(rows, window->below) - before,
                           iris_rows_at(rows, -window->above - 1) - before,
                           (rows->src->w + side - 1) * channels);
    }
    if (!iris_rows_span(&first, &end, rows)) {
        return;
    }
    uint8_t *to = (uint8_t *)iris_image_row(dst, rows->y) + first * channels;
    const int32_t samples = (end - first) * channels;
    if (side == 3) {
        const uint8_t *three[3];
        for (int32_t k = 0; k < 3; k++) {
            three[k] = iris_rows_at(rows, k - 1) + first * channels;
        }
        iris_row_box9_u8(to, columns, three, channels, samples);
    } else {
        iris_row_box_mean_u8(to, columns + first * channels, side, channels, samples);
    }
}

iris_status iris_blur_box(const iris_image *dst, const iris_image *src, int32_t side, iris_border border,
                          iris_scratch *scratch)
{
    iris_status status = iris_views_check_levels(dst, src, border);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    if (side < 1 || side > IRIS_BLUR_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    iris_rows_window window = {(side - 1) / 2, side / 2, (side - 1) / 2, side / 2};
    iris_rows_window with_leaving = {window.left, window.right, window.above + 1, window.below};
    size_t mark = iris_scratch_mark(scratch);
    iris_rows rows;
    status = iris_rows_begin(&rows, src, with_leaving, border, scratch);
    int32_t channels = status == IRIS_OK ? rows.channels : 1;
    int32_t n = (src->w + side - 1) * channels;
    uint16_t *columns = (uint16_t *)iris_scratch_take(scratch, sizeof(uint16_t) * (size_t)n);
    if (status != IRIS_OK || !columns) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    if (side != 3) {
        start(columns, &rows, window, n);
    }
    rows.window = window; /* what iris_rows_span goes by */
    for (; rows.y < src->h; iris_rows_next(&rows)) {
        make_row(dst, &rows, side, columns);
    }
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}
