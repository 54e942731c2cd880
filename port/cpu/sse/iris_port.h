/* The SSE port: x86-64-v2, which has SSSE3 and SSE4.1. Included by kernel.h only. */
#ifndef IRIS_PORT_H
#define IRIS_PORT_H

#include <stdint.h>

#define IRIS_PORT_NAME      "sse"
#define IRIS_PORT_OVERRIDES 49

void iris_row_luma_rgb888_sse(uint8_t *dst, const uint8_t *src, int32_t n);
#define iris_row_luma_rgb888 iris_row_luma_rgb888_sse

void iris_row_luma_bgr888_sse(uint8_t *dst, const uint8_t *src, int32_t n);
#define iris_row_luma_bgr888 iris_row_luma_bgr888_sse

void iris_row_swap_888_sse(uint8_t *dst, const uint8_t *src, int32_t n);
#define iris_row_swap_888 iris_row_swap_888_sse

void iris_row_above_u8_sse(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n);
#define iris_row_above_u8 iris_row_above_u8_sse

void iris_row_scan8_u8_sse(iris_block8 *block, const uint8_t *src, int32_t n);
#define iris_row_scan8_u8 iris_row_scan8_u8_sse

void iris_row_box_mean_u8_sse(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n);
#define iris_row_box_mean_u8 iris_row_box_mean_u8_sse

void iris_row_above_mean_u8_sse(uint32_t *mask, const uint8_t *src, const uint32_t *sums,
                                iris_row_window window, int32_t n);
#define iris_row_above_mean_u8 iris_row_above_mean_u8_sse

void iris_row_hsl_range_sse(uint32_t *mask, const uint8_t *rgb, const iris_hsl_range_test *test, int32_t n);
#define iris_row_hsl_range iris_row_hsl_range_sse

void iris_row_hsl24_888_sse(uint8_t *dst, const uint8_t *src, int32_t red, int32_t n);
#define iris_row_hsl24_888 iris_row_hsl24_888_sse

void iris_row_median9_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#define iris_row_median9_u8 iris_row_median9_u8_sse

void iris_row_sort5_u8_sse(uint8_t *const sorted[5], const uint8_t *const rows[5], int32_t n);
#define iris_row_sort5_u8 iris_row_sort5_u8_sse

void iris_row_median25_u8_sse(uint8_t *dst, const uint8_t *const sorted[5], int32_t step, int32_t n);
#define iris_row_median25_u8 iris_row_median25_u8_sse

void iris_row_join9_mask_sse(uint32_t *dst, const uint32_t *const rows[3], const uint32_t beside[2],
                             uint32_t all, int32_t words);
#define iris_row_join9_mask iris_row_join9_mask_sse
void iris_row_select_u16_sse(uint16_t *dst, const uint32_t *mask, int32_t n);
#define iris_row_select_u16 iris_row_select_u16_sse

void iris_row_reach_u16_sse(uint16_t *row, const uint16_t *other, iris_row_steps steps, int32_t n);
#define iris_row_reach_u16 iris_row_reach_u16_sse

void iris_row_spread_right_u16_sse(uint16_t *row, uint16_t step, int32_t n);
#define iris_row_spread_right_u16 iris_row_spread_right_u16_sse

void iris_row_spread_left_u16_sse(uint16_t *row, uint16_t step, int32_t n);
#define iris_row_spread_left_u16 iris_row_spread_left_u16_sse

void iris_row_rgb888_nv12_sse(uint8_t *dst, const uint8_t *luma, const uint8_t *chroma, int32_t n);
#define iris_row_rgb888_nv12 iris_row_rgb888_nv12_sse

void iris_row_888_bayer_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t own, int32_t green,
                            int32_t n);
#define iris_row_888_bayer iris_row_888_bayer_sse

void iris_row_halve_u16_sse(uint8_t *dst, const uint16_t *sums, int32_t n);
#define iris_row_halve_u16 iris_row_halve_u16_sse

void iris_row_integral_u8_sse(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n);
#define iris_row_integral_u8 iris_row_integral_u8_sse

void iris_row_max9_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#define iris_row_max9_u8 iris_row_max9_u8_sse

void iris_row_min9_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#define iris_row_min9_u8 iris_row_min9_u8_sse

void iris_row_bell_down_sse(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius,
                            int32_t n);
#define iris_row_bell_down iris_row_bell_down_sse

void iris_row_bell_across_sse(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                              int32_t step, int32_t n);
#define iris_row_bell_across iris_row_bell_across_sse

void iris_row_bell_across_u8_sse(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                 int32_t step, int32_t n);
#define iris_row_bell_across_u8 iris_row_bell_across_u8_sse

