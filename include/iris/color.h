/* IRIS - color: from any camera's pixels to gray, RGB, and HSL, and back.
 *
 * Conversions exist for whole views and for single rows, so that a row can be used as it arrives from the sensor. The
 * two give the same pixels. Report, sections 2.2 (grayscale conversion) and 3.2.2 (ColorSpaceConvertor).
 *
 * What the numbers mean:
 *   RGB565  5 and 6 bits are widened to 8 by repeating their high bits: 0 stays 0 and the largest is 255.
 *   RGBA    alpha is ignored: the color is as it was stored.
 *   YUV     BT.601 in the limited range, as webcams send it: Y 16 black to 235 white, U and V 128 neutral.
 *           RGB is widened to 0..255, within 1 of the exact value; GRAY8 by luma is Y as it came, which is
 *           what thresholds want.
 *   HSL     the double cone: M and m the largest and smallest of R, G, B; C = M - m; L = M + m;
 *           S = C / min(L, 510 - L); hue 0 red, 1/3 of a turn green, 2/3 blue, linear in between.
 *           S of black and white is 0, and the hue of every gray is 0.
 *   HSL48   uint16_t H 0..1535 (256 steps for 60 degrees), S 0..65535, L 0..510. From RGB and back is
 *           identity for every color. H and S are within half a step of the exact values, L is exact.
 *   HSL24   bytes H (256 steps for a turn), S 0..255, L 0..255 (half of the above), each the exact value
 *           rounded. From RGB and back, no channel moves by more than 4.
 */
#ifndef IRIS_COLOR_H
#define IRIS_COLOR_H

#include <stdint.h>

#include "iris/image.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint8_t r, g, b;
} iris_color;

typedef struct {
    uint16_t h; /* 0..1535 */
    uint16_t s; /* 0..65535 */
    uint16_t l; /* 0..510 */
} iris_hsl;     /* as in IRIS_HSL48 */

typedef enum {
    IRIS_GRAY_LUMA = 0, /* (77 R + 150 G + 29 B + 128) / 256, rounded down; of YUYV and UYVY: Y */
    IRIS_GRAY_AVERAGE,  /* (R + G + B) / 3, rounded */
    IRIS_GRAY_GREEN     /* G */
} iris_gray_method;

/* One pixel. Total: a hue of 1536 or more starts over, a lightness above 510 counts as 510. O(1). */
iris_hsl iris_hsl_from_color(iris_color color);
iris_color iris_color_from_hsl(iris_hsl hsl);

/* Converts a whole view. Sizes must be the same.
 *   to                from
 *   GRAY8             GRAY8, RGB888, BGR888, RGBA8888, RGB565, RGB565_SWAP, YUYV, UYVY (by luma), MASK1 (0 and 255)
 *   RGB888, BGR888    the same without MASK1 (gray: all three channels), HSL24, HSL48
 *   HSL24, HSL48      RGB888, BGR888
 * NV12, which is two views, is converted by nv12.h, and the BAYER8 formats, where a pixel needs its neighbors, by
 * bayer.h.
 * dst may be src (the same data and stride) where both formats have the same bytes per pixel; else they are disjoint.
 * IRIS_ERR_ARG: null pointer or invalid view; IRIS_ERR_FORMAT: another pair of formats; IRIS_ERR_RANGE: sizes differ;
 * IRIS_ERR_ALIAS. O(w h); to HSL: two divisions for every pixel that is not gray. */
iris_status iris_color_convert(const iris_image *dst, const iris_image *src);

/* Converts one row of n pixels, as iris_color_convert. Rows of HSL48 are aligned to 2 bytes, rows of MASK1 to 4.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: n outside 1..IRIS_SIDE_MAX, or odd for YUYV and UYVY;
 * IRIS_ERR_ALIGN; IRIS_ERR_ALIAS: the rows overlap but are not the same. O(n). */
iris_status iris_color_row(void *dst, iris_format dst_format, const void *src, iris_format src_format,
                           int32_t n);

/* 1 for the formats that come from cameras and files: GRAY8, RGB888, BGR888, RGBA8888, RGB565, RGB565_SWAP, YUYV, and
 * UYVY; these are what the functions below take. Else 0. O(1). */
int iris_color_takes(iris_format format);

/* Gray by the given method, from what iris_color_takes (GRAY8 is copied): a whole view, and one row. Errors,
 * aliasing, and cost as above; also IRIS_ERR_ARG for an unknown method. */
iris_status iris_color_gray(const iris_image *dst, const iris_image *src, iris_gray_method method);
iris_status iris_color_gray_row(uint8_t *dst, const void *src, iris_format src_format,
                                iris_gray_method method, int32_t n);

/* A row of RGB888 from the same formats. Errors, aliasing, and cost as above. A firmware that calls this and
 * iris_color_gray_row instead of iris_color_row carries no HSL conversion. */
iris_status iris_color_rgb_row(uint8_t *dst, const void *src, iris_format src_format, int32_t n);

/* A range of colors. All bounds belong to it. h0 > h1 goes through red: 350 to 10 is 20 degrees wide; 0 and 360 are the
 * same hue, and 0 to 360 is every hue. Grays have hue 0: a lower bound on saturation excludes them. */
typedef struct {
    int32_t h0, h1; /* degrees, 0..360 */
    int32_t s0, s1; /* percent, 0..100, s0 <= s1 */
    int32_t l0, l1; /* percent, 0..100, l0 <= l1 */
} iris_hsl_range;

/* The range made ready for pixels: exact comparisons of whole numbers, without a division per pixel. */
typedef struct {
    int32_t h0, h1;       /* degrees */
    int32_t s0, s1;       /* percent */
    int32_t l0, l1;       /* of M + m, 0..510 */
    int32_t chroma_min;   /* of M - m: 1 when grays are too pale */
    int32_t hue_wraps;    /* 1: h >= h0 or h <= h1; 0: both */
    int32_t hue_has_gray; /* 1: hue 0 is inside */
} iris_hsl_range_test;

/* IRIS_ERR_ARG: null pointer, or a bound outside its range. O(1). */
iris_status iris_hsl_range_prepare(iris_hsl_range_test *test, const iris_hsl_range *range);

/* 1 when the color is in the range, else 0; exact, not through rounded HSL. test is a prepared one. O(1). */
int iris_hsl_range_has(const iris_hsl_range_test *test, iris_color color);

/* The same for n pixels of a row of RGB888: bit i of mask = rgb pixel i is in the range. Bits past n are kept.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: n outside 1..IRIS_SIDE_MAX; IRIS_ERR_ALIGN: mask; IRIS_ERR_ALIAS: the
 * rows overlap. O(n). */
iris_status iris_hsl_range_row(uint32_t *mask, const uint8_t *rgb, int32_t n,
                               const iris_hsl_range_test *test);

/* A whole view: mask (IRIS_MASK1) from src in any format that iris_color_rgb_row takes.
 * IRIS_ERR_ARG: null pointer, invalid view, or a bound of the range; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: sizes differ;
 * IRIS_ERR_ALIAS: the views overlap. O(w h). */
iris_status iris_hsl_range_mask(const iris_image *mask, const iris_image *src, const iris_hsl_range *range);

#ifdef __cplusplus
}
#endif

#endif
