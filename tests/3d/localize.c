/* Localization: the field beside distances in double precision, and matches beside trying all places. */
#include "iris/3d/localize.h"

#include <math.h>

#include "random_number.h"
#include "test.h"

enum { SIDE = 90, BEAMS = 120, CELL = 50, WINDOW = 10, STEPS = 20 };

#define UNITS (65536 / 6.283185307179586)

static int8_t odds[SIDE * SIDE];
static uint8_t memory[IRIS_FIELD_BYTES(SIDE, SIDE)];
static IRIS_SCRATCH_BUFFER(working, IRIS_FIELD_SCRATCH_BYTES(SIDE, SIDE));
static IRIS_SCRATCH_BUFFER(matching, IRIS_LOCALIZE_SCRATCH_BYTES(BEAMS, WINDOW, STEPS));
static iris_beam beams[BEAMS];

static iris_grid grid_at(int32_t left, int32_t bottom)
{
    const int32_t corner[2] = {left, bottom};
    iris_grid grid;
    assert_int_equal(iris_grid_init(&grid, odds, sizeof odds, (iris_size){SIDE, SIDE}, CELL, corner),
                     IRIS_OK);
    return grid;
}

static iris_field field_of(const iris_grid *grid)
{
    iris_field field;
    iris_scratch scratch;
    const size_t bytes = IRIS_FIELD_SCRATCH_BYTES(grid->w, grid->h);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, bytes), IRIS_OK);
    assert_int_equal(iris_field_init(&field, memory, IRIS_FIELD_BYTES(grid->w, grid->h), grid, &scratch),
                     IRIS_OK);
    assert_true(scratch.peak == bytes && scratch.used == 0);
    return field;
}

/* Occupied cells from (x0, y0) to (x1, y1). */
static void wall(int x0, int y0, int x1, int y1)
{
    for (int y = y0; y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            odds[y * SIDE + x] = 64;
        }
    }
}

static int is_wall(const iris_grid *grid, double x, double y)
{
    const int at_x = (int)floor((x - grid->left_mm) / CELL), at_y = (int)floor((y - grid->bottom_mm) / CELL);
    return at_x < 0 || at_y < 0 || at_x >= SIDE || at_y >= SIDE || odds[at_y * SIDE + at_x] > 0;
}

static double gauss(double sigma)
{
    double sum = 0;
    for (int k = 0; k < 12; k++) {
        sum += (double)(random_u64() % 100000) / 100000 - 0.5;
    }
    return sigma * sum;
}

/* What a sensor that looks all around sees from there: walls' middles, as far as `reach`. */
static iris_scan look(const iris_grid *grid, double x, double y, double turn, double reach, double noise)
{
    for (int i = 0; i < BEAMS; i++) {
        const double bearing = i * 6.283185307179586 / BEAMS;
        double r = 0;
        while (r < reach && !is_wall(grid, x + r * cos(turn + bearing), y + r * sin(turn + bearing))) {
            r += 2;
        }
        const int hit = r < reach;
        r += hit ? 20 + gauss(noise) : 0;
        beams[i] = (iris_beam){(int32_t)lround(r * cos(bearing)), (int32_t)lround(r * sin(bearing)), 0, hit};
    }
    return (iris_scan){beams, BEAMS, 0, 0};
}

