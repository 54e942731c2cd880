/* What tests do with the kernel's virtual camera, and count before and after. */
#ifndef VIVID_H
#define VIVID_H

#include "iris/camera_control.h"
#include "iris/v4l2.h"
#include "linux/video_camera.h"

static int files_before, maps_before;

static inline const char *webcam(void)
{
    const char *path = getenv("RIG_WEBCAM");
    return path && *path ? path : NULL;
}

/* Sets a control of the camera, which is not open afterwards. */
static inline void vivid_set(const char *path, const char *name, int64_t value)
{
    iris_camera_controls controls;
    iris_status status = iris_camera_controls_open(&controls, path);
    if (status == IRIS_OK) {
        status = iris_camera_control_set(&controls, name, value);
    }
    if (status != IRIS_OK) {
        fail_msg("%s: %s", name, iris_camera_controls_problem(&controls));
    }
    iris_camera_controls_close(&controls);
}

/* The value of a menu's choice. */
static inline int64_t vivid_choice(const char *path, const char *name, const char *wanted)
{
    iris_camera_controls controls;
    iris_camera_choice choices[32];
    int32_t count;
    assert_int_equal(iris_camera_controls_open(&controls, path), IRIS_OK);
    assert_int_equal(iris_camera_control_choices(choices, &count, &controls, name, 32), IRIS_OK);
    iris_camera_controls_close(&controls);
    for (int32_t i = 0; i < count; i++) {
        if (strcmp(choices[i].name, wanted) == 0) {
            return choices[i].value;
        }
    }
    fail_msg("%s has no %s", name, wanted);
    return -1;
}

static inline int vivid_setup(void **state)
{
    (void)state;
    files_before = open_files();
    maps_before = mappings("/dev/video");
    return 0;
}

static inline int vivid_teardown(void **state)
{
    (void)state;
    assert_int_equal(open_files(), files_before);
    assert_int_equal(mappings("/dev/video"), maps_before);
    return 0;
}

/* A small picture, often: what does not cost the virtual machine much. */
static const iris_capture_config vivid_wanted = {
    .size = {320, 180}, .format = IRIS_YUYV, .rate_millihz = 60000, .reconnect_ms = 20};

/* Takes `frames` frames within the time. *took: how many came. The last status. */
static inline iris_status vivid_take(int *took, iris_capture *camera, int frames, int32_t timeout_ms)
{
    iris_status status = IRIS_OK;
    int64_t end_ms = now_ms() + timeout_ms;
    *took = 0;
    while (*took < frames && now_ms() < end_ms) {
        iris_frame frame;
        int64_t start_ms = now_ms();
        status = iris_capture_next(&frame, camera, 100);
        assert_in_range(now_ms() - start_ms, 0, 3000);
        if (status == IRIS_OK) {
            ++*took;
            assert_int_equal(iris_image_check(&frame.image), IRIS_OK);
            (void)iris_capture_give(camera, &frame);
        }
    }
    return status;
}

#endif
