#include "robot_behaviors_parts.h"

#include <stdlib.h>
#include <string.h>

#define BLOCKED_MM  60   /* nearer than this ahead: it does not drive on */
#define PATIENCE_MS 5000 /* that it waits for what is in the way */
#define BACK_MS     700

int32_t robot_within(int32_t value, int32_t least, int32_t most)
{
    return value < least ? least : value > most ? most : value;
}

int32_t robot_bearing(const robot_behaviors *b, int32_t x_mm, int32_t y_mm)
{
    const osiris_pose there = {x_mm, y_mm, 0};
    const osiris_pose step = osiris_pose_step(b->senses->pose, there);
    return iris_atan2_angle(step.y_mm, step.x_mm);
}

int32_t robot_distance(const robot_behaviors *b, int32_t x_mm, int32_t y_mm)
{
    const osiris_pose there = {x_mm, y_mm, 0};
    const osiris_pose step = osiris_pose_step(b->senses->pose, there);
    return iris_sat_s32(iris_hypot(step.x_mm, step.y_mm));
}

int32_t robot_stopping_mms(const robot_behaviors *b, int32_t left_mm, int32_t least, int32_t most)
{
    if (left_mm <= 0) {
        return 0;
    }
    const uint64_t square = (uint64_t)b->senses->plan->drive.acceleration_mms2 * (uint64_t)left_mm;
    return robot_within((int32_t)iris_sqrt_u64(square), least < most ? least : most, most);
}

void robot_steer(const robot_behaviors *b, iris_motion *motion, int32_t bearing, int32_t speed_mms)
{
    const osiris_drive_config *drive = &b->senses->plan->drive;
    const int32_t most = drive->turn_rate_max / 2, off = abs(bearing);
    motion->turn_rate = robot_within(-2 * bearing, -most, most);
    const int32_t wide = ROBOT_DEGREES(60);
    motion->speed_mms = off < wide ? (int32_t)((int64_t)speed_mms * (wide - off) / wide) : 0;
}

int32_t robot_speed(const robot_behaviors *b, int32_t named_mms)
{
    return named_mms > 0 ? named_mms : robot_cruise_mms(b->senses);
}

int robot_backs_off(robot_behaviors *b, iris_motion *motion, uint32_t now_ms)
{
    const int32_t quarter = ROBOT_DEGREES(90);
    if (robot_is_bumped(b->senses) && (int32_t)(b->back_until_ms - now_ms) <= 0) {
        const int32_t left = robot_free_mm(b->senses, quarter / 2, quarter / 2);
        const int32_t right = robot_free_mm(b->senses, -quarter / 2, quarter / 2);
        b->away = left == right ? -b->away : left > right ? -1 : 1;
        b->back_until_ms = now_ms + BACK_MS;
        b->turn_until_ms = b->back_until_ms + BACK_MS;
        b->has_plan = 0;
        robot_floor_bump(&b->floor, b->senses);
    }
    if ((int32_t)(b->back_until_ms - now_ms) > 0) {
        motion->speed_mms = -robot_cruise_mms(b->senses) / 2;
        return 1;
    }
    if ((int32_t)(b->turn_until_ms - now_ms) > 0) {
        motion->turn_rate =
            b->away * robot_within(ROBOT_DEGREES(60), 0, b->senses->plan->drive.turn_rate_max / 2);
        return 1;
    }
    return 0;
}

iris_status robot_begin_driving(void *context, const iris_order *order, uint32_t now_ms)
{
    robot_behaviors *b = context;
    b->order = *order;
    b->begun = b->last = b->senses->pose;
    b->turned = 0;
    b->begun_ms = b->seen_ms = b->blocked_ms = b->back_until_ms = b->turn_until_ms = now_ms;
    b->has_seen = b->has_plan = 0;
    b->nearest_ms = now_ms;
    b->nearest_mm = INT32_MAX;
    b->side = b->away = 1;
    return IRIS_OK;
}

void robot_tell_reached(const robot_behaviors *b, iris_motion *motion, iris_event *event)
{
    *event = (iris_event){IRIS_EVENT_REACHED, b->senses->pose.x_mm, b->senses->pose.y_mm};
    motion->done = 1;
}

