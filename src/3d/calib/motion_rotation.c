/* A camera that only turns: see calib_motion.h for the method. */
#include <string.h>

#include "motion_parts.h"

#define NUMBERS 9
#define SECOND  4096 /* of a pair: the second smallest singular value is above that share of all */
#define TRIED   24
#define SHORT                                                                                                \
    (IRIS_Q32_ONE /                                                                                          \
     2) /* the first focal length that is tried, in halves of a picture; each next one is 6/5 of it */
#define TURNED 4294313143 /* cosine of a degree */
#define ROLLED 4229717092 /* cosine of ten degrees */

static iris_q32 mul(iris_q32 a, iris_q32 b)
{
    return iris_q32_mul_sat(a, b);
}

/* (x, y, 1) at the row of `first`, and -t (x, y, 1) at the last one. */
static void add_equation(const iris_triangle *triangle, const iris_match *at, int first, iris_q32 t)
{
    const iris_q32 place[3] = {at->from.x, at->from.y, IRIS_Q32_ONE};
    iris_q32 row[NUMBERS + 1] = {0};
    for (int k = 0; k < 3; k++) {
        row[first + k] = place[k];
        row[6 + k] = -mul(t, place[k]);
    }
    iris_triangle_add(triangle, row);
}

/* The homography of a pair in the frame, row by row, of length 1 and positive depth. Returns 0 when there is no single one. */
static int homography(iris_q32 h[NUMBERS], const iris_motion_problem *of, int32_t v)
{
    iris_q32 second[NUMBERS];
    iris_triangle triangle;
    iris_triangle_init(&triangle, of->pair.numbers, NUMBERS);
    for (int32_t i = 0; i < of->pairs[v].count; i++) {
        const iris_match at = iris_motion_scaled(of, &of->pairs[v].matches[i]);
        add_equation(&triangle, &at, 0, at.to.x);
        add_equation(&triangle, &at, 3, at.to.y);
    }
    iris_q32 least = iris_null_vector(h, &triangle);
    iris_q32 next = iris_null_vector_beside(second, &triangle, h);
    iris_q32 all = iris_numbers_length(triangle.numbers, IRIS_TRIANGLE_NUMBERS(NUMBERS));
    const iris_match at = iris_motion_scaled(of, &of->pairs[v].matches[0]);
    if (mul(h[6], at.from.x) + mul(h[7], at.from.y) + h[8] < 0) {
        for (int k = 0; k < NUMBERS; k++) {
            h[k] = -h[k];
        }
    }
    return next > all / SECOND && least < next / 2;
}

/* The turn that the homography is with this focal length: K^-1 H K, made a rotation. Returns 0 when it is none. */
static int turn_of(iris_mat3 *turn, const iris_q32 h[NUMBERS], iris_q32 alpha)
{
    *turn = (iris_mat3){{h[0], h[1], iris_q32_div_sat(h[2], alpha), h[3], h[4], iris_q32_div_sat(h[5], alpha),
                         mul(h[6], alpha), mul(h[7], alpha), h[8]}};
    return iris_rotation_tidy(turn) == IRIS_OK;
}

/* The focal length with which the turns show all matches best, and these turns: 0 when none shows them. Homographies are
 * kept where trial turns are. */
static int start(iris_motion_problem *of)
{
    iris_q32 alpha = SHORT, best = 0;
    iris_wide least = {INT64_MAX, 0}, sum;
    for (int tried = 0; tried < TRIED + 1; tried++) {
        const iris_q32 with = tried < TRIED ? alpha : best;
        int good = with > 0;
        iris_motion_set_focal(&of->camera, with);
        for (int32_t v = 0; v < of->count && good; v++) {
            good = turn_of(&of->turns[v], of->trial[v].m, with);
        }
        if (good && iris_motion_squares(&sum, of, &of->camera, of->turns, -1) &&
            iris_wide_sub(sum, least).high < 0) {
            least = sum;
            best = with;
        }
        alpha = alpha / 5 * 6;
    }
    return best > 0;
}

