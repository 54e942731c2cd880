/* Color conversion. Truth: pixels worked out by hand, and double-precision references in this file. */
#include <math.h>

#include "iris/color.h"
#include "test.h"

static iris_image view(void *data, size_t bytes, int32_t w, int32_t h, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, data, bytes, (iris_size){w, h}, 0, format), IRIS_OK);
    return image;
}

/* Every one of the 65536 values, in both byte orders. */
static void rgb565_widens_to_the_whole_range(void **state)
{
    (void)state;
    for (uint32_t value = 0; value < 65536; value++) {
        uint8_t little[2] = {(uint8_t)value, (uint8_t)(value >> 8)},
                big[2] = {(uint8_t)(value >> 8), (uint8_t)value};
        uint8_t rgb[3], swapped[3], bgr[3];
        assert_int_equal(iris_color_row(rgb, IRIS_RGB888, little, IRIS_RGB565, 1), IRIS_OK);
        assert_int_equal(iris_color_row(swapped, IRIS_RGB888, big, IRIS_RGB565_SWAP, 1), IRIS_OK);
        assert_int_equal(iris_color_row(bgr, IRIS_BGR888, big, IRIS_RGB565_SWAP, 1), IRIS_OK);
        assert_memory_equal(rgb, swapped, 3);
        assert_true(fabs(rgb[0] - (value / 2048) * 255 / 31.0) < 1);
        assert_true(fabs(rgb[1] - (value / 32 % 64) * 255 / 63.0) < 1);
        assert_true(fabs(rgb[2] - (value % 32) * 255 / 31.0) < 1);
        assert_true(bgr[0] == rgb[2] && bgr[1] == rgb[1] && bgr[2] == rgb[0]);
    }
    const uint8_t pixels[] = {0xFF, 0xFF, 0x00, 0x00, 0x00, 0x80, 0x00, 0x04, 0x10, 0x00};
    const uint8_t expected[] = {255, 255, 255, 0, 0, 0, 132, 0, 0, 0, 130, 0, 0, 0, 132};
    uint8_t rgb[15];
    assert_int_equal(iris_color_row(rgb, IRIS_RGB888, pixels, IRIS_RGB565, 5), IRIS_OK);
    assert_memory_equal(rgb, expected, sizeof expected);
}

static double limited(double value)
{
    return value < 0 ? 0 : value > 255 ? 255 : value;
}

/* Within one of ITU-R BT.601 in the limited range, computed from its definition. */
static void yuv_is_bt601_limited(void **state)
{
    (void)state;
    double worst = 0;
    for (int y = 0; y < 256; y += 1) {
        for (int u = 0; u < 256; u += 5) {
            for (int v = 0; v < 256; v += 5) {
                uint8_t yuyv[4] = {(uint8_t)y, (uint8_t)u, (uint8_t)(255 - y), (uint8_t)v};
                uint8_t uyvy[4] = {(uint8_t)u, (uint8_t)y, (uint8_t)v, (uint8_t)(255 - y)};
                uint8_t rgb[6], same[6];
                assert_int_equal(iris_color_rgb_row(rgb, yuyv, IRIS_YUYV, 2), IRIS_OK);
                assert_int_equal(iris_color_rgb_row(same, uyvy, IRIS_UYVY, 2), IRIS_OK);
                assert_memory_equal(rgb, same, 6);
                for (int k = 0; k < 2; k++) {
                    double luma = ((k ? 255 - y : y) - 16) / 219.0, pb = (u - 128) / 224.0,
                           pr = (v - 128) / 224.0;
                    double r = luma + 2 * (1 - 0.299) * pr, b = luma + 2 * (1 - 0.114) * pb;
                    double g = (luma - 0.299 * r - 0.114 * b) / 0.587;
                    worst = fmax(worst, fabs(rgb[3 * k] - limited(255 * r)));
                    worst = fmax(worst, fabs(rgb[3 * k + 1] - limited(255 * g)));
                    worst = fmax(worst, fabs(rgb[3 * k + 2] - limited(255 * b)));
                }
            }
        }
    }
    print_message("# YUV: largest error %.3f\n", worst);
    assert_true(worst < 1);
    const uint8_t pixels[] = {16, 128, 235, 128,
                              81, 90,  81,  240}; /* black, white, twice red of a color bar */
    uint8_t rgb[12], gray[4];
    assert_int_equal(iris_color_rgb_row(rgb, pixels, IRIS_YUYV, 4), IRIS_OK);
    const uint8_t black_white[] = {0, 0, 0, 255, 255, 255};
    assert_memory_equal(rgb, black_white, 6);
    assert_true(rgb[6] >= 253 && rgb[7] <= 2 && rgb[8] <= 2);
    assert_int_equal(iris_color_row(gray, IRIS_GRAY8, pixels, IRIS_YUYV, 4), IRIS_OK);
    assert_true(gray[0] == 16 && gray[1] == 235 && gray[2] == 81 && gray[3] == 81);
    assert_int_equal(iris_color_row(gray, IRIS_GRAY8, pixels, IRIS_UYVY, 4), IRIS_OK);
    assert_true(gray[0] == 128 && gray[1] == 128 && gray[2] == 90 && gray[3] == 240);
}

