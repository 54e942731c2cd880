/* Matrices against double precision. */
#include "iris/3d/matrix.h"

#include <stdio.h>

#include "random3d.h"
#include "test.h"

static double largest(const iris_q32 *m, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++) {
        most = fmax(most, fabs(real(m[i])));
    }
    return most;
}

static void products(void **state)
{
    (void)state;
    for (int i = 0; i < 5000; i++) {
        iris_mat4 a, b, c;
        for (int k = 0; k < 16; k++) {
            a.m[k] = random_q32(16 * IRIS_Q32_ONE);
            b.m[k] = random_q32(16 * IRIS_Q32_ONE);
        }
        iris_mat4_multiply(&c, &a, &b);
        for (int k = 0; k < 16; k++) {
            double sum = 0;
            for (int l = 0; l < 4; l++) {
                sum += real(a.m[k / 4 * 4 + l]) * real(b.m[4 * l + k % 4]);
            }
            assert_true(fabs(real(c.m[k]) - sum) <= 0.51 / 4294967296.0 + 1e-13);
        }
        iris_mat4_multiply(&a, &a, &b);
        assert_memory_equal(&a, &c, sizeof c);
    }
}

/* The inverse in double precision by Gauss and Jordan, with pivots. Returns the least pivot. */
static double invert(double inverse[4][4], const iris_mat4 *m)
{
    double a[4][8] = {{0}}, least = 1e300;
    for (int i = 0; i < 16; i++) {
        a[i / 4][i % 4] = real(m->m[i]);
        a[i / 4][4 + i / 4] = 1;
    }
    for (int k = 0; k < 4; k++) {
        int best = k;
        for (int i = k; i < 4; i++) {
            best = fabs(a[i][k]) > fabs(a[best][k]) ? i : best;
        }
        least = fmin(least, fabs(a[best][k]));
        for (int j = 0; j < 8; j++) {
            double swap = a[k][j];
            a[k][j] = a[best][j];
            a[best][j] = swap;
        }
        for (int j = 7; j >= k; j--) {
            a[k][j] /= a[k][k];
        }
        for (int i = 0; i < 4; i++) {
            for (int j = 7; j >= k && i != k; j--) {
                a[i][j] -= a[i][k] * a[k][j];
            }
        }
    }
    for (int i = 0; i < 16; i++) {
        inverse[i / 4][i % 4] = a[i / 4][4 + i % 4];
    }
    return least;
}

static void inverses(void **state)
{
    (void)state;
    double worst = 0;
    int inverted = 0;
    for (int i = 0; i < 20000; i++) {
        iris_mat4 m, inverse;
        double truth[4][4];
        for (int k = 0; k < 16; k++) { /* rows and columns of very different sizes */
            m.m[k] = random_q32(IRIS_Q32_ONE << (k / 4 * 2 + i % 3 * (k % 4)));
        }
        if (invert(truth, &m) < 0.01) {
            continue;
        }
        inverted++;
        assert_int_equal(iris_mat4_invert(&inverse, &m), IRIS_OK);
        double x = largest(m.m, 16), y = largest(inverse.m, 16);
        for (int k = 0; k < 16; k++) {
            double off = fabs(real(inverse.m[k]) - truth[k / 4][k % 4]) * 4294967296.0;
            worst = fmax(worst, (off - 1) / (x * y * y));
        }
    }
    printf("#: %d inverses: at most 1 + %.1e x y^2 units off\n", inverted, worst);
    assert_true(inverted > 15000 && worst <= 1.0 / 1073741824);
}

