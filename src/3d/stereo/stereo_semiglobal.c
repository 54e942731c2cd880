#include <string.h>

#include "stereo_costs.h"
#include "stereo_pick.h"

#define BAND  IRIS_STEREO_BAND
#define EDGE  4 /* gray levels: more than that between two pixels may be where something ends */
#define WORST 65535

/* A band of rows, of which the paths from below are stored, and the rows behind it that these begin in. */
typedef struct {
    const iris_stereo_semiglobal_config *config;
    const iris_image *disparity;
    iris_stereo_costs costs;
    iris_stereo_pick pick;
    size_t row;      /* w times disparities */
    uint16_t *sums;  /* BAND rows */
    uint8_t *stored; /* the costs of these */
    uint16_t *above, *below, *beside;
} band;

void iris_stereo_semiglobal_defaults(iris_stereo_semiglobal_config *config)
{
    if (config) {
        *config = (iris_stereo_semiglobal_config){{63, IRIS_STEREO_BOTH, 1, 0, 1, 1}, 24, 200};
    }
}

/* One pixel further along a path: path[d] becomes costs[d] and the least of how the pixel before could have got there,
 * less the least of all there, so that sums stay small. */
static void go_on(uint16_t *path, const uint8_t *costs, int32_t n, int32_t p1, int32_t p2)
{
    int32_t least = path[0], before = WORST, own = path[0];
    for (int32_t d = 1; d < n; d++) {
        least = path[d] < least ? path[d] : least;
    }
    for (int32_t d = 0; d < n; d++) {
        int32_t after = d < n - 1 ? path[d + 1] : WORST, best = own;
        int32_t step = (before < after ? before : after) + p1;
        best = step < best ? step : best;
        best = least + p2 < best ? least + p2 : best;
        path[d] = (uint16_t)(costs[d] + best - least);
        before = own;
        own = after;
    }
}

/* What a step of more than one disparity costs between pixels of these levels. */
static int32_t leap(const iris_stereo_semiglobal_config *config, uint8_t a, uint8_t b)
{
    int32_t quarter = config->p2 / 4 > config->p1 ? config->p2 / 4 : config->p1;
    return a - b > EDGE || b - a > EDGE ? quarter : config->p2;
}

/* A row further down or up; `from`: the row before, outside of the picture for the first one. */
static void go_on_row(uint16_t *paths, const band *b, const uint8_t *costs, int32_t y, int32_t from)
{
    int32_t n = b->costs.steps;
    const iris_image *left = b->costs.left;
    if (from < 0 || from >= left->h) {
        memset(paths, 0, 2 * b->row);
        from = y;
    }
    const uint8_t *gray = iris_image_row(left, y), *gray_from = iris_image_row(left, from);
    for (int32_t x = 0; x < b->costs.w; x++, paths += n, costs += n) {
        go_on(paths, costs, n, b->config->p1, leap(b->config, gray[x], gray_from[x]));
    }
}

/* Along the row from the left (1) or the right (-1), added to the sums. */
static void add_along(uint16_t *sums, const band *b, const uint8_t *costs, int32_t y, int32_t step)
{
    int32_t n = b->costs.steps, w = b->costs.w, x = step > 0 ? 0 : w - 1, before = x;
    const uint8_t *gray = iris_image_row(b->costs.left, y);
    memset(b->beside, 0, 2 * (size_t)n);
    for (int32_t k = 0; k < w; k++, before = x, x += step) {
        size_t at = (size_t)x * (size_t)n;
        go_on(b->beside, costs + at, n, b->config->p1, leap(b->config, gray[x], gray[before]));
        for (int32_t d = 0; d < n; d++) {
            sums[at + (size_t)d] = (uint16_t)(sums[at + (size_t)d] + b->beside[d]);
        }
    }
}

