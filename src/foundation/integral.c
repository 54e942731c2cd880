#include "iris/integral.h"

#include <string.h>

#include "kernel.h"

/* ---- rows: dst[x] = above[x] + the sum of the values before x, for x from 0 to n ---- */

static void sum_row(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n)
{
    dst[0] = 0;
    iris_row_integral_u8(dst + 1, above + 1, src, n);
}

static void sum_squares_row(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n)
{
    uint32_t sum = 0;
    dst[0] = 0;
    for (int32_t x = 0; x < n; x++) {
        sum += (uint32_t)src[x] * src[x];
        dst[x + 1] = above[x + 1] + sum;
    }
}

static void sum_mask_row(uint32_t *dst, const uint32_t *above, const uint32_t *mask, int32_t n)
{
    uint32_t sum = 0;
    dst[0] = 0;
    for (int32_t x = 0; x < n; x++) {
        sum += mask[x / 32] >> (x % 32) & 1u;
        dst[x + 1] = above[x + 1] + sum;
    }
}

static iris_status check_making(const iris_image *integral, const iris_image *src, int takes_mask)
{
    if (iris_image_check(integral) != IRIS_OK || iris_image_check(src) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (integral->format != IRIS_GRAY_U32 ||
        (src->format != IRIS_GRAY8 && !(takes_mask && src->format == IRIS_MASK1))) {
        return IRIS_ERR_FORMAT;
    }
    if (integral->w != src->w + 1 || integral->h != src->h + 1) {
        return IRIS_ERR_RANGE;
    }
    return iris_image_overlaps(integral, src) ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_integral(const iris_image *integral, const iris_image *src)
{
    iris_status status = check_making(integral, src, 1);
    if (status != IRIS_OK) {
        return status;
    }
    memset(iris_image_row(integral, 0), 0, sizeof(uint32_t) * (size_t)integral->w);
    for (int32_t y = 0; y < src->h; y++) {
        const void *row = iris_image_row(src, y);
        const uint32_t *above = (const uint32_t *)iris_image_row(integral, y);
        uint32_t *dst = (uint32_t *)iris_image_row(integral, y + 1);
        if (src->format == IRIS_MASK1) {
            sum_mask_row(dst, above, (const uint32_t *)row, src->w);
        } else {
            sum_row(dst, above, (const uint8_t *)row, src->w);
        }
    }
    return IRIS_OK;
}

iris_status iris_integral_squares(const iris_image *squares, const iris_image *src)
{
    iris_status status = check_making(squares, src, 0);
    if (status != IRIS_OK) {
        return status;
    }
    memset(iris_image_row(squares, 0), 0, sizeof(uint32_t) * (size_t)squares->w);
    for (int32_t y = 0; y < src->h; y++) {
        sum_squares_row((uint32_t *)iris_image_row(squares, y + 1),
                        (const uint32_t *)iris_image_row(squares, y), (const uint8_t *)iris_image_row(src, y),
                        src->w);
    }
    return IRIS_OK;
}

/* ---- boxes ---- */

static iris_status check_box(const iris_image *integral, iris_rect box, int32_t most_pixels)
{
    if (iris_image_check(integral) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (integral->format != IRIS_GRAY_U32) {
        return IRIS_ERR_FORMAT;
    }
    if (box.x < 0 || box.y < 0 || box.w < 1 || box.h < 1 || box.x >= integral->w - box.w ||
        box.y >= integral->h - box.h || box.w > most_pixels / box.h) {
        return IRIS_ERR_RANGE;
    }
    return IRIS_OK;
}

static uint32_t box_sum(const iris_image *integral, iris_rect box)
{
    const uint32_t *top = (const uint32_t *)iris_image_row(integral, box.y) + box.x;
    const uint32_t *bottom = (const uint32_t *)iris_image_row(integral, box.y + box.h) + box.x;
    return bottom[box.w] - bottom[0] - top[box.w] + top[0];
}

/* a / b with 16 fraction bits, rounded half up. a below 2^49, b below 2^33. */
static iris_q16 quotient_q16(uint64_t a, uint64_t b)
{
    uint64_t whole = a / b, rest = a % b;
    if (whole > 32767) {
        return INT32_MAX; /* of what is no integral image */
    }
    return iris_sat_s32((int64_t)((whole << 16) + ((rest << 16) + b / 2) / b));
}

iris_status iris_integral_sum(uint32_t *sum, const iris_image *integral, iris_rect box)
{
    iris_status status = sum ? check_box(integral, box, INT32_MAX) : IRIS_ERR_ARG;
    if (status == IRIS_OK) {
        *sum = box_sum(integral, box);
    }
    return status;
}

iris_status iris_integral_mean(iris_q16 *mean_q16, const iris_image *integral, iris_rect box)
{
    iris_status status = mean_q16 ? check_box(integral, box, IRIS_INTEGRAL_SUM_PIXELS) : IRIS_ERR_ARG;
    if (status == IRIS_OK) {
        *mean_q16 = quotient_q16(box_sum(integral, box), (uint64_t)box.w * (uint64_t)box.h);
    }
    return status;
}

/* (n * sum of squares - sum^2) / n^2: below 2^49 by 2^33. */
iris_status iris_integral_variance(iris_q16 *variance_q16, const iris_image *integral,
                                   const iris_image *squares, iris_rect box)
{
    iris_status status = variance_q16 ? check_box(integral, box, IRIS_INTEGRAL_SQUARES_PIXELS) : IRIS_ERR_ARG;
    if (status == IRIS_OK) {
        status = check_box(squares, box, IRIS_INTEGRAL_SQUARES_PIXELS);
    }
    if (status == IRIS_OK && (integral->w != squares->w || integral->h != squares->h)) {
        status = IRIS_ERR_RANGE;
    }
    if (status != IRIS_OK) {
        return status;
    }
    uint64_t n = (uint64_t)box.w * (uint64_t)box.h, sum = box_sum(integral, box);
    uint64_t of_squares = n * box_sum(squares, box);
    *variance_q16 = quotient_q16(of_squares > sum * sum ? of_squares - sum * sum : 0, n * n);
    return IRIS_OK;
}
