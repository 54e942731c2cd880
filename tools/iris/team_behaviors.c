#include "team_behaviors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LINE_LOST_MS   700
#define OBJECT_LOST_MS 1500
#define LOOK_MS        300 /* nothing seen for so long in between is no loss */
#define NEAR_MM        350 /* in front of the body: from here on something ahead is avoided */
#define CLEAR_MM       600
#define AVOID_MS       600 /* it turns away for at least so long */
#define SWING_MS       1200
#define SWING_MM       100
#define MOVED_MM       20
#define WIDE           9102 /* 50 degrees */
#define AROUND_MS      1800 /* so long it drives on past what was in the way */
#define REACHED_MM     100
#define AT_TARGET_MM                                                                                         \
    400 /* so near, what stands ahead is the target itself, or a robot that is there before */
#define TOUCH_MM      60   /* and this near it is reached */
#define STUCK_MS      1000 /* or when it gets no nearer for so long */
#define ANGLE_PER_RAD (65536 / (2 * 3.14159265358979323846))

static int32_t limited(double value, int32_t most)
{
    return (int32_t)lround(value > most ? most : value < -most ? -most : value);
}

static iris_status begin_driving(void *context, const iris_order *order, uint32_t now_ms)
{
    team_behaviors *b = context;
    b->order = *order;
    b->begun = b->senses->pose;
    b->line_ms = b->last_ms = b->away_until_ms = b->nearest_ms = now_ms;
    b->moved_ms = b->swing_ms = now_ms;
    b->moved = b->senses->pose;
    b->swing = 1;
    b->nearest = 1e9;
    b->turned = b->turning = 0;
    return IRIS_OK;
}

/* --- ways --- */

static double way(const team_behaviors *b)
{
    return hypot(b->senses->pose.x_mm - b->begun.x_mm, b->senses->pose.y_mm - b->begun.y_mm);
}

static void tell_reached(const team_behaviors *b, iris_motion *motion, iris_event *event)
{
    *event = (iris_event){IRIS_EVENT_REACHED, b->senses->pose.x_mm, b->senses->pose.y_mm};
    *motion = (iris_motion){0, 0, 1};
}

static iris_status step_go(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    const team_behaviors *b = context;
    const int32_t speed = b->order.b ? b->order.b : b->senses->speed_mms;
    (void)now_ms;
    motion->speed_mms = b->order.a < 0 ? -speed : speed;
    if (way(b) >= abs(b->order.a)) {
        tell_reached(b, motion, event);
    }
    return IRIS_OK;
}

static iris_status step_turn(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    team_behaviors *b = context;
    (void)now_ms;
    b->turned += (int16_t)(b->begun.heading - b->senses->pose.heading); /* to the right */
    b->begun.heading = b->senses->pose.heading;
    const int32_t left = b->order.a - b->turned;
    motion->turn_rate = limited(4.0 * left, b->senses->turn_rate_max / 2);
    if (abs(left) < 400) {
        tell_reached(b, motion, event);
    }
    return IRIS_OK;
}

/* --- the line --- */

static iris_status step_line(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    team_behaviors *b = context;
    const team_senses *s = b->senses;
    const int32_t speed = b->order.a ? b->order.a : s->speed_mms;
    if (s->has_line) {
        b->line_ms = now_ms;
        motion->speed_mms = speed;
        /* the arc to where the line is seen (pure pursuit, R. Wallace and others 1985), and some of its angle there */
        const double x = s->line_ahead_mm > 60 ? s->line_ahead_mm : 60, y = s->line_offset_mm;
        motion->turn_rate = limited(
            speed * (2 * y * ANGLE_PER_RAD / (x * x + y * y) + 0.25 * s->line_angle / x), s->turn_rate_max);
    } else if (now_ms - b->line_ms > LINE_LOST_MS) {
        *event = (iris_event){IRIS_EVENT_LINE_END, s->pose.x_mm, s->pose.y_mm};
        motion->done = 1;
    } else {
        motion->speed_mms = speed / 2;
    }
    return IRIS_OK;
}

/* --- around what is in the way --- */

/* It is told to drive, and something that it does not see holds it. */
static int is_stuck(team_behaviors *b, uint32_t now_ms)
{
    const osiris_pose *pose = &b->senses->pose;
    if (hypot(pose->x_mm - b->moved.x_mm, pose->y_mm - b->moved.y_mm) > MOVED_MM) {
        b->moved = *pose;
        b->moved_ms = now_ms;
    }
    return now_ms - b->moved_ms > STUCK_MS;
}

/* Turns to a side (1: right, -1: left) by swinging ahead and back, as drives do that cannot turn where they stand. */
static void swing(team_behaviors *b, iris_motion *motion, int32_t side, uint32_t now_ms)
{
    const team_senses *s = b->senses;
    const int ends =
        now_ms - b->swing_ms > SWING_MS || (now_ms - b->swing_ms > STUCK_MS && is_stuck(b, now_ms));
    const int blocked = s->ahead_mm < s->radius_mm + SWING_MM;
    if (b->swing > 0 ? ends || blocked : ends && !blocked) {
        b->swing = -b->swing;
        b->swing_ms = b->moved_ms = now_ms;
    }
    motion->speed_mms = b->swing * s->speed_mms / 3;
    motion->turn_rate = side * s->turn_rate_max / 3;
}

