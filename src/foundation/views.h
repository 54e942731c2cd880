/* What operations from one picture to another of the same size ask of their arguments. The errors come in the order
 * argument, invalid view, format, size, aliasing.
 */
#ifndef IRIS_FOUNDATION_VIEWS_H
#define IRIS_FOUNDATION_VIEWS_H

#include "iris/border.h"
#include "iris/image.h"

/* 1 for the formats whose bytes are levels: IRIS_GRAY8, IRIS_RGB888, and IRIS_BGR888. */
static inline int iris_format_is_levels(iris_format format)
{
    return format == IRIS_GRAY8 || format == IRIS_RGB888 || format == IRIS_BGR888;
}

static inline int iris_format_is_bayer(iris_format format)
{
    return format >= IRIS_BAYER8_RGGB && format <= IRIS_BAYER8_BGGR;
}

/* 1 when both are the same rows of memory, whatever their formats. */
int iris_views_same_place(const iris_image *a, const iris_image *b);

/* Any formats. dst may be src when their formats are the same. For operations without a border: IRIS_BORDER_NONE. */
iris_status iris_views_check(const iris_image *dst, const iris_image *src, iris_border border);

/* The same, and both have one format of levels. */
iris_status iris_views_check_levels(const iris_image *dst, const iris_image *src, iris_border border);

/* The same without a border, and dst has the format `to` and src the format `from`. */
iris_status iris_views_check_formats(const iris_image *dst, iris_format to, const iris_image *src,
                                     iris_format from);

/* One picture that is only read, of this format. */
static inline iris_status iris_views_check_one(const iris_image *image, iris_format format)
{
    iris_status status = iris_image_check(image);
    return status == IRIS_OK && image->format != format ? IRIS_ERR_FORMAT : status;
}

#define IRIS_BORDER_NONE ((iris_border){IRIS_BORDER_REPLICATE, 0})

#endif
