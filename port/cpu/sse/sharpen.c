/* Unsharp mask of a row. */
#include "lanes.h"

/* Of an even amount a whole number and half of the fraction; of an odd one a signed fraction of 16 bits. */
typedef struct {
    lanes whole, fraction, threshold;
} sharpening;

typedef struct {
    int is_even, has_threshold;
} sharpening_kind;

static inline sharpening spread(iris_row_sharpening by, int is_even)
{
    int32_t fraction = is_even ? by.amount_q16 & 0xffff : (int16_t)by.amount_q16;
    return (sharpening){V(set1_epi16)((int16_t)((by.amount_q16 - fraction) >> 16)),
                        V(set1_epi16)((int16_t)(is_even ? fraction / 2 : fraction)),
                        V(set1_epi16)((int16_t)by.threshold)};
}

INLINE lanes sharpen_some(lanes src, lanes blurred, const sharpening *by, sharpening_kind kind)
{
    lanes difference = V(sub_epi16)(src, blurred);
    lanes change = V(mulhrs_epi16)(difference, by->fraction);
    if (!kind.is_even) {
        lanes low = V(mullo_epi16)(difference, by->fraction);
        change = V(add_epi16)(V(mulhi_epi16)(difference, by->fraction), V(srli_epi16)(low, 15));
    }
    change = V(add_epi16)(change, V(mullo_epi16)(difference, by->whole));
    if (kind.has_threshold) {
        change = VSI(and)(change, V(cmpgt_epi16)(V(abs_epi16)(difference), by->threshold));
    }
    return V(add_epi16)(src, change);
}

/* The pixels of whole vectors. */
INLINE void sharpen(uint8_t *dst, const uint8_t *src, const uint8_t *blurred, iris_row_sharpening by,
                    sharpening_kind kind, int32_t n)
{
    const sharpening all = spread(by, kind.is_even);
    const lanes zero = VSI(setzero)();
    for (int32_t i = 0; i + LANES <= n; i += LANES) {
        lanes s = load_lanes(src + i), b = load_lanes(blurred + i);
        lanes low = sharpen_some(V(unpacklo_epi8)(s, zero), V(unpacklo_epi8)(b, zero), &all, kind);
        lanes high = sharpen_some(V(unpackhi_epi8)(s, zero), V(unpackhi_epi8)(b, zero), &all, kind);
        store_lanes(dst + i, V(packus_epi16)(low, high));
    }
}

void iris_row_sharpen_u8_sse(uint8_t *dst, const uint8_t *src, const uint8_t *blurred, iris_row_sharpening by,
                             int32_t n)
{
    int32_t done = n / LANES * LANES;
    if (by.amount_q16 % 2 != 0) {
        sharpen(dst, src, blurred, by, (sharpening_kind){0, 1}, n);
    } else if (by.threshold > 0) {
        sharpen(dst, src, blurred, by, (sharpening_kind){1, 1}, n);
    } else {
        sharpen(dst, src, blurred, by, (sharpening_kind){1, 0}, n);
    }
    iris_row_sharpen_u8_c(dst + done, src + done, blurred + done, by, n - done);
}
