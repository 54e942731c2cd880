/* The other closed loop: the robot drives around a walled course, maps it with a camera that sees depths, and finds itself
 * in that map when its odometry drifts.
 */
#ifndef SIM_EXPLORE_H
#define SIM_EXPLORE_H

#include "iris/3d/localize.h"
#include "walls.h"

#define SIM_LAP_MAX 600 /* frames of a lap */

typedef struct {
    int frames;
    sim_pose truth[SIM_LAP_MAX];
    iris_map_pose odometry[SIM_LAP_MAX]; /* what it says alone, from the first frame's pose on */
    iris_map_pose found[SIM_LAP_MAX];
    uint16_t disparity[SIM_LAP_MAX][SIM_DEPTH_W * SIM_DEPTH_H];
} sim_lap;

typedef struct {
    sim_lap lap[2]; /* the map is made in the first one; in the second one the robot finds itself */
    iris_grid grid;
} sim_exploration;

/* Drives, prints what came of it, and says whether all poses were found within a cell. folder: where the picture goes; null
 * for none. frames: where both laps go, for iris map; null for none. Returns an exit code. */
int sim_explore(uint32_t seed, const char *folder, const char *frames);

/* The map with walls, and the poses as they were, as odometry has them, and as found. 0 when it cannot be written. */
int sim_explore_save(const char *folder, const sim_exploration *exploration);

/* FOLDER/camera.txt; FOLDER/first and FOLDER/second with disparities (0000.pgm ...), truth.txt, and odometry.txt: a pose
 * in a line, millimeters and degrees. The folders must be there. 0 when it cannot. */
int sim_explore_frames(const char *folder, const sim_exploration *exploration);

#endif
