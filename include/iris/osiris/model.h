/* Osiris - the model of a device: from what its driver hands over to a reading in units that people use, with the time when it
 * was true, whether it is worth anything, and how far it may be off.
 *
 * Uncertainty is one standard deviation: the device's deviation, its error in permil of the value, and what its steps leave open
 * (a twelfth of a step's square), together by squares.
 */
#ifndef IRIS_OSIRIS_MODEL_H
#define IRIS_OSIRIS_MODEL_H

#include "iris/osiris/device.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A reading is stale when it is older than three periods of its device and this. */
#define OSIRIS_STALE_MS 200

/* What a raw value means: calibrated, checked, and with the device's latency taken off its time.
 *   nothing within reach  OSIRIS_BEYOND: said so, or a range or object above `most`, a line farther aside than `most`
 *   what cannot be        OSIRIS_BROKEN: another kind than the device's, another validity than a raw value has, an angle or
 *                         radius outside its range
 * Below `least` a range counts as that; a battery's charge is 0 to 1000.
 * IRIS_ERR_ARG: null pointer, or a bad device; *reading is untouched. O(1): two square roots at most. */
iris_status osiris_model_read(osiris_reading *reading, const osiris_device *device, const osiris_raw *raw);

/* Makes a valid reading, or one of nothing, stale when it is too old now. Null is ignored. O(1). */
void osiris_model_age(osiris_reading *reading, const osiris_device *device, uint32_t now_ms);

/* The other way, for an actuator: the raw value that its driver is to take, values limited to what the device does (steering
 * and sound to least and most, a gripper to 0..1000, colors to 24 bits) and calibrated.
 * IRIS_ERR_ARG: null pointer, a bad device, or a sensor; *raw is untouched. O(1). */
iris_status osiris_model_write(osiris_raw *raw, const osiris_device *device,
                               const int32_t values[OSIRIS_VALUES], uint32_t now_ms);

#ifdef __cplusplus
}
#endif

#endif
