/* Adversarial content. */
#include "kernels.h"

static uint32_t random_state = 1;

uint32_t random_below(uint32_t end)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)random_state * end >> 32);
}

enum { ZERO, FULL, RUNS, RAMP, NEAR, NOISE, NOISE_TOO, KINDS };

static void fill_u8_kind(uint8_t *row, size_t bytes, uint32_t kind, uint8_t value)
{
    uint32_t step = 1 + random_below(7);
    uint8_t run = 0;
    for (size_t i = 0; i < bytes; i++) {
        run = random_below(6) == 0 ? (uint8_t)(255 - run) : run;
        row[i] = (uint8_t)(kind == ZERO   ? 0
                           : kind == FULL ? 255
                           : kind == RUNS ? run
                           : kind == RAMP ? i * step
                           : kind == NEAR ? value + random_below(3) - 1
                                          : random_below(256));
    }
}

void fill_u8(uint8_t *row, size_t bytes)
{
    fill_u8_kind(row, bytes, random_below(KINDS), (uint8_t)random_below(256));
}

void fill_u8_near(uint8_t *row, size_t bytes, uint8_t value)
{
    fill_u8_kind(row, bytes, random_below(KINDS), value);
}

/* The words of `size` bytes whose extremes, signed or not, are 0, all ones, the sign alone, and all but the sign. */
static void fill_words(uint8_t *row, size_t bytes, size_t size)
{
    uint32_t kind = random_below(KINDS), base = random_below(UINT32_MAX), step = random_below(2000);
    uint32_t sign = (uint32_t)1 << (8 * size - 1), word = 0;
    const uint32_t extremes[] = {0, UINT32_MAX, sign, sign - 1};
    for (size_t i = 0; i + size <= bytes; i += size) {
        if (kind == RUNS) {
            word = random_below(6) == 0 ? extremes[random_below(4)] : word;
        } else {
            word = kind < RUNS    ? extremes[kind + base % 2 * 2]
                   : kind == RAMP ? (uint32_t)i * step
                   : kind == NEAR ? base + random_below(3)
                                  : random_below(UINT32_MAX);
        }
        uint16_t half = (uint16_t)word;
        memcpy(row + i, size == 2 ? (const void *)&half : (const void *)&word, size);
    }
}

void fill_u16(uint8_t *row, size_t bytes)
{
    fill_words(row, bytes, 2);
}

void fill_u32(uint8_t *row, size_t bytes)
{
    fill_words(row, bytes, 4);
}
