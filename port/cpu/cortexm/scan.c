/* Sums and comparisons of blocks of eight pixels, four bytes at a time. */
#include <string.h>

#include <arm_acle.h>

#include "kernel.h"

static inline uint32_t word_at(const uint8_t *p)
{
    uint32_t word;
    memcpy(&word, p, 4);
    return word;
}

/* Bit i = byte i of word is below byte i of limits. */
static inline uint32_t below(uint32_t word, uint32_t limits)
{
    (void)__usub8(word, limits);
    return __usad8(__sel(0, 0x08040201u), 0);
}

/* The byte four times; by one multiplication, which the compiler would replace by two additions. */
static inline uint32_t four_of(uint32_t byte)
{
    uint32_t ones = 0x01010101u;
    __asm__("" : "+r"(ones));
    return byte * ones;
}

static inline void scan_pair(iris_block8 *block, const uint8_t *src)
{
    uint32_t x0 = word_at(src), x1 = word_at(src + 4), x2 = word_at(src + 8), x3 = word_at(src + 12);
    uint32_t limits0 = four_of(block[0].limit), limits1 = four_of(block[1].limit);
    block[0].sum = (uint16_t)__usada8(x1, 0, __usad8(x0, 0));
    block[1].sum = (uint16_t)__usada8(x3, 0, __usad8(x2, 0));
    block[0].below = 0;
    block[1].below = 0;
    if (__builtin_expect((__uqsub8(limits0, x0) | __uqsub8(limits0, x1) | __uqsub8(limits1, x2) |
                          __uqsub8(limits1, x3)) != 0,
                         0)) {
        block[0].below = (uint8_t)(below(x0, limits0) | below(x1, limits0) << 4);
        block[1].below = (uint8_t)(below(x2, limits1) | below(x3, limits1) << 4);
    }
}

/* Most blocks of a row have nothing below the limit. */
void iris_row_scan8_u8_cortexm(iris_block8 *block, const uint8_t *src, int32_t n)
{
    for (; n >= 16; n -= 16, src += 16, block += 2) {
        scan_pair(block, src);
    }
    if (n > 0) {
        iris_row_scan8_u8_c(block, src, n);
    }
}
