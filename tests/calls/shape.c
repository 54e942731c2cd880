/* Shapes: their contours, moments, signatures, and what is like them. */
#include "iris/xt/shape.h"
#include "calls.h"
#include "iris/xt/contour.h"
#include "iris/xt/moments.h"

static void find(void)
{
    iris_size size = draw_size();
    int32_t capacity = draw_within(-1, 40);
    size_t room = capacity > 0 ? (size_t)capacity : 0;
    iris_contour *found = OR_NULL(draw_results(room * sizeof *found));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    iris_scratch *scratch = draw_scratch(IRIS_CONTOUR_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_contour_find(found, capacity, count, mask, scratch));
}

static void points(void)
{
    iris_size size = draw_size();
    int32_t capacity = draw_within(-1, 40);
    size_t room = capacity > 0 ? (size_t)capacity : 0;
    iris_contour contour = {.x = draw_int(0, size.w), .y = draw_int(0, size.h)};
    iris_contour_point *to = OR_NULL(draw_results(room * sizeof *to));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const iris_contour *given = OR_NULL(draw_given(&contour, sizeof contour));
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    CALL(iris_contour_points(to, capacity, count, given, mask));
}

static void moments(void)
{
    iris_mask_moments *to = OR_NULL(draw_results(sizeof *to));
    const iris_image *mask = draw_input(IRIS_MASK1, draw_size());
    CALL(iris_mask_moments_sum(to, mask));
}

static void invariants(void)
{
    int64_t side = draw_within(0, IRIS_MOMENTS_SIDE_MAX), n = draw_within(-1, (1 << 24) + 1);
    int64_t first = n * side, second = first * side, third = second * side;
    iris_mask_moments sums = {n,     first, draw_below(1000), second, draw_below(1000),
                              third, third, draw_below(1000), third,  draw_below(1000)};
    iris_invariants *to = OR_NULL(draw_results(sizeof *to));
    const iris_mask_moments *given = OR_NULL(draw_given(draw_chance(8) ? NULL : &sums, sizeof sums));
    CALL(iris_moments_invariants(to, given));
}

static void sample(void)
{
    iris_size size = draw_size();
    iris_shape_sampling config = {draw_int(4, 90), (iris_shape_crossing)draw_below(draw_chance(20) ? 3 : 2),
                                  (int32_t)draw_below(2), draw_int(0, size.w << 16),
                                  draw_int(0, size.h << 16)};
    int fits = config.samples >= 0 && config.samples <= IRIS_SHAPE_SAMPLES_MAX;
    uint16_t *distances = OR_NULL(draw_results((size_t)(fits ? config.samples : 128) * sizeof *distances));
    iris_shape_rays *rays = OR_NULL(draw_results(sizeof *rays));
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    const iris_shape_sampling *given = draw_given(&config, sizeof config);
    CALL(iris_shape_sample(distances, rays, mask, given));
}

/* Samples as a shape has them, or anything. */
static const uint16_t *any_samples(int32_t n)
{
    uint16_t samples[100];
    for (int32_t i = 0; i < n; i++) {
        samples[i] = draw_chance(10) ? IRIS_SHAPE_MISSING : (uint16_t)draw_below(IRIS_SHAPE_ONE + 1);
    }
    return OR_NULL(draw_given(draw_chance(9) ? NULL : samples, (size_t)n * sizeof samples[0]));
}

static void table(void)
{
    int32_t samples = draw_within(3, 90);
    iris_shape_entry *entries = OR_NULL(draw_results((size_t)samples * sizeof *entries));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const uint16_t *distances = any_samples(samples);
    int32_t longest = draw_int(0, 70 << 16);
    CALL(iris_shape_table(entries, count, distances, samples, longest));
}

static void correlate(void)
{
    int32_t samples = draw_within(3, 90);
    iris_shape_tolerance tolerance = {draw_int(0, 9000), draw_int(0, 65536), draw_int(0, 65536),
                                      (int32_t)draw_below(2)};
    iris_shape_correlation *best = OR_NULL(draw_results(sizeof *best));
    const uint16_t *a = any_samples(samples), *b = any_samples(samples);
    const iris_shape_tolerance *given = OR_NULL(draw_given(&tolerance, sizeof tolerance));
    CALL(iris_shape_correlate(best, a, b, samples, given));
}

static void describe(void)
{
    iris_size size = draw_size();
    iris_contour contour = {.x = draw_int(0, size.w), .y = draw_int(0, size.h)};
    iris_shape *shape = OR_NULL(draw_results(sizeof *shape));
    const iris_contour *given = OR_NULL(draw_given(&contour, sizeof contour));
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    iris_scratch *scratch = draw_scratch(IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_shape_describe(shape, given, mask, scratch));
}

/* A description that no shape need have. */
static void any_shape(iris_shape *shape)
{
    *shape = (iris_shape){.class_index = (int32_t)draw_below(4)};
    for (int i = 0; i < IRIS_SHAPE_POINTS; i++) {
        shape->x[i] = (int16_t)draw_within(-IRIS_SHAPE_DIAMETER, IRIS_SHAPE_DIAMETER);
        shape->y[i] = (int16_t)draw_within(-IRIS_SHAPE_DIAMETER, IRIS_SHAPE_DIAMETER);
    }
    for (int i = 0; i < IRIS_SHAPE_RAYS; i++) {
        shape->rays[i] = (uint16_t)draw_below(IRIS_SHAPE_ONE + 1);
    }
    shape->moments_q20[draw_below(4)] = draw_int(0, 1 << 30);
}

static void match(void)
{
    iris_shape shapes[3];
    iris_shape_matching config;
    iris_shape_matching_defaults(&config, (iris_shape_method)draw_below(3));
    config.mirrored = (int32_t)draw_below(2);
    config.least_q16 = draw_int(0, 65536);
    config.except = draw_int(-1, 3);
    for (int i = 0; i < 3; i++) {
        any_shape(&shapes[i]);
    }
    iris_shape_library library = {OR_NULL(draw_given(&shapes[1], 2 * sizeof shapes[0])), draw_within(-1, 2)};
    iris_shape_found *found = OR_NULL(draw_results(sizeof *found));
    const iris_shape *shape = OR_NULL(draw_given(draw_chance(30) ? NULL : shapes, sizeof shapes[0]));
    const iris_shape_library *from = OR_NULL(draw_given(&library, sizeof library));
    const iris_shape_matching *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch(IRIS_SHAPE_MATCH_SCRATCH_BYTES);
    CALL(iris_shape_match(found, shape, from, given, scratch));
}

const random_call calls_shape[] = {
    {"iris_contour_find", find},         {"iris_contour_points", points},
    {"iris_mask_moments_sum", moments},  {"iris_moments_invariants", invariants},
    {"iris_shape_sample", sample},       {"iris_shape_table", table},
    {"iris_shape_correlate", correlate}, {"iris_shape_describe", describe},
    {"iris_shape_match", match},         {NULL, NULL},
};
