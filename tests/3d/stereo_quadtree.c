/* The quadtree's windows: against the same tile by tile, and pairs whose disparities are known. */
#include <math.h>

#include "iris/3d/stereo.h"
#include "iris/quadtree.h"

#include "random_number.h"
#include "test.h"

enum { W = 97, H = 61, MOST = 19, LEVELS = 3, MARGIN = 5 };

/* A pair, with margins around each view that nobody may touch. */
typedef struct {
    uint8_t left[H + 2][W + 2 * MARGIN], right[H + 2][W + 2 * MARGIN];
    uint16_t maps[LEVELS][H + 2][W + 2 * MARGIN];
    iris_image l, r, map[LEVELS];
} pair;

static pair p;
static IRIS_SCRATCH_BUFFER(working, IRIS_STEREO_QUADTREE_SCRATCH_BYTES(W, H, IRIS_STEREO_DISPARITY_MAX,
                                                                       IRIS_STEREO_LEVELS_MAX) +
                                        IRIS_STEREO_MIRROR_BYTES(W, H));

/* 0 to n - 1. */
static uint32_t random_below(uint32_t n)
{
    return (uint32_t)(random_u64() >> 32) % n;
}

/* Views of w x h pixels in the middle of their memory, the right one and the maps bottom-up. */
static void make_views(int32_t w, int32_t h)
{
    const ptrdiff_t stride = sizeof p.left[0];
    memset(p.maps, 0xA5, sizeof p.maps);
    p.l = (iris_image){&p.left[1][MARGIN], stride, w, h, IRIS_GRAY8};
    p.r = (iris_image){&p.right[h][MARGIN - 1], -stride, w, h, IRIS_GRAY8};
    for (int32_t k = 0; k < LEVELS; k++) {
        int32_t own_w = (int32_t)IRIS_PYRAMID_SIDE(w, k), own_h = (int32_t)IRIS_PYRAMID_SIDE(h, k);
        p.map[k] = (iris_image){&p.maps[k][own_h][MARGIN], -2 * stride, own_w, own_h, IRIS_GRAY_U16};
    }
}

static void assert_margins(void)
{
    for (int32_t i = 0; i < LEVELS * (H + 2) * (W + 2 * MARGIN); i++) {
        int32_t k = i / ((H + 2) * (W + 2 * MARGIN)), y = i / (W + 2 * MARGIN) % (H + 2),
                x = i % (W + 2 * MARGIN);
        int inside = y >= 1 && y <= p.map[k].h && x >= MARGIN && x < MARGIN + p.map[k].w;
        assert_true(inside || p.maps[k][y][x] == 0xA5A5);
    }
}

static uint8_t *pixel(const iris_image *image, int32_t x, int32_t y)
{
    return (uint8_t *)iris_image_row(image, y) + x;
}

static int32_t found_at(int32_t k, int32_t x, int32_t y)
{
    return ((const uint16_t *)iris_image_row(&p.map[k], y))[x];
}

static iris_stereo_quadtree_config defaults_with(int32_t most)
{
    iris_stereo_quadtree_config config;
    iris_stereo_quadtree_defaults(&config);
    config.max_disparity = most;
    config.planes = 1;
    return config;
}

/* With exactly the memory that the header says; with a byte less, nothing is done. */
static void run(int32_t count, const iris_stereo_quadtree_config *config)
{
    size_t bytes = IRIS_STEREO_QUADTREE_SCRATCH_BYTES(p.l.w, p.l.h, config->max_disparity, config->levels) +
                   (config->divided == IRIS_STEREO_RIGHT ? IRIS_STEREO_MIRROR_BYTES(p.l.w, p.l.h) : 0);
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, bytes - 1), IRIS_OK);
    memset(p.maps, 0xA5, sizeof p.maps);
    assert_int_equal(iris_stereo_quadtree_maps(p.map, count, &p.l, &p.r, config, &scratch), IRIS_ERR_SCRATCH);
    for (int32_t k = 0; k < count; k++) {
        assert_int_equal(found_at(k, 0, p.map[k].h - 1), 0xA5A5);
    }
    assert_int_equal(scratch.used, 0);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, bytes), IRIS_OK);
    assert_int_equal(iris_stereo_quadtree_maps(p.map, count, &p.l, &p.r, config, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, bytes);
    assert_margins();
}

