/* Pairs of cameras: calibrated from noisy corners, rectified, and a drawn scene measured by them, all beside a truth in
 * double precision. */
#include <math.h>
#include <stdlib.h>

#include "iris/3d/calib_pair.h"
#include "iris/3d/rectify.h"
#include "iris/3d/stereo.h"
#include "picture.h"
#include "score.h"

#define W 640
#define H 480

static double real(iris_q32 a)
{
    return (double)a / 4294967296.0;
}

static iris_q32 whole(double a)
{
    return (iris_q32)llround(a * 4294967296.0);
}

static double random_between(double low, double high)
{
    static uint64_t x = 88172645463325252u;
    x ^= x << 13;
    x ^= x >> 7;
    x ^= x << 17;
    return low + (high - low) * ((double)(x >> 11) / 9007199254740992.0);
}

/* --- a camera in double precision --- */

static void bend(double seen[2], const iris_lens *l, const double p[2])
{
    const double x = p[0], y = p[1], r2 = x * x + y * y, radial = 1 + r2 * (real(l->k1) + r2 * real(l->k2));
    seen[0] = x * radial + 2 * real(l->p1) * x * y;
    seen[1] = y * radial + real(l->p1) * (r2 + 2 * y * y);
}

/* Returns the depth. */
static double project(double pixel[2], const iris_sensor *s, const double world[3])
{
    const iris_q32 *r = s->pose.turn.m;
    const double way[3] = {world[0] - real(s->pose.place.x), world[1] - real(s->pose.place.y),
                           world[2] - real(s->pose.place.z)};
    double c[3], seen[2];
    for (int i = 0; i < 3; i++) {
        c[i] = real(r[3 * i]) * way[0] + real(r[3 * i + 1]) * way[1] + real(r[3 * i + 2]) * way[2];
    }
    bend(seen, &s->lens, (const double[2]){c[0] / c[2], c[1] / c[2]});
    pixel[0] = real(s->intrinsics.alpha_u) * seen[0] + real(s->intrinsics.u0);
    pixel[1] = real(s->intrinsics.alpha_v) * seen[1] + real(s->intrinsics.v0);
    return c[2];
}

static void ray(double d[3], const iris_sensor *s, double u, double v)
{
    const double wanted[2] = {(u - real(s->intrinsics.u0)) / real(s->intrinsics.alpha_u),
                              (v - real(s->intrinsics.v0)) / real(s->intrinsics.alpha_v)};
    double p[2] = {wanted[0], wanted[1]}, seen[2];
    for (double off = 1; off > 1e-10;) {
        bend(seen, &s->lens, p);
        off = fabs(wanted[0] - seen[0]) + fabs(wanted[1] - seen[1]);
        p[0] += wanted[0] - seen[0];
        p[1] += wanted[1] - seen[1];
    }
    for (int i = 0; i < 3; i++) {
        d[i] =
            real(s->pose.turn.m[i]) * p[0] + real(s->pose.turn.m[3 + i]) * p[1] + real(s->pose.turn.m[6 + i]);
    }
}

/* Toed in by `toe` radians together, rolled, the right one higher and ahead, with barrels; places in meters. */
static void make_pair(iris_sensor pair[2], double toe)
{
    for (int k = 0; k < 2; k++) {
        const double sign = k ? 1 : -1;
        pair[k] = (iris_sensor){
            .intrinsics = {whole(560 + 14 * k), whole(558), 0, whole(325 - 9 * k), whole(236 + 7 * k)},
            .lens = {.k1 = whole(-0.24 + 0.03 * k), .k2 = whole(0.07), .p1 = whole(0.001)}};
        iris_rotation_from_vector(&pair[k].pose.turn,
                                  (iris_vec3){whole(0.02 * sign), whole(toe / 2 * sign), whole(0.02 * sign)});
        pair[k].pose.place = (iris_vec3){whole(0.09 * sign), whole(-0.01 * sign), whole(0.0075 * sign)};
    }
}

/* --- calibration --- */

#define VIEWS  8
#define POINTS 54
#define NOISE  0.2 /* pixels */

/* Normally distributed, nearly. */
static iris_q32 noise(void)
{
    double sum = 0;
    for (int i = 0; i < 12; i++) {
        sum += random_between(-0.5, 0.5);
    }
    return whole(NOISE * sum);
}

