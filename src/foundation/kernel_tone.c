/* Gray levels: what becomes of them, by a table; and how far they go. */
#include "kernel.h"

/* Four at a time, all read before one is written: dst and src may lie so that a processor takes them for the same. */
void iris_row_tone_u8_c(uint8_t *dst, const uint8_t *src, const uint8_t level[256], int32_t n)
{
    int32_t i = 0;
    for (; i + 4 <= n; i += 4) {
        uint8_t first = level[src[i]], second = level[src[i + 1]];
        uint8_t third = level[src[i + 2]], fourth = level[src[i + 3]];
        dst[i] = first;
        dst[i + 1] = second;
        dst[i + 2] = third;
        dst[i + 3] = fourth;
    }
    for (; i < n; i++) {
        dst[i] = level[src[i]];
    }
}

void iris_row_extremes_u8_c(uint8_t extremes[2], const uint8_t *src, int32_t n)
{
    uint8_t least = extremes[0], most = extremes[1];
    for (int32_t i = 0; i < n; i++) {
        least = src[i] < least ? src[i] : least;
        most = src[i] > most ? src[i] : most;
    }
    extremes[0] = least;
    extremes[1] = most;
}
