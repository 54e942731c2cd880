#include <string.h>

#include "camera_file.h"
#include "commands.h"
#include "floor_file.h"
#include "iris/xt/birdseye.h"
#include "mounting_option.h"
#include "operation.h"

static const char help[] =
    "usage: iris birdseye (--floor FLOOR | --calib CAMERA --height MM --tilt DEG [--pan DEG] [--roll DEG]\n"
    "                     [--ahead MM] [--right MM]) --window x0,y0,x1,y1 [--scale MM] [--fill N]\n"
    "                     [--border RULE] [--json] IN... -o OUT\n\n"
    "The floor seen from straight above: a window on it becomes a picture with so many millimeters\n"
    "to a pixel. Far is up, right is right. What rises above the floor leans away.\n\n"
    "  --floor FLOOR     what iris floor has made for pictures of this size; lenses are not looked "
    "at\n" MOUNTING_OPTION_HELP "  --window x0,y0,x1,y1\n"
    "                    in millimeters on the floor: left, near, right, far; x to the right of,\n"
    "                    y ahead of where the floor file's marks are measured from\n"
    "  --scale MM        millimeters per pixel, 0.01 to 1000 (the default: 1)\n"
    "  --fill N          the level of what the camera does not see, 0 to 255 (the default: 0)\n"
    "  --border RULE     taken by every operation; changes nothing here\n"
    "  --json            one JSON object per picture\n"
    "  -o OUT            .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n\n"
    "example: iris birdseye --floor robot.floor --window -300,100,300,900 --scale 2 photo.bmp -o map.bmp\n"
    "         iris birdseye --calib left.camera --height 240 --tilt 35 --window -300,100,300,900 photo.bmp "
    "-o map.bmp\n";

#define STEP_BITS 2 /* of the map through a lens */

typedef struct {
    int has_camera; /* else the floor */
    iris_floor floor;
    iris_camera_model camera;
    iris_mounting mounting;
    iris_birdseye_window window;
} birdseye_settings;

/* By the floor's numbers. */
static iris_status draw_floor(const iris_image *map, const iris_image *from, const birdseye_settings *with)
{
    iris_birdseye birdseye;
    iris_status status = iris_birdseye_init(&birdseye, &with->floor, &with->window);
    return status == IRIS_OK ? iris_birdseye_draw(map, from, &birdseye) : status;
}

/* Through the camera's lens. `places` is for the map. */
static iris_status draw_camera(const iris_image *map, const iris_image *from, const birdseye_settings *with,
                               iris_place *places)
{
    const iris_sensor camera = {.intrinsics = with->camera.intrinsics, .lens = with->camera.lens};
    iris_remap_view view;
    iris_remap remap;
    iris_status status = iris_mounting_view(&view, &with->mounting, &with->window);
    view.step_bits = STEP_BITS;
    status = status == IRIS_OK ? iris_remap_init(&remap, places, &view, &camera, with->camera.size) : status;
    return status == IRIS_OK ? iris_remap_draw(map, from, &remap) : status;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const birdseye_settings *with = stage->settings;
    const iris_size size = {input->w, input->h}, made = with->window.size;
    iris_place *places = NULL;
    if (with->has_camera ? !camera_fits(&with->camera, stage->file, size)
                         : !floor_fits(&with->floor, stage->file, size)) {
        return EXIT_BAD_DATA;
    }
    if (with->has_camera) {
        places = stage_room(stage, IRIS_REMAP_PLACES(made.w, made.h, STEP_BITS) * sizeof *places);
        if (!places) {
            return EXIT_BAD_DATA;
        }
    }
    const iris_image *from = stage_levels(stage, input);
    const iris_image *map = from ? stage_picture(stage, with->window.size, from->format) : NULL;
    if (!map) {
        return EXIT_BAD_DATA;
    }
    iris_status status =
        with->has_camera ? draw_camera(map, from, with, places) : draw_floor(map, from, with);
    *result = *map;
    return stage_exit(stage, status);
}

