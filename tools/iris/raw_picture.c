#include "raw_picture.h"

#include <string.h>

#include "args.h"
#include "complain.h"
#include "iris/bayer.h"
#include "iris/color.h"
#include "iris/nv12.h"

static const struct {
    const char *name;
    iris_format format;
} formats[] = {{"gray", IRIS_GRAY8},
               {"rgb", IRIS_RGB888},
               {"bgr", IRIS_BGR888},
               {"rgba", IRIS_RGBA8888},
               {"rgb565", IRIS_RGB565},
               {"rgb565-be", IRIS_RGB565_SWAP},
               {"yuyv", IRIS_YUYV},
               {"uyvy", IRIS_UYVY},
               {"nv12", IRIS_UV88},
               {"bayer-rggb", IRIS_BAYER8_RGGB},
               {"bayer-grbg", IRIS_BAYER8_GRBG},
               {"bayer-gbrg", IRIS_BAYER8_GBRG},
               {"bayer-bggr", IRIS_BAYER8_BGGR}};

iris_format raw_format_find(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (strlen(formats[i].name) == length && memcmp(formats[i].name, name, length) == 0) {
            return formats[i].format;
        }
    }
    return (iris_format)0;
}

const char *raw_format_name(iris_format format)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (formats[i].format == format) {
            return formats[i].name;
        }
    }
    return NULL;
}

int raw_layout_parse(raw_layout *layout, const char *text)
{
    const char *colon = strchr(text, ':');
    int32_t n[2];
    *layout = (raw_layout){0};
    if (colon) {
        layout->format = raw_format_find(text, (size_t)(colon - text));
    }
    if (!layout->format) {
        complain("--raw", "FORMAT:WxH with a format such as yuyv, nv12, or bayer-rggb (see --help), not '%s'",
                 text);
        return 0;
    }
    if (!args_numbers(n, 2, 'x', colon + 1) || n[0] < 1 || n[1] < 1 || n[0] > IRIS_SIDE_MAX ||
        n[1] > IRIS_SIDE_MAX) {
        complain("--raw", "FORMAT:WxH, 1 to %d pixels each, not '%s'", IRIS_SIDE_MAX, text);
        return 0;
    }
    int in_pairs = layout->format == IRIS_YUYV || layout->format == IRIS_UYVY || layout->format == IRIS_UV88;
    if ((in_pairs && n[0] % 2 != 0) || (layout->format == IRIS_UV88 && n[1] % 2 != 0)) {
        complain("--raw", "pixels of %.*s share their color in pairs: an even size, not '%s'",
                 (int)(colon - text), text, colon + 1);
        return 0;
    }
    layout->size = (iris_size){n[0], n[1]};
    return 1;
}

/* The two planes lie in one buffer, as one gray picture of one and a half times the height. */
static iris_status from_nv12(const iris_image *dst, const iris_image *bytes)
{
    iris_image luma = *bytes, chroma = *bytes;
    luma.h = dst->h;
    chroma.data = iris_image_row(bytes, dst->h);
    chroma.w = dst->w / 2;
    chroma.h = dst->h / 2;
    chroma.format = IRIS_UV88;
    return iris_nv12_convert(dst, &luma, &chroma);
}

iris_status raw_picture_read(picture_buffer *picture, picture_buffer *bytes, iris_stream *stream,
                             const raw_layout *layout)
{
    const iris_image *from = &bytes->image, *to = &picture->image;
    int is_nv12 = layout->format == IRIS_UV88, is_gray = layout->format == IRIS_GRAY8;
    iris_size size = layout->size;
    if (is_nv12) {
        size.h += size.h / 2;
    }
    iris_status status = picture_reserve(bytes, size, is_nv12 ? IRIS_GRAY8 : layout->format);
    if (status == IRIS_OK) {
        status = picture_reserve(picture, layout->size, is_gray ? IRIS_GRAY8 : IRIS_RGB888);
    }
    if (status == IRIS_OK) {
        status = iris_stream_read(stream, from->data, (size_t)from->stride * (size_t)from->h);
    }
    if (status != IRIS_OK) {
        return status;
    }
    return is_nv12                              ? from_nv12(to, from)
           : layout->format >= IRIS_BAYER8_RGGB ? iris_bayer_convert(to, from)
                                                : iris_color_convert(to, from);
}
