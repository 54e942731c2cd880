/* Tones: levels worked out by hand, and curves, lightness, and adjustment in double precision. */
#include <math.h>

#include "../picture.h"
#include "../test.h"
#include "iris/color.h"
#include "iris/xt/histogram.h"
#include "iris/xt/tone.h"

#define W 37
#define H 23

static uint8_t pixels[2][H * (3 * W + 7)];

static iris_image view(int which, iris_format format, int upside_down)
{
    iris_image image;
    ptrdiff_t stride = (upside_down ? -1 : 1) * (3 * W + 7);
    assert_int_equal(
        iris_image_wrap(&image, pixels[which], sizeof pixels[which], (iris_size){W, H}, stride, format),
        IRIS_OK);
    return image;
}

static void fill_with_noise(uint32_t seed)
{
    for (size_t i = 0; i < sizeof pixels[0]; i++) {
        pixels[0][i] = (uint8_t)next_random(&seed);
    }
    memset(pixels[1], 0xA5, sizeof pixels[1]);
}

static iris_tone fresh(void)
{
    iris_tone tone;
    assert_int_equal(iris_tone_identity(&tone), IRIS_OK);
    return tone;
}

/* Another curve than the identity, to see that steps go behind it. */
static iris_tone started(void)
{
    iris_tone tone;
    for (int p = 0; p < 256; p++) {
        tone.level[p] = (uint8_t)(p * 167 + 13);
    }
    return tone;
}

static int rounded(double value)
{
    return value <= 0 ? 0 : value >= 255 ? 255 : (int)floor(value + 0.5);
}

static void steps_by_hand(void **state)
{
    (void)state;
    iris_tone tone = fresh();
    for (int p = 0; p < 256; p++) {
        assert_int_equal(tone.level[p], p);
    }
    assert_int_equal(iris_tone_add(&tone, 20), IRIS_OK);
    assert_int_equal(tone.level[0], 20);
    assert_int_equal(tone.level[235], 255);
    assert_int_equal(tone.level[255], 255);
    assert_int_equal(iris_tone_negate(&tone), IRIS_OK);
    assert_int_equal(tone.level[0], 235);
    assert_int_equal(tone.level[200], 35);
    assert_int_equal(tone.level[240], 0);
    assert_int_equal(iris_tone_add(&tone, -36), IRIS_OK);
    assert_int_equal(tone.level[0], 199);
    assert_int_equal(tone.level[200], 0);
    assert_int_equal(iris_tone_add(&tone, INT32_MAX), IRIS_OK);
    assert_int_equal(tone.level[200], 255);
    assert_int_equal(iris_tone_add(&tone, INT32_MIN), IRIS_OK);
    assert_int_equal(tone.level[0], 0);
}

static void levels_by_hand(void **state)
{
    (void)state;
    iris_tone tone = fresh();
    assert_int_equal(iris_tone_levels(&tone, 50, 60), IRIS_OK);
    const uint8_t truth[] = {0,   0,   26,  51,  77,  102, 128,
                             153, 179, 204, 230, 255, 255}; /* 25.5 each, half up */
    for (int p = 49; p <= 61; p++) {
        assert_int_equal(tone.level[p], truth[p - 49]);
    }
    assert_int_equal(tone.level[0], 0);
    assert_int_equal(tone.level[255], 255);
    tone = started();
    iris_tone before = tone;
    assert_int_equal(iris_tone_levels(&tone, 0, 255), IRIS_OK);
    assert_memory_equal(&tone, &before, sizeof tone);
    assert_int_equal(iris_tone_levels(&tone, 9, 9), IRIS_OK);
    assert_memory_equal(&tone, &before, sizeof tone);
    for (int low = 0; low < 256; low += 5) {
        for (int high = low + 1; high < 256; high += 3) {
            tone = before;
            assert_int_equal(iris_tone_levels(&tone, low, high), IRIS_OK);
            for (int p = 0; p < 256; p++) {
                assert_int_equal(tone.level[p], rounded((before.level[p] - low) * 255.0 / (high - low)));
            }
        }
    }
}

