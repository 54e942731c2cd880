/* What the readers of picture files have in common: which pixels they give, and where to. */
#ifndef IRIS_PICTURE_READ_H
#define IRIS_PICTURE_READ_H

#include "iris/image.h"

static inline int iris_picture_gives(iris_format format)
{
    return format == IRIS_GRAY8 || format == IRIS_RGB888 || format == IRIS_BGR888;
}

/* Can a picture of w x h pixels be read into this view? IRIS_ERR_FORMAT, IRIS_ERR_RANGE: another size, or the errors of
 * iris_image_check. */
static inline iris_status iris_picture_fits(const iris_image *image, int32_t w, int32_t h)
{
    iris_status status = iris_image_check(image);
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_picture_gives(image->format)) {
        return IRIS_ERR_FORMAT;
    }
    return image->w == w && image->h == h ? IRIS_OK : IRIS_ERR_RANGE;
}

#endif
