/* Of robot_behaviors*.c: what several behaviors do. */
#ifndef IRIS_TOOL_ROBOT_BEHAVIORS_PARTS_H
#define IRIS_TOOL_ROBOT_BEHAVIORS_PARTS_H

#include "robot_behaviors.h"

#define ROBOT_DEGREES(degrees) ((int32_t)((degrees)*65536 / 360))

int32_t robot_within(int32_t value, int32_t least, int32_t most);

/* From where it heads to (x, y): positive to the left; and how far that is. */
int32_t robot_bearing(const robot_behaviors *b, int32_t x_mm, int32_t y_mm);
int32_t robot_distance(const robot_behaviors *b, int32_t x_mm, int32_t y_mm);

/* The speed from which it can stop in so many mm, at most `most`, at least `least` (0 where nothing is left). */
int32_t robot_stopping_mms(const robot_behaviors *b, int32_t left_mm, int32_t least, int32_t most);

/* Turns towards a bearing (positive: left), and drives the faster the less is to be turned. */
void robot_steer(const robot_behaviors *b, iris_motion *motion, int32_t bearing, int32_t speed_mms);

/* Drives to the robot's usual speed, or what the order names. */
int32_t robot_speed(const robot_behaviors *b, int32_t named_mms);

/* Backs off what it ran into. 1: it does. */
int robot_backs_off(robot_behaviors *b, iris_motion *motion, uint32_t now_ms);

iris_status robot_begin_driving(void *context, const iris_order *order, uint32_t now_ms);

/* The robot is where it was to be. */
void robot_tell_reached(const robot_behaviors *b, iris_motion *motion, iris_event *event);

iris_status robot_step_follow(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event);
iris_status robot_step_lock(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event);
iris_status robot_step_detect(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event);
iris_status robot_begin_detect(void *context, const iris_order *order, uint32_t now_ms);
iris_status robot_step_go_to(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event);
iris_status robot_step_explore(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event);

#endif