/* The report's curve: two flat segments and a steep one between, without a jump. */
static void three_segments(void **state)
{
    (void)state;
    iris_tone tone = fresh();
    assert_int_equal(iris_tone_stretch(&tone, NULL), IRIS_OK);
    const int truth[][2] = {{0, 0},     {1, 1},     {2, 1},     {84, 42},   {85, 43},
                            {86, 45},   {127, 127}, {128, 129}, {169, 211}, {170, 213},
                            {171, 213}, {172, 214}, {254, 255}, {255, 255}};
    for (size_t i = 0; i < sizeof truth / sizeof truth[0]; i++) {
        assert_int_equal(tone.level[truth[i][0]], truth[i][1]);
    }
    uint32_t seed = 5;
    for (int round = 0; round < 400; round++) {
        int32_t a = (int32_t)(next_random(&seed) % 256),
                b = a + (int32_t)(next_random(&seed) % (uint32_t)(256 - a));
        int32_t slope[3];
        for (int k = 0; k < 3; k++) {
            slope[k] = (int32_t)(next_random(&seed) << 8) >> (next_random(&seed) % 20);
        }
        iris_tone_segments by = {a, b, slope[0], slope[1], slope[2]};
        iris_tone before = started();
        tone = before;
        assert_int_equal(iris_tone_stretch(&tone, &by), IRIS_OK);
        for (int i = 0; i < 256; i++) {
            int p = before.level[i];
            double at_a = (double)slope[0] * a, at_b = at_a + (double)slope[1] * (b - a);
            double value = p <= a   ? (double)slope[0] * p
                           : p <= b ? at_a + (double)slope[1] * (p - a)
                                    : at_b + (double)slope[2] * (p - b);
            assert_int_equal(tone.level[i], rounded(value / 65536));
        }
    }
}

/* The exact value rounded: c times a logarithm is never half way, and doubles are near enough to know the side. */
static void compression_against_doubles(void **state)
{
    (void)state;
    iris_tone tone = fresh();
    assert_int_equal(iris_tone_compress(&tone, IRIS_TONE_COMPRESS_C), IRIS_OK);
    for (int p = 0; p < 256; p++) {
        assert_int_equal(tone.level[p], rounded(255 / log(256) * log(1 + p)));
    }
    for (int64_t c = 0; c <= INT32_MAX; c += c < 3000 ? 1 : c / 701) {
        iris_tone before = started();
        tone = before;
        assert_int_equal(iris_tone_compress(&tone, (iris_q16)c), IRIS_OK);
        for (int p = 0; p < 256; p++) {
            assert_int_equal(tone.level[p], rounded((double)c / 65536 * log(1 + before.level[p])));
        }
    }
    tone = fresh();
    assert_int_equal(iris_tone_compress(&tone, 3096502), IRIS_OK);
    assert_int_equal(tone.level[158], 239); /* 239.49999999975 */
    tone = fresh();
    assert_int_equal(iris_tone_compress(&tone, INT32_MAX), IRIS_OK);
    assert_int_equal(tone.level[0], 0);
    assert_int_equal(tone.level[1], 255);
}

static void gamma_against_doubles(void **state)
{
    (void)state;
    iris_tone tone = fresh();
    assert_int_equal(iris_tone_gamma(&tone, IRIS_Q16_ONE), IRIS_OK);
    assert_int_equal(iris_tone_gamma(&tone, 2 * IRIS_Q16_ONE), IRIS_OK);
    for (int p = 0; p < 256; p++) {
        assert_int_equal(tone.level[p], (2 * p * p + 255) / 510);
    }
    for (int64_t gamma = 1; gamma <= INT32_MAX; gamma += gamma < 500 ? 1 : gamma / 317) {
        iris_tone before = started();
        tone = before;
        assert_int_equal(iris_tone_gamma(&tone, (iris_q16)gamma), IRIS_OK);
        for (int p = 0; p < 256; p++) {
            assert_int_equal(tone.level[p],
                             rounded(255 * pow(before.level[p] / 255.0, (double)gamma / 65536)));
        }
    }
    tone = fresh();
    assert_int_equal(iris_tone_gamma(&tone, 665922), IRIS_OK);
    assert_int_equal(tone.level[229], 86); /* 85.500000018 */
    tone = fresh();
    assert_int_equal(iris_tone_gamma(&tone, INT32_MAX), IRIS_OK);
    assert_int_equal(tone.level[254], 0);
    assert_int_equal(tone.level[255], 255);
}

