/* IRIS - a camera's frames (capture.h) as a camera of Osiris: somebody who knows how looks at each new frame, and says whether there
 * is an object, and where.
 *
 *     osiris_camera_eye eye;
 *     const osiris_camera_parts parts = {iris_v4l2_source(&device), look, &looker};
 *     osiris_camera_eye_init(&eye, &parts, &plan, 1);                 the path is the plan's
 *     osiris_robot_bind(&robot, 1, &osiris_camera_eye_driver, &eye, now_ms);
 *
 * `look` gets a frame and fills values of a raw camera value: x ahead and y left of the robot in mm (floor.h makes them of a
 * pixel), color, radius. The newest frame is taken, and none is waited for.
 */
#ifndef IRIS_CAMERA_EYE_H
#define IRIS_CAMERA_EYE_H

#include "iris/capture.h"
#include "iris/osiris/plan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* IRIS_OK: values are an object; IRIS_ERR_END: the frame has none; others: the reading is broken. */
typedef iris_status (*osiris_camera_look)(void *looker, int32_t values[OSIRIS_VALUES],
                                          const iris_frame *frame);

/* Read capture (what was granted, and its counters); the rest belongs to the functions. */
typedef struct {
    iris_capture capture;
    iris_capture_source source;
    const osiris_plan *plan;
    int32_t driver;
    osiris_camera_look look;
    void *looker;
    uint32_t tried_ms;
    int32_t is_open;
} osiris_camera_eye;

/* Whose frames, and who looks at them. */
typedef struct {
    iris_capture_source source;
    osiris_camera_look look;
    void *looker;
} osiris_camera_parts;

/* Makes it ready to be bound: the path is that of the plan's driver, which must outlive it.
 * IRIS_ERR_ARG: null pointer, a bad plan, no such driver, or one that is no camera; nothing is touched. O(devices^2). */
iris_status osiris_camera_eye_init(osiris_camera_eye *eye, const osiris_camera_parts *parts,
                                   const osiris_plan *plan, int32_t driver);

/* The context is the osiris_camera_eye. It has one device, a camera. Opening says what iris_capture_open says; one
 * that is not there (IRIS_ERR_IO) is tried again once a second, one that goes away comes back by itself, and meanwhile it is broken. */
extern const osiris_driver osiris_camera_eye_driver;

#ifdef __cplusplus
}
#endif

#endif
