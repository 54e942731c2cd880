#include "iris/xt/canny.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"
#include "../filter/smooth_rows.h"
#include "edge_rows.h"
#include "hysteresis.h"

/* A picture on its way through the steps, each a row behind the one before it. */
typedef struct {
    const iris_image *mask, *src;
    iris_canny_config config;
    iris_border border;
    iris_smooth_rows smooth;
    int32_t margin; /* pixels at each edge that IRIS_BORDER_SKIP leaves out of the blur; else -1 */

    int16_t *
        gradients; /* pixel 0 of a row of zeros; behind it rings: three of |dx| + |dy|, two of dx, two of dy */
    size_t gradient_step;

    int32_t words;
    uint32_t *part;   /* a row: the pixels that are evaluated */
    uint32_t *strong; /* a row */
    uint32_t *weak, *dirty;
} canny;

void iris_canny_defaults(iris_canny_config *config)
{
    if (config) {
        *config = (iris_canny_config){91750, 40, 100};
    }
}

static iris_status check(const iris_image *mask, const iris_image *src, const iris_canny_config *config,
                         iris_border border)
{
    iris_status status = iris_views_check(mask, src, border);
    if (status == IRIS_ERR_ARG) {
        return status;
    }
    int smooths = config->sigma_q16 >= IRIS_BLUR_SIGMA_MIN && config->sigma_q16 <= IRIS_BLUR_SIGMA_MAX;
    if ((config->sigma_q16 != 0 && !smooths) || config->low < 0 || config->low > config->high ||
        config->high >= IRIS_CANNY_THRESHOLD_END) {
        return IRIS_ERR_ARG;
    }
    return mask->format != IRIS_MASK1 || src->format != IRIS_GRAY8 ? IRIS_ERR_FORMAT : status;
}

static iris_status take_memory(canny *c, iris_scratch *scratch)
{
    const size_t w = (size_t)c->src->w, words = IRIS_CANNY_WORDS(w), all = words * (size_t)c->src->h;
    const size_t groups = IRIS_CANNY_WORDS(words) * (size_t)c->src->h;
    const size_t row = IRIS_SCRATCH_ROUND(4u * words);
    c->gradient_step = IRIS_SCRATCH_ROUND(2u * (w + 2u)) / 2u;
    c->gradients = (int16_t *)iris_scratch_take(scratch, 16u * c->gradient_step);
    c->part = (uint32_t *)iris_scratch_take(scratch, row);
    c->strong = (uint32_t *)iris_scratch_take(scratch, row);
    c->weak = (uint32_t *)iris_scratch_take(scratch, 4u * all);
    c->dirty = (uint32_t *)iris_scratch_take(scratch, 4u * groups);
    if (!c->gradients || !c->part || !c->strong || !c->weak || !c->dirty) {
        return IRIS_ERR_SCRATCH;
    }
    memset(c->gradients, 0, 16u * c->gradient_step);
    memset(c->weak, 0, 4u * all);
    memset(c->dirty, 0, 4u * groups);
    c->words = (int32_t)words;
    c->gradients++;
    return IRIS_OK;
}

static iris_status begin(canny *c, iris_scratch *scratch)
{
    iris_status status = take_memory(c, scratch);
    if (status == IRIS_OK) {
        status = iris_smooth_rows_begin(&c->smooth, c->src, c->config.sigma_q16, c->border, scratch);
    }
    if (status != IRIS_OK) {
        return status;
    }
    int skips = c->border.rule == IRIS_BORDER_SKIP;
    c->margin = skips ? (c->config.sigma_q16 > 0 ? IRIS_BLUR_RADIUS(c->config.sigma_q16) : 0) : -1;
    int32_t beyond = skips ? c->margin + 2 : 0;
    for (int32_t word = 0; word < c->words; word++) {
        c->part[word] = iris_mask_part(word, beyond, c->src->w - beyond);
    }
    return IRIS_OK;
}

