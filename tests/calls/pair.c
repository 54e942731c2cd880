/* Two cameras: from a board, as a text, epipolar lines, rectification, and where rays meet. */
#include "calls.h"
#include "iris/3d/calib_pair.h"
#include "iris/3d/epipolar.h"
#include "iris/3d/pair_text.h"
#include "iris/3d/rectify.h"
#include "iris/3d/triangulate.h"
#include "space.h"

static const iris_size usual = {640, 480};

/* Two cameras, the right one mostly beside the left one and turned a little. */
static void any_pair(iris_sensor cameras[2], iris_size left, iris_size right)
{
    iris_mat3 little;
    cameras[0] = draw_sensor(left, 10);
    cameras[1] = draw_sensor(right, 10);
    if (!draw_chance(4)) {
        iris_vec3 across = {draw_q32(0, 2), draw_q32(-1, 1) / 8, draw_q32(-1, 1) / 8};
        iris_vec3 axis = draw_direction();
        iris_rotation_about(&little, axis, draw_q32(-1, 1) / 4);
        cameras[1].pose.place = iris_pose_out_of(&cameras[0].pose, across);
        iris_mat3_multiply(&cameras[1].pose.turn, &little, &cameras[0].pose.turn);
    }
    if (draw_chance(20)) {
        cameras[1].pose.place = cameras[0].pose.place;
    }
    if (draw_chance(20)) {
        cameras[1].pose.place.x += draw_within(-100000, 100000);
    }
    iris_sensor *camera = &cameras[draw_below(2)];
    draw_spoiled(&camera->intrinsics.alpha_u, 5, 20);
    draw_spoiled(&camera->lens.k1, 7, 20);
    draw_spoiled(camera->pose.turn.m, 9, 20);
    draw_spoiled(&camera->pose.place.x, 3, 20);
}

static const iris_sensor *given_pair(iris_size left, iris_size right)
{
    iris_sensor made[2];
    any_pair(made, left, right);
    return draw_given(made, sizeof made);
}

static iris_vec2 any_pixel(iris_size size)
{
    iris_vec2 made = {draw_q32(-1, size.w), draw_q32(-1, size.h)};
    draw_spoiled(&made.x, 2, 12);
    return made;
}

/* ---- epipolar.h ---- */

static void essential(void)
{
    iris_mat3 *e = draw_results(sizeof *e);
    const iris_sensor *pair = given_pair(usual, usual);
    CALL(iris_epipolar_essential(e, &pair[0].pose, &pair[1].pose));
}

static void fundamental(void)
{
    iris_mat3 *f = draw_results(sizeof *f);
    const iris_sensor *pair = given_pair(usual, usual);
    CALL(iris_epipolar_fundamental(f, &pair[0], &pair[1]));
}

static void line(void)
{
    iris_line2 *made = draw_results(sizeof *made);
    const iris_sensor *pair = given_pair(usual, usual);
    iris_vec2 pixel = any_pixel(usual);
    iris_line2 other = {draw_any_q32(), draw_any_q32(), draw_any_q32()};
    (void)iris_line2_distance(&other, pixel);
    CALL(iris_epipolar_line(made, &pair[0], &pair[1], pixel));
}

static void miss(void)
{
    iris_q32 *pixels = draw_results(sizeof *pixels);
    const iris_sensor *pair = given_pair(usual, usual);
    iris_vec2 left = any_pixel(usual), right = any_pixel(usual);
    CALL(iris_epipolar_miss(pixels, &pair[0], &pair[1], left, right));
}

/* ---- rectify.h ---- */

static iris_size any_picture_size(void)
{
    iris_size size = {draw_within(60, 200), draw_within(60, 200)};
    if (draw_chance(10)) {
        *(draw_chance(2) ? &size.w : &size.h) = draw_int(2, IRIS_REMAP_SOURCE_MAX);
    }
    return size;
}

