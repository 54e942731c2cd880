/* Pairs of cameras from a board: exact views give the pair back, noise shows in the deviations, and what determines no
 * pair is refused with the reason. Places in the pictures are those of double precision. */
#include "iris/3d/calib_pair.h"

#include <stdio.h>
#include <string.h>

#include "double_camera.h"
#include "test.h"

#define VIEWS   5
#define COLUMNS 6
#define ROWS    5
#define POINTS  (COLUMNS * ROWS)

static IRIS_SCRATCH_BUFFER(memory, IRIS_PAIR_SCRATCH_BYTES(VIEWS, VIEWS *POINTS));
static iris_pair_point points[VIEWS][POINTS];
static iris_pair_view views[VIEWS];
static iris_pair_place places[VIEWS];
static iris_sensor cameras[2];
static iris_pair_fit fit;

/* The right camera's pose is that in the left one's frame. */
static void make_cameras(void)
{
    cameras[0] = (iris_sensor){.intrinsics = {whole(560), whole(552), 0, whole(325), whole(236)},
                               .lens = {.k1 = whole(-0.22), .k2 = whole(0.08), .p1 = whole(0.001)}};
    cameras[1] = (iris_sensor){.intrinsics = {whole(601), whole(604), whole(0.5), whole(310), whole(248)},
                               .lens = {.k1 = whole(-0.2), .k2 = whole(0.05), .p2 = whole(-0.0008)}};
    iris_mat3_identity(&cameras[0].pose.turn);
    cameras[0].pose.place = (iris_vec3){0, 0, 0};
    iris_rotation_from_vector(&cameras[1].pose.turn, (iris_vec3){whole(0.03), whole(0.14), whole(-0.05)});
    cameras[1].pose.place = (iris_vec3){whole(120), whole(-6), whole(11)};
}

/* A board of squares of 30 mm, about 600 mm away, tilted to all sides. */
static void make_views(void)
{
    for (int v = 0; v < VIEWS; v++) {
        iris_mat3 turn;
        const double angle = 1.2566 * v + 0.3;
        iris_rotation_from_vector(
            &turn, (iris_vec3){whole(0.5 * cos(angle)), whole(0.5 * sin(angle)), whole(0.1 * v)});
        views[v] = (iris_pair_view){points[v], POINTS};
        for (int i = 0; i < POINTS; i++) {
            const double x = 30.0 * (i % COLUMNS) - 75, y = 30.0 * (i / COLUMNS) - 60;
            const double middle[3] = {60 + 25 * v - 50, 20 - 10 * v, 520 + 40 * v};
            double world[3], pixels[2][2];
            for (int k = 0; k < 3; k++) {
                world[k] = middle[k] + real(turn.m[3 * k]) * x + real(turn.m[3 * k + 1]) * y;
            }
            assert_true(double_project(pixels[0], &cameras[0], world) > 0 &&
                        double_project(pixels[1], &cameras[1], world) > 0);
            points[v][i] = (iris_pair_point){{whole(x + 75), whole(y + 60)},
                                             {whole(pixels[0][0]), whole(pixels[0][1])},
                                             {whole(pixels[1][0]), whole(pixels[1][1])}};
        }
    }
}

static iris_pair_flaw run(int count)
{
    iris_scratch scratch;
    int32_t all = 0;
    for (int v = 0; v < count; v++) {
        all += views[v].count;
    }
    (void)iris_scratch_init(&scratch, memory.memory, IRIS_PAIR_SCRATCH_BYTES(count, all));
    const iris_status status = iris_pair_calibrate(&fit, places, views, count, cameras, &scratch);
    assert_int_equal(status, fit.flaw == IRIS_PAIR_FINE ? IRIS_OK : IRIS_ERR_DATA);
    assert_int_equal(scratch.used, 0);
    return fit.flaw;
}

/* The turn against the truth, about the right camera's axes, and how far its place is off. */
static void errors_of(double errors[6])
{
    iris_mat3 back, off;
    iris_mat3_transpose(&back, &cameras[1].pose.turn);
    iris_mat3_multiply(&off, &fit.right.turn, &back);
    const iris_vec3 turn = iris_rotation_to_vector(&off),
                    place = iris_vec3_sub(fit.right.place, cameras[1].pose.place);
    const iris_q32 all[6] = {turn.x, turn.y, turn.z, place.x, place.y, place.z};
    for (int i = 0; i < 6; i++) {
        errors[i] = real(all[i]);
    }
}

static double largest(const double *numbers, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) {
        most = fmax(most, fabs(numbers[i]));
    }
    return most;
}

