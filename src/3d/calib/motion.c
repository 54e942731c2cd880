/* What both calibrations from motion do first and last: see calib_motion.h. */
#include "iris/3d/calib_motion.h"

#include "iris/fixed.h"
#include "motion_parts.h"

#define FARTHEST ((iris_q32)1 << 60)
#define FAR      (256 * IRIS_Q32_ONE) /* in the frame */
#define LARGE    ((iris_q32)1 << 54)  /* a deviation that large is no end of it */
#define UNSURE   (IRIS_Q32_ONE / 4)   /* of the principal point, in the frame, and of the mount's turn */
#define OFF      (IRIS_Q32_ONE / 32)  /* so much is left over of a motion that is another one */

static void widen(iris_q32 *low, iris_q32 *high, iris_q32 a)
{
    *low = a < *low ? a : *low;
    *high = a > *high ? a : *high;
}

static iris_q32 larger(iris_q32 a, iris_q32 b)
{
    return a > b ? a : b;
}

static iris_q32 limited(iris_q32 a)
{
    return a > FAR ? FAR : a < -FAR ? -FAR : a;
}

static int is_near(iris_vec2 at)
{
    return at.x <= FARTHEST && at.x >= -FARTHEST && at.y <= FARTHEST && at.y >= -FARTHEST;
}

iris_match iris_motion_scaled(const iris_motion_problem *of, const iris_match *match)
{
    const iris_vec2 m = of->middle;
    iris_match made = {{limited(iris_q32_div_sat(match->from.x - m.x, of->reach)),
                        limited(iris_q32_div_sat(match->from.y - m.y, of->reach))},
                       {limited(iris_q32_div_sat(match->to.x - m.x, of->reach)),
                        limited(iris_q32_div_sat(match->to.y - m.y, of->reach))}};
    return made;
}

iris_status iris_motion_check(const iris_motion_pair *pairs, int32_t count, uint32_t models,
                              const iris_motion_config *config)
{
    const iris_size size = config->size;
    const int sized = size.w >= 1 && size.h >= 1 && size.w <= IRIS_SIDE_MAX && size.h <= IRIS_SIDE_MAX;
    if (count < 0 || count > IRIS_MOTION_PAIRS_MAX || (config->model & ~models) != 0 ||
        !(sized || (size.w == 0 && size.h == 0))) {
        return IRIS_ERR_RANGE;
    }
    for (int32_t v = 0; v < count; v++) {
        if (!pairs[v].matches && pairs[v].count != 0) {
            return IRIS_ERR_ARG;
        }
        if (pairs[v].count < 0 || pairs[v].count > IRIS_MOTION_MATCHES_MAX) {
            return IRIS_ERR_RANGE;
        }
        for (int32_t i = 0; i < pairs[v].count; i++) {
            if (!is_near(pairs[v].matches[i].from) || !is_near(pairs[v].matches[i].to)) {
                return IRIS_ERR_RANGE;
            }
        }
    }
    return IRIS_OK;
}

/* The middle and half of the longer side of all places, or of the picture. */
static void frame_of(iris_motion_problem *of, iris_size size)
{
    iris_q32 low[2] = {INT64_MAX, INT64_MAX}, high[2] = {INT64_MIN, INT64_MIN};
    for (int32_t v = 0; v < of->count && size.w == 0; v++) {
        for (int32_t i = 0; i < of->pairs[v].count; i++) {
            const iris_match *match = &of->pairs[v].matches[i];
            widen(&low[0], &high[0], match->from.x);
            widen(&low[1], &high[1], match->from.y);
            widen(&low[0], &high[0], match->to.x);
            widen(&low[1], &high[1], match->to.y);
        }
    }
    if (size.w > 0) {
        low[0] = low[1] = 0;
        high[0] = (size.w - 1) * IRIS_Q32_ONE;
        high[1] = (size.h - 1) * IRIS_Q32_ONE;
    }
    of->middle = (iris_vec2){low[0] / 2 + high[0] / 2, low[1] / 2 + high[1] / 2};
    of->reach = larger(1, larger(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2));
}

void iris_motion_begin(iris_motion_problem *of, const iris_motion_config *config)
{
    const uint32_t needs[IRIS_MOTION_INTRINSICS] = {0, IRIS_MOTION_ASPECT, IRIS_MOTION_SHEAR,
                                                    IRIS_MOTION_CENTER, IRIS_MOTION_CENTER};
    const iris_motion_camera camera = {{0}, config->mount.turn, config->mount.place};
    frame_of(of, config->size);
    of->model = config->model;
    of->camera = camera;
    of->active_count = 0;
    for (int k = 0; k < IRIS_MOTION_SHARED; k++) {
        const int is_wanted = k < IRIS_MOTION_MOUNT   ? (config->model & needs[k]) == needs[k]
                              : k < IRIS_MOTION_PLACE ? of->known
                                                      : of->known && (config->model & IRIS_MOTION_LEVER);
        if (is_wanted) {
            of->active[of->active_count++] = k;
        }
    }
}

void iris_motion_set_focal(iris_motion_camera *camera, iris_q32 alpha)
{
    camera->k[IRIS_MOTION_ALPHA_U] = camera->k[IRIS_MOTION_ALPHA_V] = alpha;
}

