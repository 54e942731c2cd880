/* Views themselves. */
#include "calls.h"

static void wrap(void)
{
    iris_size size = draw_size();
    iris_format format = draw_format();
    size_t row = iris_format_row_bytes(format, size.w), bytes = row * (size_t)size.h + draw_below(40);
    ptrdiff_t stride = draw_chance(3) ? 0 : (ptrdiff_t)row + draw_within(-4, 4);
    iris_image *image = OR_NULL(draw_results(sizeof *image));
    void *buffer = OR_NULL(draw_given(NULL, bytes));
    if (draw_chance(10)) {
        int32_t *side = draw_chance(2) ? &size.w : &size.h;
        *side = draw_int(INT32_MIN, INT32_MAX);
        stride = draw_chance(2) ? draw_chance(2) ? PTRDIFF_MIN : PTRDIFF_MAX : stride;
        bytes = draw_chance(2) ? SIZE_MAX : bytes;
    }
    stride = draw_chance(3) && stride != PTRDIFF_MIN ? -stride : stride;
    CALL(iris_image_wrap(image, buffer, bytes, size, stride, format));
}

static void crop(void)
{
    const iris_image *image = draw_input(draw_format(), draw_size());
    iris_image *view = OR_NULL(draw_results(sizeof *view));
    iris_rect rect = {draw_chance(2) ? 0 : draw_int(0, 40), draw_int(0, 10), draw_int(1, 40),
                      draw_int(1, 10)};
    CALL(iris_image_crop(view, image, rect));
}

static void check(void)
{
    const iris_image *image = draw_input(draw_format(), draw_size());
    CALL(iris_image_check(image));
}

const random_call calls_image[] = {
    {"iris_image_wrap", wrap},
    {"iris_image_crop", crop},
    {"iris_image_check", check},
    {NULL, NULL},
};
