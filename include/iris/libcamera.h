/* IRIS - a source of frames: cameras behind libcamera, as on a Raspberry Pi. See capture.h.
 *
 *     static iris_libcamera device;
 *     iris_capture camera;
 *     if (iris_capture_open(&camera, iris_libcamera_source(&device), "", NULL) == IRIS_OK) ...
 *
 * The path of iris_capture_open is a camera's id, or its number in iris_libcamera_list; "" is the first one.
 *
 * libcamera is a C++ library that allocates memory, starts threads, and exists once in a process. So this is the one source
 * that does these things, too, between open and close; it has an archive of its own, libiris-libcamera.a, and IRIS without it
 * has none of that. A program that also uses libcamera by itself must not have a CameraManager while a device is open, nor
 * call the lists then. Several devices may be open at a time, from several threads. libcamera tells standard error
 * what it does; LIBCAMERA_LOG_LEVELS=*:FATAL in the environment keeps it quiet.
 *
 * Granted is what libcamera negotiates: size, stride, format, and color space are read back, a stride wanted is not heard. The
 * rate is set where the camera says that it can be; otherwise the granted one is 0. Buffers may be fewer or more than wanted.
 * Formats: IRIS_GRAY8, RGB888, BGR888, RGBA8888, RGB565 in both byte orders, YUYV, UYVY, the four of BAYER8, and NV12. With
 * YUV, BT.601 in the limited range is asked for, which is what color.h and nv12.h compute with.
 * Frames are in memory that cannot be written. Their time is that of the sensor, by CLOCK_MONOTONIC on most systems.
 * Opening takes what libcamera takes to look for cameras, 0.1 to 1 s; calls into it have no deadline of their own, waiting
 * for a frame has. A camera that was unplugged is seen by libcamera with udev's help; on a system without, frames just stop
 * coming.
 */
#ifndef IRIS_LIBCAMERA_H
#define IRIS_LIBCAMERA_H

#include <stdint.h>

#include "iris/capture.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Belongs to the functions. */
typedef struct {
    void *session; /* what libcamera and this source have allocated; null while closed */
    char problem[IRIS_CAPTURE_PROBLEM_BYTES];
} iris_libcamera;

/* The source that *device is, for iris_capture_open. Not while a capture uses the device. Null: a source that
 * iris_capture_open refuses. Built without libcamera, opening it is IRIS_ERR_UNSUPPORTED. O(1). */
iris_capture_source iris_libcamera_source(iris_libcamera *device);

/* Texts end with a 0, have printable ASCII only, and are cut off where they are longer. */
typedef struct {
    char id[256];   /* the same after every start */
    char model[64]; /* of the sensor, such as "imx219"; empty when libcamera does not know */
} iris_libcamera_info;

/* Lists the cameras that are there now: *count is how many there are, and when that is more than the capacity, the first
 * ones are in the array and the function returns IRIS_ERR_FULL. cameras may be null when capacity is 0.
 * IRIS_ERR_ARG: null pointer or negative capacity; IRIS_ERR_UNSUPPORTED: built without libcamera; IRIS_ERR_IO: libcamera
 * does not start. With the last two *count is 0. Takes 0.1 to 1 s. */
iris_status iris_libcamera_list(iris_libcamera_info *cameras, int32_t *count, int32_t capacity);

/* A format in every size from least to most in steps; a single size is both, with steps of 0. */
typedef struct {
    char name[24];  /* libcamera's, such as "NV12" or "BGR888" */
    int32_t format; /* an iris_format or IRIS_CAPTURE_NV12; 0: IRIS does not read it */
    iris_size least, most, step;
} iris_libcamera_mode;

/* What a camera says that it offers for pictures, without the raw pixels of its sensor; the sizes of one format follow one
 * another. The path, *count, and the capacity are as above. What is granted may be another size all the same.
 * IRIS_ERR_ARG: null pointer or negative capacity; IRIS_ERR_UNSUPPORTED: built without libcamera, or no pictures from this
 * camera; IRIS_ERR_IO: no such camera, or libcamera does not start. *count is 0 then. Takes 0.1 to 1 s. */
iris_status iris_libcamera_list_modes(iris_libcamera_mode *modes, int32_t *count, const char *path,
                                      int32_t capacity);

#ifdef __cplusplus
}
#endif

#endif
