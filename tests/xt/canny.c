/* Canny's edges, pixel by pixel against the same steps on whole arrays, in the plainest form. */
#include "iris/xt/canny.h"

#include "edge_smooth.h"

#define PIXELS_MAX (SIDE_MAX * SIDE_MAX)

typedef struct {
    int32_t w, h, left, top, right, bottom; /* what is evaluated: left to right - 1, top to bottom - 1 */
    int32_t dx[PIXELS_MAX], dy[PIXELS_MAX], size[PIXELS_MAX];
    uint8_t state[PIXELS_MAX]; /* 1 weak, 2 strong */
    int32_t stack[PIXELS_MAX];
} plain;

static plain reference;

static int32_t size_at(const plain *p, int32_t x, int32_t y)
{
    return x < 0 || y < 0 || x >= p->w || y >= p->h ? 0 : p->size[y * p->w + x];
}

/* The angle by 64-bit products: no rounding. */
static int is_greatest(const plain *p, int32_t x, int32_t y)
{
    int32_t i = y * p->w + x, size = p->size[i];
    int64_t across = llabs((int64_t)p->dx[i]), down = llabs((int64_t)p->dy[i]) * 32768;
    if (down < across * 13573) {
        return size > size_at(p, x - 1, y) && size >= size_at(p, x + 1, y);
    }
    if (down > across * (13573 + 65536)) {
        return size > size_at(p, x, y - 1) && size >= size_at(p, x, y + 1);
    }
    int32_t lean = (p->dx[i] < 0) != (p->dy[i] < 0) ? -1 : 1;
    return size > size_at(p, x - lean, y - 1) && size > size_at(p, x + lean, y + 1);
}

static void flood(plain *p)
{
    int32_t waiting = 0;
    for (int32_t i = 0; i < p->w * p->h; i++) {
        if (p->state[i] == 2) {
            p->stack[waiting++] = i;
        }
    }
    while (waiting > 0) {
        int32_t i = p->stack[--waiting];
        for (int32_t k = 0; k < 9; k++) {
            int32_t x = i % p->w + k % 3 - 1, y = i / p->w + k / 3 - 1;
            if (x >= 0 && y >= 0 && x < p->w && y < p->h && p->state[y * p->w + x] == 1) {
                p->state[y * p->w + x] = 2;
                p->stack[waiting++] = y * p->w + x;
            }
        }
    }
}

static void make_reference(const iris_image *src, const iris_canny_config *config, iris_border border)
{
    plain *p = &reference;
    iris_image smooth = smooth_of(src, config->sigma_q16, border);
    int32_t radius = config->sigma_q16 > 0 ? IRIS_BLUR_RADIUS(config->sigma_q16) : 0;
    int32_t margin = border.rule == IRIS_BORDER_SKIP ? radius + 2 : 0;
    *p = (plain){.w = src->w, .h = src->h, .left = margin, .top = margin};
    p->right = src->w - margin;
    p->bottom = src->h - margin;
    for (int32_t i = 0; i < p->w * p->h; i++) {
        static const int32_t weight[3] = {1, 2, 1};
        for (int32_t k = 0; k < 9; k++) {
            int32_t level = pixel_beyond(&smooth, i % p->w + k % 3 - 1, i / p->w + k / 3 - 1, border);
            p->dx[i] += level * weight[k / 3] * (k % 3 - 1);
            p->dy[i] += level * weight[k % 3] * (k / 3 - 1);
        }
        p->size[i] = abs(p->dx[i]) + abs(p->dy[i]);
    }
    for (int32_t i = 0; i < p->w * p->h; i++) {
        int32_t x = i % p->w, y = i / p->w;
        int inside = x >= p->left && x < p->right && y >= p->top && y < p->bottom;
        if (inside && p->size[i] > config->low && is_greatest(p, x, y)) {
            p->state[i] = p->size[i] > config->high ? 2 : 1;
        }
    }
    flood(p);
}

