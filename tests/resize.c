/* Resize by area, against the overlap of each pair of pixels, in whole numbers. tests/copy.c has the other two. */
#include "iris/copy.h"
#include "test.h"

static uint8_t from[3 * IRIS_SIDE_MAX + 64], to[3 * IRIS_SIDE_MAX + 64];

static iris_image wrap(void *buffer, size_t bytes, int32_t w, int32_t h, ptrdiff_t stride, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, buffer, bytes, (iris_size){w, h}, stride, format), IRIS_OK);
    return image;
}

static void random_bytes(uint8_t *bytes, size_t count, uint32_t seed)
{
    for (size_t i = 0; i < count; i++) {
        seed = seed * 1664525u + 1013904223u;
        bytes[i] = (uint8_t)(seed >> 24);
    }
}

/* How much of src pixel j lies under dst pixel i, where the axis is src * dst long. */
static int64_t overlap(int64_t i, int64_t j, int64_t dst, int64_t src)
{
    int64_t low = i * src > j * dst ? i * src : j * dst;
    int64_t high = (i + 1) * src < (j + 1) * dst ? (i + 1) * src : (j + 1) * dst;
    return high > low ? high - low : 0;
}

static int reference(const iris_image *dst, const iris_image *src, int32_t x, int32_t y, int channel)
{
    int channels = src->format == IRIS_GRAY8 ? 1 : 3;
    int64_t sum = 0, area = (int64_t)src->w * src->h;
    for (int32_t v = 0; v < src->h; v++) {
        int64_t high = overlap(y, v, dst->h, src->h);
        const uint8_t *row = iris_image_row(src, v);
        for (int32_t u = 0; high > 0 && u < src->w; u++) {
            sum += high * overlap(x, u, dst->w, src->w) * row[u * channels + channel];
        }
    }
    return (int)((2 * sum + area) / (2 * area)); /* half up */
}

static void assert_resized(iris_size size, iris_size source, iris_format format)
{
    ptrdiff_t row = (ptrdiff_t)iris_format_row_bytes(format, size.w);
    iris_image src = wrap(from, sizeof from, source.w, source.h, 0, format);
    iris_image dst = wrap(to, sizeof to, size.w, size.h, size.w % 2 ? row + 3 : -row - 1, format);
    memset(to, 0x5A, sizeof to);
    assert_int_equal(iris_resize_area(&dst, &src), IRIS_OK);
    for (int32_t y = 0; y < size.h; y++) {
        const uint8_t *made = iris_image_row(&dst, y);
        for (int32_t i = 0; i < row; i++) {
            int channels = format == IRIS_GRAY8 ? 1 : 3;
            assert_int_equal(made[i], reference(&dst, &src, i / channels, y, i % channels));
        }
        if (y < size.h - 1) {
            assert_int_equal(made[row], 0x5A);
        }
    }
}

static void area_of_every_ratio(void **state)
{
    (void)state;
    const iris_format formats[] = {IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};
    const iris_size sizes[] = {{1, 1}, {1, 9},  {2, 3},   {3, 2},   {7, 5},
                               {8, 8}, {16, 4}, {21, 11}, {30, 30}, {41, 2}};
    const int count = sizeof sizes / sizeof sizes[0];
    for (int i = 0; i < count * count; i++) {
        random_bytes(from, 10000, (uint32_t)i);
        if (i % 3 == 0) {
            for (int b = 0; b < 10000; b++) {
                from[b] = from[b] > 127 ? 255 : 0;
            }
        }
        assert_resized(sizes[i / count], sizes[i % count], formats[i % 3]);
    }
}

static void area_by_hand(void **state)
{
    (void)state;
    const uint8_t pixels[] = {10, 20, 30, 40, 50, 61};
    memcpy(from, pixels, 6);
    iris_image src = wrap(from, 6, 3, 2, 0, IRIS_GRAY8), dst = wrap(to, sizeof to, 1, 1, 0, IRIS_GRAY8);
    assert_int_equal(iris_resize_area(&dst, &src), IRIS_OK);
    assert_int_equal(to[0], 35); /* 211 / 6 */
    dst = wrap(to, sizeof to, 2, 2, 0, IRIS_GRAY8);
    assert_int_equal(iris_resize_area(&dst, &src), IRIS_OK);
    const uint8_t halves[] = {13, 27, 43, 57}; /* 10 and half of 20: 13.3; 26.7; 43.3; 57.3 */
    assert_memory_equal(to, halves, 4);
    dst = wrap(to, sizeof to, 3, 1, 0, IRIS_GRAY8);
    assert_int_equal(iris_resize_area(&dst, &src), IRIS_OK);
    const uint8_t means[] = {25, 35, 46}; /* 45.5 is rounded up */
    assert_memory_equal(to, means, 3);
    dst = wrap(to, sizeof to, 3, 2, 0, IRIS_GRAY8);
    assert_int_equal(iris_resize_area(&dst, &src), IRIS_OK);
    assert_memory_equal(to, pixels, 6);
    src = wrap(from, 6, 3, 1, 0, IRIS_GRAY8);
    dst = wrap(to, sizeof to, 6, 2, 0, IRIS_GRAY8); /* each pixel four times */
    assert_int_equal(iris_resize_area(&dst, &src), IRIS_OK);
    const uint8_t larger[] = {10, 10, 20, 20, 30, 30, 10, 10, 20, 20, 30, 30};
    assert_memory_equal(to, larger, 12);
}

