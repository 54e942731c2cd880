#include "picture_write.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "file_name.h"
#include "file_write.h"
#include "iris/bmp.h"
#include "iris/color.h"
#include "iris/pnm.h"

picture_container picture_container_of(const char *path)
{
    const char *name = file_name(path);
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

/* What is written, and as what. */
typedef struct {
    const iris_image *image;
    picture_container container;
} job;

/* Writes and flushes; 1 when every byte has arrived. errno tells why not. */
static int write_to(FILE *file, const void *user)
{
    const job *j = user;
    const iris_image *image = j->image;
    picture_container container = j->container;
    iris_sink sink = {file_write_bytes, file};
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

int picture_write(const char *path, const iris_image *image)
{
    const job j = {image, picture_container_of(path)};
    return file_write(path, write_to, &j);
}
