/* What both files of color conversion share. */
#ifndef IRIS_COLOR_ROWS_H
#define IRIS_COLOR_ROWS_H

#include "iris/color.h"

/* A row of RGB888, and of gray, from a format that iris_color_takes; arguments are checked. */
void iris_color_rgb_fill(uint8_t *dst, const uint8_t *src, iris_format format, int32_t n);
void iris_color_gray_fill(uint8_t *dst, const uint8_t *src, iris_format format, int32_t n,
                          iris_gray_method method);

/* May n pixels at src become n pixels at dst? */
iris_status iris_color_rows_check(const void *dst, iris_format dst_format, const void *src,
                                  iris_format src_format, int32_t n);

/* The same for views, formats apart. */
iris_status iris_color_views_check(const iris_image *dst, const iris_image *src);

#endif
