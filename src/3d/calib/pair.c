#include "iris/3d/calib_pair.h"

#include <string.h>

#include "iris/fixed.h"
#include "pair_parts.h"

#define FARTHEST  ((iris_q32)1 << 60)
#define ALPHA_MIN ((iris_q32)1 << 24)
#define ALPHA_MAX ((iris_q32)1 << 52)
#define TOGETHER  1024 /* parts of half a board: nearer cameras are at one place */
#define SHARE     100  /* loose: a standard deviation above that share of the distance */

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

static void take_figures(iris_pair_fit *fit, iris_pair_place *places, iris_pair_work *w)
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

static iris_pair_flaw calibrate(iris_pair_fit *fit, iris_pair_place *places, iris_pair_work *w,
                                const iris_sensor cameras[2])
{
    iris_pair_flaw flaw = iris_pair_start(&fit->flawed, w, cameras);
    if (flaw == IRIS_PAIR_FINE) {
        flaw = iris_board_refine(&w->of) && iris_rotation_tidy(&w->data.start) == IRIS_OK ? IRIS_PAIR_FINE
                                                                                          : IRIS_PAIR_BEHIND;
    }
    if (flaw == IRIS_PAIR_FINE) {
        take_figures(fit, places, w);
    }
    return flaw;
}

static int is_near(iris_vec2 at)
{
    return at.x <= FARTHEST && at.x >= -FARTHEST && at.y <= FARTHEST && at.y >= -FARTHEST;
}

/* Counts all points. */
static iris_status check(int64_t *points, const iris_pair_view *views, int32_t count,
                         const iris_sensor cameras[2])
{
    *points = 0;
    for (int k = 0; k < 2; k++) {
        const iris_intrinsics *in = &cameras[k].intrinsics;
        if (in->alpha_u < ALPHA_MIN || in->alpha_u > ALPHA_MAX || in->alpha_v < ALPHA_MIN ||
            in->alpha_v > ALPHA_MAX) {
            return IRIS_ERR_RANGE;
        }
    }
    if (count < 0 || count > IRIS_BOARD_VIEWS_MAX) {
        return IRIS_ERR_RANGE;
    }
    for (int32_t v = 0; v < count; v++) {
        if (!views[v].points && views[v].count != 0) {
            return IRIS_ERR_ARG;
        }
        if (views[v].count < 0 || views[v].count > IRIS_BOARD_POINTS_MAX) {
            return IRIS_ERR_RANGE;
        }
        for (int32_t i = 0; i < views[v].count; i++) {
            const iris_pair_point *p = &views[v].points[i];
            if (!is_near(p->board) || !is_near(p->left) || !is_near(p->right)) {
                return IRIS_ERR_RANGE;
            }
        }
        *points += views[v].count;
    }
    return IRIS_OK;
}

static int take_memory(iris_pair_work *w, iris_scratch *scratch, size_t views, size_t points)
{
    w->motions[0] = iris_scratch_take(scratch, views * sizeof *w->motions[0]);
    w->motions[1] = iris_scratch_take(scratch, views * sizeof *w->motions[1]);
    w->of.trial = iris_scratch_take(scratch, views * sizeof *w->of.trial);
    w->first = iris_scratch_take(scratch, views * sizeof *w->first);
    w->sorted = iris_scratch_take(scratch, views * sizeof *w->sorted);
    w->seen = iris_scratch_take(scratch, points * sizeof *w->seen);
    w->of.view.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_BOARD_UNKNOWNS) * sizeof(iris_q32));
    w->of.all.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_BOARD_PARAMETERS) * sizeof(iris_q32));
    w->data.first = w->first;
    w->data.seen = w->seen;
    return w->motions[0] && w->motions[1] && w->of.trial && w->first && w->sorted && w->seen &&
           w->of.view.numbers && w->of.all.numbers;
}

iris_status iris_pair_calibrate(iris_pair_fit *fit, iris_pair_place *places, const iris_pair_view *views,
                                int32_t count, const iris_sensor cameras[2], iris_scratch *scratch)
{
    int64_t points;
    if (!fit || !places || !views || !cameras || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check(&points, views, count, cameras);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_pair_work w;
    memset(&w, 0, sizeof w);
    w.of.count = count;
    w.of.user = &w.data;
    w.data.views = views;
    w.ref = cameras[0].intrinsics.alpha_u;
    if (!take_memory(&w, scratch, (size_t)count, (size_t)points)) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    memset(fit, 0, sizeof *fit);
    fit->flawed = -1;
    fit->flaw = calibrate(fit, places, &w, cameras);
    iris_scratch_release(scratch, mark);
    return fit->flaw == IRIS_PAIR_FINE ? IRIS_OK : IRIS_ERR_DATA;
}