/* --- one disparity for each block, as the header says it --- */

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
    int32_t to = clamp(x - d, p.l.w - 1), sum = 0;
    for (int32_t k = 0; k < 25 && cost != IRIS_STEREO_SAD; k++) {
        int32_t dx = k % 5 - 2, dy = k / 5 - 2;
        int darker = gray(&p.l, x + dx, y + dy) < gray(&p.l, x, y);
        sum += darker != (gray(&p.r, to + dx, y + dy) < gray(&p.r, to, y));
    }
    int32_t apart = abs(gray(&p.l, x, y) - gray(&p.r, to, y));
    return sum + (cost == IRIS_STEREO_CENSUS ? 0 : apart < 32 ? apart : 32);
}

static int32_t tile_weight(int32_t tile_x, int32_t tile_y, iris_rect b, int32_t mean)
{
    int32_t sum = 0, count = 0;
    for (int32_t k = 0; k < 16; k++) {
        int32_t x = 4 * tile_x + k % 4, y = 4 * tile_y + k / 4, inside = x < p.l.w && y < p.l.h;
        sum += inside ? gray(&p.l, x, y) : 0;
        count += inside;
    }
    int own_x = 4 * tile_x + 3 >= b.x && 4 * tile_x < b.x + b.w;
    int own_y = 4 * tile_y + 3 >= b.y && 4 * tile_y < b.y + b.h;
    return own_x && own_y ? 3 : abs(sum / count - mean) <= 10 ? 2 : 0;
}

/* Of all disparities that whose window differs least. */
static int32_t best_of(iris_rect block, int32_t mean, const iris_stereo_quadtree_config *config)
{
    int32_t best = 0, costs[MOST + 1] = {0}, x = block.x, y = block.y, w = block.w, h = block.h;
    int32_t left = (x / 4 - 1) * 4, right = ((x + w - 1) / 4 + 2) * 4;
    int32_t top = (y / 4 - 1) * 4, bottom = ((y + h - 1) / 4 + 2) * 4;
    for (int32_t d = 0; d <= config->max_disparity && d <= x + w / 2; d++) {
        for (int32_t at_y = clamp(top, H); at_y < bottom && at_y < p.l.h; at_y += 2) {
            for (int32_t at_x = clamp(left, W); at_x < right && at_x < p.l.w; at_x++) {
                int32_t weight = tile_weight(at_x / 4, at_y / 4, block, mean);
                costs[d] += weight ? weight * pixel_cost(at_x, at_y, d, config->cost) : 0;
            }
        }
        best = costs[d] < costs[best] ? d : best;
    }
    return best;
}

static int32_t expected[H][W];

static void expect_leaf(const iris_quadtree_leaf *leaf, const iris_stereo_quadtree_config *config)
{
    int32_t across = (leaf->w + 15) / 16, down = (leaf->h + 15) / 16;
    for (int32_t i = 0; i < across * down; i++) {
        int32_t x = leaf->w * (i % across) / across, y = leaf->h * (i / across) / down;
        iris_rect block = {leaf->x + x, leaf->y + y, leaf->w * (i % across + 1) / across - x,
                           leaf->h * (i / across + 1) / down - y};
        int32_t best = best_of(block, leaf->mean.g, config);
        for (int32_t k = 0; k < block.w * block.h; k++) {
            expected[block.y + k / block.w][block.x + k % block.w] = best;
        }
    }
}

/* Is it what some place in these four rows is expected to have? */
static int is_from_row(int32_t found, int32_t y)
{
    for (int32_t k = 0; k < 4 * p.l.w; k++) {
        int32_t at = y / 4 * 4 + k / p.l.w;
        if (at < p.l.h && expected[at][k % p.l.w] == found) {
            return 1;
        }
    }
    return 0;
}

/* Noise of which the right picture shows the same, 3 pixels nearer, but for every fifth pixel. */
static void fill_shifted(uint8_t most)
{
    for (int32_t i = 0; i < p.l.w * p.l.h; i++) {
        *pixel(&p.l, i % p.l.w, i / p.l.w) = (uint8_t)random_below(most + 1u);
    }
    for (int32_t i = 0; i < p.l.w * p.l.h; i++) {
        int32_t x = i % p.l.w, y = i / p.l.w;
        *pixel(&p.r, x, y) =
            (uint8_t)(random_below(5) ? gray(&p.l, x + 3, y) : (int32_t)random_below(most + 1u));
    }
}

