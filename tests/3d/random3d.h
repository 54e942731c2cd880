/* Random vectors and rotations, and doubles beside numbers with 32 fraction bits. */
#ifndef IRIS_TEST_RANDOM3D_H
#define IRIS_TEST_RANDOM3D_H

#include <math.h>

#include "iris/3d/rotation.h"
#include "random_number.h"

static inline double real(iris_q32 a)
{
    return (double)a / 4294967296.0;
}

/* Within -limit..limit. */
static inline iris_q32 random_q32(iris_q32 limit)
{
    return (iris_q32)(random_u64() % (2 * (uint64_t)limit + 1)) - limit;
}

static inline iris_vec3 random_vec3(iris_q32 limit)
{
    iris_vec3 made = {random_q32(limit), random_q32(limit), random_q32(limit)};
    return made;
}

static inline iris_vec3 random_direction(void)
{
    iris_vec3 made = {0, 0, IRIS_Q32_ONE};
    (void)iris_vec3_normalize(&made, random_vec3(IRIS_Q32_ONE));
    return made;
}

static inline void random_rotation(iris_mat3 *r)
{
    iris_rotation_about(r, random_direction(), random_q32(IRIS_PI_Q32));
}

/* All bits, of every length: what is no sensible number either. */
static inline iris_q32 any_q32(void)
{
    static const iris_q32 extremes[] = {
        0, 1, -1, INT64_MAX, INT64_MIN, IRIS_Q32_ONE, -IRIS_Q32_ONE, INT64_MIN + 1};
    uint64_t value = random_u64();
    return value % 3 == 0 ? extremes[value / 3 % 8] : (iris_q32)random_u64() >> value % 64;
}

#endif