static void rectify(void)
{
    iris_size sizes[2] = {any_picture_size(), any_picture_size()};
    iris_rectify_config config = {{0, 0}, (iris_rectify_keep)draw_within(0, 1)};
    if (draw_chance(3)) {
        config.size = (iris_size){draw_int(16, 200), draw_int(16, 200)};
    }
    if (draw_chance(20)) {
        config.keep = (iris_rectify_keep)draw_int(IRIS_RECTIFY_VALID, IRIS_RECTIFY_ALL);
    }
    iris_rectified *made = OR_NULL(draw_results(sizeof *made));
    const iris_sensor *pair = OR_NULL(given_pair(sizes[0], sizes[1]));
    const iris_size *of = OR_NULL(draw_given(sizes, sizeof sizes));
    const iris_rectify_config *with = draw_chance(6) ? NULL : draw_given(&config, sizeof config);
    iris_scratch *scratch = draw_scratch(IRIS_RECTIFY_SCRATCH_BYTES);
    CALL(iris_rectify(made, pair, of, with, scratch));
}

static void rectify_point(void)
{
    iris_rectified made = {.focal = draw_q32(100, 800), .baseline = draw_q32(1, 9)};
    made.cameras[0] = draw_sensor(usual, 10);
    made.cameras[0].lens = (iris_lens){.k1 = 0};
    draw_spoiled(&made.baseline, 2, 10);
    draw_spoiled(&made.cameras[0].intrinsics.alpha_u, 5, 10);
    draw_spoiled(made.cameras[0].pose.turn.m, 9, 10);
    draw_spoiled(&made.cameras[0].pose.place.x, 3, 10);
    iris_vec3 *world = OR_NULL(draw_results(sizeof *world));
    const iris_rectified *rectified = OR_NULL(draw_given(&made, sizeof made));
    iris_vec2 pixel = any_pixel(usual);
    uint16_t disparity = (uint16_t)draw_below(draw_chance(8) ? 3 : 65536);
    CALL(iris_rectify_point(world, rectified, pixel, disparity));
}

/* ---- triangulate.h ---- */

/* Rays to one place, nearly; some from one place, parallel, or away from it. */
static void triangulate(void)
{
    iris_line3 rays[6];
    iris_vec3 target = draw_vec3(20);
    int32_t count = draw_int(2, 6);
    int fits = count >= 0 && count <= 6;
    uint32_t kind = draw_below(8);
    for (int i = 0; i < 6; i++) {
        rays[i] = (iris_line3){draw_vec3(9), draw_direction()};
        if (kind == 0) {
            rays[i].origin = rays[0].origin;
        }
        if (kind == 1) {
            rays[i].direction = rays[0].direction;
        } else if (!draw_chance(30)) {
            iris_vec3 way = iris_vec3_sub(target, rays[i].origin), little = draw_vec3(1);
            way = iris_vec3_add(way, iris_vec3_scale(little, 1000000));
            (void)iris_vec3_normalize(&rays[i].direction, way);
        }
        draw_spoiled(&rays[i].origin.x, 3, 60);
        draw_spoiled(&rays[i].direction.x, 3, 100);
    }
    iris_triangulation *made = OR_NULL(draw_results(sizeof *made));
    const iris_line3 *given = OR_NULL(draw_given(rays, (size_t)(fits ? count : 6) * sizeof *rays));
    count = fits || count < 0 ? count : 6;
    CALL(iris_triangulate(made, given, count));
}

/* ---- calib_pair.h ---- */

/* Seldom so many points that they tell of a pair: that takes long. */
enum { PAIR_VIEWS = 2, PAIR_POINTS = 6 };

/* A board as two cameras see it, some pixels off, twice, or anything. */
static void see_board(iris_pair_point *points, const iris_sensor cameras[2])
{
    iris_vec3 tilt = {draw_q32(-1, 1) / 2, draw_q32(-1, 1) / 2, draw_q32(-1, 1)};
    iris_vec3 ahead = {draw_q32(-60, 20), draw_q32(-40, 20), draw_q32(250, 400)};
    iris_mat3 turn;
    iris_rotation_from_vector(&turn, tilt);
    for (int i = 0; i < PAIR_POINTS; i++) {
        iris_vec3 on_board = {30 * (i % 3) * IRIS_Q32_ONE, 30 * (i / 3) * IRIS_Q32_ONE, 0};
        iris_vec3 world =
            iris_pose_out_of(&cameras[0].pose, iris_vec3_add(ahead, iris_mat3_vector(&turn, on_board)));
        points[i] = (iris_pair_point){{on_board.x, on_board.y}, {0, 0}, {0, 0}};
        (void)iris_sensor_project(&points[i].left, NULL, &cameras[0], world);
        (void)iris_sensor_project(&points[i].right, NULL, &cameras[1], world);
        points[i].left.x ^= (iris_q32)draw_below(1u << 29);
        if (i > 0 && draw_chance(60)) {
            points[i] = points[draw_below((uint32_t)i)];
        }
        draw_spoiled(&points[i].board.x, 6, 150);
    }
}

