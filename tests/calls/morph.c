/* Morphology. */
#include "iris/xt/morph.h"

#include "calls.h"

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

const random_call calls_morph[] = {
    {"iris_morph_dilate", dilate},     {"iris_morph_erode", erode},
    {"iris_morph_open", opened},       {"iris_morph_close", closed},
    {"iris_morph_gradient", gradient}, {"iris_morph_tophat", tophat},
    {"iris_morph_blackhat", blackhat}, {NULL, NULL},
};
