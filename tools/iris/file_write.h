/* Writes files so that one appears under its name only when all of it has been written: nobody ever reads half of it. */
#ifndef IRIS_TOOL_FILE_WRITE_H
#define IRIS_TOOL_FILE_WRITE_H

#include <stdio.h>

/* Calls write(file, user), which returns 1 when every byte has arrived, 0 when not: errno tells why. path: "-" is standard
 * output; devices and pipes are written in place. Complains; returns 1 when done, 0 when not: no new file is left
 * then, and one that was there is as it was. */
int file_write(const char *path, int (*write)(FILE *file, const void *user), const void *user);

#endif
