#include <string.h>

#include "../../foundation/kernel.h"
#include "stereo_costs.h"
#include "stereo_pick.h"

#define BAND IRIS_STEREO_BAND
#define EDGE 4 /* gray levels: more than that between two pixels may be where something ends */

/* A band of rows, of which the paths from below are stored, and the rows behind it that these begin in. */
typedef struct {
    const iris_stereo_semiglobal_config *config;
    const iris_image *disparity;
    iris_stereo_costs costs;
    iris_stereo_pick pick;
    size_t row;      /* w times disparities */
    uint16_t *sums;  /* BAND rows */
    uint8_t *stored; /* the costs of these */
    uint16_t *above, *below;
    uint16_t *room;  /* twice as many as disparities */
    uint16_t *leaps; /* w + 1 */
} band;

void iris_stereo_semiglobal_defaults(iris_stereo_semiglobal_config *config)
{
    if (config) {
        *config = (iris_stereo_semiglobal_config){{63, IRIS_STEREO_BOTH, 1, 0, 1, 1}, 24, 200};
    }
}

/* What a step of more than one disparity costs between each two pixels of so many. */
static void set_leaps(uint16_t *leaps, const band *b, const uint8_t *gray, const uint8_t *other, int32_t n)
{
    const iris_stereo_semiglobal_config *config = b->config;
    const int32_t quarter = config->p2 / 4 > config->p1 ? config->p2 / 4 : config->p1;
    for (int32_t x = 0; x < n; x++) {
        int32_t apart = gray[x] > other[x] ? gray[x] - other[x] : other[x] - gray[x];
        leaps[x] = (uint16_t)(apart > EDGE ? quarter : config->p2);
    }
}

/* A row further down or up, from the paths of row `before`, which is outside of the picture for the first one. */
static void go_on_row(uint16_t *paths, const uint16_t *from, uint16_t *sums, const iris_row_ground *ground,
                      const band *b, const int32_t rows[2])
{
    const iris_image *left = b->costs.left;
    const int is_first = rows[1] < 0 || rows[1] >= left->h;
    if (is_first) {
        memset(paths, 0, 2 * b->row);
    }
    set_leaps(b->leaps, b, iris_image_row(left, rows[0]), iris_image_row(left, rows[is_first ? 0 : 1]),
              left->w);
    iris_row_paths_u16(paths, is_first ? paths : from, sums, ground, left->w);
}

static iris_row_ground ground_of(const band *b, const uint8_t *costs)
{
    return (iris_row_ground){costs, b->leaps, b->costs.steps, (uint16_t)b->config->p1};
}

/* Along the row from the left and from the right, added to the sums. */
static void add_along(uint16_t *sums, const band *b, const uint8_t *costs, int32_t y)
{
    const int32_t w = b->costs.w;
    const uint8_t *gray = iris_image_row(b->costs.left, y);
    const iris_row_ground ground = ground_of(b, costs);
    b->leaps[0] = b->leaps[w] = (uint16_t)b->config->p2;
    set_leaps(b->leaps + 1, b, gray + 1, gray, w - 1);
    iris_row_paths_along_u16(sums, b->room, &ground, w);
}

/* The paths from below, of rows first to last - 1: they begin so many rows further down as a band has. The costs of these
 * rows stay, and the paths are what the sums begin with. */
static void go_up(band *b, int32_t first, int32_t last)
{
    uint8_t *const costs_of_row = b->costs.costs;
    const uint16_t *from = b->below;
    int32_t h = b->costs.left->h, end = h - last < BAND ? h : last + BAND;
    for (int32_t y = end - 1; y >= first; y--) {
        const int32_t rows[2] = {y, y == end - 1 ? -1 : y + 1};
        uint16_t *to = y < last ? b->sums + (size_t)(y - first) * b->row : b->below;
        b->costs.costs = y < last ? b->stored + (size_t)(y - first) * b->row : costs_of_row;
        const iris_row_ground ground = ground_of(b, iris_stereo_costs_pixels(&b->costs, y));
        go_on_row(to, from, NULL, &ground, b, rows);
        from = to;
    }
    b->costs.costs = costs_of_row;
}

static void pick_row(const band *b, uint16_t *sums, int32_t y)
{
    uint16_t *row = iris_image_row(b->disparity, y);
    const int32_t w = b->costs.w;
    iris_stereo_pick_begin_row(&b->pick);
    for (int32_t x = 0; x < w; x += IRIS_STEREO_PIECE, sums += IRIS_STEREO_PIECE * b->costs.steps) {
        iris_stereo_pick_piece(row, &b->pick, sums, x, w - x < IRIS_STEREO_PIECE ? w - x : IRIS_STEREO_PIECE);
    }
    iris_stereo_pick_end_row(row, &b->pick);
}

static void go_down(const band *b, int32_t first, int32_t last)
{
    for (int32_t y = first; y < last; y++) {
        const uint8_t *costs = b->stored + (size_t)(y - first) * b->row;
        uint16_t *sums = b->sums + (size_t)(y - first) * b->row;
        const int32_t rows[2] = {y, y - 1};
        const iris_row_ground ground = ground_of(b, costs);
        go_on_row(b->above, b->above, sums, &ground, b, rows);
        add_along(sums, b, costs, y);
        pick_row(b, sums, y);
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
    b->room = iris_scratch_take(scratch, 4 * ((size_t)config->max_disparity + 1));
    b->leaps = iris_scratch_take(scratch, 2 * (size_t)left->w + 2);
    int good = b->sums && b->stored && b->above && b->below && b->room && b->leaps;
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
