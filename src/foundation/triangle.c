#include "triangle.h"

#include "iris/fixed.h"

/* That of the least one, which sums that do not fit become, is one less. */
static int64_t magnitude(int64_t value)
{
    return value >= 0 ? value : value == INT64_MIN ? INT64_MAX : -value;
}

/* (a p + b q) / 2^30 */
static iris_q32 turned(iris_q30 a, iris_q32 p, iris_q30 b, iris_q32 q)
{
    return iris_wide_round_shift_sat(iris_wide_add(iris_wide_mul(a, p), iris_wide_mul(b, q)), 30);
}

/* Cosine and sine of the turn that brings (a, b) onto the first axis. */
static void turn_onto(iris_q30 *cosine, iris_q30 *sine, iris_q32 a, iris_q32 b)
{
    int64_t larger = magnitude(a) > magnitude(b) ? magnitude(a) : magnitude(b);
    int shift = iris_wide_bits(iris_wide_from(larger)) - 30;
    if (shift > 0) {
        a = iris_round_shift(a, shift);
        b = iris_round_shift(b, shift);
    } else {
        a *= (int64_t)1 << -shift;
        b *= (int64_t)1 << -shift;
    }
    int32_t length = (int32_t)iris_hypot((int32_t)a, (int32_t)b);
    *cosine = iris_q30_div((int32_t)a, length);
    *sine = iris_q30_div((int32_t)b, length);
}

void iris_triangle_init(iris_triangle *triangle, iris_q32 *numbers, int n)
{
    triangle->numbers = numbers;
    triangle->n = n;
    for (int i = 0; i < IRIS_TRIANGLE_NUMBERS(n); i++) {
        numbers[i] = 0;
    }
}

void iris_triangle_add(const iris_triangle *triangle, iris_q32 *row)
{
    for (int j = 0; j < triangle->n; j++) {
        iris_q32 *kept = iris_triangle_at(triangle, j, 0);
        iris_q30 cosine, sine;
        if (row[j] == 0) {
            continue;
        }
        turn_onto(&cosine, &sine, kept[j], row[j]);
        for (int k = j; k <= triangle->n; k++) {
            iris_q32 was = kept[k];
            kept[k] = turned(cosine, was, sine, row[k]);
            row[k] = turned(cosine, row[k], -sine, was);
        }
    }
}

int iris_triangle_solve(iris_q32 *solution, const iris_triangle *triangle, iris_q32 least)
{
    int n = triangle->n;
    for (int i = n - 1; i >= 0; i--) {
        const iris_q32 *row = iris_triangle_at(triangle, i, 0);
        iris_wide sum = iris_wide_mul(row[n], IRIS_Q32_ONE);
        if (row[i] < least && row[i] > -least) {
            return 0;
        }
        for (int k = i + 1; k < n; k++) {
            sum = iris_wide_sub(sum, iris_wide_mul(row[k], solution[k]));
        }
        solution[i] = iris_wide_div_sat(sum, row[i]);
    }
    return 1;
}
