#include "iris/3d/matrix.h"

#include "iris/3d/rotation.h"

#define SINGULAR_BITS 80 /* a determinant of 2^120 is that of an identity: here it is lost in rounding */

static const iris_mat4 identity4 = {
    {IRIS_Q32_ONE, 0, 0, 0, 0, IRIS_Q32_ONE, 0, 0, 0, 0, IRIS_Q32_ONE, 0, 0, 0, 0, IRIS_Q32_ONE}};

void iris_mat4_identity(iris_mat4 *m)
{
    *m = identity4;
}

void iris_mat4_translation(iris_mat4 *m, iris_vec3 by)
{
    *m = identity4;
    m->m[3] = by.x;
    m->m[7] = by.y;
    m->m[11] = by.z;
}

void iris_mat4_scaling(iris_mat4 *m, iris_vec3 factors)
{
    *m = identity4;
    m->m[0] = factors.x;
    m->m[5] = factors.y;
    m->m[10] = factors.z;
}

void iris_mat4_motion(iris_mat4 *m, const iris_mat3 *turn, iris_vec3 center, iris_vec3 move)
{
    iris_vec3 shift = iris_vec3_sub(iris_vec3_add(center, move), iris_mat3_vector(turn, center));
    iris_mat4 made = {{0}};
    iris_mat4_translation(&made, shift);
    for (int i = 0; i < 9; i++) {
        made.m[4 * (i / 3) + i % 3] = turn->m[i];
    }
    *m = made;
}

void iris_mat4_turn_about(iris_mat4 *m, const iris_line3 *axis, iris_q32 radians)
{
    iris_mat3 turn;
    iris_rotation_about(&turn, axis->direction, radians);
    iris_mat4_motion(m, &turn, axis->origin, (iris_vec3){0, 0, 0});
}

static uint64_t magnitude(int64_t value)
{
    return value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
}

/* How many bits the largest of `count` numbers has, which are `step` apart. */
static int bits_of(const iris_q32 *a, int step, int count)
{
    uint64_t all = 0;
    for (int k = 0; k < count; k++) {
        all |= magnitude(a[k * step]);
    }
    return iris_wide_bits((iris_wide){0, all});
}

/* The sum of `count` products, four at most, of numbers that are step_a and step_b apart. */
static iris_q32 sum_of_products(const iris_q32 *a, int step_a, const iris_q32 *b, int step_b, int count)
{
    int spare = bits_of(a, step_a, count) + bits_of(b, step_b, count) - 124;
    iris_wide sum = {0, 0};
    spare = spare > 0 ? spare : 0;
    for (int k = 0; k < count; k++) {
        sum = iris_wide_add(sum, iris_wide_mul(a[k * step_a] >> spare, b[k * step_b]));
    }
    return iris_wide_round_shift_sat(sum, 32 - spare);
}

static void multiply(iris_q32 *product, const iris_q32 *a, const iris_q32 *b, int n)
{
    for (int i = 0; i < n * n; i++) {
        product[i] = sum_of_products(a + i / n * n, 1, b + i % n, n, n);
    }
}

void iris_mat4_multiply(iris_mat4 *product, const iris_mat4 *a, const iris_mat4 *b)
{
    iris_mat4 made = {{0}};
    multiply(made.m, a->m, b->m, 4);
    *product = made;
}

/* A matrix whose rows and columns are lengthened until each has a number of 61 bits; and its minors of the rows 0 and
 * 1, and 2 and 3, shortened to 61 bits. */
typedef struct {
    int64_t a[4][4];
    int row_bits[4], column_bits[4];
    int64_t minors[2][4][4]; /* of columns [first][second], first < second */
} balanced;

/* Returns 0 when a row or column is empty. */
static int balance(balanced *b, const iris_mat4 *m)
{
    for (int i = 0; i < 4; i++) {
        int bits = bits_of(m->m + 4 * i, 1, 4);
        b->row_bits[i] = 60 - bits; /* one bit less: what is cut off is rounded down */
        for (int j = 0; j < 4; j++) {
            int64_t number = m->m[4 * i + j];
            b->a[i][j] = bits > 60 ? number >> (bits - 60) : number * ((int64_t)1 << (60 - bits));
        }
        if (bits == 0) {
            return 0;
        }
    }
    for (int j = 0; j < 4; j++) {
        int bits = bits_of(&b->a[0][j], 4, 4);
        if (bits == 0) {
            return 0;
        }
        b->column_bits[j] = 61 - bits;
        for (int i = 0; i < 4; i++) {
            b->a[i][j] *= (int64_t)1 << (61 - bits);
        }
    }
    for (int half = 0; half < 2; half++) {
        const int64_t(*rows)[4] = (const int64_t(*)[4])b->a + 2 * half;
        for (int k = 0; k < 4; k++) {
            for (int l = k + 1; l < 4; l++) {
                iris_wide minor = iris_wide_sub(iris_wide_mul(rows[0][k], rows[1][l]),
                                                iris_wide_mul(rows[0][l], rows[1][k]));
                b->minors[half][k][l] = iris_wide_round_shift_sat(minor, 62);
            }
        }
    }
    return 1;
}

/* By the minors of two halves (Laplace), with the signs of the permutations. */
static iris_wide determinant(const balanced *b)
{
    iris_wide sum = {0, 0};
    for (int k = 0; k < 4; k++) {
        for (int l = k + 1; l < 4; l++) {
            int first = k == 0 ? l == 1 ? 2 : 1 : 0, second = 6 - k - l - first;
            iris_wide part = iris_wide_mul(b->minors[0][k][l], b->minors[1][first][second]);
            sum = (k + l) % 2 ? iris_wide_add(sum, part) : iris_wide_sub(sum, part);
        }
    }
    return sum;
}

