/* Cameras from known scenes: exact ones are found, noise is evened out, wrong points are left out, and what determines
 * no camera is refused with the reason. */
#include "iris/3d/calib_scene.h"

#include <stdio.h>

#include "random3d.h"
#include "test.h"

#define MOST 40

static IRIS_SCRATCH_BUFFER(memory, IRIS_SCENE_SCRATCH_BYTES(MOST));
static iris_scene_point points[MOST];
static uint8_t used[MOST];
static iris_scene_fit fit;

static iris_q32 whole(double a)
{
    return (iris_q32)llround(a * 4294967296.0);
}

/* A camera that looks at (0, 0, 0) from about 4 m, in millimeters; points within 1 m of it along each axis. */
static iris_sensor make_scene(int count)
{
    const iris_q32 one = IRIS_Q32_ONE;
    iris_sensor s = {.intrinsics = {random_q32(200 * one) + 800 * one, random_q32(200 * one) + 800 * one,
                                    random_q32(2 * one), random_q32(50 * one) + 320 * one,
                                    random_q32(50 * one) + 240 * one}};
    random_rotation(&s.pose.turn);
    iris_pose turn = {.turn = s.pose.turn};
    s.pose.place =
        iris_pose_out_of(&turn, (iris_vec3){random_q32(300 * one), random_q32(300 * one), -4000 * one});
    for (int i = 0; i < count; i++) {
        points[i].world = random_vec3(1000 * one);
        assert_int_equal(iris_sensor_project(&points[i].image, NULL, &s, points[i].world), IRIS_OK);
    }
    return s;
}

static iris_scene_flaw run(int count)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, IRIS_SCENE_SCRATCH_BYTES(count)), IRIS_OK);
    iris_status status = iris_scene_calibrate(&fit, used, points, count, &scratch);
    assert_int_equal(status, fit.flaw == IRIS_SCENE_FINE ? IRIS_OK : IRIS_ERR_DATA);
    assert_int_equal(scratch.used, 0);
    return fit.flaw;
}

static double off(const iris_sensor *a, const iris_sensor *b)
{
    iris_vec3 way = iris_vec3_sub(a->pose.place, b->pose.place);
    return real(iris_vec3_length(way));
}

static void add_noise(int count, double sigma)
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 12; k++) { /* the sum of twelve is normally distributed, nearly */
            points[i].image.x += random_q32(whole(sigma / 2));
            points[i].image.y += random_q32(whole(sigma / 2));
        }
    }
}

static void exact_cameras(void **state)
{
    (void)state;
    double place = 0, focal = 0, rms = 0;
    for (int i = 0; i < 24; i++) {
        int count = 6 + i % 6;
        iris_sensor s = make_scene(count);
        assert_int_equal(run(count), IRIS_SCENE_FINE);
        assert_int_equal(fit.left_out, 0);
        place = fmax(place, off(&fit.refined.sensor, &s));
        focal = fmax(focal, fabs(real(fit.refined.sensor.intrinsics.alpha_u) - real(s.intrinsics.alpha_u)));
        rms = fmax(rms, real(fit.refined.rms));
    }
    printf("#: exact points: center %.1e mm, focal length %.1e px, rms %.1e px\n", place, focal, rms);
    assert_true(place < 0.2 && focal < 0.05 && rms < 1e-4);
}

static double squares(const iris_sensor *s, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        sum += pow(real(iris_scene_distance(s, &points[i])), 2);
    }
    return sum;
}

/* No other intrinsic parameters, and no other place, make the sum of squares less. */
static void is_least(const iris_sensor *s, int count)
{
    iris_sensor other = *s;
    iris_q32 *numbers[] = {&other.intrinsics.alpha_u, &other.intrinsics.alpha_v, &other.intrinsics.shear,
                           &other.intrinsics.u0,      &other.intrinsics.v0,      &other.pose.place.x,
                           &other.pose.place.y,       &other.pose.place.z};
    for (size_t k = 0; k < 2 * sizeof numbers / sizeof numbers[0]; k++) {
        *numbers[k / 2] += IRIS_Q32_ONE / (k % 2 ? 1000 : -1000);
        assert_true(squares(&other, count) > squares(s, count));
        other = *s;
    }
}

static void noise_is_evened_out(void **state)
{
    (void)state;
    double place = 0, rms = 0;
    const int rounds = 3;
    for (int i = 0; i < rounds; i++) {
        iris_sensor s = make_scene(MOST);
        add_noise(MOST, 0.5);
        assert_int_equal(run(MOST), IRIS_SCENE_FINE);
        assert_int_equal(fit.left_out, 0);
        place += pow(off(&fit.refined.sensor, &s), 2) / rounds;
        rms += pow(real(fit.refined.rms), 2) / rounds;
        assert_true(fit.refined.rms <= fit.linear.rms + 16);
        is_least(&fit.refined.sensor, MOST);
        double sum = 0;
        for (int k = 0; k < MOST; k++) {
            sum += real(iris_scene_distance(&fit.linear.sensor, &points[k]));
        }
        assert_true(fabs(sum - real(fit.linear.total)) < 1e-6);
    }
    printf("#: noise of 0.5 px: center %.1f mm, rms %.2f px\n", sqrt(place), sqrt(rms));
    assert_true(sqrt(place) < 40 && sqrt(rms) > 0.55 && sqrt(rms) < 0.72); /* 0.5 sqrt(2) sqrt(1 - 11 / 80) */
}

