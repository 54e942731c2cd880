/* Edges: the plain C bodies. */
#include "kernel.h"

#include "iris/fixed.h"

#include "octant.h"

static inline int16_t size_of(int32_t dx, int32_t dy)
{
    return (int16_t)((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy));
}

/* What the middle difference counts beyond once; nothing is left to compute where `more` is a constant 128 or 0. */
static inline int32_t extra(int32_t difference, int32_t more)
{
    return more == 128 ? difference : more == 0 ? 0 : (more * difference + 64) >> 7;
}

/* Column by column: each pixel is read once. */
static inline void gradient(const iris_row_gradient *to, const uint8_t *const rows[3], int32_t more,
                            int32_t n)
{
    const uint8_t *above = rows[0], *here = rows[1], *below = rows[2];
    int32_t left_down = below[-1] - above[-1], left_sum = below[-1] + above[-1] + here[-1];
    int32_t down = below[0] - above[0], sum = below[0] + above[0] + here[0];
    for (int32_t i = 0; i < n; i++) {
        int32_t next_down = below[i + 1] - above[i + 1];
        int32_t next_sum = below[i + 1] + above[i + 1] + here[i + 1];
        int32_t dx = next_sum - left_sum + extra(here[i + 1] - here[i - 1], more);
        int32_t dy = left_down + down + next_down + extra(down, more);
        to->dx[i] = (int16_t)dx;
        to->dy[i] = (int16_t)dy;
        to->size[i] = size_of(dx, dy);
        left_down = down;
        left_sum = sum;
        down = next_down;
        sum = next_sum;
    }
}

void iris_row_gradient_u8_c(const iris_row_gradient *to, const uint8_t *const rows[3], int32_t more,
                            int32_t n)
{
    if (n > 0 && more == 128) {
        gradient(to, rows, 128, n);
    } else if (n > 0) {
        gradient(to, rows, more, n);
    }
}

/* Doubles both sides `bits` times where `along` stays below 2^29 then. */
static inline octant_vector doubled(octant_vector v, int bits)
{
    const int shift = v.along >> (29 - bits) == 0 ? bits : 0;
    return (octant_vector){v.along << shift, v.across << shift, 0};
}

/* The vector of a pixel in the first octant; along in 2^28..2^29 - 1. */
static inline octant_vector octant_of(int32_t dx, int32_t dy)
{
    const int32_t right = dx < 0 ? -dx : dx, up = dy < 0 ? -dy : dy;
    octant_vector v = {(up > right ? up : right) << 13, (up > right ? right : up) << 13, 0};
    return doubled(doubled(doubled(doubled(v, 8), 4), 2), 1);
}

static inline uint16_t direction_of(int32_t dx, int32_t dy, int32_t angle_q16, int32_t turn)
{
    const int32_t right = dx < 0 ? -dx : dx, up = dy < 0 ? -dy : dy;
    int32_t angle = iris_round_shift_s32(angle_q16, 16);
    angle = up > right ? 16384 - angle : angle;
    angle = dx < 0 ? 32768 - angle : angle;
    angle = (dy < 0 ? -angle : angle) + turn;
    return (uint16_t)((dx | dy) == 0 ? 0 : angle);
}

#define VECTORS 32

/* As iris_atan2_angle does it, but step by step for many pixels, so that compilers work on several at once. */
void iris_row_direction_s16_c(uint16_t *dst, const int16_t *dx, const int16_t *dy, int32_t turn, int32_t n)
{
    int32_t along[VECTORS], across[VECTORS], angle[VECTORS];
    for (int32_t from = 0; from < n; from += VECTORS) {
        const int32_t some = n - from < VECTORS ? n - from : VECTORS;
        for (int32_t i = 0; i < some; i++) {
            octant_vector v = octant_of(dx[from + i], dy[from + i]);
            along[i] = v.along;
            across[i] = v.across;
            angle[i] = 0;
        }
        for (int step = 0; step < OCTANT_STEPS; step += 3) { /* of three, the vectors stay in registers */
            for (int32_t i = 0; i < some; i++) {
                octant_vector v = {along[i], across[i], angle[i]};
                v = octant_turned(octant_turned(octant_turned(v, step), step + 1), step + 2);
                along[i] = v.along;
                across[i] = v.across;
                angle[i] = v.angle;
            }
        }
        for (int32_t i = 0; i < some; i++) {
            dst[from + i] = direction_of(dx[from + i], dy[from + i], angle[i], turn);
        }
    }
}

