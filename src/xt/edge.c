#include "iris/xt/edge.h"

#include <string.h>

#include "../foundation/rows.h"
#include "../foundation/views.h"
#include "edge_rows.h"
#include "log_rows.h"

void iris_edge_defaults(iris_edge_config *config)
{
    if (config) {
        *config = (iris_edge_config){IRIS_EDGE_SOBEL, IRIS_Q16_ONE / 4, 160, 91750};
    }
}

/* A call on its way down the picture. */
typedef struct {
    iris_edge_config config;
    const iris_image *src;
    iris_border border;
    int32_t y;
    iris_rows rows;     /* around row y; not of LOG */
    iris_log_rows log;  /* before row y; of LOG */
    int16_t *values;    /* four rows */
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
    walk->values = (int16_t *)iris_scratch_take(scratch, 4 * row_bytes);
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
    memset(walk->values, 0, 4 * row_bytes);
    return IRIS_OK;
}

static iris_status walk_end(const edge_walk *walk)
{
    iris_scratch_release(walk->scratch, walk->mark);
    return IRIS_OK;
}

/* One of four rows of values, 0 until written, readable one pixel beyond its ends: what the calls name DX to SIZE, or a
 * ring of three. */
enum { DX, DY, SIZE, SPARE };

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

/* The differences of row y, once for each row; 0 when none are to be evaluated. Where there is one value, it goes to
 * dx, and the rest is not written. */
static int walk_values(edge_walk *walk, int16_t *dx, int16_t *dy)
{
    if (walk->config.op == IRIS_EDGE_LOG) {
        return iris_log_rows_next(&walk->log, dx, &walk->first, &walk->end);
    }
    if (!walk_span(walk)) {
        return 0;
    }
    const int32_t first = walk->first;
    const uint8_t *const rows[3] = {iris_rows_at(&walk->rows, -1) + first,
                                    iris_rows_at(&walk->rows, 0) + first,
                                    iris_rows_at(&walk->rows, 1) + first};
    const iris_row_gradient to = {dx + first, dy ? dy + first : NULL, values_row(walk, SIZE) + first};
    iris_edge_row(&to, rows, walk->config.op, walk->end - first);
    return 1;
}

/* DX, DY, and SIZE of row y; 0 when none are to be evaluated. */
static int walk_row(edge_walk *walk)
{
    int16_t *dx = values_row(walk, DX), *size = values_row(walk, SIZE);
    int some = walk_values(walk, dx, values_row(walk, DY));
    for (int32_t x = walk->first; some && has_one_value(walk->config.op) && x < walk->end; x++) {
        size[x] = (int16_t)(dx[x] < 0 ? -dx[x] : dx[x]);
    }
    return some;
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
        (void)walk_values(&walk, row_or(dx, &walk, DX), row_or(dy, &walk, DY));
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

iris_status iris_edge_magnitude(const iris_image *dst, const iris_image *src, const iris_edge_config *config,
                                iris_border border, iris_scratch *scratch)
{
    edge_walk walk = {.scratch = scratch};
    iris_status status = walk_to(&walk, dst, IRIS_GRAY8, src, config, border);
    if (status != IRIS_OK) {
        return status;
    }
    for (; walk.y < src->h; walk_next(&walk)) {
        if (walk_row(&walk)) {
            uint8_t *row = (uint8_t *)iris_image_row(dst, walk.y) + walk.first;
            iris_row_gain_s16(row, values_row(&walk, SIZE) + walk.first, (uint32_t)walk.config.gain_q16,
                              walk.end - walk.first);
        }
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
        for (int32_t x = walk.first; x < walk.end; x++) {
            row[x] = dx[x] == 0 && dy[x] == 0 ? 0 : (uint16_t)(iris_atan2_angle(dy[x], dx[x]) + turn);
        }
    }
    return walk_end(&walk);
}

static void mask_magnitude(const iris_image *mask, edge_walk *walk)
{
    uint32_t *bits = (uint32_t *)(walk->values + SPARE * walk->row_step);
    for (; walk->y < mask->h; walk_next(walk)) {
        if (!walk_row(walk)) {
            continue;
        }
        uint32_t *row = (uint32_t *)iris_image_row(mask, walk->y);
        iris_row_above_s16(bits, values_row(walk, SIZE), walk->config.threshold, mask->w);
        for (int32_t word = 0; word < (mask->w + 31) / 32; word++) {
            uint32_t part = iris_mask_part(word, walk->first, walk->end);
            row[word] = (row[word] & ~part) | (bits[word] & part);
        }
    }
}

/* Does the value change its sign between a and b, or does it at a pixel of value 0 between them? */
static int crosses(int32_t a, int32_t b, int32_t threshold)
{
    return (a < 0 && b > 0 && b - a > threshold) || (a > 0 && b < 0 && a - b > threshold);
}

/* Is here the pixel of a crossing from before to after? */
static int is_crossing(int32_t before, int32_t here, int32_t after, int32_t threshold)
{
    if (here == 0) {
        return crosses(before, after, threshold);
    }
    int32_t size = here < 0 ? -here : here;
    return (crosses(before, here, threshold) && size < (before < 0 ? -before : before)) ||
           (crosses(here, after, threshold) && size <= (after < 0 ? -after : after));
}

static void row_crossings(uint32_t *row, const int16_t *const values[3], int32_t threshold, int32_t first,
                          int32_t end)
{
    const int16_t *above = values[0], *here = values[1], *below = values[2];
    for (int32_t word = first / 32; 32 * word < end; word++) {
        uint32_t part = iris_mask_part(word, first, end), bits = 0;
        for (int32_t i = 0; i < 32; i++) {
            int32_t x = 32 * word + i;
            if (part >> i & 1 && (is_crossing(here[x - 1], here[x], here[x + 1], threshold) ||
                                  is_crossing(above[x], here[x], below[x], threshold))) {
                bits |= (uint32_t)1 << i;
            }
        }
        row[word] = (row[word] & ~part) | bits;
    }
}

/* Values of three rows in a ring; the fourth stays 0, for what lies beyond the edge. */
static void mask_crossings(const iris_image *mask, edge_walk *walk)
{
    const int32_t reach = walk->config.op == IRIS_EDGE_LOG ? IRIS_BLUR_RADIUS(walk->config.sigma_q16) : 0;
    const int32_t margin = walk->border.rule == IRIS_BORDER_SKIP ? reach + 2 : 0;
    const int16_t *zeros = values_row(walk, SPARE);
    const int16_t *values[3] = {zeros, zeros, zeros};
    for (int32_t y = 0; y <= mask->h; y++) {
        int16_t *next = values_row(walk, y % 3);
        values[0] = values[1];
        values[1] = values[2];
        values[2] = y < mask->h && walk_values(walk, next, NULL) ? next : zeros;
        if (y > margin && y <= mask->h - margin && margin < mask->w - margin) {
            row_crossings((uint32_t *)iris_image_row(mask, y - 1), values, walk->config.threshold, margin,
                          mask->w - margin);
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