static void blocks_have_the_disparity_that_differs_least(void **state)
{
    (void)state;
    static iris_quadtree_leaf leaves[25 * 16];
    static const iris_size sizes[] = {{W, 37}, {1, 1}, {3, 40}, {50, 2}, {33, 17}, {61, 8}};
    for (int32_t i = 0; i < 6; i++) {
        iris_quadtree tree = {.leaves = leaves, .capacity = 25 * 16};
        iris_stereo_quadtree_config config = {
            i == 3 ? 1 : 8, (iris_stereo_cost)(i % 3), 20, IRIS_STEREO_LEFT, 0, 1};
        make_views(sizes[i].w, sizes[i].h);
        fill_shifted(i % 2 ? 255 : 20);
        *pixel(&p.l, sizes[i].w / 3, sizes[i].h / 3) = 255; /* small leaves around it */
        run(1, &config);
        assert_int_equal(iris_quadtree_segment(&tree, &p.l, &(iris_quadtree_config){20, 4}), IRIS_OK);
        for (int32_t k = 0; k < tree.count; k++) {
            expect_leaf(&leaves[k], &config);
        }
        int32_t own = 0, all = p.l.w * p.l.h;
        for (int32_t k = 0; k < all; k++) {
            int32_t x = k % p.l.w, y = k / p.l.w, found = (found_at(0, x, y) + 128) / 256;
            own += found == expected[y][x];
            assert_true(is_from_row(found, y)); /* hidden ones have another's */
        }
        assert_in_range(own, i == 3 ? 0 : all * 3 / 4, all);
    }
}

/* --- rendered in double precision --- */

static double dots(int32_t x, int32_t y)
{
    uint32_t n = ((uint32_t)x * 0x9E3779B1u) ^ ((uint32_t)y * 0x85EBCA77u);
    n = (n ^ n >> 15) * 0x2C1B3C6Du;
    n = (n ^ n >> 12) * 0x297A2D39u;
    return (n ^ n >> 15) / 4294967296.0;
}

static double smooth_dots(double x, double y, int32_t layer)
{
    int32_t left = (int32_t)floor(x), top = (int32_t)floor(y);
    double u = x - left, v = y - top;
    top += 1000 * layer;
    double above = dots(left, top) * (1 - u) + dots(left + 1, top) * u;
    double below = dots(left, top + 1) * (1 - u) + dots(left + 1, top + 1) * u;
    return above * (1 - v) + below * v;
}

static uint8_t texture(double x, double y)
{
    return (uint8_t)(110 * smooth_dots(x / 5, y / 5, 1) + 90 * smooth_dots(x / 2, y / 2, 2) + 28);
}

typedef struct {
    double a, b, c; /* d = a x + b y + c */
} plane;

static double truth(const plane *s, double x, double y)
{
    return s->a * x + s->b * y + s->c;
}

static void draw_plane(const plane *s)
{
    for (int32_t i = 0; i < p.l.w * p.l.h; i++) {
        int32_t x = i % p.l.w, y = i / p.l.w;
        *pixel(&p.l, x, y) = texture(x, y);
        *pixel(&p.r, x, y) = texture((x + s->b * y + s->c) / (1 - s->a), y);
    }
}

typedef struct {
    double mean, most;
} errors;

/* In pixels of the whole picture; from column `from` of it on. */
static errors errors_of(int32_t k, const plane *s, int32_t from)
{
    errors e = {0, 0};
    int32_t count = 0;
    for (int32_t i = 0; i < p.map[k].w * p.map[k].h; i++) {
        int32_t x = i % p.map[k].w, y = i / p.map[k].w;
        if (x << k >= from) {
            double off = fabs(found_at(k, x, y) / 256.0 - truth(s, x << k, y << k));
            e.mean += off;
            e.most = off > e.most ? off : e.most;
            count++;
        }
    }
    e.mean /= count;
    return e;
}

static const plane planes[] = {{0, 0, 6.3},       {0.08, 0, 3}, {-0.1, 0.02, 14},
                               {0.03, -0.12, 11}, {0, 0.15, 4}, {0.1, 0.1, 1}};
#define PLANES ((int32_t)(sizeof planes / sizeof planes[0]))

static void slanted_planes_are_found(void **state)
{
    (void)state;
    for (int32_t i = 0; i < PLANES; i++) {
        iris_stereo_quadtree_config config = defaults_with(MOST);
        make_views(W, H);
        draw_plane(&planes[i]);
        config.planes = 0;
        run(1, &config);
        errors flat = errors_of(0, &planes[i], 0);
        config.planes = 1;
        run(1, &config);
        errors e = errors_of(0, &planes[i], 0);
        assert_true(e.mean <= 0.2 && e.most <= 2.5);
        assert_true(i == 0 || e.mean < 0.65 * flat.mean);
    }
}

