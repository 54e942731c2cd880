#include "robot_file.h"

#include <stdio.h>

#include "complain.h"
#include "floor_file.h"

static char text[65537];

/* file:line: what was expected */
static int is_read(iris_status status, const char *path, const osiris_problem *problem)
{
    char place[1200];
    if (status != IRIS_OK) {
        snprintf(place, sizeof place, "%.1150s:%d", path, (int)problem->line);
        complain(place, "%s", problem->expected);
    }
    return status == IRIS_OK;
}

int robot_file_read(osiris_plan *plan, osiris_device *devices, const char *path)
{
    size_t length = 0;
    osiris_problem problem = {0, ""};
    return text_file_read(text, sizeof text, &length, path) &&
           is_read(osiris_robot_read_text(plan, devices, OSIRIS_DEVICES_MAX, &problem, text, length), path,
                   &problem);
}

int world_file_read(osiris_world *world, osiris_world_memory *memory, const char *path)
{
    size_t length = 0;
    osiris_problem problem = {0, ""};
    return text_file_read(text, sizeof text, &length, path) &&
           is_read(osiris_world_read_text(world, memory, &problem, text, length), path, &problem);
}
