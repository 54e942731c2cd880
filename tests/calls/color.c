/* Color conversion, of whole views and of rows. */
#include "iris/color.h"

#include "calls.h"
#include "iris/bayer.h"
#include "iris/nv12.h"

static iris_format camera_format(void)
{
    static const iris_format formats[] = {IRIS_GRAY8,  IRIS_RGB888,      IRIS_BGR888, IRIS_RGBA8888,
                                          IRIS_RGB565, IRIS_RGB565_SWAP, IRIS_YUYV,   IRIS_UYVY};
    return formats[draw_below(8)];
}

/* A size that suits the format. */
static iris_size size_for(iris_format format)
{
    iris_size size = draw_size();
    if (format == IRIS_YUYV || format == IRIS_UYVY) {
        size.w += size.w % 2;
    }
    return size;
}

static void convert(void)
{
    iris_format from = draw_chance(3) ? draw_format() : camera_format();
    iris_format to = draw_chance(3) ? draw_format() : draw_gray_or_color();
    iris_size size = size_for(from);
    const iris_image *dst = draw_output(to, size);
    const iris_image *src = draw_input(from, size);
    CALL(iris_color_convert(dst, src));
}

static void gray(void)
{
    iris_format from = camera_format();
    iris_size size = size_for(from);
    const iris_image *dst = draw_output(IRIS_GRAY8, size);
    const iris_image *src = draw_input(from, size);
    iris_gray_method method = (iris_gray_method)draw_int(IRIS_GRAY_LUMA, IRIS_GRAY_GREEN);
    CALL(iris_color_gray(dst, src, method));
}

/* The bytes of a row, at least one. */
static size_t bytes_of(iris_format format, int32_t n)
{
    return iris_format_row_bytes(format, n) + 1;
}

static void row(void)
{
    iris_format from = draw_chance(3) ? draw_format() : camera_format();
    iris_format to = draw_chance(3) ? draw_format() : draw_gray_or_color();
    int32_t n = size_for(from).w;
    uint8_t *dst = OR_NULL(draw_results(bytes_of(to, n)));
    const uint8_t *src = OR_NULL(draw_chance(8) ? dst : draw_given(NULL, bytes_of(from, n)));
    if (src == dst && bytes_of(from, n) > bytes_of(to, n)) {
        from = to;
    }
    int32_t count = draw_chance(20) ? (int32_t)draw_below(2) - 1 : n;
    CALL(iris_color_row(dst, to, src, from, count));
}

static void gray_row(void)
{
    iris_format from = camera_format();
    int32_t n = size_for(from).w;
    uint8_t *dst = OR_NULL(draw_results(bytes_of(IRIS_GRAY8, n)));
    const void *src = OR_NULL(draw_given(NULL, bytes_of(from, n)));
    iris_gray_method method = (iris_gray_method)draw_int(IRIS_GRAY_LUMA, IRIS_GRAY_GREEN);
    CALL(iris_color_gray_row(dst, src, from, method, n));
}

static void rgb_row(void)
{
    iris_format from = camera_format();
    int32_t n = size_for(from).w;
    uint8_t *dst = OR_NULL(draw_results(bytes_of(IRIS_RGB888, n)));
    const void *src = OR_NULL(draw_given(NULL, bytes_of(from, n)));
    CALL(iris_color_rgb_row(dst, src, from, n));
}

static iris_hsl_range any_range(void)
{
    iris_hsl_range range = {draw_int(0, 360),  draw_int(0, 360), draw_within(0, 50),
                            draw_int(50, 100), draw_int(0, 50),  draw_within(50, 100)};
    return range;
}

static void range_prepare(void)
{
    iris_hsl_range range = any_range();
    iris_hsl_range_test *test = OR_NULL(draw_results(sizeof *test));
    const iris_hsl_range *given = OR_NULL(draw_given(&range, sizeof range));
    CALL(iris_hsl_range_prepare(test, given));
}

