/* A camera on a robot whose motions are known: see calib_motion.h for the method. */
#include <string.h>

#include "motion_parts.h"

#define STARTS   4
#define BRIEF    10           /* rounds of refining of each */
#define SHORT    IRIS_Q32_ONE /* the first focal length, in halves of a picture; each next one is 5/3 of it */
#define FARTHEST ((iris_q32)1 << 60)
#define UNIT_OFF ((iris_q32)1 << 22) /* of a rotation: 2^-10 */

static int is_near(iris_vec3 at)
{
    return at.x <= FARTHEST && at.x >= -FARTHEST && at.y <= FARTHEST && at.y >= -FARTHEST &&
           at.z <= FARTHEST && at.z >= -FARTHEST;
}

static int is_rotation(const iris_mat3 *r)
{
    iris_mat3 tidy = *r;
    int good = iris_rotation_tidy(&tidy) == IRIS_OK;
    for (int i = 0; i < 9 && good; i++) {
        good = r->m[i] <= tidy.m[i] + UNIT_OFF && r->m[i] >= tidy.m[i] - UNIT_OFF;
    }
    return good;
}

static iris_status check(const iris_motion_pair *pairs, int32_t count, const iris_motion_config *config)
{
    iris_status status = iris_motion_check(pairs, count, 2 * IRIS_MOTION_LEVER - 1, config);
    if (status != IRIS_OK) {
        return status;
    }
    int good = is_rotation(&config->mount.turn) && is_near(config->mount.place);
    for (int32_t v = 0; v < count; v++) {
        good &= is_rotation(&pairs[v].turn) && is_near(pairs[v].shift);
    }
    return good ? IRIS_OK : IRIS_ERR_RANGE;
}

static iris_q32 larger(iris_q32 a, iris_q32 b)
{
    return a > b ? a : b;
}

/* The longest of all shifts and of the lever: their unit. */
static void span_of(iris_motion_problem *of, const iris_motion_config *config)
{
    const iris_vec3 lever = config->mount.place;
    of->span = larger(1 << 16, iris_vec3_length(lever));
    for (int32_t v = 0; v < of->count; v++) {
        of->span = larger(of->span, iris_vec3_length(of->pairs[v].shift));
    }
    of->camera.lever = (iris_vec3){iris_q32_div_sat(lever.x, of->span), iris_q32_div_sat(lever.y, of->span),
                                   iris_q32_div_sat(lever.z, of->span)};
}

static int is_still(const iris_motion_problem *of)
{
    int still = 1;
    for (int32_t v = 0; v < of->count; v++) {
        const iris_vec3 turned = iris_rotation_to_vector(&of->pairs[v].turn), shift = of->pairs[v].shift;
        still &= shift.x == 0 && shift.y == 0 && shift.z == 0 && iris_vec3_length(turned) < IRIS_PI_Q32 / 180;
    }
    return still;
}

/* The best camera of those that refining ends at. */
static int solve(iris_motion_problem *of)
{
    const iris_motion_camera begin = of->camera;
    iris_motion_camera best = begin;
    iris_q32 alpha = SHORT;
    iris_wide least = {INT64_MAX, 0}, sum;
    int found = 0;
    for (int i = 0; i < STARTS; i++, alpha = alpha / 3 * 5) {
        of->camera = begin;
        iris_motion_set_focal(&of->camera, alpha);
        if (iris_motion_refine(of, BRIEF) && iris_motion_squares(&sum, of, &of->camera, 0, -1) > 0 &&
            iris_wide_sub(sum, least).high < 0) {
            least = sum;
            best = of->camera;
            found = 1;
        }
    }
    of->camera = best;
    return found && iris_motion_refine(of, IRIS_MOTION_ROUNDS);
}

static iris_motion_flaw calibrate(iris_motion_fit *fit, iris_motion_problem *of)
{
    int64_t equations = 0;
    for (int32_t v = 0; v < of->count; v++) {
        equations += of->pairs[v].count;
        if (of->pairs[v].count < 1) {
            fit->flawed = v;
            return IRIS_MOTION_TOO_FEW;
        }
    }
    if (of->count == 0 || equations < of->active_count) {
        return IRIS_MOTION_TOO_FEW;
    }
    if (is_still(of)) {
        return IRIS_MOTION_STILL;
    }
    return solve(of) ? iris_motion_take(fit, of) : IRIS_MOTION_OTHER;
}

iris_status iris_motion_calibrate(iris_motion_fit *fit, const iris_motion_pair *pairs, int32_t count,
                                  const iris_motion_config *config, iris_scratch *scratch)
{
    if (!fit || !pairs || !config || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check(pairs, count, config);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_motion_problem of = {.pairs = pairs, .count = count, .known = 1};
    of.pair.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_MOTION_UNKNOWNS) * sizeof(iris_q32));
    of.all.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_MOTION_UNKNOWNS) * sizeof(iris_q32));
    if (!of.pair.numbers || !of.all.numbers) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    memset(fit, 0, sizeof *fit);
    fit->flawed = -1;
    iris_motion_begin(&of, config);
    span_of(&of, config);
    fit->flaw = calibrate(fit, &of);
    iris_scratch_release(scratch, mark);
    return fit->flaw == IRIS_MOTION_FINE ? IRIS_OK : IRIS_ERR_DATA;
}
