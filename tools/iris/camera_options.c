#include <string.h>

#include "args.h"
#include "camera.h"
#include "complain.h"
#include "raw_picture.h"

static int read_size(iris_size *size, const char *text)
{
    int32_t n[2];
    if (!args_numbers(n, 2, 'x', text) || n[0] < 1 || n[1] < 1 || n[0] > IRIS_SIDE_MAX ||
        n[1] > IRIS_SIDE_MAX) {
        complain("--size", "WxH, 1 to %d pixels each, not '%s'", IRIS_SIDE_MAX, text);
        return 0;
    }
    *size = (iris_size){n[0], n[1]};
    return 1;
}

static int read_format(int32_t *format, const char *text)
{
    *format = (int32_t)raw_format_find(text, strlen(text));
    if (*format == IRIS_UV88) {
        *format = IRIS_CAPTURE_NV12;
    }
    if (*format == 0) {
        complain(
            "--format",
            "gray, rgb, bgr, rgba, rgb565, rgb565-be, yuyv, uyvy, nv12, or bayer-rggb and such, not '%s'",
            text);
    }
    return *format != 0;
}

static int read_rate(int32_t *rate_millihz, const char *text)
{
    int32_t rate_q16;
    int good = args_q16(&rate_q16, 1, 1000 * 65536, text);
    *rate_millihz = good ? (int32_t)(((int64_t)rate_q16 * 1000 + 32768) / 65536) : 0;
    if (*rate_millihz == 0) {
        complain("--rate", "frames per second, above 0 to 1000, not '%s'", text);
    }
    return *rate_millihz != 0;
}

int camera_options_read(iris_capture_config *config, const camera_texts *texts)
{
    *config = (iris_capture_config){0};
    return (!texts->size || read_size(&config->size, texts->size)) &&
           (!texts->format || read_format(&config->format, texts->format)) &&
           (!texts->rate || read_rate(&config->rate_millihz, texts->rate));
}

const char *camera_format_name(int32_t format)
{
    const char *name = raw_format_name(format == IRIS_CAPTURE_NV12 ? IRIS_UV88 : (iris_format)format);
    return name ? name : "?";
}
