#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "camera_file.h"
#include "commands.h"
#include "complain.h"
#include "depth_file.h"
#include "file_write.h"
#include "inputs.h"
#include "iris/3d/carve.h"
#include "iris/3d/localize.h"
#include "iris/3d/voxel_map.h"
#include "json.h"
#include "map_file.h"
#include "number_file.h"
#include "one_line.h"
#include "progress.h"
#include "system.h"

static const char help[] =
    "usage: iris map DEPTH... --camera CAMERA --poses POSES [--baseline MM | --depth] [--height MM]\n"
    "                [--tilt DEG] [--ahead MM] [--band LOW,HIGH] [--far MM] [--cell MM]\n"
    "                [-o MAP.yaml] [--ply MODEL.ply] [--localize MAP.yaml] [--json]\n\n"
    "A map of the floor from pictures of disparities or depths and the poses that they were taken from;\n"
    "or, with --localize, the poses from such pictures, a map, and what odometry says.\n\n"
    "  DEPTH...         PGM of 16 bits, or folders of them: disparities as iris stereo -o writes them\n"
    "  --camera CAMERA  of pictures without lens: the rectified.pair of iris rectify -o, or a camera file\n"
    "  --poses POSES    a text with a pose for each picture: x and y in millimeters, and the heading in\n"
    "                   degrees, counterclockwise from x; with --localize as odometry has them\n"
    "  --baseline MM    between the two cameras of disparities (default: that of the pair)\n"
    "  --depth          pictures have depths in millimeters instead\n"
    "  --height MM      of the camera above the floor (default 200)\n"
    "  --tilt DEG       how far it looks down, -80 to 80 (default 0)\n"
    "  --ahead MM       how far it is in front of the robot's reference point (default 0)\n"
    "  --band LOW,HIGH  heights of what is in the way, in millimeters (default 50,1000)\n"
    "  --far MM         what is farther away is not taken (default 5000)\n"
    "  --cell MM        a cell's side, 1 to 10000 (default 50)\n"
    "  -o MAP.yaml      the map as map servers of robots have it, with MAP.pgm beside it\n"
    "  --ply MODEL.ply  the surface of a map in space, up to the height of the band, as a cloud of points\n"
    "  --localize MAP.yaml\n"
    "                   finds the poses in that map; the first one is to be within 0.5 m and 10 degrees\n"
    "  --json           one JSON object; with --localize one for each picture\n\n"
    "JSON has frames, left out (taken outside of the map), cells (across and up), origin (of the map, in\n"
    "millimeters), occupied and free (how many cells); or, with --localize, frame, x, y, heading, verdict\n"
    "(found, few, none, ambiguous, or edge), score (0 to 1), and spread (in millimeters).\n\n"
    "example: iris map disparities/ --camera camera.txt --baseline 120 --poses poses.txt -o floor.yaml\n";

#define POSES_MAX  65536
#define VOXELS_MAX ((size_t)1 << 28)
#define MM(q32)    ((int32_t)llround((double)(q32) / 4294967296.0))

typedef struct {
    const char *camera_path, *poses_path, *map, *output, *ply;
    iris_depth_camera camera;
    iris_size size;
    int32_t cell_mm;
    int json;
    iris_map_pose *poses;
    input_list inputs;
} wishes;

/* What is worked with, for all frames. */
typedef struct {
    picture_buffer depth;
    iris_beam *beams;
    void *memory; /* scratch */
    size_t bytes;
    iris_grid grid;
    iris_voxel_map space; /* odds null: not wanted */
    uint8_t *field_bytes;
    iris_field field;
    int left_out;
    int64_t seen; /* columns of pictures that show where something is, or that nothing is */
} session;

/* --- poses --- */

