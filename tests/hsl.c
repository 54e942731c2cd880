/* HSL: every one of the 2^24 colors, held against a double-precision reference. */
#include <math.h>

#include "iris/color.h"
#include "test.h"

typedef struct {
    double h, s, l; /* degrees, 0..1, 0..1 */
} reference;

/* The textbook's HSL (Foley and van Dam). */
static reference reference_of(int r, int g, int b)
{
    double max = fmax(r, fmax(g, b)) / 255, min = fmin(r, fmin(g, b)) / 255, c = max - min;
    double red = r / 255.0, green = g / 255.0, blue = b / 255.0;
    reference hsl = {0, 0, (max + min) / 2};
    if (r != g || g != b) {
        hsl.s = c / (1 - fabs(2 * hsl.l - 1));
        hsl.h = max == red ? (green - blue) / c : max == green ? 2 + (blue - red) / c : 4 + (red - green) / c;
        hsl.h = hsl.h < 0 ? 60 * hsl.h + 360 : 60 * hsl.h;
    }
    return hsl;
}

/* How far apart two hues are, in steps of which `turn` make a turn. */
static double hue_error(double a, double b, double turn)
{
    double error = fabs(a - b);
    return fmin(error, turn - error);
}

/* The 256 colors of one red and green, rg = 256 red + green. */
static void all_blues(uint8_t rgb[256 * 3], int rg)
{
    for (int b = 0; b < 256; b++) {
        rgb[3 * b] = (uint8_t)(rg >> 8);
        rgb[3 * b + 1] = (uint8_t)rg;
        rgb[3 * b + 2] = (uint8_t)b;
    }
}

static void every_color_comes_back_from_hsl48(void **state)
{
    (void)state;
    static uint8_t rgb[256 * 3], back[256 * 3];
    static uint16_t hsl[256 * 3];
    uint32_t wrong = 0;
    double worst_h = 0, worst_s = 0, worst_l = 0;
    for (int rg = 0; rg < 65536; rg++) {
        all_blues(rgb, rg);
        assert_int_equal(iris_color_row(hsl, IRIS_HSL48, rgb, IRIS_RGB888, 256), IRIS_OK);
        assert_int_equal(iris_color_row(back, IRIS_RGB888, hsl, IRIS_HSL48, 256), IRIS_OK);
        wrong += memcmp(rgb, back, sizeof rgb) != 0;
        for (int b = 0; b < 256; b++) {
            reference truth = reference_of(rg >> 8, rg & 255, b);
            const uint16_t *is = hsl + 3 * b;
            wrong += is[0] > 1535 || is[2] > 510;
            worst_h = fmax(worst_h, hue_error(is[0], truth.h * 1536 / 360, 1536));
            worst_s = fmax(worst_s, fabs(is[1] - truth.s * 65535));
            worst_l = fmax(worst_l, fabs(is[2] - truth.l * 510));
        }
    }
    print_message("# HSL48: largest errors %.4f %.4f %.4f steps\n", worst_h, worst_s, worst_l);
    assert_int_equal(wrong, 0);
    assert_true(worst_h <= 0.5 + 1e-9 && worst_s <= 0.5 + 1e-9 && worst_l <= 1e-9);
}

static void every_color_comes_near_from_hsl24(void **state)
{
    (void)state;
    static uint8_t rgb[256 * 3], hsl[256 * 3], back[256 * 3];
    int worst = 0;
    double worst_h = 0, worst_s = 0, worst_l = 0;
    for (int rg = 0; rg < 65536; rg++) {
        all_blues(rgb, rg);
        assert_int_equal(iris_color_row(hsl, IRIS_HSL24, rgb, IRIS_RGB888, 256), IRIS_OK);
        assert_int_equal(iris_color_row(back, IRIS_RGB888, hsl, IRIS_HSL24, 256), IRIS_OK);
        for (int i = 0; i < 3 * 256; i++) {
            int error = abs(rgb[i] - back[i]);
            worst = error > worst ? error : worst;
        }
        for (int b = rg % 7; b < 256; b += 7) {
            reference truth = reference_of(rg >> 8, rg & 255, b);
            worst_h = fmax(worst_h, hue_error(hsl[3 * b], truth.h * 256 / 360, 256));
            worst_s = fmax(worst_s, fabs(hsl[3 * b + 1] - truth.s * 255));
            worst_l = fmax(worst_l, fabs(hsl[3 * b + 2] - truth.l * 255));
        }
    }
    print_message("# HSL24: largest error of a channel after the way back %d\n", worst);
    assert_int_equal(worst, 4);
    assert_true(worst_h <= 0.5 + 1e-9 && worst_s <= 0.5 + 1e-9 && worst_l <= 0.5 + 1e-9);
}

