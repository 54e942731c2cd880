/* Shapes: their contours and moments. */
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

const random_call calls_shape[] = {
    {"iris_contour_find", find},
    {"iris_contour_points", points},
    {"iris_mask_moments_sum", moments},
    {"iris_moments_invariants", invariants},
    {NULL, NULL},
};