static void histograms_make_tones(void **state)
{
    (void)state;
    uint32_t histogram[256] = {0};
    iris_tone tone = fresh(), before = fresh();
    assert_int_equal(iris_tone_equalize(&tone, histogram), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_stretch_share(&tone, histogram, 0), IRIS_ERR_RANGE);
    histogram[40] = 7;
    assert_int_equal(iris_tone_equalize(&tone, histogram), IRIS_OK);
    assert_int_equal(iris_tone_stretch_share(&tone, histogram, 0), IRIS_OK);
    assert_memory_equal(&tone, &before, sizeof tone);
    histogram[50] = 1; /* n = 12: 40 is 0, 50 is 255/5, 52 is 2 * 255/5, 60 is 255 */
    histogram[52] = 1;
    histogram[60] = 3;
    assert_int_equal(iris_tone_equalize(&tone, histogram), IRIS_OK);
    const int truth[][2] = {{0, 0},   {39, 0},   {40, 0},   {49, 0},   {50, 51},
                            {51, 51}, {52, 102}, {59, 102}, {60, 255}, {255, 255}};
    for (size_t i = 0; i < sizeof truth / sizeof truth[0]; i++) {
        assert_int_equal(tone.level[truth[i][0]], truth[i][1]);
    }
    tone = fresh();
    assert_int_equal(iris_tone_stretch_share(&tone, histogram, 0), IRIS_OK);
    assert_int_equal(iris_tone_levels(&before, 40, 60), IRIS_OK);
    assert_memory_equal(&tone, &before, sizeof tone);
    histogram[0] = 1; /* of 13 pixels, one in 13 is 5041 in 65536 */
    tone = fresh();
    assert_int_equal(iris_tone_stretch_share(&tone, histogram, 5042), IRIS_OK);
    assert_memory_equal(&tone, &before, sizeof tone);
    tone = before = fresh();
    assert_int_equal(iris_tone_stretch_share(&tone, histogram, 5041), IRIS_OK);
    assert_int_equal(iris_tone_levels(&before, 0, 60), IRIS_OK);
    assert_memory_equal(&tone, &before, sizeof tone);
    for (int p = 0; p < 256; p++) {
        histogram[p] = UINT32_MAX;
    }
    tone = fresh();
    assert_int_equal(iris_tone_equalize(&tone, histogram), IRIS_OK);
    before = fresh();
    assert_memory_equal(&tone, &before, sizeof tone);
}

