#include "ray.h"

/* 1 for 0: an axis along which the ray does not go changes nothing. */
static int64_t size_of(int32_t a)
{
    return a < 0 ? -a : a > 0 ? a : 1;
}

void iris_ray_start(iris_ray *ray, const int32_t from[3], const int32_t to[3], int32_t cell_mm)
{
    const int64_t sizes[3] = {size_of(to[0] - from[0]), size_of(to[1] - from[1]), size_of(to[2] - from[2])};
    for (int axis = 0; axis < 3; axis++) {
        const int32_t first = iris_ray_floor(from[axis], cell_mm), last = iris_ray_floor(to[axis], cell_mm);
        const int forward = last > first;
        const int64_t others = sizes[(axis + 1) % 3] * sizes[(axis + 2) % 3];
        const int32_t away = forward ? (first + 1) * cell_mm - from[axis] : from[axis] - first * cell_mm;
        ray->at[axis] = first;
        ray->step[axis] = forward ? 1 : -1;
        ray->left[axis] = forward ? last - first : first - last;
        ray->gain[axis] = cell_mm * others;
        ray->until[axis] = ray->left[axis] > 0 ? away * others : INT64_MAX;
    }
}
