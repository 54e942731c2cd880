/* Histograms: counted by hand and pixel by pixel; statistics in wider numbers than the library has. */
#include <math.h>

#include "../picture.h"
#include "../test.h"
#include "iris/color.h"
#include "iris/xt/histogram.h"

#define W 75
#define H 21

static uint8_t pixels[H * (3 * W + 5)];
static uint32_t words[(W / 32 + 2) * H];

static iris_image view(iris_format format, ptrdiff_t stride)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, pixels, sizeof pixels, (iris_size){W, H}, stride, format),
                     IRIS_OK);
    return image;
}

static iris_image mask_view(void)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, words, sizeof words, (iris_size){W, H}, -16, IRIS_MASK1),
                     IRIS_OK);
    return image;
}

static void noise(uint32_t seed)
{
    for (size_t i = 0; i < sizeof pixels; i++) {
        pixels[i] = (uint8_t)(next_random(&seed) >> (i % 3 == 1 ? 2 : 0));
    }
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        words[i] = next_random(&seed) << 16 ^ next_random(&seed);
        words[i] = i % 5 == 0 ? 0 : i % 5 == 1 ? ~0u : words[i];
    }
}

static int bit(const iris_image *mask, int32_t x, int32_t y)
{
    return ((const uint32_t *)iris_image_row(mask, y))[x / 32] >> x % 32 & 1;
}

/* What is to be counted of pixel (x, y), by another way than the library's. */
static int level_at(const iris_image *image, int32_t channel, int32_t x, int32_t y)
{
    const uint8_t *row = iris_image_row(image, y);
    if (image->format == IRIS_MASK1) {
        return bit(image, x, y);
    }
    if (image->format == IRIS_GRAY8) {
        return row[x];
    }
    if (channel == IRIS_CHANNEL_LIGHTNESS) {
        uint8_t hsl[3];
        assert_int_equal(iris_color_row(hsl, IRIS_HSL24, row + 3 * x, image->format, 1), IRIS_OK);
        return hsl[2];
    }
    return row[3 * x + channel];
}

static void assert_counted(const iris_image *image, int32_t channel, const iris_image *mask)
{
    uint32_t truth[256] = {0}, found[256], by_rows[256] = {0};
    memset(found, 0xEE, sizeof found);
    for (int32_t i = 0; i < image->w * image->h; i++) {
        int32_t x = i % image->w, y = i / image->w;
        truth[level_at(image, channel, x, y)] += !mask || bit(mask, x, y);
    }
    assert_int_equal(iris_histogram(found, image, channel, mask), IRIS_OK);
    assert_memory_equal(found, truth, sizeof truth);
    for (int32_t y = 0; y < image->h; y++) {
        const uint32_t *selected = mask ? iris_image_row(mask, y) : NULL;
        assert_int_equal(
            iris_histogram_row(by_rows, iris_image_row(image, y), image->format, channel, image->w, selected),
            IRIS_OK);
    }
    assert_memory_equal(by_rows, truth, sizeof truth);
}

static void every_width_format_and_channel(void **state)
{
    (void)state;
    const struct {
        iris_format format;
        int32_t first, last;
    } kinds[] = {{IRIS_GRAY8, 0, 0}, {IRIS_RGB888, -1, 2}, {IRIS_BGR888, -1, 2}, {IRIS_HSL24, 0, 2}};
    for (int32_t w = 1; w <= W; w++) {
        noise((uint32_t)w);
        iris_image mask = mask_view(), masked;
        mask.w = w;
        mask.h = H - w % 4;
        for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
            iris_image image = view(kinds[k].format, (w % 2 ? -1 : 1) * (3 * W + 5)), part;
            assert_int_equal(iris_image_crop(&part, &image, (iris_rect){W - w, w % 4, w, H - w % 4}),
                             IRIS_OK);
            for (int32_t channel = kinds[k].first; channel <= kinds[k].last; channel++) {
                assert_counted(&part, channel, NULL);
                assert_counted(&part, channel, &mask);
            }
        }
        assert_counted(&mask, 0, NULL);
        masked = mask;
        masked.data = (uint8_t *)mask.data + 4;
        masked.w = w < 60 ? w : 60;
        mask.w = masked.w;
        assert_counted(&mask, 0, &masked);
    }
}

/* A flat picture is the worst for tables, and the largest that counts: nothing may run over. */
static void large_and_flat(void **state)
{
    (void)state;
    static uint8_t row[IRIS_SIDE_MAX];
    uint32_t histogram[256] = {0};
    memset(row, 200, sizeof row);
    row[100] = 7;
    for (int y = 0; y < 3000; y++) {
        assert_int_equal(iris_histogram_row(histogram, row, IRIS_GRAY8, 0, IRIS_SIDE_MAX, NULL), IRIS_OK);
    }
    assert_int_equal(histogram[200], 3000 * (IRIS_SIDE_MAX - 1));
    assert_int_equal(histogram[7], 3000);
    static uint8_t all[6 * IRIS_SIDE_MAX];
    memset(all, 99, sizeof all);
    iris_image flat = {all, IRIS_SIDE_MAX, IRIS_SIDE_MAX, 6, IRIS_GRAY8};
    assert_counted(&flat, 0, NULL);
}

