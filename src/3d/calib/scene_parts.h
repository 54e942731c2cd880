/* What the parts of a calibration from a known scene share. */
#ifndef IRIS_SCENE_PARTS_H
#define IRIS_SCENE_PARTS_H

#include "../camera/null_vector.h"
#include "iris/3d/calib_scene.h"

#define IRIS_SCENE_NUMBERS 12
#define IRIS_SCENE_FAR     ((iris_q32)1 << 42) /* 1024 times the spread: farther off than any point that counts */

/* A point, moved and scaled: five coordinates about 0, of a spread of about 1. */
typedef struct {
    iris_vec3 world;
    iris_vec2 image;
} iris_scene_pair;

typedef struct {
    const iris_scene_point *points;
    int32_t count;
    uint8_t *used;
    iris_scene_pair *pairs;
    iris_q32 *distances;
    iris_triangle triangle;
    /* a place is middle + reach times that of a pair */
    iris_vec3 middle;
    iris_vec2 image_middle;
    iris_q32 reach, image_reach;
} iris_scene_problem;

/* Makes pairs of all points, by the middle and the spread of those used: 0 when these are all at one place. */
int iris_scene_normalize(iris_scene_problem *of);

/* Are the points used, or all but one of them, nearly on one plane? Of normalized pairs. */
int iris_scene_is_flat(const iris_scene_problem *of);

/* Are their places in the picture on one line, or nearly? */
int iris_scene_is_line(const iris_scene_problem *of);

/* The matrix with the least algebraic errors of the points used, of length 1, positive where most points are. */
void iris_scene_solve(iris_q32 m[IRIS_SCENE_NUMBERS], iris_scene_problem *of);

/* Was it the only one, after iris_scene_solve? */
int iris_scene_is_single(const iris_scene_problem *of);

/* Makes the sum of squared distances of the points used least. */
void iris_scene_refine(iris_q32 m[IRIS_SCENE_NUMBERS], iris_scene_problem *of);

/* Where the matrix shows a pair, and its depth of no unit. Returns 0 behind the camera, and far off the picture. */
int iris_scene_show(iris_vec2 *at, iris_q32 *depth, const iris_q32 m[IRIS_SCENE_NUMBERS],
                    const iris_scene_pair *pair);

/* Leaves out of `used` what does not fit the others. Returns 0 when nothing fits. */
int iris_scene_leave_out(iris_scene_problem *of);

#endif