/* Turns away from what is ahead, to the side with more room, until the way is free. 1 while it does. */
static int avoids(team_behaviors *b, iris_motion *motion, int32_t near_mm, uint32_t now_ms)
{
    const team_senses *s = b->senses;
    const int stuck = is_stuck(b, now_ms);
    if (b->turning == 0 && (s->ahead_mm < s->radius_mm + near_mm || stuck)) {
        b->turning = s->right_mm >= s->left_mm ? 1 : -1;
        b->swing = -1;
        b->swing_ms = b->avoid_ms = b->moved_ms = now_ms;
    }
    if (b->turning != 0 && s->ahead_mm >= s->radius_mm + CLEAR_MM && now_ms - b->avoid_ms > AVOID_MS) {
        b->turning = 0;
        b->moved_ms = now_ms;
    }
    if (b->turning != 0) {
        swing(b, motion, b->turning, now_ms);
    }
    return b->turning != 0;
}

static int32_t drawn(team_behaviors *b, int32_t most)
{
    b->random = b->random * 1664525u + 1013904223u;
    return (int32_t)((b->random >> 8) % (uint32_t)(2 * most + 1)) - most;
}

static iris_status step_explore(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    team_behaviors *b = context;
    const team_senses *s = b->senses;
    (void)event;
    if (!avoids(b, motion, NEAR_MM, now_ms)) {
        if (now_ms - b->last_ms >= 2000) { /* a new bend from time to time */
            b->last_ms = now_ms;
            b->turned = drawn(b, s->turn_rate_max / 10);
        }
        motion->speed_mms = b->order.a ? b->order.a : s->speed_mms;
        motion->turn_rate = s->left_mm < s->radius_mm + NEAR_MM    ? s->turn_rate_max / 8
                            : s->right_mm < s->radius_mm + NEAR_MM ? -s->turn_rate_max / 8
                                                                   : b->turned;
    }
    return IRIS_OK;
}

static iris_status step_go_to(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    team_behaviors *b = context;
    const team_senses *s = b->senses;
    const double dx = b->order.a - s->pose.x_mm, dy = b->order.b - s->pose.y_mm, distance = hypot(dx, dy);
    const int16_t off = (int16_t)(s->pose.heading - (int16_t)lround(atan2(dy, dx) * ANGLE_PER_RAD));
    const int at_target = distance < s->radius_mm + AT_TARGET_MM;
    if (distance < b->nearest - 10) {
        b->nearest = distance;
        b->nearest_ms = now_ms;
    }
    if (distance < REACHED_MM || (at_target && s->ahead_mm < s->radius_mm + TOUCH_MM) ||
        (at_target && now_ms - b->nearest_ms > STUCK_MS)) {
        tell_reached(b, motion, event);
        return IRIS_OK;
    }
    if (!at_target && avoids(b, motion, NEAR_MM, now_ms)) {
        b->away_until_ms = now_ms + AROUND_MS;
        return IRIS_OK;
    }
    if ((int32_t)(b->away_until_ms - now_ms) > 0) {
        motion->speed_mms = s->speed_mms;
    } else if (abs(off) > WIDE) {
        swing(b, motion, off > 0 ? 1 : -1, now_ms);
    } else {
        motion->speed_mms = limited(2 * distance + 40, s->speed_mms);
        motion->turn_rate = limited(2.0 * off, s->turn_rate_max / 2);
    }
    return IRIS_OK;
}

/* --- what attends --- */

static iris_status begin_detecting(void *context, const iris_order *order, uint32_t now_ms)
{
    team_behaviors *b = context;
    (void)order;
    b->sees = 0;
    b->object_ms = now_ms;
    return IRIS_OK;
}

static iris_status step_detect(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    team_behaviors *b = context;
    const team_senses *s = b->senses;
    (void)motion;
    if (s->has_object) {
        b->object_ms = now_ms;
        if (!b->sees) {
            *event = (iris_event){IRIS_EVENT_OBJECT_DETECTED, s->object_x_mm, s->object_y_mm};
        }
        b->sees = 1;
    } else if (b->sees && now_ms - b->object_ms > OBJECT_LOST_MS) {
        b->sees = 0;
        event->kind = IRIS_EVENT_OBJECT_LOST;
    }
    return IRIS_OK;
}

static iris_status step_map(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    (void)context, (void)now_ms, (void)motion, (void)event;
    return IRIS_OK;
}

void team_behaviors_init(team_behaviors *b, const team_senses *senses, uint32_t seed)
{
    memset(b, 0, sizeof *b);
    b->senses = senses;
    b->random = seed;
    b->table[IRIS_ORDER_GO] = (iris_behavior){begin_driving, step_go, b};
    b->table[IRIS_ORDER_TURN] = (iris_behavior){begin_driving, step_turn, b};
    b->table[IRIS_ORDER_FOLLOW_LINE] = (iris_behavior){begin_driving, step_line, b};
    b->table[IRIS_ORDER_GO_TO] = (iris_behavior){begin_driving, step_go_to, b};
    b->table[IRIS_ORDER_EXPLORE] = (iris_behavior){begin_driving, step_explore, b};
    b->table[IRIS_ORDER_MAP] = (iris_behavior){begin_detecting, step_map, b};
    b->table[IRIS_ORDER_DETECT] = (iris_behavior){begin_detecting, step_detect, b};
}
