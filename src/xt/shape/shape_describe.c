#include <string.h>

#include "../mask/contour_steps.h"
#include "iris/xt/moments.h"
#include "iris/xt/shape.h"

#define POINTS       IRIS_SHAPE_POINTS
#define LEVEL_Q8     256
#define DIAGONAL_Q8  362 /* the root of 2 */
#define ROOT_MAX_Q20 ((int64_t)1024 << 20)

/* An outline, and the points along it, in the description itself: pixels with so many fraction bits that the mask's sides
 * fit in 15 bits. */
typedef struct {
    const iris_image *mask;
    iris_image area; /* what it encloses, in working memory */
    iris_contour_side start;
    int64_t length_q8;
    int16_t *x, *y;
    int bits;
} outline;

static int64_t step_q8(int turn)
{
    return turn < 0 ? DIAGONAL_Q8 : turn == 0 ? LEVEL_Q8 : 0;
}

/* Sets the first of the pixels right of each upright side; a pixel with an odd number of sides left of it is enclosed. */
static void mark_sides(outline *o)
{
    iris_contour_side side = o->start;
    o->length_q8 = 0;
    do {
        if ((side.way & 1) == 0 && side.x < o->mask->w) {
            uint32_t *row = (uint32_t *)iris_image_row(&o->area, iris_contour_y(&side));
            row[side.x >> 5] ^= (uint32_t)1 << (side.x & 31);
        }
        o->length_q8 += step_q8(iris_contour_step(&side, o->mask));
    } while (!iris_contour_same(&side, &o->start));
}

static void fill(const outline *o)
{
    const int32_t words = (o->mask->w + 31) / 32;
    for (int32_t y = 0; y < o->mask->h; y++) {
        uint32_t *row = (uint32_t *)iris_image_row(&o->area, y), before = 0;
        for (int32_t word = 0; word < words; word++) {
            uint32_t bits = row[word];
            for (int shift = 1; shift < 32; shift *= 2) {
                bits ^= bits << shift;
            }
            row[word] = bits ^ before;
            before = row[word] >> 31 ? ~(uint32_t)0 : 0;
        }
    }
}

/* POINTS of them evenly along the polygon of pixels. Holes, which are followed the other way, are turned around. */
static void spread_points(outline *o)
{
    iris_contour_side side = o->start;
    int64_t gone_q8 = 0;
    int32_t made = 0, backwards = o->start.way == 2;
    do {
        int64_t x = iris_contour_x(&side), y = iris_contour_y(&side);
        int64_t step = step_q8(iris_contour_step(&side, o->mask));
        int64_t to_x = iris_contour_x(&side), to_y = iris_contour_y(&side);
        while (made < POINTS && made * o->length_q8 < (gone_q8 + step) * POINTS) {
            int64_t part_q8 = ((made * o->length_q8 - gone_q8 * POINTS) * 256 / POINTS) / step;
            int32_t index = backwards ? (POINTS - made) % POINTS : made;
            o->x[index] = (int16_t)iris_round_shift(x * 256 + (to_x - x) * part_q8, 8 - o->bits);
            o->y[index] = (int16_t)iris_round_shift(y * 256 + (to_y - y) * part_q8, 8 - o->bits);
            made++;
        }
        gone_q8 += step;
    } while (!iris_contour_same(&side, &o->start));
}

/* The largest distance of two points, with 8 fraction bits. */
static uint32_t diameter_of(const outline *o)
{
    uint32_t most = 0;
    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < i; k++) {
            int32_t dx = o->x[i] - o->x[k], dy = o->y[i] - o->y[k];
            uint32_t square = (uint32_t)(dx * dx) + (uint32_t)(dy * dy); /* below 2^31 */
            most = square > most ? square : most;
        }
    }
    return iris_sqrt_u64((uint64_t)most << 2 * (8 - o->bits));
}

/* About their mean, with diameter_q8 as IRIS_SHAPE_DIAMETER. */
static void scale_axis(int16_t *axis, int bits, int64_t diameter_q8)
{
    int32_t sum = 0;
    for (int i = 0; i < POINTS; i++) {
        sum += axis[i];
    }
    for (int i = 0; i < POINTS; i++) {
        int64_t scaled = ((int64_t)axis[i] * POINTS - sum) * (IRIS_SHAPE_DIAMETER << (8 - bits));
        int32_t to = (int32_t)(scaled / (diameter_q8 * POINTS));
        axis[i] = (int16_t)(to > IRIS_SHAPE_DIAMETER    ? IRIS_SHAPE_DIAMETER
                            : to < -IRIS_SHAPE_DIAMETER ? -IRIS_SHAPE_DIAMETER
                                                        : to);
    }
}

