/* Color signatures: ranges against the exact test, and lessons from drawn scenes whose colors are known. */
#include "iris/xt/signature.h"

#include "iris/color.h"
#include "test.h"

enum { W = 97, H = 71 };

static uint8_t pixels[W * H * 3], bits[W * H];
static iris_signatures table;
static IRIS_SCRATCH_BUFFER(memory, IRIS_SIGNATURE_SCRATCH_BYTES);
static uint32_t seed = 1;

static uint32_t next_random(void)
{
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image view(void *data, size_t bytes, int32_t w, int32_t h, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, data, bytes, (iris_size){w, h}, 0, format), IRIS_OK);
    return image;
}

static iris_image picture(void)
{
    return view(pixels, sizeof pixels, W, H, IRIS_RGB888);
}

static uint8_t level(int32_t value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

/* A color with noise of +-`noise`. */
static void paint(int32_t x, int32_t y, iris_color color, int32_t noise)
{
    const uint8_t rgb[3] = {color.r, color.g, color.b};
    for (int i = 0; i < 3; i++) {
        pixels[3 * (y * W + x) + i] =
            level(rgb[i] + (int32_t)(next_random() % (uint32_t)(2 * noise + 1)) - noise);
    }
}

/* A disc on a floor, both of one color with noise. */
static void scene(iris_color floor, iris_color disc, int32_t at_x, int32_t at_y, int32_t r)
{
    for (int32_t y = 0; y < H; y++) {
        for (int32_t x = 0; x < W; x++) {
            int is_disc = (x - at_x) * (x - at_x) + (y - at_y) * (y - at_y) <= r * r;
            paint(x, y, is_disc ? disc : floor, 6);
        }
    }
}

static int has(iris_color color, int32_t which)
{
    const uint8_t rgb[3] = {color.r, color.g, color.b};
    uint8_t found;
    assert_int_equal(iris_signature_row(&found, rgb, IRIS_RGB888, 1, &table), IRIS_OK);
    return found >> which & 1;
}

static iris_signature_lesson teach(iris_rect rect)
{
    iris_signature_lesson lesson;
    iris_image image = picture();
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_signature_teach(&lesson, &table, 3, &image, rect, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    return lesson;
}

/* Share of the disc's pixels with signature 3, and of the floor's. */
static void shares(double *disc, double *floor, int32_t at_x, int32_t at_y, int32_t r)
{
    iris_image image = picture(), dst = view(bits, sizeof bits, W, H, IRIS_GRAY8);
    int32_t all[2] = {0, 0}, with[2] = {0, 0};
    assert_int_equal(iris_signature_classify(&dst, &image, &table), IRIS_OK);
    for (int32_t i = 0; i < W * H; i++) {
        int32_t x = i % W - at_x, y = i / W - at_y;
        int k = x * x + y * y <= r * r;
        all[k]++;
        with[k] += bits[i] >> 3 & 1;
    }
    *disc = with[1] / (double)all[1];
    *floor = with[0] / (double)all[0];
}

static void ranges_agree_with_the_exact_test(void **state)
{
    (void)state;
    int32_t same = 0, all = 0, inside = 0;
    for (int i = 0; i < 60; i++) {
        int32_t s0 = (int32_t)(next_random() % 60), l0 = (int32_t)(next_random() % 50), which = i % 8;
        int32_t h0 = (int32_t)(next_random() % 360);
        const iris_hsl_range range = {h0,     (h0 + 20 + (int32_t)(next_random() % 60)) % 360, s0, 100, l0,
                                      l0 + 40};
        iris_hsl_range_test test;
        assert_int_equal(iris_hsl_range_prepare(&test, &range), IRIS_OK);
        assert_int_equal(iris_signature_from_range(&table, which, &range), IRIS_OK);
        for (int k = 0; k < 2000; k++, all++) {
            uint32_t r = next_random(), g = next_random(), b = next_random();
            const iris_color color = {(uint8_t)r, (uint8_t)g, (uint8_t)b};
            int exact = iris_hsl_range_has(&test, color);
            same += has(color, which) == exact;
            inside += exact;
        }
    }
    assert_true(inside > all / 30);
    assert_true(same > all / 100 * 96);
}

/* Colors well inside and well outside are never confused. */
static void plain_colors(void **state)
{
    (void)state;
    static const iris_hsl_range red = {340, 20, 40, 100, 15, 85}, blue = {210, 270, 40, 100, 15, 85},
                                dark = {0, 360, 0, 100, 0, 18};
    (void)memset(&table, 0, sizeof table);
    assert_int_equal(iris_signature_from_range(&table, 0, &red), IRIS_OK);
    assert_int_equal(iris_signature_from_range(&table, 1, &blue), IRIS_OK);
    assert_int_equal(iris_signature_from_range(&table, 7, &dark), IRIS_OK);
    static const struct {
        iris_color color;
        int bits;
    } colors[] = {{{255, 0, 0}, 1},     {{200, 30, 40}, 1}, {{120, 20, 20}, 1},  {{0, 0, 255}, 2},
                  {{40, 60, 200}, 2},   {{0, 255, 0}, 0},   {{255, 255, 0}, 0},  {{255, 255, 255}, 0},
                  {{128, 128, 128}, 0}, {{0, 0, 0}, 128},   {{30, 30, 30}, 128}, {{200, 180, 175}, 0}};
    for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++) {
        for (int k = 0; k < 8; k++) {
            assert_int_equal(has(colors[i].color, k), colors[i].bits >> k & 1);
        }
    }
    assert_int_equal(iris_signature_clear(&table, 0), IRIS_OK);
    assert_int_equal(has((iris_color){255, 0, 0}, 0), 0);
    assert_int_equal(has((iris_color){0, 0, 255}, 1), 1);
}

/* The bytes of a format that mean these pixels of RGB888 nearly; returns a row. */
static void every_format_means_the_same(void **state)
{
    (void)state;
    enum { N = 66 };
    static const iris_format formats[] = {IRIS_GRAY8,       IRIS_BGR888, IRIS_RGBA8888, IRIS_RGB565,
                                          IRIS_RGB565_SWAP, IRIS_YUYV,   IRIS_UYVY};
    for (int32_t i = 0; i < IRIS_SIGNATURE_CELLS; i++) {
        table.cells[i] = (uint8_t)next_random();
    }
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
        int32_t same = 0, all = 0;
        for (int k = 0; k < 50; k++) {
            union {
                uint8_t bytes[4 * N];
                uint16_t words[2 * N];
            } row;
            uint8_t rgb[3 * N], direct[N], through_rgb[N];
            for (int i = 0; i < 4 * N; i++) {
                row.bytes[i] =
                    (uint8_t)(formats[f] == IRIS_YUYV || formats[f] == IRIS_UYVY ? 80 + next_random() % 96
                                                                                 : next_random());
            }
            assert_int_equal(iris_color_rgb_row(rgb, row.bytes, formats[f], N), IRIS_OK);
            assert_int_equal(iris_signature_row(direct, row.bytes, formats[f], N, &table), IRIS_OK);
            assert_int_equal(iris_signature_row(through_rgb, rgb, IRIS_RGB888, N, &table), IRIS_OK);
            for (int i = 0; i < N; i++, all++) {
                same += direct[i] == through_rgb[i];
            }
        }
        int is_yuv = formats[f] == IRIS_YUYV || formats[f] == IRIS_UYVY; /* rounded on its way through RGB */
        assert_true(is_yuv ? same > all * 8 / 10 : same == all);
    }
}

