/* The camera against the same model in double precision, on random cameras and points; and what is known of some. */
#include "iris/3d/camera.h"

#include <stdio.h>

#include "double_camera.h"
#include "test.h"

static const double unit = 1 / 4294967296.0;

/* The model as camera.h states it. */
static void bend(double q[2], const iris_lens *lens, const double p[2])
{
    double x = p[0] - real(lens->center.x), y = p[1] - real(lens->center.y), r2 = x * x + y * y;
    double radial = r2 * (real(lens->k1) + r2 * (real(lens->k2) + r2 * real(lens->k3)));
    double p1 = real(lens->p1), p2 = real(lens->p2);
    q[0] = p[0] + x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
    q[1] = p[1] + y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
}

/* Returns the depth. */
static double project(double pixel[2], const iris_sensor *s, iris_vec3 world)
{
    double from[3] = {real(world.x) - real(s->pose.place.x), real(world.y) - real(s->pose.place.y),
                      real(world.z) - real(s->pose.place.z)};
    double to[3], q[2];
    for (int i = 0; i < 3; i++) {
        to[i] = 0;
        for (int k = 0; k < 3; k++) {
            to[i] += real(s->pose.turn.m[3 * i + k]) * from[k];
        }
    }
    double p[2] = {to[0] / to[2], to[1] / to[2]};
    bend(q, &s->lens, p);
    pixel[0] = real(s->intrinsics.alpha_u) * q[0] + real(s->intrinsics.shear) * q[1] + real(s->intrinsics.u0);
    pixel[1] = real(s->intrinsics.alpha_v) * q[1] + real(s->intrinsics.v0);
    return to[2];
}

static iris_sensor random_sensor(int with_lens)
{
    const iris_q32 one = IRIS_Q32_ONE;
    iris_sensor s = {.pose = {.place = random_vec3(1000 * one)}};
    s.intrinsics = (iris_intrinsics){random_q32(2000 * one) + 2100 * one, random_q32(2000 * one) + 2100 * one,
                                     random_q32(10 * one), random_q32(500 * one) + 500 * one,
                                     random_q32(500 * one) + 500 * one};
    random_rotation(&s.pose.turn);
    if (with_lens) {
        s.lens = (iris_lens){random_q32(one / 4),   random_q32(one / 16),
                             random_q32(one / 64),  random_q32(one / 128),
                             random_q32(one / 128), {random_q32(one / 64), random_q32(one / 64)},
                             IRIS_LENS_BENDS};
    }
    return s;
}

/* A point in front of the camera, within half a focal length of its axis. */
static iris_vec3 random_point(const iris_sensor *s)
{
    iris_q32 z = random_q32(50 * IRIS_Q32_ONE) + 51 * IRIS_Q32_ONE;
    iris_vec3 at = {random_q32(z / 2), random_q32(z / 2), z};
    return iris_pose_out_of(&s->pose, at);
}

static void projections(void **state)
{
    (void)state;
    double worst = 0, bent = 0;
    for (int i = 0; i < 200000; i++) {
        iris_sensor s = random_sensor(i % 2);
        iris_vec3 world = random_point(&s);
        iris_vec2 pixel;
        iris_q32 depth;
        double truth[2], z = project(truth, &s, world);
        assert_int_equal(iris_sensor_project(&pixel, &depth, &s, world), IRIS_OK);
        double off = fmax(fabs(real(pixel.x) - truth[0]), fabs(real(pixel.y) - truth[1]));
        double alpha = fmax(real(s.intrinsics.alpha_u), real(s.intrinsics.alpha_v));
        double share = off / (alpha * (1 / z + 1) * unit * 4);
        worst = fmax(worst, i % 2 ? 0 : share);
        bent = fmax(bent, i % 2 ? share : 0);
        assert_true(fabs(real(depth) - z) <= 4 * unit);
    }
    printf("#: projection: %.2f of the bound, through a lens %.2f\n", worst, bent);
    assert_true(worst <= 1 && bent <= 4);
}

