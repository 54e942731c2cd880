/* Where two cameras show a point of the board, and how that changes with every parameter: see calib_pair.h. */
#include "pair_parts.h"

#define NEAR  ((iris_q32)1 << 20) /* 2^-12: a depth below is none */
#define WIDE  (8 * IRIS_Q32_ONE)  /* beside the axis, in focal lengths */
#define STEEP ((iris_q32)1 << 50) /* of what changes: equations keep within numbers */
#define STEP  ((iris_q32)1 << 22) /* 2^-10: to see what the lens makes of small distances */

static iris_q32 limited(iris_q32 a)
{
    return a > STEEP ? STEEP : a < -STEEP ? -STEEP : a;
}

static int32_t count_one(const iris_board_problem *of, int32_t v)
{
    return ((const iris_pair_data *)of->user)->views[v].count;
}

static int32_t count_both(const iris_board_problem *of, int32_t v)
{
    return 2 * count_one(of, v);
}

static iris_board_seen point_of(const iris_board_problem *of, int32_t v, int32_t i, int is_right)
{
    const iris_pair_data *data = of->user;
    const iris_pair_seen *seen = &data->seen[data->first[v] + i];
    const iris_board_point point = {data->views[v].points[i].board, seen->straight[is_right]};
    return (iris_board_seen){iris_board_scaled(of, &point), seen->weights[is_right], is_right};
}

static iris_board_seen point_left(const iris_board_problem *of, int32_t v, int32_t i)
{
    return point_of(of, v, i, 0);
}

static iris_board_seen point_right(const iris_board_problem *of, int32_t v, int32_t i)
{
    return point_of(of, v, i, 1);
}

static iris_board_seen point_both(const iris_board_problem *of, int32_t v, int32_t i)
{
    const int32_t count = count_one(of, v);
    return i < count ? point_of(of, v, i, 0) : point_of(of, v, i - count, 1);
}

static int show_one(iris_vec2 *missing, iris_board_rows *rows, const iris_board_problem *of,
                    const iris_q32 shared[IRIS_BOARD_PARAMETERS], const iris_board_motion *motion,
                    const iris_board_seen *seen)
{
    (void)of;
    return iris_board_show(missing, rows, shared, motion, &seen->at);
}

const iris_board_source iris_pair_left = {count_one, point_left, show_one},
                        iris_pair_right = {count_one, point_right, show_one},
                        iris_pair_both = {count_both, point_both, iris_pair_show};

/* What the lens shows beside p, a step to both sides along one axis: by how much that is apart, per focal length. */
static iris_vec2 slope(const iris_lens *lens, iris_vec2 p, iris_q32 x, iris_q32 y)
{
    const iris_vec2 a = iris_lens_bend(lens, (iris_vec2){p.x + x, p.y + y}),
                    b = iris_lens_bend(lens, (iris_vec2){p.x - x, p.y - y});
    return (iris_vec2){iris_q32_div_sat(a.x - b.x, 2 * STEP), iris_q32_div_sat(a.y - b.y, 2 * STEP)};
}

int iris_pair_see(iris_pair_seen *seen, const iris_pair_point *point, const iris_sensor cameras[2],
                  iris_q32 ref)
{
    const iris_vec2 pixels[2] = {point->left, point->right};
    for (int k = 0; k < 2; k++) {
        const iris_intrinsics *in = &cameras[k].intrinsics;
        const iris_lens *lens = &cameras[k].lens;
        iris_vec2 place, *p = &seen->straight[k];
        if (iris_intrinsics_plane(&place, in, pixels[k]) != IRIS_OK ||
            iris_lens_straighten(p, lens, place) != IRIS_OK || p->x > WIDE || p->x < -WIDE || p->y > WIDE ||
            p->y < -WIDE) {
            return 0;
        }
        const iris_vec2 by_x = slope(lens, *p, STEP, 0), by_y = slope(lens, *p, 0, STEP);
        const iris_q32 u = iris_q32_div_sat(in->alpha_u, ref), v = iris_q32_div_sat(in->alpha_v, ref);
        const iris_q32 shear = iris_q32_div_sat(in->shear, ref);
        seen->weights[k][0] = limited(iris_q32_mul_sat(u, by_x.x)) + limited(iris_q32_mul_sat(shear, by_x.y));
        seen->weights[k][1] = limited(iris_q32_mul_sat(u, by_y.x)) + limited(iris_q32_mul_sat(shear, by_y.y));
        seen->weights[k][2] = limited(iris_q32_mul_sat(v, by_x.y));
        seen->weights[k][3] = limited(iris_q32_mul_sat(v, by_y.y));
    }
    return 1;
}

