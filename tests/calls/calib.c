/* Cameras from points that are known: scenes and boards, and boards in pictures. */
#include "iris/3d/board_find.h"
#include "iris/3d/calib_board.h"
#include "iris/3d/calib_scene.h"

#include "calls.h"
#include "space.h"

/* Seldom so many points that wrong ones are left out, and boards that tell of a camera: that takes long. */
enum { SCENE_POINTS = 14, VIEWS = 3, VIEW_POINTS = 9 };

static void scene(void)
{
    iris_scene_point points[SCENE_POINTS];
    iris_sensor sensor = draw_sensor((iris_size){640, 480}, 10);
    int32_t count = draw_chance(80) ? 13 : draw_int(0, 9);
    int fits = count >= 0 && count <= SCENE_POINTS, flat = draw_chance(8);
    sensor.lens = (iris_lens){.k1 = 0};
    if (fits && draw_chance(2)) {
        count = count < 6 ? 7 : count;
    }
    for (int i = 0; i < SCENE_POINTS; i++) {
        points[i].world = draw_chance(30) ? draw_vec3(20) : draw_seen(&sensor, 5, 20);
        points[i].world.z = flat ? 0 : points[i].world.z;
        points[i].image = (iris_vec2){0, 0};
        (void)iris_sensor_project(&points[i].image, NULL, &sensor, points[i].world);
        points[i].image.x += draw_chance(20) ? draw_q32(-99, 99) : 0;
        if (i > 0 && draw_chance(60)) {
            points[i] = points[draw_below((uint32_t)i)];
        }
        draw_spoiled(&points[i].world.x, 5, 150);
    }
    iris_scene_fit *fit = OR_NULL(draw_results(sizeof *fit));
    size_t room = (size_t)(fits ? count : SCENE_POINTS);
    uint8_t *used = OR_NULL(draw_results(room));
    const iris_scene_point *given = OR_NULL(draw_given(points, room * sizeof *points));
    count = fits || count < 0 || count > IRIS_SCENE_POINTS_MAX ? count : 9;
    iris_scratch *scratch = draw_scratch(IRIS_SCENE_SCRATCH_BYTES(count >= 0 && count <= 1024 ? count : 0));
    CALL(iris_scene_calibrate(fit, used, given, count, scratch));
}

/* A view of some points of a board, in front of the camera; half of the boards face it. */
static void see_board(iris_board_point *points, int32_t count, iris_sensor *sensor)
{
    iris_vec3 tilt = {draw_q32(-1, 1), draw_q32(-1, 1), draw_q32(-1, 1)};
    iris_rotation_from_vector(&sensor->pose.turn, tilt);
    iris_pose turn = {.turn = sensor->pose.turn};
    iris_vec3 back =
        iris_pose_out_of(&turn, (iris_vec3){draw_q32(-20, 20), draw_q32(-20, 20), draw_q32(-400, -250)});
    sensor->pose.place = iris_vec3_add(back, (iris_vec3){30 * IRIS_Q32_ONE, 30 * IRIS_Q32_ONE, 0});
    for (int32_t i = 0; i < count; i++) {
        iris_vec3 world = {30 * (i % 3) * IRIS_Q32_ONE, 30 * (i / 3) * IRIS_Q32_ONE, 0};
        points[i].board = (iris_vec2){world.x, world.y};
        points[i].image = (iris_vec2){0, 0};
        (void)iris_sensor_project(&points[i].image, NULL, sensor, world);
        points[i].image.x += draw_within(INT32_MIN, INT32_MAX) / 8;
        if (i > 0 && draw_chance(100)) {
            points[i] = points[draw_below((uint32_t)i)];
        }
        draw_spoiled(&points[i].board.x, 4, 200);
    }
}

static void board(void)
{
    iris_board_view views[VIEWS];
    iris_size size = {640, 480};
    iris_sensor sensor = draw_sensor(size, 0);
    iris_board_config config = {draw_chance(4) ? draw_below(9) : 0, size};
    int32_t count = draw_chance(3) ? draw_int(0, VIEWS) : 2;
    int fits = count >= 0 && count <= VIEWS, tells = draw_chance(6);
    sensor.lens = (iris_lens){.k1 = sensor.lens.k1, .k2 = sensor.lens.k2};
    for (int v = 0; v < VIEWS; v++) {
        iris_board_point points[VIEW_POINTS];
        int32_t n = draw_chance(12) ? draw_within(0, VIEW_POINTS) : tells ? 6 : 4;
        see_board(points, VIEW_POINTS, &sensor);
        views[v] = (iris_board_view){OR_NULL(draw_given(points, (size_t)n * sizeof *points)), n};
        views[v].count = draw_chance(100) ? draw_int(INT32_MIN, 0) : n;
        if (views[v].count > n) {
            views[v].count = draw_chance(2) ? n : IRIS_BOARD_POINTS_MAX + 1;
        }
    }
    if (draw_chance(10)) {
        *(draw_chance(2) ? &config.size.w : &config.size.h) = draw_int(0, IRIS_SIDE_MAX);
    }
    size_t room = (size_t)(fits ? count : 0);
    iris_board_fit *fit = OR_NULL(draw_results(sizeof *fit));
    iris_board_place *places = OR_NULL(draw_results(room * sizeof *places));
    const iris_board_view *given = OR_NULL(draw_given(views, room * sizeof *views));
    const iris_board_config *with = draw_chance(8) ? NULL : draw_given(&config, sizeof config);
    count = fits || count < 0 || count > IRIS_BOARD_VIEWS_MAX ? count : 0;
    iris_scratch *scratch = draw_scratch(IRIS_BOARD_SCRATCH_BYTES(count >= 0 && count <= VIEWS ? count : 0));
    CALL(iris_board_calibrate(fit, places, given, count, with, scratch));
}

