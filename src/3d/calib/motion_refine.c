/* Levenberg and Marquardt's steps, a pair at a time: see calib_motion.h. */
#include "motion_parts.h"

#define DAMPING  (IRIS_Q32_ONE / 256)
#define ENDS     ((iris_q32)1 << 42)
#define ENOUGH   32                  /* bits by which the sum is less than what a round gains */
#define STEEPEST (64 * IRIS_Q32_ONE) /* of a parameter */

/* How many unknowns of a pair are its own. */
static int own_of(const iris_motion_problem *of)
{
    return of->known ? 0 : IRIS_MOTION_OWN;
}

int32_t iris_motion_squares(iris_wide *sum, const iris_motion_problem *of, const iris_motion_camera *camera,
                            const iris_mat3 *turns, int32_t v)
{
    int32_t equations = 0;
    const int32_t first = v < 0 ? 0 : v, last = v < 0 ? of->count : v + 1;
    *sum = (iris_wide){0, 0};
    for (int32_t i = first; i < last; i++) {
        iris_motion_way way;
        iris_motion_way_of(&way, of, camera, turns, i);
        for (int32_t k = 0; k < of->pairs[i].count; k++) {
            const iris_match match = iris_motion_scaled(of, &of->pairs[i].matches[k]);
            iris_motion_rows rows;
            if (!iris_motion_show(&rows, camera, &way, &match, 0)) {
                return 0;
            }
            for (int r = 0; r < rows.count; r++) {
                const iris_q32 off = rows.row[r][IRIS_MOTION_OWN + IRIS_MOTION_SHARED];
                *sum = iris_wide_add(*sum, iris_wide_mul(off, off));
            }
            equations += rows.count;
        }
    }
    return equations;
}

/* The row of a pair's own and the active unknowns alone. With square pixels both focal lengths are one. */
static void add_row(iris_motion_problem *of, const iris_q32 *all)
{
    iris_q32 row[IRIS_MOTION_OWN + IRIS_MOTION_SHARED + 1] = {0};
    const int own = own_of(of);
    for (int k = 0; k < own; k++) {
        row[k] = all[k];
    }
    for (int k = 0; k < of->active_count; k++) {
        row[own + k] = all[IRIS_MOTION_OWN + of->active[k]];
    }
    if (!(of->model & IRIS_MOTION_ASPECT)) {
        row[own] += all[IRIS_MOTION_OWN + IRIS_MOTION_ALPHA_V];
    }
    row[own + of->active_count] = all[IRIS_MOTION_OWN + IRIS_MOTION_SHARED];
    iris_triangle_add(&of->pair, row);
}

static void add_damping(const iris_triangle *triangle, int count, iris_q32 damping)
{
    for (int k = 0; k < count && damping > 0; k++) {
        iris_q32 row[IRIS_MOTION_OWN + IRIS_MOTION_SHARED + 1] = {0};
        row[k] = damping;
        iris_triangle_add(triangle, row);
    }
}

/* The triangle of pair v. */
static int take_pair(iris_motion_problem *of, int32_t v, iris_q32 damping)
{
    iris_motion_way way;
    iris_motion_way_of(&way, of, &of->camera, of->turns, v);
    iris_triangle_init(&of->pair, of->pair.numbers, own_of(of) + of->active_count);
    for (int32_t i = 0; i < of->pairs[v].count; i++) {
        const iris_match match = iris_motion_scaled(of, &of->pairs[v].matches[i]);
        iris_motion_rows rows;
        if (!iris_motion_show(&rows, &of->camera, &way, &match, 1)) {
            return 0;
        }
        for (int r = 0; r < rows.count; r++) {
            add_row(of, rows.row[r]);
        }
    }
    add_damping(&of->pair, own_of(of), damping);
    return 1;
}

/* What all pairs say of the shared parameters, into their triangle. */
static int take_all(iris_motion_problem *of, iris_q32 damping)
{
    const int n = of->active_count, own = own_of(of);
    iris_triangle_init(&of->all, of->all.numbers, n);
    for (int32_t v = 0; v < of->count; v++) {
        if (!take_pair(of, v, damping)) {
            return 0;
        }
        for (int j = 0; j < n; j++) {
            iris_q32 row[IRIS_MOTION_SHARED + 1] = {0};
            for (int k = j; k <= n; k++) {
                row[k] = *iris_triangle_at(&of->pair, own + j, own + k);
            }
            iris_triangle_add(&of->all, row);
        }
    }
    add_damping(&of->all, n, damping);
    return 1;
}

