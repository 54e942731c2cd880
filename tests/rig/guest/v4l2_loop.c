/* Pictures pushed through the kernel's virtual driver and captured back, in every format: not a byte may differ. */
#include <errno.h>

#include "iris/v4l2.h"
#include "video_sender.h"

#include <sys/syscall.h>

enum { W = 640, H = 480, FRAMES = 5, SETTLE = 3 };

static iris_v4l2 device;
static uint32_t hidden; /* a format that the camera seems not to have */

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int ioctl(int handle, unsigned long request, ...)
{
    va_list arguments;
    va_start(arguments, request);
    void *argument = va_arg(arguments, void *);
    va_end(arguments);
    int result = (int)syscall(SYS_ioctl, handle, request, argument);
    struct v4l2_fmtdesc *offer = argument;
    if (result == 0 && request == VIDIOC_ENUM_FMT && offer->pixelformat == hidden) {
        offer->pixelformat = V4L2_PIX_FMT_YVU420;
    }
    return result;
}

static uint64_t noise(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    return *state ^= *state << 17;
}

/* A number for a row, from all its bytes: eight at a time, as every row here has. */
static uint64_t mix(uint64_t sum, const uint8_t *row, size_t bytes)
{
    assert_int_equal(bytes % 8, 0);
    for (size_t i = 0; i < bytes; i += 8) {
        uint64_t word;
        memcpy(&word, row + i, 8);
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 29;
    }
    return sum;
}

static uint64_t sum_of(const iris_image *image)
{
    uint64_t sum = 0xcbf29ce484222325u;
    for (int32_t y = 0; y < image->h; y++) {
        sum = mix(sum, iris_image_row(image, y), iris_format_row_bytes(image->format, image->w));
    }
    return sum;
}

/* The sender's pictures as views. */
static void views(iris_image *image, iris_image *chroma, const video_sender *sender, int index,
                  int32_t format)
{
    const int nv12 = format == IRIS_CAPTURE_NV12;
    size_t luma = (size_t)sender->stride[0] * H;
    assert_int_equal(iris_image_wrap(image, sender->memory[index][0], sender->bytes[index][0],
                                     (iris_size){W, H}, sender->stride[0],
                                     nv12 ? IRIS_GRAY8 : (iris_format)format),
                     IRIS_OK);
    if (!nv12) {
        return;
    }
    uint8_t *second = sender->planes == 2 ? sender->memory[index][1] : sender->memory[index][0] + luma;
    size_t bytes = sender->planes == 2 ? sender->bytes[index][1] : sender->bytes[index][0] - luma;
    assert_int_equal(iris_image_wrap(chroma, second, bytes, (iris_size){W / 2, H / 2},
                                     sender->stride[sender->planes - 1], IRIS_UV88),
                     IRIS_OK);
}

static void fill(uint64_t sums[SENDER_PICTURES][2], const video_sender *sender, int32_t format)
{
    uint64_t state = 7;
    for (int i = 0; i < SENDER_PICTURES; i++) {
        for (int k = 0; k < sender->planes; k++) {
            for (size_t b = 0; b + 8 <= sender->bytes[i][k]; b += 8) {
                uint64_t word = noise(&state);
                memcpy(sender->memory[i][k] + b, &word, 8);
            }
        }
        iris_image image, chroma;
        views(&image, &chroma, sender, i, format);
        sums[i][0] = sum_of(&image);
        sums[i][1] = format == IRIS_CAPTURE_NV12 ? sum_of(&chroma) : 0;
    }
}

/* Which of the pictures it is; -1: none. */
static int picture_of(const iris_frame *frame, uint64_t sums[SENDER_PICTURES][2], int32_t format)
{
    uint64_t sum = sum_of(&frame->image), chroma = format == IRIS_CAPTURE_NV12 ? sum_of(&frame->chroma) : 0;
    for (int i = 0; i < SENDER_PICTURES; i++) {
        if (sums[i][0] == sum && sums[i][1] == chroma) {
            return i;
        }
    }
    return -1;
}

static void open_camera(iris_capture *camera, const char *path, int32_t format, int32_t stride)
{
    const iris_capture_config wanted = {.size = {W, H}, .format = format, .stride = stride};
    int handle = open(path, O_RDWR | O_NONBLOCK);
    assert_true(handle >= 0);
    set_video_timings(handle, 0);
    set_video_control(handle, VIVID_TEXT, 2);
    set_video_control(handle, VIVID_LOOP, 1);
    close(handle);
    iris_status status = iris_capture_open(camera, iris_v4l2_source(&device), path, &wanted);
    if (status != IRIS_OK) {
        fail_msg("%s: %s", path, iris_capture_problem(camera));
    }
    assert_int_equal(camera->granted.size.w, W);
    assert_int_equal(camera->granted.size.h, H);
    assert_int_equal(camera->granted.format, format);
    if (stride) {
        assert_int_equal(camera->granted.stride, stride);
    }
}

