/* The closed loop: camera, follower, controller, sentence, robot, and again. */
#ifndef SIM_DRIVE_H
#define SIM_DRIVE_H

#include "camera.h"
#include "iris/xt/pursuit.h"
#include "robot.h"

#define SIM_STEPS_MAX 60000 /* of a drive */
#define SIM_SHOTS                                                                                            \
    (2 * SIM_MARKS) /* camera frames that are kept to be looked at: before each difficult place */

typedef struct {
    float x, y;       /* cm, of the robot's reference point */
    float lateral_cm; /* from the center line, positive to the left */
    uint8_t state;    /* iris_line_state of the command the robot followed */
} sim_step;

typedef struct {
    uint8_t gray[SIM_W * SIM_H];
    iris_span rows[SIM_H];
    iris_follow_result line; /* without .rows */
    iris_command command;
    const sim_mark *mark; /* what lies ahead; null when the drive did not come here */
    double ahead_cm;      /* how far */
} sim_shot;

/* What to drive. */
typedef struct {
    int laps;
    int frames_per_second;
    const iris_steer_config *steer; /* null for the library's defaults */
    const iris_pursuit *pursuit;    /* steers by the floor's millimeters; null: by the picture */
} sim_plan;

typedef struct {
    double length;         /* cm of a lap */
    double laps;           /* driven, from the start along the course */
    double mean_square;    /* cm^2 of the lateral distance */
    double mean_cm;        /* of the lateral distance's magnitude */
    double largest_cm;     /* lateral distance */
    double largest_at;     /* cm along the lap */
    double seconds;        /* driven */
    double vision_seconds; /* the library's share of this machine's time: following, steering, sentence */
    int frames;
    int count[3];    /* frames by iris_line_state */
    const char *end; /* why the drive ended; null: all laps are done */
    int steps;
    sim_step step[SIM_STEPS_MAX]; /* one per frame */
    sim_shot shot[SIM_SHOTS];
} sim_record;

/* Drives until all laps are done, the robot is off the course by 40 cm, or has not come nearer for 5 s. */
void sim_drive(sim_record *record, const sim_plan *plan, sim_camera *camera, const sim_floor *floor,
               sim_robot *robot);

#endif
