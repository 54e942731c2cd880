#include "digest.h"

#include "iris/xt/median.h"

static void median(iris_format format, int32_t channels, int32_t side)
{
    iris_image src = digest_picture(format, 21, 16);
    iris_image dst = digest_canvas(format, 21, 16);
    for (int i = 0; i < 4; i++) {
        iris_border border = {(iris_border_rule)i, 90};
        iris_scratch scratch = digest_scratch(IRIS_MEDIAN_SCRATCH_BYTES(21, channels, side));
        digest_number(iris_median(&dst, &src, side, border, &scratch));
        digest_view(&dst);
    }
}

static void of_3(void)
{
    median(IRIS_RGB888, 3, 3);
}

static void of_5(void)
{
    median(IRIS_GRAY8, 1, 5);
}

const digest_operation digest_median[] = {
    {"median.3", of_3},
    {"median.5", of_5},
    {NULL, NULL},
};
