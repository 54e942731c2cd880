#include "iris/xt/convolve.h"

#include "../foundation/rows.h"
#include "filter.h"
#include "rank_one.h"

#define TILE 64 /* samples that are summed at a time */

/* Rounded division by a constant. A sum starts as divisor / 2 + bias * divisor, so that what is left to do is to
 * round down: n / divisor is n * factor >> shift, with factor = 2^shift / divisor rounded up and 2^(shift - 31) the
 * largest power of two that is not above divisor. The excess of factor * divisor over 2^shift is below divisor (0 for
 * powers of two), and the quotient is exact while n times the excess is below 2^shift (Granlund and Montgomery,
 * 1994). */
typedef struct {
    int32_t start, divisor;
    uint32_t factor;
    int shift;
    int exact;     /* for all n up to 32768 * divisor; up to 255 * divisor it always is */
    int absolute;  /* of the result */
    int32_t limit; /* n that gives the greatest result */
} quotient;

typedef struct {
    const iris_image *dst;
    iris_rows rows;
    const int32_t *weights; /* as they lie on the window */
    int32_t h, w;           /* of the window */
    int separable;
    int32_t down[IRIS_KERNEL_SIDE_MAX], across[IRIS_KERNEL_SIDE_MAX];
    int32_t *middle; /* of a separable matrix: pixel 0 of a row summed from top to bottom */
    quotient quotient;
} convolution;

static quotient quotient_for(const iris_kernel *kernel, int32_t greatest)
{
    quotient q = {kernel->divisor / 2 + kernel->bias * kernel->divisor, kernel->divisor, 0, 31, 0, 0, 0};
    while (q.divisor >> (q.shift - 30) != 0) {
        q.shift++;
    }
    q.factor = (uint32_t)((((uint64_t)1 << q.shift) + (uint32_t)q.divisor - 1) / (uint32_t)q.divisor);
    q.exact = greatest == 255 || q.shift - 31 <= 14 || (q.divisor & (q.divisor - 1)) == 0;
    q.absolute = kernel->absolute;
    q.limit = iris_sat_s32((int64_t)greatest * q.divisor);
    return q;
}

/* n: at least 0. */
static inline int32_t divide(int32_t n, const quotient *q)
{
    n = n < q->limit ? n : q->limit;
    return q->exact ? (int32_t)((uint64_t)(uint32_t)n * q->factor >> q->shift) : n / q->divisor;
}

/* Of n < 0, the quotient is rounded down too: minus what (divisor - 1 - n) / divisor is. */
static inline uint8_t settle_u8(int32_t n, const quotient *q)
{
    n = n >= 0 ? n : q->absolute ? q->divisor - 1 - n : 0;
    return (uint8_t)divide(n, q);
}

static inline int16_t settle_s16(int32_t n, const quotient *q)
{
    int32_t value = divide(n >= 0 ? n : q->divisor - 1 - n, q);
    value = n >= 0 || q->absolute ? value : -value;
    return (int16_t)(value <= INT16_MAX ? value : INT16_MAX);
}

static void settle(const convolution *work, const int32_t *sums, int32_t from, int32_t n)
{
    uint8_t *row = (uint8_t *)iris_image_row(work->dst, work->rows.y);
    if (work->dst->format == IRIS_GRAY_S16) {
        for (int32_t i = 0; i < n; i++) {
            ((int16_t *)(void *)row)[from + i] = settle_s16(sums[i], &work->quotient);
        }
    } else if (work->dst->format == IRIS_HSL24) {
        const uint8_t *src = (const uint8_t *)iris_image_row(work->rows.src, work->rows.y);
        for (int32_t i = 0, at = 3 * from; i < n; i++, at += 3) {
            row[at] = src[at];
            row[at + 1] = src[at + 1];
            row[at + 2] = settle_u8(sums[i], &work->quotient);
        }
    } else {
        for (int32_t i = 0; i < n; i++) {
            row[from + i] = settle_u8(sums[i], &work->quotient);
        }
    }
}

static void add_u8(int32_t *sums, const uint8_t *src, int32_t weight, int32_t n)
{
    for (int32_t i = 0; weight != 0 && i < n; i++) {
        sums[i] += weight * src[i];
    }
}

