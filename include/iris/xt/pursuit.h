/* IRIS-XT - steering by millimeters: pure pursuit of a line on the floor.
 *
 * What steer.h does with offsets in the picture is done here with places on the floor, so that one setting holds for
 * every camera, height, and tilt, and curves are driven as they are:
 *
 *     goal       the place where the line, followed from the robot, is `lookahead_mm` away from the axle; its end, if
 *                it is seen no farther
 *     curvature  2 x / (x^2 + y^2)         of the arc from the axle, straight ahead at first, to the goal (x, y)
 *     steer      curvature * radius_mm     1 at the curve that full steering drives
 *
 * The speed, a line that is lost, and the memory of sharp bends are those of steer.h, which works beneath; so is the
 * command. R. C. Coulter, "Implementation of the pure pursuit path tracking algorithm", 1992.
 *
 * The middle of the axle is where the floor's (0, 0) is, unless axle_mm says otherwise.
 */
#ifndef IRIS_XT_PURSUIT_H
#define IRIS_XT_PURSUIT_H

#include "iris/command.h"
#include "iris/status.h"
#include "iris/xt/floor.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int32_t lookahead_mm; /* 10..10000: a longer one is smoother and cuts curves more; default 200 */
    /* 1..100000: of the curve, at the axle's middle, that full steering drives; default 75: half of the distance of
     * two driven wheels, of which the inner one then stands still */
    int32_t radius_mm;
    int32_t axle_mm; /* -10000..10000: y of the middle of the axle on the floor; default 0 */
} iris_pursuit_config;

/* Where the line is on the floor. Everything is zero when the line is not found, or not seen on the floor. */
typedef struct {
    int32_t found;
    iris_place goal;       /* mm on the floor */
    iris_q16 offset_q16;   /* mm: the goal's x, positive right */
    iris_q16 distance_q16; /* mm, from the axle's middle to the goal */
    iris_angle heading;   /* of the line where it is nearest to the robot, 0 straight ahead, right positive */
    int32_t steer_permil; /* what follows from it, before any limit: up to 100000 to either side */
} iris_pursuit_goal;

/* Sensible values, as given above. Null is ignored. O(1). */
void iris_pursuit_defaults(iris_pursuit_config *config);

/* Where to go for a line that was found. `side`: on which side the line goes on if it lies across, more than 60 degrees
 * from straight ahead: -1 left, 1 right, 0 unknown (the end that the follower calls the far one).
 *   line    of pictures that floor was made for; any values: at most IRIS_FOLLOW_SEGMENTS_MAX segments count
 *   config  null for the defaults
 * IRIS_ERR_ARG: null pointer, or a config value outside its range. O(segments): some 2500 instructions on a Cortex-M4
 * for each. */
iris_status iris_pursuit_find(iris_pursuit_goal *goal, const iris_floor *floor,
                              const iris_follow_result *line, int32_t side,
                              const iris_pursuit_config *config);

/* What is steered by. */
typedef struct {
    const iris_floor *floor;
    const iris_pursuit_config *config; /* null for the defaults */
} iris_pursuit;

/* iris_steer_update, and then iris_pursuit_find with the side of the bend that *steer remembers: if there is a goal,
 * its steering, within the limit of *steer, is the command's.
 * IRIS_ERR_ARG: null pointer (but for by->config), or a config value outside its range. O(segments). */
iris_status iris_pursuit_update(iris_command *command, iris_pursuit_goal *goal, iris_steer *steer,
                                const iris_follow_result *line, const iris_pursuit *by, int32_t elapsed_ms);

#ifdef __cplusplus
}
#endif

#endif
