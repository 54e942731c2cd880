#include "digest.h"

#include "iris/bayer.h"
#include "iris/color.h"
#include "iris/nv12.h"

static void between(iris_format to, iris_format from)
{
    iris_image src = digest_picture(from, 38, 24);
    iris_image dst = digest_canvas(to, 38, 24);
    digest_number(iris_color_convert(&dst, &src));
    digest_view(&dst);
}

static void from_rgb565(void)
{
    between(IRIS_RGB888, IRIS_RGB565);
}

static void from_rgb565_swap(void)
{
    between(IRIS_GRAY8, IRIS_RGB565_SWAP);
}

static void from_yuyv(void)
{
    between(IRIS_RGB888, IRIS_YUYV);
}

static void from_uyvy(void)
{
    between(IRIS_BGR888, IRIS_UYVY);
}

static void from_rgba(void)
{
    between(IRIS_RGB888, IRIS_RGBA8888);
}

static void rgba_gray(void)
{
    between(IRIS_GRAY8, IRIS_RGBA8888);
}

static void from_mask(void)
{
    between(IRIS_GRAY8, IRIS_MASK1);
}

static void swapped(void)
{
    between(IRIS_BGR888, IRIS_RGB888);
}

static void luma_bgr(void)
{
    between(IRIS_GRAY8, IRIS_BGR888);
}

static void hsl_there_and_back(iris_format hsl)
{
    iris_image src = digest_picture(IRIS_RGB888, 31, 20);
    iris_image dst = digest_canvas(hsl, 31, 20);
    digest_number(iris_color_convert(&dst, &src));
    digest_view(&dst);
    digest_number(iris_color_convert(&src, &dst));
    digest_view(&src);
}

static void hsl24(void)
{
    hsl_there_and_back(IRIS_HSL24);
}

static void hsl48(void)
{
    hsl_there_and_back(IRIS_HSL48);
}

static void gray_methods(void)
{
    static const iris_format formats[] = {IRIS_RGB888, IRIS_BGR888, IRIS_RGB565, IRIS_YUYV};
    iris_image dst = digest_canvas(IRIS_GRAY8, 20, 12);
    for (int f = 0; f < 4; f++) {
        iris_image src = digest_picture(formats[f], 20, 12);
        for (int method = IRIS_GRAY_LUMA; method <= IRIS_GRAY_GREEN; method++) {
            digest_number(iris_color_gray(&dst, &src, (iris_gray_method)method));
            digest_view(&dst);
        }
    }
}

static void hsl_range(void)
{
    static const iris_hsl_range ranges[] = {
        {350, 10, 5, 100, 0, 100}, {40, 200, 0, 60, 20, 90}, {0, 360, 0, 100, 50, 100}};
    iris_image src = digest_picture(IRIS_RGB888, 45, 20);
    iris_image mask = digest_canvas(IRIS_MASK1, 45, 20);
    for (int i = 0; i < 3; i++) {
        digest_number(iris_hsl_range_mask(&mask, &src, &ranges[i]));
        digest_view(&mask);
    }
}

static void nv12(void)
{
    static const iris_format targets[] = {IRIS_RGB888, IRIS_BGR888, IRIS_GRAY8};
    iris_image luma = digest_picture(IRIS_GRAY8, 31, 19);
    iris_image chroma = digest_picture(IRIS_UV88, 16, 10);
    for (int i = 0; i < 3; i++) {
        iris_image dst = digest_canvas(targets[i], 31, 19);
        digest_number(iris_nv12_convert(&dst, &luma, &chroma));
        digest_view(&dst);
    }
}

static void bayer(void)
{
    static const iris_format targets[] = {IRIS_RGB888, IRIS_BGR888, IRIS_GRAY8, IRIS_RGB888};
    for (int i = 0; i < 4; i++) {
        iris_image src = digest_picture((iris_format)(IRIS_BAYER8_RGGB + i), 33, 15);
        iris_image dst = digest_canvas(targets[i], 33, 15);
        digest_number(iris_bayer_convert(&dst, &src));
        digest_view(&dst);
    }
}

const digest_operation digest_color[] = {
    {"color.from_rgb565", from_rgb565},
    {"color.from_rgb565_swap", from_rgb565_swap},
    {"color.from_yuyv", from_yuyv},
    {"color.from_uyvy", from_uyvy},
    {"color.from_rgba", from_rgba},
    {"color.rgba_gray", rgba_gray},
    {"color.from_mask", from_mask},
    {"color.swapped", swapped},
    {"color.luma_bgr", luma_bgr},
    {"color.hsl24", hsl24},
    {"color.hsl48", hsl48},
    {"color.gray_methods", gray_methods},
    {"color.hsl_range", hsl_range},
    {"nv12.convert", nv12},
    {"bayer.convert", bayer},
    {NULL, NULL},
};
