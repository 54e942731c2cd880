/* A team's paths as seen from above: walls, painted lines, and objects of the world, each robot's way in its own color.
 */
#ifndef IRIS_TOOL_TEAM_PATHS_H
#define IRIS_TOOL_TEAM_PATHS_H

#include "iris/osiris/world.h"
#include "team_record.h"

/* Writes the picture. Complains; 1 when done, else 0. */
int team_paths_write(const char *path, const team_record *record, const osiris_world *world);

#endif
