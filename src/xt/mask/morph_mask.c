#include "../../foundation/kernel.h"
#include "mask_bits.h"
#include "morph_step.h"

static int32_t words_of(int32_t pixels)
{
    return (pixels + 31) / 32;
}

/* The last word of what iris_row_join3_mask makes of n pixels; looks at no word that has none of them. */
static uint32_t join_last(const uint32_t *row, const int32_t at[3], int32_t n, uint32_t all)
{
    uint32_t joined = 0;
    int32_t word = words_of(n) - 1;
    for (int k = 0; k < 3; k++) {
        joined |= iris_mask_pixels_to(row, 32 * word + at[k], (n - 1 + at[k]) >> 5) ^ all;
    }
    return joined ^ all;
}

void iris_mask_join_span(uint32_t *to, const uint32_t *row, iris_mask_span span, uint32_t *run)
{
    int32_t count = span.last - span.first + 1, length = count < 3 ? count : 3;
    int32_t n = span.w + count - length;
    int32_t start[3] = {span.first, span.first + length / 2, span.first + length - 1};
    uint32_t all = span.all ? ~0u : 0u, *made = count > 3 ? run : to;
    iris_row_join3_mask(made, row, start, all, words_of(n) - 1);
    made[words_of(n) - 1] = join_last(row, start, n, all);
    for (; 3 * length < count; length *= 3) {
        const int32_t at[3] = {0, length, 2 * length};
        iris_row_join3_mask(run, run, at, all, words_of(span.w + count - 3 * length));
    }
    if (length < count) {
        const int32_t at[3] = {0, length < count - length ? length : count - length, count - length};
        iris_row_join3_mask(to, run, at, all, words_of(span.w));
    }
}
