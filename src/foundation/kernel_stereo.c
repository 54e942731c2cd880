/* Stereo pairs: what places differ by, and which of them are alike. */
#include <string.h>

#include "kernel.h"

#define GRAY_MOST 32

void iris_row_census_u8_c(uint8_t *const planes[3], const uint8_t *const rows[5], int32_t n)
{
    uint8_t *restrict first = planes[0], *restrict second = planes[1], *restrict third = planes[2];
    const uint8_t *above2 = rows[0], *above = rows[1], *here = rows[2], *below = rows[3], *below2 = rows[4];
    for (int32_t i = 0; i < n; i++) {
        const uint8_t own = here[i];
        first[i] = (uint8_t)((above2[i - 2] < own ? 1 : 0) | (above2[i - 1] < own ? 2 : 0) |
                             (above2[i] < own ? 4 : 0) | (above2[i + 1] < own ? 8 : 0) |
                             (above2[i + 2] < own ? 16 : 0) | (above[i - 2] < own ? 32 : 0) |
                             (above[i - 1] < own ? 64 : 0) | (above[i] < own ? 128 : 0));
        second[i] = (uint8_t)((above[i + 1] < own ? 1 : 0) | (above[i + 2] < own ? 2 : 0) |
                              (here[i - 2] < own ? 4 : 0) | (here[i - 1] < own ? 8 : 0) |
                              (here[i + 1] < own ? 16 : 0) | (here[i + 2] < own ? 32 : 0) |
                              (below[i - 2] < own ? 64 : 0) | (below[i - 1] < own ? 128 : 0));
        third[i] = (uint8_t)((below[i] < own ? 1 : 0) | (below[i + 1] < own ? 2 : 0) |
                             (below[i + 2] < own ? 4 : 0) | (below2[i - 2] < own ? 8 : 0) |
                             (below2[i - 1] < own ? 16 : 0) | (below2[i] < own ? 32 : 0) |
                             (below2[i + 1] < own ? 64 : 0) | (below2[i + 2] < own ? 128 : 0));
    }
}

/* Bits of each byte of three words, counted together. */
static inline uint64_t count_bits(uint64_t a, uint64_t b, uint64_t c)
{
    const uint64_t twos = 0x5555555555555555u, fours = 0x3333333333333333u, bytes = 0x0F0F0F0F0F0F0F0Fu;
    uint64_t odd = a ^ b, ones = odd ^ c, pairs = (a & b) | (odd & c);
    ones -= ones >> 1 & twos;
    pairs -= pairs >> 1 & twos;
    ones = (ones & fours) + (ones >> 2 & fours);
    pairs = (pairs & fours) + (pairs >> 2 & fours);
    ones += pairs << 1;
    return (ones & bytes) + (ones >> 4 & bytes);
}

static inline uint64_t eight_from(const uint8_t *from)
{
    uint64_t word;
    memcpy(&word, from, 8);
    return word;
}

static inline void census_costs(uint8_t *to, const iris_row_pair *pair, int32_t x)
{
    const uint8_t *first = pair->right[0] - x, *second = pair->right[1] - x, *third = pair->right[2] - x;
    const uint64_t each = 0x0101010101010101u;
    const uint64_t a = pair->left[0][x] * each, b = pair->left[1][x] * each, c = pair->left[2][x] * each;
    const int32_t steps = pair->steps;
    int32_t d = 0;
    for (; d < steps - 7; d += 8) {
        uint64_t bits =
            count_bits(a ^ eight_from(first + d), b ^ eight_from(second + d), c ^ eight_from(third + d));
        memcpy(to + d, &bits, 8);
    }
    for (; d < steps; d++) {
        to[d] = (uint8_t)count_bits((a ^ first[d]) & 255, (b ^ second[d]) & 255, (c ^ third[d]) & 255);
    }
}

static inline uint8_t gray_cost(uint8_t a, uint8_t b)
{
    uint8_t apart = (uint8_t)(a > b ? a - b : b - a);
    return apart < GRAY_MOST ? apart : GRAY_MOST;
}

static inline void pixel_costs(uint8_t *restrict to, const iris_row_pair *pair, int32_t x)
{
    const int32_t steps = pair->steps;
    if (pair->left[0]) {
        census_costs(to, pair, x);
    }
    if (pair->left[3]) {
        const uint8_t *right = pair->right[3] - x, gray = pair->left[3][x];
        if (pair->left[0]) {
            for (int32_t d = 0; d < steps; d++) {
                to[d] = (uint8_t)(to[d] + gray_cost(gray, right[d]));
            }
        } else {
            for (int32_t d = 0; d < steps; d++) {
                to[d] = gray_cost(gray, right[d]);
            }
        }
    }
}

