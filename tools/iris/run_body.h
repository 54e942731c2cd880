/* The robot of `iris run`: its plan from a file, simulated in a world or the real one, with its drive's ramps.
 */
#ifndef IRIS_TOOL_RUN_BODY_H
#define IRIS_TOOL_RUN_BODY_H

#include "iris/osiris/robot_text.h"
#include "iris/osiris/simulated.h"
#include "iris/osiris/world_text.h"
#include "real_robot.h"

typedef struct {
    osiris_plan plan;
    osiris_device devices[OSIRIS_DEVICES_MAX];
    uint32_t check; /* of the robot file's text */
    osiris_world world;
    osiris_world_memory memory;
    osiris_simulated simulated;
    osiris_simulated_device measured[OSIRIS_DEVICES_MAX];
    int is_real;
    robot_drivers drivers;
    osiris_drive drive;
    osiris_device drive_device;
} run_body;

/* The plan alone: all that a replay needs. Complains; returns 1, or 0. */
int run_body_read(run_body *body, const char *robot);

/* Puts it into a world, null: an open floor. Complains; returns 1, or 0. */
int run_body_place(run_body *body, const char *world, uint32_t seed);

/* Or drives the hardware that the plan names. Complains; returns 1, or 0. */
int run_body_open(run_body *body);
void run_body_close(run_body *body, uint32_t now_ms);

/* Time has come to now_ms. A device's new raw value: 0 when there is none. Where it truly is, if that is known. */
void run_body_pass(run_body *body, uint32_t now_ms);
int run_body_sense(run_body *body, osiris_raw *raw, int32_t device, uint32_t now_ms);
int run_body_pose(const run_body *body, osiris_pose *pose);

/* Where it begins. */
osiris_pose run_body_start(const run_body *body);

/* Tells the drive: towards these speeds by its ramps, or to stand at once. */
void run_body_drive(run_body *body, int32_t speed_mms, int32_t turn_rate, int32_t elapsed_ms,
                    uint32_t now_ms);
void run_body_halt(run_body *body, uint32_t now_ms);

#endif
