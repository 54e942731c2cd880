/* The AVX2 port: x86-64-v3. It takes the SSE port's kernels, compiled anew for this processor: those on lanes.h get
 * vectors of 32 bytes, the others keep 16, where twice as many buy nothing. Included by kernel.h only. */
#ifndef IRIS_PORT_AVX2_H
#define IRIS_PORT_AVX2_H

#include "../sse/iris_port.h"

#undef IRIS_PORT_NAME
#define IRIS_PORT_NAME "avx2"
#undef IRIS_PORT_OVERRIDES
#define IRIS_PORT_OVERRIDES 51

void iris_row_luma_rgb888_avx2(uint8_t *dst, const uint8_t *src, int32_t n);
#undef iris_row_luma_rgb888
#define iris_row_luma_rgb888 iris_row_luma_rgb888_avx2

void iris_row_luma_bgr888_avx2(uint8_t *dst, const uint8_t *src, int32_t n);
#undef iris_row_luma_bgr888
#define iris_row_luma_bgr888 iris_row_luma_bgr888_avx2

void iris_row_luma_rgba8888_avx2(uint8_t *dst, const uint8_t *src, int32_t n);
#undef iris_row_luma_rgba8888
#define iris_row_luma_rgba8888 iris_row_luma_rgba8888_avx2

void iris_row_above_u8_avx2(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n);
#undef iris_row_above_u8
#define iris_row_above_u8 iris_row_above_u8_avx2

void iris_row_max9_u8_avx2(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#undef iris_row_max9_u8
#define iris_row_max9_u8 iris_row_max9_u8_avx2

void iris_row_min9_u8_avx2(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#undef iris_row_min9_u8
#define iris_row_min9_u8 iris_row_min9_u8_avx2

void iris_row_select_u16_avx2(uint16_t *dst, const uint32_t *mask, int32_t n);
#undef iris_row_select_u16
#define iris_row_select_u16 iris_row_select_u16_avx2

#undef iris_row_halve_u16
#define iris_row_halve_u16 iris_row_halve_u16_c

void iris_row_reach_u16_avx2(uint16_t *row, const uint16_t *other, iris_row_steps steps, int32_t n);
#undef iris_row_reach_u16
#define iris_row_reach_u16 iris_row_reach_u16_avx2

void iris_row_spread_right_u16_avx2(uint16_t *row, uint16_t step, int32_t n);
#undef iris_row_spread_right_u16
#define iris_row_spread_right_u16 iris_row_spread_right_u16_avx2

void iris_row_spread_left_u16_avx2(uint16_t *row, uint16_t step, int32_t n);
#undef iris_row_spread_left_u16
#define iris_row_spread_left_u16 iris_row_spread_left_u16_avx2

void iris_row_median9_u8_avx2(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n);
#undef iris_row_median9_u8
#define iris_row_median9_u8 iris_row_median9_u8_avx2

void iris_row_sort5_u8_avx2(uint8_t *const sorted[5], const uint8_t *const rows[5], int32_t n);
#undef iris_row_sort5_u8
#define iris_row_sort5_u8 iris_row_sort5_u8_avx2

void iris_row_median25_u8_avx2(uint8_t *dst, const uint8_t *const sorted[5], int32_t step, int32_t n);
#undef iris_row_median25_u8
#define iris_row_median25_u8 iris_row_median25_u8_avx2

void iris_row_rgb888_nv12_avx2(uint8_t *dst, const uint8_t *luma, const uint8_t *chroma, int32_t n);
#undef iris_row_rgb888_nv12
#define iris_row_rgb888_nv12 iris_row_rgb888_nv12_avx2

void iris_row_888_bayer_avx2(uint8_t *dst, const uint8_t *const rows[3], int32_t own, int32_t green,
                             int32_t n);
#undef iris_row_888_bayer
#define iris_row_888_bayer iris_row_888_bayer_avx2

void iris_row_box_mean_u8_avx2(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n);
#undef iris_row_box_mean_u8
#define iris_row_box_mean_u8 iris_row_box_mean_u8_avx2

void iris_row_above_mean_u8_avx2(uint32_t *mask, const uint8_t *src, const uint32_t *sums,
                                 iris_row_window window, int32_t n);
#undef iris_row_above_mean_u8
#define iris_row_above_mean_u8 iris_row_above_mean_u8_avx2

void iris_row_between_u8_avx2(uint8_t *dst, const uint8_t *const rows[2], const iris_row_places *places,
                              uint32_t down, int32_t n);
#undef iris_row_between_u8
#define iris_row_between_u8 iris_row_between_u8_avx2

void iris_row_columns16_u8_avx2(uint8_t *dst, ptrdiff_t stride, const uint8_t *const rows[16], int32_t n);
#undef iris_row_columns16_u8
#define iris_row_columns16_u8 iris_row_columns16_u8_avx2

void iris_row_tone_u8_avx2(uint8_t *dst, const uint8_t *src, const uint8_t level[256], int32_t n);
#undef iris_row_tone_u8
#define iris_row_tone_u8 iris_row_tone_u8_avx2

void iris_row_bends_u8_avx2(uint8_t *dst, const iris_row_bends *way, int32_t n);
#define iris_row_bends_u8 iris_row_bends_u8_avx2

void iris_row_along_u8_avx2(uint8_t *dst, const iris_row_way *way, int32_t n);
#define iris_row_along_u8 iris_row_along_u8_avx2

void iris_row_integral_u8_avx2(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n);
#undef iris_row_integral_u8
#define iris_row_integral_u8 iris_row_integral_u8_avx2

#endif
