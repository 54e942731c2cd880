#include "team_body.h"

#include <stdlib.h>

#include "robot_file.h"

#define AHEAD 2731  /* range sensors within 15 degrees look ahead */
#define ASIDE 14564 /* and to 80 degrees to a side */

static const char small_robot[] =
    "robot small\n"
    "body 180 170\n"
    "drive differential track 150 speed 500 turn 180\n"
    "camera eye at 60 0 cone 60 from 50 to 3000 noise 10 rate 20 latency 40\n"
    "range front at 90 0 cone 15 from 20 to 2000 step 5 noise 5 rate 20\n"
    "range left at 70 60 facing 45 cone 15 from 20 to 2000 step 5 noise 5 rate 20\n"
    "range right at 70 -60 facing -45 cone 15 from 20 to 2000 step 5 noise 5 rate 20\n"
    "line tape at 70 0 to 80 noise 1 rate 50\n"
    "bump nose at 90 0 cone 120 rate 50\n"
    "odometry wheels error 1 rate 50\n"
    "heading compass noise 1 rate 20\n"
    "battery pack from 6400 to 8400 noise 20 rate 1\n";

int team_body_read(team_body *body, const char *path)
{
    osiris_problem problem;
    return path ? robot_file_read(&body->plan, body->devices, path)
                : osiris_robot_read_text(&body->plan, body->devices, OSIRIS_DEVICES_MAX, &problem,
                                         small_robot, sizeof small_robot - 1) == IRIS_OK;
}

/* --- senses --- */

static void see_object(team_senses *senses, const osiris_raw *raw)
{
    senses->has_object = raw->validity == OSIRIS_VALID;
    if (senses->has_object) {
        const osiris_pose seen =
            osiris_pose_after(senses->pose, (osiris_pose){raw->values[0], raw->values[1], 0});
        senses->object_x_mm = seen.x_mm;
        senses->object_y_mm = seen.y_mm;
    }
}

/* The nearest of the sensors of a side, from the reference point. */
static void measure_ranges(team_body *body)
{
    int32_t nearest[3] = {TEAM_FAR_MM, TEAM_FAR_MM, TEAM_FAR_MM};
    for (int32_t i = 0; i < body->plan.device_count; i++) {
        const osiris_device *device = &body->devices[i];
        const int32_t aside = device->place.heading;
        if (device->kind == OSIRIS_RANGE && abs(aside) < ASIDE) {
            int32_t *to = &nearest[abs(aside) < AHEAD ? 0 : aside > 0 ? 1 : 2];
            *to = body->ranges[i] < *to ? body->ranges[i] : *to;
        }
    }
    body->senses.ahead_mm = nearest[0];
    body->senses.left_mm = nearest[1];
    body->senses.right_mm = nearest[2];
}

static void take(team_body *body, const osiris_raw *raw, const osiris_device *device)
{
    team_senses *senses = &body->senses;
    const osiris_pose odometry = {raw->values[0], raw->values[1], (iris_angle)raw->values[2]};
    switch (device->kind) {
    case OSIRIS_CAMERA:
        see_object(senses, raw);
        break;
    case OSIRIS_RANGE:
        body->ranges[device - body->devices] =
            raw->validity == OSIRIS_VALID
                ? osiris_calibration_value(&device->calibration, raw->values[0]) + device->place.x_mm
                : TEAM_FAR_MM;
        break;
    case OSIRIS_LINE:
        senses->has_line = raw->validity == OSIRIS_VALID;
        senses->line_offset_mm = raw->values[0] - device->place.y_mm;
        senses->line_ahead_mm = device->place.x_mm;
        senses->line_angle = (iris_angle)raw->values[1];
        break;
    case OSIRIS_ODOMETRY:
        senses->pose = osiris_pose_after(senses->pose, osiris_pose_step(body->odometry, odometry));
        body->odometry = odometry;
        break;
    case OSIRIS_HEADING:
        senses->pose.heading = (iris_angle)raw->values[0];
        break;
    case OSIRIS_BATTERY:
        body->battery_permil = (raw->values[0] - device->least) * 1000 /
                               (device->most > device->least ? device->most - device->least : 1);
        break;
    default:
        break;
    }
}

iris_status team_body_place(team_body *body, const osiris_world *world, osiris_pose start, uint32_t seed)
{
    const osiris_plan *plan = &body->plan;
    body->senses.pose = start;
    body->senses.radius_mm =
        plan->ahead_mm + (plan->length_mm > plan->width_mm ? plan->length_mm : plan->width_mm) / 2;
    for (int32_t i = 0; i < OSIRIS_DEVICES_MAX; i++) {
        body->ranges[i] = TEAM_FAR_MM;
    }
    measure_ranges(body);
    body->senses.speed_mms = plan->drive.speed_max_mms / 2;
    body->senses.turn_rate_max = plan->drive.turn_rate_max;
    body->battery_permil = 1000;
    const iris_status status = osiris_drive_init(&body->drive, &plan->drive);
    return status != IRIS_OK ? status
                             : osiris_simulated_init(&body->body, body->measured, plan, world, start, seed);
}

void team_body_step(team_body *body, const iris_motion *motion, uint32_t now_ms)
{
    const osiris_velocity wanted = {motion->speed_mms * 65536, 0, motion->turn_rate * 256};
    const osiris_device *drive = NULL;
    osiris_raw raw = {OSIRIS_DRIVE, OSIRIS_VALID, now_ms, {0}};
    (void)osiris_drive_step(&body->drive, &wanted, (int32_t)(now_ms - body->body.now_ms));
    raw.values[0] = body->drive.velocity.ahead_q16;
    raw.values[1] = body->drive.velocity.left_q16;
    raw.values[2] = body->drive.velocity.turn_q8;
    raw.values[3] = body->drive.steering;
    for (int32_t i = 0; i < body->plan.device_count; i++) {
        drive = body->devices[i].kind == OSIRIS_DRIVE ? &body->devices[i] : drive;
    }
    if (drive) {
        (void)osiris_simulated_driver.write(&body->body, drive, &raw, now_ms);
    }
    (void)osiris_simulated_step(&body->body, now_ms);
    for (int32_t i = 0; i < body->plan.device_count; i++) {
        if (osiris_kind_is_sensor(body->devices[i].kind) &&
            osiris_simulated_driver.read(&body->body, &raw, &body->devices[i], now_ms) == IRIS_OK) {
            take(body, &raw, &body->devices[i]);
        }
    }
    measure_ranges(body);
}
