/* A camera whose driver answers what no driver should. */
#include "fake_video.h"
#include "iris/v4l2.h"
#include "video_camera.h"

static iris_v4l2 device;
static iris_capture camera;
static int before_files, before_maps;

static int fresh(void **state)
{
    (void)state;
    memset(&fake, 0, sizeof fake);
    fake.handle = -1;
    fake.capabilities = V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_OUTPUT;
    fake.device_capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    fake.offers[0] = V4L2_PIX_FMT_MJPEG;
    fake.offers[1] = V4L2_PIX_FMT_YUYV;
    fake.pix = (struct v4l2_pix_format){
        .width = W, .height = H, .pixelformat = V4L2_PIX_FMT_YUYV, .bytesperline = ROW};
    fake.rate.capability = V4L2_CAP_TIMEPERFRAME;
    fake.rate.timeperframe = (struct v4l2_fract){1001, 30000};
    fake.grants = 4;
    fake.length = PAGE;
    fake.pieces = 1;
    fake.planes = 1;
    fake.ready = NEVER;
    fake.answer.bytesused = PICTURE;
    before_files = open_files();
    before_maps = mappings("fake-camera");
    return 0;
}

/* Whatever a test did, nothing is left open or mapped. */
static int nothing_left(void **state)
{
    (void)state;
    iris_capture_close(&camera);
    assert_int_equal(open_files(), before_files);
    assert_int_equal(mappings("fake-camera"), before_maps);
    return 0;
}

static void several_planes(uint32_t fourcc, int planes)
{
    fake.device_capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
    fake.multi = 1;
    fake.planes = planes;
    fake.pieces = (uint32_t)planes;
    fake.offers[0] = fourcc;
    fake.offers[1] = 0;
    fake.pix.pixelformat = fourcc;
    fake.strides[0] = fake.strides[1] = W;
    fake.planes_answer[0].bytesused = fake.planes_answer[1].bytesused = PAGE;
}

static iris_status open_with(const iris_capture_config *wanted)
{
    return iris_capture_open(&camera, iris_v4l2_source(&device), "camera", wanted);
}

static void opens(void)
{
    iris_status status = open_with(NULL);
    if (status != IRIS_OK) {
        fail_msg("%s", iris_capture_problem(&camera));
    }
}

static void says(const char *part)
{
    if (!strstr(iris_capture_problem(&camera), part)) {
        fail_msg("\"%s\" does not say \"%s\"", iris_capture_problem(&camera), part);
    }
}

static void refused(iris_status expected, const char *part)
{
    iris_status status = open_with(NULL);
    if (status != expected) {
        fail_msg("%s: status %d, and wanted was %d: %s", part, (int)status, (int)expected,
                 iris_capture_problem(&camera));
    }
    says(part);
    assert_int_equal(fake.queued, 0);
    assert_int_equal(open_files(), before_files);
}

static void one_frame(iris_frame *frame)
{
    assert_int_equal(iris_capture_next(frame, &camera, 500), IRIS_OK);
    const iris_v4l2_memory *memory = device.memory[frame->buffer];
    const uint8_t *first = frame->image.data;
    assert_true(first >= (const uint8_t *)memory[0].start);
    assert_true(first + (ptrdiff_t)frame->image.stride * (frame->image.h - 1) +
                    (ptrdiff_t)iris_format_row_bytes(frame->image.format, frame->image.w) <=
                (const uint8_t *)memory[0].start + memory[0].bytes);
}

