#include "iris/xt/canny_adapt.h"

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"
#include "../filter/smooth_rows.h"
#include "edge_rows.h"

#define FACTOR 6
#define LEVELS                                                                                               \
    (IRIS_CANNY_ADAPT_HIGH_MAX / FACTOR + 2) /* of gradients; those above are as good as the last */

/* Pixels of each gradient. */
static void count_row(int32_t count[LEVELS], const iris_row_gradient *to, const iris_smooth_rows *smooth,
                      int32_t y)
{
    const int32_t w = smooth->src->w;
    const uint8_t *const rows[3] = {iris_smooth_row(smooth, y - 1), iris_smooth_row(smooth, y),
                                    iris_smooth_row(smooth, y + 1)};
    iris_row_gradient_u8(to, rows, IRIS_EDGE_MORE_SOBEL, w);
    for (int32_t x = 0; x < w; x++) {
        int32_t level = to->size[x];
        count[level < LEVELS ? level : LEVELS - 1]++;
    }
}

static int32_t median_of(const int32_t count[LEVELS], int32_t pixels)
{
    int32_t level = 0, sum = count[0];
    while (level < LEVELS - 1 && sum <= pixels / 2) {
        sum += count[++level];
    }
    return level;
}

iris_status iris_canny_adapt(iris_canny_config *config, const iris_image *src, iris_scratch *scratch)
{
    if (!config || !src || !scratch) {
        return IRIS_ERR_ARG;
    }
    const iris_q16 sigma_q16 = config->sigma_q16;
    if (sigma_q16 != 0 && (sigma_q16 < IRIS_BLUR_SIGMA_MIN || sigma_q16 > IRIS_BLUR_SIGMA_MAX)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(src, IRIS_GRAY8);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t count[LEVELS] = {0};
    iris_smooth_rows smooth;
    const size_t start = iris_scratch_mark(scratch), row = IRIS_SCRATCH_ROUND(2u * (size_t)src->w);
    int16_t *gradients = (int16_t *)iris_scratch_take(scratch, 3u * row);
    status = gradients ? iris_smooth_rows_begin(&smooth, src, sigma_q16,
                                                (iris_border){IRIS_BORDER_REPLICATE, 0}, scratch)
                       : IRIS_ERR_SCRATCH;
    for (int32_t y = 0; status == IRIS_OK && y <= src->h; y++) {
        if (y < src->h) {
            iris_smooth_rows_next(&smooth, y);
        }
        if (y > 0) {
            count_row(count, &(iris_row_gradient){gradients, gradients + row / 2, gradients + row}, &smooth,
                      y - 1);
        }
    }
    iris_scratch_release(scratch, start);
    if (status == IRIS_OK) {
        int32_t high = FACTOR * median_of(count, src->w * src->h);
        high = high > IRIS_CANNY_ADAPT_HIGH_MAX ? IRIS_CANNY_ADAPT_HIGH_MAX : high;
        config->high = high < IRIS_CANNY_ADAPT_HIGH_MIN ? IRIS_CANNY_ADAPT_HIGH_MIN : high;
        config->low = config->high * 2 / 5;
    }
    return status;
}
