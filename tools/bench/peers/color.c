/* Colors: conversions, and the pixels within a range. */
#include "iris/color.h"
#include "iris/bayer.h"
#include "iris/copy.h"
#include "iris/nv12.h"
#include "iris/xt/follow.h"
#include "peers.h"

static iris_image bgr, source, hsl;

/* The picture's bytes as those of another format. */
static void take(iris_format format)
{
    source = bench_frame.rgb;
    source.format = format;
    source.stride = (ptrdiff_t)iris_format_row_bytes(format, source.w);
}

static void gray_of_bgr(void)
{
    take(IRIS_BGR888);
    peer_gives_gray();
}

static void gray_of_yuyv(void)
{
    take(IRIS_YUYV);
    peer_gives_gray();
}

static void color_of_yuyv(void)
{
    take(IRIS_YUYV);
    peer_gives_color();
}

static void color_of_bgr(void)
{
    take(IRIS_BGR888);
    peer_gives_color();
}

/* The chroma of NV12 comes as the color picture's first bytes. */
static void color_of_nv12(void)
{
    source = (iris_image){bench_frame.rgb.data, bench_frame.gray.w / 2 * 2, bench_frame.gray.w / 2,
                          bench_frame.gray.h / 2, IRIS_UV88};
    peer_gives_color();
}

static void color_of_bayer(void)
{
    source = bench_frame.gray;
    source.format = IRIS_BAYER8_RGGB;
    peer_gives_color();
}

static void prepare_bgr(void)
{
    bgr = bench_frame.rgb;
    bgr.format = IRIS_BGR888;
    peer_gives_mask();
}

static void prepare_hsl(void)
{
    prepare_bgr();
    hsl = bench_canvas(IRIS_HSL24);
    peer_result = hsl;
}

static void prepare_back(void)
{
    prepare_hsl();
    (void)iris_color_convert(&hsl, &bgr);
    peer_gives_color();
    peer_result.format = IRIS_BGR888;
}

static iris_status gray(void)
{
    return iris_color_gray(&bench_frame.gray_to, &source, IRIS_GRAY_LUMA);
}

static iris_status color(void)
{
    return iris_color_convert(&bench_frame.rgb_to, &source);
}

static iris_status nv12(void)
{
    return iris_nv12_convert(&bench_frame.rgb_to, &bench_frame.gray, &source);
}

static iris_status bayer(void)
{
    return iris_bayer_convert(&bench_frame.rgb_to, &source);
}

static iris_status color_of_gray(void)
{
    return iris_color_convert(&bench_frame.rgb_to, &bench_frame.gray);
}

static iris_status to_hsl(void)
{
    return iris_color_convert(&hsl, &bgr);
}

static iris_status from_hsl(void)
{
    iris_image to = bench_frame.rgb_to;
    to.format = IRIS_BGR888;
    return iris_color_convert(&to, &hsl);
}

/* Browns: hue 12 to 40 degrees. */
static iris_status range(void)
{
    const iris_hsl_range browns = {12, 40, 20, 90, 15, 80};
    return iris_hsl_range_mask(&bench_frame.mask_to, &bgr, &browns);
}

static iris_status channel(void)
{
    return iris_channel_extract(&bench_frame.gray_to, &bench_frame.rgb, 1);
}

/* A red tape, followed from the first frame on. */
static iris_follow follow;
static iris_follow_result line;

static void prepare_follow(void)
{
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_COLOR;
    config.format = IRIS_BGR888;
    config.color = (iris_hsl_range){330, 20, 32, 100, 10, 90};
    (void)iris_follow_init_full(&follow, (iris_size){bench_frame.rgb.w, bench_frame.rgb.h}, &config,
                                &bench_frame.scratch);
    prepare_bgr();
    peer_gives_numbers(4, 1);
}

static iris_status follow_line(void)
{
    return iris_follow_frame(&line, &follow, &bgr, 0);
}

/* Found or not; the middle of the line in the middle row, doubled; the angle. */
static void report_line(void)
{
    int32_t y = bench_frame.rgb.h / 2;
    peer_number(0, 0, line.state == IRIS_LINE_FOUND && line.rows);
    peer_number(1, 0, line.rows ? line.rows[y].left + line.rows[y].right : 0);
    peer_number(2, 0, line.angle);
}

const peer_case peer_color[] = {
    {"BGR to gray", gray, gray_of_bgr, NULL},
    {"BGR to HSL", to_hsl, prepare_hsl, NULL},
    {"HSL to BGR", from_hsl, prepare_back, NULL},
    {"BGR to RGB", color, color_of_bgr, NULL},
    {"gray to RGB", color_of_gray, peer_gives_color, NULL},
    {"YUYV to gray", gray, gray_of_yuyv, NULL},
    {"YUYV to RGB", color, color_of_yuyv, NULL},
    {"NV12 to RGB", nv12, color_of_nv12, NULL},
    {"Bayer to RGB", bayer, color_of_bayer, NULL},
    {"one channel of BGR", channel, peer_gives_gray, NULL},
    {"BGR to mask by a range of HSL", range, prepare_bgr, NULL},
    {"line follow by color", follow_line, prepare_follow, report_line},
    {NULL, NULL, NULL, NULL},
};
