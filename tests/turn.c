/* Turning. Truth: letters turned by hand, and where each pixel must come from. */
#include "iris/turn.h"
#include "test.h"

enum { W = 100, H = 75 };

static uint32_t from[W * H * 2], to[W * H * 2], before[W * H * 2];

static const iris_format formats[] = {
    IRIS_GRAY8,       IRIS_GRAY_S16,    IRIS_GRAY_U16,    IRIS_GRAY_U32,    IRIS_MASK1, IRIS_RGB888,
    IRIS_BGR888,      IRIS_RGBA8888,    IRIS_RGB565,      IRIS_RGB565_SWAP, IRIS_UV88,  IRIS_BAYER8_RGGB,
    IRIS_BAYER8_GRBG, IRIS_BAYER8_GBRG, IRIS_BAYER8_BGGR, IRIS_HSL24,       IRIS_HSL48,
};
enum { FORMATS = sizeof formats / sizeof formats[0] };

static iris_image wrap(void *buffer, size_t bytes, int32_t w, int32_t h, ptrdiff_t stride, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, buffer, bytes, (iris_size){w, h}, stride, format), IRIS_OK);
    return image;
}

static void random_words(uint32_t *words, size_t count, uint32_t seed)
{
    for (size_t i = 0; i < count; i++) {
        seed ^= seed << 13;
        seed ^= seed >> 17;
        seed ^= seed << 5;
        words[i] = seed;
    }
}

static int bit(const iris_image *mask, int32_t x, int32_t y)
{
    const uint32_t *row = iris_image_row(mask, y);
    return row[x / 32] >> (x % 32) & 1;
}

static void letters_by_hand(void **state)
{
    (void)state;
    static const char *const expected[8] = {"abcdef", "cbafed", "defabc", "fedcba",
                                            "adbecf", "daebfc", "cfbead", "fcebda"};
    uint8_t letters[] = "abcdef", turned[] = "......";
    for (int how = 0; how < 8; how++) {
        int32_t w = how < 4 ? 3 : 2, h = 5 - w;
        iris_image src = wrap(letters, 6, 3, 2, 0, IRIS_GRAY8), dst = wrap(turned, 6, w, h, 0, IRIS_GRAY8);
        assert_int_equal(iris_turn(&dst, &src, (iris_turning)how), IRIS_OK);
        assert_string_equal((char *)turned, expected[how]);
    }
}

/* The pixel of src that lies at (x, y) of dst, said for each turning on its own. */
static void source_of(int32_t *u, int32_t *v, const iris_image *src, iris_turning turning, int32_t x,
                      int32_t y)
{
    int32_t right = src->w - 1, bottom = src->h - 1;
    const int32_t us[8] = {x, right - x, x, right - x, y, y, right - y, right - y};
    const int32_t vs[8] = {y, y, bottom - y, bottom - y, x, bottom - x, x, bottom - x};
    *u = us[turning];
    *v = vs[turning];
}

static void assert_turned(const iris_image *dst, const iris_image *src, iris_turning turning)
{
    size_t bytes = iris_format_row_bytes(src->format, 1);
    for (int32_t y = 0; y < dst->h; y++) {
        for (int32_t x = 0; x < dst->w; x++) {
            int32_t u, v;
            source_of(&u, &v, src, turning, x, y);
            if (src->format == IRIS_MASK1) {
                assert_int_equal(bit(dst, x, y), bit(src, u, v));
            } else {
                assert_memory_equal((uint8_t *)iris_image_row(dst, y) + (size_t)x * bytes,
                                    (uint8_t *)iris_image_row(src, v) + (size_t)u * bytes, bytes);
            }
        }
    }
}

/* Everything of `to` that is not a pixel of dst is as it was. */
static void assert_rest_kept(const iris_image *dst)
{
    iris_image old = *dst;
    old.data = (uint8_t *)before + ((uint8_t *)dst->data - (uint8_t *)to);
    size_t bytes = iris_format_row_bytes(dst->format, dst->w);
    for (int32_t y = 0; y < dst->h; y++) {
        if (dst->format == IRIS_MASK1) {
            for (int32_t x = 0; x < dst->w; x++) {
                uint32_t *row = iris_image_row(&old, y);
                row[x / 32] = (row[x / 32] & ~((uint32_t)1 << x % 32)) | (uint32_t)bit(dst, x, y) << x % 32;
            }
        } else {
            memcpy(iris_image_row(&old, y), iris_image_row(dst, y), bytes);
        }
    }
    assert_memory_equal(to, before, sizeof to);
}

