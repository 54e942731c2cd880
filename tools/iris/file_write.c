#include "file_write.h"

#include <errno.h>
#include <string.h>

#include "complain.h"
#include "system.h"

const char *file_write_problem(void)
{
    return errno ? strerror(errno) : "cannot be written";
}

ptrdiff_t file_write_bytes(void *file, const uint8_t *data, size_t bytes)
{
    const size_t written = fwrite(data, 1, bytes, file);
    return written > 0 ? (ptrdiff_t)written : -1;
}

int file_write_text(FILE *file, const void *user)
{
    return fputs(user, file) >= 0 && fflush(file) == 0;
}

/* Into a device or a pipe that is there already, or to standard output. */
static int write_in_place(const char *path, file_writer write, const void *user)
{
    int is_stdout = strcmp(path, "-") == 0;
    FILE *file = is_stdout ? stdout : fopen(path, "wb");
    int done = file && write(file, user);
    if (!done) {
        complain(is_stdout ? "standard output" : path, "%s", file_write_problem());
    }
    if (file && !is_stdout && fclose(file) != 0 && done) {
        complain(path, "%s", file_write_problem());
        done = 0;
    }
    return done;
}

int file_write(const char *path, file_writer write, const void *user)
{
    return strcmp(path, "-") == 0 || system_is_special(path) ? write_in_place(path, write, user)
                                                             : system_replace(path, write, user);
}
