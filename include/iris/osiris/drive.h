/* Osiris - drives: how fast each wheel turns for a movement of the robot, and the other way; limits, and ramps.
 *
 *     differential   two driven wheels at the ends of an axle. The reference point is the axle's middle
 *                    left = v + w track / 2, right = v - w track / 2
 *     Ackermann      a driven rear axle and steered front wheels. The reference point is the rear axle's middle
 *                    tan(steering) = w wheelbase / v, as the wheel in the middle of the front axle would stand; the rear wheels
 *                    as those of a differential drive
 *     omni           three or four wheels on a circle whose rims roll sideways, too, wheel i at the angle (2 i + 1) half
 *                    turns / wheels from ahead, to the left. The reference point is the circle's middle
 *                    wheel i = -sin(a) ahead + cos(a) left - w radius
 *
 * v is in mm/s, w the turn rate, positive to the right (pose.h), here in radians. J. Borenstein, H. R. Everett, L. Feng,
 * "Where am I?", 1996, section 1.
 *
 * A wish is brought to what the drive can do so that the robot's curve stays the same: where a wheel would be too fast, all
 * are slowed down alike. An Ackermann drive keeps its speed where a curve is too tight, and steers as far as it can; and asked to
 * turn on the spot, it shuffles: ahead and back with its wheels turned to either side, which turns it where it stands.
 */
#ifndef IRIS_OSIRIS_DRIVE_H
#define IRIS_OSIRIS_DRIVE_H

#include "iris/osiris/pose.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define OSIRIS_WHEELS_MAX    4
#define OSIRIS_SPEED_MAX_MMS 16000   /* of a wheel */
#define OSIRIS_TURN_RATE_MAX 1048576 /* 16 turns a second */
#define OSIRIS_SIDE_MAX_MM   4000    /* track, wheelbase, radius */

typedef enum { OSIRIS_DIFFERENTIAL = 0, OSIRIS_ACKERMANN, OSIRIS_OMNI } osiris_drive_kind;

typedef struct {
    osiris_drive_kind kind;
    int32_t track_mm;     /* 1..OSIRIS_SIDE_MAX_MM: between left and right wheels; omni: not used */
    int32_t wheelbase_mm; /* 1..OSIRIS_SIDE_MAX_MM: Ackermann: between the axles */
    int32_t radius_mm;    /* 1..OSIRIS_SIDE_MAX_MM: omni: from the middle to each wheel */
    int32_t wheels;       /* 3 or 4: omni */
    int32_t steering_max; /* angle units, 182..14563 (1 to 80 degrees): Ackermann, to either side */
    int32_t
        steering_rate; /* angle units/s, 1..OSIRIS_TURN_RATE_MAX: Ackermann: how fast the wheels are steered */
    int32_t speed_max_mms;     /* of a wheel, 1..OSIRIS_SPEED_MAX_MMS */
    int32_t turn_rate_max;     /* of the robot, angle units/s, 1..OSIRIS_TURN_RATE_MAX */
    int32_t acceleration_mms2; /* 1..1000000, speeding up and slowing down */
    int32_t turn_acceleration; /* angle units/s^2, 1..100000000; Ackermann: not used */
} osiris_drive_config;

/* What the wheels do. speed_q16: mm/s of a wheel's rim, 16 fraction bits. Differential: left, right. Ackermann: rear left,
 * rear right, and the steering, angle units, positive to the right. Omni: wheel 0 to wheels - 1. */
typedef struct {
    int32_t count;
    iris_q16 speed_q16[OSIRIS_WHEELS_MAX];
    iris_angle steering;
} osiris_wheels;

/* A drive on its way to what is wanted. Read `velocity` and `steering`; the rest belongs to the functions. */
typedef struct {
    osiris_drive_config config;
    osiris_velocity velocity; /* that the robot is told to have now */
    iris_angle steering;      /* Ackermann: where the wheels stand, positive to the right */
    int32_t steering_q8;
    int32_t shuffled_q8; /* mm that this piece of a turn on the spot has lasted */
    int8_t shuffle;      /* 1: ahead, -1: back, 0: no turn on the spot */
} osiris_drive;

/* An ordinary small robot of this kind: 150 mm between wheels, 160 mm between axles, three omni wheels at 100 mm, 500 mm/s,
 * 180 degrees/s, 1000 mm/s^2, 720 degrees/s^2, steering up to 30 degrees at 180 degrees/s. Null is ignored. O(1). */
void osiris_drive_defaults(osiris_drive_config *config, osiris_drive_kind kind);

/* IRIS_ERR_ARG: null pointer, or a value outside its range that this kind uses. O(1). */
iris_status osiris_drive_check(const osiris_drive_config *config);

/* Makes *drive stand still. IRIS_ERR_ARG as above; *drive is untouched. O(1). */
iris_status osiris_drive_init(osiris_drive *drive, const osiris_drive_config *config);

/* The wheels for a velocity that the drive can have (osiris_drive_limit). What a drive cannot do - to the left, but for omni;
 * a tighter curve than the steering allows - is left out. Speeds saturate.
 * Differential and omni: exact to 2/65536 mm/s, and a part in 20 million of what the turn makes. Ackermann: the steering is the nearest angle unit; one that stands keeps it at 0.
 * IRIS_ERR_ARG: null pointer, or a bad config; *wheels is untouched. O(1). */
iris_status osiris_drive_wheels(osiris_wheels *wheels, const osiris_drive_config *config,
                                const osiris_velocity *velocity);

/* The velocity that wheels give: of more than two wheels, the one that fits best (least squares).
 * osiris_drive_velocity(osiris_drive_wheels(v)) is v, within 2/65536 mm/s and 1/256 angle unit a second for each 100 mm/s or so
 * of the wheels; for Ackermann within what half an angle unit of steering makes. Saturates.
 * IRIS_ERR_ARG: null pointer, a bad config, or another count of wheels. O(1). */
iris_status osiris_drive_velocity(osiris_velocity *velocity, const osiris_drive_config *config,
                                  const osiris_wheels *wheels);

/* Brings *velocity to what the drive can do at most, as said above. IRIS_ERR_ARG: null pointer, or a bad config. O(1). */
iris_status osiris_drive_limit(osiris_velocity *velocity, const osiris_drive_config *config);

/* Goes on towards `wanted` for elapsed_ms, 0..1000 (less and more count as these), by the drive's ramps; drive->velocity is
 * what the robot is to do now. Every wanted velocity is taken, limited first. Ahead, left, and turn have ramps of their own;
 * Ackermann: the speed and the steering have.
 * IRIS_ERR_ARG: null pointer, or *drive was not made by osiris_drive_init. O(1). */
iris_status osiris_drive_step(osiris_drive *drive, const osiris_velocity *wanted, int32_t elapsed_ms);

/* Stands still at once, without a ramp: for an emergency. Null is ignored. O(1). */
void osiris_drive_halt(osiris_drive *drive);

/* The radius of the tightest curve, mm, of the reference point: 0 for those that turn on the spot. O(1). */
int32_t osiris_drive_radius_min(const osiris_drive_config *config);

#ifdef __cplusplus
}
#endif

#endif
