/* What operations from one picture to another of the same size ask of their arguments. */
#ifndef IRIS_XT_FILTER_H
#define IRIS_XT_FILTER_H

#include "iris/border.h"
#include "iris/image.h"

/* A filter from src to dst, of any formats: the errors in the order argument, invalid view, size, aliasing. dst may
 * be src when their formats are the same. */
iris_status iris_filter_check(const iris_image *dst, const iris_image *src, iris_border border);

/* The same, and both are IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888. */
iris_status iris_filter_check_u8(const iris_image *dst, const iris_image *src, iris_border border);

/* The same without a border, and dst has the format `to` and src the format `from`. */
iris_status iris_filter_check_formats(const iris_image *dst, iris_format to, const iris_image *src,
                                      iris_format from);

#endif
