/* Cameras of the kernel: what is wanted, and what the driver makes of it. */
#include "iris/v4l2.h"
#include "v4l2_buffers.h"
#include "video_device.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

/* The longest list of formats that is read. */
enum { FORMATS_MAX = 256 };

/* struct v4l2_format without the two ways to say it. */
typedef struct {
    uint32_t w, h, fourcc, field, colorspace, encoding, quantization, planes;
    uint32_t stride[2];
} picture_format;

static void read_format(picture_format *read, const struct v4l2_format *format)
{
    if (format->type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
        const struct v4l2_pix_format_mplane *pix = &format->fmt.pix_mp;
        *read = (picture_format){pix->width,
                                 pix->height,
                                 pix->pixelformat,
                                 pix->field,
                                 pix->colorspace,
                                 pix->ycbcr_enc,
                                 pix->quantization,
                                 pix->num_planes,
                                 {pix->plane_fmt[0].bytesperline, pix->plane_fmt[1].bytesperline}};
    } else {
        const struct v4l2_pix_format *pix = &format->fmt.pix;
        *read = (picture_format){pix->width,
                                 pix->height,
                                 pix->pixelformat,
                                 pix->field,
                                 pix->colorspace,
                                 pix->ycbcr_enc,
                                 pix->quantization,
                                 1,
                                 {pix->bytesperline, pix->bytesperline}};
    }
}

static void write_format(struct v4l2_format *format, iris_size size, const video_format *wanted,
                         uint32_t stride)
{
    if (format->type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
        struct v4l2_pix_format_mplane *pix = &format->fmt.pix_mp;
        pix->width = size.w ? (uint32_t)size.w : pix->width;
        pix->height = size.h ? (uint32_t)size.h : pix->height;
        pix->pixelformat = wanted->fourcc;
        pix->field = V4L2_FIELD_NONE;
        pix->num_planes = (uint8_t)wanted->planes;
        memset(pix->plane_fmt, 0, sizeof pix->plane_fmt);
        for (int32_t i = 0; i < wanted->planes; i++) {
            pix->plane_fmt[i].bytesperline = stride;
        }
    } else {
        struct v4l2_pix_format *pix = &format->fmt.pix;
        pix->width = size.w ? (uint32_t)size.w : pix->width;
        pix->height = size.h ? (uint32_t)size.h : pix->height;
        pix->pixelformat = wanted->fourcc;
        pix->field = V4L2_FIELD_NONE;
        pix->bytesperline = stride;
        pix->sizeimage = 0;
    }
}

/* Says that nothing that is offered is wanted: by name. */
static iris_status refuse(iris_v4l2 *device, int32_t wanted)
{
    problem_text text = problem_text_in(device->problem, sizeof device->problem);
    char name[VIDEO_FOURCC_BYTES];
    problem_text_add(&text, "the camera offers ");
    for (uint32_t i = 0; i < FORMATS_MAX; i++) {
        struct v4l2_fmtdesc offer;
        memset(&offer, 0, sizeof offer);
        offer.index = i;
        offer.type = device->type;
        if (video_ask(device->handle, VIDIOC_ENUM_FMT, &offer) != 0) {
            problem_text_add(&text, i == 0 ? "no format at all" : "");
            break;
        }
        video_fourcc_text(name, offer.pixelformat);
        if (text.length > 96) {
            problem_text_add(&text, " and more");
            break;
        }
        problem_text_add(&text, i == 0 ? "" : " ");
        problem_text_add(&text, name);
    }
    int32_t named = 0;
    for (int i = 0; i < VIDEO_FORMATS; i++) {
        named += video_formats[i].format == wanted;
    }
    problem_text_add(&text, wanted == 0 ? "; IRIS reads"
                            : named > 0 ? "; wanted is"
                                        : "; no camera of the kernel gives the one that is wanted");
    for (int i = 0; i < VIDEO_FORMATS; i++) {
        if (wanted == 0 || video_formats[i].format == wanted) {
            video_fourcc_text(name, video_formats[i].fourcc);
            problem_text_add(&text, " ");
            problem_text_add(&text, name);
        }
    }
    return IRIS_ERR_FORMAT;
}