iris_q32 iris_motion_root_mean(iris_wide sum, int64_t n)
{
    return iris_wide_div_sat(iris_wide_mul(iris_wide_sqrt(sum), 65536), iris_sqrt_u64((uint64_t)n << 32));
}

/* Standard deviations of the active parameters in the frame, if noise is 1/1024: the lengths of R^-T e. */
static void deviations_of(iris_q32 deviations[IRIS_MOTION_SHARED], const iris_motion_problem *of)
{
    const int n = of->active_count;
    for (int k = 0; k < IRIS_MOTION_SHARED; k++) {
        deviations[k] = 0;
    }
    for (int k = 0; k < n; k++) {
        iris_q32 y[IRIS_MOTION_SHARED] = {0};
        for (int i = k; i < n; i++) {
            iris_wide rest = i == k ? iris_wide_mul(IRIS_Q32_ONE, IRIS_Q32_ONE / 1024) : iris_wide_from(0);
            for (int j = k; j < i; j++) {
                rest = iris_wide_sub(rest, iris_wide_mul(*iris_triangle_at(&of->all, j, i), y[j]));
            }
            iris_q32 d = *iris_triangle_at(&of->all, i, i);
            y[i] = iris_wide_div_sat(rest, d == 0 ? 1 : d);
            y[i] = y[i] > LARGE ? LARGE : y[i] < -LARGE ? -LARGE : y[i];
        }
        deviations[of->active[k]] = iris_numbers_length(y, n);
    }
}

/* deviations are 1024 times too small */
static iris_q32 times(iris_q32 deviation, iris_q32 noise, iris_q32 reach)
{
    return iris_q32_mul_sat(iris_wide_round_shift_sat(iris_wide_mul(deviation, noise), 22), reach);
}

static int64_t matches_of(const iris_motion_problem *of)
{
    int64_t n = 0;
    for (int32_t v = 0; v < of->count; v++) {
        n += of->pairs[v].count;
    }
    return n;
}

static void take_numbers(iris_motion_fit *fit, const iris_motion_problem *of)
{
    const iris_q32 *k = of->camera.k, reach = of->reach;
    fit->intrinsics = (iris_intrinsics){iris_q32_mul_sat(k[IRIS_MOTION_ALPHA_U], reach),
                                        iris_q32_mul_sat(k[IRIS_MOTION_ALPHA_V], reach),
                                        iris_q32_mul_sat(k[IRIS_MOTION_SKEW], reach),
                                        iris_q32_mul_sat(k[IRIS_MOTION_U0], reach) + of->middle.x,
                                        iris_q32_mul_sat(k[IRIS_MOTION_V0], reach) + of->middle.y};
    fit->mount = (iris_pose){of->camera.mount, iris_vec3_scale(of->camera.lever, of->span)};
}

iris_motion_flaw iris_motion_take(iris_motion_fit *fit, iris_motion_problem *of)
{
    iris_q32 d[IRIS_MOTION_SHARED];
    const iris_q32 *k = of->camera.k;
    iris_wide sum;
    const int32_t n = iris_motion_squares(&sum, of, &of->camera, of->turns, -1);
    if (n == 0) {
        return IRIS_MOTION_OTHER;
    }
    const int64_t open = n - of->active_count - (of->known ? 0 : IRIS_MOTION_OWN * (int64_t)of->count);
    const iris_q32 noise = iris_motion_root_mean(sum, open > 0 ? open : 1);
    const iris_q32 left = iris_motion_root_mean(sum, matches_of(of));
    take_numbers(fit, of);
    fit->rms = iris_q32_mul_sat(left, of->reach);
    deviations_of(d, of);
    for (int i = 0; i < IRIS_MOTION_INTRINSICS; i++) {
        fit->deviations[i] = times(d[i], noise, of->reach);
    }
    if (!(of->model & IRIS_MOTION_ASPECT)) {
        fit->deviations[IRIS_MOTION_ALPHA_V] = fit->deviations[IRIS_MOTION_ALPHA_U];
    }
    const iris_q32 *m = d + IRIS_MOTION_MOUNT, *l = d + IRIS_MOTION_PLACE;
    fit->mount_deviation = (iris_vec3){times(m[0], noise, IRIS_Q32_ONE), times(m[1], noise, IRIS_Q32_ONE),
                                       times(m[2], noise, IRIS_Q32_ONE)};
    fit->lever_deviation =
        (iris_vec3){times(l[0], noise, of->span), times(l[1], noise, of->span), times(l[2], noise, of->span)};
    if (left > OFF) {
        return IRIS_MOTION_OTHER;
    }
    /* with noise of 1/1024 of half a picture's side, whatever it is */
    int known = d[IRIS_MOTION_ALPHA_U] < k[IRIS_MOTION_ALPHA_U] / 8 &&
                d[IRIS_MOTION_ALPHA_V] < k[IRIS_MOTION_ALPHA_V] / 8;
    for (int i = IRIS_MOTION_SKEW; i < IRIS_MOTION_PLACE; i++) {
        known &= d[i] < UNSURE;
    }
    return known ? IRIS_MOTION_FINE : IRIS_MOTION_UNDETERMINED;
}