static void a_camera_without_a_readable_format_is_refused_by_name(void **state)
{
    (void)state;
    fake.offers[1] = V4L2_PIX_FMT_H264;
    refused(IRIS_ERR_FORMAT,
            "offers MJPG H264; IRIS reads YUYV UYVY NV12 NM12 RGB3 BGR3 RGBP RGBR RGGB GRBG GBRG BA81 GREY");
    fake.offers[0] = 0;
    refused(IRIS_ERR_FORMAT, "no format at all");
    fake.offers[0] = V4L2_PIX_FMT_MJPEG;
    fake.endless = 1;
    fake.offers[2] = fake.offers[3] = V4L2_PIX_FMT_Y16_BE;
    fake.offers[1] = 0xffff2020u; /* not even letters */
    refused(IRIS_ERR_FORMAT, "and more; IRIS reads YUYV");
    fresh(NULL);
    assert_int_equal(open_with(&(iris_capture_config){.format = IRIS_RGB888}), IRIS_ERR_FORMAT);
    says("offers MJPG YUYV; wanted is RGB3");
    assert_int_equal(open_with(&(iris_capture_config){.format = IRIS_CAPTURE_NV12}), IRIS_ERR_FORMAT);
    says("wanted is NV12 NM12");
    assert_int_equal(open_with(&(iris_capture_config){.format = IRIS_RGBA8888}), IRIS_ERR_FORMAT);
    says("no camera of the kernel gives the one that is wanted");
    assert_int_equal(open_with(&(iris_capture_config){.format = IRIS_HSL48}), IRIS_ERR_FORMAT);
    fake.pix.pixelformat = V4L2_PIX_FMT_MJPEG; /* the driver takes another than it said */
    refused(IRIS_ERR_FORMAT, "offers MJPG YUYV");
    fake.offers[0] = V4L2_PIX_FMT_NV12M; /* in two pieces by an interface for one */
    fake.offers[1] = 0;
    refused(IRIS_ERR_FORMAT, "offers NM12");
}

static void the_preferred_format_is_asked_for(void **state)
{
    (void)state;
    static const uint32_t order[] = {V4L2_PIX_FMT_YUYV,    V4L2_PIX_FMT_UYVY,   V4L2_PIX_FMT_NV12,
                                     V4L2_PIX_FMT_RGB24,   V4L2_PIX_FMT_BGR24,  V4L2_PIX_FMT_RGB565,
                                     V4L2_PIX_FMT_RGB565X, V4L2_PIX_FMT_SRGGB8, V4L2_PIX_FMT_SGRBG8,
                                     V4L2_PIX_FMT_SGBRG8,  V4L2_PIX_FMT_SBGGR8, V4L2_PIX_FMT_GREY};
    for (size_t i = 0; i + 1 < sizeof order / sizeof order[0]; i++) {
        for (int turned = 0; turned < 2; turned++) {
            fake.offers[turned] = order[i];
            fake.offers[!turned] = order[i + 1];
            fake.pix.pixelformat = order[i];
            fake.pix.bytesperline = 0; /* rows without padding */
            opens();
            assert_int_equal(fake.asked.fmt.pix.pixelformat, order[i]);
            assert_int_equal(camera.granted.stride,
                             order[i] == V4L2_PIX_FMT_NV12
                                 ? W
                                 : (int)iris_format_row_bytes((iris_format)camera.granted.format, W));
            iris_capture_close(&camera);
        }
    }
}

static void wishes_reach_the_driver_and_answers_the_program(void **state)
{
    (void)state;
    fake.rate.timeperframe = (struct v4l2_fract){1, 25};
    fake.pix.bytesperline = 160;
    assert_int_equal(
        open_with(&(iris_capture_config){
            .size = {320, 240}, .format = IRIS_YUYV, .rate_millihz = 29970, .stride = 700, .buffers = 3}),
        IRIS_OK);
    assert_int_equal(fake.asked.fmt.pix.width, 320);
    assert_int_equal(fake.asked.fmt.pix.height, 240);
    assert_int_equal(fake.asked.fmt.pix.bytesperline, 700);
    assert_int_equal(fake.asked.fmt.pix.field, V4L2_FIELD_NONE);
    assert_int_equal(fake.asked_rate.parm.capture.timeperframe.numerator, 1000);
    assert_int_equal(fake.asked_rate.parm.capture.timeperframe.denominator, 29970);
    assert_int_equal(camera.granted.size.w, W); /* what came nearest */
    assert_int_equal(camera.granted.size.h, H);
    assert_int_equal(camera.granted.stride, 160);
    assert_int_equal(camera.granted.rate_millihz, 25000);
    assert_int_equal(camera.granted.buffers, 4);
    iris_capture_close(&camera);
    fake.pix.width = 48; /* the source as it is set */
    opens();
    assert_int_equal(fake.asked.fmt.pix.width, 48);
    assert_int_equal(camera.granted.size.w, 48);
}

