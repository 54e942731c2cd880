/* Means of square windows. */
#include "kernel_box.h"

#include "kernel.h"

void iris_row_box_mean_u8_c(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    const box_division by = box_division_of(side);
    const uint16_t *ahead = columns + (side - 1) * step;
    for (int32_t c = 0; c < step && c < n; c++) {
        uint32_t sum = by.add;
        for (int32_t k = 0; k < side - 1; k++) {
            sum += columns[c + k * step];
        }
        for (int32_t i = c; i < n; i += step) {
            sum += ahead[i];
            dst[i] = (uint8_t)((uint64_t)sum * by.factor >> by.shift);
            sum -= columns[i];
        }
    }
}
