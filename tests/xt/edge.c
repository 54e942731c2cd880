/* Edges: by hand, and against masks of coefficients walked over every pixel. */
#include "iris/xt/edge.h"

#include <math.h>

#include "edge_picture.h"

/* What a mask of 3x3 coefficients says of pixel (x, y): in 128ths, rounded once per third of the isotropic ones. */
typedef struct {
    int32_t dx[9], dy[9], divisor;
} masks;

static const masks of_operator[] = {
    [IRIS_EDGE_SOBEL] = {{-1, 0, 1, -2, 0, 2, -1, 0, 1}, {-1, -2, -1, 0, 0, 0, 1, 2, 1}, 1},
    [IRIS_EDGE_PREWITT] = {{-1, 0, 1, -1, 0, 1, -1, 0, 1}, {-1, -1, -1, 0, 0, 0, 1, 1, 1}, 1},
    [IRIS_EDGE_ISOTROPIC] = {{-128, 0, 128, -181, 0, 181, -128, 0, 128},
                             {-128, -181, -128, 0, 0, 0, 128, 181, 128},
                             128},
    [IRIS_EDGE_ROBERTS] = {{0, 0, 0, 0, -1, 0, 0, 0, 1}, {0, 0, 0, 0, 0, -1, 0, 1, 0}, 1},
    [IRIS_EDGE_LAPLACIAN] = {{0, 1, 0, 1, -4, 1, 0, 1, 0}, {0}, 1},
};
#define OPERATORS 5

static int32_t sum(const iris_image *src, const int32_t *mask, int32_t divisor, int32_t x, int32_t y,
                   iris_border border)
{
    int32_t total = 0;
    for (int32_t i = 0; i < 9; i++) {
        total += mask[i] * pixel_beyond(src, x + i % 3 - 1, y + i / 3 - 1, border);
    }
    return (int32_t)floor((double)total / divisor + 0.5);
}

static int32_t reference_dx(const iris_image *src, int op, int32_t x, int32_t y, iris_border border)
{
    return sum(src, of_operator[op].dx, of_operator[op].divisor, x, y, border);
}

static int32_t reference_dy(const iris_image *src, int op, int32_t x, int32_t y, iris_border border)
{
    return sum(src, of_operator[op].dy, of_operator[op].divisor, x, y, border);
}

static int is_evaluated(const iris_image *src, int op, int32_t x, int32_t y, iris_border border)
{
    int32_t before = op == IRIS_EDGE_ROBERTS ? 0 : 1;
    return border.rule != IRIS_BORDER_SKIP ||
           (x >= before && y >= before && x < src->w - 1 && y < src->h - 1);
}

static iris_edge_config config_of(int op)
{
    iris_edge_config config;
    iris_edge_defaults(&config);
    config.op = (iris_edge_operator)op;
    return config;
}

