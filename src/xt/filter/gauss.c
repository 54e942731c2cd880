#include "gauss.h"

#define ONE_Q31 ((uint32_t)1 << 31)

/* exp(-t) is the product of exp(-2^i) over the set bits of t from 16 down to 1/1024, times 1 - x + x^2 / 2 of the
 * rest. */
static uint32_t exp_minus_q31(uint64_t t_q32)
{
    static const uint32_t power[15] = {242u,        720401u,     39332535u,   290630308u,  790015084u,
                                       1302514674u, 1672461947u, 1895147668u, 2017374191u, 2081412522u,
                                       2114190000u, 2130771798u, 2139111403u, 2143293437u, 2145387520u};
    if (t_q32 >> 37 != 0) {
        return 0;
    }
    uint64_t result = ONE_Q31;
    for (int i = 0; i < 15; i++) {
        if (t_q32 >> (36 - i) & 1) {
            result = (result * power[i] + (ONE_Q31 >> 1)) >> 31;
        }
    }
    uint64_t x_q32 = t_q32 & (((uint64_t)1 << 22) - 1);
    uint64_t rest = ONE_Q31 - (x_q32 >> 1) + (x_q32 * x_q32 >> 34);
    return (uint32_t)((result * rest + (ONE_Q31 >> 1)) >> 31);
}

uint32_t iris_gauss_q31(int32_t squared, iris_q16 sigma_q16)
{
    uint64_t variance_q32 = (uint64_t)sigma_q16 * (uint64_t)sigma_q16;
    return exp_minus_q31((uint64_t)squared * (((uint64_t)1 << 63) / variance_q32));
}
