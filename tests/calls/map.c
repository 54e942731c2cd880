/* Maps: scans, grids of odds and their texts, where a robot is, and maps of space. */
#include "iris/3d/localize.h"
#include "iris/3d/map_text.h"
#include "iris/3d/voxel_map.h"

#include "calls.h"

enum { SIDE = 40, BEAMS = 40 };

static iris_map_pose any_pose(void)
{
    iris_map_pose pose = {draw_within(-300, 300), draw_within(-300, 300),
                          (iris_angle)draw_within(-32768, 32767)};
    if (draw_chance(8)) {
        *(draw_chance(2) ? &pose.x_mm : &pose.y_mm) = draw_int(-IRIS_MAP_PLACE_MAX_MM, IRIS_MAP_PLACE_MAX_MM);
    }
    return pose;
}

/* ---- scan.h ---- */

static void from_ranges(void)
{
    int32_t ranges[BEAMS];
    iris_range_sensor made = {.mount = any_pose(),
                              .first_q16 = draw_int(-1000000, 1000000),
                              .step_q16 = draw_int(-60000000, 60000000),
                              .least_mm = 10,
                              .most_mm = 3000,
                              .quiet_mm = draw_within(0, 3000),
                              .spread_mm = 20};
    int32_t count = draw_int(0, BEAMS);
    int fits = count >= 0 && count <= BEAMS;
    for (int i = 0; i < BEAMS; i++) {
        ranges[i] = draw_int(-10, 3500);
    }
    if (draw_chance(5)) {
        int32_t *numbers[] = {&made.least_mm, &made.most_mm, &made.quiet_mm, &made.spread_mm};
        *numbers[draw_below(4)] = draw_int(0, IRIS_SCAN_REACH_MAX_MM / 2);
    }
    size_t room = (size_t)(fits ? count : BEAMS);
    iris_beam *beams = OR_NULL(draw_results(room * sizeof *beams));
    int32_t *beam_count = OR_NULL(draw_results(sizeof *beam_count));
    const int32_t *given = OR_NULL(draw_given(ranges, room * sizeof *ranges));
    const iris_range_sensor *sensor = OR_NULL(draw_given(&made, sizeof made));
    count = fits || count < 0 || count > IRIS_SCAN_BEAMS_MAX ? count : BEAMS;
    CALL(iris_scan_from_ranges(beams, beam_count, given, count, sensor));
}

static iris_depth_camera any_depth_camera(iris_size size)
{
    iris_depth_camera camera;
    iris_depth_camera_defaults(&camera, size, draw_within(20, 200) * 65536, draw_within(10, 100) * 65536);
    camera.kind = draw_chance(2) ? IRIS_DEPTH_DISPARITY : IRIS_DEPTH_MM;
    camera.tilt = (iris_angle)(draw_chance(2) ? 0 : draw_int(-15000, 15000));
    camera.height_mm = draw_within(0, 500);
    camera.mount = draw_chance(2) ? camera.mount : any_pose();
    if (draw_chance(4)) {
        int32_t *numbers[] = {&camera.focal_q16, &camera.baseline_q16, &camera.u0_q16,  &camera.v0_q16,
                              &camera.height_mm, &camera.low_mm,       &camera.high_mm, &camera.near_mm,
                              &camera.far_mm,    &camera.spread_q16};
        *numbers[draw_below(10)] = draw_chance(2) ? draw_int(1, 65535) : draw_int(INT32_MIN, INT32_MAX);
    }
    return camera;
}

static void from_depth(void)
{
    iris_size size = draw_size();
    iris_depth_camera made = any_depth_camera(size);
    iris_beam *beams = OR_NULL(draw_results((size_t)(size.w + 1) * sizeof *beams));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const iris_image *depth = draw_input(IRIS_GRAY_U16, size);
    const iris_depth_camera *camera = OR_NULL(draw_given(&made, sizeof made));
    iris_scratch *scratch = draw_scratch(IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(size.w));
    CALL(iris_scan_from_depth(beams, count, depth, camera, scratch));
}

