/* IRIS-3D - triangulation: the point in space that two or more rays see. Report, section 2.8 (the intersection of two
 * rays), for cameras of any geometry: nothing is rectified, and the rays need not meet.
 *
 *     iris_line3 rays[2];
 *     iris_sensor_ray(&rays[0], &left, left_pixel);
 *     iris_sensor_ray(&rays[1], &right, right_pixel);
 *     iris_triangulate(&point, rays, 2);
 *
 * Method: least squares of the distances from the rays, by Givens rotations, three equations a ray; of two rays it is
 * the middle of the shortest way between them (Hartley and Sturm, "Triangulation", 1997, section 2).
 */
#ifndef IRIS_3D_TRIANGULATE_H
#define IRIS_3D_TRIANGULATE_H

#include "iris/3d/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    IRIS_TRIANGULATION_FINE = 0,
    IRIS_TRIANGULATION_ONE_PLACE, /* all rays begin at one place, to 2^-16 units */
    IRIS_TRIANGULATION_PARALLEL,  /* all are parallel to 2^-14 (0.003 degrees): the point is too far away */
    IRIS_TRIANGULATION_BEHIND     /* a ray comes from the point instead of going there */
} iris_triangulation_flaw;

typedef struct {
    iris_triangulation_flaw flaw;
    int32_t flawed;  /* of IRIS_TRIANGULATION_BEHIND: which ray; else -1 */
    iris_vec3 point; /* the sum of squared distances from the rays is least here */
    iris_q32
        off; /* the largest distance of the point from a ray; of two rays: half of the gap between them */
} iris_triangulation;

/* rays: `count` of them, directions of length 1 (iris_sensor_ray). With s the sine of the largest angle between two of
 * them, and z the distance of the point, it is within (z + 1) 2^-28 / s of the true one.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: fewer than two rays, a place beyond 2^28, or a
 * direction whose length is off 1 by 2^-12; these leave *made untouched.
 * IRIS_ERR_DATA: made->flaw says why, and made->point and made->off are not valid. O(count), 50 products a ray. */
iris_status iris_triangulate(iris_triangulation *made, const iris_line3 *rays, int32_t count);

#ifdef __cplusplus
}
#endif

#endif