static void rates_may_be_nonsense(void **state)
{
    (void)state;
    static const struct {
        struct v4l2_fract interval;
        int32_t rate;
    } rates[] = {{{1001, 30000}, 29970},       {{0, 30}, 0},        {{0, 0}, 0}, {{1, 0}, 0},
                 {{1, 0xffffffff}, INT32_MAX}, {{0xffffffff, 1}, 0}};
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        fake.rate.timeperframe = rates[i].interval;
        opens();
        assert_int_equal(camera.granted.rate_millihz, rates[i].rate);
        iris_capture_close(&camera);
    }
    fake.failing = VIDIOC_G_PARM; /* knows of no rates */
    fake.error = ENOTTY;
    fake.times = NEVER;
    opens();
    assert_int_equal(camera.granted.rate_millihz, 0);
}

static void pictures_that_cannot_be_are_refused(void **state)
{
    (void)state;
    static const struct {
        uint32_t w, h, stride, field;
        const char *part;
    } pictures[] = {
        {0, H, ROW, 1, "size"},
        {W, 0, ROW, 1, "size"},
        {40000, H, 80000, 1, "size"},
        {W, 0xffffffff, ROW, 1, "size"},
        {63, H, 126, 1, "odd"},
        {W, H, ROW - 1, 1, "shorter"},
        {W, H, 0xffffffff, 1, "shorter"},
        {W, H, ROW, V4L2_FIELD_ALTERNATE, "interlaced"},
        {W, H, ROW, V4L2_FIELD_SEQ_TB, "interlaced"},
        {W, 33, ROW, 1, "too small"},
        {W, 32767, 0x7ffffff0, 1, "too small"},
    };
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++) {
        fake.pix.width = pictures[i].w;
        fake.pix.height = pictures[i].h;
        fake.pix.bytesperline = pictures[i].stride;
        fake.pix.field = pictures[i].field;
        refused(IRIS_ERR_RANGE, pictures[i].part);
    }
    fresh(NULL);
    fake.pix.bytesperline = ROW + 1; /* an odd stride is fine for bytes, and not for numbers of 16 bits */
    opens();
    iris_capture_close(&camera);
    fake.pix.pixelformat = fake.offers[1] = V4L2_PIX_FMT_RGB565;
    refused(IRIS_ERR_RANGE, "odd");
    fresh(NULL);
    several_planes(V4L2_PIX_FMT_NV12M, 1);
    refused(IRIS_ERR_RANGE, "parts");
    several_planes(V4L2_PIX_FMT_NV12M, 2);
    fake.pieces = 3;
    refused(IRIS_ERR_IO, "mapped");
    fake.pieces = 2;
    fake.strides[1] = W - 1;
    refused(IRIS_ERR_RANGE, "too small");
    fake.pix.height = 3; /* the colors of an odd side */
    fake.strides[1] = 0;
    opens();
}

static void buffers_may_be_few_or_many(void **state)
{
    (void)state;
    static const int32_t grants[][2] = {{2, 2}, {3, 3}, {8, 8}, {32, 8}};
    for (uint32_t count = 0; count < 2; count++) {
        fake.grants = count;
        refused(IRIS_ERR_RANGE, "two buffers");
    }
    for (int i = 0; i < 4; i++) {
        iris_frame frame;
        fake.grants = (uint32_t)grants[i][0];
        opens();
        assert_int_equal(camera.granted.buffers, grants[i][1]);
        for (int k = 0; k < grants[i][1] - 1; k++) {
            one_frame(&frame);
        }
        assert_int_equal(iris_capture_next(&frame, &camera, 5), IRIS_ERR_FULL);
        iris_capture_close(&camera);
    }
    fake.grants = 4;
    fake.length = PICTURE - 1;
    refused(IRIS_ERR_RANGE, "too small");
    fake.length = 0;
    refused(IRIS_ERR_IO, "mapped");
    fake.length = PAGE;
    fake.offset = 1; /* where nothing can be mapped */
    refused(IRIS_ERR_IO, "mapped");
}

