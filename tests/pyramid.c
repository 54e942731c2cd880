/* Pyramid. Truth: sums over the 25 pixels in whole numbers, and pixels by hand. */
#include "iris/pyramid.h"
#include "test.h"

enum { BYTES = 40000, W_MAX = 130 };

static uint8_t from[BYTES], to[BYTES], before[BYTES], memory[BYTES];
static IRIS_SCRATCH_BUFFER(arena, IRIS_PYRAMID_SCRATCH_BYTES(W_MAX, 3));

static const iris_format formats[] = {IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};

static iris_image wrap(void *buffer, size_t bytes, int32_t w, int32_t h, ptrdiff_t stride, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, buffer, bytes, (iris_size){w, h}, stride, format), IRIS_OK);
    return image;
}

static iris_scratch working(size_t bytes)
{
    iris_scratch scratch;
    assert_true(bytes <= sizeof arena);
    assert_int_equal(iris_scratch_init(&scratch, arena.memory, bytes), IRIS_OK);
    return scratch;
}

static void random_bytes(uint8_t *bytes, size_t count, uint32_t seed)
{
    for (size_t i = 0; i < count; i++) {
        seed = seed * 1664525u + 1013904223u;
        bytes[i] = (uint8_t)(seed >> 24);
        if (seed % 3 == 0) {
            bytes[i] = bytes[i] > 127 ? 255 : 0;
        }
    }
}

static int channels_of(iris_format format)
{
    return format == IRIS_GRAY8 ? 1 : 3;
}

/* A sample anywhere, by the rule. */
static int sample(const iris_image *src, int32_t x, int32_t y, int channel, iris_border border)
{
    int32_t u = iris_border_index(x, src->w, border.rule), v = iris_border_index(y, src->h, border.rule);
    if (u < 0 || v < 0) {
        return border.value;
    }
    return ((const uint8_t *)iris_image_row(src, v))[u * channels_of(src->format) + channel];
}

static int smoothed(const iris_image *src, int32_t x, int32_t y, int channel, iris_border border)
{
    static const int weights[5] = {1, 4, 6, 4, 1};
    int sum = 0;
    for (int j = -2; j <= 2; j++) {
        for (int i = -2; i <= 2; i++) {
            sum += weights[i + 2] * weights[j + 2] * sample(src, x + i, y + j, channel, border);
        }
    }
    return (sum + 128) / 256;
}

static int inside(const iris_image *src, int32_t x, int32_t y, int32_t reach)
{
    return x >= reach && y >= reach && x + reach < src->w && y + reach < src->h;
}

static void assert_rest_kept(const iris_image *dst)
{
    iris_image old = *dst;
    old.data = before + ((uint8_t *)dst->data - to);
    for (int32_t y = 0; y < dst->h; y++) {
        memcpy(iris_image_row(&old, y), iris_image_row(dst, y), iris_format_row_bytes(dst->format, dst->w));
    }
    assert_memory_equal(to, before, sizeof to);
}

