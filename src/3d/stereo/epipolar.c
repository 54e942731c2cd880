#include "iris/3d/epipolar.h"

#define ALPHA_MIN ((iris_q32)1 << 24)
#define ALPHA_MAX ((iris_q32)1 << 46)
#define SEES      ((iris_q32)1 << 18) /* sine between a ray and the baseline: below, it goes to the other camera */
#define FLAT      ((iris_q32)1 << 26) /* the plane's tilt against the picture plane: below, they are parallel */

/* From the left camera to the right one: the turn, and the baseline's direction in the right one's frame. */
static iris_status between(iris_mat3 *turn, iris_vec3 *baseline, const iris_pose *left,
                           const iris_pose *right)
{
    iris_mat3 back;
    iris_vec3 direction;
    iris_status status = iris_vec3_normalize(&direction, iris_vec3_sub(left->place, right->place));
    if (status == IRIS_OK) {
        iris_mat3_transpose(&back, &left->turn);
        iris_mat3_multiply(turn, &right->turn, &back);
        *baseline = iris_mat3_vector(&right->turn, direction);
    }
    return status;
}

iris_status iris_epipolar_essential(iris_mat3 *e, const iris_pose *left, const iris_pose *right)
{
    iris_mat3 turn;
    iris_vec3 t;
    iris_status status = between(&turn, &t, left, right);
    if (status == IRIS_OK) {
        const iris_vec3 back = iris_vec3_sub((iris_vec3){0, 0, 0}, t);
        const iris_mat3 cross = {{0, back.z, t.y, t.z, 0, back.x, back.y, t.x, 0}};
        iris_mat3_multiply(e, &cross, &turn);
    }
    return status;
}

/* K^-1 times alpha_u alpha_v: nothing is rounded away that K^-1 would make small.
 *     (alpha_v, -shear, shear v0 - alpha_v u0; 0, alpha_u, -alpha_u v0; 0, 0, alpha_u alpha_v) */
static void adjugate(iris_mat3 *made, const iris_intrinsics *k)
{
    const iris_q32 corner = iris_wide_round_shift_sat(
        iris_wide_sub(iris_wide_mul(k->shear, k->v0), iris_wide_mul(k->alpha_v, k->u0)), 32);
    const iris_q32 tilt = iris_wide_round_shift_sat(iris_wide_negate(iris_wide_from(k->shear)), 0);
    *made = (iris_mat3){{k->alpha_v, tilt, corner, 0, k->alpha_u, iris_q32_mul_sat(-k->alpha_u, k->v0), 0, 0,
                         iris_q32_mul_sat(k->alpha_u, k->alpha_v)}};
}

/* a b, or a^T b, with the largest number of `bits` bits. */
static void multiply(iris_mat3 *product, const iris_mat3 *a, int transposed, const iris_mat3 *b, int bits)
{
    iris_wide made[9];
    int most = bits;
    for (int i = 0; i < 9; i++) {
        made[i] = (iris_wide){0, 0};
        for (int k = 0; k < 3; k++) {
            const iris_q32 factor = transposed ? a->m[3 * k + i / 3] : a->m[i / 3 * 3 + k];
            made[i] = iris_wide_add(made[i], iris_wide_mul(factor, b->m[3 * k + i % 3]));
        }
        const int has = iris_wide_bits(made[i]);
        most = has > most ? has : most;
    }
    for (int i = 0; i < 9; i++) {
        product->m[i] = iris_wide_round_shift_sat(made[i], most - bits);
    }
}

static int is_sound(const iris_intrinsics *k)
{
    return k->alpha_u >= ALPHA_MIN && k->alpha_v >= ALPHA_MIN && k->alpha_u <= ALPHA_MAX &&
           k->alpha_v <= ALPHA_MAX;
}

iris_status iris_epipolar_fundamental(iris_mat3 *f, const iris_sensor *left, const iris_sensor *right)
{
    iris_mat3 e, from, to;
    if (!is_sound(&left->intrinsics) || !is_sound(&right->intrinsics)) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = iris_epipolar_essential(&e, &left->pose, &right->pose);
    if (status == IRIS_OK) {
        adjugate(&from, &left->intrinsics);
        adjugate(&to, &right->intrinsics);
        multiply(&e, &e, 0, &from, 61);
        multiply(f, &to, 1, &e, 57);
    }
    return status;
}

iris_q32 iris_line2_distance(const iris_line2 *line, iris_vec2 p)
{
    return iris_vec3_dot((iris_vec3){line->a, line->b, line->c}, (iris_vec3){p.x, p.y, IRIS_Q32_ONE});
}

iris_status iris_epipolar_line(iris_line2 *line, const iris_sensor *left, const iris_sensor *right,
                               iris_vec2 pixel)
{
    iris_line3 ray;
    iris_vec3 baseline, normal;
    iris_status status = iris_sensor_ray(&ray, left, pixel);
    if (status == IRIS_OK) {
        status = iris_vec3_normalize(&baseline, iris_vec3_sub(left->pose.place, right->pose.place));
    }
    if (status != IRIS_OK) {
        return status;
    }
    const iris_vec3 across = iris_vec3_cross(baseline, ray.direction);
    if (iris_vec3_length(across) < SEES || iris_vec3_normalize(&normal, across) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    normal = iris_mat3_vector(&right->pose.turn, normal);
    const iris_q32 steep = iris_vec3_length((iris_vec3){normal.x, normal.y, 0});
    if (steep < FLAT) {
        return IRIS_ERR_RANGE;
    }
    *line = (iris_line2){iris_q32_div_sat(normal.x, steep), iris_q32_div_sat(normal.y, steep),
                         iris_q32_div_sat(normal.z, steep)};
    return IRIS_OK;
}

iris_status iris_epipolar_miss(iris_q32 *pixels, const iris_sensor *left, const iris_sensor *right,
                               iris_vec2 left_pixel, iris_vec2 right_pixel)
{
    iris_line2 line;
    iris_vec2 seen, straight;
    iris_status status = iris_epipolar_line(&line, left, right, left_pixel);
    status = status == IRIS_OK ? iris_intrinsics_plane(&seen, &right->intrinsics, right_pixel) : status;
    status = status == IRIS_OK ? iris_lens_straighten(&straight, &right->lens, seen) : status;
    if (status == IRIS_OK) {
        const iris_q32 off = iris_line2_distance(&line, straight);
        const iris_q32 alpha = right->intrinsics.alpha_u / 2 + right->intrinsics.alpha_v / 2;
        *pixels = iris_q32_mul_sat(off < 0 ? (off == INT64_MIN ? INT64_MAX : -off) : off, alpha);
    }
    return status;
}
