/* Floor files: what `iris floor` writes, and what other commands take by --floor. */
#ifndef IRIS_TOOL_FLOOR_FILE_H
#define IRIS_TOOL_FLOOR_FILE_H

#include <stddef.h>

#include "iris/xt/floor.h"

#define TEXT_FILE_BYTES 65536

/* Reads a whole text of less than `room` bytes; "-" is standard input. Complains; returns 1, or 0. */
int text_file_read(char *text, size_t room, size_t *length, const char *path);

/* The floor in a file. Complains, with the line; returns 1, or 0. */
int floor_file_read(iris_floor *floor, const char *path);

/* Are pictures of this size those that the floor was made for? Complains about `file` if not. */
int floor_fits(const iris_floor *floor, const char *file, iris_size size);

#endif