/* Beams that end within a room of some meters; rarely null. */
static const iris_scan *any_scan(int32_t *count)
{
    iris_beam beams[BEAMS];
    iris_scan made = {
        .count = draw_within(0, BEAMS), .x_mm = draw_within(-100, 100), .y_mm = draw_within(-100, 100)};
    int32_t reach = draw_chance(4) ? IRIS_SCAN_REACH_MAX_MM - 1 : 600;
    for (int32_t i = 0; i < made.count; i++) {
        beams[i] = (iris_beam){draw_within(-reach, reach), draw_within(-reach, reach), draw_within(0, 60), 1};
        beams[i].hit = draw_chance(4) ? draw_int(0, 1) : 1;
        if (draw_chance(300)) {
            int32_t *numbers[] = {&beams[i].x_mm, &beams[i].y_mm, &beams[i].spread_mm};
            *numbers[draw_below(3)] = draw_int(-IRIS_SCAN_REACH_MAX_MM, IRIS_SCAN_REACH_MAX_MM);
        }
    }
    *count = made.count;
    made.beams = OR_NULL(draw_given(beams, (size_t)made.count * sizeof *beams));
    if (draw_chance(30)) {
        made.count =
            draw_chance(2) ? draw_within(INT32_MIN, -1) : draw_within(IRIS_SCAN_BEAMS_MAX + 1, INT32_MAX);
    }
    if (draw_chance(30)) {
        *(draw_chance(2) ? &made.x_mm : &made.y_mm) =
            draw_int(-IRIS_SCAN_REACH_MAX_MM, IRIS_SCAN_REACH_MAX_MM);
    }
    return OR_NULL(draw_given(&made, sizeof made));
}

/* ---- grid.h ---- */

/* Some cells around (0, 0), or far away. */
static iris_grid plain_grid(void)
{
    iris_grid made = {.w = draw_within(1, SIDE), .h = draw_within(1, SIDE), .cell_mm = draw_within(20, 60)};
    made.left_mm = -made.w * made.cell_mm / 2;
    made.bottom_mm = -made.h * made.cell_mm / 2;
    if (draw_chance(12)) {
        made.cell_mm = draw_within(1, IRIS_GRID_CELL_MAX_MM);
        made.left_mm = draw_within(1 - IRIS_MAP_PLACE_MAX_MM, IRIS_MAP_PLACE_MAX_MM - 1);
    }
    return made;
}

/* One number may be wrong. */
static void spoil_grid(iris_grid *grid)
{
    int32_t *sides[] = {&grid->w, &grid->h}, *places[] = {&grid->left_mm, &grid->bottom_mm};
    if (draw_chance(30)) {
        *sides[draw_below(2)] =
            draw_chance(2) ? draw_within(INT32_MIN, 0) : draw_within(IRIS_GRID_SIDE_MAX + 1, INT32_MAX);
    }
    if (draw_chance(30)) {
        *places[draw_below(2)] = draw_int(-IRIS_MAP_PLACE_MAX_MM, IRIS_MAP_PLACE_MAX_MM);
    }
    if (draw_chance(30)) {
        grid->cell_mm = draw_int(1, IRIS_GRID_CELL_MAX_MM);
    }
}

/* In memory that a call may change; rarely null. */
static const iris_grid *any_grid(iris_size *size, int is_changed)
{
    iris_grid made = plain_grid();
    size_t cells = (size_t)made.w * (size_t)made.h;
    *size = (iris_size){made.w, made.h};
    made.odds = is_changed ? draw_results(cells) : draw_given(NULL, cells);
    made.odds = OR_NULL(made.odds);
    spoil_grid(&made);
    return OR_NULL(draw_given(&made, sizeof made));
}

static void init(void)
{
    iris_size cells = {draw_int(1, SIDE), draw_int(1, SIDE)};
    int32_t corner[2] = {draw_int(1 - IRIS_MAP_PLACE_MAX_MM, IRIS_MAP_PLACE_MAX_MM - 1),
                         draw_within(-99, 99)};
    int32_t cell_mm = draw_int(1, IRIS_GRID_CELL_MAX_MM);
    size_t bytes = draw_chance(3) ? draw_below(SIDE * SIDE + 1) : SIDE * SIDE;
    iris_grid *grid = OR_NULL(draw_results(sizeof *grid));
    int8_t *odds = OR_NULL(draw_results(bytes));
    const int32_t *corner_mm = OR_NULL(draw_given(corner, sizeof corner));
    CALL(iris_grid_init(grid, odds, bytes, cells, cell_mm, corner_mm));
}

