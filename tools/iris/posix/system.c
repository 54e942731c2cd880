#include "../system.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "../complain.h"
#include "iris/scratch.h"

/* A stream that the caller closed is held by something that fails: else the next file opened would get its number, and
 * the robot's port our answers. Returns 0 when that is impossible. */
static int hold_closed_streams(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++) {
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) != fd) {
            return 0;
        }
    }
    return 1;
}

int system_begin(void)
{
    (void)signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error of writing */
    return hold_closed_streams();
}

int system_is_terminal(int fd)
{
    return isatty(fd);
}

int64_t system_clock_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

int64_t system_clock_ms(void)
{
    return system_clock_us() / 1000;
}

void system_sleep_ms(int32_t ms)
{
    const struct timespec time = {ms / 1000, ms % 1000 * 1000000L};
    (void)nanosleep(&time, NULL);
}

void *system_scratch(size_t bytes)
{
    void *memory;
    return posix_memalign(&memory, IRIS_SCRATCH_ALIGN, bytes) == 0 ? memory : NULL;
}

int system_is_separator(char c)
{
    return c == '/';
}

int system_open(const char *path)
{
    return open(path, O_RDONLY | O_CLOEXEC);
}

int system_is_same_file(const char *a, const char *b)
{
    struct stat of_a, of_b;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

int system_make_folder(const char *path)
{
    return mkdir(path, 0777);
}

int system_is_special(const char *path)
{
    struct stat existing;
    return stat(path, &existing) == 0 && !S_ISREG(existing.st_mode);
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
        complain(name, "%s", file_write_problem());
        return 0;
    }
    FILE *file = fdopen(fd, "wb");
    int done = file && write(file, user) && fchmod(fd, mode) == 0;
    if (file ? fclose(file) != 0 : close(fd) != 0) {
        done = 0;
    }
    done = done && rename(temporary, path) == 0;
    if (!done) {
        const char *problem = file_write_problem();
        unlink(temporary);
        complain(name, "%s", problem);
    }
    return done;
}

int system_replace(const char *path, file_writer write, const void *user)
{
    struct stat existing;
    char resolved[PATH_MAX];
    if (stat(path, &existing) != 0) {
        mode_t mask = umask(0);
        umask(mask);
        return write_beside(path, path, 0666 & ~mask, write, user);
    }
    if (access(path, W_OK) != 0) { /* its folder would let us replace it */
        complain(path, "%s", strerror(errno));
        return 0;
    }
    /* A link stays a link: the file it points to is replaced. */
    return write_beside(realpath(path, resolved) ? resolved : path, path, existing.st_mode & 07777, write,
                        user);
}
