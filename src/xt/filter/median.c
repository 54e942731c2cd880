#include "iris/xt/median.h"

#include "../../foundation/kernel.h"
#include "../../foundation/rows.h"
#include "../../foundation/views.h"

static void row_of_3(uint8_t *dst, const iris_rows *rows, int32_t from, int32_t n)
{
    const uint8_t *around[3];
    for (int32_t i = 0; i < 3; i++) {
        around[i] = iris_rows_at(rows, i - 1) + from;
    }
    iris_row_median9_u8(dst + from, around, rows->channels, n);
}

/* sorted: 5 rows, each of `bytes` bytes. */
static void row_of_5(uint8_t *dst, const iris_rows *rows, int32_t from, int32_t n, uint8_t *sorted,
                     size_t bytes)
{
    const uint8_t *around[5], *ranks[5];
    uint8_t *room[5];
    int32_t beyond = 2 * rows->channels;
    for (int32_t i = 0; i < 5; i++) {
        around[i] = iris_rows_at(rows, i - 2) + from - beyond;
        room[i] = sorted + (size_t)i * bytes;
        ranks[i] = room[i] + beyond;
    }
    iris_row_sort5_u8(room, around, n + 2 * beyond);
    iris_row_median25_u8(dst + from, ranks, rows->channels, n);
}

static iris_status median(const iris_image *dst, const iris_image *src, int32_t side, iris_border border,
                          iris_scratch *scratch)
{
    int32_t reach = side / 2;
    iris_rows rows;
    iris_status status =
        iris_rows_begin(&rows, src, (iris_rows_window){reach, reach, reach, reach}, border, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    size_t bytes = IRIS_SCRATCH_ROUND((size_t)rows.channels * ((size_t)src->w + 4));
    uint8_t *sorted = (uint8_t *)iris_scratch_take(scratch, side == 5 ? 5 * bytes : 0);
    if (!sorted) {
        return IRIS_ERR_SCRATCH;
    }
    for (; rows.y < src->h; iris_rows_next(&rows)) {
        int32_t first, end;
        if (!iris_rows_span(&first, &end, &rows)) {
            continue;
        }
        uint8_t *to = (uint8_t *)iris_image_row(dst, rows.y);
        int32_t from = first * rows.channels, n = (end - first) * rows.channels;
        if (side == 3) {
            row_of_3(to, &rows, from, n);
        } else {
            row_of_5(to, &rows, from, n, sorted, bytes);
        }
    }
    return IRIS_OK;
}

iris_status iris_median(const iris_image *dst, const iris_image *src, int32_t side, iris_border border,
                        iris_scratch *scratch)
{
    iris_status status = iris_views_check_levels(dst, src, border);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    if (side != 3 && side != 5) {
        return IRIS_ERR_RANGE;
    }
    size_t mark = iris_scratch_mark(scratch);
    status = median(dst, src, side, border, scratch);
    iris_scratch_release(scratch, mark);
    return status;
}
