/* Disparities of pairs whose disparities are known, and block matching against the same, window by window. */
#include "iris/3d/stereo.h"

#include "random_number.h"
#include "test.h"

enum { W = 61, H = 41, MOST = 12 };

/* A pair, with margins around each view that nobody may touch. */
typedef struct {
    uint8_t left[H + 2][W + 9], right[H + 2][W + 5];
    uint16_t disparity[H + 2][W + 7];
    iris_image l, r, d;
} pair;

static pair p;
static IRIS_SCRATCH_BUFFER(working, IRIS_STEREO_BLOCK_SCRATCH_BYTES(W, IRIS_STEREO_DISPARITY_MAX));

static iris_scratch scratch_of(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, bytes), IRIS_OK);
    return scratch;
}

/* 0 to n - 1. */
static uint32_t random_below(uint32_t n)
{
    return (uint32_t)(random_u64() >> 32) % n;
}

/* Views of w x h pixels in the middle of their memory, the right one bottom-up. */
static void make_views(int32_t w, int32_t h)
{
    memset(p.disparity, 0xA5, sizeof p.disparity);
    p.l = (iris_image){&p.left[1][3], sizeof p.left[0], w, h, IRIS_GRAY8};
    p.r = (iris_image){&p.right[h][2], -(ptrdiff_t)sizeof p.right[0], w, h, IRIS_GRAY8};
    p.d = (iris_image){&p.disparity[1][4], sizeof p.disparity[0], w, h, IRIS_GRAY_U16};
}

static void assert_margins(void)
{
    for (int32_t y = 0; y < H + 2; y++) {
        for (int32_t x = 0; x < W + 7; x++) {
            int inside = y >= 1 && y <= p.d.h && x >= 4 && x < 4 + p.d.w;
            assert_true(inside || p.disparity[y][x] == 0xA5A5);
        }
    }
}

static uint8_t *pixel(const iris_image *image, int32_t x, int32_t y)
{
    return (uint8_t *)iris_image_row(image, y) + x;
}

static int32_t disparity_at(int32_t x, int32_t y)
{
    return ((const uint16_t *)iris_image_row(&p.d, y))[x];
}

static void fill_random(uint8_t most)
{
    for (int32_t y = 0; y < p.l.h; y++) {
        for (int32_t x = 0; x < p.l.w; x++) {
            *pixel(&p.l, x, y) = (uint8_t)random_below((uint32_t)most + 1);
            *pixel(&p.r, x, y) = (uint8_t)random_below((uint32_t)most + 1);
        }
    }
}

static iris_stereo_block_config plain(int32_t most, iris_stereo_cost cost, int32_t side)
{
    return (iris_stereo_block_config){{most, cost, 255, 0, 0, 0}, side};
}

