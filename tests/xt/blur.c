/* Blurs: against double precision with all of the bell curve, on real pictures and on the worst there are. */
#include "iris/xt/blur.h"

#include <math.h>

#include "../picture.h"

#define SIDE    96
#define REACH   400 /* ten times the largest sigma */
#define PADDING 13

static uint8_t source[4 * SIDE * SIDE], result[4 * SIDE * SIDE], before[4 * SIDE * SIDE];
static double middle[SIDE][3 * SIDE], expected[SIDE][3 * SIDE];
static IRIS_SCRATCH_BUFFER(memory, IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(SIDE, 3, IRIS_BLUR_SIGMA_MAX));

static const iris_border borders[] = {{IRIS_BORDER_REPLICATE, 0},
                                      {IRIS_BORDER_REFLECT101, 0},
                                      {IRIS_BORDER_CONSTANT, 200},
                                      {IRIS_BORDER_SKIP, 0}};

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

/* A view at an odd address; odd rows longer than needed; upside down when h is odd. */
static iris_image view(uint8_t *pixels, int32_t w, int32_t h, iris_format format)
{
    iris_image image;
    ptrdiff_t stride = (ptrdiff_t)iris_format_row_bytes(format, w) + PADDING;
    assert_int_equal(iris_image_wrap(&image, pixels + 3, 4 * SIDE * SIDE - 3, (iris_size){w, h},
                                     h % 2 ? -stride : stride, format),
                     IRIS_OK);
    return image;
}

static uint8_t *at(const iris_image *image, int32_t i, int32_t y)
{
    return (uint8_t *)iris_image_row(image, y) + i;
}

/* What stands for position i of n, by walking; -1: the constant. */
static int place(int i, int n, iris_border_rule rule)
{
    while (i < 0 || i >= n) {
        if (rule == IRIS_BORDER_CONSTANT) {
            return -1;
        }
        if (rule != IRIS_BORDER_REFLECT101 || n == 1) {
            return i < 0 ? 0 : n - 1;
        }
        i = i < 0 ? -i : 2 * (n - 1) - i;
    }
    return i;
}

static void gaussian_in_doubles(const iris_image *src, double sigma, iris_border border)
{
    static double weight[REACH + 1];
    int channels = src->format == IRIS_GRAY8 ? 1 : 3, reach = (int)(10 * sigma) + 1;
    double sum = 0;
    for (int k = 0; k <= reach && k <= REACH; k++) {
        weight[k] = exp(-k * k / (2 * sigma * sigma));
        sum += k ? 2 * weight[k] : 1;
    }
    for (int y = 0; y < src->h; y++) {
        for (int i = 0; i < src->w * channels; i++) {
            middle[y][i] = 0;
            for (int k = -reach; k <= reach; k++) {
                int x = place(i / channels + k, src->w, border.rule);
                double pixel = x < 0 ? border.value : *at(src, x * channels + i % channels, y);
                middle[y][i] += weight[abs(k)] / sum * pixel;
            }
        }
    }
    for (int y = 0; y < src->h; y++) {
        for (int i = 0; i < src->w * channels; i++) {
            expected[y][i] = 0;
            for (int k = -reach; k <= reach; k++) {
                int row = place(y + k, src->h, border.rule);
                expected[y][i] += weight[abs(k)] / sum * (row < 0 ? border.value : middle[row][i]);
            }
        }
    }
}

