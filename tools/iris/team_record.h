/* What happened to a team of robots: where each was, what it did, and which signals there were.
 */
#ifndef IRIS_TOOL_TEAM_RECORD_H
#define IRIS_TOOL_TEAM_RECORD_H

#include <stdint.h>

#include "iris/borg/signal.h"
#include "iris/color.h"

/* In mm; x to the east, y to the north. */
typedef struct {
    int32_t x, y;
} team_place;

typedef struct {
    int32_t ref, unit; /* its group's line, and which machine of it, from 1 */
    const char *state; /* at the end; static storage */
    team_place *path;  /* one place for each step_ms */
    int32_t path_count;
    int32_t heading_deg; /* at the end, counterclockwise from x */
} team_robot;

/* From at_ms on a robot did something else. */
typedef struct {
    uint32_t at_ms;
    int32_t robot;
    const char *state; /* static storage */
} team_change;

typedef struct {
    uint32_t at_ms;
    int32_t robot; /* that it arrived at */
    borg_signal signal;
} team_signal;

typedef struct {
    const char *title;
    uint32_t time_ms, step_ms;
    team_robot *robots;
    int32_t robot_count;
    team_change *changes; /* in the order of time */
    int32_t change_count;
    team_signal *signals; /* in the order of time */
    int32_t signal_count;
} team_record;

/* Each appends one; 0 when there is no more memory. */
int team_record_place(team_robot *robot, team_place place);
int team_record_change(team_record *record, team_change change);
int team_record_signal(team_record *record, team_signal one);

/* The arrays, with the robots and their paths. */
void team_record_free(team_record *record);

/* A robot's name: its group's line and its number, as 20/3. Colors that can be told apart on white, over and over. */
void team_robot_name(char name[32], const team_robot *robot);
iris_color team_color(int32_t robot);

#endif