static void statistics_by_hand(void **state)
{
    (void)state;
    uint32_t histogram[256] = {0};
    iris_histogram_statistics is;
    histogram[10] = 1;
    histogram[20] = 2;
    histogram[250] = 1; /* mean 75, squares 65^2 + 2 55^2 + 175^2 = 40900 */
    assert_int_equal(iris_histogram_measure(&is, histogram), IRIS_OK);
    assert_int_equal(is.count, 4);
    assert_int_equal(is.min, 10);
    assert_int_equal(is.max, 250);
    assert_int_equal(is.median, 20);
    assert_int_equal(is.mean_q16, 75 * 65536);
    assert_int_equal(is.variance_q16, 10225 * 65536);
    histogram[20] = 0;
    histogram[11] = 1; /* 10 11 250: mean 271/3, variance (2 240^2 + 239^2... ) by differences of pairs / 9 */
    assert_int_equal(iris_histogram_measure(&is, histogram), IRIS_OK);
    assert_int_equal(is.mean_q16, (271 * 65536 + 1) / 3);
    assert_int_equal(is.variance_q16, (int)floor((1.0 + 240 * 240 + 239 * 239) / 9 * 65536 + 0.5));
    assert_int_equal(is.median, 11);

    memset(histogram, 0, sizeof histogram);
    histogram[0] = histogram[255] = (uint32_t)1 << 29; /* the largest variance of the most pixels */
    assert_int_equal(iris_histogram_measure(&is, histogram), IRIS_OK);
    assert_int_equal(is.variance_q16, (int)(127.5 * 127.5 * 65536));
    assert_int_equal(is.mean_q16, (int)(127.5 * 65536));
    assert_int_equal(is.median, 0);
    histogram[3] = 1;
    iris_histogram_statistics before = is;
    assert_int_equal(iris_histogram_measure(&is, histogram), IRIS_ERR_RANGE);
    assert_memory_equal(&is, &before, sizeof is);
    memset(histogram, 0, sizeof histogram);
    histogram[255] = (uint32_t)1 << 30;
    assert_int_equal(iris_histogram_measure(&is, histogram), IRIS_OK);
    assert_int_equal(is.mean_q16, 255 * 65536);
    assert_int_equal(is.variance_q16, 0);
    assert_int_equal(is.median, 255);
}

static void statistics_in_wide_numbers(void **state)
{
    (void)state;
    uint32_t seed = 3;
    for (int round = 0; round < 3000; round++) {
        uint32_t histogram[256] = {0}, n = 0;
        long double sum = 0, squares = 0;
        for (int k = 0; k <= round % 40; k++) {
            uint32_t level = next_random(&seed) % 256, count = next_random(&seed) >> (round % 24);
            histogram[level] += count + 1;
        }
        for (int p = 0; p < 256; p++) {
            n += histogram[p];
            sum += (long double)histogram[p] * p;
        }
        for (int p = 0; p < 256; p++) {
            long double off = (long double)p * n - sum; /* exact: below 2^64 */
            squares += off * off * histogram[p];
        }
        iris_histogram_statistics is;
        assert_int_equal(iris_histogram_measure(&is, histogram), IRIS_OK);
        assert_int_equal(is.count, n);
        assert_int_equal(is.mean_q16, (int)floorl(sum / n * 65536 + 0.5L));
        long double variance = squares / n / n / n * 65536;
        assert_true(fabsl(variance - is.variance_q16) < 0.5L + 1e-6L);
        for (int k = 0; k < 20; k++) {
            int32_t share = k == 0 ? 0 : k == 1 ? 65536 : (int32_t)(next_random(&seed) % 65537);
            uint8_t level;
            assert_int_equal(iris_histogram_percentile(&level, histogram, share), IRIS_OK);
            uint64_t below = 0;
            for (int p = 0; p < level; p++) {
                below += histogram[p];
            }
            uint64_t least = (uint64_t)n * (uint64_t)share;
            assert_true((below + histogram[level]) * 65536 >= least && histogram[level] > 0);
            assert_true(below == 0 || below * 65536 < least);
        }
    }
}

