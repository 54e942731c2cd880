/* Where a lens's polynomial turns back. With s = r^2 the slope of r (1 + k1 s + k2 s^2 + k3 s^3) along r is the cubic
 * 1 + 3 k1 s + 5 k2 s^2 + 7 k3 s^3. It is above 0 all the way from 0 to s if it is so at s, and at its only minimum if
 * that lies between: no root need be searched. */
#include "lens_fold.h"

#define LARGEST ((iris_q32)1 << 56) /* of a factor: its products fit, and no lens is near it */

/* Factors of s, s^2, and s^3. */
typedef struct {
    iris_q32 a, b, c;
} cubic;

static iris_q32 factor(iris_q32 k, int times)
{
    return times * (k > LARGEST ? LARGEST : k < -LARGEST ? -LARGEST : k);
}

static iris_q32 sum(iris_q32 a, iris_q32 b)
{
    return iris_wide_round_shift_sat(iris_wide_add(iris_wide_from(a), iris_wide_from(b)), 0);
}

static iris_q32 slope(const cubic *of, iris_q32 s)
{
    const iris_q32 inner = sum(of->b, iris_q32_mul_sat(of->c, s));
    return sum(IRIS_Q32_ONE, iris_q32_mul_sat(sum(of->a, iris_q32_mul_sat(inner, s)), s));
}

static iris_q32 fallen(iris_q32 a)
{
    return a < 0 ? a : 0;
}

/* Where the cubic has its minimum: the root of a + 2 b s + 3 c s^2 at which that grows. Below 0: there is none that
 * matters. */
static iris_q32 minimum(const cubic *of)
{
    const iris_wide square = iris_wide_sub(iris_wide_mul(of->b, of->b), iris_wide_mul(of->a, 3 * of->c));
    if (square.high < 0) {
        return -1;
    }
    const iris_q32 root = iris_wide_sqrt(square);
    if (of->b > 0) { /* so that nothing is subtracted from what is about the same */
        return iris_q32_div_sat(-of->a, of->b + root);
    }
    return of->c == 0 ? -1 : iris_q32_div_sat(root - of->b, 3 * of->c);
}

int iris_lens_grows(const iris_lens *lens, iris_q32 square)
{
    const cubic of = {factor(lens->k1, 3), factor(lens->k2, 5), factor(lens->k3, 7)};
    const cubic falling = {fallen(of.a), fallen(of.b),
                           fallen(of.c)}; /* it is below the other, and only falls */
    if (slope(&falling, square) > 0) {
        return 1;
    }
    const iris_q32 least = minimum(&of);
    return slope(&of, square) > 0 && (least <= 0 || least >= square || slope(&of, least) > 0);
}
