#include "robot.h"

#include <math.h>

void sim_robot_init(sim_robot *robot, sim_pose pose)
{
    *robot = (sim_robot){
        .axle_cm = 15, .width_cm = 18, .top_speed = 60, .motor_s = 0.08, .acceleration = 300, .pose = pose};
}

/* One wheel's speed after `seconds`: the motor closes in on the wanted speed, as fast as it can. */
static double turn_wheel(const sim_robot *robot, double speed, double wanted, double seconds)
{
    double limit = robot->acceleration * seconds;
    double change = (fmin(wanted, robot->top_speed) - speed) * (1 - exp(-seconds / robot->motor_s));
    return speed + fmax(-limit, fmin(limit, change));
}

void sim_robot_drive(sim_robot *robot, const iris_command *command, double seconds)
{
    double speed = command->speed_permil / 1000.0 * robot->top_speed;
    double steer = command->steer_permil / 1000.0;
    robot->left = turn_wheel(robot, robot->left, speed * (1 + steer), seconds);
    robot->right = turn_wheel(robot, robot->right, speed * (1 - steer), seconds);
    double turn = (robot->right - robot->left) / robot->axle_cm * seconds;
    double way = (robot->right + robot->left) / 2 * seconds;
    robot->pose.x += way * cos(robot->pose.heading + turn / 2);
    robot->pose.y += way * sin(robot->pose.heading + turn / 2);
    robot->pose.heading += turn;
}
