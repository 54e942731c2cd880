/* Writes files so that one appears under its name only when all of it has been written: nobody ever reads half of it. */
#ifndef IRIS_TOOL_FILE_WRITE_H
#define IRIS_TOOL_FILE_WRITE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Returns 1 when every byte has arrived, 0 when not: errno tells why. */
typedef int (*file_writer)(FILE *file, const void *user);

/* Calls write(file, user). path: "-" is standard output; devices and pipes are written in place. Complains; returns 1
 * when done, 0 when not: no new file is left then, and one that was there is as it was. */
int file_write(const char *path, file_writer write, const void *user);

/* Of an iris_sink whose user is a FILE. */
ptrdiff_t file_write_bytes(void *file, const uint8_t *data, size_t bytes);

/* A file_writer: user is a text that ends with a 0. */
int file_write_text(FILE *file, const void *user);

/* What went wrong with a file, by errno. */
const char *file_write_problem(void);

#endif
