/* Reads any bytes as a robot file. What is accepted is a robot that holds together, and can be simulated and asked. */
#include "iris/osiris/robot_text.h"

#include <stdlib.h>

#include "iris/osiris/robot.h"
#include "iris/osiris/simulated.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

static osiris_device devices[OSIRIS_DEVICES_MAX];
static osiris_reading readings[OSIRIS_DEVICES_MAX];
static osiris_simulated_device states[OSIRIS_DEVICES_MAX];

static void drive(const osiris_plan *plan)
{
    static const osiris_segment wall = {300, -500, 300, 500};
    static const osiris_segment tape = {-300, 0, 300, 0};
    static const osiris_object thing = {200, 50, 20, 0xFF0000};
    static const osiris_world world = {&wall, &tape, &thing, NULL, 1, 1, 1, 0};
    static osiris_simulated simulated;
    static osiris_robot robot;
    const osiris_pose start = {0, 0, 0};
    osiris_obstacle obstacle;
    osiris_sight sight;
    if (osiris_plan_check(plan) != IRIS_OK ||
        osiris_simulated_init(&simulated, states, plan, &world, start, 1) != IRIS_OK ||
        osiris_robot_init(&robot, readings, plan) != IRIS_OK) {
        abort();
    }
    for (int32_t i = 0; i < plan->driver_count; i++) {
        (void)osiris_robot_bind(&robot, i, &osiris_simulated_driver, &simulated, 0);
    }
    for (uint32_t ms = 0; ms < 300; ms += 30) {
        (void)osiris_simulated_step(&simulated, ms);
        (void)osiris_robot_sense(&robot, ms);
        (void)osiris_robot_obstacle(&obstacle, &robot, (iris_angle)(ms * 100));
        (void)osiris_robot_object(&sight, &robot);
        (void)osiris_robot_drive(&robot, 500, (int32_t)ms * 100 - 10000, ms);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    static osiris_plan plan;
    osiris_problem problem = {0, NULL};
    const iris_status status =
        osiris_robot_read_text(&plan, devices, OSIRIS_DEVICES_MAX, &problem, (const char *)data, bytes);
    if (status == IRIS_OK) {
        drive(&plan);
    } else if (data && (problem.line < 1 || !problem.expected)) {
        abort();
    }
    return 0;
}
