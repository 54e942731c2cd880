#include "map_file.h"

#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "floor_file.h"
#include "frame_reader.h"
#include "iris/3d/map_text.h"
#include "picture_write.h"
#include "system.h"

#define PATH_BYTES 1024

static size_t base_length(const char *path)
{
    size_t length = 0;
    for (size_t i = 0; path[i] != '\0'; i++) {
        length = system_is_separator(path[i]) ? i + 1 : length;
    }
    return length;
}

static int write_picture(const char *path, const iris_grid *grid)
{
    picture_buffer picture = {0};
    const iris_size size = {grid->w, grid->h};
    iris_status status = picture_reserve(&picture, size, IRIS_GRAY8);
    status = status == IRIS_OK ? iris_grid_to_picture(&picture.image, grid) : status;
    int written = 0;
    if (status != IRIS_OK) {
        complain(path, "%s", picture_problem(status, size));
    } else {
        written = picture_write(path, &picture.image);
    }
    picture_free(&picture);
    return written;
}

int map_file_write(const char *path, const iris_grid *grid)
{
    char picture[PATH_BYTES], text[IRIS_MAP_TEXT_BYTES];
    size_t length = strlen(path), text_length = 0;
    iris_map_text map = {.cell_mm = grid->cell_mm, .left_mm = grid->left_mm, .bottom_mm = grid->bottom_mm};
    const size_t base = base_length(path);
    iris_grid_shades_defaults(&map.shades);
    if (length + 1 > sizeof picture || length - base >= sizeof map.image) {
        complain(path, "this name is too long");
        return 0;
    }
    snprintf(picture, sizeof picture, "%.*s.pgm", (int)(length - 5), path);
    snprintf(map.image, sizeof map.image, "%.*s", (int)sizeof map.image - 1, picture + base);
    if (iris_map_write_text(text, sizeof text, &text_length, &map) != IRIS_OK) {
        complain(path, "a map's name has no quotes, #, or blanks at its ends");
        return 0;
    }
    return write_picture(picture, grid) && file_write(path, file_write_text, text);
}

static int grid_from(iris_grid *grid, const iris_map_text *map, const iris_image *image, const char *path)
{
    const int32_t corner[2] = {map->left_mm, map->bottom_mm};
    const size_t bytes = (size_t)image->w * (size_t)image->h;
    int8_t *odds = malloc(bytes);
    const iris_status status =
        odds ? iris_grid_init(grid, odds, bytes, (iris_size){image->w, image->h}, map->cell_mm, corner)
             : IRIS_ERR_SCRATCH;
    if (status != IRIS_OK || iris_grid_from_picture(grid, image, &map->shades) != IRIS_OK) {
        complain(path,
                 odds ? "%dx%d cells are too many: a map has up to %d along a side" : "not enough memory",
                 (int)image->w, (int)image->h, IRIS_GRID_SIDE_MAX);
        free(odds);
        return 0;
    }
    return 1;
}

static int read_picture(iris_grid *grid, const iris_map_text *map, const char *path)
{
    static frame_reader reader;
    picture_buffer picture = {0};
    iris_status status = frame_reader_open(&reader, path);
    status = status == IRIS_OK ? frame_reader_next(&reader, &picture, IRIS_GRAY8) : status;
    frame_reader_close(&reader);
    int good = 0;
    if (status != IRIS_OK) {
        complain(path, "%s", frame_reader_problem(&reader));
    } else {
        good = grid_from(grid, map, &picture.image, path);
    }
    picture_free(&picture);
    return good;
}

int map_file_read(iris_grid *grid, const char *path)
{
    static char text[TEXT_FILE_BYTES];
    char picture[PATH_BYTES];
    size_t length = 0;
    int32_t line = 0;
    iris_map_text map;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return 0;
    }
    const iris_status status = iris_map_read_text(&map, &line, text, length);
    if (status != IRIS_OK) {
        complain(path, "line %d: %s", (int)line,
                 status == IRIS_ERR_TRUNCATED ? "image, resolution, or origin is missing"
                 : status == IRIS_ERR_UNSUPPORTED
                     ? "cells are to be whole millimeters, the origin without an "
                       "angle, and the mode trinary"
                     : "not the text of a map, or damaged");
        return 0;
    }
    const size_t base = system_is_separator(map.image[0]) ? 0 : base_length(path);
    if (base + strlen(map.image) + 1 > sizeof picture) {
        complain(path, "its picture's name is too long");
        return 0;
    }
    snprintf(picture, sizeof picture, "%.*s%s", (int)base, path, map.image);
    return read_picture(grid, &map, picture);
}
