#include "iris/indicator.h"

#include <stddef.h>

void iris_indicator_defaults(iris_indicator_config *config)
{
    if (config) {
        config->on_permil = 100;
        config->off_permil = 50;
    }
}

iris_status iris_indicator_init(iris_indicator *indicator, const iris_indicator_config *config)
{
    iris_indicator_config defaults;
    iris_indicator_defaults(&defaults);
    config = config ? config : &defaults;
    if (!indicator || config->on_permil < 1 || config->on_permil > 1000 || config->off_permil < 0 ||
        config->off_permil > config->on_permil) {
        return IRIS_ERR_ARG;
    }
    indicator->lines = IRIS_INDICATE_STOP;
    indicator->config = *config;
    return IRIS_OK;
}

uint32_t iris_indicator_update(iris_indicator *indicator, const iris_command *command)
{
    if (!indicator || !command) {
        return IRIS_INDICATE_STOP;
    }
    const int32_t steer = command->steer_permil;
    uint32_t lines = indicator->lines;
    uint32_t now = ~lines & IRIS_INDICATE_HEARTBEAT;
    if (command->speed_permil <= 0) {
        now |= IRIS_INDICATE_STOP;
    } else {
        const iris_indicator_config *config = &indicator->config;
        int32_t left_from = lines & IRIS_INDICATE_LEFT ? config->off_permil + 1 : config->on_permil;
        int32_t right_from = lines & IRIS_INDICATE_RIGHT ? config->off_permil + 1 : config->on_permil;
        now |= steer <= -left_from ? IRIS_INDICATE_LEFT : 0;
        now |= steer >= right_from ? IRIS_INDICATE_RIGHT : 0;
    }
    indicator->lines = now;
    return now;
}
