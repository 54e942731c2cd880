/* Integral images. Truth: sums by hand, by loops over the pixels of each box, and variances in double precision. */
#include "iris/integral.h"
#include "test.h"

#include <math.h>

enum { W = 71, H = 23, BIG = 300 };

static uint8_t pixels[BIG * BIG];
static uint32_t words[(W + 31) / 32 * H + 64], sums[(BIG + 1) * (BIG + 1)], squares[(BIG + 1) * (BIG + 1)];

static iris_image wrap(void *buffer, size_t bytes, int32_t w, int32_t h, ptrdiff_t stride, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, buffer, bytes, (iris_size){w, h}, stride, format), IRIS_OK);
    return image;
}

static uint32_t random_next(void)
{
    static uint32_t seed = 1;
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

static uint32_t value_at(const iris_image *src, int32_t x, int32_t y)
{
    if (src->format == IRIS_MASK1) {
        return ((const uint32_t *)iris_image_row(src, y))[x / 32] >> x % 32 & 1;
    }
    return ((const uint8_t *)iris_image_row(src, y))[x];
}

static void by_hand(void **state)
{
    (void)state;
    uint8_t gray[6] = {1, 2, 3, 10, 20, 30};
    const uint32_t expected[12] = {0, 0, 0, 0, 0, 1, 3, 6, 0, 11, 33, 66};
    const uint32_t expected_squares[12] = {0, 0, 0, 0, 0, 1, 5, 14, 0, 101, 505, 1414};
    iris_image src = wrap(gray, 6, 3, 2, 0, IRIS_GRAY8), integral = wrap(sums, 48, 4, 3, 0, IRIS_GRAY_U32);
    iris_image of_squares = wrap(squares, 48, 4, 3, 0, IRIS_GRAY_U32);
    assert_int_equal(iris_integral(&integral, &src), IRIS_OK);
    assert_memory_equal(sums, expected, 48);
    assert_int_equal(iris_integral_squares(&of_squares, &src), IRIS_OK);
    assert_memory_equal(squares, expected_squares, 48);
    uint32_t sum;
    iris_q16 mean, variance;
    iris_rect right = {1, 0, 2, 2}; /* 2 3 20 30: mean 13.75, squares 1313, variance 328.25 - 189.0625 */
    assert_int_equal(iris_integral_sum(&sum, &integral, right), IRIS_OK);
    assert_int_equal(sum, 55);
    assert_int_equal(iris_integral_mean(&mean, &integral, right), IRIS_OK);
    assert_int_equal(mean, 55 * 65536 / 4);
    assert_int_equal(iris_integral_variance(&variance, &integral, &of_squares, right), IRIS_OK);
    assert_int_equal(variance, 139.1875 * 65536);
    assert_int_equal(iris_integral_mean(&mean, &integral, (iris_rect){0, 0, 3, 1}), IRIS_OK);
    assert_int_equal(mean, 2 * 65536);
    assert_int_equal(iris_integral_variance(&variance, &integral, &of_squares, (iris_rect){0, 0, 3, 1}),
                     IRIS_OK);
    assert_int_equal(variance, 43691); /* 2 / 3 */
    assert_int_equal(iris_integral_variance(&variance, &integral, &of_squares, (iris_rect){2, 1, 1, 1}),
                     IRIS_OK);
    assert_int_equal(variance, 0);
}

/* Every box of small pictures; views with padding, bottom-up, and cut out of others. */
static void every_box(void **state)
{
    (void)state;
    const iris_size sizes[] = {{1, 1}, {1, 8}, {9, 1}, {13, 7}, {33, 4}};
    for (int kind = 0; kind < 6; kind++) {
        for (size_t i = 0; i < sizeof words / 4; i++) {
            words[i] = random_next() << 16 ^ random_next();
        }
        for (int i = 0; i < W * H; i++) {
            pixels[i] = (uint8_t)(kind < 2 ? 255 : random_next());
        }
        int mask = kind % 2;
        iris_image whole = mask ? wrap(words, sizeof words, W, H, -12, IRIS_MASK1)
                                : wrap(pixels, sizeof pixels, W, H, kind % 3 ? 90 : -77, IRIS_GRAY8);
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
            int32_t w = sizes[s].w, h = sizes[s].h;
            iris_image src,
                integral = wrap(sums, sizeof sums, w + 1, h + 1, kind % 3 ? 0 : -160, IRIS_GRAY_U32);
            memset(sums, 0x5A, sizeof sums);
            assert_int_equal(iris_image_crop(&src, &whole, (iris_rect){mask ? 32 : 7, 5, w, h}), IRIS_OK);
            assert_int_equal(iris_integral(&integral, &src), IRIS_OK);
            if (integral.stride == -160 && w < 38) {
                assert_int_equal(((uint32_t *)iris_image_row(&integral, 0))[w + 1], 0x5A5A5A5A);
            }
            for (iris_rect b = {0, 0, 1, 1}; b.y < h; b.h++) {
                if (b.y + b.h > h) {
                    b.h = 0;
                    b.y++;
                    continue;
                }
                for (b.x = 0; b.x < w; b.x++) {
                    uint32_t expected = 0, sum;
                    for (b.w = 1; b.x + b.w <= w; b.w++) {
                        for (int32_t v = b.y; v < b.y + b.h; v++) {
                            expected += value_at(&src, b.x + b.w - 1, v);
                        }
                        iris_q16 mean;
                        assert_int_equal(iris_integral_sum(&sum, &integral, b), IRIS_OK);
                        assert_int_equal(sum, expected);
                        assert_int_equal(iris_integral_mean(&mean, &integral, b), IRIS_OK);
                        assert_int_equal(mean, floor(expected * 65536.0 / (b.w * b.h) + 0.5));
                    }
                }
            }
        }
    }
}

