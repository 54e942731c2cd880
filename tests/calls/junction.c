/* Line masks and junctions. */
#include "iris/xt/junction.h"

#include "calls.h"
#include "iris/xt/line_mask.h"

static void line_mask(void)
{
    iris_size size = draw_size();
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *gray = draw_input(IRIS_GRAY8, size);
    int32_t *found = OR_NULL(draw_results(sizeof *found));
    iris_line_mask_config config = {draw_int(0, 1), draw_int(100, 900)};
    const iris_line_mask_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch(IRIS_LINE_MASK_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_line_mask(found, mask, gray, given, scratch));
}

static void junctions(void)
{
    iris_size size = draw_size();
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    int32_t capacity = draw_within(-1, 5);
    size_t room = capacity > 0 ? (size_t)capacity : 0;
    iris_junction *found = OR_NULL(draw_results(room * sizeof *found));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    iris_junction_config config = {draw_int(1000, 10000), (iris_angle)draw_int(0, 8192),
                                   (iris_angle)draw_int(1820, 16384)};
    const iris_junction_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch(IRIS_JUNCTION_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_junctions_find(found, capacity, count, mask, given, scratch));
}

const random_call calls_junction[] = {
    {"iris_line_mask", line_mask},
    {"iris_junctions_find", junctions},
    {NULL, NULL},
};
