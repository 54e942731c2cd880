/* Turn rates and the speed of what turns: a point `arm_mm` from the middle of a turn.
 */
#ifndef OSIRIS_WHEELS_H
#define OSIRIS_WHEELS_H

#include "iris/fixed.h"
#include "rounded.h"

/* mm/s, 16 fraction bits, of a turn of so many 256ths of an angle unit a second (below 2^29): times 2 pi / 2^24 * 2^16.
 * 2 pi with 20 fraction bits. arm_mm: up to 4096. */
static inline int64_t osiris_rim_q16(int64_t turn_q8, int32_t arm_mm)
{
    return iris_round_shift(turn_q8 * arm_mm * 6588397, 28);
}

/* The other way: 2^24 / 2 pi / 2^16 with 20 fraction bits. rim_q16: up to 2^35. */
static inline int64_t osiris_turn_q8(int64_t rim_q16, int32_t arm_mm)
{
    return osiris_quotient(rim_q16 * 42722830, (int64_t)arm_mm << 20);
}

#endif
