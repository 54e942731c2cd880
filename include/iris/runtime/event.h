/* IRIS - events: what a robot's behaviors, and its runtime, tell back.
 */
#ifndef IRIS_RUNTIME_EVENT_H
#define IRIS_RUNTIME_EVENT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    IRIS_EVENT_NONE = 0,
    IRIS_EVENT_OBJECT_DETECTED, /* it is seen, at (x, y) */
    IRIS_EVENT_OBJECT_LOST,     /* it is no longer, and was at (x, y) last */
    IRIS_EVENT_REACHED,         /* an order that ends is done: the robot is at (x, y) */
    IRIS_EVENT_LINE_END,        /* the line ended at (x, y) */
    IRIS_EVENT_BUMPED,          /* it ran into something at (x, y) */
    IRIS_EVENT_BATTERY_LOW,     /* x: permil that are left */
    IRIS_EVENT_FAILED,          /* x: verb of the order that cannot be done, y: iris_status */
    IRIS_EVENT_STOPPED,         /* x: source of the STOP that was obeyed */
    IRIS_EVENT_EXPIRED          /* x: source, y: verb of the order whose lease was not renewed */
} iris_event_kind;

#define IRIS_EVENT_KINDS 10 /* with NONE */

/* Places are in millimeters on the floor, as osiris/pose.h has it; what is not used is 0. */
typedef struct {
    iris_event_kind kind;
    int32_t x, y;
} iris_event;

/* In small letters, such as "object lost". Null when there is no such kind; static storage. O(1). */
const char *iris_event_name(int32_t kind);

#ifdef __cplusplus
}
#endif

#endif
