/* IRIS - the signals of BorgCode: what machines react to and tell each other (the report's section 6.2.3).
 */
#ifndef IRIS_BORG_SIGNAL_H
#define IRIS_BORG_SIGNAL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    BORG_START = 0,        /* the mission begins, or begins anew */
    BORG_OBJ_DETECT_TRUE,  /* the object is seen, at (x, y) */
    BORG_OBJ_DETECT_FALSE, /* it is lost: OBJ_DETECT_TRUE holds no longer */
    BORG_TIME_OUT,         /* the chunk's seconds since ResetTime have passed: each machine's own */
    BORG_REACHED,          /* where Go went */
    BORG_VOTE_WIN,         /* this machine is one of the k that were chosen */
    BORG_VOTE_LOST,
    BORG_STOPPED,
    BORG_LINE_END,
    BORG_BUMPED,
    BORG_BATTERY_LOW
} borg_signal_kind;

#define BORG_SIGNAL_KINDS 11

/* x and y: of a target, in millimeters in the frame of the robots' poses; 0 where there is none. */
typedef struct {
    uint8_t kind; /* borg_signal_kind */
    uint8_t unit; /* which machine of its group, from 1 */
    uint16_t ref; /* line of the group that it comes from; 0: the machine's own */
    int32_t x, y;
} borg_signal;

/* As it is written: "OBJ_DETECT_TRUE". Null when there is no such kind. Static storage; O(1). */
const char *borg_signal_name(int32_t kind);

/* The kind of a name of `length` letters, in any case; OBJ_DET_TRUE, OBJ_DET_FALSE, and TIME_OUT_TRUE are read, too.
 * -1 when no signal is called so, or name is null. O(kinds). */
int32_t borg_signal_find(const char *name, size_t length);

#ifdef __cplusplus
}
#endif

#endif
