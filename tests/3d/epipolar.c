/* Epipolar geometry against double precision: random cameras with lenses, and points that both see. */
#include "iris/3d/epipolar.h"

#include <stdio.h>
#include <string.h>

#include "double_camera.h"
#include "test.h"

static const int size[2] = {640, 480};

/* p'^T M p */
static double between_places(const iris_mat3 *m, const double left[2], const double right[2])
{
    const double p[3] = {left[0], left[1], 1}, q[3] = {right[0], right[1], 1};
    double sum = 0;
    for (int i = 0; i < 9; i++) {
        sum += real(m->m[i]) * q[i / 3] * p[i % 3];
    }
    return sum;
}

/* The distance of the right place from the line that M makes of the left one. */
static double off_line(const iris_mat3 *m, const double left[2], const double right[2])
{
    const double a = real(m->m[0]) * left[0] + real(m->m[1]) * left[1] + real(m->m[2]);
    const double b = real(m->m[3]) * left[0] + real(m->m[4]) * left[1] + real(m->m[5]);
    return fabs(between_places(m, left, right)) / hypot(a, b);
}

static void points_of_both_pictures(void **state)
{
    (void)state;
    double of_e = 0, of_f = 0, of_line = 0, of_miss = 0, of_shift = 0;
    for (int round = 0; round < 300; round++) {
        iris_sensor pair[2];
        iris_mat3 e, f;
        random_pair(pair, between(0.05, 20), 0.7, size[0], size[1]);
        assert_int_equal(iris_epipolar_essential(&e, &pair[0].pose, &pair[1].pose), IRIS_OK);
        assert_int_equal(iris_epipolar_fundamental(&f, &pair[0], &pair[1]), IRIS_OK);
        for (int i = 0; i < 20; i++) {
            double world[3], pixels[2][2], planes[2][2], flat[2][2];
            const double away = real(iris_vec3_length(iris_vec3_sub(pair[1].pose.place, pair[0].pose.place)));
            if (!random_seen(world, pixels, pair, away * between(2, 50), size)) {
                continue;
            }
            for (int k = 0; k < 2; k++) {
                double c[3];
                double_into(c, &pair[k].pose, world);
                planes[k][0] = c[0] / c[2];
                planes[k][1] = c[1] / c[2];
                double_pixel(flat[k], &pair[k].intrinsics, planes[k]);
            }
            of_e = fmax(of_e, fabs(between_places(&e, planes[0], planes[1])));
            of_f = fmax(of_f, off_line(&f, flat[0], flat[1]));
            const iris_vec2 left = {whole(pixels[0][0]), whole(pixels[0][1])};
            iris_vec2 right = {whole(pixels[1][0]), whole(pixels[1][1])};
            iris_line2 line;
            iris_q32 miss;
            assert_int_equal(iris_epipolar_line(&line, &pair[0], &pair[1], left), IRIS_OK);
            assert_true(fabs(hypot(real(line.a), real(line.b)) - 1) < 1e-9);
            of_line =
                fmax(of_line, fabs(real(line.a) * planes[1][0] + real(line.b) * planes[1][1] + real(line.c)));
            assert_int_equal(iris_epipolar_miss(&miss, &pair[0], &pair[1], left, right), IRIS_OK);
            of_miss = fmax(of_miss, real(miss));
            /* three pixels across the line, without the lens */
            const double alpha = real(pair[1].intrinsics.alpha_u) / 2 + real(pair[1].intrinsics.alpha_v) / 2;
            const double aside[2] = {planes[1][0] + 3 / alpha * real(line.a),
                                     planes[1][1] + 3 / alpha * real(line.b)};
            double seen[2], pixel[2];
            double_bend(seen, &pair[1].lens, aside);
            double_pixel(pixel, &pair[1].intrinsics, seen);
            right = (iris_vec2){whole(pixel[0]), whole(pixel[1])};
            assert_int_equal(iris_epipolar_miss(&miss, &pair[0], &pair[1], left, right), IRIS_OK);
            of_shift = fmax(of_shift, fabs(real(miss) - 3));
        }
    }
    printf("#: E %.1e, F %.1e px, lines %.1e, misses %.1e and %.1e px\n", of_e, of_f, of_line, of_miss,
           of_shift);
    assert_true(of_e > 0 && of_e < 8e-9 && of_f < 1e-4 && of_line < 1e-7 && of_miss < 1e-3 &&
                of_shift < 1e-3);
}