static void assert_gradient(const iris_image *src, int op, iris_border border)
{
    iris_image dx = other_view(src, IRIS_GRAY_S16, 0), dy = other_view(src, IRIS_GRAY_S16, 1);
    iris_edge_config config = config_of(op);
    iris_scratch scratch = arena(IRIS_EDGE_SCRATCH_BYTES(src->w));
    int both = op != IRIS_EDGE_LAPLACIAN;
    assert_int_equal(iris_edge_gradient(&dx, both ? &dy : NULL, src, &config, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, IRIS_EDGE_SCRATCH_BYTES(src->w));
    assert_int_equal(scratch.used, 0);
    for (int32_t y = 0; y < src->h; y++) {
        const int16_t *dx_row = iris_image_row(&dx, y), *dy_row = iris_image_row(&dy, y);
        for (int32_t x = 0; x < src->w; x++) {
            int evaluated = is_evaluated(src, op, x, y, border);
            assert_int_equal(dx_row[x], evaluated ? reference_dx(src, op, x, y, border) : UNTOUCHED_S16);
            assert_int_equal(dy_row[x],
                             evaluated && both ? reference_dy(src, op, x, y, border) : UNTOUCHED_S16);
        }
    }
    assert_int_equal(iris_edge_gradient(both ? NULL : &dx, both ? &dy : NULL, src, &config, border, &scratch),
                     IRIS_OK);
    assert_around_untouched();
}

static void assert_magnitude(const iris_image *src, int op, iris_border border, iris_q16 gain_q16)
{
    iris_image dst = other_view(src, IRIS_GRAY8, 0), again = other_view(src, IRIS_GRAY8, 1);
    iris_edge_config config = config_of(op);
    config.gain_q16 = gain_q16;
    iris_scratch scratch = arena(IRIS_EDGE_SCRATCH_BYTES(src->w));
    assert_int_equal(iris_edge_magnitude(&dst, src, &config, border, &scratch), IRIS_OK);
    for (int32_t y = 0; y < src->h; y++) {
        const uint8_t *row = iris_image_row(&dst, y);
        memcpy(iris_image_row(&again, y), iris_image_row(src, y), (size_t)src->w);
        for (int32_t x = 0; x < src->w; x++) {
            int32_t sum_of_both =
                abs(reference_dx(src, op, x, y, border)) + abs(reference_dy(src, op, x, y, border));
            double level = floor(sum_of_both * (gain_q16 / 65536.0) + 0.5);
            assert_int_equal(row[x], is_evaluated(src, op, x, y, border) ? (int)fmin(level, 255) : UNTOUCHED);
        }
    }
    assert_int_equal(iris_edge_magnitude(&again, &again, &config, border, &scratch), IRIS_OK);
    for (int32_t y = 0; y < src->h; y++) {
        const uint8_t *row = iris_image_row(&dst, y), *in_place = iris_image_row(&again, y);
        for (int32_t x = 0; x < src->w; x++) {
            int kept = pixel(src, x, y);
            assert_int_equal(in_place[x], is_evaluated(src, op, x, y, border) ? row[x] : kept);
        }
    }
    assert_around_untouched();
}

static void assert_direction(const iris_image *src, int op, iris_border border)
{
    iris_image dst = other_view(src, IRIS_GRAY_U16, 0);
    iris_edge_config config = config_of(op);
    iris_scratch scratch = arena(IRIS_EDGE_SCRATCH_BYTES(src->w));
    assert_int_equal(iris_edge_direction(&dst, src, &config, border, &scratch), IRIS_OK);
    for (int32_t y = 0; y < src->h; y++) {
        const uint16_t *row = iris_image_row(&dst, y);
        for (int32_t x = 0; x < src->w; x++) {
            double dx = reference_dx(src, op, x, y, border), dy = reference_dy(src, op, x, y, border);
            if (!is_evaluated(src, op, x, y, border)) {
                assert_int_equal(row[x], (uint16_t)UNTOUCHED_S16);
            } else if (dx == 0 && dy == 0) {
                assert_int_equal(row[x], 0);
            } else {
                double turn = op == IRIS_EDGE_ROBERTS ? 8192 : 0;
                double angle = atan2(dy, dx) * 32768 / 3.14159265358979323846 + turn;
                double off = fmod(row[x] - angle + 3 * 65536.0, 65536);
                assert_true(off <= 1 || off >= 65535);
            }
        }
    }
    assert_around_untouched();
}

/* The Laplacian for zero crossings: 0 where there is none. */
static int32_t value_at(const iris_image *values, int32_t x, int32_t y)
{
    int inside = x >= 0 && y >= 0 && x < values->w && y < values->h;
    int32_t value = inside ? ((const int16_t *)iris_image_row(values, y))[x] : 0;
    return value == UNTOUCHED_S16 ? 0 : value;
}

/* Every pair of neighbors, and every pair with a zero between, marks a pixel: written pair by pair. */
static void reference_crossings(uint8_t *marks, const iris_image *values, int32_t threshold)
{
    memset(marks, 0, SIDE_MAX * SIDE_MAX);
    for (int32_t i = 0; i < 2 * values->w * values->h; i++) {
        int32_t x = i / 2 % values->w, y = i / 2 / values->w, right = i % 2, down = !right;
        int32_t a = value_at(values, x, y), b = value_at(values, x + right, y + down);
        if (a * b < 0 && abs(a - b) > threshold) {
            int second = abs(b) < abs(a);
            marks[(y + (second ? down : 0)) * values->w + x + (second ? right : 0)] = 1;
        }
        int32_t c = value_at(values, x + 2 * right, y + 2 * down);
        if (b == 0 && a * c < 0 && abs(a - c) > threshold) {
            marks[(y + down) * values->w + x + right] = 1;
        }
    }
}

/* The values come from iris_edge_gradient, which is tested by itself. */
static void assert_crossings(const iris_image *src, const iris_edge_config *config, iris_border border)
{
    static uint8_t marks[SIDE_MAX * SIDE_MAX];
    iris_image mask = mask_view(src->w, src->h), values = other_view(src, IRIS_GRAY_S16, 0);
    size_t bytes = config->op == IRIS_EDGE_LOG ? IRIS_EDGE_LOG_SCRATCH_BYTES(src->w, config->sigma_q16)
                                               : IRIS_EDGE_SCRATCH_BYTES(src->w);
    int32_t radius = config->op == IRIS_EDGE_LOG ? IRIS_BLUR_RADIUS(config->sigma_q16) : 0;
    int32_t margin = border.rule == IRIS_BORDER_SKIP ? radius + 2 : 0;
    iris_scratch scratch = arena(bytes);
    assert_int_equal(iris_edge_gradient(&values, NULL, src, config, border, &scratch), IRIS_OK);
    assert_int_equal(iris_edge_mask(&mask, src, config, border, &scratch), IRIS_OK);
    reference_crossings(marks, &values, config->threshold);
    for (int32_t y = 0; y < src->h; y++) {
        for (int32_t x = 0; x < (src->w + 31) / 32 * 32; x++) {
            int evaluated = x >= margin && y >= margin && x < src->w - margin && y < src->h - margin;
            assert_int_equal(bit(&mask, x, y), evaluated ? marks[y * src->w + x] : UNTOUCHED_BIT(x, y));
        }
    }
    assert_around_untouched();
}

static void assert_mask(const iris_image *src, int op, iris_border border, int32_t threshold)
{
    iris_image mask = mask_view(src->w, src->h);
    iris_edge_config config = config_of(op);
    config.threshold = threshold;
    if (op == IRIS_EDGE_LAPLACIAN) {
        assert_crossings(src, &config, border);
        return;
    }
    iris_scratch scratch = arena(IRIS_EDGE_SCRATCH_BYTES(src->w));
    assert_int_equal(iris_edge_mask(&mask, src, &config, border, &scratch), IRIS_OK);
    for (int32_t y = 0; y < src->h; y++) {
        for (int32_t x = 0; x < (src->w + 31) / 32 * 32; x++) {
            int evaluated = x < src->w && is_evaluated(src, op, x, y, border);
            int expected =
                abs(reference_dx(src, op, x, y, border)) + abs(reference_dy(src, op, x, y, border)) >
                threshold;
            assert_int_equal(bit(&mask, x, y), evaluated ? expected : UNTOUCHED_BIT(x, y));
        }
    }
    assert_around_untouched();
}

static void every_result_at_every_border(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1}, {2, 1}, {1, 2},  {2, 2},  {3, 3},  {1, 9},  {9, 1},
                                      {4, 3}, {5, 5}, {31, 4}, {32, 5}, {33, 6}, {65, 9}, {40, 40}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int kind = 0; kind < PICTURE_KINDS; kind++) {
            iris_image src = picture_of(kind, sizes[i]);
            for (int rule = 0; rule < 4; rule++) {
                iris_border border = {(iris_border_rule)rule, (uint8_t)(50 * kind)};
                for (int op = 0; op < OPERATORS; op++) {
                    assert_gradient(&src, op, border);
                    assert_magnitude(&src, op, border, kind % 2 ? 16384 : 50000 + 200000 * kind);
                    assert_mask(&src, op, border, kind * 60);
                    if (op != IRIS_EDGE_LAPLACIAN) {
                        assert_direction(&src, op, border);
                    }
                }
            }
        }
    }
}

