#include "camera_file.h"

#include <string.h>

#include "complain.h"
#include "file_write.h"
#include "floor_file.h"

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

int camera_file_read(iris_camera_model *camera, const char *path)
{
    static char text[TEXT_FILE_BYTES];
    size_t length = 0;
    int32_t line = 0;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return 0;
    }
    iris_status status = iris_camera_read_text(camera, &line, text, length);
    if (status != IRIS_OK) {
        complain_text(path, status, line, "camera");
    }
    return status == IRIS_OK;
}

int pair_file_read(iris_pair *pair, const char *path)
{
    static char text[TEXT_FILE_BYTES];
    size_t length = 0;
    int32_t line = 0;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return 0;
    }
    iris_status status = iris_pair_read_text(pair, &line, text, length);
    if (status != IRIS_OK) {
        complain_text(path, status, line, "pair");
    }
    return status == IRIS_OK;
}

static int write_text(FILE *file, const void *user)
{
    return fputs(user, file) >= 0 && fflush(file) == 0;
}

int pair_file_write(const char *path, const iris_pair *pair)
{
    char text[IRIS_PAIR_TEXT_BYTES];
    size_t length = 0;
    if (iris_pair_write_text(text, sizeof text, &length, pair) != IRIS_OK) {
        complain(path, "numbers that are too large");
        return 0;
    }
    return file_write(path, write_text, text);
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
