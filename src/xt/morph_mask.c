#include "mask_bits.h"
#include "morph_step.h"

static int32_t words_of(int32_t pixels)
{
    return (pixels + 31) / 32;
}

/* Pixels from `first` on become pixels 0 to n - 1. Looks at no word without any of them. */
static void move_pixels(uint32_t *to, const uint32_t *row, int32_t first, int32_t n)
{
    int32_t words = words_of(n);
    for (int32_t i = 0; i < words - 1; i++) {
        to[i] = iris_mask_pixels(row, 32 * i + first);
    }
    int32_t at = 32 * (words - 1) + first;
    to[words - 1] = at >> 5 == (n - 1 + first) >> 5 ? row[at >> 5] >> (at & 31) : iris_mask_pixels(row, at);
}

/* Pixels x, x + a, x + b of run are joined to pixel x. */
static void join_three(uint32_t *to, const uint32_t *run, int32_t a, int32_t b, const iris_mask_span *span)
{
    int32_t words = words_of(span->w);
    uint32_t turn = span->all ? ~0u : 0u; /* and is or of the negatives */
    for (int32_t i = 0; i < words; i++) {
        uint32_t third = iris_mask_pixels(run, 32 * i + a) ^ turn;
        third |= iris_mask_pixels(run, 32 * i + b) ^ turn;
        to[i] = (third | (run[i] ^ turn)) ^ turn;
    }
}

void iris_mask_join_span(uint32_t *to, const uint32_t *row, iris_mask_span span, uint32_t *run)
{
    int32_t count = span.last - span.first + 1, length = 1;
    move_pixels(count == 1 ? to : run, row, span.first, span.w + count - 1);
    for (; 3 * length < count; length *= 3) {
        iris_mask_span wider = {.w = span.w + count - 3 * length, .all = span.all};
        join_three(run, run, length, 2 * length, &wider);
    }
    if (count > 1) {
        join_three(to, run, length < count - length ? length : count - length, count - length, &span);
    }
}
