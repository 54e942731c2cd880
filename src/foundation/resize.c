#include "iris/copy.h"

#include <string.h>

#include "kernel.h"
#include "views.h"

enum { FRACTION_BITS = 11, FRACTION_ONE = IRIS_ROW_WHOLE };

/* floor((first + i * step) / divisor) for i = 0, 1, 2, ... without a division per step and without drift. */
typedef struct {
    int32_t value, rest; /* now: value + rest / divisor */
    int32_t step, rest_step, divisor;
} walk;

static walk walk_begin(int32_t first, int32_t step, int32_t divisor)
{
    walk w = {first / divisor, first % divisor, step / divisor, step % divisor, divisor};
    if (w.rest < 0) {
        w.rest += divisor;
        w.value--;
    }
    return w;
}

static void walk_next(walk *w)
{
    w->value += w->step;
    w->rest += w->rest_step;
    if (w->rest >= w->divisor) {
        w->rest -= w->divisor;
        w->value++;
    }
}

/* The nearest src pixel: floor((i + 0.5) * src / dst). Below 2^31: (2 * 32766 + 1) * 32767. */
static walk walk_nearest(int32_t dst_side, int32_t src_side)
{
    return walk_begin(src_side, 2 * src_side, 2 * dst_side);
}

/* The position (i + 0.5) * src / dst - 0.5 in 1/2048 pixel, rounded half up. */
static walk walk_between(int32_t dst_side, int32_t src_side)
{
    return walk_begin((src_side - dst_side) * FRACTION_ONE + dst_side, 2 * FRACTION_ONE * src_side,
                      2 * dst_side);
}

/* A place on an axis: between a pixel and the next one, with the weight of that. On an axis of one pixel there is no next
 * one, and it has no weight. */
typedef struct {
    int32_t first;
    uint32_t weight;
} place;

static place place_at(int32_t position, int32_t side)
{
    int32_t last = side - 1;
    if (position <= 0 || last == 0) {
        return (place){0, 0};
    }
    if (position >= last * FRACTION_ONE) {
        return (place){last - 1, FRACTION_ONE};
    }
    return (place){position >> FRACTION_BITS, (uint32_t)position & (FRACTION_ONE - 1u)};
}

