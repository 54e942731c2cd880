#include "camera_file.h"

#include <string.h>

#include "complain.h"
#include "file_write.h"
#include "floor_file.h"

enum { FILE_OF_CAMERA = 1, FILE_OF_PAIR };

static void complain_text(const char *path, iris_status status, int32_t line, const char *kind)
{
    if (status == IRIS_ERR_TRUNCATED) {
        complain(path, "line %d: ends early", (int)line);
    } else if (status == IRIS_ERR_UNSUPPORTED) {
        complain(path, "line %d: a later version of %s file than this iris knows", (int)line, kind);
    } else {
        complain(path, "line %d: not a %s file, or damaged: make it again by iris calibrate%s", (int)line,
                 kind, strcmp(kind, "pair") == 0 ? " pair" : "");
    }
}

/* A pair where `pair` is not null and the text begins as one, or where `camera` is null; else a camera. 0: nothing. */
static int read_either(iris_camera_model *camera, iris_pair *pair, const char *path)
{
    static const char pairs[] = "iris pair";
    static char text[TEXT_FILE_BYTES];
    size_t length = 0;
    int32_t line = 0;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return 0;
    }
    const int is_pair =
        !camera || (pair && length >= sizeof pairs && memcmp(text, pairs, sizeof pairs - 1) == 0);
    iris_status status = is_pair ? iris_pair_read_text(pair, &line, text, length)
                                 : iris_camera_read_text(camera, &line, text, length);
    if (status != IRIS_OK) {
        complain_text(path, status, line, is_pair ? "pair" : "camera");
        return 0;
    }
    return is_pair ? FILE_OF_PAIR : FILE_OF_CAMERA;
}

int camera_file_read(iris_camera_model *camera, const char *path)
{
    return read_either(camera, NULL, path) != 0;
}

int pair_file_read(iris_pair *pair, const char *path)
{
    return read_either(NULL, pair, path) != 0;
}

static int has_lens(const iris_lens *lens)
{
    return (lens->k1 | lens->k2 | lens->k3 | lens->p1 | lens->p2) != 0;
}

/* Side by side, and not turned; alike. */
static int is_rectified(const iris_pair *pair)
{
    const iris_intrinsics *a = &pair->cameras[0].intrinsics, *b = &pair->cameras[1].intrinsics;
    return !has_lens(&pair->cameras[0].lens) && !has_lens(&pair->cameras[1].lens) &&
           (pair->turn.x | pair->turn.y | pair->turn.z | pair->place.y | pair->place.z) == 0 &&
           pair->place.x > 0 && a->alpha_u == b->alpha_u && a->alpha_v == b->alpha_v && a->u0 == b->u0 &&
           a->v0 == b->v0;
}

int flat_camera_read(iris_camera_model *camera, iris_q32 *baseline, const char *path)
{
    iris_pair pair;
    *baseline = 0;
    const int kind = read_either(camera, &pair, path);
    if (kind == FILE_OF_PAIR) {
        if (!is_rectified(&pair)) {
            complain(path, "this pair is not rectified: take the rectified.pair that iris rectify -o makes");
            return 0;
        }
        *camera = pair.cameras[0];
        *baseline = pair.place.x;
    } else if (kind == FILE_OF_CAMERA && has_lens(&camera->lens)) {
        complain(path, "this camera has a lens, and its pictures bend: use those of iris rectify with its "
                       "rectified.pair, or undistort them and take a camera without lens");
        return 0;
    }
    return kind != 0;
}

int pair_file_write(const char *path, const iris_pair *pair)
{
    char text[IRIS_PAIR_TEXT_BYTES];
    size_t length = 0;
    if (iris_pair_write_text(text, sizeof text, &length, pair) != IRIS_OK) {
        complain(path, "numbers that are too large");
        return 0;
    }
    return file_write(path, file_write_text, text);
}

int camera_fits(const iris_camera_model *camera, const char *file, iris_size size)
{
    if (size.w == camera->size.w && size.h == camera->size.h) {
        return 1;
    }
    complain(file, "%dx%d pixels, but the camera was calibrated with pictures of %dx%d", (int)size.w,
             (int)size.h, (int)camera->size.w, (int)camera->size.h);
    return 0;
}
