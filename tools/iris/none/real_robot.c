#include "../real_robot.h"

#include "../complain.h"

int real_robot_open(robot_drivers *drivers, const osiris_plan *plan, uint32_t now_ms)
{
    (void)drivers;
    (void)now_ms;
    complain(plan->name, "a robot's hardware is driven on Linux only; without --real it is simulated");
    return 0;
}

int64_t real_robot_run(int64_t now_us)
{
    (void)now_us;
    return 10000;
}

void real_robot_close(uint32_t now_ms)
{
    (void)now_ms;
}
