/* The closed form that the refinement begins with: see calib_board.h for the method. */
#include "board_parts.h"

#define NUMBERS  9
#define SECOND   4096 /* of a view: the second smallest singular value is above that share of all */
#define SINGULAR ((iris_q32)1 << 16)
#define FAR      (256 * IRIS_Q32_ONE)
#define USUAL    (IRIS_Q32_ONE / 4) /* of a picture that is 53 degrees wide, where views say little */

static void widen(iris_q32 *low, iris_q32 *high, iris_q32 a)
{
    *low = a < *low ? a : *low;
    *high = a > *high ? a : *high;
}

static iris_q32 half(iris_q32 low, iris_q32 high)
{
    return low / 2 + high / 2;
}

static iris_q32 larger(iris_q32 a, iris_q32 b)
{
    return a > b ? a : b;
}

/* The middle and half of the longer side of all places, on the board and in the picture, whose size may be known. */
static void frame_of(iris_board_problem *of, iris_size size)
{
    iris_q32 low[4], high[4];
    for (int k = 0; k < 4; k++) {
        low[k] = INT64_MAX;
        high[k] = INT64_MIN;
    }
    for (int32_t v = 0; v < of->count; v++) {
        for (int32_t i = 0; i < of->views[v].count; i++) {
            const iris_board_point *p = &of->views[v].points[i];
            widen(&low[0], &high[0], p->board.x);
            widen(&low[1], &high[1], p->board.y);
            widen(&low[2], &high[2], p->image.x);
            widen(&low[3], &high[3], p->image.y);
        }
    }
    if (size.w > 0) {
        low[2] = low[3] = 0;
        high[2] = (size.w - 1) * IRIS_Q32_ONE;
        high[3] = (size.h - 1) * IRIS_Q32_ONE;
    }
    of->frame.board = (iris_vec2){half(low[0], high[0]), half(low[1], high[1])};
    of->frame.image = (iris_vec2){half(low[2], high[2]), half(low[3], high[3])};
    of->frame.board_reach = larger(1, larger(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2));
    of->frame.image_reach = larger(1, larger(high[2] / 2 - low[2] / 2, high[3] / 2 - low[3] / 2));
}

iris_board_point iris_board_scaled(const iris_board_problem *of, const iris_board_point *point)
{
    const iris_board_frame *f = &of->frame;
    iris_board_point made = {{iris_q32_div_sat(point->board.x - f->board.x, f->board_reach),
                              iris_q32_div_sat(point->board.y - f->board.y, f->board_reach)},
                             {iris_q32_div_sat(point->image.x - f->image.x, f->image_reach),
                              iris_q32_div_sat(point->image.y - f->image.y, f->image_reach)}};
    return made;
}

static iris_q32 limited(iris_q32 a)
{
    return a > FAR ? FAR : a < -FAR ? -FAR : a;
}

/* Are a view's places in the picture on one line, or nearly: 1/64 of their spread? */
static int is_line(const iris_board_problem *of, int32_t v)
{
    const int32_t n = of->source->count(of, v);
    iris_q32 x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (int32_t i = 0; i < n; i++) {
        iris_vec2 at = of->source->point(of, v, i).at.image;
        x += limited(at.x) / n;
        y += limited(at.y) / n;
    }
    for (int32_t i = 0; i < n; i++) {
        iris_vec2 at = of->source->point(of, v, i).at.image;
        at = (iris_vec2){limited(at.x) - x, limited(at.y) - y};
        xx += iris_q32_mul_sat(at.x, at.x) / n;
        xy += iris_q32_mul_sat(at.x, at.y) / n;
        yy += iris_q32_mul_sat(at.y, at.y) / n;
    }
    iris_wide across = iris_wide_sub(iris_wide_mul(xx, yy), iris_wide_mul(xy, xy));
    return iris_wide_sub(across, iris_wide_mul((xx + yy) / 4096, xx + yy)).high < 0;
}

/* (X, 1) at the row of `first`, and -t (X, 1) at the last one. */
static void add_equation(const iris_triangle *triangle, const iris_board_point *at, int first, iris_q32 t)
{
    const iris_q32 place[3] = {at->board.x, at->board.y, IRIS_Q32_ONE};
    iris_q32 row[NUMBERS + 1] = {0};
    for (int k = 0; k < 3; k++) {
        row[first + k] = place[k];
        row[6 + k] = -iris_q32_mul_sat(t, place[k]);
    }
    iris_triangle_add(triangle, row);
}

/* The homography of a view, row by row, of length 1. Returns 0 when there is no single one. */
static int homography(iris_q32 h[NUMBERS], const iris_board_problem *of, int32_t v)
{
    iris_q32 second[NUMBERS];
    iris_triangle triangle;
    const int32_t count = of->source->count(of, v);
    iris_triangle_init(&triangle, of->view.numbers, NUMBERS);
    for (int32_t i = 0; i < count; i++) {
        const iris_board_point at = of->source->point(of, v, i).at;
        add_equation(&triangle, &at, 0, at.image.x);
        add_equation(&triangle, &at, 3, at.image.y);
    }
    iris_q32 least = iris_null_vector(h, &triangle);
    iris_q32 next = iris_null_vector_beside(second, &triangle, h);
    iris_q32 all = iris_numbers_length(triangle.numbers, IRIS_TRIANGLE_NUMBERS(NUMBERS));
    return next > all / SECOND && least < next / 2;
}

