/* Occupancy grids: hand-made rays, and every cell of random ones against where a segment goes in double precision. */
#include "iris/3d/grid.h"

#include <math.h>

#include "random_number.h"
#include "test.h"

enum { W = 61, H = 47, SIDE = 200 };

static int8_t odds[W * H];
static IRIS_SCRATCH_BUFFER(working, IRIS_GRID_FUSE_SCRATCH_BYTES(W, H));

static iris_grid grid_of(int32_t w, int32_t h, int32_t cell_mm, int32_t left, int32_t bottom)
{
    const int32_t corner[2] = {left, bottom};
    iris_grid grid;
    assert_int_equal(iris_grid_init(&grid, odds, (size_t)w * (size_t)h, (iris_size){w, h}, cell_mm, corner),
                     IRIS_OK);
    return grid;
}

static iris_status fuse(const iris_grid *grid, iris_map_pose robot, const iris_scan *scan,
                        const iris_fusion *fusion)
{
    const size_t bytes = IRIS_GRID_FUSE_SCRATCH_BYTES(grid->w, grid->h);
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, bytes), IRIS_OK);
    const iris_status status = iris_grid_fuse(grid, robot, scan, fusion, &scratch);
    assert_true(status != IRIS_OK || scratch.peak == bytes);
    assert_int_equal(scratch.used, 0);
    return status;
}

static void fuse_beam(const iris_grid *grid, iris_map_pose robot, iris_beam beam)
{
    const iris_scan scan = {&beam, 1, 0, 0};
    assert_int_equal(fuse(grid, robot, &scan, NULL), IRIS_OK);
}

/* Rows from the lowest one on. */
static void assert_odds(const iris_grid *grid, const int *wanted)
{
    for (int i = 0; i < grid->w * grid->h; i++) {
        assert_int_equal(grid->odds[i], wanted[i]);
    }
}