void iris_row_costs_u8_c(uint8_t *costs, const iris_row_pair *pair, int32_t n)
{
    for (int32_t x = 0; x < n; x++, costs += pair->steps) {
        pixel_costs(costs, pair, x);
    }
}

#define STEPS_MOST 256

void iris_row_slide_costs_u16_c(uint16_t *sums, const iris_row_pair *enter, const iris_row_pair *leave,
                                int32_t n)
{
    uint8_t more[STEPS_MOST] = {0}, less[STEPS_MOST] = {0};
    const int32_t steps = enter->steps;
    for (int32_t x = 0; x < n; x++, sums += steps) {
        pixel_costs(more, enter, x);
        if (leave) {
            pixel_costs(less, leave, x);
        }
        for (int32_t d = 0; d < steps; d++) {
            sums[d] = (uint16_t)(sums[d] + more[d] - less[d]);
        }
    }
}

void iris_row_roll_u16_c(uint16_t *sums, const uint16_t *enter, const uint16_t *leave, int32_t steps,
                         int32_t n)
{
    for (int32_t x = 0; x < n; x++, sums += steps, enter += steps, leave += steps) {
        uint16_t *restrict to = sums;
        const uint16_t *before = sums - steps;
        for (int32_t d = 0; d < steps; d++) {
            to[d] = (uint16_t)(before[d] + enter[d] - leave[d]);
        }
    }
}

static inline void add_four(uint16_t *restrict to, const uint8_t *restrict costs, int32_t steps)
{
    for (int32_t d = 0; d < steps; d++) {
        to[d] = (uint16_t)(to[d] + costs[d] + costs[steps + d] + costs[2 * steps + d] + costs[3 * steps + d]);
    }
}

void iris_row_tiles_u16_c(uint16_t *sums, const uint8_t *costs, int32_t steps, int32_t n)
{
    int32_t whole = n - n % 4;
    for (int32_t x = 0; x < whole; x += 4, sums += steps, costs += 4 * steps) {
        add_four(sums, costs, steps);
    }
    for (int32_t x = whole; x < n; x++, costs += steps) {
        for (int32_t d = 0; d < steps; d++) {
            sums[d] = (uint16_t)(sums[d] + costs[d]);
        }
    }
}

void iris_row_weigh_u16_c(uint16_t *restrict sums, const uint16_t *restrict src, uint16_t weight, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        sums[i] = (uint16_t)(sums[i] + weight * (uint32_t)src[i]);
    }
}

void iris_row_least_u16_c(const iris_row_least *to, const uint16_t *costs, int32_t steps, int32_t apart,
                          int32_t n)
{
    for (int32_t x = 0; x < n; x++, costs += apart) {
        uint32_t found = UINT32_MAX;
        for (int32_t d = 0; d < steps; d++) {
            uint32_t cost = (uint32_t)costs[d] << 8 | (uint32_t)d;
            found = cost < found ? cost : found;
        }
        int32_t step = (int32_t)(found & 255);
        int inside = step > 0 && step < steps - 1;
        to->step[x] = (uint16_t)step;
        to->least[x] = costs[step];
        to->before[x] = costs[step - inside];
        to->behind[x] = costs[step + inside];
    }
}

/* (128 |before - behind| + bend / 2) / bend, of which the quotient is at most 128. */
void iris_row_parabola_u16_c(uint16_t *dst, const iris_row_least *from, int32_t n)
{
    const uint16_t *step = from->step, *left = from->before, *least = from->least, *right = from->behind;
    for (int32_t x = 0; x < n; x++) {
        int32_t before = left[x], behind = right[x], bend = before + behind - 2 * least[x];
        int32_t apart = before > behind ? before - behind : behind - before;
        int32_t rest = 128 * apart + (bend >> 1), off = 0;
        for (int bit = 7; bit >= 0; bit--) {
            int32_t part = bend * (1 << bit);
            int fits = bend > 0 && rest >= part;
            rest -= fits ? part : 0;
            off |= fits ? 1 << bit : 0;
        }
        off = off > 127 ? 127 : off;
        int32_t value = step[x] * 256 + (before > behind ? off : -off);
        dst[x] = (uint16_t)(value > 0 ? value : 1);
    }
}

void iris_row_facing_u16_c(uint16_t *least, uint16_t *step, const uint16_t *costs, int32_t steps, int32_t n)
{
    for (int32_t x = 0; x < n; x++, costs += steps) {
        uint16_t *restrict low = least - x, *restrict at = step - x;
        for (int32_t d = 0; d < steps; d++) {
            int lower = costs[d] < low[d];
            low[d] = lower ? costs[d] : low[d];
            at[d] = lower ? (uint16_t)d : at[d];
        }
    }
}
