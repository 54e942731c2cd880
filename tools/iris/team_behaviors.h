/* What the robots of a simulated team can do, on any drive: speeds and turn rates from what their sensors say.
 */
#ifndef IRIS_TOOL_TEAM_BEHAVIORS_H
#define IRIS_TOOL_TEAM_BEHAVIORS_H

#include "iris/osiris/pose.h"
#include "iris/runtime/runtime.h"

/* What a robot knows at this moment. Distances are mm; TEAM_FAR_MM where nothing is near. */
#define TEAM_FAR_MM 100000

typedef struct {
    osiris_pose pose;
    int32_t ahead_mm, left_mm,
        right_mm;                     /* of the nearest thing in these directions, from the reference point */
    int32_t has_line, line_offset_mm; /* to the right, */
    int32_t line_ahead_mm;            /* there */
    iris_angle line_angle;            /* positive when it leans right */
    int32_t has_object;               /* seen now, on the floor: */
    int32_t object_x_mm, object_y_mm;
    int32_t radius_mm;     /* from the reference point to the body's front */
    int32_t speed_mms;     /* that is usual */
    int32_t turn_rate_max; /* angle units a second */
} team_senses;

typedef struct {
    const team_senses *senses;
    uint32_t random;
    iris_order order; /* the one that drives */
    osiris_pose begun;
    uint32_t line_ms, object_ms, away_until_ms, last_ms;
    double nearest;    /* to the target, at nearest_ms */
    osiris_pose moved; /* where it was at moved_ms, a little away from here */
    uint32_t nearest_ms, moved_ms, swing_ms, avoid_ms;
    int32_t swing;           /* 1: ahead, -1: back */
    int32_t turned, turning; /* of a turn; to which side it avoids: -1, 1, 0: none */
    int32_t sees;
    iris_behavior table[IRIS_ORDER_VERBS];
} team_behaviors;

/* senses must outlive them. */
void team_behaviors_init(team_behaviors *behaviors, const team_senses *senses, uint32_t seed);

#endif
