#include "views.h"

int iris_views_same_place(const iris_image *a, const iris_image *b)
{
    return a->data == b->data && (a->stride == b->stride || a->h == 1);
}

iris_status iris_views_check(const iris_image *dst, const iris_image *src, iris_border border)
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
    int same = dst->format == src->format && iris_views_same_place(dst, src);
    return !same && iris_image_overlaps(dst, src) ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_views_check_levels(const iris_image *dst, const iris_image *src, iris_border border)
{
    iris_status status = iris_views_check(dst, src, border);
    if (status == IRIS_ERR_ARG) {
        return status;
    }
    return iris_format_is_levels(src->format) && dst->format == src->format ? status : IRIS_ERR_FORMAT;
}

iris_status iris_views_check_formats(const iris_image *dst, iris_format to, const iris_image *src,
                                     iris_format from)
{
    iris_status status = iris_views_check(dst, src, IRIS_BORDER_NONE);
    if (status == IRIS_ERR_ARG) {
        return status;
    }
    return dst->format == to && src->format == from ? status : IRIS_ERR_FORMAT;
}