/* One look-up gives what the steps give one after the other. */
static void steps_compose(void **state)
{
    (void)state;
    iris_tone both = fresh(), first = fresh(), second = fresh();
    for (iris_tone *tone = &both; tone; tone = tone == &both ? &first : NULL) {
        assert_int_equal(iris_tone_levels(tone, 20, 210), IRIS_OK);
        assert_int_equal(iris_tone_gamma(tone, IRIS_Q16_ONE / 3), IRIS_OK);
    }
    for (iris_tone *tone = &both; tone; tone = tone == &both ? &second : NULL) {
        assert_int_equal(iris_tone_negate(tone), IRIS_OK);
        assert_int_equal(iris_tone_stretch(tone, NULL), IRIS_OK);
    }
    fill_with_noise(1);
    iris_image src = view(0, IRIS_RGB888, 0), dst = view(1, IRIS_RGB888, 0);
    static uint8_t once[sizeof pixels[1]];
    assert_int_equal(iris_tone_apply(&dst, &src, &both), IRIS_OK);
    memcpy(once, pixels[1], sizeof once);
    assert_int_equal(iris_tone_apply(&dst, &src, &first), IRIS_OK);
    assert_int_equal(iris_tone_apply(&dst, &dst, &second), IRIS_OK);
    assert_memory_equal(once, pixels[1], sizeof once);
    assert_int_equal(iris_tone_then(&first, &second), IRIS_OK);
    assert_memory_equal(&first, &both, sizeof both);
    iris_tone mirror = fresh();
    assert_int_equal(iris_tone_negate(&mirror), IRIS_OK);
    assert_int_equal(iris_tone_then(&mirror, &mirror), IRIS_OK);
    first = fresh();
    assert_memory_equal(&mirror, &first, sizeof first);
}

/* Every width, both directions of rows, in place and not; nothing else is written. */
static void pictures_by_table(void **state)
{
    (void)state;
    const iris_format formats[] = {IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};
    iris_tone tone = started();
    for (int round = 0; round < 3 * W; round++) {
        iris_format format = formats[round / W];
        int32_t channels = format == IRIS_GRAY8 ? 1 : 3, w = round % W + 1;
        fill_with_noise((uint32_t)round);
        static uint8_t before[2][sizeof pixels[0]];
        memcpy(before, pixels, sizeof before);
        iris_image src = view(0, format, round % 2), dst = view(round % 3 > 0, format, round % 2);
        iris_rect rect = {W - w, w / 4, w, H - w / 2};
        assert_int_equal(iris_image_crop(&src, &src, rect), IRIS_OK);
        assert_int_equal(iris_image_crop(&dst, &dst, rect), IRIS_OK);
        assert_int_equal(iris_tone_apply(&dst, &src, &tone), IRIS_OK);
        uint8_t *all = before[round % 3 > 0];
        for (int32_t y = 0; y < dst.h; y++) {
            ptrdiff_t at = (uint8_t *)iris_image_row(&src, y) - pixels[0];
            for (int32_t i = 0; i < channels * w; i++) {
                all[at + i] = tone.level[before[0][at + i]];
            }
        }
        assert_memory_equal(pixels[round % 3 > 0], all, sizeof pixels[0]);
    }
}

static void three_tones_and_rows(void **state)
{
    (void)state;
    iris_tone red = fresh(), green = started(), blue = fresh();
    assert_int_equal(iris_tone_negate(&red), IRIS_OK);
    assert_int_equal(iris_tone_add(&blue, 100), IRIS_OK);
    fill_with_noise(3);
    for (int bgr = 0; bgr < 2; bgr++) {
        iris_image src = view(0, bgr ? IRIS_BGR888 : IRIS_RGB888, bgr), dst = view(1, src.format, !bgr);
        assert_int_equal(iris_tone_apply_rgb(&dst, &src, &red, &green, &blue), IRIS_OK);
        for (int32_t i = 0; i < W * H; i++) {
            const uint8_t *from = (uint8_t *)iris_image_row(&src, i / W) + i % W * 3;
            const uint8_t *to = (uint8_t *)iris_image_row(&dst, i / W) + i % W * 3;
            assert_int_equal(to[bgr ? 2 : 0], 255 - from[bgr ? 2 : 0]);
            assert_int_equal(to[1], green.level[from[1]]);
            assert_int_equal(to[bgr ? 0 : 2], from[bgr ? 0 : 2] > 155 ? 255 : from[bgr ? 0 : 2] + 100);
        }
    }
    assert_int_equal(iris_tone_row(pixels[1], pixels[0] + 1, 50, &red), IRIS_OK);
    assert_int_equal(pixels[1][49], 255 - pixels[0][50]);
    assert_int_equal(iris_tone_row(pixels[1], pixels[0], 0, &red), IRIS_OK);
    assert_int_equal(iris_tone_row(pixels[1], pixels[1], 1, &red), IRIS_OK);
    assert_int_equal(pixels[1][0], pixels[0][1]);
    assert_int_equal(iris_tone_row(pixels[0], pixels[0] + 1, 2, &red), IRIS_ERR_ALIAS);
    assert_int_equal(iris_tone_row(pixels[0] + 1, pixels[0], 2, &red), IRIS_ERR_ALIAS);
    assert_int_equal(iris_tone_row(pixels[0], pixels[1], -1, &red), IRIS_ERR_RANGE);
}