static int read_poses(wishes *w)
{
    iris_q32 *numbers = malloc(3 * sizeof *numbers * POSES_MAX);
    w->poses = malloc(POSES_MAX * sizeof *w->poses);
    number_table table = {numbers, NULL, 0, POSES_MAX, 3};
    int good = numbers && w->poses;
    if (!good) {
        complain(w->poses_path, "not enough memory");
    }
    good = good && number_file_read(&table, w->poses_path);
    if (good && table.rows != w->inputs.count) {
        complain(w->poses_path, "%d poses, but %d pictures: there is to be one for each", table.rows,
                 w->inputs.count);
        good = 0;
    }
    for (int i = 0; i < table.rows && good; i++) {
        const iris_q32 *n = numbers + 3 * (size_t)i;
        const double turns = (double)n[2] / 4294967296.0 / 360;
        w->poses[i] = (iris_map_pose){MM(n[0]), MM(n[1]),
                                      iris_angle_wrap((int32_t)lround(65536 * (turns - floor(turns))))};
        if (abs(w->poses[i].x_mm) >= IRIS_MAP_PLACE_MAX_MM / 2 ||
            abs(w->poses[i].y_mm) >= IRIS_MAP_PLACE_MAX_MM / 2) {
            complain(w->poses_path, "pose %d is farther away than 134 km", i + 1);
            good = 0;
        }
    }
    free(numbers);
    return good;
}

/* --- a frame --- */

static int start(session *s, const wishes *w)
{
    s->beams = malloc((size_t)w->size.w * sizeof *s->beams);
    s->bytes = IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(w->size.w);
    const size_t fuse = IRIS_GRID_FUSE_SCRATCH_BYTES(s->grid.w, s->grid.h),
                 match = IRIS_LOCALIZE_SCRATCH_BYTES(w->size.w, 10, 20),
                 field = w->map ? IRIS_FIELD_SCRATCH_BYTES(s->grid.w, s->grid.h) : 0,
                 space = s->space.odds ? IRIS_VOXEL_MAP_FUSE_SCRATCH_BYTES(
                                             s->space.counts[0], s->space.counts[1], s->space.counts[2])
                                       : 0;
    s->bytes = fuse > s->bytes ? fuse : s->bytes;
    s->bytes = match > s->bytes ? match : s->bytes;
    s->bytes = field > s->bytes ? field : s->bytes;
    s->bytes = space > s->bytes ? space : s->bytes;
    s->memory = system_scratch(s->bytes);
    if (!s->beams || !s->memory) {
        complain(w->map ? w->map : "--cell", "not enough memory");
        return 0;
    }
    return 1;
}

static iris_scratch scratch_of(const session *s)
{
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, s->memory, s->bytes);
    return scratch;
}

static int read_scan(iris_scan *scan, session *s, const wishes *w, int i)
{
    const char *path = w->inputs.paths[i];
    iris_scratch scratch = scratch_of(s);
    *scan = (iris_scan){s->beams, 0, w->camera.mount.x_mm, w->camera.mount.y_mm};
    if (!depth_file_read(&s->depth, path)) {
        return 0;
    }
    if (s->depth.image.w != w->size.w || s->depth.image.h != w->size.h) {
        complain(path, "%dx%d pixels, but the camera was calibrated with pictures of %dx%d",
                 (int)s->depth.image.w, (int)s->depth.image.h, (int)w->size.w, (int)w->size.h);
        return 0;
    }
    const iris_status status =
        iris_scan_from_depth(s->beams, &scan->count, &s->depth.image, &w->camera, &scratch);
    if (status != IRIS_OK) {
        complain(path, "%s", iris_status_text(status));
    }
    return status == IRIS_OK;
}

/* --- mapping --- */

