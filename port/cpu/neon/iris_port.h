/* The NEON port: ARMv7-A and AArch64, little-endian, by the intrinsics that both have. Included by kernel.h only. */
#ifndef IRIS_PORT_H
#define IRIS_PORT_H

#include <stdint.h>

#define IRIS_PORT_NAME      "neon"
#define IRIS_PORT_OVERRIDES 38

void iris_row_luma_rgb888_neon(uint8_t *dst, const uint8_t *src, int32_t n);
#define iris_row_luma_rgb888 iris_row_luma_rgb888_neon

void iris_row_luma_bgr888_neon(uint8_t *dst, const uint8_t *src, int32_t n);
#define iris_row_luma_bgr888 iris_row_luma_bgr888_neon

void iris_row_swap_888_neon(uint8_t *dst, const uint8_t *src, int32_t n);
#define iris_row_swap_888 iris_row_swap_888_neon

void iris_row_above_u8_neon(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n);
#define iris_row_above_u8 iris_row_above_u8_neon

void iris_row_scan8_u8_neon(iris_block8 *block, const uint8_t *src, int32_t n);
#define iris_row_scan8_u8 iris_row_scan8_u8_neon

void iris_row_box_mean_u8_neon(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n);
#define iris_row_box_mean_u8 iris_row_box_mean_u8_neon

void iris_row_above_mean_u8_neon(uint32_t *mask, const uint8_t *src, const uint32_t *sums,
                                 iris_row_window window, int32_t n);
#define iris_row_above_mean_u8 iris_row_above_mean_u8_neon

void iris_row_hsl_range_neon(uint32_t *mask, const uint8_t *rgb, const iris_hsl_range_test *test, int32_t n);
#define iris_row_hsl_range iris_row_hsl_range_neon

void iris_row_hsl24_888_neon(uint8_t *dst, const uint8_t *src, int32_t red, int32_t n);
#define iris_row_hsl24_888 iris_row_hsl24_888_neon

void iris_row_median9_u8_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#define iris_row_median9_u8 iris_row_median9_u8_neon

void iris_row_sort5_u8_neon(uint8_t *const sorted[5], const uint8_t *const rows[5], int32_t n);
#define iris_row_sort5_u8 iris_row_sort5_u8_neon

void iris_row_median25_u8_neon(uint8_t *dst, const uint8_t *const sorted[5], int32_t step, int32_t n);
#define iris_row_median25_u8 iris_row_median25_u8_neon

void iris_row_join3_mask_neon(uint32_t *dst, const uint32_t *src, const int32_t at[3], uint32_t all,
                              int32_t words);
#define iris_row_join3_mask iris_row_join3_mask_neon
void iris_row_join9_mask_neon(uint32_t *dst, const uint32_t *const rows[3], const uint32_t beside[2],
                              uint32_t all, int32_t words);
#define iris_row_join9_mask iris_row_join9_mask_neon
void iris_row_select_u16_neon(uint16_t *dst, const uint32_t *mask, int32_t n);
#define iris_row_select_u16 iris_row_select_u16_neon

void iris_row_reach_u16_neon(uint16_t *row, const uint16_t *other, iris_row_steps steps, int32_t n);
#define iris_row_reach_u16 iris_row_reach_u16_neon

void iris_row_spread_right_u16_neon(uint16_t *row, uint16_t step, int32_t n);
#define iris_row_spread_right_u16 iris_row_spread_right_u16_neon

void iris_row_spread_left_u16_neon(uint16_t *row, uint16_t step, int32_t n);
#define iris_row_spread_left_u16 iris_row_spread_left_u16_neon

void iris_row_rgb888_nv12_neon(uint8_t *dst, const uint8_t *luma, const uint8_t *chroma, int32_t n);
#define iris_row_rgb888_nv12 iris_row_rgb888_nv12_neon

void iris_row_888_bayer_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t own, int32_t green,
                             int32_t n);
#define iris_row_888_bayer iris_row_888_bayer_neon

void iris_row_integral_u8_neon(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n);
#define iris_row_integral_u8 iris_row_integral_u8_neon

void iris_row_max9_u8_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#define iris_row_max9_u8 iris_row_max9_u8_neon

void iris_row_min9_u8_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#define iris_row_min9_u8 iris_row_min9_u8_neon

void iris_row_bell_down_neon(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius,
                             int32_t n);
#define iris_row_bell_down iris_row_bell_down_neon

void iris_row_bell_across_neon(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n);
#define iris_row_bell_across iris_row_bell_across_neon

void iris_row_bell_across_u8_neon(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                  int32_t step, int32_t n);
#define iris_row_bell_across_u8 iris_row_bell_across_u8_neon

void iris_row_luma_rgba8888_neon(uint8_t *dst, const uint8_t *src, int32_t n);
#define iris_row_luma_rgba8888 iris_row_luma_rgba8888_neon

void iris_row_gradient_u8_neon(const iris_row_gradient *to, const uint8_t *const rows[3], int32_t more,
                               int32_t n);
#define iris_row_gradient_u8 iris_row_gradient_u8_neon

void iris_row_gain_s16_neon(uint8_t *dst, const int16_t *size, uint32_t gain_q16, int32_t n);
#define iris_row_gain_s16 iris_row_gain_s16_neon

void iris_row_above_s16_neon(uint32_t *mask, const int16_t *src, int32_t limit, int32_t n);
#define iris_row_above_s16 iris_row_above_s16_neon

void iris_row_ridges_s16_neon(uint32_t *weak, uint32_t *strong, const iris_row_ridges *rows, int32_t n);
#define iris_row_ridges_s16 iris_row_ridges_s16_neon

void iris_row_unlike_u8_neon(uint32_t *mask, const uint8_t *const rows[3], uint8_t limit, int32_t n);
#define iris_row_unlike_u8 iris_row_unlike_u8_neon

void iris_row_sharpen_u8_neon(uint8_t *dst, const uint8_t *src, const uint8_t *blurred,
                              iris_row_sharpening by, int32_t n);
#define iris_row_sharpen_u8 iris_row_sharpen_u8_neon

void iris_row_wide_down_neon(int16_t *dst, const uint8_t *src, const int32_t *at, const int16_t *weights,
                             int32_t radius, int32_t n);
#define iris_row_wide_down iris_row_wide_down_neon

void iris_row_wide_across_neon(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n);
#define iris_row_wide_across iris_row_wide_across_neon

void iris_row_wide_across_u8_neon(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                  int32_t step, int32_t n);
#define iris_row_wide_across_u8 iris_row_wide_across_u8_neon

void iris_row_filter_u8_neon(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                             const iris_row_quotient *quotient, int32_t n);
#define iris_row_filter_u8 iris_row_filter_u8_neon

void iris_row_crossings_s16_neon(uint32_t *mask, const int16_t *const rows[3], int32_t threshold, int32_t n);
#define iris_row_crossings_s16 iris_row_crossings_s16_neon

#endif
