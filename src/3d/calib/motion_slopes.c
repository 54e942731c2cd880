/* How the place that a motion shows changes with every parameter. */
#include "motion_parts.h"

#define STEEP ((iris_q32)1 << 48) /* equations keep within numbers */

enum {
    K = IRIS_MOTION_OWN,
    MOUNT = IRIS_MOTION_OWN + IRIS_MOTION_MOUNT,
    PLACE = IRIS_MOTION_OWN + IRIS_MOTION_PLACE
};

static iris_q32 mul(iris_q32 a, iris_q32 b)
{
    return iris_q32_mul_sat(a, b);
}

static iris_q32 limited(iris_q32 a)
{
    return a > STEEP ? STEEP : a < -STEEP ? -STEEP : a;
}

iris_vec2 iris_motion_moved(const iris_motion_ray *at, const iris_q32 *k, iris_vec3 step)
{
    iris_q32 right = limited(iris_q32_div_sat(step.x - mul(at->plane.x, step.z), at->after.z));
    iris_q32 down = limited(iris_q32_div_sat(step.y - mul(at->plane.y, step.z), at->after.z));
    return (iris_vec2){limited(mul(k[IRIS_MOTION_ALPHA_U], right) + mul(k[IRIS_MOTION_SKEW], down)),
                       limited(mul(k[IRIS_MOTION_ALPHA_V], down))};
}

static void set(iris_motion_rows *rows, int column, iris_vec2 slope)
{
    rows->row[0][column] = limited(slope.x);
    rows->row[1][column] = limited(slope.y);
}

void iris_motion_slopes_of_intrinsics(iris_motion_rows *rows, const iris_motion_ray *at, const iris_q32 *k,
                                      const iris_motion_way *way)
{
    const iris_q32 au = k[IRIS_MOTION_ALPHA_U], av = k[IRIS_MOTION_ALPHA_V];
    const iris_q32 x = at->before.x, y = at->before.y, lean = iris_q32_div_sat(k[IRIS_MOTION_SKEW], au);
    const iris_q32 one_u = iris_q32_div_sat(IRIS_Q32_ONE, au), one_v = iris_q32_div_sat(IRIS_Q32_ONE, av);
    const iris_q32 y_av = mul(y, one_v);
    /* how (x, y) of the ray changes with each, and what is seen of that directly */
    const iris_vec2 first[IRIS_MOTION_INTRINSICS] = {{-mul(x, one_u), 0},
                                                     {mul(lean, y_av), -y_av},
                                                     {-mul(y, one_u), 0},
                                                     {-one_u, 0},
                                                     {mul(lean, one_v), -one_v}};
    const iris_vec2 second[IRIS_MOTION_INTRINSICS] = {
        {at->plane.x, 0}, {0, at->plane.y}, {at->plane.y, 0}, {IRIS_Q32_ONE, 0}, {0, IRIS_Q32_ONE}};
    for (int i = 0; i < IRIS_MOTION_INTRINSICS; i++) {
        iris_vec2 by =
            iris_motion_moved(at, k, iris_mat3_vector(&way->turn, (iris_vec3){first[i].x, first[i].y, 0}));
        set(rows, K + i, (iris_vec2){by.x + second[i].x, by.y + second[i].y});
    }
}

void iris_motion_slopes_of_turns(iris_motion_rows *rows, const iris_motion_ray *at, const iris_q32 *k,
                                 const iris_motion_way *way)
{
    const iris_vec3 axes[3] = {{IRIS_Q32_ONE, 0, 0}, {0, IRIS_Q32_ONE, 0}, {0, 0, IRIS_Q32_ONE}};
    for (int i = 0; i < 3; i++) {
        const iris_vec3 own = iris_vec3_cross(axes[i], at->after);
        const iris_vec3 before = iris_mat3_vector(&way->turn, iris_vec3_cross(axes[i], at->before));
        const iris_vec3 lever = {way->lever.m[i], way->lever.m[3 + i], way->lever.m[6 + i]};
        set(rows, i, iris_motion_moved(at, k, own));
        set(rows, MOUNT + i, iris_motion_moved(at, k, iris_vec3_sub(own, before)));
        set(rows, PLACE + i, iris_motion_moved(at, k, iris_vec3_scale(lever, at->inverse)));
    }
}
