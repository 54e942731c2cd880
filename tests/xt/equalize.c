/* Equalization: by hand, and the whole of the local one written again from its definition, without shortcuts. */
#include <math.h>

#include "../picture.h"
#include "../test.h"
#include "iris/color.h"
#include "iris/xt/equalize.h"

#define SIDE      96
#define ROW_BYTES (3 * SIDE + 5)

static uint8_t pixels[2][SIDE * ROW_BYTES];
static IRIS_SCRATCH_BUFFER(memory, IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(IRIS_EQUALIZE_TILES_MAX));

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image view(int which, iris_format format, int32_t w, int32_t h, int upside_down)
{
    iris_image image;
    ptrdiff_t stride = upside_down ? -ROW_BYTES : ROW_BYTES;
    assert_int_equal(
        iris_image_wrap(&image, pixels[which], sizeof pixels[which], (iris_size){w, h}, stride, format),
        IRIS_OK);
    return image;
}

static uint8_t *at(const iris_image *image, int32_t x, int32_t y)
{
    return (uint8_t *)iris_image_row(image, y) + x * (image->format == IRIS_GRAY8 ? 1 : 3);
}

/* kind 0: noise; 1: few levels; 2: two levels; 3: a slope; 4: flat */
static void fill(int kind, uint32_t seed)
{
    for (size_t i = 0; i < sizeof pixels[0]; i++) {
        uint32_t noise = next_random(&seed);
        pixels[0][i] = (uint8_t)(kind == 0   ? noise
                                 : kind == 1 ? 90 + noise % 20
                                 : kind == 2 ? noise % 2 * 255
                                 : kind == 3 ? i / 150
                                             : 77);
    }
    memset(pixels[1], 0xA5, sizeof pixels[1]);
}

/* ---- the reference ---- */

/* Twice the lightness of a pixel, 0 to 510. */
static int twice_lightness(const iris_image *image, int32_t x, int32_t y)
{
    const uint8_t *p = at(image, x, y);
    if (image->format == IRIS_GRAY8) {
        return 2 * p[0];
    }
    int max = p[0] > p[1] ? p[0] : p[1], min = p[0] < p[1] ? p[0] : p[1];
    return (max > p[2] ? max : p[2]) + (min < p[2] ? min : p[2]);
}

static int curves[IRIS_EQUALIZE_TILES_MAX][IRIS_EQUALIZE_TILES_MAX][256];

static void curve_of(int curve[256], const iris_image *src, const iris_equalize_local_config *by, int tx,
                     int ty)
{
    int32_t t = by->tiles, x0 = tx * src->w / t, x1 = (tx + 1) * src->w / t, y0 = ty * src->h / t,
            y1 = (ty + 1) * src->h / t;
    int64_t count[256] = {0}, area = (x1 - x0) * (y1 - y0), excess = 0, sum = 0;
    for (int32_t y = y0; y < y1; y++) {
        for (int32_t x = x0; x < x1; x++) {
            count[(twice_lightness(src, x, y) + 1) / 2]++;
        }
    }
    if (by->limit_q16 > 0) {
        int64_t most = (int64_t)floor((double)by->limit_q16 / 65536 * (double)area / 256);
        most = most < 1 ? 1 : most;
        for (int p = 0; p < 256; p++) {
            excess += count[p] > most ? count[p] - most : 0;
            count[p] = count[p] > most ? most : count[p];
        }
        for (int p = 0; p < 256; p++) {
            count[p] += excess / 256;
        }
        for (int64_t j = 0; j < excess % 256; j++) {
            count[256 * j / (excess % 256)]++;
        }
    }
    for (int p = 0; p < 256; p++) {
        sum += count[p];
        curve[p] = (int)((255 * sum * 2 + area) / (2 * area));
    }
    assert_int_equal(sum, area);
}

static int32_t twice_center(int32_t tile, int32_t side, int32_t tiles)
{
    return tile * side / tiles + (tile + 1) * side / tiles - 1;
}

/* The last tile whose center is not behind x, its neighbor, and the neighbor's weight. */
static int64_t place(int32_t *first, int32_t *second, int32_t x, int32_t side, int32_t tiles)
{
    int32_t before = 0; /* tiles */
    while (before < tiles && twice_center(before, side, tiles) <= 2 * x) {
        before++;
    }
    *first = before > 0 ? before - 1 : 0;
    *second = before < tiles ? before : tiles - 1;
    if (*first == *second) {
        return 0;
    }
    double left = twice_center(*first, side, tiles), right = twice_center(*second, side, tiles);
    return (int64_t)floor(2048 * (2 * x - left) / (right - left) + 0.5 + 1e-9);
}