static void gray_by_every_method(void **state)
{
    (void)state;
    static uint8_t rgb[3 * 1000], bgr[3 * 1000], gray[1000], same[1000];
    uint32_t color = 0;
    for (int block = 0; block < 300; block++) {
        for (int i = 0; i < 1000; i++, color += 56003) {
            bgr[3 * i + 2] = rgb[3 * i] = (uint8_t)(color >> 16);
            bgr[3 * i + 1] = rgb[3 * i + 1] = (uint8_t)(color >> 8);
            bgr[3 * i] = rgb[3 * i + 2] = (uint8_t)color;
        }
        for (int method = IRIS_GRAY_LUMA; method <= IRIS_GRAY_GREEN; method++) {
            iris_gray_method by = (iris_gray_method)method;
            assert_int_equal(iris_color_gray_row(gray, rgb, IRIS_RGB888, by, 1000), IRIS_OK);
            assert_int_equal(iris_color_gray_row(same, bgr, IRIS_BGR888, by, 1000), IRIS_OK);
            assert_memory_equal(gray, same, sizeof gray);
            for (int i = 0; i < 1000; i++) {
                double r = rgb[3 * i], g = rgb[3 * i + 1], b = rgb[3 * i + 2];
                if (by == IRIS_GRAY_GREEN) {
                    assert_int_equal(gray[i], (int)g);
                } else if (by == IRIS_GRAY_AVERAGE) {
                    assert_int_equal(gray[i], (int)floor((r + g + b) / 3 + 0.5));
                } else {
                    assert_true(fabs(gray[i] - (0.299 * r + 0.587 * g + 0.114 * b)) < 1);
                }
            }
        }
    }
    for (int sum = 0; sum <= 765; sum++) { /* every sum of three */
        uint8_t pixel[3] = {(uint8_t)(sum / 3), (uint8_t)((sum + 1) / 3), (uint8_t)((sum + 2) / 3)}, average;
        assert_int_equal(iris_color_gray_row(&average, pixel, IRIS_RGB888, IRIS_GRAY_AVERAGE, 1), IRIS_OK);
        assert_int_equal(average, (int)floor(sum / 3.0 + 0.5));
    }
    const uint8_t known[] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0};
    const uint8_t luma[] = {77, 149, 29, 255, 0};
    assert_int_equal(iris_color_row(gray, IRIS_GRAY8, known, IRIS_RGB888, 5), IRIS_OK);
    assert_memory_equal(gray, luma, 5);
}

