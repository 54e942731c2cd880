/* Pictures as cameras dump them: bytes without a header, rows without padding. What they are is said by --raw. */
#ifndef IRIS_TOOL_RAW_PICTURE_H
#define IRIS_TOOL_RAW_PICTURE_H

#include "iris/image.h"
#include "iris/stream.h"
#include "picture.h"

/* For help texts. */
#define RAW_PICTURE_OPTION                                                                                   \
    "  --raw FORMAT:WxH  inputs are a camera's bytes without a header, W by H pixels: gray, rgb,\n"          \
    "                    bgr, rgba, rgb565, rgb565-be, yuyv, uyvy, nv12, bayer-rggb, bayer-grbg,\n"          \
    "                    bayer-gbrg, or bayer-bggr\n"

/* IRIS_UV88 stands for NV12 here. */
typedef struct {
    iris_format format; /* 0: none was given */
    iris_size size;
} raw_layout;

/* The format of a name of `length` letters, such as "yuyv"; 0: there is none. */
iris_format raw_format_find(const char *name, size_t length);

/* Null: not the format of raw pictures. */
const char *raw_format_name(iris_format format);

/* Reads FORMAT:WxH. Returns 0 after complaining. */
int raw_layout_parse(raw_layout *layout, const char *text);

/* Reads the next picture of the stream through *bytes into *picture, as IRIS_GRAY8 (gray) or IRIS_RGB888.
 * IRIS_ERR_END, IRIS_ERR_TRUNCATED, IRIS_ERR_IO: the stream; otherwise the errors of picture_reserve. */
iris_status raw_picture_read(picture_buffer *picture, picture_buffer *bytes, iris_stream *stream,
                             const raw_layout *layout);

#endif
