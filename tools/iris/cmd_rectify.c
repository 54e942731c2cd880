#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "calibrate_json.h"
#include "camera_file.h"
#include "commands.h"
#include "complain.h"
#include "file_name.h"
#include "frame_reader.h"
#include "iris/copy.h"
#include "iris/draw.h"
#include "picture_write.h"
#include "rectified_pair.h"
#include "system.h"

static const char help[] =
    "usage: iris rectify LEFT RIGHT --calib PAIR [-o FOLDER] [--lines PICTURE] [--keep valid|all]\n"
    "                    [--json]\n\n"
    "Pictures of two cameras as if these were side by side and looked the same way, without lenses: what\n"
    "is in one row of the left one is in the same row of the right one, to the left by its disparity d,\n"
    "and its distance is z = b f / d, with b the distance of the cameras and f the focal length.\n\n"
    "  --calib PAIR       the two cameras: a file of iris calibrate pair\n"
    "  -o FOLDER          where left and right go, as the pictures are named (left.pgm and right.pgm of\n"
    "                     PGM), and rectified.pair, the pair file of the two\n"
    "  --lines PICTURE    both side by side with lines across, to look at\n"
    "  --keep valid|all   valid (the default): as much as both see wholly; all: everything that either\n"
    "                     sees, and black where it sees nothing\n"
    "  --json             one JSON object\n\n"
    "JSON has width, height, focal (pixels), u0, v0 (of both), baseline (in the unit of the board that the\n"
    "pair was calibrated with), and by how many degrees each camera was turned.\n\n"
    "example: iris rectify left.pgm right.pgm --calib rig.pair -o flat --lines seen.bmp\n";

#define LINES 16 /* across */

typedef struct {
    const char *inputs[2], *calib, *folder, *lines;
    iris_rectify_keep keep;
    int json;
} wishes;

static int read_pictures(picture_buffer pictures[2], const char *const names[2])
{
    static frame_reader reader;
    for (int k = 0; k < 2; k++) {
        iris_status status = frame_reader_open(&reader, names[k]);
        status = status == IRIS_OK ? frame_reader_next(&reader, &pictures[k], 0) : status;
        frame_reader_close(&reader);
        if (status != IRIS_OK) {
            complain(names[k], "%s", frame_reader_problem(&reader));
            return 0;
        }
    }
    return 1;
}

/* What to write the picture of that name as. */
static const char *extension_of(const char *name, const iris_image *image)
{
    picture_container container = picture_container_of(name);
    return picture_extension(container == CONTAINER_UNKNOWN ? CONTAINER_BMP : container, image->format);
}

static int write_folder(const wishes *w, const iris_rectified *made, const picture_buffer views[2])
{
    static const char *const sides[2] = {"left", "right"};
    const iris_intrinsics *k = &made->views[0].intrinsics;
    const iris_camera_model camera = {made->views[0].size, *k, {0}};
    const iris_pair flat = {{camera, camera}, {0, 0, 0}, {made->baseline, 0, 0}};
    char path[4096];
    (void)system_make_folder(w->folder);
    if (strlen(w->folder) >= sizeof path - 32) {
        complain("-o", "the name of the folder is too long");
        return 0;
    }
    int done = 1;
    for (int i = 0; i < 2 && done; i++) {
        snprintf(path, sizeof path, "%s/%s%s", w->folder, sides[i],
                 extension_of(w->inputs[i], &views[i].image));
        done = picture_write(path, &views[i].image);
    }
    snprintf(path, sizeof path, "%s/rectified.pair", w->folder);
    return done && pair_file_write(path, &flat);
}

/* Both beside each other, with lines across. */
static int write_lines(const char *path, const picture_buffer views[2])
{
    picture_buffer both = {0};
    const int32_t w = views[0].image.w, h = views[0].image.h;
    const iris_size size = {2 * w, h};
    iris_status status = picture_reserve(&both, size, IRIS_RGB888);
    for (int k = 0; k < 2 && status == IRIS_OK; k++) {
        iris_image half;
        status = iris_image_crop(&half, &both.image, (iris_rect){k * w, 0, w, h});
        status = status == IRIS_OK ? iris_color_convert(&half, &views[k].image) : status;
    }
    for (int i = 0; i < LINES && status == IRIS_OK; i++) {
        const int32_t y = (2 * i + 1) * h / (2 * LINES);
        const iris_color color = i % 2 ? (iris_color){255, 200, 0} : (iris_color){0, 220, 120};
        status = iris_draw_line(&both.image, 0, y, 2 * w - 1, y, color);
    }
    int done = status == IRIS_OK && picture_write(path, &both.image);
    if (status != IRIS_OK) {
        complain(path, "%s", picture_problem(status, size));
    }
    picture_free(&both);
    return done;
}

