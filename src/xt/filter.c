#include "filter.h"

static int same_view(const iris_image *a, const iris_image *b)
{
    return a->data == b->data && a->format == b->format && (a->stride == b->stride || a->h == 1);
}

iris_status iris_filter_check(const iris_image *dst, const iris_image *src, iris_border border)
{
    if (!dst || !src || (unsigned)border.rule > IRIS_BORDER_SKIP) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(dst);
    if (status == IRIS_OK) {
        status = iris_image_check(src);
    }
    if (status != IRIS_OK) {
        return status;
    }
    if (dst->w != src->w || dst->h != src->h) {
        return IRIS_ERR_RANGE;
    }
    return !same_view(dst, src) && iris_image_overlaps(dst, src) ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_filter_check_u8(const iris_image *dst, const iris_image *src, iris_border border)
{
    iris_status status = iris_filter_check(dst, src, border);
    if (status == IRIS_ERR_ARG) {
        return status;
    }
    int known = src->format == IRIS_GRAY8 || src->format == IRIS_RGB888 || src->format == IRIS_BGR888;
    return known && dst->format == src->format ? status : IRIS_ERR_FORMAT;
}

iris_status iris_filter_check_formats(const iris_image *dst, iris_format to, const iris_image *src,
                                      iris_format from)
{
    iris_status status = iris_filter_check(dst, src, (iris_border){IRIS_BORDER_REPLICATE, 0});
    if (status == IRIS_ERR_ARG) {
        return status;
    }
    return dst->format == to && src->format == from ? status : IRIS_ERR_FORMAT;
}
