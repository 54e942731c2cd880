/* A drive over one junction: the robot comes from the south, is told where to go, and must end on that branch. */
#ifndef SIM_BRANCH_H
#define SIM_BRANCH_H

#include <stdint.h>

/* kind: t, left, right (a branch to one side of a straight line), y, or crossing; take: left, right, or straight; by:
 * the robot, demo, over (its camera is over the axle), ahead (far ahead of it), or slow. Prints what came of it.
 * Returns 1 when the robot ends on the branch that it was told to take, 0 when not, -1 for an unknown word, or a
 * junction that does not have the branch. */
int sim_branch_drive(const char *kind, const char *take, const char *by, uint32_t seed);

#endif
