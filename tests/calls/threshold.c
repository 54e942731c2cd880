/* Masks of gray pictures. */
#include "iris/xt/threshold.h"

#include "calls.h"

static iris_select any_side(void)
{
    return (iris_select)draw_int(IRIS_SELECT_BRIGHT, IRIS_SELECT_DARK);
}

static void fixed(void)
{
    iris_size size = draw_size();
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *gray = draw_input(IRIS_GRAY8, size);
    uint8_t value = (uint8_t)draw_below(256);
    iris_select side = any_side();
    CALL(iris_threshold(mask, gray, value, side));
}

static void otsu(void)
{
    iris_size size = draw_size();
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *gray = draw_input(IRIS_GRAY8, size);
    uint8_t *value = OR_NULL(draw_results(1));
    iris_select side = any_side();
    iris_scratch *scratch = draw_scratch(IRIS_THRESHOLD_OTSU_SCRATCH_BYTES);
    CALL(iris_threshold_otsu(value, mask, gray, side, scratch));
}

static void otsu_value(void)
{
    uint32_t histogram[256] = {0};
    for (int i = 0; i < 256; i++) {
        histogram[i] = draw_chance(20) ? draw_below(draw_chance(10) ? UINT32_MAX : 1000) : 0;
    }
    uint8_t *value = OR_NULL(draw_results(1));
    const uint32_t *given = OR_NULL(draw_given(histogram, sizeof histogram));
    CALL(iris_otsu_value(value, given));
}

static void adaptive(void)
{
    iris_size size = draw_size();
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *gray = draw_input(IRIS_GRAY8, size);
    int32_t radius = draw_int(0, draw_chance(4) ? IRIS_THRESHOLD_RADIUS_MAX : 40), c = draw_int(-255, 255);
    iris_select side = any_side();
    iris_scratch *scratch = draw_scratch(radius < 0 || radius > IRIS_THRESHOLD_RADIUS_MAX || size.w == 0
                                             ? 0
                                             : IRIS_THRESHOLD_SCRATCH_BYTES(size.w, radius));
    CALL(iris_threshold_adaptive(mask, gray, radius, c, side, scratch));
}

const random_call calls_threshold[] = {
    {"iris_threshold", fixed},
    {"iris_threshold_otsu", otsu},
    {"iris_otsu_value", otsu_value},
    {"iris_threshold_adaptive", adaptive},
    {NULL, NULL},
};