static void run_block(const iris_stereo_block_config *config)
{
    iris_scratch scratch = scratch_of(IRIS_STEREO_BLOCK_SCRATCH_BYTES(p.l.w, config->stereo.max_disparity));
    assert_int_equal(iris_stereo_block(&p.d, &p.l, &p.r, config, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, scratch.bytes);
    assert_int_equal(scratch.used, 0);
    assert_margins();
}

/* --- block matching as the header says it, window by window --- */

static int32_t clamp(int32_t a, int32_t most)
{
    return a < 0 ? 0 : a > most ? most : a;
}

static int32_t gray(const iris_image *image, int32_t x, int32_t y)
{
    return *pixel(image, clamp(x, image->w - 1), clamp(y, image->h - 1));
}

static int32_t pixel_cost(int32_t x, int32_t y, int32_t d, iris_stereo_cost cost)
{
    x = clamp(x, p.l.w - 1);
    y = clamp(y, p.l.h - 1);
    int32_t to = clamp(x - d, p.l.w - 1), sum = 0;
    for (int32_t k = 0; k < 25 && cost != IRIS_STEREO_SAD; k++) {
        int32_t dx = k % 5 - 2, dy = k / 5 - 2;
        int darker = gray(&p.l, x + dx, y + dy) < gray(&p.l, x, y);
        sum += darker != (gray(&p.r, to + dx, y + dy) < gray(&p.r, to, y));
    }
    int32_t apart = abs(gray(&p.l, x, y) - gray(&p.r, to, y));
    return sum + (cost == IRIS_STEREO_CENSUS ? 0 : apart < 32 ? apart : 32);
}

static int32_t window_cost(int32_t x, int32_t y, int32_t d, const iris_stereo_block_config *config)
{
    int32_t reach = config->side / 2, sum = 0;
    for (int32_t dy = -reach; dy <= reach; dy++) {
        for (int32_t dx = -reach; dx <= reach; dx++) {
            sum += pixel_cost(x + dx, y + dy, d, config->stereo.cost);
        }
    }
    return sum;
}

/* The whole disparity of the left (1) or right (-1) picture's place, and the costs of all that are possible. */
static int32_t best_at(int32_t costs[MOST + 1], int32_t x, int32_t y, int side,
                       const iris_stereo_block_config *config)
{
    int32_t best = 0;
    for (int32_t d = 0; d <= config->stereo.max_disparity; d++) {
        int32_t from = side > 0 ? x : x + d;
        costs[d] = from >= p.l.w || from - d < 0 ? INT32_MAX : window_cost(from, y, d, config);
        best = costs[d] < costs[best] ? d : best;
    }
    return best;
}

static int32_t expected_at(int32_t x, int32_t y, const iris_stereo_block_config *config)
{
    int32_t c[MOST + 1], other[MOST + 1], most = config->stereo.max_disparity;
    int32_t best = best_at(c, x, y, 1, config), value = 256 * best;
    for (int32_t d = 0; d <= most && config->stereo.uniqueness_percent > 0; d++) {
        int64_t margin = (int64_t)c[d] * (100 - config->stereo.uniqueness_percent);
        if (c[d] != INT32_MAX && abs(d - best) > 1 && margin < 100 * (int64_t)c[best]) {
            return 0;
        }
    }
    if (config->stereo.check_px < 255 &&
        abs(best_at(other, x - best, y, -1, config) - best) > config->stereo.check_px) {
        return 0;
    }
    if (best > 0 && best < most && c[best + 1] != INT32_MAX && c[best - 1] + c[best + 1] > 2 * c[best]) {
        double off = 128.0 * (c[best - 1] - c[best + 1]) / (c[best - 1] + c[best + 1] - 2 * c[best]);
        int32_t whole = (int32_t)(off < 0 ? off - 0.5 : off + 0.5);
        value += whole > 127 ? 127 : whole < -127 ? -127 : whole;
    }
    return value > 0 ? value : 1;
}

static void assert_as_expected(const iris_stereo_block_config *config)
{
    run_block(config);
    for (int32_t y = 0; y < p.l.h; y++) {
        for (int32_t x = 0; x < p.l.w; x++) {
            assert_int_equal(disparity_at(x, y), expected_at(x, y, config));
        }
    }
}

static void block_is_the_least_of_all_windows(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1}, {2, 3}, {5, 1}, {17, 9}, {24, 4}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int k = 0; k < 6; k++) {
            make_views(sizes[i].w, sizes[i].h);
            fill_random(k % 2 ? 255 : 20);
            iris_stereo_block_config config = plain(k < 3 ? MOST : 1, (iris_stereo_cost)(k % 3), 1 + 2 * k);
            assert_as_expected(&config);
            config.stereo.check_px = k % 3;
            config.stereo.uniqueness_percent = 4 * k;
            assert_as_expected(&config);
        }
    }
}

static void extremes_do_not_overflow(void **state)
{
    (void)state;
    make_views(W, 3);
    for (int32_t y = 0; y < 3; y++) {
        for (int32_t x = 0; x < W; x++) {
            *pixel(&p.l, x, y) = (x + y) % 2 ? 255 : 0;
            *pixel(&p.r, x, y) = (x + y) % 2 ? 0 : 255;
        }
    }
    iris_stereo_block_config config = plain(2, IRIS_STEREO_BOTH, IRIS_STEREO_SIDE_MAX);
    assert_as_expected(&config);
    config.stereo.max_disparity = IRIS_STEREO_DISPARITY_MAX;
    run_block(&config);
}

/* --- semi-global matching as the header says it, with all costs of the picture at once --- */

enum { TALL = 37, NARROW = 9, FEW = 5 };

