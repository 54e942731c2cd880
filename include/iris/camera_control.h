/* IRIS - exposure, gain, white balance, focus, and what else a camera lets be set, by name.
 *
 * A robot that follows a line wants the same picture of the same floor: fix what a camera adjusts on its own.
 *
 *     iris_camera_controls controls;
 *     if (iris_camera_controls_open(&controls, "/dev/video0") == IRIS_OK) {
 *         iris_camera_control_choose(&controls, "exposure-auto", "manual");   of the menu's choices
 *         iris_camera_control_set(&controls, "exposure", 80);                 units of 100 us on most cameras
 *         iris_camera_controls_close(&controls);
 *     }
 *
 * Works beside a capture of the same camera, also of another program, and settings stay when it is closed. Set the
 * automatic one first: a control that another one rules is inactive, takes a value, and heeds it later, if at all.
 *
 * Names: exposure, exposure-auto, exposure-auto-priority, exposure-bias, gain, gain-auto, analog-gain, digital-gain, iso,
 * iso-auto, white-balance, white-balance-auto, white-balance-once, red-balance, blue-balance, focus, focus-auto, brightness,
 * brightness-auto, contrast, saturation, hue, hue-auto, sharpness, gamma, backlight-compensation, power-line-frequency,
 * flip-horizontal, flip-vertical, rotate, zoom, pan, tilt, test-pattern: the same on every camera that has them. Any other
 * control has its driver's name in small letters with dashes ("LED1 Mode": led1-mode). Of several that would have one name
 * the second is called name-2.
 */
#ifndef IRIS_CAMERA_CONTROL_H
#define IRIS_CAMERA_CONTROL_H

#include <stdint.h>

#include "iris/capture.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Room for a name with a terminating 0. */
#define IRIS_CAMERA_CONTROL_NAME_BYTES 40

typedef enum {
    IRIS_CONTROL_NUMBER = 1,
    IRIS_CONTROL_SWITCH, /* 0 or 1 */
    IRIS_CONTROL_MENU,   /* one of the choices that iris_camera_control_choices lists */
    IRIS_CONTROL_BUTTON, /* setting it, to any value, does something; it has no value */
    IRIS_CONTROL_BITS    /* any of the bits of maximum */
} iris_camera_control_kind;

/* Flags of a control. */
#define IRIS_CONTROL_READ_ONLY  1u
#define IRIS_CONTROL_WRITE_ONLY 2u
#define IRIS_CONTROL_INACTIVE   4u /* another control rules it now, such as exposure-auto */
#define IRIS_CONTROL_BUSY       8u /* cannot be set now, for example while frames flow */

typedef struct {
    char name[IRIS_CAMERA_CONTROL_NAME_BYTES];
    int64_t minimum, maximum, step; /* step at least 1 */
    int64_t default_value;
    int64_t value; /* 0 for a button, for what is write-only, and for what could not be read */
    iris_camera_control_kind kind;
    uint32_t flags;
    uint32_t id;    /* the kernel's */
    char label[33]; /* the driver's own name */
} iris_camera_control;

typedef struct {
    int64_t value;
    char name
        [IRIS_CAMERA_CONTROL_NAME_BYTES]; /* in small letters with dashes, such as "manual-mode"; or a number */
} iris_camera_choice;

/* A camera whose controls are open; belongs to the functions. Not to be used from two threads at a time. */
typedef struct {
    int handle; /* file descriptor, -1 when closed */
    char problem[IRIS_CAPTURE_PROBLEM_BYTES];
} iris_camera_controls;

/* Opens the camera at path for its controls.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_IO: not there, no permission, or no answer; IRIS_ERR_UNSUPPORTED: not a camera. */
iris_status iris_camera_controls_open(iris_camera_controls *controls, const char *path);

/* Null and a second call do nothing. */
void iris_camera_controls_close(iris_camera_controls *controls);

/* Why the last call failed, in words that say what to do: for IRIS_ERR_RANGE what the range is. Never null; belongs to
 * *controls. */
const char *iris_camera_controls_problem(const iris_camera_controls *controls);

/* All controls with their values, in the driver's order. list may be null when capacity is 0. *count is how many there
 * are; IRIS_ERR_FULL: more than capacity, and the first are there.
 * IRIS_ERR_ARG: null pointer, negative capacity, or not open; IRIS_ERR_IO: the camera does not answer. */
iris_status iris_camera_controls_list(iris_camera_control *list, int32_t *count,
                                      iris_camera_controls *controls, int32_t capacity);

/* The control of that name, with its value.
 * IRIS_ERR_ARG: null pointer or not open; IRIS_ERR_UNSUPPORTED: this camera has no such control; IRIS_ERR_IO. */
iris_status iris_camera_control_get(iris_camera_control *control, iris_camera_controls *controls,
                                    const char *name);

/* Sets the control of that name. The driver rounds to a step: iris_camera_control_get tells.
 * IRIS_ERR_ARG: null pointer or not open; IRIS_ERR_UNSUPPORTED: this camera has no such control, or it is read-only;
 * IRIS_ERR_RANGE: value outside minimum..maximum, or not among a menu's choices; IRIS_ERR_IO: the camera does not answer,
 * or refuses it now. */
iris_status iris_camera_control_set(iris_camera_controls *controls, const char *name, int64_t value);

/* Sets the menu of that name to the choice of that name, or to the only one whose name begins so, up to a dash: "manual" for
 * "manual-mode", which is what webcams call it.
 * IRIS_ERR_ARG: null pointer or not open; IRIS_ERR_RANGE: no menu, no such choice, or several that begin so: the problem
 * lists them; IRIS_ERR_UNSUPPORTED, IRIS_ERR_IO: as iris_camera_control_set. */
iris_status iris_camera_control_choose(iris_camera_controls *controls, const char *name, const char *word);

/* The choices of a menu: values and names, by value; none for another kind. *count and IRIS_ERR_FULL as above.
 * IRIS_ERR_ARG: null pointer, negative capacity, or not open; IRIS_ERR_UNSUPPORTED: no such control; IRIS_ERR_IO. */
iris_status iris_camera_control_choices(iris_camera_choice *choices, int32_t *count,
                                        iris_camera_controls *controls, const char *name, int32_t capacity);

#ifdef __cplusplus
}
#endif

#endif
