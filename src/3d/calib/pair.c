#include "iris/3d/calib_pair.h"

#include <string.h>

#include "iris/fixed.h"
#include "pair_parts.h"

#define FARTHEST  ((iris_q32)1 << 60)
#define ALPHA_MIN ((iris_q32)1 << 24)
#define ALPHA_MAX ((iris_q32)1 << 52)

static iris_pair_flaw calibrate(iris_pair_fit *fit, iris_pair_place *places, iris_pair_work *w,
                                const iris_sensor cameras[2])
{
    iris_pair_flaw flaw = iris_pair_start(&fit->flawed, w, cameras);
    if (flaw == IRIS_PAIR_FINE) {
        flaw = iris_board_refine(&w->of) && iris_rotation_tidy(&w->data.start) == IRIS_OK ? IRIS_PAIR_FINE
                                                                                          : IRIS_PAIR_BEHIND;
    }
    if (flaw == IRIS_PAIR_FINE) {
        iris_pair_figures(fit, places, w);
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
