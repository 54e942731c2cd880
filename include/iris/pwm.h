/* IRIS - a motor on two lines: its direction, and its speed by pulses made in software.
 *
 *     iris_pwm_run(&motor, speed_permil, now_us);
 *     set the lines to motor.level and motor.backward, sleep for motor.wait_us at most, again
 *
 * A period begins with the pulse, whose length is the speed's share of it; 0 and full speed have no edges. A new speed
 * counts from the next period on, so that no pulse is cut short or doubled, however often commands come; but a stop ends the
 * pulse at once, and so does a change of direction. Periods lie on one grid from the start on: an edge that comes late moves
 * no other.
 *
 * The clock is any of the caller's that counts microseconds and may wrap. Call at least once in half an hour.
 */
#ifndef IRIS_PWM_H
#define IRIS_PWM_H

#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Read the first three; the rest belongs to the functions. */
typedef struct {
    int32_t level;    /* of the pulse line now: 0 or 1 */
    int32_t backward; /* the direction line: 1 backwards; stays while the motor stands */
    int32_t wait_us;  /* until the next edge or the next period, at least 1 */

    int32_t period_us;
    int32_t pulse_us; /* of this period */
    int32_t speed;    /* that it was made for */
    uint32_t begin_us;
} iris_pwm;

/* Makes *pwm ready, standing still; its first period begins at now_us.
 *   rate_hz  1 to 10000 periods a second. More than 1000 is for clocks and lines that are fast enough.
 * IRIS_ERR_ARG: null pointer, or the rate. O(1). */
iris_status iris_pwm_init(iris_pwm *pwm, int32_t rate_hz, uint32_t now_us);

/* The lines now, for this speed: -1000..1000 permil, forwards positive, what is beyond counts as the limit. Null does
 * nothing. O(1): two divisions when a period begins, none within. */
void iris_pwm_run(iris_pwm *pwm, int32_t speed_permil, uint32_t now_us);

#ifdef __cplusplus
}
#endif

#endif
