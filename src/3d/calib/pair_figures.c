#include "iris/fixed.h"
#include "pair_parts.h"

#define TOGETHER 1024 /* parts of half a board: nearer cameras are at one place */
#define SHARE    100  /* loose: a standard deviation above that share of the distance */

/* The sum of squared distances of a camera's points in a view. */
static iris_wide squares(const iris_pair_work *w, int32_t v, int is_right)
{
    const int32_t count = w->data.views[v].count;
    iris_wide sum = {0, 0};
    for (int32_t i = 0; i < count; i++) {
        const iris_board_seen seen = iris_pair_both.point(&w->of, v, is_right * count + i);
        iris_vec2 off = {0, 0};
        (void)iris_pair_show(&off, NULL, &w->of, w->of.shared, &w->of.motions[v], &seen);
        sum = iris_wide_add(sum, iris_wide_add(iris_wide_mul(off.x, off.x), iris_wide_mul(off.y, off.y)));
    }
    return sum;
}

/* The left camera in the board's frame. */
static iris_pose place_of(const iris_pair_work *w, const iris_board_motion *motion)
{
    const iris_board_frame *f = &w->of.frame;
    const iris_vec3 back = iris_mat3_transposed_vector(&motion->turn, motion->shift);
    const iris_vec3 place = iris_vec3_scale(back, -f->board_reach);
    return (iris_pose){motion->turn, iris_vec3_add(place, (iris_vec3){f->board.x, f->board.y, 0})};
}

void iris_pair_figures(iris_pair_fit *fit, iris_pair_place *places, iris_pair_work *w)
{
    const iris_q32 *s = w->of.shared, reach = w->of.frame.board_reach;
    iris_q32 deviations[IRIS_BOARD_PARAMETERS];
    iris_wide all = {0, 0};
    int64_t n = 0;
    for (int32_t v = 0; v < w->of.count; v++) {
        const int32_t count = w->data.views[v].count;
        places[v].left = place_of(w, &w->of.motions[v]);
        for (int k = 0; k < 2; k++) {
            const iris_wide sum = squares(w, v, k);
            all = iris_wide_add(all, sum);
            places[v].rms[k] = iris_q32_mul_sat(iris_board_root_mean(sum, count), w->ref);
        }
        n += 2 * count;
    }
    fit->rms = iris_q32_mul_sat(iris_board_root_mean(all, n), w->ref);
    const int64_t spare = 2 * n - IRIS_PAIR_PARAMETERS - IRIS_BOARD_POSE * (int64_t)w->of.count;
    const iris_q32 noise = iris_board_root_mean(all, spare > 0 ? spare : 1);
    iris_board_deviations(deviations, &w->of);
    for (int k = 0; k < IRIS_PAIR_PARAMETERS; k++) {
        fit->deviations[k] = iris_board_deviation(deviations[k], noise, k < 3 ? 0 : reach);
    }
    iris_rotation_from_vector(&fit->right.turn, (iris_vec3){s[0], s[1], s[2]});
    iris_mat3_multiply(&fit->right.turn, &fit->right.turn, &w->data.start);
    fit->right.place = iris_vec3_scale((iris_vec3){s[3], s[4], s[5]}, reach);
    fit->baseline = iris_vec3_length(fit->right.place);
    const iris_q32 *d = fit->deviations;
    const iris_q32 loose = iris_vec3_length((iris_vec3){d[3], d[4], d[5]});
    fit->remarks = fit->baseline / 3 < loose || fit->baseline < reach / TOGETHER ? IRIS_PAIR_ONE_PLACE : 0;
    fit->remarks |= fit->baseline / SHARE < loose ? IRIS_PAIR_LOOSE : 0;
    fit->remarks |= fit->rms > IRIS_Q32_ONE ? IRIS_PAIR_FAR_OFF : 0;
}
