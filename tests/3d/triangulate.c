/* Triangulation against points that are known. */
#include "iris/3d/triangulate.h"

#include <stdio.h>
#include <string.h>

#include "double_camera.h"
#include "test.h"

enum { RAYS = 6 };

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* From a place within 1 of (0, 0, 0) to the point. */
static void ray_to(iris_line3 *ray, const double point[3])
{
    double d[3];
    ray->origin = random_vec3(IRIS_Q32_ONE);
    const iris_q32 from[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    for (int i = 0; i < 3; i++) {
        d[i] = point[i] - real(from[i]);
    }
    const double l = length(d);
    ray->direction = (iris_vec3){whole(d[0] / l), whole(d[1] / l), whole(d[2] / l)};
}

/* The largest sine between two directions. */
static double sine_of(const iris_line3 *rays, int count)
{
    double most = 0;
    for (int a = 0; a < count; a++) {
        for (int b = 0; b < a; b++) {
            const iris_vec3 p = rays[a].direction, q = rays[b].direction;
            const double c[3] = {real(p.y) * real(q.z) - real(p.z) * real(q.y),
                                 real(p.z) * real(q.x) - real(p.x) * real(q.z),
                                 real(p.x) * real(q.y) - real(p.y) * real(q.x)};
            most = fmax(most, length(c));
        }
    }
    return most;
}

static double off(iris_vec3 p, const double point[3])
{
    const double d[3] = {real(p.x) - point[0], real(p.y) - point[1], real(p.z) - point[2]};
    return length(d);
}

static void rays_that_meet(void **state)
{
    (void)state;
    double worst = 0;
    int far = 0;
    for (int round = 0; round < 4000; round++) {
        const int count = 2 + round % (RAYS - 1);
        const double away = exp(between(log(0.5), log(300)));
        const iris_vec3 to = random_direction();
        const double point[3] = {away * real(to.x), away * real(to.y), away * real(to.z)};
        iris_line3 rays[RAYS];
        iris_triangulation made;
        for (int i = 0; i < count; i++) {
            ray_to(&rays[i], point);
        }
        const double sine = sine_of(rays, count);
        const iris_status status = iris_triangulate(&made, rays, count);
        if (sine < 1e-4) {
            continue;
        }
        assert_int_equal(status, IRIS_OK);
        assert_int_equal(made.flawed, -1);
        far += away > 100;
        worst = fmax(worst, off(made.point, point) * sine / (away + 1));
        assert_true(real(made.off) <= off(made.point, point) + 1e-6);
    }
    printf("#: points off by %.1e of their distance over the sine\n", worst);
    assert_true(far > 100 && worst > 0 && worst < 1 / 268435456.0);
}

/* Two rays: the middle between them, and half of the gap; the lines' own function says the same. */
static void rays_that_miss(void **state)
{
    (void)state;
    for (int round = 0; round < 300; round++) {
        const double point[3] = {between(-2, 2), between(-2, 2), between(3, 9)};
        iris_line3 rays[2];
        iris_triangulation made;
        iris_vec3 middle;
        iris_q32 gap;
        for (int i = 0; i < 2; i++) {
            const double beside[3] = {point[0] + between(-0.02, 0.02), point[1] + between(-0.02, 0.02),
                                      point[2]};
            ray_to(&rays[i], beside);
        }
        if (sine_of(rays, 2) < 0.02) {
            continue;
        }
        assert_int_equal(iris_triangulate(&made, rays, 2), IRIS_OK);
        assert_int_equal(iris_line3_meet(&middle, &gap, &rays[0], &rays[1]), IRIS_OK);
        assert_true(real(iris_vec3_length(iris_vec3_sub(made.point, middle))) < 1e-5);
        assert_true(fabs(real(made.off) - real(gap) / 2) < 1e-6);
    }
}

static double squares(iris_vec3 p, const iris_line3 *rays, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        sum += pow(real(iris_line3_distance(&rays[i], p)), 2);
    }
    return sum;
}

