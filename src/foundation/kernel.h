/* IRIS - row kernels: the only code that a port may replace.
 *
 * Each works on one row of n >= 0 pixels, reads and writes only [row, row + n), and gives the same bits on every port.
 * The plain C body exists under the name with _c on every port; a port overrides by defining the plain name in its
 * iris_port.h (see DESIGN notes in README.md). Masks: bit i of word i / 32 is pixel i; bits past n are kept.
 */
#ifndef IRIS_KERNEL_H
#define IRIS_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#include "kernel_types.h"

#include "iris_port.h"

/* Writes the low `count` (1 to 32) bits of `bits` to a word of a mask and keeps the rest of it. */
static inline void iris_row_put_bits(uint32_t *word, uint32_t bits, int32_t count)
{
    uint32_t keep = count == 32 ? 0u : ~0u << count;
    *word = (*word & keep) | (bits & ~keep);
}

/* dst = (77 R + 150 G + 29 B + 128) >> 8. */
void iris_row_luma_rgb888_c(uint8_t *dst, const uint8_t *src, int32_t n);
#ifndef iris_row_luma_rgb888
#define iris_row_luma_rgb888 iris_row_luma_rgb888_c
#endif

void iris_row_luma_bgr888_c(uint8_t *dst, const uint8_t *src, int32_t n);
#ifndef iris_row_luma_bgr888
#define iris_row_luma_bgr888 iris_row_luma_bgr888_c
#endif

/* The same of RGBA8888. */
void iris_row_luma_rgba8888_c(uint8_t *dst, const uint8_t *src, int32_t n);
#ifndef iris_row_luma_rgba8888
#define iris_row_luma_rgba8888 iris_row_luma_rgba8888_c
#endif

/* dst = src with bytes 0 and 2 of each pixel exchanged. dst may be src. */
void iris_row_swap_888_c(uint8_t *dst, const uint8_t *src, int32_t n);
#ifndef iris_row_swap_888
#define iris_row_swap_888 iris_row_swap_888_c
#endif

/* dst = RGB888 (or BGR888) of gray levels: each one three times. dst and src do not overlap. */
void iris_row_888_gray_c(uint8_t *dst, const uint8_t *src, int32_t n);
#ifndef iris_row_888_gray
#define iris_row_888_gray iris_row_888_gray_c
#endif

/* bit = src > limit. */
void iris_row_above_u8_c(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n);
#ifndef iris_row_above_u8
#define iris_row_above_u8 iris_row_above_u8_c
#endif

/* Sets sum and below of each block of 8 pixels. A last block of fewer counts only those; its higher bits are 0. */
void iris_row_scan8_u8_c(iris_block8 *block, const uint8_t *src, int32_t n);
#ifndef iris_row_scan8_u8
#define iris_row_scan8_u8 iris_row_scan8_u8_c
#endif

/* sums += enter - leave, modulo 2^32: the sums of columns over a window that moves down by one row. */
void iris_row_slide_u32_c(uint32_t *sums, const uint8_t *enter, const uint8_t *leave, int32_t n);
#ifndef iris_row_slide_u32
#define iris_row_slide_u32 iris_row_slide_u32_c
#endif

/* The same modulo 2^16. */
void iris_row_slide_u16_c(uint16_t *sums, const uint8_t *enter, const uint8_t *leave, int32_t n);
#ifndef iris_row_slide_u16
#define iris_row_slide_u16 iris_row_slide_u16_c
#endif

/* dst[i] = (columns[i] + columns[i + step] + ... + columns[i + (side - 1) * step]) / side^2, rounded half up. side: 1 to
 * 255; step: 1 or 3. columns holds n + (side - 1) * step sums, each of at most 255 * side. */
void iris_row_box_mean_u8_c(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n);
#ifndef iris_row_box_mean_u8
#define iris_row_box_mean_u8 iris_row_box_mean_u8_c
#endif

/* bit i = src[i] > mean - c, where mean = (sums[i] + ... + sums[i + side - 1]) / side^2, exactly. sums holds
 * n + side - 1 columns, each of at most 255 * side. */