static void beams_by_hand(void **state)
{
    (void)state;
    iris_grid grid = grid_of(5, 3, 100, -200, -100); /* x from -200 to 300, y from -100 to 200 */
    fuse_beam(&grid, (iris_map_pose){-150, -50, 0}, (iris_beam){360, 0, 0, 1});
    assert_odds(&grid, (const int[]){-6, -6, -6, -6, 14, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    grid = grid_of(5, 3, 100, -200, -100);
    fuse_beam(&grid, (iris_map_pose){-150, -50, 0}, (iris_beam){360, 0, 0, 0}); /* nothing there */
    assert_odds(&grid, (const int[]){-6, -6, -6, -6, -6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    grid = grid_of(5, 3, 100, -200, -100);
    fuse_beam(&grid, (iris_map_pose){250, 150, -32768}, (iris_beam){1000, 0, 0, 1}); /* beyond the edge */
    assert_odds(&grid, (const int[]){0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -6, -6, -6, -6, -6});
    grid = grid_of(5, 3, 100, -200, -100);
    fuse_beam(&grid, (iris_map_pose){-200, -100, 8192}, (iris_beam){354, 0, 0, 1}); /* x before y at edges */
    assert_odds(&grid, (const int[]){-6, -6, 0, 0, 0, 0, -6, -6, 0, 0, 0, 0, 14, 0, 0});
    grid = grid_of(5, 3, 100, -200, -100);
    fuse_beam(&grid, (iris_map_pose){0, 0, 0}, (iris_beam){0, 0, 0, 1}); /* no way at all: a hit alone */
    assert_odds(&grid, (const int[]){0, 0, 0, 0, 0, 0, 0, 14, 0, 0, 0, 0, 0, 0, 0});
}

/* How much of the segment is in a cell, in millimeters; negative: how far apart, or so. */
static double inside(const double from[2], const double to[2], double x, double y, double side)
{
    double first = 0, last = 1, gap = 0;
    const double least[2] = {x, y};
    for (int i = 0; i < 2; i++) {
        const double d = to[i] - from[i], a = least[i] - from[i], b = a + side;
        if (d == 0) {
            gap = fmin(gap, fmin(-a, b)); /* negative when outside */
        } else {
            first = fmax(first, fmin(a / d, b / d));
            last = fmin(last, fmax(a / d, b / d));
        }
    }
    return gap < 0 ? gap : (last - first) * hypot(to[0] - from[0], to[1] - from[1]);
}

static void every_cell_beside_double_precision(void **state)
{
    (void)state;
    int passed = 0;
    for (int i = 0; i < SIDE; i++) {
        const int32_t cell = 20 + (int32_t)(random_u64() % 60);
        const int32_t left = (int32_t)(random_u64() % 4000) - 3000, bottom = i % 5 ? -700 : -200000000;
        const iris_grid grid = grid_of(W, H, cell, left, bottom);
        const iris_map_pose robot = {left + (int32_t)(random_u64() % (uint32_t)(W * cell)),
                                     bottom + (int32_t)(random_u64() % (uint32_t)(H * cell)),
                                     (iris_angle)(i % 4 ? (int)random_u64() : i / 4 * 16384)};
        const iris_beam beam = {(int32_t)(random_u64() % 6000) - 3000,
                                i % 3 ? (int32_t)(random_u64() % 6000) - 3000 : 0, 0, 1};
        fuse_beam(&grid, robot, beam);
        const double turn = robot.heading * 6.283185307179586 / 65536, from[2] = {robot.x_mm, robot.y_mm};
        const double to[2] = {floor(robot.x_mm + beam.x_mm * cos(turn) - beam.y_mm * sin(turn) + 0.5),
                              floor(robot.y_mm + beam.x_mm * sin(turn) + beam.y_mm * cos(turn) + 0.5)};
        for (int32_t y = 0; y < H; y++) {
            for (int32_t x = 0; x < W; x++) {
                const double at[2] = {left + x * cell, bottom + y * cell};
                const int is_end = to[0] > at[0] + 0.01 && to[0] < at[0] + cell - 0.01 &&
                                   to[1] > at[1] + 0.01 && to[1] < at[1] + cell - 0.01;
                const double part = inside(from, to, at[0], at[1], cell);
                const int8_t found = grid.odds[y * W + x];
                if (is_end) {
                    assert_int_equal(found, 14);
                } else if (part > 0.01 && found != 14) { /* on an edge the end may be in either */
                    assert_int_equal(found, -6);
                    passed++;
                } else if (part < -0.01) {
                    assert_int_equal(found, 0);
                }
            }
        }
    }
    assert_true(passed > 20 * SIDE);
}

static void a_scan_counts_once_and_saturates(void **state)
{
    (void)state;
    const iris_beam beams[4] = {{250, 0, 0, 1}, {260, 10, 0, 1}, {450, 0, 0, 1}, {450, 10, 0, 0}};
    const iris_scan scan = {beams, 4, 0, 0};
    const iris_map_pose robot = {50, 50, 0};
    const iris_grid grid = grid_of(6, 1, 100, 0, 0);
    assert_int_equal(fuse(&grid, robot, &scan, NULL), IRIS_OK);
    assert_odds(&grid, (const int[]){-6, -6, -6, 14, -6, 14}); /* hits stay hits where other beams pass */
    for (int i = 0; i < 20; i++) {
        assert_int_equal(fuse(&grid, robot, &scan, NULL), IRIS_OK);
    }
    assert_odds(&grid, (const int[]){-64, -64, -64, 64, -64, 64});
    const iris_fusion strong = {127, 127, 127};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(fuse(&grid, robot, &scan, &strong), IRIS_OK);
    }
    assert_odds(&grid, (const int[]){-127, -127, -127, 127, -127, 127});
}

static void unsure_beams_are_worth_less(void **state)
{
    (void)state;
    const iris_map_pose robot = {50, 50, 0};
    iris_grid grid = grid_of(6, 1, 100, 0, 0);
    fuse_beam(&grid, robot, (iris_beam){400, 0, 50, 1}); /* 14 100 / 150, and free to 350 */
    assert_odds(&grid, (const int[]){-6, -6, -6, -6, 9, 0});
    grid = grid_of(6, 1, 100, 0, 0);
    fuse_beam(&grid, robot, (iris_beam){460, 0, 200, 1}); /* 14 100 / 300, free to 110 */
    assert_odds(&grid, (const int[]){-6, -6, 0, 0, 0, 5});
    grid = grid_of(6, 1, 100, 0, 0);
    fuse_beam(&grid, robot, (iris_beam){500, 0, 201, 1}); /* nothing, free to 148 */
    assert_odds(&grid, (const int[]){-6, -6, 0, 0, 0, 0});
    grid = grid_of(6, 1, 100, 0, 0);
    fuse_beam(&grid, robot, (iris_beam){500, 0, 250000, 1});
    assert_odds(&grid, (const int[]){-6, 0, 0, 0, 0, 0});
}

/* A beam that may have met a wall did: that of 400 mm is at 450, and that wall is what 520 with a spread of 60 has met. */
static void walls_do_not_grow_backwards(void **state)
{
    (void)state;
    const iris_map_pose robot = {50, 50, 0};
    const iris_grid grid = grid_of(7, 1, 100, 0, 0);
    fuse_beam(&grid, robot, (iris_beam){400, 0, 0, 1});
    fuse_beam(&grid, robot, (iris_beam){520, 0, 60, 1}); /* from 400 on: 14 100 / 160 */
    assert_odds(&grid, (const int[]){-12, -12, -12, -12, 14 + 9, 0, 0});
    fuse_beam(&grid, robot, (iris_beam){600, 0, 20, 1}); /* surely behind it */
    assert_odds(&grid, (const int[]){-18, -18, -18, -18, 23 - 6, -6, 12});
}

/* Errors of single ranges average out: two of five miss the wall's cell. What ends behind it before it is
 * known stays: nobody sees it. */
static void errors_average_out(void **state)
{
    (void)state;
    const iris_grid grid = grid_of(W, 1, 50, 0, 0);
    for (int i = 0; i < 400; i++) {
        double error = 0;
        for (int k = 0; k < 12; k++) {
            error += (double)(random_u64() % 1000) / 1000 - 0.5;
        }
        fuse_beam(&grid, (iris_map_pose){25, 25, 0},
                  (iris_beam){2000 + (int32_t)floor(error * 30), 0, 30, 1});
    }
    for (int x = 0; x < W; x++) {
        const int occupied = grid.odds[x] >= IRIS_ODDS_OCCUPIED;
        assert_true(x == 40 ? occupied : !occupied || x == 41);
        assert_true(x > 36 || grid.odds[x] <= IRIS_ODDS_FREE);
    }
}

static void the_sensor_has_a_place(void **state)
{
    (void)state;
    const iris_beam beam = {300, 200, 0, 1};
    const iris_scan scan = {&beam, 1, 100, 200};
    const iris_grid grid = grid_of(6, 6, 100, 0, 0);
    assert_int_equal(fuse(&grid, (iris_map_pose){350, 50, 16384}, &scan, NULL), IRIS_OK);
    int wanted[36] = {0}; /* from (150, 150) up to (150, 350) */
    wanted[6 + 1] = wanted[12 + 1] = -6;
    wanted[18 + 1] = 14;
    assert_odds(&grid, wanted);
}

static void at_looks_a_place_up(void **state)
{
    (void)state;
    const iris_grid grid = grid_of(3, 2, 100, -150, -250);
    for (int i = 0; i < 6; i++) {
        grid.odds[i] = (int8_t)(i + 1);
    }
    assert_int_equal(iris_grid_at(&grid, -150, -250), 1);
    assert_int_equal(iris_grid_at(&grid, -51, -151), 1);
    assert_int_equal(iris_grid_at(&grid, 149, -51), 6);
    assert_int_equal(iris_grid_at(&grid, 150, -51), 0);
    assert_int_equal(iris_grid_at(&grid, -151, -151), 0);
    assert_int_equal(iris_grid_at(&grid, INT32_MIN, INT32_MAX), 0);
}

static void bad_arguments_change_nothing(void **state)
{
    (void)state;
    const int32_t corner[2] = {0, 0}, far[2] = {0, IRIS_MAP_PLACE_MAX_MM};
    iris_grid grid = grid_of(4, 4, 100, 0, 0), other = grid;
    iris_beam beam = {150, 0, 0, 1};
    iris_scan scan = {&beam, 1, 0, 0};
    iris_scratch scratch;
    const iris_map_pose in = {50, 50, 0};
    const struct {
        iris_size cells;
        int32_t cell_mm;
        size_t bytes;
    } bad[] = {{{0, 4}, 100, 99},
               {{4, 4097}, 100, 99999},
               {{4, -1}, 100, 99},
               {{4, 4}, 0, 99},
               {{4, 4}, 10001, 99},
               {{4, 4}, 100, 15},
               {{INT32_MAX, INT32_MAX}, 1, SIZE_MAX}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(iris_grid_init(&other, odds, bad[i].bytes, bad[i].cells, bad[i].cell_mm, corner),
                         IRIS_ERR_RANGE);
    }
    assert_int_equal(iris_grid_init(&other, odds, 16, (iris_size){4, 4}, 100, far), IRIS_ERR_RANGE);
    assert_int_equal(iris_grid_init(&other, NULL, 16, (iris_size){4, 4}, 100, corner), IRIS_ERR_ARG);
    assert_memory_equal(&other, &grid, sizeof grid);

    assert_int_equal(iris_scratch_init(&scratch, working.memory, IRIS_GRID_FUSE_SCRATCH_BYTES(4, 4) - 1),
                     IRIS_OK);
    assert_int_equal(iris_grid_fuse(&grid, in, &scan, NULL, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_grid_fuse(&grid, in, &scan, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_grid_fuse(NULL, in, &scan, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_grid_fuse(&grid, in, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(fuse(&grid, (iris_map_pose){-1, 50, 0}, &scan, NULL), IRIS_ERR_RANGE);
    assert_int_equal(fuse(&grid, (iris_map_pose){50, 400, 0}, &scan, NULL), IRIS_ERR_RANGE);
    assert_int_equal(fuse(&grid, (iris_map_pose){INT32_MIN, INT32_MAX, 0}, &scan, NULL), IRIS_ERR_RANGE);
    const iris_fusion none[] = {{0, 6, 64}, {14, 0, 64}, {14, 6, 0}, {128, 6, 64}, {14, -6, 64}};
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(fuse(&grid, in, &scan, &none[i]), IRIS_ERR_ARG);
    }
    const iris_beam bad_beams[] = {{IRIS_SCAN_REACH_MAX_MM, 0, 0, 1}, {0, INT32_MIN, 0, 1}, {0, 0, -1, 1}};
    for (size_t i = 0; i < 3; i++) {
        beam = bad_beams[i];
        assert_int_equal(fuse(&grid, in, &scan, NULL), IRIS_ERR_ARG);
    }
    beam = (iris_beam){150, 0, 0, 1};
    scan.count = -1;
    assert_int_equal(fuse(&grid, in, &scan, NULL), IRIS_ERR_ARG);
    grid.w = 0;
    scan.count = 1;
    assert_int_equal(fuse(&grid, in, &scan, NULL), IRIS_ERR_ARG);
    for (int i = 0; i < 16; i++) {
        assert_int_equal(odds[i], 0);
    }
}

static void the_longest_beams_end(void **state)
{
    (void)state;
    const int32_t far = IRIS_MAP_PLACE_MAX_MM - 1, reach = IRIS_SCAN_REACH_MAX_MM - 1;
    const iris_beam beams[] = {{reach, reach, 0, 1}, {-reach, reach, 0, 0}, {reach, -reach, reach, 1}};
    const iris_scan scan = {beams, 3, -reach, -reach};
    const iris_grid grid = grid_of(W, H, IRIS_GRID_CELL_MAX_MM, far, far);
    for (int i = 0; i < 64; i++) {
        const iris_status status =
            fuse(&grid, (iris_map_pose){far, far, (iris_angle)(i * 1024)}, &scan, NULL);
        assert_true(status == IRIS_OK || status == IRIS_ERR_RANGE);
    }
    assert_true(iris_grid_at(&grid, far, far) != 0);
}

static void as_a_picture(void **state)
{
    (void)state;
    static const int8_t cells[6] = {10, 9, 0, -22, -23, -64};
    static const uint8_t wanted[2][3] = {{205, 254, 254}, {0, 205, 205}}; /* y goes up */
    uint8_t pixels[2][5];
    iris_image image;
    const iris_grid grid = grid_of(3, 2, 50, 0, 0);
    memcpy(odds, cells, sizeof cells);
    memset(pixels, 77, sizeof pixels);
    assert_int_equal(iris_image_wrap(&image, pixels, sizeof pixels, (iris_size){3, 2}, 5, IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_grid_to_picture(&image, &grid), IRIS_OK);
    for (int y = 0; y < 2; y++) {
        assert_memory_equal(pixels[y], wanted[y], 3);
        assert_int_equal(pixels[y][3], 77);
    }
    assert_int_equal(iris_grid_from_picture(&grid, &image, NULL), IRIS_OK);
    assert_odds(&grid, (const int[]){64, 0, 0, 0, -64, -64});
    image.w = 2;
    assert_int_equal(iris_grid_to_picture(&image, &grid), IRIS_ERR_RANGE);
    assert_int_equal(iris_grid_from_picture(&grid, &image, NULL), IRIS_ERR_RANGE);
    image.format = IRIS_MASK1;
    assert_true(iris_grid_to_picture(&image, &grid) != IRIS_OK);
    assert_int_equal(iris_grid_from_picture(&grid, NULL, NULL), IRIS_ERR_ARG);
}

/* p = (255 - gray) / 255 beside the thresholds, for every gray. */
static void shades_of_a_picture(void **state)
{
    (void)state;
    uint8_t pixels[256];
    static int8_t cells[256];
    const int32_t corner[2] = {0, 0};
    iris_grid grid;
    iris_image image;
    assert_int_equal(iris_grid_init(&grid, cells, 256, (iris_size){256, 1}, 50, corner), IRIS_OK);
    assert_int_equal(iris_image_wrap(&image, pixels, 256, (iris_size){256, 1}, 0, IRIS_GRAY8), IRIS_OK);
    for (int i = 0; i < 256; i++) {
        pixels[i] = (uint8_t)i;
    }
    const iris_grid_shades shades[] = {
        {42598, 12845, 0}, {42598, 12845, 1}, {65536, 0, 0}, {32768, 32768, 1}};
    for (size_t k = 0; k < 4; k++) {
        assert_int_equal(iris_grid_from_picture(&grid, &image, &shades[k]), IRIS_OK);
        for (int i = 0; i < 256; i++) {
            const double p = (shades[k].negate ? i : 255 - i) / 255.0;
            assert_int_equal(cells[i], p > shades[k].occupied_q16 / 65536.0 ? 64
                                       : p < shades[k].free_q16 / 65536.0   ? -64
                                                                            : 0);
        }
    }
    const iris_grid_shades bad[] = {{65537, 0, 0}, {65536, -1, 0}, {100, 101, 0}};
    for (size_t k = 0; k < 3; k++) {
        assert_int_equal(iris_grid_from_picture(&grid, &image, &bad[k]), IRIS_ERR_ARG);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beams_by_hand),
        cmocka_unit_test(every_cell_beside_double_precision),
        cmocka_unit_test(a_scan_counts_once_and_saturates),
        cmocka_unit_test(unsure_beams_are_worth_less),
        cmocka_unit_test(walls_do_not_grow_backwards),
        cmocka_unit_test(errors_average_out),
        cmocka_unit_test(the_sensor_has_a_place),
        cmocka_unit_test(at_looks_a_place_up),
        cmocka_unit_test(bad_arguments_change_nothing),
        cmocka_unit_test(the_longest_beams_end),
        cmocka_unit_test(as_a_picture),
        cmocka_unit_test(shades_of_a_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
