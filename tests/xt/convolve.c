/* Convolution: against sums in 64 bits for matrices of all kinds; the generators against their formulas in doubles. */
#include "iris/xt/convolve.h"

#include <math.h>

#include "../picture.h"

#define SIDE 60

static uint8_t source[6 * SIDE * SIDE], result[6 * SIDE * SIDE], expected[6 * SIDE * SIDE];
static int32_t values[IRIS_KERNEL_SIDE_MAX * IRIS_KERNEL_SIDE_MAX];
static IRIS_SCRATCH_BUFFER(memory,
                           IRIS_CONVOLVE_SCRATCH_BYTES(SIDE, 3, IRIS_KERNEL_SIDE_MAX, IRIS_KERNEL_SIDE_MAX));
static uint32_t seed = 17;

static int between(int low, int high)
{
    return low + (int)(next_random(&seed) % (unsigned)(high - low + 1));
}

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

/* Longer rows than needed, upside down when h is odd. */
static iris_image view(uint8_t *pixels, int32_t w, int32_t h, iris_format format)
{
    iris_image image;
    ptrdiff_t stride = (ptrdiff_t)iris_format_row_bytes(format, w) + 6;
    assert_int_equal(iris_image_wrap(&image, pixels + 2, sizeof source - 2, (iris_size){w, h},
                                     h % 2 ? -stride : stride, format),
                     IRIS_OK);
    return image;
}

static uint8_t *at(const iris_image *image, int32_t i, int32_t y)
{
    return (uint8_t *)iris_image_row(image, y) + i;
}

static int channels_of(const iris_image *image)
{
    return image->format == IRIS_GRAY8 || image->format == IRIS_GRAY_S16 ? 1 : 3;
}

