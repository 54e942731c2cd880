/* What a histogram says, exactly. */
#include "iris/xt/histogram.h"

typedef struct {
    uint64_t count, sum;
    uint8_t min, max;
} extent;

static extent extent_of(const uint32_t histogram[256])
{
    extent all = {0, 0, 0, 0};
    for (int32_t p = 0; p < 256; p++) {
        if (histogram[p] == 0) {
            continue;
        }
        all.min = all.count == 0 ? (uint8_t)p : all.min;
        all.max = (uint8_t)p;
        all.count += histogram[p];
        all.sum += (uint64_t)histogram[p] * (uint32_t)p;
    }
    return all;
}

/* numerator / denominator with 16 fraction bits, rounded half up: 0 <= numerator < denominator <= 2^60. */
static int32_t fraction_q16(uint64_t numerator, uint64_t denominator)
{
    int32_t fraction = 0;
    for (int bit = 0; bit < 17; bit++) {
        numerator += numerator;
        fraction = 2 * fraction + (numerator >= denominator);
        numerator -= numerator >= denominator ? denominator : 0;
    }
    return (fraction + 1) / 2;
}

/* With the mean between q and q + 1, (sum of (p - q)^2) / n - (mean - q)^2: the first is a + b / n, the second r^2 / n^2. Of n
 * up to 2^30, each product here is at most 2^60. */
static iris_q16 variance_of(const uint32_t histogram[256], extent all)
{
    int64_t n = (int64_t)all.count;
    int64_t q = (int64_t)all.sum / n, r = (int64_t)all.sum % n, squares = 0;
    for (int64_t p = 0; p < 256; p++) {
        squares += (int64_t)histogram[p] * (p - q) * (p - q);
    }
    int64_t a = squares / n, b = squares % n;
    int64_t rest = b * n - r * r;
    if (rest < 0) {
        a--;
        rest += n * n;
    }
    return (iris_q16)(a * IRIS_Q16_ONE) + fraction_q16((uint64_t)rest, (uint64_t)(n * n));
}

iris_status iris_histogram_measure(iris_histogram_statistics *statistics, const uint32_t histogram[256])
{
    if (!statistics || !histogram) {
        return IRIS_ERR_ARG;
    }
    extent all = extent_of(histogram);
    if (all.count == 0 || all.count > (uint64_t)1 << 30) {
        return IRIS_ERR_RANGE;
    }
    statistics->count = (uint32_t)all.count;
    statistics->min = all.min;
    statistics->max = all.max;
    statistics->mean_q16 = (iris_q16)((all.sum * 131072 + all.count) / (2 * all.count));
    statistics->variance_q16 = variance_of(histogram, all);
    return iris_histogram_percentile(&statistics->median, histogram, IRIS_Q16_ONE / 2);
}

iris_status iris_histogram_percentile(uint8_t *level, const uint32_t histogram[256], iris_q16 share_q16)
{
    if (!level || !histogram) {
        return IRIS_ERR_ARG;
    }
    extent all = extent_of(histogram);
    if (share_q16 < 0 || share_q16 > IRIS_Q16_ONE || all.count == 0) {
        return IRIS_ERR_RANGE;
    }
    int32_t p = all.min;
    uint64_t up_to = histogram[p];
    while (up_to * IRIS_Q16_ONE < all.count * (uint32_t)share_q16) {
        p++;
        up_to += histogram[p];
    }
    *level = (uint8_t)p;
    return IRIS_OK;
}
