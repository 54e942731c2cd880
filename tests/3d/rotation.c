/* Rotations against double precision, and from one form into the other. */
#include "iris/3d/rotation.h"

#include <stdio.h>

#include "random3d.h"
#include "test.h"

static int64_t difference(const iris_mat3 *a, const iris_mat3 *b)
{
    int64_t most = 0;
    for (int i = 0; i < 9; i++) {
        int64_t off = llabs(a->m[i] - b->m[i]);
        most = off > most ? off : most;
    }
    return most;
}

static void about_an_axis(void **state)
{
    (void)state;
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
        iris_vec3 axis = random_direction();
        iris_q32 angle = random_q32(2 * IRIS_PI_Q32);
        iris_mat3 r;
        iris_rotation_about(&r, axis, angle);
        double a[3] = {real(axis.x), real(axis.y), real(axis.z)}, s = sin(real(angle)), c = cos(real(angle));
        for (int k = 0; k < 9; k++) {
            int row = k / 3, column = k % 3;
            double turned =
                row == column ? c : (column == (row + 1) % 3 ? -s : s) * a[(6 - row - column) % 3];
            worst = fmax(worst, fabs(real(r.m[k]) - (turned + (1 - c) * a[row] * a[column])));
        }
    }
    printf("#: rotation about an axis: at most %.2f units off\n", worst * 4294967296.0);
    assert_true(worst <= 2.5 / 4294967296.0);
}

static void there_and_back(void **state)
{
    (void)state;
    int64_t vectors = 0, quaternions = 0, angles = 0;
    for (int i = 0; i < 20000; i++) {
        iris_mat3 r, back;
        /* every kind of angle: any, tiny, and nearly a half turn */
        iris_q32 turn = i % 3 == 0   ? random_q32(IRIS_PI_Q32)
                        : i % 3 == 1 ? random_q32(1 << 20)
                                     : IRIS_PI_Q32 - random_q32(1 << 20);
        iris_rotation_about(&r, random_direction(), turn);
        iris_rotation_from_vector(&back, iris_rotation_to_vector(&r));
        int64_t off = difference(&r, &back);
        vectors = off > vectors ? off : vectors;
        iris_rotation_from_quaternion(&back, iris_rotation_to_quaternion(&r));
        off = difference(&r, &back);
        quaternions = off > quaternions ? off : quaternions;
        iris_rotation_from_angles(&back, iris_rotation_to_angles(&r));
        off = difference(&r, &back);
        angles = off > angles ? off : angles;
    }
    printf("#: there and back: by vector %d, by quaternion %d, by angles %d units\n", (int)vectors,
           (int)quaternions, (int)angles);
    assert_true(vectors <= 16 && quaternions <= 16 && angles <= 4096);
}

static void elementary(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE, quarter = IRIS_PI_Q32 / 2;
    iris_mat3 r;
    iris_rotation_from_angles(&r, (iris_angles){quarter, 0, 0}); /* pan: y goes to z */
    iris_vec3 v = iris_mat3_vector(&r, (iris_vec3){0, one, 0});
    assert_true(llabs(v.x) < 8 && llabs(v.y) < 8 && llabs(v.z - one) < 8);
    iris_rotation_from_angles(&r, (iris_angles){0, quarter, 0}); /* tilt: z goes to x */
    v = iris_mat3_vector(&r, (iris_vec3){0, 0, one});
    assert_true(llabs(v.x - one) < 8 && llabs(v.y) < 8 && llabs(v.z) < 8);
    iris_rotation_from_angles(&r, (iris_angles){quarter, quarter, 0}); /* pan first: y to z, then z to x */
    v = iris_mat3_vector(&r, (iris_vec3){0, one, 0});
    assert_true(llabs(v.x - one) < 8 && llabs(v.y) < 8 && llabs(v.z) < 8);
    iris_angles locked = iris_rotation_to_angles(&r);
    assert_true(locked.pan == 0 && llabs(locked.tilt - quarter) < 8);
    iris_quaternion q = {0, 0, 0, 0};
    iris_rotation_from_quaternion(&r, q);
    assert_true(r.m[0] == one && r.m[4] == one && r.m[8] == one && r.m[1] == 0);
    q = (iris_quaternion){one, 0, 0, one}; /* not of length 1: a quarter turn from x to y */
    iris_rotation_from_quaternion(&r, q);
    assert_true(llabs(r.m[3] - one) < 8 && llabs(r.m[0]) < 8);
    iris_rotation_from_vector(&r, (iris_vec3){0, 0, 0});
    assert_true(r.m[0] == one && r.m[4] == one && r.m[8] == one && r.m[1] == 0);
}

static void drift(void **state)
{
    (void)state;
    iris_mat3 r, step, tidy;
    random_rotation(&step);
    iris_mat3_identity(&r);
    for (int i = 0; i < 100000; i++) {
        iris_mat3_multiply(&r, &r, &step);
    }
    r.m[1] += 1 << 22; /* and worse: 0.001 */
    tidy = r;
    assert_int_equal(iris_rotation_tidy(&tidy), IRIS_OK);
    assert_true(difference(&tidy, &r) < 1 << 23);
    iris_mat3 transposed, product, identity;
    iris_mat3_transpose(&transposed, &tidy);
    iris_mat3_multiply(&product, &tidy, &transposed);
    iris_mat3_identity(&identity);
    assert_true(difference(&product, &identity) <= 8);
    r = identity;
    r.m[8] = -IRIS_Q32_ONE; /* a mirror */
    assert_int_equal(iris_rotation_tidy(&r), IRIS_ERR_RANGE);
}

static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        iris_mat3 r;
        for (int k = 0; k < 9; k++) {
            r.m[k] = any_q32();
        }
        iris_vec3 v = iris_rotation_to_vector(&r);
        iris_quaternion q = {any_q32(), any_q32(), any_q32(), any_q32()};
        iris_angles angles = iris_rotation_to_angles(&r);
        iris_rotation_from_angles(&r, angles);
        iris_rotation_from_quaternion(&r, q);
        iris_rotation_from_vector(&r, v);
        iris_rotation_about(&r, (iris_vec3){any_q32(), any_q32(), any_q32()}, any_q32());
        (void)iris_rotation_tidy(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(about_an_axis), cmocka_unit_test(there_and_back), cmocka_unit_test(elementary),
        cmocka_unit_test(drift),         cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
