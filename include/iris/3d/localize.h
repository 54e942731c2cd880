/* IRIS-3D - localization: where on a known map a robot is, from where it should be by its odometry and what it sees now.
 *
 * The scan is laid on the map at every place of a window around the prediction, and turned to every heading of it: the
 * place is taken where its ends fall nearest to walls. Correlative matching after E. Olson 2009: nothing is assumed about
 * the start but the window, and nothing in it is missed. Blocks of 8 x 8 places come first, by a map of the best that a
 * block can be; only blocks that could hold the best place are looked into, and the result is that of trying all.
 */
#ifndef IRIS_3D_LOCALIZE_H
#define IRIS_3D_LOCALIZE_H

#include "iris/3d/grid.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- the map, made ready --- */

#define IRIS_FIELD_BLOCK 8

/* How near to a wall each cell is: 255 in an occupied one, falling as a bell curve with a standard deviation of 1.5 cells,
 * 0 from 5 cells on; and the best of each 8 x 8 cells. In the caller's memory. */
typedef struct {
    const uint8_t *near; /* w * h */
    const uint8_t
        *blocks; /* (w + 7) * (h + 7): at (x + 7, y + 7) the best of the block whose least cell is (x, y) */
    int32_t w, h;
    int32_t cell_mm, left_mm, bottom_mm; /* as the grid's */
} iris_field;

#define IRIS_FIELD_BYTES(w, h)                                                                               \
    ((size_t)(w) * (size_t)(h) +                                                                             \
     ((size_t)(w) + IRIS_FIELD_BLOCK - 1u) * ((size_t)(h) + IRIS_FIELD_BLOCK - 1u))
#define IRIS_FIELD_SCRATCH_BYTES(w, h)                                                                       \
    (IRIS_SCRATCH_ROUND(2u * (size_t)(w) * (size_t)(h)) +                                                    \
     IRIS_SCRATCH_ROUND(((size_t)(w) + 31u) / 32u * 4u * (size_t)(h)))

/* Makes *field of the grid, in `bytes` bytes at `memory`, which stay the caller's. The grid is not needed any more then.
 * IRIS_ERR_ARG: null pointer or invalid grid; IRIS_ERR_RANGE: less than IRIS_FIELD_BYTES(w, h); IRIS_ERR_SCRATCH: less
 * than IRIS_FIELD_SCRATCH_BYTES(w, h). O(cells): a distance transform (xt/distance.h) and two passes. */
iris_status iris_field_init(iris_field *field, uint8_t *memory, size_t bytes, const iris_grid *grid,
                            iris_scratch *scratch);

/* --- matching --- */

/* What is searched, and what is taken for a match. */
typedef struct {
    int32_t
        window_cells; /* so many cells to each side of the prediction, 1 to IRIS_LOCALIZE_WINDOW_MAX; default 10 */
    int32_t
        angle_steps; /* so many steps to each side of its heading, 0 to IRIS_LOCALIZE_STEPS_MAX; default 20 */
    iris_angle
        angle_step; /* above 0; default 91: half a degree, with 20 steps 10 degrees to each side. The window is
                              below half a turn to each side */
    int32_t least_percent; /* the least score, 1 to 100; default 40 */
    int32_t least_beams;   /* so many beams must end at something, 1 and more; default 20 */
    /* How sure the prediction is: standard deviations of its place and of its heading, which weigh the places that the
     * scan leaves open; 0, the default: it tells nothing but where to look. */
    int32_t predicted_mm;
    iris_angle predicted_angle;
} iris_localize_config;

#define IRIS_LOCALIZE_WINDOW_MAX 200
#define IRIS_LOCALIZE_STEPS_MAX  1000

/* As given above: for a robot that does not know where it is, within the window. One that does, from the last scan and
 * the step since then, sets predicted_mm and predicted_angle, too, to some millimeters and a degree. Null is ignored. */
