/* What row kernels take beside rows; before kernel.h, so that ports can declare theirs. */
#ifndef IRIS_KERNEL_TYPES_H
#define IRIS_KERNEL_TYPES_H

#include <stddef.h>
#include <stdint.h>

#include "iris/color.h"

/* Eight neighboring pixels of a row. */
typedef struct iris_block8 {
    uint16_t sum;  /* of the pixels */
    uint8_t limit; /* given */
    uint8_t below; /* bit i = pixel i < limit */
} iris_block8;

typedef struct {
    int32_t side; /* of the square window: odd, 1 to 2047 */
    int32_t c;    /* gray levels below the mean, -255 to 255 */
} iris_row_window;

/* What a step costs. */
typedef struct {
    uint16_t straight, diagonal;
} iris_row_steps;

/* The farthest that the bell kernels reach. */
#define IRIS_BELL_RADIUS 5

/* Where a row of gradients goes: dx, dy, and |dx| + |dy|. */
typedef struct {
    int16_t *dx, *dy, *size;
} iris_row_gradient;

/* Three rows of |dx| + |dy|, each readable from -1 to n, with dx and dy of the middle one. |dx| and |dy| are at most
 * 1020; low and high 0 to 32767. */
typedef struct {
    const int16_t *size[3];
    const int16_t *dx, *dy;
    int32_t low, high;
} iris_row_ridges;

typedef struct {
    int32_t amount_q16; /* 0 to 16.0 */
    int32_t threshold;  /* 0 to 255 */
} iris_row_sharpening;

/* One sample of a window: where it is found for pixel 0, and its weight, above INT32_MIN. */
typedef struct {
    const uint8_t *src;
    int32_t weight;
} iris_row_tap;

/* The most taps of one call: a window of 7x7. */
#define IRIS_ROW_TAPS 49

/* From sums to bytes: n / divisor, rounded down, 0 to 255. Of n below 0 that is 0, or with `absolute` minus the
 * quotient, (divisor - 1 - n) / divisor, which does not overflow. Where n is at most 255 * divisor, the quotient is n
 * * factor >> shift: factor = 2^shift / divisor, rounded up, and 2^(shift - 31) the largest power of two that is not
 * above divisor. */
typedef struct {
    int32_t start;   /* of each sum: divisor / 2 + bias * divisor */
    int32_t divisor; /* 1 to 2^22 */
    uint32_t factor;
    int shift, absolute;
} iris_row_quotient;

/* A line of weights, for samples `step` apart. */
typedef struct {
    const int32_t *weights;
    int32_t count, step;
} iris_row_line;

/* A whole of the weights of two samples. */
#define IRIS_ROW_WHOLE 2048u

/* Places in a row: between the sample at[i] and the one `step` (1 or 3) behind it, whose weight is weight[i], 0 to
 * IRIS_ROW_WHOLE. at is at least 0, and none is below one before: with a step of 3 not by more than 2, for the
 * samples of a pixel may come again. */
typedef struct {
    const int32_t *at;
    const uint16_t *weight;
    int32_t step;
} iris_row_places;

/* A straight way over a picture: place i is (x + i dx, y + i dy), with 16 fraction bits. */
typedef struct {
    const uint8_t *src; /* pixel (0, 0) */
    ptrdiff_t stride;
    int32_t x, y, dx, dy;
} iris_row_way;

/* A way over a picture with a bend every 2^bits pixels: there it is at these places, with 16 fraction bits of which the
 * last four are 0; between two of them pixels are equally far from each other. */
typedef struct {
    const uint8_t *src; /* pixel (0, 0) */
    ptrdiff_t stride;
    int32_t w;             /* pixels of a row of src */
    int bits;              /* 0 to 4 */
    const int32_t *places; /* x, y, x, y, and so on */
} iris_row_bends;

/* How far: (to - from) / 2^bits, rounded to 4096ths. */
static inline int32_t iris_row_bends_step(int32_t from, int32_t to, int bits)
{
    return ((((to - from) >> 4) + ((1 << bits) >> 1)) >> bits) * 16;
}

/* Two rows of a stereo pair that are compared: planes 0 to 2 are census bits, 3 gray levels. The right row goes from right
 * to left: right[k][d - x] is what left[k][x] is compared with at disparity d. Both are null in planes that are not
 * looked at. */
typedef struct {
    const uint8_t *left[4], *right[4];
    int32_t steps; /* how many disparities, from 0: at least 1 */
} iris_row_pair;

/* The least of the costs of each pixel: at which step it is, and those of the steps beside. At the first or the last step
 * these are the least one, too. */
typedef struct {
    uint16_t *step, *before, *least, *behind;
} iris_row_least;

/* What semi-global paths go over: n pixels with `steps` costs each, and what more than one step costs between a pixel
 * and the one to the left of it (leaps[0] to leaps[n], both of its ends included) or the one where the path comes
 * from. */
typedef struct {
    const uint8_t *costs;
    const uint16_t *leaps; /* at least `one`, at most 10000 */
    int32_t steps;         /* 2 to 256 */
    uint16_t one;          /* what one step costs */
} iris_row_ground;

#endif