/* ---- color ---- */

typedef struct {
    double h, s, l; /* of 60 degrees, 0..1, 0..1 */
} real_hsl;

static real_hsl hsl_of(const uint8_t *rgb)
{
    double r = rgb[0] / 255.0, g = rgb[1] / 255.0, b = rgb[2] / 255.0;
    double max = fmax(r, fmax(g, b)), min = fmin(r, fmin(g, b)), c = max - min;
    real_hsl hsl = {0, 0, (max + min) / 2};
    if (rgb[0] != rgb[1] || rgb[1] != rgb[2]) {
        hsl.s = c / (1 - fabs(max + min - 1));
        hsl.h = max == r ? (g - b) / c : max == g ? 2 + (b - r) / c : 4 + (r - g) / c;
    }
    return hsl;
}

static void assert_color(const uint8_t *rgb, real_hsl truth)
{
    double c = (1 - fabs(2 * truth.l - 1)) * truth.s;
    const double away[3] = {0, 4, 2};
    for (int k = 0; k < 3; k++) {
        double turned = fmod(truth.h + away[k] + 24, 6);
        double share = fmin(1, fmax(0, fabs(turned - 3) - 1));
        assert_true(fabs(rgb[k] - 255 * (truth.l - c / 2 + c * share)) < 0.51);
    }
}

static double limited(double value)
{
    return fmin(1, fmax(0, value));
}

static void adjustment_against_doubles(void **state)
{
    (void)state;
    uint32_t seed = 77;
    for (int round = 0; round < 300; round++) {
        fill_with_noise(seed);
        for (int i = 0; i < 300; i++) { /* some grays and pure colors */
            pixels[0][3 * (i % 20) + i / 60] = (uint8_t)(i % 3 * 127 + (i % 3 == 1 ? 60 : 0));
        }
        iris_adjustment by = {
            (int32_t)(next_random(&seed) % 511) - 255, 0,
            -(int32_t)(next_random(&seed) % 256),      (int32_t)(next_random(&seed) % 4000) - 2000,
            (int32_t)(next_random(&seed) % 201) - 100, (int32_t)(next_random(&seed) % 201) - 100};
        by.red = round % 3 ? 0 : by.red;
        by.blue = round % 3 ? 0 : by.blue;
        by.saturation = round % 4 == 1 ? 0 : by.saturation;
        by.lightness = round % 5 == 1 ? 0 : by.lightness;
        iris_image src = view(0, IRIS_RGB888, 0), dst = view(1, IRIS_RGB888, 1);
        assert_int_equal(iris_adjust(&dst, &src, &by), IRIS_OK);
        for (int32_t i = 0; i < W * H; i++) {
            const uint8_t *from = (uint8_t *)iris_image_row(&src, i / W) + i % W * 3;
            uint8_t shifted[3] = {(uint8_t)rounded(from[0] + by.red), from[1],
                                  (uint8_t)rounded(from[2] + by.blue)};
            real_hsl hsl = hsl_of(shifted);
            hsl.h += fmod(by.hue / 60.0, 6);
            hsl.s = hsl.s > 0 ? limited(hsl.s + by.saturation / 100.0) : 0;
            hsl.l = limited(hsl.l + by.lightness / 100.0);
            assert_color((uint8_t *)iris_image_row(&dst, i / W) + i % W * 3, hsl);
        }
    }
}