static void a_picture_is_counted(void **state)
{
    (void)state;
    picture camera = load_pnm(data_path("edges/classic/camera_256.pgm"));
    if (!camera.pixels) {
        skip();
    }
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, camera.pixels, (size_t)camera.w * (size_t)camera.h,
                                     (iris_size){camera.w, camera.h}, 0, IRIS_GRAY8),
                     IRIS_OK);
    assert_counted(&image, 0, NULL);
    free(camera.pixels);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    uint32_t histogram[256], before[256];
    iris_histogram_statistics is;
    uint8_t level = 9;
    memset(histogram, 0, sizeof histogram);
    assert_int_equal(iris_histogram_measure(NULL, histogram), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_measure(&is, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_measure(&is, histogram), IRIS_ERR_RANGE);
    assert_int_equal(iris_histogram_percentile(NULL, histogram, 5), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_percentile(&level, NULL, 5), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_percentile(&level, histogram, 5), IRIS_ERR_RANGE);
    histogram[5] = 2;
    assert_int_equal(iris_histogram_percentile(&level, histogram, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_histogram_percentile(&level, histogram, 65537), IRIS_ERR_RANGE);
    assert_int_equal(level, 9);

    memset(histogram, 0xAB, sizeof histogram);
    memcpy(before, histogram, sizeof before);
    iris_image gray = view(IRIS_GRAY8, 0), rgb = view(IRIS_RGB888, 0), hsl = view(IRIS_HSL24, 0),
               mask = mask_view(), bad = gray;
    assert_int_equal(iris_histogram(NULL, &gray, 0, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram(histogram, NULL, 0, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram(histogram, &gray, 1, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram(histogram, &gray, IRIS_CHANNEL_LIGHTNESS, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram(histogram, &hsl, IRIS_CHANNEL_LIGHTNESS, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram(histogram, &rgb, 3, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram(histogram, &rgb, -2, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram(histogram, &mask, 1, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram(histogram, &gray, 0, &gray), IRIS_ERR_FORMAT);
    bad.format = IRIS_BAYER8_RGGB;
    assert_int_equal(iris_histogram(histogram, &bad, 0, NULL), IRIS_ERR_FORMAT);
    bad.format = (iris_format)0;
    assert_int_equal(iris_histogram(histogram, &bad, 0, NULL), IRIS_ERR_ARG);
    bad = mask;
    bad.w = W - 1;
    assert_int_equal(iris_histogram(histogram, &gray, 0, &bad), IRIS_ERR_RANGE);
    bad.data = (uint8_t *)words + 2;
    assert_int_equal(iris_histogram(histogram, &gray, 0, &bad), IRIS_ERR_ALIGN);
    assert_int_equal(iris_histogram_row(NULL, pixels, IRIS_GRAY8, 0, 1, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_row(histogram, NULL, IRIS_GRAY8, 0, 1, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_row(histogram, pixels, IRIS_GRAY8, 1, 1, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_row(histogram, pixels, IRIS_YUYV, 0, 1, NULL), IRIS_ERR_FORMAT);
    assert_int_equal(iris_histogram_row(histogram, pixels, IRIS_GRAY8, 0, 0, NULL), IRIS_ERR_RANGE);
    assert_int_equal(iris_histogram_row(histogram, pixels, IRIS_GRAY8, 0, IRIS_SIDE_MAX + 1, NULL),
                     IRIS_ERR_RANGE);
    const uint8_t *odd = (const uint8_t *)words + 1;
    assert_int_equal(iris_histogram_row(histogram, odd, IRIS_MASK1, 0, 1, NULL), IRIS_ERR_ALIGN);
    assert_int_equal(
        iris_histogram_row(histogram, pixels, IRIS_GRAY8, 0, 1, (const uint32_t *)(uintptr_t)odd),
        IRIS_ERR_ALIGN);
    assert_memory_equal(histogram, before, sizeof before);
    assert_int_equal(iris_histogram_extremes(NULL, &level, &gray), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_extremes(&level, NULL, &gray), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_extremes(&level, &level, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_histogram_extremes(&level, &level, &rgb), IRIS_ERR_FORMAT);
    assert_int_equal(level, 9);
}

/* Rows with and without space between them, and last row first; the space holds what is farther. */
static void extremes_of_views(void **state)
{
    (void)state;
    static const ptrdiff_t strides[] = {W, W + 3, -W, -(W + 3)};
    for (size_t i = 0; i < sizeof strides / sizeof strides[0]; i++) {
        iris_image image = view(IRIS_GRAY8, strides[i]);
        uint8_t darkest = 0, brightest = 0;
        for (size_t k = 0; k < sizeof pixels; k++) {
            pixels[k] = k % 2 ? 255 : 0;
        }
        for (int32_t y = 0; y < H; y++) {
            memset(iris_image_row(&image, y), 90, W);
        }
        ((uint8_t *)iris_image_row(&image, H - 1))[W - 1] = 40;
        ((uint8_t *)iris_image_row(&image, 0))[0] = 180;
        assert_int_equal(iris_histogram_extremes(&darkest, &brightest, &image), IRIS_OK);
        assert_int_equal(darkest, 40);
        assert_int_equal(brightest, 180);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_width_format_and_channel),
        cmocka_unit_test(large_and_flat),
        cmocka_unit_test(statistics_by_hand),
        cmocka_unit_test(statistics_in_wide_numbers),
        cmocka_unit_test(a_picture_is_counted),
        cmocka_unit_test(extremes_of_views),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("histogram", tests, NULL, NULL);
}
