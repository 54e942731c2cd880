#include "digest.h"

#include "iris/xt/contour.h"
#include "iris/xt/moments.h"
#include "iris/xt/shape.h"
#include "iris/xt/threshold.h"

#define W 131
#define H 45

/* What is brighter than `value`: a bright half, spots, and a ragged line between them. */
static iris_image bright(uint8_t value)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image mask = digest_canvas(IRIS_MASK1, W, H);
    (void)iris_threshold(&mask, &gray, value, IRIS_SELECT_BRIGHT);
    return mask;
}

static void contours(void)
{
    iris_image mask = bright(128);
    iris_contour found[12];
    iris_contour_point points[40];
    int32_t count = 0;
    iris_scratch scratch = digest_scratch(IRIS_CONTOUR_SCRATCH_BYTES(W, H));
    digest_number(iris_contour_find(found, 12, &count, &mask, &scratch));
    digest_number(count);
    for (int32_t i = 0; i < 12 && i < count; i++) {
        const iris_contour *c = &found[i];
        const int32_t fields[] = {c->x, c->y, c->is_hole, c->parent, c->area, c->points, c->diagonals};
        digest_values(fields, sizeof fields, 4);
        digest_values(&c->box, sizeof c->box, 4);
        int32_t length = 0;
        digest_number(iris_contour_points(points, 40, &length, c, &mask));
        digest_values(points, (size_t)(length < 40 ? length : 40) * sizeof points[0], sizeof points[0].x);
    }
}

static void moments(void)
{
    iris_image mask = bright(128);
    iris_mask_moments sums = {0};
    iris_invariants v = {0};
    digest_number(iris_mask_moments_sum(&sums, &mask));
    digest_number(iris_moments_invariants(&v, &sums));
    digest_values(&sums, sizeof sums, sizeof sums.m00);
    digest_number(v.x_q16);
    digest_number(v.y_q16);
    digest_values(v.hu_q40, sizeof v.hu_q40, sizeof v.hu_q40[0]);
}

static void signature(void)
{
    iris_image mask = bright(128);
    const iris_shape_sampling config = {90, IRIS_SHAPE_LAST, 0, 0, 0};
    uint16_t *rays = digest_take(90 * sizeof *rays), *other = digest_take(90 * sizeof *other);
    iris_shape_rays from = {0, 0, 0, 0};
    iris_shape_correlation best = {0, 0, 0, 0, 0};
    digest_number(iris_shape_sample(rays, &from, &mask, &config));
    digest_values(rays, 90 * sizeof *rays, sizeof *rays);
    digest_values(&from, sizeof from, 4);
    digest_number(
        iris_shape_sample(other, NULL, &mask, &(iris_shape_sampling){90, IRIS_SHAPE_FIRST, 0, 0, 0}));
    digest_number(iris_shape_correlate(&best, rays, other, 90, NULL));
    digest_number(best.degree_q16);
    digest_number(best.shift);
    digest_number(best.mirrored);
    digest_number(best.angle);
    digest_number(best.compared);
}

static void digest_match(const iris_shape *shape, const iris_shape *model, iris_shape_method method)
{
    iris_shape_matching config;
    iris_shape_found found = {0, 0, 0, 0, 0};
    const iris_shape_library library = {model, 1};
    size_t bytes = IRIS_SHAPE_MATCH_SCRATCH_BYTES;
    iris_scratch scratch;
    iris_shape_matching_defaults(&config, method);
    (void)iris_scratch_init(&scratch, digest_take(bytes), bytes);
    digest_number(iris_shape_match(&found, shape, &library, &config, &scratch));
    digest_number(found.class_index);
    digest_number(found.score_q16);
    digest_number(found.angle);
    digest_number(found.mirrored);
}

static void shapes(void)
{
    iris_image mask = bright(128);
    iris_contour outlines[2];
    iris_shape *two = digest_take(2 * sizeof *two);
    int32_t count = 0;
    iris_scratch scratch = digest_scratch(IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(W, H));
    digest_number(iris_contour_find(outlines, 2, &count, &mask, &scratch));
    for (int i = 0; i < 2 && i < count; i++) {
        digest_number(iris_shape_describe(&two[i], &outlines[i], &mask, &scratch));
        digest_values(two[i].x, sizeof two[i].x, 2);
        digest_values(two[i].y, sizeof two[i].y, 2);
        digest_values(two[i].rays, sizeof two[i].rays, 2);
        digest_values(two[i].moments_q20, sizeof two[i].moments_q20, 4);
    }
}

static void match_any(iris_shape_method method)
{
    iris_shape *two = digest_take(2 * sizeof *two);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < IRIS_SHAPE_RAYS; k++) {
            two[i].rays[k] = (uint16_t)digest_between(20000, IRIS_SHAPE_ONE);
        }
        two[i].moments_q20[0] = digest_between(100000, 300000);
    }
    digest_match(&two[0], &two[1], method);
}

static void radial(void)
{
    match_any(IRIS_SHAPE_RADIAL);
}

static void by_moments(void)
{
    match_any(IRIS_SHAPE_MOMENTS);
}

/* Two stars. */
static void heights(void)
{
    iris_shape *two = digest_take(2 * sizeof *two);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < IRIS_SHAPE_POINTS; k++) {
            int32_t r = 1200 + 700 * (k / 8 % 2) + digest_between(0, 100);
            iris_angle angle = iris_angle_wrap(k * 1024 + i * 8000);
            two[i].x[k] = (int16_t)iris_q30_mul(r, iris_cos_q30(angle));
            two[i].y[k] = (int16_t)iris_q30_mul(r / 2, iris_sin_q30(angle));
        }
    }
    digest_match(&two[0], &two[1], IRIS_SHAPE_HEIGHTS);
}

const digest_operation digest_shape[] = {
    {"shape.contours", contours},   {"shape.moments", moments},
    {"shape.signature", signature}, {"shape.shapes", shapes},
    {"shape.radial", radial},       {"shape.by_moments", by_moments},
    {"shape.heights", heights},     {NULL, NULL},
};
