/* The cells of a straight ray, one after the other, in the plane or in space: without an error, since places are whole
 * millimeters. After J. Amanatides and A. Woo 1987, with products instead of quotients.
 */
#ifndef IRIS_3D_MAP_RAY_H
#define IRIS_3D_MAP_RAY_H

#include <stdint.h>

#define IRIS_RAY_LENGTH_MAX_MM ((int32_t)1 << 20) /* along each axis: products of three fit 64 bits */

typedef struct {
    int32_t at[3];    /* the cell */
    int32_t left[3];  /* steps that are left */
    int32_t step[3];  /* 1, -1 */
    int64_t until[3]; /* how far along the ray the next step is, in units that all axes share */
    int64_t gain[3];  /* from one step to the next */
} iris_ray;

/* a / b rounded down, for b > 0. */
static inline int32_t iris_ray_floor(int32_t a, int32_t b)
{
    return a / b - (a % b < 0);
}

/* From `from` to `to`, millimeters from the corner of cell 0, 2^30 at most, and apart IRIS_RAY_LENGTH_MAX_MM at most. */
void iris_ray_start(iris_ray *ray, const int32_t from[3], const int32_t to[3], int32_t cell_mm);

/* Goes on to the next cell; 0: this is the last one. Where a ray goes through an edge, x comes first, then y. */
static inline int iris_ray_next(iris_ray *ray)
{
    int axis = ray->until[1] < ray->until[0] ? 1 : 0;
    axis = ray->until[2] < ray->until[axis] ? 2 : axis;
    if (ray->left[axis] == 0) {
        return 0;
    }
    ray->at[axis] += ray->step[axis];
    ray->left[axis]--;
    ray->until[axis] = ray->left[axis] > 0 ? ray->until[axis] + ray->gain[axis] : INT64_MAX;
    return 1;
}

#endif
