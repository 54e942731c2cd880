/* Osiris - a robot as data: its body, its drive, its devices, and what drives them. robot_text.h reads it from a file that
 * people write; the same plan makes a robot (robot.h), and a simulated one (simulated.h).
 */
#ifndef IRIS_OSIRIS_PLAN_H
#define IRIS_OSIRIS_PLAN_H

#include "iris/osiris/device.h"
#include "iris/osiris/drive.h"

#ifdef __cplusplus
extern "C" {
#endif

#define OSIRIS_DRIVERS_MAX 4
#define OSIRIS_PATH_BYTES  64 /* of a driver's path, with the 0 at its end */
#define OSIRIS_BODY_MAX_MM 4000

typedef enum {
    OSIRIS_DRIVER_SIMULATED = 0,
    OSIRIS_DRIVER_SERIAL,
    OSIRIS_DRIVER_GPIO,
    OSIRIS_DRIVER_CAMERA
} osiris_driver_kind;

/* The lines of a GPIO drive, in this order. */
enum {
    OSIRIS_LINE_LEFT_DIR,
    OSIRIS_LINE_LEFT_PWM,
    OSIRIS_LINE_RIGHT_DIR,
    OSIRIS_LINE_RIGHT_PWM,
    OSIRIS_GPIO_LINES
};

typedef struct {
    osiris_driver_kind kind;
    char name[OSIRIS_NAME_BYTES];
    char path[OSIRIS_PATH_BYTES];     /* serial: the port; GPIO: the chip; camera: the device or folder */
    int32_t rate;                     /* serial: baud; GPIO: pulses a second */
    int32_t lines[OSIRIS_GPIO_LINES]; /* GPIO: offsets on the chip */
} osiris_driver_plan;

/* The devices are the caller's. The body is a rectangle around a point that lies ahead_mm before the reference point. */
typedef struct {
    char name[OSIRIS_NAME_BYTES];
    int32_t length_mm, width_mm; /* 1..OSIRIS_BODY_MAX_MM */
    int32_t ahead_mm;            /* -OSIRIS_BODY_MAX_MM..OSIRIS_BODY_MAX_MM */
    osiris_drive_config drive;
    int32_t driver_count, device_count; /* 1 or more; 0 or more */
    osiris_driver_plan drivers[OSIRIS_DRIVERS_MAX];
    const osiris_device *devices;
} osiris_plan;

/* IRIS_ERR_ARG: null pointer, a value outside its range, a bad drive or device, a device of a driver that is not there, two
 * devices of one name (an empty one is no name), or of one driver, kind, and channel. O(devices^2). */
iris_status osiris_plan_check(const osiris_plan *plan);

/* The index of the device of this name, or -1. O(devices). */
int32_t osiris_plan_find(const osiris_plan *plan, const char *name);

#ifdef __cplusplus
}
#endif

#endif