/* Three of ten, wherever. */
static void wrong_points_are_left_out(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        int count = i < 2 ? 12 : MOST, wrong = count * 3 / 10, found = 0;
        iris_sensor s = make_scene(count);
        add_noise(count, 0.3);
        for (int k = 0; k < wrong; k++) {
            points[k].image.x += whole(25) + random_q32(whole(5)) * (k + 1);
            points[k].image.y += random_q32(whole(200));
        }
        assert_int_equal(run(count), IRIS_SCENE_FINE);
        for (int k = 0; k < count; k++) {
            found += k < wrong && !used[k];
            assert_true(k < wrong || used[k]);
        }
        assert_int_equal(found, wrong);
        assert_int_equal(fit.left_out, wrong);
        assert_true(off(&fit.refined.sensor, &s) < 120);
    }
}

static void refused(void **state)
{
    (void)state;
    (void)make_scene(20);
    assert_int_equal(run(5), IRIS_SCENE_TOO_FEW);
    assert_int_equal(run(0), IRIS_SCENE_TOO_FEW);
    for (int i = 5; i < 20; i++) { /* five, again and again */
        points[i] = points[i % 5];
    }
    assert_int_equal(run(20), IRIS_SCENE_TOO_FEW);
    for (int one = 0; one < 2; one++) { /* on a plane, and all but one */
        iris_sensor s = make_scene(20);
        for (int i = one; i < 20; i++) {
            points[i].world.z = points[i].world.x / 2 - points[i].world.y + 7 * IRIS_Q32_ONE;
            assert_int_equal(iris_sensor_project(&points[i].image, NULL, &s, points[i].world), IRIS_OK);
        }
        add_noise(20, 0.3);
        assert_int_equal(run(20), IRIS_SCENE_FLAT);
        assert_int_equal(run(9), IRIS_SCENE_FLAT);
    }
    (void)make_scene(9);
    for (int i = 0; i < 9; i++) { /* a mirror's */
        points[i].world.x = -points[i].world.x;
    }
    assert_int_equal(run(9), IRIS_SCENE_MIRRORED);
    (void)make_scene(9);
    for (int i = 0; i < 9; i++) { /* on one line of the picture */
        points[i].image.y = points[i].image.x / 2;
    }
    assert_int_equal(run(9), IRIS_SCENE_UNDETERMINED);
}

/* Points on a twisted cubic that goes through the camera. */
static void a_cubic_tells_nothing(void **state)
{
    (void)state;
    iris_sensor s = {.intrinsics = {whole(800), whole(800), 0, whole(320), whole(240)}};
    iris_mat3_identity(&s.pose.turn);
    for (int i = 0; i < 11; i++) {
        double t = (i % 2 ? -1 : 1) * (0.5 + 0.1 * i);
        points[i].world = (iris_vec3){whole(t), whole(t * t * t), whole(2 + t * t)};
        s.pose.place = (iris_vec3){0, 0, whole(2)}; /* t = 0 */
        assert_int_equal(iris_sensor_project(&points[i].image, NULL, &s, points[i].world), IRIS_OK);
    }
    assert_int_equal(run(11), IRIS_SCENE_UNDETERMINED);
}

static void wrong_calls(void **state)
{
    (void)state;
    iris_scratch scratch;
    (void)make_scene(12);
    const iris_scene_fit before = fit;
    (void)iris_scratch_init(&scratch, memory.memory, IRIS_SCENE_SCRATCH_BYTES(12) - 1);
    assert_int_equal(iris_scene_calibrate(&fit, used, points, 12, &scratch), IRIS_ERR_SCRATCH);
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    assert_int_equal(iris_scene_calibrate(NULL, used, points, 12, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_scene_calibrate(&fit, NULL, points, 12, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_scene_calibrate(&fit, used, NULL, 12, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_scene_calibrate(&fit, used, points, 12, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_scene_calibrate(&fit, used, points, -1, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_scene_calibrate(&fit, used, points, IRIS_SCENE_POINTS_MAX + 1, &scratch),
                     IRIS_ERR_RANGE);
    points[3].world.y = ((iris_q32)1 << 60) + 1;
    assert_int_equal(iris_scene_calibrate(&fit, used, points, 12, &scratch), IRIS_ERR_RANGE);
    assert_memory_equal(&fit, &before, sizeof fit);
}

static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 28; i++) {
        int count = 6 + i % 7, fine = i % 3;
        (void)make_scene(count);
        for (int k = 0; k < count; k++) {
            iris_q32 *numbers[] = {&points[k].world.x, &points[k].world.y, &points[k].world.z,
                                   &points[k].image.x, &points[k].image.y};
            for (int n = 0; n < 5; n++) {
                *numbers[n] = fine && (k + n) % 5 ? *numbers[n] : any_q32() / 8;
            }
        }
        (void)run(count);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_cameras),
        cmocka_unit_test(noise_is_evened_out),
        cmocka_unit_test(wrong_points_are_left_out),
        cmocka_unit_test(refused),
        cmocka_unit_test(a_cubic_tells_nothing),
        cmocka_unit_test(wrong_calls),
        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