static void short_and_damaged_frames_are_not_delivered(void **state)
{
    (void)state;
    static const struct {
        uint32_t used, flags;
        int good;
    } frames[] = {
        {PICTURE, 0, 1},     {PICTURE - 1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {PICTURE, V4L2_BUF_FLAG_ERROR, 0},
        {0xffffffffu, 0, 1}, {PAGE, 0, 1}};
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; i++) {
        iris_frame frame;
        opens();
        fake.answer.bytesused = frames[i].used;
        fake.answer.flags = frames[i].flags;
        fake.ready = 1;
        if (frames[i].good) {
            one_frame(&frame);
        } else {
            assert_int_equal(iris_capture_next(&frame, &camera, 0), IRIS_ERR_TIMEOUT);
            assert_int_equal(fake.queued, 0xf); /* the buffer is back at once */
            fake.answer.bytesused = PICTURE;
            fake.answer.flags = 0;
            fake.ready = 1;
            one_frame(&frame);
            assert_int_equal(frame.sequence, 1);
        }
        assert_int_equal(camera.damaged, !frames[i].good);
        iris_capture_close(&camera);
    }
}

static void pixels_may_begin_later(void **state)
{
    (void)state;
    static const struct {
        uint32_t offset, used;
        int good;
    } planes[] = {{0, W * H, 1},
                  {128, 128 + W * H, 1},
                  {128, W * H, 0},
                  {PAGE - W * H, PAGE, 1},
                  {PAGE - W * H + 1, PAGE, 0},
                  {PAGE, 2 * PAGE, 0},
                  {0xffffffffu, 0xffffffffu, 0}};
    several_planes(V4L2_PIX_FMT_NV12M, 2);
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++) {
        iris_frame frame;
        opens();
        assert_int_equal(camera.granted.format, IRIS_CAPTURE_NV12);
        fake.ready = 1;
        fake.planes_answer[0].data_offset = planes[i].offset;
        fake.planes_answer[0].bytesused = planes[i].used;
        fake.planes_answer[1].bytesused = PAGE;
        if (planes[i].good) {
            one_frame(&frame);
            assert_ptr_equal(frame.image.data,
                             (uint8_t *)device.memory[frame.buffer][0].start + planes[i].offset);
            assert_ptr_equal(frame.chroma.data, device.memory[frame.buffer][1].start);
            assert_int_equal(frame.chroma.w, W / 2);
            assert_int_equal(frame.chroma.h, H / 2);
        } else {
            assert_int_equal(iris_capture_next(&frame, &camera, 5), IRIS_ERR_TIMEOUT);
        }
        iris_capture_close(&camera);
    }
    opens(); /* the colors end early */
    fake.ready = 1;
    fake.planes_answer[0].data_offset = 0;
    fake.planes_answer[0].bytesused = PAGE;
    fake.planes_answer[1].bytesused = W * H / 2 - 1;
    iris_frame frame;
    assert_int_equal(iris_capture_next(&frame, &camera, 5), IRIS_ERR_TIMEOUT);
    assert_int_equal(camera.damaged, 1);
}

static void colors_behind_the_luma_have_to_be_there(void **state)
{
    (void)state;
    static const struct {
        uint32_t used;
        int good;
    } frames[] = {{W * H + W * H / 2, 1}, {W * H + W * H / 2 - 1, 0},
                  {W * H + 1, 0},         {W * H, 0},
                  {W * H - 1, 0},         {1, 0}};
    fake.offers[0] = fake.pix.pixelformat = V4L2_PIX_FMT_NV12;
    fake.offers[1] = 0;
    fake.pix.bytesperline = W;
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; i++) {
        iris_frame frame;
        opens();
        fake.ready = 1;
        fake.answer.bytesused = frames[i].used;
        if (frames[i].good) {
            one_frame(&frame);
            assert_ptr_equal(frame.chroma.data, (uint8_t *)frame.image.data + (size_t)W * H);
            assert_int_equal(frame.chroma.stride, W);
            assert_int_equal(iris_image_check(&frame.chroma), IRIS_OK);
        } else {
            assert_int_equal(iris_capture_next(&frame, &camera, 0), IRIS_ERR_TIMEOUT);
            assert_int_equal(camera.damaged, 1);
        }
        iris_capture_close(&camera);
    }
    static const uint32_t lengths[] = {W * H / 2, W * H, W * H + 1, W * H + W * H / 2 - 1};
    for (int i = 0; i < 4; i++) {
        fake.length = lengths[i];
        refused(IRIS_ERR_RANGE, "too small");
    }
}