/* What a homography says of 1 / alpha_u^2 and 1 / alpha_v^2: its first two columns are perpendicular, and of one
 * length, on the picture plane. */
static void add_focal(const iris_triangle *both, const iris_triangle *one, const iris_q32 h[NUMBERS])
{
    iris_q32 rows[2][3];
    for (int k = 0; k < 3; k++) {
        const iris_q32 a = h[3 * k], b = h[3 * k + 1];
        rows[0][k] = iris_q32_mul_sat(a, b);
        rows[1][k] = iris_wide_round_shift_sat(iris_wide_mul(a + b, a - b), 33);
    }
    for (int i = 0; i < 2; i++) {
        iris_q32 row[3] = {rows[i][0], rows[i][1], -rows[i][2]};
        iris_q32 alike[2] = {rows[i][0] + rows[i][1], -rows[i][2]};
        iris_triangle_add(both, row);
        iris_triangle_add(one, alike);
    }
}

/* 1 / sqrt(a) */
static iris_q32 inverse_root(iris_q32 a)
{
    return iris_q32_div_sat(IRIS_Q32_ONE, iris_q32_sqrt(a));
}

/* Is the focal length of such a square within 1/8 to 24 times half of the picture's side? */
static int is_sound(iris_q32 a)
{
    return a > IRIS_Q32_ONE / 576 && a < 64 * IRIS_Q32_ONE;
}

static iris_board_flaw focal_lengths(iris_board_problem *of, int32_t *flawed)
{
    iris_q32 h[NUMBERS], squares[2], numbers[IRIS_TRIANGLE_NUMBERS(2)], lone[IRIS_TRIANGLE_NUMBERS(1)];
    iris_triangle both, one;
    iris_triangle_init(&both, numbers, 2);
    iris_triangle_init(&one, lone, 1);
    for (int32_t v = 0; v < of->count; v++) {
        if (is_line(of, v) || !homography(h, of, v)) {
            *flawed = v;
            return IRIS_BOARD_IN_LINE;
        }
        add_focal(&both, &one, h);
    }
    if (!iris_triangle_solve(squares, &both, SINGULAR) || !is_sound(squares[0]) || !is_sound(squares[1])) {
        if (!iris_triangle_solve(squares, &one, SINGULAR) || !is_sound(squares[0])) {
            squares[0] = USUAL;
        }
        squares[1] = squares[0];
    }
    of->shared[IRIS_BOARD_ALPHA_U] = inverse_root(squares[0]);
    of->shared[IRIS_BOARD_ALPHA_V] = inverse_root(squares[1]);
    return IRIS_BOARD_FINE;
}

/* The motion of a homography. Returns 0 when there is none. */
static int motion_of(iris_board_motion *motion, const iris_board_problem *of, const iris_q32 h[NUMBERS])
{
    iris_vec3 columns[3], x, y;
    int sign = h[8] < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        columns[k] =
            (iris_vec3){iris_q32_div_sat(sign * h[k], of->shared[IRIS_BOARD_ALPHA_U]),
                        iris_q32_div_sat(sign * h[3 + k], of->shared[IRIS_BOARD_ALPHA_V]), sign * h[6 + k]};
    }
    iris_q32 length = half(iris_vec3_length(columns[0]), iris_vec3_length(columns[1]));
    if (iris_vec3_normalize(&x, columns[0]) != IRIS_OK || length == 0) {
        return 0;
    }
    iris_vec3 across = iris_vec3_sub(columns[1], iris_vec3_scale(x, iris_vec3_dot(x, columns[1])));
    if (iris_vec3_normalize(&y, across) != IRIS_OK) {
        return 0;
    }
    iris_vec3 z = iris_vec3_cross(x, y);
    motion->turn = (iris_mat3){{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}};
    motion->shift =
        (iris_vec3){iris_q32_div_sat(columns[2].x, length), iris_q32_div_sat(columns[2].y, length),
                    iris_q32_div_sat(columns[2].z, length)};
    return iris_rotation_tidy(&motion->turn) == IRIS_OK;
}

iris_board_flaw iris_board_poses(iris_board_problem *of, int32_t *flawed)
{
    for (int32_t v = 0; v < of->count; v++) {
        iris_q32 h[NUMBERS];
        iris_vec2 missing;
        int single = !is_line(of, v) && homography(h, of, v),
            seen = single && motion_of(&of->motions[v], of, h);
        for (int32_t i = 0; i < of->source->count(of, v) && seen; i++) {
            const iris_board_seen point = of->source->point(of, v, i);
            seen = of->source->show(&missing, 0, of, of->shared, &of->motions[v], &point);
        }
        if (!seen) {
            *flawed = v;
            return single ? IRIS_BOARD_BEHIND : IRIS_BOARD_IN_LINE;
        }
    }
    return IRIS_BOARD_FINE;
}

iris_board_flaw iris_board_start(iris_board_problem *of, int32_t *flawed, iris_size size)
{
    frame_of(of, size);
    for (int i = 0; i < IRIS_BOARD_PARAMETERS; i++) {
        of->shared[i] = 0;
    }
    iris_board_flaw flaw = focal_lengths(of, flawed);
    return flaw == IRIS_BOARD_FINE ? iris_board_poses(of, flawed) : flaw;
}
