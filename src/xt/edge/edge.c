#include "iris/xt/edge.h"

#include <string.h>

#include "../../foundation/rows.h"
#include "../../foundation/views.h"
#include "../filter/log_rows.h"
#include "edge_rows.h"

void iris_edge_defaults(iris_edge_config *config)
{
    if (config) {
        *config = (iris_edge_config){IRIS_EDGE_SOBEL, IRIS_Q16_ONE / 4, 160, 91750};
    }
}

/* Rows of values, 0 until written: what is named DX to SIZE, or a ring of three; one that stays 0; and one for a row of
 * a mask. */
enum { DX, DY, SIZE, ZEROS, BITS, ROWS };

/* A call on its way down the picture. */
typedef struct {
    iris_edge_config config;
    const iris_image *src;
    iris_border border;
    int32_t y;
    iris_rows rows;     /* around row y; not of LOG */
    iris_log_rows log;  /* before row y; of LOG */
    int16_t *values;    /* ROWS rows */
    size_t row_step;    /* from one to the next */
    int32_t first, end; /* the pixels of row y that are evaluated */
    iris_scratch *scratch;
    size_t mark;
} edge_walk;

/* The second derivatives have one value for each pixel, and no direction. */
static int has_one_value(iris_edge_operator op)
{
    return op == IRIS_EDGE_LAPLACIAN || op == IRIS_EDGE_LOG;
}

static iris_status check_config(edge_walk *walk, const iris_edge_config *config)
{
    iris_edge_defaults(&walk->config);
    if (config) {
        walk->config = *config;
    }
    const iris_edge_config *c = &walk->config;
    int smooths = c->sigma_q16 >= IRIS_BLUR_SIGMA_MIN && c->sigma_q16 <= IRIS_BLUR_SIGMA_MAX;
    return (unsigned)c->op > IRIS_EDGE_LOG || c->gain_q16 < 0 || c->gain_q16 >= IRIS_EDGE_GAIN_END ||
                   c->threshold < 0 || c->threshold >= IRIS_EDGE_THRESHOLD_END ||
                   (c->op == IRIS_EDGE_LOG && !smooths)
               ? IRIS_ERR_ARG
               : IRIS_OK;
}

static iris_status check_view(const iris_image *dst, iris_format format, const iris_image *src,
                              iris_border border)
{
    iris_status status = iris_views_check(dst, src, border);
    return status != IRIS_ERR_ARG && (dst->format != format || src->format != IRIS_GRAY8) ? IRIS_ERR_FORMAT
                                                                                          : status;
}

/* Takes working memory; ready at row 0. Given back by walk_end. */
static iris_status walk_begin(edge_walk *walk, const iris_image *src, iris_border border,
                              iris_scratch *scratch)
{
    const size_t row_bytes = IRIS_SCRATCH_ROUND(2u * ((size_t)src->w + 2u));
    walk->src = src;
    walk->border = border;
    walk->y = 0;
    walk->scratch = scratch;
    walk->mark = iris_scratch_mark(scratch);
    walk->row_step = row_bytes / 2;
    walk->values = (int16_t *)iris_scratch_take(scratch, ROWS * row_bytes);
    if (!walk->values) {
        return IRIS_ERR_SCRATCH;
    }
    iris_status status =
        walk->config.op == IRIS_EDGE_LOG
            ? iris_log_rows_begin(&walk->log, src, walk->config.sigma_q16, border, scratch)
            : iris_rows_begin(&walk->rows, src, (iris_rows_window){1, 1, 1, 1}, border, scratch);
    if (status != IRIS_OK) {
        iris_scratch_release(scratch, walk->mark);
        return status;
    }
    memset(walk->values, 0, ROWS * row_bytes);
    return IRIS_OK;
}

static iris_status walk_end(const edge_walk *walk)
{
    iris_scratch_release(walk->scratch, walk->mark);
    return IRIS_OK;
}

/* Readable one pixel beyond its ends. */
static int16_t *values_row(const edge_walk *walk, int32_t index)
{
    return walk->values + (size_t)index * walk->row_step + 1;
}

/* The pixels to be evaluated in row y; 0 when there are none. */
static int walk_span(edge_walk *walk)
{
    if (walk->border.rule != IRIS_BORDER_SKIP || walk->config.op != IRIS_EDGE_ROBERTS) {
        return iris_rows_span(&walk->first, &walk->end, &walk->rows);
    }
    walk->first = 0;
    walk->end = walk->src->w - 1;
    return walk->end > 0 && walk->y < walk->src->h - 1;
}

