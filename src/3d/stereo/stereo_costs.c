#include "stereo_costs.h"

#include <string.h>

#define SAD_MOST 32

static int32_t between(int32_t a, int32_t least, int32_t most)
{
    return a < least ? least : a > most ? most : a;
}

static iris_status check_config(const iris_stereo_config *config)
{
    int good = config->max_disparity >= 1 && config->max_disparity <= IRIS_STEREO_DISPARITY_MAX &&
               (unsigned)config->cost <= IRIS_STEREO_BOTH && config->check_px >= 0 &&
               config->check_px <= 255 && config->uniqueness_percent >= 0 && config->uniqueness_percent <= 99;
    return good ? IRIS_OK : IRIS_ERR_ARG;
}

static iris_status check_views(const iris_image *disparity, const iris_image *left, const iris_image *right)
{
    const iris_image *views[] = {disparity, left, right};
    for (int i = 0; i < 3; i++) {
        iris_status status = iris_image_check(views[i]);
        if (status != IRIS_OK) {
            return status;
        }
    }
    if (disparity->format != IRIS_GRAY_U16 || left->format != IRIS_GRAY8 || right->format != IRIS_GRAY8) {
        return IRIS_ERR_FORMAT;
    }
    if (left->w != right->w || left->h != right->h || left->w != disparity->w || left->h != disparity->h) {
        return IRIS_ERR_RANGE;
    }
    int meet = iris_image_overlaps(disparity, left) || iris_image_overlaps(disparity, right);
    return meet ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_stereo_check(const iris_image *disparity, const iris_image *left, const iris_image *right,
                              const iris_stereo_config *config)
{
    iris_status status = check_config(config);
    return status == IRIS_OK ? check_views(disparity, left, right) : status;
}

iris_status iris_stereo_costs_begin(iris_stereo_costs *c, const iris_image *left, const iris_image *right,
                                    const iris_stereo_config *config, int32_t side, iris_scratch *scratch)
{
    size_t w = (size_t)left->w, most = (size_t)config->max_disparity, cells = w * (most + 1);
    *c = (iris_stereo_costs){.left = left,
                             .right = right,
                             .w = left->w,
                             .steps = config->max_disparity + 1,
                             .cost = config->cost,
                             .reach = side / 2};
    size_t windows = side > 0 ? 2 * cells : 0;
    c->columns = iris_scratch_take(scratch, windows);
    c->sums = iris_scratch_take(scratch, windows);
    c->costs = iris_scratch_take(scratch, cells);
    c->census_left = iris_scratch_take(scratch, 4 * w);
    c->census_right = iris_scratch_take(scratch, 4 * (w + most));
    c->gray_right = iris_scratch_take(scratch, w + most);
    int good = c->columns && c->sums && c->costs && c->census_left && c->census_right && c->gray_right;
    return good ? IRIS_OK : IRIS_ERR_SCRATCH;
}

/* A bit for each of the 24 pixels around: is it darker? Pixel 0 of the row goes to `to`, the next ones `step` on. */
static void census(uint32_t *to, ptrdiff_t step, const iris_image *image, int32_t y)
{
    const uint8_t *rows[5];
    int32_t w = image->w;
    for (int k = 0; k < 5; k++) {
        rows[k] = iris_image_row(image, between(y + k - 2, 0, image->h - 1));
    }
    for (int32_t x = 0; x < w; x++, to += step) {
        int32_t at[5];
        uint32_t bits = 0;
        for (int i = 0; i < 5; i++) {
            at[i] = x >= 2 && x < w - 2 ? x + i - 2 : between(x + i - 2, 0, w - 1);
        }
        uint8_t own = rows[2][x];
        for (int k = 0; k < 5; k++) {
            const uint8_t *row = rows[k];
            bits = bits << 5 | (uint32_t)(row[at[0]] < own) << 4 | (uint32_t)(row[at[1]] < own) << 3 |
                   (uint32_t)(row[at[2]] < own) << 2 | (uint32_t)(row[at[3]] < own) << 1 |
                   (uint32_t)(row[at[4]] < own);
        }
        *to = bits;
    }
}

/* How many bits are set. */
static uint32_t count_bits(uint32_t bits)
{
    bits -= bits >> 1 & 0x55555555u;
    bits = (bits & 0x33333333u) + (bits >> 2 & 0x33333333u);
    return ((bits + (bits >> 4)) & 0x0F0F0F0Fu) * 0x01010101u >> 24;
}

static uint32_t gray_cost(uint8_t a, uint8_t b)
{
    uint32_t apart = (uint32_t)(a > b ? a - b : b - a);
    return apart < SAD_MOST ? apart : SAD_MOST;
}

static void costs_at(uint8_t *to, const iris_stereo_costs *c, int32_t x, uint8_t gray)
{
    const uint32_t *right = c->census_right + (c->w - 1 - x);
    const uint8_t *gray_right = c->gray_right + (c->w - 1 - x);
    uint32_t left = c->census_left[x];
    for (int32_t d = 0; d < c->steps && c->cost == IRIS_STEREO_CENSUS; d++) {
        to[d] = (uint8_t)count_bits(left ^ right[d]);
    }
    for (int32_t d = 0; d < c->steps && c->cost == IRIS_STEREO_SAD; d++) {
        to[d] = (uint8_t)gray_cost(gray, gray_right[d]);
    }
    for (int32_t d = 0; d < c->steps && c->cost == IRIS_STEREO_BOTH; d++) {
        to[d] = (uint8_t)(count_bits(left ^ right[d]) + gray_cost(gray, gray_right[d]));
    }
}

const uint8_t *iris_stereo_costs_pixels(const iris_stereo_costs *c, int32_t y)
{
    const uint8_t *left = iris_image_row(c->left, y), *right = iris_image_row(c->right, y);
    int32_t w = c->w;
    if (c->cost != IRIS_STEREO_SAD) {
        census(c->census_left, 1, c->left, y);
        census(c->census_right + w - 1, -1, c->right, y);
    }
    for (int32_t x = 0; x < w; x++) {
        c->gray_right[w - 1 - x] = right[x];
    }
    for (int32_t d = 0; d < c->steps - 1; d++) {
        c->census_right[w + d] = c->census_right[w - 1];
        c->gray_right[w + d] = right[0];
    }
    for (int32_t x = 0; x < w; x++) {
        costs_at(c->costs + (size_t)x * (size_t)c->steps, c, x, left[x]);
    }
    return c->costs;
}

/* columns += times costs of row y. */
static void add_row(iris_stereo_costs *c, int32_t y, int32_t times)
{
    size_t cells = (size_t)c->w * (size_t)c->steps;
    const uint8_t *costs = iris_stereo_costs_pixels(c, y);
    for (size_t i = 0; i < cells; i++) {
        c->columns[i] = (uint16_t)(c->columns[i] + times * costs[i]);
    }
}

/* From sums over columns to those over windows. */
static void sum_row(iris_stereo_costs *c)
{
    size_t steps = (size_t)c->steps;
    for (size_t d = 0; d < steps; d++) {
        c->sums[d] = 0;
    }
    for (int32_t k = -c->reach; k <= c->reach; k++) {
        const uint16_t *column = c->columns + (size_t)between(k, 0, c->w - 1) * steps;
        for (size_t d = 0; d < steps; d++) {
            c->sums[d] = (uint16_t)(c->sums[d] + column[d]);
        }
    }
    for (int32_t x = 1; x < c->w; x++) {
        const uint16_t *enter = c->columns + (size_t)between(x + c->reach, 0, c->w - 1) * steps;
        const uint16_t *leave = c->columns + (size_t)between(x - 1 - c->reach, 0, c->w - 1) * steps;
        uint16_t *sum = c->sums + (size_t)x * steps;
        const uint16_t *before = sum - steps;
        for (size_t d = 0; d < steps; d++) {
            sum[d] = (uint16_t)(before[d] + enter[d] - leave[d]);
        }
    }
}

const uint16_t *iris_stereo_costs_row(iris_stereo_costs *c, int32_t y)
{
    int32_t bottom = c->left->h - 1;
    if (y == 0 || c->reach == 0) {
        memset(c->columns, 0, 2 * (size_t)c->w * (size_t)c->steps);
        for (int32_t k = -c->reach; k <= c->reach; k++) {
            add_row(c, between(y + k, 0, bottom), 1);
        }
    } else {
        add_row(c, between(y + c->reach, 0, bottom), 1);
        add_row(c, between(y - 1 - c->reach, 0, bottom), -1);
    }
    if (c->reach == 0) {
        return c->columns;
    }
    sum_row(c);
    return c->sums;
}