static void exact_views(void **state)
{
    (void)state;
    for (int count = 1; count <= VIEWS; count += 2) {
        double errors[6];
        make_cameras();
        make_views();
        assert_int_equal(run(count), IRIS_PAIR_FINE);
        errors_of(errors);
        printf("#: %d exact views: turn %.1e, place %.1e mm, rms %.1e px\n", count, largest(errors, 3),
               largest(errors + 3, 3), real(fit.rms));
        assert_true(largest(errors, 3) < 1e-6 && largest(errors + 3, 3) < 1e-4 && real(fit.rms) < 1e-4);
        assert_true(fabs(real(fit.baseline) - sqrt(120 * 120 + 36 + 121)) < 1e-4);
        assert_int_equal(fit.remarks, 0);
        assert_int_equal(fit.flawed, -1);
    }
    /* the board's middle is where the left camera sees it */
    const iris_vec3 middle = iris_pose_into(&places[2].left, (iris_vec3){whole(75), whole(60), 0});
    assert_true(fabs(real(middle.x) - 60) < 1e-4 && fabs(real(middle.y)) < 1e-4 &&
                fabs(real(middle.z) - 600) < 1e-4);
}

/* The same with lenses that correct, and have a center: nothing is asked of them but to bend and straighten. */
static void other_lenses(void **state)
{
    (void)state;
    double errors[6];
    make_cameras();
    make_views();
    for (int k = 0; k < 2; k++) {
        iris_lens *lens = &cameras[k].lens;
        *lens = (iris_lens){
            .k1 = whole(0.2), .center = {whole(0.01), whole(-0.02)}, .direction = IRIS_LENS_CORRECTS};
    }
    for (int i = 0; i < VIEWS * POINTS; i++) {
        iris_pair_point *p = &points[i / POINTS][i % POINTS];
        iris_vec2 *seen[2] = {&p->left, &p->right};
        for (int k = 0; k < 2; k++) { /* a place on the picture plane that is straight by the new lens */
            iris_sensor old = cameras[k];
            iris_vec2 plane, straight;
            make_cameras();
            const iris_lens bends = cameras[k].lens;
            cameras[k] = old;
            assert_int_equal(iris_intrinsics_plane(&plane, &old.intrinsics, *seen[k]), IRIS_OK);
            assert_int_equal(iris_lens_straighten(&straight, &bends, plane), IRIS_OK);
            *seen[k] = iris_intrinsics_pixel(&old.intrinsics, iris_lens_bend(&old.lens, straight));
            cameras[1 - k].lens = old.lens;
        }
    }
    assert_int_equal(run(VIEWS), IRIS_PAIR_FINE);
    errors_of(errors);
    assert_true(largest(errors, 3) < 1e-6 && largest(errors + 3, 3) < 1e-3 && real(fit.rms) < 1e-3);
}

/* Normally distributed, nearly, with that standard deviation. */
static iris_q32 noise_of(double deviation)
{
    iris_q32 sum = 0;
    for (int i = 0; i < 12; i++) {
        sum += random_q32(whole(deviation / 2));
    }
    return sum;
}

static void noise(void **state)
{
    (void)state;
    const int rounds = 12;
    double sum = 0, rms = 0, worst = 0;
    for (int round = 0; round < rounds; round++) {
        double errors[6];
        make_cameras();
        make_views();
        for (int i = 0; i < VIEWS * POINTS; i++) {
            iris_pair_point *p = &points[i / POINTS][i % POINTS];
            p->left.x += noise_of(0.3);
            p->left.y += noise_of(0.3);
            p->right.x += noise_of(0.3);
            p->right.y += noise_of(0.3);
        }
        assert_int_equal(run(VIEWS), IRIS_PAIR_FINE);
        errors_of(errors);
        rms += real(fit.rms) / rounds;
        worst = fmax(worst, largest(errors + 3, 3));
        for (int k = 0; k < 6; k++) {
            assert_true(fit.deviations[k] > 0);
            sum += pow(errors[k] / real(fit.deviations[k]), 2) / (6 * rounds);
        }
        for (int v = 0; v < VIEWS; v++) {
            assert_true(real(places[v].rms[0]) > 0.2 && real(places[v].rms[0]) < 0.6 &&
                        real(places[v].rms[1]) > 0.2 && real(places[v].rms[1]) < 0.6);
        }
    }
    const double expected = 0.3 * sqrt(2 * (1 - (6 + 6.0 * VIEWS) / (4 * VIEWS * POINTS)));
    printf("#: noise of 0.3 pixels: errors are %.2f of the deviations (root mean square), rms %.3f (%.3f), "
           "worst place "
           "%.2f mm\n",
           sqrt(sum), rms, expected, worst);
    assert_true(sqrt(sum) > 0.75 && sqrt(sum) < 1.3 && fabs(rms - expected) < 0.02);
}

