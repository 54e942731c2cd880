/* Natural logarithm and exponential with enough bits that what is made of them by one product rounds as the exact value
 * does. Shifts and additions: multiplicative normalization by factors 1 + 2^-k.
 */
#ifndef IRIS_FOUNDATION_LOGARITHM_H
#define IRIS_FOUNDATION_LOGARITHM_H

#include <stdint.h>

/* ln n with 58 fraction bits, within 2^-54; n at least 1. 31 steps. */
uint64_t iris_ln_q58(uint32_t n);

/* e^-v with 56 fraction bits, within 2^-55; v has 58 fraction bits. 31 steps and a division. */
uint64_t iris_exp_minus_q56(uint64_t v_q58);

#endif
