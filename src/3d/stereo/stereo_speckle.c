#include "iris/3d/stereo.h"

/* Sets of pixels as trees: of pixel i the one above it, or for the topmost minus how many the set has. */

static int32_t top_of(int32_t *above, int32_t i)
{
    while (above[i] >= 0) {
        if (above[above[i]] >= 0) {
            above[i] = above[above[i]];
        }
        i = above[i];
    }
    return i;
}

static void join(int32_t *above, int32_t a, int32_t b)
{
    a = top_of(above, a);
    b = top_of(above, b);
    if (a != b) {
        int32_t larger = above[a] <= above[b] ? a : b, smaller = larger == a ? b : a;
        above[larger] += above[smaller];
        above[smaller] = larger;
    }
}

static int hang_together(uint16_t a, uint16_t b, int32_t difference)
{
    return a != 0 && b != 0 && a - b <= difference && b - a <= difference;
}

static void join_row(int32_t *above, const iris_image *disparity, int32_t y, int32_t difference)
{
    const uint16_t *row = iris_image_row(disparity, y);
    const uint16_t *upper = y > 0 ? iris_image_row(disparity, y - 1) : NULL;
    int32_t at = y * disparity->w;
    for (int32_t x = 0; x < disparity->w; x++, at++) {
        above[at] = -1;
        if (x > 0 && hang_together(row[x - 1], row[x], difference)) {
            join(above, at - 1, at);
        }
        if (upper && hang_together(upper[x], row[x], difference)) {
            join(above, at - disparity->w, at);
        }
    }
}

iris_status iris_stereo_speckle(const iris_image *disparity, int32_t least_area, int32_t difference,
                                iris_scratch *scratch)
{
    if (!disparity || !scratch || least_area < 0 || difference < 0 || difference > UINT16_MAX) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(disparity);
    if (status == IRIS_OK && disparity->format != IRIS_GRAY_U16) {
        status = IRIS_ERR_FORMAT;
    }
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    int32_t *above = iris_scratch_take(scratch, 4 * (size_t)disparity->w * (size_t)disparity->h);
    for (int32_t y = 0; y < disparity->h && above; y++) {
        join_row(above, disparity, y, difference);
    }
    for (int32_t y = 0; y < disparity->h && above; y++) {
        uint16_t *row = iris_image_row(disparity, y);
        for (int32_t x = 0; x < disparity->w; x++) {
            int32_t top = top_of(above, y * disparity->w + x);
            row[x] = -above[top] < least_area ? 0 : row[x];
        }
    }
    iris_scratch_release(scratch, mark);
    return above ? IRIS_OK : IRIS_ERR_SCRATCH;
}
