/* Local equalization: a curve for each tile, and a walk over the pixels between the tiles' centers. */
#include "iris/xt/equalize.h"

#include "../../foundation/lightness.h"
#include "../../foundation/views.h"
#include "iris/xt/histogram.h"
#include "tone_lightness.h"

#define ONE 2048 /* sum of two weights */

void iris_equalize_local_defaults(iris_equalize_local_config *config)
{
    if (config) {
        *config = (iris_equalize_local_config){8, 3 * IRIS_Q16_ONE};
    }
}

/* First pixel of tile i. */
static int32_t tile_start(int32_t i, int32_t side, int32_t tiles)
{
    return i * side / tiles;
}

/* Takes from the levels what they have too much, and gives it back to all. */
static void clip(uint32_t histogram[256], uint32_t most)
{
    uint32_t excess = 0;
    for (int32_t p = 0; p < 256; p++) {
        if (histogram[p] > most) {
            excess += histogram[p] - most;
            histogram[p] = most;
        }
    }
    for (int32_t p = 0; p < 256; p++) {
        histogram[p] += excess / 256;
    }
    uint32_t rest = excess % 256;
    for (uint32_t j = 0; j < rest; j++) {
        histogram[256 * j / rest]++;
    }
}

/* The curve of a tile. */
static void make_curve(uint8_t curve[256], uint32_t histogram[256], const iris_image *tile,
                       iris_q16 limit_q16)
{
    uint32_t area = (uint32_t)tile->w * (uint32_t)tile->h;
    (void)iris_histogram(histogram, tile, tile->format == IRIS_GRAY8 ? 0 : IRIS_CHANNEL_LIGHTNESS, NULL);
    if (limit_q16 > 0) {
        uint64_t most = (uint64_t)area * (uint32_t)limit_q16 >> 24;
        clip(histogram, most > 0 ? (uint32_t)most : 1);
    }
    uint64_t up_to = 0;
    for (int32_t p = 0; p < 256; p++) {
        up_to += histogram[p];
        curve[p] = (uint8_t)((510 * up_to + area) / (2 * (uint64_t)area));
    }
}

static void make_curves(uint8_t *curves, uint32_t histogram[256], const iris_image *src,
                        const iris_equalize_local_config *config)
{
    int32_t tiles = config->tiles;
    for (int32_t i = 0; i < tiles * tiles; i++) {
        int32_t x = tile_start(i % tiles, src->w, tiles), y = tile_start(i / tiles, src->h, tiles);
        iris_rect rect = {x, y, tile_start(i % tiles + 1, src->w, tiles) - x,
                          tile_start(i / tiles + 1, src->h, tiles) - y};
        iris_image tile;
        (void)iris_image_crop(&tile, src, rect);
        make_curve(curves + 256 * i, histogram, &tile, config->limit_q16);
    }
}

/* The pixels from the center of tile `left` to that of the next one, or of the picture's end: [first, end). */
typedef struct {
    int32_t left, right; /* tiles */
    int32_t first, end;
    int32_t center, distance; /* of the left one, and from it to the right one, in half pixels */
} stretch;

static int32_t center_of(int32_t i, int32_t side, int32_t tiles)
{
    return tile_start(i, side, tiles) + tile_start(i + 1, side, tiles) - 1;
}

/* The stretch before tile i's center, i from 0 to tiles. */
static stretch stretch_before(int32_t i, int32_t side, int32_t tiles)
{
    stretch s = {i > 0 ? i - 1 : 0, i < tiles ? i : tiles - 1, 0, side, 0, 1};
    s.center = center_of(s.left, side, tiles);
    s.distance = s.right > s.left ? center_of(s.right, side, tiles) - s.center : 1;
    s.first = i > 0 ? (s.center + 1) / 2 : 0;
    s.end = i < tiles ? (center_of(i, side, tiles) + 1) / 2 : side;
    return s;
}

/* Weights of the second of two curves, pixel by pixel: round(ONE d / D) without a division for each. */
typedef struct {
    int32_t weight, rest;
    int32_t step, step_rest, whole;
} ramp;

static ramp ramp_at(const stretch *s, int32_t x)
{
    ramp r = {0, 0, 0, 0, 1};
    if (s->right != s->left) {
        int32_t twice = 2 * ONE * (2 * x - s->center) + s->distance;
        r.whole = 2 * s->distance;
        r.weight = twice / r.whole;
        r.rest = twice % r.whole;
        r.step = 4 * ONE / r.whole;
        r.step_rest = 4 * ONE % r.whole;
    }
    return r;
}