/* By hand: side by side, without turns, rows are the lines, and E is known. */
static void side_by_side(void **state)
{
    (void)state;
    iris_sensor pair[2] = {{.intrinsics = {whole(500), whole(400), 0, whole(320), whole(240)}}};
    iris_mat3 e, f;
    iris_line2 line;
    iris_q32 miss;
    iris_mat3_identity(&pair[0].pose.turn);
    pair[1] = pair[0];
    pair[1].pose.place.x = whole(0.25);
    assert_int_equal(iris_epipolar_essential(&e, &pair[0].pose, &pair[1].pose), IRIS_OK);
    const iris_mat3 wanted = {{0, 0, 0, 0, 0, IRIS_Q32_ONE, 0, -IRIS_Q32_ONE, 0}}; /* t = (-1, 0, 0) */
    assert_memory_equal(&e, &wanted, sizeof e);
    /* y' - y = 0: the numbers of y and y' are 1 / 400, that of 1 is 0 */
    assert_int_equal(iris_epipolar_fundamental(&f, &pair[0], &pair[1]), IRIS_OK);
    for (int i = 0; i < 9; i++) {
        assert_true((f.m[i] != 0) == (i == 5 || i == 7));
    }
    assert_int_equal(f.m[5], -f.m[7]);
    assert_true(f.m[5] >= whole(16777216.0) && f.m[5] < whole(33554432.0));
    const iris_vec2 left = {whole(100), whole(340)};
    assert_int_equal(iris_epipolar_line(&line, &pair[0], &pair[1], left), IRIS_OK);
    assert_int_equal(line.a, 0);
    assert_true(fabs(real(line.b)) == 1 && fabs(real(line.c) / real(line.b) + 0.25) < 1e-9);
    assert_int_equal(iris_epipolar_miss(&miss, &pair[0], &pair[1], left, (iris_vec2){whole(-50), whole(360)}),
                     IRIS_OK);
    assert_true(fabs(real(miss) - 20 / 400.0 * 450) < 1e-4);
    assert_int_equal(iris_line2_distance(&line, (iris_vec2){whole(7), 0}), line.c);
}

static void refusals(void **state)
{
    (void)state;
    iris_sensor pair[2];
    iris_mat3 e, f, before;
    iris_line2 line = {1, 2, 3};
    iris_q32 miss = 5;
    const iris_vec2 pixel = {whole(300), whole(200)};
    random_pair(pair, 1, 0.2, size[0], size[1]);
    memset(&e, 7, sizeof e);
    memset(&f, 7, sizeof f);
    before = e;
    iris_sensor same = pair[1];
    same.pose.place = pair[0].pose.place;
    assert_int_equal(iris_epipolar_essential(&e, &pair[0].pose, &same.pose), IRIS_ERR_RANGE);
    assert_int_equal(iris_epipolar_fundamental(&f, &pair[0], &same), IRIS_ERR_RANGE);
    assert_int_equal(iris_epipolar_line(&line, &pair[0], &same, pixel), IRIS_ERR_RANGE);
    assert_int_equal(iris_epipolar_miss(&miss, &pair[0], &same, pixel, pixel), IRIS_ERR_RANGE);
    iris_sensor flat = pair[1];
    flat.intrinsics.alpha_v = 0;
    assert_int_equal(iris_epipolar_fundamental(&f, &pair[0], &flat), IRIS_ERR_RANGE);
    assert_int_equal(iris_epipolar_miss(&miss, &pair[0], &flat, pixel, pixel), IRIS_ERR_RANGE);
    flat.intrinsics.alpha_v = whole(20000);
    assert_int_equal(iris_epipolar_fundamental(&f, &flat, &pair[1]), IRIS_ERR_RANGE);
    assert_memory_equal(&e, &before, sizeof e);
    assert_memory_equal(&f, &before, sizeof f);
    /* the left pixel sees the right camera: one stands before the other */
    iris_line3 ray;
    assert_int_equal(iris_sensor_ray(&ray, &pair[0], pixel), IRIS_OK);
    iris_sensor ahead = pair[1];
    ahead.pose.place = iris_line3_point(&ray, whole(3));
    assert_int_equal(iris_epipolar_line(&line, &pair[0], &ahead, pixel), IRIS_ERR_RANGE);
    /* the plane of the ray and the baseline is the right camera's picture plane */
    iris_sensor plain = {.intrinsics = pair[0].intrinsics};
    plain.intrinsics.shear = 0;
    iris_mat3_identity(&plain.pose.turn);
    iris_sensor down = plain;
    down.pose.place.x = whole(1);
    down.pose.turn = (iris_mat3){{IRIS_Q32_ONE, 0, 0, 0, 0, -IRIS_Q32_ONE, 0, IRIS_Q32_ONE, 0}};
    const iris_vec2 center = {plain.intrinsics.u0, plain.intrinsics.v0};
    assert_int_equal(iris_epipolar_line(&line, &plain, &down, center), IRIS_ERR_RANGE);
    assert_true(line.a == 1 && line.b == 2 && line.c == 3 && miss == 5);
}

static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        iris_sensor pair[2];
        iris_mat3 m;
        iris_line2 line;
        iris_q32 miss;
        random_pair(pair, 1, 0.5, size[0], size[1]);
        for (int k = 0; k < 3; k++) {
            spoil(&pair[k % 2]);
        }
        (void)iris_epipolar_essential(&m, &pair[0].pose, &pair[1].pose);
        (void)iris_epipolar_fundamental(&m, &pair[0], &pair[1]);
        (void)iris_epipolar_fundamental(&m, &pair[1], &pair[0]);
        (void)iris_epipolar_line(&line, &pair[i % 2], &pair[1 - i % 2], (iris_vec2){any_q32(), any_q32()});
        (void)iris_epipolar_miss(&miss, &pair[i % 2], &pair[1 - i % 2], (iris_vec2){any_q32(), any_q32()},
                                 (iris_vec2){any_q32(), any_q32()});
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_of_both_pictures),
        cmocka_unit_test(side_by_side),
        cmocka_unit_test(refusals),
        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