static void rays_go_through_their_points(void **state)
{
    (void)state;
    double worst = 0;
    for (int i = 0; i < 30000; i++) {
        iris_sensor s = random_sensor(i % 2);
        iris_vec3 world = random_point(&s);
        iris_vec2 pixel;
        iris_line3 ray;
        iris_q32 depth;
        assert_int_equal(iris_sensor_project(&pixel, &depth, &s, world), IRIS_OK);
        assert_int_equal(iris_sensor_ray(&ray, &s, pixel), IRIS_OK);
        worst = fmax(worst, real(iris_line3_distance(&ray, world)) / real(depth));
    }
    printf("#: rays: at most %.1e of the depth beside their points\n", worst);
    assert_true(worst <= 1.0 / 67108864);
}

static void lenses_both_ways(void **state)
{
    (void)state;
    double worst = 0;
    for (int i = 0; i < 30000; i++) {
        iris_sensor s = random_sensor(1);
        iris_vec2 p = {random_q32(IRIS_Q32_ONE / 2), random_q32(IRIS_Q32_ONE / 2)}, q, back;
        s.lens.direction = i % 2 ? IRIS_LENS_CORRECTS : IRIS_LENS_BENDS;
        if (i % 2) { /* the polynomial is the straightening */
            double to[2], from[2] = {real(p.x), real(p.y)};
            assert_int_equal(iris_lens_straighten(&q, &s.lens, p), IRIS_OK);
            bend(to, &s.lens, from);
            assert_true(fabs(real(q.x) - to[0]) <= 16 * unit && fabs(real(q.y) - to[1]) <= 16 * unit);
            back = iris_lens_bend(&s.lens, q);
        } else {
            q = iris_lens_bend(&s.lens, p);
            assert_int_equal(iris_lens_straighten(&back, &s.lens, q), IRIS_OK);
        }
        worst = fmax(worst, fmax(fabs(real(back.x) - real(p.x)), fabs(real(back.y) - real(p.y))));
    }
    printf("#: lens and back: at most %.0f units\n", worst / unit);
    assert_true(worst <= 64 * unit);
}

/* The report's equation 2.18: u = u~ (1 + k1 (u~^2 + v~^2)). */
static void barrel_and_pillow(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    iris_lens barrel = {.k1 = one / 4, .direction = IRIS_LENS_CORRECTS};
    iris_vec2 straight, seen;
    assert_int_equal(iris_lens_straighten(&straight, &barrel, (iris_vec2){one / 2, 0}), IRIS_OK);
    assert_true(straight.x == one / 2 + one / 32 && straight.y == 0); /* a barrel had drawn it inwards */
    seen = iris_lens_bend(&barrel, straight);
    assert_true(llabs(seen.x - one / 2) <= 16 && seen.y == 0);
    iris_lens pillow = {.k1 = -one / 4, .direction = IRIS_LENS_CORRECTS};
    assert_int_equal(iris_lens_straighten(&straight, &pillow, (iris_vec2){0, one / 2}), IRIS_OK);
    assert_true(straight.y == one / 2 - one / 32 && straight.x == 0);
}

/* 1 - r^2 turns back at r = 0.577, where it shows 0.385: nothing is seen farther out. */
static void where_the_polynomial_turns_back(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    iris_lens lens = {.k1 = -one};
    iris_vec2 straight;
    assert_int_equal(iris_lens_straighten(&straight, &lens, (iris_vec2){one * 3 / 8, 0}), IRIS_OK);
    assert_true(straight.x > one / 2 && straight.x < one * 577 / 1000);
    assert_int_equal(iris_lens_straighten(&straight, &lens, (iris_vec2){one * 2 / 5, 0}), IRIS_ERR_RANGE);
    assert_int_equal(iris_lens_straighten(&straight, &lens, (iris_vec2){0, -one}), IRIS_ERR_RANGE);
}

/* The first r at which r (1 + k1 r^2 + k2 r^4 + k3 r^6) grows no more, by going outwards; 99: none up to 12. */
static double fold_of(const iris_lens *l)
{
    for (double r = 0; r < 12; r += 1.0 / 8192) {
        const double s = r * r;
        if (1 + s * (3 * real(l->k1) + s * (5 * real(l->k2) + s * 7 * real(l->k3))) <= 0) {
            return r;
        }
    }
    return 99;
}