void iris_row_luma_rgba8888_sse(uint8_t *dst, const uint8_t *src, int32_t n);
#define iris_row_luma_rgba8888 iris_row_luma_rgba8888_sse

void iris_row_gradient_u8_sse(const iris_row_gradient *to, const uint8_t *const rows[3], int32_t more,
                              int32_t n);
#define iris_row_gradient_u8 iris_row_gradient_u8_sse

void iris_row_gradient_gain_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t more,
                                   uint32_t gain_q16, int32_t n);
#define iris_row_gradient_gain_u8 iris_row_gradient_gain_u8_sse

void iris_row_laplacian_gain_u8_sse(uint8_t *dst, const uint8_t *const rows[3], uint32_t gain_q16, int32_t n);
#define iris_row_laplacian_gain_u8 iris_row_laplacian_gain_u8_sse

void iris_row_gain_s16_sse(uint8_t *dst, const int16_t *size, uint32_t gain_q16, int32_t n);
#define iris_row_gain_s16 iris_row_gain_s16_sse

void iris_row_above_s16_sse(uint32_t *mask, const int16_t *src, int32_t limit, int32_t n);
#define iris_row_above_s16 iris_row_above_s16_sse

void iris_row_ridges_s16_sse(uint32_t *weak, uint32_t *strong, const iris_row_ridges *rows, int32_t n);
#define iris_row_ridges_s16 iris_row_ridges_s16_sse

void iris_row_unlike_u8_sse(uint32_t *mask, const uint8_t *const rows[3], uint8_t limit, int32_t n);
#define iris_row_unlike_u8 iris_row_unlike_u8_sse

void iris_row_sharpen_u8_sse(uint8_t *dst, const uint8_t *src, const uint8_t *blurred, iris_row_sharpening by,
                             int32_t n);
#define iris_row_sharpen_u8 iris_row_sharpen_u8_sse

void iris_row_wide_down_sse(int16_t *dst, const uint8_t *src, const int32_t *at, const int16_t *weights,
                            int32_t radius, int32_t n);
#define iris_row_wide_down iris_row_wide_down_sse

void iris_row_wide_across_sse(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                              int32_t step, int32_t n);
#define iris_row_wide_across iris_row_wide_across_sse

void iris_row_wide_across_u8_sse(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                 int32_t step, int32_t n);
#define iris_row_wide_across_u8 iris_row_wide_across_u8_sse

void iris_row_taps_u8_sse(int32_t *sums, const iris_row_tap *taps, int32_t count, int32_t n);
#define iris_row_taps_u8 iris_row_taps_u8_sse

void iris_row_filter_u8_sse(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                            const iris_row_quotient *quotient, int32_t n);
#define iris_row_filter_u8 iris_row_filter_u8_sse

void iris_row_crossings_s16_sse(uint32_t *mask, const int16_t *const rows[3], int32_t threshold, int32_t n);
#define iris_row_crossings_s16 iris_row_crossings_s16_sse

void iris_row_columns16_u8_sse(uint8_t *dst, ptrdiff_t stride, const uint8_t *const rows[16], int32_t n);
#define iris_row_columns16_u8 iris_row_columns16_u8_sse

void iris_row_tone_u8_sse(uint8_t *dst, const uint8_t *src, const uint8_t level[256], int32_t n);
#define iris_row_tone_u8 iris_row_tone_u8_sse

void iris_row_census_u8_sse(uint8_t *const planes[3], const uint8_t *const rows[5], int32_t n);
#define iris_row_census_u8 iris_row_census_u8_sse

void iris_row_costs_u8_sse(uint8_t *costs, const iris_row_pair *pair, int32_t n);
#define iris_row_costs_u8 iris_row_costs_u8_sse

void iris_row_slide_costs_u16_sse(uint16_t *sums, const iris_row_pair *enter, const iris_row_pair *leave,
                                  int32_t n);
#define iris_row_slide_costs_u16 iris_row_slide_costs_u16_sse

void iris_row_least_u16_sse(const iris_row_least *to, const uint16_t *costs, int32_t steps, int32_t apart,
                            int32_t n);
#define iris_row_least_u16 iris_row_least_u16_sse

void iris_row_paths_u16_sse(uint16_t *paths, const uint16_t *from, uint16_t *sums,
                            const iris_row_ground *ground, int32_t n);
#define iris_row_paths_u16 iris_row_paths_u16_sse

void iris_row_paths_along_u16_sse(uint16_t *sums, uint16_t *room, const iris_row_ground *ground, int32_t n);
#define iris_row_paths_along_u16 iris_row_paths_along_u16_sse

#endif