/* Boxes up to the largest whose squares fit, in pictures whose own sums of squares wrap around. */
static void variance_against_doubles(void **state)
{
    (void)state;
    iris_image src = wrap(pixels, sizeof pixels, BIG, BIG, 0, IRIS_GRAY8);
    iris_image integral = wrap(sums, sizeof sums, BIG + 1, BIG + 1, 0, IRIS_GRAY_U32);
    iris_image of_squares = wrap(squares, sizeof squares, BIG + 1, BIG + 1, 0, IRIS_GRAY_U32);
    for (int kind = 0; kind < 4; kind++) {
        for (int i = 0; i < BIG * BIG; i++) {
            pixels[i] = (uint8_t)(kind == 0   ? 255
                                  : kind == 1 ? random_next()
                                  : kind == 2 ? random_next() % 2 * 255
                                              : 250 + random_next() % 3);
        }
        assert_int_equal(iris_integral(&integral, &src), IRIS_OK);
        assert_int_equal(iris_integral_squares(&of_squares, &src), IRIS_OK);
        for (int box = 0; box < 40; box++) {
            iris_rect b = {0, 0, 257, 257};
            b.x = (int32_t)(random_next() % 43);
            b.y = (int32_t)(random_next() % 43);
            if (box > 3) {
                b.w = 1 + (int32_t)(random_next() % (box < 20 ? 9u : 257u));
                b.h = 1 + (int32_t)(random_next() % (box < 20 ? 9u : 257u));
            }
            double n = b.w * b.h, sum = 0, of = 0; /* whole numbers: exact */
            for (int32_t i = 0; i < b.w * b.h; i++) {
                double value = value_at(&src, b.x + i % b.w, b.y + i / b.w);
                sum += value;
                of += value * value;
            }
            double exact = (n * of - sum * sum) / (n * n);
            iris_q16 variance;
            assert_int_equal(iris_integral_variance(&variance, &integral, &of_squares, b), IRIS_OK);
            assert_true(fabs(variance / 65536.0 - exact) < 0.51 / 65536);
        }
    }
}

static void boxes_that_do_not_fit(void **state)
{
    (void)state;
    iris_image src = wrap(pixels, sizeof pixels, BIG, BIG, 0, IRIS_GRAY8);
    iris_image integral = wrap(sums, sizeof sums, BIG + 1, BIG + 1, 0, IRIS_GRAY_U32);
    uint32_t sum = 77;
    iris_q16 q = 78;
    assert_int_equal(iris_integral(&integral, &src), IRIS_OK);
    const iris_rect bad[] = {{-1, 0, 2, 2},        {0, -1, 2, 2},
                             {0, 0, 0, 1},         {0, 0, 1, 0},
                             {0, 0, BIG + 1, 1},   {0, 0, 1, BIG + 1},
                             {1, 0, BIG, 1},       {0, 1, 1, BIG},
                             {INT32_MAX, 0, 1, 1}, {0, 0, INT32_MAX, 1},
                             {0, 0, 1, INT32_MAX}, {INT32_MIN, 0, INT32_MIN, 1},
                             {0, INT32_MAX, 1, 1}, {2, 2, INT32_MAX, INT32_MAX},
                             {0, 0, -5, -5}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(iris_integral_sum(&sum, &integral, bad[i]), IRIS_ERR_RANGE);
        assert_int_equal(iris_integral_mean(&q, &integral, bad[i]), IRIS_ERR_RANGE);
        assert_int_equal(iris_integral_variance(&q, &integral, &integral, bad[i]), IRIS_ERR_RANGE);
    }
    assert_int_equal(iris_integral_variance(&q, &integral, &integral, (iris_rect){0, 0, 258, 257}),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_integral_sum(&sum, &integral, (iris_rect){0, 0, BIG, BIG}), IRIS_OK);
    sum = 77;
    iris_image smaller = wrap(squares, sizeof squares, BIG, BIG, 0, IRIS_GRAY_U32);
    assert_int_equal(iris_integral_variance(&q, &integral, &smaller, (iris_rect){0, 0, 2, 2}),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_integral_sum(NULL, &integral, (iris_rect){0, 0, 2, 2}), IRIS_ERR_ARG);
    assert_int_equal(iris_integral_sum(&sum, NULL, (iris_rect){0, 0, 2, 2}), IRIS_ERR_ARG);
    assert_int_equal(iris_integral_sum(&sum, &src, (iris_rect){0, 0, 2, 2}), IRIS_ERR_FORMAT);
    assert_int_equal(iris_integral_mean(NULL, &integral, (iris_rect){0, 0, 2, 2}), IRIS_ERR_ARG);
    assert_int_equal(iris_integral_variance(NULL, &integral, &integral, (iris_rect){0, 0, 2, 2}),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_integral_variance(&q, &integral, NULL, (iris_rect){0, 0, 2, 2}), IRIS_ERR_ARG);
    assert_int_equal(iris_integral_variance(&q, &src, &integral, (iris_rect){0, 0, 2, 2}), IRIS_ERR_FORMAT);
    assert_int_equal(sum, 77);
    assert_int_equal(q, 78);
}

