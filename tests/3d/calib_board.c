/* Cameras from a board: exact views give the camera back, noise shows in the deviations, and what determines no camera
 * is refused with the reason. */
#include "iris/3d/calib_board.h"

#include <stdio.h>

#include "random3d.h"
#include "test.h"

#define VIEWS   5
#define COLUMNS 6
#define ROWS    4
#define POINTS  (COLUMNS * ROWS)

static IRIS_SCRATCH_BUFFER(memory, IRIS_BOARD_SCRATCH_BYTES(VIEWS));
static iris_board_point points[VIEWS][POINTS];
static iris_board_view views[VIEWS];
static iris_board_place places[VIEWS];
static iris_pose poses[VIEWS];
static iris_board_fit fit;
static iris_board_config config;

static iris_q32 whole(double a)
{
    return (iris_q32)llround(a * 4294967296.0);
}

static iris_sensor make_camera(uint32_t model)
{
    iris_sensor s = {.intrinsics = {whole(800), whole(790), 0, whole(330), whole(235)},
                     .lens = {.k1 = whole(-0.25), .k2 = whole(0.12)}};
    s.intrinsics.shear = model & IRIS_BOARD_SHEAR ? whole(1.5) : 0;
    s.lens.k3 = model & IRIS_BOARD_K3 ? whole(-0.08) : 0;
    s.lens.p1 = model & IRIS_BOARD_TANGENTIAL ? whole(0.002) : 0;
    s.lens.p2 = model & IRIS_BOARD_TANGENTIAL ? whole(-0.001) : 0;
    config = (iris_board_config){model, {640, 480}};
    return s;
}

/* Squares of 30 mm, about 280 mm away, tilted by `tilt` and some to each side. */
static void make_views(iris_sensor *s, double tilt)
{
    for (int v = 0; v < VIEWS; v++) {
        double angle = 1.2566 * v + 0.3;
        iris_rotation_from_vector(
            &s->pose.turn, (iris_vec3){whole(tilt * cos(angle)), whole(tilt * sin(angle)), whole(0.1 * v)});
        iris_pose turn = {.turn = s->pose.turn};
        iris_vec3 back =
            iris_pose_out_of(&turn, (iris_vec3){whole(8 * v - 16), whole(12 - 6 * v), whole(-280)});
        s->pose.place = iris_vec3_add(back, (iris_vec3){whole(75), whole(45), 0});
        poses[v] = s->pose;
        views[v] = (iris_board_view){points[v], POINTS};
        for (int i = 0; i < POINTS; i++) {
            iris_vec3 world = {whole(30.0 * (i % COLUMNS)), whole(30.0 * (i / COLUMNS)), 0};
            points[v][i].board = (iris_vec2){world.x, world.y};
            assert_int_equal(iris_sensor_project(&points[v][i].image, NULL, s, world), IRIS_OK);
        }
    }
}

static iris_board_flaw run(int count)
{
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, memory.memory, IRIS_BOARD_SCRATCH_BYTES(count));
    iris_status status = iris_board_calibrate(&fit, places, views, count, &config, &scratch);
    assert_int_equal(status, fit.flaw == IRIS_BOARD_FINE ? IRIS_OK : IRIS_ERR_DATA);
    assert_int_equal(scratch.used, 0);
    return fit.flaw;
}

static void values_of(double *values, const iris_intrinsics *k, const iris_lens *l)
{
    const iris_q32 all[IRIS_BOARD_PARAMETERS] = {k->alpha_u, k->alpha_v, k->shear, k->u0, k->v0,
                                                 l->k1,      l->k2,      l->k3,    l->p1, l->p2};
    for (int i = 0; i < IRIS_BOARD_PARAMETERS; i++) {
        values[i] = real(all[i]);
    }
}

static void exact_views(void **state)
{
    (void)state;
    static const uint32_t models[] = {0, 7};
    for (int m = 0; m < 2; m++) {
        double truth[IRIS_BOARD_PARAMETERS], found[IRIS_BOARD_PARAMETERS], pixels = 0, lens = 0, place = 0;
        iris_sensor s = make_camera(models[m]);
        make_views(&s, 0.5);
        assert_int_equal(run(VIEWS), IRIS_BOARD_FINE);
        values_of(truth, &s.intrinsics, &s.lens);
        values_of(found, &fit.intrinsics, &fit.lens);
        for (int k = 0; k < IRIS_BOARD_PARAMETERS; k++) {
            double off = fabs(found[k] - truth[k]);
            pixels = fmax(pixels, k <= IRIS_BOARD_V0 ? off : 0);
            lens = fmax(lens, k > IRIS_BOARD_V0 ? off : 0);
        }
        for (int v = 0; v < VIEWS; v++) {
            place = fmax(place, real(iris_vec3_length(iris_vec3_sub(places[v].pose.place, poses[v].place))));
        }
        printf("#: exact views: pixels %.1e, lens %.1e, places %.1e mm, rms %.1e px\n", pixels, lens, place,
               real(fit.rms));
        assert_true(pixels < 1e-3 && lens < 1e-4 && place < 1e-3 && real(fit.rms) < 1e-5);
        assert_int_equal(fit.remarks, 0);
    }
}

