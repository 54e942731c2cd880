/* What a robot can do: a behavior for each verb of an order, from what its sensors say to a speed and a turn rate. The same
 * for any drive and any set of devices. Integers only: the same readings give the same motion, bit for bit.
 *
 *     senses take readings; robot_behaviors_sense; iris_runtime_step with behaviors->table
 */
#ifndef IRIS_TOOL_ROBOT_BEHAVIORS_H
#define IRIS_TOOL_ROBOT_BEHAVIORS_H

#include "iris/runtime/runtime.h"
#include "robot_floor.h"

/* Read table and floor and is_mapping; the rest belongs to the functions. */
typedef struct {
    iris_behavior table[IRIS_ORDER_VERBS];
    robot_floor floor;
    uint8_t is_mapping; /* MAP was ordered */

    robot_senses *senses;
    iris_order order; /* the one that drives */
    osiris_pose begun, last;
    int32_t turned;                                     /* angle units since it began */
    uint32_t begun_ms, seen_ms, planned_ms, blocked_ms; /* seen: the line, or the object locked on to */
    uint32_t back_until_ms, turn_until_ms, look_ms, nearest_ms;
    int32_t nearest_mm; /* that it has been to the goal, at nearest_ms */
    int32_t away;       /* to which side it turns from what it ran into: -1 left, 1 right */
    int32_t offset_mm;  /* of the line, when it was seen last */
    int32_t side;       /* on which the line, or the object, was last: -1 left, 1 right */
    uint8_t has_seen, has_plan;
    uint8_t sees, looks; /* DETECT */
    osiris_pose object;
} robot_behaviors;

/* The senses must outlive them. */
void robot_behaviors_init(robot_behaviors *behaviors, robot_senses *senses);

/* After new readings, before each step. */
void robot_behaviors_sense(robot_behaviors *behaviors);

#endif
