/* Levenberg and Marquardt's steps, a view at a time: see calib_board.h for the method. */
#include "board_parts.h"

#define ROUNDS   60
#define DAMPING  (IRIS_Q32_ONE / 256)
#define ENDS     ((iris_q32)1 << 42)
#define ENOUGH   32 /* bits by which the sum is less than what a round gains */
#define POSE     IRIS_BOARD_POSE
#define UNKNOWN  ((iris_q32)1 << 58) /* a deviation that is none: the parameter is left open */
#define STEEPEST (64 * IRIS_Q32_ONE) /* of a parameter: such a camera is none */

static void add_damping(const iris_triangle *triangle, int count, iris_q32 damping)
{
    for (int k = 0; k < count && damping > 0; k++) {
        iris_q32 row[IRIS_BOARD_UNKNOWNS + 1] = {0};
        row[k] = damping;
        iris_triangle_add(triangle, row);
    }
}

/* The row of the active unknowns alone. */
static void add_row(iris_board_problem *of, const iris_q32 *all)
{
    iris_q32 row[IRIS_BOARD_UNKNOWNS + 1];
    for (int k = 0; k < POSE; k++) {
        row[k] = all[k];
    }
    for (int k = 0; k < of->active_count; k++) {
        row[POSE + k] = all[POSE + of->active[k]];
    }
    row[POSE + of->active_count] = all[IRIS_BOARD_UNKNOWNS];
    iris_triangle_add(&of->view, row);
}

/* A view's triangle; adds to the sum of squared distances. Returns 0: a point is behind the camera. */
static int take_view(iris_wide *sum, iris_board_problem *of, int32_t v, iris_q32 damping)
{
    iris_triangle_init(&of->view, of->view.numbers, POSE + of->active_count);
    const int32_t count = of->source->count(of, v);
    for (int32_t i = 0; i < count; i++) {
        const iris_board_seen seen = of->source->point(of, v, i);
        iris_board_rows rows;
        iris_vec2 off;
        if (!of->source->show(&off, &rows, of, of->shared, &of->motions[v], &seen)) {
            return 0;
        }
        *sum = iris_wide_add(*sum, iris_wide_add(iris_wide_mul(off.x, off.x), iris_wide_mul(off.y, off.y)));
        add_row(of, rows.right);
        add_row(of, rows.down);
    }
    add_damping(&of->view, POSE, damping);
    return 1;
}

/* What all views say of the shared parameters, into their triangle. */
static int take_all(iris_wide *sum, iris_board_problem *of, iris_q32 damping)
{
    const int n = of->active_count;
    *sum = (iris_wide){0, 0};
    iris_triangle_init(&of->all, of->all.numbers, n);
    for (int32_t v = 0; v < of->count; v++) {
        if (!take_view(sum, of, v, damping)) {
            return 0;
        }
        for (int j = 0; j < n; j++) {
            iris_q32 row[IRIS_BOARD_PARAMETERS + 1] = {0};
            for (int k = j; k <= n; k++) {
                row[k] = *iris_triangle_at(&of->view, POSE + j, POSE + k);
            }
            iris_triangle_add(&of->all, row);
        }
    }
    add_damping(&of->all, n, damping);
    return 1;
}

static iris_q32 sum_of(iris_q32 a, iris_q32 b)
{
    return iris_wide_round_shift_sat(iris_wide_add(iris_wide_from(a), iris_wide_from(b)), 0);
}

/* The motion of a view after the step of the shared parameters: what its triangle says of its own six. */
static int move_view(iris_board_problem *of, int32_t v, const iris_q32 *shared_step)
{
    const int n = of->view.n;
    iris_q32 step[IRIS_BOARD_UNKNOWNS] = {0};
    for (int k = 0; k < of->active_count; k++) {
        step[POSE + k] = shared_step[k];
    }
    for (int i = POSE - 1; i >= 0; i--) {
        const iris_q32 *row = iris_triangle_at(&of->view, i, 0);
        iris_wide sum = iris_wide_mul(row[n], IRIS_Q32_ONE);
        for (int k = i + 1; k < n; k++) {
            sum = iris_wide_sub(sum, iris_wide_mul(row[k], step[k]));
        }
        if (row[i] == 0) {
            return 0;
        }
        step[i] = iris_wide_div_sat(sum, row[i]);
    }
    iris_mat3 turn;
    iris_rotation_from_vector(&turn, (iris_vec3){step[0], step[1], step[2]});
    iris_mat3_multiply(&of->trial[v].turn, &turn, &of->motions[v].turn);
    of->trial[v].shift = iris_vec3_add(of->motions[v].shift, (iris_vec3){step[3], step[4], step[5]});
    return iris_rotation_tidy(&of->trial[v].turn) == IRIS_OK;
}

