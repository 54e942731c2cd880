#include "picture.h"

#include <stdio.h>
#include <stdlib.h>

/* Bytes in all pictures. */
static size_t taken;

iris_status picture_reserve(picture_buffer *picture, iris_size size, iris_format format)
{
    size_t row = iris_format_row_bytes(format, size.w);
    if (row == 0 || size.h < 1 || size.h > IRIS_SIDE_MAX) {
        picture_free(picture);
        return IRIS_ERR_RANGE;
    }
    size_t needed =
        row * (size_t)size.h; /* at most 6 * 32767^2, which fits the 33 bits and more of a host's size_t */
    if (needed > picture->capacity) {
        picture_free(picture);
        if (needed > PICTURE_MEMORY_MAX - taken) {
            return IRIS_ERR_FULL;
        }
        picture->memory = malloc(needed);
        if (!picture->memory) {
            return IRIS_ERR_SCRATCH;
        }
        picture->capacity = needed;
        taken += needed;
    }
    return iris_image_wrap(&picture->image, picture->memory, picture->capacity, size, 0, format);
}

const char *picture_problem(iris_status status, iris_size size)
{
    static char text[80];
    if (status == IRIS_ERR_FULL) {
        snprintf(text, sizeof text, "%dx%d pixels would take more than 1 GiB", (int)size.w, (int)size.h);
    } else if (status == IRIS_ERR_SCRATCH) {
        snprintf(text, sizeof text, "not enough memory for %dx%d pixels", (int)size.w, (int)size.h);
    } else {
        snprintf(text, sizeof text, "%s", iris_status_text(status));
    }
    return text;
}

void picture_free(picture_buffer *picture)
{
    free(picture->memory);
    taken -= picture->capacity;
    picture->memory = NULL;
    picture->capacity = 0;
}
