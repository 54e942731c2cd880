/* Thresholds: masks worked out by hand, and brute force in double precision. */
#include "iris/xt/threshold.h"
#include "../test.h"

#define SIDE 80

static uint8_t pixels[SIDE * SIDE];
static uint32_t words[(SIDE / 32 + 1) * SIDE];
static IRIS_SCRATCH_BUFFER(memory, IRIS_THRESHOLD_SCRATCH_BYTES(SIDE, IRIS_THRESHOLD_RADIUS_MAX));

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image gray_image(int32_t w, int32_t h, ptrdiff_t stride)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, pixels, sizeof pixels, (iris_size){w, h}, stride, IRIS_GRAY8),
                     IRIS_OK);
    return image;
}

static iris_image mask_image(int32_t w, int32_t h, uint32_t fill)
{
    iris_image image;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        words[i] = fill;
    }
    assert_int_equal(iris_image_wrap(&image, words, sizeof words, (iris_size){w, h}, 0, IRIS_MASK1), IRIS_OK);
    return image;
}

static int bit(const iris_image *mask, int32_t x, int32_t y)
{
    const uint32_t *row = iris_image_row(mask, y);
    return row[x / 32] >> x % 32 & 1;
}

static int gray_at(const iris_image *gray, int32_t x, int32_t y)
{
    return ((const uint8_t *)iris_image_row(gray, y))[x];
}

/* Every bit from w to the end of the row's last word. */
static void assert_padding(const iris_image *mask, int value)
{
    for (int32_t y = 0; y < mask->h; y++) {
        for (int32_t x = mask->w; x < (mask->w + 31) / 32 * 32; x++) {
            assert_int_equal(bit(mask, x, y), value);
        }
    }
}

static unsigned random_next(void)
{
    static unsigned seed = 12345;
    seed = seed * 1664525u + 1013904223u;
    return seed >> 16;
}

static void fixed_by_hand(void **state)
{
    (void)state;
    iris_image gray = gray_image(4, 2, 0);
    memcpy(pixels, ((uint8_t[]){0, 99, 100, 101, 255, 100, 0, 200}), 8);
    iris_image mask = mask_image(4, 2, 0xFFFFFFF0u);
    assert_int_equal(iris_threshold(&mask, &gray, 100, IRIS_SELECT_BRIGHT), IRIS_OK);
    assert_int_equal(words[0], 0xFFFFFFF8u);
    assert_int_equal(words[1], 0xFFFFFFF9u);
    mask = mask_image(4, 2, 0);
    assert_int_equal(iris_threshold(&mask, &gray, 100, IRIS_SELECT_DARK), IRIS_OK);
    assert_int_equal(words[0], 0x7);
    assert_int_equal(words[1], 0x6);
    assert_int_equal(iris_threshold(&mask, &gray, 255, IRIS_SELECT_BRIGHT), IRIS_OK);
    assert_int_equal(words[0] | words[1], 0);
    assert_int_equal(iris_threshold(&mask, &gray, 0, IRIS_SELECT_BRIGHT), IRIS_OK);
    assert_int_equal(words[0], 0xE);
    assert_int_equal(words[1], 0xB);
}

static void fixed_at_every_width_and_stride(void **state)
{
    (void)state;
    for (int32_t w = 1; w <= 70; w++) {
        for (size_t i = 0; i < sizeof pixels; i++) {
            pixels[i] = (uint8_t)random_next();
        }
        iris_image gray = gray_image(w, 3, w % 2 ? -(w + 5) : w + 5);
        for (int dark = 0; dark < 2; dark++) {
            iris_image mask = mask_image(w, 3, dark ? ~0u : 0u);
            assert_int_equal(iris_threshold(&mask, &gray, 128, dark ? IRIS_SELECT_DARK : IRIS_SELECT_BRIGHT),
                             IRIS_OK);
            for (int32_t i = 0; i < 3 * w; i++) {
                assert_int_equal(bit(&mask, i % w, i / w), (gray_at(&gray, i % w, i / w) > 128) != dark);
            }
            assert_padding(&mask, dark);
        }
    }
}

