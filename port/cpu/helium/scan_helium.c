/* Sums and comparisons of blocks of eight pixels, two blocks in a vector. */
#include <arm_mve.h>

#include "kernel.h"

void iris_row_scan8_u8_helium(iris_block8 *block, const uint8_t *src, int32_t n)
{
    static const uint8_t where[16] = {2, 2, 2, 2, 2, 2, 2, 2, 6, 6, 6, 6, 6, 6, 6, 6}; /* limits are */
    const uint8x16_t limit_of = vldrbq_u8(where);
    for (; n >= 16; n -= 16, src += 16, block += 2) {
        uint8x16_t limits = vldrbq_gather_offset_u8((const uint8_t *)block, limit_of);
        uint32_t below = vcmphiq_u8(limits, vldrbq_u8(src));
        block[0].sum = (uint16_t)vaddvq_u16(vldrbq_u16(src));
        block[1].sum = (uint16_t)vaddvq_u16(vldrbq_u16(src + 8));
        block[0].below = (uint8_t)below;
        block[1].below = (uint8_t)(below >> 8);
    }
    if (n > 0) {
        iris_row_scan8_u8_c(block, src, n);
    }
}