/* A map that holds all poses and what is seen from them. */
static int lay_out(session *s, const wishes *w)
{
    int32_t least[2] = {INT32_MAX, INT32_MAX}, most[2] = {INT32_MIN, INT32_MIN};
    for (int i = 0; i < w->inputs.count; i++) {
        const int32_t at[2] = {w->poses[i].x_mm, w->poses[i].y_mm};
        for (int k = 0; k < 2; k++) {
            least[k] = at[k] < least[k] ? at[k] : least[k];
            most[k] = at[k] > most[k] ? at[k] : most[k];
        }
    }
    const int64_t around = w->camera.far_mm + abs(w->camera.mount.x_mm) + (int64_t)w->cell_mm;
    int64_t cells[2];
    int32_t corner[2];
    for (int k = 0; k < 2; k++) {
        const int64_t first = (int64_t)floor((double)(least[k] - around) / w->cell_mm);
        cells[k] = (int64_t)ceil((double)(most[k] + around) / w->cell_mm) - first;
        corner[k] = (int32_t)(first * w->cell_mm);
    }
    if (cells[0] > IRIS_GRID_SIDE_MAX || cells[1] > IRIS_GRID_SIDE_MAX) {
        complain("--cell", "%lldx%lld cells would be needed, and a map has %d along a side: take larger ones",
                 (long long)cells[0], (long long)cells[1], IRIS_GRID_SIDE_MAX);
        return 0;
    }
    const size_t bytes = (size_t)cells[0] * (size_t)cells[1];
    int8_t *odds = malloc(bytes);
    if (!odds || iris_grid_init(&s->grid, odds, bytes, (iris_size){(int32_t)cells[0], (int32_t)cells[1]},
                                w->cell_mm, corner) != IRIS_OK) {
        complain("--cell", "not enough memory: take larger cells");
        free(odds);
        return 0;
    }
    return 1;
}

/* The same floor, from there up to the band's upper end. */
static int lay_out_space(session *s, const wishes *w)
{
    const int32_t top = w->camera.high_mm > w->camera.height_mm ? w->camera.high_mm : w->camera.height_mm;
    const int32_t counts[3] = {s->grid.w, s->grid.h, top / w->cell_mm + 2};
    const int32_t least[3] = {s->grid.left_mm, s->grid.bottom_mm, -w->cell_mm};
    const size_t bytes = IRIS_VOXEL_MAP_BYTES(counts[0], counts[1], counts[2]);
    int8_t *odds = bytes <= VOXELS_MAX ? malloc(bytes) : NULL;
    if (!odds || iris_voxel_map_init(&s->space, odds, bytes, counts, w->cell_mm, least) != IRIS_OK) {
        complain("--ply", "%dx%dx%d voxels are too many: take larger cells", (int)counts[0], (int)counts[1],
                 (int)counts[2]);
        free(odds);
        return 0;
    }
    return 1;
}

static int fuse(session *s, const wishes *w, int i)
{
    iris_scan scan;
    if (!read_scan(&scan, s, w, i)) {
        return 0;
    }
    s->seen += scan.count;
    iris_scratch scratch = scratch_of(s);
    s->left_out += iris_grid_fuse(&s->grid, w->poses[i], &scan, NULL, &scratch) != IRIS_OK;
    if (s->space.odds) {
        scratch = scratch_of(s);
        (void)iris_voxel_map_fuse(&s->space, w->poses[i], &s->depth.image, &w->camera, NULL, &scratch);
    }
    return 1;
}

static int write_model(FILE *file, const void *user)
{
    return iris_carve_write_ply((iris_sink){file_write_bytes, file}, user) == IRIS_OK && fflush(file) == 0;
}

static int write_space(const wishes *w, const iris_voxel_map *space)
{
    const size_t bytes = IRIS_VOXEL_BYTES(space->counts[0], space->counts[1], space->counts[2]);
    uint32_t *bits = malloc(bytes);
    iris_voxel_world world;
    int good = bits && iris_voxel_map_solid(&world, bits, bytes, space, IRIS_ODDS_OCCUPIED) == IRIS_OK;
    if (!good) {
        complain(w->ply, "not enough memory");
    }
    good = good && file_write(w->ply, write_model, &world);
    free(bits);
    return good;
}