static void resolutions_agree(void **state)
{
    (void)state;
    for (int32_t i = 0; i < PLANES; i++) {
        static uint16_t all[LEVELS][H + 2][W + 2 * MARGIN];
        iris_stereo_quadtree_config config = defaults_with(MOST);
        make_views(W, H);
        draw_plane(&planes[i]);
        run(LEVELS, &config);
        memcpy(all, p.maps, sizeof all);
        for (int32_t k = 0; k < LEVELS; k++) {
            assert_true(errors_of(k, &planes[i], 0).mean <= 0.25 * (1 << k));
        }
        for (int32_t k = 0; k < LEVELS; k++) {
            iris_image one[LEVELS] = {{0}};
            iris_scratch scratch;
            assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
            one[k] = p.map[k];
            memset(p.maps, 0xA5, sizeof p.maps);
            assert_int_equal(iris_stereo_quadtree_maps(one, k + 1, &p.l, &p.r, &config, &scratch), IRIS_OK);
            assert_memory_equal(p.maps[k], all[k], sizeof all[k]);
        }
    }
}

/* The right picture's disparities are those of the pair in a mirror. */
static void either_picture_can_be_divided(void **state)
{
    (void)state;
    static uint16_t right[H][W];
    iris_stereo_quadtree_config config = defaults_with(MOST);
    make_views(W, H);
    draw_plane(&planes[2]);
    for (int32_t x = 40; x < 60; x++) {
        *pixel(&p.l, x, 30) = *pixel(&p.r, x - 15, 30) = (uint8_t)random_below(256);
    }
    config.divided = IRIS_STEREO_RIGHT;
    run(2, &config);
    for (int32_t k = 0; k < W * H; k++) {
        right[k / W][k % W] = (uint16_t)found_at(0, k % W, k / W);
        const plane *s = &planes[2];
        double x = (k % W + s->b * (k / W) + s->c) / (1 - s->a); /* in the left picture */
        assert_true(k / W > 20 || x >= W || fabs(right[k / W][k % W] / 256.0 - truth(s, x, k / W)) <= 1.5);
    }
    for (int32_t y = 0; y < H; y++) {
        uint8_t was[2][W];
        memcpy(was[0], pixel(&p.l, 0, y), W);
        memcpy(was[1], pixel(&p.r, 0, y), W);
        for (int32_t x = 0; x < W; x++) {
            *pixel(&p.l, x, y) = was[1][W - 1 - x];
            *pixel(&p.r, x, y) = was[0][W - 1 - x];
        }
    }
    config.divided = IRIS_STEREO_LEFT;
    run(2, &config);
    for (int32_t k = 0; k < W * H; k++) {
        assert_int_equal(found_at(0, W - 1 - k % W, k / W), right[k / W][k % W]);
    }
}

/* A near square before a wall: what is left of it, which the right camera does not see, is wall, too, and so is what
 * the right camera does not see at the left edge. */
static void what_one_camera_sees_goes_on_as_what_is_behind(void **state)
{
    (void)state;
    const plane wall = {0, 0, 4}, square = {0, 0, 14};
    iris_stereo_quadtree_config config = defaults_with(MOST);
    make_views(W, H);
    draw_plane(&wall);
    for (int32_t k = 0; k < 32 * 32; k++) {
        int32_t x = 44 + k % 32, y = 16 + k / 32;
        *pixel(&p.l, x, y) = *pixel(&p.r, x - 14, y) = texture(x + 500, y);
    }
    run(1, &config);
    int32_t off = 0;
    for (int32_t k = 0; k < W * H; k++) {
        int32_t x = k % W, y = k / W, in = x >= 44 && x < 76 && y >= 16 && y < 48;
        double apart = found_at(0, x, y) / 256.0 - truth(in ? &square : &wall, x, y);
        off += fabs(apart) > 1;
        int at_edge = x > 30 && x < 84 && y > 8 && y < 56;
        assert_true(at_edge || fabs(apart) <= 1.5);
    }
    assert_in_range(off, 0, W * H / 20);
}

/* --- what is hard --- */