static void every_turning_of_every_format(void **state)
{
    (void)state;
    const iris_size sizes[] = {{1, 1},  {1, 7},  {9, 1},  {2, 2},   {31, 3},  {32, 5}, {33, 32},
                               {65, 9}, {64, 4}, {3, 70}, {40, 33}, {97, 41}, {96, 64}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (int f = 0; f < FORMATS; f++) {
            for (int how = 0; how < 8; how++) {
                random_words(from, W * H * 2, (uint32_t)(s * 100 + (size_t)f * 8 + 7));
                random_words(to, W * H * 2, 3);
                memcpy(before, to, sizeof to);
                iris_turning turning = (iris_turning)how;
                int32_t w = how < 4 ? sizes[s].w : sizes[s].h, h = how < 4 ? sizes[s].h : sizes[s].w;
                ptrdiff_t pad = (ptrdiff_t)(iris_format_row_bytes(formats[f], w) + 7) / 4 * 4;
                iris_image src =
                    wrap(from, sizeof from, sizes[s].w, sizes[s].h, how % 3 ? 0 : -604, formats[f]);
                iris_image dst = wrap(to, sizeof to, w, h, how % 2 ? -pad : pad,
                                      iris_turn_format(formats[f], sizes[s], turning));
                assert_int_equal(iris_turn(&dst, &src, turning), IRIS_OK);
                assert_turned(&dst, &src, turning);
                assert_rest_kept(&dst);
            }
        }
    }
}

static void in_place(void **state)
{
    (void)state;
    const iris_size sizes[] = {{1, 1}, {1, 6}, {7, 1}, {31, 3}, {32, 4}, {33, 5}, {64, 2}, {95, 7}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (int f = 0; f < FORMATS; f++) {
            for (int how = 0; how < 4; how++) {
                random_words(to, W * H * 2, (uint32_t)(s * 100 + (size_t)f * 8 + 5));
                memcpy(before, to, sizeof to);
                memcpy(from, to, sizeof to);
                ptrdiff_t stride = how % 2 ? -600 : 600;
                iris_image src = wrap(from, sizeof from, sizes[s].w, sizes[s].h, stride, formats[f]);
                iris_image dst = wrap(to, sizeof to, sizes[s].w, sizes[s].h, stride, formats[f]), same = dst;
                dst.format = iris_turn_format(formats[f], sizes[s], (iris_turning)how);
                assert_int_equal(iris_turn(&dst, &same, (iris_turning)how), IRIS_OK);
                assert_turned(&dst, &src, (iris_turning)how);
                assert_rest_kept(&dst);
            }
        }
    }
}

static void regions_at_odd_offsets(void **state)
{
    (void)state;
    random_words(from, W * H * 2, 1);
    random_words(to, W * H * 2, 2);
    memcpy(before, to, sizeof to);
    iris_image whole = wrap(from, sizeof from, W, H, 0, IRIS_RGB888), src, dst;
    iris_image canvas = wrap(to, sizeof to, W, H, 0, IRIS_RGB888);
    assert_int_equal(iris_image_crop(&src, &whole, (iris_rect){13, 7, 41, 23}), IRIS_OK);
    for (int how = 0; how < 8; how++) {
        iris_rect rect = {11, 5, how < 4 ? 41 : 23, how < 4 ? 23 : 41};
        assert_int_equal(iris_image_crop(&dst, &canvas, rect), IRIS_OK);
        assert_int_equal(iris_turn(&dst, &src, (iris_turning)how), IRIS_OK);
        assert_turned(&dst, &src, (iris_turning)how);
        assert_rest_kept(&dst);
    }
}

/* What the filter of each new pixel is, against what it was where the pixel came from. */
static void bayer_orders(void **state)
{
    (void)state;
    const char *const letters[] = {"RGGB", "GRBG", "GBRG", "BGGR"};
    for (int order = 0; order < 4; order++) {
        for (int how = 0; how < 8; how++) {
            for (int32_t w = 1; w < 5; w++) {
                for (int32_t h = 1; h < 5; h++) {
                    iris_image src = wrap(from, sizeof from, w, h, 0, IRIS_GRAY8);
                    int made = (int)iris_turn_format((iris_format)(IRIS_BAYER8_RGGB + order),
                                                     (iris_size){w, h}, (iris_turning)how) -
                               IRIS_BAYER8_RGGB;
                    assert_in_range(made, 0, 3);
                    for (int32_t i = 0; i < w * h; i++) {
                        int32_t x = i % (how < 4 ? w : h), y = i / (how < 4 ? w : h), u, v;
                        source_of(&u, &v, &src, (iris_turning)how, x, y);
                        assert_int_equal(letters[made][y % 2 * 2 + x % 2], letters[order][v % 2 * 2 + u % 2]);
                    }
                }
            }
        }
    }
    assert_int_equal(iris_turn_format(IRIS_RGB888, (iris_size){4, 4}, IRIS_TURN_90), IRIS_RGB888);
}