static void crops_leave_the_rest_alone(void **state)
{
    (void)state;
    memset(pixels, 200, sizeof pixels);
    iris_image gray = gray_image(75, 10, 0), mask = mask_image(75, 10, 0), gray_part, mask_part;
    assert_int_equal(iris_image_crop(&gray_part, &gray, (iris_rect){7, 2, 20, 5}), IRIS_OK);
    assert_int_equal(iris_image_crop(&mask_part, &mask, (iris_rect){32, 3, 20, 5}), IRIS_OK);
    assert_int_equal(iris_threshold(&mask_part, &gray_part, 100, IRIS_SELECT_BRIGHT), IRIS_OK);
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_threshold_adaptive(&mask_part, &gray_part, 2, 1, IRIS_SELECT_BRIGHT, &scratch),
                     IRIS_OK);
    for (int32_t i = 0; i < 96 * 10; i++) {
        int32_t x = i % 96, y = i / 96;
        assert_int_equal(bit(&mask, x, y), x >= 32 && x < 52 && y >= 3 && y < 8);
    }
}

static void otsu_by_hand(void **state)
{
    (void)state;
    uint32_t histogram[256] = {0};
    uint8_t value = 77;
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_ERR_RANGE);
    assert_int_equal(iris_otsu_value(NULL, histogram), IRIS_ERR_ARG);
    assert_int_equal(iris_otsu_value(&value, NULL), IRIS_ERR_ARG);
    assert_int_equal(value, 77);
    histogram[200] = 5;
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_OK);
    assert_int_equal(value, 200);
    histogram[50] = 1; /* 50..199 divide alike: the middle is 124.5 */
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_OK);
    assert_int_equal(value, 124);

    /* The example of many lecture notes: levels 0..5 with these counts are best divided above level 2. */
    const uint32_t lecture[6] = {8, 7, 2, 6, 9, 4};
    memset(histogram, 0, sizeof histogram);
    memcpy(histogram, lecture, sizeof lecture);
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_OK);
    assert_int_equal(value, 2);
}

/* Three levels 0, 100, 200 with counts a, b, c. With a = c the two divisions are equally good: the darker.
 * One pixel more on either side decides, (a + 1)(2a + b)^2 / (a + b) being above a (2a + b + 2)^2 / (a + b +
 * 1). */
static void otsu_is_exact_at_the_largest_counts(void **state)
{
    (void)state;
    const uint32_t many = (uint32_t)1 << 28;
    uint32_t histogram[256] = {0};
    uint8_t value;
    histogram[0] = histogram[100] = histogram[200] = many;
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_OK);
    assert_int_equal(value, 49);
    histogram[0] = many + 1;
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_OK);
    assert_int_equal(value, 49);
    histogram[0] = many;
    histogram[200] = many + 1;
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_OK);
    assert_int_equal(value, 149);

    memset(histogram, 0, sizeof histogram);
    histogram[0] = histogram[255] = 2 * many; /* 2^30: the largest difference there is */
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_OK);
    assert_int_equal(value, 127);
    histogram[9] = 1;
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_ERR_RANGE);
    memset(histogram, 0xFF, sizeof histogram);
    assert_int_equal(iris_otsu_value(&value, histogram), IRIS_ERR_RANGE);
    assert_int_equal(value, 127);
}

static double variance_at(const uint32_t *histogram, int value)
{
    double n[2] = {0, 0}, sum[2] = {0, 0};
    for (int i = 0; i < 256; i++) {
        n[i > value] += histogram[i];
        sum[i > value] += (double)histogram[i] * i;
    }
    double apart = n[0] > 0 && n[1] > 0 ? sum[0] / n[0] - sum[1] / n[1] : 0;
    return n[0] * n[1] * apart * apart;
}

