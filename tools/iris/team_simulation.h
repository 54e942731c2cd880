/* A team of robots in a simulated world, in one process: for each robot a simulated body with its behaviors, a runtime, and a
 * member of the team; all members on one bus, which may lose what they tell each other.
 */
#ifndef IRIS_TOOL_TEAM_SIMULATION_H
#define IRIS_TOOL_TEAM_SIMULATION_H

#include "iris/osiris/world.h"
#include "team_record.h"
#include "team_script.h"

typedef struct {
    const team_script *script;
    const osiris_world *world;
    const char *
        robots; /* names of robot files with commas between, one robot each, over and over; null: a small robot */
    uint32_t seed;
    int32_t loss_percent; /* of datagrams, for each receiver */
} team_setup;

#define TEAM_STEP_MS  20
#define TEAM_TIME_MAX 3600 /* seconds; longer time-outs count as this */

/* Runs until all stand still for good, or for a little more than twice the longest time-out of the script. Complains; 1 when done, else 0. The record is to be freed
 * either way. */
int team_simulate(team_record *record, const team_setup *setup);

#endif