static iris_vec2 seen_at(const iris_sensor *camera, const double world[3])
{
    double pixel[2];
    (void)project(pixel, camera, world);
    return (iris_vec2){whole(pixel[0]) + noise(), whole(pixel[1]) + noise()};
}

/* A chessboard of 25 mm, tilted to all sides. */
static void see_board(iris_pair_point *points, const iris_sensor pair[2], int v)
{
    iris_mat3 turn;
    iris_rotation_from_vector(
        &turn, (iris_vec3){whole(0.5 * cos(0.8 * v)), whole(0.5 * sin(0.8 * v)), whole(0.1 * v)});
    for (int i = 0; i < POINTS; i++) {
        const double x = 0.025 * (i % 9), y = 0.025 * (i / 9), at[2] = {x - 0.1, y - 0.0625};
        const double middle[3] = {0.05 * (v % 3 - 1), 0.05 * (v / 3 - 1), 0.5 + 0.02 * v};
        double world[3];
        for (int k = 0; k < 3; k++) {
            world[k] = middle[k] + real(turn.m[3 * k]) * at[0] + real(turn.m[3 * k + 1]) * at[1];
        }
        points[i] =
            (iris_pair_point){{whole(x), whole(y)}, seen_at(&pair[0], world), seen_at(&pair[1], world)};
    }
}

static void score_calibration(score *s)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_PAIR_SCRATCH_BYTES(VIEWS, VIEWS * POINTS));
    static iris_pair_point points[VIEWS][POINTS];
    static iris_pair_place places[VIEWS];
    const int rounds = 12;
    double turned = 0, moved = 0, ratio = 0;
    iris_pair_view views[VIEWS];
    iris_sensor pair[2];
    int good = 1;
    make_pair(pair, 0.09);
    for (int round = 0; round < rounds && good; round++) {
        iris_scratch scratch;
        iris_pair_fit fit;
        iris_mat3 back, off;
        for (int v = 0; v < VIEWS; v++) {
            see_board(points[v], pair, v);
            views[v] = (iris_pair_view){points[v], POINTS};
        }
        (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
        good = iris_pair_calibrate(&fit, places, views, VIEWS, pair, &scratch) == IRIS_OK;
        iris_mat3_transpose(&back, &pair[0].pose.turn);
        iris_mat3_multiply(&off, &pair[1].pose.turn, &back);
        iris_mat3_transpose(&back, &off);
        iris_mat3_multiply(&off, &fit.right.turn, &back);
        const iris_vec3 turn = iris_rotation_to_vector(&off);
        const iris_vec3 place =
            iris_vec3_sub(fit.right.place, iris_pose_into(&pair[0].pose, pair[1].pose.place));
        const double errors[6] = {real(turn.x),  real(turn.y),  real(turn.z),
                                  real(place.x), real(place.y), real(place.z)};
        for (int k = 0; k < 6 && good; k++) {
            ratio += pow(errors[k] / real(fit.deviations[k]), 2) / (6 * rounds);
        }
        turned = fmax(turned,
                      57.29578 * sqrt(errors[0] * errors[0] + errors[1] * errors[1] + errors[2] * errors[2]));
        moved =
            fmax(moved, 1000 * sqrt(errors[3] * errors[3] + errors[4] * errors[4] + errors[5] * errors[5]));
    }
    score_row(s, "a pair 18 cm apart from 8 boards, corners by 0.2 px: turn and place, worst of 12",
              "0.1 degrees, 1 mm", score_if(good && turned <= 0.1 && moved <= 1), "%.3f degrees, %.2f mm",
              turned, moved);
    score_row(s, "the same: errors as shares of their standard deviations", "0.75 to 1.3",
              score_if(good && ratio >= 0.75 * 0.75 && ratio <= 1.3 * 1.3), "%.2f", sqrt(ratio));
}

/* --- rows --- */

typedef struct {
    iris_sensor pair[2];
    iris_rectified made;
    iris_remap maps[2];
    iris_place *places[2];
} rig;