static void report(json_writer *json, const operation_stage *stage)
{
    const birdseye_settings *with = stage->settings;
    json_key(json, "mm_per_pixel");
    json_number(json, with->window.mm_per_pixel_q16 / 65536.0, 4);
    json_key(json, "corner_x_mm"); /* of the center of the top left pixel */
    json_number(json, with->window.corner.x_q16 / 65536.0, 3);
    json_key(json, "corner_y_mm");
    json_number(json, with->window.corner.y_q16 / 65536.0, 3);
}

/* The window's size in pixels, and its corner; 0 after complaining. */
static int read_window(iris_birdseye_window *window, const char *text)
{
    int32_t n[4];
    int good = args_numbers(n, 4, ',', text);
    for (int i = 0; i < 4 && good; i++) {
        good = n[i] >= -32000 && n[i] <= 32000;
    }
    if (!good || n[0] >= n[2] || n[1] >= n[3]) {
        complain("--window",
                 "left,near,right,far in millimeters, left below right and near below far, not '%s'", text);
        return 0;
    }
    int64_t scale = window->mm_per_pixel_q16;
    int64_t w = ((int64_t)(n[2] - n[0]) * 65536 + scale / 2) / scale;
    int64_t h = ((int64_t)(n[3] - n[1]) * 65536 + scale / 2) / scale;
    if (w < 1 || h < 1 || w > IRIS_SIDE_MAX || h > IRIS_SIDE_MAX) {
        complain("--window", "%lldx%lld pixels at this --scale: 1 to %d can be", (long long)w, (long long)h,
                 IRIS_SIDE_MAX);
        return 0;
    }
    window->size = (iris_size){(int32_t)w, (int32_t)h};
    window->corner.x_q16 = (iris_q16)(n[0] * 65536 + scale / 2);
    window->corner.y_q16 = (iris_q16)(n[3] * 65536 - scale / 2);
    return 1;
}

static int parse(void *settings, operation_words *words)
{
    birdseye_settings *with = settings;
    const char *floor = NULL, *window = NULL, *scale = "1", *fill = "0";
    mounting_texts mounting = {NULL};
    const args_option options[] = {MOUNTING_OPTIONS(mounting),
                                   {"floor", 0, NULL, &floor},
                                   {"window", 0, NULL, &window},
                                   {"scale", 0, NULL, &scale},
                                   {"fill", 0, NULL, &fill}};
    int32_t level;
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    with->has_camera = mounting_is_given(&mounting);
    if (floor && with->has_camera) {
        complain("--floor", "not together with --calib and the mounting");
        return 0;
    }
    if (with->has_camera && !mounting_option_read(&with->mounting, &mounting)) {
        return 0;
    }
    if ((!floor && !with->has_camera) || !window) {
        complain(NULL, "%s is needed (see --help)",
                 window ? "--floor FLOOR, or --calib, --height, and --tilt," : "--window x0,y0,x1,y1");
        return 0;
    }
    if (!args_q16(&with->window.mm_per_pixel_q16, IRIS_BIRDSEYE_SCALE_MIN, IRIS_BIRDSEYE_SCALE_MAX, scale)) {
        complain("--scale", "0.01 to 1000 millimeters per pixel, not '%s'", scale);
        return 0;
    }
    if (!args_numbers(&level, 1, ',', fill) || level < 0 || level > 255) {
        complain("--fill", "0 to 255, not '%s'", fill);
        return 0;
    }
    with->window.fill = (uint8_t)level;
    if (!read_window(&with->window, window)) {
        return 0;
    }
    if (with->has_camera ? !camera_file_read(&with->camera, mounting.calib)
                         : !floor_file_read(&with->floor, floor)) {
        words->exit_code = EXIT_BAD_DATA;
        return 0;
    }
    return 1;
}

const operation operation_birdseye = {.name = "birdseye",
                                      .summary = "the floor seen from straight above, to scale",
                                      .help = help,
                                      .parse = parse,
                                      .apply = apply,
                                      .report = report,
                                      .reshapes = 1,
                                      .has_border = 1};