static void no_inverse(void **state)
{
    (void)state;
    iris_mat4 m, inverse, before;
    iris_mat4_scaling(&m, (iris_vec3){IRIS_Q32_ONE, 0, IRIS_Q32_ONE});
    iris_mat4_identity(&inverse);
    before = inverse;
    assert_int_equal(iris_mat4_invert(&inverse, &m), IRIS_ERR_RANGE);
    for (int i = 0; i < 16; i++) {
        m.m[i] = (i + 1) * IRIS_Q32_ONE; /* of rank 2 */
    }
    assert_int_equal(iris_mat4_invert(&inverse, &m), IRIS_ERR_RANGE);
    iris_mat4_scaling(&m, (iris_vec3){1, 1, 1}); /* its inverse would be 2^32 */
    assert_int_equal(iris_mat4_invert(&inverse, &m), IRIS_ERR_RANGE);
    assert_memory_equal(&inverse, &before, sizeof before);
    iris_mat3 small;
    iris_mat3_identity(&small);
    small.m[8] = 0;
    assert_int_equal(iris_mat3_invert(&small, &small), IRIS_ERR_RANGE);
}

static void motions(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    iris_mat4 turn, move;
    iris_vec3 p;
    /* A quarter turn about the line through (2, 0, x) along z: from x to y. */
    iris_line3 axis = {{2 * one, 0, 5 * one}, {0, 0, one}};
    iris_mat4_turn_about(&turn, &axis, IRIS_PI_Q32 / 2);
    assert_int_equal(iris_mat4_point(&p, &turn, (iris_vec3){3 * one, 0, one}), IRIS_OK);
    assert_true(llabs(p.x - 2 * one) <= 8 && llabs(p.y - one) <= 8 && p.z == one);
    iris_mat4_translation(&move, (iris_vec3){one, -2 * one, 3 * one});
    iris_mat4_multiply(&move, &move, &turn);
    assert_int_equal(iris_mat4_point(&p, &move, (iris_vec3){3 * one, 0, one}), IRIS_OK);
    assert_true(llabs(p.x - 3 * one) <= 8 && llabs(p.y + one) <= 8 && p.z == 4 * one);
    iris_mat4_scaling(&move, (iris_vec3){2 * one, 3 * one, -one});
    move.m[15] = 2 * one; /* all is divided by it */
    assert_int_equal(iris_mat4_point(&p, &move, (iris_vec3){one, one, one}), IRIS_OK);
    assert_true(p.x == one && p.y == 3 * one / 2 && p.z == -one / 2);
    move.m[15] = 0;
    assert_int_equal(iris_mat4_point(&p, &move, (iris_vec3){one, one, one}), IRIS_ERR_RANGE);
}

static void small_matrices(void **state)
{
    (void)state;
    for (int i = 0; i < 5000; i++) {
        iris_mat3 r, transposed, product, inverse;
        iris_vec3 v = random_vec3(100 * IRIS_Q32_ONE);
        random_rotation(&r);
        iris_mat3_transpose(&transposed, &r);
        iris_vec3 back = iris_mat3_vector(&transposed, iris_mat3_vector(&r, v));
        iris_vec3 also = iris_mat3_transposed_vector(&r, iris_mat3_vector(&r, v));
        assert_true(back.x == also.x && back.y == also.y && back.z == also.z);
        assert_true(llabs(back.x - v.x) < 2000 && llabs(back.y - v.y) < 2000 && llabs(back.z - v.z) < 2000);
        assert_int_equal(iris_mat3_invert(&inverse, &r), IRIS_OK);
        iris_mat3_multiply(&product, &r, &inverse);
        for (int k = 0; k < 9; k++) {
            assert_true(llabs(inverse.m[k] - transposed.m[k]) <= 8);
            assert_true(llabs(product.m[k] - (k % 4 ? 0 : IRIS_Q32_ONE)) <= 4);
        }
    }
}

static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        iris_mat4 a, b;
        iris_vec3 p = {any_q32(), any_q32(), any_q32()};
        for (int k = 0; k < 16; k++) {
            a.m[k] = any_q32();
            b.m[k] = any_q32();
        }
        (void)iris_mat4_point(&p, &a, p);
        (void)iris_mat4_invert(&b, &a);
        iris_mat4_multiply(&a, &a, &b);
        (void)iris_mat4_invert(&a, &a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products), cmocka_unit_test(inverses),       cmocka_unit_test(no_inverse),
        cmocka_unit_test(motions),  cmocka_unit_test(small_matrices), cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
