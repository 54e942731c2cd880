/* A robot's behaviors that find their own way over the floor: go to a place, explore. */
#include <stdlib.h>

#include "robot_behaviors_parts.h"

#define PLAN_MS     300
#define LOOK_MM     250
#define AT_GOAL_MM  40
#define NEAR_MM     90    /* ahead: it turns away first */
#define AT_THING_MM 250   /* between its front and a goal that is a thing, at which it stands */
#define NEXT_TO_MM  500   /* or where another robot stands before it */
#define WAIT_MS     2000  /* that it tries to get nearer there */
#define GIVE_UP_MS  20000 /* no way, or none that leads on */

/* To a place on the way. What is right ahead is turned away from, to the freer side. */
static void drive_towards(robot_behaviors *b, iris_motion *motion, const osiris_pose *place, int32_t speed)
{
    const int32_t ahead = robot_free_mm(b->senses, 0, ROBOT_DEGREES(25));
    const int32_t bearing = robot_bearing(b, place->x_mm, place->y_mm);
    const int32_t slow = robot_stopping_mms(b, ahead - NEAR_MM / 2, 30, speed);
    robot_steer(b, motion, bearing, slow);
    if (ahead < NEAR_MM && abs(bearing) < ROBOT_DEGREES(45)) {
        const int32_t left = robot_free_mm(b->senses, ROBOT_DEGREES(50), ROBOT_DEGREES(40));
        const int32_t right = robot_free_mm(b->senses, -ROBOT_DEGREES(50), ROBOT_DEGREES(40));
        const int32_t rate = robot_within(ROBOT_DEGREES(60), 0, b->senses->plan->drive.turn_rate_max / 2);
        motion->turn_rate = left > right ? -rate : rate;
        motion->speed_mms = -speed / 4;
    }
}

/* It gets no farther: a few cm in GIVE_UP_MS. */
static int is_stuck(robot_behaviors *b, uint32_t now_ms)
{
    if (robot_distance(b, b->last.x_mm, b->last.y_mm) > 100) {
        b->last = b->senses->pose;
        b->blocked_ms = now_ms;
    }
    return now_ms - b->blocked_ms > GIVE_UP_MS;
}

/* At the place, or before the thing that stands there, or beside it as near as it gets. */
static int has_arrived(robot_behaviors *b, int32_t distance, uint32_t now_ms)
{
    const int32_t between = distance - robot_front_mm(b->senses);
    if (distance < b->nearest_mm - 10) {
        b->nearest_mm = distance;
        b->nearest_ms = now_ms;
    }
    const uint32_t waited_ms = now_ms - b->nearest_ms;
    return distance <= AT_GOAL_MM ||
           (between < AT_THING_MM ? waited_ms > WAIT_MS : between < NEXT_TO_MM && waited_ms > 3 * WAIT_MS) ||
           (between < AT_THING_MM && abs(robot_bearing(b, b->order.a, b->order.b)) < ROBOT_DEGREES(40) &&
            robot_free_mm(b->senses, 0, ROBOT_DEGREES(25)) < between + 30);
}

iris_status robot_step_go_to(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot_behaviors *b = context;
    const int32_t distance = robot_distance(b, b->order.a, b->order.b);
    osiris_pose place = {b->order.a, b->order.b, 0};
    if (has_arrived(b, distance, now_ms)) {
        robot_tell_reached(b, motion, event);
        return IRIS_OK;
    }
    if (is_stuck(b, now_ms)) {
        return IRIS_ERR_TIMEOUT;
    }
    if (robot_backs_off(b, motion, now_ms)) {
        return IRIS_OK;
    }
    if (!b->has_plan || now_ms - b->planned_ms >= PLAN_MS) {
        b->has_plan = (uint8_t)robot_floor_plan_to(&b->floor, b->senses, b->order.a, b->order.b);
        b->planned_ms = now_ms;
    }
    if (distance > LOOK_MM && b->has_plan && !robot_floor_ahead(&b->floor, &place, b->senses, LOOK_MM)) {
        motion->turn_rate = ROBOT_DEGREES(30); /* no way is known: it looks around */
        return IRIS_OK;
    }
    const int32_t speed = robot_stopping_mms(b, distance - AT_GOAL_MM / 2, 30, robot_cruise_mms(b->senses));
    drive_towards(b, motion, &place, speed);
    return IRIS_OK;
}

iris_status robot_step_explore(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot_behaviors *b = context;
    const int32_t speed = robot_speed(b, b->order.a);
    osiris_pose place;
    (void)event;
    if (robot_backs_off(b, motion, now_ms)) {
        return IRIS_OK;
    }
    if (!b->has_plan || now_ms - b->planned_ms >= PLAN_MS) {
        b->has_plan = (uint8_t)robot_floor_plan_unknown(&b->floor, b->senses);
        b->planned_ms = now_ms;
    }
    if (b->has_plan && robot_floor_ahead(&b->floor, &place, b->senses, LOOK_MM)) {
        drive_towards(b, motion, &place, speed);
        return IRIS_OK;
    }
    /* all that can be reached is known: on, and away from what is ahead */
    const osiris_pose on = {1000, 0, 0};
    place = osiris_pose_after(b->senses->pose, on);
    drive_towards(b, motion, &place, speed);
    return IRIS_OK;
}
