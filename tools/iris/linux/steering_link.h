/* What passes between `iris follow` and its steering process, over a socket that keeps messages apart. */
#ifndef IRIS_TOOL_STEERING_LINK_H
#define IRIS_TOOL_STEERING_LINK_H

#include <stdint.h>
#include <time.h>

#include "iris/command.h"

typedef enum {
    STEERING_COMMAND,
    STEERING_HALT,    /* stop until the next command */
    STEERING_FAREWELL /* the last message: the program ends as it should */
} steering_kind;

/* To the steering process. */
typedef struct {
    steering_kind kind;
    int64_t time_ms;      /* when it was made */
    iris_command command; /* of STEERING_COMMAND; its number is the steering process's to give */
} steering_message;

/* The steering process sends any byte so often at least: it is alive. The first one says that everything is open. */
#define STEERING_ALIVE_MS 100

/* How long stopping may take: what is connected is given half a second, and some to the process itself. */
#define STEERING_STOP_MS      500
#define STEERING_STOP_MOST_MS 1000

/* Lines stay safe so long before they are given back: long enough for a relay. */
#define STEERING_HOLD_MS 100

static inline int64_t steering_clock_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static inline int64_t steering_clock_ms(void)
{
    return steering_clock_us() / 1000;
}

static inline void steering_sleep_ms(int32_t ms)
{
    const struct timespec pause = {ms / 1000, (long)(ms % 1000) * 1000000};
    nanosleep(&pause, NULL);
}

#endif
