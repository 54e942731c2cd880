#include "iris/watchdog.h"

#include <stddef.h>

iris_status iris_watchdog_init(iris_watchdog *dog, int32_t deadline_ms)
{
    if (!dog || deadline_ms < 1 || deadline_ms > IRIS_WATCHDOG_MAX_MS) {
        return IRIS_ERR_ARG;
    }
    dog->expirations = 0;
    dog->deadline_ms = deadline_ms;
    dog->fed_ms = 0;
    dog->expired = 1;
    return IRIS_OK;
}

void iris_watchdog_feed(iris_watchdog *dog, uint32_t now_ms)
{
    if (dog) {
        dog->fed_ms = now_ms;
        dog->expired = 0;
    }
}

int32_t iris_watchdog_left_ms(iris_watchdog *dog, uint32_t now_ms)
{
    if (!dog || dog->expired) {
        return 0;
    }
    uint32_t elapsed_ms = now_ms - dog->fed_ms;
    if (elapsed_ms > (uint32_t)dog->deadline_ms) {
        dog->expired = 1;
        dog->expirations++;
        return 0;
    }
    return dog->deadline_ms - (int32_t)elapsed_ms + 1;
}

int iris_watchdog_expired(iris_watchdog *dog, uint32_t now_ms)
{
    return iris_watchdog_left_ms(dog, now_ms) == 0;
}