/* The first of video_formats that is wanted and offered; null: none. *error: errno when the list could not be read. */
static const video_format *choose(int *error, const iris_v4l2 *device, int32_t wanted)
{
    const video_format *best = NULL;
    *error = 0;
    for (uint32_t i = 0; i < FORMATS_MAX; i++) {
        struct v4l2_fmtdesc offer;
        memset(&offer, 0, sizeof offer);
        offer.index = i;
        offer.type = device->type;
        int failed = video_ask(device->handle, VIDIOC_ENUM_FMT, &offer);
        if (failed != 0) {
            *error = failed == EINVAL || failed == ENOTTY ? 0 : failed;
            break;
        }
        const video_format *found = video_format_find(offer.pixelformat);
        if (found && (wanted == 0 || found->format == wanted) && (!best || found < best) &&
            (found->planes == 1 || device->type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE)) {
            best = found;
        }
    }
    return best;
}

static iris_color_matrix matrix_of(uint32_t encoding)
{
    switch (encoding) {
    case V4L2_YCBCR_ENC_601:
    case V4L2_YCBCR_ENC_XV601:
        return IRIS_MATRIX_BT601;
    case V4L2_YCBCR_ENC_709:
    case V4L2_YCBCR_ENC_XV709:
        return IRIS_MATRIX_BT709;
    case V4L2_YCBCR_ENC_BT2020:
    case V4L2_YCBCR_ENC_BT2020_CONST_LUM:
        return IRIS_MATRIX_BT2020;
    default:
        return IRIS_MATRIX_UNKNOWN;
    }
}

/* What the kernel's defaults mean. A driver that names no colors at all has not said anything. */
static void read_colors(iris_capture_grant *grant, const picture_format *format)
{
    int yuv = grant->format == IRIS_YUYV || grant->format == IRIS_UYVY ||
              grant->format == IRIS_CAPTURE_NV12 || grant->format == IRIS_GRAY8;
    int known = format->colorspace != V4L2_COLORSPACE_DEFAULT;
    uint32_t encoding = format->encoding, quantization = format->quantization;
    if (encoding == V4L2_YCBCR_ENC_DEFAULT && known) {
        encoding = V4L2_MAP_YCBCR_ENC_DEFAULT(format->colorspace);
    }
    if (quantization == V4L2_QUANTIZATION_DEFAULT && known) {
        quantization = V4L2_MAP_QUANTIZATION_DEFAULT(!yuv, format->colorspace, encoding);
    }
    grant->matrix = yuv ? matrix_of(encoding) : IRIS_MATRIX_UNKNOWN;
    grant->range = quantization == V4L2_QUANTIZATION_FULL_RANGE  ? IRIS_RANGE_FULL
                   : quantization == V4L2_QUANTIZATION_LIM_RANGE ? IRIS_RANGE_LIMITED
                                                                 : IRIS_RANGE_UNKNOWN;
}

/* Fills the device's grant with what the driver has settled for. */
static iris_status accept(iris_v4l2 *device, const picture_format *format, int32_t wanted)
{
    const video_format *found = video_format_find(format->fourcc);
    if (!found || (wanted != 0 && found->format != wanted)) {
        return refuse(device, wanted);
    }
    if (format->field == V4L2_FIELD_ALTERNATE || format->field == V4L2_FIELD_SEQ_TB ||
        format->field == V4L2_FIELD_SEQ_BT) {
        return v4l2_fail(device, IRIS_ERR_RANGE, "the camera's pictures are interlaced, each half by itself",
                         0);
    }
    if (format->w < 1 || format->w > IRIS_SIDE_MAX || format->h < 1 || format->h > IRIS_SIDE_MAX ||
        format->planes != (uint32_t)found->planes) {
        return v4l2_fail(device, IRIS_ERR_RANGE,
                         "the camera's pictures have a size or parts that IRIS does not read", 0);
    }
    iris_format first = found->format == IRIS_CAPTURE_NV12 ? IRIS_GRAY8 : (iris_format)found->format;
    size_t row = iris_format_row_bytes(first, (int32_t)format->w);
    size_t chroma_row = iris_format_row_bytes(IRIS_UV88, ((int32_t)format->w + 1) / 2);
    uint32_t stride = format->stride[0] ? format->stride[0] : (uint32_t)row;
    uint32_t chroma = format->stride[found->planes - 1];
    if (row == 0 || stride < row || stride > INT32_MAX || chroma > INT32_MAX) {
        return v4l2_fail(device, IRIS_ERR_RANGE,
                         "the driver's rows are shorter than a picture's, or of odd width", 0);
    }
    device->planes = found->planes;
    device->grant.size = (iris_size){(int32_t)format->w, (int32_t)format->h};
    device->grant.format = found->format;
    device->grant.stride = (int32_t)stride;
    device->chroma_stride = chroma               ? (int32_t)chroma
                            : found->planes == 1 ? (int32_t)stride
                                                 : (int32_t)chroma_row;
    read_colors(&device->grant, format);
    return IRIS_OK;
}

