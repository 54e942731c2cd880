/* Runs of selected pixels in a row of a mask.
 *
 *     iris_mask_span run = {0, 0};
 *     while (iris_mask_run(&run, row, run.end, w)) {
 *         run.first to run.end - 1 are selected
 *     }
 */
#ifndef IRIS_XT_MASK_RUNS_H
#define IRIS_XT_MASK_RUNS_H

#include <stdint.h>

typedef struct {
    int32_t first, end; /* the first pixel, and the one behind the last */
} iris_mask_span;

/* The first pixel at or behind `from` whose bit is that of flip's opposite: flip 0 looks for ones, ~0 for zeros. w when
 * there is none. */
static inline int32_t iris_mask_next(const uint32_t *row, int32_t from, int32_t w, uint32_t flip)
{
    int32_t word = from >> 5;
    uint32_t bits = from < w ? (row[word] ^ flip) & (~(uint32_t)0 << (from & 31)) : 0;
    while (bits == 0) {
        if (from >= w || ++word > (w - 1) >> 5) {
            return w;
        }
        bits = row[word] ^ flip;
    }
    int32_t at = 32 * word + __builtin_ctz(bits);
    return at < w ? at : w;
}

/* The next run at or behind `from`, 0 up to w, of the row's w pixels (a run that `from` is inside begins there). 1, or 0
 * when there is none. Bits past w are ignored. O(words between). */
static inline int iris_mask_run(iris_mask_span *run, const uint32_t *row, int32_t from, int32_t w)
{
    run->first = iris_mask_next(row, from, w, 0);
    run->end = iris_mask_next(row, run->first, w, ~(uint32_t)0);
    return run->first < w;
}

#endif