static void a_buffer_that_the_driver_does_not_have_breaks_the_stream(void **state)
{
    (void)state;
    static const uint32_t indexes[] = {4, 7, 8, 31, 32, 0x80000000u, 0xffffffffu};
    iris_frame frame, held;
    for (size_t i = 0; i < sizeof indexes / sizeof indexes[0]; i++) {
        opens();
        fake.any_index = 1;
        fake.answer.index = indexes[i];
        assert_int_equal(iris_capture_next(&frame, &camera, 20), IRIS_ERR_IO);
        says("does not have");
        assert_false(iris_capture_is_running(&camera));
        iris_capture_close(&camera);
    }
    fake.any_index = 0;
    opens();
    one_frame(&held);
    fake.any_index = 1; /* one that the program still has */
    fake.answer.index = (uint32_t)held.buffer;
    assert_int_equal(iris_capture_next(&frame, &camera, 20), IRIS_ERR_IO);
    assert_int_equal(iris_image_check(&held.image), IRIS_OK);
    assert_int_equal(((uint8_t *)held.image.data)[PICTURE - 1], 0); /* still there */
    assert_int_equal(iris_capture_give(&camera, &held), IRIS_ERR_IO);
}

static void times_may_be_anything(void **state)
{
    (void)state;
    static const struct timeval times[] = {
        {0, 0}, {-1, -1}, {INT64_MAX, 999999}, {INT64_MIN, 0}, {1, INT64_MAX}};
    iris_frame frame;
    opens();
    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++) {
        fake.answer.timestamp = times[i];
        one_frame(&frame);
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
    }
    fake.answer.timestamp = (struct timeval){12, 345678};
    one_frame(&frame);
    assert_int_equal(frame.time_us, 12345678);
}

static void waiting_ends_in_time(void **state)
{
    (void)state;
    iris_frame frame;
    for (int i = 0; i < 3; i++) {
        opens();
        fake.ready = 0;
        fake.polls = fake.requests = 0;
        fake.always_ready = i == 1;
        fake.poll_error = i == 2 ? EINTR : 0;
        int64_t start_ms = now_ms();
        assert_int_equal(iris_capture_next(&frame, &camera, 60), IRIS_ERR_TIMEOUT);
        assert_in_range(now_ms() - start_ms, 59, 3000);
        assert_true(fake.requests < 100 || i == 2); /* it does not spin */
        fake.poll_error = 0;
        fake.ready = 1;
        one_frame(&frame);
        iris_capture_close(&camera);
    }
}

static void a_buffer_that_is_not_taken_is_offered_again(void **state)
{
    (void)state;
    static const int errors[] = {EINVAL, ENOMEM, EBUSY, EINTR};
    iris_frame frame;
    for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        opens();
        one_frame(&frame);
        fake.failing = VIDIOC_QBUF;
        fake.error = errors[i];
        fake.times = 20;
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
        assert_int_not_equal(fake.queued, 0xf);
        fake.times = 0;
        fake.ready = 0;
        assert_int_equal(iris_capture_next(&frame, &camera, 0), IRIS_ERR_TIMEOUT);
        assert_int_equal(fake.queued, 0xf);
        fake.ready = NEVER;
        fake.times = NEVER; /* none is taken any more */
        for (int turn = 0; turn < 20 && iris_capture_is_running(&camera); turn++) {
            if (iris_capture_next(&frame, &camera, 1) == IRIS_OK) {
                assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
            }
        }
        assert_false(iris_capture_is_running(&camera));
        says("takes no buffer");
        fake.times = 0;
        iris_capture_close(&camera);
    }
}

static void a_stream_that_breaks_is_started_again(void **state)
{
    (void)state;
    static const int errors[] = {EIO, EPIPE, EINVAL};
    iris_frame frame, held;
    for (int i = 0; i < 3; i++) {
        opens();
        one_frame(&held);
        fake.failing = VIDIOC_DQBUF;
        fake.error = errors[i];
        fake.times = 1;
        one_frame(&frame);
        assert_int_not_equal(frame.buffer, held.buffer);
        assert_int_equal(camera.restarts, 1);
        assert_int_equal(camera.returns, 0);
        assert_int_equal(iris_capture_give(&camera, &held), IRIS_OK);
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
        assert_int_equal(fake.queued, 0xf);
        iris_capture_close(&camera);
    }
}