/* So many mm ahead, or back, on the line on which it stands. */
static iris_status step_go(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot_behaviors *b = context;
    const osiris_pose done = osiris_pose_step(b->begun, b->senses->pose);
    const int32_t back = b->order.a < 0;
    const int32_t left = back ? done.x_mm - b->order.a : b->order.a - done.x_mm;
    if (left <= 2) {
        robot_tell_reached(b, motion, event);
        return IRIS_OK;
    }
    const int32_t most = robot_speed(b, b->order.b);
    const int32_t free_mm = robot_free_mm(b->senses, back ? -32768 : 0, ROBOT_DEGREES(25));
    if (free_mm < BLOCKED_MM || robot_is_bumped(b->senses)) {
        return now_ms - b->blocked_ms > PATIENCE_MS ? IRIS_ERR_TIMEOUT : IRIS_OK;
    }
    b->blocked_ms = now_ms;
    const int32_t speed =
        robot_stopping_mms(b, left < free_mm - BLOCKED_MM ? left : free_mm - BLOCKED_MM, 15, most);
    motion->speed_mms = back ? -speed : speed;
    /* back to the line: a tenth of a degree for each mm beside it, at most 20 degrees */
    const int32_t aside = robot_within(done.y_mm * 18, -ROBOT_DEGREES(20), ROBOT_DEGREES(20));
    const int32_t wrong =
        iris_angle_wrap(b->senses->pose.heading - b->begun.heading) + (back ? -aside : aside);
    motion->turn_rate = 2 * robot_within(wrong, -ROBOT_DEGREES(20), ROBOT_DEGREES(20));
    return IRIS_OK;
}

static iris_status step_turn(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot_behaviors *b = context;
    const osiris_drive_config *drive = &b->senses->plan->drive;
    b->turned += iris_angle_wrap(b->last.heading - b->senses->pose.heading);
    b->last = b->senses->pose;
    const int32_t left = b->order.a - b->turned;
    const int32_t most = drive->turn_rate_max / 2;
    if (abs(left) <= ROBOT_DEGREES(1)) {
        robot_tell_reached(b, motion, event);
        return IRIS_OK;
    }
    const int32_t ramp = drive->kind == OSIRIS_ACKERMANN ? ROBOT_DEGREES(90) : drive->turn_acceleration;
    const int32_t rate = (int32_t)iris_sqrt_u64((uint64_t)ramp * (uint64_t)abs(left));
    const int32_t kept = robot_within(rate, robot_within(ROBOT_DEGREES(8), 1, most), most);
    motion->turn_rate = left < 0 ? -kept : kept;
    (void)now_ms;
    return IRIS_OK;
}

static iris_status begin_map(void *context, const iris_order *order, uint32_t now_ms)
{
    (void)order;
    (void)now_ms;
    ((robot_behaviors *)context)->is_mapping = 1;
    return IRIS_OK;
}

/* The floor is kept anyway, for the ways over it. */
static iris_status step_map(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    (void)context;
    (void)now_ms;
    (void)motion;
    (void)event;
    return IRIS_OK;
}

void robot_behaviors_init(robot_behaviors *b, robot_senses *senses)
{
    memset(b, 0, sizeof *b);
    b->senses = senses;
    robot_floor_init(&b->floor, senses->pose);
    b->table[IRIS_ORDER_GO] = (iris_behavior){robot_begin_driving, step_go, b};
    b->table[IRIS_ORDER_TURN] = (iris_behavior){robot_begin_driving, step_turn, b};
    b->table[IRIS_ORDER_FOLLOW_LINE] = (iris_behavior){robot_begin_driving, robot_step_follow, b};
    b->table[IRIS_ORDER_LOCK_ON] = (iris_behavior){robot_begin_driving, robot_step_lock, b};
    b->table[IRIS_ORDER_GO_TO] = (iris_behavior){robot_begin_driving, robot_step_go_to, b};
    b->table[IRIS_ORDER_EXPLORE] = (iris_behavior){robot_begin_driving, robot_step_explore, b};
    b->table[IRIS_ORDER_MAP] = (iris_behavior){begin_map, step_map, b};
    b->table[IRIS_ORDER_DETECT] = (iris_behavior){robot_begin_detect, robot_step_detect, b};
}

void robot_behaviors_sense(robot_behaviors *b)
{
    robot_floor_take(&b->floor, b->senses);
}
