/* Lists and controls of a camera whose driver answers what no driver should. */
#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "iris/camera_control.h"
#include "iris/camera_list.h"
#include "video_camera.h"

enum { ENDLESS = 600 };

static int camera = -1, files_before;
static int stuck; /* the list of controls goes back */
static unsigned long failing;
static int error;
static int32_t last_set;

static const struct {
    uint32_t id;
    const char *name;
    enum v4l2_ctrl_type type;
} has[] = {
    {V4L2_CID_BRIGHTNESS, "Brightness", V4L2_CTRL_TYPE_INTEGER},
    {V4L2_CID_EXPOSURE, "Exposure", V4L2_CTRL_TYPE_INTEGER},
    {V4L2_CID_EXPOSURE_ABSOLUTE, "Exposure (Absolute)", V4L2_CTRL_TYPE_INTEGER},
    {V4L2_CID_PRIVATE_BASE, "LED1  Mode!", V4L2_CTRL_TYPE_INTEGER},
    {V4L2_CID_PRIVATE_BASE + 1, "led1 mode", V4L2_CTRL_TYPE_INTEGER},
    {V4L2_CID_PRIVATE_BASE + 2, "LED1 MODE", V4L2_CTRL_TYPE_INTEGER},
    {V4L2_CID_PRIVATE_BASE + 3, "\x01\xff!", V4L2_CTRL_TYPE_INTEGER},
    {V4L2_CID_PRIVATE_BASE + 4, "A name without an end, 32 bytes.", V4L2_CTRL_TYPE_INTEGER},
    {V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", V4L2_CTRL_TYPE_MENU},
    {V4L2_CID_PRIVATE_BASE + 5, "Lamp", V4L2_CTRL_TYPE_MENU},
    {V4L2_CID_PRIVATE_BASE + 6, "Integers", V4L2_CTRL_TYPE_INTEGER_MENU},
};
enum { HAS = sizeof has / sizeof has[0] };

/* What menus offer; of exposure's there is no choice 0. */
static const char *const exposures[] = {"", "Manual Mode", "Shutter Priority Mode", "Aperture Priority Mode"};
static const char *const lamps[] = {"Slow Glow", "Slow Blink", "On", "On Demand"};

static int refuse(int with)
{
    errno = with;
    return -1;
}

static int query(struct v4l2_query_ext_ctrl *control)
{
    uint32_t after = control->id & ~V4L2_CTRL_FLAG_NEXT_CTRL, best = 0;
    for (uint32_t i = 0; i < HAS; i++) {
        if (has[i].id > after && (best == 0 || has[i].id < has[best - 1].id)) {
            best = i + 1;
        }
    }
    if (best == 0) {
        if (!stuck) {
            return refuse(EINVAL);
        }
        best = 1;
    }
    control->id = has[best - 1].id;
    control->type = has[best - 1].type;
    memcpy(control->name, has[best - 1].name, strnlen(has[best - 1].name, sizeof control->name));
    control->minimum = -5;
    control->maximum = 5;
    control->step = stuck ? UINT64_MAX : 0;
    return 0;
}

static int query_menu(struct v4l2_querymenu *item)
{
    static const int64_t integers[] = {1, 2, 3, 42};
    if (item->index > 3 || (item->id == V4L2_CID_EXPOSURE_AUTO && item->index == 0)) {
        return refuse(EINVAL);
    }
    if (item->id == V4L2_CID_PRIVATE_BASE + 6) {
        item->value = integers[item->index];
    } else {
        strcpy((char *)item->name, (item->id == V4L2_CID_EXPOSURE_AUTO ? exposures : lamps)[item->index]);
    }
    return 0;
}

static int answer(unsigned long request, void *argument)
{
    struct v4l2_capability *capability = argument;
    switch (request) {
    case VIDIOC_QUERYCAP:
        memset(capability->card, 0xc3, sizeof capability->card);
        memset(capability->driver, 'd', sizeof capability->driver);
        memset(capability->bus_info, ' ', sizeof capability->bus_info);
        capability->capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        return 0;
    case VIDIOC_ENUM_FMT:
        memset(((struct v4l2_fmtdesc *)argument)->description, 'x', 32);
        ((struct v4l2_fmtdesc *)argument)->pixelformat = 0xff0a4100u;
        return 0;
    case VIDIOC_ENUM_FRAMESIZES:
        ((struct v4l2_frmsizeenum *)argument)->type = V4L2_FRMSIZE_TYPE_DISCRETE;
        ((struct v4l2_frmsizeenum *)argument)->discrete.width = 0xffffffffu;
        return 0;
    case VIDIOC_ENUM_FRAMEINTERVALS:
        ((struct v4l2_frmivalenum *)argument)->type = V4L2_FRMIVAL_TYPE_DISCRETE;
        ((struct v4l2_frmivalenum *)argument)->discrete.denominator = 30;
        return 0;
    case VIDIOC_QUERY_EXT_CTRL:
        return query(argument);
    case VIDIOC_QUERYMENU:
        return query_menu(argument);
    case VIDIOC_G_EXT_CTRLS:
        ((struct v4l2_ext_controls *)argument)->controls->value = 3;
        return 0;
    case VIDIOC_S_EXT_CTRLS:
        last_set = ((struct v4l2_ext_controls *)argument)->controls->value;
        return 0;
    default:
        return refuse(ENOTTY);
    }
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int ioctl(int handle, unsigned long request, ...)
{
    va_list arguments;
    va_start(arguments, request);
    void *argument = va_arg(arguments, void *);
    va_end(arguments);
    if (handle != camera) {
        return (int)syscall(SYS_ioctl, handle, request, argument);
    }
    return request == failing ? refuse(error) : answer(request, argument);
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int open(const char *path, int flags, ...)
{
    if (strncmp(path, "/dev/video", 10) != 0) {
        return (int)syscall(SYS_openat, AT_FDCWD, path, flags, 0600);
    }
    if (strcmp(path, "/dev/video3") == 0) {
        return refuse(EACCES);
    }
    if (strcmp(path, "/dev/video7") != 0 && strcmp(path, "/dev/video255") != 0) {
        return refuse(ENOENT);
    }
    camera = (int)syscall(SYS_memfd_create, "fake-camera", 0);
    return camera;
}

static int fresh(void **state)
{
    (void)state;
    failing = 0;
    stuck = 0;
    files_before = open_files();
    return 0;
}

static int nothing_open(void **state)
{
    (void)state;
    assert_int_equal(open_files(), files_before);
    return 0;
}

static void a_camera_without_permission_is_listed(void **state)
{
    (void)state;
    iris_camera cameras[4];
    int32_t count;
    assert_int_equal(iris_camera_list(cameras, &count, 4), IRIS_OK);
    assert_int_equal(count, 3);
    assert_string_equal(cameras[0].path, "/dev/video3");
    assert_non_null(strstr(cameras[0].problem, "no permission"));
    assert_string_equal(cameras[0].card, "");
    assert_string_equal(cameras[1].path, "/dev/video7");
    assert_null(cameras[1].problem);
    assert_string_equal(cameras[1].card, "????????????????????????????????"); /* 32, and an end */
    assert_string_equal(cameras[1].driver, "dddddddddddddddd");
    assert_string_equal(cameras[1].bus, "");
    assert_string_equal(cameras[2].path, "/dev/video255");
}

static void lists_without_an_end_are_cut(void **state)
{
    (void)state;
    static iris_camera_format formats[ENDLESS];
    static iris_camera_sizes sizes[ENDLESS];
    static iris_camera_rates rates[ENDLESS];
    const char *path = "/dev/video7";
    int32_t count;
    assert_int_equal(iris_camera_list_formats(formats, &count, path, ENDLESS), IRIS_OK);
    assert_in_range(count, 256, ENDLESS - 1);
    assert_string_equal(formats[0].fourcc, "-BE"); /* a name that begins with a 0 */
    assert_int_equal(strlen(formats[0].description), 32);
    assert_int_equal(iris_camera_list_sizes(sizes, &count, path, "YUYV", ENDLESS), IRIS_OK);
    assert_in_range(count, 256, ENDLESS - 1);
    assert_int_equal(sizes[0].least.w, INT32_MAX);
    assert_int_equal(iris_camera_list_rates(rates, &count, path, "YUYV", (iris_size){-1, 0}, ENDLESS),
                     IRIS_OK);
    assert_in_range(count, 256, ENDLESS - 1);
    assert_int_equal(rates[0].most_millihz, 0);
    failing = VIDIOC_ENUM_FMT;
    error = EIO;
    assert_int_equal(iris_camera_list_formats(formats, &count, path, ENDLESS), IRIS_ERR_IO);
    assert_int_equal(count, 0);
}

static void every_control_has_a_name_of_its_own(void **state)
{
    (void)state;
    static const char *const names[HAS] = {"brightness",
                                           "exposure",
                                           "led1-mode",
                                           "led1-mode-2",
                                           "led1-mode-3",
                                           "unnamed",
                                           "a-name-without-an-end-32-bytes",
                                           "exposure-2",
                                           "exposure-auto",
                                           "lamp",
                                           "integers"};
    iris_camera_controls controls;
    iris_camera_control list[HAS + 1], one;
    int32_t count;
    assert_int_equal(iris_camera_controls_open(&controls, "/dev/video7"), IRIS_OK);
    for (stuck = 0; stuck < 2; stuck++) {
        assert_int_equal(iris_camera_controls_list(list, &count, &controls, HAS + 1), IRIS_OK);
        assert_int_equal(count, HAS);
        for (int i = 0; i < HAS; i++) {
            int32_t seen = 0;
            for (int k = 0; k < HAS; k++) {
                seen += strcmp(list[k].name, names[i]) == 0;
                if (strcmp(list[k].name, names[i]) == 0) {
                    assert_int_equal(iris_camera_control_get(&one, &controls, names[i]), IRIS_OK);
                    assert_int_equal(one.id, list[k].id);
                    assert_int_equal(one.step, 1);
                    assert_int_equal(one.value, 3);
                }
            }
            assert_int_equal(seen, 1);
        }
        assert_int_equal(iris_camera_control_get(&one, &controls, "led1-mode-4"), IRIS_ERR_UNSUPPORTED);
        assert_int_equal(iris_camera_control_get(&one, &controls, "led1-mode-0"), IRIS_ERR_UNSUPPORTED);
        assert_int_equal(iris_camera_control_get(&one, &controls, "exposure-3"), IRIS_ERR_UNSUPPORTED);
    }
    iris_camera_controls_close(&controls);
}

static void what_the_driver_says_to_a_value_is_told(void **state)
{
    (void)state;
    static const struct {
        int error;
        iris_status status;
        const char *part;
    } answers[] = {{ERANGE, IRIS_ERR_RANGE, "exposure takes -5 to 5"},
                   {EBUSY, IRIS_ERR_IO, "while frames flow"},
                   {EACCES, IRIS_ERR_IO, "cannot be set"},
                   {ENODEV, IRIS_ERR_IO, "gone"},
                   {EINTR, IRIS_ERR_IO, "signals"}};
    iris_camera_controls controls;
    iris_camera_control one;
    assert_int_equal(iris_camera_controls_open(&controls, "/dev/video7"), IRIS_OK);
    assert_int_equal(iris_camera_control_set(&controls, "exposure", -5), IRIS_OK);
    assert_int_equal(last_set, -5);
    failing = VIDIOC_S_EXT_CTRLS;
    for (size_t i = 0; i < sizeof answers / sizeof answers[0]; i++) {
        error = answers[i].error;
        assert_int_equal(iris_camera_control_set(&controls, "exposure", 5), answers[i].status);
        assert_non_null(strstr(iris_camera_controls_problem(&controls), answers[i].part));
    }
    failing = VIDIOC_G_EXT_CTRLS; /* one that cannot be read is there all the same */
    error = EIO;
    assert_int_equal(iris_camera_control_get(&one, &controls, "exposure"), IRIS_OK);
    assert_int_equal(one.value, 0);
    failing = VIDIOC_QUERY_EXT_CTRL;
    assert_int_equal(iris_camera_control_get(&one, &controls, "exposure"), IRIS_ERR_IO);
    iris_camera_controls_close(&controls);
}

static void a_choice_is_taken_by_its_first_words(void **state)
{
    (void)state;
    static const struct {
        const char *menu, *word;
        iris_status status;
        int32_t value;
    } calls[] = {{"exposure-auto", "manual", IRIS_OK, 1},
                 {"exposure-auto", "manual-mode", IRIS_OK, 1},
                 {"exposure-auto", "aperture-priority", IRIS_OK, 3},
                 {"exposure-auto", "man", IRIS_ERR_RANGE, 0},
                 {"exposure-auto", "manual-mode-2", IRIS_ERR_RANGE, 0},
                 {"exposure-auto", "mode", IRIS_ERR_RANGE, 0},
                 {"exposure-auto", "", IRIS_ERR_RANGE, 0},
                 {"lamp", "slow", IRIS_ERR_RANGE, 0}, /* two begin so */
                 {"lamp", "slow-glow", IRIS_OK, 0},
                 {"lamp", "on", IRIS_OK, 2}, /* its whole name */
                 {"integers", "2", IRIS_OK, 1},
                 {"integers", "42", IRIS_OK, 3},
                 {"integers", "4", IRIS_ERR_RANGE, 0},
                 {"integers", "0", IRIS_ERR_RANGE, 0},
                 {"exposure", "manual", IRIS_ERR_RANGE, 0},
                 {"warp", "manual", IRIS_ERR_UNSUPPORTED, 0}};
    iris_camera_controls controls;
    assert_int_equal(iris_camera_controls_open(&controls, "/dev/video7"), IRIS_OK);
    for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++) {
        last_set = -1;
        assert_int_equal(iris_camera_control_choose(&controls, calls[i].menu, calls[i].word),
                         calls[i].status);
        assert_int_equal(last_set, calls[i].status == IRIS_OK ? calls[i].value : -1);
    }
    assert_int_equal(iris_camera_control_choose(&controls, "exposure-auto", "off"), IRIS_ERR_RANGE);
    assert_string_equal(iris_camera_controls_problem(&controls),
                        "no single choice is called that; there are manual-mode shutter-priority-mode "
                        "aperture-priority-mode");
    assert_int_equal(iris_camera_control_choose(&controls, NULL, "off"), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_choose(&controls, "lamp", NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_choose(NULL, "lamp", "on"), IRIS_ERR_ARG);
    failing = VIDIOC_QUERYMENU;
    error = EIO;
    assert_int_equal(iris_camera_control_choose(&controls, "lamp", "on"), IRIS_ERR_IO);
    iris_camera_controls_close(&controls);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, fresh, nothing_open)
    const struct CMUnitTest tests[] = {
        CASE(a_camera_without_permission_is_listed), CASE(lists_without_an_end_are_cut),
        CASE(every_control_has_a_name_of_its_own),   CASE(what_the_driver_says_to_a_value_is_told),
        CASE(a_choice_is_taken_by_its_first_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
