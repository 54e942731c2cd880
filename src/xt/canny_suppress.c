#include "canny_parts.h"

static int32_t size_of(int32_t value)
{
    return value < 0 ? -value : value;
}

/* Is the gradient of pixel x greatest across its edge? */
static int is_ridge(const iris_canny_rows *rows, int32_t x)
{
    const int16_t *above = rows->above, *here = rows->here, *below = rows->below;
    int32_t size = here[x], dx = rows->dx[x], dy = rows->dy[x];
    int32_t across = size_of(dx), down = size_of(dy), t = (across * 13573) >> 15;
    if (down <= t) {
        return size > here[x - 1] && size >= here[x + 1];
    }
    if (down > 2 * across + t) {
        return size > above[x] && size >= below[x];
    }
    int32_t lean = (dx ^ dy) < 0 ? -1 : 1;
    return size > above[x - lean] && size > below[x + lean];
}

void iris_canny_suppress(uint32_t *weak, uint32_t *strong, const iris_canny_rows *rows, int32_t n)
{
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        uint32_t above_low = 0, above_high = 0;
        for (int32_t i = 0; i < count; i++) {
            if (rows->here[start + i] > rows->low && is_ridge(rows, start + i)) {
                above_low |= (uint32_t)1 << i;
                above_high |= (uint32_t)(rows->here[start + i] > rows->high) << i;
            }
        }
        weak[start / 32] = above_low;
        strong[start / 32] = above_high;
    }
}
