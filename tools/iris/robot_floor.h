/* The floor as a robot gets to know it: an occupancy grid, and ways over it that keep clear of what is known to be there.
 */
#ifndef IRIS_TOOL_ROBOT_FLOOR_H
#define IRIS_TOOL_ROBOT_FLOOR_H

#include "iris/3d/grid.h"
#include "robot_senses.h"

#define ROBOT_FLOOR_CELLS   256 /* a side; 12.8 m, with where it began in the middle */
#define ROBOT_FLOOR_CELL_MM 50

typedef struct {
    iris_grid grid;
    int8_t odds[ROBOT_FLOOR_CELLS * ROBOT_FLOOR_CELLS];
    uint8_t blocked[ROBOT_FLOOR_CELLS * ROBOT_FLOOR_CELLS];
    uint16_t steps[ROBOT_FLOOR_CELLS * ROBOT_FLOOR_CELLS]; /* to the goal; 0: not reached */
    int32_t queue[ROBOT_FLOOR_CELLS * ROBOT_FLOOR_CELLS];
    uint32_t taken_ms[OSIRIS_DEVICES_MAX]; /* times of the readings that are in it */
} robot_floor;

/* Nothing is known of it. */
void robot_floor_init(robot_floor *floor, osiris_pose start);

/* Adds the range readings that are new. */
void robot_floor_take(robot_floor *floor, const robot_senses *senses);

/* The robot ran into something that its sensors did not see: before it. */
void robot_floor_bump(robot_floor *floor, const robot_senses *senses);

/* Plans ways to (x, y), from wherever the robot may be; and to what nobody has seen yet. 0: there is no such place on
 * this floor; the latter also when no way leads there from the robot. */
int robot_floor_plan_to(robot_floor *floor, const robot_senses *senses, int32_t x_mm, int32_t y_mm);
int robot_floor_plan_unknown(robot_floor *floor, const robot_senses *senses);

/* A place on the planned way, up to about reach_mm from the robot, which leads there. 0: no way is known. */
int robot_floor_ahead(const robot_floor *floor, osiris_pose *place, const robot_senses *senses,
                      int32_t reach_mm);

#endif