static iris_location locate(const iris_field *field, iris_map_pose predicted, const iris_scan *scan,
                            const iris_localize_config *config)
{
    iris_scratch scratch;
    iris_location location;
    assert_int_equal(iris_scratch_init(&scratch, matching.memory, sizeof matching.memory), IRIS_OK);
    assert_int_equal(iris_localize(&location, field, predicted, scan, config, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    return location;
}

static void field_beside_distances(void **state)
{
    (void)state;
    const iris_grid grid = grid_at(0, 0);
    for (int i = 0; i < 60; i++) {
        odds[random_u64() % sizeof odds] = 10;
        odds[random_u64() % sizeof odds] = 9;
        odds[random_u64() % sizeof odds] = -64;
    }
    const iris_field field = field_of(&grid);
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            double nearest = 1e9;
            for (int k = 0; k < SIDE * SIDE; k++) {
                nearest = odds[k] >= 10 ? fmin(nearest, hypot(k % SIDE - x, k / SIDE - y)) : nearest;
            }
            const int near = field.near[y * SIDE + x]; /* distances are within 6 % */
            assert_true(near <= 255 * exp(-pow(nearest * 0.94 / 1.5, 2) / 2) + 1);
            assert_true(nearest > 4.9 || near >= 255 * exp(-pow(nearest * 1.061 / 1.5, 2) / 2) - 1);
            assert_true(nearest < 6 || near == 0);
        }
    }
    for (int y = -7; y < SIDE; y++) {
        for (int x = -7; x < SIDE; x++) {
            int best = 0;
            for (int k = 0; k < 64; k++) {
                const int at_x = x + k % 8, at_y = y + k / 8;
                if (at_x >= 0 && at_y >= 0 && at_x < SIDE && at_y < SIDE) {
                    best = field.near[at_y * SIDE + at_x] > best ? field.near[at_y * SIDE + at_x] : best;
                }
            }
            assert_int_equal(field.blocks[(y + 7) * (SIDE + 7) + x + 7], best);
        }
    }
}

/* Rooms of all kinds: an outer wall, and boxes in it. */
static void build_room(void)
{
    wall(4, 4, 85, 4);
    wall(4, 85, 85, 85);
    wall(4, 4, 4, 85);
    wall(85, 4, 85, 85);
    for (int i = 0; i < 6; i++) {
        const int x = 8 + (int)(random_u64() % 66), y = 8 + (int)(random_u64() % 66);
        wall(x, y, x + (int)(random_u64() % 8), y + (int)(random_u64() % 8));
    }
}

static void free_place(double at[2], const iris_grid *grid)
{
    do {
        at[0] = grid->left_mm + 300 + (double)(random_u64() % 3800);
        at[1] = grid->bottom_mm + 300 + (double)(random_u64() % 3800);
    } while (is_wall(grid, at[0], at[1]));
}

/* The best score of all places of the window, and how many have it. */
static int best_by_trying_all(const iris_field *field, iris_map_pose predicted, const iris_scan *scan,
                              const iris_localize_config *c)
{
    static int32_t spots[BEAMS][2];
    int best = -1;
    for (int a = -c->angle_steps; a <= c->angle_steps; a++) {
        const iris_map_pose turned = {predicted.x_mm, predicted.y_mm,
                                      iris_angle_wrap(predicted.heading + a * c->angle_step)};
        for (int i = 0; i < scan->count; i++) {
            const iris_map_pose end =
                iris_map_pose_after(turned, (iris_map_pose){beams[i].x_mm, beams[i].y_mm, 0});
            spots[i][0] = (int32_t)floor((end.x_mm - field->left_mm) / (double)CELL);
            spots[i][1] = (int32_t)floor((end.y_mm - field->bottom_mm) / (double)CELL);
        }
        for (int k = 0; k < (2 * c->window_cells + 1) * (2 * c->window_cells + 1); k++) {
            const int dx = k % (2 * c->window_cells + 1) - c->window_cells;
            const int dy = k / (2 * c->window_cells + 1) - c->window_cells;
            int score = 0;
            for (int i = 0; i < scan->count; i++) {
                const int x = spots[i][0] + dx, y = spots[i][1] + dy;
                score += beams[i].hit && x >= 0 && y >= 0 && x < field->w && y < field->h
                             ? field->near[y * field->w + x]
                             : 0;
            }
            best = score > best ? score : best;
        }
    }
    return best;
}

