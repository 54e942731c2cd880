/* Semi-global paths, one pixel after the other. */
#include <string.h>

#include "kernel.h"

#define STEPS_MOST 256

static inline uint16_t reached(uint16_t own, uint16_t beside, uint16_t most, uint16_t one, uint8_t cost,
                               uint16_t least)
{
    uint16_t best = (uint16_t)(beside + one);
    best = best < own ? best : own;
    best = best < most ? best : most;
    return (uint16_t)(best + cost - least);
}

/* From the paths of the pixel before to those of the next one; `to` is not `from`. */
static inline void go_on(uint16_t *restrict to, const uint16_t *restrict from, const uint8_t *restrict costs,
                         const iris_row_ground *ground, uint16_t leap)
{
    const int32_t last = ground->steps - 1;
    const uint16_t one = ground->one;
    uint16_t least = from[0];
    for (int32_t d = 1; d <= last; d++) {
        least = from[d] < least ? from[d] : least;
    }
    const uint16_t most = (uint16_t)(least + leap);
    for (int32_t d = 1; d < last; d++) {
        uint16_t beside = from[d - 1] < from[d + 1] ? from[d - 1] : from[d + 1];
        to[d] = reached(from[d], beside, most, one, costs[d], least);
    }
    to[0] = reached(from[0], from[1], most, ground->one, costs[0], least);
    to[last] = reached(from[last], from[last - 1], most, ground->one, costs[last], least);
}

static inline void add(uint16_t *restrict sums, const uint16_t *restrict paths, int32_t steps)
{
    for (int32_t d = 0; d < steps; d++) {
        sums[d] = (uint16_t)(sums[d] + paths[d]);
    }
}

void iris_row_paths_u16_c(uint16_t *paths, const uint16_t *from, uint16_t *sums,
                          const iris_row_ground *ground, int32_t n)
{
    uint16_t before[STEPS_MOST];
    const int32_t steps = ground->steps;
    const uint8_t *costs = ground->costs;
    for (int32_t x = 0; x < n; x++, paths += steps, from += steps, costs += steps) {
        memcpy(before, from, 2 * (size_t)steps);
        go_on(paths, before, costs, ground, ground->leaps[x]);
        if (sums) {
            add(sums, paths, steps);
            sums += steps;
        }
    }
}

/* One way: `way` is 1 or -1. */
static void go_along(uint16_t *sums, uint16_t *room, const iris_row_ground *ground, int32_t way, int32_t n)
{
    const int32_t steps = ground->steps;
    memset(room, 0, 2 * (size_t)steps);
    for (int32_t k = 0; k < n; k++) {
        int32_t x = way > 0 ? k : n - 1 - k;
        uint16_t *from = room + (k % 2) * steps, *to = room + (1 - k % 2) * steps;
        go_on(to, from, ground->costs + (ptrdiff_t)x * steps, ground, ground->leaps[way > 0 ? x : x + 1]);
        add(sums + (ptrdiff_t)x * steps, to, steps);
    }
}

void iris_row_paths_along_u16_c(uint16_t *sums, uint16_t *room, const iris_row_ground *ground, int32_t n)
{
    go_along(sums, room, ground, 1, n);
    go_along(sums, room, ground, -1, n);
}
