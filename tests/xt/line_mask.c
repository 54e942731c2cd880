/* Line masks: painted floors in uneven light, whose line pixels are known. */
#include "iris/xt/line_mask.h"

#include <math.h>

#include "../picture.h"

#define W 163
#define H 121

static uint8_t pixels[256 * 200];
static uint32_t words[256 * 200 / 32 + 2000];
static IRIS_SCRATCH_BUFFER(memory, 1 << 14);

/* How a floor is painted: its level, the line's share of it, how the light falls off to the right, noise. */
typedef struct {
    double floor, line, light;
    int noise;
    double slant, width; /* a line through the middle, `slant` columns per row; 0 wide: none */
    double bar;          /* a level line in the middle, so many rows thick */
} painting;

static int on_line(const painting *p, int32_t x, int32_t y, double more)
{
    double across = (x - W / 2 - p->slant * (y - H / 2)) / sqrt(1 + p->slant * p->slant);
    return (p->width > 0 && fabs(across) <= p->width / 2 + more) ||
           (p->bar > 0 && abs(y - H / 2) <= p->bar / 2 + more);
}

static iris_image paint(const painting *p)
{
    iris_image gray;
    uint32_t random = 99;
    assert_int_equal(iris_image_wrap(&gray, pixels, sizeof pixels, (iris_size){W, H}, 0, IRIS_GRAY8),
                     IRIS_OK);
    for (int32_t y = 0; y < H; y++) {
        uint8_t *row = iris_image_row(&gray, y);
        for (int32_t x = 0; x < W; x++) {
            double light = 1 + p->light * (x / (double)W - 0.5);
            random = random * 1664525u + 1013904223u;
            double level = p->floor * (on_line(p, x, y, 0) ? p->line : 1) * light;
            level += p->noise > 0 ? (int)(random >> 16) % (2 * p->noise + 1) - p->noise : 0;
            row[x] = (uint8_t)(level < 0 ? 0 : level > 255 ? 255 : level);
        }
    }
    return gray;
}

static iris_image mask_of(uint32_t fill)
{
    iris_image mask;
    memset(words, fill ? 0xff : 0, sizeof words);
    assert_int_equal(iris_image_wrap(&mask, words, sizeof words, (iris_size){W, H}, 0, IRIS_MASK1), IRIS_OK);
    return mask;
}

static int32_t make(const iris_image *mask, const iris_image *gray, const iris_line_mask_config *config)
{
    int32_t found = -1;
    iris_scratch scratch;
    assert_int_equal(
        iris_scratch_init(&scratch, memory.memory, IRIS_LINE_MASK_SCRATCH_BYTES(gray->w, gray->h)), IRIS_OK);
    assert_int_equal(iris_line_mask(&found, mask, gray, config, &scratch), IRIS_OK);
    return found;
}

/* All but pixels along the edges are as painted. */
static void expect(const painting *p, const iris_line_mask_config *config)
{
    iris_image gray = paint(p), mask = mask_of(1);
    int wrong = 0;
    assert_int_equal(make(&mask, &gray, config), 1);
    for (int32_t y = 0; y < H; y++) {
        const uint32_t *row = iris_image_row(&mask, y);
        for (int32_t x = 0; x < W; x++) {
            int on = row[x / 32] >> x % 32 & 1;
            wrong += on ? !on_line(p, x, y, 1) : on_line(p, x, y, -1);
        }
        assert_int_equal(row[W / 32] >> W % 32, 0xffffffffu >> W % 32); /* past w */
    }
    assert_int_equal(wrong, 0);
}

static void dark_lines(void **state)
{
    (void)state;
    expect(&(painting){200, 0.2, 0, 0, 0, 12, 0}, NULL);
    expect(&(painting){200, 0.2, 0.6, 10, 0.7, 12, 0}, NULL);
    expect(&(painting){120, 0.4, -0.6, 8, -0.4, 20, 9}, NULL);
    expect(&(painting){90, 0.5, 0.4, 4, 0.2, 25, 14}, NULL);
    expect(&(painting){230, 0.6, 0.4, 15, 0, 0, 16}, NULL);
}

static void bright_lines(void **state)
{
    (void)state;
    const iris_line_mask_config bright = {1, 300};
    expect(&(painting){60, 2.5, 0, 0, 0.3, 12, 0}, &bright);
    expect(&(painting){70, 3, 0.6, 8, -0.5, 14, 10}, &bright);
    expect(&(painting){190, 1.34, 0, 3, 0.5, 14, 10}, &bright); /* nearly white on a light floor */
}

