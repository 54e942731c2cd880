#include "iris/xt/birdseye.h"

#include "floor_parts.h"
#include "runs.h"

#define RUN_BITS 7    /* pixels between two exact positions: 2^RUN_BITS at most */
#define BEND     8192 /* 4/32 of a pixel, 16 fraction bits: see may_join */
#define ENTRY    45   /* bits of a number that is multiplied with a pixel's x or y */

iris_status iris_birdseye_init(iris_birdseye *birdseye, const iris_floor *floor,
                               const iris_birdseye_window *window)
{
    if (!birdseye || !floor || !window || window->mm_per_pixel_q16 < IRIS_BIRDSEYE_SCALE_MIN ||
        window->mm_per_pixel_q16 > IRIS_BIRDSEYE_SCALE_MAX) {
        return IRIS_ERR_ARG;
    }
    if (window->size.w < 1 || window->size.w > IRIS_SIDE_MAX || window->size.h < 1 ||
        window->size.h > IRIS_SIDE_MAX || floor->size.w > IRIS_BIRDSEYE_SOURCE_MAX ||
        floor->size.h > IRIS_BIRDSEYE_SOURCE_MAX) {
        return IRIS_ERR_RANGE;
    }
    iris_wide entry[9];
    int shift = 0;
    for (int i = 0; i < 9; i += 3) {
        entry[i] = iris_wide_mul(floor->to_image_q32[i], window->mm_per_pixel_q16);
        entry[i + 1] = iris_wide_mul(floor->to_image_q32[i + 1], -window->mm_per_pixel_q16);
        entry[i + 2] = iris_floor_row(floor->to_image_q32 + i, window->corner);
    }
    for (int i = 0; i < 9; i++) {
        int over = iris_wide_bits(entry[i]) - ENTRY - (i % 3 == 2 ? 15 : 0);
        shift = over > shift ? over : shift;
    }
    *birdseye = (iris_birdseye){.window = *window, .source = floor->size};
    for (int i = 0; i < 9; i++) {
        birdseye->row[i] = iris_wide_round_shift_sat(entry[i], shift);
    }
    return IRIS_OK;
}

/* What a pixel of the map is projected with: position * depth, and depth. */
typedef struct {
    int64_t x, y, depth;
} ray;

/* A position that was computed exactly. */
typedef struct {
    iris_q16 x, y;
    int64_t depth;
    int exists; /* 0: behind the camera, or far outside of the picture */
} knot;

/* The way along a row of the map. */
typedef struct {
    ray first, step; /* of the row's first pixel, and from each to the next */
    int32_t x, w;
    int bits; /* to try: the next run may be of 2^bits pixels */
    knot here;
} walk;

static int bits_of(int64_t value)
{
    return iris_wide_bits(iris_wide_from(value));
}

/* a / depth with 16 fraction bits, where r is 2^62 / (depth / 2^shift), below 2^32. */
static iris_q16 position(int64_t a, uint32_t r, int shift)
{
    int64_t shifted = shift >= 0 ? a >> shift : a * ((int64_t)1 << -shift);
    return (iris_q16)iris_round_shift((shifted >> 15) * (int64_t)r, 31);
}

static knot knot_at(const walk *w, int32_t x)
{
    knot made = {0, 0, w->first.depth + x * w->step.depth, 0};
    int64_t right = w->first.x + x * w->step.x, down = w->first.y + x * w->step.y;
    int64_t most = made.depth - (made.depth >> 8); /* up to 32640 pixels: positions fit 32 bits */
    if (made.depth < 65536 || right >> 15 >= most || right >> 15 <= -most || down >> 15 >= most ||
        down >> 15 <= -most) {
        return made;
    }
    int shift = bits_of(made.depth) - 31;
    uint64_t by = (uint64_t)(shift >= 0 ? made.depth >> shift : made.depth << -shift);
    uint64_t inverse = ((uint64_t)1 << 62) / by;
    uint32_t r = inverse > UINT32_MAX ? UINT32_MAX : (uint32_t)inverse;
    made.exists = 1;
    made.x = position(right, r, shift);
    made.y = position(down, r, shift);
    return made;
}