/* The sum of squared distances by the camera as it was found. */
static double squares(const iris_sensor *camera)
{
    double sum = 0;
    iris_sensor s = *camera;
    for (int v = 0; v < VIEWS; v++) {
        s.pose = places[v].pose;
        for (int i = 0; i < POINTS; i++) {
            iris_vec2 at;
            iris_vec3 world = {points[v][i].board.x, points[v][i].board.y, 0};
            assert_int_equal(iris_sensor_project(&at, NULL, &s, world), IRIS_OK);
            sum += pow(real(at.x - points[v][i].image.x), 2) + pow(real(at.y - points[v][i].image.y), 2);
        }
    }
    return sum;
}

static void noise(void **state)
{
    (void)state;
    double truth[IRIS_BOARD_PARAMETERS], found[IRIS_BOARD_PARAMETERS], sum = 0;
    const int rounds = 3;
    iris_sensor s = make_camera(0);
    for (int round = 0; round < rounds; round++) {
        make_views(&s, 0.5);
        for (int k = 0; k < 12 * VIEWS * POINTS;
             k++) { /* the sum of twelve is normally distributed, nearly */
            points[k % VIEWS][k / VIEWS % POINTS].image.x += random_q32(whole(0.15));
            points[k % VIEWS][k / VIEWS % POINTS].image.y += random_q32(whole(0.15));
        }
        assert_int_equal(run(VIEWS), IRIS_BOARD_FINE);
        assert_true(fabs(real(fit.rms) - 0.3 * sqrt(2 * (1 - 36.0 / 240))) < 0.06);
        iris_sensor camera = {.intrinsics = fit.intrinsics, .lens = fit.lens};
        double least = squares(&camera);
        assert_true(fabs(sqrt(least / (VIEWS * POINTS)) - real(fit.rms)) < 1e-5);
        values_of(truth, &s.intrinsics, &s.lens);
        values_of(found, &fit.intrinsics, &fit.lens);
        for (int k = 0; k < IRIS_BOARD_PARAMETERS; k++) {
            assert_true((fit.deviations[k] > 0) == (k <= IRIS_BOARD_LENS_K2 && k != IRIS_BOARD_SKEW));
            if (fit.deviations[k] > 0) {
                sum += pow((found[k] - truth[k]) / real(fit.deviations[k]), 2) / (6 * rounds);
            }
        }
        iris_sensor other = camera; /* nothing else is better */
        iris_q32 *numbers[] = {&other.intrinsics.alpha_u,
                               &other.intrinsics.alpha_v,
                               &other.intrinsics.u0,
                               &other.intrinsics.v0,
                               &other.lens.k1,
                               &other.lens.k2};
        for (int k = 0; k < 12; k++) {
            *numbers[k / 2] += (k % 2 ? 1 : -1) * (k < 8    ? IRIS_Q32_ONE / 512
                                                   : k < 10 ? IRIS_Q32_ONE / 32768
                                                            : IRIS_Q32_ONE / 4096);
            assert_true(squares(&other) > least);
            other = camera;
        }
    }
    printf("#: errors are %.2f of the deviations (root mean square)\n", sqrt(sum));
    assert_true(sqrt(sum) > 0.4 && sqrt(sum) < 1.8);
}

static void remarks(void **state)
{
    (void)state;
    iris_sensor s = make_camera(0);
    make_views(&s, 0.5);
    views[1] = views[2] = views[0]; /* one place, again and again */
    assert_int_equal(run(3), IRIS_BOARD_FINE);
    assert_int_equal(fit.remarks & IRIS_BOARD_TURNS_LITTLE, IRIS_BOARD_TURNS_LITTLE);
    config.size = (iris_size){2000, 2000};
    make_views(&s, 0.5);
    assert_int_equal(run(VIEWS), IRIS_BOARD_FINE);
    assert_int_equal(fit.remarks & IRIS_BOARD_COVERS_LITTLE, IRIS_BOARD_COVERS_LITTLE);
    assert_true(fit.fields > 4 && fit.fields < 16);
}