static void down_against_sums(void **state)
{
    (void)state;
    const iris_size sizes[] = {{1, 1}, {1, 9},  {2, 2},   {3, 1},  {4, 3},  {5, 5},
                               {6, 7}, {16, 8}, {33, 12}, {64, 6}, {101, 9}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (int k = 0; k < 12; k++) {
            iris_format format = formats[k / 4];
            iris_border border = {(iris_border_rule)(k % 4), 93};
            int32_t w = sizes[s].w, h = sizes[s].h;
            int channels = channels_of(format);
            random_bytes(from, sizeof from, (uint32_t)(s * 12) + (uint32_t)k);
            random_bytes(to, sizeof to, 2);
            memcpy(before, to, sizeof to);
            iris_image whole = wrap(from, sizeof from, w + 5, h + 3, k % 2 ? -400 : 401, format), src;
            assert_int_equal(iris_image_crop(&src, &whole, (iris_rect){3, 1, w, h}), IRIS_OK);
            iris_image dst = wrap(to, sizeof to, (w + 1) / 2, (h + 1) / 2, k % 3 ? -307 : 306, format);
            iris_scratch scratch = working(IRIS_PYRAMID_SCRATCH_BYTES(w, channels) - 1);
            assert_int_equal(iris_pyramid_down(&dst, &src, border, &scratch), IRIS_ERR_SCRATCH);
            assert_int_equal(scratch.used, 0);
            assert_memory_equal(to, before, sizeof to);
            scratch = working(IRIS_PYRAMID_SCRATCH_BYTES(w, channels));
            assert_int_equal(iris_pyramid_down(&dst, &src, border, &scratch), IRIS_OK);
            assert_int_equal(scratch.used, 0);
            assert_int_equal(scratch.peak, IRIS_PYRAMID_SCRATCH_BYTES(w, channels));
            for (int32_t i = 0; i < dst.w * dst.h * channels; i++) {
                int32_t x = i / channels % dst.w, y = i / channels / dst.w;
                int kept = border.rule == IRIS_BORDER_SKIP && !inside(&src, 2 * x, 2 * y, 2);
                ptrdiff_t at = (uint8_t *)iris_image_row(&dst, y) - to + x * channels + i % channels;
                assert_int_equal(to[at],
                                 kept ? before[at] : smoothed(&src, 2 * x, 2 * y, i % channels, border));
            }
            assert_rest_kept(&dst);
        }
    }
}

/* New pixels in between by zeros, then the five weights of twice the size: four times as much in all. */
static int spread(const iris_image *src, int32_t x, int32_t y, int channel, iris_border border)
{
    static const int weights[5] = {1, 4, 6, 4, 1};
    int sum = 0;
    for (int32_t j = -2; j <= 2; j++) {
        for (int32_t i = -2; i <= 2; i++) {
            if ((x + i) % 2 == 0 && (y + j) % 2 == 0) {
                sum +=
                    weights[i + 2] * weights[j + 2] * sample(src, (x + i) / 2, (y + j) / 2, channel, border);
            }
        }
    }
    return (sum + 32) / 64;
}

static void up_against_sums(void **state)
{
    (void)state;
    const iris_size sizes[] = {{1, 1}, {1, 5}, {2, 2}, {3, 1}, {4, 3}, {17, 6}, {32, 5}, {45, 7}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (int k = 0; k < 48; k++) {
            iris_format format = formats[k / 4 % 3];
            iris_border border = {(iris_border_rule)(k % 4), 93};
            int32_t w = sizes[s].w, h = sizes[s].h;
            int channels = channels_of(format);
            random_bytes(from, sizeof from, (uint32_t)(s * 12) + (uint32_t)k);
            random_bytes(to, sizeof to, 2);
            memcpy(before, to, sizeof to);
            iris_image src = wrap(from, sizeof from, w, h, k % 2 ? -400 : 401, format);
            iris_image dst =
                wrap(to, sizeof to, 2 * w - k / 12 % 2, 2 * h - k / 24 % 2, k % 3 ? -307 : 306, format);
            iris_scratch scratch = working(IRIS_PYRAMID_UP_SCRATCH_BYTES(w, channels) - 1);
            assert_int_equal(iris_pyramid_up(&dst, &src, border, &scratch), IRIS_ERR_SCRATCH);
            assert_int_equal(scratch.used, 0);
            assert_memory_equal(to, before, sizeof to);
            scratch = working(IRIS_PYRAMID_UP_SCRATCH_BYTES(w, channels));
            assert_int_equal(iris_pyramid_up(&dst, &src, border, &scratch), IRIS_OK);
            assert_int_equal(scratch.used, 0);
            assert_int_equal(scratch.peak, IRIS_PYRAMID_UP_SCRATCH_BYTES(w, channels));
            for (int32_t i = 0; i < dst.w * dst.h * channels; i++) {
                int32_t x = i / channels % dst.w, y = i / channels / dst.w;
                int kept = border.rule == IRIS_BORDER_SKIP && !inside(&src, x / 2, y / 2, 1);
                ptrdiff_t at = (uint8_t *)iris_image_row(&dst, y) - to + x * channels + i % channels;
                assert_int_equal(to[at], kept ? before[at] : spread(&src, x, y, i % channels, border));
            }
            assert_rest_kept(&dst);
        }
    }
}