void iris_row_laplacian_u8_c(int16_t *dst, const uint8_t *const rows[3], int32_t n)
{
    const uint8_t *above = rows[0], *here = rows[1], *below = rows[2];
    for (int32_t i = 0; i < n; i++) {
        dst[i] = (int16_t)(above[i] + below[i] + here[i - 1] + here[i + 1] - 4 * here[i]);
    }
}

void iris_row_gain_s16_c(uint8_t *dst, const int16_t *src, uint32_t gain_q16, int32_t n)
{
    const uint32_t white = gain_q16 == 0 ? UINT32_MAX : (256u << 16) / gain_q16 + 1;
    for (int32_t i = 0; i < n; i++) {
        uint32_t level = (uint32_t)(src[i] < 0 ? -src[i] : src[i]);
        level = level >= white ? 255 : (level * gain_q16 + 32768u) >> 16;
        dst[i] = (uint8_t)(level > 255 ? 255 : level);
    }
}

/* By way of the port's kernels, a piece at a time. */
#define TILE 64

void iris_row_gradient_gain_u8_c(uint8_t *dst, const uint8_t *const rows[3], int32_t more, uint32_t gain_q16,
                                 int32_t n)
{
    int16_t dx[TILE], dy[TILE], size[TILE];
    const iris_row_gradient to = {dx, dy, size};
    for (int32_t from = 0; from < n; from += TILE) {
        int32_t some = n - from < TILE ? n - from : TILE;
        const uint8_t *const here[3] = {rows[0] + from, rows[1] + from, rows[2] + from};
        iris_row_gradient_u8(&to, here, more, some);
        iris_row_gain_s16(dst + from, size, gain_q16, some);
    }
}

void iris_row_laplacian_gain_u8_c(uint8_t *dst, const uint8_t *const rows[3], uint32_t gain_q16, int32_t n)
{
    int16_t values[TILE];
    for (int32_t from = 0; from < n; from += TILE) {
        int32_t some = n - from < TILE ? n - from : TILE;
        const uint8_t *const here[3] = {rows[0] + from, rows[1] + from, rows[2] + from};
        iris_row_laplacian_u8(values, here, some);
        iris_row_gain_s16(dst + from, values, gain_q16, some);
    }
}

void iris_row_above_s16_c(uint32_t *mask, const int16_t *src, int32_t limit, int32_t n)
{
    for (int32_t start = 0; start < n; start += 32, src += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        uint32_t bits = 0;
        for (int32_t i = 0; i < count; i++) {
            bits |= (uint32_t)(src[i] > limit) << i;
        }
        iris_row_put_bits(&mask[start / 32], bits, count);
    }
}

/* Does the value change its sign between a and b, or does it at a pixel of value 0 between them? */
static inline int crosses(int32_t a, int32_t b, int32_t threshold)
{
    return (a < 0 && b > 0 && b - a > threshold) || (a > 0 && b < 0 && a - b > threshold);
}

/* Is here the pixel of a crossing from before to after? */
static inline int is_crossing(int32_t before, int32_t here, int32_t after, int32_t threshold)
{
    if (here == 0) {
        return crosses(before, after, threshold);
    }
    int32_t size = here < 0 ? -here : here;
    return (crosses(before, here, threshold) && size < (before < 0 ? -before : before)) ||
           (crosses(here, after, threshold) && size <= (after < 0 ? -after : after));
}

