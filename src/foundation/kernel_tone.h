/* Tables of levels that are a straight line from black to white: a port with vectors computes them, without a look-up. */
#ifndef IRIS_KERNEL_TONE_H
#define IRIS_KERNEL_TONE_H

#include <stdint.h>

/* So long a row is worth looking whether its table is such a line. */
#define TONE_LONG 2048

/* Level p becomes base + ((a * whole + (256 a * part >> 16) + add) >> shift), where a is p - low, 0 to range; base is
 * a where the line is nearly one to one (keeps), else 0. No sum leaves 16 bits. */
typedef struct {
    uint8_t low, range;
    uint16_t whole, part, add;
    int shift, keeps;
} tone_line;

static inline uint8_t tone_line_at(const tone_line *line, uint32_t p)
{
    uint32_t a = p <= line->low ? 0 : p - line->low < line->range ? p - line->low : line->range;
    uint32_t sum = a * line->whole + (256 * a * line->part >> 16) + line->add;
    return (uint8_t)((line->keeps ? a : 0) + ((sum & 65535u) >> line->shift));
}

/* 0 when some level is none of the line's. */
static inline int tone_line_fits(const tone_line *line, const uint8_t level[256])
{
    uint32_t other = 0;
    for (uint32_t p = 0; p < 256; p++) {
        other |= (uint32_t)tone_line_at(line, p) ^ level[p];
    }
    return other == 0;
}

/* The line that makes these levels; 0 when there is none. The slope is rounded up or down, and a little is added, until all
 * levels are met: for each of the 255 ranges some line of these does (the test of the kernel goes through them). */
static inline int tone_line_of(tone_line *line, const uint8_t level[256])
{
    uint32_t low = 0, high = 255;
    while (low < 255 && level[low + 1] == 0) {
        low++;
    }
    while (high > 0 && level[high - 1] == 255) {
        high--;
    }
    if (level[0] != 0 || level[255] != 255 || low >= high) {
        return 0;
    }
    uint32_t range = high - low, keeps = range > 170;
    uint32_t slope = keeps ? ((255 - range) << 17) / range : (255u << 16) / range;
    for (uint32_t more = 0; more < 4; more++) {
        uint32_t s = slope + 1 - more / 2, half = keeps ? 256 : 128;
        *line = (tone_line){(uint8_t)low,
                            (uint8_t)range,
                            (uint16_t)(keeps ? 0 : s >> 8),
                            (uint16_t)(keeps ? s : s & 255),
                            (uint16_t)(half + 1 - more % 2),
                            keeps ? 9 : 8,
                            (int)keeps};
        if (tone_line_fits(line, level)) {
            return 1;
        }
    }
    return 0;
}

#endif