/* Blurs both ways; the largest error; what SKIP leaves out and what is not dst's is as before. */
static double gaussian_error(const iris_image *src, iris_q16 sigma, iris_border border)
{
    int channels = src->format == IRIS_GRAY8 ? 1 : 3, radius = IRIS_BLUR_RADIUS(sigma);
    size_t bytes = IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(src->w, channels, sigma);
    iris_scratch scratch = arena(bytes);
    iris_image dst = view(result, src->w, src->h, src->format),
               old = view(before, src->w, src->h, src->format);
    uint32_t seed = 99;
    for (size_t i = 0; i < sizeof result; i++) {
        result[i] = before[i] = (uint8_t)next_random(&seed);
    }
    assert_int_equal(iris_blur_gaussian(&dst, src, sigma, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, bytes);
    assert_int_equal(scratch.used, 0);
    gaussian_in_doubles(src, sigma / 65536.0, border);
    double worst = 0;
    for (int y = 0; y < src->h; y++) {
        for (int i = 0; i < src->w * channels; i++) {
            int x = i / channels;
            if (border.rule == IRIS_BORDER_SKIP &&
                (x < radius || y < radius || x >= src->w - radius || y >= src->h - radius)) {
                assert_int_equal(*at(&dst, i, y), *at(&old, i, y));
                continue;
            }
            worst = fmax(worst, fabs(*at(&dst, i, y) - floor(expected[y][i] + 0.5)));
            *at(&old, i, y) = *at(&dst, i, y);
        }
    }
    assert_memory_equal(result, before, sizeof result);
    return worst;
}

/* Part of a real picture, 0 when it is missing. */
static int load(const iris_image *image, const char *name, int32_t x, int32_t y)
{
    picture from = load_pnm(data_path(name));
    if (!from.pixels) {
        print_message("%s is missing\n", name);
        return 0;
    }
    int channels = image->format == IRIS_GRAY8 ? 1 : 3;
    assert_true(x + image->w <= from.w && y + image->h <= from.h);
    for (int32_t row = 0; row < image->h; row++) {
        for (int32_t i = 0; i < image->w * channels; i++) {
            int32_t from_x = x + i / channels, shift = 40 * (i % channels);
            from_x = (from_x + shift) % from.w; /* three channels that differ */
            *at(image, i, row) = from.pixels[((y + row) * from.w + from_x) * from.channels];
        }
    }
    free(from.pixels);
    return 1;
}

static void gaussian_of_real_pictures(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int32_t x, y;
    } part[] = {{"edges/bsds/69007.pgm", 190, 110},
                {"edges/classic/camera_256.pgm", 90, 60},
                {"edges/classic/moon_256.pgm", 100, 100},
                {"stereo/cones/left.pgm", 210, 133}};
    double sigma = 0.1;
    for (int i = 0; sigma < 40; i++) {
        iris_format format = i % 3 == 2 ? IRIS_RGB888 : IRIS_GRAY8;
        int32_t w = format == IRIS_GRAY8 ? SIDE - 1 : 41,
                h = sigma < 3 && format == IRIS_GRAY8 ? SIDE - i % 2 : 43;
        iris_image src = view(source, w, h, format);
        if (!load(&src, part[i % 4].name, part[i % 4].x, part[i % 4].y)) {
            skip();
        }
        iris_q16 sigma_q16 = (iris_q16)(sigma * 65536 + 0.5);
        assert_true(gaussian_error(&src, sigma_q16, borders[i / 3 % 4]) <= 1);
        sigma *= sigma < 4 ? 1.06 : 1.19;
    }
}

/* Every rule with every kind of size, also windows larger than the picture. */
static void gaussian_of_odd_sizes(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1}, {1, 9}, {9, 1}, {2, 3}, {7, 5}, {33, 18}, {65, 3}, {3, 64}};
    static const double sigmas[] = {0.1, 0.3, 0.8, 1.1, 1.4, 2.5, 7.3};
    uint32_t seed = 5;
    for (size_t i = 0; i < sizeof source; i++) {
        source[i] = (uint8_t)next_random(&seed);
    }
    for (int s = 0; s < 8; s++) {
        for (int b = 0; b < 4; b++) {
            for (int k = 0; k < 7; k++) {
                iris_format format = k % 3 == 0 ? IRIS_BGR888 : IRIS_GRAY8;
                iris_image src = view(source, sizes[s].w, sizes[s].h, format);
                assert_true(gaussian_error(&src, (iris_q16)(sigmas[k] * 65536 + 0.5), borders[b]) <= 1);
            }
        }
    }
}