static void known_colors(void **state)
{
    (void)state;
    const struct {
        iris_color color;
        iris_hsl hsl;
    } known[] = {
        {{255, 0, 0}, {0, 65535, 255}},
        {{255, 255, 0}, {256, 65535, 255}},
        {{0, 255, 0}, {512, 65535, 255}},
        {{0, 255, 255}, {768, 65535, 255}},
        {{0, 0, 255}, {1024, 65535, 255}},
        {{255, 0, 255}, {1280, 65535, 255}},
        {{0, 0, 0}, {0, 0, 0}},
        {{255, 255, 255}, {0, 0, 510}},
        {{128, 128, 128}, {0, 0, 256}},
        {{255, 0, 1}, {1535, 65535, 255}},
        {{192, 64, 64}, {0, 33026, 256}}, /* S = 128 / 254 */
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        iris_hsl hsl = iris_hsl_from_color(known[i].color);
        assert_memory_equal(&hsl, &known[i].hsl, sizeof hsl);
        iris_color color = iris_color_from_hsl(known[i].hsl);
        assert_memory_equal(&color, &known[i].color, sizeof color);
    }
}

/* Any three numbers give a color, and one of the lightness asked for. */
static void any_hsl_is_a_color(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 400000; i++) {
        iris_hsl hsl = {(uint16_t)(i * 40503u), (uint16_t)(i * 30011u >> 3),
                        (uint16_t)(i % 3 ? i % 512 : i * 7919u)};
        iris_color color = iris_color_from_hsl(hsl);
        int sum = (int)lrint(510 * reference_of(color.r, color.g, color.b).l);
        assert_true(abs(sum - (hsl.l > 510 ? 510 : hsl.l)) <= 1);
        iris_hsl wrapped = {(uint16_t)(hsl.h % 1536), hsl.s, hsl.l > 510 ? 510 : hsl.l};
        iris_color same = iris_color_from_hsl(wrapped);
        assert_memory_equal(&color, &same, sizeof same);
    }
}

static void bgr_rows_and_rows_in_place(void **state)
{
    (void)state;
    enum { N = 100 };
    uint8_t rgb[3 * N], bgr[3 * N], out[3 * N], compact[3 * N];
    uint16_t a[3 * N], b[3 * N];
    for (int i = 0; i < N; i++) {
        for (int c = 0; c < 3; c++) {
            rgb[3 * i + c] = (uint8_t)(i * 37 + c * 91 + i * c * 11);
            bgr[3 * i + 2 - c] = rgb[3 * i + c];
        }
    }
    assert_int_equal(iris_color_row(a, IRIS_HSL48, rgb, IRIS_RGB888, N), IRIS_OK);
    assert_int_equal(iris_color_row(b, IRIS_HSL48, bgr, IRIS_BGR888, N), IRIS_OK);
    assert_memory_equal(a, b, sizeof a);
    assert_int_equal(iris_color_row(out, IRIS_BGR888, a, IRIS_HSL48, N), IRIS_OK);
    assert_memory_equal(out, bgr, sizeof bgr);
    assert_int_equal(iris_color_row(compact, IRIS_HSL24, rgb, IRIS_RGB888, N), IRIS_OK);
    assert_int_equal(iris_color_row(bgr, IRIS_HSL24, bgr, IRIS_BGR888, N), IRIS_OK);
    assert_memory_equal(bgr, compact, sizeof compact);
    assert_int_equal(iris_color_row(out, IRIS_BGR888, compact, IRIS_HSL24, N), IRIS_OK);
    assert_int_equal(iris_color_row(bgr, IRIS_BGR888, bgr, IRIS_HSL24, N), IRIS_OK);
    assert_memory_equal(bgr, out, sizeof out);

    assert_int_equal(iris_color_row((uint8_t *)a + 1, IRIS_HSL48, rgb, IRIS_RGB888, 10), IRIS_ERR_ALIGN);
    assert_int_equal(iris_color_row(a, IRIS_HSL48, a, IRIS_RGB888, 10), IRIS_ERR_ALIAS);
    assert_int_equal(iris_color_row(a, IRIS_HSL48, rgb, IRIS_GRAY8, 10), IRIS_ERR_FORMAT);
    assert_int_equal(iris_color_row(rgb, IRIS_GRAY8, a, IRIS_HSL48, 10), IRIS_ERR_FORMAT);
}