/* Of many rays the sum of squared distances is least: anywhere else it is more. */
static void least_squares(void **state)
{
    (void)state;
    for (int round = 0; round < 200; round++) {
        iris_line3 rays[RAYS];
        iris_triangulation made;
        for (int i = 0; i < RAYS; i++) {
            ray_to(&rays[i], (const double[3]){between(-0.1, 0.1), between(-0.1, 0.1), between(4, 4.2)});
        }
        assert_int_equal(iris_triangulate(&made, rays, RAYS), IRIS_OK);
        const double least = squares(made.point, rays, RAYS);
        double most = 0;
        for (int i = 0; i < RAYS; i++) {
            most = fmax(most, real(iris_line3_distance(&rays[i], made.point)));
        }
        assert_true(fabs(most - real(made.off)) < 1e-8);
        for (int i = 0; i < 6; i++) {
            iris_vec3 other = made.point;
            iris_q32 *numbers[] = {&other.x, &other.y, &other.z};
            *numbers[i / 2] += i % 2 ? IRIS_Q32_ONE / 1024 : -IRIS_Q32_ONE / 1024;
            assert_true(squares(other, rays, RAYS) > least);
        }
    }
}

static void refused(void **state)
{
    (void)state;
    iris_triangulation made;
    const iris_q32 one = IRIS_Q32_ONE;
    iris_line3 rays[3] = {{{0, 0, 0}, {0, 0, one}}, {{one, 0, 0}, {0, 0, one}}, {{0, one, 0}, {0, 0, -one}}};
    assert_int_equal(iris_triangulate(&made, rays, 3), IRIS_ERR_DATA);
    assert_int_equal(made.flaw, IRIS_TRIANGULATION_PARALLEL);
    assert_int_equal(made.flawed, -1);
    rays[1].origin = rays[2].origin = rays[0].origin;
    rays[1].direction = (iris_vec3){whole(0.6), 0, whole(0.8)};
    assert_int_equal(iris_triangulate(&made, rays, 2), IRIS_ERR_DATA);
    assert_int_equal(made.flaw, IRIS_TRIANGULATION_ONE_PLACE);
    rays[1].origin.x = whole(3); /* away from each other: they meet behind both, at z = -4 */
    assert_int_equal(iris_triangulate(&made, rays, 2), IRIS_ERR_DATA);
    assert_int_equal(made.flaw, IRIS_TRIANGULATION_BEHIND);
    assert_int_equal(made.flawed, 0);
    rays[0].direction.z = -one; /* the first one goes there */
    assert_int_equal(iris_triangulate(&made, rays, 2), IRIS_ERR_DATA);
    assert_int_equal(made.flawed, 1);
    rays[0].direction.z = one;
    rays[1].direction.x = whole(-0.6);
    assert_int_equal(iris_triangulate(&made, rays, 2), IRIS_OK);
    assert_true(off(made.point, (const double[3]){0, 0, 4}) < 1e-8 && made.off < 16);
    const iris_triangulation before = made;
    assert_int_equal(iris_triangulate(&made, rays, 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_triangulate(&made, rays, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_triangulate(NULL, rays, 2), IRIS_ERR_ARG);
    assert_int_equal(iris_triangulate(&made, NULL, 2), IRIS_ERR_ARG);
    rays[1].direction.x = whole(-0.7);
    assert_int_equal(iris_triangulate(&made, rays, 2), IRIS_ERR_RANGE);
    rays[1].direction = rays[0].direction;
    rays[1].origin.y = ((iris_q32)1 << 60) + 1;
    assert_int_equal(iris_triangulate(&made, rays, 2), IRIS_ERR_RANGE);
    assert_memory_equal(&made, &before, sizeof made);
}

static void any_numbers(void **state)
{
    (void)state;
    for (int round = 0; round < 3000; round++) {
        iris_line3 rays[3];
        iris_triangulation made;
        for (int i = 0; i < 3; i++) {
            rays[i].direction =
                round % 16 ? random_direction() : (iris_vec3){any_q32(), any_q32(), any_q32()};
            rays[i].origin = (iris_vec3){any_q32() / 8, any_q32() / 8, any_q32() / 8};
        }
        (void)iris_triangulate(&made, rays, 2 + round % 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_that_meet), cmocka_unit_test(rays_that_miss), cmocka_unit_test(least_squares),
        cmocka_unit_test(refused),        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
