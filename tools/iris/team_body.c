#include "team_body.h"

#include "robot_file.h"

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

iris_status team_body_place(team_body *body, const osiris_world *world, osiris_pose start, uint32_t seed)
{
    const iris_status status = osiris_drive_init(&body->drive, &body->plan.drive);
    robot_senses_init(&body->senses, &body->plan, start);
    robot_behaviors_init(&body->behaviors, &body->senses);
    return status != IRIS_OK
               ? status
               : osiris_simulated_init(&body->body, body->measured, &body->plan, world, start, seed);
}

static void drive(team_body *body, const iris_motion *motion, uint32_t now_ms)
{
    const osiris_velocity wanted = {motion->speed_mms * 65536, 0, motion->turn_rate * 256};
    (void)osiris_drive_step(&body->drive, &wanted, (int32_t)(now_ms - body->body.now_ms));
    const osiris_raw told = {OSIRIS_DRIVE,
                             OSIRIS_VALID,
                             now_ms,
                             {body->drive.velocity.ahead_q16, body->drive.velocity.left_q16,
                              body->drive.velocity.turn_q8, body->drive.steering}};
    for (int32_t i = 0; i < body->plan.device_count; i++) {
        if (body->devices[i].kind == OSIRIS_DRIVE) {
            (void)osiris_simulated_driver.write(&body->body, &body->devices[i], &told, now_ms);
        }
    }
}

void team_body_step(team_body *body, const iris_motion *motion, uint32_t now_ms)
{
    osiris_raw raw;
    drive(body, motion, now_ms);
    (void)osiris_simulated_step(&body->body, now_ms);
    for (int32_t i = 0; i < body->plan.device_count; i++) {
        if (osiris_kind_is_sensor(body->devices[i].kind) &&
            osiris_simulated_driver.read(&body->body, &raw, &body->devices[i], now_ms) == IRIS_OK) {
            robot_senses_take(&body->senses, i, &raw);
        }
    }
    robot_behaviors_sense(&body->behaviors);
}