/* Is row y of what a step makes evaluated, when it looks `reach` pixels beyond the blurred picture's? */
static int has_row(const canny *c, int32_t y, int32_t reach)
{
    int32_t beyond = c->margin < 0 ? 0 : c->margin + reach;
    return y >= beyond && y < c->src->h - beyond;
}

/* Rows of gradients; beyond the picture they are 0. */
static int16_t *size_row(const canny *c, int32_t y)
{
    int inside = y >= 0 && y < c->src->h;
    return c->gradients + (inside ? (size_t)(1 + y % 3) : 0) * c->gradient_step;
}

static int16_t *dx_row(const canny *c, int32_t y)
{
    return c->gradients + (size_t)(4 + y % 2) * c->gradient_step;
}

static int16_t *dy_row(const canny *c, int32_t y)
{
    return c->gradients + (size_t)(6 + y % 2) * c->gradient_step;
}

static void make_gradient(const canny *c, int32_t y)
{
    const int32_t first = c->margin + 1, n = c->src->w - 2 * first;
    if (n > 0) {
        const uint8_t *const rows[3] = {iris_smooth_row(&c->smooth, y - 1) + first,
                                        iris_smooth_row(&c->smooth, y) + first,
                                        iris_smooth_row(&c->smooth, y + 1) + first};
        const iris_row_gradient to = {dx_row(c, y) + first, dy_row(c, y) + first, size_row(c, y) + first};
        iris_row_gradient_u8(&to, rows, IRIS_EDGE_MORE_SOBEL, n);
    }
}

/* Row y of the mask gets its strong pixels; words with pixels that are weak alone are to be looked at. */
static void make_mask(const canny *c, int32_t y)
{
    const iris_row_ridges rows = {{size_row(c, y - 1), size_row(c, y), size_row(c, y + 1)},
                                  dx_row(c, y),
                                  dy_row(c, y),
                                  c->config.low,
                                  c->config.high};
    uint32_t *weak = c->weak + (size_t)y * (size_t)c->words, *row = (uint32_t *)iris_image_row(c->mask, y);
    iris_row_ridges_s16(weak, c->strong, &rows, c->src->w);
    uint32_t *dirty = c->dirty + (size_t)y * IRIS_CANNY_WORDS(c->words);
    for (int32_t word = 0; word < c->words; word++) {
        uint32_t part = c->part[word], strong = c->strong[word] & part;
        weak[word] &= part;
        row[word] = (row[word] & ~part) | strong;
        dirty[word / 32] |= (uint32_t)(weak[word] != strong) << word % 32;
    }
}

iris_status iris_canny(const iris_image *mask, const iris_image *src, const iris_canny_config *config,
                       iris_border border, iris_scratch *scratch)
{
    canny c = {.mask = mask, .src = src, .border = border};
    iris_canny_defaults(&c.config);
    if (config) {
        c.config = *config;
    }
    iris_status status = check(mask, src, &c.config, border);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    size_t start = iris_scratch_mark(scratch);
    status = begin(&c, scratch);
    for (int32_t y = 0; status == IRIS_OK && y < src->h + 2; y++) {
        if (y < src->h) {
            iris_smooth_rows_next(&c.smooth, y);
        }
        if (y >= 1 && has_row(&c, y - 1, 1)) {
            make_gradient(&c, y - 1);
        }
        if (y >= 2 && has_row(&c, y - 2, 2)) {
            make_mask(&c, y - 2);
        }
    }
    if (status == IRIS_OK) {
        int32_t beyond = c.margin < 0 ? 0 : c.margin + 2;
        memset(c.strong, 0, 4u * (size_t)c.words);
        iris_hysteresis_run(
            &(iris_hysteresis){mask, c.part, c.strong, beyond, src->h - beyond, c.weak, c.dirty});
    }
    iris_scratch_release(scratch, start);
    return status;
}
