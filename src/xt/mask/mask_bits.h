/* Parts of a mask's words. */
#ifndef IRIS_XT_MASK_BITS_H
#define IRIS_XT_MASK_BITS_H

#include <stdint.h>

/* 32 pixels of a mask's row from pixel `at` on. Reads two words, even where one has them all. */
static inline uint32_t iris_mask_pixels(const uint32_t *row, int32_t at)
{
    int32_t shift = at & 31;
    const uint32_t *word = row + (at >> 5);
    return word[0] >> shift | word[1] << 1 << (31 - shift);
}

/* The same, but no word behind `last` is looked at. */
static inline uint32_t iris_mask_pixels_to(const uint32_t *row, int32_t at, int32_t last)
{
    return (at >> 5) < last ? iris_mask_pixels(row, at) : row[at >> 5] >> (at & 31);
}

/* The bits of a row's word that are pixels from first up to below end. */
static inline uint32_t iris_mask_range(int32_t word, int32_t first, int32_t end)
{
    int32_t low = first - 32 * word, high = end - 32 * word;
    uint32_t from = low <= 0 ? ~0u : low < 32 ? ~0u << low : 0;
    return high >= 32 ? from : high > 0 ? from & ~(~0u << high) : 0;
}

#endif
