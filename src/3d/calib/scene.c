#include "iris/3d/calib_scene.h"

#include "iris/fixed.h"
#include "scene_parts.h"

#define ROBUST_FROM 12
#define FARTHEST    ((iris_q32)1 << 60)
#define AFFINE      4096 /* the depth varies by less than that share of it: no perspective */

static int is_near(iris_q32 a)
{
    return a <= FARTHEST && a >= -FARTHEST;
}

static int is_same(const iris_scene_point *a, const iris_scene_point *b, int of_image)
{
    return of_image ? a->image.x == b->image.x && a->image.y == b->image.y
                    : a->world.x == b->world.x && a->world.y == b->world.y && a->world.z == b->world.z;
}

/* Are there six different places among those used? */
static int has_six(const iris_scene_problem *of, int of_image)
{
    int32_t found = 0;
    for (int32_t i = 0; i < of->count && found < IRIS_SCENE_POINTS_MIN; i++) {
        int32_t k = 0;
        while (k < i && !(of->used[k] && is_same(&of->points[k], &of->points[i], of_image))) {
            k++;
        }
        found += of->used[i] && k == i;
    }
    return found == IRIS_SCENE_POINTS_MIN;
}

iris_q32 iris_scene_distance(const iris_sensor *sensor, const iris_scene_point *point)
{
    iris_vec2 at, is = point->image;
    if (iris_sensor_project(&at, 0, sensor, point->world) != IRIS_OK) {
        return INT64_MAX;
    }
    return iris_vec3_length(iris_vec3_sub((iris_vec3){is.x, is.y, 0}, (iris_vec3){at.x, at.y, 0}));
}

/* The sums of distances. */
static void measure(iris_scene_camera *camera, const iris_scene_problem *of)
{
    iris_wide total = {0, 0}, squares = {0, 0};
    int32_t n = 0;
    for (int32_t i = 0; i < of->count; i++) {
        iris_q32 d = of->used[i] ? iris_scene_distance(&camera->sensor, &of->points[i]) : 0;
        d = d > FARTHEST ? FARTHEST : d;
        n += of->used[i];
        total = iris_wide_add(total, iris_wide_from(d));
        d = iris_wide_round_shift_sat(iris_wide_from(d), 4);
        squares = iris_wide_add(squares, iris_wide_mul(d, d));
    }
    camera->total = iris_wide_round_shift_sat(total, 0);
    iris_wide root = iris_wide_mul(iris_wide_sqrt(squares), 16 * 65536);
    camera->rms = iris_wide_div_sat(root, iris_sqrt_u64((uint64_t)n << 32));
}

/* a reach + by m */
static iris_q32 moved(iris_q32 a, iris_q32 reach, iris_q32 by, iris_q32 m)
{
    iris_wide sum = iris_wide_add(iris_wide_mul(a, reach), iris_wide_mul(by, m));
    return iris_wide_round_shift_sat(sum, 32);
}

/* The camera of a matrix between pairs. */
static iris_scene_flaw camera_of(iris_scene_camera *camera, const iris_scene_problem *of,
                                 const iris_q32 m[IRIS_SCENE_NUMBERS])
{
    iris_q32 pixels[IRIS_SCENE_NUMBERS];
    iris_q32 slope = iris_vec3_length((iris_vec3){m[8], m[9], m[10]});
    if (slope <= m[11] / AFFINE) {
        return IRIS_SCENE_UNDETERMINED;
    }
    for (int k = 0; k < 4; k++) {
        pixels[k] = moved(m[k], of->image_reach, of->image_middle.x, m[8 + k]);
        pixels[4 + k] = moved(m[4 + k], of->image_reach, of->image_middle.y, m[8 + k]);
        pixels[8 + k] = m[8 + k];
    }
    if (iris_sensor_decompose(&camera->sensor, pixels) != IRIS_OK) {
        return IRIS_SCENE_UNDETERMINED;
    }
    iris_vec3 origin = {0, 0, 0};
    if (iris_pose_into(&camera->sensor.pose, origin).z < 0) {
        return IRIS_SCENE_MIRRORED;
    }
    iris_vec3 place = iris_vec3_scale(camera->sensor.pose.place, of->reach);
    camera->sensor.pose.place = iris_vec3_add(place, of->middle);
    measure(camera, of);
    return IRIS_SCENE_FINE;
}

