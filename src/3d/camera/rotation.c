#include "iris/3d/rotation.h"

#define LOCKED 4096 /* 2^-20: pan and roll turn about the same axis */

/* What a rotation or an axis cannot have beside 1 is cut off. */
static iris_q32 unit(iris_q32 a)
{
    return a > IRIS_Q32_ONE ? IRIS_Q32_ONE : a < -IRIS_Q32_ONE ? -IRIS_Q32_ONE : a;
}

static iris_mat3 units(const iris_mat3 *r)
{
    iris_mat3 made;
    for (int i = 0; i < 9; i++) {
        made.m[i] = unit(r->m[i]);
    }
    return made;
}

static iris_q32 mul(iris_q32 a, iris_q32 b)
{
    return iris_q32_mul_sat(a, b);
}

void iris_rotation_about(iris_mat3 *r, iris_vec3 axis, iris_q32 radians)
{
    iris_q32 s, c;
    iris_q32_sin_cos(&s, &c, radians);
    axis = (iris_vec3){unit(axis.x), unit(axis.y), unit(axis.z)};
    iris_vec3 v = iris_vec3_scale(axis, IRIS_Q32_ONE - c), w = iris_vec3_scale(axis, s);
    *r = (iris_mat3){{c + mul(v.x, axis.x), mul(v.x, axis.y) - w.z, mul(v.x, axis.z) + w.y,
                      mul(v.x, axis.y) + w.z, c + mul(v.y, axis.y), mul(v.y, axis.z) - w.x,
                      mul(v.x, axis.z) - w.y, mul(v.y, axis.z) + w.x, c + mul(v.z, axis.z)}};
}

void iris_rotation_from_vector(iris_mat3 *r, iris_vec3 v)
{
    iris_vec3 axis;
    if (iris_vec3_normalize(&axis, v) == IRIS_OK) {
        iris_rotation_about(r, axis, iris_vec3_length(v));
    } else {
        iris_mat3_identity(r);
    }
}

iris_vec3 iris_rotation_to_vector(const iris_mat3 *r)
{
    iris_quaternion q = iris_rotation_to_quaternion(r);
    iris_vec3 v = {q.x, q.y, q.z}, axis;
    if (iris_vec3_normalize(&axis, v) != IRIS_OK) {
        return v;
    }
    return iris_vec3_scale(axis, 2 * iris_q32_atan2(iris_vec3_length(v), q.w));
}

void iris_rotation_from_angles(iris_mat3 *r, iris_angles angles)
{
    iris_mat3 pan, tilt, roll;
    iris_rotation_about(&pan, (iris_vec3){IRIS_Q32_ONE, 0, 0}, angles.pan);
    iris_rotation_about(&tilt, (iris_vec3){0, IRIS_Q32_ONE, 0}, angles.tilt);
    iris_rotation_about(&roll, (iris_vec3){0, 0, IRIS_Q32_ONE}, angles.roll);
    iris_mat3_multiply(&tilt, &tilt, &pan);
    iris_mat3_multiply(r, &roll, &tilt);
}

iris_angles iris_rotation_to_angles(const iris_mat3 *r)
{
    const iris_mat3 cut = units(r);
    const iris_q32 *m = cut.m;
    iris_q32 cosine = iris_vec3_length((iris_vec3){m[0], m[3], 0});
    iris_angles angles = {0, iris_q32_atan2(-m[6], cosine), 0};
    if (cosine < LOCKED) {
        angles.roll = iris_q32_atan2(-m[1], m[4]);
    } else {
        angles.pan = iris_q32_atan2(m[7], m[8]);
        angles.roll = iris_q32_atan2(m[3], m[0]);
    }
    return angles;
}

void iris_rotation_from_quaternion(iris_mat3 *r, iris_quaternion q)
{
    iris_vec3 v = {q.x, q.y, q.z}, axis;
    if (iris_vec3_normalize(&axis, v) == IRIS_OK) {
        iris_rotation_about(r, axis, 2 * iris_q32_atan2(iris_vec3_length(v), q.w));
    } else {
        iris_mat3_identity(r);
    }
}

iris_quaternion iris_rotation_to_quaternion(const iris_mat3 *r)
{
    const iris_mat3 cut = units(r);
    const iris_q32 *m = cut.m;
    const iris_q32 trace = m[0] + m[4] + m[8];
    const iris_q32 largest[4] = {trace, m[0], m[4], m[8]};
    iris_q32 part[4]; /* w x, y, z */
    int best = 0;
    for (int i = 1; i < 4; i++) {
        best = largest[i] > largest[best] ? i : best;
    }
    iris_q32 square =
        IRIS_Q32_ONE + (best ? 2 * largest[best] - trace : trace); /* of twice the largest part */
    iris_q32 twice = iris_q32_sqrt(square);
    if (best == 0) {
        part[1] = m[7] - m[5];
        part[2] = m[2] - m[6];
        part[3] = m[3] - m[1];
    } else {
        int a = best - 1, b = best % 3, c = (best + 1) % 3;
        part[0] = m[3 * c + b] - m[3 * b + c];
        part[1 + b] = m[3 * b + a] + m[3 * a + b];
        part[1 + c] = m[3 * c + a] + m[3 * a + c];
    }
    for (int i = 0; i < 4; i++) {
        part[i] = i == best ? twice / 2 : iris_q32_div_sat(part[i], 2 * twice);
    }
    iris_quaternion q = {part[0], part[1], part[2], part[3]};
    return q.w >= 0 ? q : (iris_quaternion){-q.w, -q.x, -q.y, -q.z};
}

iris_status iris_rotation_tidy(iris_mat3 *r)
{
    const iris_q32 *m = r->m;
    const iris_vec3 second = {m[3], m[4], m[5]}, third = {m[6], m[7], m[8]};
    iris_vec3 x, z;
    if (iris_vec3_normalize(&x, (iris_vec3){m[0], m[1], m[2]}) != IRIS_OK ||
        iris_vec3_normalize(&z, iris_vec3_cross(x, second)) != IRIS_OK || iris_vec3_dot(z, third) <= 0) {
        return IRIS_ERR_RANGE;
    }
    iris_vec3 y = iris_vec3_cross(z, x);
    *r = (iris_mat3){{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}};
    return IRIS_OK;
}