/* Asks for the rate, if one is wanted, and reads what it is; a driver may not know of rates. */
static void set_rate(iris_v4l2 *device, int32_t rate_millihz)
{
    struct v4l2_streamparm parameters;
    struct v4l2_fract *interval = &parameters.parm.capture.timeperframe;
    memset(&parameters, 0, sizeof parameters);
    parameters.type = device->type;
    device->grant.rate_millihz = 0;
    if (video_ask(device->handle, VIDIOC_G_PARM, &parameters) != 0) {
        return;
    }
    if (rate_millihz != 0 && parameters.parm.capture.capability & V4L2_CAP_TIMEPERFRAME) {
        *interval = (struct v4l2_fract){1000, (uint32_t)rate_millihz};
        if (video_ask(device->handle, VIDIOC_S_PARM, &parameters) != 0 &&
            video_ask(device->handle, VIDIOC_G_PARM, &parameters) != 0) {
            return;
        }
    }
    device->grant.rate_millihz = video_rate_millihz(*interval);
}

static iris_status negotiate(iris_v4l2 *device, const iris_capture_config *wanted)
{
    int error = 0;
    const video_format *chosen = choose(&error, device, wanted->format);
    if (error != 0) {
        return v4l2_fail(device, IRIS_ERR_IO, "the camera does not say what it offers", error);
    }
    if (!chosen) {
        return refuse(device, wanted->format);
    }
    struct v4l2_format format;
    picture_format settled;
    memset(&format, 0, sizeof format);
    format.type = device->type;
    error = video_ask(device->handle, VIDIOC_G_FMT, &format);
    if (error == 0) {
        write_format(&format, wanted->size, chosen, (uint32_t)wanted->stride);
        error = video_ask(device->handle, VIDIOC_S_FMT, &format);
    }
    if (error != 0) {
        return v4l2_fail(device, IRIS_ERR_IO, "size and format cannot be set", error);
    }
    read_format(&settled, &format);
    iris_status status = accept(device, &settled, wanted->format);
    if (status == IRIS_OK) {
        set_rate(device, wanted->rate_millihz);
    }
    return status;
}

static void v4l2_close(void *state)
{
    iris_v4l2 *device = state;
    if (device->handle < 0) {
        return;
    }
    v4l2_stop(device);
    v4l2_release(device);
    (void)close(device->handle);
    device->handle = -1;
    device->borrowed = 0;
}

static iris_status v4l2_open(void *state, iris_capture_grant *grant, const char *path,
                             const iris_capture_config *wanted)
{
    iris_v4l2 *device = state;
    struct v4l2_capability capability;
    memset(device, 0, sizeof *device);
    device->handle = -1;
    int error = video_open(&device->handle, &device->type, &capability, path);
    if (error != 0) {
        return v4l2_fail(device, video_open_status(error), video_open_text(error), 0);
    }
    iris_status status = negotiate(device, wanted);
    if (status == IRIS_OK) {
        status = v4l2_map(device, wanted->buffers);
    }
    if (status != IRIS_OK) {
        v4l2_close(device);
        return status;
    }
    *grant = device->grant;
    return IRIS_OK;
}

static const char *v4l2_problem(const void *state)
{
    const iris_v4l2 *device = state;
    return device->problem;
}

iris_capture_source iris_v4l2_source(iris_v4l2 *device)
{
    static const iris_capture_driver driver = {v4l2_open, v4l2_start, v4l2_take,   v4l2_give,
                                               v4l2_stop, v4l2_close, v4l2_problem};
    if (device) {
        memset(device, 0, sizeof *device);
        device->handle = -1;
        (void)v4l2_fail(device, IRIS_OK, "not opened", 0);
    }
    return (iris_capture_source){&driver, device};
}
