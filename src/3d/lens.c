/* What a lens does, and undoes. */
#include "iris/3d/camera.h"

#define ROUNDS 30
#define CLOSE  16                   /* 2^-28 */
#define LIMIT  (64 * IRIS_Q32_ONE)  /* of places on the picture plane, in focal lengths */
#define FOLD   (IRIS_Q32_ONE / 256) /* of the determinant: the polynomial is about to turn back */

static iris_q32 mul(iris_q32 a, iris_q32 b)
{
    return iris_q32_mul_sat(a, b);
}

static iris_q32 sum(iris_q32 a, iris_q32 b)
{
    return iris_wide_round_shift_sat(iris_wide_add(iris_wide_from(a), iris_wide_from(b)), 0);
}

static iris_q32 limited(iris_q32 a)
{
    return a > LIMIT ? LIMIT : a < -LIMIT ? -LIMIT : a;
}

/* Twice a, and three times it. */
static iris_q32 twice(iris_q32 a)
{
    return sum(a, a);
}

/* The slopes of the polynomial at a place: (a, b; b, d). */
typedef struct {
    iris_q32 a, b, d;
} slopes;

/* The polynomial at p, which is within LIMIT, and its slopes there. */
static iris_vec2 bend(slopes *slope, const iris_lens *lens, iris_vec2 p)
{
    const iris_q32 x = limited(sum(p.x, -limited(lens->center.x))),
                   y = limited(sum(p.y, -limited(lens->center.y)));
    const iris_q32 xx = mul(x, x), xy = mul(x, y), yy = mul(y, y), square = xx + yy;
    const iris_q32 radial = mul(sum(mul(sum(mul(lens->k3, square), lens->k2), square), lens->k1), square);
    const iris_q32 k3_part = mul(lens->k3, square);
    const iris_q32 growth = sum(mul(sum(sum(twice(k3_part), k3_part), twice(lens->k2)), square), lens->k1);
    const iris_q32 by_y = mul(lens->p1, y), by_x = mul(lens->p2, x),
                   mixed = sum(mul(lens->p1, x), mul(lens->p2, y));
    const iris_q32 along_x = sum(mul(lens->p1, twice(xy)), mul(lens->p2, square + 2 * xx));
    const iris_q32 along_y = sum(mul(lens->p1, square + 2 * yy), mul(lens->p2, twice(xy)));
    const iris_q32 stretch = sum(IRIS_Q32_ONE, radial);
    slope->a = sum(sum(stretch, twice(mul(xx, growth))), twice(sum(by_y, sum(by_x, twice(by_x)))));
    slope->b = twice(sum(mul(xy, growth), mixed));
    slope->d = sum(sum(stretch, twice(mul(yy, growth))), twice(sum(by_x, sum(by_y, twice(by_y)))));
    return (iris_vec2){sum(p.x, sum(mul(x, radial), along_x)), sum(p.y, sum(mul(y, radial), along_y))};
}

/* 2^-32 of the determinant; not above 0 behind the fold. */
static iris_q32 determinant(const slopes *s)
{
    return iris_wide_round_shift_sat(iris_wide_sub(iris_wide_mul(s->a, s->d), iris_wide_mul(s->b, s->b)), 32);
}

static int is_upright(const slopes *s)
{
    return s->a > 0 && s->d > 0 && determinant(s) > FOLD;
}

/* (d e.x - b e.y) / determinant */
static iris_q32 newton(iris_q32 d, iris_q32 ex, iris_q32 b, iris_q32 ey, iris_q32 by)
{
    iris_q32 over = iris_wide_round_shift_sat(iris_wide_sub(iris_wide_mul(d, ex), iris_wide_mul(b, ey)), 32);
    return iris_q32_div_sat(over, by);
}

/* The place that the polynomial brings to `wanted`. */
static iris_status solve(iris_vec2 *found, const iris_lens *lens, iris_vec2 wanted)
{
    slopes s, next;
    iris_vec2 at = {limited(wanted.x), limited(wanted.y)}, value = bend(&s, lens, at);
    for (int round = 0; round < ROUNDS; round++) {
        iris_vec2 off = {sum(wanted.x, -limited(value.x)), sum(wanted.y, -limited(value.y))};
        *found = at;
        if (off.x <= CLOSE && off.x >= -CLOSE && off.y <= CLOSE && off.y >= -CLOSE && is_upright(&s)) {
            return IRIS_OK;
        }
        if (!is_upright(&s)) {
            return IRIS_ERR_RANGE;
        }
        iris_q32 by = determinant(&s);
        iris_vec2 step = {newton(s.d, off.x, s.b, off.y, by), newton(s.a, off.y, s.b, off.x, by)};
        for (int halves = 0; halves < 8; halves++, step.x /= 2, step.y /= 2) {
            iris_vec2 to = {limited(sum(at.x, step.x)), limited(sum(at.y, step.y))};
            value = bend(&next, lens, to);
            if (halves == 7 || is_upright(&next)) {
                at = to;
                s = next;
                break;
            }
        }
    }
    return IRIS_ERR_RANGE;
}

iris_vec2 iris_lens_bend(const iris_lens *lens, iris_vec2 p)
{
    iris_vec2 seen;
    slopes s;
    if (lens->direction == IRIS_LENS_BENDS) {
        return bend(&s, lens, (iris_vec2){limited(p.x), limited(p.y)});
    }
    (void)solve(&seen, lens, p);
    return seen;
}

iris_status iris_lens_straighten(iris_vec2 *straight, const iris_lens *lens, iris_vec2 p)
{
    slopes s;
    if (lens->direction == IRIS_LENS_CORRECTS) {
        *straight = bend(&s, lens, (iris_vec2){limited(p.x), limited(p.y)});
        return IRIS_OK;
    }
    return solve(straight, lens, p);
}
