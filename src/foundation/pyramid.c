#include "iris/pyramid.h"

#include "kernel.h"
#include "rows.h"
#include "views.h"

/* The rows around a row, and their weighed sums with what lies beyond the edges. */
typedef struct {
    iris_rows rows;
    int32_t beyond; /* samples on each side: the channels times 2 going down, times 1 going up */
    uint16_t *sums; /* of sample 0; at most 16 * 255 */
} sum_rows;

static iris_status sum_rows_begin(sum_rows *sum, const iris_image *src, int32_t reach, iris_border border,
                                  iris_scratch *scratch)
{
    iris_status status =
        iris_rows_begin(&sum->rows, src, (iris_rows_window){reach, reach, reach, reach}, border, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    sum->beyond = reach * sum->rows.channels;
    size_t samples = (size_t)src->w * (size_t)sum->rows.channels + 2 * (size_t)sum->beyond;
    uint16_t *sums = (uint16_t *)iris_scratch_take(scratch, sizeof *sums * samples);
    if (!sums) {
        return IRIS_ERR_SCRATCH;
    }
    sum->sums = sums + sum->beyond;
    return IRIS_OK;
}

static iris_status check(const iris_image *dst, const iris_image *src, iris_border_rule rule)
{
    if (iris_image_check(dst) != IRIS_OK || iris_image_check(src) != IRIS_OK ||
        (unsigned)rule > IRIS_BORDER_SKIP) {
        return IRIS_ERR_ARG;
    }
    if (dst->format != src->format || !iris_format_is_levels(src->format)) {
        return IRIS_ERR_FORMAT;
    }
    return iris_image_overlaps(dst, src) ? IRIS_ERR_ALIAS : IRIS_OK;
}

/* ---- down ---- */

static iris_status check_down(const iris_image *dst, const iris_image *src, iris_border_rule rule)
{
    iris_status status = check(dst, src, rule);
    if (status == IRIS_ERR_ARG || status == IRIS_ERR_FORMAT) {
        return status;
    }
    return dst->w != (src->w + 1) / 2 || dst->h != (src->h + 1) / 2 ? IRIS_ERR_RANGE : status;
}

/* 1 4 6 4 1 of the rows. */
static void sum_five_rows(sum_rows *sum)
{
    const uint8_t *rows[5];
    for (int32_t i = 0; i < 5; i++) {
        rows[i] = iris_rows_at(&sum->rows, i - 2) - sum->beyond;
    }
    iris_row_binomial5_u8(sum->sums - sum->beyond, rows,
                          sum->rows.src->w * sum->rows.channels + 2 * sum->beyond);
}

/* 1 4 6 4 1 of the sums around each second pixel: to dst pixels x to below end. */
static void halve_row(uint8_t *dst, const sum_rows *sum, int32_t x, int32_t end)
{
    const int32_t step = sum->rows.channels;
    if (step == 1) {
        iris_row_halve_u16(dst + x, sum->sums + 2 * x, end - x);
        return;
    }
    for (; x < end; x++) {
        for (int32_t c = 0; c < step; c++) {
            const uint16_t *s = sum->sums + 2 * x * step + c;
            uint32_t outer = (uint32_t)s[-2 * step] + s[2 * step], inner = (uint32_t)s[-step] + s[step];
            dst[x * step + c] = (uint8_t)((outer + 4u * inner + 6u * s[0] + 128u) >> 8);
        }
    }
}

static iris_status run_down(const iris_image *dst, const iris_image *src, iris_border border,
                            iris_scratch *scratch)
{
    size_t mark = iris_scratch_mark(scratch);
    sum_rows sum;
    iris_status status = sum_rows_begin(&sum, src, 2, border, scratch);
    for (; status == IRIS_OK && sum.rows.y < src->h; iris_rows_next(&sum.rows)) {
        int32_t first, end;
        if (sum.rows.y % 2 == 0 && iris_rows_span(&first, &end, &sum.rows)) {
            sum_five_rows(&sum);
            halve_row(iris_image_row(dst, sum.rows.y / 2), &sum, (first + 1) / 2, (end + 1) / 2);
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}

iris_status iris_pyramid_down(const iris_image *dst, const iris_image *src, iris_border border,
                              iris_scratch *scratch)
{
    iris_status status = scratch ? check_down(dst, src, border.rule) : IRIS_ERR_ARG;
    return status == IRIS_OK ? run_down(dst, src, border, scratch) : status;
}

/* ---- all levels ---- */

iris_status iris_pyramid_wrap(iris_pyramid *pyramid, const iris_image *src, int32_t levels, void *memory,
                              size_t bytes)
{
    if (!pyramid || iris_image_check(src) != IRIS_OK || (levels > 1 && !memory)) {
        return IRIS_ERR_ARG;
    }
    if (!iris_format_is_levels(src->format)) {
        return IRIS_ERR_FORMAT;
    }
    const size_t channels = src->format == IRIS_GRAY8 ? 1 : 3;
    if (levels < 1 || levels > IRIS_PYRAMID_LEVELS_MAX ||
        bytes < IRIS_PYRAMID_BYTES(src->w, src->h, channels, levels)) {
        return IRIS_ERR_RANGE;
    }
    iris_pyramid made = {.level = {*src}, .levels = levels};
    uint8_t *next = (uint8_t *)memory;
    for (int32_t i = 1; i < levels; i++) {
        iris_image *level = &made.level[i];
        level->data = next;
        level->w = (int32_t)IRIS_PYRAMID_SIDE(src->w, i);
        level->h = (int32_t)IRIS_PYRAMID_SIDE(src->h, i);
        level->stride = (ptrdiff_t)channels * level->w;
        level->format = src->format;
        next += (size_t)level->stride * (size_t)level->h;
        if (iris_image_overlaps(level, src)) {
            return IRIS_ERR_ALIAS;
        }
    }
    *pyramid = made;
    return IRIS_OK;
}

iris_status iris_pyramid_build(const iris_pyramid *pyramid, iris_border border, iris_scratch *scratch)
{
    if (!pyramid || !scratch || border.rule == IRIS_BORDER_SKIP || pyramid->levels < 1 ||
        pyramid->levels > IRIS_PYRAMID_LEVELS_MAX) {
        return IRIS_ERR_ARG;
    }
    iris_status status = IRIS_OK;
    for (int32_t i = 1; status == IRIS_OK && i < pyramid->levels; i++) {
        status = check_down(&pyramid->level[i], &pyramid->level[i - 1], border.rule);
    }
    for (int32_t i = 1; status == IRIS_OK && i < pyramid->levels; i++) {
        status = run_down(&pyramid->level[i], &pyramid->level[i - 1], border, scratch);
    }
    return status;
}

/* ---- up ---- */

static iris_status check_up(const iris_image *dst, const iris_image *src, iris_border_rule rule)
{
    iris_status status = check(dst, src, rule);
    if (status == IRIS_ERR_ARG || status == IRIS_ERR_FORMAT) {
        return status;
    }
    return (dst->w + 1) / 2 != src->w || (dst->h + 1) / 2 != src->h ? IRIS_ERR_RANGE : status;
}

/* 1 6 1 of the rows, or 4 4 of this one and the next. */
static void sum_three_rows(sum_rows *sum, int between)
{
    const uint8_t *above = iris_rows_at(&sum->rows, -1), *row = iris_rows_at(&sum->rows, 0);
    const uint8_t *below = iris_rows_at(&sum->rows, 1);
    const uint32_t upper = between ? 0 : 1, middle = between ? 4 : 6, lower = between ? 4 : 1;
    int32_t end = sum->rows.src->w * sum->rows.channels + sum->beyond;
    for (int32_t x = -sum->beyond; x < end; x++) {
        sum->sums[x] = (uint16_t)(upper * above[x] + middle * row[x] + lower * below[x]);
    }
}

/* The dst pixels that belong to src pixels x to below end. An odd width has no second one at the last of them. */
static void double_row(const iris_image *dst, int32_t y, const sum_rows *sum, int32_t x, int32_t end)
{
    const int32_t step = sum->rows.channels, pairs = end < dst->w / 2 ? end : dst->w / 2;
    const uint16_t *s = sum->sums + x * step;
    uint8_t *to = (uint8_t *)iris_image_row(dst, y) + 2 * x * step;
    for (; x < pairs; x++, to += step) {
        for (int32_t c = 0; c < step; c++, s++, to++) {
            to[0] = (uint8_t)(((uint32_t)s[-step] + 6u * s[0] + s[step] + 32u) >> 6);
            to[step] = (uint8_t)((4u * ((uint32_t)s[0] + s[step]) + 32u) >> 6);
        }
    }
    for (int32_t c = 0; x < end && c < step; c++, s++) {
        to[c] = (uint8_t)(((uint32_t)s[-step] + 6u * s[0] + s[step] + 32u) >> 6);
    }
}

iris_status iris_pyramid_up(const iris_image *dst, const iris_image *src, iris_border border,
                            iris_scratch *scratch)
{
    iris_status status = scratch ? check_up(dst, src, border.rule) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    sum_rows sum;
    status = sum_rows_begin(&sum, src, 1, border, scratch);
    for (; status == IRIS_OK && sum.rows.y < src->h; iris_rows_next(&sum.rows)) {
        int32_t first, end;
        for (int32_t i = 0; i < 2 && iris_rows_span(&first, &end, &sum.rows); i++) {
            int32_t y = 2 * sum.rows.y + i;
            if (y < dst->h) {
                sum_three_rows(&sum, i);
                double_row(dst, y, &sum, first, end);
            }
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}