/* Black within the radius and white without, and the other way round: all that is cut off counts in full. */
static void gaussian_of_the_worst_pictures(void **state)
{
    (void)state;
    static const double sigmas[] = {0.2, 0.5, 0.6, 0.8, 0.81, 1.1, 1.4, 1.7, 1.71, 2, 3, 5, 8, 11};
    for (size_t s = 0; s < sizeof sigmas / sizeof sigmas[0]; s++) {
        iris_q16 sigma = (iris_q16)(sigmas[s] * 65536);
        int radius = IRIS_BLUR_RADIUS(sigma);
        iris_image src = view(source, SIDE, SIDE, IRIS_GRAY8);
        for (int inside = 0; inside <= 255; inside += 255) {
            for (int i = 0; i < SIDE * SIDE; i++) {
                int x = i % SIDE - SIDE / 2, y = i / SIDE - SIDE / 2;
                *at(&src, i % SIDE, i / SIDE) =
                    (uint8_t)(abs(x) <= radius && abs(y) <= radius ? inside : 255 - inside);
            }
            assert_true(gaussian_error(&src, sigma, borders[0]) <= 1);
        }
    }
}

static void gaussian_keeps_even_areas(void **state)
{
    (void)state;
    for (iris_q16 sigma = IRIS_BLUR_SIGMA_MIN; sigma <= IRIS_BLUR_SIGMA_MAX; sigma += sigma / 5) {
        for (int level = 0; level <= 255; level += 51) {
            memset(source, level, sizeof source);
            iris_image image = view(source, 20, 9, IRIS_GRAY8);
            iris_scratch scratch = arena(sizeof memory);
            assert_int_equal(iris_blur_gaussian(&image, &image, sigma, borders[1], &scratch), IRIS_OK);
            for (size_t i = 0; i < 1000; i++) {
                assert_int_equal(source[i], level);
            }
        }
    }
}

static void gaussian_in_place(void **state)
{
    (void)state;
    uint32_t seed = 7;
    for (int b = 0; b < 4; b++) {
        for (int32_t h = 1; h < 40; h += 6) {
            for (size_t i = 0; i < sizeof source; i++) {
                source[i] = result[i] = (uint8_t)next_random(&seed);
            }
            iris_image src = view(source, 31, h, IRIS_RGB888), dst = view(result, 31, h, IRIS_RGB888);
            iris_scratch scratch = arena(sizeof memory);
            iris_q16 sigma = 65536 * h / 10 + 30000;
            assert_int_equal(iris_blur_gaussian(&dst, &src, sigma, borders[b], &scratch), IRIS_OK);
            assert_int_equal(iris_blur_gaussian(&src, &src, sigma, borders[b], &scratch), IRIS_OK);
            for (int32_t y = 0; y < h; y++) {
                assert_memory_equal(at(&src, 0, y), at(&dst, 0, y), 93);
            }
        }
    }
}

/* The weights of 5 taps by hand: exp(-1 / 1.28) and exp(-4 / 1.28) of 1 + 2 (0.457833 + 0.043937) are 0.499116,
 * 0.228511 and 0.021930 of it all. */
static void gaussian_by_hand(void **state)
{
    (void)state;
    memset(source, 0, sizeof source);
    iris_image src = view(source, 9, 9, IRIS_GRAY8), dst = view(result, 9, 9, IRIS_GRAY8);
    *at(&src, 4, 4) = 255;
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_blur_gaussian(&dst, &src, 52428, borders[0], &scratch), IRIS_OK);
    static const uint8_t row4[9] = {0, 0, 3, 29, 64, 29, 3, 0, 0}, row5[9] = {0, 0, 1, 13, 29, 13, 1, 0, 0},
                         row6[9] = {0, 0, 0, 1, 3, 1, 0, 0, 0};
    assert_memory_equal(at(&dst, 0, 4), row4, 9);
    assert_memory_equal(at(&dst, 0, 3), row5, 9);
    assert_memory_equal(at(&dst, 0, 5), row5, 9);
    assert_memory_equal(at(&dst, 0, 6), row6, 9);
    assert_int_equal(IRIS_BLUR_RADIUS(13107), 0);
    assert_int_equal(IRIS_BLUR_RADIUS(32768), 1);
    assert_int_equal(IRIS_BLUR_RADIUS(52428), 2);
    assert_int_equal(IRIS_BLUR_RADIUS(72089), 3);
    assert_int_equal(IRIS_BLUR_RADIUS(IRIS_BLUR_SIGMA_MAX), 133);
}

