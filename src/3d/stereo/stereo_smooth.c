#include <string.h>

#include "../../foundation/kernel.h"
#include "iris/3d/stereo.h"

/* Puts a match among those that are sorted. */
static int insert(uint16_t *sorted, int count, uint16_t value)
{
    int at = count;
    for (; at > 0 && sorted[at - 1] > value; at--) {
        sorted[at] = sorted[at - 1];
    }
    sorted[at] = value;
    return count + 1;
}

static uint16_t median_at(const uint16_t *const rows[5], int32_t x, int32_t w)
{
    uint16_t sorted[25] = {0};
    int count = 0;
    int32_t first = x < 2 ? 0 : x - 2, last = x > w - 3 ? w - 1 : x + 2;
    for (int k = 0; k < 5; k++) {
        for (int32_t i = first; i <= last && rows[k]; i++) {
            if (rows[k][i] != 0) {
                count = insert(sorted, count, rows[k][i]);
            }
        }
    }
    return sorted[(count - 1) / 2];
}

/* Is there a place without a match in this column? */
static int has_hole(const uint16_t *const rows[5], int32_t x)
{
    return rows[0][x] == 0 || rows[1][x] == 0 || rows[2][x] == 0 || rows[3][x] == 0 || rows[4][x] == 0;
}

/* All medians of a row, and then again those near its ends and around places without a match. */
static void smooth_row(uint16_t *row, const uint16_t *const rows[5], int32_t w)
{
    int32_t hole = -3; /* the last column with one */
    if (w < 5 || !rows[0] || !rows[1] || !rows[3] || !rows[4]) {
        for (int32_t x = 0; x < w; x++) {
            row[x] = rows[2][x] == 0 ? 0 : median_at(rows, x, w);
        }
        return;
    }
    const uint16_t *const inner[5] = {rows[0] + 2, rows[1] + 2, rows[2] + 2, rows[3] + 2, rows[4] + 2};
    iris_row_median25_u16(row + 2, inner, w - 4);
    hole = has_hole(rows, 0) ? 0 : hole;
    hole = has_hole(rows, 1) ? 1 : hole;
    for (int32_t x = 0; x < w; x++) {
        hole = x + 2 < w && has_hole(rows, x + 2) ? x + 2 : hole;
        if (x < 2 || x >= w - 2 || hole >= x - 2) {
            row[x] = rows[2][x] == 0 ? 0 : median_at(rows, x, w);
        }
    }
}

iris_status iris_stereo_smooth(const iris_image *disparity, iris_scratch *scratch)
{
    iris_status status = disparity && scratch ? iris_image_check(disparity) : IRIS_ERR_ARG;
    if (status == IRIS_OK && disparity->format != IRIS_GRAY_U16) {
        status = IRIS_ERR_FORMAT;
    }
    if (status != IRIS_OK) {
        return status;
    }
    /* As they were: the row worked on, and the two above it, in turn. */
    uint16_t *was[3];
    size_t mark = iris_scratch_mark(scratch), bytes = 2 * (size_t)disparity->w;
    for (int i = 0; i < 3; i++) {
        was[i] = iris_scratch_take(scratch, bytes);
    }
    int32_t h = disparity->h;
    for (int32_t y = 0; y < h && was[2]; y++) {
        uint16_t *row = iris_image_row(disparity, y);
        memcpy(was[y % 3], row, bytes);
        const uint16_t *rows[5] = {y > 1 ? was[(y - 2) % 3] : NULL, y > 0 ? was[(y - 1) % 3] : NULL,
                                   was[y % 3], y < h - 1 ? iris_image_row(disparity, y + 1) : NULL,
                                   y < h - 2 ? iris_image_row(disparity, y + 2) : NULL};
        smooth_row(row, rows, disparity->w);
    }
    iris_scratch_release(scratch, mark);
    return was[2] ? IRIS_OK : IRIS_ERR_SCRATCH;
}