static int32_t assert_canny(const iris_image *src, iris_canny_config config, iris_border border)
{
    int32_t found = 0;
    iris_image mask = mask_view(src->w, src->h);
    make_reference(src, &config, border);
    iris_scratch scratch = arena(IRIS_CANNY_SCRATCH_BYTES(src->w, src->h, config.sigma_q16));
    assert_int_equal(iris_canny(&mask, src, &config, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, IRIS_CANNY_SCRATCH_BYTES(src->w, src->h, config.sigma_q16));
    assert_int_equal(scratch.used, 0);
    for (int32_t y = 0; y < src->h; y++) {
        for (int32_t x = 0; x < (src->w + 31) / 32 * 32; x++) {
            int evaluated =
                x >= reference.left && x < reference.right && y >= reference.top && y < reference.bottom;
            int expected = evaluated ? reference.state[y * src->w + x] == 2 : UNTOUCHED_BIT(x, y);
            assert_int_equal(bit(&mask, x, y), expected);
            found += evaluated && expected;
        }
    }
    assert_around_untouched();
    return found;
}

static void every_border_and_size(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1}, {2, 1},  {1, 2},  {2, 2},  {3, 3},  {1, 9},   {9, 1},
                                      {4, 5}, {31, 7}, {32, 8}, {33, 9}, {65, 9}, {13, 64}, {70, 40}};
    static const iris_q16 sigmas[] = {0, 30000, 91750, 400000};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int kind = 0; kind < PICTURE_KINDS; kind++) {
            iris_image src = picture_of(kind, sizes[i]);
            for (int rule = 0; rule < 4; rule++) {
                iris_border border = {(iris_border_rule)rule, (uint8_t)(50 * kind)};
                for (int k = 0; k < 4; k++) {
                    (void)assert_canny(&src, (iris_canny_config){sigmas[k], 0, 0}, border);
                    (void)assert_canny(&src, (iris_canny_config){sigmas[k], 60 / (k + 1), 300 / (k + 1)},
                                       border);
                }
            }
        }
    }
}

static void photographs(void **state)
{
    (void)state;
    picture camera = load_pnm(data_path("edges/classic/camera_256.pgm"));
    picture city = load_pnm(data_path("edges/bsds/69007.pgm"));
    if (!camera.pixels || !city.pixels) {
        free(camera.pixels);
        free(city.pixels);
        print_message("skipped: no shared data\n");
        skip();
    }
    for (int part = 0; part < 8; part++) {
        iris_size size = {132 - part, 125 + part};
        iris_image src = picture_part(part % 2 ? &camera : &city, 20 + 11 * part, 20 + 13 * part, size);
        iris_border border = {(iris_border_rule)(part % 4), 99};
        assert_true(assert_canny(&src, (iris_canny_config){0, 100, 200}, border) > 200);
        assert_true(assert_canny(&src, (iris_canny_config){91750, 20, 100}, border) > 200);
        (void)assert_canny(&src, (iris_canny_config){131072, 0, 300}, border);
        (void)assert_canny(&src, (iris_canny_config){0, 1500, 2040}, border);
        assert_int_equal(assert_canny(&src, (iris_canny_config){0, 32767, 32767}, border), 0);
    }
    free(camera.pixels);
    free(city.pixels);
}

/* A faint line three pixels wide that goes up and down (or left and right) through the picture, and is clear at one end
 * alone: its edges are found from there to the other end. */
static iris_image maze(int turned, int at_the_end)
{
    iris_image src = source_view((iris_size){130, 130}, turned);
    for (int32_t i = 0; i < 130 * 130; i++) {
        int32_t x = turned ? i / 130 : i % 130, y = turned ? i % 130 : i / 130;
        int lane = x % 10 >= 4 && x % 10 <= 6 && y >= 10 && y <= 120;
        int32_t bend = (x - 4) / 10 % 2 ? 10 : 118;
        int turn = x >= 4 && x <= 126 && y >= bend && y <= bend + 2;
        int clear = at_the_end ? x == 125 && y >= 10 && y <= 12 : x == 5 && y >= 10 && y <= 12;
        ((uint8_t *)iris_image_row(&src, i / 130))[i % 130] = clear ? 255 : lane || turn ? 120 : 100;
    }
    return src;
}

static void mazes(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        iris_image src = maze(kind / 2, kind % 2);
        assert_true(assert_canny(&src, (iris_canny_config){0, 10, 400}, (iris_border){0}) > 2500);
        (void)assert_canny(&src, (iris_canny_config){60000, 10, 200}, (iris_border){0});
    }
}