/* The mean of a window in whole numbers, half up. */
static int mean_at(const iris_image *src, int i, int y, int side, iris_border border)
{
    int channels = src->format == IRIS_GRAY8 ? 1 : 3, sum = 0;
    for (int dy = 0; dy < side; dy++) {
        int row = place(y - (side - 1) / 2 + dy, src->h, border.rule);
        for (int dx = 0; dx < side; dx++) {
            int x = place(i / channels - (side - 1) / 2 + dx, src->w, border.rule);
            sum += x < 0 || row < 0 ? border.value : *at(src, x * channels + i % channels, row);
        }
    }
    return (int)floor((double)sum / (side * side) + 0.5);
}

static void box_is_the_mean(const iris_image *src, int side, iris_border border, int in_place)
{
    int channels = src->format == IRIS_GRAY8 ? 1 : 3, left = (side - 1) / 2, right = side / 2;
    size_t bytes = IRIS_BLUR_BOX_SCRATCH_BYTES(src->w, channels, side);
    iris_scratch scratch = arena(bytes);
    memcpy(result, source, sizeof result);
    iris_image dst = view(result, src->w, src->h, src->format);
    assert_int_equal(iris_blur_box(&dst, in_place ? &dst : src, side, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, bytes);
    assert_int_equal(scratch.used, 0);
    memcpy(before, source, sizeof before);
    iris_image old = view(before, src->w, src->h, src->format);
    for (int y = 0; y < src->h; y++) {
        for (int i = 0; i < src->w * channels; i++) {
            int x = i / channels;
            if (border.rule != IRIS_BORDER_SKIP ||
                (x >= left && y >= left && x < src->w - right && y < src->h - right)) {
                *at(&old, i, y) = (uint8_t)mean_at(src, i, y, side, border);
            }
        }
    }
    assert_memory_equal(result, before, sizeof result);
}

static void box_against_sums(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1}, {1, 9}, {9, 1}, {2, 3}, {17, 12}, {33, 19}};
    static const int sides[] = {1, 2, 3, 4, 5, 6, 7, 10, 15, 31, 64};
    uint32_t seed = 3;
    for (size_t i = 0; i < sizeof source; i++) {
        source[i] = (uint8_t)next_random(&seed);
    }
    for (int s = 0; s < 6; s++) {
        for (int b = 0; b < 4; b++) {
            for (int k = 0; k < 11; k++) {
                iris_image src = view(source, sizes[s].w, sizes[s].h, (k + s) % 3 ? IRIS_GRAY8 : IRIS_RGB888);
                box_is_the_mean(&src, sides[k], borders[b], (s + k + b) % 2);
            }
        }
    }
}

