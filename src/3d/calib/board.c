#include "iris/3d/calib_board.h"

#include <string.h>

#include "board_parts.h"
#include "iris/fixed.h"

#define FARTHEST ((iris_q32)1 << 60)
#define TURNED   4148633411 /* cosine of 15 degrees */
#define SHARE    200        /* loose: a standard deviation above that share of a focal length */

/* deviations are 1024 times too small */
iris_q32 iris_board_deviation(iris_q32 deviation, iris_q32 noise, iris_q32 reach)
{
    iris_q32 made = iris_wide_round_shift_sat(iris_wide_mul(deviation, noise), 22);
    return reach ? iris_q32_mul_sat(made, reach) : made;
}

/* The sum of squared distances of a view, in the frame. */
static iris_wide squares(const iris_board_problem *of, int32_t v)
{
    iris_wide sum = {0, 0};
    for (int32_t i = 0; i < of->views[v].count; i++) {
        iris_board_point at = iris_board_scaled(of, &of->views[v].points[i]);
        iris_vec2 off = {0, 0};
        (void)iris_board_show(&off, 0, of->shared, &of->motions[v], &at);
        sum = iris_wide_add(sum, iris_wide_add(iris_wide_mul(off.x, off.x), iris_wide_mul(off.y, off.y)));
    }
    return sum;
}

iris_q32 iris_board_root_mean(iris_wide sum, int64_t n)
{
    return iris_wide_div_sat(iris_wide_mul(iris_wide_sqrt(sum), 65536), iris_sqrt_u64((uint64_t)n << 32));
}

static int32_t count_of(const iris_board_problem *of, int32_t v)
{
    return of->views[v].count;
}

static iris_board_seen point_of(const iris_board_problem *of, int32_t v, int32_t i)
{
    return (iris_board_seen){.at = iris_board_scaled(of, &of->views[v].points[i])};
}

static int show(iris_vec2 *missing, iris_board_rows *rows, const iris_board_problem *of,
                const iris_q32 shared[IRIS_BOARD_PARAMETERS], const iris_board_motion *motion,
                const iris_board_seen *seen)
{
    (void)of;
    return iris_board_show(missing, rows, shared, motion, &seen->at);
}

/* The camera's place of a motion. */
static iris_pose pose_of(const iris_board_problem *of, const iris_board_motion *motion)
{
    const iris_board_frame *f = &of->frame;
    iris_vec3 back = iris_mat3_transposed_vector(&motion->turn, motion->shift);
    iris_vec3 place = iris_vec3_scale(back, -f->board_reach);
    iris_pose made = {motion->turn, iris_vec3_add(place, (iris_vec3){f->board.x, f->board.y, 0})};
    return made;
}

static void take_camera(iris_board_fit *fit, const iris_board_problem *of)
{
    const iris_q32 *s = of->shared, reach = of->frame.image_reach;
    fit->intrinsics = (iris_intrinsics){iris_q32_mul_sat(s[IRIS_BOARD_ALPHA_U], reach),
                                        iris_q32_mul_sat(s[IRIS_BOARD_ALPHA_V], reach),
                                        iris_q32_mul_sat(s[IRIS_BOARD_SKEW], reach),
                                        iris_q32_mul_sat(s[IRIS_BOARD_U0], reach) + of->frame.image.x,
                                        iris_q32_mul_sat(s[IRIS_BOARD_V0], reach) + of->frame.image.y};
    fit->lens = (iris_lens){.k1 = s[IRIS_BOARD_LENS_K1],
                            .k2 = s[IRIS_BOARD_LENS_K2],
                            .k3 = s[IRIS_BOARD_LENS_K3],
                            .p1 = s[IRIS_BOARD_LENS_P1],
                            .p2 = s[IRIS_BOARD_LENS_P2],
                            .direction = IRIS_LENS_BENDS};
}