/* Gray of two-byte formats goes through pieces of RGB: every length around their ends. */
static void gray_of_packed_formats_is_gray_of_their_rgb(void **state)
{
    (void)state;
    const iris_format formats[] = {IRIS_RGB565, IRIS_RGB565_SWAP, IRIS_YUYV, IRIS_UYVY};
    uint8_t src[2 * 200], rgb[3 * 200], gray[200 + 1], expected[200];
    for (int i = 0; i < 400; i++) {
        src[i] = (uint8_t)(i * 151 + i / 7 * 13);
    }
    for (int f = 0; f < 4; f++) {
        for (int n = 2; n <= 200; n += 2) {
            for (int method = IRIS_GRAY_LUMA; method <= IRIS_GRAY_GREEN; method++) {
                if (method == IRIS_GRAY_LUMA && f >= 2) {
                    continue;
                }
                iris_gray_method by = (iris_gray_method)method;
                gray[n] = 0x5A;
                assert_int_equal(iris_color_rgb_row(rgb, src, formats[f], n), IRIS_OK);
                assert_int_equal(iris_color_gray_row(expected, rgb, IRIS_RGB888, by, n), IRIS_OK);
                assert_int_equal(iris_color_gray_row(gray, src, formats[f], by, n), IRIS_OK);
                assert_memory_equal(gray, expected, (size_t)n);
                assert_int_equal(gray[n], 0x5A);
            }
        }
    }
}

/* Whatever alpha is, at every length around the pieces, and to BGR too. */
static void rgba_is_rgb_without_alpha(void **state)
{
    (void)state;
    uint8_t rgba[4 * 200], rgb[3 * 200], bgr[3 * 200], made[3 * 200 + 1], expected[200];
    for (int i = 0; i < 200; i++) {
        for (int c = 0; c < 3; c++) {
            rgba[4 * i + c] = rgb[3 * i + c] = bgr[3 * i + 2 - c] = (uint8_t)(i * 151 + c * 77 + i / 7 * 13);
        }
        rgba[4 * i + 3] = (uint8_t)(i * 91);
    }
    for (int n = 1; n <= 200; n++) {
        made[3 * n] = 0x5A;
        assert_int_equal(iris_color_row(made, IRIS_RGB888, rgba, IRIS_RGBA8888, n), IRIS_OK);
        assert_memory_equal(made, rgb, 3 * (size_t)n);
        assert_int_equal(iris_color_row(made, IRIS_BGR888, rgba, IRIS_RGBA8888, n), IRIS_OK);
        assert_memory_equal(made, bgr, 3 * (size_t)n);
        assert_int_equal(made[3 * n], 0x5A);
        for (int method = IRIS_GRAY_LUMA; method <= IRIS_GRAY_GREEN; method++) {
            iris_gray_method by = (iris_gray_method)method;
            made[n] = 0x5A;
            assert_int_equal(iris_color_gray_row(expected, rgb, IRIS_RGB888, by, n), IRIS_OK);
            assert_int_equal(iris_color_gray_row(made, rgba, IRIS_RGBA8888, by, n), IRIS_OK);
            assert_memory_equal(made, expected, (size_t)n);
            assert_int_equal(made[n], 0x5A);
        }
    }
    const uint8_t pixels[] = {1, 2, 3, 0, 250, 251, 252, 255};
    const uint8_t colors[] = {1, 2, 3, 250, 251, 252};
    assert_int_equal(iris_color_rgb_row(made, pixels, IRIS_RGBA8888, 2), IRIS_OK);
    assert_memory_equal(made, colors, 6);
}

static void gray_and_mask_spread(void **state)
{
    (void)state;
    const uint8_t gray[] = {0, 7, 255};
    const uint8_t spread[] = {0, 0, 0, 7, 7, 7, 255, 255, 255};
    const uint32_t mask[] = {0x80000001u, 0xFFFFFFFEu};
    uint8_t rgb[9], pixels[35];
    assert_int_equal(iris_color_row(rgb, IRIS_RGB888, gray, IRIS_GRAY8, 3), IRIS_OK);
    assert_memory_equal(rgb, spread, 9);
    assert_int_equal(iris_color_row(rgb, IRIS_BGR888, gray, IRIS_GRAY8, 3), IRIS_OK);
    assert_memory_equal(rgb, spread, 9);
    assert_int_equal(iris_color_row(pixels, IRIS_GRAY8, mask, IRIS_MASK1, 35), IRIS_OK);
    for (int i = 0; i < 35; i++) {
        assert_int_equal(pixels[i], i == 0 || i == 31 || i >= 33 ? 255 : 0);
    }
}

