/* Unsharp mask of a row. */
#include "iris/fixed.h"
#include "kernel.h"

void iris_row_sharpen_u8_c(uint8_t *dst, const uint8_t *src, const uint8_t *blurred, iris_row_sharpening by,
                           int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        int32_t difference = src[i] - blurred[i], value = src[i];
        if (difference > by.threshold || difference < -by.threshold) {
            value += (int32_t)iris_round_shift(difference * by.amount_q16, 16);
        }
        dst[i] = (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
    }
}