static void adjusted(uint8_t r, uint8_t g, uint8_t b, iris_adjustment by, uint32_t truth)
{
    for (int bgr = 0; bgr < 2; bgr++) {
        uint8_t pixel[3] = {bgr ? b : r, g, bgr ? r : b};
        iris_image image = {pixel, 3, 1, 1, bgr ? IRIS_BGR888 : IRIS_RGB888};
        assert_int_equal(iris_adjust(&image, &image, &by), IRIS_OK);
        assert_int_equal(pixel[bgr ? 2 : 0] << 16 | pixel[1] << 8 | pixel[bgr ? 0 : 2], truth);
    }
}

static void adjustment_by_hand(void **state)
{
    (void)state;
    adjusted(10, 20, 30, (iris_adjustment){250, -21, 5, 0, 0, 0}, 0xFF0023);
    adjusted(255, 0, 0, (iris_adjustment){.hue = 120}, 0x00FF00);
    adjusted(255, 0, 0, (iris_adjustment){.hue = -120}, 0x0000FF);
    adjusted(255, 0, 0, (iris_adjustment){.hue = 60}, 0xFFFF00);
    adjusted(255, 0, 0, (iris_adjustment){.hue = INT32_MAX}, 0x00FF1E); /* 127 degrees and whole turns */
    adjusted(200, 100, 100, (iris_adjustment){.hue = 360}, 0xC86464);
    adjusted(200, 100, 100, (iris_adjustment){.saturation = -100}, 0x969696);
    adjusted(200, 100, 100, (iris_adjustment){.saturation = 100}, 0xFF2D2D);
    adjusted(90, 90, 90, (iris_adjustment){.saturation = 100, .hue = 77}, 0x5A5A5A);
    adjusted(0, 0, 255, (iris_adjustment){.lightness = 100}, 0xFFFFFF);
    adjusted(0, 0, 255, (iris_adjustment){.lightness = -100}, 0x000000);
    adjusted(0, 0, 255, (iris_adjustment){.lightness = 20}, 0x6666FF);
    adjusted(99, 99, 99, (iris_adjustment){.lightness = 10}, 0x7D7D7D); /* half up */
    adjusted(0, 0, 0, (iris_adjustment){.lightness = 20}, 0x333333);
    adjusted(0, 0, 0, (iris_adjustment){.red = 51, .lightness = 10}, 0x660000);
}

/* Zeros change nothing, whole turns change nothing, and neither does the identity on the lightness: of all colors. */
static void nothing_changes_nothing(void **state)
{
    (void)state;
    static uint8_t from[3 * 4096], to[3 * 4096];
    iris_image src = {from, sizeof from, 4096, 1, IRIS_RGB888}, dst = {to, sizeof to, 4096, 1, IRIS_RGB888};
    const iris_adjustment zeros = {0}, turns = {.hue = 720};
    iris_tone identity = fresh();
    for (uint32_t start = 0; start < 1u << 24; start += 4096 * 19) {
        for (uint32_t i = 0; i < 4096; i++) {
            uint32_t color = (start + i) * 2654435761u >> 8;
            from[3 * i] = (uint8_t)color;
            from[3 * i + 1] = (uint8_t)(color >> 8);
            from[3 * i + 2] = (uint8_t)(color >> 16);
        }
        assert_int_equal(iris_adjust(&dst, &src, start % 3 ? &zeros : &turns), IRIS_OK);
        assert_memory_equal(from, to, sizeof to);
        assert_int_equal(iris_tone_apply_lightness(&dst, &src, &identity), IRIS_OK);
        assert_memory_equal(from, to, sizeof to);
    }
}