/* Why there is no camera: by the turns about the optical axis, and all others. */
static iris_motion_flaw reason(const iris_motion_problem *of)
{
    int turned = 0, aside = 0;
    for (int32_t v = 0; v < of->count; v++) {
        const iris_q32 *m = of->turns[v].m;
        const iris_q32 cosine = (m[0] + m[4] + m[8] - IRIS_Q32_ONE) / 2;
        const iris_vec3 axis = {m[7] - m[5], m[2] - m[6], m[3] - m[1]};
        iris_vec3 unit;
        if (cosine < TURNED) {
            turned = 1;
            aside |= iris_vec3_normalize(&unit, axis) == IRIS_OK && unit.z < ROLLED && unit.z > -ROLLED;
        }
    }
    return !turned ? IRIS_MOTION_STILL : !aside ? IRIS_MOTION_ROLLS : IRIS_MOTION_UNDETERMINED;
}

static iris_motion_flaw calibrate(iris_motion_fit *fit, iris_motion_problem *of)
{
    int64_t equations = 0;
    for (int32_t v = 0; v < of->count; v++) {
        fit->flawed = v;
        equations += 2 * of->pairs[v].count - IRIS_MOTION_OWN;
        if (of->pairs[v].count < IRIS_MOTION_MATCHES_MIN) {
            return IRIS_MOTION_TOO_FEW;
        }
        if (!homography(of->trial[v].m, of, v)) {
            return IRIS_MOTION_IN_LINE;
        }
    }
    fit->flawed = -1;
    if (of->count == 0 || equations < of->active_count) {
        return IRIS_MOTION_TOO_FEW;
    }
    if (!start(of)) {
        return IRIS_MOTION_OTHER;
    }
    iris_motion_flaw still = reason(of);
    if (still == IRIS_MOTION_STILL || still == IRIS_MOTION_ROLLS) {
        return still;
    }
    if (!iris_motion_refine(of, IRIS_MOTION_ROUNDS)) {
        return IRIS_MOTION_OTHER;
    }
    iris_motion_flaw flaw = iris_motion_take(fit, of);
    return flaw == IRIS_MOTION_UNDETERMINED ? reason(of) : flaw;
}

iris_status iris_rotation_calibrate(iris_motion_fit *fit, iris_motion_turn *turns,
                                    const iris_motion_pair *pairs, int32_t count,
                                    const iris_motion_config *config, iris_scratch *scratch)
{
    static const iris_motion_config plain = {.model = 0};
    if (!fit || !turns || !pairs || !scratch) {
        return IRIS_ERR_ARG;
    }
    config = config ? config : &plain;
    iris_status status =
        iris_motion_check(pairs, count, IRIS_MOTION_CENTER | IRIS_MOTION_ASPECT | IRIS_MOTION_SHEAR, config);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_motion_problem of = {.pairs = pairs, .count = count, .span = IRIS_Q32_ONE};
    of.turns = iris_scratch_take(scratch, (size_t)count * sizeof *of.turns);
    of.trial = iris_scratch_take(scratch, (size_t)count * sizeof *of.trial);
    of.pair.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_MOTION_UNKNOWNS) * sizeof(iris_q32));
    of.all.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_MOTION_UNKNOWNS) * sizeof(iris_q32));
    if (!of.turns || !of.trial || !of.pair.numbers || !of.all.numbers) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    memset(fit, 0, sizeof *fit);
    fit->flawed = -1;
    iris_motion_begin(&of, config);
    fit->flaw = calibrate(fit, &of);
    for (int32_t v = 0; v < count && fit->flaw == IRIS_MOTION_FINE; v++) {
        iris_wide sum;
        (void)iris_motion_squares(&sum, &of, &of.camera, of.turns, v);
        turns[v].turn = of.turns[v];
        turns[v].rms = iris_q32_mul_sat(iris_motion_root_mean(sum, pairs[v].count), of.reach);
    }
    iris_scratch_release(scratch, mark);
    return fit->flaw == IRIS_MOTION_FINE ? IRIS_OK : IRIS_ERR_DATA;
}