/* Twice the new lightness, times 2048^2. */
static int64_t mixed(const iris_image *src, int32_t x, int32_t y, int32_t tiles)
{
    int32_t x0, x1, y0, y1;
    int64_t right = place(&x0, &x1, x, src->w, tiles), below = place(&y0, &y1, y, src->h, tiles);
    int l = twice_lightness(src, x, y), low = l / 2, high = (l + 1) / 2;
#define TWICE(ty, tx) ((int64_t)curves[ty][tx][low] + curves[ty][tx][high])
    return (TWICE(y0, x0) * (2048 - right) + TWICE(y0, x1) * right) * (2048 - below) +
           (TWICE(y1, x0) * (2048 - right) + TWICE(y1, x1) * right) * below;
}

/* The color with another lightness, as the textbook has it. */
static void assert_lightness(const uint8_t *is, const uint8_t *was, double lightness)
{
    double max = fmax(was[0], fmax(was[1], was[2])), min = fmin(was[0], fmin(was[1], was[2]));
    double room = 255 - fabs(max + min - 255),
           chroma = room > 0 ? (max - min) / room * (255 - fabs(2 * lightness - 255)) : 0;
    for (int c = 0; c < 3; c++) {
        double share = max > min ? (was[c] - min) / (max - min) : 0;
        assert_true(fabs(is[c] - (lightness - chroma / 2 + chroma * share)) < 0.51);
    }
}

static void assert_local(const iris_image *dst, const iris_image *src, const iris_equalize_local_config *by)
{
    static uint8_t before[sizeof pixels[0]];
    iris_scratch scratch = arena(IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(by->tiles));
    iris_image was = *src;
    memcpy(before, pixels[0], sizeof before);
    was.data = before + ((uint8_t *)src->data - pixels[0]);
    for (int32_t i = 0; i < by->tiles * by->tiles; i++) {
        curve_of(curves[i / by->tiles][i % by->tiles], &was, by, i % by->tiles, i / by->tiles);
    }
    assert_int_equal(iris_equalize_local(dst, src, by, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(by->tiles));
    for (int32_t y = 0; y < src->h; y++) {
        for (int32_t x = 0; x < src->w; x++) {
            int64_t twice = mixed(&was, x, y, by->tiles);
            if (src->format == IRIS_GRAY8) {
                assert_int_equal(*at(dst, x, y), (twice + 4194304) / 8388608);
            } else {
                assert_lightness(at(dst, x, y), at(&was, x, y), (double)twice / 8388608);
            }
        }
    }
}

/* ---- tests ---- */

static void local_at_every_size(void **state)
{
    (void)state;
    const iris_q16 limits[] = {0, 1, 65536, 3 * 65536, 160000, 256 * 65536};
    for (int32_t round = 0; round < 240; round++) {
        iris_format format = round % 4 == 3 ? IRIS_RGB888 : round % 16 == 2 ? IRIS_BGR888 : IRIS_GRAY8;
        int32_t w = 1 + round * 37 % SIDE, h = 1 + round * 53 % SIDE, shorter = w < h ? w : h;
        iris_equalize_local_config by = {1 + round % (shorter < 12 ? shorter : 12), limits[round % 6]};
        by.tiles = round % 20 == 7 ? (shorter < 64 ? shorter : 64) : by.tiles;
        fill(round % 5, (uint32_t)round);
        iris_image src = view(0, format, w, h, round & 1), dst = view(round % 3 > 0, format, w, h, round & 1);
        assert_local(&dst, &src, &by);
    }
}

/* A region does not look at what is around it, nor touch it. */
static void regions(void **state)
{
    (void)state;
    iris_equalize_local_config by = {3, 2 * IRIS_Q16_ONE};
    for (int color = 0; color < 2; color++) {
        iris_format format = color ? IRIS_RGB888 : IRIS_GRAY8;
        iris_image src = view(0, format, SIDE, SIDE, 0), dst = view(1, format, SIDE, SIDE, 0), from, to;
        const iris_rect rect = {31, 7, 40, 50};
        fill(0, 4);
        assert_int_equal(iris_image_crop(&from, &src, rect), IRIS_OK);
        assert_int_equal(iris_image_crop(&to, &dst, rect), IRIS_OK);
        assert_local(&to, &from, &by);
        int channels = color ? 3 : 1;
        for (int32_t y = 0; y < SIDE; y++) {
            for (int32_t i = 0; i < ROW_BYTES; i++) {
                int inside = y >= 7 && y < 57 && i >= 31 * channels && i < 71 * channels;
                assert_true(inside || pixels[1][y * ROW_BYTES + i] == 0xA5);
            }
        }
    }
}

static void defaults_are_the_null_config(void **state)
{
    (void)state;
    iris_equalize_local_config by;
    iris_scratch scratch = arena(sizeof memory.memory);
    iris_equalize_local_defaults(&by);
    iris_equalize_local_defaults(NULL);
    assert_int_equal(by.tiles, 8);
    assert_int_equal(by.limit_q16, 3 * 65536);
    fill(3, 1);
    iris_image src = view(0, IRIS_GRAY8, 90, 61, 0), dst = view(1, IRIS_GRAY8, 90, 61, 0);
    static uint8_t first[sizeof pixels[1]];
    assert_int_equal(iris_equalize_local(&dst, &src, NULL, &scratch), IRIS_OK);
    memcpy(first, pixels[1], sizeof first);
    assert_int_equal(iris_equalize_local(&dst, &src, &by, &scratch), IRIS_OK);
    assert_memory_equal(first, pixels[1], sizeof first);
}

/* 100 100 100 101 101 103 with cdf 3, 5, 6: round(255 (cdf - 3) / 3). */
static void whole_by_hand(void **state)
{
    (void)state;
    uint8_t row[6] = {100, 101, 103, 100, 101, 100};
    const uint8_t truth[6] = {0, 170, 255, 0, 170, 0};
    iris_image image = {row, 6, 6, 1, IRIS_GRAY8};
    iris_scratch scratch = arena(IRIS_EQUALIZE_SCRATCH_BYTES);
    assert_int_equal(iris_equalize(&image, &image, &scratch), IRIS_OK);
    assert_memory_equal(row, truth, sizeof truth);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, IRIS_EQUALIZE_SCRATCH_BYTES);
    uint8_t flat[3] = {9, 9, 9};
    iris_image one = {flat, 3, 3, 1, IRIS_GRAY8};
    assert_int_equal(iris_equalize(&one, &one, &scratch), IRIS_OK);
    assert_int_equal(flat[0] + flat[1] + flat[2], 27);
    uint8_t color[9] = {200, 100, 100, 0, 0, 0, 60, 60, 60}; /* lightness 150, 0, 60: 255, 0, 128 */
    const uint8_t bright[9] = {255, 255, 255, 0, 0, 0, 128, 128, 128};
    iris_image three = {color, 9, 3, 1, IRIS_BGR888};
    assert_int_equal(iris_equalize(&three, &three, &scratch), IRIS_OK);
    assert_memory_equal(color, bright, sizeof bright);
}