/* Quotients of small whole numbers compare with whole numbers exactly in double precision. */
static int in_range(const iris_hsl_range *range, int r, int g, int b)
{
    int max = r > g ? r : g, min = r > g ? g : r;
    max = b > max ? b : max;
    min = b < min ? b : min;
    double c = max - min, sum = max + min, hue = 0, saturation = 0;
    if (c > 0) {
        saturation = 100 * c / (sum <= 255 ? sum : 510 - sum);
        hue = max == g ? 120 + 60 * (b - r) / c : max == b ? 240 + 60 * (r - g) / c : 60 * (g - b) / c;
        hue = hue < 0 ? hue + 360 : hue;
        if (max == g && max == r) {
            hue = 60;
        }
    }
    int inside;
    if (range->h0 <= range->h1) {
        inside = (hue >= range->h0 && hue <= range->h1) || (hue == 0 && range->h1 == 360);
    } else {
        inside = hue >= range->h0 || hue <= range->h1;
    }
    return inside && saturation >= range->s0 && saturation <= range->s1 && 100 * sum / 510 >= range->l0 &&
           100 * sum / 510 <= range->l1;
}

static void range_agrees_with_the_reference(void **state)
{
    (void)state;
    static const iris_hsl_range ranges[] = {
        {0, 360, 0, 100, 0, 100},   {350, 10, 30, 100, 20, 80},  {40, 70, 25, 100, 30, 90},
        {360, 360, 0, 100, 0, 100}, {0, 0, 0, 0, 20, 50},        {60, 60, 100, 100, 20, 50},
        {10, 360, 0, 100, 0, 100},  {360, 20, 1, 100, 0, 100},   {200, 199, 0, 100, 0, 49},
        {120, 240, 0, 50, 0, 100},  {240, 120, 10, 90, 90, 100}, {0, 360, 1, 100, 0, 100},
        {0, 360, 0, 0, 0, 100},     {300, 0, 0, 100, 0, 0},      {1, 359, 0, 100, 0, 100},
        {0, 180, 33, 34, 33, 67}};
    static uint8_t rgb[3 * 512];
    static uint32_t mask[512 / 32];
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        iris_hsl_range_test test;
        assert_int_equal(iris_hsl_range_prepare(&test, &ranges[i]), IRIS_OK);
        uint32_t color = 0, wrong = 0, inside = 0;
        for (int block = 0; block < 1000; block++) {
            for (int k = 0; k < 512; k++, color += 33721) {
                rgb[3 * k] = (uint8_t)(color >> 16);
                rgb[3 * k + 1] = (uint8_t)(color >> 8);
                rgb[3 * k + 2] = (uint8_t)color;
                if (k % 8 < 3) { /* on the planes and faces of the color cube: ties, full saturation */
                    rgb[3 * k + k % 8] = k % 16 < 8 ? 0 : rgb[3 * k + (k + 1) % 3];
                }
                if (k % 8 == 3) {
                    memset(rgb + 3 * k, (int)(color & 255), 3);
                }
            }
            assert_int_equal(iris_hsl_range_row(mask, rgb, 512, &test), IRIS_OK);
            for (int k = 0; k < 512; k++) {
                int expected = in_range(&ranges[i], rgb[3 * k], rgb[3 * k + 1], rgb[3 * k + 2]);
                wrong += expected != (int)(mask[k / 32] >> (k % 32) & 1u);
                inside += expected;
            }
        }
        assert_int_equal(wrong, 0);
        assert_true(inside > 0);
    }
}

