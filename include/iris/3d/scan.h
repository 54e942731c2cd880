/* IRIS-3D - scans: what is around a robot, as beams over the floor. From ranges that a turning sensor has measured, or
 * from a picture of disparities or depths.
 *
 * A beam goes straight from the sensor to where it ends; what it passes is free. Places are in the robot's frame
 * (map_pose.h). Null pointers are IRIS_ERR_ARG.
 */
#ifndef IRIS_3D_SCAN_H
#define IRIS_3D_SCAN_H

#include "iris/3d/map_pose.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Beams end nearer than this in x and y, and sensors are nearer. */
#define IRIS_SCAN_REACH_MAX_MM 250000

/* The most beams of a scan. */
#define IRIS_SCAN_BEAMS_MAX 32767

typedef struct {
    int32_t x_mm, y_mm; /* where it ends */
    int32_t spread_mm;  /* standard deviation of that along the beam, 0 to IRIS_SCAN_REACH_MAX_MM */
    int32_t hit;        /* 1: something is there. 0: nothing up to there */
} iris_beam;

typedef struct {
    const iris_beam *beams;
    int32_t count;      /* 0 to IRIS_SCAN_BEAMS_MAX */
    int32_t x_mm, y_mm; /* the sensor's place */
} iris_scan;

/* --- from ranges --- */

/* A sensor that looks around. */
typedef struct {
    iris_map_pose mount; /* where it is on the robot, and the direction that it calls 0 */
    int32_t
        first_q16; /* the first range's bearing, counterclockwise from there: units of iris_angle, 16 fraction bits */
    int32_t step_q16; /* from one range to the next */
    int32_t least_mm,
        most_mm;       /* ranges outside are no return; 0 < least < most < IRIS_SCAN_REACH_MAX_MM / 2 */
    int32_t quiet_mm;  /* a direction without a return is free so far: 0 (nobody knows) to most_mm */
    int32_t spread_mm; /* standard deviation of a range, 0 to most_mm */
} iris_range_sensor;

/* The beams of `count` ranges in millimeters, any numbers: beams has room for `count`; *beam_count is how many there are,
 * since what has no return makes none when quiet_mm is 0.
 * IRIS_ERR_ARG: null pointer, or a field of the sensor outside its range; IRIS_ERR_RANGE: count outside
 * 0..IRIS_SCAN_BEAMS_MAX. O(count): a sine and a cosine each. */
iris_status iris_scan_from_ranges(iris_beam *beams, int32_t *beam_count, const int32_t *ranges_mm,
                                  int32_t count, const iris_range_sensor *sensor);

/* --- from depths --- */

typedef enum {
    IRIS_DEPTH_DISPARITY = 0, /* as stereo.h: 256 to a pixel, 0 is no match; z = baseline focal / disparity */
    IRIS_DEPTH_MM             /* z in millimeters, 0 is none: what depth cameras give */
} iris_depth_kind;

/* A camera that sees depths, on a robot. Its pictures are without lens (rectified), and its x axis is level. */
typedef struct {
    iris_depth_kind kind;
    iris_q16 focal_q16;      /* pixels, 1 and more */
    iris_q16 baseline_q16;   /* millimeters; disparities only: focal times baseline is from 1 to below 2^23 */
    iris_q16 u0_q16, v0_q16; /* the principal point */
    iris_map_pose mount;     /* where the lens is on the robot; its heading is where the camera looks */
    int32_t height_mm;       /* of the lens above the floor, 0 to IRIS_SCAN_REACH_MAX_MM */
    iris_angle tilt;         /* of the optical axis below the horizon; within 80 degrees */
    int32_t low_mm,
        high_mm; /* what is between these heights is in the way: floor below, ceiling above. low < high */
    int32_t near_mm, far_mm; /* places nearer or farther ahead are not taken; 0 < near < far <= 65535 */
    /* Standard deviation of a depth of 1 m in millimeters; it grows with the square of the depth. 0 and more. For
     * disparities that are p pixels off it is 10^6 p / (focal baseline). */
    iris_q16 spread_q16;
} iris_depth_camera;

/* Of stereo pictures, in pixels and millimeters: the principal point in the middle, on the robot's reference point, level
 * and 200 mm high, with matches 1/4 pixel off; 50 to 1000 mm is in the way, seen from 100 to 5000 mm. Null is ignored. */
void iris_depth_camera_defaults(iris_depth_camera *camera, iris_size size, iris_q16 focal_q16,
                                iris_q16 baseline_q16);

#define IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(w) IRIS_SCRATCH_ROUND(28u * (size_t)(w))

/* The beams of a picture of depths: one for each column of a level camera in the same place, which are the columns of the
 * picture where it is not tilted. A column's beam ends at the nearest thing in the way: at the mean of those of its pixels
 * that are up to 4 standard deviations (or 2 %) farther than the third nearest one, and half of that nearer, so that two
 * wrong matches are none.
 * Without such a thing, it is free as far as floor was seen, or to far_mm if something was seen farther away.
 *   beams       room for as many as the picture is wide; *count: how many there are, from left to right
 *   depth       IRIS_GRAY_U16
 * The spread of a beam is that of a pixel, and less where more than 8 pixels make the mean, which err alike, as matches of
 * a window do: that over the square root of n / 8.
 * IRIS_ERR_ARG: null pointer, or a field of the camera outside its range; errors of iris_image_check; IRIS_ERR_FORMAT;
 * IRIS_ERR_SCRATCH: less than IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(w). O(w h), twice a division for each pixel. */
iris_status iris_scan_from_depth(iris_beam *beams, int32_t *count, const iris_image *depth,
                                 const iris_depth_camera *camera, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