/* Row y and its neighbors, from the first pixel that is evaluated. */
static void rows_around(const uint8_t *rows[3], const edge_walk *walk)
{
    for (int32_t k = 0; k < 3; k++) {
        rows[k] = iris_rows_at(&walk->rows, k - 1) + walk->first;
    }
}

/* The differences of row y into rows of its pixels, once for each row; 0 when none are to be evaluated. Where there is
 * one value, it goes to dx, and the rest is not written. */
static int walk_values(edge_walk *walk, iris_row_gradient to)
{
    if (walk->config.op == IRIS_EDGE_LOG) {
        return iris_log_rows_next(&walk->log, to.dx, &walk->first, &walk->end);
    }
    if (!walk_span(walk)) {
        return 0;
    }
    const int32_t first = walk->first;
    const uint8_t *rows[3];
    rows_around(rows, walk);
    to = (iris_row_gradient){to.dx + first, to.dy + first, to.size + first};
    iris_edge_row(&to, rows, walk->config.op, walk->end - first);
    return 1;
}

/* DX, DY, and SIZE of row y (DX alone where there is one value); 0 when none are to be evaluated. */
static int walk_row(edge_walk *walk)
{
    return walk_values(
        walk, (iris_row_gradient){values_row(walk, DX), values_row(walk, DY), values_row(walk, SIZE)});
}

static void walk_next(edge_walk *walk)
{
    walk->y++;
    if (walk->config.op != IRIS_EDGE_LOG) {
        iris_rows_next(&walk->rows);
    }
}

/* Row y of a view, or where values go that nobody wants. */
static int16_t *row_or(const iris_image *dst, const edge_walk *walk, int32_t index)
{
    return dst ? (int16_t *)iris_image_row(dst, walk->y) : values_row(walk, index);
}