static void requests_that_fail_are_said_in_words(void **state)
{
    (void)state;
    static const struct {
        unsigned long request;
        int error;
        iris_status status;
        const char *part;
    } failures[] = {
        {VIDIOC_QUERYCAP, ENOTTY, IRIS_ERR_UNSUPPORTED, "not a device that captures pictures"},
        {VIDIOC_QUERYCAP, EINVAL, IRIS_ERR_UNSUPPORTED, "not a device that captures pictures"},
        {VIDIOC_QUERYCAP, EIO, IRIS_ERR_IO, "failed"},
        {VIDIOC_QUERYCAP, EINTR, IRIS_ERR_IO, "signals"},
        {VIDIOC_ENUM_FMT, ENODEV, IRIS_ERR_IO, "gone"},
        {VIDIOC_G_FMT, EIO, IRIS_ERR_IO, "size and format"},
        {VIDIOC_S_FMT, EBUSY, IRIS_ERR_IO, "another program"},
        {VIDIOC_REQBUFS, EBUSY, IRIS_ERR_IO, "another program"},
        {VIDIOC_REQBUFS, ENOMEM, IRIS_ERR_IO, "fewer buffers"},
        {VIDIOC_QUERYBUF, EINVAL, IRIS_ERR_IO, "mapped"},
        {VIDIOC_QBUF, ENODEV, IRIS_ERR_IO, "takes no buffer: the camera is gone"},
        {VIDIOC_STREAMON, ENOSPC, IRIS_ERR_IO, "another USB port"},
        {VIDIOC_STREAMON, EPIPE, IRIS_ERR_IO, "not connected"},
    };
    for (size_t i = 0; i < sizeof failures / sizeof failures[0]; i++) {
        fake.failing = failures[i].request;
        fake.error = failures[i].error;
        fake.times = NEVER;
        fake.after = 0;
        refused(failures[i].status, failures[i].part);
        fake.times = failures[i].error == EINTR ? 3 : 0; /* a few signals do no harm */
        opens();
        iris_capture_close(&camera);
    }
}

static void what_is_no_camera_is_refused(void **state)
{
    (void)state;
    static const uint32_t abilities[] = {0, V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING,
                                         V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING,
                                         V4L2_CAP_VIDEO_M2M_MPLANE | V4L2_CAP_STREAMING};
    for (size_t i = 0; i < sizeof abilities / sizeof abilities[0]; i++) {
        fake.device_capabilities = abilities[i];
        refused(IRIS_ERR_UNSUPPORTED, "not a device that captures pictures");
    }
    fake.device_capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_READWRITE;
    refused(IRIS_ERR_UNSUPPORTED, "mapped memory");
    fake.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING; /* an old driver */
    opens();
    iris_capture_close(&camera);
    static const struct {
        const char *path;
        iris_status status;
        const char *part;
    } paths[] = {{"/dev/no-such-camera", IRIS_ERR_IO, "no such device"},
                 {"/dev/null", IRIS_ERR_UNSUPPORTED, "not a device"},
                 {"/", IRIS_ERR_UNSUPPORTED, "not a device"},
                 {"README.md/x", IRIS_ERR_IO, "no such device"}};
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        assert_int_equal(iris_capture_open(&camera, iris_v4l2_source(&device), paths[i].path, NULL),
                         paths[i].status);
        says(paths[i].part);
    }
    assert_int_equal(iris_capture_open(&camera, iris_v4l2_source(NULL), "camera", NULL), IRIS_ERR_ARG);
    assert_int_equal(open_with(&(iris_capture_config){.buffers = 1}), IRIS_ERR_ARG);
    says("not opened");
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, fresh, nothing_left)
    const struct CMUnitTest tests[] = {
        CASE(a_camera_without_a_readable_format_is_refused_by_name),
        CASE(the_preferred_format_is_asked_for),
        CASE(wishes_reach_the_driver_and_answers_the_program),
        CASE(rates_may_be_nonsense),
        CASE(pictures_that_cannot_be_are_refused),
        CASE(buffers_may_be_few_or_many),
        CASE(short_and_damaged_frames_are_not_delivered),
        CASE(pixels_may_begin_later),
        CASE(colors_behind_the_luma_have_to_be_there),
        CASE(a_buffer_that_the_driver_does_not_have_breaks_the_stream),
        CASE(times_may_be_anything),
        CASE(waiting_ends_in_time),
        CASE(a_buffer_that_is_not_taken_is_offered_again),
        CASE(a_stream_that_breaks_is_started_again),
        CASE(requests_that_fail_are_said_in_words),
        CASE(what_is_no_camera_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
