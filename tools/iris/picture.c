#include "picture.h"

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
            return IRIS_ERR_SCRATCH;
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

void picture_free(picture_buffer *picture)
{
    free(picture->memory);
    taken -= picture->capacity;
    picture->memory = NULL;
    picture->capacity = 0;
}
