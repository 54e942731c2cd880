#include "follow_parts.h"

/* The mask's words, byte by byte: bit i of byte b is column 8 b + i on every processor. */
static void to_bytes(uint8_t *line, const uint32_t *mask, size_t words)
{
    for (size_t k = 0; k < words; k++) {
        uint32_t word = mask[k];
        for (size_t i = 0; i < 4; i++) {
            line[4 * k + i] = (uint8_t)(word >> (8 * i));
        }
    }
}

void iris_follow_mark_color(iris_follow *follow, const uint8_t *rgb)
{
    uint32_t *mask = (uint32_t *)(void *)follow->line;
    size_t words = ((size_t)follow->size.w + 31) / 32;
    mask[words - 1] = 0; /* bits past w */
    iris_hsl_range_row(mask, rgb, follow->size.w, &follow->color);
    to_bytes(follow->line, mask, words);
}