static void pair_calibrate(void)
{
    iris_sensor cameras[2];
    iris_pair_view views[PAIR_VIEWS];
    int32_t count = draw_chance(3) ? draw_int(0, PAIR_VIEWS) : draw_within(1, PAIR_VIEWS);
    int fits = count >= 0 && count <= PAIR_VIEWS, tells = draw_chance(4);
    size_t room = (size_t)(fits ? count : 0), all = 0;
    any_pair(cameras, usual, usual);
    for (int v = 0; v < PAIR_VIEWS; v++) {
        iris_pair_point points[PAIR_POINTS];
        int32_t n = tells ? draw_within(4, PAIR_POINTS) : draw_within(0, 4);
        see_board(points, cameras);
        views[v] = (iris_pair_view){OR_NULL(draw_given(points, (size_t)n * sizeof *points)), n};
        all += v < count ? (size_t)n : 0;
        if (draw_chance(60)) {
            views[v].count = draw_chance(2) ? draw_within(INT32_MIN, -1) : draw_within(4097, INT32_MAX);
        }
    }
    iris_pair_fit *fit = OR_NULL(draw_results(sizeof *fit));
    iris_pair_place *places = OR_NULL(draw_results(room * sizeof *places));
    const iris_pair_view *given = OR_NULL(draw_given(views, room * sizeof *views));
    const iris_sensor *of = OR_NULL(draw_given(cameras, sizeof cameras));
    count = fits || count < 0 || count > IRIS_BOARD_VIEWS_MAX ? count : 0;
    iris_scratch *scratch = draw_scratch(IRIS_PAIR_SCRATCH_BYTES(room, all));
    CALL(iris_pair_calibrate(fit, places, given, count, of, scratch));
}

/* ---- pair_text.h ---- */

static iris_pair any_pair_model(void)
{
    iris_sensor cameras[2];
    any_pair(cameras, usual, usual);
    iris_pair made = {.turn = draw_vec3(1), .place = draw_vec3(100)};
    for (int k = 0; k < 2; k++) {
        made.cameras[k] = (iris_camera_model){usual, cameras[k].intrinsics, cameras[k].lens};
    }
    draw_spoiled(&made.turn.x, 6, 10);
    return made;
}

static void write_text(void)
{
    iris_sensor sensors[2];
    iris_pair made = any_pair_model();
    size_t capacity = draw_chance(3) ? draw_below(IRIS_PAIR_TEXT_BYTES) : IRIS_PAIR_TEXT_BYTES;
    char *text = OR_NULL(draw_results(capacity));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    const iris_pair *pair = OR_NULL(draw_given(&made, sizeof made));
    iris_pair_sensors(sensors, &made);
    CALL(iris_pair_write_text(text, capacity, length, pair));
}

static void read_text(void)
{
    char text[IRIS_PAIR_TEXT_BYTES] = "iris pair 1";
    size_t length = 11;
    iris_pair made = any_pair_model();
    (void)iris_pair_write_text(text, sizeof text, &length, &made);
    if (draw_chance(2)) {
        text[draw_below((uint32_t)length)] ^= (char)draw_below(128);
    }
    iris_pair *pair = OR_NULL(draw_results(sizeof *pair));
    int32_t *line = OR_NULL(draw_state(NULL, sizeof *line));
    length = draw_chance(4) ? draw_below((uint32_t)length + 1) : length;
    const char *given = OR_NULL(draw_given(text, length));
    CALL(iris_pair_read_text(pair, line, given, length));
}

const random_call calls_pair[] = {
    {"iris_epipolar_essential", essential},
    {"iris_epipolar_fundamental", fundamental},
    {"iris_epipolar_line", line},
    {"iris_epipolar_miss", miss},
    {"iris_rectify", rectify},
    {"iris_rectify_point", rectify_point},
    {"iris_triangulate", triangulate},
    {"iris_pair_calibrate", pair_calibrate},
    {"iris_pair_write_text", write_text},
    {"iris_pair_read_text", read_text},
    {NULL, NULL},
};
