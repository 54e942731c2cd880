#include "iris/runtime/event.h"

#include <stddef.h>

const char *iris_event_name(int32_t kind)
{
    static const char *const names[IRIS_EVENT_KINDS] = {
        "none",   "object detected", "object lost", "reached", "line end",
        "bumped", "battery low",     "failed",      "stopped", "expired"};
    return kind >= 0 && kind < IRIS_EVENT_KINDS ? names[kind] : NULL;
}