static void remarks(void **state)
{
    (void)state;
    make_cameras();
    cameras[1].pose.place = (iris_vec3){0, 0, 0};
    make_views();
    for (int i = 0; i < VIEWS * POINTS; i++) {
        points[i / POINTS][i % POINTS].left.x += noise_of(0.3);
    }
    assert_int_equal(run(VIEWS), IRIS_PAIR_FINE);
    assert_int_equal(fit.remarks, IRIS_PAIR_ONE_PLACE | IRIS_PAIR_LOOSE);
    make_cameras();
    make_views();
    for (int i = 0; i < POINTS; i++) { /* one view's points in the right picture are others */
        points[1][i].right = points[2][i].right;
    }
    assert_int_equal(run(VIEWS), IRIS_PAIR_FINE);
    assert_int_equal(fit.remarks & IRIS_PAIR_FAR_OFF, IRIS_PAIR_FAR_OFF);
    assert_true(places[1].rms[1] > places[0].rms[1]);
}

static void refused(void **state)
{
    (void)state;
    make_cameras();
    make_views();
    assert_int_equal(run(0), IRIS_PAIR_TOO_FEW);
    views[2].count = 3;
    assert_int_equal(run(VIEWS), IRIS_PAIR_TOO_FEW);
    assert_int_equal(fit.flawed, 2);
    make_views();
    points[3][7].right.x = whole(40000); /* k1 < 0: the lens turns back long before */
    assert_int_equal(run(VIEWS), IRIS_PAIR_NO_RAY);
    assert_int_equal(fit.flawed, 3);
    make_views();
    for (int i = 0; i < POINTS; i++) {
        points[1][i] = points[1][i % 3];
    }
    assert_int_equal(run(VIEWS), IRIS_PAIR_IN_LINE);
    assert_int_equal(fit.flawed, 1);
    make_views();
    for (int i = 0; i < POINTS; i++) { /* the right picture in a mirror */
        points[4][i].right.x = whole(620) - points[4][i].right.x;
    }
    const iris_pair_flaw flaw = run(VIEWS);
    assert_true(flaw == IRIS_PAIR_BEHIND || (fit.remarks & IRIS_PAIR_FAR_OFF));
}

static void wrong_calls(void **state)
{
    (void)state;
    iris_scratch scratch;
    make_cameras();
    make_views();
    assert_int_equal(run(VIEWS), IRIS_PAIR_FINE);
    const iris_pair_fit before = fit;
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory - 1);
    assert_int_equal(iris_pair_calibrate(&fit, places, views, VIEWS, cameras, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    assert_int_equal(iris_pair_calibrate(NULL, places, views, VIEWS, cameras, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_calibrate(&fit, NULL, views, VIEWS, cameras, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_calibrate(&fit, places, NULL, VIEWS, cameras, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_calibrate(&fit, places, views, VIEWS, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_calibrate(&fit, places, views, VIEWS, cameras, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_calibrate(&fit, places, views, -1, cameras, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_pair_calibrate(&fit, places, views, IRIS_BOARD_VIEWS_MAX + 1, cameras, &scratch),
                     IRIS_ERR_RANGE);
    points[1][2].right.y = ((iris_q32)1 << 60) + 1;
    assert_int_equal(iris_pair_calibrate(&fit, places, views, VIEWS, cameras, &scratch), IRIS_ERR_RANGE);
    make_views();
    views[1].count = IRIS_BOARD_POINTS_MAX + 1;
    assert_int_equal(iris_pair_calibrate(&fit, places, views, VIEWS, cameras, &scratch), IRIS_ERR_RANGE);
    views[1] = (iris_pair_view){NULL, 5};
    assert_int_equal(iris_pair_calibrate(&fit, places, views, VIEWS, cameras, &scratch), IRIS_ERR_ARG);
    cameras[1].intrinsics.alpha_v = 0;
    assert_int_equal(iris_pair_calibrate(&fit, places, views, VIEWS, cameras, &scratch), IRIS_ERR_RANGE);
    assert_memory_equal(&fit, &before, sizeof fit);
}

static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        make_cameras();
        make_views();
        for (int v = 0; v < 2; v++) {
            views[v].count = 12;
            for (int k = 0; k < 12; k++) {
                iris_pair_point *p = &points[v][k];
                iris_q32 *numbers[] = {&p->board.x, &p->board.y, &p->left.x,
                                       &p->left.y,  &p->right.x, &p->right.y};
                for (int n = 0; n < 6; n++) {
                    *numbers[n] = i % 3 && (k + n) % (i % 3 == 1 ? 5 : 50) ? *numbers[n] : any_q32() / 8;
                }
            }
        }
        if (i % 4 == 3) {
            spoil(&cameras[i / 4 % 2]);
        }
        iris_scratch scratch;
        (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
        (void)iris_pair_calibrate(&fit, places, views, 2, cameras, &scratch);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_views), cmocka_unit_test(other_lenses), cmocka_unit_test(noise),
        cmocka_unit_test(remarks),     cmocka_unit_test(refused),      cmocka_unit_test(wrong_calls),
        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
