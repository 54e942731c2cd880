/* IRIS - four lines that say what a command says, for robots and people that read no sentences: left, right, stop, and a
 * heartbeat.
 *
 *     left, right   steering to that side: on from on_permil on, off again at off_permil; never both, and none at a stop
 *     stop          the speed is 0
 *     heartbeat     the other level with each command: it beats only while commands come
 */
#ifndef IRIS_INDICATOR_H
#define IRIS_INDICATOR_H

#include <stdint.h>

#include "iris/command.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The lines, a bit each. */
#define IRIS_INDICATE_LEFT      1u
#define IRIS_INDICATE_RIGHT     2u
#define IRIS_INDICATE_STOP      4u
#define IRIS_INDICATE_HEARTBEAT 8u

typedef struct {
    int32_t on_permil; /* 1..1000: of steering, from which a side is on; default 100 */
    int32_t
        off_permil; /* 0..on_permil: at or below which it is off again, so that it does not flicker; default 50 */
} iris_indicator_config;

/* Read `lines`; the rest belongs to the functions. */
typedef struct {
    uint32_t lines; /* IRIS_INDICATE_..., of the last command */
    iris_indicator_config config;
} iris_indicator;

/* The values above. Null is ignored. O(1). */
void iris_indicator_defaults(iris_indicator_config *config);

/* Makes *indicator ready: stop alone. config is copied, null means the defaults.
 * IRIS_ERR_ARG: null pointer, or a config value outside its range. O(1). */
iris_status iris_indicator_init(iris_indicator *indicator, const iris_indicator_config *config);

/* Takes a fresh command and returns the lines; any steering counts. Null: IRIS_INDICATE_STOP alone. O(1). */
uint32_t iris_indicator_update(iris_indicator *indicator, const iris_command *command);

#ifdef __cplusplus
}
#endif

#endif
