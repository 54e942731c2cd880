/* A robot's hardware, as its robot file names it: serial ports and lines of a GPIO chip. Once in linux/, refused in none/.
 */
#ifndef IRIS_TOOL_REAL_ROBOT_H
#define IRIS_TOOL_REAL_ROBOT_H

#include "iris/osiris/plan.h"

/* By the plan's drivers, which are to stay; null where there is none: a camera, which needs somebody who looks. */
typedef struct {
    const osiris_driver *drivers[OSIRIS_DRIVERS_MAX];
    void *contexts[OSIRIS_DRIVERS_MAX];
} robot_drivers;

/* Opens them. Complains; returns 1, or 0. */
int real_robot_open(robot_drivers *drivers, const osiris_plan *plan, uint32_t now_ms);

/* Makes the pulses of motors on lines. Returns after how many microseconds to call it again at the latest. */
int64_t real_robot_run(int64_t now_us);

/* With everything standing still. */
void real_robot_close(uint32_t now_ms);

#endif
