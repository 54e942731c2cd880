/* The robot of `iris run`: its plan from a file, simulated in a world, with its drive's ramps.
 */
#ifndef IRIS_TOOL_RUN_BODY_H
#define IRIS_TOOL_RUN_BODY_H

#include "iris/osiris/robot_text.h"
#include "iris/osiris/simulated.h"
#include "iris/osiris/world_text.h"

typedef struct {
    osiris_plan plan;
    osiris_device devices[OSIRIS_DEVICES_MAX];
    uint32_t check; /* of the robot file's text */
    osiris_world world;
    osiris_world_memory memory;
    osiris_simulated simulated;
    osiris_simulated_device measured[OSIRIS_DEVICES_MAX];
    osiris_drive drive;
    osiris_device drive_device;
} run_body;

/* The plan alone: all that a replay needs. Complains; returns 1, or 0. */
int run_body_read(run_body *body, const char *robot);

/* Puts it into a world, null: an open floor. Complains; returns 1, or 0. */
int run_body_place(run_body *body, const char *world, uint32_t seed);

/* Where it begins. */
osiris_pose run_body_start(const run_body *body);

/* Tells the drive: towards these speeds by its ramps, or to stand at once. */
void run_body_drive(run_body *body, int32_t speed_mms, int32_t turn_rate, int32_t elapsed_ms,
                    uint32_t now_ms);
void run_body_halt(run_body *body, uint32_t now_ms);

#endif