void iris_localize_defaults(iris_localize_config *config);

typedef enum {
    IRIS_LOCALIZE_FOUND = 0,
    IRIS_LOCALIZE_TOO_FEW, /* too few beams end at something: there is nothing to match */
    IRIS_LOCALIZE_NO_MATCH, /* nowhere in the window does the scan look like the map: a wrong prediction, or map */
    IRIS_LOCALIZE_AMBIGUOUS, /* other places are as good: along a corridor, or where the map repeats itself */
    IRIS_LOCALIZE_AT_EDGE    /* the best place is at the window's edge: a better one may be beyond it */
} iris_localize_verdict;

typedef struct {
    iris_localize_verdict verdict;
    iris_map_pose pose;     /* the best one; the prediction, where there was none */
    int32_t score_permille; /* 1000: all beams end in the middle of walls */
    int32_t beams;          /* how many ended at something, surely enough */
    /* Standard deviation of all places within a tenth of the best score, by how much they are above that: in the direction
     * in which it is largest, and of the heading. */
    int32_t spread_mm;
    int32_t spread_angle;    /* units of iris_angle */
    iris_angle spread_along; /* that direction, -90 to 90 degrees from the map's x */
} iris_location;

/* Is the pose better than the prediction? When it was found; and when it is ambiguous, if the prediction was given as sure:
 * it decides then what the scan leaves open. */
static inline int iris_location_is_of_use(const iris_location *location, const iris_localize_config *config)
{
    return location->verdict == IRIS_LOCALIZE_FOUND ||
           (location->verdict == IRIS_LOCALIZE_AMBIGUOUS && config->predicted_mm > 0 &&
            config->predicted_angle > 0);
}

#define IRIS_LOCALIZE_BLOCKS(window_cells)                                                                   \
    ((2u * (size_t)(window_cells) + IRIS_FIELD_BLOCK) / IRIS_FIELD_BLOCK)
#define IRIS_LOCALIZE_SCRATCH_BYTES(beams, window_cells, angle_steps)                                        \
    (IRIS_SCRATCH_ROUND(8u * (size_t)(beams)) +                                                              \
     IRIS_SCRATCH_ROUND(4u * (2u * (size_t)(angle_steps) + 1u) * IRIS_LOCALIZE_BLOCKS(window_cells) *        \
                        IRIS_LOCALIZE_BLOCKS(window_cells)))

/* Finds the robot. Beams count that end at something, with a spread of at most 2 cells (grid.h); each is worth what the
 * field says where it ends, and the score is their mean. Among equal places the one nearest to the prediction is taken.
 * The pose is the mean of all places within a tenth of the best score, by how much they are above that, and by how likely the
 * prediction makes them: d standard deviations away, (1 + d^2 / 2)^-2 as much.
 *
 * It is refused as ambiguous when places within a tenth of the best score spread more than 3 cells (or window_cells / 2,
 * if that is less) or more than half of the angle steps: in a corridor, unless an eighth of the beams sees something
 * across. What the corridor does tell is there: the pose across it, and the direction along it.
 *
 *   predicted   where odometry says that it is: iris_map_pose_after(last pose, step)
 *   config      null for the defaults
 * IRIS_ERR_ARG: null pointer, an invalid field, scan, or config; IRIS_ERR_RANGE: the prediction is not within
 * IRIS_MAP_PLACE_MAX_MM; IRIS_ERR_SCRATCH: less than IRIS_LOCALIZE_SCRATCH_BYTES(scan->count, ...). *location is
 * untouched then.
 * With n beams and a window of m cells and k steps: n (2k + 1) (m / 4 + 1)^2 look-ups, and 64 n for each block that is
 * looked into: a few where there is one clear place, at worst all, n (2k + 1) (2m + 1)^2, twice. */
iris_status iris_localize(iris_location *location, const iris_field *field, iris_map_pose predicted,
                          const iris_scan *scan, const iris_localize_config *config, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