void iris_row_above_mean_u8_c(uint32_t *mask, const uint8_t *src, const uint32_t *sums,
                              iris_row_window window, int32_t n);
#ifndef iris_row_above_mean_u8
#define iris_row_above_mean_u8 iris_row_above_mean_u8_c
#endif

/* bit = the RGB888 pixel is in the range of a prepared test. */
void iris_row_hsl_range_c(uint32_t *mask, const uint8_t *rgb, const iris_hsl_range_test *test, int32_t n);
#ifndef iris_row_hsl_range
#define iris_row_hsl_range iris_row_hsl_range_c
#endif

/* dst = HSL24, as iris/color.h says, of pixels whose red is byte 0 or 2. dst may be src. */
void iris_row_hsl24_888_c(uint8_t *dst, const uint8_t *src, int32_t red, int32_t n);
#ifndef iris_row_hsl24_888
#define iris_row_hsl24_888 iris_row_hsl24_888_c
#endif

/* dst = the median of the 3x3 samples around, of three rows. A pixel's neighbors are `step` samples away; rows are
 * readable from -step up to below n + step. */
void iris_row_median9_u8_c(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#ifndef iris_row_median9_u8
#define iris_row_median9_u8 iris_row_median9_u8_c
#endif

/* sorted[0] = the least of five rows' samples, up to sorted[4] = the greatest. */
void iris_row_sort5_u8_c(uint8_t *const sorted[5], const uint8_t *const rows[5], int32_t n);
#ifndef iris_row_sort5_u8
#define iris_row_sort5_u8 iris_row_sort5_u8_c
#endif

/* dst = the median of the 5x5 samples around, of the sorted rows of iris_row_sort5_u8, readable from -2 step up to
 * below n + 2 step. */
void iris_row_median25_u8_c(uint8_t *dst, const uint8_t *const sorted[5], int32_t step, int32_t n);
#ifndef iris_row_median25_u8
#define iris_row_median25_u8 iris_row_median25_u8_c
#endif

/* dst = the largest and the smallest of three. dst may be one of them, and those that are not may also overlap it from
 * behind (dst + 1). */
void iris_row_max3_u8_c(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n);
#ifndef iris_row_max3_u8
#define iris_row_max3_u8 iris_row_max3_u8_c
#endif

void iris_row_min3_u8_c(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n);
#ifndef iris_row_min3_u8
#define iris_row_min3_u8 iris_row_min3_u8_c
#endif

/* dst = the largest and the smallest of the 3x3 samples around, of three rows. A pixel's neighbors are `step` samples
 * away, 1 or 3; rows are readable from -step up to below n + step. dst is none of them. */
void iris_row_max9_u8_c(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#ifndef iris_row_max9_u8
#define iris_row_max9_u8 iris_row_max9_u8_c
#endif

void iris_row_min9_u8_c(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#ifndef iris_row_min9_u8
#define iris_row_min9_u8 iris_row_min9_u8_c
#endif

/* dst = a - b, 0 where that is negative. dst may be a or b. */
void iris_row_minus_u8_c(uint8_t *dst, const uint8_t *a, const uint8_t *b, int32_t n);
#ifndef iris_row_minus_u8
#define iris_row_minus_u8 iris_row_minus_u8_c
#endif

/* Pixel x of a mask = pixels x + at[0], x + at[1], and x + at[2] joined: by "or", or with all = ~0 by "and". Writes
 * `words` whole words; reads the word with pixel at[k] and `words` more behind it. dst may be src where no at is
 * negative. */
void iris_row_join3_mask_c(uint32_t *dst, const uint32_t *src, const int32_t at[3], uint32_t all,
                           int32_t words);
#ifndef iris_row_join3_mask
#define iris_row_join3_mask iris_row_join3_mask_c
#endif

/* The pixels of three rows of a mask joined; `all` as above. dst may be one of them. */
void iris_row_join_rows_mask_c(uint32_t *dst, const uint32_t *a, const uint32_t *b, const uint32_t *c,
                               uint32_t all, int32_t words);
#ifndef iris_row_join_rows_mask
#define iris_row_join_rows_mask iris_row_join_rows_mask_c
#endif

/* The 3x3 pixels around of three rows joined; `all` as above. beside: words that stand for what is joined to the left and
 * right of the rows. dst is none of them. */
void iris_row_join9_mask_c(uint32_t *dst, const uint32_t *const rows[3], const uint32_t beside[2],
                           uint32_t all, int32_t words);
#ifndef iris_row_join9_mask
#define iris_row_join9_mask iris_row_join9_mask_c
#endif

/* Pixel x of dst stays set where pixel x + at of src is set, or with turn = ~0 where it is clear. `words` whole words;
 * reads the word with pixel `at` and `words` more behind it. dst is not src. */
void iris_row_agree_mask_c(uint32_t *dst, const uint32_t *src, int32_t at, uint32_t turn, int32_t words);
#ifndef iris_row_agree_mask
#define iris_row_agree_mask iris_row_agree_mask_c
#endif

/* dst = 65535 where the bit is set, else 0. */
void iris_row_select_u16_c(uint16_t *dst, const uint32_t *mask, int32_t n);
#ifndef iris_row_select_u16
#define iris_row_select_u16 iris_row_select_u16_c
#endif

/* row = the least of row, of other + straight, and of other's pixels beside it + diagonal; sums end at 65535. There is
 * nothing beside the ends. straight: 1 to 255; diagonal: the same, or 65535, which never is the least. */
void iris_row_reach_u16_c(uint16_t *row, const uint16_t *other, iris_row_steps steps, int32_t n);
#ifndef iris_row_reach_u16
#define iris_row_reach_u16 iris_row_reach_u16_c
#endif

/* row = the least of each pixel and of all to the left (to the right) of it with a step of 1 to 255 for each pixel in
 * between; sums end at 65535. */
void iris_row_spread_right_u16_c(uint16_t *row, uint16_t step, int32_t n);
#ifndef iris_row_spread_right_u16
#define iris_row_spread_right_u16 iris_row_spread_right_u16_c
#endif

void iris_row_spread_left_u16_c(uint16_t *row, uint16_t step, int32_t n);
#ifndef iris_row_spread_left_u16
#define iris_row_spread_left_u16 iris_row_spread_left_u16_c
#endif

/* dst = RGB888 of a row of NV12: pixels 2 i and 2 i + 1 have the U chroma[2 i] and the V chroma[2 i + 1]; see yuv.h. */
void iris_row_rgb888_nv12_c(uint8_t *dst, const uint8_t *luma, const uint8_t *chroma, int32_t n);
#ifndef iris_row_rgb888_nv12
#define iris_row_rgb888_nv12 iris_row_rgb888_nv12_c
#endif

/* dst[i] = src[2 i + which], which is 0 or 1: Y of YUYV, and what is not Y. */
void iris_row_every_second_u8_c(uint8_t *dst, const uint8_t *src, int32_t which, int32_t n);
#ifndef iris_row_every_second_u8
#define iris_row_every_second_u8 iris_row_every_second_u8_c
#endif

/* dst = the colors of a row of a Bayer picture, as bayer.h says. The row is rows[1], between those above and below
 * it; rows are readable from -1 up to below n + 1. own: the byte of a pixel that gets the row's color other than
 * green, 0 or 2; the other one gets that of the rows around. green: pixels of this parity are green. */
void iris_row_888_bayer_c(uint8_t *dst, const uint8_t *const rows[3], int32_t own, int32_t green, int32_t n);
#ifndef iris_row_888_bayer
#define iris_row_888_bayer iris_row_888_bayer_c
#endif

/* sums = rows[0] + 4 rows[1] + 6 rows[2] + 4 rows[3] + rows[4]. */
void iris_row_binomial5_u8_c(uint16_t *sums, const uint8_t *const rows[5], int32_t n);
#ifndef iris_row_binomial5_u8
#define iris_row_binomial5_u8 iris_row_binomial5_u8_c
#endif

/* dst[i] = the same sum of sums[2 i - 2] to sums[2 i + 2], plus 128, divided by 256. sums are at most 4080. */
void iris_row_halve_u16_c(uint8_t *dst, const uint16_t *sums, int32_t n);
#ifndef iris_row_halve_u16
#define iris_row_halve_u16 iris_row_halve_u16_c
#endif

/* dst[i] = above[i] + src[0] + ... + src[i], modulo 2^32. */
void iris_row_integral_u8_c(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n);
#ifndef iris_row_integral_u8
#define iris_row_integral_u8 iris_row_integral_u8_c
#endif

/* A symmetric weighted sum of 2 radius + 1 rows of bytes, radius 1 to IRIS_BELL_RADIUS; weights of the distances 0 to
 * radius, which sum to 2^15 with each side counted, each at least 0 and below 2^15. dst has 6 fraction bits: the sum,
 * over the distances, of (pair * weight + 2^8) >> 9, where pair is the two samples at that distance, or the middle
 * one. */
void iris_row_bell_down_c(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius,
                          int32_t n);
#ifndef iris_row_bell_down
#define iris_row_bell_down iris_row_bell_down_c
#endif

/* The same across a row of such sums, 0 to 2^14 each, whose samples are `step` apart: (pair * weight + 2^14) >> 15.
 * src is readable from -radius * step up to below n + radius * step. */
void iris_row_bell_across_c(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                            int32_t step, int32_t n);
#ifndef iris_row_bell_across
#define iris_row_bell_across iris_row_bell_across_c
#endif

/* The same, rounded to bytes. */
void iris_row_bell_across_u8_c(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n);
#ifndef iris_row_bell_across_u8
#define iris_row_bell_across_u8 iris_row_bell_across_u8_c
#endif

/* Differences of the 3x3 pixels around, of three rows that are readable from -1 to n: dx is the sum of what the right
 * ones are more than the left ones, and `more` 128ths (0 to 128) of the middle difference, rounded; dy: same, down. */
void iris_row_gradient_u8_c(const iris_row_gradient *to, const uint8_t *const rows[3], int32_t more,
                            int32_t n);
#ifndef iris_row_gradient_u8
#define iris_row_gradient_u8 iris_row_gradient_u8_c
#endif

/* dst = iris_atan2_angle(dy, dx) + turn, modulo 2^16; 0 where both are 0. */
void iris_row_direction_s16_c(uint16_t *dst, const int16_t *dx, const int16_t *dy, int32_t turn, int32_t n);
#ifndef iris_row_direction_s16
#define iris_row_direction_s16 iris_row_direction_s16_c
#endif

/* dst = the sum of the four neighbors less 4 times the pixel, of three rows that are readable from -1 to n. */
void iris_row_laplacian_u8_c(int16_t *dst, const uint8_t *const rows[3], int32_t n);
#ifndef iris_row_laplacian_u8
#define iris_row_laplacian_u8 iris_row_laplacian_u8_c
#endif

/* dst = |src| * gain, rounded, at most 255. src: above -32768; gain below 16.0. */
void iris_row_gain_s16_c(uint8_t *dst, const int16_t *src, uint32_t gain_q16, int32_t n);
#ifndef iris_row_gain_s16
#define iris_row_gain_s16 iris_row_gain_s16_c
#endif

/* Both at once, without rows in between: the gain of a gradient's size, and of a Laplacian. */
void iris_row_gradient_gain_u8_c(uint8_t *dst, const uint8_t *const rows[3], int32_t more, uint32_t gain_q16,
                                 int32_t n);
#ifndef iris_row_gradient_gain_u8
#define iris_row_gradient_gain_u8 iris_row_gradient_gain_u8_c
#endif

void iris_row_laplacian_gain_u8_c(uint8_t *dst, const uint8_t *const rows[3], uint32_t gain_q16, int32_t n);
#ifndef iris_row_laplacian_gain_u8
#define iris_row_laplacian_gain_u8 iris_row_laplacian_gain_u8_c
#endif

/* bit = src > limit; limit 0 to 32767. */
void iris_row_above_s16_c(uint32_t *mask, const int16_t *src, int32_t limit, int32_t n);
#ifndef iris_row_above_s16
#define iris_row_above_s16 iris_row_above_s16_c
#endif

/* bit = a zero crossing by the rules of iris/xt/edge.h, of three rows that are readable from -1 to n and above -32768;
 * threshold 0 to 32767. */
void iris_row_crossings_s16_c(uint32_t *mask, const int16_t *const rows[3], int32_t threshold, int32_t n);
#ifndef iris_row_crossings_s16
#define iris_row_crossings_s16 iris_row_crossings_s16_c
#endif

/* bit = the gradient is greatest across its edge, by the rules of iris/xt/canny.h, and above low (above high). */
void iris_row_ridges_s16_c(uint32_t *weak, uint32_t *strong, const iris_row_ridges *rows, int32_t n);
#ifndef iris_row_ridges_s16
#define iris_row_ridges_s16 iris_row_ridges_s16_c
#endif

/* bit = the left and right neighbor, or the upper and lower one, differ by more than limit. Three rows, readable from
 * -1 to n. */
void iris_row_unlike_u8_c(uint32_t *mask, const uint8_t *const rows[3], uint8_t limit, int32_t n);
#ifndef iris_row_unlike_u8
#define iris_row_unlike_u8 iris_row_unlike_u8_c
#endif

/* dst = src + (src - blurred) * amount, rounded, 0 to 255, where |src - blurred| is above the threshold, else src.
 * dst may be src. */
void iris_row_sharpen_u8_c(uint8_t *dst, const uint8_t *src, const uint8_t *blurred, iris_row_sharpening by,
                           int32_t n);
#ifndef iris_row_sharpen_u8
#define iris_row_sharpen_u8 iris_row_sharpen_u8_c
#endif

/* A symmetric weighted sum of 2 radius + 1 rows of bytes, radius 1 or more, of which the first sample of row k, counted
 * from 0, is src[at[k]]. weights of the distances 0 to radius, which sum to 2^17 with each side counted, each at least 0
 * and below 2^15. dst has 6 fraction bits: (sum + 2^10) >> 11. */
void iris_row_wide_down_c(int16_t *dst, const uint8_t *src, const int32_t *at, const int16_t *weights,
                          int32_t radius, int32_t n);
#ifndef iris_row_wide_down
#define iris_row_wide_down iris_row_wide_down_c
#endif

/* The same across a row of such sums, 0 to 255 * 2^6 each, whose samples are `step` apart: (sum + 2^16) >> 17. src is
 * readable from -radius * step up to below n + radius * step. */
void iris_row_wide_across_c(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                            int32_t step, int32_t n);
#ifndef iris_row_wide_across
#define iris_row_wide_across iris_row_wide_across_c
#endif

/* The same, rounded to bytes at once: (sum + 2^22) >> 23. */
void iris_row_wide_across_u8_c(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n);
#ifndef iris_row_wide_across_u8
#define iris_row_wide_across_u8 iris_row_wide_across_u8_c
#endif

/* sums[i] += weight * src[i] of each tap; count: 1 to IRIS_ROW_TAPS. No sum on the way leaves int32_t, in any order. */
void iris_row_taps_u8_c(int32_t *sums, const iris_row_tap *taps, int32_t count, int32_t n);
#ifndef iris_row_taps_u8
#define iris_row_taps_u8 iris_row_taps_u8_c
#endif

/* dst = the quotient of such sums, which begin as quotient->start. */
void iris_row_filter_u8_c(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                          const iris_row_quotient *quotient, int32_t n);
#ifndef iris_row_filter_u8
#define iris_row_filter_u8 iris_row_filter_u8_c
#endif

/* dst = the quotient of each sum. */
void iris_row_settle_u8_c(uint8_t *dst, const int32_t *sums, const iris_row_quotient *quotient, int32_t n);
#ifndef iris_row_settle_u8
#define iris_row_settle_u8 iris_row_settle_u8_c
#endif

/* sums[i] += weights[k] * src[i + k * step] of k from 0 to count - 1; no sum on the way leaves int32_t. src is readable
 * up to below n + (count - 1) * step. */
void iris_row_taps_s32_c(int32_t *sums, const int32_t *src, const int32_t *weights, int32_t count,
                         int32_t step, int32_t n);
#ifndef iris_row_taps_s32
#define iris_row_taps_s32 iris_row_taps_s32_c
#endif

/* dst = the quotient of such sums, which begin as quotient->start. */
void iris_row_filter_s32_c(uint8_t *dst, const int32_t *src, const iris_row_line *line,
                           const iris_row_quotient *quotient, int32_t n);
#ifndef iris_row_filter_s32
#define iris_row_filter_s32 iris_row_filter_s32_c
#endif

/* dst[i] = the mean of the two samples from 2 i on of both rows, rounded half up. */
void iris_row_halve2_u8_c(uint8_t *dst, const uint8_t *upper, const uint8_t *lower, int32_t n);
#ifndef iris_row_halve2_u8
#define iris_row_halve2_u8 iris_row_halve2_u8_c
#endif

/* dst = what lies at places of two rows, the lower one with the weight `down`, 0 to IRIS_ROW_WHOLE, rounded half up. Rows
 * are readable from 0 up to the farthest sample that a place is beside. */
void iris_row_between_u8_c(uint8_t *dst, const uint8_t *const rows[2], const iris_row_places *places,
                           uint32_t down, int32_t n);
#ifndef iris_row_between_u8
#define iris_row_between_u8 iris_row_between_u8_c
#endif

/* dst[i * stride + k] = rows[k][i]: sixteen rows become columns. */
void iris_row_columns16_u8_c(uint8_t *dst, ptrdiff_t stride, const uint8_t *const rows[16], int32_t n);
#ifndef iris_row_columns16_u8
#define iris_row_columns16_u8 iris_row_columns16_u8_c
#endif

/* dst = level[src]. dst may be src. */
void iris_row_tone_u8_c(uint8_t *dst, const uint8_t *src, const uint8_t level[256], int32_t n);
#ifndef iris_row_tone_u8
#define iris_row_tone_u8 iris_row_tone_u8_c
#endif

/* dst[i] = what lies at place i of a way, between four pixels, by the upper 8 bits of its fractions, rounded half up. All
 * these pixels exist, and a row of the picture has four at least. */
void iris_row_along_u8_c(uint8_t *dst, const iris_row_way *way, int32_t n);
#ifndef iris_row_along_u8
#define iris_row_along_u8 iris_row_along_u8_c
#endif

/* dst = the mean of the 3x3 samples around, of three rows, rounded half up. A pixel's neighbors are `step` samples away, 1 or
 * 3; rows are readable from -step up to below n + step. columns becomes the sums of the three rows, from -step on. */
void iris_row_box9_u8_c(uint8_t *dst, uint16_t *columns, const uint8_t *const rows[3], int32_t step,
                        int32_t n);
#ifndef iris_row_box9_u8
#define iris_row_box9_u8 iris_row_box9_u8_c
#endif

/* extremes[0] becomes the least of itself and all samples, extremes[1] the greatest. */
void iris_row_extremes_u8_c(uint8_t extremes[2], const uint8_t *src, int32_t n);
#ifndef iris_row_extremes_u8
#define iris_row_extremes_u8 iris_row_extremes_u8_c
#endif

/* The same along a way with bends, which has a place behind the last pixel, too. */
void iris_row_bends_u8_c(uint8_t *dst, const iris_row_bends *way, int32_t n);
#ifndef iris_row_bends_u8
#define iris_row_bends_u8 iris_row_bends_u8_c
#endif

/* dst[i] = src[n - 1 - i]. dst may be src. */
void iris_row_reverse_u8_c(uint8_t *dst, const uint8_t *src, int32_t n);
#ifndef iris_row_reverse_u8
#define iris_row_reverse_u8 iris_row_reverse_u8_c
#endif

/* dst[i] = src[3 i]: a channel of three. */
void iris_row_every_third_u8_c(uint8_t *dst, const uint8_t *src, int32_t n);
#ifndef iris_row_every_third_u8
#define iris_row_every_third_u8 iris_row_every_third_u8_c
#endif

/* The census of a row: which of the 24 pixels around are darker, 8 in each plane. Rows are readable from -2 up to below
 * n + 2; planes are none of them. */
void iris_row_census_u8_c(uint8_t *const planes[3], const uint8_t *const rows[5], int32_t n);
#ifndef iris_row_census_u8
#define iris_row_census_u8 iris_row_census_u8_c
#endif

/* What n pixels of a pair differ by at each step: how many bits of the census, and the gray levels, at most 32, added. */
void iris_row_costs_u8_c(uint8_t *costs, const iris_row_pair *pair, int32_t n);
#ifndef iris_row_costs_u8
#define iris_row_costs_u8 iris_row_costs_u8_c
#endif

/* sums += these costs of one pair, and -= those of another one with as many steps, which may be null. */
void iris_row_slide_costs_u16_c(uint16_t *sums, const iris_row_pair *enter, const iris_row_pair *leave,
                                int32_t n);
#ifndef iris_row_slide_costs_u16
#define iris_row_slide_costs_u16 iris_row_slide_costs_u16_c
#endif

/* sums of each pixel = those of the pixel before + enter - leave, all of `steps` values; modulo 2^16. */
void iris_row_roll_u16_c(uint16_t *sums, const uint16_t *enter, const uint16_t *leave, int32_t steps,
                         int32_t n);
#ifndef iris_row_roll_u16
#define iris_row_roll_u16 iris_row_roll_u16_c
#endif

/* sums of each four neighboring pixels += the costs of these, all of `steps` values; the last ones may be fewer than four.
 * Modulo 2^16. */
void iris_row_tiles_u16_c(uint16_t *sums, const uint8_t *costs, int32_t steps, int32_t n);
#ifndef iris_row_tiles_u16
#define iris_row_tiles_u16 iris_row_tiles_u16_c
#endif

/* sums += weight * src, modulo 2^16. */
void iris_row_weigh_u16_c(uint16_t *sums, const uint16_t *src, uint16_t weight, int32_t n);
#ifndef iris_row_weigh_u16
#define iris_row_weigh_u16 iris_row_weigh_u16_c
#endif

/* The first least one of `steps` (1 to 256) costs of each pixel; pixels are `apart` costs from each other. */
void iris_row_least_u16_c(const iris_row_least *to, const uint16_t *costs, int32_t steps, int32_t apart,
                          int32_t n);
#ifndef iris_row_least_u16
#define iris_row_least_u16 iris_row_least_u16_c
#endif

/* dst = 256 times the place of the lowest point of the parabola through a least cost and those beside, at least 1. */
void iris_row_parabola_u16_c(uint16_t *dst, const iris_row_least *from, int32_t n);
#ifndef iris_row_parabola_u16
#define iris_row_parabola_u16 iris_row_parabola_u16_c
#endif

/* least[d - x] = the least of itself and of cost d of pixel x, step[d - x] = its d, of the first one where several are as
 * small. */
void iris_row_facing_u16_c(uint16_t *least, uint16_t *step, const uint16_t *costs, int32_t steps, int32_t n);
#ifndef iris_row_facing_u16
#define iris_row_facing_u16 iris_row_facing_u16_c
#endif

/* dst = the median of the 5x5 values around, of five rows that are readable from -2 up to below n + 2. */
void iris_row_median25_u16_c(uint16_t *dst, const uint16_t *const rows[5], int32_t n);
#ifndef iris_row_median25_u16
#define iris_row_median25_u16 iris_row_median25_u16_c
#endif

/* Paths go on to the next row: of each pixel they become its costs and the least of those they come from, of these one
 * step beside + one, and of the least of all + the pixel's leap; less the least of all. Then sums += paths, where sums
 * are not null. paths may be where they come from. */
void iris_row_paths_u16_c(uint16_t *paths, const uint16_t *from, uint16_t *sums,
                          const iris_row_ground *ground, int32_t n);
#ifndef iris_row_paths_u16
#define iris_row_paths_u16 iris_row_paths_u16_c
#endif

/* The same along the row, from left to right and from right to left: sums += both. They begin as 0. room: 2 * steps. */
void iris_row_paths_along_u16_c(uint16_t *sums, uint16_t *room, const iris_row_ground *ground, int32_t n);
#ifndef iris_row_paths_along_u16
#define iris_row_paths_along_u16 iris_row_paths_along_u16_c
#endif

#endif