static double degrees(const iris_mat3 *turn)
{
    return calibrate_real(iris_vec3_length(iris_rotation_to_vector(turn))) * 57.295779513;
}

static void print(const wishes *w, const iris_rectified *made)
{
    const iris_remap_view *view = &made->views[0];
    const double turned[2] = {degrees(&view->turn), degrees(&made->views[1].turn)};
    if (!w->json) {
        printf("%dx%d pixels, focal length %.3f, center %.3f %.3f, baseline %.6g: z = %.6g / d\n"
               "the left camera was turned by %.2f degrees, the right one by %.2f\n",
               (int)view->size.w, (int)view->size.h, calibrate_real(made->focal),
               calibrate_real(view->intrinsics.u0), calibrate_real(view->intrinsics.v0),
               calibrate_real(made->baseline), calibrate_real(made->baseline) * calibrate_real(made->focal),
               turned[0], turned[1]);
        return;
    }
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "left");
    json_string(&json, w->inputs[0]);
    json_key(&json, "right");
    json_string(&json, w->inputs[1]);
    json_key(&json, "width");
    json_integer(&json, view->size.w);
    json_key(&json, "height");
    json_integer(&json, view->size.h);
    calibrate_number(&json, "focal", made->focal);
    calibrate_number(&json, "u0", view->intrinsics.u0);
    calibrate_number(&json, "v0", view->intrinsics.v0);
    calibrate_number(&json, "baseline", made->baseline);
    json_key(&json, "turned");
    json_open(&json, '[');
    json_number(&json, turned[0], 4);
    json_number(&json, turned[1], 4);
    json_close(&json, ']');
    json_close(&json, '}');
}

static int run(const wishes *w)
{
    picture_buffer pictures[2];
    iris_rectified made;
    memset(pictures, 0, sizeof pictures);
    int exit_code = EXIT_BAD_DATA;
    if (read_pictures(pictures, w->inputs)) {
        exit_code = rectified_pair_make(&made, pictures, w->inputs, w->calib, w->keep);
    }
    if (exit_code == EXIT_DONE && ((w->folder && !write_folder(w, &made, pictures)) ||
                                   (w->lines && !write_lines(w->lines, pictures)))) {
        exit_code = EXIT_BAD_DATA;
    }
    if (exit_code == EXIT_DONE && !(w->lines && strcmp(w->lines, "-") == 0)) {
        print(w, &made);
    }
    picture_free(&pictures[0]);
    picture_free(&pictures[1]);
    return exit_code;
}

int cmd_rectify(int argc, char **argv)
{
    wishes w = {.keep = IRIS_RECTIFY_VALID};
    const char *keep = "valid";
    const args_option options[] = {{"calib", 0, NULL, &w.calib},
                                   {"output", 'o', NULL, &w.folder},
                                   {"lines", 0, NULL, &w.lines},
                                   {"keep", 0, NULL, &keep},
                                   {"json", 0, &w.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (args.operand_count != 2 || !w.calib) {
        complain(NULL, "two pictures and a pair file are expected: LEFT RIGHT --calib PAIR (see --help)");
        return EXIT_BAD_CALL;
    }
    w.inputs[0] = args.operands[0];
    w.inputs[1] = args.operands[1];
    if (!rectified_keep_read(&w.keep, keep)) {
        return EXIT_BAD_CALL;
    }
    const char *dot = w.folder ? strrchr(file_name(w.folder), '.') : NULL;
    if (w.folder &&
        (strcmp(w.folder, "-") == 0 || (dot && picture_container_of(w.folder) != CONTAINER_UNKNOWN))) {
        complain(w.folder, "two pictures are written: -o takes the name of a folder");
        return EXIT_BAD_CALL;
    }
    if (w.lines &&
        (picture_container_of(w.lines) == CONTAINER_UNKNOWN || (w.json && strcmp(w.lines, "-") == 0))) {
        complain(w.lines, w.json ? "one of --json and --lines - only, and pictures are .bmp, .ppm, or .pgm"
                                 : "expected is .bmp, .ppm, or .pgm");
        return EXIT_BAD_CALL;
    }
    return run(&w);
}
