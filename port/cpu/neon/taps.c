/* Weighted sums of rows, in 32 bits; weights that do not fit 16 are left to the plain body. */
#include <arm_neon.h>

#include "kernel.h"

static int fits_s16(const iris_row_tap *taps, int32_t count)
{
    for (int32_t k = 0; k < count; k++) {
        if (taps[k].weight < INT16_MIN || taps[k].weight > INT16_MAX) {
            return 0;
        }
    }
    return 1;
}

/* Adds all taps, of 8 pixels at i. */
static inline int32x4x2_t add_all(int32x4x2_t sums, const iris_row_tap *taps, int32_t count, int32_t i)
{
    for (int32_t k = 0; k < count; k++) {
        int16x8_t src = vreinterpretq_s16_u16(vmovl_u8(vld1_u8(taps[k].src + i)));
        int16_t weight = (int16_t)taps[k].weight;
        sums.val[0] = vmlal_n_s16(sums.val[0], vget_low_s16(src), weight);
        sums.val[1] = vmlal_n_s16(sums.val[1], vget_high_s16(src), weight);
    }
    return sums;
}

/* Four sums, 0 to 255 each afterwards. A divisor that is a power of two is a shift, by 31 less than that of the
 * factor. */
static inline uint16x4_t divide(int32x4_t sum, const iris_row_quotient *q, int by_shift)
{
    int32x4_t zero = vdupq_n_s32(0);
    if (q->absolute) {
        int32x4_t negative = vshrq_n_s32(sum, 31);
        sum = vaddq_s32(veorq_s32(sum, negative), vandq_s32(negative, vdupq_n_s32(q->divisor)));
    }
    uint32x4_t size = vreinterpretq_u32_s32(vminq_s32(vmaxq_s32(sum, zero), vdupq_n_s32(255 * q->divisor)));
    if (by_shift) {
        return vmovn_u32(vshlq_u32(size, vdupq_n_s32(31 - q->shift)));
    }
    const int64x2_t right = vdupq_n_s64(-q->shift);
    uint64x2_t low = vshlq_u64(vmull_n_u32(vget_low_u32(size), q->factor), right);
    uint64x2_t high = vshlq_u64(vmull_n_u32(vget_high_u32(size), q->factor), right);
    return vmovn_u32(vcombine_u32(vmovn_u64(low), vmovn_u64(high)));
}

static inline uint8x8_t settle_8(int32x4x2_t sums, const iris_row_quotient *q, int by_shift)
{
    return vmovn_u16(vcombine_u16(divide(sums.val[0], q, by_shift), divide(sums.val[1], q, by_shift)));
}

static int is_power(int32_t divisor)
{
    return (divisor & (divisor - 1)) == 0;
}

/* The last pixels of a row come again, where it is no multiple of 8. */
void iris_row_filter_u8_neon(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                             const iris_row_quotient *quotient, int32_t n)
{
    if (n < 8 || !fits_s16(taps, count)) {
        iris_row_filter_u8_c(dst, taps, count, quotient, n);
        return;
    }
    int by_shift = is_power(quotient->divisor);
    int32x4x2_t start = {{vdupq_n_s32(quotient->start), vdupq_n_s32(quotient->start)}};
    for (int32_t i = 0; i < n; i += 8) {
        int32_t at = i < n - 8 ? i : n - 8;
        vst1_u8(dst + at, settle_8(add_all(start, taps, count, at), quotient, by_shift));
    }
}