/* The paths from below, of rows first to last - 1: they begin so many rows further down as a band has. */
static void go_up(const band *b, int32_t first, int32_t last)
{
    int32_t h = b->costs.left->h, end = h - last < BAND ? h : last + BAND;
    for (int32_t y = end - 1; y >= first; y--) {
        const uint8_t *costs = iris_stereo_costs_pixels(&b->costs, y);
        go_on_row(b->below, b, costs, y, y == end - 1 ? -1 : y + 1);
        if (y < last) {
            memcpy(b->stored + (size_t)(y - first) * b->row, costs, b->row);
            memcpy(b->sums + (size_t)(y - first) * b->row, b->below, 2 * b->row);
        }
    }
}

static void go_down(const band *b, int32_t first, int32_t last)
{
    for (int32_t y = first; y < last; y++) {
        const uint8_t *costs = b->stored + (size_t)(y - first) * b->row;
        uint16_t *sums = b->sums + (size_t)(y - first) * b->row;
        go_on_row(b->above, b, costs, y, y - 1);
        for (size_t i = 0; i < b->row; i++) {
            sums[i] = (uint16_t)(sums[i] + b->above[i]);
        }
        add_along(sums, b, costs, y, 1);
        add_along(sums, b, costs, y, -1);
        iris_stereo_pick_row(iris_image_row(b->disparity, y), &b->pick, sums);
    }
}

static iris_status begin(band *b, const iris_image *left, const iris_image *right, iris_scratch *scratch)
{
    const iris_stereo_config *config = &b->config->stereo;
    b->row = (size_t)left->w * ((size_t)config->max_disparity + 1);
    iris_status status = iris_stereo_costs_begin(&b->costs, left, right, config, 0, scratch);
    if (status == IRIS_OK) {
        status = iris_stereo_pick_begin(&b->pick, config, left->w, scratch);
    }
    b->sums = iris_scratch_take(scratch, 2 * BAND * b->row);
    b->stored = iris_scratch_take(scratch, BAND * b->row);
    b->above = iris_scratch_take(scratch, 2 * b->row);
    b->below = iris_scratch_take(scratch, 2 * b->row);
    b->beside = iris_scratch_take(scratch, 2 * ((size_t)config->max_disparity + 1));
    int good = b->sums && b->stored && b->above && b->below && b->beside;
    return status == IRIS_OK && !good ? IRIS_ERR_SCRATCH : status;
}

/* All bands; the scratch is given back by the caller. */
static iris_status match(band *b, const iris_image *left, const iris_image *right, iris_scratch *scratch)
{
    iris_status status = begin(b, left, right, scratch);
    size_t mark = iris_scratch_mark(scratch);
    if (status != IRIS_OK || !iris_scratch_take(scratch, IRIS_STEREO_SMOOTH_SCRATCH_BYTES(left->w))) {
        return IRIS_ERR_SCRATCH;
    }
    iris_scratch_release(scratch, mark);
    for (int32_t y = 0; y < left->h; y += BAND) {
        int32_t last = left->h - y < BAND ? left->h : y + BAND;
        go_up(b, y, last);
        go_down(b, y, last);
    }
    return b->config->stereo.smooth ? iris_stereo_smooth(b->disparity, scratch) : IRIS_OK;
}

iris_status iris_stereo_semiglobal(const iris_image *disparity, const iris_image *left,
                                   const iris_image *right, const iris_stereo_semiglobal_config *config,
                                   iris_scratch *scratch)
{
    iris_stereo_semiglobal_config defaults;
    iris_stereo_semiglobal_defaults(&defaults);
    band b = {.config = config ? config : &defaults, .disparity = disparity};
    if (!disparity || !left || !right || !scratch || b.config->p1 < 0 || b.config->p2 < b.config->p1 ||
        b.config->p2 > IRIS_STEREO_P2_MAX) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_stereo_check(disparity, left, right, &b.config->stereo);
    if (status == IRIS_OK) {
        size_t mark = iris_scratch_mark(scratch);
        status = match(&b, left, right, scratch);
        iris_scratch_release(scratch, mark);
    }
    return status;
}
