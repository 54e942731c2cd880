#include "floor_mounting.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera_file.h"
#include "complain.h"
#include "file_write.h"
#include "json.h"
#include "one_line.h"

#define BENT_PX 1.0 /* a lens that bends by less is none to warn of */

typedef struct {
    iris_floor floor;
    iris_camera_model camera;
    const mounting_texts *texts;
    double bent_px;           /* by the lens, at most, on the picture's edge */
    int has_near, has_middle; /* below the horizon */
    iris_place near,
        middle; /* on the floor: what is seen at the middle of the lower edge, and in the middle */
} mounted;

static double real(iris_q32 number)
{
    return (double)number / 4294967296.0;
}

/* How far a lens moves what would be seen at the pixel. */
static double bent(const iris_camera_model *camera, double x, double y)
{
    const iris_vec2 pixel = {(iris_q32)(x * 4294967296.0), (iris_q32)(y * 4294967296.0)};
    iris_vec2 p;
    if (iris_intrinsics_plane(&p, &camera->intrinsics, pixel) != IRIS_OK) {
        return 0;
    }
    iris_vec2 seen = iris_intrinsics_pixel(&camera->intrinsics, iris_lens_bend(&camera->lens, p));
    return hypot(real(seen.x) - x, real(seen.y) - y);
}

static void measure(mounted *of)
{
    const iris_size size = of->camera.size;
    for (int i = 0; i < 9; i++) {
        of->bent_px =
            fmax(of->bent_px, bent(&of->camera, i % 3 * (size.w - 1) / 2.0, i / 3 * (size.h - 1) / 2.0));
    }
    of->has_near = iris_floor_point(&of->near, &of->floor, iris_place_of(size.w / 2, size.h - 1)) == IRIS_OK;
    of->has_middle =
        iris_floor_point(&of->middle, &of->floor, iris_place_of(size.w / 2, size.h / 2)) == IRIS_OK;
}

static int write_floor(FILE *file, const void *user)
{
    const mounted *of = user;
    const mounting_texts *t = of->texts;
    char text[IRIS_FLOOR_TEXT_BYTES];
    size_t length = 0;
    (void)iris_floor_write_text(text, sizeof text, &length, &of->floor);
    fputs(text, file);
    fputs("\n# ", file);
    one_line(file, t->calib);
    fprintf(file, ", %s mm above the floor, tilt %s, pan %s, roll %s, at %s %s mm\n", t->height, t->tilt,
            t->pan ? t->pan : "0", t->roll ? t->roll : "0", t->right ? t->right : "0",
            t->ahead ? t->ahead : "0");
    return !ferror(file) && fflush(file) == 0;
}

static void json_place(json_writer *json, const char *key, int exists, iris_place at)
{
    json_key(json, key);
    if (!exists) {
        json_null(json);
        return;
    }
    json_open(json, '[');
    json_number(json, at.x_q16 / 65536.0, 1);
    json_number(json, at.y_q16 / 65536.0, 1);
    json_close(json, ']');
}

static void print_json(const mounted *of, const char *output)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "file");
    json_string(&json, of->texts->calib);
    json_key(&json, "output");
    json_string(&json, output);
    json_key(&json, "width");
    json_integer(&json, of->floor.size.w);
    json_key(&json, "height");
    json_integer(&json, of->floor.size.h);
    json_place(&json, "near_mm", of->has_near, of->near);
    json_place(&json, "middle_mm", of->has_middle, of->middle);
    json_key(&json, "lens_px");
    json_number(&json, of->bent_px, 2);
    json_close(&json, '}');
}

static void print_place(const char *what, int exists, iris_place at)
{
    printf("%s: ", what);
    if (exists) {
        printf("%+.0f mm to the right, %.0f mm ahead\n", at.x_q16 / 65536.0, at.y_q16 / 65536.0);
    } else {
        printf("above the horizon, or farther than 32 m\n");
    }
}

int floor_from_mounting(const mounting_texts *texts, const char *output, int json)
{
    mounted of = {.texts = texts};
    iris_mounting mounting;
    if (!mounting_option_read(&mounting, texts)) {
        return EXIT_BAD_CALL;
    }
    if (!camera_file_read(&of.camera, texts->calib)) {
        return EXIT_BAD_DATA;
    }
    if (iris_mounting_floor(&of.floor, &mounting, &of.camera) != IRIS_OK) {
        complain(texts->calib, "no floor is seen so: its focal lengths are out of range");
        return EXIT_BAD_DATA;
    }
    measure(&of);
    if (of.bent_px > BENT_PX) {
        complain(texts->calib,
                 "warning: the lens bends by up to %.1f pixels: this floor is that of pictures after iris "
                 "undistort "
                 "--calib",
                 of.bent_px);
    }
    if (output && !file_write(output, write_floor, &of)) {
        return EXIT_BAD_DATA;
    }
    if (json) {
        print_json(&of, output);
    } else if (!output || strcmp(output, "-") != 0) {
        print_place("the middle of the lower edge sees", of.has_near, of.near);
        print_place("the picture's middle sees", of.has_middle, of.middle);
    }
    return EXIT_DONE;
}
