#include "file_write.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "complain.h"

typedef int (*file_writer)(FILE *file, const void *user);

static const char *write_problem(void)
{
    return errno ? strerror(errno) : "cannot be written";
}

/* Into a device or a pipe that is there already, or to standard output. */
static int write_in_place(const char *path, file_writer write, const void *user)
{
    int is_stdout = strcmp(path, "-") == 0;
    FILE *file = is_stdout ? stdout : fopen(path, "wb");
    int done = file && write(file, user);
    if (!done) {
        complain(is_stdout ? "standard output" : path, "%s", write_problem());
    }
    if (file && !is_stdout && fclose(file) != 0 && done) {
        complain(path, "%s", write_problem());
        done = 0;
    }
    return done;
}

/* Into a new file beside `path`, which then takes its place. `name` is what the user calls it. */
static int write_beside(const char *path, const char *name, mode_t mode, file_writer write, const void *user)
{
    char temporary[PATH_MAX];
    const char *slash = strrchr(path, '/');
    int folder = slash ? (int)(slash + 1 - path) : 0;
    if (snprintf(temporary, sizeof temporary, "%.*s.iris-XXXXXX", folder, path) >= (int)sizeof temporary) {
        complain(name, "%s", strerror(ENAMETOOLONG));
        return 0;
    }
    int fd = mkstemp(temporary);
    if (fd < 0) {
        complain(name, "%s", write_problem());
        return 0;
    }
    FILE *file = fdopen(fd, "wb");
    int done = file && write(file, user) && fchmod(fd, mode) == 0;
    if (file ? fclose(file) != 0 : close(fd) != 0) {
        done = 0;
    }
    done = done && rename(temporary, path) == 0;
    if (!done) {
        const char *problem = write_problem();
        unlink(temporary);
        complain(name, "%s", problem);
    }
    return done;
}

int file_write(const char *path, file_writer write, const void *user)
{
    struct stat existing;
    char resolved[PATH_MAX];
    if (strcmp(path, "-") == 0) {
        return write_in_place(path, write, user);
    }
    if (stat(path, &existing) != 0) {
        mode_t mask = umask(0);
        umask(mask);
        return write_beside(path, path, 0666 & ~mask, write, user);
    }
    if (!S_ISREG(existing.st_mode)) {
        return write_in_place(path, write, user);
    }
    if (access(path, W_OK) != 0) { /* its folder would let us replace it */
        complain(path, "%s", strerror(errno));
        return 0;
    }
    /* A link stays a link: the file it points to is replaced. */
    return write_beside(realpath(path, resolved) ? resolved : path, path, existing.st_mode & 07777, write,
                        user);
}
