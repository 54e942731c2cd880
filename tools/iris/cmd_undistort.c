#include <stdlib.h>
#include <string.h>

#include "camera_file.h"
#include "commands.h"
#include "iris/3d/remap.h"
#include "operation.h"

static const char help[] =
    "usage: iris undistort (--calib CAMERA | --camera FX,FY,U0,V0[,SKEW] --lens K1[,K2[,P1,P2[,K3]]])\n"
    "                      [--fill N] [--border RULE] [--json] IN... -o OUT\n\n"
    "The picture without what the lens bends: straight lines become straight.\n\n"
    "  --calib CAMERA    a camera file, of iris calibrate, and pictures of the size it was made for\n"
    "  --camera FX,FY,U0,V0[,SKEW]\n"
    "                    focal length in pixels, across and down, and the principal point\n"
    "  --lens K1[,K2[,P1,P2[,K3]]]\n"
    "                    radial (k) and tangential (p) distortion, in the order and the meaning\n"
    "                    of OpenCV and of Zhang: what is seen of a straight ray at r focal lengths\n"
    "                    from the axis is at r (1 + k1 r^2 + k2 r^4 + k3 r^6)\n"
    "  --fill N          the level of what the camera does not see, 0 to 255 (the default: 0)\n"
    "  --border RULE     taken by every operation; changes nothing here\n"
    "  --json            one JSON object per picture\n"
    "  -o OUT            .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n\n"
    "example: iris undistort --calib left.camera left01.pgm -o flat.bmp\n"
    "         iris undistort --camera 532.8,532.9,342.5,233.9 --lens -0.28,0.03 left01.pgm -o flat.bmp\n";

#define LIMIT      100000.0             /* of all numbers */
#define FINE_BELOW (256 * IRIS_Q32_ONE) /* focal length: small pictures bend within few pixels */

typedef struct {
    iris_camera_model model;
    int has_size; /* the model's, of a file */
    uint8_t fill;
} undistort_settings;

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const undistort_settings *with = stage->settings;
    const iris_size size = {input->w, input->h};
    const iris_sensor camera = {.intrinsics = with->model.intrinsics, .lens = with->model.lens};
    if (with->has_size && !camera_fits(&with->model, stage->file, size)) {
        return EXIT_BAD_DATA;
    }
    const iris_image *from = stage_levels(stage, input);
    const iris_image *flat = from ? stage_picture(stage, size, from->format) : NULL;
    iris_remap_view view;
    iris_remap map;
    const iris_intrinsics *k = &camera.intrinsics;
    const iris_q32 least_focal = k->alpha_u < k->alpha_v ? k->alpha_u : k->alpha_v;
    iris_remap_view_defaults(&view, k, size);
    view.step_bits = least_focal < FINE_BELOW ? 0 : 2;
    view.fill = with->fill;
    iris_place *places =
        flat ? stage_room(stage, IRIS_REMAP_PLACES(size.w, size.h, view.step_bits) * sizeof *places) : NULL;
    if (!places) {
        return EXIT_BAD_DATA;
    }
    iris_status status = iris_remap_init(&map, places, &view, &camera, size);
    status = status == IRIS_OK ? iris_remap_draw(flat, from, &map) : status;
    *result = *flat;
    return stage_exit(stage, status);
}

/* Numbers with commas between them, at most `most`; how many, or 0. */
static int read_numbers(iris_q32 *numbers, int most, const char *text)
{
    for (int count = 0; count < most; text++) {
        char *end;
        double number = strtod(text, &end);
        if (end == text || !(number >= -LIMIT && number <= LIMIT) || (*end != ',' && *end != '\0')) {
            return 0;
        }
        numbers[count++] = (iris_q32)(number * 4294967296.0 + (number < 0 ? -0.5 : 0.5));
        text = end;
        if (*end == '\0') {
            return count;
        }
    }
    return 0;
}

static int read_camera(iris_intrinsics *k, const char *text)
{
    iris_q32 n[5] = {0};
    int count = read_numbers(n, 5, text);
    if (count < 4 || n[0] < IRIS_Q32_ONE || n[1] < IRIS_Q32_ONE) {
        complain("--camera", "fx,fy,u0,v0 or fx,fy,u0,v0,skew in pixels, with focal lengths from 1, not '%s'",
                 text);
        return 0;
    }
    *k = (iris_intrinsics){n[0], n[1], n[4], n[2], n[3]};
    return 1;
}

static int read_lens(iris_lens *lens, const char *text)
{
    iris_q32 n[5] = {0};
    int count = read_numbers(n, 5, text);
    if (count == 0 || count == 3) {
        complain("--lens", "k1 or k1,k2 or k1,k2,p1,p2 or k1,k2,p1,p2,k3, not '%s'", text);
        return 0;
    }
    *lens = (iris_lens){.k1 = n[0], .k2 = n[1], .p1 = n[2], .p2 = n[3], .k3 = n[4]};
    return 1;
}

static int parse(void *settings, operation_words *words)
{
    undistort_settings *with = settings;
    const char *calib = NULL, *camera = NULL, *lens = NULL, *fill = "0";
    const args_option options[] = {{"calib", 0, NULL, &calib},
                                   {"camera", 0, NULL, &camera},
                                   {"lens", 0, NULL, &lens},
                                   {"fill", 0, NULL, &fill}};
    int32_t level;
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    if (calib && (camera || lens)) {
        complain("--calib", "not together with --camera or --lens: the file has both");
        return 0;
    }
    if (!calib && (!camera || !lens)) {
        complain(NULL, "%s is needed (see --help)",
                 camera ? "--lens K1,..."
                 : lens ? "--camera FX,FY,U0,V0"
                        : "--calib CAMERA, or --camera and --lens,");
        return 0;
    }
    if (!args_numbers(&level, 1, ',', fill) || level < 0 || level > 255) {
        complain("--fill", "0 to 255, not '%s'", fill);
        return 0;
    }
    with->fill = (uint8_t)level;
    with->has_size = calib != NULL;
    if (calib && !camera_file_read(&with->model, calib)) {
        words->exit_code = EXIT_BAD_DATA;
        return 0;
    }
    return calib || (read_camera(&with->model.intrinsics, camera) && read_lens(&with->model.lens, lens));
}

const operation operation_undistort = {.name = "undistort",
                                       .summary = "without what the lens bends",
                                       .help = help,
                                       .parse = parse,
                                       .apply = apply,
                                       .reshapes = 1,
                                       .has_border = 1};