static void masks_are_the_bits(void **state)
{
    (void)state;
    static uint32_t words[H * 4 + 4];
    scene((iris_color){120, 120, 110}, (iris_color){200, 40, 40}, 40, 30, 12);
    for (int32_t i = 0; i < IRIS_SIGNATURE_CELLS; i++) {
        table.cells[i] = (uint8_t)next_random();
    }
    iris_image image = picture(), dst = view(bits, sizeof bits, W, H, IRIS_GRAY8);
    iris_image mask = view(words, sizeof words, W, H, IRIS_MASK1);
    assert_int_equal(iris_signature_classify(&dst, &image, &table), IRIS_OK);
    for (uint32_t selected = 0; selected < 256; selected += 15) {
        (void)memset(words, selected % 2 ? 0xFF : 0, sizeof words);
        assert_int_equal(iris_signature_mask(&mask, &image, &table, selected), IRIS_OK);
        for (int32_t y = 0; y < H; y++) {
            const uint32_t *row = iris_image_row(&mask, y);
            for (int32_t x = 0; x < 128; x++) {
                uint32_t expected = x < W ? (bits[y * W + x] & selected) != 0 : selected % 2;
                assert_int_equal(row[x / 32] >> x % 32 & 1, expected);
            }
        }
        assert_int_equal(words[4 * H], selected % 2 ? ~0u : 0);
    }
}

