/* A walled course, and what a camera that sees depths makes of it: disparities with noise, gaps, and wrong matches.
 *
 * Millimeters, x to the east and y to the north; headings in radians, counterclockwise from east. Everything solid is a
 * polygon that stands on the floor.
 */
#ifndef SIM_WALLS_H
#define SIM_WALLS_H

#include "iris/3d/scan.h"
#include "light.h"

#define SIM_CORNERS_MAX 8
#define SIM_DEPTH_W     160
#define SIM_DEPTH_H     120

typedef struct {
    double corner[SIM_CORNERS_MAX][2];
    int corners;
    double height;
} sim_solid;

/* The first one is the room: solid is what is outside of it. */
extern const sim_solid sim_solids[];
extern const int sim_solid_count;

/* The robot's way around, a closed line. */
extern const double sim_way[][2];
extern const int sim_way_points;

/* Is it in the room, and in nothing solid? */
int sim_is_free(double x, double y);

/* How far it is to the nearest wall. */
double sim_wall_distance(double x, double y);

/* The nearest wall that is ahead of the robot's camera in a direction, 1 ahead and `left` to the left: where it is, and how
 * far ahead. */
double sim_wall_ahead(double at[2], sim_pose robot, double left);

/* The robot's stereo camera: 160x120, 75 degrees wide, 300 mm high, 120 mm ahead of the axle, 8 degrees down. */
iris_depth_camera sim_depth_camera(void);

/* Standard deviation of a disparity, pixels. */
#define SIM_DISPARITY_NOISE 0.25

/* What it sees from the robot's pose: disparities as stereo.h has them, SIM_DEPTH_W x SIM_DEPTH_H. */
void sim_depth_render(uint16_t *disparity, sim_random *random, sim_pose robot);

/* A normal deviate. */
double sim_gauss(sim_random *random);

#endif