/* In how many of 8 x 8 fields of the picture there are points. */
static int32_t fields_of(const iris_board_problem *of, iris_size size)
{
    uint8_t rows[8] = {0};
    int32_t count = 0;
    if (size.w == 0) {
        return -1;
    }
    for (int32_t v = 0; v < of->count; v++) {
        for (int32_t i = 0; i < of->views[v].count; i++) {
            iris_vec2 at = of->views[v].points[i].image;
            int64_t x = (at.x >> 32) * 8 / size.w, y = (at.y >> 32) * 8 / size.h;
            if (x >= 0 && x < 8 && y >= 0 && y < 8) {
                rows[y] |= (uint8_t)(1 << x);
            }
        }
    }
    for (int i = 0; i < 64; i++) {
        count += rows[i / 8] >> (i % 8) & 1;
    }
    return count;
}

/* Are there two views whose boards are turned against each other, out of their planes? */
static int turns(const iris_board_problem *of)
{
    int found = 0;
    for (int32_t a = 0; a < of->count; a++) {
        for (int32_t b = 0; b < a; b++) {
            const iris_q32 *p = of->motions[a].turn.m, *q = of->motions[b].turn.m;
            iris_q32 cosine = iris_vec3_dot((iris_vec3){p[2], p[5], p[8]}, (iris_vec3){q[2], q[5], q[8]});
            found |= cosine < TURNED;
        }
    }
    return found;
}

/* The deviations. Returns 0 when noise of 1/1024 of half a picture's side leaves no focal length. */
static int take_deviations(iris_board_fit *fit, iris_board_problem *of, iris_q32 noise)
{
    const iris_q32 *s = of->shared, *d = fit->deviations;
    iris_board_deviations(fit->deviations, of);
    int known = d[IRIS_BOARD_ALPHA_U] < s[IRIS_BOARD_ALPHA_U] / 8 &&
                d[IRIS_BOARD_ALPHA_V] < s[IRIS_BOARD_ALPHA_V] / 8;
    for (int k = 0; k < IRIS_BOARD_PARAMETERS; k++) {
        fit->deviations[k] =
            iris_board_deviation(d[k], noise, k < IRIS_BOARD_LENS_K1 ? of->frame.image_reach : 0);
    }
    return known;
}

static iris_board_flaw take_figures(iris_board_fit *fit, iris_board_place *places, iris_board_problem *of,
                                    iris_size size)
{
    const iris_q32 reach = of->frame.image_reach;
    iris_wide all = {0, 0};
    int64_t n = 0;
    for (int32_t v = 0; v < of->count; v++) {
        iris_wide sum = squares(of, v);
        all = iris_wide_add(all, sum);
        n += of->views[v].count;
        places[v].rms = iris_q32_mul_sat(iris_board_root_mean(sum, of->views[v].count), reach);
        places[v].pose = pose_of(of, &of->motions[v]);
    }
    fit->rms = iris_q32_mul_sat(iris_board_root_mean(all, n), reach);
    int64_t free_equations = 2 * n - of->active_count - IRIS_BOARD_POSE * (int64_t)of->count;
    iris_q32 noise = iris_board_root_mean(all, free_equations > 0 ? free_equations : 1);
    if (!take_deviations(fit, of, noise)) {
        return IRIS_BOARD_FACING;
    }
    fit->fields = fields_of(of, size);
    fit->remarks = fit->fields >= 0 && fit->fields < 32 ? IRIS_BOARD_COVERS_LITTLE : 0;
    fit->remarks |= turns(of) ? 0 : IRIS_BOARD_TURNS_LITTLE;
    fit->remarks |= fit->deviations[IRIS_BOARD_ALPHA_U] > fit->intrinsics.alpha_u / SHARE ||
                            fit->deviations[IRIS_BOARD_ALPHA_V] > fit->intrinsics.alpha_v / SHARE
                        ? IRIS_BOARD_LOOSE
                        : 0;
    return IRIS_BOARD_FINE;
}