/* Every frame after the first few is one of the pictures, and all of them come. */
static void passes(const char *in, const char *out, uint32_t fourcc, int32_t format, int32_t stride)
{
    uint64_t sums[SENDER_PICTURES][2];
    uint32_t seen = 0;
    video_sender sender;
    iris_capture camera;
    sender_open(&sender, out, fourcc, W, H);
    fill(sums, &sender, format);
    open_camera(&camera, in, format, stride);
    sender_start(&sender);
    for (int i = 0; i < SETTLE + FRAMES; i++) {
        iris_frame frame;
        iris_status status = iris_capture_next(&frame, &camera, 3000);
        if (status != IRIS_OK) {
            fail_msg("%.4s: %s", (const char *)&fourcc, iris_capture_problem(&camera));
        }
        int picture = i < SETTLE ? -1 : picture_of(&frame, sums, format);
        if (i >= SETTLE && picture < 0) {
            fail_msg("%.4s with stride %d: frame %d is none of the pictures", (const char *)&fourcc,
                     (int)camera.granted.stride, i);
        }
        seen |= picture >= 0 ? 1u << picture : 0;
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
        sender_go_on(&sender);
    }
    assert_true(seen & (seen - 1)); /* more than one */
    iris_capture_close(&camera);
    sender_close(&sender);
}

static const struct {
    uint32_t fourcc;
    int32_t format, padded;
} formats[] = {
    {V4L2_PIX_FMT_YUYV, IRIS_YUYV, 1408},           {V4L2_PIX_FMT_UYVY, IRIS_UYVY, 1408},
    {V4L2_PIX_FMT_NV12, IRIS_CAPTURE_NV12, 704},    {V4L2_PIX_FMT_RGB24, IRIS_RGB888, 2112},
    {V4L2_PIX_FMT_BGR24, IRIS_BGR888, 2112},        {V4L2_PIX_FMT_RGB565, IRIS_RGB565, 1408},
    {V4L2_PIX_FMT_RGB565X, IRIS_RGB565_SWAP, 1408}, {V4L2_PIX_FMT_SRGGB8, IRIS_BAYER8_RGGB, 704},
    {V4L2_PIX_FMT_SGRBG8, IRIS_BAYER8_GRBG, 704},   {V4L2_PIX_FMT_SGBRG8, IRIS_BAYER8_GBRG, 704},
    {V4L2_PIX_FMT_SBGGR8, IRIS_BAYER8_BGGR, 704},   {V4L2_PIX_FMT_GREY, IRIS_GRAY8, 704},
};

static void loop(const char *in, const char *out)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        passes(in, out, formats[i].fourcc, formats[i].format, 0);
        passes(in, out, formats[i].fourcc, formats[i].format, formats[i].padded);
    }
}

static void every_format_comes_back_byte_for_byte(void **state)
{
    (void)state;
    loop(getenv("RIG_LOOP_IN"), getenv("RIG_LOOP_OUT"));
}

static void so_it_does_by_the_interface_of_many_planes(void **state)
{
    (void)state;
    loop(getenv("RIG_PLANES_IN"), getenv("RIG_PLANES_OUT"));
}

static void so_do_pictures_in_two_pieces_of_memory(void **state)
{
    (void)state;
    hidden = V4L2_PIX_FMT_NV12; /* which is preferred */
    passes(getenv("RIG_PLANES_IN"), getenv("RIG_PLANES_OUT"), V4L2_PIX_FMT_NV12M, IRIS_CAPTURE_NV12, 0);
    assert_int_equal(device.planes, 2);
    passes(getenv("RIG_PLANES_IN"), getenv("RIG_PLANES_OUT"), V4L2_PIX_FMT_NV12M, IRIS_CAPTURE_NV12, 704);
    hidden = 0;
}

static void needs_the_virtual_machine(void **state)
{
    (void)state;
    print_message("no looped cameras of the virtual machine (make test-linux)\n");
    skip();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_comes_back_byte_for_byte),
        cmocka_unit_test(so_it_does_by_the_interface_of_many_planes),
        cmocka_unit_test(so_do_pictures_in_two_pieces_of_memory),
    };
    const struct CMUnitTest none[] = {cmocka_unit_test(needs_the_virtual_machine)};
    const char *in = getenv("RIG_LOOP_IN"), *planes = getenv("RIG_PLANES_IN");
    return in && *in && planes && *planes ? cmocka_run_group_tests(tests, NULL, NULL)
                                          : cmocka_run_group_tests(none, NULL, NULL);
}
