#include "skeleton_parts.h"

#include "../../foundation/kernel.h"

void iris_skeleton_load(uint64_t *row, const iris_image *mask, int32_t y)
{
    const uint32_t *from = (const uint32_t *)iris_image_row(mask, y);
    int32_t whole = mask->w / 64, rest = mask->w % 64;
    for (int32_t i = 0; i < whole; i++) {
        row[i] = from[2 * i] | (uint64_t)from[2 * i + 1] << 32;
    }
    row[whole] = 0;
    if (rest > 0) {
        uint64_t last = from[2 * whole] | (rest > 32 ? (uint64_t)from[2 * whole + 1] << 32 : 0);
        row[whole] = last & (((uint64_t)1 << rest) - 1);
    }
}

void iris_skeleton_put(const iris_image *mask, int32_t y, int32_t i, uint64_t bits)
{
    uint32_t *to = (uint32_t *)iris_image_row(mask, y);
    int32_t x = 64 * i, count = mask->w - x;
    if (count > 0) {
        iris_row_put_bits(&to[2 * i], (uint32_t)bits, count < 32 ? count : 32);
    }
    if (count > 32) {
        iris_row_put_bits(&to[2 * i + 1], (uint32_t)(bits >> 32), count < 64 ? count - 32 : 32);
    }
}