/* 3 x 2 pixels with padding, bottom-up source: the padding stays, the rows are turned. */
static void views_of_any_stride(void **state)
{
    (void)state;
    uint8_t src[2 * 12] = {4, 5, 6, 7, 8, 9, 1, 2, 3, 0, 0, 0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 0, 0, 0};
    uint8_t dst[2 * 10];
    const uint8_t expected[2 * 10] = {30, 20, 10, 60, 50, 40, 90, 80, 70, 0x5A,
                                      6,  5,  4,  9,  8,  7,  3,  2,  1,  0x5A};
    iris_image from, to;
    memset(dst, 0x5A, sizeof dst);
    assert_int_equal(iris_image_wrap(&from, src, sizeof src, (iris_size){3, 2}, -12, IRIS_BGR888), IRIS_OK);
    assert_int_equal(iris_image_wrap(&to, dst, sizeof dst, (iris_size){3, 2}, 10, IRIS_RGB888), IRIS_OK);
    assert_int_equal(iris_color_convert(&to, &from), IRIS_OK);
    assert_memory_equal(dst, expected, sizeof dst);
    uint8_t green[6];
    to = view(green, sizeof green, 3, 2, IRIS_GRAY8);
    assert_int_equal(iris_color_gray(&to, &from, IRIS_GRAY_GREEN), IRIS_OK);
    const uint8_t greens[] = {20, 50, 80, 5, 8, 2};
    assert_memory_equal(green, greens, sizeof green);
}

