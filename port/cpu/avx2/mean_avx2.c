/* Gray levels against the mean of a window. */
#include "vector.h"

typedef struct {
    __m256i total; /* of the window before the next pixel's last column, eight times */
    __m256i c, area;
} mean_state;

/* Eight pixels: all ones where above. columns: the first of pixel 0's window; ahead: its last. */
static inline __m256i above_8(mean_state *state, const uint8_t *src, const uint32_t *columns,
                              const uint32_t *ahead)
{
    const __m256i last = _mm256_set1_epi32(7);
    __m256i leave = load32(columns);
    __m256i change = _mm256_sub_epi32(load32(ahead), leave);
    change = _mm256_add_epi32(change, _mm256_slli_si256(change, 4));
    change = _mm256_add_epi32(change, _mm256_slli_si256(change, 8));
    __m256i low = _mm256_permute2x128_si256(change, change, 0x08); /* in the place of the high half */
    change = _mm256_add_epi32(change, _mm256_shuffle_epi32(low, 0xff));
    __m256i sum = _mm256_add_epi32(_mm256_add_epi32(state->total, change), leave);
    state->total = _mm256_add_epi32(state->total, _mm256_permutevar8x32_epi32(change, last));
    __m128i eight = _mm_loadl_epi64((const __m128i *)(const void *)src);
    __m256i level = _mm256_add_epi32(_mm256_cvtepu8_epi32(eight), state->c);
    return _mm256_cmpgt_epi32(_mm256_mullo_epi32(level, state->area), sum);
}

static inline uint32_t above_32(mean_state *state, const uint8_t *src, const uint32_t *columns,
                                const uint32_t *ahead)
{
    const __m256i order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7); /* from that of the packs */
    __m256i a = above_8(state, src, columns, ahead);
    __m256i b = above_8(state, src + 8, columns + 8, ahead + 8);
    __m256i c = above_8(state, src + 16, columns + 16, ahead + 16);
    __m256i d = above_8(state, src + 24, columns + 24, ahead + 24);
    __m256i bytes = _mm256_packs_epi16(_mm256_packs_epi32(a, b), _mm256_packs_epi32(c, d));
    return (uint32_t)_mm256_movemask_epi8(_mm256_permutevar8x32_epi32(bytes, order));
}

void iris_row_above_mean_u8_avx2(uint32_t *mask, const uint8_t *src, const uint32_t *sums,
                                 iris_row_window window, int32_t n)
{
    const uint32_t *ahead = sums + window.side - 1;
    if (n >= 32) {
        uint32_t total = 0;
        for (const uint32_t *column = sums; column < ahead; column++) {
            total += *column;
        }
        mean_state state = {_mm256_set1_epi32((int32_t)total), _mm256_set1_epi32(window.c),
                            _mm256_set1_epi32(window.side * window.side)};
        for (; n >= 32; n -= 32, src += 32, sums += 32, ahead += 32) {
            *mask++ = above_32(&state, src, sums, ahead);
        }
    }
    iris_row_above_mean_u8_c(mask, src, sums, window, n);
}
