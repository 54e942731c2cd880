#include "frame_picture.h"

#include "iris/bayer.h"
#include "iris/color.h"
#include "iris/nv12.h"

iris_status frame_picture(iris_image *view, picture_buffer *room, const iris_frame *frame)
{
    const iris_image *image = &frame->image;
    iris_format format = image->format;
    *view = *image;
    if (!frame->chroma.data && (format == IRIS_GRAY8 || format == IRIS_RGB888 || format == IRIS_BGR888)) {
        return IRIS_OK;
    }
    iris_status status = picture_reserve(room, (iris_size){image->w, image->h}, IRIS_RGB888);
    if (status != IRIS_OK) {
        return status;
    }
    *view = room->image;
    return frame->chroma.data ? iris_nv12_convert(view, image, &frame->chroma)
           : format >= IRIS_BAYER8_RGGB && format <= IRIS_BAYER8_BGGR ? iris_bayer_convert(view, image)
                                                                      : iris_color_convert(view, image);
}