static void a_photograph(void **state)
{
    (void)state;
    picture photograph = load_pnm(data_path("edges/classic/camera_256.pgm"));
    if (!photograph.pixels) {
        print_message("skipped: no shared data\n");
        skip();
    }
    for (int part = 0; part < 4; part++) {
        iris_image src = picture_part(&photograph, 31 + 50 * part, 17 + 37 * part, (iris_size){99, 97});
        for (int op = 0; op < OPERATORS; op++) {
            iris_border border = {(iris_border_rule)part, 99};
            assert_gradient(&src, op, border);
            assert_magnitude(&src, op, border, 16384);
            assert_mask(&src, op, border, op == IRIS_EDGE_LAPLACIAN ? 20 : 160);
            if (op != IRIS_EDGE_LAPLACIAN) {
                assert_direction(&src, op, border);
            }
        }
    }
    free(photograph.pixels);
}

/* A bright square on a dark ground: each side's direction, and the largest gradients there are. */
static void a_square_by_hand(void **state)
{
    (void)state;
    iris_image src = picture_of(0, (iris_size){9, 9});
    for (int32_t i = 0; i < 81; i++) {
        ((uint8_t *)iris_image_row(&src, i / 9))[i % 9] =
            i % 9 >= 3 && i % 9 < 6 && i / 9 >= 3 && i / 9 < 6 ? 255 : 0;
    }
    iris_scratch scratch = arena(IRIS_EDGE_SCRATCH_BYTES(9));
    iris_image dst = other_view(&src, IRIS_GRAY_U16, 0);
    for (int op = 0; op < 4; op++) {
        iris_edge_config config = config_of(op);
        assert_int_equal(iris_edge_direction(&dst, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
        const uint16_t *row = iris_image_row(&dst, 4);
        assert_int_equal(row[2], 0);
        assert_int_equal((int16_t)row[op == IRIS_EDGE_ROBERTS ? 5 : 6], INT16_MIN);
        assert_int_equal(row[0], 0);
        row = iris_image_row(&dst, 2);
        assert_int_equal(row[4], 16384);
        assert_int_equal(row[2], 8192);
        row = iris_image_row(&dst, op == IRIS_EDGE_ROBERTS ? 5 : 6);
        assert_int_equal((int16_t)row[4], -16384);
    }
    iris_image dx = other_view(&src, IRIS_GRAY_S16, 0), dy = other_view(&src, IRIS_GRAY_S16, 1);
    static const int16_t sides[4] = {4 * 255, 3 * 255, 871, 255};
    for (int op = 0; op < 4; op++) {
        iris_edge_config config = config_of(op);
        assert_int_equal(iris_edge_gradient(&dx, &dy, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
        assert_int_equal(((const int16_t *)iris_image_row(&dx, 4))[2], sides[op]);
        assert_int_equal(((const int16_t *)iris_image_row(&dy, 4))[2],
                         op == IRIS_EDGE_ROBERTS ? -sides[op] : 0);
    }
}

/* A step of 100 between columns 3 and 4, and a ramp of two: each is one column of crossings. */
static void crossings_by_hand(void **state)
{
    (void)state;
    static const uint8_t step[8] = {10, 10, 10, 10, 110, 110, 110, 110};
    static const uint8_t ramp[8] = {10, 10, 10, 10, 60, 110, 110, 110};
    iris_edge_config config = config_of(IRIS_EDGE_LAPLACIAN);
    iris_scratch scratch = arena(IRIS_EDGE_SCRATCH_BYTES(8));
    for (int kind = 0; kind < 2; kind++) {
        iris_image src = picture_of(0, (iris_size){8, 5});
        for (int32_t y = 0; y < 5; y++) {
            memcpy(iris_image_row(&src, y), kind ? ramp : step, 8);
        }
        for (config.threshold = 0; config.threshold < 300; config.threshold++) {
            iris_image mask = mask_view(8, 5);
            assert_int_equal(iris_edge_mask(&mask, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
            int found = config.threshold < (kind ? 100 : 200);
            for (int32_t i = 0; i < 40; i++) {
                assert_int_equal(bit(&mask, i % 8, i / 8), found && i % 8 == (kind ? 4 : 3));
            }
        }
    }
}

/* The blurred picture in double precision, without end but for what weighs nothing, one pixel beyond the edge too. */
static double smooth[(SIDE_MAX + 2) * (SIDE_MAX + 2)];

static void make_smooth(const iris_image *src, double sigma, iris_border border)
{
    static double down[SIDE_MAX * 3 * SIDE_MAX];
    int32_t reach = (int32_t)ceil(6 * sigma), wide = src->w + 2 * reach;
    for (int32_t i = 0; i < src->h * wide; i++) {
        double sum = 0, weights = 0;
        for (int32_t k = -reach; k <= reach; k++) {
            double weight = exp(-k * k / (2 * sigma * sigma));
            sum += weight * pixel_beyond(src, i % wide - reach, i / wide + k, border);
            weights += weight;
        }
        down[i] = sum / weights;
    }
    for (int32_t i = 0; i < (src->w + 2) * (src->h + 2); i++) {
        int32_t x = place_beyond(i % (src->w + 2) - 1, src->w, border.rule);
        int32_t y = place_beyond(i / (src->w + 2) - 1, src->h, border.rule);
        double sum = 0, weights = 0;
        for (int32_t k = -reach; k <= reach && x >= 0 && y >= 0; k++) {
            double weight = exp(-k * k / (2 * sigma * sigma));
            sum += weight * down[y * wide + x + k + reach];
            weights += weight;
        }
        smooth[i] = weights > 0 ? sum / weights : border.value;
    }
}

/* Values against doubles: the largest difference, in 32nds of a level; and a magnitude that fits them exactly. */
static double log_error(const iris_image *src, const iris_edge_config *config, iris_border border)
{
    iris_image values = other_view(src, IRIS_GRAY_S16, 0), dst = other_view(src, IRIS_GRAY8, 1);
    int32_t margin = border.rule == IRIS_BORDER_SKIP ? IRIS_BLUR_RADIUS(config->sigma_q16) + 1 : 0;
    int32_t wide = src->w + 2;
    double worst = 0;
    iris_scratch scratch = arena(IRIS_EDGE_LOG_SCRATCH_BYTES(src->w, config->sigma_q16));
    assert_int_equal(iris_edge_gradient(&values, NULL, src, config, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, IRIS_EDGE_LOG_SCRATCH_BYTES(src->w, config->sigma_q16));
    assert_int_equal(scratch.used, 0);
    assert_int_equal(iris_edge_magnitude(&dst, src, config, border, &scratch), IRIS_OK);
    make_smooth(src, config->sigma_q16 / 65536.0, border);
    for (int32_t i = 0; i < src->w * src->h; i++) {
        int32_t x = i % src->w, y = i / src->w;
        int32_t value = ((const int16_t *)iris_image_row(&values, y))[x];
        if (x < margin || y < margin || x >= src->w - margin || y >= src->h - margin) {
            assert_int_equal(value, UNTOUCHED_S16);
            assert_int_equal(pixel(&dst, x, y), UNTOUCHED);
            continue;
        }
        const double *p = smooth + (y + 1) * wide + x + 1;
        worst = fmax(worst, fabs(value - 32 * (p[-1] + p[1] + p[-wide] + p[wide] - 4 * p[0])));
        double level = floor(abs(value) * (config->gain_q16 / 65536.0) + 0.5);
        assert_int_equal(pixel(&dst, x, y), (int)fmin(level, 255));
    }
    assert_around_untouched();
    return worst;
}

static void laplacian_of_gaussian(void **state)
{
    (void)state;
    static const iris_q16 sigmas[] = {65536, 91750, 150000, 300000};
    static const iris_size sizes[] = {{1, 1}, {9, 1}, {2, 12}, {33, 21}, {65, 40}};
    for (int i = 0; i < 5; i++) {
        for (int k = 0; k < 4 * 4; k++) {
            iris_border border = {(iris_border_rule)(k % 4), 77};
            iris_edge_config config = config_of(IRIS_EDGE_LOG);
            config.sigma_q16 = sigmas[k / 4];
            for (int kind = 0; kind < PICTURE_KINDS; kind++) {
                iris_image src = picture_of(kind, sizes[i]);
                config.threshold = 40 * kind;
                config.gain_q16 = kind == 1 ? IRIS_EDGE_GAIN_END - 1 : 30000 * kind;
                double error = log_error(&src, &config, border);
                if (error > 32) { /* a level */
                    fail_msg("off by %f at sigma %d, %dx%d, kind %d", error, config.sigma_q16, src.w, src.h,
                             kind);
                }
                assert_crossings(&src, &config, border);
            }
        }
    }
}

/* The extremes of 16 bits: single pixels, hardly smoothed. */
static void laplacian_of_little_smoothing(void **state)
{
    (void)state;
    iris_image src = picture_of(0, (iris_size){9, 9}), values = other_view(&src, IRIS_GRAY_S16, 0);
    iris_edge_config config = config_of(IRIS_EDGE_LOG);
    config.sigma_q16 = IRIS_BLUR_SIGMA_MIN;
    iris_scratch scratch = arena(IRIS_EDGE_LOG_SCRATCH_BYTES(9, IRIS_BLUR_SIGMA_MIN));
    for (int32_t i = 0; i < 81; i++) {
        ((uint8_t *)iris_image_row(&src, i / 9))[i % 9] = (i / 9 + i % 9) % 2 ? 255 : 0;
    }
    assert_int_equal(iris_edge_gradient(&values, NULL, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
    for (int32_t i = 0; i < 49; i++) {
        int32_t x = i % 7 + 1, y = i / 7 + 1;
        assert_int_equal(((const int16_t *)iris_image_row(&values, y))[x],
                         (x + y) % 2 ? -4 * 255 * 32 : 4 * 255 * 32);
    }
    config.gain_q16 = IRIS_EDGE_GAIN_END - 1;
    iris_image dst = other_view(&src, IRIS_GRAY8, 0);
    assert_int_equal(iris_edge_magnitude(&dst, &src, &config, (iris_border){0}, &scratch), IRIS_OK);
    assert_int_equal(pixel(&dst, 4, 4), 255);
}

static void scratch_is_exact(void **state)
{
    (void)state;
    reset_results();
    iris_image src = picture_of(1, (iris_size){37, 8}), gray = other_view(&src, IRIS_GRAY8, 0);
    iris_image dx = other_view(&src, IRIS_GRAY_S16, 0), angle = other_view(&src, IRIS_GRAY_U16, 0);
    iris_image mask = mask_view(37, 8);
    const size_t bytes = IRIS_EDGE_SCRATCH_BYTES(37);
    assert_int_equal(bytes, 4 * 64 + 5 * 80); /* 16 + 37 + 1 bytes; 39 of 2 bytes */
    iris_scratch scratch = arena(bytes - 1);
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    assert_int_equal(iris_edge_gradient(&dx, NULL, &src, NULL, border, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_edge_magnitude(&gray, &src, NULL, border, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_edge_direction(&angle, &src, NULL, border, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_edge_mask(&mask, &src, NULL, border, &scratch), IRIS_ERR_SCRATCH);
    iris_edge_config log = config_of(IRIS_EDGE_LOG);
    scratch = arena(IRIS_EDGE_LOG_SCRATCH_BYTES(37, log.sigma_q16) - 1);
    assert_int_equal(iris_edge_mask(&mask, &src, &log, border, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    assert_all_untouched();
    scratch = arena(bytes);
    assert_int_equal(iris_edge_mask(&mask, &src, NULL, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, bytes);
}

static iris_status mask_by(iris_edge_config config, iris_border border)
{
    iris_image src = picture_of(1, (iris_size){20, 10}), mask = mask_view(20, 10);
    iris_scratch scratch = arena(IRIS_EDGE_SCRATCH_BYTES(20));
    iris_status status = iris_edge_mask(&mask, &src, &config, border, &scratch);
    assert_true(status == IRIS_OK || scratch.peak == 0);
    return status;
}

static void values_outside_their_range(void **state)
{
    (void)state;
    reset_results();
    const iris_border border = {IRIS_BORDER_SKIP, 0};
    iris_edge_config good = config_of(IRIS_EDGE_SOBEL), bad = good;
    assert_int_equal(mask_by(good, border), IRIS_OK);
    assert_int_equal(mask_by(good, (iris_border){(iris_border_rule)4, 0}), IRIS_ERR_ARG);
    assert_int_equal(mask_by(good, (iris_border){(iris_border_rule)-1, 0}), IRIS_ERR_ARG);
    bad.op = (iris_edge_operator)(IRIS_EDGE_LOG + 1);
    assert_int_equal(mask_by(bad, border), IRIS_ERR_ARG);
    bad.op = (iris_edge_operator)-1;
    assert_int_equal(mask_by(bad, border), IRIS_ERR_ARG);
    bad = good;
    bad.gain_q16 = -1;
    assert_int_equal(mask_by(bad, border), IRIS_ERR_ARG);
    bad.gain_q16 = IRIS_EDGE_GAIN_END;
    assert_int_equal(mask_by(bad, border), IRIS_ERR_ARG);
    bad = good;
    bad.threshold = -1;
    assert_int_equal(mask_by(bad, border), IRIS_ERR_ARG);
    bad.threshold = IRIS_EDGE_THRESHOLD_END;
    assert_int_equal(mask_by(bad, border), IRIS_ERR_ARG);
    assert_all_untouched();
    bad = config_of(IRIS_EDGE_LOG);
    bad.sigma_q16 = 0;
    assert_int_equal(mask_by(bad, border), IRIS_ERR_ARG);
    bad.sigma_q16 = IRIS_BLUR_SIGMA_MAX + 1;
    assert_int_equal(mask_by(bad, border), IRIS_ERR_ARG);
    assert_all_untouched();
    bad = good;
    bad.sigma_q16 = -1; /* not looked at */
    bad.threshold = IRIS_EDGE_THRESHOLD_END - 1;
    bad.gain_q16 = IRIS_EDGE_GAIN_END - 1;
    assert_int_equal(mask_by(bad, border), IRIS_OK);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    reset_results();
    iris_image src = picture_of(1, (iris_size){20, 10}), gray = other_view(&src, IRIS_GRAY8, 0), bad;
    iris_image dx = other_view(&src, IRIS_GRAY_S16, 0), dy = other_view(&src, IRIS_GRAY_S16, 1);
    iris_image angle = other_view(&src, IRIS_GRAY_U16, 0), mask = mask_view(20, 10);
    iris_edge_config laplacian = config_of(IRIS_EDGE_LAPLACIAN);
    iris_scratch scratch = arena(IRIS_EDGE_SCRATCH_BYTES(20));
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    assert_int_equal(iris_edge_gradient(NULL, NULL, &src, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_gradient(&dx, &dy, NULL, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_gradient(&dx, &dy, &src, NULL, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_gradient(&dx, &dy, &src, &laplacian, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_gradient(&dx, &dx, &src, NULL, border, &scratch), IRIS_ERR_ALIAS);
    assert_int_equal(iris_edge_gradient(&dx, &angle, &src, NULL, border, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_edge_gradient(&gray, NULL, &src, NULL, border, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_edge_direction(&angle, &src, &laplacian, border, &scratch), IRIS_ERR_ARG);
    laplacian.op = IRIS_EDGE_LOG;
    assert_int_equal(iris_edge_gradient(&dx, &dy, &src, &laplacian, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_direction(&angle, &src, &laplacian, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_direction(&dx, &src, NULL, border, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_edge_direction(NULL, &src, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_magnitude(&gray, &gray, NULL, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_magnitude(NULL, &src, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_magnitude(&mask, &src, NULL, border, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_edge_magnitude(&gray, &mask, NULL, border, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_edge_mask(&mask, NULL, NULL, border, &scratch), IRIS_ERR_ARG);
    bad = gray;
    bad.w = 19;
    assert_int_equal(iris_edge_magnitude(&bad, &src, NULL, border, &scratch), IRIS_ERR_RANGE);
    bad.w = 0;
    assert_int_equal(iris_edge_magnitude(&bad, &src, NULL, border, &scratch), IRIS_ERR_RANGE);
    bad = src;
    bad.data = (uint8_t *)src.data + 1;
    assert_int_equal(iris_edge_magnitude(&bad, &src, NULL, border, &scratch), IRIS_ERR_ALIAS);
    assert_int_equal(scratch.peak, 0);
    assert_all_untouched();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_result_at_every_border),
        cmocka_unit_test(a_photograph),
        cmocka_unit_test(a_square_by_hand),
        cmocka_unit_test(crossings_by_hand),
        cmocka_unit_test(laplacian_of_gaussian),
        cmocka_unit_test(laplacian_of_little_smoothing),
        cmocka_unit_test(scratch_is_exact),
        cmocka_unit_test(values_outside_their_range),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("edge", tests, NULL, NULL);
}