static void as_by_trying_all(void **state)
{
    (void)state;
    iris_localize_config config;
    iris_localize_defaults(&config);
    config.least_percent = 1;
    config.least_beams = 1;
    for (int i = 0; i < 12; i++) {
        const iris_grid grid = grid_at(-1700 * i, 900 * i);
        double at[2];
        build_room();
        free_place(at, &grid);
        const iris_field field = field_of(&grid);
        const iris_scan scan = look(&grid, at[0], at[1], i, 2500, 60);
        config.window_cells = 2 + i % 9;
        config.angle_steps = i % 5 * 4;
        const iris_map_pose predicted = {(int32_t)at[0] + (int32_t)(random_u64() % 400) - 200,
                                         (int32_t)at[1] + (int32_t)(random_u64() % 400) - 200,
                                         iris_angle_wrap((int32_t)(i * UNITS) + 400)};
        const iris_location found = locate(&field, predicted, &scan, &config);
        const int best = best_by_trying_all(&field, predicted, &scan, &config);
        assert_int_equal(found.score_permille, (int64_t)best * 1000 / (255 * (int64_t)found.beams));
    }
}

static void a_robot_is_found(void **state)
{
    (void)state;
    double sum = 0;
    for (int i = 0; i < 40; i++) {
        const iris_grid grid = grid_at(i % 2 ? -2200 : 100000000, i % 3 ? -4400 : 50);
        double at[2];
        build_room();
        free_place(at, &grid);
        const iris_field field = field_of(&grid);
        const iris_angle heading = i % 4 == 0 ? (iris_angle)(-32768 + i * 8) : (iris_angle)random_u64();
        const iris_scan scan = look(&grid, at[0], at[1], heading / UNITS, 6000, 15);
        const iris_map_pose predicted = {(int32_t)at[0] + (int32_t)(random_u64() % 700) - 350,
                                         (int32_t)at[1] + (int32_t)(random_u64() % 700) - 350,
                                         iris_angle_wrap(heading + (int32_t)(random_u64() % 3000) - 1500)};
        const iris_location found = locate(&field, predicted, &scan, NULL);
        assert_int_equal(found.verdict, IRIS_LOCALIZE_FOUND);
        const double error = hypot(found.pose.x_mm - at[0], found.pose.y_mm - at[1]);
        assert_true(error < CELL);
        assert_true(abs(iris_angle_wrap(found.pose.heading - heading)) < 182); /* a degree */
        assert_true(found.spread_mm < 3 * CELL && found.score_permille > 600 && found.beams == BEAMS);
        sum += error / 40;
    }
    assert_true(sum < 0.3 * CELL);
}

static void a_corridor_is_ambiguous(void **state)
{
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        const iris_grid grid = grid_at(0, 0);
        wall(turned ? 35 : 0, turned ? 0 : 35, turned ? 35 : 89, turned ? 89 : 35);
        wall(turned ? 55 : 0, turned ? 0 : 55, turned ? 55 : 89, turned ? 89 : 55);
        const iris_field field = field_of(&grid);
        const iris_scan scan = look(&grid, 2275, 2275, 0.3, 1500, 5);
        const iris_location found = locate(&field, (iris_map_pose){2300, 2250, 3129}, &scan, NULL);
        assert_int_equal(found.verdict, IRIS_LOCALIZE_AMBIGUOUS);
        assert_true(found.spread_mm > 5 * CELL);
        assert_true(turned ? abs(found.spread_along) > 16000 : abs(found.spread_along) < 400);
        /* across it, all is known */
        assert_true(abs((turned ? found.pose.x_mm : found.pose.y_mm) - 2275) < CELL / 2);
        assert_true(abs(found.pose.heading - 3129) < 364);
    }
}

/* What the scan leaves open the prediction decides, when it is sure; what the scan tells it does not change much. */
static void a_sure_prediction_decides(void **state)
{
    (void)state;
    const iris_grid grid = grid_at(0, 0);
    wall(0, 35, 89, 35);
    wall(0, 55, 89, 55);
    const iris_field field = field_of(&grid);
    const iris_scan scan = look(&grid, 2275, 2275, 0, 1500, 5);
    iris_localize_config config;
    iris_localize_defaults(&config);
    const iris_map_pose predicted = {2400, 2235, 200};
    config.window_cells = 9; /* not even around the corridor's cells */
    iris_location found = locate(&field, predicted, &scan, &config);
    assert_true(found.verdict == IRIS_LOCALIZE_AMBIGUOUS && !iris_location_is_of_use(&found, &config));
    config.predicted_mm = 40;
    config.predicted_angle = 364;
    found = locate(&field, predicted, &scan, &config);
    assert_true(found.verdict == IRIS_LOCALIZE_AMBIGUOUS && iris_location_is_of_use(&found, &config));
    assert_true(abs(found.pose.x_mm - 2400) < CELL / 4);
    assert_true(abs(found.pose.y_mm - 2275) < CELL / 2);
    config.predicted_mm = INT32_MAX;
    config.predicted_angle = 1;
    found = locate(&field, predicted, &scan, &config);
    assert_true(abs(found.pose.heading - 200) <= 91);
    config.predicted_mm = 1;
    config.predicted_angle = INT16_MAX;
    found = locate(&field, predicted, &scan, &config);
    assert_true(abs(found.pose.x_mm - 2400) <= CELL && abs(found.pose.y_mm - 2235) <= CELL);
}

