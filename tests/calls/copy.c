/* Copies, fills, channels, and other sizes. */
#include "iris/copy.h"

#include "calls.h"

static iris_size even(iris_size size)
{
    size.w += size.w % 2;
    return size;
}

static void copy(void)
{
    iris_size size = even(draw_size());
    iris_format format = draw_format();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    CALL(iris_copy(dst, src));
}

static void paste(void)
{
    iris_format format = draw_format();
    const iris_image *dst = draw_output(format, even(draw_size()));
    const iris_image *src = draw_input(format, even(draw_size()));
    int32_t x = draw_int(-70, 70), y = draw_int(-70, 70);
    draw_overlap_is_fine();
    CALL(iris_paste(dst, src, x, y));
}

static void mask_copy(void)
{
    const iris_image *dst = draw_output(IRIS_MASK1, draw_size());
    const iris_image *src = draw_input(IRIS_MASK1, draw_size());
    int32_t x = draw_int(0, 40), y = draw_int(0, 40);
    draw_overlap_is_fine();
    CALL(iris_mask_copy(dst, src, x, y));
}

static void fill(void)
{
    static const uint64_t values[] = {0, 1, 0xff, 0xffff, 0xffffff, 0xffffffff, 0xffffffffffff, UINT64_MAX};
    const iris_image *dst = draw_output(draw_format(), even(draw_size()));
    uint64_t value = values[draw_below(8)];
    CALL(iris_fill(dst, value));
}

static iris_format channel_format(void)
{
    return draw_either(draw_either(IRIS_RGB888, IRIS_BGR888), draw_either(IRIS_RGBA8888, IRIS_HSL24));
}

static void channel_extract(void)
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(IRIS_GRAY8, size);
    const iris_image *src = draw_input(channel_format(), size);
    int32_t channel = draw_int(0, 3);
    CALL(iris_channel_extract(dst, src, channel));
}

static void channel_insert(void)
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(channel_format(), size);
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    int32_t channel = draw_int(0, 3);
    CALL(iris_channel_insert(dst, src, channel));
}

static void resize_nearest(void)
{
    iris_format format = draw_gray_or_color();
    const iris_image *dst = draw_output(format, draw_size());
    const iris_image *src = draw_input(format, draw_size());
    CALL(iris_resize_nearest(dst, src));
}

static void resize_bilinear(void)
{
    iris_format format = draw_gray_or_color();
    const iris_image *dst = draw_output(format, draw_size());
    const iris_image *src = draw_input(format, draw_size());
    CALL(iris_resize_bilinear(dst, src));
}

static void resize_area(void)
{
    iris_format format = draw_gray_or_color();
    const iris_image *dst = draw_output(format, draw_size());
    const iris_image *src = draw_input(format, draw_size());
    CALL(iris_resize_area(dst, src));
}

const random_call calls_copy[] = {
    {"iris_copy", copy},
    {"iris_paste", paste},
    {"iris_mask_copy", mask_copy},
    {"iris_fill", fill},
    {"iris_channel_extract", channel_extract},
    {"iris_channel_insert", channel_insert},
    {"iris_resize_nearest", resize_nearest},
    {"iris_resize_bilinear", resize_bilinear},
    {"iris_resize_area", resize_area},
    {NULL, NULL},
};
