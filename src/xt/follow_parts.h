/* The follower's parts, in the order a frame passes them. Only follow*.c include this. */
#ifndef IRIS_FOLLOW_PARTS_H
#define IRIS_FOLLOW_PARTS_H

#include "../foundation/kernel.h"
#include "iris/xt/follow.h"
#include "iris/xt/regress.h"

/* Runs in successive rows that overlap: a piece of line, or of anything else that is dark. 32 bytes. */
typedef struct iris_follow_chain {
    iris_span top, bottom; /* its runs in the rows top_y and bottom_y */
    int16_t top_y, bottom_y;
    int16_t rows;                    /* rows with a run */
    int16_t widest;                  /* run, pixels */
    int32_t area;                    /* pixels in all runs */
    int32_t contrast_sum, range_sum; /* one sample per row: how far from the floor, of how far it could be */
    int16_t next;                    /* chain that continues it towards the robot, or -1 */
    int16_t used;                    /* 1: it belongs to a line that was chosen before */
} iris_follow_chain;

/* follow_floor.c: from pixels to line bits, by brightness against the floor. */
void iris_follow_mark_floor(iris_follow *follow, const uint8_t *gray);

/* follow_color.c: from pixels to line bits, by color. */
void iris_follow_mark_color(iris_follow *follow, const uint8_t *rgb);

/* follow_runs.c: from line bits to runs, and from runs to chains. gray is null when lines are told by color. */
void iris_follow_collect(iris_follow *follow, const uint8_t *gray);

/* follow_choose.c: which chains are the line. Puts chains that continue each other together and marks the best of these as
 * used: the farthest chain, then .next towards the robot. Returns the farthest chain's number, or -1 when no line is left. */
int32_t iris_follow_choose(iris_follow *follow);

/* follow_shape.c: from the chosen chains to the result: one line, or (other >= 0) the lane between two. Returns 0 when two
 * lines have no row between them. */
int iris_follow_describe(iris_follow_result *result, iris_follow *follow, int32_t line, int32_t other);

#endif