static void lightness_against_doubles(void **state)
{
    (void)state;
    iris_tone tone = fresh();
    assert_int_equal(iris_tone_gamma(&tone, IRIS_Q16_ONE / 2), IRIS_OK);
    assert_int_equal(iris_tone_negate(&tone), IRIS_OK);
    fill_with_noise(8);
    iris_image src = view(0, IRIS_RGB888, 1), dst = view(1, IRIS_RGB888, 0);
    assert_int_equal(iris_tone_apply_lightness(&dst, &src, &tone), IRIS_OK);
    for (int32_t i = 0; i < W * H; i++) {
        const uint8_t *from = (uint8_t *)iris_image_row(&src, i / W) + i % W * 3;
        real_hsl hsl = hsl_of(from);
        double level = 255 * hsl.l;
        hsl.l = (tone.level[(int)floor(level + 1e-9)] + tone.level[(int)ceil(level - 1e-9)]) / 510.0;
        assert_color((uint8_t *)iris_image_row(&dst, i / W) + i % W * 3, hsl);
    }
    static uint8_t as_rgb[sizeof pixels[0]];
    memcpy(as_rgb, pixels[0], sizeof as_rgb);
    iris_image bgr = src;
    assert_int_equal(iris_color_convert(&(iris_image){src.data, src.stride, W, H, IRIS_BGR888}, &src),
                     IRIS_OK);
    bgr.format = IRIS_BGR888;
    assert_int_equal(iris_tone_apply_lightness(&bgr, &bgr, &tone), IRIS_OK);
    for (int32_t i = 0; i < W * H; i++) {
        const uint8_t *a = (uint8_t *)iris_image_row(&bgr, i / W) + i % W * 3;
        const uint8_t *b = (uint8_t *)iris_image_row(&dst, i / W) + i % W * 3;
        assert_true(a[0] == b[2] && a[1] == b[1] && a[2] == b[0]);
    }
    src = view(0, IRIS_GRAY8, 0);
    iris_image gray = view(1, IRIS_GRAY8, 0);
    assert_int_equal(iris_tone_apply_lightness(&gray, &src, &tone), IRIS_OK);
    assert_int_equal(pixels[1][W - 1], tone.level[pixels[0][W - 1]]);
}

