/* IRIS - which cameras there are, and what each can do.
 *
 *     iris_camera cameras[8];
 *     int32_t count;
 *     iris_camera_list(cameras, &count, 8);
 *
 * Every list goes into the caller's array: *count is how many there are, and when that is more than the capacity, the
 * first ones are there and the function returns IRIS_ERR_FULL. An array may be null when its capacity is 0. A camera that
 * another program uses can be asked all the same. What is wrong with a path: IRIS_ERR_IO, not there or no answer;
 * IRIS_ERR_UNSUPPORTED, not a camera. Each call opens and closes the device, which a USB camera may take some 100 ms for.
 */
#ifndef IRIS_CAMERA_LIST_H
#define IRIS_CAMERA_LIST_H

#include <stdint.h>

#include "iris/image.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Texts end with a 0, and have printable ASCII only. */
typedef struct {
    char path[32];   /* such as "/dev/video0" */
    char card[33];   /* the camera's name; empty when problem is not null */
    char driver[17]; /* such as "uvcvideo" */
    char bus[33];    /* where it is, such as "usb-0000:00:14.0-1" */
    const char
        *problem; /* null, or why nothing more is known, such as a missing permission; static storage */
} iris_camera;

/* Devices of the kernel that capture pictures, /dev/video0 to /dev/video255, by number.
 * IRIS_ERR_ARG: null pointer or negative capacity; IRIS_ERR_FULL. */
iris_status iris_camera_list(iris_camera *cameras, int32_t *count, int32_t capacity);

typedef struct {
    char fourcc[8];       /* the kernel's name, such as "YUYV", "MJPG", or "Y16-BE" */
    char description[33]; /* the driver's words */
    int32_t format;       /* an iris_format or IRIS_CAPTURE_NV12 (capture.h); 0: IRIS does not read it */
} iris_camera_format;

/* The formats of a camera, in the driver's order.
 * IRIS_ERR_ARG: null pointer or negative capacity; IRIS_ERR_IO; IRIS_ERR_UNSUPPORTED; IRIS_ERR_FULL. */
iris_status iris_camera_list_formats(iris_camera_format *formats, int32_t *count, const char *path,
                                     int32_t capacity);

/* Every size from least to most in steps; a single size is both, with steps of 0. */
typedef struct {
    iris_size least, most, step;
} iris_camera_sizes;

/* The sizes of one format, by its name from iris_camera_list_formats. A driver may not say: none then.
 * IRIS_ERR_ARG: null pointer, negative capacity, or a name that is none; IRIS_ERR_IO; IRIS_ERR_UNSUPPORTED;
 * IRIS_ERR_FULL. */
iris_status iris_camera_list_sizes(iris_camera_sizes *sizes, int32_t *count, const char *path,
                                   const char *fourcc, int32_t capacity);

/* Every rate from least to most, in frames per 1000 seconds; a single rate is both. */
typedef struct {
    int32_t least_millihz, most_millihz;
} iris_camera_rates;

/* The rates of one format and size. A driver may not say: none then. Errors as above. */
iris_status iris_camera_list_rates(iris_camera_rates *rates, int32_t *count, const char *path,
                                   const char *fourcc, iris_size size, int32_t capacity);

#ifdef __cplusplus
}
#endif

#endif