static void in_place_where_pixels_have_the_same_size(void **state)
{
    (void)state;
    uint8_t pixels[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    const uint8_t swapped[12] = {3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10};
    iris_image rgb = view(pixels, sizeof pixels, 2, 2, IRIS_RGB888), bgr = rgb, gray;
    bgr.format = IRIS_BGR888;
    assert_int_equal(iris_color_convert(&bgr, &rgb), IRIS_OK);
    assert_memory_equal(pixels, swapped, 12);
    assert_int_equal(iris_color_convert(&rgb, &rgb), IRIS_OK);
    assert_memory_equal(pixels, swapped, 12);
    gray = view(pixels, sizeof pixels, 2, 2, IRIS_GRAY8);
    assert_int_equal(iris_color_gray(&gray, &gray, IRIS_GRAY_AVERAGE), IRIS_OK);
    assert_int_equal(iris_color_convert(&gray, &rgb), IRIS_ERR_ALIAS);
    assert_int_equal(iris_color_gray(&gray, &rgb, IRIS_GRAY_GREEN), IRIS_ERR_ALIAS);
    iris_image turned = bgr; /* the same bytes, upside down */
    turned.data = pixels + 6;
    turned.stride = -6;
    assert_int_equal(iris_color_convert(&turned, &rgb), IRIS_ERR_ALIAS);
    iris_image wide = view(pixels, sizeof pixels, 1, 2, IRIS_RGB888),
               narrow = wide; /* one start, two strides */
    wide.stride = 6;
    assert_int_equal(iris_color_convert(&wide, &narrow), IRIS_ERR_ALIAS);
    assert_int_equal(iris_color_row(pixels + 3, IRIS_RGB888, pixels, IRIS_BGR888, 2), IRIS_ERR_ALIAS);
    assert_int_equal(iris_color_row(pixels + 6, IRIS_RGB888, pixels, IRIS_BGR888, 2), IRIS_OK);
    assert_int_equal(iris_color_rgb_row(pixels, pixels, IRIS_GRAY8, 2), IRIS_ERR_ALIAS);
    assert_int_equal(iris_color_gray_row(pixels, pixels + 1, IRIS_GRAY8, IRIS_GRAY_LUMA, 2), IRIS_ERR_ALIAS);
}

static void bad_calls_are_refused_and_touch_nothing(void **state)
{
    (void)state;
    static uint32_t from[64], to[64], before[64];
    iris_image src = view(from, sizeof from, 4, 4, IRIS_RGB888), dst = view(to, sizeof to, 4, 4, IRIS_GRAY8);
    iris_image other = view(to, sizeof to, 4, 3, IRIS_GRAY8), invalid = dst,
               mask = view(to, sizeof to, 4, 4, IRIS_MASK1);
    invalid.w = 0;
    memset(to, 0x5A, sizeof to);
    memcpy(before, to, sizeof to);
    assert_int_equal(iris_color_convert(NULL, &src), IRIS_ERR_ARG);
    assert_int_equal(iris_color_convert(&dst, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_color_convert(&invalid, &src), IRIS_ERR_ARG);
    assert_int_equal(iris_color_convert(&other, &src), IRIS_ERR_RANGE);
    assert_int_equal(iris_color_convert(&mask, &src), IRIS_ERR_FORMAT);
    assert_int_equal(iris_color_gray(&mask, &src, IRIS_GRAY_LUMA), IRIS_ERR_FORMAT);
    assert_int_equal(iris_color_gray(&dst, &src, (iris_gray_method)3), IRIS_ERR_ARG);
    assert_int_equal(iris_color_gray(&dst, &src, (iris_gray_method)-1), IRIS_ERR_ARG);
    assert_int_equal(iris_color_row(NULL, IRIS_GRAY8, from, IRIS_RGB888, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_color_row(to, IRIS_GRAY8, NULL, IRIS_RGB888, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_color_rgb_row(NULL, from, IRIS_RGB888, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_color_gray_row((uint8_t *)to, NULL, IRIS_RGB888, IRIS_GRAY_LUMA, 4), IRIS_ERR_ARG);
    const int32_t counts[] = {0, -1, INT32_MIN, INT32_MAX, IRIS_SIDE_MAX + 1};
    for (int i = 0; i < 5; i++) {
        assert_int_equal(iris_color_row(to, IRIS_GRAY8, from, IRIS_RGB888, counts[i]), IRIS_ERR_RANGE);
        assert_int_equal(iris_color_rgb_row((uint8_t *)to, from, IRIS_RGB888, counts[i]), IRIS_ERR_RANGE);
    }
    assert_int_equal(iris_color_row(to, IRIS_GRAY8, from, IRIS_YUYV, 3), IRIS_ERR_RANGE);
    assert_int_equal(iris_color_row(to, IRIS_GRAY8, (uint8_t *)from + 1, IRIS_MASK1, 3), IRIS_ERR_ALIGN);
    assert_int_equal(iris_color_rgb_row((uint8_t *)to, from, IRIS_HSL24, 4), IRIS_ERR_FORMAT);
    /* every pair outside the table, unknown formats too */
    for (int d = 0; d <= 25; d++) {
        for (int s = 0; s <= 25; s++) {
            int camera = s == IRIS_GRAY8 || s == IRIS_RGB888 || s == IRIS_BGR888 || s == IRIS_RGBA8888 ||
                         s == IRIS_RGB565 || s == IRIS_RGB565_SWAP || s == IRIS_YUYV || s == IRIS_UYVY;
            assert_int_equal(iris_color_takes((iris_format)s), camera);
            int pair =
                (d == IRIS_GRAY8 && (camera || s == IRIS_MASK1)) ||
                ((d == IRIS_RGB888 || d == IRIS_BGR888) && (camera || s == IRIS_HSL24 || s == IRIS_HSL48)) ||
                ((d == IRIS_HSL24 || d == IRIS_HSL48) && (s == IRIS_RGB888 || s == IRIS_BGR888));
            iris_status status = iris_color_row(to, (iris_format)d, from, (iris_format)s, pair ? 0 : 4);
            assert_int_equal(status, pair ? IRIS_ERR_RANGE : IRIS_ERR_FORMAT);
        }
    }
    assert_memory_equal(to, before, sizeof to);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rgb565_widens_to_the_whole_range),
        cmocka_unit_test(yuv_is_bt601_limited),
        cmocka_unit_test(gray_by_every_method),
        cmocka_unit_test(gray_of_packed_formats_is_gray_of_their_rgb),
        cmocka_unit_test(rgba_is_rgb_without_alpha),
        cmocka_unit_test(gray_and_mask_spread),
        cmocka_unit_test(views_of_any_stride),
        cmocka_unit_test(in_place_where_pixels_have_the_same_size),
        cmocka_unit_test(bad_calls_are_refused_and_touch_nothing),
    };
    return cmocka_run_group_tests_name("color", tests, NULL, NULL);
}
