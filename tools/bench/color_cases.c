#include <string.h>

#include "bench.h"
#include "iris/bayer.h"
#include "iris/color.h"
#include "iris/nv12.h"

static iris_image yuyv, bgr, hsl, bayer, chroma;

static void prepare_yuyv(void)
{
    yuyv = bench_canvas(IRIS_YUYV);
    memcpy(yuyv.data, bench_frame.rgb.data, iris_format_row_bytes(IRIS_YUYV, yuyv.w) * (size_t)yuyv.h);
}

static void prepare_bgr(void)
{
    bgr = bench_frame.rgb;
    bgr.format = IRIS_BGR888;
}

static void prepare_hsl(void)
{
    hsl = bench_canvas(IRIS_HSL24);
    (void)iris_color_convert(&hsl, &bench_frame.rgb);
}

static void prepare_bayer(void)
{
    bayer = bench_frame.gray;
    bayer.format = IRIS_BAYER8_RGGB;
}

static void prepare_chroma(void)
{
    chroma = bench_canvas_of(IRIS_UV88, bench_frame.gray.w / 2, bench_frame.gray.h / 2);
    (void)memcpy(chroma.data, bench_frame.rgb.data,
                 iris_format_row_bytes(IRIS_UV88, chroma.w) * (size_t)chroma.h);
}

static iris_status luma_of_rgb(void)
{
    return iris_color_gray(&bench_frame.gray_to, &bench_frame.rgb, IRIS_GRAY_LUMA);
}

static iris_status luma_of_bgr(void)
{
    return iris_color_gray(&bench_frame.gray_to, &bgr, IRIS_GRAY_LUMA);
}

static iris_status rgb_of_bgr(void)
{
    return iris_color_convert(&bench_frame.rgb_to, &bgr);
}

static iris_status rgb_of_bgr_in_place(void)
{
    return iris_color_convert(&bench_frame.rgb, &bgr);
}

static iris_status gray_of_yuyv(void)
{
    return iris_color_gray(&bench_frame.gray_to, &yuyv, IRIS_GRAY_LUMA);
}

static iris_status rgb_of_yuyv(void)
{
    return iris_color_convert(&bench_frame.rgb_to, &yuyv);
}

static iris_status hsl_of_rgb(void)
{
    return iris_color_convert(&hsl, &bench_frame.rgb);
}

static iris_status rgb_of_hsl(void)
{
    return iris_color_convert(&bench_frame.rgb_to, &hsl);
}

static iris_status rgb_of_nv12(void)
{
    return iris_nv12_convert(&bench_frame.rgb_to, &bench_frame.gray, &chroma);
}

static iris_status rgb_of_bayer(void)
{
    return iris_bayer_convert(&bench_frame.rgb_to, &bayer);
}

static iris_status gray_of_bayer(void)
{
    return iris_bayer_convert(&bench_frame.gray_to, &bayer);
}

static iris_status hsl_range(void)
{
    const iris_hsl_range range = {30, 80, 30, 100, 20, 90};
    return iris_hsl_range_mask(&bench_frame.mask_to, &bench_frame.rgb, &range);
}

const bench_case bench_color[] = {
    {"RGB to gray by luma", luma_of_rgb, NULL},
    {"BGR to gray by luma", luma_of_bgr, prepare_bgr},
    {"BGR to RGB", rgb_of_bgr, prepare_bgr},
    {"BGR to RGB in place", rgb_of_bgr_in_place, prepare_bgr},
    {"YUYV to gray", gray_of_yuyv, prepare_yuyv},
    {"YUYV to RGB", rgb_of_yuyv, prepare_yuyv},
    {"NV12 to RGB", rgb_of_nv12, prepare_chroma},
    {"Bayer to RGB", rgb_of_bayer, prepare_bayer},
    {"Bayer to gray", gray_of_bayer, prepare_bayer},
    {"RGB to HSL24", hsl_of_rgb, prepare_hsl},
    {"HSL24 to RGB", rgb_of_hsl, prepare_hsl},
    {"RGB to mask by HSL range", hsl_range, NULL},
    {0},
};
