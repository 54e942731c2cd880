/* Rendered frames with their truth, for trying a line follower on. */
#ifndef SIM_FRAMES_H
#define SIM_FRAMES_H

#include "camera.h"

/* Writes `count` frames as DIR/0000.pgm, ... and DIR/truth.txt, seen from poses along one lap that waver
 * around the center line by up to 4 cm and 10 degrees. Returns 0 when a file cannot be written. */
int sim_frames_write(const char *folder, int count, sim_camera *camera, const sim_floor *floor);

#endif