/* The turn from the left to the right camera by the shared parameters; the last one is kept. */
static const iris_mat3 *turn_of(iris_pair_data *data, const iris_q32 *shared)
{
    if (shared[0] != data->turned[0] || shared[1] != data->turned[1] || shared[2] != data->turned[2]) {
        iris_rotation_from_vector(&data->turn, (iris_vec3){shared[0], shared[1], shared[2]});
        iris_mat3_multiply(&data->turn, &data->turn, &data->start);
        for (int i = 0; i < 3; i++) {
            data->turned[i] = shared[i];
        }
    }
    return &data->turn;
}

/* The row of a coordinate that changes with the place on the picture plane by the two weights. from: the place in the
 * camera that sees it; turn: to this one from the left one, null in the left one. */
static void put_row(iris_q32 *row, const iris_q32 *weights, iris_vec3 from, iris_vec3 arm,
                    const iris_mat3 *turn)
{
    const iris_vec2 plane = {iris_q32_div_sat(from.x, from.z), iris_q32_div_sat(from.y, from.z)};
    iris_vec3 by = iris_board_by_place(weights[0], weights[1], plane, from.z);
    if (turn) {
        iris_q32 *shared = row + IRIS_BOARD_POSE;
        const iris_vec3 turned = iris_vec3_cross(from, by);
        by = iris_mat3_transposed_vector(turn, by);
        const iris_q32 made[IRIS_PAIR_PARAMETERS] = {turned.x,       turned.y,       turned.z,
                                                     -limited(by.x), -limited(by.y), -limited(by.z)};
        for (int i = 0; i < IRIS_PAIR_PARAMETERS; i++) {
            shared[i] = limited(made[i]);
        }
    }
    iris_board_pose_row(row, by, arm);
}

int iris_pair_show(iris_vec2 *missing, iris_board_rows *rows, const iris_board_problem *of,
                   const iris_q32 shared[IRIS_BOARD_PARAMETERS], const iris_board_motion *motion,
                   const iris_board_seen *seen)
{
    const iris_vec3 board = {seen->at.board.x, seen->at.board.y, 0},
                    arm = iris_mat3_vector(&motion->turn, board);
    const iris_mat3 *turn = seen->is_right ? turn_of(of->user, shared) : NULL;
    const iris_q32 *w = seen->weights;
    iris_vec3 from = iris_vec3_add(arm, motion->shift);
    if (turn) {
        from = iris_mat3_vector(turn, iris_vec3_sub(from, (iris_vec3){shared[3], shared[4], shared[5]}));
    }
    if (from.z < NEAR) {
        return 0;
    }
    const iris_q32 x = iris_q32_div_sat(from.x, from.z), y = iris_q32_div_sat(from.y, from.z);
    if (x > WIDE || x < -WIDE || y > WIDE || y < -WIDE) {
        return 0;
    }
    const iris_q32 off_x = seen->at.image.x - x, off_y = seen->at.image.y - y;
    missing->x = limited(iris_q32_mul_sat(w[0], off_x)) + limited(iris_q32_mul_sat(w[1], off_y));
    missing->y = limited(iris_q32_mul_sat(w[2], off_x)) + limited(iris_q32_mul_sat(w[3], off_y));
    if (rows) {
        *rows = (iris_board_rows){{0}, {0}};
        put_row(rows->right, w, from, arm, turn);
        put_row(rows->down, w + 2, from, arm, turn);
        rows->right[IRIS_BOARD_UNKNOWNS] = missing->x;
        rows->down[IRIS_BOARD_UNKNOWNS] = missing->y;
    }
    return 1;
}
