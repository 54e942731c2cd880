/* The simulated camera: a pinhole that looks ahead and down at the floor. */
#ifndef SIM_CAMERA_H
#define SIM_CAMERA_H

#include <stdint.h>

#include "iris/xt/floor.h"
#include "light.h"

#define SIM_W 160
#define SIM_H 120

/* Where a pixel's center meets the floor, in cm from the robot's reference point. */
typedef struct {
    float ahead, left;
} sim_ground;

typedef struct {
    double height_cm;  /* of the lens above the floor */
    double forward_cm; /* of the lens in front of the robot's reference point */
    double pitch_deg;  /* of the optical axis below the horizon; the whole picture lies below the horizon */
    double fov_deg;    /* horizontal field of view */
    double noise;      /* standard deviation in gray values */
    int blank;         /* 1: a covered lens; noise only */
    sim_random random;
    sim_ground ground[2 * SIM_H][SIM_W]; /* two samples per pixel, one above the other */
    float blur[SIM_H];                   /* cm of floor that a pixel is wide */
    float gauss[4096];                   /* normal deviates */
} sim_camera;

/* The demo's camera: 18 cm above the floor, 5 cm ahead of the axle, 42 degrees down, 62 degrees wide. */
void sim_camera_init(sim_camera *camera, uint32_t seed);

/* Takes over another height, position, pitch, or field of view. */
void sim_camera_aim(sim_camera *camera);

/* Renders what the camera sees from the robot's pose, row by row, top first. */
void sim_camera_render(uint8_t *gray, sim_camera *camera, const sim_floor *floor, sim_pose robot);

/* The floor under image position (x, y), pixels, for a robot at `pose`. */
sim_pose sim_camera_floor(const sim_camera *camera, sim_pose pose, double x, double y);

/* The camera's floor in the robot's millimeters, as anybody would find it: from `count` marks (4 to 64) on the floor, measured to
 * a millimeter, and read off the picture to within 0.3 pixels (standard deviation). 0 when it is refused. */
int sim_camera_marks(iris_floor *found, sim_camera *camera, int count);

/* The runs of tape in image row y from the true geometry, without noise, light, or glare: first and last
 * column of each, inclusive, in pixels. Returns how many there are, at most `max`. */
int sim_camera_truth(double (*run)[2], int max, const sim_camera *camera, const sim_track *track,
                     sim_pose robot, int y);

#endif