static void set_moments(iris_shape *shape, const iris_image *area)
{
    iris_mask_moments sums;
    iris_invariants v;
    (void)iris_mask_moments_sum(&sums, area);
    (void)iris_moments_invariants(&v, &sums); /* no outline encloses nothing */
    shape->x_q16 = v.x_q16;
    shape->y_q16 = v.y_q16;
    for (int i = 0; i < 4; i++) {
        int64_t hu = v.hu_q40[i] < 0 ? 0 : v.hu_q40[i];
        int64_t root = i == 0 ? hu >> 20 : (int64_t)iris_sqrt_u64((uint64_t)hu);
        shape->moments_q20[i] = (int32_t)(root > ROOT_MAX_Q20 ? ROOT_MAX_Q20 : root);
    }
}

static iris_status check(outline *o, const iris_contour *contour)
{
    iris_status status = iris_image_check(o->mask);
    if (status != IRIS_OK || o->mask->format != IRIS_MASK1) {
        return status != IRIS_OK ? status : IRIS_ERR_FORMAT;
    }
    if (o->mask->w > IRIS_MOMENTS_SIDE_MAX || o->mask->h > IRIS_MOMENTS_SIDE_MAX ||
        (uint32_t)contour->x >= (uint32_t)o->mask->w || (uint32_t)contour->y >= (uint32_t)o->mask->h ||
        !iris_contour_start(&o->start, o->mask, contour->x, contour->y)) {
        return IRIS_ERR_RANGE;
    }
    return IRIS_OK;
}

/* Holes of a part count for rays, as they are a border that a ray meets. */
static void cut_holes(const outline *o)
{
    const int32_t words = (o->mask->w + 31) / 32;
    for (int32_t y = 0; y < o->mask->h; y++) {
        uint32_t *row = (uint32_t *)iris_image_row(&o->area, y);
        const uint32_t *from = (const uint32_t *)iris_image_row(o->mask, y);
        for (int32_t word = 0; word < words; word++) {
            row[word] &= from[word];
        }
    }
}

/* Nothing here can fail. */
static void describe(iris_shape *shape, outline *o)
{
    fill(o);
    o->x = shape->x;
    o->y = shape->y;
    o->bits = 7;
    while ((o->mask->w | o->mask->h) << o->bits >= 65536 / 2) {
        o->bits--;
    }
    spread_points(o);
    uint32_t diameter_q8 = diameter_of(o);
    diameter_q8 += diameter_q8 == 0;
    shape->class_index = 0;
    shape->diameter_q16 = iris_sat_s32((int64_t)diameter_q8 * 256);
    scale_axis(shape->x, o->bits, diameter_q8);
    scale_axis(shape->y, o->bits, diameter_q8);
    set_moments(shape, &o->area);
    if (o->start.way == 0) {
        cut_holes(o);
    }
    const iris_shape_sampling rays = {IRIS_SHAPE_RAYS, IRIS_SHAPE_FIRST, 1, shape->x_q16, shape->y_q16};
    (void)iris_shape_sample(shape->rays, NULL, &o->area, &rays);
}

iris_status iris_shape_describe(iris_shape *shape, const iris_contour *contour, const iris_image *mask,
                                iris_scratch *scratch)
{
    if (!shape || !contour || !mask || !scratch) {
        return IRIS_ERR_ARG;
    }
    outline o = {.mask = mask};
    iris_status status = check(&o, contour);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch), bytes = IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(mask->w, mask->h);
    void *memory = iris_scratch_take(scratch, bytes);
    if (!memory) {
        return IRIS_ERR_SCRATCH;
    }
    memset(memory, 0, bytes);
    status = iris_image_wrap(&o.area, memory, bytes, (iris_size){mask->w, mask->h}, 0, IRIS_MASK1);
    if (status == IRIS_OK) {
        mark_sides(&o);
        status = o.length_q8 == 0 ? IRIS_ERR_RANGE : IRIS_OK;
    }
    if (status == IRIS_OK) {
        describe(shape, &o);
    }
    iris_scratch_release(scratch, mark);
    return status;
}