static void add_s32(int32_t *sums, const int32_t *src, int32_t weight, int32_t n)
{
    for (int32_t i = 0; weight != 0 && i < n; i++) {
        sums[i] += weight * src[i];
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

static void row_whole(const convolution *work, int32_t first, int32_t end)
{
    int32_t channels = work->rows.channels, sums[TILE];
    for (int32_t from = first; from < end; from += TILE) {
        int32_t n = tile(from, end);
        const int32_t *weight = work->weights;
        start(sums, work->quotient.start, n);
        for (int32_t r = 0; r < work->h; r++) {
            const uint8_t *src = iris_rows_at(&work->rows, r - work->rows.window.above) + from -
                                 work->rows.window.left * channels;
            for (int32_t c = 0; c < work->w; c++, src += channels) {
                add_u8(sums, src, *weight++, n);
            }
        }
        settle(work, sums, from, n);
    }
}

static void row_in_two_passes(const convolution *work, int32_t first, int32_t end)
{
    int32_t channels = work->rows.channels, sums[TILE];
    int32_t left = work->rows.window.left * channels, right = work->rows.window.right * channels;
    for (int32_t from = first - left; from < end + right; from += TILE) {
        int32_t n = tile(from, end + right);
        start(work->middle + from, 0, n);
        for (int32_t r = 0; r < work->h; r++) {
            const uint8_t *src = iris_rows_at(&work->rows, r - work->rows.window.above);
            add_u8(work->middle + from, src + from, work->down[r], n);
        }
    }
    for (int32_t from = first; from < end; from += TILE) {
        int32_t n = tile(from, end);
        start(sums, work->quotient.start, n);
        for (int32_t c = 0; c < work->w; c++) {
            add_s32(sums, work->middle + from - left + c * channels, work->across[c], n);
        }
        settle(work, sums, from, n);
    }
}

static int32_t nonzero(const int32_t *values, int32_t n)
{
    int32_t count = 0;
    for (int32_t i = 0; i < n; i++) {
        count += values[i] != 0;
    }
    return count;
}

static iris_status begin(convolution *work, const iris_image *src, const iris_kernel *kernel, int turned,
                         iris_border border, iris_scratch *scratch)
{
    int32_t count = kernel->rows * kernel->columns;
    iris_rows_window window = {(kernel->columns - 1) / 2, kernel->columns / 2, (kernel->rows - 1) / 2,
                               kernel->rows / 2};
    iris_status status = iris_rows_begin(&work->rows, src, window, border, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t channels = work->rows.channels;
    size_t samples = ((size_t)src->w + (size_t)kernel->columns - 1) * (size_t)channels;
    int32_t *weights = (int32_t *)iris_scratch_take(scratch, sizeof(int32_t) * (size_t)count);
    int32_t *middle = (int32_t *)iris_scratch_take(scratch, sizeof(int32_t) * samples);
    if (!weights || !middle) {
        return IRIS_ERR_SCRATCH;
    }
    for (int32_t i = 0; i < count; i++) {
        weights[i] = kernel->values[turned ? count - 1 - i : i];
    }
    work->weights = weights;
    work->h = kernel->rows;
    work->w = kernel->columns;
    work->middle = middle + window.left * channels;
    work->separable = iris_rank_one(work->down, work->across, weights, work->h, work->w) &&
                      nonzero(work->down, work->h) + nonzero(work->across, work->w) < nonzero(weights, count);
    return IRIS_OK;
}

static iris_status check_kernel(const iris_kernel *kernel)
{
    if (!kernel || !kernel->values || kernel->rows < 1 || kernel->rows > IRIS_KERNEL_SIDE_MAX ||
        kernel->columns < 1 || kernel->columns > IRIS_KERNEL_SIDE_MAX || kernel->divisor < 1 ||
        kernel->divisor > IRIS_KERNEL_DIVISOR_MAX || (kernel->absolute != 0 && kernel->absolute != 1)) {
        return IRIS_ERR_ARG;
    }
    int64_t sum = 0, bias = kernel->bias;
    for (int32_t i = 0; i < kernel->rows * kernel->columns; i++) {
        int64_t value = kernel->values[i];
        sum += value < 0 ? -value : value;
    }
    sum = 255 * sum + kernel->divisor / 2 + (bias < 0 ? -bias : bias) * kernel->divisor;
    return sum <= INT32_MAX ? IRIS_OK : IRIS_ERR_RANGE;
}

static iris_status check(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                         iris_border border)
{
    iris_status status = iris_filter_check(dst, src, border);
    if (status == IRIS_ERR_ARG) {
        return status;
    }
    int to_s16 = src->format == IRIS_GRAY8 && dst->format == IRIS_GRAY_S16;
    int lightness = src->format == IRIS_HSL24 && dst->format == IRIS_HSL24;
    if (!to_s16 && !lightness) {
        status = iris_filter_check_u8(dst, src, border);
    }
    return status != IRIS_OK ? status : check_kernel(kernel);
}

static iris_status correlate(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                             int turned, iris_border border, iris_scratch *scratch)
{
    iris_status status = check(dst, src, kernel, border);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    size_t mark = iris_scratch_mark(scratch);
    convolution work = {0};
    work.dst = dst;
    work.quotient = quotient_for(kernel, dst->format == IRIS_GRAY_S16 ? 32768 : 255);
    status = begin(&work, src, kernel, turned, border, scratch);
    for (; status == IRIS_OK && work.rows.y < src->h; iris_rows_next(&work.rows)) {
        int32_t first, end, channels = work.rows.channels;
        if (!iris_rows_span(&first, &end, &work.rows)) {
            continue;
        }
        if (work.separable) {
            row_in_two_passes(&work, first * channels, end * channels);
        } else {
            row_whole(&work, first * channels, end * channels);
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}

iris_status iris_correlate(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                           iris_border border, iris_scratch *scratch)
{
    return correlate(dst, src, kernel, 0, border, scratch);
}

iris_status iris_convolve(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                          iris_border border, iris_scratch *scratch)
{
    return correlate(dst, src, kernel, 1, border, scratch);
}
