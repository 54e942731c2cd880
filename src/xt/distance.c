#include "iris/xt/distance.h"

static iris_status check(const iris_image *distance, const iris_image *mask, iris_distance_metric metric)
{
    if (!distance || !mask || (metric != IRIS_DISTANCE_L1 && metric != IRIS_DISTANCE_CHAMFER)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(distance);
    if (status == IRIS_OK) {
        status = iris_image_check(mask);
    }
    if (status != IRIS_OK) {
        return status;
    }
    if (distance->format != IRIS_GRAY_U16 || mask->format != IRIS_MASK1) {
        return IRIS_ERR_FORMAT;
    }
    if (distance->w != mask->w || distance->h != mask->h) {
        return IRIS_ERR_RANGE;
    }
    return iris_image_overlaps(distance, mask) ? IRIS_ERR_ALIAS : IRIS_OK;
}

static uint16_t nearer(uint32_t a, uint32_t b)
{
    return (uint16_t)(a < b ? a : b);
}

/* 0 where the mask is clear, else as far as can be. */
static void row_start(uint16_t *row, const uint32_t *mask, int32_t n)
{
    for (int32_t x = 0; x < n; x++) {
        row[x] = (uint16_t)(0u - (mask[x / 32] >> x % 32 & 1));
    }
}

/* One step from the row above or below, straight; of a chamfer also diagonally. */
static void row_reach(uint16_t *row, const uint16_t *other, int32_t n)
{
    for (int32_t x = 0; x < n; x++) {
        row[x] = nearer(row[x], other[x] + 1u);
    }
}

static void row_reach_chamfer(uint16_t *row, const uint16_t *other, int32_t n)
{
    uint32_t left = IRIS_DISTANCE_MAX, here = other[0];
    for (int32_t x = 0; x < n; x++) {
        uint32_t right = x + 1 < n ? other[x + 1] : IRIS_DISTANCE_MAX;
        row[x] = nearer(nearer(row[x], here + 3), (left < right ? left : right) + 4);
        left = here;
        here = right;
    }
}

/* Any number of steps along the row. */
static void row_right(uint16_t *row, uint32_t step, int32_t n)
{
    uint32_t before = IRIS_DISTANCE_MAX;
    for (int32_t x = 0; x < n; x++) {
        before = row[x] = nearer(row[x], before + step);
    }
}

static void row_left(uint16_t *row, uint32_t step, int32_t n)
{
    uint32_t before = IRIS_DISTANCE_MAX;
    for (int32_t x = n - 1; x >= 0; x--) {
        before = row[x] = nearer(row[x], before + step);
    }
}

iris_status iris_distance_transform(const iris_image *distance, const iris_image *mask,
                                    iris_distance_metric metric)
{
    iris_status status = check(distance, mask, metric);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t w = mask->w, h = mask->h;
    uint32_t step = metric == IRIS_DISTANCE_L1 ? 1 : 3;
    void (*reach)(uint16_t *, const uint16_t *, int32_t) =
        metric == IRIS_DISTANCE_L1 ? row_reach : row_reach_chamfer;
    for (int32_t y = 0; y < h; y++) {
        uint16_t *row = (uint16_t *)iris_image_row(distance, y);
        row_start(row, (const uint32_t *)iris_image_row(mask, y), w);
        if (y > 0) {
            reach(row, (const uint16_t *)iris_image_row(distance, y - 1), w);
        }
        row_right(row, step, w);
    }
    for (int32_t y = h - 1; y >= 0; y--) {
        uint16_t *row = (uint16_t *)iris_image_row(distance, y);
        if (y < h - 1) {
            reach(row, (const uint16_t *)iris_image_row(distance, y + 1), w);
        }
        row_left(row, step, w);
    }
    return IRIS_OK;
}
