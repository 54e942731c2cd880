#include "iris/differential.h"

#include <stddef.h>

void iris_differential_defaults(iris_differential_config *config)
{
    if (config) {
        config->turn_permil = 1000;
        config->limit_permil = 1000;
        config->least_permil = 0;
    }
}

static int is_within(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

/* value / by, rounded to nearest, halves away from 0: the same to the left and to the right. */
static int32_t divided(int32_t value, int32_t by)
{
    return value < 0 ? -((by / 2 - value) / by) : (value + by / 2) / by;
}

static int32_t at_least(int32_t speed, int32_t least)
{
    if (speed > 0 && speed < least) {
        return least;
    }
    return speed < 0 && speed > -least ? -least : speed;
}

iris_status iris_differential_mix(iris_wheels *wheels, const iris_command *command,
                                  const iris_differential_config *config)
{
    iris_differential_config defaults;
    if (!config) {
        iris_differential_defaults(&defaults);
        config = &defaults;
    }
    if (!wheels || !command || !is_within(config->turn_permil, 0, 4000) ||
        !is_within(config->limit_permil, 0, 1000) ||
        !is_within(config->least_permil, 0, config->limit_permil) ||
        !is_within(command->steer_permil, -1000, 1000) || !is_within(command->speed_permil, 0, 1000)) {
        return IRIS_ERR_ARG;
    }
    /* In permil of the speed: 1000 + 4000 at most, so that all products fit */
    int32_t turn = divided(config->turn_permil * command->steer_permil, 1000);
    int32_t left = divided(command->speed_permil * (1000 + turn), 1000);
    int32_t right = divided(command->speed_permil * (1000 - turn), 1000);
    int32_t outer = left > right ? left : right;
    if (outer > config->limit_permil) {
        left = divided(left * config->limit_permil, outer);
        right = divided(right * config->limit_permil, outer);
    }
    wheels->left_permil = at_least(left, config->least_permil);
    wheels->right_permil = at_least(right, config->least_permil);
    return IRIS_OK;
}
