#include "bench.h"

#include "iris/color.h"
#include "iris/xt/signature.h"

static iris_signatures table;
static iris_image yuyv, rgb565;

static void prepare(void)
{
    for (int32_t k = 0; k < IRIS_SIGNATURES; k++) {
        const iris_hsl_range range = {45 * k, 45 * k + 40, 20, 100, 10, 90};
        (void)iris_signature_from_range(&table, k, &range);
    }
    /* What the bytes mean does not matter here. */
    yuyv = bench_frame.rgb;
    yuyv.format = IRIS_YUYV;
    rgb565 = bench_frame.rgb;
    rgb565.format = IRIS_RGB565;
}

static iris_status of_rgb(void)
{
    return iris_signature_classify(&bench_frame.gray_to, &bench_frame.rgb, &table);
}

static iris_status of_yuyv(void)
{
    return iris_signature_classify(&bench_frame.gray_to, &yuyv, &table);
}

static iris_status of_rgb565(void)
{
    return iris_signature_classify(&bench_frame.gray_to, &rgb565, &table);
}

static iris_status mask_of_rgb(void)
{
    return iris_signature_mask(&bench_frame.mask_to, &bench_frame.rgb, &table, 1);
}

static iris_status from_range(void)
{
    return iris_signature_from_range(&table, 0, &(iris_hsl_range){340, 20, 20, 100, 10, 90});
}

static iris_status teach(void)
{
    const iris_rect rect = {bench_frame.rgb.w / 2, bench_frame.rgb.h / 2, 16, 16};
    return iris_signature_teach(NULL, &table, 0, &bench_frame.rgb, rect, &bench_frame.scratch);
}

const bench_case bench_signature[] = {
    {"8 signatures, RGB888", of_rgb, prepare},
    {"8 signatures, YUYV", of_yuyv, prepare},
    {"8 signatures, RGB565", of_rgb565, prepare},
    {"mask of a signature, RGB888", mask_of_rgb, prepare},
    {"signature of a range", from_range, NULL},
    {"signature of a rectangle, 16x16", teach, NULL},
    {0},
};