static void refused(void **state)
{
    (void)state;
    iris_sensor s = make_camera(0);
    make_views(&s, 0.5);
    assert_int_equal(run(0), IRIS_BOARD_TOO_FEW);
    views[2].count = 3;
    assert_int_equal(run(VIEWS), IRIS_BOARD_TOO_FEW);
    assert_int_equal(fit.flawed, 2);
    views[0].count = 5; /* ten equations, twelve unknowns */
    assert_int_equal(run(1), IRIS_BOARD_TOO_FEW);
    make_views(&s, 0.5);
    for (int i = 0; i < POINTS; i++) {
        points[3][i].board.y = 2 * points[3][i].board.x;
        points[3][i].image.y = 2 * points[3][i].image.x;
    }
    assert_int_equal(run(VIEWS), IRIS_BOARD_IN_LINE);
    assert_int_equal(fit.flawed, 3);
    make_views(&s, 0.5);
    for (int i = 0; i < POINTS; i++) {
        points[1][i] = points[1][i % 3];
    }
    assert_int_equal(run(VIEWS), IRIS_BOARD_IN_LINE);
    s.lens = (iris_lens){0};
    make_views(&s, 0);
    assert_int_equal(run(VIEWS), IRIS_BOARD_FACING);
    assert_int_equal(fit.flawed, -1);
    make_views(&s, 0.5);
    for (int i = 0; i < POINTS; i++) { /* no plane */
        points[4][i].image = (iris_vec2){random_q32(whole(300)), random_q32(whole(300))};
    }
    assert_true(run(VIEWS) != IRIS_BOARD_FINE || places[4].rms > whole(50));
}

/* Five places of one view, one of them twice: as many equations as parameters, which do not determine them. */
static void one_point_twice(void **state)
{
    (void)state;
    static const double seen[6][4] = {
        {0, 0, 253.34277984686196, 159.47923432453535},  {30, 0, 289.96804601489566, 169.8819867009297},
        {60, 0, 333.05535879102536, 182.17397539201193}, {0, 30, 211.78708657831885, 223.17757317749783},
        {30, 0, 289.96804601489566, 169.8819867009297},  {60, 30, 284.84952635131776, 257.8770275753923}};
    for (int i = 0; i < 6; i++) {
        points[0][i] = (iris_board_point){{whole(seen[i][0]), whole(seen[i][1])},
                                          {whole(seen[i][2]), whole(seen[i][3])}};
    }
    views[0] = (iris_board_view){points[0], 6};
    config = (iris_board_config){0, {640, 480}};
    assert_int_equal(run(1), IRIS_BOARD_FACING);
}

static void wrong_calls(void **state)
{
    (void)state;
    iris_scratch scratch;
    iris_sensor s = make_camera(0);
    make_views(&s, 0.5);
    const iris_board_fit before = fit;
    (void)iris_scratch_init(&scratch, memory.memory, IRIS_BOARD_SCRATCH_BYTES(VIEWS) - 1);
    assert_int_equal(iris_board_calibrate(&fit, places, views, VIEWS, NULL, &scratch), IRIS_ERR_SCRATCH);
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    assert_int_equal(iris_board_calibrate(NULL, places, views, VIEWS, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_board_calibrate(&fit, NULL, views, VIEWS, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_board_calibrate(&fit, places, NULL, VIEWS, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_board_calibrate(&fit, places, views, VIEWS, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_board_calibrate(&fit, places, views, -1, NULL, &scratch), IRIS_ERR_RANGE);
    config.model = 8;
    assert_int_equal(iris_board_calibrate(&fit, places, views, VIEWS, &config, &scratch), IRIS_ERR_RANGE);
    config = (iris_board_config){0, {0, 480}};
    assert_int_equal(iris_board_calibrate(&fit, places, views, VIEWS, &config, &scratch), IRIS_ERR_RANGE);
    points[1][2].image.y = ((iris_q32)1 << 60) + 1;
    assert_int_equal(iris_board_calibrate(&fit, places, views, VIEWS, NULL, &scratch), IRIS_ERR_RANGE);
    views[1].points = NULL;
    assert_int_equal(iris_board_calibrate(&fit, places, views, VIEWS, NULL, &scratch), IRIS_ERR_ARG);
    assert_memory_equal(&fit, &before, sizeof fit);
}

static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 24; i++) {
        iris_sensor s = make_camera((uint32_t)i % 8);
        make_views(&s, 0.5);
        for (int v = 0; v < 2; v++) {
            views[v].count = 16;
            for (int k = 0; k < 16; k++) {
                iris_q32 *numbers[] = {&points[v][k].board.x, &points[v][k].board.y, &points[v][k].image.x,
                                       &points[v][k].image.y};
                for (int n = 0; n < 4; n++) {
                    *numbers[n] = i % 3 && (k + n) % (i % 3 == 1 ? 5 : 50) ? *numbers[n] : any_q32() / 8;
                }
            }
        }
        (void)run(2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_views),     cmocka_unit_test(noise),       cmocka_unit_test(remarks),
        cmocka_unit_test(refused),         cmocka_unit_test(wrong_calls), cmocka_unit_test(any_numbers),
        cmocka_unit_test(one_point_twice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