static void learns_objects_of_every_color(void **state)
{
    (void)state;
    static const struct {
        iris_color floor, disc;
        int32_t hue; /* of the disc; -1: gray */
    } scenes[] = {
        {{150, 150, 140}, {200, 30, 30}, 0},  {{60, 60, 60}, {190, 20, 60}, 346},
        {{30, 30, 30}, {60, 12, 14}, 358},    {{200, 200, 195}, {230, 120, 30}, 27},
        {{90, 110, 90}, {40, 80, 190}, 224},  {{120, 90, 60}, {60, 170, 70}, 125},
        {{160, 130, 90}, {240, 230, 60}, 57}, {{200, 200, 195}, {35, 35, 35}, -1},
        {{60, 60, 60}, {235, 235, 235}, -1},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        for (int sloppy = 0; sloppy < 3; sloppy++) {
            double disc, floor;
            scene(scenes[i].floor, scenes[i].disc, 40, 30, 10);
            static const iris_rect rects[] = {{30, 20, 21, 21}, {33, 22, 21, 21}, {27, 18, 27, 26}};
            (void)memset(&table, 0, sizeof table);
            iris_signature_lesson lesson = teach(rects[sloppy]);
            shares(&disc, &floor, 40, 30, 10);
            assert_true(disc > 0.9);
            assert_true(floor < 0.01);
            assert_true(lesson.share_permil > (sloppy ? 500 : 850) && lesson.elsewhere_permil < 80);
            assert_true(abs(lesson.color.r - scenes[i].disc.r) < 12 &&
                        abs(lesson.color.b - scenes[i].disc.b) < 12);
            if (scenes[i].hue < 0) {
                assert_int_equal(lesson.range.h0, 0);
                assert_int_equal(lesson.range.h1, 360);
                assert_int_equal(lesson.chroma0, 0);
            } else {
                int32_t width = (lesson.range.h1 - lesson.range.h0 + 360) % 360;
                assert_true((scenes[i].hue - lesson.range.h0 + 360) % 360 < width && width <= 84);
            }
        }
    }
}

/* What was learned in one light is known in another. */
static void other_light(void **state)
{
    (void)state;
    double disc, floor;
    scene((iris_color){150, 150, 140}, (iris_color){180, 40, 50}, 40, 30, 10);
    (void)teach((iris_rect){30, 20, 21, 21});
    scene((iris_color){90, 90, 84}, (iris_color){108, 24, 30}, 60, 30, 10);
    shares(&disc, &floor, 60, 30, 10);
    assert_true(disc > 0.9 && floor < 0.01);
    scene((iris_color){195, 195, 182}, (iris_color){234, 52, 65}, 60, 30, 10);
    shares(&disc, &floor, 60, 30, 10);
    assert_true(disc > 0.9 && floor < 0.01);
}

/* Another thing that is seen while the object is taught is told from it. */
static void learns_what_it_is_not(void **state)
{
    (void)state;
    scene((iris_color){150, 150, 140}, (iris_color){200, 40, 50}, 30, 30, 10);
    for (int32_t i = 0; i < 20 * 30; i++) {
        paint(70 + i % 20, 20 + i / 20, (iris_color){200, 85, 50}, 6);
    }
    (void)memset(&table, 0, sizeof table);
    (void)teach((iris_rect){20, 20, 21, 21});
    assert_int_equal(has((iris_color){200, 40, 50}, 3), 1);
    assert_int_equal(has((iris_color){200, 85, 50}, 3), 0);
    iris_signature_lesson lesson = teach((iris_rect){45, 5, 12, 12}); /* nothing but floor */
    assert_true(lesson.elsewhere_permil > 500);
}

