#include "iris/xt/threshold.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"
#include "../tone/histogram_gray.h"

static iris_status check(const iris_image *mask, const iris_image *gray, iris_select select)
{
    if (select != IRIS_SELECT_BRIGHT && select != IRIS_SELECT_DARK) {
        return IRIS_ERR_ARG;
    }
    return iris_views_check_formats(mask, IRIS_MASK1, gray, IRIS_GRAY8);
}

/* A finished row of "bright" becomes a row of `select`. */
static void row_select(uint32_t *row, int32_t w, iris_select select)
{
    if (select == IRIS_SELECT_BRIGHT) {
        return;
    }
    for (int32_t word = 0; word < w / 32; word++) {
        row[word] = ~row[word];
    }
    if (w % 32 != 0) {
        row[w / 32] ^= ((uint32_t)1 << w % 32) - 1;
    }
}

iris_status iris_threshold(const iris_image *mask, const iris_image *gray, uint8_t value, iris_select select)
{
    iris_status status = check(mask, gray, select);
    if (status != IRIS_OK) {
        return status;
    }
    for (int32_t y = 0; y < gray->h; y++) {
        uint32_t *row = (uint32_t *)iris_image_row(mask, y);
        iris_row_above_u8(row, (const uint8_t *)iris_image_row(gray, y), value, gray->w);
        row_select(row, gray->w, select);
    }
    return IRIS_OK;
}

iris_status iris_threshold_otsu(uint8_t *value, const iris_image *mask, const iris_image *gray,
                                iris_select select, iris_scratch *scratch)
{
    iris_status status = check(mask, gray, select);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    size_t start = iris_scratch_mark(scratch);
    uint32_t *histogram = (uint32_t *)iris_scratch_take(scratch, IRIS_THRESHOLD_OTSU_SCRATCH_BYTES);
    if (!histogram) {
        return IRIS_ERR_SCRATCH;
    }
    memset(histogram, 0, IRIS_THRESHOLD_OTSU_SCRATCH_BYTES);
    iris_histogram_count_gray(histogram, gray);
    uint8_t found;
    status = iris_otsu_value(&found, histogram);
    iris_scratch_release(scratch, start);
    if (status != IRIS_OK) {
        return status;
    }
    if (value) {
        *value = found;
    }
    return iris_threshold(mask, gray, found, select);
}

/* Row y of the image continued upwards and downwards by its first and last row. */
static const uint8_t *row_replicated(const iris_image *gray, int32_t y)
{
    return (const uint8_t *)iris_image_row(gray, y < 0 ? 0 : y < gray->h ? y : gray->h - 1);
}

/* The sums of each column over the rows -radius..radius, the window of row 0. */
static void columns_start(uint32_t *columns, const iris_image *gray, int32_t radius)
{
    for (int32_t x = 0; x < gray->w; x++) {
        columns[x] = 0;
    }
    for (int32_t y = -radius; y <= radius; y++) {
        const uint8_t *row = row_replicated(gray, y);
        for (int32_t x = 0; x < gray->w; x++) {
            columns[x] += row[x];
        }
    }
}

iris_status iris_threshold_adaptive(const iris_image *mask, const iris_image *gray, int32_t radius, int32_t c,
                                    iris_select select, iris_scratch *scratch)
{
    iris_status status = check(mask, gray, select);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    if (radius < 0 || radius > IRIS_THRESHOLD_RADIUS_MAX || c < -255 || c > 255) {
        return IRIS_ERR_RANGE;
    }
    size_t start = iris_scratch_mark(scratch);
    uint32_t *padded = (uint32_t *)iris_scratch_take(scratch, IRIS_THRESHOLD_SCRATCH_BYTES(gray->w, radius));
    if (!padded) {
        return IRIS_ERR_SCRATCH;
    }
    uint32_t *columns = padded + radius;
    uint32_t *behind = columns + gray->w;
    columns_start(columns, gray, radius);
    for (int32_t y = 0; y < gray->h; y++) {
        for (int32_t i = 0; i < radius; i++) {
            padded[i] = columns[0];
            behind[i] = behind[-1];
        }
        uint32_t *row = (uint32_t *)iris_image_row(mask, y);
        iris_row_above_mean_u8(row, row_replicated(gray, y), padded, (iris_row_window){2 * radius + 1, c},
                               gray->w);
        row_select(row, gray->w, select);
        iris_row_slide_u32(columns, row_replicated(gray, y + radius + 1), row_replicated(gray, y - radius),
                           gray->w);
    }
    iris_scratch_release(scratch, start);
    return IRIS_OK;
}
