/* IRIS - a watchdog: no fresh command within the deadline means stop.
 *
 *     if (a command has come) {
 *         iris_watchdog_feed(&dog, now_ms);
 *     }
 *     if (iris_watchdog_expired(&dog, now_ms)) {
 *         stop();
 *     }
 *
 * It starts expired: what has had no command yet does not move. Once expired, it stays so until it is fed again.
 *
 * The clock is any of the caller's that counts milliseconds and may wrap. Ask at least once in 24 days, as every control
 * loop does. A time before the last feeding, which no clock should tell, counts as too late.
 */
#ifndef IRIS_WATCHDOG_H
#define IRIS_WATCHDOG_H

#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The longest deadline: 10 minutes. */
#define IRIS_WATCHDOG_MAX_MS 600000

/* Read `expirations`; the rest belongs to the functions. */
typedef struct {
    uint32_t expirations; /* deadlines that passed; wraps */
    int32_t deadline_ms;
    uint32_t fed_ms;
    int32_t expired;
} iris_watchdog;

/* Makes *dog ready, expired.
 *   deadline_ms  1 to IRIS_WATCHDOG_MAX_MS: so long after a command all is well; later it is too late
 * IRIS_ERR_ARG: null pointer, or the deadline. O(1). */
iris_status iris_watchdog_init(iris_watchdog *dog, int32_t deadline_ms);

/* A fresh command has come. Null does nothing. O(1). */
void iris_watchdog_feed(iris_watchdog *dog, uint32_t now_ms);

/* 1: stop; 0: go on. Null is expired. O(1). */
int iris_watchdog_expired(iris_watchdog *dog, uint32_t now_ms);

/* Milliseconds until it would expire, at least 1; 0 when it has. For how long a loop may sleep. Null: 0. O(1). */
int32_t iris_watchdog_left_ms(iris_watchdog *dog, uint32_t now_ms);

#ifdef __cplusplus
}
#endif

#endif
