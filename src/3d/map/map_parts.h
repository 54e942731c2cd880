/* What grids, scans, and maps of voxels share. */
#ifndef IRIS_3D_MAP_PARTS_H
#define IRIS_3D_MAP_PARTS_H

#include "iris/3d/grid.h"
#include "ray.h"

/* A direction. */
typedef struct {
    iris_q30 cosine, sine;
} iris_heading;

static inline iris_heading iris_heading_of(iris_angle angle)
{
    return (iris_heading){iris_cos_q30(angle), iris_sin_q30(angle)};
}

/* (x, y) turned, along x and along y, to the nearest whole number. */
static inline int32_t iris_heading_x(iris_heading turn, int32_t x, int32_t y)
{
    return iris_sat_s32(iris_round_shift((int64_t)x * turn.cosine - (int64_t)y * turn.sine, 30));
}

static inline int32_t iris_heading_y(iris_heading turn, int32_t x, int32_t y)
{
    return iris_sat_s32(iris_round_shift((int64_t)x * turn.sine + (int64_t)y * turn.cosine, 30));
}

static inline int iris_place_fits(int32_t mm)
{
    return mm > -IRIS_MAP_PLACE_MAX_MM && mm < IRIS_MAP_PLACE_MAX_MM;
}

/* Are these a grid's size and place? */
int iris_grid_is_laid_out(iris_size cells, int32_t cell_mm, int32_t left_mm, int32_t bottom_mm);

/* IRIS_ERR_ARG: null, or contradicts grid.h or scan.h. */
iris_status iris_grid_check(const iris_grid *grid);
iris_status iris_scan_check(const iris_scan *scan);
iris_status iris_fusion_check(const iris_fusion *fusion);

/* What a hit is worth for a place that is so unsure; 0: nothing. */
int32_t iris_fusion_hit(const iris_fusion *fusion, int32_t spread_mm, int32_t cell_mm);

/* odds + gain, within the limit. Odds beyond it, from elsewhere, come back to it. */
static inline int8_t iris_fusion_add(const iris_fusion *fusion, int8_t odds, int32_t gain)
{
    const int32_t sum = odds + gain;
    return (int8_t)(sum > fusion->limit ? fusion->limit : sum < -fusion->limit ? -fusion->limit : sum);
}

/* Marks bit i: 1 when it was not yet. */
static inline int iris_mark(uint32_t *marks, size_t i)
{
    const uint32_t bit = (uint32_t)1 << (i % 32), before = marks[i / 32];
    marks[i / 32] = before | bit;
    return (before & bit) == 0;
}

#endif
