/* Osiris - devices: a robot's sensors and actuators as data, what they say, and what drives them.
 *
 * Three layers: a driver hands over raw values as its device counts them; the model (model.h) makes readings of them, in
 * units that people use, with time, validity, and uncertainty; the robot (robot.h) answers what a behavior asks.
 *
 * Values have a fixed size and a tag; what they are is said by the kind:
 *
 *     kind       values of a reading                                        least and most are of
 *     camera     object: x ahead mm, y left mm (robot's frame), color       the object's distance, mm
 *                0xRRGGBB, radius mm
 *     range      distance mm, from the sensor in its direction              the distance, mm
 *     line       line under it: offset to the right mm, angle of the        most: how far it sees to each side, mm
 *                line, positive when it leans right, angle units
 *     bump       1 pressed, 0 not                                           -
 *     odometry   x mm, y mm, heading, from where it began                   -
 *     heading    heading, angle units, on the floor (pose.h)                -
 *     battery    millivolts, permil of its charge                           empty and full, millivolts
 *     drive      ahead, left mm/s with 16 fraction bits, turn with 8        -
 *                (osiris_velocity), steering (angle units)
 *     steering   angle units, positive to the right                         the angle
 *     gripper    0 closed .. 1000 open                                      -
 *     light      color 0xRRGGBB; 0: off                                     -
 *     sound      Hz, ms; 0: silent                                          Hz
 *
 * In a raw value a driver's own numbers stand in the same places (a range sensor's volts, say); the first is what the device's
 * calibration translates.
 */
#ifndef IRIS_OSIRIS_DEVICE_H
#define IRIS_OSIRIS_DEVICE_H

#include "iris/osiris/pose.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define OSIRIS_DEVICES_MAX     64
#define OSIRIS_NAME_BYTES      16 /* of a device, with the 0 at its end */
#define OSIRIS_VALUES          4
#define OSIRIS_CALIBRATION_MAX 8

typedef enum {
    OSIRIS_NOTHING = 0,
    OSIRIS_CAMERA, /* sensors */
    OSIRIS_RANGE,
    OSIRIS_LINE,
    OSIRIS_BUMP,
    OSIRIS_ODOMETRY,
    OSIRIS_HEADING,
    OSIRIS_BATTERY,
    OSIRIS_DRIVE, /* actuators */
    OSIRIS_STEERING,
    OSIRIS_GRIPPER,
    OSIRIS_LIGHT,
    OSIRIS_SOUND,
    OSIRIS_KINDS
} osiris_kind;

/* What a raw value and a reading are worth. */
typedef enum {
    OSIRIS_NEVER = 0, /* none has come yet */
    OSIRIS_VALID,
    OSIRIS_BEYOND, /* it works, and there is nothing within its reach: no echo, no line, no object */
    OSIRIS_STALE,  /* none has come for too long (readings only) */
    OSIRIS_BROKEN  /* the driver failed, or what it says cannot be */
} osiris_validity;

/* As a driver hands it over, or takes it. A zeroed one says nothing. */
typedef struct {
    osiris_kind kind;
    osiris_validity validity; /* OSIRIS_VALID or OSIRIS_BEYOND */
    uint32_t time_ms;         /* by the caller's clock, when it was handed over */
    int32_t values[OSIRIS_VALUES];
} osiris_raw;

/* As the model makes it. Uncertainty: one standard deviation of each value, in its unit. */
typedef struct {
    osiris_kind kind;
    osiris_validity validity;
    uint32_t time_ms; /* when it was true: the device's latency is taken off */
    int32_t values[OSIRIS_VALUES];
    int32_t uncertainty[OSIRIS_VALUES];
} osiris_reading;

/* What raw[i] means: value[i]; straight in between, and on at both ends. raw grows. No points: a raw value is the value. */
typedef struct {
    int32_t count; /* 0, or 2..OSIRIS_CALIBRATION_MAX */
    int32_t raw[OSIRIS_CALIBRATION_MAX];
    int32_t value[OSIRIS_CALIBRATION_MAX];
} osiris_calibration;

typedef struct {
    osiris_kind kind;
    char name[OSIRIS_NAME_BYTES];
    int32_t driver;  /* which of the robot's drivers has it, from 0 */
    int32_t channel; /* which of the driver's devices of its kind it is, from 0 */
    osiris_pose
        place; /* on the robot, nearer than 10 m; heading: where it looks, counterclockwise from ahead */
    int32_t height_mm; /* above the floor */
    int32_t width; /* of what it sees, angle units, 0..65536: a cone's full angle, a camera's field of view */
    int32_t least, most;  /* see above */
    int32_t resolution;   /* the smallest step of its first value, 1 or more */
    int32_t deviation;    /* of its first value: noise, one standard deviation, 0 or more */
    int32_t error_permil; /* what is added to that for each 1000 of the value: 0..1000 */
    int32_t period_ms;    /* between two readings, 1..60000 */
    int32_t latency_ms;   /* from what was true to the reading, 0..10000 */
    osiris_calibration calibration;
} osiris_device;

/* Drives the devices of one robot, or some of them. None of the functions waits. */
typedef struct {
    iris_status (*open)(void *context, uint32_t now_ms);
    /* The newest raw value of a device. IRIS_ERR_TIMEOUT: nothing new since the last call; IRIS_ERR_UNSUPPORTED: it has no
     * such device; others: it failed. *raw is written with IRIS_OK only. */
    iris_status (*read)(void *context, osiris_raw *raw, const osiris_device *device, uint32_t now_ms);
    /* Tells an actuator. IRIS_ERR_UNSUPPORTED: it has no such device; others: it failed. */
    iris_status (*write)(void *context, const osiris_device *device, const osiris_raw *raw, uint32_t now_ms);
    void (*close)(void *context, uint32_t now_ms); /* with everything standing still */
} osiris_driver;

/* A device of this kind with its usual reach and rate, in the middle of the robot, looking ahead; without a name. Null is
 * ignored. O(1). */
void osiris_device_defaults(osiris_device *device, osiris_kind kind);

/* IRIS_ERR_ARG: null pointer, a number outside its range, least above most, a place 10 m or more away, a
 * calibration that does not grow, or a name without an end. O(1). */
iris_status osiris_device_check(const osiris_device *device);

/* What a raw value means, rounded and saturated; and the other way: the raw value that means this, of the piece that has
 * it, else of the end that is nearer to it. For a calibration that osiris_device_check accepts. O(points), one division. */
int32_t osiris_calibration_value(const osiris_calibration *calibration, int32_t raw);
int32_t osiris_calibration_raw(const osiris_calibration *calibration, int32_t value);

/* Is it a sensor? O(1). */
static inline int osiris_kind_is_sensor(osiris_kind kind)
{
    return kind > OSIRIS_NOTHING && kind < OSIRIS_DRIVE;
}

/* "camera" and so on, and the unit of the first value, such as "mm" ("" where it has none). Never null; static storage. */
const char *osiris_kind_name(osiris_kind kind);
const char *osiris_kind_unit(osiris_kind kind);

#ifdef __cplusplus
}
#endif

#endif
