/* Cameras and lenses, their texts, pictures without the lens's bends, and floors of cameras that are mounted. */
#include "iris/3d/camera_text.h"
#include "iris/3d/mounting.h"
#include "iris/3d/remap.h"

#include "calls.h"
#include "space.h"

static const iris_size usual = {640, 480};

/* On the picture plane, mostly where a camera sees. */
static iris_vec2 any_place(void)
{
    iris_vec2 made = {draw_q32(-2, 2) / 4, draw_q32(-2, 2) / 4};
    if (draw_chance(3)) {
        made = (iris_vec2){draw_q32(-9, 9), draw_q32(-9, 9)};
    }
    draw_spoiled(&made.x, 2, 10);
    return made;
}

static iris_vec2 any_pixel(void)
{
    iris_vec2 made = {draw_q32(-100, 740), draw_q32(-100, 580)};
    draw_spoiled(&made.x, 2, 10);
    return made;
}

static void straighten(void)
{
    iris_vec2 *straight = draw_state(NULL, sizeof *straight), p = any_place();
    const iris_sensor *sensor = draw_any_sensor(usual, 10);
    (void)iris_lens_bend(&sensor->lens, p);
    CALL(iris_lens_straighten(straight, &sensor->lens, p));
}

static void plane(void)
{
    iris_vec2 *p = draw_results(sizeof *p), pixel = any_pixel();
    const iris_sensor *sensor = draw_any_sensor(usual, 10);
    (void)iris_intrinsics_pixel(&sensor->intrinsics, any_place());
    CALL(iris_intrinsics_plane(p, &sensor->intrinsics, pixel));
}

static void project(void)
{
    iris_vec2 *pixel = draw_results(sizeof *pixel);
    iris_q32 *depth = draw_chance(4) ? NULL : draw_results(sizeof *depth);
    const iris_sensor *sensor = draw_any_sensor(usual, 10);
    iris_vec3 world = draw_chance(6) ? draw_vec3(100) : draw_seen(sensor, 1, 50);
    draw_spoiled(&world.x, 3, 10);
    CALL(iris_sensor_project(pixel, depth, sensor, world));
}

static void ray(void)
{
    iris_line3 *line = draw_results(sizeof *line);
    const iris_sensor *sensor = draw_any_sensor(usual, 10);
    iris_vec2 pixel = any_pixel();
    CALL(iris_sensor_ray(line, sensor, pixel));
}

static void decompose(void)
{
    iris_q32 made[12];
    iris_sensor *sensor = draw_results(sizeof *sensor);
    iris_sensor_matrix(made, draw_any_sensor(usual, 10));
    for (int i = 0, scaled = draw_chance(3); i < 12 && scaled; i++) {
        made[i] = -(made[i] / 1000);
    }
    draw_spoiled(made, 12, 8);
    const iris_q32 *m = draw_given(made, sizeof made);
    CALL(iris_sensor_decompose(sensor, m));
}

/* ---- camera_text.h ---- */

static iris_camera_model any_model(void)
{
    const iris_sensor *sensor = draw_any_sensor(usual, 10);
    iris_camera_model made = {usual, sensor->intrinsics, sensor->lens};
    if (draw_chance(10)) {
        *(draw_chance(2) ? &made.size.w : &made.size.h) = draw_int(1, IRIS_SIDE_MAX);
    }
    return made;
}

static void write_text(void)
{
    iris_camera_model made = any_model();
    size_t capacity = draw_chance(3) ? draw_below(IRIS_CAMERA_TEXT_BYTES) : IRIS_CAMERA_TEXT_BYTES;
    char *text = OR_NULL(draw_results(capacity));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    const iris_camera_model *model = OR_NULL(draw_given(&made, sizeof made));
    CALL(iris_camera_write_text(text, capacity, length, model));
}

static void read_text(void)
{
    char text[IRIS_CAMERA_TEXT_BYTES] = "iris camera 1";
    size_t length = 13;
    iris_camera_model made = any_model();
    (void)iris_camera_write_text(text, sizeof text, &length, &made);
    if (draw_chance(2)) {
        text[draw_below((uint32_t)length)] ^= (char)draw_below(128);
    }
    iris_camera_model *model = OR_NULL(draw_results(sizeof *model));
    int32_t *line = OR_NULL(draw_state(NULL, sizeof *line));
    length = draw_chance(4) ? draw_below((uint32_t)length + 1) : length;
    const char *given = OR_NULL(draw_given(text, length));
    CALL(iris_camera_read_text(model, line, given, length));
}

/* ---- remap.h ---- */

enum { PLACES = 3000 };

/* A view of what the camera sees; its map has PLACES places at most. */
static iris_remap_view any_view(const iris_sensor *camera)
{
    iris_remap_view view;
    iris_remap_view_defaults(&view, &camera->intrinsics, draw_size());
    view.fill = (uint8_t)draw_below(256);
    view.step_bits = draw_chance(3) ? draw_int(0, IRIS_REMAP_STEP_BITS_MAX) : 2;
    if (draw_chance(3)) {
        iris_vec3 axis = draw_direction();
        iris_rotation_about(&view.turn, axis, draw_q32(-1, 1) / (draw_chance(2) ? 1 : 8));
    }
    draw_spoiled(view.turn.m, 9, 20);
    draw_spoiled(&view.intrinsics.alpha_u, 5, 20);
    if (draw_chance(20)) {
        *(draw_chance(2) ? &view.size.w : &view.size.h) = draw_int(1, IRIS_SIDE_MAX);
    }
    int fits = view.size.w > 0 && view.size.w <= IRIS_SIDE_MAX && view.size.h > 0 &&
               view.size.h <= IRIS_SIDE_MAX && view.step_bits >= 0 &&
               view.step_bits <= IRIS_REMAP_STEP_BITS_MAX;
    if (fits && IRIS_REMAP_PLACES(view.size.w, view.size.h, view.step_bits) > PLACES) {
        view.size = (iris_size){17, 16};
    }
    return view;
}

