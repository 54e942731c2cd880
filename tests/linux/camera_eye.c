/* A camera as a device of a robot: a source that is played here, and somebody who looks. */
#include "iris/camera_eye.h"

#include "fake_source.h"
#include "iris/osiris/robot.h"
#include "iris/osiris/robot_text.h"

static osiris_plan plan;
static osiris_device devices[OSIRIS_DEVICES_MAX];
static osiris_reading readings[OSIRIS_DEVICES_MAX];
static osiris_robot robot;
static osiris_camera_eye eye;
static iris_status says;
static int looked;

static iris_status look(void *looker, int32_t values[OSIRIS_VALUES], const iris_frame *frame)
{
    assert_ptr_equal(looker, &says);
    assert_int_equal(frame->image.w, 8);
    looked++;
    values[0] = 400;
    values[1] = -300;
    values[2] = 0xFF8000;
    values[3] = 50;
    return says;
}

static const osiris_camera_parts parts = {{&driver, &fake}, look, &says};

static void begin(int missing, iris_status opens)
{
    static const char text[] =
        "robot r\ndriver eye camera somewhere\ndrive omni wheels 3 radius 90\ncamera front\nrange a\n";
    osiris_problem problem;
    memset(&fake, 0, sizeof fake);
    fake.grant.size = (iris_size){8, 4};
    fake.grant.format = IRIS_GRAY8;
    fake.grant.stride = 8;
    fake.grant.buffers = BUFFERS;
    fake.fail_at = NEVER;
    fake.missing = missing;
    says = IRIS_OK;
    looked = 0;
    assert_int_equal(osiris_robot_read_text(&plan, devices, OSIRIS_DEVICES_MAX, &problem, text, sizeof text),
                     IRIS_OK);
    plan.device_count = 2; /* the drive and the camera */
    assert_int_equal(osiris_robot_init(&robot, readings, &plan), IRIS_OK);
    assert_int_equal(osiris_camera_eye_init(&eye, &parts, &plan, 0), IRIS_OK);
    assert_int_equal(osiris_robot_bind(&robot, 0, &osiris_camera_eye_driver, &eye, 0), opens);
}

static void sees(void **state)
{
    (void)state;
    osiris_sight sight;
    begin(0, IRIS_OK);
    assert_int_equal(fake.wanted.policy, IRIS_CAPTURE_LATEST);
    assert_int_equal(osiris_robot_sense(&robot, 10), IRIS_OK);
    assert_int_equal(looked, 0);
    fake.waiting = 3;
    assert_int_equal(osiris_robot_sense(&robot, 20), IRIS_OK);
    assert_int_equal(looked, 1); /* at the newest */
    assert_int_equal(fake.waiting, 0);
    assert_int_equal(fake.borrowed, 0);
    assert_int_equal(osiris_robot_object(&sight, &robot), IRIS_OK);
    assert_int_equal(sight.distance_mm, 500);
    assert_int_equal(sight.y_mm, -300);
    assert_int_equal(osiris_robot_sense(&robot, 30), IRIS_OK);
    assert_int_equal(osiris_robot_object(&sight, &robot), IRIS_OK); /* still what it saw last */
    says = IRIS_ERR_END;
    fake.waiting = 1;
    assert_int_equal(osiris_robot_sense(&robot, 40), IRIS_OK);
    assert_int_equal(osiris_robot_object(&sight, &robot), IRIS_ERR_END);
    says = IRIS_ERR_FORMAT;
    fake.waiting = 1;
    assert_int_equal(osiris_robot_sense(&robot, 50), IRIS_ERR_IO);
    assert_int_equal(readings[1].validity, OSIRIS_BROKEN);
    assert_int_equal(fake.borrowed, 0);
    assert_int_equal(osiris_robot_drive(&robot, 100, 0, 60),
                     IRIS_ERR_UNSUPPORTED); /* a camera does not drive */
    osiris_robot_close(&robot, 70);
    assert_int_equal(fake.closes, 1);
}

static void comes_later(void **state)
{
    (void)state;
    begin(2, IRIS_ERR_IO);
    fake.waiting = 1;
    assert_int_equal(osiris_robot_sense(&robot, 500), IRIS_ERR_IO);
    assert_int_equal(fake.opens, 1);
    assert_int_equal(osiris_robot_sense(&robot, 1000), IRIS_ERR_IO);
    assert_int_equal(fake.opens, 2);
    assert_int_equal(osiris_robot_sense(&robot, 2000), IRIS_OK);
    assert_int_equal(readings[1].validity, OSIRIS_VALID);
    osiris_robot_close(&robot, 2010);
    osiris_robot_close(&robot, 2010);
}

static void refuses(void **state)
{
    (void)state;
    osiris_camera_parts bad = parts;
    begin(0, IRIS_OK);
    osiris_robot_close(&robot, 10);
    assert_int_equal(osiris_camera_eye_init(NULL, &parts, &plan, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_camera_eye_init(&eye, NULL, &plan, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_camera_eye_init(&eye, &parts, &plan, 1), IRIS_ERR_ARG);
    bad.look = NULL;
    assert_int_equal(osiris_camera_eye_init(&eye, &bad, &plan, 0), IRIS_ERR_ARG);
    plan.drivers[0].kind = OSIRIS_DRIVER_SERIAL;
    assert_int_equal(osiris_camera_eye_init(&eye, &parts, &plan, 0), IRIS_ERR_ARG);
    assert_ptr_equal(source.device, &fake);
    assert_true(now_ms() > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sees),
        cmocka_unit_test(comes_later),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