/* Of row i and column j, with its sign. */
static int64_t cofactor(const balanced *b, int i, int j)
{
    const int64_t *row = b->a[i ^ 1];
    const int64_t(*minors)[4] = b->minors[i < 2];
    int k = j == 0, l = j <= 1 ? 2 : 1, n = j == 3 ? 2 : 3;
    iris_wide sum = iris_wide_sub(iris_wide_mul(row[k], minors[l][n]), iris_wide_mul(row[l], minors[k][n]));
    sum = iris_wide_add(sum, iris_wide_mul(row[n], minors[k][l]));
    int64_t value = iris_wide_round_shift_sat(sum, 62);
    return (i + j) % 2 ? -value : value;
}

/* value 2^shift / by, saturated to INT64_MAX and its negative. */
static iris_q32 quotient(int64_t value, int shift, int64_t by)
{
    if (shift < 0) {
        value = shift < -63 ? 0 : iris_wide_round_shift_sat(iris_wide_from(value), -shift);
        return iris_wide_div_sat(iris_wide_from(value), by);
    }
    if (value != 0 && iris_wide_bits(iris_wide_from(value)) + shift > 125) {
        return (value < 0) != (by < 0) ? -INT64_MAX : INT64_MAX;
    }
    int more = value != 0 && shift > 62 ? shift - 62 : 0;
    shift = shift > 62 ? 62 : shift;
    return iris_wide_div_sat(iris_wide_mul(value * ((int64_t)1 << more), (int64_t)1 << shift), by);
}

iris_status iris_mat4_invert(iris_mat4 *inverse, const iris_mat4 *m)
{
    balanced b;
    iris_mat4 made = {{0}};
    if (!balance(&b, m)) {
        return IRIS_ERR_RANGE;
    }
    iris_wide det = determinant(&b);
    int bits = iris_wide_bits(det), spare = bits > 62 ? bits - 62 : 0;
    if (bits < SINGULAR_BITS) {
        return IRIS_ERR_RANGE;
    }
    int64_t by = iris_wide_round_shift_sat(det, spare);
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            int64_t part = quotient(cofactor(&b, i, j), 64 + b.row_bits[i] + b.column_bits[j] - spare, by);
            if (part == INT64_MAX || part <= -INT64_MAX) {
                return IRIS_ERR_RANGE;
            }
            made.m[4 * j + i] = part;
        }
    }
    *inverse = made;
    return IRIS_OK;
}

iris_status iris_mat4_point(iris_vec3 *moved, const iris_mat4 *m, iris_vec3 p)
{
    const iris_q32 from[4] = {p.x, p.y, p.z, IRIS_Q32_ONE};
    iris_q32 to[4];
    for (int i = 0; i < 4; i++) {
        to[i] = sum_of_products(m->m + 4 * i, 1, from, 1, 4);
    }
    if (to[3] == 0) {
        return IRIS_ERR_RANGE;
    }
    for (int i = 0; i < 3 && to[3] != IRIS_Q32_ONE; i++) {
        to[i] = iris_q32_div_sat(to[i], to[3]);
    }
    *moved = (iris_vec3){to[0], to[1], to[2]};
    return IRIS_OK;
}

void iris_mat3_identity(iris_mat3 *m)
{
    for (int i = 0; i < 9; i++) {
        m->m[i] = i % 4 == 0 ? IRIS_Q32_ONE : 0;
    }
}

void iris_mat3_multiply(iris_mat3 *product, const iris_mat3 *a, const iris_mat3 *b)
{
    iris_mat3 made = {{0}};
    multiply(made.m, a->m, b->m, 3);
    *product = made;
}

iris_vec3 iris_mat3_vector(const iris_mat3 *m, iris_vec3 v)
{
    const iris_q32 from[3] = {v.x, v.y, v.z};
    return (iris_vec3){sum_of_products(m->m, 1, from, 1, 3), sum_of_products(m->m + 3, 1, from, 1, 3),
                       sum_of_products(m->m + 6, 1, from, 1, 3)};
}

iris_vec3 iris_mat3_transposed_vector(const iris_mat3 *m, iris_vec3 v)
{
    const iris_q32 from[3] = {v.x, v.y, v.z};
    return (iris_vec3){sum_of_products(m->m, 3, from, 1, 3), sum_of_products(m->m + 1, 3, from, 1, 3),
                       sum_of_products(m->m + 2, 3, from, 1, 3)};
}

void iris_mat3_transpose(iris_mat3 *transposed, const iris_mat3 *m)
{
    const iris_mat3 from = *m;
    for (int i = 0; i < 9; i++) {
        transposed->m[i] = from.m[i % 3 * 3 + i / 3];
    }
}

iris_status iris_mat3_invert(iris_mat3 *inverse, const iris_mat3 *m)
{
    iris_mat4 whole = identity4;
    for (int i = 0; i < 9; i++) {
        whole.m[4 * (i / 3) + i % 3] = m->m[i];
    }
    iris_status status = iris_mat4_invert(&whole, &whole);
    for (int i = 0; i < 9 && status == IRIS_OK; i++) {
        inverse->m[i] = whole.m[4 * (i / 3) + i % 3];
    }
    return status;
}
