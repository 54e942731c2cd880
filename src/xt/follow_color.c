#include "follow_parts.h"

void iris_follow_mark_color(iris_follow *follow, const uint8_t *rgb)
{
    int32_t blocks = (int32_t)IRIS_FOLLOW_BLOCKS(follow->size.w);
    follow->mask[(follow->size.w - 1) / 32] = 0; /* bits past w */
    iris_row_hsl_range(follow->mask, rgb, &follow->color, follow->size.w);
    for (int32_t b = 0; b < blocks; b++) {
        follow->blocks[b].below = (uint8_t)(follow->mask[b / 4] >> (b % 4 * 8));
    }
}
