#include "iris/xt/distance.h"

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"

static iris_status check(const iris_image *distance, const iris_image *mask, iris_distance_metric metric)
{
    if (metric != IRIS_DISTANCE_L1 && metric != IRIS_DISTANCE_CHAMFER) {
        return IRIS_ERR_ARG;
    }
    return iris_views_check_formats(distance, IRIS_GRAY_U16, mask, IRIS_MASK1);
}

iris_status iris_distance_transform(const iris_image *distance, const iris_image *mask,
                                    iris_distance_metric metric)
{
    iris_status status = check(distance, mask, metric);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t w = mask->w, h = mask->h;
    iris_row_steps steps = {1, IRIS_DISTANCE_MAX};
    if (metric == IRIS_DISTANCE_CHAMFER) {
        steps = (iris_row_steps){3, 4};
    }
    for (int32_t y = 0; y < h; y++) {
        uint16_t *row = (uint16_t *)iris_image_row(distance, y);
        iris_row_select_u16(row, (const uint32_t *)iris_image_row(mask, y), w);
        if (metric == IRIS_DISTANCE_L1) { /* along the rows first, and then only down and up */
            iris_row_spread_right_u16(row, steps.straight, w);
            iris_row_spread_left_u16(row, steps.straight, w);
        }
        if (y > 0) {
            iris_row_reach_u16(row, (const uint16_t *)iris_image_row(distance, y - 1), steps, w);
        }
        if (metric == IRIS_DISTANCE_CHAMFER) {
            iris_row_spread_right_u16(row, steps.straight, w);
        }
    }
    for (int32_t y = h - 1; y >= 0; y--) {
        uint16_t *row = (uint16_t *)iris_image_row(distance, y);
        if (y < h - 1) {
            iris_row_reach_u16(row, (const uint16_t *)iris_image_row(distance, y + 1), steps, w);
        }
        if (metric == IRIS_DISTANCE_CHAMFER) {
            iris_row_spread_left_u16(row, steps.straight, w);
        }
    }
    return IRIS_OK;
}
