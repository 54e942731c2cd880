/* Cameras of the kernel's virtual driver, in the virtual machine (tests/rig). */
#include "iris/v4l2.h"
#include "test.h"

static iris_v4l2 device;

static const char *camera_path(void)
{
    const char *path = getenv("RIG_WEBCAM");
    if (!path || !*path) {
        print_message("no camera of the virtual machine\n");
        skip();
    }
    return path;
}

static void frames_follow_each_other(void **state)
{
    (void)state;
    const char *path = camera_path();
    const iris_capture_config wanted = {.size = {640, 360}, .format = IRIS_YUYV, .rate_millihz = 30000};
    iris_capture camera;
    iris_frame frame;
    assert_int_equal(iris_capture_open(&camera, iris_v4l2_source(&device), path, &wanted), IRIS_OK);
    assert_int_equal(camera.granted.size.w, 640);
    assert_int_equal(camera.granted.size.h, 360);
    assert_int_equal(camera.granted.format, IRIS_YUYV);
    assert_int_equal(camera.granted.stride, 1280);
    assert_int_equal(camera.granted.rate_millihz, 30000);
    for (uint64_t i = 0; i < 5; i++) {
        assert_int_equal(iris_capture_next(&frame, &camera, 2000), IRIS_OK);
        assert_int_equal(frame.sequence, i + camera.dropped);
        assert_int_equal(iris_image_check(&frame.image), IRIS_OK);
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
    }
    iris_capture_close(&camera);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(frames_follow_each_other)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
