/* A robot with two driven wheels.
 *
 * Its reference point is the middle of the axle. A command's speed is the speed of the middle, its steering the share
 * that the wheels differ by: the inner wheel of full steering stands still, so that the robot turns around that wheel.
 */
#ifndef SIM_ROBOT_H
#define SIM_ROBOT_H

#include "iris/command.h"
#include "track.h"

typedef struct {
    double axle_cm;      /* between the wheels */
    double width_cm;     /* of the body */
    double top_speed;    /* cm/s of a wheel at most; speed 1000 is this */
    double motor_s;      /* time constant of the motors */
    double acceleration; /* cm/s^2 of a wheel at most */
    sim_pose pose;
    double left, right; /* cm/s */
} sim_robot;

/* The demo's robot: 18 cm wide, wheels 15 cm apart, 60 cm/s, motors of 80 ms and 300 cm/s^2; stands at `pose`. */
void sim_robot_init(sim_robot *robot, sim_pose pose);

/* Drives for `seconds` (a few milliseconds) by the command's steer and speed. */
void sim_robot_drive(sim_robot *robot, const iris_command *command, double seconds);

#endif
