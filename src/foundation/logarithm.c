#include "logarithm.h"

#define STEPS   31
#define LN2_Q58 0x2C5C85FDF473DE7u
#define ONE_Q62 ((uint64_t)1 << 62)

/* ln(1 + 2^-k) with 58 fraction bits, k from 1 on. */
static const uint64_t ln_of_factor[STEPS] = {
    0x19F323ECBF984BF, 0x0E47FBE3CD4D10D, 0x0789C1DB8ABCB98, 0x03E14618022C54D, 0x01F829B0E783300,
    0x00FE054587E01F2, 0x007F80A9AC419E2, 0x003FE0154562178, 0x001FF802A9AB10E, 0x000FFE005545588,
    0x0007FF800AA9AAC, 0x0003FFE00155455, 0x0001FFF8002AA9B, 0x0000FFFE0005554, 0x00007FFF8000AAB,
    0x00003FFFE000155, 0x00001FFFF80002B, 0x00000FFFFE00005, 0x000007FFFF80001, 0x000003FFFFE0000,
    0x000001FFFFF8000, 0x000000FFFFFE000, 0x0000007FFFFF800, 0x0000003FFFFFE00, 0x0000001FFFFFF80,
    0x0000000FFFFFFE0, 0x00000007FFFFFF8, 0x00000003FFFFFFE, 0x000000020000000, 0x000000010000000,
    0x000000008000000,
};

/* n = 2^e m with m from 1 up to below 2. Factors carry m up to just below 2; of 2 - m = 2 d what is missing there is
 * ln(1 / (1 - d)), which is d to the last bit. */
uint64_t iris_ln_q58(uint32_t n)
{
    uint64_t m = n;
    uint32_t e = 62;
    for (; m < ONE_Q62; m += m) {
        e--;
    }
    uint64_t ln = (e + 1) * LN2_Q58;
    for (int k = 1; k <= STEPS; k++) {
        uint64_t next = m + (m >> k);
        if (next <= 2 * ONE_Q62) {
            m = next;
            ln -= ln_of_factor[k - 1];
        }
    }
    return ln - ((2 * ONE_Q62 - m) >> 5);
}

/* e^-v = e^f / 2^n with f from 0 up to below ln 2; e^f is the product of the factors whose logarithms sum up to f. */
uint64_t iris_exp_minus_q56(uint64_t v_q58)
{
    uint64_t n = v_q58 / LN2_Q58 + 1;
    if (n > 56) {
        return 0;
    }
    uint64_t f = n * LN2_Q58 - v_q58, y = ONE_Q62;
    for (int k = 1; k <= STEPS; k++) {
        if (f >= ln_of_factor[k - 1]) {
            f -= ln_of_factor[k - 1];
            y += y >> k;
        }
    }
    y += ((y >> 27) * f) >> 31;
    return y >> (n + 6);
}
