/* IRIS - orders: the few things that a robot is told to do, whoever tells it (the report's section 6.2.2).
 *
 * A person at a console, a stream of a gamepad, a program, a chunk of BorgCode, and a recorded session give the same orders.
 * What drives takes turns; what attends (MAP, DETECT) goes on beside it.
 *
 *     verb          a                            b                     as text
 *     STOP          -                            -                     stop
 *     GO            mm ahead, negative: back     mm/s, 0: its own      go 500        go 500 200
 *     TURN          angle units, right positive  -                     turn 90       turn -12.5
 *     DRIVE         mm/s, negative: back         angle units/s, right  drive 200 30
 *     FOLLOW_LINE   mm/s, 0: its own             -                     follow        follow 300
 *     LOCK_ON       mm/s, 0: its own             -                     lock
 *     GO_TO         x mm                         y mm                  goto 1200 -300
 *     EXPLORE       mm/s, 0: its own             -                     explore
 *     MAP           -                            -                     map
 *     DETECT        -                            -                     detect
 *     RESET_TIME    -                            -                     reset
 *
 * An angle unit is 1/65536 of a turn; texts have degrees, with up to three places behind a point, by which every angle is read
 * again as it was. Places are on the floor, as osiris/pose.h has it. What is not used is 0.
 */
#ifndef IRIS_RUNTIME_ORDER_H
#define IRIS_RUNTIME_ORDER_H

#include <stddef.h>
#include <stdint.h>

#include "iris/command.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_ORDER_PLACE_MAX_MM  10000000 /* of ways and places, either side of 0 */
#define IRIS_ORDER_SPEED_MAX_MMS 16000
#define IRIS_ORDER_ANGLE_MAX     6553600 /* 100 turns, either side of 0 */
#define IRIS_ORDER_TURN_RATE_MAX 1048576 /* 16 turns a second, either side of 0 */
#define IRIS_ORDER_TEXT_BYTES    48      /* room for any order's text with a 0 */

typedef enum {
    IRIS_ORDER_NONE = 0,
    IRIS_ORDER_STOP,
    IRIS_ORDER_GO,
    IRIS_ORDER_TURN,
    IRIS_ORDER_DRIVE,
    IRIS_ORDER_FOLLOW_LINE,
    IRIS_ORDER_LOCK_ON,
    IRIS_ORDER_GO_TO,
    IRIS_ORDER_EXPLORE,
    IRIS_ORDER_MAP,
    IRIS_ORDER_DETECT,
    IRIS_ORDER_RESET_TIME
} iris_order_verb;

#define IRIS_ORDER_VERBS 12 /* with NONE */

typedef struct {
    iris_order_verb verb;
    int32_t a, b;
} iris_order;

/* MAP and DETECT. O(1). */
static inline int iris_order_attends(iris_order_verb verb)
{
    return verb == IRIS_ORDER_MAP || verb == IRIS_ORDER_DETECT;
}

/* GO, TURN, and GO_TO come to an end by themselves; what else drives goes on until something else is to be done. O(1). */
static inline int iris_order_ends(iris_order_verb verb)
{
    return verb == IRIS_ORDER_GO || verb == IRIS_ORDER_TURN || verb == IRIS_ORDER_GO_TO;
}

/* IRIS_ERR_ARG: null pointer, or no such verb (NONE is none); IRIS_ERR_RANGE: a or b outside its range, or not 0 where it is not
 * used. O(1). */
iris_status iris_order_check(const iris_order *order);

/* The verb as it is written, "goto". Null when there is no such verb; static storage. O(1). */
const char *iris_order_name(int32_t verb);

/* Writes an order as text with a 0 behind it, IRIS_ORDER_TEXT_BYTES at most, and its length without the 0 to *length.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: capacity; others as iris_order_check. O(length). */
iris_status iris_order_write(char *text, size_t capacity, size_t *length, const iris_order *order);

/* Reads one line of `length` bytes, in capital or small letters, with spaces wherever, and a comment behind a #; a line
 * break at its end is no part of it. *column, from 1, is where what is wrong begins, and 0 when nothing is.
 * IRIS_ERR_END: there is nothing in this line; IRIS_ERR_DATA: no order, or something behind it; IRIS_ERR_RANGE: a number outside
 * its range; IRIS_ERR_ARG: null pointer. *order is written with IRIS_OK only, and *column but for null pointers. O(length). */
iris_status iris_order_read(iris_order *order, int32_t *column, const char *text, size_t length);

/* A command sentence's content as an order: DRIVE, with speed_permil of speed_max, and at full steering turn_rate_max at full
 * speed, less as it is slower: the curve stays the same.
 *   speed_max_mms  1..IRIS_ORDER_SPEED_MAX_MMS
 *   turn_rate_max  0..IRIS_ORDER_TURN_RATE_MAX
 * IRIS_ERR_ARG: null pointer, or a steering or speed outside iris_command's range; IRIS_ERR_RANGE: the maxima; *order untouched.
 * O(1). */
iris_status iris_order_of_command(iris_order *order, const iris_command *command, int32_t speed_max_mms,
                                  int32_t turn_rate_max);

#ifdef __cplusplus
}
#endif

#endif
