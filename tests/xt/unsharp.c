/* Unsharp mask: against its formula in doubles, on real pictures; steps and thresholds worked out by hand. */
#include "iris/xt/unsharp.h"

#include <math.h>

#include "../picture.h"

#define SIDE 64

static uint8_t source[4 * SIDE * SIDE], result[4 * SIDE * SIDE], blurred[4 * SIDE * SIDE];
static IRIS_SCRATCH_BUFFER(memory, IRIS_UNSHARP_SCRATCH_BYTES(SIDE, 3, 5 * 65536));

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image view(uint8_t *pixels, int32_t w, int32_t h, iris_format format)
{
    iris_image image;
    ptrdiff_t stride = (ptrdiff_t)iris_format_row_bytes(format, w) + 7;
    assert_int_equal(iris_image_wrap(&image, pixels + 1, sizeof source - 1, (iris_size){w, h},
                                     h % 2 ? -stride : stride, format),
                     IRIS_OK);
    return image;
}

/* Whole buffers are compared: rows' padding, and what SKIP leaves out, is the same in all three. */
static void check(const iris_image *src, const iris_unsharp_config *config, iris_border border, int in_place)
{
    int channels = src->format == IRIS_GRAY8 ? 1 : 3;
    size_t bytes = IRIS_UNSHARP_SCRATCH_BYTES(src->w, channels, config->sigma_q16);
    iris_scratch scratch = arena(sizeof memory);
    memcpy(result, source, sizeof result);
    memcpy(blurred, source, sizeof blurred);
    iris_image dst = view(result, src->w, src->h, src->format),
               blur = view(blurred, src->w, src->h, src->format);
    assert_int_equal(iris_blur_gaussian(&blur, src, config->sigma_q16, border, &scratch), IRIS_OK);
    scratch = arena(bytes);
    assert_int_equal(iris_unsharp(&dst, in_place ? &dst : src, config, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, bytes);
    assert_int_equal(scratch.used, 0);
    for (size_t i = 0; i < sizeof result; i++) {
        int difference = source[i] - blurred[i];
        double value = source[i];
        if (abs(difference) > config->threshold) {
            value += floor(config->amount_q16 / 65536.0 * difference + 0.5);
        }
        assert_int_equal(result[i], value < 0 ? 0 : value > 255 ? 255 : (int)value);
    }
}

static void against_the_formula(void **state)
{
    (void)state;
    uint32_t seed = 4;
    picture from = load_pnm(data_path("edges/classic/camera_256.pgm"));
    for (int k = 0; k < 80; k++) {
        iris_image src = view(source, 1 + (k * 7) % SIDE, 1 + (k * 5) % 40, k % 3 ? IRIS_GRAY8 : IRIS_BGR888);
        for (size_t i = 0; i < sizeof source; i++) {
            source[i] = from.pixels && k % 2 ? from.pixels[i + 9000] : (uint8_t)next_random(&seed);
        }
        iris_unsharp_config config = {
            (iris_q16)(IRIS_BLUR_SIGMA_MIN + next_random(&seed) % 300000),
            (iris_q16)(next_random(&seed) % (k % 4 ? 200000 : IRIS_UNSHARP_AMOUNT_MAX + 1)),
            (int32_t)(next_random(&seed) % (k % 5 ? 20 : 256))};
        check(&src, &config, (iris_border){(iris_border_rule)(k / 2 % 4), 77}, k % 2);
    }
    if (!from.pixels) {
        print_message("edges/classic/camera_256.pgm is missing\n");
    }
    free(from.pixels);
}

/* A step from 100 to 140, blurred by 5 taps, overshoots on both sides; below the threshold nothing happens. The
 * weights are those of the test of blurs, 0.499, 0.2285, 0.0219. */
static void a_step_by_hand(void **state)
{
    (void)state;
    uint8_t step[8] = {100, 100, 100, 100, 140, 140, 140, 140}, out[8];
    iris_image src, dst;
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_image_wrap(&src, step, 8, (iris_size){8, 1}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&dst, out, 8, (iris_size){8, 1}, 0, IRIS_GRAY8), IRIS_OK);
    iris_unsharp_config config = {52428, 2 * 65536, 0}; /* blurred: 100.88 -> 101, 110.02 -> 110 */
    assert_int_equal(iris_unsharp(&dst, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(out, ((uint8_t[]){100, 100, 98, 80, 160, 142, 140, 140}), 8);
    config.threshold = 1;
    assert_int_equal(iris_unsharp(&dst, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(out, ((uint8_t[]){100, 100, 100, 80, 160, 140, 140, 140}), 8);
    config.threshold = 10;
    assert_int_equal(iris_unsharp(&dst, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(out, step, 8);
    config = (iris_unsharp_config){52428, IRIS_UNSHARP_AMOUNT_MAX, 2}; /* 100 - 160 and 140 + 160 */
    assert_int_equal(iris_unsharp(&dst, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(out, ((uint8_t[]){100, 100, 100, 0, 255, 140, 140, 140}), 8);
}

static void defaults(void **state)
{
    (void)state;
    iris_unsharp_config config = {1, 1, 1};
    iris_unsharp_defaults(&config);
    assert_true(config.sigma_q16 == 65536 && config.amount_q16 == 65536 && config.threshold == 0);
    iris_unsharp_defaults(NULL);
    for (size_t i = 0; i < sizeof source; i++) {
        source[i] = (uint8_t)(i * i / 7);
    }
    iris_image src = view(source, 30, 30, IRIS_GRAY8), dst = view(result, 30, 30, IRIS_GRAY8),
               same = view(blurred, 30, 30, IRIS_GRAY8);
    iris_scratch scratch = arena(sizeof memory);
    memset(result, 0, sizeof result);
    memset(blurred, 0, sizeof blurred);
    assert_int_equal(iris_unsharp(&dst, &src, NULL, (iris_border){0}, &scratch), IRIS_OK);
    assert_int_equal(iris_unsharp(&same, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(result, blurred, sizeof result);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    memset(source, 1, sizeof source);
    memset(result, 2, sizeof result);
    iris_image src = view(source, 20, 20, IRIS_GRAY8), dst = view(result, 20, 20, IRIS_GRAY8), bad = dst;
    iris_scratch scratch = arena(sizeof memory);
    iris_border border = {0};
    assert_int_equal(iris_unsharp(NULL, &src, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_unsharp(&dst, NULL, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_unsharp(&dst, &src, NULL, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_unsharp(&dst, &src, NULL, (iris_border){(iris_border_rule)4, 0}, &scratch),
                     IRIS_ERR_ARG);
    const iris_unsharp_config wrong[] = {{IRIS_BLUR_SIGMA_MIN - 1, 1, 1},
                                         {IRIS_BLUR_SIGMA_MAX + 1, 1, 1},
                                         {65536, -1, 1},
                                         {65536, IRIS_UNSHARP_AMOUNT_MAX + 1, 1},
                                         {65536, 1, -1},
                                         {65536, 1, 256}};
    for (int i = 0; i < 6; i++) {
        assert_int_equal(iris_unsharp(&dst, &src, &wrong[i], border, &scratch), IRIS_ERR_ARG);
    }
    bad.w = 19;
    assert_int_equal(iris_unsharp(&bad, &src, NULL, border, &scratch), IRIS_ERR_RANGE);
    bad = view(result, 20, 20, IRIS_YUYV);
    assert_int_equal(iris_unsharp(&bad, &bad, NULL, border, &scratch), IRIS_ERR_FORMAT);
    bad = src;
    bad.data = (uint8_t *)src.data + 1;
    assert_int_equal(iris_unsharp(&bad, &src, NULL, border, &scratch), IRIS_ERR_ALIAS);
    scratch = arena(IRIS_UNSHARP_SCRATCH_BYTES(20, 1, 65536) - 1);
    assert_int_equal(iris_unsharp(&dst, &src, NULL, border, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    for (size_t i = 0; i < sizeof result; i++) {
        assert_int_equal(result[i], 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_by_hand),
        cmocka_unit_test(against_the_formula),
        cmocka_unit_test(defaults),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("unsharp", tests, NULL, NULL);
}
