/* The world of a simulated team: a file, or a room that is built in.
 */
#ifndef IRIS_TOOL_TEAM_WORLD_H
#define IRIS_TOOL_TEAM_WORLD_H

#include "iris/osiris/world_text.h"

typedef struct {
    osiris_world is;
    osiris_world_memory memory; /* of it */
} team_world;

/* path: null for the room. Complains; 1 when done, else 0. */
int team_world_read(team_world *world, const char *path);

#endif
