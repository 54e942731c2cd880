/* IRIS-XT - line following: where is the line, and where does it go?
 *
 * Finds a dark, bright, or colored line on the floor, in whole images or in rows as they arrive from the sensor, with a
 * few rows of working memory and no frame buffer. Rows come top first, which is far first for a forward-looking camera.
 * Three calls drive a robot (examples/follow.c): iris_follow_init, iris_follow_frame, iris_steer_update.
 *
 * Directions: an angle is 0 when the line runs straight ahead (up the image) and positive when it leans right, -90 to
 * 90 degrees. Offsets are (center - (w - 1) / 2) / (w / 2): 0 in the middle, -1 and 1 at the sides, positive right.
 * Report, sections 2.3 and 2.4.
 */
#ifndef IRIS_XT_FOLLOW_H
#define IRIS_XT_FOLLOW_H

#include "iris/command.h"
#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_FOLLOW_SEGMENTS_MAX 8

typedef struct {
    int32_t x0, y0, x1, y1; /* pixels; (x0, y0) is the end nearer to the robot */
} iris_segment;

/* First and last column of the line in a row, inclusive; left > right when the row has none. With `lane`: the columns
 * between the two lines. */
typedef struct {
    int16_t left, right;
} iris_span;

typedef struct {
    iris_line_state  state;             /* everything below is zero when IRIS_LINE_LOST */
    int32_t          has_next;          /* 1: the line bends sharply, next_angle is the direction behind the bend */
    iris_angle       angle;             /* of the line at the robot */
    iris_angle       next_angle;        /* of the next straight part */
    iris_q16         offset_q16;        /* at the bottom row */
    iris_q16         lookahead_offset_q16; /* at the look-ahead row */
    int32_t          width_px;          /* of the line (or of the lane), median over its rows */
    int32_t          confidence_permil; /* 0..1000 */
    int32_t          segment_count;
    iris_segment     segments[IRIS_FOLLOW_SEGMENTS_MAX]; /* near to far */
    const iris_span *rows;              /* one per image row, in the follower's memory until the next frame begins;
                                           null when stale or lost */
} iris_follow_result;

#ifdef __cplusplus
}
#endif

#endif
