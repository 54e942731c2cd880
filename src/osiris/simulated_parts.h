/* What moves a simulated robot, and what measures for it.
 */
#ifndef OSIRIS_SIMULATED_PARTS_H
#define OSIRIS_SIMULATED_PARTS_H

#include "iris/osiris/simulated.h"

/* What a device of the plan measures now. */
void osiris_simulated_measure(osiris_simulated *robot, osiris_raw *raw, const osiris_device *device);

#endif