static int make_rig(rig *r, double toe)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_RECTIFY_SCRATCH_BYTES);
    const iris_size sizes[2] = {{W, H}, {W, H}};
    iris_scratch scratch;
    make_pair(r->pair, toe);
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    int good = iris_rectify(&r->made, r->pair, sizes, NULL, &scratch) == IRIS_OK;
    for (int k = 0; k < 2; k++) {
        r->places[k] = malloc(IRIS_REMAP_PLACES(W, H, 3) * sizeof *r->places[k]);
        good =
            good && r->places[k] &&
            iris_remap_init(&r->maps[k], r->places[k], &r->made.views[k], &r->pair[k], sizes[k]) == IRIS_OK;
    }
    return good;
}

static void free_rig(rig *r)
{
    free(r->places[0]);
    free(r->places[1]);
}

/* By how many pixels a map is off at a place of the view, of what is at the point. */
static double map_off(const rig *r, int k, const double at[2], const double world[3])
{
    const int step = 1 << r->maps[k].step_bits, columns = ((W - 1) >> r->maps[k].step_bits) + 2;
    const int x = (int)(at[0] / step), y = (int)(at[1] / step);
    double seen[2], mapped[2] = {0, 0};
    for (int i = 0; i < 4; i++) {
        const iris_place *p = &r->places[k][(y + i / 2) * columns + x + i % 2];
        const double right = at[0] / step - x, down = at[1] / step - y;
        const double share = (i % 2 ? right : 1 - right) * (i / 2 ? down : 1 - down);
        mapped[0] += share * p->x_q16 / 65536;
        mapped[1] += share * p->y_q16 / 65536;
    }
    (void)project(seen, &r->pair[k], world);
    return hypot(mapped[0] - seen[0], mapped[1] - seen[1]);
}

static void score_rows(score *s)
{
    double rows = 0, maps = 0;
    int good = 1, points = 0;
    for (int round = 0; round < 20 && good; round++) {
        rig r;
        good = make_rig(&r, 0.02 * round);
        for (int i = 0; i < 500 && good; i++) {
            double d[3], world[3], at[2][2];
            const iris_vec3 from = r.made.cameras[0].pose.place;
            const double z = 0.5 / random_between(0.02, 1);
            ray(d, &r.made.cameras[0], random_between(1, W - 2), random_between(1, H - 2));
            world[0] = real(from.x) + z * d[0];
            world[1] = real(from.y) + z * d[1];
            world[2] = real(from.z) + z * d[2];
            (void)project(at[0], &r.made.cameras[0], world);
            (void)project(at[1], &r.made.cameras[1], world);
            if (at[1][0] > 0 && at[1][0] < W - 1) {
                rows = fmax(rows, fabs(at[0][1] - at[1][1]));
                maps = fmax(maps, fmax(map_off(&r, 0, at[0], world), map_off(&r, 1, at[1], world)));
                points++;
            }
        }
        free_rig(&r);
    }
    score_row(s, "rectified, toed in by 0 to 22 degrees: rows of what both see; by maps of steps of 8",
              "0.001 and 0.1 px", score_if(good && points > 1000 && rows <= 0.001 && maps <= 0.1),
              "%.6f and %.3f px", rows, maps);
}

/* --- a closed loop --- */

/* Gray levels of a surface, smooth between places 1/14, 1/28, 1/56, and 1/112 apart. */
static double speckle(double x, double y)
{
    double level = 0;
    for (int octave = 0; octave < 4; octave++) {
        const double sx = x * (14 << octave), sy = y * (14 << octave);
        const int left = (int)floor(sx), top = (int)floor(sy);
        const double right = sx - left, down = sy - top;
        for (int i = 0; i < 4; i++) {
            uint32_t key = (uint32_t)(left + i % 2) * 73856093u ^ (uint32_t)(top + i / 2) * 19349663u ^
                           (uint32_t)octave * 83492791u;
            key = (key ^ key >> 13) * 1274126177u;
            level += ((key ^ key >> 16) & 255) * (i % 2 ? right : 1 - right) * (i / 2 ? down : 1 - down) / 4;
        }
    }
    return level;
}

/* A tilted wall about 3 m away, and two boards before it, at 2.2 and 1.7 m: how far along the ray. */
static double look(double *level, const double from[3], const double d[3])
{
    static const double boards[2][5] = {{2.2, -0.55, -0.1, -0.35, 0.3}, {1.7, 0.15, 0.6, -0.1, 0.4}};
    double t = (3.2 + 0.2 * from[0] - from[2]) / (d[2] - 0.2 * d[0]);
    *level = speckle(from[0] + t * d[0], from[1] + t * d[1]);
    for (int i = 0; i < 2; i++) {
        const double *b = boards[i], s = (b[0] - from[2]) / d[2], x = from[0] + s * d[0],
                     y = from[1] + s * d[1];
        if (s < t && x > b[1] && x < b[2] && y > b[3] && y < b[4]) {
            t = s;
            *level = speckle(x + 5 * (i + 1), y);
        }
    }
    return t;
}

