#include "null_vector.h"

#define ROUNDS 30
#define LEAST  64 /* 2^-26: a diagonal number below counts as so large */
#define BITS                                                                                                 \
    26 /* of the largest number that goes into a solution: what comes out has 2^26 times it at most */

/* How many bits the largest number has. */
static int bits_of(const iris_q32 *numbers, int n)
{
    int most = 0;
    for (int i = 0; i < n; i++) {
        int has = iris_wide_bits(iris_wide_from(numbers[i]));
        most = has > most ? has : most;
    }
    return most;
}

/* Shifts all numbers so that the largest has `bits` bits. */
static void scale(iris_q32 *numbers, int n, int bits)
{
    int most = bits_of(numbers, n);
    for (int i = 0; i < n && most > 0; i++) {
        numbers[i] = most > bits ? iris_wide_round_shift_sat(iris_wide_from(numbers[i]), most - bits)
                                 : numbers[i] * ((iris_q32)1 << (bits - most));
    }
}

iris_q32 iris_numbers_length(const iris_q32 *numbers, int n)
{
    iris_wide sum = {0, 0};
    int spare = bits_of(numbers, n) - 58; /* the squares of a hundred numbers of 58 bits are below 2^124 */
    spare = spare > 0 ? spare : 0;
    for (int i = 0; i < n; i++) {
        iris_q32 a = numbers[i] >> spare;
        sum = iris_wide_add(sum, iris_wide_mul(a, a));
    }
    int64_t length = iris_wide_sqrt(sum);
    return length > INT64_MAX >> spare ? INT64_MAX : length * ((int64_t)1 << spare);
}

void iris_numbers_normalize(iris_q32 *numbers, int n)
{
    scale(numbers, n, 56);
    iris_q32 length = iris_numbers_length(numbers, n);
    for (int i = 0; i < n && length > 0; i++) {
        numbers[i] = iris_q32_div_sat(numbers[i], length);
    }
}

static iris_q32 diagonal(const iris_triangle *t, int i)
{
    iris_q32 d = *iris_triangle_at(t, i, i);
    return d >= LEAST || d <= -LEAST ? d : d < 0 ? -LEAST : LEAST;
}

/* x becomes what R, or R^T, brings to x. */
static void solve(iris_q32 *x, const iris_triangle *t, int transposed)
{
    for (int step = 0; step < t->n; step++) {
        int i = transposed ? step : t->n - 1 - step;
        iris_wide sum = iris_wide_mul(x[i], IRIS_Q32_ONE);
        for (int k = transposed ? 0 : i + 1; k < (transposed ? i : t->n); k++) {
            iris_q32 r = transposed ? *iris_triangle_at(t, k, i) : *iris_triangle_at(t, i, k);
            sum = iris_wide_sub(sum, iris_wide_mul(r, x[k]));
        }
        x[i] = iris_wide_div_sat(sum, diagonal(t, i));
    }
}

/* Takes from x what it has of `to`. */
static void part(iris_q32 *x, const iris_q32 *to, int n)
{
    iris_wide along = {0, 0};
    for (int i = 0; i < n; i++) {
        along = iris_wide_add(along, iris_wide_mul(x[i], to[i]));
    }
    iris_q32 share = iris_wide_round_shift_sat(along, 32);
    for (int i = 0; i < n; i++) {
        x[i] -= iris_q32_mul_sat(share, to[i]);
    }
}

static iris_q32 value_of(const iris_q32 *v, const iris_triangle *t)
{
    iris_q32 made[IRIS_NULL_VECTOR_MAX];
    for (int i = 0; i < t->n; i++) {
        iris_wide sum = {0, 0};
        for (int k = i; k < t->n; k++) {
            sum = iris_wide_add(sum, iris_wide_mul(*iris_triangle_at(t, i, k), v[k]));
        }
        made[i] = iris_wide_round_shift_sat(sum, 32);
    }
    return iris_numbers_length(made, t->n);
}

static int differs(const iris_q32 *a, const iris_q32 *b, int n)
{
    int same = 1, opposite = 1;
    for (int i = 0; i < n; i++) {
        same &= a[i] - b[i] <= 2 && b[i] - a[i] <= 2;
        opposite &= a[i] + b[i] <= 2 && a[i] + b[i] >= -2;
    }
    return !same && !opposite;
}

iris_q32 iris_null_vector_beside(iris_q32 *v, const iris_triangle *triangle, const iris_q32 *to)
{
    const int n = triangle->n;
    iris_q32 last[IRIS_NULL_VECTOR_MAX];
    for (int i = 0; i < n; i++) {
        v[i] = (iris_q32)(i % 3 + 1) * (i % 2 ? -1 : 1) * IRIS_Q32_ONE;
        last[i] = 0;
    }
    for (int round = 0; round < ROUNDS; round++) {
        if (to) {
            scale(v, n, 56);
            part(v, to, n);
        }
        scale(v, n, BITS);
        if (!differs(v, last, n)) {
            break;
        }
        for (int i = 0; i < n; i++) {
            last[i] = v[i];
        }
        solve(v, triangle, 1);
        scale(v, n, BITS);
        solve(v, triangle, 0);
    }
    if (to) {
        scale(v, n, 56);
        part(v, to, n);
    }
    iris_numbers_normalize(v, n);
    return value_of(v, triangle);
}

iris_q32 iris_null_vector(iris_q32 *v, const iris_triangle *triangle)
{
    return iris_null_vector_beside(v, triangle, 0);
}