static void fuse(void)
{
    iris_size size;
    int32_t count;
    iris_fusion made;
    iris_fusion_defaults(&made);
    if (draw_chance(4)) {
        int32_t *numbers[] = {&made.hit, &made.miss, &made.limit};
        *numbers[draw_below(3)] = draw_int(1, 127);
    }
    const iris_grid *grid = any_grid(&size, 1);
    const iris_scan *scan = any_scan(&count);
    const iris_fusion *fusion = draw_chance(8) ? NULL : draw_given(&made, sizeof made);
    iris_map_pose robot = any_pose();
    iris_scratch *scratch = draw_scratch(IRIS_GRID_FUSE_SCRATCH_BYTES(size.w, size.h));
    if (grid && grid->odds) {
        (void)iris_map_pose_step(robot, iris_map_pose_after(robot, any_pose()));
    }
    CALL(iris_grid_fuse(grid, robot, scan, fusion, scratch));
}

static void to_picture(void)
{
    iris_size size;
    const iris_grid *grid = any_grid(&size, 0);
    const iris_image *image = draw_output(IRIS_GRAY8, size);
    CALL(iris_grid_to_picture(image, grid));
}

static void from_picture(void)
{
    iris_size size;
    iris_grid_shades made;
    iris_grid_shades_defaults(&made);
    if (draw_chance(2)) {
        made = (iris_grid_shades){draw_int(0, 65536), draw_int(0, 65536), draw_int(0, 1)};
    }
    const iris_grid *grid = any_grid(&size, 1);
    const iris_image *image = draw_input(IRIS_GRAY8, size);
    const iris_grid_shades *shades = draw_chance(8) ? NULL : draw_given(&made, sizeof made);
    CALL(iris_grid_from_picture(grid, image, shades));
}

/* ---- localize.h ---- */

static void field_init(void)
{
    iris_size size;
    const iris_grid *grid = any_grid(&size, 0);
    size_t needed = IRIS_FIELD_BYTES(size.w, size.h);
    size_t bytes = draw_chance(6) ? draw_below((uint32_t)needed + 1) : needed;
    iris_field *field = OR_NULL(draw_results(sizeof *field));
    uint8_t *memory = OR_NULL(draw_results(bytes));
    iris_scratch *scratch = draw_scratch(IRIS_FIELD_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_field_init(field, memory, bytes, grid, scratch));
}

/* Of any numbers: what is near walls, or not; rarely null. */
static const iris_field *any_field(void)
{
    iris_grid grid = plain_grid();
    size_t cells = (size_t)grid.w * (size_t)grid.h;
    uint8_t *near = draw_given(NULL, IRIS_FIELD_BYTES(grid.w, grid.h));
    iris_field made = {near, near + cells, grid.w, grid.h, grid.cell_mm, grid.left_mm, grid.bottom_mm};
    spoil_grid(&grid);
    made.w = grid.w;
    made.cell_mm = grid.cell_mm;
    made.near = OR_NULL(made.near);
    made.blocks = OR_NULL(made.blocks);
    return OR_NULL(draw_given(&made, sizeof made));
}

static iris_localize_config any_config(void)
{
    iris_localize_config config;
    iris_localize_defaults(&config);
    config.window_cells = draw_within(1, 10);
    config.angle_steps = draw_within(0, 4);
    config.angle_step = (iris_angle)draw_within(1, 2000);
    config.least_percent = draw_chance(2) ? 1 : draw_int(1, 100);
    config.least_beams = draw_within(1, 10);
    if (draw_chance(8)) {
        config.angle_step = (iris_angle)draw_int(-100, 32767);
        config.least_beams = draw_int(1, 100);
    }
    if (draw_chance(20)) {
        int32_t *numbers[] = {&config.window_cells, &config.angle_steps};
        *numbers[draw_below(2)] = draw_chance(2) ? draw_within(INT32_MIN, -1) : draw_within(1001, INT32_MAX);
    }
    return config;
}

