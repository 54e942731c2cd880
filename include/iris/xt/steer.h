/* IRIS-XT - steering: from where the line is to what the robot does.
 *
 * A proportional-derivative controller on the line's offset and angle, slower in curves, with a stated behavior when
 * the line is lost. One call per frame, in 32-bit integers; it knows nothing of the robot but its config, so that the
 * same command suits a steered axle (steer is the wheel angle) and two driven wheels (full steer stops the inner wheel:
 * left = speed + steer * speed, right = speed - steer * speed, which is up to twice the speed: the robot caps it).
 * Report, sections 2.3 and 2.4.
 *
 *     offset = bottom row's + share * (look-ahead row's - bottom row's)
 *     steer  = offset_gain * (offset + derivative_ms * rate) + angle_gain * angle     rate: low-passed d offset / dt
 *     speed  = cruise - (cruise - slow) * sharpness        sharpness: 1 at curve_permil, of the larger of the steering
 *                                                          and angle_gain * the steepest angle in sight
 *
 * Bend ahead (result.has_next, beyond 30 degrees): the robot slows down, and turns as soon as the part of the line in
 * front of the bend is shorter than bend_widths line widths; from there the angle is that of the next part. The bend's
 * side is remembered, so that a line straight across the image (90 or -90 degrees, which is the same line) is turned
 * into on that side, and a line that is lost at the bend is searched there.
 *
 * Not found: for hold_ms the last steering is kept, at slow speed (past a bend: full steer to its side); then the robot
 * searches, turning to the side where the line was last; at stop_ms it stops until the line is back. A robot that has
 * never seen a line stands still.
 *
 * The defaults drive the robot of tools/sim at 10 to 60 frames/s, with wheels 10 to 25 cm apart, half to twice its
 * speed, and its camera 14 to 30 cm high. A larger look-ahead share cuts corners more and forgives more delay.
 */
#ifndef IRIS_XT_STEER_H
#define IRIS_XT_STEER_H

#include "iris/command.h"
#include "iris/fixed.h"
#include "iris/status.h"
#include "iris/xt/follow.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int32_t offset_gain_permil;  /* 0..10000: steer for an offset of 1 (half the image width); default 700 */
    int32_t angle_gain_permil;   /* 0..10000: steer for an angle of 90 degrees; default 300 */
    int32_t lookahead_permil;    /* 0..1000: share of the look-ahead row in the offset; default 150 */
    int32_t derivative_ms;       /* 0..1000: how far ahead in time the offset's change counts; default 120 */
    int32_t filter_ms;           /* 0..1000: time constant that smooths that change; default 60 */
    int32_t bend_widths_permil;  /* 0..20000: see above, in permil of the line's width; default 1000 */
    int32_t limit_permil;        /* 0..1000: steer stays within -limit..limit; default 1000 */
    int32_t full_lock_centideg;  /* 0..9000: the wheel angle of steer 1000; default 4500 */
    int32_t cruise_permil;       /* 0..1000: speed on a straight line; default 600 */
    int32_t slow_permil;         /* 0..1000: speed in sharp curves, and while the line is held; default 250 */
    int32_t curve_permil;        /* 1..10000: the steering at which speed is down to slow; default 500 */
    int32_t hold_ms;             /* 0..60000: since the line was last found; default 200 */
    int32_t search_steer_permil; /* 0..1000: default 1000 */
    int32_t search_speed_permil; /* 0..1000: default 200 */
    int32_t stop_ms;             /* 0..60000: since the line was last found; default 3000 */
} iris_steer_config;

/* A controller. The fields are its own. */
typedef struct {
    iris_steer_config config;
    int32_t seq;        /* of the next command */
    int32_t seen;       /* 1 once a line was found */
    int32_t since_ms;   /* since the line was last found, at most 60000 */
    int32_t settled;    /* 1: offset_q16 is the last frame's, so that its change is known */
    int32_t offset_q16; /* of the last frame with a line */
    int32_t rate_q24;   /* smoothed change of the offset per ms */
    int32_t steer;      /* last steering with a line, permil */
    int32_t side;       /* where the line was last: -1 left, 1 right */
    int32_t bend;       /* side of a sharp bend that was announced and not yet passed: -1, 0, 1 */
} iris_steer;

/* The values above. Null is ignored. O(1). */
void iris_steer_defaults(iris_steer_config *config);

/* Makes *steer ready; config is copied, null means the defaults.
 * IRIS_ERR_ARG: steer is null, or a config value is outside its range. O(1). */
iris_status iris_steer_init(iris_steer *steer, const iris_steer_config *config);

/* The command for this frame: seq (0 at first, counts to 9999, and starts over), state, steer, speed, and the line's
 * angle, offset, and confidence as the sentence has them.
 *   line        any values: offsets count as at most 2 to either side, an unknown state as lost
 *   elapsed_ms  since the last update, limited to 0..60000. With 0 the offset's change is not known.
 * IRIS_ERR_ARG: null pointer. O(1): some ten 32-bit divisions, no 64-bit one. */
iris_status iris_steer_update(iris_command *command, iris_steer *steer, const iris_follow_result *line,
                              int32_t elapsed_ms);

/* A command's steering as a wheel angle in hundredths of a degree, positive right: steer_permil of full_lock_centideg.
 * 0 for a null pointer; steer_permil counts as at most 1000 to either side. O(1). */
int32_t iris_steer_wheel_centideg(const iris_steer *steer, const iris_command *command);

#ifdef __cplusplus
}
#endif

#endif