static void tell_map(const wishes *w, const session *s)
{
    int occupied = 0, is_free = 0;
    for (size_t i = 0; i < (size_t)s->grid.w * (size_t)s->grid.h; i++) {
        occupied += s->grid.odds[i] >= IRIS_ODDS_OCCUPIED;
        is_free += s->grid.odds[i] <= IRIS_ODDS_FREE;
    }
    if (!w->json) {
        one_line(stdout, w->output ? w->output : w->poses_path);
        printf(": %d pictures, %dx%d cells of %d mm, %d occupied, %d free\n", w->inputs.count, (int)s->grid.w,
               (int)s->grid.h, (int)s->grid.cell_mm, occupied, is_free);
        return;
    }
    json_writer json = json_to(stdout);
    const struct {
        const char *key;
        int32_t value;
    } all[] = {
        {"frames", w->inputs.count}, {"left_out", s->left_out}, {"occupied", occupied}, {"free", is_free}};
    json_open(&json, '{');
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        json_key(&json, all[i].key);
        json_integer(&json, all[i].value);
    }
    json_key(&json, "cells");
    json_open(&json, '[');
    json_integer(&json, s->grid.w);
    json_integer(&json, s->grid.h);
    json_close(&json, ']');
    json_key(&json, "origin");
    json_open(&json, '[');
    json_integer(&json, s->grid.left_mm);
    json_integer(&json, s->grid.bottom_mm);
    json_close(&json, ']');
    json_close(&json, '}');
}

static int make_map(const wishes *w, session *s)
{
    int good = lay_out(s, w) && (!w->ply || lay_out_space(s, w)) && start(s, w);
    for (int i = 0; i < w->inputs.count && good; i++) {
        progress_show("map", i + 1, w->inputs.count, w->inputs.paths[i]);
        good = fuse(s, w, i);
    }
    progress_clear();
    if (good && s->seen == 0) {
        complain(w->poses_path,
                 "no picture has a match above the floor: are they disparities of this camera?");
        good = 0;
    }
    good =
        good && (!w->output || map_file_write(w->output, &s->grid)) && (!w->ply || write_space(w, &s->space));
    if (good) {
        tell_map(w, s);
    }
    return good;
}

/* --- localization --- */

static void tell_pose(const wishes *w, int i, iris_map_pose pose, const iris_location *location)
{
    static const char *const verdicts[] = {"found", "few", "none", "ambiguous", "edge"};
    const double heading = pose.heading * 360 / 65536.0;
    if (!w->json) {
        printf("%d %d %.2f %s %.2f %d ", (int)pose.x_mm, (int)pose.y_mm, heading, verdicts[location->verdict],
               location->score_permille / 1000.0, (int)location->spread_mm);
        one_line(stdout, w->inputs.paths[i]);
        putchar('\n');
        return;
    }
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "frame");
    json_string(&json, w->inputs.paths[i]);
    json_key(&json, "x");
    json_integer(&json, pose.x_mm);
    json_key(&json, "y");
    json_integer(&json, pose.y_mm);
    json_key(&json, "heading");
    json_number(&json, heading, 2);
    json_key(&json, "verdict");
    json_string(&json, verdicts[location->verdict]);
    json_key(&json, "score");
    json_number(&json, location->score_permille / 1000.0, 3);
    json_key(&json, "spread");
    json_integer(&json, location->spread_mm);
    json_close(&json, '}');
}

static int find_poses(const wishes *w, session *s)
{
    iris_localize_config config;
    iris_map_pose pose = w->poses[0];
    int good = map_file_read(&s->grid, w->map) && start(s, w);
    iris_localize_defaults(&config);
    if (good) {
        const size_t bytes = IRIS_FIELD_BYTES(s->grid.w, s->grid.h);
        iris_scratch scratch = scratch_of(s);
        s->field_bytes = malloc(bytes);
        good = s->field_bytes &&
               iris_field_init(&s->field, s->field_bytes, bytes, &s->grid, &scratch) == IRIS_OK;
        config.window_cells = (500 + s->grid.cell_mm - 1) / s->grid.cell_mm;
        config.window_cells = config.window_cells > 10 ? 10 : config.window_cells;
        if (!good) {
            complain(w->map, "not enough memory");
        }
    }
    for (int i = 0; i < w->inputs.count && good; i++) {
        iris_scan scan;
        iris_location location;
        if (i > 0) {
            pose = iris_map_pose_after(pose, iris_map_pose_step(w->poses[i - 1], w->poses[i]));
        }
        good = read_scan(&scan, s, w, i);
        if (good) {
            iris_scratch scratch = scratch_of(s);
            good = iris_localize(&location, &s->field, pose, &scan, &config, &scratch) == IRIS_OK;
            pose = good && iris_location_is_of_use(&location, &config) ? location.pose : pose;
        }
        if (good) {
            tell_pose(w, i, pose, &location);
            if (location.verdict ==
                IRIS_LOCALIZE_FOUND) { /* from now on odometry tells more than where to look */
                config.predicted_mm = 20;
                config.predicted_angle = 182;
            }
        }
    }
    return good;
}