/* A ray at r from the axis, in any direction: is it in the picture? */
static int is_projected(const iris_sensor *s, double r, double angle)
{
    const double x = r * cos(angle), y = r * sin(angle);
    iris_vec2 pixel;
    return iris_sensor_project(&pixel, NULL, s, (iris_vec3){whole(x), whole(y), IRIS_Q32_ONE}) == IRIS_OK;
}

/* In every combination of signs: seen up to the fold, and nowhere beyond, also where the polynomial grows again. */
static void nothing_is_seen_behind_the_fold(void **state)
{
    (void)state;
    int folds = 0, ends = 0;
    for (int i = 0; i < 300; i++) {
        iris_sensor s = {.intrinsics = {300 * IRIS_Q32_ONE, 300 * IRIS_Q32_ONE, 0, 0, 0}};
        iris_mat3_identity(&s.pose.turn);
        s.lens.k1 = i == 0 ? whole(-0.3) : whole(between(-1, 0.3));
        s.lens.k2 = i % 3 ? whole(between(-0.3, 0.6)) : 0;
        s.lens.k3 = i % 3 > 1 ? whole(between(-0.15, 0.15)) : 0;
        const double fold = fold_of(&s.lens);
        for (double r = 0.01; r < 7; r += 0.03) {
            if (fabs(r - fold) > 0.001) {
                assert_int_equal(is_projected(&s, r, between(0, 6.2831853)), r < fold);
            }
        }
        folds += fold < 7;
        ends += fold > 7;
    }
    printf("#: %d polynomials turn back, %d do not\n", folds, ends);
    assert_true(folds > 100 && ends > 20);
}

/* The other direction: the pixel beyond the fold has no ray, and a ray beyond what the fold shows has no pixel. */
static void nor_where_the_lens_corrects(void **state)
{
    (void)state;
    iris_sensor s = {.intrinsics = {IRIS_Q32_ONE, IRIS_Q32_ONE, 0, 0, 0},
                     .lens = {.k1 = whole(-0.3), .direction = IRIS_LENS_CORRECTS}};
    iris_mat3_identity(&s.pose.turn);
    iris_vec2 straight;
    const double fold = sqrt(1 / 0.9), farthest = fold * 2 / 3;
    assert_int_equal(iris_lens_straighten(&straight, &s.lens, (iris_vec2){whole(fold - 0.001), 0}), IRIS_OK);
    assert_int_equal(iris_lens_straighten(&straight, &s.lens, (iris_vec2){whole(fold + 0.001), 0}),
                     IRIS_ERR_RANGE);
    assert_true(is_projected(&s, farthest - 0.01, 1) && !is_projected(&s, farthest + 0.01, 1));
}

static void matrices_both_ways(void **state)
{
    (void)state;
    double angle = 0, focal = 0, place = 0;
    for (int i = 0; i < 5000; i++) {
        iris_sensor s = random_sensor(0), found;
        iris_q32 m[12];
        s.pose.place = random_vec3(20 * IRIS_Q32_ONE);
        iris_sensor_matrix(m, &s);
        for (int k = 0; k < 12 && i % 3; k++) { /* any scale, either sign */
            m[k] = i % 3 == 1 ? -m[k] / 8 : 5 * m[k];
        }
        assert_int_equal(iris_sensor_decompose(&found, m), IRIS_OK);
        for (int k = 0; k < 9; k++) {
            angle = fmax(angle, fabs(real(found.pose.turn.m[k]) - real(s.pose.turn.m[k])));
        }
        focal = fmax(focal, fabs(real(found.intrinsics.alpha_u) - real(s.intrinsics.alpha_u)));
        focal = fmax(focal, fabs(real(found.intrinsics.alpha_v) - real(s.intrinsics.alpha_v)));
        focal = fmax(focal, fabs(real(found.intrinsics.u0) - real(s.intrinsics.u0)));
        focal = fmax(focal, fabs(real(found.intrinsics.v0) - real(s.intrinsics.v0)));
        focal = fmax(focal, fabs(real(found.intrinsics.shear) - real(s.intrinsics.shear)));
        place = fmax(place, fabs(real(found.pose.place.x) - real(s.pose.place.x)));
        place = fmax(place, fabs(real(found.pose.place.z) - real(s.pose.place.z)));
    }
    printf("#: matrix and back: rotation %.1e, pixels %.1e, place %.1e\n", angle, focal, place);
    assert_true(angle < 1e-7 && focal < 1e-4 && place < 1e-5);
}

