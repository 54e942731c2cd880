/* Where the pixels of a row of depths are, seen from a camera on a robot.
 */
#ifndef IRIS_3D_MAP_DEPTH_ROW_H
#define IRIS_3D_MAP_DEPTH_ROW_H

#include "iris/3d/scan.h"
#include "map_parts.h"

/* Of a depth of 1, with 16 fraction bits. */
typedef struct {
    int32_t ahead, down;
} iris_depth_row;

/* IRIS_ERR_ARG: contradicts scan.h. */
iris_status iris_depth_camera_check(const iris_depth_camera *camera);

/* 0: what row v sees is not ahead, or far above or below. */
int iris_depth_row_of(iris_depth_row *row, const iris_depth_camera *camera, int32_t v);

/* Focal length times baseline, 256 to a pixel: over a disparity it is the depth. */
static inline uint32_t iris_depth_product(const iris_depth_camera *camera)
{
    return camera->kind == IRIS_DEPTH_MM
               ? 0
               : (uint32_t)(((int64_t)camera->focal_q16 * camera->baseline_q16) >> 24);
}

/* The depth of a pixel that is not 0. product: 0 where pixels are depths. */
static inline uint32_t iris_depth_of(uint32_t product, uint16_t pixel)
{
    return product == 0 ? pixel : (product + pixel / 2u) / pixel;
}

static inline int32_t iris_depth_ahead(const iris_depth_row *row, uint32_t depth)
{
    return iris_sat_s32(iris_round_shift((int64_t)depth * row->ahead, 16));
}

static inline int32_t iris_depth_height(const iris_depth_row *row, uint32_t depth,
                                        const iris_depth_camera *camera)
{
    return iris_sat_s32(camera->height_mm - iris_round_shift((int64_t)depth * row->down, 16));
}

/* Standard deviation of a place so far ahead, 65535 at most: millimeters. */
static inline int32_t iris_depth_spread(const iris_depth_camera *camera, int32_t ahead)
{
    const int64_t spread = iris_round_shift((int64_t)ahead * ahead / 1000 * camera->spread_q16 / 1000, 16);
    return (int32_t)(spread > IRIS_SCAN_REACH_MAX_MM / 2 ? IRIS_SCAN_REACH_MAX_MM / 2 : spread);
}

#endif