/* Around the half between two levels, for every side: columns of the one and of the other in almost equal parts. */
static void box_divides_exactly(void **state)
{
    (void)state;
    static uint8_t column[4 * SIDE * SIDE];
    for (int side = 1; side <= IRIS_BLUR_SIDE_MAX; side++) {
        iris_image src = view(column, side, 3, IRIS_GRAY8), dst = view(result, side, 3, IRIS_GRAY8);
        for (int level = 0; level < 255; level += 1 + side / 4) {
            for (int more = -1; more <= 1; more++) {
                int ones = (side + 1) / 2 + more;
                for (int y = 0; y < 3; y++) {
                    memset(at(&src, 0, y), level, (size_t)side);
                    memset(at(&src, 0, y), level + 1, (size_t)(ones < 0 ? 0 : ones > side ? side : ones));
                }
                iris_scratch scratch = arena(sizeof memory);
                assert_int_equal(iris_blur_box(&dst, &src, side, borders[0], &scratch), IRIS_OK);
                int x = (side - 1) / 2;
                ones = ones < 0 ? 0 : ones > side ? side : ones;
                assert_int_equal(*at(&dst, x, 1), level + (2 * ones >= side));
            }
        }
        memset(column, 255, sizeof column);
        iris_scratch scratch = arena(sizeof memory);
        assert_int_equal(iris_blur_box(&dst, &src, side, borders[0], &scratch), IRIS_OK);
        assert_int_equal(*at(&dst, 0, 0), 255);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    memset(source, 1, sizeof source);
    memset(result, 2, sizeof result);
    iris_image src = view(source, 20, 20, IRIS_GRAY8), dst = view(result, 20, 20, IRIS_GRAY8), bad = dst;
    iris_scratch scratch = arena(sizeof memory);
    iris_border border = {0};
    assert_int_equal(iris_blur_gaussian(NULL, &src, 65536, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blur_gaussian(&dst, NULL, 65536, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blur_gaussian(&dst, &src, 65536, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_blur_gaussian(&dst, &src, 65536, (iris_border){4, 0}, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blur_gaussian(&dst, &src, IRIS_BLUR_SIGMA_MIN - 1, border, &scratch),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_blur_gaussian(&dst, &src, IRIS_BLUR_SIGMA_MAX + 1, border, &scratch),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_blur_gaussian(&dst, &src, INT32_MIN, border, &scratch), IRIS_ERR_RANGE);
    bad.w = 19;
    assert_int_equal(iris_blur_gaussian(&bad, &src, 65536, border, &scratch), IRIS_ERR_RANGE);
    bad = view(result, 20, 20, IRIS_RGB888);
    assert_int_equal(iris_blur_gaussian(&bad, &src, 65536, border, &scratch), IRIS_ERR_FORMAT);
    bad = view(result, 20, 20, IRIS_HSL24);
    assert_int_equal(iris_blur_gaussian(&bad, &bad, 65536, border, &scratch), IRIS_ERR_FORMAT);
    bad = src;
    bad.data = at(&src, 1, 0);
    assert_int_equal(iris_blur_gaussian(&bad, &src, 65536, border, &scratch), IRIS_ERR_ALIAS);
    bad.data = NULL;
    assert_int_equal(iris_blur_gaussian(&bad, &src, 65536, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blur_box(NULL, &src, 3, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blur_box(&dst, &src, 3, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_blur_box(&dst, &src, 0, border, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_blur_box(&dst, &src, IRIS_BLUR_SIDE_MAX + 1, border, &scratch), IRIS_ERR_RANGE);
    for (int side = 1; side < 9; side++) {
        scratch = arena(IRIS_BLUR_BOX_SCRATCH_BYTES(20, 1, side) - 1);
        assert_int_equal(iris_blur_box(&dst, &src, side, border, &scratch), IRIS_ERR_SCRATCH);
        assert_int_equal(scratch.used, 0);
    }
    for (iris_q16 sigma = 65536; sigma < 3 * 65536; sigma += 32768) { /* weights in other units above 1.7 */
        scratch = arena(IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(20, 1, sigma) - 1);
        assert_int_equal(iris_blur_gaussian(&dst, &src, sigma, border, &scratch), IRIS_ERR_SCRATCH);
        assert_int_equal(scratch.used, 0);
    }
    for (size_t i = 0; i < sizeof result; i++) {
        assert_int_equal(result[i], 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaussian_by_hand),          cmocka_unit_test(gaussian_of_real_pictures),
        cmocka_unit_test(gaussian_of_odd_sizes),     cmocka_unit_test(gaussian_of_the_worst_pictures),
        cmocka_unit_test(gaussian_keeps_even_areas), cmocka_unit_test(gaussian_in_place),
        cmocka_unit_test(box_against_sums),          cmocka_unit_test(box_divides_exactly),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("blur", tests, NULL, NULL);
}
