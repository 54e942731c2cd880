#include "convolve_rows.h"

#include <string.h>

#define TILE 64 /* samples that are settled at a time */

/* n / divisor, rounded down, of either sign. A divisor that is a power of two is a shift, by 31 less than that of the
 * factor. */
static inline int32_t quotient_of(int32_t n, const iris_row_quotient *q, int by_shift)
{
    if (by_shift) {
        return n >> (q->shift - 31);
    }
    return n >= 0 ? n / q->divisor : -((q->divisor - 1 - n) / q->divisor);
}

static void settle_s16(int16_t *dst, const int32_t *sums, const iris_row_quotient *q, int32_t n)
{
    int by_shift = (q->divisor & (q->divisor - 1)) == 0;
    for (int32_t i = 0; i < n; i++) {
        int32_t value = quotient_of(sums[i], q, by_shift);
        value = q->absolute && value < 0 ? -value : value;
        dst[i] = (int16_t)(value > INT16_MAX ? INT16_MAX : value < INT16_MIN ? INT16_MIN : value);
    }
}

/* What becomes of the sums of n samples from `from` on. */
static void settle(const iris_convolution *work, const int32_t *sums, int32_t from, int32_t n)
{
    uint8_t *row = (uint8_t *)iris_image_row(work->dst, work->rows.y);
    if (work->dst->format == IRIS_GRAY_S16) {
        settle_s16((int16_t *)(void *)row + from, sums, &work->quotient, n);
    } else if (work->dst->format == IRIS_HSL24) {
        uint8_t lightness[TILE];
        const uint8_t *src = (const uint8_t *)iris_image_row(work->rows.src, work->rows.y);
        iris_row_settle_u8(lightness, sums, &work->quotient, n);
        for (int32_t i = 0, at = 3 * from; i < n; i++, at += 3) {
            row[at] = src[at];
            row[at + 1] = src[at + 1];
            row[at + 2] = lightness[i];
        }
    } else {
        iris_row_settle_u8(row + from, sums, &work->quotient, n);
    }
}

static void start(int32_t *sums, int32_t value, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        sums[i] = value;
    }
}

static int32_t tile(int32_t from, int32_t end)
{
    return end - from < TILE ? end - from : TILE;
}

/* A place in the window. */
typedef struct {
    int32_t row, column;
} place;

/* The taps of the window from `at` on, for sample `from`, without those that weigh nothing; at most IRIS_ROW_TAPS. */
static int32_t next_taps(iris_row_tap taps[IRIS_ROW_TAPS], const iris_convolution *work, place *at,
                         int32_t from)
{
    int32_t channels = work->rows.channels, count = 0;
    for (; at->row < work->h; at->row++, at->column = 0) {
        const int32_t *weights = work->weights + at->row * work->w;
        const uint8_t *src = iris_rows_at(&work->rows, at->row - work->rows.window.above) + from -
                             work->rows.window.left * channels;
        for (; at->column < work->w; at->column++) {
            if (count == IRIS_ROW_TAPS) {
                return count;
            }
            taps[count] = (iris_row_tap){src + at->column * channels, weights[at->column]};
            count += weights[at->column] != 0;
        }
    }
    return count;
}

static int makes_bytes(const iris_convolution *work)
{
    return work->dst->format != IRIS_GRAY_S16 && work->dst->format != IRIS_HSL24;
}

static void row_whole(const iris_convolution *work, int32_t first, int32_t end)
{
    iris_row_tap taps[IRIS_ROW_TAPS];
    place at = {0, 0};
    int32_t count = next_taps(taps, work, &at, first);
    if (makes_bytes(work) && count > 0 && at.row == work->h) {
        uint8_t *dst = (uint8_t *)iris_image_row(work->dst, work->rows.y);
        iris_row_filter_u8(dst + first, taps, count, &work->quotient, end - first);
        return;
    }
    start(work->middle + first, work->quotient.start, end - first);
    for (; count > 0; count = next_taps(taps, work, &at, first)) {
        iris_row_taps_u8(work->middle + first, taps, count, end - first);
    }
    for (int32_t from = first; from < end; from += TILE) {
        settle(work, work->middle + from, from, tile(from, end));
    }
}

static void row_in_two_passes(const iris_convolution *work, int32_t first, int32_t end)
{
    int32_t channels = work->rows.channels, sums[TILE];
    int32_t left = work->rows.window.left * channels, right = work->rows.window.right * channels;
    iris_row_tap taps[IRIS_KERNEL_SIDE_MAX];
    int32_t count = 0;
    for (int32_t r = 0; r < work->h; r++) {
        taps[count] = (iris_row_tap){iris_rows_at(&work->rows, r - work->rows.window.above) + first - left,
                                     work->down[r]};
        count += work->down[r] != 0;
    }
    memset(work->middle + first - left, 0, sizeof(int32_t) * (size_t)(end - first + left + right));
    iris_row_taps_u8(work->middle + first - left, taps, count, end - first + left + right);
    if (makes_bytes(work)) {
        iris_row_line across = {work->across, work->w, channels};
        uint8_t *dst = (uint8_t *)iris_image_row(work->dst, work->rows.y);
        iris_row_filter_s32(dst + first, work->middle + first - left, &across, &work->quotient, end - first);
        return;
    }
    for (int32_t from = first; from < end; from += TILE) {
        int32_t n = tile(from, end);
        start(sums, work->quotient.start, n);
        iris_row_taps_s32(sums, work->middle + from - left, work->across, work->w, channels, n);
        settle(work, sums, from, n);
    }
}

void iris_convolve_row(const iris_convolution *work, int32_t first, int32_t end)
{
    if (work->separable) {
        row_in_two_passes(work, first, end);
    } else {
        row_whole(work, first, end);
    }
}
