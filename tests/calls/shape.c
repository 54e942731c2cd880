/* Shapes: their contours. */
#include "calls.h"
#include "iris/xt/contour.h"

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

const random_call calls_shape[] = {
    {"iris_contour_find", find},
    {"iris_contour_points", points},
    {NULL, NULL},
};
