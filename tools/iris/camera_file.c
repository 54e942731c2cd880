#include "camera_file.h"

#include "complain.h"
#include "floor_file.h"

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
        complain(path, "line %d: %s", (int)line,
                 status == IRIS_ERR_TRUNCATED ? "ends early"
                 : status == IRIS_ERR_UNSUPPORTED
                     ? "a later version of camera file than this iris knows"
                     : "not a camera file, or damaged: make it again by iris calibrate");
    }
    return status == IRIS_OK;
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