static void range_of_known_colors(void **state)
{
    (void)state;
    iris_hsl_range_test test;
    iris_hsl_range red = {350, 10, 50, 100, 20, 80}, all = {0, 360, 0, 100, 0, 100},
                   pale = {0, 360, 1, 100, 0, 100};
    assert_int_equal(iris_hsl_range_prepare(&test, &red), IRIS_OK);
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){200, 20, 20}), 1);
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){200, 20, 40}), 1); /* 353 degrees */
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){200, 80, 20}), 0); /* 20 degrees */
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){20, 20, 20}), 0);
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){255, 250, 250}), 0);
    assert_int_equal(iris_hsl_range_prepare(&test, &all), IRIS_OK);
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){0, 0, 0}), 1);
    assert_int_equal(iris_hsl_range_prepare(&test, &pale), IRIS_OK);
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){0, 0, 0}), 0);
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){255, 255, 255}), 0);
    assert_int_equal(iris_hsl_range_has(&test, (iris_color){0, 0, 1}), 1);
}

static void range_refuses_bad_bounds(void **state)
{
    (void)state;
    const iris_hsl_range bad[] = {{-1, 10, 0, 100, 0, 100},
                                  {0, 361, 0, 100, 0, 100},
                                  {0, 10, 60, 50, 0, 100},
                                  {0, 10, -1, 50, 0, 100},
                                  {0, 10, 0, 101, 0, 100},
                                  {0, 10, 0, 100, 2, 1},
                                  {0, 10, 0, 100, 0, 101},
                                  {INT32_MAX, INT32_MIN, 0, 100, 0, 100},
                                  {0, 10, 0, 100, INT32_MIN, INT32_MAX}};
    iris_hsl_range_test test, before;
    memset(&test, 0x5A, sizeof test);
    before = test;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(iris_hsl_range_prepare(&test, &bad[i]), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_hsl_range_prepare(&test, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hsl_range_prepare(NULL, &bad[0]), IRIS_ERR_ARG);
    assert_memory_equal(&test, &before, sizeof test);
}

/* A color of each whole degree, and corners of the cube: all ranges of hue that begin or end at a change of sector. */
static void range_of_bgr_is_that_of_rgb(void **state)
{
    (void)state;
    enum { W = 360 + 343, WORDS = (W + 31) / 32 };
    static const int32_t hues[] = {0,   1,   59,  60,  61,  119, 120, 121, 180,
                                   239, 240, 241, 299, 300, 301, 359, 360};
    static const uint8_t levels[] = {0, 1, 51, 102, 128, 254, 255};
    enum { HUES = sizeof hues / sizeof hues[0] };
    uint8_t rgb[3 * W], bgr[3 * W];
    for (int i = 0; i < 360; i++) {
        int sector = i / 60, up = sector % 2 ? 60 - i % 60 : i % 60;
        for (int c = 0; c < 3; c++) {
            int most = (sector + 1) / 2 % 3 == c, least = (sector / 2 + 2) % 3 == c;
            rgb[3 * i + c] = (uint8_t)(most ? 60 : least ? 0 : up);
        }
    }
    for (int k = 0; k < 343; k++) {
        uint8_t *corner = &rgb[3 * (360 + k)];
        corner[0] = levels[k % 7];
        corner[1] = levels[k / 7 % 7];
        corner[2] = levels[k / 49];
    }
    for (int i = 0; i < 3 * W; i++) {
        bgr[i] = rgb[i - i % 3 + 2 - i % 3];
    }
    for (int i = 0; i < HUES * HUES; i++) {
        iris_hsl_range range = {hues[i / HUES], hues[i % HUES], i % 3 * 20, 100, 0, 100};
        uint32_t of_rgb[WORDS] = {0}, of_bgr[WORDS] = {0};
        iris_image src, mask;
        assert_int_equal(iris_image_wrap(&src, rgb, sizeof rgb, (iris_size){W, 1}, 0, IRIS_RGB888), IRIS_OK);
        assert_int_equal(iris_image_wrap(&mask, of_rgb, sizeof of_rgb, (iris_size){W, 1}, 0, IRIS_MASK1),
                         IRIS_OK);
        assert_int_equal(iris_hsl_range_mask(&mask, &src, &range), IRIS_OK);
        assert_int_equal(iris_image_wrap(&src, bgr, sizeof bgr, (iris_size){W, 1}, 0, IRIS_BGR888), IRIS_OK);
        assert_int_equal(iris_image_wrap(&mask, of_bgr, sizeof of_bgr, (iris_size){W, 1}, 0, IRIS_MASK1),
                         IRIS_OK);
        assert_int_equal(iris_hsl_range_mask(&mask, &src, &range), IRIS_OK);
        assert_memory_equal(of_rgb, of_bgr, sizeof of_rgb);
    }
}

static void range_rows_keep_the_bits_past_the_end(void **state)
{
    (void)state;
    iris_hsl_range all = {0, 360, 0, 100, 0, 100}, none = {0, 360, 100, 100, 100, 100};
    iris_hsl_range_test test;
    uint8_t rgb[3 * 70] = {0};
    for (int n = 1; n <= 70; n++) {
        uint32_t mask[4] = {0, 0, 0, 0};
        assert_int_equal(iris_hsl_range_prepare(&test, &all), IRIS_OK);
        assert_int_equal(iris_hsl_range_row(mask, rgb, n, &test), IRIS_OK);
        for (int i = 0; i < 128; i++) {
            assert_int_equal(mask[i / 32] >> (i % 32) & 1u, i < n);
        }
        memset(mask, 0xFF, sizeof mask);
        assert_int_equal(iris_hsl_range_prepare(&test, &none), IRIS_OK);
        assert_int_equal(iris_hsl_range_row(mask, rgb, n, &test), IRIS_OK);
        for (int i = 0; i < 128; i++) {
            assert_int_equal(mask[i / 32] >> (i % 32) & 1u, i >= n);
        }
    }
    uint32_t mask[64];
    assert_int_equal(iris_hsl_range_row(NULL, rgb, 1, &test), IRIS_ERR_ARG);
    assert_int_equal(iris_hsl_range_row(mask, NULL, 1, &test), IRIS_ERR_ARG);
    assert_int_equal(iris_hsl_range_row(mask, rgb, 1, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hsl_range_row(mask, rgb, 0, &test), IRIS_ERR_RANGE);
    assert_int_equal(iris_hsl_range_row(mask, rgb, IRIS_SIDE_MAX + 1, &test), IRIS_ERR_RANGE);
    assert_int_equal(iris_hsl_range_row((uint32_t *)(void *)((uint8_t *)mask + 2), rgb, 1, &test),
                     IRIS_ERR_ALIGN);
    assert_int_equal(iris_hsl_range_row(mask, (uint8_t *)mask + 3, 32, &test), IRIS_ERR_ALIAS);
    assert_int_equal(iris_hsl_range_row(mask, (uint8_t *)mask + 4, 32, &test), IRIS_OK);
}

static void range_of_a_view_is_that_of_its_rows(void **state)
{
    (void)state;
    enum { W = 150, H = 5 };
    static uint8_t rgb[H][3 * W], bgr[H][3 * W];
    static uint8_t rgb565[H][2 * W];
    uint32_t of_rgb[H][5], of_bgr[H][5], row[5];
    for (int i = 0; i < H * W; i++) { /* colors that RGB565 holds exactly */
        uint32_t r = (uint32_t)i * 7 % 32, g = (uint32_t)i * 11 % 64, b = (uint32_t)i * 5 / 3 % 32;
        rgb565[i / W][i % W * 2] = (uint8_t)(g << 5 | b); /* the low byte comes first */
        rgb565[i / W][i % W * 2 + 1] = (uint8_t)(r << 3 | g >> 3);
        uint8_t *pixel = &rgb[i / W][i % W * 3], *mirror = &bgr[i / W][i % W * 3];
        mirror[2] = pixel[0] = (uint8_t)(r << 3 | r >> 2);
        mirror[1] = pixel[1] = (uint8_t)(g << 2 | g >> 4);
        mirror[0] = pixel[2] = (uint8_t)(b << 3 | b >> 2);
    }
    iris_hsl_range range = {300, 100, 20, 90, 10, 90};
    iris_hsl_range_test test;
    iris_image mask, src;
    assert_int_equal(iris_hsl_range_prepare(&test, &range), IRIS_OK);
    const struct {
        void *data;
        size_t bytes;
        iris_format format;
    } sources[] = {
        {rgb, sizeof rgb, IRIS_RGB888}, {bgr, sizeof bgr, IRIS_BGR888}, {rgb565, sizeof rgb565, IRIS_RGB565}};
    for (int i = 0; i < 3; i++) {
        memset(of_bgr, 0, sizeof of_bgr);
        assert_int_equal(iris_image_wrap(&mask, of_bgr, sizeof of_bgr, (iris_size){W, H}, 0, IRIS_MASK1),
                         IRIS_OK);
        assert_int_equal(
            iris_image_wrap(&src, sources[i].data, sources[i].bytes, (iris_size){W, H}, 0, sources[i].format),
            IRIS_OK);
        assert_int_equal(iris_hsl_range_mask(&mask, &src, &range), IRIS_OK);
        for (int y = 0; y < H; y++) {
            memset(row, 0, sizeof row);
            assert_int_equal(iris_hsl_range_row(row, rgb[y], W, &test), IRIS_OK);
            assert_memory_equal(row, of_bgr[y], sizeof row);
        }
    }
    memcpy(of_rgb, of_bgr, sizeof of_rgb);
    iris_image other = mask;
    other.w--;
    assert_int_equal(iris_hsl_range_mask(&other, &src, &range), IRIS_ERR_RANGE);
    assert_int_equal(iris_hsl_range_mask(&src, &src, &range), IRIS_ERR_FORMAT);
    assert_int_equal(iris_hsl_range_mask(&mask, &mask, &range), IRIS_ERR_ALIAS);
    assert_int_equal(iris_hsl_range_mask(NULL, &src, &range), IRIS_ERR_ARG);
    assert_int_equal(iris_hsl_range_mask(&mask, &src, NULL), IRIS_ERR_ARG);
    static uint16_t hsl[H][3 * W];
    assert_int_equal(iris_image_wrap(&src, hsl, sizeof hsl, (iris_size){W, H}, 0, IRIS_HSL48), IRIS_OK);
    assert_int_equal(iris_hsl_range_mask(&mask, &src, &range), IRIS_ERR_FORMAT);
    assert_memory_equal(of_rgb, of_bgr, sizeof of_rgb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_color_comes_back_from_hsl48),
        cmocka_unit_test(every_color_comes_near_from_hsl24),
        cmocka_unit_test(known_colors),
        cmocka_unit_test(any_hsl_is_a_color),
        cmocka_unit_test(bgr_rows_and_rows_in_place),
        cmocka_unit_test(range_agrees_with_the_reference),
        cmocka_unit_test(range_of_known_colors),
        cmocka_unit_test(range_refuses_bad_bounds),
        cmocka_unit_test(range_of_bgr_is_that_of_rgb),
        cmocka_unit_test(range_rows_keep_the_bits_past_the_end),
        cmocka_unit_test(range_of_a_view_is_that_of_its_rows),
    };
    return cmocka_run_group_tests_name("hsl", tests, NULL, NULL);
}