static void localize(void)
{
    int32_t count;
    iris_localize_config made = any_config();
    iris_location *location = OR_NULL(draw_results(sizeof *location));
    const iris_field *field = any_field();
    const iris_scan *scan = any_scan(&count);
    const iris_localize_config *config = draw_chance(60) ? NULL : draw_given(&made, sizeof made);
    iris_map_pose predicted = any_pose();
    int fits = made.window_cells >= 1 && made.window_cells <= IRIS_LOCALIZE_WINDOW_MAX &&
               made.angle_steps >= 0 && made.angle_steps <= IRIS_LOCALIZE_STEPS_MAX;
    size_t needed = !config ? IRIS_LOCALIZE_SCRATCH_BYTES(count, 10, 20)
                    : fits  ? IRIS_LOCALIZE_SCRATCH_BYTES(count, made.window_cells, made.angle_steps)
                            : 0;
    iris_scratch *scratch = draw_scratch(needed);
    CALL(iris_localize(location, field, predicted, scan, config, scratch));
}

/* ---- map_text.h ---- */

static iris_map_text any_map_text(void)
{
    iris_map_text made = {.image = "floor.pgm", .cell_mm = draw_int(1, IRIS_GRID_CELL_MAX_MM)};
    made.left_mm = draw_int(1 - IRIS_MAP_PLACE_MAX_MM, IRIS_MAP_PLACE_MAX_MM - 1);
    made.bottom_mm = draw_within(-5000, 5000);
    iris_grid_shades_defaults(&made.shades);
    if (draw_chance(2)) {
        made.shades = (iris_grid_shades){draw_int(0, 65536), draw_int(0, 65536), draw_int(0, 1)};
    }
    for (size_t i = 0; i < sizeof made.image && draw_chance(3); i++) {
        made.image[i] = (char)draw_within(draw_chance(8) ? 0 : 33, 126);
    }
    if (draw_chance(10)) {
        for (size_t i = 0; i < sizeof made.image; i++) {
            made.image[i] = (char)(i + 1 < sizeof made.image || draw_chance(2) ? 'x' : 0);
        }
    }
    return made;
}

static void write_text(void)
{
    iris_map_text made = any_map_text();
    size_t capacity = draw_chance(3) ? draw_below(IRIS_MAP_TEXT_BYTES) : IRIS_MAP_TEXT_BYTES;
    char *text = OR_NULL(draw_results(capacity));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    const iris_map_text *map = OR_NULL(draw_given(&made, sizeof made));
    CALL(iris_map_write_text(text, capacity, length, map));
}

static void read_text(void)
{
    char text[IRIS_MAP_TEXT_BYTES] = "image: a.pgm";
    size_t length = 12;
    iris_map_text made = any_map_text();
    (void)iris_map_write_text(text, sizeof text, &length, &made);
    if (draw_chance(2)) {
        text[draw_below((uint32_t)length)] ^= (char)draw_below(128);
    }
    iris_map_text *map = OR_NULL(draw_results(sizeof *map));
    int32_t *line = OR_NULL(draw_state(NULL, sizeof *line));
    length = draw_chance(4) ? draw_below((uint32_t)length + 1) : length;
    const char *given = OR_NULL(draw_given(text, length));
    CALL(iris_map_read_text(map, line, given, length));
}

/* ---- voxel_map.h ---- */

/* Some cubes around (0, 0) from the floor up, or far away. */
static iris_voxel_map plain_voxels(void)
{
    iris_voxel_map made = {.counts = {draw_within(1, 20), draw_within(1, 20), draw_within(1, 9)},
                           .cell_mm = draw_within(40, 120)};
    for (int axis = 0; axis < 2; axis++) {
        made.least_mm[axis] = -made.counts[axis] * made.cell_mm / 2;
    }
    if (draw_chance(10)) {
        made.least_mm[draw_below(3)] = draw_within(1 - IRIS_MAP_PLACE_MAX_MM, IRIS_MAP_PLACE_MAX_MM - 1);
    }
    return made;
}

