/* Gray levels against the mean of a window. */
#include "vector.h"

typedef struct {
    __m128i total; /* of the window before the next pixel's last column, four times */
    __m128i c, area;
} mean_state;

/* Four pixels: all ones where above. columns: the first of pixel 0's window; ahead: its last. */
static inline __m128i above_4(mean_state *state, const uint8_t *src, const uint32_t *columns,
                              const uint32_t *ahead)
{
    int32_t four;
    memcpy(&four, src, sizeof four);
    __m128i leave = load16(columns);
    __m128i change = _mm_sub_epi32(load16(ahead), leave);
    change = _mm_add_epi32(change, _mm_slli_si128(change, 4));
    change = _mm_add_epi32(change, _mm_slli_si128(change, 8));
    __m128i after = _mm_add_epi32(state->total, change); /* each pixel's first column has left */
    state->total = _mm_shuffle_epi32(after, 0xff);
    __m128i level = _mm_add_epi32(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(four)), state->c);
    return _mm_cmpgt_epi32(_mm_mullo_epi32(level, state->area), _mm_add_epi32(after, leave));
}

static inline __m128i above_16(mean_state *state, const uint8_t *src, const uint32_t *columns,
                               const uint32_t *ahead)
{
    __m128i a = above_4(state, src, columns, ahead);
    __m128i b = above_4(state, src + 4, columns + 4, ahead + 4);
    __m128i c = above_4(state, src + 8, columns + 8, ahead + 8);
    __m128i d = above_4(state, src + 12, columns + 12, ahead + 12);
    return _mm_packs_epi16(_mm_packs_epi32(a, b), _mm_packs_epi32(c, d));
}

void iris_row_above_mean_u8_sse(uint32_t *mask, const uint8_t *src, const uint32_t *sums,
                                iris_row_window window, int32_t n)
{
    const uint32_t *ahead = sums + window.side - 1;
    if (n >= 32) {
        uint32_t total = 0;
        for (const uint32_t *column = sums; column < ahead; column++) {
            total += *column;
        }
        mean_state state = {_mm_set1_epi32((int32_t)total), _mm_set1_epi32(window.c),
                            _mm_set1_epi32(window.side * window.side)};
        for (; n >= 32; n -= 32, src += 32, sums += 32, ahead += 32) {
            __m128i first = above_16(&state, src, sums, ahead);
            __m128i second = above_16(&state, src + 16, sums + 16, ahead + 16);
            *mask++ = high_bits(first, second);
        }
    }
    iris_row_above_mean_u8_c(mask, src, sums, window, n);
}