static void every_place_and_size(void **state)
{
    (void)state;
    scene((iris_color){150, 150, 140}, (iris_color){200, 40, 50}, 30, 30, 10);
    for (int32_t i = 0; i < 300; i++) {
        iris_rect rect = {(int32_t)(next_random() % W), (int32_t)(next_random() % H), 1, 1};
        rect.w += (int32_t)(next_random() % (uint32_t)(W - rect.x));
        rect.h += (int32_t)(next_random() % (uint32_t)(H - rect.y));
        iris_signature_lesson lesson = teach(rect);
        assert_in_range(lesson.share_permil, 0, 1000);
        assert_in_range(lesson.range.h0, 0, 360);
        assert_true(lesson.range.l0 <= lesson.range.l1 && lesson.range.s0 <= lesson.range.s1);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static iris_signatures before;
    iris_image image = picture(), dst = view(bits, sizeof bits, W, H, IRIS_GRAY8), other = dst;
    iris_signature_lesson lesson = {.share_permil = -7};
    const iris_rect rect = {10, 10, 5, 5};
    const iris_hsl_range range = {0, 10, 0, 10, 0, 10}, wrong = {0, 10, 20, 10, 0, 10};
    iris_scratch scratch = arena(sizeof memory), less = arena(IRIS_SIGNATURE_SCRATCH_BYTES - 1);
    for (int32_t i = 0; i < IRIS_SIGNATURE_CELLS; i++) {
        table.cells[i] = (uint8_t)next_random();
    }
    before = table;
    assert_int_equal(iris_signature_clear(NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_clear(&table, 8), IRIS_ERR_RANGE);
    assert_int_equal(iris_signature_clear(&table, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_signature_from_range(NULL, 0, &range), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_from_range(&table, 0, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_from_range(&table, 0, &wrong), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_from_range(&table, 8, &range), IRIS_ERR_RANGE);
    assert_int_equal(iris_signature_teach(&lesson, NULL, 0, &image, rect, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_teach(&lesson, &table, 0, NULL, rect, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_teach(&lesson, &table, 0, &image, rect, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_teach(&lesson, &table, 8, &image, rect, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_signature_teach(&lesson, &table, 0, &image, rect, &less), IRIS_ERR_SCRATCH);
    static const iris_rect outside[] = {{-1, 0, 5, 5},        {0, -1, 5, 5},       {W - 4, 0, 5, 5},
                                        {0, H - 4, 5, 5},     {0, 0, 0, 5},        {0, 0, 5, -1},
                                        {INT32_MAX, 0, 5, 5}, {0, 0, INT32_MAX, 5}};
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        assert_int_equal(iris_signature_teach(&lesson, &table, 0, &image, outside[i], &scratch),
                         IRIS_ERR_RANGE);
    }
    iris_image hsl = image;
    hsl.format = IRIS_HSL24;
    assert_int_equal(iris_signature_teach(&lesson, &table, 0, &hsl, rect, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(lesson.share_permil, -7);
    assert_memory_equal(&before, &table, sizeof table);
    assert_int_equal(iris_signature_classify(NULL, &image, &table), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_classify(&dst, NULL, &table), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_classify(&dst, &image, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_classify(&image, &image, &table), IRIS_ERR_FORMAT);
    assert_int_equal(iris_signature_classify(&dst, &hsl, &table), IRIS_ERR_FORMAT);
    other.h--;
    assert_int_equal(iris_signature_classify(&other, &image, &table), IRIS_ERR_RANGE);
    other = view(pixels, sizeof pixels, W, H, IRIS_GRAY8);
    assert_int_equal(iris_signature_classify(&other, &image, &table), IRIS_ERR_ALIAS);
    assert_int_equal(iris_signature_mask(&dst, &image, &table, 1), IRIS_ERR_FORMAT);
    static uint32_t words[4 * H];
    iris_image mask = view(words, sizeof words, W, H, IRIS_MASK1);
    assert_int_equal(iris_signature_mask(&mask, &image, &table, 256), IRIS_ERR_RANGE);
    assert_int_equal(iris_signature_row(NULL, pixels, IRIS_RGB888, 3, &table), IRIS_ERR_ARG);
    assert_int_equal(iris_signature_row(bits, pixels, IRIS_HSL24, 3, &table), IRIS_ERR_FORMAT);
    assert_int_equal(iris_signature_row(bits, pixels, IRIS_RGB888, 0, &table), IRIS_ERR_RANGE);
    assert_int_equal(iris_signature_row(bits, pixels, IRIS_YUYV, 3, &table), IRIS_ERR_RANGE);
    assert_int_equal(iris_signature_row(pixels, pixels, IRIS_RGB888, 3, &table), IRIS_ERR_ALIAS);
    assert_int_equal(iris_signature_row(bits, pixels + 1 - (uintptr_t)pixels % 2, IRIS_RGB565, 3, &table),
                     IRIS_ERR_ALIGN);
    assert_memory_equal(&before, &table, sizeof table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges_agree_with_the_exact_test),
        cmocka_unit_test(plain_colors),
        cmocka_unit_test(every_format_means_the_same),
        cmocka_unit_test(masks_are_the_bits),
        cmocka_unit_test(learns_objects_of_every_color),
        cmocka_unit_test(other_light),
        cmocka_unit_test(learns_what_it_is_not),
        cmocka_unit_test(every_place_and_size),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("signature", tests, NULL, NULL);
}