/* Turns r by a small vector. */
static int turn_by(iris_mat3 *r, const iris_mat3 *from, const iris_q32 by[3])
{
    iris_mat3 turn;
    iris_rotation_from_vector(&turn, (iris_vec3){by[0], by[1], by[2]});
    iris_mat3_multiply(r, &turn, from);
    return iris_rotation_tidy(r) == IRIS_OK;
}

/* A pair's own turn after the step of the shared parameters. */
static int move_pair(iris_motion_problem *of, int32_t v, const iris_q32 *shared_step)
{
    const int n = of->pair.n;
    iris_q32 step[IRIS_MOTION_OWN + IRIS_MOTION_SHARED] = {0};
    for (int k = 0; k < of->active_count; k++) {
        step[IRIS_MOTION_OWN + k] = shared_step[k];
    }
    for (int i = IRIS_MOTION_OWN - 1; i >= 0; i--) {
        const iris_q32 *row = iris_triangle_at(&of->pair, i, 0);
        iris_wide sum = iris_wide_mul(row[n], IRIS_Q32_ONE);
        for (int k = i + 1; k < n; k++) {
            sum = iris_wide_sub(sum, iris_wide_mul(row[k], step[k]));
        }
        if (row[i] == 0) {
            return 0;
        }
        step[i] = iris_wide_div_sat(sum, row[i]);
    }
    return turn_by(&of->trial[v], &of->turns[v], step);
}

static iris_q32 sum_of(iris_q32 a, iris_q32 b)
{
    return iris_wide_round_shift_sat(iris_wide_add(iris_wide_from(a), iris_wide_from(b)), 0);
}

/* The camera after the step, whose numbers are those of the active parameters. */
static int move_camera(iris_motion_camera *to, const iris_motion_problem *of, const iris_q32 *step)
{
    iris_q32 by[IRIS_MOTION_SHARED] = {0};
    *to = of->camera;
    for (int k = 0; k < of->active_count; k++) {
        by[of->active[k]] = step[k];
    }
    if (!(of->model & IRIS_MOTION_ASPECT)) {
        by[IRIS_MOTION_ALPHA_V] = by[IRIS_MOTION_ALPHA_U];
    }
    for (int k = 0; k < IRIS_MOTION_INTRINSICS; k++) {
        to->k[k] = sum_of(to->k[k], by[k]);
        if (to->k[k] > STEEPEST || to->k[k] < -STEEPEST) {
            return 0;
        }
    }
    const iris_q32 *lever = by + IRIS_MOTION_PLACE;
    to->lever = iris_vec3_add(to->lever, (iris_vec3){lever[0], lever[1], lever[2]});
    return to->k[IRIS_MOTION_ALPHA_U] > IRIS_Q32_ONE / 16 && to->k[IRIS_MOTION_ALPHA_V] > IRIS_Q32_ONE / 16 &&
           to->lever.x < STEEPEST && to->lever.x > -STEEPEST && to->lever.y < STEEPEST &&
           to->lever.y > -STEEPEST && to->lever.z < STEEPEST && to->lever.z > -STEEPEST &&
           (!of->known || turn_by(&to->mount, &of->camera.mount, by + IRIS_MOTION_MOUNT));
}

/* A step: trial turns, and a camera. */
static int try_step(iris_motion_camera *to, iris_motion_problem *of, iris_q32 damping)
{
    iris_q32 step[IRIS_MOTION_SHARED];
    if (!iris_triangle_solve(step, &of->all, 1) || !move_camera(to, of, step)) {
        return 0;
    }
    int good = 1;
    for (int32_t v = 0; v < of->count && good && !of->known; v++) {
        good = take_pair(of, v, damping) && move_pair(of, v, step);
    }
    return good;
}

int iris_motion_refine(iris_motion_problem *of, int rounds)
{
    iris_motion_camera to;
    iris_q32 damping = DAMPING;
    iris_wide least, sum;
    int known = iris_motion_squares(&least, of, &of->camera, of->turns, -1) && take_all(of, damping);
    for (int round = 0; round < rounds && known && damping < ENDS; round++) {
        int good = try_step(&to, of, damping) && iris_motion_squares(&sum, of, &to, of->trial, -1);
        iris_wide gain = good ? iris_wide_sub(least, sum) : (iris_wide){-1, 0};
        if (gain.high >= 0 && iris_wide_bits(gain) > 0) {
            iris_mat3 *old = of->turns;
            of->turns = of->trial;
            of->trial = old;
            of->camera = to;
            damping = damping / 8 + 1;
            int done = iris_wide_bits(gain) + ENOUGH < iris_wide_bits(least);
            least = sum;
            known = take_all(of, damping);
            if (done) {
                break;
            }
        } else {
            damping *= 16;
            known = take_all(of, damping);
        }
    }
    return known && take_all(of, 0);
}