/* Anything may be given as an integral image: values of no picture saturate. */
static void what_is_no_integral_image(void **state)
{
    (void)state;
    iris_image any = wrap(sums, sizeof sums, 260, 260, 0, IRIS_GRAY_U32);
    iris_image other = wrap(squares, sizeof squares, 260, 260, 0, IRIS_GRAY_U32);
    iris_q16 q;
    memset(squares, 0, sizeof squares);
    for (size_t i = 0; i < 260 * 260; i++) {
        sums[i] = i == 261 ? UINT32_MAX : 0;
    }
    assert_int_equal(iris_integral_mean(&q, &any, (iris_rect){0, 0, 1, 1}), IRIS_OK);
    assert_int_equal(q, INT32_MAX);
    assert_int_equal(iris_integral_variance(&q, &any, &other, (iris_rect){0, 0, 1, 1}), IRIS_OK);
    assert_int_equal(q, 0);
    assert_int_equal(iris_integral_variance(&q, &other, &any, (iris_rect){0, 0, 1, 1}), IRIS_OK);
    assert_int_equal(q, INT32_MAX);
    for (size_t i = 0; i < 260 * 260; i++) {
        sums[i] = i == 257 * 261 ? UINT32_MAX : 0;
    }
    assert_int_equal(iris_integral_variance(&q, &other, &any, (iris_rect){0, 0, 257, 257}), IRIS_OK);
    assert_int_equal(q, INT32_MAX);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    memset(sums, 0x5A, sizeof sums);
    iris_image src = wrap(pixels, sizeof pixels, 9, 5, 0, IRIS_GRAY8), bad = src;
    iris_image integral = wrap(sums, sizeof sums, 10, 6, 0, IRIS_GRAY_U32), other = integral;
    iris_image mask = wrap(words, sizeof words, 9, 5, 0, IRIS_MASK1);
    assert_int_equal(iris_integral(NULL, &src), IRIS_ERR_ARG);
    assert_int_equal(iris_integral(&integral, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_integral_squares(NULL, &src), IRIS_ERR_ARG);
    assert_int_equal(iris_integral_squares(&integral, &mask), IRIS_ERR_FORMAT);
    assert_int_equal(iris_integral(&src, &src), IRIS_ERR_FORMAT);
    bad.format = IRIS_BAYER8_RGGB;
    assert_int_equal(iris_integral(&integral, &bad), IRIS_ERR_FORMAT);
    for (int32_t w = 8; w <= 12; w++) {
        for (int32_t h = 4; h <= 8; h++) {
            other.w = w;
            other.h = h;
            other.stride = 48;
            assert_int_equal(iris_integral(&other, &src), w == 10 && h == 6 ? IRIS_OK : IRIS_ERR_RANGE);
        }
    }
    memset(sums, 0x5A, sizeof sums);
    bad = src;
    bad.data = sums;
    assert_int_equal(iris_integral(&integral, &bad), IRIS_ERR_ALIAS);
    assert_int_equal(iris_integral_squares(&integral, &bad), IRIS_ERR_ALIAS);
    for (int i = 0; i < 60; i++) {
        assert_int_equal(sums[i], 0x5A5A5A5A);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(every_box),
        cmocka_unit_test(variance_against_doubles),
        cmocka_unit_test(boxes_that_do_not_fit),
        cmocka_unit_test(what_is_no_integral_image),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("integral", tests, NULL, NULL);
}
