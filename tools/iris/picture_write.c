#include "picture_write.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "complain.h"
#include "iris/bmp.h"
#include "iris/color.h"
#include "iris/pnm.h"

picture_container picture_container_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    if (!dot || dot == name || strcasecmp(dot, ".bmp") == 0) {
        return CONTAINER_BMP;
    }
    return strcasecmp(dot, ".pgm") == 0   ? CONTAINER_PGM
           : strcasecmp(dot, ".ppm") == 0 ? CONTAINER_PPM
           : strcasecmp(dot, ".pnm") == 0 ? CONTAINER_PNM
                                          : CONTAINER_UNKNOWN;
}

static int has_color(iris_format format)
{
    return format == IRIS_RGB888 || format == IRIS_BGR888;
}

const char *picture_extension(picture_container container, iris_format format)
{
    return container == CONTAINER_BMP ? ".bmp" : has_color(format) ? ".ppm" : ".pgm";
}

static ptrdiff_t write_bytes(void *user, const uint8_t *data, size_t bytes)
{
    size_t written = fwrite(data, 1, bytes, user);
    return written > 0 ? (ptrdiff_t)written : -1;
}

/* The row as `format`, in `room` when it is not that already. A mask becomes gray on its way to color. */
static const void *row_as(iris_format format, const void *row, const iris_image *image, uint8_t *room)
{
    static uint8_t gray[IRIS_SIDE_MAX];
    iris_format from = image->format;
    if (from == IRIS_MASK1 && format == IRIS_RGB888) {
        iris_color_row(gray, IRIS_GRAY8, row, from, image->w);
        row = gray;
        from = IRIS_GRAY8;
    }
    if (from == format) {
        return row;
    }
    iris_color_row(room, format, row, from, image->w);
    return room;
}

static iris_status write_pnm(iris_sink sink, const iris_image *image, iris_format format)
{
    static uint8_t room[3 * IRIS_SIDE_MAX];
    iris_pnm_writer writer;
    iris_status status = iris_pnm_write_begin(&writer, sink, (iris_size){image->w, image->h}, format);
    for (int32_t y = 0; y < image->h && status == IRIS_OK; y++) {
        status = iris_pnm_write_row(&writer, row_as(format, iris_image_row(image, y), image, room));
    }
    return status == IRIS_OK ? iris_pnm_write_end(&writer) : status;
}

/* Writes and flushes; 1 when every byte has arrived. errno tells why not. */
static int write_to(FILE *file, const iris_image *image, picture_container container)
{
    iris_sink sink = {write_bytes, file};
    iris_status status = IRIS_OK;
    errno = 0;
    if (container == CONTAINER_BMP) {
        status = iris_bmp_write(sink, image);
    } else {
        int color = container == CONTAINER_PPM || (container == CONTAINER_PNM && has_color(image->format));
        status = write_pnm(sink, image, color ? IRIS_RGB888 : IRIS_GRAY8);
    }
    return status == IRIS_OK && fflush(file) == 0;
}

static const char *write_problem(void)
{
    return errno ? strerror(errno) : "cannot be written";
}

/* Into a device or a pipe that is there already, or to standard output. */
static int write_in_place(const char *path, const iris_image *image, picture_container container)
{
    int is_stdout = strcmp(path, "-") == 0;
    FILE *file = is_stdout ? stdout : fopen(path, "wb");
    int done = file && write_to(file, image, container);
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
static int write_beside(const char *path, const char *name, mode_t mode, const iris_image *image,
                        picture_container container)
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
    int done = file && write_to(file, image, container) && fchmod(fd, mode) == 0;
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

int picture_write(const char *path, const iris_image *image)
{
    picture_container container = picture_container_of(path);
    struct stat existing;
    char resolved[PATH_MAX];
    if (strcmp(path, "-") == 0) {
        return write_in_place(path, image, container);
    }
    if (stat(path, &existing) != 0) {
        mode_t mask = umask(0);
        umask(mask);
        return write_beside(path, path, 0666 & ~mask, image, container);
    }
    if (!S_ISREG(existing.st_mode)) {
        return write_in_place(path, image, container);
    }
    if (access(path, W_OK) != 0) { /* its folder would let us replace it */
        complain(path, "%s", strerror(errno));
        return 0;
    }
    /* A link stays a link: the file it points to is replaced. */
    return write_beside(realpath(path, resolved) ? resolved : path, path, existing.st_mode & 07777, image,
                        container);
}