typedef int32_t volume[TALL][NARROW][FEW];

/* Of all the ways to get to disparity d from a pixel whose paths are `from`, null: the path begins here. */
static int32_t way_to(const int32_t *from, int32_t d, int32_t leap, int32_t p1)
{
    int32_t best = INT32_MAX, least = INT32_MAX;
    for (int32_t k = 0; k < FEW && from; k++) {
        int32_t step = k == d ? 0 : abs(k - d) == 1 && p1 < leap ? p1 : leap;
        best = from[k] + step < best ? from[k] + step : best;
        least = from[k] < least ? from[k] : least;
    }
    return from ? best - least : 0;
}

static int32_t leap_of(int32_t x, int32_t y, int32_t from_x, int32_t from_y, int32_t p1, int32_t p2)
{
    int32_t apart = abs(gray(&p.l, x, y) - gray(&p.l, from_x, from_y));
    return apart <= 4 ? p2 : p2 / 4 > p1 ? p2 / 4 : p1;
}

/* Adds the paths that come from (dx, dy), of rows[0] to rows[1] - 1; they begin in row rows[2] - 1 at the latest. */
static void add_paths(volume sums, int32_t dx, int32_t dy, const int32_t rows[3],
                      const iris_stereo_semiglobal_config *c)
{
    static volume paths;
    int32_t w = p.l.w, end = rows[2];
    for (int32_t i = 0; i < end * w; i++) {
        int32_t y = dy > 0 ? end - 1 - i / w : i / w, x = dx > 0 ? w - 1 - i % w : i % w;
        int32_t from_x = x + dx, from_y = y + dy;
        int begins = from_x < 0 || from_x >= w || from_y < 0 || from_y >= end;
        const int32_t *from = begins ? NULL : paths[from_y][from_x];
        int32_t leap = begins ? 0 : leap_of(x, y, from_x, from_y, c->p1, c->p2);
        for (int32_t d = 0; d < FEW; d++) {
            paths[y][x][d] = pixel_cost(x, y, d, c->stereo.cost) + way_to(from, d, leap, c->p1);
            sums[y][x][d] += y >= rows[0] && y < rows[1] ? paths[y][x][d] : 0;
        }
    }
}

