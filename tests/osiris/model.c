/* From raw values to readings, by hand. */
#include "iris/osiris/model.h"

#include <math.h>

#include "test.h"

static osiris_device device;
static osiris_raw raw;
static osiris_reading reading;

static void is(osiris_kind kind, int32_t a, int32_t b, int32_t c, int32_t d)
{
    const osiris_raw made = {kind, OSIRIS_VALID, 1000, {a, b, c, d}};
    osiris_device_defaults(&device, kind);
    raw = made;
}

static osiris_validity reads(void)
{
    assert_int_equal(osiris_model_read(&reading, &device, &raw), IRIS_OK);
    assert_int_equal(reading.kind, device.kind);
    return reading.validity;
}

static void ranges(void **state)
{
    (void)state;
    is(OSIRIS_RANGE, 500, 0, 0, 0);
    device.latency_ms = 30;
    device.deviation = 6;
    device.error_permil = 20;
    device.resolution = 12;
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.values[0], 500);
    assert_int_equal(reading.time_ms, 970);
    assert_int_equal(reading.uncertainty[0],
                     (int)sqrt(16 * 16 + 144 / 12.0)); /* 6 and 2 % of 500; a step's */
    raw.values[0] = 5;
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.values[0], 20);
    raw.values[0] = 2001;
    assert_int_equal(reads(), OSIRIS_BEYOND);
    raw.validity = OSIRIS_BEYOND;
    raw.values[0] = 5;
    assert_int_equal(reads(), OSIRIS_BEYOND);
    const osiris_calibration volts = {2, {0, 1000}, {100, 1100}};
    device.calibration = volts;
    raw.validity = OSIRIS_VALID;
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.values[0], 105);
}

static void what_cannot_be(void **state)
{
    (void)state;
    is(OSIRIS_RANGE, 500, 0, 0, 0);
    raw.kind = OSIRIS_BUMP;
    assert_int_equal(reads(), OSIRIS_BROKEN);
    is(OSIRIS_RANGE, 500, 0, 0, 0);
    raw.validity = (osiris_validity)77;
    assert_int_equal(reads(), OSIRIS_BROKEN);
    raw.validity = OSIRIS_NEVER;
    assert_int_equal(reads(), OSIRIS_BROKEN);
    is(OSIRIS_ODOMETRY, 1, 2, 32768, 0);
    assert_int_equal(reads(), OSIRIS_BROKEN);
    is(OSIRIS_LINE, 1, 16385, 0, 0);
    assert_int_equal(reads(), OSIRIS_BROKEN);
    is(OSIRIS_CAMERA, 100, 2, 0x1000000, 5);
    assert_int_equal(reads(), OSIRIS_BROKEN);
    is(OSIRIS_CAMERA, 100, 2, 0xFFFFFF, -1);
    assert_int_equal(reads(), OSIRIS_BROKEN);
    is(OSIRIS_BUMP, 1, 0, 0, 0);
    raw.validity = OSIRIS_BEYOND;
    assert_int_equal(reads(), OSIRIS_BROKEN);
    is(OSIRIS_LIGHT, 1, 0, 0, 0);
    assert_int_equal(reads(), OSIRIS_BROKEN);
    device.period_ms = 0;
    assert_int_equal(osiris_model_read(&reading, &device, &raw), IRIS_ERR_ARG);
    assert_int_equal(osiris_model_read(NULL, &device, &raw), IRIS_ERR_ARG);
    assert_int_equal(osiris_model_read(&reading, NULL, &raw), IRIS_ERR_ARG);
    assert_int_equal(osiris_model_read(&reading, &device, NULL), IRIS_ERR_ARG);
}

