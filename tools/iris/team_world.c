#include "team_world.h"

#include "robot_file.h"

/* Two half walls, a line along which the object comes into sight, and it. */
static const char room[] =
    "wall -3000 -2000 3000 -2000 3000 2000 -3000 2000 -3000 -2000\n"
    "wall -600 2000 -600 1100\n"
    "wall 0 -600 0 0\n"
    "line -2600 -1400 -400 -1400 100 -1250 500 -900 700 -400 700 400 500 900 100 1250 -200 1400\n"
    "object 1900 500 radius 80 color red\n"
    "start -2500 -1400\n"
    "start -2300 -100\n"
    "start -2100 1300 facing -22\n"
    "start 2300 -1300 facing 90\n"
    "start 1000 1600 facing 180\n";

int team_world_read(team_world *world, const char *path)
{
    osiris_problem problem;
    return path ? world_file_read(&world->is, &world->memory, path)
                : osiris_world_read_text(&world->is, &world->memory, &problem, room, sizeof room - 1) ==
                      IRIS_OK;
}