static void a_round_room_has_no_heading(void **state)
{
    (void)state;
    const iris_grid grid = grid_at(0, 0);
    for (int i = 0; i < 4000; i++) {
        const double turn = i * 6.283185307179586 / 4000;
        odds[(int)floor(45.5 + 30 * sin(turn)) * SIDE + (int)floor(45.5 + 30 * cos(turn))] = 64;
    }
    const iris_field field = field_of(&grid);
    const iris_scan scan = look(&grid, 2275, 2275, 0, 3000, 0);
    const iris_location found = locate(&field, (iris_map_pose){2275, 2275, 0}, &scan, NULL);
    assert_int_equal(found.verdict, IRIS_LOCALIZE_AMBIGUOUS);
    assert_true(found.spread_angle > 910 && found.spread_mm < 2 * CELL);
}

static void walls_that_repeat_are_ambiguous(void **state)
{
    (void)state;
    const iris_grid grid = grid_at(0, 0);
    wall(0, 30, 89, 30);
    wall(0, 55, 89, 55);
    for (int x = 5; x < 90; x += 8) {
        wall(x, 31, x, 38);
    }
    const iris_field field = field_of(&grid);
    const iris_scan scan = look(&grid, 2275, 2375, 0, 1000, 0);
    const iris_location found = locate(&field, (iris_map_pose){2275, 2375, 0}, &scan, NULL);
    assert_int_equal(found.verdict, IRIS_LOCALIZE_AMBIGUOUS);
}

static void nothing_to_match(void **state)
{
    (void)state;
    iris_grid grid = grid_at(0, 0);
    build_room();
    double at[2];
    free_place(at, &grid);
    const iris_map_pose there = {(int32_t)at[0], (int32_t)at[1], 0};
    iris_field field = field_of(&grid);
    iris_scan scan = look(&grid, at[0], at[1], 0, 6000, 0);
    scan.count = 19;
    assert_int_equal(locate(&field, there, &scan, NULL).verdict, IRIS_LOCALIZE_TOO_FEW);
    scan.count = 0;
    assert_int_equal(locate(&field, there, &scan, NULL).verdict, IRIS_LOCALIZE_TOO_FEW);
    scan.count = BEAMS;
    for (int i = 0; i < BEAMS; i++) {
        beams[i].spread_mm = 101;
    }
    assert_int_equal(locate(&field, there, &scan, NULL).verdict, IRIS_LOCALIZE_TOO_FEW);
    scan = look(&grid, at[0], at[1], 0, 6000, 0);
    const iris_map_pose far = {IRIS_MAP_PLACE_MAX_MM - 1, 1 - IRIS_MAP_PLACE_MAX_MM, 77};
    const iris_location nowhere = locate(&field, far, &scan, NULL);
    assert_int_equal(nowhere.verdict, IRIS_LOCALIZE_NO_MATCH);
    assert_memory_equal(&nowhere.pose.x_mm, &far.x_mm, sizeof far.x_mm);
    const iris_map_pose beside = {there.x_mm + 12 * CELL, there.y_mm, 0};
    assert_true(locate(&field, beside, &scan, NULL).verdict !=
                IRIS_LOCALIZE_FOUND); /* outside of the window */
    grid = grid_at(0, 0);
    field = field_of(&grid); /* all unknown */
    assert_int_equal(locate(&field, there, &scan, NULL).verdict, IRIS_LOCALIZE_NO_MATCH);
}

