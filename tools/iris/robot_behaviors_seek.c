/* A robot's behaviors that look for something: follow a line, lock on to an object, detect it. */
#include <stdlib.h>

#include "robot_behaviors_parts.h"

#define LINE_SEARCH_MS                                                                                       \
    1500 /* a line that was under it: so long it is looked for, ahead and on the side where it was */
#define LINE_ASIDE_MM  30 /* it left on this side, and did not end: it is looked for there */
#define LINE_ASIDE_MS  5000
#define LINE_FIND_MS   4000 /* and one that never was, ahead */
#define LOCK_SEARCH_MS 500
#define LOCK_NEAR_MM   200 /* between its front and the object */
#define DETECT_LOST_MS 1500

iris_status robot_step_follow(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot_behaviors *b = context;
    const int32_t speed = robot_speed(b, b->order.a);
    const int32_t most = b->senses->plan->drive.turn_rate_max / 2;
    int32_t offset = 0, angle = 0, ahead = 0;
    if (robot_backs_off(b, motion, now_ms)) {
        return IRIS_OK;
    }
    if (robot_sees_line(b->senses, &offset, &angle, &ahead)) {
        /* an arc through where the line is seen (pure pursuit, R. Wallace and others 1985), and half of its angle there:
         * w = v 2 y / (x^2 + y^2), 10430 angle units to a radian */
        const int32_t x = ahead > 50 ? ahead : 50;
        const int64_t square = (int64_t)x * x + (int64_t)offset * offset;
        const int64_t arc = (int64_t)speed * 2 * offset * 10430 / square;
        const int64_t along = (int64_t)speed * angle / (4 * x);
        motion->turn_rate = robot_within(iris_sat_s32(arc + along), -most, most);
        motion->speed_mms = speed - (int32_t)((int64_t)speed * abs(motion->turn_rate) / (2 * most));
        b->seen_ms = now_ms;
        b->has_seen = 1;
        b->side = offset < 0 ? -1 : 1;
        b->offset_mm = abs(offset);
        b->last = b->senses->pose;
        return IRIS_OK;
    }
    const uint32_t gone = now_ms - b->seen_ms;
    const int is_aside = b->has_seen && b->offset_mm > LINE_ASIDE_MM;
    if (gone >= (!b->has_seen ? LINE_FIND_MS : is_aside ? LINE_ASIDE_MS : LINE_SEARCH_MS)) {
        *event = (iris_event){IRIS_EVENT_LINE_END, b->last.x_mm, b->last.y_mm};
        motion->done = 1;
        return IRIS_OK;
    }
    motion->speed_mms = speed / 3;
    motion->turn_rate = is_aside || (b->has_seen && gone > LINE_SEARCH_MS / 4) ? b->side * most / 2 : 0;
    return IRIS_OK;
}

iris_status robot_step_lock(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot_behaviors *b = context;
    osiris_pose place;
    (void)event;
    if (robot_sees_object(b->senses, &place)) {
        const int32_t bearing = robot_bearing(b, place.x_mm, place.y_mm);
        const int32_t left =
            robot_distance(b, place.x_mm, place.y_mm) - robot_front_mm(b->senses) - LOCK_NEAR_MM;
        b->seen_ms = now_ms;
        b->side = bearing > 0 ? -1 : 1;
        robot_steer(b, motion, bearing, robot_stopping_mms(b, left, 0, robot_speed(b, b->order.a)));
        if (left < 0 && abs(bearing) < ROBOT_DEGREES(3)) {
            motion->turn_rate = 0;
        }
        return IRIS_OK;
    }
    if (now_ms - b->seen_ms > LOCK_SEARCH_MS) {
        motion->turn_rate =
            b->side * robot_within(ROBOT_DEGREES(45), 0, b->senses->plan->drive.turn_rate_max / 2);
    }
    return IRIS_OK;
}

iris_status robot_begin_detect(void *context, const iris_order *order, uint32_t now_ms)
{
    robot_behaviors *b = context;
    (void)order;
    b->sees = 0;
    b->looks = 0;
    b->look_ms = now_ms;
    return IRIS_OK;
}

/* Told when it is seen in three steps, one after the other, and when it has not been seen for a while. */
iris_status robot_step_detect(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot_behaviors *b = context;
    osiris_pose place;
    (void)motion;
    if (robot_sees_object(b->senses, &place)) {
        b->object = place;
        b->look_ms = now_ms;
        b->looks = (uint8_t)(b->looks < 3 ? b->looks + 1 : 3);
        if (b->looks == 3 && !b->sees) {
            b->sees = 1;
            *event = (iris_event){IRIS_EVENT_OBJECT_DETECTED, place.x_mm, place.y_mm};
        }
        return IRIS_OK;
    }
    b->looks = 0;
    if (b->sees && now_ms - b->look_ms > DETECT_LOST_MS) {
        b->sees = 0;
        *event = (iris_event){IRIS_EVENT_OBJECT_LOST, b->object.x_mm, b->object.y_mm};
    }
    return IRIS_OK;
}
