/* Rows of distances, eight pixels at a time. Sums end at 65535. */
#include <arm_neon.h>

#include "kernel.h"

void iris_row_select_u16_neon(uint16_t *dst, const uint32_t *mask, int32_t n)
{
    static const uint16_t places[8] = {1, 2, 4, 8, 16, 32, 64, 128};
    const uint16x8_t bits = vld1q_u16(places);
    int32_t i = 0;
    for (; i < n - 7; i += 8) {
        vst1q_u16(dst + i, vtstq_u16(vdupq_n_u16((uint16_t)(mask[i / 32] >> i % 32 & 255)), bits));
    }
    for (; i < n; i++) {
        dst[i] = (uint16_t)(0u - (mask[i / 32] >> i % 32 & 1));
    }
}

void iris_row_reach_u16_neon(uint16_t *row, const uint16_t *other, iris_row_steps steps, int32_t n)
{
    const uint16x8_t straight = vdupq_n_u16(steps.straight), diagonal = vdupq_n_u16(steps.diagonal);
    uint16x8_t left = vdupq_n_u16(65535); /* the eight before */
    int32_t i = 0;
    for (; i < n - 8; i += 8) {
        uint16x8_t here = vld1q_u16(other + i);
        uint16x8_t beside = vminq_u16(vextq_u16(left, here, 7), vld1q_u16(other + i + 1));
        uint16x8_t near = vminq_u16(vqaddq_u16(here, straight), vqaddq_u16(beside, diagonal));
        vst1q_u16(row + i, vminq_u16(vld1q_u16(row + i), near));
        left = here;
    }
    for (; i < n; i++) {
        uint16_t rest[3] = {i > 0 ? other[i - 1] : 65535, other[i], i + 1 < n ? other[i + 1] : 65535};
        uint32_t beside = (rest[0] < rest[2] ? rest[0] : rest[2]) + (uint32_t)steps.diagonal;
        uint32_t near = rest[1] + (uint32_t)steps.straight;
        near = near < beside ? near : beside;
        row[i] = near < row[i] ? (uint16_t)near : row[i];
    }
}

/* The least of the eight and of those before them, with a step for each pixel between: by one, two, and four pixels. */
static inline uint16x8_t spread_right(uint16x8_t v, uint16x8_t step)
{
    const uint16x8_t far = vdupq_n_u16(65535);
    v = vminq_u16(v, vqaddq_u16(vextq_u16(far, v, 7), step));
    v = vminq_u16(v, vqaddq_u16(vextq_u16(far, v, 6), vshlq_n_u16(step, 1)));
    return vminq_u16(v, vqaddq_u16(vextq_u16(far, v, 4), vshlq_n_u16(step, 2)));
}

static inline uint16x8_t spread_left(uint16x8_t v, uint16x8_t step)
{
    const uint16x8_t far = vdupq_n_u16(65535);
    v = vminq_u16(v, vqaddq_u16(vextq_u16(v, far, 1), step));
    v = vminq_u16(v, vqaddq_u16(vextq_u16(v, far, 2), vshlq_n_u16(step, 1)));
    return vminq_u16(v, vqaddq_u16(vextq_u16(v, far, 4), vshlq_n_u16(step, 2)));
}

void iris_row_spread_right_u16_neon(uint16_t *row, uint16_t step, int32_t n)
{
    static const uint16_t counts[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    const uint16x8_t each = vdupq_n_u16(step), ramp = vmulq_u16(each, vld1q_u16(counts));
    const uint16x8_t eight = vshlq_n_u16(each, 3);
    uint16x8_t before = vdupq_n_u16(65535); /* the pixel before, eight times */
    int32_t i = 0;
    for (; i < n - 7; i += 8) {
        uint16x8_t v = spread_right(vld1q_u16(row + i), each);
        vst1q_u16(row + i, vminq_u16(v, vqaddq_u16(before, ramp)));
        before = vminq_u16(vdupq_lane_u16(vget_high_u16(v), 3), vqaddq_u16(before, eight));
    }
    uint32_t left = vgetq_lane_u16(before, 0);
    for (; i < n; i++) {
        left = left + step < row[i] ? left + step : row[i];
        row[i] = (uint16_t)left;
    }
}

void iris_row_spread_left_u16_neon(uint16_t *row, uint16_t step, int32_t n)
{
    static const uint16_t counts[8] = {8, 7, 6, 5, 4, 3, 2, 1};
    const uint16x8_t each = vdupq_n_u16(step), ramp = vmulq_u16(each, vld1q_u16(counts));
    const uint16x8_t eight = vshlq_n_u16(each, 3);
    uint16x8_t before = vdupq_n_u16(65535);
    int32_t i = n;
    for (; i > 7; i -= 8) {
        uint16x8_t v = spread_left(vld1q_u16(row + i - 8), each);
        vst1q_u16(row + i - 8, vminq_u16(v, vqaddq_u16(before, ramp)));
        before = vminq_u16(vdupq_lane_u16(vget_low_u16(v), 0), vqaddq_u16(before, eight));
    }
    uint32_t right = vgetq_lane_u16(before, 0);
    for (; i > 0; i--) {
        right = right + step < row[i - 1] ? right + step : row[i - 1];
        row[i - 1] = (uint16_t)right;
    }
}