/* Which parameters are looked for. */
static void choose(iris_board_problem *of, uint32_t model)
{
    of->active_count = 0;
    for (int k = 0; k < IRIS_BOARD_PARAMETERS; k++) {
        uint32_t needs = k == IRIS_BOARD_SKEW                                 ? IRIS_BOARD_SHEAR
                         : k == IRIS_BOARD_LENS_K3                            ? IRIS_BOARD_K3
                         : k == IRIS_BOARD_LENS_P1 || k == IRIS_BOARD_LENS_P2 ? IRIS_BOARD_TANGENTIAL
                                                                              : 0;
        if ((model & needs) == needs) {
            of->active[of->active_count++] = k;
        }
    }
}

static iris_board_flaw calibrate(iris_board_fit *fit, iris_board_place *places, iris_board_problem *of,
                                 iris_size size)
{
    int64_t equations = 0;
    fit->flawed = -1;
    for (int32_t v = 0; v < of->count; v++) {
        equations += 2 * of->views[v].count - IRIS_BOARD_POSE;
        if (of->views[v].count < IRIS_BOARD_POINTS_MIN) {
            fit->flawed = v;
            return IRIS_BOARD_TOO_FEW;
        }
    }
    if (equations < of->active_count) {
        return IRIS_BOARD_TOO_FEW;
    }
    iris_board_flaw flaw = iris_board_start(of, &fit->flawed, size);
    if (flaw == IRIS_BOARD_FINE && !iris_board_refine(of)) {
        flaw = IRIS_BOARD_BEHIND;
    }
    if (flaw == IRIS_BOARD_FINE) {
        take_camera(fit, of);
        flaw = take_figures(fit, places, of, size);
    }
    return flaw;
}

static int is_near(iris_vec2 at)
{
    return at.x <= FARTHEST && at.x >= -FARTHEST && at.y <= FARTHEST && at.y >= -FARTHEST;
}

static iris_status check(const iris_board_view *views, int32_t count, const iris_board_config *config)
{
    const iris_size size = config->size;
    const int sized = size.w >= 1 && size.h >= 1 && size.w <= IRIS_SIDE_MAX && size.h <= IRIS_SIDE_MAX;
    if (count < 0 || count > IRIS_BOARD_VIEWS_MAX || config->model > 7 ||
        !(sized || (size.w == 0 && size.h == 0))) {
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
            if (!is_near(views[v].points[i].board) || !is_near(views[v].points[i].image)) {
                return IRIS_ERR_RANGE;
            }
        }
    }
    return IRIS_OK;
}

iris_status iris_board_calibrate(iris_board_fit *fit, iris_board_place *places, const iris_board_view *views,
                                 int32_t count, const iris_board_config *config, iris_scratch *scratch)
{
    static const iris_board_config plain = {0, {0, 0}};
    static const iris_board_source source = {count_of, point_of, show};
    if (!fit || !places || !views || !scratch) {
        return IRIS_ERR_ARG;
    }
    config = config ? config : &plain;
    iris_status status = check(views, count, config);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_board_problem of = {.source = &source, .views = views, .count = count};
    of.motions = iris_scratch_take(scratch, (size_t)count * sizeof *of.motions);
    of.trial = iris_scratch_take(scratch, (size_t)count * sizeof *of.trial);
    of.view.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_BOARD_UNKNOWNS) * sizeof(iris_q32));
    of.all.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_BOARD_PARAMETERS) * sizeof(iris_q32));
    if (!of.motions || !of.trial || !of.view.numbers || !of.all.numbers) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    memset(fit, 0, sizeof *fit);
    choose(&of, config->model);
    fit->flaw = calibrate(fit, places, &of, config->size);
    iris_scratch_release(scratch, mark);
    return fit->flaw == IRIS_BOARD_FINE ? IRIS_OK : IRIS_ERR_DATA;
}