static void range_row(void)
{
    const iris_hsl_range everything = {0, 360, 0, 100, 20, 80};
    iris_hsl_range range = any_range();
    iris_hsl_range_test test;
    if (iris_hsl_range_prepare(&test, &range) != IRIS_OK) {
        (void)iris_hsl_range_prepare(&test, &everything);
    }
    int32_t n = draw_within(0, 70);
    uint32_t *mask = OR_NULL(draw_results(bytes_of(IRIS_MASK1, n)));
    const uint8_t *rgb = OR_NULL(draw_given(NULL, bytes_of(IRIS_RGB888, n)));
    const iris_hsl_range_test *given = OR_NULL(draw_given(&test, sizeof test));
    CALL(iris_hsl_range_row(mask, rgb, n, given));
}

static void range_mask(void)
{
    iris_hsl_range range = any_range();
    iris_format from = camera_format();
    iris_size size = size_for(from);
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(from, size);
    const iris_hsl_range *given = OR_NULL(draw_given(&range, sizeof range));
    CALL(iris_hsl_range_mask(mask, src, given));
}

static iris_format bayer_format(void)
{
    return (iris_format)draw_within(IRIS_BAYER8_RGGB, IRIS_BAYER8_BGGR);
}

static void bayer_convert(void)
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(draw_gray_or_color(), size);
    const iris_image *src = draw_input(bayer_format(), size);
    CALL(iris_bayer_convert(dst, src));
}

static void bayer_row(void)
{
    iris_format to = draw_gray_or_color();
    int32_t n = draw_within(0, 70);
    uint8_t *dst = OR_NULL(draw_results(bytes_of(to, n)));
    const uint8_t *rows[3] = {NULL, NULL, NULL};
    for (int i = 0; i < 3; i++) {
        rows[i] = i > 0 && draw_chance(3) ? rows[i - 1] : OR_NULL(draw_given(NULL, bytes_of(IRIS_GRAY8, n)));
    }
    const uint8_t *const *given = OR_NULL(draw_given(rows, sizeof rows));
    iris_format order = draw_chance(20) ? draw_format() : bayer_format();
    CALL(iris_bayer_row(dst, to, given, order, n));
}

static void nv12_convert(void)
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(draw_gray_or_color(), size);
    const iris_image *luma = draw_input(IRIS_GRAY8, size);
    const iris_image *chroma = draw_input(IRIS_UV88, (iris_size){(size.w + 1) / 2, (size.h + 1) / 2});
    CALL(iris_nv12_convert(dst, luma, chroma));
}

static void nv12_row(void)
{
    iris_format to = draw_gray_or_color();
    int32_t n = draw_within(0, 70);
    uint8_t *dst = OR_NULL(draw_results(bytes_of(to, n)));
    const uint8_t *luma = OR_NULL(draw_given(NULL, bytes_of(IRIS_GRAY8, n)));
    const uint8_t *chroma = OR_NULL(draw_given(NULL, bytes_of(IRIS_UV88, (n + 1) / 2)));
    CALL(iris_nv12_row(dst, to, luma, chroma, n));
}

static void nv12_crop(void)
{
    iris_size size = draw_size();
    const iris_image *luma = draw_input(IRIS_GRAY8, size);
    const iris_image *chroma = draw_input(IRIS_UV88, (iris_size){(size.w + 1) / 2, (size.h + 1) / 2});
    iris_image *luma_view = OR_NULL(draw_results(sizeof *luma_view));
    iris_image *chroma_view = OR_NULL(draw_results(sizeof *chroma_view));
    iris_rect rect = {2 * draw_within(0, 5), draw_int(0, 4), draw_int(1, 20), draw_int(1, 20)};
    CALL(iris_nv12_crop(luma_view, chroma_view, luma, chroma, rect));
}

const random_call calls_color[] = {
    {"iris_color_convert", convert},
    {"iris_color_gray", gray},
    {"iris_color_row", row},
    {"iris_color_gray_row", gray_row},
    {"iris_color_rgb_row", rgb_row},
    {"iris_hsl_range_prepare", range_prepare},
    {"iris_hsl_range_row", range_row},
    {"iris_hsl_range_mask", range_mask},
    {"iris_bayer_convert", bayer_convert},
    {"iris_bayer_row", bayer_row},
    {"iris_nv12_convert", nv12_convert},
    {"iris_nv12_row", nv12_row},
    {"iris_nv12_crop", nv12_crop},
    {NULL, NULL},
};