static void semiglobal_is_the_sum_of_four_paths(void **state)
{
    (void)state;
    static volume sums;
    static IRIS_SCRATCH_BUFFER(room, IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(NARROW, FEW - 1));
    static const iris_size sizes[] = {{NARROW, TALL}, {1, 1}, {NARROW, 16}, {4, 33}, {NARROW, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        make_views(sizes[i].w, sizes[i].h);
        fill_random(i % 2 ? 255 : 12);
        int32_t h = sizes[i].h;
        iris_stereo_semiglobal_config config = {
            {FEW - 1, IRIS_STEREO_BOTH, 255, 0, 0, 0}, 6, i == 2 ? 10000 : 40};
        memset(sums, 0, sizeof sums);
        add_paths(sums, -1, 0, (int32_t[]){0, h, h}, &config);
        add_paths(sums, 1, 0, (int32_t[]){0, h, h}, &config);
        add_paths(sums, 0, -1, (int32_t[]){0, h, h}, &config);
        for (int32_t y = 0; y < h; y += 16) {
            int32_t last = y + 16 < h ? y + 16 : h;
            add_paths(sums, 0, 1, (int32_t[]){y, last, last + 16 < h ? last + 16 : h}, &config);
        }
        iris_scratch scratch;
        size_t bytes = IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(sizes[i].w, FEW - 1);
        assert_int_equal(iris_scratch_init(&scratch, room.memory, bytes), IRIS_OK);
        assert_int_equal(iris_stereo_semiglobal(&p.d, &p.l, &p.r, &config, &scratch), IRIS_OK);
        assert_int_equal(scratch.peak, bytes);
        assert_margins();
        for (int32_t k = 0; k < h * sizes[i].w; k++) {
            int32_t x = k % sizes[i].w, y = k / sizes[i].w, best = 0;
            for (int32_t d = 1; d < FEW && d <= x; d++) {
                best = sums[y][x][d] < sums[y][x][best] ? d : best;
            }
            assert_int_equal((disparity_at(x, y) + 128) / 256, best);
        }
        assert_int_equal(iris_scratch_init(&scratch, room.memory, bytes - 1), IRIS_OK);
        assert_int_equal(iris_stereo_semiglobal(&p.d, &p.l, &p.r, &config, &scratch), IRIS_ERR_SCRATCH);
    }
}

/* --- pairs with a known answer --- */

/* Random dots of which a square lies `near` to the front, and the rest `far`. */
static void make_dots(int32_t far, int32_t near)
{
    make_views(W, H);
    fill_random(255);
    for (int32_t y = 0; y < H; y++) {
        for (int32_t x = far; x < W; x++) {
            *pixel(&p.l, x, y) = *pixel(&p.r, x - far, y);
        }
        for (int32_t x = 24; x < 44 && y >= 10 && y < 30; x++) {
            *pixel(&p.l, x, y) = *pixel(&p.r, x - near, y) = (uint8_t)random_below(256);
        }
    }
}

static void dots_have_their_exact_disparity(void **state)
{
    (void)state;
    for (int cost = IRIS_STEREO_CENSUS; cost <= IRIS_STEREO_BOTH; cost++) {
        make_dots(2, 9);
        iris_stereo_block_config config;
        iris_stereo_block_defaults(&config);
        config.stereo.max_disparity = MOST;
        config.stereo.cost = (iris_stereo_cost)cost;
        config.side = 7;
        run_block(&config);
        for (int32_t y = 0; y < H; y++) {
            for (int32_t x = 0; x < W; x++) {
                int32_t d = (disparity_at(x, y) + 128) / 256;
                assert_true(d >= 0 && d <= MOST);
                if (x >= 30 && x < 38 && y >= 16 && y < 24) {
                    assert_int_equal(d, 9);
                } else if ((x >= 6 && x < 12) || x >= 52) {
                    assert_int_equal(d, 2);
                }
            }
        }
    }
}

/* Smooth stripes, another row of them for each row, with 16 places to a pixel. */
static void make_wave(uint8_t *wave, int32_t count)
{
    int32_t from = 0, to = 128;
    for (int32_t i = 0; i < count; i++) {
        if (i % 32 == 0) {
            from = to;
            to = (int32_t)random_below(160);
        }
        wave[i] = (uint8_t)((from * (32 - i % 32) + to * (i % 32)) / 32);
    }
}

/* A plane that comes nearer from left to right. */
static void slanted_planes_have_fractions(void **state)
{
    (void)state;
    make_views(W, H);
    static uint8_t wave[16 * (W + 16)];
    for (int32_t y = 0; y < H; y++) {
        make_wave(wave, sizeof wave);
        for (int32_t x = 0; x < W; x++) {
            int32_t d16 = 48 + x;
            *pixel(&p.r, x, y) = wave[16 * x];
            *pixel(&p.l, x, y) = wave[16 * x >= d16 ? 16 * x - d16 : 0];
        }
    }
    iris_stereo_block_config config = plain(MOST, IRIS_STEREO_SAD, 9);
    run_block(&config);
    int32_t off = 0, count = 0;
    for (int32_t y = 5; y < H - 5; y++) {
        for (int32_t x = 12; x < W - 6; x++, count++) {
            int32_t apart = abs(disparity_at(x, y) - 16 * (48 + x));
            assert_in_range(apart, 0, 256);
            off += apart;
        }
    }
    assert_in_range(off, 0, 40 * count); /* whole disparities alone are off by 64 on average */
}

/* --- what is done to disparities --- */

static void put(int32_t x, int32_t y, uint16_t value)
{
    ((uint16_t *)iris_image_row(&p.d, y))[x] = value;
}

static int compare(const void *a, const void *b)
{
    return *(const uint16_t *)a - *(const uint16_t *)b;
}

static void smoothing_takes_the_median_of_matches(void **state)
{
    (void)state;
    static uint16_t was[H][W];
    static const iris_size sizes[] = {{1, 1}, {3, 2}, {W, 7}, {4, H}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        make_views(sizes[i].w, sizes[i].h);
        for (int32_t k = 0; k < p.d.w * p.d.h; k++) {
            uint16_t value = random_below(3) ? (uint16_t)random_below(65536) : 0;
            put(k % p.d.w, k / p.d.w, value);
            was[k / p.d.w][k % p.d.w] = value;
        }
        iris_scratch scratch = scratch_of(IRIS_STEREO_SMOOTH_SCRATCH_BYTES(p.d.w));
        assert_int_equal(iris_stereo_smooth(&p.d, &scratch), IRIS_OK);
        assert_int_equal(scratch.peak, scratch.bytes);
        assert_margins();
        for (int32_t k = 0; k < p.d.w * p.d.h; k++) {
            uint16_t around[25] = {0};
            size_t count = 0;
            int32_t x = k % p.d.w, y = k / p.d.w;
            for (int32_t n = 0; n < 25; n++) {
                int32_t at_x = x + n % 5 - 2, at_y = y + n / 5 - 2;
                int inside = at_x >= 0 && at_y >= 0 && at_x < p.d.w && at_y < p.d.h;
                if (inside && was[at_y][at_x] != 0) {
                    around[count++] = was[at_y][at_x];
                }
            }
            qsort(around, count, sizeof around[0], compare);
            assert_int_equal(disparity_at(x, y), was[y][x] ? around[(count - 1) / 2] : 0);
        }
    }
}

static void small_specks_go(void **state)
{
    (void)state;
    make_views(20, 10);
    for (int32_t k = 0; k < 200; k++) {
        put(k % 20, k / 20, k % 20 < 10 ? 512 : 0);
    }
    static const uint8_t speck[][2] = {{12, 2}, {13, 2}, {14, 2}, {14, 3}, {14, 4}, {13, 4}};
    for (size_t i = 0; i < 6; i++) {
        put(speck[i][0], speck[i][1], (uint16_t)(3000 + 100 * i));
    }
    put(4, 4, 2000); /* alone within the large one */
    iris_scratch scratch = scratch_of(IRIS_STEREO_SPECKLE_SCRATCH_BYTES(20, 10));
    assert_int_equal(iris_stereo_speckle(&p.d, 6, 100, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, scratch.bytes);
    assert_int_equal(disparity_at(14, 4), 3400);
    assert_int_equal(disparity_at(4, 4), 0);
    assert_int_equal(disparity_at(3, 4), 512);
    assert_int_equal(iris_stereo_speckle(&p.d, 6, 99, &scratch), IRIS_OK);
    assert_int_equal(disparity_at(14, 4), 0);
    assert_int_equal(iris_stereo_speckle(&p.d, 99, 0, &scratch), IRIS_OK);
    assert_int_equal(disparity_at(0, 0), 512); /* 100 pixels less one */
    assert_int_equal(iris_stereo_speckle(&p.d, 100, 0, &scratch), IRIS_OK);
    assert_int_equal(disparity_at(0, 0), 0);
    assert_margins();
    assert_int_equal(iris_stereo_speckle(&p.d, -1, 0, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_speckle(&p.d, 1, 65536, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_speckle(&p.l, 1, 0, &scratch), IRIS_ERR_FORMAT);
    scratch = scratch_of(IRIS_STEREO_SPECKLE_SCRATCH_BYTES(20, 10) - 1);
    assert_int_equal(iris_stereo_speckle(&p.d, 1, 0, &scratch), IRIS_ERR_SCRATCH);
}

static void depth_is_baseline_times_focal_length_by_disparity(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    assert_true(iris_stereo_depth(256, 2 * one, 100 * one) == 200 * one);
    assert_true(iris_stereo_depth(128, 2 * one, 100 * one) == 400 * one);
    assert_true(iris_stereo_depth(0, 2 * one, 100 * one) == IRIS_STEREO_INFINITY);
    assert_true(iris_stereo_depth(1, INT64_MAX, INT64_MAX) == IRIS_STEREO_INFINITY);
    for (int i = 0; i < 1000; i++) {
        uint16_t disparity = (uint16_t)(1 + random_below(65535));
        double b = random_below(1000000) / 1000.0, f = 1 + random_below(3000);
        double z = (double)iris_stereo_depth(disparity, (iris_q32)(b * (double)one), (iris_q32)f * one) /
                   (double)one;
        double expected = b * f * 256 / disparity;
        assert_true(z > expected - 1e-3 && z < expected + 1e-3);
    }
}

static void calls_that_are_refused(void **state)
{
    (void)state;
    make_views(W, H);
    fill_random(255);
    iris_stereo_block_config config = plain(MOST, IRIS_STEREO_BOTH, 3);
    size_t bytes = IRIS_STEREO_BLOCK_SCRATCH_BYTES(W, MOST);
    iris_scratch scratch = scratch_of(bytes - 1), enough = scratch_of(bytes);
    assert_int_equal(iris_stereo_block(&p.d, &p.l, &p.r, &config, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(iris_stereo_block(NULL, &p.l, &p.r, &config, &enough), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_block(&p.d, NULL, &p.r, &config, &enough), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_block(&p.d, &p.l, NULL, &config, &enough), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_block(&p.d, &p.l, &p.r, &config, NULL), IRIS_ERR_ARG);
    static const iris_stereo_block_config wrong[] = {{{0, 0, 1, 0, 0, 0}, 3},   {{256, 0, 1, 0, 0, 0}, 3},
                                                     {{9, 3, 1, 0, 0, 0}, 3},   {{9, 0, -1, 0, 0, 0}, 3},
                                                     {{9, 0, 256, 0, 0, 0}, 3}, {{9, 0, 1, -1, 0, 0}, 3},
                                                     {{9, 0, 1, 0, 0, 0}, 4},   {{9, 0, 1, 100, 0, 0}, 3},
                                                     {{9, 0, 1, 0, 0, 0}, 33},  {{9, 0, 1, 0, 0, 0}, -1}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(iris_stereo_block(&p.d, &p.l, &p.r, &wrong[i], &enough), IRIS_ERR_ARG);
    }
    static const iris_stereo_semiglobal_config wrong_paths[] = {{{9, 0, 1, 0, 0, 0}, -1, 9},
                                                                {{9, 0, 1, 0, 0, 0}, 10, 9},
                                                                {{9, 0, 1, 0, 0, 0}, 1, 10001},
                                                                {{0, 0, 1, 0, 0, 0}, 1, 9}};
    for (size_t i = 0; i < sizeof wrong_paths / sizeof wrong_paths[0]; i++) {
        assert_int_equal(iris_stereo_semiglobal(&p.d, &p.l, &p.r, &wrong_paths[i], &enough), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_stereo_semiglobal(&p.d, &p.l, &p.r, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_semiglobal(&p.l, &p.l, &p.r, NULL, &enough), IRIS_ERR_FORMAT);
    assert_int_equal(iris_stereo_block(&p.l, &p.l, &p.r, &config, &enough), IRIS_ERR_FORMAT);
    iris_image small = p.r, over = p.l;
    small.w--;
    over.data = p.d.data;
    assert_int_equal(iris_stereo_block(&p.d, &p.l, &small, &config, &enough), IRIS_ERR_RANGE);
    assert_int_equal(iris_stereo_block(&p.d, &over, &p.r, &config, &enough), IRIS_ERR_ALIAS);
    assert_int_equal(iris_stereo_smooth(NULL, &enough), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_smooth(&p.l, &enough), IRIS_ERR_FORMAT);
    scratch = scratch_of(IRIS_STEREO_SMOOTH_SCRATCH_BYTES(W) - 1);
    assert_int_equal(iris_stereo_smooth(&p.d, &scratch), IRIS_ERR_SCRATCH);
    for (int32_t k = 0; k < W * H; k++) {
        assert_int_equal(disparity_at(k % W, k / W), 0xA5A5);
    }
    assert_int_equal(iris_stereo_block(&p.d, &p.l, &p.r, &config, &enough), IRIS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(block_is_the_least_of_all_windows),
        cmocka_unit_test(extremes_do_not_overflow),
        cmocka_unit_test(semiglobal_is_the_sum_of_four_paths),
        cmocka_unit_test(dots_have_their_exact_disparity),
        cmocka_unit_test(slanted_planes_have_fractions),
        cmocka_unit_test(smoothing_takes_the_median_of_matches),
        cmocka_unit_test(small_specks_go),
        cmocka_unit_test(depth_is_baseline_times_focal_length_by_disparity),
        cmocka_unit_test(calls_that_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