static void other_kinds(void **state)
{
    (void)state;
    is(OSIRIS_BATTERY, 7400, 0, 0, 0);
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.values[1], 500);
    raw.values[0] = 9000;
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.values[1], 1000);
    raw.values[0] = -5;
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.values[1], 0);
    is(OSIRIS_BUMP, -3, 0, 0, 0);
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.values[0], 1);
    is(OSIRIS_HEADING, 40000, 0, 0, 0);
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.values[0], 40000 - 65536);
    is(OSIRIS_CAMERA, 300, -400, 0xFF8000, 30);
    device.error_permil = 20;
    assert_int_equal(reads(), OSIRIS_VALID);
    assert_int_equal(reading.uncertainty[1], 10);
    device.most = 499;
    assert_int_equal(reads(), OSIRIS_BEYOND);
    is(OSIRIS_LINE, -60, -16384, 0, 0);
    assert_int_equal(reads(), OSIRIS_VALID);
    raw.values[0] = 61;
    assert_int_equal(reads(), OSIRIS_BEYOND);
    for (int kind = OSIRIS_CAMERA; kind < OSIRIS_KINDS; kind++) { /* whatever comes */
        for (int i = 0; i < 8; i++) {
            is((osiris_kind)kind, i & 1 ? INT32_MIN : INT32_MAX, i & 2 ? INT32_MIN : INT32_MAX,
               i & 4 ? INT32_MIN : INT32_MAX, INT32_MIN);
            device.most = device.kind == OSIRIS_LIGHT ? 0 : OSIRIS_PLACE_MAX_MM - 1;
            (void)reads();
        }
    }
}

static void ages(void **state)
{
    (void)state;
    is(OSIRIS_RANGE, 500, 0, 0, 0);
    raw.time_ms = 4294967290u;
    assert_int_equal(reads(), OSIRIS_VALID);
    osiris_model_age(&reading, &device, 344); /* 350 ms later: three periods of 50 and 200 */
    assert_int_equal(reading.validity, OSIRIS_VALID);
    osiris_model_age(&reading, &device, 345);
    assert_int_equal(reading.validity, OSIRIS_STALE);
    reading.validity = OSIRIS_BROKEN;
    osiris_model_age(&reading, &device, 9000);
    assert_int_equal(reading.validity, OSIRIS_BROKEN);
    osiris_model_age(NULL, &device, 9000);
    osiris_model_age(&reading, NULL, 9000);
}

static void writes(void **state)
{
    (void)state;
    static const struct {
        osiris_kind kind;
        int32_t given, written;
    } pairs[] = {{OSIRIS_STEERING, 6000, 5461},
                 {OSIRIS_STEERING, -9000, -5461},
                 {OSIRIS_GRIPPER, 1001, 1000},
                 {OSIRIS_GRIPPER, -1, 0},
                 {OSIRIS_LIGHT, 0x1FF8000, 0xFF8000},
                 {OSIRIS_SOUND, 5, 20},
                 {OSIRIS_SOUND, 0, 0},
                 {OSIRIS_DRIVE, -7, -7}};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        const int32_t values[OSIRIS_VALUES] = {pairs[i].given, 2, 3, 4};
        osiris_device_defaults(&device, pairs[i].kind);
        assert_int_equal(osiris_model_write(&raw, &device, values, 55), IRIS_OK);
        assert_int_equal(raw.values[0], pairs[i].written);
        assert_int_equal(raw.values[3], 4);
        assert_int_equal(raw.time_ms, 55);
        assert_int_equal(raw.kind, pairs[i].kind);
    }
    const int32_t values[OSIRIS_VALUES] = {0, 0, 0, 0};
    const osiris_calibration servo = {2, {1000, 2000}, {-5461, 5461}}; /* microseconds */
    osiris_device_defaults(&device, OSIRIS_STEERING);
    device.calibration = servo;
    assert_int_equal(osiris_model_write(&raw, &device, values, 55), IRIS_OK);
    assert_int_equal(raw.values[0], 1500);
    osiris_device_defaults(&device, OSIRIS_RANGE);
    assert_int_equal(osiris_model_write(&raw, &device, values, 55), IRIS_ERR_ARG);
    assert_int_equal(osiris_model_write(NULL, &device, values, 55), IRIS_ERR_ARG);
    assert_int_equal(osiris_model_write(&raw, &device, NULL, 55), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges), cmocka_unit_test(what_cannot_be), cmocka_unit_test(other_kinds),
        cmocka_unit_test(ages),   cmocka_unit_test(writes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