static int64_t floor_divide(int64_t a, int64_t b)
{
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

static int64_t value_at(const iris_image *src, int i, int y, const iris_kernel *k, int turned,
                        iris_border border)
{
    int channels = channels_of(src);
    int64_t sum = 0;
    for (int r = 0; r < k->rows; r++) {
        int row = iris_border_index(y - (k->rows - 1) / 2 + r, src->h, border.rule);
        for (int c = 0; c < k->columns; c++) {
            int column = iris_border_index(i / channels - (k->columns - 1) / 2 + c, src->w, border.rule);
            int pixel =
                row < 0 || column < 0 ? border.value : *at(src, column * channels + i % channels, row);
            int index = r * k->columns + c;
            sum += (int64_t)pixel * k->values[turned ? k->rows * k->columns - 1 - index : index];
        }
    }
    int64_t value = floor_divide(2 * sum + k->divisor, 2 * (int64_t)k->divisor) + k->bias;
    return k->absolute && value < 0 ? -value : value;
}

static int64_t limit(int64_t value, int64_t low, int64_t high)
{
    return value < low ? low : value > high ? high : value;
}

static void set_expected(const iris_image *dst, const iris_image *src, const iris_kernel *k, int turned,
                         iris_border border)
{
    int channels = channels_of(src);
    for (int y = 0; y < src->h; y++) {
        for (int i = 0; i < src->w * channels; i++) {
            int x = i / channels;
            if (border.rule == IRIS_BORDER_SKIP &&
                (x < (k->columns - 1) / 2 || y < (k->rows - 1) / 2 || x >= src->w - k->columns / 2 ||
                 y >= src->h - k->rows / 2)) {
                continue;
            }
            int64_t value = value_at(src, i, y, k, turned, border);
            if (dst->format == IRIS_GRAY_S16) {
                int16_t half = (int16_t)limit(value, -32768, 32767);
                memcpy(at(dst, 2 * i, y), &half, 2);
            } else if (dst->format == IRIS_HSL24 && i % 3 != 2) {
                *at(dst, i, y) = *at(src, i, y);
            } else {
                *at(dst, i, y) = (uint8_t)limit(value, 0, 255);
            }
        }
    }
}

static void check(const iris_image *src, iris_format format, const iris_kernel *k, iris_border border)
{
    for (int turned = 0; turned < 2; turned++) {
        int in_place = format == src->format && between(0, 1);
        size_t bytes = IRIS_CONVOLVE_SCRATCH_BYTES(src->w, src->format == IRIS_HSL24 ? 1 : channels_of(src),
                                                   k->rows, k->columns);
        iris_scratch scratch = arena(bytes);
        memcpy(result, source, sizeof result);
        memcpy(expected, source, sizeof expected);
        iris_image dst = view(result, src->w, src->h, format),
                   wanted = view(expected, src->w, src->h, format);
        set_expected(&wanted, src, k, turned, border);
        assert_int_equal(
            (turned ? iris_convolve : iris_correlate)(&dst, in_place ? &dst : src, k, border, &scratch),
            IRIS_OK);
        assert_int_equal(scratch.peak, bytes);
        assert_int_equal(scratch.used, 0);
        assert_memory_equal(result, expected, sizeof result);
    }
}

static void fill_source(void)
{
    int kind = between(0, 3);
    for (size_t i = 0; i < sizeof source; i++) {
        source[i] = (uint8_t)(kind == 0 ? 255 * between(0, 1) : between(0, 255));
    }
}

static iris_image any_source(iris_format *dst_format)
{
    static const iris_format formats[][2] = {{IRIS_GRAY8, IRIS_GRAY8},
                                             {IRIS_GRAY8, IRIS_GRAY_S16},
                                             {IRIS_RGB888, IRIS_RGB888},
                                             {IRIS_BGR888, IRIS_BGR888},
                                             {IRIS_HSL24, IRIS_HSL24}};
    const iris_format *format = formats[between(0, 4)];
    *dst_format = format[1];
    fill_source();
    int thin = between(0, 5);
    return view(source, thin == 0 ? 1 : between(1, 40), thin == 1 ? 1 : between(1, 14), format[0]);
}

static iris_border any_border(void)
{
    return (iris_border){(iris_border_rule)between(0, 3), (uint8_t)between(0, 255)};
}

static int32_t any_divisor(void)
{
    static const int32_t divisors[] = {1,    2,     3,     16,    9,     255,     256,
                                       1000, 32767, 32768, 65535, 65536, 4194303, 4194304};
    return divisors[between(0, 13)];
}

/* What check_kernel asks for, in other words. */
static int fits(const iris_kernel *k)
{
    double sum = 0;
    for (int i = 0; i < k->rows * k->columns; i++) {
        sum += fabs((double)k->values[i]);
    }
    return 255 * sum + k->divisor / 2 + fabs((double)k->bias) * k->divisor < 2147483648.0;
}

static void matrices_of_all_kinds(void **state)
{
    (void)state;
    int refused = 0;
    for (int round = 0; round < 400; round++) {
        iris_format format;
        iris_image src = any_source(&format);
        int most = round % 8 == 0 ? 31 : 7;
        iris_kernel k = {values,        between(1, most),   between(1, most),
                         any_divisor(), between(-300, 300), between(0, 1)};
        int scale = 1 << between(0, 19), product = between(0, 1), down[31], across[31];
        for (int i = 0; i < 31; i++) {
            down[i] = between(-9, 9) * (between(0, 3) != 0);
            across[i] = between(-scale / 64 - 2, scale / 64 + 2);
        }
        for (int i = 0; i < k.rows * k.columns; i++) {
            values[i] = product ? down[i / k.columns] * across[i % k.columns] : between(-scale, scale);
        }
        if (!fits(&k)) {
            iris_scratch scratch = arena(sizeof memory);
            iris_image dst = view(result, src.w, src.h, format);
            assert_int_equal(iris_convolve(&dst, &src, &k, any_border(), &scratch), IRIS_ERR_RANGE);
            refused++;
            k.divisor = between(1, 100);
            k.bias = 0;
        }
        if (fits(&k)) {
            check(&src, format, &k, any_border());
        }
    }
    assert_in_range(refused, 3, 200);
}

/* The largest sums that are allowed, on white and black, with every way to divide and to write. */
static void the_largest_sums(void **state)
{
    (void)state;
    iris_image src = view(source, 20, 4, IRIS_GRAY8);
    for (int round = 0; round < 200; round++) {
        iris_kernel k = {values, between(1, 5), between(1, 5), any_divisor(), 0, between(0, 1)};
        int count = k.rows * k.columns, sign = between(0, 2);
        int32_t all = (INT32_MAX - k.divisor / 2) / 255, rest = all;
        for (int i = 0; i < count; i++) {
            values[i] = i + 1 == count ? rest : between(0, rest / 2);
            rest -= values[i];
            values[i] = sign == 0 || (sign == 1 && i % 2) ? values[i] : -values[i];
        }
        for (size_t i = 0; i < sizeof source; i++) {
            source[i] = between(0, 9) ? 255 : (uint8_t)between(0, 255);
        }
        iris_border border = any_border();
        check(&src, round % 2 ? IRIS_GRAY8 : IRIS_GRAY_S16, &k, border);
        values[0] += values[0] < 0 ? -1 : 1;
        iris_scratch scratch = arena(sizeof memory);
        iris_image dst = view(result, src.w, src.h, IRIS_GRAY8);
        assert_int_equal(iris_convolve(&dst, &src, &k, border, &scratch), IRIS_ERR_RANGE);
    }
}

/* The tool's example, and where the matrix lies: a single pixel spreads the matrix as it is written by convolution, and turned
 * by correlation. */
static void by_hand(void **state)
{
    (void)state;
    static const int32_t binomial[9] = {1, 2, 1, 2, 4, 2, 1, 2, 1}, even[6] = {1, 2, 3, 4, 5, 6};
    iris_kernel k = {binomial, 3, 3, 16, 0, 0};
    uint8_t pixels[9] = {0, 16, 32, 0, 16, 32, 0, 16, 33}, out[25] = {0};
    iris_image src, dst;
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_image_wrap(&src, pixels, 9, (iris_size){3, 3}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&dst, out, 9, (iris_size){3, 3}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_convolve(&dst, &src, &k, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(out, ((uint8_t[]){4, 16, 28, 4, 16, 28, 4, 16, 29}), 9);

    uint8_t dot[25] = {0};
    dot[12] = 1;
    k = (iris_kernel){even, 2, 3, 1, 0, 0};
    assert_int_equal(iris_image_wrap(&src, dot, 25, (iris_size){5, 5}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&dst, out, 25, (iris_size){5, 5}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_convolve(&dst, &src, &k, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(
        out, ((uint8_t[]){0, 0, 0, 0, 0, 0, 1, 2, 3, 0, 0, 4, 5, 6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 25);
    assert_int_equal(iris_correlate(&dst, &src, &k, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(
        out, ((uint8_t[]){0, 0, 0, 0, 0, 0, 6, 5, 4, 0, 0, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 25);

    /* Halves go up: -5 / 2 is -2, 5 / 2 is 3. The bias comes before the absolute value. */
    static const int32_t minus = -5, plus = 5;
    int16_t half;
    assert_int_equal(iris_image_wrap(&src, dot + 12, 1, (iris_size){1, 1}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&dst, &half, 2, (iris_size){1, 1}, 0, IRIS_GRAY_S16), IRIS_OK);
    const struct {
        iris_kernel kernel;
        int value;
    } cases[] = {{{&minus, 1, 1, 2, 0, 0}, -2},          {{&plus, 1, 1, 2, 0, 0}, 3},
                 {{&minus, 1, 1, 2, 0, 1}, 2},           {{&minus, 1, 1, 2, 1, 1}, 1},
                 {{&minus, 1, 1, 2, -40000, 0}, -32768}, {{&plus, 1, 1, 2, 40000, 0}, 32767},
                 {{&minus, 1, 1, 2, -40000, 1}, 32767}};
    for (int i = 0; i < 7; i++) {
        assert_int_equal(iris_correlate(&dst, &src, &cases[i].kernel, (iris_border){0}, &scratch), IRIS_OK);
        assert_int_equal(half, cases[i].value);
    }
}

static void turned_matrices(void **state)
{
    (void)state;
    static int32_t turned[49];
    for (int round = 0; round < 60; round++) {
        iris_kernel k = {values, between(1, 7), between(1, 7), 1, 0, 0}, t = {turned, 0, 0, 1, 0, 0};
        t.rows = k.rows;
        t.columns = k.columns;
        for (int i = 0; i < k.rows * k.columns; i++) {
            values[i] = turned[k.rows * k.columns - 1 - i] = between(-2, 3);
        }
        fill_source();
        iris_image src = view(source, between(1, 30), between(1, 9), IRIS_GRAY8);
        iris_image one = view(result, src.w, src.h, IRIS_GRAY8),
                   two = view(expected, src.w, src.h, IRIS_GRAY8);
        iris_border border = any_border();
        iris_scratch scratch = arena(sizeof memory);
        memset(result, 1, sizeof result);
        memset(expected, 1, sizeof expected);
        assert_int_equal(iris_convolve(&one, &src, &k, border, &scratch), IRIS_OK);
        assert_int_equal(iris_correlate(&two, &src, &t, border, &scratch), IRIS_OK);
        assert_memory_equal(result, expected, sizeof result);
    }
}

static void assert_kernel(const iris_kernel *k, int rows, int columns, int divisor, const int32_t *wanted)
{
    assert_ptr_equal(k->values, values);
    assert_int_equal(k->rows, rows);
    assert_int_equal(k->columns, columns);
    assert_int_equal(k->divisor, divisor);
    assert_int_equal(k->bias, 0);
    assert_int_equal(k->absolute, 0);
    assert_memory_equal(values, wanted, sizeof(int32_t) * (size_t)(rows * columns));
}

static void small_generators(void **state)
{
    (void)state;
    iris_kernel k;
    assert_int_equal(iris_kernel_roberts(&k, values, IRIS_KERNEL_X), IRIS_OK);
    assert_kernel(&k, 2, 2, 1, (int32_t[]){-1, 0, 0, 1});
    assert_int_equal(iris_kernel_roberts(&k, values, IRIS_KERNEL_Y), IRIS_OK);
    assert_kernel(&k, 2, 2, 1, (int32_t[]){0, -1, 1, 0});
    assert_int_equal(iris_kernel_sobel(&k, values, IRIS_KERNEL_X), IRIS_OK);
    assert_kernel(&k, 3, 3, 1, (int32_t[]){-1, 0, 1, -2, 0, 2, -1, 0, 1});
    assert_int_equal(iris_kernel_sobel(&k, values, IRIS_KERNEL_Y), IRIS_OK);
    assert_kernel(&k, 3, 3, 1, (int32_t[]){-1, -2, -1, 0, 0, 0, 1, 2, 1});
    assert_int_equal(iris_kernel_prewitt(&k, values, IRIS_KERNEL_X), IRIS_OK);
    assert_kernel(&k, 3, 3, 1, (int32_t[]){-1, 0, 1, -1, 0, 1, -1, 0, 1});
    assert_int_equal(iris_kernel_prewitt(&k, values, IRIS_KERNEL_Y), IRIS_OK);
    assert_kernel(&k, 3, 3, 1, (int32_t[]){-1, -1, -1, 0, 0, 0, 1, 1, 1});
    assert_int_equal(iris_kernel_isotropic(&k, values, IRIS_KERNEL_X), IRIS_OK);
    assert_kernel(&k, 3, 3, 128, (int32_t[]){-128, 0, 128, -181, 0, 181, -128, 0, 128});
    assert_true(fabs(181.0 / 128 / sqrt(2) - 1) < 1.2e-4);
    assert_int_equal(iris_kernel_isotropic(&k, values, IRIS_KERNEL_Y), IRIS_OK);
    assert_kernel(&k, 3, 3, 128, (int32_t[]){-128, -181, -128, 0, 0, 0, 128, 181, 128});
    assert_int_equal(iris_kernel_laplacian(&k, values, 4), IRIS_OK);
    assert_kernel(&k, 3, 3, 1, (int32_t[]){0, 1, 0, 1, -4, 1, 0, 1, 0});
    assert_int_equal(iris_kernel_laplacian(&k, values, 8), IRIS_OK);
    assert_kernel(&k, 3, 3, 1, (int32_t[]){1, 1, 1, 1, -8, 1, 1, 1, 1});
    assert_int_equal(iris_kernel_box(&k, values, 2, 3), IRIS_OK);
    assert_kernel(&k, 2, 3, 6, (int32_t[]){1, 1, 1, 1, 1, 1});
    assert_int_equal(iris_kernel_laplacian(&k, values, 5), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_box(&k, values, 0, 3), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_box(&k, values, 3, 32), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_sobel(NULL, values, IRIS_KERNEL_X), IRIS_ERR_ARG);
    assert_int_equal(iris_kernel_roberts(&k, NULL, IRIS_KERNEL_X), IRIS_ERR_ARG);
    assert_int_equal(iris_kernel_prewitt(&k, values, (iris_kernel_direction)2), IRIS_ERR_ARG);
    assert_int_equal(iris_kernel_laplacian(&k, NULL, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_kernel_box(NULL, values, 1, 1), IRIS_ERR_ARG);
    assert_kernel(&k, 2, 3, 6, (int32_t[]){1, 1, 1, 1, 1, 1});
}

static double bell[16]; /* the real weights of the distances */

static void set_bell(double sigma)
{
    double sum = 0;
    for (int i = -60; i <= 60; i++) {
        sum += exp(-i * i / (2 * sigma * sigma));
    }
    for (int i = 0; i < 16; i++) {
        bell[i] = exp(-i * i / (2 * sigma * sigma)) / sum;
    }
}

static void gaussian_generators(void **state)
{
    (void)state;
    for (iris_q16 sigma = IRIS_BLUR_SIGMA_MIN; sigma <= IRIS_KERNEL_GAUSSIAN_SIGMA_MAX; sigma += 5000) {
        iris_kernel k;
        int radius = IRIS_BLUR_RADIUS(sigma), side = 2 * radius + 1, sum = 0, i = 0;
        assert_true(IRIS_KERNEL_GAUSSIAN_VALUES(sigma) == side * side && side <= IRIS_KERNEL_SIDE_MAX);
        set_bell(sigma / 65536.0);
        assert_int_equal(iris_kernel_gaussian(&k, values, sigma), IRIS_OK);
        assert_true(k.rows == side && k.columns == side && k.divisor == 1 << 22);
        for (int y = -radius; y <= radius; y++) {
            for (int x = -radius; x <= radius; x++, i++) {
                double real = bell[abs(x)] * bell[abs(y)] * k.divisor;
                sum += values[i];
                assert_true(fabs(values[i] - real) <= 0.002 * k.divisor);
                assert_int_equal(values[i], values[(y + radius) + (x + radius) * side]);
            }
        }
        assert_int_equal(sum, k.divisor);
        assert_true(fits(&k));

        for (iris_q16 amount = 0; amount <= 16 * 65536; amount += 150000) {
            assert_int_equal(iris_kernel_unsharp(&k, values, sigma, amount), IRIS_OK);
            sum = i = 0;
            for (int y = -radius; y <= radius; y++) {
                for (int x = -radius; x <= radius; x++, i++) {
                    double real = bell[abs(x)] * bell[abs(y)];
                    real = ((x == 0 && y == 0) - amount / 65536.0 * (real - (x == 0 && y == 0))) * k.divisor;
                    sum += values[i];
                    assert_true(fabs(values[i] - real) <= (0.002 * amount / 65536 + 0.003) * k.divisor);
                }
            }
            assert_true(sum == k.divisor && k.divisor == 65536 && fits(&k));
        }
    }
    iris_kernel k;
    assert_int_equal(iris_kernel_gaussian(&k, values, IRIS_BLUR_SIGMA_MIN - 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_gaussian(&k, values, IRIS_KERNEL_GAUSSIAN_SIGMA_MAX + 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_unsharp(&k, values, 65536, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_unsharp(&k, values, 65536, 16 * 65536 + 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_unsharp(NULL, values, 65536, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_kernel_gaussian(&k, NULL, 65536), IRIS_ERR_ARG);
    assert_int_equal(IRIS_BLUR_RADIUS(IRIS_KERNEL_GAUSSIAN_SIGMA_MAX), 15);
    assert_int_equal(IRIS_BLUR_RADIUS(IRIS_KERNEL_GAUSSIAN_SIGMA_MAX + 1), 16);
}

static double laplacian_of_gaussian(double sigma, double r2)
{
    double s2 = sigma * sigma, pi = 3.14159265358979323846;
    return (r2 / s2 - 2) / s2 * exp(-r2 / (2 * s2)) / (2 * pi * s2);
}

static void log_generator(void **state)
{
    (void)state;
    iris_kernel k;
    for (iris_q16 sigma = IRIS_KERNEL_LOG_SIGMA_MIN; sigma <= IRIS_KERNEL_LOG_SIGMA_MAX; sigma += 7000) {
        int radius = IRIS_KERNEL_LOG_RADIUS(sigma), side = 2 * radius + 1, sum = 0;
        double mean = 0;
        assert_true(IRIS_KERNEL_LOG_VALUES(sigma) == side * side && side <= IRIS_KERNEL_SIDE_MAX);
        assert_int_equal(iris_kernel_log(&k, values, sigma), IRIS_OK);
        assert_true(k.rows == side && k.columns == side && k.divisor == 1 << (sigma < 65536 ? 19 : 22) &&
                    fits(&k));
        for (int pass = 0; pass < 2; pass++) {
            for (int i = 0; i < side * side; i++) {
                int x = i % side - radius, y = i / side - radius;
                double real = laplacian_of_gaussian(sigma / 65536.0, x * x + y * y);
                mean += pass ? 0 : real / (side * side);
                sum += pass ? values[i] : 0;
                double error = fabs(values[i] - (real - mean) * k.divisor);
                assert_true(!pass || error <= (i == side * side / 2 ? 2 * side : 1));
            }
        }
        assert_int_equal(sum, 0);
    }
    assert_int_equal(iris_kernel_log(&k, values, IRIS_KERNEL_LOG_SIGMA_MIN - 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_log(&k, values, IRIS_KERNEL_LOG_SIGMA_MAX + 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_kernel_log(&k, NULL, 65536), IRIS_ERR_ARG);
    assert_int_equal(IRIS_KERNEL_LOG_RADIUS(IRIS_KERNEL_LOG_SIGMA_MAX), 15);
}

static void real_pictures(void **state)
{
    (void)state;
    picture from = load_pnm(data_path("edges/classic/camera_256.pgm"));
    if (!from.pixels) {
        print_message("edges/classic/camera_256.pgm is missing\n");
        skip();
    }
    iris_image src = view(source, 58, 45, IRIS_GRAY8);
    for (int y = 0; y < src.h; y++) {
        memcpy(at(&src, 0, y), from.pixels + (y + 50) * from.w + 100, (size_t)src.w);
    }
    free(from.pixels);
    for (int i = 0; i < 12; i++) {
        iris_kernel k;
        iris_kernel_direction direction = i % 2 ? IRIS_KERNEL_Y : IRIS_KERNEL_X;
        iris_status status = i < 2    ? iris_kernel_sobel(&k, values, direction)
                             : i < 4  ? iris_kernel_isotropic(&k, values, direction)
                             : i < 6  ? iris_kernel_roberts(&k, values, direction)
                             : i < 8  ? iris_kernel_laplacian(&k, values, i % 2 ? 4 : 8)
                             : i < 9  ? iris_kernel_gaussian(&k, values, 91750)
                             : i < 10 ? iris_kernel_log(&k, values, 91750)
                             : i < 11 ? iris_kernel_unsharp(&k, values, 65536, 98304)
                                      : iris_kernel_box(&k, values, 4, 7);
        assert_int_equal(status, IRIS_OK);
        k.absolute = i % 3 == 1;
        check(&src, i % 4 == 3 ? IRIS_GRAY_S16 : IRIS_GRAY8, &k, any_border());
    }
}

/* The mean by iris_blur_box is that of the box matrix. */
static void the_same_as_box_blur(void **state)
{
    (void)state;
    for (int side = 1; side <= 9; side++) {
        iris_kernel k;
        fill_source();
        iris_image src = view(source, 33, 12, IRIS_RGB888), one = view(result, 33, 12, IRIS_RGB888),
                   two = view(expected, 33, 12, IRIS_RGB888);
        iris_border border = any_border();
        iris_scratch scratch = arena(sizeof memory);
        memset(result, 1, sizeof result);
        memset(expected, 1, sizeof expected);
        assert_int_equal(iris_kernel_box(&k, values, side, side), IRIS_OK);
        assert_int_equal(iris_convolve(&one, &src, &k, border, &scratch), IRIS_OK);
        assert_int_equal(iris_blur_box(&two, &src, side, border, &scratch), IRIS_OK);
        assert_memory_equal(result, expected, sizeof result);
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
    iris_kernel k;
    assert_int_equal(iris_kernel_sobel(&k, values, IRIS_KERNEL_X), IRIS_OK);
    assert_int_equal(iris_convolve(NULL, &src, &k, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_convolve(&dst, NULL, &k, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_convolve(&dst, &src, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_convolve(&dst, &src, &k, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_convolve(&dst, &src, &k, (iris_border){(iris_border_rule)-1, 0}, &scratch),
                     IRIS_ERR_ARG);
    const iris_kernel wrong[] = {{NULL, 3, 3, 1, 0, 0},    {values, 0, 3, 1, 0, 0},
                                 {values, 3, 32, 1, 0, 0}, {values, 32, 3, 1, 0, 0},
                                 {values, 3, -1, 1, 0, 0}, {values, 3, 3, 0, 0, 0},
                                 {values, 3, 3, -1, 0, 0}, {values, 3, 3, IRIS_KERNEL_DIVISOR_MAX + 1, 0, 0},
                                 {values, 3, 3, 1, 0, 2}};
    for (int i = 0; i < 9; i++) {
        assert_int_equal(iris_correlate(&dst, &src, &wrong[i], border, &scratch), IRIS_ERR_ARG);
    }
    k.bias = INT32_MIN;
    assert_int_equal(iris_correlate(&dst, &src, &k, border, &scratch), IRIS_ERR_RANGE);
    k.bias = INT32_MAX;
    assert_int_equal(iris_correlate(&dst, &src, &k, border, &scratch), IRIS_ERR_RANGE);
    k.bias = 0;
    values[3] = INT32_MIN;
    assert_int_equal(iris_correlate(&dst, &src, &k, border, &scratch), IRIS_ERR_RANGE);
    values[3] = -2;
    bad.h = 19;
    assert_int_equal(iris_convolve(&bad, &src, &k, border, &scratch), IRIS_ERR_RANGE);
    bad = view(result, 20, 20, IRIS_RGB888);
    assert_int_equal(iris_convolve(&bad, &src, &k, border, &scratch), IRIS_ERR_FORMAT);
    bad = view(result, 20, 20, IRIS_GRAY_U16);
    assert_int_equal(iris_convolve(&bad, &src, &k, border, &scratch), IRIS_ERR_FORMAT);
    bad = view(source, 20, 20, IRIS_GRAY_S16);
    assert_int_equal(iris_convolve(&bad, &src, &k, border, &scratch), IRIS_ERR_ALIAS);
    bad = src;
    bad.data = at(&src, 1, 0);
    assert_int_equal(iris_convolve(&bad, &src, &k, border, &scratch), IRIS_ERR_ALIAS);
    for (int32_t side = 1; side < 5; side++) {
        k = (iris_kernel){values, side, 5 - side, 1, 0, 0};
        scratch = arena(IRIS_CONVOLVE_SCRATCH_BYTES(20, 1, side, 5 - side) - 1);
        assert_int_equal(iris_convolve(&dst, &src, &k, border, &scratch), IRIS_ERR_SCRATCH);
        assert_int_equal(scratch.used, 0);
    }
    for (size_t i = 0; i < sizeof result; i++) {
        assert_int_equal(result[i], 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(matrices_of_all_kinds),
        cmocka_unit_test(the_largest_sums),
        cmocka_unit_test(turned_matrices),
        cmocka_unit_test(small_generators),
        cmocka_unit_test(gaussian_generators),
        cmocka_unit_test(log_generator),
        cmocka_unit_test(real_pictures),
        cmocka_unit_test(the_same_as_box_blur),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("convolve", tests, NULL, NULL);
}
