/* Unsharp mask of a row. */
#include "lanes.h"

/* The amount is a whole number and a signed fraction of 16 bits. */
typedef struct {
    lanes whole, fraction, threshold;
} sharpening;

static inline lanes sharpen_some(lanes src, lanes blurred, const sharpening *by)
{
    lanes difference = V(sub_epi16)(src, blurred);
    lanes high = V(mulhi_epi16)(difference, by->fraction), low = V(mullo_epi16)(difference, by->fraction);
    lanes change = V(add_epi16)(high, V(srli_epi16)(low, 15));
    change = V(add_epi16)(change, V(mullo_epi16)(difference, by->whole));
    lanes counts = V(cmpgt_epi16)(V(abs_epi16)(difference), by->threshold);
    return V(add_epi16)(src, VSI(and)(change, counts));
}

void iris_row_sharpen_u8_sse(uint8_t *dst, const uint8_t *src, const uint8_t *blurred, iris_row_sharpening by,
                             int32_t n)
{
    int16_t fraction = (int16_t)by.amount_q16;
    const sharpening spread = {V(set1_epi16)((int16_t)((by.amount_q16 - fraction) >> 16)),
                               V(set1_epi16)(fraction), V(set1_epi16)((int16_t)by.threshold)};
    const lanes zero = VSI(setzero)();
    for (; n >= LANES; n -= LANES, dst += LANES, src += LANES, blurred += LANES) {
        lanes s = load_lanes(src), b = load_lanes(blurred);
        lanes low = sharpen_some(V(unpacklo_epi8)(s, zero), V(unpacklo_epi8)(b, zero), &spread);
        lanes high = sharpen_some(V(unpackhi_epi8)(s, zero), V(unpackhi_epi8)(b, zero), &spread);
        store_lanes(dst, V(packus_epi16)(low, high));
    }
    iris_row_sharpen_u8_c(dst, src, blurred, by, n);
}