static void whole_against_its_formula(void **state)
{
    (void)state;
    for (int round = 0; round < 60; round++) {
        iris_format format = round % 3 == 0 ? IRIS_GRAY8 : round % 3 == 1 ? IRIS_RGB888 : IRIS_BGR888;
        int32_t w = 1 + round * 31 % SIDE, h = 1 + round * 43 % SIDE, count[256] = {0}, darkest = 255;
        fill(round % 5, (uint32_t)round);
        iris_image src = view(0, format, w, h, round % 2), dst = view(1, format, w, h, !(round % 2));
        for (int32_t i = 0; i < w * h; i++) {
            int32_t l = (twice_lightness(&src, i % w, i / w) + 1) / 2;
            count[l]++;
            darkest = l < darkest ? l : darkest;
        }
        double curve[256], below = 0;
        for (int p = 0; p < 256; p++) {
            below += count[p];
            curve[p] =
                p < darkest ? 0 : floor((below - count[darkest]) * 255 / (w * h - count[darkest]) + 0.5);
            curve[p] = count[darkest] == w * h ? p : curve[p];
        }
        iris_scratch scratch = arena(IRIS_EQUALIZE_SCRATCH_BYTES);
        assert_int_equal(iris_equalize(&dst, &src, &scratch), IRIS_OK);
        for (int32_t i = 0; i < w * h; i++) {
            int l = twice_lightness(&src, i % w, i / w);
            double lightness = (curve[l / 2] + curve[(l + 1) / 2]) / 2;
            if (format == IRIS_GRAY8) {
                assert_int_equal(*at(&dst, i % w, i / w), (int)lightness);
            } else {
                assert_lightness(at(&dst, i % w, i / w), at(&src, i % w, i / w), lightness);
            }
        }
    }
}