static walk walk_of(const iris_birdseye *b, int32_t y)
{
    walk made = {.w = b->window.size.w, .bits = RUN_BITS};
    const int64_t *row = b->row;
    made.first = (ray){row[1] * y + row[2], row[4] * y + row[5], row[7] * y + row[8]};
    made.step = (ray){row[0], row[3], row[6]};
    made.here = knot_at(&made, 0);
    return made;
}

static int64_t magnitude(int64_t value)
{
    return value < 0 ? -value : value;
}

/* May positions between two knots be interpolated? They are off by at most |way| (sqrt k - 1) / (sqrt k + 1), k the ratio of
 * the depths, the larger to the smaller: less than |way| (k - 1) / 4. That is to be within 1/32 of a pixel. */
static int may_join(const knot *a, const knot *b)
{
    if (!a->exists || !b->exists) {
        return 0;
    }
    int64_t right = magnitude((int64_t)b->x - a->x), down = magnitude((int64_t)b->y - a->y);
    int64_t way = right > down ? right : down;
    int64_t least = a->depth < b->depth ? a->depth : b->depth, change = magnitude(b->depth - a->depth);
    int shift = bits_of(least > change ? least : change) - 31;
    shift = shift > 0 ? shift : 0;
    return (way >> 1) * ((change >> shift) + 1) <= BEND / 2 * (least >> shift);
}

/* The next run; 0 behind the row's end. */
static int next_run(iris_run *to, walk *w)
{
    if (w->x >= w->w) {
        return 0;
    }
    int bits = w->bits;
    knot there = knot_at(w, w->x + (1 << bits));
    while (bits > 0 && !may_join(&w->here, &there)) {
        there = knot_at(w, w->x + (1 << --bits));
    }
    const knot *here = &w->here;
    int32_t n = 1 << bits;
    *to = (iris_run){.n = n, .exists = here->exists, .x = here->x, .y = here->y};
    if (bits > 0) {
        to->dx = (iris_q16)iris_round_shift((int64_t)there.x - here->x, bits);
        to->dy = (iris_q16)iris_round_shift((int64_t)there.y - here->y, bits);
    }
    to->n = n < w->w - w->x ? n : w->w - w->x;
    w->x += n;
    w->here = there;
    w->bits = bits < RUN_BITS ? bits + 1 : bits;
    return 1;
}

static void draw_row(uint8_t *to, const void *user, const iris_image *src, int32_t y)
{
    const iris_birdseye *birdseye = user;
    int channels = src->format == IRIS_GRAY8 ? 1 : 3;
    walk w = walk_of(birdseye, y);
    iris_run r;
    while (next_run(&r, &w)) {
        iris_run_draw(to, &r, src, channels, birdseye->window.fill);
        to += r.n * channels;
    }
}

static iris_run_picture picture_of(const iris_birdseye *birdseye)
{
    return (iris_run_picture){birdseye->window.size, birdseye->source, birdseye, draw_row};
}

iris_status iris_birdseye_draw(const iris_image *dst, const iris_image *src, const iris_birdseye *birdseye)
{
    if (!dst || !src || !birdseye) {
        return IRIS_ERR_ARG;
    }
    const iris_run_picture picture = picture_of(birdseye);
    return iris_run_picture_draw(dst, src, &picture);
}

iris_status iris_birdseye_row(void *pixels, const iris_birdseye *birdseye, const iris_image *src, int32_t y)
{
    if (!pixels || !birdseye || !src) {
        return IRIS_ERR_ARG;
    }
    const iris_run_picture picture = picture_of(birdseye);
    return iris_run_picture_row(pixels, src, &picture, y);
}

iris_status iris_birdseye_places(iris_place *places, const iris_birdseye *birdseye, int32_t y)
{
    if (!places || !birdseye) {
        return IRIS_ERR_ARG;
    }
    if (y < 0 || y >= birdseye->window.size.h) {
        return IRIS_ERR_RANGE;
    }
    walk w = walk_of(birdseye, y);
    iris_run r;
    for (; next_run(&r, &w); places += r.n) {
        for (int32_t i = 0; i < r.n; i++) {
            iris_place at = iris_run_place(&r, i), none = {INT32_MIN, INT32_MIN};
            int seen = r.exists && iris_run_sees(at, birdseye->source);
            places[i] = seen ? at : none;
        }
    }
    return IRIS_OK;
}
