#include "digest.h"

#include "iris/pyramid.h"

static void built(iris_format format, int32_t w, int32_t h)
{
    const int channels = format == IRIS_GRAY8 ? 1 : 3;
    iris_image src = digest_picture(format, w, h);
    size_t bytes = IRIS_PYRAMID_BYTES(w, h, channels, 5);
    void *memory = digest_take(bytes);
    iris_scratch scratch = digest_scratch(IRIS_PYRAMID_SCRATCH_BYTES(w, channels));
    for (int rule = IRIS_BORDER_REPLICATE; rule < IRIS_BORDER_SKIP; rule++) {
        iris_pyramid pyramid;
        digest_number(iris_pyramid_wrap(&pyramid, &src, 5, memory, bytes));
        digest_number(iris_pyramid_build(&pyramid, (iris_border){(iris_border_rule)rule, 60}, &scratch));
        digest_bytes(memory, bytes);
    }
}

static void build_gray(void)
{
    built(IRIS_GRAY8, 61, 42);
}

static void build_rgb(void)
{
    built(IRIS_RGB888, 31, 25);
}

static void up(void)
{
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_BGR888};
    for (int i = 0; i < 8; i++) {
        const iris_format format = formats[i % 2];
        iris_image src = digest_picture(format, 9, 7);
        iris_image dst = digest_canvas(format, 18 - i / 2 % 2, 14 - i / 4);
        iris_scratch scratch = digest_scratch(IRIS_PYRAMID_UP_SCRATCH_BYTES(9, i % 2 ? 3 : 1));
        iris_border border = {(iris_border_rule)(i % 4), 60};
        digest_number(iris_pyramid_up(&dst, &src, border, &scratch));
        digest_view(&dst);
    }
}

const digest_operation digest_pyramid[] = {
    {"pyramid.build_gray", build_gray}, {"pyramid.build_rgb", build_rgb}, {"pyramid.up", up}, {NULL, NULL}};
