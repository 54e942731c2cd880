/* Reads any bytes as a camera's text. What is accepted is written and read again as it was. */
#include <stdlib.h>
#include <string.h>

#include "iris/3d/camera_text.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    iris_camera_model model, again;
    int32_t line = 0;
    if (iris_camera_read_text(&model, &line, (const char *)data, bytes) == IRIS_OK) {
        char text[IRIS_CAMERA_TEXT_BYTES];
        size_t length = 0;
        if (iris_camera_write_text(text, sizeof text, &length, &model) != IRIS_OK ||
            iris_camera_read_text(&again, &line, text, length) != IRIS_OK ||
            memcmp(&again.intrinsics, &model.intrinsics, sizeof again.intrinsics) != 0) {
            abort();
        }
    }
    return 0;
}
