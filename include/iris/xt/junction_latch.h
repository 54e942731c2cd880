/* IRIS-XT - the latch: take the left branch, the right one, or go straight on, at the next junction.
 *
 * It stands between the follower and the steering. While a junction comes nearer that offers what was asked for, the
 * follower's result is changed into the line that leads through it: the way there, then the chosen branch as a bend
 * (steer.h turns there as at any sharp bend). Where the follower was on another line its offset changes little by
 * little, for steering answers to a jump. When the junction has passed below the image, every line but the branch is
 * hidden, so that the steering searches for it on its side. A line is the branch when its angle is nearer to that of
 * the branch, less what the robot has turned since, than to that of the line that goes on beside it; how far it has
 * turned is told by the junction and by either line while they are in sight, and by the time in between. When the
 * branch has been ahead, within 30 degrees, for three frames, or after four seconds, the latch lets go, and the next
 * turn counts. Between junctions, and without a turn to take, results stay as they are.
 *
 *     iris_follow_frame(&line, ...);  iris_line_mask(...);  iris_junctions_find(junctions, ...);
 *     iris_junction_latch_update(&line, &latch, junctions, count, elapsed_ms);
 *     iris_steer_update(&command, &steer, &line, elapsed_ms);
 *
 * A junction counts when it was seen in three frames in a row, about where it was or lower. One that does not offer the
 * turn (no branch 20 degrees or more to that side; none within 35 degrees of straight ahead) is left to the follower,
 * and the turn is kept for the next.
 */
#ifndef IRIS_XT_JUNCTION_LATCH_H
#define IRIS_XT_JUNCTION_LATCH_H

#include "iris/status.h"
#include "iris/xt/follow.h"
#include "iris/xt/junction.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_JUNCTION_TURNS_MAX 16

typedef enum { IRIS_TURN_STRAIGHT = 0, IRIS_TURN_LEFT, IRIS_TURN_RIGHT } iris_turn;

typedef enum {
    IRIS_LATCH_WAITS = 0, /* for a junction; without turns for ever */
    IRIS_LATCH_COMING,    /* one that offers the turn is in sight */
    IRIS_LATCH_TURNS,     /* it has passed below the image, and the branch is not straight ahead yet */
    IRIS_LATCH_DONE,      /* the branch is straight ahead; then it waits, if there are more turns */
    IRIS_LATCH_MISSED     /* it did not come in four seconds; the same */
} iris_latch_state;

/* An offset, and how much of its jumps is still to be told. */
typedef struct {
    int32_t told, behind;
} iris_junction_slide;

/* The fields are its own; state and turn may be read. */
typedef struct {
    iris_size size;
    iris_latch_state state;
    iris_turn turn;                           /* that the state is about */
    iris_turn turns[IRIS_JUNCTION_TURNS_MAX]; /* the next first */
    int32_t turn_count;
    int32_t hits, misses; /* frames in which the junction was seen in a row, and was not */
    int32_t x, y;         /* where, pixels */
    int32_t branch; /* the chosen one's angle; while turning what it was at first, to the side of the turn */
    int32_t gap;    /* from it to the next branch on the other side */
    int32_t since_ms;          /* in this state */
    int32_t turned, turned_ms; /* angle turned so far, as last seen, and when that was */
    int32_t sliding;           /* 1: the last frame had a line */
    iris_junction_slide near, ahead;
} iris_junction_latch;

/* Ready for frames of this size, without turns. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: a side outside
 * 8..IRIS_FOLLOW_SIDE_MAX. O(1). */
iris_status iris_junction_latch_init(iris_junction_latch *latch, iris_size size);

/* Turns to take at the next junctions, one each, behind those that are still to be taken.
 * IRIS_ERR_ARG: null pointer, a negative count, or an unknown turn; IRIS_ERR_FULL: more than IRIS_JUNCTION_TURNS_MAX in
 * all: none is taken. O(count). */
iris_status iris_junction_latch_take(iris_junction_latch *latch, const iris_turn *turns, int32_t count);

/* Changes the follower's result for this frame. junctions are those of iris_junctions_find, the nearest first.
 * elapsed_ms: since the last frame, limited to 0..60000.
 * IRIS_ERR_ARG: null pointer (junctions may be null when count is 0), or a negative count. O(count). */
iris_status iris_junction_latch_update(iris_follow_result *line, iris_junction_latch *latch,
                                       const iris_junction *junctions, int32_t count, int32_t elapsed_ms);

#ifdef __cplusplus
}
#endif

#endif