/* Are all points used in front of the camera? */
static int sees_all(const iris_scene_problem *of, const iris_q32 m[IRIS_SCENE_NUMBERS])
{
    int all = 1;
    for (int32_t i = 0; i < of->count; i++) {
        iris_vec2 at;
        iris_q32 depth;
        all &= !of->used[i] || iris_scene_show(&at, &depth, m, &of->pairs[i]);
    }
    return all;
}

static iris_scene_flaw calibrate(iris_scene_fit *fit, iris_scene_problem *of)
{
    iris_q32 m[IRIS_SCENE_NUMBERS];
    if (!has_six(of, 0) || !has_six(of, 1) || !iris_scene_normalize(of)) {
        return IRIS_SCENE_TOO_FEW;
    }
    if (iris_scene_is_flat(of)) {
        return IRIS_SCENE_FLAT;
    }
    if (of->count >= ROBUST_FROM) {
        if (!iris_scene_leave_out(of)) {
            return IRIS_SCENE_BEHIND;
        }
        if (!has_six(of, 0) || !has_six(of, 1) || !iris_scene_normalize(of)) {
            return IRIS_SCENE_UNDETERMINED;
        }
        if (iris_scene_is_flat(of)) {
            return IRIS_SCENE_FLAT;
        }
    }
    iris_scene_solve(m, of);
    if (!iris_scene_is_single(of) || iris_scene_is_line(of)) {
        return IRIS_SCENE_UNDETERMINED;
    }
    if (!sees_all(of, m)) {
        return IRIS_SCENE_BEHIND;
    }
    iris_scene_flaw flaw = camera_of(&fit->linear, of, m);
    if (flaw == IRIS_SCENE_FINE) {
        iris_scene_refine(m, of);
        flaw = camera_of(&fit->refined, of, m);
    }
    return flaw;
}

iris_status iris_scene_calibrate(iris_scene_fit *fit, uint8_t *used, const iris_scene_point *points,
                                 int32_t count, iris_scratch *scratch)
{
    if (!fit || !used || !points || !scratch) {
        return IRIS_ERR_ARG;
    }
    if (count < 0 || count > IRIS_SCENE_POINTS_MAX) {
        return IRIS_ERR_RANGE;
    }
    for (int32_t i = 0; i < count; i++) {
        const iris_scene_point *p = &points[i];
        if (!is_near(p->world.x) || !is_near(p->world.y) || !is_near(p->world.z) || !is_near(p->image.x) ||
            !is_near(p->image.y)) {
            return IRIS_ERR_RANGE;
        }
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_scene_problem of = {.points = points, .count = count, .used = used};
    of.pairs = iris_scratch_take(scratch, (size_t)count * sizeof *of.pairs);
    of.distances = iris_scratch_take(scratch, (size_t)count * sizeof *of.distances);
    of.triangle.numbers =
        iris_scratch_take(scratch, IRIS_TRIANGLE_NUMBERS(IRIS_SCENE_NUMBERS) * sizeof *of.triangle.numbers);
    if (!of.pairs || !of.distances || !of.triangle.numbers) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    for (int32_t i = 0; i < count; i++) {
        used[i] = 1;
    }
    iris_scene_fit made = {.flaw = IRIS_SCENE_TOO_FEW};
    made.flaw = calibrate(&made, &of);
    for (int32_t i = 0; i < count; i++) {
        made.left_out += !used[i];
    }
    *fit = made;
    iris_scratch_release(scratch, mark);
    return made.flaw == IRIS_SCENE_FINE ? IRIS_OK : IRIS_ERR_DATA;
}
