/* IRIS - two driven wheels: from a steering command to the speed of each.
 *
 *     left  = speed + turn * steer * speed        turn: config.turn_permil / 1000
 *     right = speed - turn * steer * speed
 *
 * With turn 1 full steering stops the inner wheel, as steer.h has it; with more, that wheel runs backwards, and at 2 the robot
 * turns almost on the spot. Where the outer wheel would be faster than it can, both are slowed down alike: the robot drives
 * the same curve, slower.
 *
 * How a motor gets such a speed from two lines is in pwm.h.
 */
#ifndef IRIS_DIFFERENTIAL_H
#define IRIS_DIFFERENTIAL_H

#include <stdint.h>

#include "iris/command.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int32_t turn_permil;  /* 0..4000: see above; default 1000 */
    int32_t limit_permil; /* 0..1000: no wheel is faster, either way; default 1000 */
    int32_t
        least_permil; /* 0..limit_permil: a wheel that turns at all gets at least that, for motors that hum and stand
                             below it; default 0 */
} iris_differential_config;

typedef struct {
    int32_t left_permil, right_permil; /* -1000..1000 of full speed, forwards positive */
} iris_wheels;

/* The values above. Null is ignored. O(1). */
void iris_differential_defaults(iris_differential_config *config);

/* The speeds of both wheels for this command: 0 and 0 for one to stop (speed 0).
 *   config  null for the defaults
 * IRIS_ERR_ARG: null pointer, a config value outside its range, or steer or speed outside theirs; *wheels untouched. O(1):
 * at most two divisions for each wheel. */
iris_status iris_differential_mix(iris_wheels *wheels, const iris_command *command,
                                  const iris_differential_config *config);

#ifdef __cplusplus
}
#endif

#endif