static void pictures_of_one_gray_level_are_at_infinity(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1}, {2, 1}, {1, 7}, {5, 5}, {17, 3}, {W, H}};
    for (int32_t i = 0; i < 6; i++) {
        for (int32_t levels = 1; levels <= LEVELS; levels++) {
            iris_stereo_quadtree_config config = defaults_with(i < 5 ? 255 : MOST);
            config.levels = levels;
            config.divided = (iris_stereo_side)(i % 2);
            make_views(sizes[i].w, sizes[i].h);
            memset(p.left, 77, sizeof p.left);
            memset(p.right, 99, sizeof p.right);
            run(levels, &config);
            for (int32_t k = 0; k < sizes[i].w * sizes[i].h; k++) {
                assert_int_equal(found_at(0, k % sizes[i].w, k / sizes[i].w), 1);
            }
        }
    }
}

static void extremes_stay_in_range(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{W, 9}, {31, H}, {4, 4}, {64, 16}};
    for (int32_t i = 0; i < 12; i++) {
        iris_stereo_quadtree_config config = {i % 4 == 0 ? 255 : 30,
                                              (iris_stereo_cost)(i % 3),
                                              255 * (i % 2),
                                              (iris_stereo_side)(i / 2 % 2),
                                              1,
                                              1 + i % IRIS_STEREO_LEVELS_MAX};
        make_views(sizes[i % 4].w, sizes[i % 4].h);
        for (int32_t k = 0; k < p.l.w * p.l.h; k++) {
            int32_t x = k % p.l.w, y = k / p.l.w, board = (x + y) % 2;
            *pixel(&p.l, x, y) = (uint8_t)(i < 6 ? 255 * board : (int32_t)random_below(256));
            *pixel(&p.r, x, y) = (uint8_t)(i < 6 ? 255 - 255 * board : (int32_t)random_below(256));
        }
        run(1, &config);
        for (int32_t k = 0; k < p.l.w * p.l.h; k++) {
            assert_in_range(found_at(0, k % p.l.w, k / p.l.w), 1, 256 * config.max_disparity);
        }
    }
}

static void calls_that_are_refused(void **state)
{
    (void)state;
    make_views(W, H);
    draw_plane(&planes[0]);
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    static const iris_stereo_quadtree_config wrong[] = {
        {0, 0, 20, 0, 1, 1},  {256, 0, 20, 0, 1, 1}, {9, 3, 20, 0, 1, 1}, {9, 0, -1, 0, 1, 1},
        {9, 0, 256, 0, 1, 1}, {9, 0, 20, 2, 1, 1},   {9, 0, 20, 0, 1, 0}, {9, 0, 20, 0, 1, 6}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(iris_stereo_quadtree(&p.map[0], &p.l, &p.r, &wrong[i], &scratch), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_stereo_quadtree(NULL, &p.l, &p.r, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_quadtree(&p.map[0], NULL, &p.r, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_quadtree(&p.map[0], &p.l, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_quadtree(&p.map[0], &p.l, &p.r, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_quadtree(&(iris_image){0}, &p.l, &p.r, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_quadtree(&p.map[1], &p.l, &p.r, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_stereo_quadtree(&p.l, &p.l, &p.r, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_stereo_quadtree(&p.map[0], &p.map[0], &p.r, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_stereo_quadtree_maps(NULL, 1, &p.l, &p.r, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_quadtree_maps(p.map, 0, &p.l, &p.r, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_stereo_quadtree_maps(p.map, 4, &p.l, &p.r, NULL, &scratch), IRIS_ERR_ARG);
    iris_image maps[2] = {p.map[0], p.map[1]}, small = p.r, over = p.l;
    maps[1].data = p.maps[0][40];
    assert_int_equal(iris_stereo_quadtree_maps(maps, 2, &p.l, &p.r, NULL, &scratch), IRIS_ERR_ALIAS);
    small.w--;
    over.data = p.maps[0][1];
    assert_int_equal(iris_stereo_quadtree(&p.map[0], &p.l, &small, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_stereo_quadtree(&p.map[0], &over, &p.r, NULL, &scratch), IRIS_ERR_ALIAS);
    assert_margins();
    assert_int_equal(found_at(0, 0, 0), 0xA5A5);
    assert_int_equal(iris_stereo_quadtree(&p.map[0], &p.l, &p.r, NULL, &scratch), IRIS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_have_the_disparity_that_differs_least),
        cmocka_unit_test(slanted_planes_are_found),
        cmocka_unit_test(resolutions_agree),
        cmocka_unit_test(either_picture_can_be_divided),
        cmocka_unit_test(what_one_camera_sees_goes_on_as_what_is_behind),
        cmocka_unit_test(pictures_of_one_gray_level_are_at_infinity),
        cmocka_unit_test(extremes_stay_in_range),
        cmocka_unit_test(calls_that_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
