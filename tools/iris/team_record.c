#include "team_record.h"

#include <stdio.h>
#include <stdlib.h>

/* Room for one more behind `count`: arrays grow when count is a power of two. */
static void *grown(void *array, int32_t count, size_t size)
{
    const int is_full = (count & (count - 1)) == 0;
    return is_full ? realloc(array, (count > 0 ? 2 * (size_t)count : 1) * size) : array;
}

int team_record_place(team_robot *robot, team_place place)
{
    team_place *more = grown(robot->path, robot->path_count, sizeof *more);
    if (more) {
        robot->path = more;
        more[robot->path_count++] = place;
    }
    return more != NULL;
}

int team_record_change(team_record *record, team_change change)
{
    team_change *more = grown(record->changes, record->change_count, sizeof *more);
    if (more) {
        record->changes = more;
        more[record->change_count++] = change;
    }
    return more != NULL;
}

int team_record_signal(team_record *record, team_signal one)
{
    team_signal *more = grown(record->signals, record->signal_count, sizeof *more);
    if (more) {
        record->signals = more;
        more[record->signal_count++] = one;
    }
    return more != NULL;
}

void team_record_free(team_record *record)
{
    for (int32_t i = 0; i < record->robot_count; i++) {
        free(record->robots[i].path);
    }
    free(record->robots);
    free(record->changes);
    free(record->signals);
}

void team_robot_name(char name[32], const team_robot *robot)
{
    snprintf(name, 32, "%d/%d", (int)robot->ref, (int)robot->unit);
}

iris_color team_color(int32_t robot)
{
    static const iris_color colors[] = {{0, 90, 190},   {214, 60, 20},  {0, 140, 90},   {170, 50, 160},
                                        {200, 140, 0},  {40, 170, 210}, {110, 80, 50},  {120, 150, 20},
                                        {240, 90, 140}, {90, 90, 110},  {110, 60, 220}, {0, 110, 120}};
    return colors[(size_t)robot % (sizeof colors / sizeof colors[0])];
}
