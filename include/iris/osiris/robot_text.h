/* Osiris - robot files: a robot as a text that people write, one thing on a line. Files are in examples/robots.
 *
 *     robot NAME
 *     body LENGTH WIDTH [ahead MM]         mm; its middle lies ahead of the reference point (pose.h, drive.h)
 *     driver NAME simulated
 *     driver NAME serial PATH [rate BAUD]                                               115200
 *     driver NAME gpio CHIP left-dir N left-pwm N right-dir N right-pwm N [rate HZ]     lines of the chip; 100
 *     driver NAME camera PATH                                                           a device, or a recording
 *     drive differential track MM {attribute}
 *     drive ackermann track MM wheelbase MM steering DEGREES [steering-rate DEGREES/S] {attribute}
 *     drive omni wheels 3|4 radius MM {attribute}
 *         attributes: speed MM/S  turn DEGREES/S  acceleration MM/S^2  turn-acceleration DEGREES/S^2  by DRIVER
 *     KIND NAME {attribute}                camera range line bump odometry heading battery steering gripper light sound
 *         at X Y         where on the robot, mm: ahead, and to the left           0 0
 *         height MM      above the floor                                          0
 *         facing DEGREES where it looks, counterclockwise from ahead              0
 *         cone DEGREES   the full angle that it sees
 *         from N, to N   what it can tell: mm; battery mV; steering degrees; sound Hz
 *         step N         its smallest step                                        1
 *         noise N        one standard deviation                                   0
 *         error PERCENT  of the value, added to that                              0
 *         rate HZ        how often it measures
 *         latency MS     from what was true to its reading                        0
 *         by DRIVER      who drives it: the first one, if this is left out
 *         channel N      which of the driver's devices of this kind               counts from 0
 *         calibrate RAW VALUE RAW VALUE ...   what raw values mean; 2 to 8 pairs, the raw ones growing
 *
 * From, to, step, and noise of headings and steerings are in degrees. Words stand in any order behind the first two; what
 * follows a # does not count. Without a driver line there is one, "simulated". Drivers stand before what names them. The drive
 * is the device "drive".
 */
#ifndef IRIS_OSIRIS_ROBOT_TEXT_H
#define IRIS_OSIRIS_ROBOT_TEXT_H

#include <stddef.h>

#include "iris/osiris/plan.h"
#include "iris/osiris/problem.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Reads `bytes` bytes of any content; a 0 at their end is no part of the text. plan->devices is `devices` then, of which
 * there are `capacity` (OSIRIS_DEVICES_MAX are always enough), and osiris_plan_check accepts the plan.
 * IRIS_ERR_ARG: null pointer. The others set *problem, and *plan and devices are of no use: IRIS_ERR_FULL: more devices than
 * capacity or OSIRIS_DEVICES_MAX, or more drivers than OSIRIS_DRIVERS_MAX; IRIS_ERR_DATA: anything else.
 * O(bytes + devices^2). */
iris_status osiris_robot_read_text(osiris_plan *plan, osiris_device *devices, int32_t capacity,
                                   osiris_problem *problem, const char *text, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif
