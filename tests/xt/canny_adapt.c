/* Thresholds from the picture: the median, by sorting. */
#include "iris/xt/canny_adapt.h"

#include "edge_picture.h"

static uint8_t smooth_bytes[SIDE_MAX * SIDE_MAX];
static int32_t sizes[SIDE_MAX * SIDE_MAX];
static uint32_t seed = 5;

static int by_size(const void *a, const void *b)
{
    return *(const int32_t *)a - *(const int32_t *)b;
}

static int32_t expected_high(const iris_image *src, iris_q16 sigma_q16)
{
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    const iris_image smooth = {smooth_bytes, src->w, src->w, src->h, IRIS_GRAY8};
    for (int32_t y = 0; y < src->h; y++) {
        memcpy(iris_image_row(&smooth, y), iris_image_row(src, y), (size_t)src->w);
    }
    if (sigma_q16 > 0) {
        iris_scratch scratch = arena(IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(src->w, 1, sigma_q16));
        assert_int_equal(iris_blur_gaussian(&smooth, &smooth, sigma_q16, border, &scratch), IRIS_OK);
    }
    for (int32_t i = 0; i < src->w * src->h; i++) {
        static const int weight[3] = {1, 2, 1};
        int dx = 0, dy = 0;
        for (int k = 0; k < 9; k++) {
            int level = pixel_beyond(&smooth, i % src->w + k % 3 - 1, i / src->w + k / 3 - 1, border);
            dx += level * weight[k / 3] * (k % 3 - 1);
            dy += level * weight[k % 3] * (k / 3 - 1);
        }
        sizes[i] = abs(dx) + abs(dy);
    }
    qsort(sizes, (size_t)src->w * (size_t)src->h, sizeof sizes[0], by_size);
    int32_t high = 6 * sizes[src->w * src->h / 2];
    return high < 24 ? 24 : high > 100 ? 100 : high;
}

static void median(void **state)
{
    (void)state;
    int32_t least = 100, most = 24, between = 0;
    for (int i = 0; i < 300; i++) {
        static uint8_t bytes[SIDE_MAX * SIDE_MAX];
        int32_t w = 1 + (int32_t)(next_random(&seed) % 60), h = 1 + (int32_t)(next_random(&seed) % 60);
        uint32_t noise = 1 + next_random(&seed) % (i % 3 ? 30 : 255);
        for (int32_t k = 0; k < w * h; k++) {
            bytes[k] = (uint8_t)(next_random(&seed) % noise + (k % w > w / 2 ? 255 - noise : 0));
        }
        const iris_image src = {bytes + (i % 2 ? 0 : (h - 1) * w), i % 2 ? w : -w, w, h, IRIS_GRAY8};
        iris_canny_config config = {i % 4 ? 91750 : 0, 1, 2};
        iris_scratch scratch = arena(IRIS_CANNY_ADAPT_SCRATCH_BYTES(w, config.sigma_q16));
        assert_int_equal(iris_canny_adapt(&config, &src, &scratch), IRIS_OK);
        assert_int_equal(scratch.used, 0);
        assert_int_equal(scratch.peak, scratch.bytes);
        int32_t high = config.high;
        assert_int_equal(high, expected_high(&src, config.sigma_q16));
        assert_int_equal(config.low, high * 2 / 5);
        least = high < least ? high : least;
        most = high > most ? high : most;
        between += high > 24 && high < 100;
    }
    assert_true(least == 24 && most == 100 && between > 30);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static uint8_t bytes[64];
    iris_image src = {bytes, 8, 8, 8, IRIS_GRAY8}, mask = {bytes, 4, 8, 8, IRIS_MASK1},
               none = {NULL, 8, 8, 8, IRIS_GRAY8};
    iris_canny_config config = {91750, 1, 2}, bad = {-1, 1, 2}, low = {IRIS_BLUR_SIGMA_MIN - 1, 1, 2},
                      high = {IRIS_BLUR_SIGMA_MAX + 1, 1, 2};
    iris_scratch scratch = arena(sizeof working.memory);
    assert_int_equal(iris_canny_adapt(NULL, &src, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_canny_adapt(&config, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_canny_adapt(&config, &src, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_canny_adapt(&bad, &src, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_canny_adapt(&low, &src, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_canny_adapt(&high, &src, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_canny_adapt(&config, &none, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_canny_adapt(&config, &mask, &scratch), IRIS_ERR_FORMAT);
    scratch = arena(IRIS_CANNY_ADAPT_SCRATCH_BYTES(8, 91750) - 1);
    assert_int_equal(iris_canny_adapt(&config, &src, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    assert_true(config.low == 1 && config.high == 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(median),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
