/* Pictures in memory that the tool owns. All of them together never take more than 1 GiB, whatever a header says. */
#ifndef IRIS_TOOL_PICTURE_H
#define IRIS_TOOL_PICTURE_H

#include "iris/image.h"

#define PICTURE_MEMORY_MAX ((size_t)1 << 30)

/* Zeroed: an empty picture. */
typedef struct {
    iris_image image;
    void *memory;
    size_t capacity; /* bytes at memory, kept for the next picture */
} picture_buffer;

/* Makes picture->image a view of this size and format; what the picture held is lost. IRIS_ERR_FULL: it would take
 * more than PICTURE_MEMORY_MAX, nothing was asked for; IRIS_ERR_SCRATCH: the system has no more memory; IRIS_ERR_RANGE.
 * The picture is empty then. */
iris_status picture_reserve(picture_buffer *picture, iris_size size, iris_format format);

/* Why picture_reserve refused, in words for a complaint; valid until the next call. */
const char *picture_problem(iris_status status, iris_size size);

void picture_free(picture_buffer *picture);

#endif