/* ---- board_find.h ---- */

/* Squares of a board in a picture that may be none, dark and bright; some have been lost. */
static void paint_board(const iris_image *image, iris_board_grid grid)
{
    if (!image || iris_image_check(image) != IRIS_OK || image->format != IRIS_GRAY8) {
        return;
    }
    int32_t side = draw_within(7, 12), left = draw_within(0, 9), top = draw_within(0, 9),
            lost = draw_int(0, 40);
    int32_t slant = draw_chance(2) ? draw_within(-4, 4) : 0;
    for (int32_t y = 0; y < image->h; y++) {
        uint8_t *row = iris_image_row(image, y);
        for (int32_t x = 0; x < image->w; x++) {
            int32_t u = x - left + y * slant / 16, v = y - top - x * slant / 16;
            int32_t i = u / side, k = v / side,
                    inside = u >= 0 && v >= 0 && i <= grid.columns && k <= grid.rows;
            row[x] = inside && (i + k) % 2 == 0 && i + 9 * k != lost ? 30 : 220;
        }
    }
}

/* Circles, which are squares here, in rows; every second row may be shifted. */
static void paint_circles(const iris_image *image, iris_board_grid grid, int shifted)
{
    if (!image || iris_image_check(image) != IRIS_OK || image->format != IRIS_GRAY8) {
        return;
    }
    int32_t step = draw_within(12, 14), wide = draw_within(4, 7), left = draw_within(0, 6),
            lost = draw_int(0, 40);
    for (int32_t y = 0; y < image->h; y++) {
        uint8_t *row = iris_image_row(image, y);
        for (int32_t x = 0; x < image->w; x++) {
            int32_t v = y - 3, k = v / step, u = x - left - (shifted && k % 2 ? step / 2 : 0), i = u / step;
            int32_t inside = u >= 0 && v >= 0 && i < grid.columns && k < grid.rows && i + 9 * k != lost;
            row[x] = inside && u % step < wide && v % step < wide ? 30 : 220;
        }
    }
}

/* A picture of a board, or of anything, and the board to look for. */
typedef struct {
    iris_size size;
    iris_board_grid grid, seen;
    size_t places; /* of the board to look for; 0 where it is none */
} board_call;

static board_call any_board(void)
{
    board_call made = {
        {draw_within(50, 70), draw_within(50, 70)}, {draw_within(3, 5), draw_within(3, 5)}, {0, 0}, 0};
    iris_board_grid *grid = &made.grid;
    made.seen = *grid;
    if (draw_chance(6)) {
        *(draw_chance(2) ? &grid->columns : &grid->rows) =
            draw_int(IRIS_BOARD_SIDE_MIN, IRIS_BOARD_SIDE_MAX / 4);
    }
    made.size = draw_chance(10) ? draw_size() : made.size;
    if (grid->columns >= IRIS_BOARD_SIDE_MIN && grid->columns <= IRIS_BOARD_SIDE_MAX &&
        grid->rows >= IRIS_BOARD_SIDE_MIN && grid->rows <= IRIS_BOARD_SIDE_MAX && made.size.w > 0 &&
        made.size.h > 0) {
        made.places = (size_t)grid->columns * (size_t)grid->rows;
    }
    return made;
}

static void corners(void)
{
    board_call made = any_board();
    size_t w = (size_t)made.size.w, h = (size_t)made.size.h;
    iris_vec2 *places = OR_NULL(draw_results(made.places * sizeof *places));
    iris_board_report *report = OR_NULL(draw_results(sizeof *report));
    const iris_image *gray = draw_input(IRIS_GRAY8, made.size);
    const iris_board_grid *grid = OR_NULL(draw_given(&made.grid, sizeof made.grid));
    if (!draw_chance(4)) {
        paint_board(gray, made.seen);
    }
    size_t needed =
        made.places ? IRIS_BOARD_CORNERS_SCRATCH_BYTES(w, h, made.grid.columns, made.grid.rows) : 0;
    iris_scratch *scratch = draw_scratch(needed);
    CALL(iris_board_corners(places, report, gray, grid, scratch));
}

static void circles(void)
{
    board_call made = any_board();
    size_t w = (size_t)made.size.w, h = (size_t)made.size.h;
    iris_board_circle_rows rows = (iris_board_circle_rows)draw_within(0, 1);
    iris_vec2 *places = OR_NULL(draw_results(made.places * sizeof *places));
    iris_board_report *report = OR_NULL(draw_results(sizeof *report));
    const iris_image *gray = draw_input(IRIS_GRAY8, made.size);
    const iris_board_grid *grid = OR_NULL(draw_given(&made.grid, sizeof made.grid));
    if (!draw_chance(4)) {
        paint_circles(gray, made.seen, rows == IRIS_BOARD_CIRCLES_SHIFTED);
    }
    if (draw_chance(30)) {
        rows = (iris_board_circle_rows)draw_int(IRIS_BOARD_CIRCLES, IRIS_BOARD_CIRCLES_SHIFTED);
    }
    size_t needed =
        made.places ? IRIS_BOARD_CIRCLES_SCRATCH_BYTES(w, h, made.grid.columns, made.grid.rows) : 0;
    iris_scratch *scratch = draw_scratch(needed);
    CALL(iris_board_circles(places, report, gray, grid, rows, scratch));
}

const random_call calls_calib[] = {
    {"iris_scene_calibrate", scene},
    {"iris_board_calibrate", board},
    {"iris_board_corners", corners},
    {"iris_board_circles", circles},
    {NULL, NULL},
};