static void origin_of(double from[3], const iris_sensor *camera)
{
    from[0] = real(camera->pose.place.x);
    from[1] = real(camera->pose.place.y);
    from[2] = real(camera->pose.place.z);
}

/* The rectified view of what the camera sees. */
static int draw(iris_image *view, const rig *r, int k)
{
    iris_image seen = picture_make(W, H, IRIS_GRAY8);
    double from[3];
    *view = picture_make(W, H, IRIS_GRAY8);
    origin_of(from, &r->pair[k]);
    for (int i = 0; i < W * H && seen.data; i++) {
        double d[3], level;
        ray(d, &r->pair[k], i % W, i / W);
        (void)look(&level, from, d);
        ((uint8_t *)iris_image_row(&seen, i / W))[i % W] = (uint8_t)(level + 0.5);
    }
    int good = seen.data && view->data && iris_remap_draw(view, &seen, &r->maps[k]) == IRIS_OK;
    free(seen.data);
    return good;
}

static int match(iris_image *disparity, const iris_image views[2])
{
    const size_t bytes = IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(W, 100);
    void *memory = malloc(bytes);
    iris_scratch scratch;
    iris_stereo_semiglobal_config config;
    *disparity = picture_make(W, H, IRIS_GRAY_U16);
    iris_stereo_semiglobal_defaults(&config);
    config.stereo.max_disparity = 100;
    int good = memory && disparity->data && iris_scratch_init(&scratch, memory, bytes) == IRIS_OK &&
               iris_stereo_semiglobal(disparity, &views[0], &views[1], &config, &scratch) == IRIS_OK;
    free(memory);
    return good;
}

static void compare(score *s, const rig *r, const iris_image *disparity)
{
    int near = 0, all = 0;
    double squares = 0, from[3];
    origin_of(from, &r->made.cameras[0]);
    for (int i = 0; i < W * H; i++) {
        double d[3], level, at[2];
        iris_vec3 found;
        ray(d, &r->made.cameras[0], i % W, i / W);
        const double t = look(&level, from, d);
        const double there[3] = {from[0] + t * d[0], from[1] + t * d[1], from[2] + t * d[2]};
        (void)project(at, &r->made.cameras[1], there);
        if (at[0] >= 0) { /* the right view reaches so far */
            const iris_vec2 pixel = {i % W * IRIS_Q32_ONE, i / W * IRIS_Q32_ONE};
            const uint16_t match = ((const uint16_t *)iris_image_row(disparity, i / W))[i % W];
            const int known = iris_rectify_point(&found, &r->made, pixel, match) == IRIS_OK;
            const double share = known ? hypot(hypot(real(found.x) - there[0], real(found.y) - there[1]),
                                               real(found.z) - there[2]) /
                                             t
                                       : 1;
            all++;
            near += share < 0.05;
            squares += share < 0.05 ? share * share : 0;
        }
    }
    const double percent = 100.0 * near / (all > 0 ? all : 1),
                 rms = 100 * sqrt(squares / (near > 0 ? near : 1));
    score_row(s, "two toed-in cameras with lenses, drawn, rectified, matched: places within 5 % of the depth",
              "at least 95 %", score_if(percent >= 95), "%.1f %%; these by %.2f %% (root mean square)",
              percent, rms);
}

void score_pair(score *s)
{
    iris_image views[2] = {{0}, {0}}, disparity = {0};
    rig r;
    score_calibration(s);
    score_rows(s);
    if (make_rig(&r, 0.09) && draw(&views[0], &r, 0) && draw(&views[1], &r, 1) && match(&disparity, views)) {
        compare(s, &r, &disparity);
        if (s->pictures) {
            picture_save(&views[0], s->pictures, "pair_left.bmp");
            picture_save(&views[1], s->pictures, "pair_right.bmp");
        }
    }
    free_rig(&r);
    free(views[0].data);
    free(views[1].data);
    free(disparity.data);
}
