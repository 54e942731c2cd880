/* Means of square windows: running sums, made of the differences of what enters and what leaves. */
#include "kernel_box.h"

#include <arm_neon.h>

#include "kernel.h"

/* Lane i plus all lanes i - step, i - 2 step... */
static inline uint16x8_t scan_u16(uint16x8_t v, int32_t step)
{
    const uint16x8_t zero = vdupq_n_u16(0);
    if (step == 1) {
        v = vaddq_u16(v, vextq_u16(zero, v, 7));
        v = vaddq_u16(v, vextq_u16(zero, v, 6));
        return vaddq_u16(v, vextq_u16(zero, v, 4));
    }
    v = vaddq_u16(v, vextq_u16(zero, v, 5));
    return vaddq_u16(v, vextq_u16(zero, v, 2));
}

/* The last `step` lanes, again and again. */
static inline uint16x8_t last_u16(uint16x8_t v, int32_t step)
{
    return step == 1 ? vdupq_lane_u16(vget_high_u16(v), 3) : scan_u16(vextq_u16(v, vdupq_n_u16(0), 5), 3);
}

static inline uint8x8_t divide_u16(uint16x8_t sums, box_division by)
{
    uint32x4_t low = vmull_n_u16(vget_low_u16(sums), (uint16_t)by.factor);
    uint32x4_t high = vmull_n_u16(vget_high_u16(sums), (uint16_t)by.factor);
    uint16x8_t both = vcombine_u16(vshrn_n_u32(low, 16), vshrn_n_u32(high, 16));
    return vmovn_u16(vshlq_u16(both, vdupq_n_s16((int16_t)(16 - by.shift))));
}

static inline void narrow(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    const box_division by = box_division_of(side);
    uint32_t totals[8];
    box_begin(totals, columns, side, step, by.add);
    uint16x8_t total = vcombine_u16(vmovn_u32(vld1q_u32(totals)), vmovn_u32(vld1q_u32(totals + 4)));
    for (int32_t i = 0; i < n; i += 8) {
        uint16x8_t leave = vld1q_u16(columns + i);
        uint16x8_t change = vsubq_u16(vld1q_u16(columns + i + (side - 1) * step), leave);
        uint16x8_t after = vaddq_u16(total, scan_u16(change, step)); /* each sample's first column has left */
        total = last_u16(after, step);
        vst1_u8(dst + i, divide_u16(vaddq_u16(after, leave), by));
    }
}

static inline uint32x4_t scan_u32(uint32x4_t v, int32_t step)
{
    const uint32x4_t zero = vdupq_n_u32(0);
    if (step == 1) {
        v = vaddq_u32(v, vextq_u32(zero, v, 3));
        return vaddq_u32(v, vextq_u32(zero, v, 2));
    }
    return vaddq_u32(v, vextq_u32(zero, v, 1));
}

static inline uint32x4_t last_u32(uint32x4_t v, int32_t step)
{
    return step == 1 ? vdupq_lane_u32(vget_high_u32(v), 1) : scan_u32(vextq_u32(v, vdupq_n_u32(0), 1), 3);
}

static inline uint16x4_t divide_u32(uint32x4_t sums, box_division by)
{
    const int64x2_t down = vdupq_n_s64(-by.shift);
    uint64x2_t low = vshlq_u64(vmull_n_u32(vget_low_u32(sums), by.factor), down);
    uint64x2_t high = vshlq_u64(vmull_n_u32(vget_high_u32(sums), by.factor), down);
    return vmovn_u32(vcombine_u32(vmovn_u64(low), vmovn_u64(high)));
}

/* Four means. total goes on to the next four. */
static inline uint16x4_t wide_4(uint32x4_t *total, const uint16_t *columns, int32_t side, int32_t step,
                                box_division by)
{
    uint32x4_t leave = vmovl_u16(vld1_u16(columns));
    uint32x4_t change = vsubq_u32(vmovl_u16(vld1_u16(columns + (side - 1) * step)), leave);
    uint32x4_t after = vaddq_u32(*total, scan_u32(change, step));
    *total = last_u32(after, step);
    return divide_u32(vaddq_u32(after, leave), by);
}

static inline void wide(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    const box_division by = box_division_of(side);
    uint32_t totals[8];
    box_begin(totals, columns, side, step, by.add);
    uint32x4_t total = vld1q_u32(totals);
    for (int32_t i = 0; i < n; i += 8) {
        uint16x4_t low = wide_4(&total, columns + i, side, step, by);
        uint16x4_t high = wide_4(&total, columns + i + 4, side, step, by);
        vst1_u8(dst + i, vmovn_u16(vcombine_u16(low, high)));
    }
}

void iris_row_box_mean_u8_neon(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    int32_t whole = n / 8 * 8;
    if (whole == 0) {
        iris_row_box_mean_u8_c(dst, columns, side, step, n);
        return;
    }
    if (side <= BOX_NARROW && step == 1) {
        narrow(dst, columns, side, 1, whole);
    } else if (side <= BOX_NARROW) {
        narrow(dst, columns, side, 3, whole);
    } else if (step == 1) {
        wide(dst, columns, side, 1, whole);
    } else {
        wide(dst, columns, side, 3, whole);
    }
    iris_row_box_mean_u8_c(dst + whole, columns + whole, side, step, n - whole);
}