static double spread(const picture *of, int32_t x0, int32_t y0)
{
    double sum = 0, squares = 0;
    for (int32_t i = 0; i < 32 * 32; i++) {
        double p = of->pixels[(y0 + i / 32) * of->w + x0 + i % 32];
        sum += p / 1024;
        squares += p * p / 1024;
    }
    return sqrt(squares - sum * sum);
}

/* Every part of the moon gets more contrast, the flat ones in its lower half most. */
static void the_moon_in_tiles(void **state)
{
    (void)state;
    picture moon = load_pnm(data_path("edges/classic/moon_256.pgm"));
    if (!moon.pixels) {
        skip();
    }
    double before[4], after[4];
    iris_image image;
    iris_scratch scratch = arena(sizeof memory.memory);
    assert_int_equal(iris_image_wrap(&image, moon.pixels, (size_t)moon.w * (size_t)moon.h,
                                     (iris_size){moon.w, moon.h}, 0, IRIS_GRAY8),
                     IRIS_OK);
    for (int i = 0; i < 4; i++) {
        before[i] = spread(&moon, 40 + i % 2 * 120, 40 + i / 2 * 120);
    }
    assert_int_equal(iris_equalize_local(&image, &image, NULL, &scratch), IRIS_OK);
    for (int i = 0; i < 4; i++) {
        after[i] = spread(&moon, 40 + i % 2 * 120, 40 + i / 2 * 120);
        assert_true(after[i] > (i < 2 ? 1.1 : 1.5) * before[i] &&
                    after[i] < 4 * before[i]); /* limit + what comes back */
    }
    free(moon.pixels);
}

static void scratch_is_exact(void **state)
{
    (void)state;
    fill(0, 6);
    iris_image src = view(0, IRIS_GRAY8, 50, 40, 0), dst = view(1, IRIS_GRAY8, 50, 40, 0);
    iris_equalize_local_config by = {5, 0};
    iris_scratch scratch = arena(IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(5) - 1);
    assert_int_equal(IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(5), 1024 + 25 * 256);
    assert_int_equal(iris_equalize_local(&dst, &src, &by, &scratch), IRIS_ERR_SCRATCH);
    scratch = arena(IRIS_EQUALIZE_SCRATCH_BYTES - 1);
    assert_int_equal(iris_equalize(&dst, &src, &scratch), IRIS_ERR_SCRATCH);
    for (size_t i = 0; i < sizeof pixels[1]; i++) {
        assert_int_equal(pixels[1][i], 0xA5);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    fill(0, 7);
    iris_scratch scratch = arena(sizeof memory.memory);
    iris_image src = view(0, IRIS_GRAY8, 50, 40, 0), dst = view(1, IRIS_GRAY8, 50, 40, 0), bad = dst;
    assert_int_equal(iris_equalize(NULL, &src, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_equalize(&dst, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_equalize(&dst, &src, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_equalize_local(NULL, &src, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_equalize_local(&dst, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_equalize_local(&dst, &src, NULL, NULL), IRIS_ERR_ARG);
    const iris_equalize_local_config beyond[] = {{0, 0}, {-1, 0}, {65, 0}, {2, -1}, {2, 256 * 65536 + 1}};
    for (int i = 0; i < 5; i++) {
        assert_int_equal(iris_equalize_local(&dst, &src, &beyond[i], &scratch), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_equalize_local(&dst, &src, &(iris_equalize_local_config){41, 0}, &scratch),
                     IRIS_ERR_RANGE);
    bad.w = 49;
    assert_int_equal(iris_equalize(&bad, &src, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_equalize_local(&bad, &src, NULL, &scratch), IRIS_ERR_RANGE);
    bad = src;
    bad.data = pixels[0] + 1;
    assert_int_equal(iris_equalize(&bad, &src, &scratch), IRIS_ERR_ALIAS);
    assert_int_equal(iris_equalize_local(&bad, &src, NULL, &scratch), IRIS_ERR_ALIAS);
    bad = dst;
    bad.format = IRIS_BAYER8_RGGB;
    assert_int_equal(iris_equalize(&bad, &src, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_equalize(&bad, &bad, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_equalize_local(&bad, &bad, NULL, &scratch), IRIS_ERR_FORMAT);
    for (size_t i = 0; i < sizeof pixels[1]; i++) {
        assert_int_equal(pixels[1][i], 0xA5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_by_hand),
        cmocka_unit_test(whole_against_its_formula),
        cmocka_unit_test(local_at_every_size),
        cmocka_unit_test(regions),
        cmocka_unit_test(defaults_are_the_null_config),
        cmocka_unit_test(the_moon_in_tiles),
        cmocka_unit_test(scratch_is_exact),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("equalize", tests, NULL, NULL);
}
