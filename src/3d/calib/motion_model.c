/* Where a motion shows the match of a place. */
#include <string.h>

#include "motion_parts.h"

#define NEAR  ((iris_q32)1 << 20) /* 2^-12: a depth below is none */
#define WIDE  (16 * IRIS_Q32_ONE) /* of places on the picture plane */
#define STEEP ((iris_q32)1 << 48) /* of what changes: equations keep within numbers */
#define SLACK 16                  /* 2^-28, a square: what depth moves by less than that moves nothing */

enum { OWN = IRIS_MOTION_OWN };

static iris_q32 mul(iris_q32 a, iris_q32 b)
{
    return iris_q32_mul_sat(a, b);
}

static iris_q32 limited(iris_q32 a)
{
    return a > STEEP ? STEEP : a < -STEEP ? -STEEP : a;
}

void iris_motion_way_of(iris_motion_way *way, const iris_motion_problem *of, const iris_motion_camera *camera,
                        const iris_mat3 *turns, int32_t v)
{
    const iris_mat3 none = {{0}};
    if (!of->known) {
        *way = (iris_motion_way){turns[v], {0, 0, 0}, none};
        return;
    }
    /* the camera's turn is mount R^T mount^T, its shift mount (R^T (lever - t) - lever) */
    iris_mat3 back, mounted;
    iris_vec3 t = of->pairs[v].shift;
    iris_mat3_transpose(&back, &of->pairs[v].turn);
    iris_mat3_multiply(&way->lever, &camera->mount, &back);
    iris_mat3_transpose(&mounted, &camera->mount);
    iris_mat3_multiply(&way->turn, &way->lever, &mounted);
    t = (iris_vec3){iris_q32_div_sat(t.x, of->span), iris_q32_div_sat(t.y, of->span),
                    iris_q32_div_sat(t.z, of->span)};
    way->shift = iris_vec3_sub(iris_mat3_vector(&way->lever, iris_vec3_sub(camera->lever, t)),
                               iris_mat3_vector(&camera->mount, camera->lever));
    for (int i = 0; i < 9; i++) {
        way->lever.m[i] -= camera->mount.m[i];
    }
}

static iris_vec2 on_plane(const iris_q32 *k, iris_vec2 at)
{
    iris_q32 y = iris_q32_div_sat(at.y - k[IRIS_MOTION_V0], k[IRIS_MOTION_ALPHA_V]);
    iris_q32 x =
        iris_q32_div_sat(at.x - k[IRIS_MOTION_U0] - mul(k[IRIS_MOTION_SKEW], y), k[IRIS_MOTION_ALPHA_U]);
    return (iris_vec2){x, y};
}

/* The inverse depth with which the way shows the match best; 0 where it makes no difference, or none is in front. */
static void find_depth(iris_motion_ray *at, const iris_motion_way *way)
{
    const iris_vec3 t = way->shift;
    const iris_q32 g[2] = {t.x - mul(at->seen.x, t.z), t.y - mul(at->seen.y, t.z)};
    const iris_q32 c[2] = {at->after.x - mul(at->seen.x, at->after.z),
                           at->after.y - mul(at->seen.y, at->after.z)};
    const iris_wide square = iris_wide_add(iris_wide_mul(g[0], g[0]), iris_wide_mul(g[1], g[1]));
    const iris_wide along = iris_wide_add(iris_wide_mul(g[0], c[0]), iris_wide_mul(g[1], c[1]));
    const iris_q32 by = iris_wide_round_shift_sat(square, 32);
    const iris_q32 wanted = iris_wide_round_shift_sat(iris_wide_negate(along), 32);
    at->inverse = 0;
    at->slides = 0;
    if (by > SLACK && wanted > 0) {
        at->inverse = limited(iris_q32_div_sat(wanted, by));
        at->slides = 1;
        at->after = iris_vec3_add(at->after, iris_vec3_scale(t, at->inverse));
    }
}

static int follow(iris_motion_ray *at, const iris_q32 *k, const iris_motion_way *way, const iris_match *match)
{
    iris_vec2 from = on_plane(k, match->from);
    at->seen = on_plane(k, match->to);
    if (from.x > WIDE || from.x < -WIDE || from.y > WIDE || from.y < -WIDE) {
        return 0;
    }
    at->before = (iris_vec3){from.x, from.y, IRIS_Q32_ONE};
    at->after = iris_mat3_vector(&way->turn, at->before);
    find_depth(at, way);
    if (at->after.z < NEAR) {
        return 0;
    }
    at->plane =
        (iris_vec2){iris_q32_div_sat(at->after.x, at->after.z), iris_q32_div_sat(at->after.y, at->after.z)};
    return at->plane.x < WIDE && at->plane.x > -WIDE && at->plane.y < WIDE && at->plane.y > -WIDE;
}

/* What is across the line on which the match may be: one equation of the two. */
static void cross_line(iris_motion_rows *rows, iris_vec2 along)
{
    iris_vec3 unit;
    const int last = OWN + IRIS_MOTION_SHARED;
    if (iris_vec3_normalize(&unit, (iris_vec3){along.x, along.y, 0}) != IRIS_OK) {
        return;
    }
    rows->count = 1;
    for (int i = 0; i <= last; i++) {
        rows->row[0][i] = mul(rows->row[1][i], unit.x) - mul(rows->row[0][i], unit.y);
    }
}

int iris_motion_show(iris_motion_rows *rows, const iris_motion_camera *camera, const iris_motion_way *way,
                     const iris_match *match, int slopes)
{
    const iris_q32 *k = camera->k;
    iris_motion_ray at;
    if (!follow(&at, k, way, match)) {
        return 0;
    }
    memset(rows, 0, sizeof *rows);
    rows->count = 2;
    if (slopes) {
        iris_motion_slopes_of_intrinsics(rows, &at, k, way);
        iris_motion_slopes_of_turns(rows, &at, k, way);
    }
    const iris_q32 u = mul(k[IRIS_MOTION_ALPHA_U], at.plane.x) + mul(k[IRIS_MOTION_SKEW], at.plane.y);
    const iris_vec2 off = {match->to.x - u - k[IRIS_MOTION_U0],
                           match->to.y - mul(k[IRIS_MOTION_ALPHA_V], at.plane.y) - k[IRIS_MOTION_V0]};
    rows->row[0][OWN + IRIS_MOTION_SHARED] = limited(off.x);
    rows->row[1][OWN + IRIS_MOTION_SHARED] = limited(off.y);
    if (at.slides) {
        cross_line(rows, iris_motion_moved(&at, k, way->shift));
    }
    return 1;
}