static iris_status check_resize(const iris_image *dst, const iris_image *src)
{
    iris_status status = iris_image_check(dst);
    if (status == IRIS_OK) {
        status = iris_image_check(src);
    }
    if (status != IRIS_OK) {
        return status;
    }
    if (dst->format != src->format || !iris_format_is_levels(dst->format)) {
        return IRIS_ERR_FORMAT;
    }
    return iris_image_overlaps(dst, src) ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_resize_nearest(const iris_image *dst, const iris_image *src)
{
    iris_status status = check_resize(dst, src);
    if (status != IRIS_OK) {
        return status;
    }
    const int32_t channels = dst->format == IRIS_GRAY8 ? 1 : 3;
    walk down = walk_nearest(dst->h, src->h);
    for (int32_t y = 0; y < dst->h; y++, walk_next(&down)) {
        uint8_t *to = iris_image_row(dst, y);
        const uint8_t *row = iris_image_row(src, down.value);
        walk across = walk_nearest(dst->w, src->w);
        for (int32_t x = 0; x < dst->w; x++, walk_next(&across)) {
            const uint8_t *from = row + across.value * channels;
            for (int32_t c = 0; c < channels; c++) {
                *to++ = from[c];
            }
        }
    }
    return IRIS_OK;
}

/* Samples that are made at once: whole pixels of one or three. */
#define PIECE 120

/* The samples x to x + n - 1 of every row of dst, of these places. A row of one pixel is read as two. */
static void blend_columns(const iris_image *dst, int32_t x, int32_t n, const iris_image *src,
                          const iris_row_places *places)
{
    const int32_t channels = dst->format == IRIS_GRAY8 ? 1 : 3;
    walk down = walk_between(dst->h, src->h);
    for (int32_t y = 0; y < dst->h; y++, walk_next(&down)) {
        place at = place_at(down.value, src->h);
        uint8_t twice[2][6];
        const uint8_t *rows[2] = {iris_image_row(src, at.first),
                                  iris_image_row(src, at.first + (at.weight > 0))};
        for (int k = 0; k < 2 && src->w == 1; k++) {
            memcpy(twice[k], rows[k], (size_t)channels);
            memcpy(twice[k] + channels, rows[k], (size_t)channels);
            rows[k] = twice[k];
        }
        iris_row_between_u8((uint8_t *)iris_image_row(dst, y) + x, rows, places, at.weight, n);
    }
}

iris_status iris_resize_bilinear(const iris_image *dst, const iris_image *src)
{
    int32_t at[PIECE];
    uint16_t weight[PIECE];
    iris_status status = check_resize(dst, src);
    if (status != IRIS_OK) {
        return status;
    }
    const int32_t channels = dst->format == IRIS_GRAY8 ? 1 : 3;
    const iris_row_places places = {at, weight, channels};
    walk across = walk_between(dst->w, src->w);
    for (int32_t x = 0, n = 0; x < dst->w; n = 0) {
        for (; x < dst->w && n < PIECE; x++, walk_next(&across)) {
            place column = place_at(across.value, src->w);
            for (int32_t c = 0; c < channels; c++, n++) {
                at[n] = column.first * channels + c;
                weight[n] = (uint16_t)column.weight;
            }
        }
        blend_columns(dst, x * channels - n, n, src, &places);
    }
    return IRIS_OK;
}

/* The src pixels under one dst pixel on one axis, from first to last. A src pixel is dst_side units long and a dst
 * pixel src_side units: lengths on this axis are whole numbers below 2^15, places below 2^30. */
typedef struct {
    int32_t first, last;
    uint32_t first_part, part,
        last_part; /* of the first, of those between, of the last; one pixel: first_part */
} cover;

/* Where dst pixel i begins, in src pixels: i * src / dst. */
static walk walk_edges(int32_t dst_side, int32_t src_side)
{
    return walk_begin(0, src_side, dst_side);
}

/* The dst pixel that begins at *edge; moves on to its end. */
static cover cover_next(walk *edge, int32_t src_side)
{
    walk end = *edge;
    walk_next(&end);
    cover c = {edge->value, end.value, (uint32_t)(edge->divisor - edge->rest), (uint32_t)edge->divisor,
               (uint32_t)end.rest};
    if (end.rest == 0) {
        c.last--;
        c.last_part = c.part;
    }
    if (c.first == c.last) {
        c.first_part = (uint32_t)src_side;
    }
    *edge = end;
    return c;
}

/* The weighed sum of a row under a dst pixel, one channel: at most 255 * 32767. */
static uint32_t sum_across(const uint8_t *row, const cover *c, int32_t channels)
{
    uint32_t sum = row[c->first * channels] * c->first_part, between = 0;
    if (c->first == c->last) {
        return sum;
    }
    for (int32_t x = c->first + 1; x < c->last; x++) {
        between += row[x * channels];
    }
    return sum + between * c->part + row[c->last * channels] * c->last_part;
}

/* The sum under a dst pixel, one channel: below 2^38. */
static uint64_t sum_area(const iris_image *src, const cover *rows, const cover *columns, int32_t channel)
{
    const int32_t channels = src->format == IRIS_GRAY8 ? 1 : 3;
    uint64_t sum = 0;
    for (int32_t y = rows->first; y <= rows->last; y++) {
        uint32_t part = y == rows->first ? rows->first_part : y == rows->last ? rows->last_part : rows->part;
        const uint8_t *row = iris_image_row(src, y);
        sum += (uint64_t)sum_across(row + channel, columns, channels) * part;
    }
    return sum;
}

/* To half of both sides: the mean of four, without a division. */
static void halve(const iris_image *dst, const iris_image *src)
{
    const int32_t channels = dst->format == IRIS_GRAY8 ? 1 : 3;
    for (int32_t y = 0; y < dst->h; y++) {
        uint8_t *to = iris_image_row(dst, y);
        const uint8_t *upper = iris_image_row(src, 2 * y), *lower = iris_image_row(src, 2 * y + 1);
        if (channels == 1) {
            iris_row_halve2_u8(to, upper, lower, dst->w);
            continue;
        }
        for (int32_t x = 0; x < dst->w; x++, upper += channels, lower += channels) {
            for (int32_t c = 0; c < channels; c++, upper++, lower++) {
                *to++ =
                    (uint8_t)(((uint32_t)upper[0] + upper[channels] + lower[0] + lower[channels] + 2u) >> 2);
            }
        }
    }
}

iris_status iris_resize_area(const iris_image *dst, const iris_image *src)
{
    iris_status status = check_resize(dst, src);
    if (status != IRIS_OK) {
        return status;
    }
    const int32_t channels = dst->format == IRIS_GRAY8 ? 1 : 3;
    if (src->w == 2 * dst->w && src->h == 2 * dst->h) {
        halve(dst, src);
        return IRIS_OK;
    }
    const uint64_t area = (uint64_t)src->w * (uint64_t)src->h;
    walk down = walk_edges(dst->h, src->h);
    for (int32_t y = 0; y < dst->h; y++) {
        uint8_t *to = iris_image_row(dst, y);
        cover rows = cover_next(&down, src->h);
        walk across = walk_edges(dst->w, src->w);
        for (int32_t x = 0; x < dst->w; x++) {
            cover columns = cover_next(&across, src->w);
            for (int32_t c = 0; c < channels; c++) {
                *to++ = (uint8_t)((sum_area(src, &rows, &columns, c) + area / 2) / area);
            }
        }
    }
    return IRIS_OK;
}