/* --- the call --- */

typedef struct {
    const char *baseline, *height, *tilt, *ahead, *band, *far, *cell;
    int depth;
} texts;

/* What a map cannot be made with. */
static int check_camera(const iris_depth_camera *c, const iris_intrinsics *k, const wishes *w)
{
    const double product = (double)k->alpha_u / 4294967296.0 * c->baseline_q16 / 65536;
    if (k->alpha_u < IRIS_Q32_ONE || k->alpha_u > 32000 * IRIS_Q32_ONE) {
        complain(w->camera_path, "a focal length of %.6g pixels: from 1 to 32000 can be used",
                 (double)k->alpha_u / 4294967296.0);
        return 0;
    }
    if (c->kind == IRIS_DEPTH_DISPARITY && (product < 1 || product >= 8388608)) {
        complain(w->camera_path, "the focal length times the baseline, %.6g, is to be from 1 to 8388607",
                 product);
        return 0;
    }
    return 1;
}

/* The distance of the cameras: what was said, else the pair's. */
static int take_baseline(wishes *w, const texts *t, iris_q32 pair_mm)
{
    if (t->baseline || t->depth) {
        return EXIT_DONE;
    }
    if (pair_mm == 0) {
        complain(NULL,
                 "one of --baseline MM and --depth is needed, or a rectified pair as CAMERA (see --help)");
        return EXIT_BAD_CALL;
    }
    if (pair_mm < IRIS_Q32_ONE || pair_mm > 1000 * IRIS_Q32_ONE) {
        complain(w->camera_path,
                 "its cameras are %.6g apart, but 1 to 1000 millimeters are expected: was the "
                 "board measured in another unit? Say --baseline MM",
                 (double)pair_mm / 4294967296.0);
        return EXIT_BAD_DATA;
    }
    w->camera.baseline_q16 = (iris_q16)(pair_mm >> 16);
    return EXIT_DONE;
}

static int read_camera(wishes *w, const texts *t)
{
    iris_camera_model model;
    iris_q32 pair_mm;
    if (!flat_camera_read(&model, &pair_mm, w->camera_path)) {
        return EXIT_BAD_DATA;
    }
    const int exit_code = take_baseline(w, t, pair_mm);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    const iris_intrinsics *k = &model.intrinsics;
    iris_depth_camera *c = &w->camera;
    const iris_depth_camera wanted = *c;
    c->kind = t->depth ? IRIS_DEPTH_MM : IRIS_DEPTH_DISPARITY;
    if (!check_camera(c, k, w)) {
        return EXIT_BAD_DATA;
    }
    iris_depth_camera_defaults(c, model.size, (iris_q16)(k->alpha_u >> 16), wanted.baseline_q16);
    c->kind = t->depth ? IRIS_DEPTH_MM : IRIS_DEPTH_DISPARITY;
    c->u0_q16 = iris_sat_s32(k->u0 >> 16);
    c->v0_q16 = iris_sat_s32(k->v0 >> 16);
    c->height_mm = wanted.height_mm;
    c->tilt = wanted.tilt;
    c->mount = wanted.mount;
    c->low_mm = wanted.low_mm;
    c->high_mm = wanted.high_mm;
    c->far_mm = wanted.far_mm;
    w->size = model.size;
    if (t->depth) {
        c->spread_q16 = 10 * IRIS_Q16_ONE;
    }
    return EXIT_DONE;
}