void iris_row_crossings_s16_c(uint32_t *mask, const int16_t *const rows[3], int32_t threshold, int32_t n)
{
    const int16_t *above = rows[0], *here = rows[1], *below = rows[2];
    for (int32_t start = 0; start < n; start += 32) {
        int32_t end = n - start < 32 ? n : start + 32;
        uint32_t bits = 0;
        for (int32_t i = start; i < end; i++) {
            int crosses_here = is_crossing(here[i - 1], here[i], here[i + 1], threshold) ||
                               is_crossing(above[i], here[i], below[i], threshold);
            bits |= (uint32_t)crosses_here << (i - start);
        }
        iris_row_put_bits(&mask[start / 32], bits, end - start);
    }
}

/* Is the gradient of pixel i greatest across its edge? */
static inline int is_ridge(const iris_row_ridges *rows, int32_t i)
{
    const int16_t *above = rows->size[0], *here = rows->size[1], *below = rows->size[2];
    int32_t size = here[i], dx = rows->dx[i], dy = rows->dy[i];
    int32_t across = dx < 0 ? -dx : dx, down = dy < 0 ? -dy : dy, t = (across * 13573) >> 15;
    if (down <= t) {
        return size > here[i - 1] && size >= here[i + 1];
    }
    if (down > 2 * across + t) {
        return size > above[i] && size >= below[i];
    }
    int32_t lean = (dx ^ dy) < 0 ? -1 : 1;
    return size > above[i - lean] && size > below[i + lean];
}

void iris_row_ridges_s16_c(uint32_t *weak, uint32_t *strong, const iris_row_ridges *rows, int32_t n)
{
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        uint32_t above_low = 0, above_high = 0;
        for (int32_t i = 0; i < count; i++) {
            if (rows->size[1][start + i] > rows->low && is_ridge(rows, start + i)) {
                above_low |= (uint32_t)1 << i;
                above_high |= (uint32_t)(rows->size[1][start + i] > rows->high) << i;
            }
        }
        iris_row_put_bits(&weak[start / 32], above_low, count);
        iris_row_put_bits(&strong[start / 32], above_high, count);
    }
}

/* Four bytes as a word, the first in the low byte; one load where the processor can. */
static inline uint32_t word_at(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

#define EVEN  0x00ff00ffu
#define CARRY 0x02000200u

/* Two bytes each of a and b, in the low halves of 16 bits: carries where they differ by more than the limit, of which
 * `level` is 511 less in both halves. No half borrows from the other: each stays within 1 to 766. */
static inline uint32_t unlike(uint32_t a, uint32_t b, uint32_t level)
{
    uint32_t apart = a - b;
    return (level + apart) | (level - apart);
}

/* Four pixels as four bits. */
static inline uint32_t unlike_4(const uint8_t *const rows[3], int32_t i, uint32_t level)
{
    uint32_t left = word_at(rows[1] + i - 1), right = word_at(rows[1] + i + 1);
    uint32_t above = word_at(rows[0] + i), below = word_at(rows[2] + i);
    uint32_t even = unlike(left & EVEN, right & EVEN, level) | unlike(above & EVEN, below & EVEN, level);
    uint32_t odd = unlike(left >> 8 & EVEN, right >> 8 & EVEN, level) |
                   unlike(above >> 8 & EVEN, below >> 8 & EVEN, level);
    uint32_t bits = (even & CARRY) >> 9 | (odd & CARRY) >> 8;
    return (bits | bits >> 14) & 15u;
}

void iris_row_unlike_u8_c(uint32_t *mask, const uint8_t *const rows[3], uint8_t limit, int32_t n)
{
    const uint32_t level = (511u - limit) * 0x00010001u;
    int32_t i = 0;
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        uint32_t bits = 0;
        for (; i + 4 <= start + count; i += 4) {
            bits |= unlike_4(rows, i, level) << (i - start);
        }
        for (; i < start + count; i++) {
            int32_t across = rows[1][i - 1] - rows[1][i + 1], down = rows[0][i] - rows[2][i];
            int is_unlike = across > limit || -across > limit || down > limit || -down > limit;
            bits |= (uint32_t)is_unlike << (i - start);
        }
        iris_row_put_bits(&mask[start / 32], bits, count);
    }
}
