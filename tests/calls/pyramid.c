/* Gaussian pyramids. */
#include "iris/pyramid.h"

#include "calls.h"

static size_t channels_of(iris_format format)
{
    return format == IRIS_GRAY8 ? 1 : 3;
}

static iris_size half(iris_size size)
{
    return (iris_size){(size.w + 1) / 2, (size.h + 1) / 2};
}

static void wrap(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    int32_t levels = draw_int(1, draw_chance(4) ? IRIS_PYRAMID_LEVELS_MAX : 5);
    int fits = levels >= 1 && levels <= IRIS_PYRAMID_LEVELS_MAX && size.w > 0 && size.h > 0;
    size_t bytes = fits ? IRIS_PYRAMID_BYTES(size.w, size.h, channels_of(format), levels) : 0;
    bytes = bytes > 0 && draw_chance(20) ? bytes - 1 : bytes;
    iris_pyramid *pyramid = OR_NULL(draw_results(sizeof *pyramid));
    const iris_image *src = draw_input(format, size);
    void *memory = OR_NULL(draw_results(bytes));
    CALL(iris_pyramid_wrap(pyramid, src, levels, memory, bytes));
}

/* A pyramid as it is made, some of whose numbers are then changed. */
static void build(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    int32_t levels = draw_within(1, 5);
    size_t channels = channels_of(format), bytes = 0;
    if (size.w > 0 && size.h > 0) {
        bytes = IRIS_PYRAMID_BYTES(size.w, size.h, channels, levels);
    }
    iris_pyramid pyramid = {0};
    const iris_image *src = draw_input(format, size);
    void *memory = draw_results(bytes);
    (void)iris_pyramid_wrap(&pyramid, src, levels, memory, bytes);
    if (draw_chance(8)) {
        iris_image *level = &pyramid.level[draw_below(5)];
        int32_t *numbers[] = {&level->w, &level->h, &pyramid.levels};
        *numbers[draw_below(3)] = draw_chance(2) ? 0 : -1;
    }
    const iris_pyramid *given = OR_NULL(draw_given(&pyramid, sizeof pyramid));
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch_up_to(IRIS_PYRAMID_SCRATCH_BYTES(size.w, channels));
    CALL(iris_pyramid_build(given, border, scratch));
}

static void down(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, half(size));
    const iris_image *src = draw_input(format, size);
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch(IRIS_PYRAMID_SCRATCH_BYTES(size.w, channels_of(format)));
    CALL(iris_pyramid_down(dst, src, border, scratch));
}

static void up(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, half(size));
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch(IRIS_PYRAMID_UP_SCRATCH_BYTES(half(size).w, channels_of(format)));
    CALL(iris_pyramid_up(dst, src, border, scratch));
}

const random_call calls_pyramid[] = {
    {"iris_pyramid_wrap", wrap},
    {"iris_pyramid_build", build},
    {"iris_pyramid_down", down},
    {"iris_pyramid_up", up},
    {NULL, NULL},
};
