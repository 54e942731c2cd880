#include "stereo_space.h"

#include <stdlib.h>

#include "complain.h"
#include "file_write.h"
#include "iris/3d/stereo.h"
#include "iris/pnm.h"
#include "picture.h"

static double real(iris_q32 a)
{
    return (double)a / 4294967296.0;
}

/* In the left camera's frame. Returns 0 where nothing is known. */
static int point_at(iris_vec3 *point, const stereo_space *space, int32_t x, int32_t y)
{
    const uint16_t *row = iris_image_row(space->disparity, y);
    const iris_vec2 pixel = {x * IRIS_Q32_ONE, y * IRIS_Q32_ONE};
    return iris_rectify_point(point, space->rectified, pixel, row[x]) == IRIS_OK;
}

/* Along the left view's axis. */
static double depth_at(const stereo_space *space, int32_t x, int32_t y)
{
    const uint16_t disparity = ((const uint16_t *)iris_image_row(space->disparity, y))[x];
    const iris_q32 depth =
        disparity > 1 ? iris_stereo_depth(disparity, space->rectified->baseline, space->rectified->focal)
                      : IRIS_STEREO_INFINITY;
    return depth == IRIS_STEREO_INFINITY ? 0 : real(depth);
}

static int write_depth(FILE *file, const void *user)
{
    iris_sink sink = {file_write_bytes, file};
    return iris_pnm_write(sink, user) == IRIS_OK && fflush(file) == 0;
}

int stereo_depth_write(const char *path, stereo_space *space)
{
    picture_buffer depth = {0};
    const iris_size size = {space->disparity->w, space->disparity->h};
    iris_status status = picture_reserve(&depth, size, IRIS_GRAY_U16);
    if (status != IRIS_OK) {
        complain(path, "%s", picture_problem(status, size));
        return 0;
    }
    space->beyond = 0;
    for (int32_t y = 0; y < size.h; y++) {
        uint16_t *to = iris_image_row(&depth.image, y);
        for (int32_t x = 0; x < size.w; x++) {
            const double units = depth_at(space, x, y) * space->per_unit;
            const int known = units > 0, beyond = units >= 65535.5;
            to[x] = (uint16_t)(!known || beyond ? 0 : units < 1 ? 1 : units + 0.5);
            space->beyond += beyond;
        }
    }
    int done = file_write(path, write_depth, &depth.image);
    picture_free(&depth);
    return done;
}

static int write_points(FILE *file, const void *user)
{
    const stereo_space *space = user;
    const int32_t w = space->disparity->w, h = space->disparity->h;
    iris_vec3 p;
    int32_t count = 0;
    for (int32_t i = 0; i < w * h; i++) {
        count += point_at(&p, space, i % w, i / w);
    }
    fprintf(file,
            "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
            (int)count);
    for (int32_t i = 0; i < w * h; i++) {
        if (point_at(&p, space, i % w, i / w)) {
            const int level = ((const uint8_t *)iris_image_row(space->left, i / w))[i % w];
            fprintf(file, "%.7g %.7g %.7g %d %d %d\n", real(p.x), real(p.y), real(p.z), level, level, level);
        }
    }
    return !ferror(file) && fflush(file) == 0;
}

int stereo_points_write(const char *path, const stereo_space *space)
{
    return file_write(path, write_points, space);
}

int stereo_depth_range(double range[2], const stereo_space *space)
{
    range[0] = range[1] = 0;
    for (int32_t y = 0; y < space->disparity->h; y++) {
        for (int32_t x = 0; x < space->disparity->w; x++) {
            const double depth = depth_at(space, x, y);
            if (depth > 0) {
                range[0] = range[0] == 0 || depth < range[0] ? depth : range[0];
                range[1] = depth > range[1] ? depth : range[1];
            }
        }
    }
    return range[1] > 0;
}