static void rows_of_pairs_are_only_exchanged(void **state)
{
    (void)state;
    const iris_format pairs[] = {IRIS_YUYV, IRIS_UYVY};
    for (int f = 0; f < 2; f++) {
        random_words(from, W * H * 2, 1);
        random_words(to, W * H * 2, 2);
        memcpy(before, to, sizeof to);
        iris_image src = wrap(from, sizeof from, 8, 8, 0, pairs[f]),
                   dst = wrap(to, sizeof to, 8, 8, 0, pairs[f]);
        for (int how = 0; how < 8; how++) {
            int kept = how == IRIS_TURN_NONE || how == IRIS_FLIP_VERTICAL;
            if (!kept) {
                assert_int_equal(iris_turn(&dst, &src, (iris_turning)how), IRIS_ERR_FORMAT);
            }
        }
        assert_memory_equal(to, before, sizeof to);
        assert_int_equal(iris_turn(&dst, &src, IRIS_FLIP_VERTICAL), IRIS_OK);
        for (int32_t y = 0; y < 8; y++) {
            assert_memory_equal(iris_image_row(&dst, y), iris_image_row(&src, 7 - y), 16);
        }
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    random_words(from, W * H * 2, 1);
    random_words(to, W * H * 2, 2);
    memcpy(before, to, sizeof to);
    iris_image src = wrap(from, sizeof from, 9, 5, 0, IRIS_GRAY8),
               dst = wrap(to, sizeof to, 9, 5, 0, IRIS_GRAY8);
    iris_image across = wrap(to, sizeof to, 5, 9, 0, IRIS_GRAY8), bad = dst;
    assert_int_equal(iris_turn(NULL, &src, IRIS_TURN_180), IRIS_ERR_ARG);
    assert_int_equal(iris_turn(&dst, NULL, IRIS_TURN_180), IRIS_ERR_ARG);
    assert_int_equal(iris_turn(&dst, &src, (iris_turning)8), IRIS_ERR_ARG);
    assert_int_equal(iris_turn(&dst, &src, (iris_turning)-1), IRIS_ERR_ARG);
    assert_int_equal(iris_turn(&dst, &src, IRIS_TURN_90), IRIS_ERR_RANGE);
    assert_int_equal(iris_turn(&across, &src, IRIS_TURN_180), IRIS_ERR_RANGE);
    bad.format = IRIS_BAYER8_RGGB;
    assert_int_equal(iris_turn(&bad, &src, IRIS_TURN_180), IRIS_ERR_FORMAT);
    bad.w = 0;
    assert_int_equal(iris_turn(&bad, &src, IRIS_TURN_180), IRIS_ERR_ARG);
    iris_image odd = wrap(from, sizeof from, 8, 5, 0, IRIS_BAYER8_RGGB),
               same = wrap(to, sizeof to, 8, 5, 0, IRIS_BAYER8_RGGB);
    assert_int_equal(iris_turn(&same, &odd, IRIS_FLIP_HORIZONTAL), IRIS_ERR_FORMAT);
    iris_image part, image = wrap(to, sizeof to, 10, 10, 0, IRIS_GRAY8), square, turned;
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){1, 1, 9, 5}), IRIS_OK);
    assert_int_equal(iris_image_crop(&square, &image, (iris_rect){0, 0, 9, 5}), IRIS_OK);
    assert_int_equal(iris_turn(&part, &square, IRIS_TURN_180), IRIS_ERR_ALIAS);
    assert_int_equal(iris_turn(&image, &image, IRIS_TRANSPOSE), IRIS_ERR_ALIAS);
    turned = wrap(to, sizeof to, 10, 10, -10, IRIS_GRAY8);
    assert_int_equal(iris_turn(&turned, &image, IRIS_FLIP_VERTICAL), IRIS_ERR_ALIAS);
    assert_memory_equal(to, before, sizeof to);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_by_hand),
        cmocka_unit_test(every_turning_of_every_format),
        cmocka_unit_test(in_place),
        cmocka_unit_test(regions_at_odd_offsets),
        cmocka_unit_test(bayer_orders),
        cmocka_unit_test(rows_of_pairs_are_only_exchanged),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("turn", tests, NULL, NULL);
}