/* A step: trial motions, and in `shared` the parameters. */
static int try_step(iris_q32 shared[IRIS_BOARD_PARAMETERS], iris_board_problem *of, iris_q32 damping)
{
    iris_q32 step[IRIS_BOARD_PARAMETERS];
    iris_wide sum = {0, 0};
    if (!iris_triangle_solve(step, &of->all, 1)) {
        return 0;
    }
    for (int i = 0; i < IRIS_BOARD_PARAMETERS; i++) {
        shared[i] = of->shared[i];
    }
    for (int k = 0; k < of->active_count; k++) {
        iris_q32 *to = &shared[of->active[k]];
        *to = sum_of(*to, step[k]);
        if (*to > STEEPEST || *to < -STEEPEST) {
            return 0;
        }
    }
    int good = 1;
    for (int32_t v = 0; v < of->count && good; v++) {
        good = take_view(&sum, of, v, damping) && move_view(of, v, step);
    }
    return good;
}

/* The sum of squared distances of a trial. */
static int measure(iris_wide *sum, const iris_board_problem *of, const iris_q32 shared[IRIS_BOARD_PARAMETERS])
{
    *sum = (iris_wide){0, 0};
    for (int32_t v = 0; v < of->count; v++) {
        const int32_t count = of->source->count(of, v);
        for (int32_t i = 0; i < count; i++) {
            const iris_board_seen seen = of->source->point(of, v, i);
            iris_vec2 off;
            if (!of->source->show(&off, 0, of, shared, &of->trial[v], &seen)) {
                return 0;
            }
            *sum =
                iris_wide_add(*sum, iris_wide_add(iris_wide_mul(off.x, off.x), iris_wide_mul(off.y, off.y)));
        }
    }
    return 1;
}

static void take_trial(iris_board_problem *of, const iris_q32 shared[IRIS_BOARD_PARAMETERS])
{
    iris_board_motion *old = of->motions;
    of->motions = of->trial;
    of->trial = old;
    for (int i = 0; i < IRIS_BOARD_PARAMETERS; i++) {
        of->shared[i] = shared[i];
    }
}

int iris_board_refine(iris_board_problem *of)
{
    iris_q32 shared[IRIS_BOARD_PARAMETERS], damping = DAMPING;
    iris_wide least, sum;
    int known = take_all(&least, of, damping);
    for (int round = 0; round < ROUNDS && known && damping < ENDS; round++) {
        int good = try_step(shared, of, damping) && measure(&sum, of, shared);
        iris_wide gain = good ? iris_wide_sub(least, sum) : (iris_wide){-1, 0};
        if (gain.high >= 0 && iris_wide_bits(gain) > 0) {
            take_trial(of, shared);
            damping = damping / 8 + 1;
            int done = iris_wide_bits(gain) + ENOUGH < iris_wide_bits(least);
            known = take_all(&least, of, damping);
            if (done) {
                break;
            }
        } else {
            damping *= 16;
            known = take_all(&least, of, damping);
        }
    }
    return known;
}

void iris_board_deviations(iris_q32 deviations[IRIS_BOARD_PARAMETERS], iris_board_problem *of)
{
    iris_wide sum;
    const int n = of->active_count;
    (void)take_all(&sum, of, 0);
    for (int k = 0; k < IRIS_BOARD_PARAMETERS; k++) {
        deviations[k] = 0;
    }
    for (int k = 0; k < n; k++) { /* the length of R^-T e_k */
        iris_q32 y[IRIS_BOARD_PARAMETERS] = {0};
        for (int i = k; i < n; i++) {
            iris_wide rest = iris_wide_from(0);
            for (int j = k; j < i; j++) {
                rest = iris_wide_sub(rest, iris_wide_mul(*iris_triangle_at(&of->all, j, i), y[j]));
            }
            if (i == k) {
                rest = iris_wide_mul(IRIS_Q32_ONE, IRIS_Q32_ONE / 1024);
            }
            y[i] = iris_wide_div_sat(rest, *iris_triangle_at(&of->all, i, i));
            if (y[i] > UNKNOWN || y[i] < -UNKNOWN) { /* further sums would not fit */
                y[k] = INT64_MAX;
                break;
            }
        }
        deviations[of->active[k]] = iris_numbers_length(y, n);
    }
}