/* A step between columns 4 and 5: dx is 400 in both, and the left one is taken. */
static void a_step_by_hand(void **state)
{
    (void)state;
    iris_image src = picture_of(0, (iris_size){10, 6});
    for (int32_t y = 0; y < 6; y++) {
        memset(iris_image_row(&src, y), 50, 5);
        memset((uint8_t *)iris_image_row(&src, y) + 5, 150, 5);
    }
    static const struct {
        int32_t low, high, found;
    } cases[] = {{0, 0, 1}, {399, 399, 1}, {399, 400, 0}, {400, 400, 0}, {100, 300, 1}};
    iris_scratch scratch = arena(IRIS_CANNY_SCRATCH_BYTES(10, 6, 0));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        iris_image mask = mask_view(10, 6);
        iris_canny_config config = {0, cases[i].low, cases[i].high};
        assert_int_equal(iris_canny(&mask, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
        for (int32_t k = 0; k < 60; k++) {
            assert_int_equal(bit(&mask, k % 10, k / 10), cases[i].found && k % 10 == 4);
        }
    }
}

static void scratch_is_exact(void **state)
{
    (void)state;
    reset_results();
    iris_image src = picture_of(1, (iris_size){37, 8}), mask = mask_view(37, 8);
    iris_canny_config config;
    iris_canny_defaults(&config);
    const size_t bytes = IRIS_CANNY_SCRATCH_BYTES(37, 8, config.sigma_q16);
    /* rows of the blurred picture, of gradients, of masks; the weak mask, its dirty words; the blur */
    assert_int_equal(bytes,
                     4 * 64 + 8 * 80 + 2 * 16 + 64 + 32 + IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(37, 1, 91750));
    iris_scratch scratch = arena(bytes - 1);
    assert_int_equal(iris_canny(&mask, &src, NULL, (iris_border){0}, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    config.sigma_q16 = 0;
    scratch = arena(IRIS_CANNY_SCRATCH_BYTES(37, 8, 0) - 1);
    assert_int_equal(iris_canny(&mask, &src, &config, (iris_border){0}, &scratch), IRIS_ERR_SCRATCH);
    assert_all_untouched();
    scratch = arena(bytes);
    assert_int_equal(iris_canny(&mask, &src, NULL, (iris_border){0}, &scratch), IRIS_OK);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    reset_results();
    iris_image src = picture_of(1, (iris_size){20, 10}), mask = mask_view(20, 10), bad;
    iris_image gray = other_view(&src, IRIS_GRAY8, 0);
    iris_scratch scratch = arena(IRIS_CANNY_SCRATCH_BYTES(20, 10, IRIS_BLUR_SIGMA_MAX));
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    static const iris_canny_config bad_configs[] = {
        {-1, 1, 2}, {IRIS_BLUR_SIGMA_MIN - 1, 1, 2}, {IRIS_BLUR_SIGMA_MAX + 1, 1, 2}, {0, -1, 2},
        {0, 3, 2},  {0, 1, IRIS_CANNY_THRESHOLD_END}};
    for (size_t i = 0; i < sizeof bad_configs / sizeof bad_configs[0]; i++) {
        assert_int_equal(iris_canny(&mask, &src, &bad_configs[i], border, &scratch), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_canny(NULL, &src, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_canny(&mask, NULL, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_canny(&mask, &src, NULL, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_canny(&mask, &src, NULL, (iris_border){(iris_border_rule)4, 0}, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_canny(&gray, &src, NULL, border, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_canny(&mask, &mask, NULL, border, &scratch), IRIS_ERR_FORMAT);
    bad = mask;
    bad.h = 9;
    assert_int_equal(iris_canny(&bad, &src, NULL, border, &scratch), IRIS_ERR_RANGE);
    bad.h = 0;
    assert_int_equal(iris_canny(&bad, &src, NULL, border, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(
        iris_image_wrap(&bad, result_memory[2].bytes, 20 * 10, (iris_size){20, 10}, 0, IRIS_GRAY8), IRIS_OK);
    mask.data = result_memory[2].bytes + 64;
    mask.stride = 4;
    assert_int_equal(iris_canny(&mask, &bad, NULL, border, &scratch), IRIS_ERR_ALIAS);
    assert_int_equal(scratch.peak, 0);
    assert_all_untouched();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_border_and_size),
        cmocka_unit_test(photographs),
        cmocka_unit_test(mazes),
        cmocka_unit_test(a_step_by_hand),
        cmocka_unit_test(scratch_is_exact),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("canny", tests, NULL, NULL);
}