iris_status iris_edge_gradient(const iris_image *dx, const iris_image *dy, const iris_image *src,
                               const iris_edge_config *config, iris_border border, iris_scratch *scratch)
{
    edge_walk walk;
    if ((!dx && !dy) || !src || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check_config(&walk, config);
    if (status == IRIS_OK && dy && has_one_value(walk.config.op)) {
        status = IRIS_ERR_ARG;
    }
    if (status == IRIS_OK && dx) {
        status = check_view(dx, IRIS_GRAY_S16, src, border);
    }
    if (status == IRIS_OK && dy) {
        status = check_view(dy, IRIS_GRAY_S16, src, border);
    }
    if (status == IRIS_OK && dx && dy && iris_image_overlaps(dx, dy)) {
        status = IRIS_ERR_ALIAS;
    }
    if (status == IRIS_OK) {
        status = walk_begin(&walk, src, border, scratch);
    }
    if (status != IRIS_OK) {
        return status;
    }
    for (; walk.y < src->h; walk_next(&walk)) {
        (void)walk_values(&walk, (iris_row_gradient){row_or(dx, &walk, DX), row_or(dy, &walk, DY),
                                                     values_row(&walk, SIZE)});
    }
    return walk_end(&walk);
}

/* The checks and the beginning of the calls that have one result. */
static iris_status walk_to(edge_walk *walk, const iris_image *dst, iris_format format, const iris_image *src,
                           const iris_edge_config *config, iris_border border)
{
    iris_scratch *scratch = walk->scratch;
    if (!dst || !src || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check_config(walk, config);
    if (status == IRIS_OK && format == IRIS_GRAY_U16 && has_one_value(walk->config.op)) {
        status = IRIS_ERR_ARG;
    }
    if (status == IRIS_OK) {
        status = check_view(dst, format, src, border);
    }
    return status == IRIS_OK ? walk_begin(walk, src, border, scratch) : status;
}

/* Row y of the magnitude: at once from the picture, or by way of a row of values. */
static void write_levels(const iris_image *dst, edge_walk *walk)
{
    uint8_t *row = (uint8_t *)iris_image_row(dst, walk->y);
    const uint32_t gain_q16 = (uint32_t)walk->config.gain_q16;
    const iris_edge_operator op = walk->config.op;
    if (op == IRIS_EDGE_LOG || op == IRIS_EDGE_ROBERTS) {
        if (walk_row(walk)) {
            const int16_t *sizes = values_row(walk, op == IRIS_EDGE_LOG ? DX : SIZE) + walk->first;
            iris_row_gain_s16(row + walk->first, sizes, gain_q16, walk->end - walk->first);
        }
    } else if (walk_span(walk)) {
        const uint8_t *rows[3];
        rows_around(rows, walk);
        iris_edge_row_u8(row + walk->first, rows, op, gain_q16, walk->end - walk->first);
    }
}

iris_status iris_edge_magnitude(const iris_image *dst, const iris_image *src, const iris_edge_config *config,
                                iris_border border, iris_scratch *scratch)
{
    edge_walk walk = {.scratch = scratch};
    iris_status status = walk_to(&walk, dst, IRIS_GRAY8, src, config, border);
    if (status != IRIS_OK) {
        return status;
    }
    for (; walk.y < src->h; walk_next(&walk)) {
        write_levels(dst, &walk);
    }
    return walk_end(&walk);
}

iris_status iris_edge_direction(const iris_image *dst, const iris_image *src, const iris_edge_config *config,
                                iris_border border, iris_scratch *scratch)
{
    edge_walk walk = {.scratch = scratch};
    iris_status status = walk_to(&walk, dst, IRIS_GRAY_U16, src, config, border);
    if (status != IRIS_OK) {
        return status;
    }
    const int32_t turn = walk.config.op == IRIS_EDGE_ROBERTS ? 8192 : 0;
    const int16_t *dx = values_row(&walk, DX), *dy = values_row(&walk, DY);
    for (; walk.y < src->h; walk_next(&walk)) {
        if (!walk_row(&walk)) {
            continue;
        }
        uint16_t *row = (uint16_t *)iris_image_row(dst, walk.y);
        iris_row_direction_s16(row + walk.first, dx + walk.first, dy + walk.first, turn,
                               walk.end - walk.first);
    }
    return walk_end(&walk);
}

/* Puts the pixels first to end - 1 of a row of bits into row y. */
static void put_bits(const iris_image *mask, int32_t y, const uint32_t *bits, int32_t first, int32_t end)
{
    uint32_t *row = (uint32_t *)iris_image_row(mask, y);
    for (int32_t word = first / 32; 32 * word < end; word++) {
        uint32_t part = iris_mask_part(word, first, end);
        row[word] = (row[word] & ~part) | (bits[word] & part);
    }
}

static void mask_magnitude(const iris_image *mask, edge_walk *walk)
{
    uint32_t *bits = (uint32_t *)(walk->values + BITS * walk->row_step);
    for (; walk->y < mask->h; walk_next(walk)) {
        if (walk_row(walk)) {
            iris_row_above_s16(bits, values_row(walk, SIZE), walk->config.threshold, mask->w);
            put_bits(mask, walk->y, bits, walk->first, walk->end);
        }
    }
}

/* Values of three rows in a ring; 0 stands for what lies beyond the edge. */
static void mask_crossings(const iris_image *mask, edge_walk *walk)
{
    const int32_t reach = walk->config.op == IRIS_EDGE_LOG ? IRIS_BLUR_RADIUS(walk->config.sigma_q16) : 0;
    const int32_t margin = walk->border.rule == IRIS_BORDER_SKIP ? reach + 2 : 0;
    const int16_t *zeros = values_row(walk, ZEROS);
    uint32_t *bits = (uint32_t *)(walk->values + BITS * walk->row_step);
    const int16_t *values[3] = {zeros, zeros, zeros};
    for (int32_t y = 0; y <= mask->h; y++) {
        int16_t *next = values_row(walk, y % 3);
        values[0] = values[1];
        values[1] = values[2];
        values[2] = y < mask->h && walk_values(walk, (iris_row_gradient){next, next, next}) ? next : zeros;
        if (y > margin && y <= mask->h - margin) {
            iris_row_crossings_s16(bits, values, walk->config.threshold, mask->w);
            put_bits(mask, y - 1, bits, margin, mask->w - margin);
        }
        if (y < mask->h) {
            walk_next(walk);
        }
    }
}

iris_status iris_edge_mask(const iris_image *mask, const iris_image *src, const iris_edge_config *config,
                           iris_border border, iris_scratch *scratch)
{
    edge_walk walk = {.scratch = scratch};
    iris_status status = walk_to(&walk, mask, IRIS_MASK1, src, config, border);
    if (status != IRIS_OK) {
        return status;
    }
    if (has_one_value(walk.config.op)) {
        mask_crossings(mask, &walk);
    } else {
        mask_magnitude(mask, &walk);
    }
    return walk_end(&walk);
}
