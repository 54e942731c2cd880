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

/* A ninth of the sum, at most 2299, is 7282 times that, divided by 2^16: 9 * 7282 is 2^16 and 2 more, which never is a whole
 * one in 2299 / 9. */
void iris_row_box9_u8_c(uint8_t *dst, uint16_t *columns, const uint8_t *const rows[3], int32_t step,
                        int32_t n)
{
    const uint8_t *above = rows[0] - step, *row = rows[1] - step, *below = rows[2] - step;
    for (int32_t i = 0; i < n + 2 * step && n > 0; i++) {
        columns[i] = (uint16_t)(above[i] + row[i] + below[i]);
    }
    for (int32_t i = 0; i < n; i++) {
        uint16_t sum = (uint16_t)(columns[i] + columns[i + step] + columns[i + 2 * step] + 4);
        dst[i] = (uint8_t)((uint32_t)sum * 7282u >> 16);
    }
}