static void at_the_window_s_edge(void **state)
{
    (void)state;
    const iris_grid grid = grid_at(0, 0);
    wall(0, 10, 89, 10);
    wall(10, 0, 10, 89);
    wall(80, 0, 80, 89);
    const iris_field field = field_of(&grid);
    const iris_scan scan = look(&grid, 2000, 1400, 0, 3500, 0);
    iris_localize_config config;
    iris_localize_defaults(&config);
    config.least_percent = 10;
    const iris_location found = locate(&field, (iris_map_pose){2000, 1400 + 11 * CELL, 0}, &scan, &config);
    assert_int_equal(found.verdict, IRIS_LOCALIZE_AT_EDGE);
    assert_true(abs(found.pose.y_mm - (1400 + CELL)) <= CELL);
}

static void bad_arguments(void **state)
{
    (void)state;
    const iris_grid grid = grid_at(0, 0);
    build_room();
    iris_field field = field_of(&grid), other = field;
    const iris_scan scan = look(&grid, 2000, 2000, 0, 4000, 0);
    const iris_map_pose there = {2000, 2000, 0};
    iris_location location, before;
    iris_scratch scratch;
    memset(&location, 0x5A, sizeof location);
    before = location;
    assert_int_equal(iris_scratch_init(&scratch, matching.memory, sizeof matching.memory), IRIS_OK);
    const iris_localize_config bad[] = {
        {0, 20, 91, 40, 20, 0, 0},    {201, 20, 91, 40, 20, 0, 0},  {10, -1, 91, 40, 20, 0, 0},
        {10, 1001, 1, 40, 20, 0, 0},  {10, 20, 0, 40, 20, 0, 0},    {10, 20, -5, 40, 20, 0, 0},
        {10, 20, 1639, 40, 20, 0, 0}, {10, 20, 91, 0, 20, 0, 0},    {10, 20, 91, 101, 20, 0, 0},
        {10, 20, 91, 40, 0, 0, 0},    {10, 20, 91, 40, 20, -1, 10}, {10, 20, 91, 40, 20, 10, -1}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(iris_localize(&location, &field, there, &scan, &bad[i], &scratch), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_localize(NULL, &field, there, &scan, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_localize(&location, NULL, there, &scan, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_localize(&location, &field, there, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_localize(&location, &field, there, &scan, NULL, NULL), IRIS_ERR_ARG);
    other.w = 5000;
    assert_int_equal(iris_localize(&location, &other, there, &scan, NULL, &scratch), IRIS_ERR_ARG);
    const iris_map_pose far = {IRIS_MAP_PLACE_MAX_MM, 0, 0};
    assert_int_equal(iris_localize(&location, &field, far, &scan, NULL, &scratch), IRIS_ERR_RANGE);
    scratch.bytes--;
    assert_int_equal(iris_localize(&location, &field, there, &scan, NULL, &scratch), IRIS_ERR_SCRATCH);
    assert_memory_equal(&location, &before, sizeof before);

    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory - 1), IRIS_OK);
    other = field;
    assert_int_equal(iris_field_init(&field, memory, sizeof memory, &grid, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_field_init(&field, memory, sizeof memory - 1, &grid, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_field_init(&field, NULL, sizeof memory, &grid, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_field_init(&field, memory, sizeof memory, NULL, &scratch), IRIS_ERR_ARG);
    assert_true(field.near == other.near && field.w == other.w && scratch.used == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(field_beside_distances),
        cmocka_unit_test(as_by_trying_all),
        cmocka_unit_test(a_robot_is_found),
        cmocka_unit_test(a_corridor_is_ambiguous),
        cmocka_unit_test(a_sure_prediction_decides),
        cmocka_unit_test(a_round_room_has_no_heading),
        cmocka_unit_test(walls_that_repeat_are_ambiguous),
        cmocka_unit_test(nothing_to_match),
        cmocka_unit_test(at_the_window_s_edge),
        cmocka_unit_test(bad_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