static void by_hand(void **state)
{
    (void)state;
    const iris_border mirrored = {IRIS_BORDER_REFLECT101, 0}, zero = {IRIS_BORDER_CONSTANT, 0};
    iris_scratch scratch = working(sizeof arena);
    memset(from, 0, 25); /* one bright pixel in the middle of 5 x 5 */
    from[12] = 255;
    iris_image src = wrap(from, 25, 5, 5, 0, IRIS_GRAY8), dst = wrap(to, 9, 3, 3, 0, IRIS_GRAY8);
    assert_int_equal(iris_pyramid_down(&dst, &src, zero, &scratch), IRIS_OK);
    const uint8_t bright[9] = {1, 6, 1, 6, 36, 6, 1, 6, 1}; /* 255 times 1, 6, 36 of 256 */
    assert_memory_equal(to, bright, 9);
    assert_int_equal(iris_pyramid_down(&dst, &src, mirrored, &scratch), IRIS_OK);
    const uint8_t reflected[9] = {4,  12, 4,  12, 36,
                                  12, 4,  12, 4}; /* seen twice, and four times, at the edge */
    assert_memory_equal(to, reflected, 9);
    uint8_t row[4] = {0, 100, 200, 40};
    src = wrap(row, 4, 4, 1, 0, IRIS_GRAY8);
    dst = wrap(to, 2, 2, 1, 0, IRIS_GRAY8);
    assert_int_equal(iris_pyramid_down(&dst, &src, (iris_border){0}, &scratch), IRIS_OK);
    assert_int_equal(to[0], 38);  /* (0 0 0 100 200): 600 / 16 */
    assert_int_equal(to[1], 113); /* (0 100 200 40 40): 1800 / 16 */
    uint8_t two[2] = {10, 90};
    src = wrap(two, 2, 2, 1, 0, IRIS_GRAY8);
    dst = wrap(to, 4, 4, 1, 0, IRIS_GRAY8);
    assert_int_equal(iris_pyramid_up(&dst, &src, (iris_border){0}, &scratch), IRIS_OK);
    const uint8_t wide[4] = {20, 50, 80, 90}; /* (10 + 60 + 90) / 8, (40 + 360) / 8, (10 + 540 + 90) / 8 */
    assert_memory_equal(to, wide, 4);
}

/* Every level is one step down from the one before; the memory is filled to its last byte, and no further. */
static void all_levels(void **state)
{
    (void)state;
    for (int k = 0; k < 12; k++) {
        const int channels = channels_of(formats[k % 3]);
        const int32_t w = 97 - 13 * k / 2, h = 1 + 9 * k, levels = 1 + k % 7;
        size_t bytes = IRIS_PYRAMID_BYTES(w, h, channels, levels);
        random_bytes(from, sizeof from, (uint32_t)k);
        memset(memory, 0x5A, sizeof memory);
        iris_image src = wrap(from, sizeof from, w, h, 300, formats[k % 3]);
        iris_border border = {(iris_border_rule)(k % 3), 7};
        iris_pyramid pyramid;
        if (bytes > 0) {
            assert_int_equal(iris_pyramid_wrap(&pyramid, &src, levels, memory, bytes - 1), IRIS_ERR_RANGE);
        }
        assert_int_equal(iris_pyramid_wrap(&pyramid, &src, levels, bytes ? memory : NULL, bytes), IRIS_OK);
        assert_int_equal(pyramid.levels, levels);
        assert_memory_equal(&pyramid.level[0], &src, sizeof src);
        iris_scratch scratch = working(IRIS_PYRAMID_SCRATCH_BYTES(w, channels) - 1);
        if (levels > 1) {
            assert_int_equal(iris_pyramid_build(&pyramid, border, &scratch), IRIS_ERR_SCRATCH);
            assert_int_equal(memory[0], 0x5A);
        }
        scratch = working(IRIS_PYRAMID_SCRATCH_BYTES(w, channels));
        assert_int_equal(iris_pyramid_build(&pyramid, border, &scratch), IRIS_OK);
        assert_int_equal(scratch.used, 0);
        size_t used = 0;
        for (int32_t i = 1; i < levels; i++) {
            const iris_image *level = &pyramid.level[i], *last = level - 1;
            assert_int_equal(level->w, (last->w + 1) / 2);
            assert_int_equal(level->h, (last->h + 1) / 2);
            assert_int_equal(level->w, IRIS_PYRAMID_SIDE(w, i));
            assert_ptr_equal(level->data, memory + used);
            iris_image dst = wrap(to, sizeof to, level->w, level->h, 0, level->format);
            assert_int_equal(iris_pyramid_down(&dst, last, border, &scratch), IRIS_OK);
            size_t size = (size_t)level->w * (size_t)level->h * (size_t)channels;
            assert_memory_equal(level->data, to, size);
            used += size;
        }
        assert_int_equal(used, bytes);
        assert_int_equal(memory[bytes], 0x5A);
    }
}