/* In memory that a call may change; rarely an invalid one, or null. counts: as they are for sure. */
static const iris_voxel_map *any_voxels(int32_t counts[3], int is_changed)
{
    iris_voxel_map made = plain_voxels();
    size_t bytes = IRIS_VOXEL_MAP_BYTES(made.counts[0], made.counts[1], made.counts[2]);
    for (int axis = 0; axis < 3; axis++) {
        counts[axis] = made.counts[axis];
    }
    made.odds = is_changed ? draw_results(bytes) : draw_given(NULL, bytes);
    made.odds = OR_NULL(made.odds);
    if (draw_chance(20)) {
        made.counts[draw_below(3)] =
            draw_chance(2) ? draw_within(INT32_MIN, 0) : draw_within(1025, INT32_MAX);
    }
    if (draw_chance(30)) {
        made.least_mm[draw_below(3)] = draw_int(-IRIS_MAP_PLACE_MAX_MM, IRIS_MAP_PLACE_MAX_MM);
    }
    if (draw_chance(30)) {
        made.cell_mm = draw_int(1, IRIS_GRID_CELL_MAX_MM);
    }
    return OR_NULL(draw_given(&made, sizeof made));
}

static void voxels_init(void)
{
    iris_voxel_map made = plain_voxels();
    if (draw_chance(4)) {
        made.counts[draw_below(3)] = draw_int(1, 20);
    }
    int32_t cell_mm = draw_int(1, IRIS_GRID_CELL_MAX_MM);
    size_t bytes = draw_chance(3) ? draw_below(8000) : 8000;
    iris_voxel_map *map = OR_NULL(draw_results(sizeof *map));
    int8_t *odds = OR_NULL(draw_results(bytes));
    const int32_t *counts = OR_NULL(draw_given(made.counts, sizeof made.counts));
    const int32_t *least_mm = OR_NULL(draw_given(made.least_mm, sizeof made.least_mm));
    CALL(iris_voxel_map_init(map, odds, bytes, counts, cell_mm, least_mm));
}

static void voxels_fuse(void)
{
    iris_size size = {draw_within(1, 24), draw_within(1, 24)};
    iris_depth_camera made = any_depth_camera(size);
    iris_voxel_fusion fusion;
    int32_t counts[3];
    iris_voxel_fusion_defaults(&fusion);
    if (draw_chance(4)) {
        int32_t *numbers[] = {&fusion.fusion.hit, &fusion.fusion.miss, &fusion.fusion.limit, &fusion.every};
        *numbers[draw_below(4)] = draw_int(1, 127);
    }
    const iris_voxel_map *map = any_voxels(counts, 1);
    const iris_image *depth = draw_input(IRIS_GRAY_U16, size);
    const iris_depth_camera *camera = OR_NULL(draw_given(&made, sizeof made));
    const iris_voxel_fusion *config = draw_chance(8) ? NULL : draw_given(&fusion, sizeof fusion);
    iris_map_pose robot = any_pose();
    iris_scratch *scratch = draw_scratch(IRIS_VOXEL_MAP_FUSE_SCRATCH_BYTES(counts[0], counts[1], counts[2]));
    CALL(iris_voxel_map_fuse(map, robot, depth, camera, config, scratch));
}

static void voxels_solid(void)
{
    int32_t counts[3], odds = draw_int(-127, 127);
    const iris_voxel_map *map = any_voxels(counts, 0);
    size_t needed = IRIS_VOXEL_BYTES(counts[0], counts[1], counts[2]);
    size_t bytes = draw_chance(6) ? draw_below((uint32_t)needed) : needed;
    iris_voxel_world *world = OR_NULL(draw_results(sizeof *world));
    uint32_t *bits = OR_NULL(draw_results(bytes));
    CALL(iris_voxel_map_solid(world, bits, bytes, map, odds));
}

const random_call calls_map[] = {
    {"iris_scan_from_ranges", from_ranges},
    {"iris_scan_from_depth", from_depth},
    {"iris_grid_init", init},
    {"iris_grid_fuse", fuse},
    {"iris_grid_to_picture", to_picture},
    {"iris_grid_from_picture", from_picture},
    {"iris_field_init", field_init},
    {"iris_localize", localize},
    {"iris_map_write_text", write_text},
    {"iris_map_read_text", read_text},
    {"iris_voxel_map_init", voxels_init},
    {"iris_voxel_map_fuse", voxels_fuse},
    {"iris_voxel_map_solid", voxels_solid},
    {NULL, NULL},
};
