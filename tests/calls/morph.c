/* Morphology, patterns in masks, and distances. */
#include "iris/xt/morph.h"

#include <string.h>

#include "calls.h"
#include "iris/xt/distance.h"
#include "iris/xt/hitmiss.h"

typedef iris_status (*operation)(const iris_image *dst, const iris_image *src,
                                 const iris_morph_element *element, iris_border border,
                                 iris_scratch *scratch);

static iris_morph_element any_element(void)
{
    iris_morph_element element;
    iris_morph_element_defaults(&element);
    if (draw_chance(2)) {
        element.w = draw_int(1, draw_chance(20) ? IRIS_MORPH_SIDE_MAX : 12);
        element.h = draw_int(1, draw_chance(20) ? IRIS_MORPH_SIDE_MAX : 12);
    }
    element.shape = (iris_morph_shape)draw_int(IRIS_MORPH_SQUARE, IRIS_MORPH_CROSS);
    element.exclude_center = draw_int(0, 1);
    return element;
}

static int fits(iris_morph_element element)
{
    return element.w >= 1 && element.w <= IRIS_MORPH_SIDE_MAX && element.h >= 1 &&
           element.h <= IRIS_MORPH_SIDE_MAX;
}

static void call(operation run, size_t steps)
{
    iris_format format = draw_chance(2) ? IRIS_MASK1 : draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    iris_morph_element element = any_element();
    const iris_morph_element *given = draw_given(&element, sizeof element);
    if (draw_chance(10)) {
        given = NULL;
        iris_morph_element_defaults(&element);
    }
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch(
        fits(element) ? steps * IRIS_MORPH_SCRATCH_BYTES(format, size.w, element.w, element.h) : 0);
    CALL(run(dst, src, given, border, scratch));
}

static void dilate(void)
{
    call(iris_morph_dilate, 1);
}

static void erode(void)
{
    call(iris_morph_erode, 1);
}

static void opened(void)
{
    call(iris_morph_open, 2);
}

static void closed(void)
{
    call(iris_morph_close, 2);
}

static void gradient(void)
{
    call(iris_morph_gradient, 2);
}

static void tophat(void)
{
    call(iris_morph_tophat, 2);
}

static void blackhat(void)
{
    call(iris_morph_blackhat, 2);
}

static void distance(void)
{
    iris_size size = draw_size();
    const iris_image *far = draw_output(IRIS_GRAY_U16, size);
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    iris_distance_metric metric = (iris_distance_metric)draw_int(IRIS_DISTANCE_L1, IRIS_DISTANCE_CHAMFER);
    CALL(iris_distance_transform(far, mask, metric));
}

static void pattern_read(void)
{
    char text[80];
    int32_t length = draw_within(0, 20), row = draw_within(1, 10);
    for (int32_t i = 0; i < length; i++) {
        text[i] = (char)(draw_chance(60) ? draw_below(256)
                                         : (uint32_t)(i % row == row - 1 ? '/' : "01."[draw_below(3)]));
    }
    text[length] = '\0';
    iris_hitmiss_pattern *pattern = OR_NULL(draw_results(sizeof *pattern));
    const char *given = OR_NULL(draw_given(text, strlen(text) + 1));
    CALL(iris_hitmiss_pattern_read(pattern, given));
}

static void hitmiss(void)
{
    iris_hitmiss_pattern pattern = {
        draw_int(1, IRIS_HITMISS_SIDE_MAX), draw_int(1, IRIS_HITMISS_SIDE_MAX), {0}, {0}};
    for (int y = 0; y < IRIS_HITMISS_SIDE_MAX; y++) {
        pattern.set[y] = (uint8_t)(draw_below(256) >> draw_below(8));
        pattern.clear[y] = (uint8_t)(draw_below(256) >> draw_below(8));
    }
    int fits_here = pattern.w >= 1 && pattern.w <= IRIS_HITMISS_SIDE_MAX && pattern.h >= 1 &&
                    pattern.h <= IRIS_HITMISS_SIDE_MAX;
    iris_size size = draw_size();
    const iris_image *dst = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(IRIS_MASK1, size);
    const iris_hitmiss_pattern *given = OR_NULL(draw_given(&pattern, sizeof pattern));
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch(
        fits_here ? IRIS_HITMISS_SCRATCH_BYTES(size.w, (uint32_t)pattern.w, (uint32_t)pattern.h) : 0);
    CALL(iris_hitmiss_find(dst, src, given, border, scratch));
}

const random_call calls_morph[] = {
    {"iris_morph_dilate", dilate},
    {"iris_morph_erode", erode},
    {"iris_morph_open", opened},
    {"iris_morph_close", closed},
    {"iris_morph_gradient", gradient},
    {"iris_morph_tophat", tophat},
    {"iris_morph_blackhat", blackhat},
    {"iris_distance_transform", distance},
    {"iris_hitmiss_pattern_read", pattern_read},
    {"iris_hitmiss_find", hitmiss},
    {NULL, NULL},
};
