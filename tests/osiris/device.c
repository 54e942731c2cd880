/* Devices and their calibrations. */
#include "iris/osiris/device.h"

#include "test.h"

static void every_kind_is_good(void **state)
{
    (void)state;
    osiris_device device;
    for (int kind = OSIRIS_CAMERA; kind < OSIRIS_KINDS; kind++) {
        osiris_device_defaults(&device, (osiris_kind)kind);
        assert_int_equal(osiris_device_check(&device), IRIS_OK);
        assert_int_equal(osiris_kind_is_sensor((osiris_kind)kind), kind <= OSIRIS_BATTERY);
        assert_true(osiris_kind_name((osiris_kind)kind)[0] != 0);
    }
    osiris_device_defaults(NULL, OSIRIS_CAMERA);
    osiris_device_defaults(&device, OSIRIS_NOTHING);
    assert_int_equal(osiris_device_check(&device), IRIS_ERR_ARG);
    assert_int_equal(osiris_device_check(NULL), IRIS_ERR_ARG);
    assert_string_equal(osiris_kind_name(OSIRIS_BATTERY), "battery");
    assert_string_equal(osiris_kind_unit(OSIRIS_BATTERY), "mV");
    assert_string_equal(osiris_kind_name((osiris_kind)99), "nothing");
    assert_string_equal(osiris_kind_unit((osiris_kind)-1), "");
}

static void numbers_out_of_range(void **state)
{
    (void)state;
    osiris_device good, bad;
    osiris_device_defaults(&good, OSIRIS_RANGE);
    const struct {
        int32_t *number;
        int32_t low, high;
    } ranges[] = {{&bad.place.x_mm, -9999, 9999}, {&bad.place.y_mm, -9999, 9999},
                  {&bad.height_mm, -9999, 9999},  {&bad.width, 0, 65536},
                  {&bad.resolution, 1, 1 << 20},  {&bad.deviation, 0, 1 << 20},
                  {&bad.error_permil, 0, 1000},   {&bad.period_ms, 1, 60000},
                  {&bad.latency_ms, 0, 10000},    {&bad.least, -(1 << 20) + 1, 2000},
                  {&bad.most, 20, (1 << 20) - 1}, {&bad.channel, 0, 255}};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        const int32_t tries[] = {ranges[i].low, ranges[i].high, ranges[i].low - 1, ranges[i].high + 1};
        for (int k = 0; k < 4; k++) {
            bad = good;
            *ranges[i].number = tries[k];
            assert_int_equal(osiris_device_check(&bad), k < 2 ? IRIS_OK : IRIS_ERR_ARG);
        }
    }
    bad = good;
    memset(bad.name, 'x', sizeof bad.name);
    assert_int_equal(osiris_device_check(&bad), IRIS_ERR_ARG);
}

static void calibrations(void **state)
{
    (void)state;
    /* Volts of a sensor that sees less the farther it is. */
    const osiris_calibration falls = {4, {400, 1000, 2000, 3000}, {800, 300, 100, 50}}, none = {0, {0}, {0}};
    const struct {
        int32_t raw, value;
    } pairs[] = {{400, 800}, {700, 550}, {1000, 300}, {1500, 200}, {2900, 55}, {3000, 50}};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        assert_int_equal(osiris_calibration_value(&falls, pairs[i].raw), pairs[i].value);
        assert_int_equal(osiris_calibration_raw(&falls, pairs[i].value), pairs[i].raw);
    }
    assert_int_equal(osiris_calibration_value(&falls, 4000), 0);
    assert_int_equal(osiris_calibration_value(&falls, -200), 1300);
    assert_int_equal(osiris_calibration_raw(&falls, 5000), 400);
    assert_int_equal(osiris_calibration_raw(&falls, -5000), 3000);
    assert_int_equal(osiris_calibration_value(&none, -77), -77);
    assert_int_equal(osiris_calibration_raw(&none, -77), -77);
    const osiris_calibration wide = {2, {INT32_MIN, INT32_MAX}, {INT32_MAX, INT32_MIN}};
    assert_int_equal(osiris_calibration_value(&wide, INT32_MIN), INT32_MAX);
    assert_int_equal(osiris_calibration_value(&wide, INT32_MAX), INT32_MIN);
    const osiris_calibration steep = {2, {0, 1}, {INT32_MIN, INT32_MAX}};
    assert_int_equal(osiris_calibration_value(&steep, INT32_MAX), INT32_MAX);
    assert_int_equal(osiris_calibration_value(&steep, INT32_MIN), INT32_MIN);
    osiris_device device;
    osiris_device_defaults(&device, OSIRIS_RANGE);
    device.calibration = falls;
    assert_int_equal(osiris_device_check(&device), IRIS_OK);
    device.calibration.raw[2] = 1000;
    assert_int_equal(osiris_device_check(&device), IRIS_ERR_ARG);
    device.calibration.count = 1;
    assert_int_equal(osiris_device_check(&device), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_good),
        cmocka_unit_test(numbers_out_of_range),
        cmocka_unit_test(calibrations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
