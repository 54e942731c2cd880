/* Gray levels against the mean of a window. */
#include "bits.h"

typedef struct {
    uint32x4_t total; /* of the window before the next pixel's last column, four times */
    int32x4_t c, area;
} mean_state;

/* Four pixels: all ones where above. columns: the first of pixel 0's window; ahead: its last. */
static inline uint16x4_t above_4(mean_state *state, uint16x4_t pixels, const uint32_t *columns,
                                 const uint32_t *ahead)
{
    const uint32x4_t zero = vdupq_n_u32(0);
    uint32x4_t leave = vld1q_u32(columns);
    uint32x4_t change = vsubq_u32(vld1q_u32(ahead), leave);
    change = vaddq_u32(change, vextq_u32(zero, change, 3));
    change = vaddq_u32(change, vextq_u32(zero, change, 2));
    uint32x4_t after = vaddq_u32(state->total, change); /* each pixel's first column has left */
    state->total = vdupq_lane_u32(vget_high_u32(after), 1);
    int32x4_t level = vaddq_s32(vreinterpretq_s32_u32(vmovl_u16(pixels)), state->c);
    int32x4_t total = vreinterpretq_s32_u32(vaddq_u32(after, leave));
    return vmovn_u32(vcgtq_s32(vmulq_s32(level, state->area), total));
}

static inline uint8x8_t above_8(mean_state *state, uint8x8_t pixels, const uint32_t *columns,
                                const uint32_t *ahead)
{
    uint16x8_t wide = vmovl_u8(pixels);
    uint16x4_t low = above_4(state, vget_low_u16(wide), columns, ahead);
    uint16x4_t high = above_4(state, vget_high_u16(wide), columns + 4, ahead + 4);
    return vmovn_u16(vcombine_u16(low, high));
}

static inline uint8x16_t above_16(mean_state *state, const uint8_t *src, const uint32_t *columns,
                                  const uint32_t *ahead)
{
    uint8x16_t pixels = vld1q_u8(src);
    uint8x8_t low = above_8(state, vget_low_u8(pixels), columns, ahead);
    uint8x8_t high = above_8(state, vget_high_u8(pixels), columns + 8, ahead + 8);
    return vcombine_u8(low, high);
}

void iris_row_above_mean_u8_neon(uint32_t *mask, const uint8_t *src, const uint32_t *sums,
                                 iris_row_window window, int32_t n)
{
    const uint32_t *ahead = sums + window.side - 1;
    if (n >= 32) {
        uint32_t total = 0;
        for (const uint32_t *column = sums; column < ahead; column++) {
            total += *column;
        }
        mean_state state = {vdupq_n_u32(total), vdupq_n_s32(window.c),
                            vdupq_n_s32(window.side * window.side)};
        for (; n >= 32; n -= 32, src += 32, sums += 32, ahead += 32) {
            uint8x16_t first = above_16(&state, src, sums, ahead);
            uint8x16_t second = above_16(&state, src + 16, sums + 16, ahead + 16);
            *mask++ = word_of_32(first, second);
        }
    }
    iris_row_above_mean_u8_c(mask, src, sums, window, n);
}