static void by_hand(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    iris_sensor s = {.intrinsics = {100 * one, 200 * one, 0, 32 * one, 24 * one}};
    iris_vec2 pixel = {7, 7};
    iris_q32 m[12] = {0}, depth = 7;
    iris_mat3_identity(&s.pose.turn);
    s.pose.place = (iris_vec3){0, 0, -2 * one};
    assert_int_equal(iris_sensor_project(&pixel, &depth, &s, (iris_vec3){one, -one, 2 * one}), IRIS_OK);
    assert_true(pixel.x == 57 * one && pixel.y == -26 * one && depth == 4 * one);
    assert_int_equal(iris_sensor_project(&pixel, &depth, &s, (iris_vec3){0, 0, -2 * one}), IRIS_ERR_RANGE);
    assert_int_equal(iris_sensor_project(&pixel, NULL, &s, (iris_vec3){0, 0, -3 * one}), IRIS_ERR_RANGE);
    assert_int_equal(iris_sensor_project(&pixel, NULL, &s, (iris_vec3){9 * one, 0, -one}), IRIS_ERR_RANGE);
    assert_true(pixel.x == 57 * one && depth == 4 * one);
    assert_int_equal(iris_sensor_decompose(&s, m), IRIS_ERR_RANGE);
    m[0] = m[5] = one; /* of rank 2 */
    m[10] = 0;
    assert_int_equal(iris_sensor_decompose(&s, m), IRIS_ERR_RANGE);
    s.intrinsics.alpha_v = 0;
    iris_line3 ray;
    assert_int_equal(iris_sensor_ray(&ray, &s, pixel), IRIS_ERR_RANGE);
}

static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        iris_sensor s, made;
        iris_q32 m[12];
        iris_q32 *numbers[] = {&s.intrinsics.alpha_u,
                               &s.intrinsics.alpha_v,
                               &s.intrinsics.shear,
                               &s.intrinsics.u0,
                               &s.intrinsics.v0,
                               &s.lens.k1,
                               &s.lens.k2,
                               &s.lens.k3,
                               &s.lens.p1,
                               &s.lens.p2,
                               &s.lens.center.x,
                               &s.lens.center.y,
                               &s.pose.place.x,
                               &s.pose.place.y,
                               &s.pose.place.z};
        for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
            *numbers[k] = any_q32();
        }
        for (int k = 0; k < 9; k++) {
            s.pose.turn.m[k] = any_q32();
        }
        s.lens.direction = i % 2 ? IRIS_LENS_CORRECTS : IRIS_LENS_BENDS;
        iris_vec2 pixel = {any_q32(), any_q32()};
        iris_line3 ray;
        iris_q32 depth;
        (void)iris_sensor_ray(&ray, &s, pixel);
        (void)iris_sensor_project(&pixel, &depth, &s, (iris_vec3){any_q32(), any_q32(), any_q32()});
        iris_sensor_matrix(m, &s);
        (void)iris_sensor_decompose(&made, m);
        for (int k = 0; k < 12; k++) {
            m[k] = any_q32();
        }
        (void)iris_sensor_decompose(&made, m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(projections),
        cmocka_unit_test(rays_go_through_their_points),
        cmocka_unit_test(lenses_both_ways),
        cmocka_unit_test(barrel_and_pillow),
        cmocka_unit_test(where_the_polynomial_turns_back),
        cmocka_unit_test(nothing_is_seen_behind_the_fold),
        cmocka_unit_test(nor_where_the_lens_corrects),
        cmocka_unit_test(matrices_both_ways),
        cmocka_unit_test(by_hand),
        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