/* The moon's picture has few levels: between its percentiles it fills them all. */
static void the_moon_gets_contrast(void **state)
{
    (void)state;
    picture moon = load_pnm(data_path("edges/classic/moon_256.pgm"));
    if (!moon.pixels) {
        skip();
    }
    size_t bytes = (size_t)moon.w * (size_t)moon.h;
    iris_image image;
    uint32_t histogram[256];
    iris_tone tone = fresh();
    assert_int_equal(iris_image_wrap(&image, moon.pixels, bytes, (iris_size){moon.w, moon.h}, 0, IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_histogram(histogram, &image, 0, NULL), IRIS_OK);
    assert_int_equal(iris_tone_stretch_share(&tone, histogram, 655), IRIS_OK);
    assert_int_equal(iris_tone_apply(&image, &image, &tone), IRIS_OK);
    size_t black = 0, white = 0;
    for (size_t i = 0; i < bytes; i++) {
        black += moon.pixels[i] == 0;
        white += moon.pixels[i] == 255;
    }
    assert_true(black * 100 >= bytes && white * 100 >= bytes); /* at least one percent reaches each end, */
    assert_true(black * 10 < bytes && white * 10 < bytes);     /* and not many more */
    free(moon.pixels);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_tone tone = started(), before = tone;
    uint32_t histogram[256] = {1};
    assert_int_equal(iris_tone_identity(NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_negate(NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_add(NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_then(&tone, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_then(NULL, &tone), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_compress(NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_compress(&tone, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_gamma(NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_gamma(&tone, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_gamma(&tone, INT32_MIN), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_stretch(NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_stretch(&tone, &(iris_tone_segments){-1, 5, 0, 0, 0}), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_stretch(&tone, &(iris_tone_segments){6, 5, 0, 0, 0}), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_stretch(&tone, &(iris_tone_segments){6, 256, 0, 0, 0}), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_levels(NULL, 1, 2), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_levels(&tone, -1, 2), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_levels(&tone, 3, 2), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_levels(&tone, 3, 256), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_stretch_share(NULL, histogram, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_stretch_share(&tone, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_stretch_share(&tone, histogram, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_stretch_share(&tone, histogram, 32768), IRIS_ERR_RANGE);
    assert_int_equal(iris_tone_equalize(NULL, histogram), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_equalize(&tone, NULL), IRIS_ERR_ARG);
    assert_memory_equal(&tone, &before, sizeof tone);
    iris_tone_segments_defaults(NULL);
}

static void wrong_pictures_are_refused(void **state)
{
    (void)state;
    fill_with_noise(2);
    iris_tone tone = started();
    iris_adjustment none = {0};
    iris_image gray = view(0, IRIS_GRAY8, 0), out = view(1, IRIS_GRAY8, 0), bad = out;
    iris_image rgb = view(0, IRIS_RGB888, 0), rgb_out = view(1, IRIS_RGB888, 0), part;
    iris_image hsl = view(0, IRIS_HSL24, 0), whole = gray;
    assert_int_equal(iris_tone_apply(NULL, &gray, &tone), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_apply(&out, NULL, &tone), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_apply(&out, &gray, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_apply(&out, &rgb, &tone), IRIS_ERR_FORMAT);
    assert_int_equal(iris_tone_apply(&rgb_out, &hsl, &tone), IRIS_ERR_FORMAT);
    bad.w--;
    assert_int_equal(iris_tone_apply(&bad, &gray, &tone), IRIS_ERR_RANGE);
    bad.w = 0;
    assert_int_equal(iris_tone_apply(&bad, &gray, &tone), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_crop(&part, &gray, (iris_rect){1, 0, W - 1, H}), IRIS_OK);
    gray.w--;
    assert_int_equal(iris_tone_apply(&part, &gray, &tone), IRIS_ERR_ALIAS);
    assert_int_equal(iris_tone_apply_lightness(&part, &gray, &tone), IRIS_ERR_ALIAS);
    assert_int_equal(iris_tone_apply_lightness(&rgb_out, &rgb, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_apply_lightness(&rgb_out, NULL, &tone), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_apply_rgb(&rgb_out, &rgb, &tone, NULL, &tone), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_apply_rgb(&out, &whole, &tone, &tone, &tone), IRIS_ERR_FORMAT);
    assert_int_equal(iris_adjust(&rgb_out, &rgb, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_adjust(&out, &whole, &none), IRIS_ERR_FORMAT);
    const iris_adjustment beyond[] = {
        {.red = 256}, {.green = -256}, {.blue = INT32_MIN}, {.saturation = 101}, {.lightness = -101}};
    for (int i = 0; i < 5; i++) {
        assert_int_equal(iris_adjust(&rgb_out, &rgb, &beyond[i]), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_tone_row(NULL, pixels[0], 1, &tone), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_row(pixels[1], NULL, 1, &tone), IRIS_ERR_ARG);
    assert_int_equal(iris_tone_row(pixels[1], pixels[0], 1, NULL), IRIS_ERR_ARG);
    for (size_t i = 0; i < sizeof pixels[1]; i++) {
        assert_int_equal(pixels[1][i], 0xA5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_by_hand),
        cmocka_unit_test(levels_by_hand),
        cmocka_unit_test(three_segments),
        cmocka_unit_test(compression_against_doubles),
        cmocka_unit_test(gamma_against_doubles),
        cmocka_unit_test(histograms_make_tones),
        cmocka_unit_test(steps_compose),
        cmocka_unit_test(pictures_by_table),
        cmocka_unit_test(three_tones_and_rows),
        cmocka_unit_test(adjustment_by_hand),
        cmocka_unit_test(adjustment_against_doubles),
        cmocka_unit_test(nothing_changes_nothing),
        cmocka_unit_test(lightness_against_doubles),
        cmocka_unit_test(the_moon_gets_contrast),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(wrong_pictures_are_refused),
    };
    return cmocka_run_group_tests_name("tone", tests, NULL, NULL);
}