static inline void ramp_next(ramp *r)
{
    r->rest += r->step_rest;
    int carry = r->rest >= r->whole;
    r->rest -= carry ? r->whole : 0;
    r->weight += r->step + carry;
}

/* Four curves, and the weight of the lower two. */
typedef struct {
    const uint8_t *above_left, *above_right, *below_left, *below_right;
    int32_t below;
} mixture;

static inline uint32_t mix(const mixture *of, int32_t above, int32_t below)
{
    return (uint32_t)above * (uint32_t)(ONE - of->below) + (uint32_t)below * (uint32_t)of->below;
}

static void mix_gray(uint8_t *dst, const uint8_t *src, int32_t n, const mixture *of, ramp r)
{
    for (int32_t i = 0; i < n; i++, ramp_next(&r)) {
        int32_t p = src[i], left = ONE - r.weight;
        int32_t above = of->above_left[p] * left + of->above_right[p] * r.weight;
        int32_t below = of->below_left[p] * left + of->below_right[p] * r.weight;
        dst[i] = (uint8_t)((mix(of, above, below) + (1 << 21)) >> 22);
    }
}

static void mix_lightness(uint8_t *dst, const uint8_t *src, int32_t n, const mixture *of, ramp r)
{
    for (int32_t i = 0; i < 3 * n; i += 3, ramp_next(&r)) {
        iris_hsl_extent extent = iris_hsl_extent_of(src[i], src[i + 1], src[i + 2]);
        int32_t l = extent.sum, left = ONE - r.weight;
        int32_t above =
            iris_tone_twice_at(of->above_left, l) * left + iris_tone_twice_at(of->above_right, l) * r.weight;
        int32_t below =
            iris_tone_twice_at(of->below_left, l) * left + iris_tone_twice_at(of->below_right, l) * r.weight;
        iris_lightness_set(dst + i, src + i, extent, (int32_t)((mix(of, above, below) + 2) >> 2));
    }
}

/* Two rows of curves, and the weight of the lower one. */
typedef struct {
    const uint8_t *above, *below;
    int32_t weight;
    int32_t tiles;
} tile_rows;

/* A row between the curves of two rows of tiles. */
static void mix_row(const iris_image *dst, const iris_image *src, int32_t y, const tile_rows *rows)
{
    int32_t bytes = src->format == IRIS_GRAY8 ? 1 : 3;
    uint8_t *to = (uint8_t *)iris_image_row(dst, y);
    const uint8_t *from = (const uint8_t *)iris_image_row(src, y);
    for (int32_t i = 0; i <= rows->tiles; i++) {
        stretch across = stretch_before(i, src->w, rows->tiles);
        int32_t start = bytes * across.first, n = across.end - across.first;
        mixture of = {rows->above + 256 * across.left, rows->above + 256 * across.right,
                      rows->below + 256 * across.left, rows->below + 256 * across.right, rows->weight};
        if (bytes == 1) {
            mix_gray(to + start, from + start, n, &of, ramp_at(&across, across.first));
        } else {
            mix_lightness(to + start, from + start, n, &of, ramp_at(&across, across.first));
        }
    }
}

iris_status iris_equalize_local(const iris_image *dst, const iris_image *src,
                                const iris_equalize_local_config *config, iris_scratch *scratch)
{
    iris_equalize_local_config by;
    iris_status status = scratch ? iris_views_check_levels(dst, src, IRIS_BORDER_NONE) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    iris_equalize_local_defaults(&by);
    by = config ? *config : by;
    if (by.tiles < 1 || by.tiles > IRIS_EQUALIZE_TILES_MAX || by.limit_q16 < 0 ||
        by.limit_q16 > 256 * IRIS_Q16_ONE) {
        return IRIS_ERR_ARG;
    }
    if (by.tiles > src->w || by.tiles > src->h) {
        return IRIS_ERR_RANGE;
    }
    size_t mark = iris_scratch_mark(scratch);
    uint8_t *memory = (uint8_t *)iris_scratch_take(scratch, IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(by.tiles));
    if (!memory) {
        return IRIS_ERR_SCRATCH;
    }
    uint8_t *curves = memory + 1024;
    make_curves(curves, (uint32_t *)(void *)memory, src, &by);
    for (int32_t i = 0; i <= by.tiles; i++) {
        stretch down = stretch_before(i, src->h, by.tiles);
        ramp r = ramp_at(&down, down.first);
        for (int32_t y = down.first; y < down.end; y++, ramp_next(&r)) {
            tile_rows rows = {curves + 256 * by.tiles * down.left, curves + 256 * by.tiles * down.right,
                              r.weight, by.tiles};
            mix_row(dst, src, y, &rows);
        }
    }
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}
