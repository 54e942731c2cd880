/* The pair that the refinement begins with: see calib_pair.h for the method. */
#include <string.h>

#include "pair_parts.h"

/* The middle and half of the longer side of all places on the board. */
static void frame_of(iris_pair_work *w)
{
    iris_q32 low[2] = {INT64_MAX, INT64_MAX}, high[2] = {INT64_MIN, INT64_MIN};
    for (int32_t v = 0; v < w->of.count; v++) {
        for (int32_t i = 0; i < w->data.views[v].count; i++) {
            const iris_vec2 at = w->data.views[v].points[i].board;
            low[0] = at.x < low[0] ? at.x : low[0];
            low[1] = at.y < low[1] ? at.y : low[1];
            high[0] = at.x > high[0] ? at.x : high[0];
            high[1] = at.y > high[1] ? at.y : high[1];
        }
    }
    const iris_q32 wide = high[0] / 2 - low[0] / 2, tall = high[1] / 2 - low[1] / 2;
    const iris_q32 reach = wide > tall ? wide : tall;
    w->of.frame.board = (iris_vec2){low[0] / 2 + high[0] / 2, low[1] / 2 + high[1] / 2};
    w->of.frame.board_reach = reach > 1 ? reach : 1;
    w->of.frame.image = (iris_vec2){0, 0};
    w->of.frame.image_reach = IRIS_Q32_ONE;
}

static iris_pair_flaw see_all(int32_t *flawed, iris_pair_work *w, const iris_sensor cameras[2])
{
    int32_t next = 0;
    for (int32_t v = 0; v < w->of.count; v++) {
        const iris_pair_view *view = &w->data.views[v];
        w->first[v] = next;
        *flawed = v;
        if (view->count < IRIS_BOARD_POINTS_MIN) {
            return IRIS_PAIR_TOO_FEW;
        }
        for (int32_t i = 0; i < view->count; i++) {
            if (!iris_pair_see(&w->seen[next++], &view->points[i], cameras, w->ref)) {
                return IRIS_PAIR_NO_RAY;
            }
        }
    }
    *flawed = -1;
    return w->of.count > 0 ? IRIS_PAIR_FINE : IRIS_PAIR_TOO_FEW;
}

/* The board's poses before one camera alone. */
static iris_pair_flaw poses_of(int32_t *flawed, iris_pair_work *w, int k)
{
    w->of.source = k ? &iris_pair_right : &iris_pair_left;
    w->of.motions = w->motions[k];
    w->of.active_count = 0;
    memset(w->of.shared, 0, sizeof w->of.shared);
    w->of.shared[IRIS_BOARD_ALPHA_U] = w->of.shared[IRIS_BOARD_ALPHA_V] = IRIS_Q32_ONE;
    const iris_board_flaw flaw = iris_board_poses(&w->of, flawed);
    if (flaw != IRIS_BOARD_FINE || !iris_board_refine(&w->of)) {
        return flaw == IRIS_BOARD_IN_LINE ? IRIS_PAIR_IN_LINE : IRIS_PAIR_BEHIND;
    }
    iris_board_motion *trial = w->of.trial; /* the two change places with each step */
    if (w->of.motions != w->motions[k]) {
        trial = w->motions[k];
        w->motions[k] = w->of.motions;
    }
    w->of.trial = trial;
    return IRIS_PAIR_FINE;
}

/* What a view says of the pair: the turn against the start's, and the right camera's place. */
static void say(iris_q32 numbers[IRIS_PAIR_PARAMETERS], const iris_pair_work *w, int32_t v)
{
    const iris_board_motion *left = &w->motions[0][v], *right = &w->motions[1][v];
    iris_mat3 back, turn;
    iris_mat3_transpose(&back, &left->turn);
    iris_mat3_multiply(&turn, &right->turn, &back);
    const iris_vec3 place = iris_vec3_sub(left->shift, iris_mat3_transposed_vector(&turn, right->shift));
    iris_mat3_transpose(&back, &w->data.start);
    iris_mat3_multiply(&turn, &turn, &back);
    const iris_vec3 turned = iris_rotation_to_vector(&turn);
    const iris_q32 all[IRIS_PAIR_PARAMETERS] = {turned.x, turned.y, turned.z, place.x, place.y, place.z};
    memcpy(numbers, all, sizeof all);
}

/* The pair to begin with: of each number the median of all views. */
static void start(iris_pair_work *w)
{
    iris_mat3 back;
    iris_mat3_transpose(&back, &w->motions[0][0].turn);
    iris_mat3_multiply(&w->data.start, &w->motions[1][0].turn, &back);
    for (int k = 0; k < IRIS_PAIR_PARAMETERS; k++) {
        for (int32_t v = 0; v < w->of.count; v++) {
            iris_q32 numbers[IRIS_PAIR_PARAMETERS];
            int32_t to = v;
            say(numbers, w, v);
            for (; to > 0 && w->sorted[to - 1] > numbers[k]; to--) {
                w->sorted[to] = w->sorted[to - 1];
            }
            w->sorted[to] = numbers[k];
        }
        w->of.shared[k] = w->sorted[w->of.count / 2];
        w->of.active[k] = k;
    }
    w->of.active_count = IRIS_PAIR_PARAMETERS;
    w->data.turn = w->data.start;
    memset(w->data.turned, 0, sizeof w->data.turned);
    w->of.source = &iris_pair_both;
    w->of.motions = w->motions[0];
}

iris_pair_flaw iris_pair_start(int32_t *flawed, iris_pair_work *w, const iris_sensor cameras[2])
{
    frame_of(w);
    iris_pair_flaw flaw = see_all(flawed, w, cameras);
    for (int k = 0; k < 2 && flaw == IRIS_PAIR_FINE; k++) {
        flaw = poses_of(flawed, w, k);
    }
    if (flaw == IRIS_PAIR_FINE) {
        start(w);
    }
    return flaw;
}