static void sizes_are_constants(void **state)
{
    (void)state;
    static const uint8_t buffer[IRIS_PYRAMID_BYTES(320, 240, 1, 4)];
    assert_int_equal(sizeof buffer, 160 * 120 + 80 * 60 + 40 * 30);
    assert_int_equal(IRIS_PYRAMID_BYTES(5, 3, 3, 16), 3 * (3 * 2 + 2 * 1 + 13));
    assert_int_equal(IRIS_PYRAMID_BYTES(640, 480, 3, 1), 0);
    assert_int_equal(IRIS_PYRAMID_SIDE(IRIS_SIDE_MAX, 15), 1);
    assert_int_equal(IRIS_PYRAMID_SIDE(33, 0), 33);
    assert_int_equal(IRIS_PYRAMID_SIDE(33, 5), 2);
    assert_int_equal(IRIS_PYRAMID_SCRATCH_BYTES(10, 1), 6 * 32 + 32); /* 16 + 10 + 2, and 14 sums */
    assert_int_equal(IRIS_PYRAMID_UP_SCRATCH_BYTES(10, 3), 4 * 64 + 80);
}

/* What a constant picture must stay, at both ends, at every level and back. */
static void constant_pictures_stay(void **state)
{
    (void)state;
    for (int value = 0; value < 256; value += 51) {
        memset(from, value, sizeof from);
        iris_image src = wrap(from, sizeof from, 77, 41, 0, IRIS_GRAY8);
        iris_scratch scratch = working(sizeof arena);
        iris_pyramid pyramid;
        assert_int_equal(iris_pyramid_wrap(&pyramid, &src, 16, memory, sizeof memory), IRIS_OK);
        assert_int_equal(iris_pyramid_build(&pyramid, (iris_border){0}, &scratch), IRIS_OK);
        for (size_t i = 0; i < IRIS_PYRAMID_BYTES(77, 41, 1, 16); i++) {
            assert_int_equal(memory[i], value);
        }
        iris_image dst = wrap(to, sizeof to, 77, 41, 0, IRIS_GRAY8);
        assert_int_equal(iris_pyramid_up(&dst, &pyramid.level[1], (iris_border){0}, &scratch), IRIS_OK);
        assert_memory_equal(to, from, 77 * 41);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_scratch scratch = working(sizeof arena);
    const iris_border plain = {0}, unknown = {(iris_border_rule)4, 0};
    memset(to, 0x5A, sizeof to);
    memcpy(before, to, sizeof to);
    iris_image src = wrap(from, sizeof from, 9, 6, 0, IRIS_GRAY8),
               dst = wrap(to, sizeof to, 5, 3, 0, IRIS_GRAY8);
    iris_image up = wrap(to, sizeof to, 17, 12, 0, IRIS_GRAY8), bad;
    assert_int_equal(iris_pyramid_down(NULL, &src, plain, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_down(&dst, NULL, plain, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_down(&dst, &src, plain, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_down(&dst, &src, unknown, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_up(&up, NULL, plain, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_up(&up, &src, plain, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_up(&up, &src, unknown, &scratch), IRIS_ERR_ARG);
    for (int32_t w = 4; w <= 19; w++) {
        for (int32_t h = 2; h <= 13; h++) {
            bad = wrap(to, sizeof to, w, h, 0, IRIS_GRAY8);
            if (w != 5 || h != 3) {
                assert_int_equal(iris_pyramid_down(&bad, &src, plain, &scratch), IRIS_ERR_RANGE);
            }
            if (w < 17 || w > 18 || h < 11 || h > 12) {
                assert_int_equal(iris_pyramid_up(&bad, &src, plain, &scratch), IRIS_ERR_RANGE);
            }
        }
    }
    bad = dst;
    bad.format = IRIS_BAYER8_RGGB;
    assert_int_equal(iris_pyramid_down(&bad, &src, plain, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_pyramid_up(&bad, &bad, plain, &scratch), IRIS_ERR_FORMAT);
    bad = dst;
    bad.data = from + 53;
    assert_int_equal(iris_pyramid_down(&bad, &src, plain, &scratch), IRIS_ERR_ALIAS);
    bad = up;
    bad.data = from + 53;
    assert_int_equal(iris_pyramid_up(&bad, &src, plain, &scratch), IRIS_ERR_ALIAS);
    assert_memory_equal(to, before, sizeof to);
}

static void wrong_pyramids_are_refused(void **state)
{
    (void)state;
    iris_scratch scratch = working(sizeof arena);
    const iris_border plain = {0}, skip = {IRIS_BORDER_SKIP, 0}, unknown = {(iris_border_rule)4, 0};
    memset(to, 0x5A, sizeof to);
    memcpy(before, to, sizeof to);
    iris_image src = wrap(from, sizeof from, 9, 6, 0, IRIS_GRAY8), bad;
    iris_pyramid pyramid = {.levels = 77}, damaged;
    assert_int_equal(iris_pyramid_wrap(NULL, &src, 2, memory, sizeof memory), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_wrap(&pyramid, NULL, 2, memory, sizeof memory), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_wrap(&pyramid, &src, 2, NULL, sizeof memory), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_wrap(&pyramid, &src, 0, memory, sizeof memory), IRIS_ERR_RANGE);
    assert_int_equal(iris_pyramid_wrap(&pyramid, &src, 17, memory, sizeof memory), IRIS_ERR_RANGE);
    assert_int_equal(iris_pyramid_wrap(&pyramid, &src, INT32_MIN, memory, sizeof memory), IRIS_ERR_RANGE);
    assert_int_equal(iris_pyramid_wrap(&pyramid, &src, 3, from + 53, 1000), IRIS_ERR_ALIAS);
    bad = src;
    bad.format = IRIS_HSL24;
    bad.stride = 27;
    assert_int_equal(iris_pyramid_wrap(&pyramid, &bad, 2, memory, sizeof memory), IRIS_ERR_FORMAT);
    assert_int_equal(pyramid.levels, 77);
    assert_int_equal(iris_pyramid_build(&pyramid, plain, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_wrap(&pyramid, &src, 3, to, sizeof to), IRIS_OK);
    assert_int_equal(iris_pyramid_build(NULL, plain, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_build(&pyramid, plain, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_build(&pyramid, skip, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pyramid_build(&pyramid, unknown, &scratch), IRIS_ERR_ARG);
    damaged = pyramid;
    damaged.level[2].w = 1;
    assert_int_equal(iris_pyramid_build(&damaged, plain, &scratch), IRIS_ERR_RANGE);
    damaged = pyramid;
    damaged.level[2].data = NULL;
    assert_int_equal(iris_pyramid_build(&damaged, plain, &scratch), IRIS_ERR_ARG);
    assert_memory_equal(to, before, sizeof to);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(down_against_sums),
        cmocka_unit_test(up_against_sums),
        cmocka_unit_test(by_hand),
        cmocka_unit_test(all_levels),
        cmocka_unit_test(sizes_are_constants),
        cmocka_unit_test(constant_pictures_stay),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(wrong_pyramids_are_refused),
    };
    return cmocka_run_group_tests_name("pyramid", tests, NULL, NULL);
}
