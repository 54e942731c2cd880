/* One pixel of YUV to RGB: BT.601 in the limited range, in 1/256, within 1 of the exact value. */
#ifndef IRIS_FOUNDATION_YUV_H
#define IRIS_FOUNDATION_YUV_H

#include <stdint.h>

/* What U and V add to each channel, times 256. */
typedef struct {
    int32_t r, g, b;
} iris_yuv_tint;

static inline iris_yuv_tint iris_yuv_tint_of(uint8_t u, uint8_t v)
{
    int32_t from_u = u - 128, from_v = v - 128;
    return (iris_yuv_tint){409 * from_v, -100 * from_u - 208 * from_v, 516 * from_u};
}

/* What Y gives to each channel, times 256, with the half for rounding. */
static inline int32_t iris_yuv_luma(uint8_t y)
{
    return 298 * (y - 16) + 128;
}

static inline uint8_t iris_yuv_channel(int32_t value)
{
    value >>= 8;
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

#endif