/* A floor alone, however dark and noisy, and a line that has less than the contrast. */
static void nothing(void **state)
{
    (void)state;
    const iris_line_mask_config bright = {1, 300};
    const painting floors[] = {{200, 1, 0, 0, 0, 0, 0},     {130, 1, 0.8, 12, 0, 0, 0},
                               {12, 1, 0, 12, 0, 0, 0},     {0, 1, 0, 0, 0, 0, 0},
                               {255, 1, 0, 0, 0, 0, 0},     {180, 0.75, 0, 6, 0, 12, 0},
                               {180, 0.8, 0.3, 6, 1, 12, 8}};
    for (size_t i = 0; i < sizeof floors / sizeof floors[0]; i++) {
        for (int k = 0; k < (floors[i].width > 0 ? 1 : 2); k++) {
            iris_image gray = paint(&floors[i]), mask = mask_of(1);
            assert_int_equal(make(&mask, &gray, k ? &bright : NULL), 0);
            for (int32_t y = 0; y < H; y++) {
                for (int32_t x = 0; x < W; x++) {
                    assert_false(((const uint32_t *)iris_image_row(&mask, y))[x / 32] >> x % 32 & 1);
                }
            }
        }
    }
}

static void contrast_counts(void **state)
{
    (void)state;
    iris_line_mask_config config;
    iris_image gray = paint(&(painting){180, 0.75, 0, 3, 0, 12, 0}), mask = mask_of(0);
    iris_line_mask_defaults(&config);
    assert_int_equal(config.contrast_permil, 300);
    config.contrast_permil = 150;
    assert_int_equal(make(&mask, &gray, &config), 1);
}

/* Views turned upside down give the same, upside down; and every size is taken. */
static void views_and_sizes(void **state)
{
    (void)state;
    static uint32_t other[2000];
    iris_image gray = paint(&(painting){200, 0.3, 0.3, 8, 0.4, 12, 0}), mask = mask_of(0), turned,
               flipped = gray;
    assert_int_equal(make(&mask, &gray, NULL), 1);
    flipped.data = iris_image_row(&gray, H - 1);
    flipped.stride = -gray.stride;
    assert_int_equal(iris_image_wrap(&turned, other, sizeof other, (iris_size){W, H}, 0, IRIS_MASK1),
                     IRIS_OK);
    make(&turned, &flipped, NULL);
    int differ = 0; /* blocks are laid from the top */
    for (int32_t y = 0; y < H; y++) {
        for (int32_t x = 0; x < W; x++) {
            uint32_t a = ((const uint32_t *)iris_image_row(&mask, y))[x / 32] >> x % 32 & 1;
            uint32_t b = ((const uint32_t *)iris_image_row(&turned, H - 1 - y))[x / 32] >> x % 32 & 1;
            differ += a != b;
        }
    }
    assert_true(differ < 40);
    for (int32_t w = 1; w < 140; w += 7) {
        for (int32_t h = 1; h < 140; h += 11) {
            iris_image small, to;
            assert_int_equal(iris_image_wrap(&small, pixels, sizeof pixels, (iris_size){w, h}, 0, IRIS_GRAY8),
                             IRIS_OK);
            assert_int_equal(iris_image_wrap(&to, words, sizeof words, (iris_size){w, h}, 0, IRIS_MASK1),
                             IRIS_OK);
            make(&to, &small, NULL);
        }
    }
}

static void refuses(void **state)
{
    (void)state;
    int32_t found = 7;
    iris_scratch scratch;
    iris_image gray = paint(&(painting){200, 0.3, 0, 0, 0, 12, 0}), mask = mask_of(1), small = gray;
    iris_scratch_init(&scratch, memory.memory, IRIS_LINE_MASK_SCRATCH_BYTES(W, H) - 1);
    assert_int_equal(iris_line_mask(&found, &mask, &gray, NULL, &scratch), IRIS_ERR_SCRATCH);
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    assert_int_equal(iris_line_mask(&found, NULL, &gray, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_line_mask(&found, &mask, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_line_mask(&found, &mask, &gray, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_line_mask(&found, &gray, &gray, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_line_mask(&found, &mask, &gray, &(iris_line_mask_config){2, 300}, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_line_mask(&found, &mask, &gray, &(iris_line_mask_config){0, 99}, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_line_mask(&found, &mask, &gray, &(iris_line_mask_config){0, 901}, &scratch),
                     IRIS_ERR_ARG);
    small.h--;
    assert_int_equal(iris_line_mask(&found, &mask, &small, NULL, &scratch), IRIS_ERR_RANGE);
    iris_line_mask_defaults(NULL);
    assert_int_equal(found, 7);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        assert_int_equal(words[i], 0xffffffffu);
    }
    assert_int_equal(iris_line_mask(NULL, &mask, &gray, NULL, &scratch), IRIS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dark_lines),      cmocka_unit_test(bright_lines),    cmocka_unit_test(nothing),
        cmocka_unit_test(contrast_counts), cmocka_unit_test(views_and_sizes), cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