static void area_of_the_longest_sides(void **state)
{
    (void)state;
    const int32_t far = IRIS_SIDE_MAX;
    const iris_size sizes[] = {{1, 1}, {2, 1}, {far, 1}, {far - 1, 1}, {12345, 1}, {1, 123}, {3, 7}};
    for (int i = 0; i < 7; i++) {
        for (int kind = 0; kind < 2; kind++) {
            for (int turned = 0; turned < 2; turned++) {
                if (turned && sizes[i].w > 1000) {
                    continue; /* all of src under each of many pixels: slow */
                }
                random_bytes(from, sizeof from, (uint32_t)i);
                if (kind) {
                    memset(from, 255, sizeof from);
                }
                iris_image src = wrap(from, sizeof from, turned ? 1 : far, turned ? far : 1, 0, IRIS_GRAY8);
                iris_image dst = wrap(to, sizeof to, sizes[i].w, sizes[i].h, 0, IRIS_GRAY8);
                assert_int_equal(iris_resize_area(&dst, &src), IRIS_OK);
                int32_t n = sizes[i].w * sizes[i].h, step = n > 40 ? n / 23 : 1;
                for (int32_t p = 0; p < n; p += step) {
                    int expected = kind ? 255 : reference(&dst, &src, p % dst.w, p / dst.w, 0);
                    assert_int_equal(to[p], expected);
                }
            }
        }
    }
}

/* A part of a picture, into a part of another: nothing around either counts. */
static void area_of_regions(void **state)
{
    (void)state;
    random_bytes(from, 100 * 60, 4);
    memset(to, 0x5A, sizeof to);
    iris_image whole = wrap(from, 6000, 33, 60, -100, IRIS_RGB888),
               canvas = wrap(to, 6000, 30, 50, 100, IRIS_RGB888);
    iris_image src, dst;
    assert_int_equal(iris_image_crop(&src, &whole, (iris_rect){5, 3, 21, 17}), IRIS_OK);
    assert_int_equal(iris_image_crop(&dst, &canvas, (iris_rect){7, 9, 11, 23}), IRIS_OK);
    assert_int_equal(iris_resize_area(&dst, &src), IRIS_OK);
    for (int32_t i = 0; i < 100 * 50; i++) {
        int32_t x = i % 100 / 3 - 7, y = i / 100 - 9;
        int inside = x >= 0 && x < 11 && y >= 0 && y < 23 && i % 100 >= 21;
        assert_int_equal(to[i], inside ? reference(&dst, &src, x, y, i % 100 % 3) : 0x5A);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    memset(to, 0x5A, sizeof to);
    iris_image src = wrap(from, sizeof from, 9, 5, 0, IRIS_GRAY8),
               dst = wrap(to, sizeof to, 5, 9, 0, IRIS_GRAY8);
    iris_image bad = dst;
    assert_int_equal(iris_resize_area(NULL, &src), IRIS_ERR_ARG);
    assert_int_equal(iris_resize_area(&dst, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_resize_area(&src, &src), IRIS_ERR_ALIAS);
    bad.format = IRIS_BAYER8_RGGB;
    assert_int_equal(iris_resize_area(&bad, &bad), IRIS_ERR_FORMAT);
    assert_int_equal(iris_resize_area(&bad, &src), IRIS_ERR_FORMAT);
    bad.w = 0;
    assert_int_equal(iris_resize_area(&bad, &src), IRIS_ERR_RANGE);
    for (int i = 0; i < 100; i++) {
        assert_int_equal(to[i], 0x5A);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(area_of_every_ratio),       cmocka_unit_test(area_by_hand),
        cmocka_unit_test(area_of_the_longest_sides), cmocka_unit_test(area_of_regions),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("resize", tests, NULL, NULL);
}
