/* One simulated robot of a team: its body in the world, its drive with ramps, and what its sensors tell its behaviors.
 */
#ifndef IRIS_TOOL_TEAM_BODY_H
#define IRIS_TOOL_TEAM_BODY_H

#include "iris/osiris/robot_text.h"
#include "iris/osiris/simulated.h"
#include "robot_behaviors.h"

typedef struct {
    osiris_plan plan;
    osiris_device devices[OSIRIS_DEVICES_MAX]; /* of the plan */
    osiris_simulated body;
    osiris_simulated_device measured[OSIRIS_DEVICES_MAX];
    osiris_drive drive;
    robot_senses senses;
    robot_behaviors behaviors;
} team_body;

/* From a robot file; path null: an ordinary small robot. Complains; 1 when done, else 0. */
int team_body_read(team_body *body, const char *path);

/* Puts it, as its plan has it, into the world. Returns a status of osiris_simulated_init. */
iris_status team_body_place(team_body *body, const osiris_world *world, osiris_pose start, uint32_t seed);

/* Lets time pass: it drives as it was told, and its senses are new. */
void team_body_step(team_body *body, const iris_motion *motion, uint32_t now_ms);

#endif