static void remap_init(void)
{
    iris_size source = draw_size();
    const iris_sensor *camera = draw_any_sensor(source, 10);
    iris_remap_view made = any_view(camera);
    int fits = made.size.w > 0 && made.size.w <= 70 && made.size.h > 0 && made.size.h <= 70 &&
               made.step_bits >= 0 && made.step_bits <= IRIS_REMAP_STEP_BITS_MAX;
    size_t count = fits ? IRIS_REMAP_PLACES(made.size.w, made.size.h, made.step_bits) : PLACES;
    iris_remap *remap = OR_NULL(draw_results(sizeof *remap));
    iris_place *places = OR_NULL(draw_results(count * sizeof *places));
    const iris_remap_view *view = OR_NULL(draw_given(&made, sizeof made));
    if (draw_chance(10)) {
        *(draw_chance(2) ? &source.w : &source.h) = draw_int(1, IRIS_REMAP_SOURCE_MAX);
    }
    camera = OR_NULL(camera);
    CALL(iris_remap_init(remap, places, view, camera, source));
}

/* A map for pictures of this size; null when there is none. */
static const iris_remap *any_remap(iris_size source, iris_size *size)
{
    static iris_place places[PLACES];
    iris_remap remap;
    iris_sensor camera = draw_sensor(source, 0);
    if (draw_chance(8)) {
        camera = *draw_any_sensor(source, 0);
    }
    iris_remap_view view = any_view(&camera);
    if (view.size.w > 70 || view.size.h > 70) {
        view.size = (iris_size){20, 10};
    }
    *size = view.size;
    if (iris_remap_init(&remap, places, &view, &camera, source) != IRIS_OK) {
        return NULL;
    }
    size_t count = IRIS_REMAP_PLACES(view.size.w, view.size.h, view.step_bits);
    remap.places = draw_state(places, count * sizeof *places);
    return OR_NULL(draw_given(&remap, sizeof remap));
}

static void remap_draw(void)
{
    iris_size source = draw_size(), size;
    iris_format format = draw_gray_or_color();
    const iris_remap *remap = any_remap(source, &size);
    const iris_image *src = draw_input(format, source), *dst = draw_output(format, size);
    CALL(iris_remap_draw(dst, src, remap));
}

static void remap_row(void)
{
    iris_size source = draw_size(), size;
    iris_format format = draw_gray_or_color();
    const iris_remap *remap = any_remap(source, &size);
    const iris_image *src = draw_input(format, source);
    void *pixels = OR_NULL(draw_results(3 * (size_t)(size.w > 0 ? size.w : 0)));
    int32_t y = draw_int(0, size.h > 0 ? size.h - 1 : 0);
    CALL(iris_remap_row(pixels, remap, src, y));
}

/* ---- mounting.h ---- */

/* Some centimeters above the floor, looking down; rarely anything, or null. */
static const iris_mounting *any_mounting(void)
{
    iris_mounting made = {.height = draw_q32(30, 600),
                          .tilt = draw_q32(0, 1),
                          .pan = draw_q32(-1, 1) / 4,
                          .roll = draw_q32(-1, 1) / 8,
                          .right = draw_q32(-99, 99),
                          .ahead = draw_q32(-300, 300)};
    draw_spoiled(&made.height, 6, 6);
    return OR_NULL(draw_given(&made, sizeof made));
}

static void mounting_pose(void)
{
    iris_pose *pose = OR_NULL(draw_results(sizeof *pose));
    const iris_mounting *mounting = any_mounting();
    CALL(iris_mounting_pose(pose, mounting));
}

static void mounting_floor(void)
{
    iris_camera_model made = any_model();
    iris_floor *floor = OR_NULL(draw_results(sizeof *floor));
    const iris_mounting *mounting = any_mounting();
    const iris_camera_model *camera = OR_NULL(draw_given(&made, sizeof made));
    CALL(iris_mounting_floor(floor, mounting, camera));
}

static void mounting_view(void)
{
    iris_birdseye_window made = {.size = draw_size(),
                                 .corner = iris_place_of(draw_int(-300, 100), draw_int(100, 2000)),
                                 .mm_per_pixel_q16 =
                                     draw_int(IRIS_BIRDSEYE_SCALE_MIN, IRIS_BIRDSEYE_SCALE_MAX)};
    iris_remap_view *view = OR_NULL(draw_results(sizeof *view));
    const iris_mounting *mounting = any_mounting();
    const iris_birdseye_window *window = OR_NULL(draw_given(&made, sizeof made));
    CALL(iris_mounting_view(view, mounting, window));
}

const random_call calls_camera[] = {
    {"iris_lens_straighten", straighten},  {"iris_intrinsics_plane", plane},
    {"iris_sensor_project", project},      {"iris_sensor_ray", ray},
    {"iris_sensor_decompose", decompose},  {"iris_camera_write_text", write_text},
    {"iris_camera_read_text", read_text},  {"iris_remap_init", remap_init},
    {"iris_remap_draw", remap_draw},       {"iris_remap_row", remap_row},
    {"iris_mounting_pose", mounting_pose}, {"iris_mounting_floor", mounting_floor},
    {"iris_mounting_view", mounting_view}, {NULL, NULL},
};
