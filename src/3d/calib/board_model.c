/* Where a view shows a point, and how that changes with every parameter. */
#include "board_parts.h"

#define NEAR  ((iris_q32)1 << 20) /* 2^-12: a depth below is none */
#define WIDE  (3 * IRIS_Q32_ONE)  /* beside the axis, in focal lengths */
#define FAR   (64 * IRIS_Q32_ONE) /* from where the picture shows it */
#define STEEP ((iris_q32)1 << 50) /* of what changes: equations keep within numbers */

static iris_q32 mul(iris_q32 a, iris_q32 b)
{
    return iris_q32_mul_sat(a, b);
}

static int is_within(iris_q32 a, iris_q32 limit)
{
    return a <= limit && a >= -limit;
}

static iris_q32 limited(iris_q32 a)
{
    return a > STEEP ? STEEP : a < -STEEP ? -STEEP : a;
}

/* A place on the picture plane, the lens's part in it, and how that changes. */
typedef struct {
    iris_q32 x, y, r2, r4, r6;
    iris_q32 bent_x, bent_y;
    iris_q32 xx, xy, yy; /* slopes of the lens */
} ray;

static void bend(ray *at, const iris_q32 *s)
{
    const iris_q32 k1 = s[IRIS_BOARD_LENS_K1], k2 = s[IRIS_BOARD_LENS_K2], k3 = s[IRIS_BOARD_LENS_K3];
    const iris_q32 p1 = s[IRIS_BOARD_LENS_P1], p2 = s[IRIS_BOARD_LENS_P2], x = at->x, y = at->y;
    const iris_q32 x2 = mul(x, x), y2 = mul(y, y), xy = mul(x, y);
    at->r2 = x2 + y2;
    at->r4 = mul(at->r2, at->r2);
    at->r6 = mul(at->r4, at->r2);
    const iris_q32 stretch = IRIS_Q32_ONE + mul(k1, at->r2) + mul(k2, at->r4) + mul(k3, at->r6);
    const iris_q32 growth = k1 + 2 * mul(k2, at->r2) + 3 * mul(k3, at->r4);
    at->bent_x = mul(x, stretch) + 2 * mul(p1, xy) + mul(p2, at->r2 + 2 * x2);
    at->bent_y = mul(y, stretch) + mul(p1, at->r2 + 2 * y2) + 2 * mul(p2, xy);
    at->xx = stretch + 2 * mul(x2, growth) + 2 * mul(p1, y) + 6 * mul(p2, x);
    at->xy = 2 * mul(xy, growth) + 2 * mul(p1, x) + 2 * mul(p2, y);
    at->yy = stretch + 2 * mul(y2, growth) + 6 * mul(p1, y) + 2 * mul(p2, x);
}

void iris_board_pose_row(iris_q32 row[IRIS_BOARD_POSE], iris_vec3 by, iris_vec3 arm)
{
    const iris_vec3 turn = iris_vec3_cross(arm, by);
    const iris_q32 made[IRIS_BOARD_POSE] = {turn.x, turn.y, turn.z, by.x, by.y, by.z};
    for (int i = 0; i < IRIS_BOARD_POSE; i++) {
        row[i] = limited(made[i]);
    }
}

iris_vec3 iris_board_by_place(iris_q32 by_x, iris_q32 by_y, iris_vec2 plane, iris_q32 depth)
{
    return (iris_vec3){iris_q32_div_sat(by_x, depth), iris_q32_div_sat(by_y, depth),
                       iris_q32_div_sat(-mul(by_x, plane.x) - mul(by_y, plane.y), depth)};
}

/* The lens's five numbers of a row, for a coordinate that is a times the bent x and b times the bent y. */
static void lens_part(iris_q32 *row, const ray *at, iris_q32 a, iris_q32 b)
{
    const iris_q32 along = mul(a, at->x) + mul(b, at->y), xy = 2 * mul(at->x, at->y);
    const iris_q32 x2 = at->r2 + 2 * mul(at->x, at->x), y2 = at->r2 + 2 * mul(at->y, at->y);
    row[IRIS_BOARD_LENS_K1] = mul(along, at->r2);
    row[IRIS_BOARD_LENS_K2] = mul(along, at->r4);
    row[IRIS_BOARD_LENS_K3] = mul(along, at->r6);
    row[IRIS_BOARD_LENS_P1] = mul(a, xy) + mul(b, y2);
    row[IRIS_BOARD_LENS_P2] = mul(a, x2) + mul(b, xy);
}

int iris_board_show(iris_vec2 *missing, iris_board_rows *rows, const iris_q32 shared[IRIS_BOARD_PARAMETERS],
                    const iris_board_motion *motion, const iris_board_point *point)
{
    const iris_q32 a = shared[IRIS_BOARD_ALPHA_U], b = shared[IRIS_BOARD_ALPHA_V],
                   s = shared[IRIS_BOARD_SKEW];
    const iris_vec3 arm = iris_mat3_vector(&motion->turn, (iris_vec3){point->board.x, point->board.y, 0});
    const iris_vec3 from = iris_vec3_add(arm, motion->shift);
    ray at;
    if (from.z < NEAR || a <= 0 || b <= 0) {
        return 0;
    }
    at.x = iris_q32_div_sat(from.x, from.z);
    at.y = iris_q32_div_sat(from.y, from.z);
    if (!is_within(at.x, WIDE) || !is_within(at.y, WIDE)) {
        return 0;
    }
    bend(&at, shared);
    missing->x = point->image.x - mul(a, at.bent_x) - mul(s, at.bent_y) - shared[IRIS_BOARD_U0];
    missing->y = point->image.y - mul(b, at.bent_y) - shared[IRIS_BOARD_V0];
    if (rows) {
        const iris_vec2 plane = {at.x, at.y};
        *rows = (iris_board_rows){{0}, {0}};
        iris_board_pose_row(
            rows->right,
            iris_board_by_place(mul(a, at.xx) + mul(s, at.xy), mul(a, at.xy) + mul(s, at.yy), plane, from.z),
            arm);
        iris_board_pose_row(rows->down, iris_board_by_place(mul(b, at.xy), mul(b, at.yy), plane, from.z),
                            arm);
        iris_q32 *right = rows->right + IRIS_BOARD_POSE, *down = rows->down + IRIS_BOARD_POSE;
        right[IRIS_BOARD_ALPHA_U] = at.bent_x;
        right[IRIS_BOARD_SKEW] = at.bent_y;
        right[IRIS_BOARD_U0] = IRIS_Q32_ONE;
        down[IRIS_BOARD_ALPHA_V] = at.bent_y;
        down[IRIS_BOARD_V0] = IRIS_Q32_ONE;
        lens_part(right, &at, a, s);
        lens_part(down, &at, 0, b);
        rows->right[IRIS_BOARD_UNKNOWNS] = missing->x;
        rows->down[IRIS_BOARD_UNKNOWNS] = missing->y;
    }
    return is_within(missing->x, FAR) && is_within(missing->y, FAR);
}
