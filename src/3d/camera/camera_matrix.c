/* The projective matrix of a camera, and the camera of a projective matrix. */
#include "iris/3d/camera.h"

void iris_sensor_matrix(iris_q32 m[12], const iris_sensor *sensor)
{
    const iris_intrinsics *k = &sensor->intrinsics;
    const iris_mat3 calibration = {{k->alpha_u, k->shear, k->u0, 0, k->alpha_v, k->v0, 0, 0, IRIS_Q32_ONE}};
    iris_mat3 a;
    iris_mat3_multiply(&a, &calibration, &sensor->pose.turn);
    iris_vec3 moved = iris_vec3_sub((iris_vec3){0, 0, 0}, iris_mat3_vector(&a, sensor->pose.place));
    const iris_q32 last[3] = {moved.x, moved.y, moved.z};
    for (int i = 0; i < 12; i++) {
        m[i] = i % 4 == 3 ? last[i / 4] : a.m[3 * (i / 4) + i % 4];
    }
}

static iris_vec3 row_of(const iris_q32 m[12], int row)
{
    return (iris_vec3){m[4 * row], m[4 * row + 1], m[4 * row + 2]};
}

/* a / length, by number. */
static iris_vec3 divided(iris_vec3 a, iris_q32 length)
{
    return (iris_vec3){iris_q32_div_sat(a.x, length), iris_q32_div_sat(a.y, length),
                       iris_q32_div_sat(a.z, length)};
}

/* Rows from below: each is what it has of those below it, and a new direction. The signs make all lengths positive. */
static iris_status decompose(iris_intrinsics *k, iris_mat3 *turn, const iris_vec3 rows[3])
{
    iris_vec3 x, y, z;
    if (iris_vec3_normalize(&z, rows[2]) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    k->v0 = iris_vec3_dot(rows[1], z);
    iris_vec3 down = iris_vec3_sub(rows[1], iris_vec3_scale(z, k->v0));
    k->alpha_v = iris_vec3_length(down);
    if (iris_vec3_normalize(&y, down) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    k->u0 = iris_vec3_dot(rows[0], z);
    k->shear = iris_vec3_dot(rows[0], y);
    x = iris_vec3_cross(y, z);
    k->alpha_u = iris_vec3_dot(rows[0], x);
    *turn = (iris_mat3){{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}};
    return k->alpha_u > 0 && k->alpha_v > 0 ? IRIS_OK : IRIS_ERR_RANGE;
}

/* a - b c - d e, with 64 fraction bits. */
static iris_wide rest(iris_q32 a, iris_q32 b, iris_q32 c, iris_q32 d, iris_q32 e)
{
    iris_wide difference = iris_wide_sub(iris_wide_mul(a, IRIS_Q32_ONE), iris_wide_mul(b, c));
    return iris_wide_sub(difference, iris_wide_mul(d, e));
}

iris_status iris_sensor_decompose(iris_sensor *sensor, const iris_q32 m[12])
{
    iris_sensor made = {.lens = {.k1 = 0}};
    iris_q32 length = iris_vec3_length(row_of(m, 2));
    iris_vec3 rows[3];
    if (length == 0) {
        return IRIS_ERR_RANGE;
    }
    /* M of either sign is the same camera: the one with a positive determinant has R without a mirror. */
    if (iris_vec3_dot(iris_vec3_cross(divided(row_of(m, 0), length), divided(row_of(m, 1), length)),
                      divided(row_of(m, 2), length)) < 0) {
        length = -length;
    }
    for (int i = 0; i < 3; i++) {
        rows[i] = divided(row_of(m, i), length);
    }
    if (decompose(&made.intrinsics, &made.pose.turn, rows) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    /* t = -A^-1 b = -R^T (K^-1 b): the ray of b, as long as its last number. */
    iris_vec3 b = divided((iris_vec3){m[3], m[7], m[11]}, -length);
    const iris_intrinsics *k = &made.intrinsics;
    iris_q32 y = iris_wide_div_sat(rest(b.y, k->v0, b.z, 0, 0), k->alpha_v);
    iris_q32 x = iris_wide_div_sat(rest(b.x, k->u0, b.z, k->shear, y), k->alpha_u);
    made.pose.place = iris_mat3_transposed_vector(&made.pose.turn, (iris_vec3){x, y, b.z});
    *sensor = made;
    return IRIS_OK;
}