static void otsu_against_doubles(void **state)
{
    (void)state;
    for (int round = 0; round < 300; round++) {
        uint32_t histogram[256] = {0};
        uint8_t value;
        for (int i = 0; i < 1 + round; i++) {
            histogram[round % 3 == 0 ? random_next() % 256 : (random_next() % 40 + random_next() % 40) * 3] +=
                1 + random_next() % 1000 * (round % 5);
        }
        assert_int_equal(iris_otsu_value(&value, histogram), IRIS_OK);
        double best = 0;
        for (int i = 0; i < 256; i++) {
            double here = variance_at(histogram, i);
            best = here > best ? here : best;
        }
        assert_true(variance_at(histogram, value) >= best * (1 - 1e-12));
    }
}

static void otsu_of_an_image(void **state)
{
    (void)state;
    iris_image gray = gray_image(41, 30, 50);
    iris_scratch scratch = arena(IRIS_THRESHOLD_OTSU_SCRATCH_BYTES);
    uint8_t value = 0;
    memset(pixels, 255, sizeof pixels); /* what lies between the rows must not count */
    for (int32_t i = 0; i < 41 * 30; i++) {
        pixels[i / 41 * 50 + i % 41] = (uint8_t)(i % 41 > 20 ? 150 + i % 11 : 60 + i % 17);
    }
    iris_image mask = mask_image(41, 30, 0);
    assert_int_equal(iris_threshold_otsu(&value, &mask, &gray, IRIS_SELECT_DARK, &scratch), IRIS_OK);
    assert_int_equal(value, (76 + 149) / 2);
    for (int32_t i = 0; i < 41 * 30; i++) {
        assert_int_equal(bit(&mask, i % 41, i / 41), i % 41 <= 20);
    }
    assert_int_equal(scratch.used, 0);
    assert_int_equal(iris_threshold_otsu(NULL, &mask, &gray, IRIS_SELECT_BRIGHT, &scratch), IRIS_OK);
    assert_int_equal(bit(&mask, 0, 0), 0);

    scratch = arena(IRIS_THRESHOLD_OTSU_SCRATCH_BYTES - 1);
    mask = mask_image(41, 30, 0x1234);
    value = 9;
    assert_int_equal(iris_threshold_otsu(&value, &mask, &gray, IRIS_SELECT_DARK, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(value, 9);
    assert_int_equal(words[7], 0x1234);
}

/* 3x3 window around the middle of 90 90 90 / 90 x 90 / 90 90 90: the mean is 80 + x / 9. */
static void adaptive_by_hand(void **state)
{
    (void)state;
    const struct {
        uint8_t middle;
        int32_t c;
        int bright;
    } cases[] = {{90, 0, 0},     {91, 0, 1},  {89, 0, 0},  {90, 1, 1}, {90, -1, 0}, {81, 8, 0},    {81, 9, 1},
                 {255, -146, 1}, {99, -8, 0}, {99, -7, 1}, {0, 80, 0}, {0, 81, 1},  {255, -147, 0}};
    iris_image gray = gray_image(3, 3, 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        iris_image mask = mask_image(3, 3, 0);
        iris_scratch scratch = arena(IRIS_THRESHOLD_SCRATCH_BYTES(3, 1));
        memset(pixels, 90, 9);
        pixels[4] = cases[i].middle;
        assert_int_equal(iris_threshold_adaptive(&mask, &gray, 1, cases[i].c, IRIS_SELECT_BRIGHT, &scratch),
                         IRIS_OK);
        assert_int_equal(bit(&mask, 1, 1), cases[i].bright);
        assert_int_equal(iris_threshold_adaptive(&mask, &gray, 1, cases[i].c, IRIS_SELECT_DARK, &scratch),
                         IRIS_OK);
        assert_int_equal(bit(&mask, 1, 1), !cases[i].bright);
    }
}

static int32_t clamp(int32_t value, int32_t high)
{
    return value < 0 ? 0 : value > high ? high : value;
}

static double mean_around(const iris_image *gray, int32_t x, int32_t y, int32_t radius)
{
    double sum = 0;
    for (int32_t v = y - radius; v <= y + radius; v++) {
        for (int32_t u = x - radius; u <= x + radius; u++) {
            sum += gray_at(gray, clamp(u, gray->w - 1), clamp(v, gray->h - 1));
        }
    }
    return sum / ((2.0 * radius + 1) * (2.0 * radius + 1));
}

static void assert_adaptive(const iris_image *gray, int32_t radius, int32_t c, int dark)
{
    iris_image mask = mask_image(gray->w, gray->h, dark ? ~0u : 0u);
    iris_scratch scratch = arena(IRIS_THRESHOLD_SCRATCH_BYTES(gray->w, radius));
    assert_int_equal(iris_threshold_adaptive(&mask, gray, radius, c,
                                             dark ? IRIS_SELECT_DARK : IRIS_SELECT_BRIGHT, &scratch),
                     IRIS_OK);
    assert_int_equal(scratch.used, 0);
    for (int32_t i = 0; i < gray->w * gray->h; i++) {
        double above = gray_at(gray, i % gray->w, i / gray->w) -
                       (mean_around(gray, i % gray->w, i / gray->w, radius) - c);
        assert_int_equal(bit(&mask, i % gray->w, i / gray->w), (above > 1e-9) != dark);
    }
    assert_padding(&mask, dark);
}

static void adaptive_against_doubles(void **state)
{
    (void)state;
    const struct {
        int32_t w, h, radius, c;
    } cases[] = {{1, 1, 0, 0},       {1, 1, 3, -1},   {1, 9, 2, 0},  {9, 1, 2, 0},    {5, 7, 20, 2},
                 {31, 20, 1, 0},     {32, 20, 2, 5},  {33, 9, 7, 3}, {64, 11, 3, -4}, {65, 40, 9, 255},
                 {70, 33, 15, -255}, {23, 50, 11, 7}, {40, 6, 0, 0}, {40, 6, 0, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int kind = 0; kind < 4; kind++) {
            for (size_t k = 0; k < sizeof pixels; k++) {
                unsigned noise = random_next();
                pixels[k] = (uint8_t)(kind == 0   ? noise
                                      : kind == 1 ? noise % 2 * 255
                                      : kind == 2 ? noise % 4 + 100
                                                  : k / 3);
            }
            iris_image gray = gray_image(cases[i].w, cases[i].h, kind % 2 ? -75 : 77);
            assert_adaptive(&gray, cases[i].radius, cases[i].c, kind / 2);
        }
    }
}

/* The largest window: sums reach 255 * 2047^2, and the comparison 510 * 2047^2, just below 2^31. */
static void adaptive_at_the_limits(void **state)
{
    (void)state;
    const int32_t far = IRIS_THRESHOLD_RADIUS_MAX;
    iris_image gray = gray_image(33, 5, 0);
    iris_scratch scratch = arena(sizeof memory);
    for (int dark = 0; dark < 2; dark++) {
        memset(pixels, dark ? 0 : 255, sizeof pixels);
        for (int32_t c = -255; c <= 255; c += 51) {
            iris_image mask = mask_image(33, 5, 0);
            assert_int_equal(iris_threshold_adaptive(&mask, &gray, far, c, IRIS_SELECT_BRIGHT, &scratch),
                             IRIS_OK);
            for (int32_t i = 0; i < 33 * 5; i++) {
                assert_int_equal(bit(&mask, i % 33, i / 33), c > 0);
            }
        }
    }
}

static void a_line_under_uneven_light(void **state)
{
    (void)state;
    iris_image gray = gray_image(80, 40, 0), mask = mask_image(80, 40, 0);
    iris_scratch scratch = arena(IRIS_THRESHOLD_SCRATCH_BYTES(80, 8));
    for (int32_t i = 0; i < 80 * 40; i++) { /* light 60..218 across, the line 30 darker */
        int32_t x = i % 80;
        pixels[i] = (uint8_t)(60 + 2 * x - (x >= 38 && x < 43 ? 30 : 0));
    }
    assert_int_equal(iris_threshold_adaptive(&mask, &gray, 8, 12, IRIS_SELECT_DARK, &scratch), IRIS_OK);
    for (int32_t i = 0; i < 80 * 40; i++) {
        assert_int_equal(bit(&mask, i % 80, i / 80), i % 80 >= 38 && i % 80 < 43);
    }
}

static void scratch_is_exact(void **state)
{
    (void)state;
    iris_image gray = gray_image(37, 8, 0), mask = mask_image(37, 8, 0xABCD);
    iris_scratch scratch = arena(IRIS_THRESHOLD_SCRATCH_BYTES(37, 5) - 1);
    assert_int_equal(IRIS_THRESHOLD_SCRATCH_BYTES(37, 5), 192); /* 47 sums of 4 bytes, in blocks of 16 */
    assert_int_equal(iris_threshold_adaptive(&mask, &gray, 5, 0, IRIS_SELECT_DARK, &scratch),
                     IRIS_ERR_SCRATCH);
    for (int i = 0; i < 16; i++) {
        assert_int_equal(words[i], 0xABCD);
    }
    scratch = arena(IRIS_THRESHOLD_SCRATCH_BYTES(37, 5));
    assert_int_equal(iris_threshold_adaptive(&mask, &gray, 5, 0, IRIS_SELECT_DARK, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, IRIS_THRESHOLD_SCRATCH_BYTES(37, 5));
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_image gray = gray_image(8, 8, 0), mask = mask_image(8, 8, 0x55), bad;
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_threshold(NULL, &gray, 1, IRIS_SELECT_DARK), IRIS_ERR_ARG);
    assert_int_equal(iris_threshold(&mask, NULL, 1, IRIS_SELECT_DARK), IRIS_ERR_ARG);
    assert_int_equal(iris_threshold(&mask, &gray, 1, (iris_select)2), IRIS_ERR_ARG);
    assert_int_equal(iris_threshold(&gray, &mask, 1, IRIS_SELECT_DARK), IRIS_ERR_FORMAT);
    assert_int_equal(iris_threshold(&gray, &gray, 1, IRIS_SELECT_DARK), IRIS_ERR_FORMAT);
    bad = mask;
    bad.w = 7;
    assert_int_equal(iris_threshold(&bad, &gray, 1, IRIS_SELECT_DARK), IRIS_ERR_RANGE);
    bad.w = 0;
    assert_int_equal(iris_threshold(&bad, &gray, 1, IRIS_SELECT_DARK), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_wrap(&bad, words, 64, (iris_size){8, 8}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_threshold(&mask, &bad, 1, IRIS_SELECT_DARK), IRIS_ERR_ALIAS);
    assert_int_equal(iris_threshold_otsu(NULL, &mask, &bad, IRIS_SELECT_DARK, &scratch), IRIS_ERR_ALIAS);
    assert_int_equal(iris_threshold_otsu(NULL, &mask, &gray, IRIS_SELECT_DARK, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_threshold_adaptive(&mask, &gray, 1, 1, IRIS_SELECT_DARK, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_threshold_adaptive(&mask, &gray, -1, 1, IRIS_SELECT_DARK, &scratch),
                     IRIS_ERR_RANGE);
    assert_int_equal(
        iris_threshold_adaptive(&mask, &gray, IRIS_THRESHOLD_RADIUS_MAX + 1, 1, IRIS_SELECT_DARK, &scratch),
        IRIS_ERR_RANGE);
    assert_int_equal(iris_threshold_adaptive(&mask, &gray, 1, 256, IRIS_SELECT_DARK, &scratch),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_threshold_adaptive(&mask, &gray, 1, -256, IRIS_SELECT_DARK, &scratch),
                     IRIS_ERR_RANGE);
    for (int i = 0; i < 16; i++) {
        assert_int_equal(words[i], 0x55);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fixed_by_hand),
        cmocka_unit_test(fixed_at_every_width_and_stride),
        cmocka_unit_test(crops_leave_the_rest_alone),
        cmocka_unit_test(otsu_by_hand),
        cmocka_unit_test(otsu_is_exact_at_the_largest_counts),
        cmocka_unit_test(otsu_against_doubles),
        cmocka_unit_test(otsu_of_an_image),
        cmocka_unit_test(adaptive_by_hand),
        cmocka_unit_test(adaptive_against_doubles),
        cmocka_unit_test(adaptive_at_the_limits),
        cmocka_unit_test(a_line_under_uneven_light),
        cmocka_unit_test(scratch_is_exact),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("threshold", tests, NULL, NULL);
}
