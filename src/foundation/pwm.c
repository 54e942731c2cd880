#include "iris/pwm.h"

#include <stddef.h>

iris_status iris_pwm_init(iris_pwm *pwm, int32_t rate_hz, uint32_t now_us)
{
    if (!pwm || rate_hz < 1 || rate_hz > 10000) {
        return IRIS_ERR_ARG;
    }
    pwm->level = 0;
    pwm->backward = 0;
    pwm->period_us = 1000000 / rate_hz;
    pwm->wait_us = pwm->period_us;
    pwm->pulse_us = 0;
    pwm->speed = 0;
    pwm->begin_us = now_us;
    return IRIS_OK;
}

static void start_pulse(iris_pwm *pwm, int32_t speed)
{
    int32_t magnitude = speed < 0 ? -speed : speed;
    pwm->speed = speed;
    pwm->pulse_us = magnitude * (pwm->period_us / 1000) + (magnitude * (pwm->period_us % 1000) + 500) / 1000;
}

void iris_pwm_run(iris_pwm *pwm, int32_t speed_permil, uint32_t now_us)
{
    if (!pwm) {
        return;
    }
    int32_t speed = speed_permil > 1000 ? 1000 : speed_permil < -1000 ? -1000 : speed_permil;
    uint32_t elapsed_us = now_us - pwm->begin_us;
    const uint32_t period_us = (uint32_t)pwm->period_us;
    if (elapsed_us >= period_us) {
        uint32_t into_us = elapsed_us % period_us;
        pwm->begin_us = now_us - into_us;
        elapsed_us = into_us;
        start_pulse(pwm, speed);
        pwm->backward = speed == 0 ? pwm->backward : speed < 0;
    } else if (pwm->speed != 0 && (speed == 0 || (speed < 0) != (pwm->speed < 0))) {
        start_pulse(pwm, 0);
    }
    int32_t at_us = (int32_t)elapsed_us;
    pwm->level = at_us < pwm->pulse_us;
    pwm->wait_us = (pwm->level ? pwm->pulse_us : pwm->period_us) - at_us;
}
