/* What a lens does, and undoes. */
#include "lens_fold.h"

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

/* What a place's distance and direction from the center make of the terms. */
typedef struct {
    iris_q32 x, y, xx, xy, yy, square;
} terms;

static terms terms_of(const iris_lens *lens, iris_vec2 p)
{
    terms t = {.x = limited(sum(p.x, -limited(lens->center.x))),
               .y = limited(sum(p.y, -limited(lens->center.y)))};
    t.xx = mul(t.x, t.x);
    t.xy = mul(t.x, t.y);
    t.yy = mul(t.y, t.y);
    t.square = t.xx + t.yy;
    return t;
}

/* k1 r^2 + k2 r^4 + k3 r^6 */
static iris_q32 radial_of(const iris_lens *lens, iris_q32 square)
{
    return mul(sum(mul(sum(mul(lens->k3, square), lens->k2), square), lens->k1), square);
}

/* Its slope: k1 + 2 k2 r^2 + 3 k3 r^4 */
static iris_q32 growth_of(const iris_lens *lens, iris_q32 square)
{
    iris_q32 k3_part = mul(lens->k3, square);
    return sum(mul(sum(sum(twice(k3_part), k3_part), twice(lens->k2)), square), lens->k1);
}

/* The polynomial at p, which is within LIMIT. */
static iris_vec2 bend(const iris_lens *lens, iris_vec2 p)
{
    const terms t = terms_of(lens, p);
    const iris_q32 radial = radial_of(lens, t.square);
    const iris_q32 along_x = sum(mul(lens->p1, twice(t.xy)), mul(lens->p2, t.square + 2 * t.xx));
    const iris_q32 along_y = sum(mul(lens->p1, t.square + 2 * t.yy), mul(lens->p2, twice(t.xy)));
    return (iris_vec2){sum(p.x, sum(mul(t.x, radial), along_x)), sum(p.y, sum(mul(t.y, radial), along_y))};
}

/* Its slopes there. */
static slopes slopes_at(const iris_lens *lens, iris_vec2 p)
{
    const terms t = terms_of(lens, p);
    const iris_q32 stretch = sum(IRIS_Q32_ONE, radial_of(lens, t.square)), growth = growth_of(lens, t.square);
    const iris_q32 by_y = mul(lens->p1, t.y), by_x = mul(lens->p2, t.x);
    slopes s;
    s.a = sum(sum(stretch, twice(mul(t.xx, growth))), twice(sum(by_y, sum(by_x, twice(by_x)))));
    s.b = twice(sum(mul(t.xy, growth), sum(mul(lens->p1, t.x), mul(lens->p2, t.y))));
    s.d = sum(sum(stretch, twice(mul(t.yy, growth))), twice(sum(by_x, sum(by_y, twice(by_y)))));
    return s;
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
    iris_vec2 at = {limited(wanted.x), limited(wanted.y)}, value = bend(lens, at);
    slopes s = slopes_at(lens, at);
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
            slopes next = slopes_at(lens, to);
            if (halves == 7 || is_upright(&next)) {
                at = to;
                value = bend(lens, at);
                s = next;
                break;
            }
        }
    }
    return IRIS_ERR_RANGE;
}

/* Is p, of the polynomial's argument, before the place where it turns back? */
static int is_before_fold(const iris_lens *lens, iris_vec2 p)
{
    return iris_lens_grows(lens, terms_of(lens, p).square);
}

/* The polynomial, and what solves it: with places before the fold alone. */
static iris_status forward(iris_vec2 *to, const iris_lens *lens, iris_vec2 p)
{
    const iris_vec2 from = {limited(p.x), limited(p.y)};
    *to = bend(lens, from);
    return is_before_fold(lens, from) ? IRIS_OK : IRIS_ERR_RANGE;
}

static iris_status backward(iris_vec2 *to, const iris_lens *lens, iris_vec2 p)
{
    const iris_status status = solve(to, lens, p);
    return status == IRIS_OK && !is_before_fold(lens, *to) ? IRIS_ERR_RANGE : status;
}

iris_status iris_lens_show(iris_vec2 *seen, const iris_lens *lens, iris_vec2 p)
{
    return lens->direction == IRIS_LENS_BENDS ? forward(seen, lens, p) : backward(seen, lens, p);
}

iris_vec2 iris_lens_bend(const iris_lens *lens, iris_vec2 p)
{
    iris_vec2 seen;
    (void)iris_lens_show(&seen, lens, p);
    return seen;
}

iris_status iris_lens_straighten(iris_vec2 *straight, const iris_lens *lens, iris_vec2 p)
{
    return lens->direction == IRIS_LENS_CORRECTS ? forward(straight, lens, p) : backward(straight, lens, p);
}