static int read_numbers(wishes *w, const texts *t)
{
    iris_depth_camera *c = &w->camera;
    int32_t tilt_q16 = 0, band[2] = {50, 1000};
    c->height_mm = 200;
    c->far_mm = 5000;
    w->cell_mm = 50;
    const args_whole wholes[] = {{"--height", t->height, &c->height_mm, 0, 20000},
                                 {"--ahead", t->ahead, &c->mount.x_mm, -20000, 20000},
                                 {"--far", t->far, &c->far_mm, 200, 65535},
                                 {"--cell", t->cell, &w->cell_mm, 1, IRIS_GRID_CELL_MAX_MM}};
    if (!args_wholes(wholes, sizeof wholes / sizeof wholes[0])) {
        return 0;
    }
    if (t->baseline && !args_q16(&c->baseline_q16, 65536, 1000 * 65536, t->baseline)) {
        complain("--baseline", "1 to 1000 millimeters, not '%s'", t->baseline);
        return 0;
    }
    if (t->tilt && !args_q16(&tilt_q16, -80 * 65536, 80 * 65536, t->tilt)) {
        complain("--tilt", "-80 to 80 degrees, not '%s'", t->tilt);
        return 0;
    }
    if (t->band &&
        (!args_numbers(band, 2, ',', t->band) || band[0] < 0 || band[1] <= band[0] || band[1] > 20000)) {
        complain("--band", "LOW,HIGH in millimeters, 0 to 20000, not '%s'", t->band);
        return 0;
    }
    c->tilt = (iris_angle)lround(tilt_q16 / 360.0);
    c->low_mm = band[0];
    c->high_mm = band[1];
    return 1;
}

static int check_call(const wishes *w, const texts *t, int operands)
{
    const char *wrong =
        operands < 1                      ? "expected are pictures of disparities or depths (see --help)"
        : !w->camera_path                 ? "--camera CAMERA is needed (see --help)"
        : !w->poses_path                  ? "--poses POSES is needed (see --help)"
        : t->baseline && t->depth         ? "only one of --baseline MM and --depth is needed (see --help)"
        : w->map && (w->output || w->ply) ? "--localize makes no map: no -o and no --ply with it"
                                          : NULL;
    if (wrong) {
        complain(NULL, "%s", wrong);
        return 0;
    }
    const size_t length = w->output ? strlen(w->output) : 0;
    if (w->output && (length < 6 || strcmp(w->output + length - 5, ".yaml") != 0)) {
        complain(w->output, "a map's name ends with .yaml; its picture will lie beside it");
        return 0;
    }
    if (w->ply && strcmp(w->ply, "-") == 0) {
        complain("--ply", "expected is the name of a file");
        return 0;
    }
    return 1;
}

static int run(wishes *w)
{
    session s = {.left_out = 0};
    const int good = read_poses(w) && (w->map ? find_poses(w, &s) : make_map(w, &s));
    free(s.beams);
    free(s.memory);
    free(s.grid.odds);
    free(s.space.odds);
    free(s.field_bytes);
    free(w->poses);
    picture_free(&s.depth);
    return good ? EXIT_DONE : EXIT_BAD_DATA;
}

int cmd_map(int argc, char **argv)
{
    wishes w = {.cell_mm = 50};
    texts t = {.depth = 0};
    const args_option options[] = {{"camera", 0, NULL, &w.camera_path},
                                   {"poses", 0, NULL, &w.poses_path},
                                   {"baseline", 0, NULL, &t.baseline},
                                   {"depth", 0, &t.depth, NULL},
                                   {"height", 0, NULL, &t.height},
                                   {"tilt", 0, NULL, &t.tilt},
                                   {"ahead", 0, NULL, &t.ahead},
                                   {"band", 0, NULL, &t.band},
                                   {"far", 0, NULL, &t.far},
                                   {"cell", 0, NULL, &t.cell},
                                   {"output", 'o', NULL, &w.output},
                                   {"ply", 0, NULL, &w.ply},
                                   {"localize", 0, NULL, &w.map},
                                   {"json", 0, &w.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (!check_call(&w, &t, args.operand_count) || !read_numbers(&w, &t)) {
        return EXIT_BAD_CALL;
    }
    exit_code = read_camera(&w, &t);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    exit_code = inputs_expand(&w.inputs, args.operand_count, args.operands);
    exit_code = exit_code == EXIT_DONE ? run(&w) : exit_code;
    inputs_free(&w.inputs);
    return exit_code;
}
