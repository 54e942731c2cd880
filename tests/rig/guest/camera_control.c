/* Lists and controls of cameras, with the kernel's virtual drivers. */
#include "iris/camera_control.h"
#include "iris/camera_list.h"
#include "vivid.h"

enum { CONTROLS = 200, FORMATS = 128 };

static iris_camera_controls controls;
static iris_camera_control list[CONTROLS];

static int open_controls(void **state)
{
    iris_camera_controls_close(&controls);
    vivid_setup(state);
    return iris_camera_controls_open(&controls, webcam()) != IRIS_OK;
}

static int close_controls(void **state)
{
    iris_camera_controls_close(&controls);
    iris_camera_controls_close(&controls);
    return vivid_teardown(state);
}

static iris_camera_control get(const char *name)
{
    iris_camera_control control;
    iris_status status = iris_camera_control_get(&control, &controls, name);
    if (status != IRIS_OK) {
        fail_msg("%s: %s", name, iris_camera_controls_problem(&controls));
    }
    assert_string_equal(control.name, name);
    return control;
}

static void set(const char *name, int64_t value)
{
    iris_status status = iris_camera_control_set(&controls, name, value);
    if (status != IRIS_OK) {
        fail_msg("%s: %s", name, iris_camera_controls_problem(&controls));
    }
}

static void refuses(iris_status expected, const char *name, int64_t value, const char *part)
{
    assert_int_equal(iris_camera_control_set(&controls, name, value), expected);
    if (!strstr(iris_camera_controls_problem(&controls), part)) {
        fail_msg("\"%s\" does not say \"%s\"", iris_camera_controls_problem(&controls), part);
    }
}

static void controls_are_listed(void **state)
{
    (void)state;
    int32_t count, again;
    assert_int_equal(iris_camera_controls_list(list, &count, &controls, CONTROLS), IRIS_OK);
    assert_in_range(count, 20, CONTROLS);
    assert_string_equal(list[0].name, "brightness");
    for (int32_t i = 0; i < count; i++) {
        const char *letters = "abcdefghijklmnopqrstuvwxyz0123456789-";
        assert_in_range(list[i].kind, IRIS_CONTROL_NUMBER, IRIS_CONTROL_BITS);
        assert_int_equal(strspn(list[i].name, letters), strlen(list[i].name));
        assert_true(list[i].name[0] && list[i].label[0] && list[i].step >= 1);
        if (list[i].kind != IRIS_CONTROL_BUTTON && list[i].kind != IRIS_CONTROL_BITS) {
            assert_true(list[i].minimum <= list[i].value && list[i].value <= list[i].maximum);
        }
        for (int32_t k = 0; k < i; k++) {
            assert_string_not_equal(list[i].name, list[k].name);
        }
        if (i % 8 == 0) {
            iris_camera_control one = get(list[i].name);
            assert_int_equal(one.id, list[i].id);
        }
    }
    list[5].name[0] = '#'; /* what there is no room for is not touched */
    assert_int_equal(iris_camera_controls_list(list, &again, &controls, 5), IRIS_ERR_FULL);
    assert_int_equal(again, count);
    assert_int_equal(list[5].name[0], '#');
    assert_int_equal(iris_camera_controls_list(NULL, &again, &controls, 0), IRIS_ERR_FULL);
    assert_int_equal(again, count);
}

static void what_is_set_reads_back(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int64_t values[2];
    } sets[] = {{"brightness", {0, 255}},
                {"contrast", {7, 128}},
                {"hue", {-128, 0}},
                {"flip-horizontal", {1, 0}},
                {"boolean", {0, 1}},
                {"menu", {4, 3}},
                {"integer-menu", {8, 4}},
                {"integer-32-bits", {INT32_MIN, 0}},
                {"integer-64-bits", {INT64_MIN, 1234567890123}},
                {"bitmask", {0x80402010, 0x80002000}},
                {"gain-auto", {0, 1}}};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        for (int k = 0; k < 2; k++) {
            set(sets[i].name, sets[i].values[k]);
            assert_true(get(sets[i].name).value == sets[i].values[k]);
        }
    }
    set("brightness", 77);
    iris_camera_controls_close(&controls); /* it stays */
    assert_int_equal(iris_camera_controls_open(&controls, webcam()), IRIS_OK);
    assert_int_equal(get("brightness").value, 77);
    set("brightness", 128);
    set("button", 12345);
}

static void an_automatic_control_rules_another(void **state)
{
    (void)state;
    set("gain-auto", 1);
    assert_true(get("gain").flags & IRIS_CONTROL_INACTIVE);
    set("gain-auto", 0);
    assert_false(get("gain").flags & IRIS_CONTROL_INACTIVE);
    set("gain", 42);
    assert_int_equal(get("gain").value, 42);
    set("gain-auto", 1);
}

static void what_cannot_be_set_is_said_in_words(void **state)
{
    (void)state;
    refuses(IRIS_ERR_RANGE, "brightness", 256, "brightness takes 0 to 255");
    refuses(IRIS_ERR_RANGE, "brightness", -1, "brightness takes 0 to 255");
    refuses(IRIS_ERR_RANGE, "hue", INT64_MIN, "hue takes -128 to 128");
    refuses(IRIS_ERR_RANGE, "integer-32-bits", 1LL << 32, "takes -2147483648 to 2147483647");
    refuses(IRIS_ERR_RANGE, "flip-vertical", 2, "takes 0 to 1");
    refuses(IRIS_ERR_RANGE, "menu", 2, "menu takes a choice from 1 to 4"); /* a hole */
    refuses(IRIS_ERR_RANGE, "menu", 0, "menu takes a choice from 1 to 4");
    refuses(IRIS_ERR_RANGE, "bitmask", 1, "takes the bits of 2151686160");
    refuses(IRIS_ERR_UNSUPPORTED, "read-only-integer-32-bits", 9, "only be read");
    static const char *const strangers[] = {
        "",      "focus", "brightness-2", "Brightness",
        "menu-", "-2",    "brightness-",  "a-name-that-is-longer-than-any-control-may-have-12",
        "99999"};
    for (size_t i = 0; i < sizeof strangers / sizeof strangers[0]; i++) {
        iris_camera_control control;
        refuses(IRIS_ERR_UNSUPPORTED, strangers[i], 1, "no such control");
        assert_int_equal(iris_camera_control_get(&control, &controls, strangers[i]), IRIS_ERR_UNSUPPORTED);
    }
    assert_int_equal(get("brightness").value, 128);
    assert_int_equal(get("menu").value, 3);
}

static void menus_have_choices(void **state)
{
    (void)state;
    iris_camera_choice choices[8];
    int32_t count;
    assert_int_equal(iris_camera_control_choices(choices, &count, &controls, "menu", 8), IRIS_OK);
    assert_int_equal(count, 3);
    assert_int_equal(choices[0].value, 1);
    assert_string_equal(choices[1].name, "menu-item-3");
    assert_int_equal(choices[1].value, 3);
    assert_int_equal(iris_camera_control_choices(choices, &count, &controls, "menu", 1), IRIS_ERR_FULL);
    assert_int_equal(count, 3);
    assert_int_equal(iris_camera_control_choices(choices, &count, &controls, "integer-menu", 8), IRIS_OK);
    assert_int_equal(count, 7); /* again a hole */
    assert_int_equal(choices[4].value, 6);
    assert_string_equal(choices[4].name, "13");
    assert_int_equal(iris_camera_control_choices(choices, &count, &controls, "brightness", 8), IRIS_OK);
    assert_int_equal(count, 0);
    assert_int_equal(iris_camera_control_choices(choices, &count, &controls, "focus", 8),
                     IRIS_ERR_UNSUPPORTED);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_camera_control control;
    iris_camera_choice choice;
    int32_t count;
    assert_int_equal(iris_camera_controls_open(NULL, webcam()), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_controls_list(list, NULL, &controls, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_controls_list(list, &count, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_controls_list(NULL, &count, &controls, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_controls_list(list, &count, &controls, -1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_get(NULL, &controls, "hue"), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_get(&control, &controls, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_set(NULL, "hue", 0), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_set(&controls, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_choices(&choice, NULL, &controls, "menu", 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_choices(NULL, &count, &controls, "menu", 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_choices(&choice, &count, &controls, NULL, 1), IRIS_ERR_ARG);
    iris_camera_controls_close(&controls);
    assert_int_equal(iris_camera_controls_list(list, &count, &controls, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_get(&control, &controls, "hue"), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_control_set(&controls, "hue", 0), IRIS_ERR_ARG);
    iris_camera_controls_close(NULL);
    assert_non_null(iris_camera_controls_problem(NULL));
    assert_int_equal(iris_camera_controls_open(&controls, "/dev/no-such-camera"), IRIS_ERR_IO);
    assert_string_equal(iris_camera_controls_problem(&controls), "no such device");
    assert_int_equal(iris_camera_controls_open(&controls, "/dev/null"), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(iris_camera_controls_open(&controls, getenv("RIG_LOOP_OUT")), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(controls.handle, -1);
}

static void a_camera_that_is_gone_is_said_to_be(void **state)
{
    (void)state;
    int32_t count;
    set("disconnect", 1);
    assert_int_equal(iris_camera_controls_list(list, &count, &controls, CONTROLS), IRIS_ERR_IO);
    assert_non_null(strstr(iris_camera_controls_problem(&controls), "gone"));
    refuses(IRIS_ERR_IO, "brightness", 1, "gone");
    iris_camera_controls_close(&controls);
    assert_int_equal(iris_camera_controls_open(&controls, webcam()), IRIS_OK);
    assert_int_equal(get("brightness").value, 128);
}

static void cameras_are_listed(void **state)
{
    (void)state;
    iris_camera cameras[8], first;
    int32_t count, again, found = -1;
    assert_int_equal(iris_camera_list(cameras, &count, 8), IRIS_OK);
    assert_in_range(count, 3, 8);
    for (int32_t i = 0; i < count; i++) {
        assert_null(cameras[i].problem);
        assert_string_not_equal(cameras[i].path, getenv("RIG_LOOP_OUT"));
        found = strcmp(cameras[i].path, webcam()) == 0 ? i : found;
    }
    assert_in_range(found, 0, count - 1);
    assert_string_equal(cameras[found].driver, "vivid");
    assert_string_equal(cameras[found].card, "vivid");
    assert_string_equal(cameras[found].bus, "platform:vivid-000");
    assert_int_equal(iris_camera_list(&first, &again, 1), IRIS_ERR_FULL);
    assert_int_equal(again, count);
    assert_string_equal(first.path, cameras[0].path);
    assert_int_equal(iris_camera_list(NULL, &count, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_list(&first, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_list(&first, &count, -1), IRIS_ERR_ARG);
}

static void formats_sizes_and_rates_are_listed(void **state)
{
    (void)state;
    static iris_camera_format formats[FORMATS];
    iris_camera_sizes sizes[16];
    iris_camera_rates rates[64];
    int32_t count, seen = 0;
    assert_int_equal(iris_camera_list_formats(formats, &count, webcam(), FORMATS), IRIS_OK);
    for (int32_t i = 0; i < count; i++) {
        seen += strcmp(formats[i].fourcc, "YUYV") == 0 && formats[i].format == IRIS_YUYV;
        seen += strcmp(formats[i].fourcc, "NV12") == 0 && formats[i].format == IRIS_CAPTURE_NV12;
        seen += strcmp(formats[i].fourcc, "Y16-BE") == 0 && formats[i].format == 0;
        seen +=
            strcmp(formats[i].fourcc, "GREY") == 0 && strcmp(formats[i].description, "8-bit Greyscale") == 0;
    }
    assert_int_equal(seen, 4);
    assert_int_equal(iris_camera_list_sizes(sizes, &count, webcam(), "YUYV", 16), IRIS_OK);
    assert_in_range(count, 3, 16);
    assert_int_equal(sizes[0].least.w, 320);
    assert_int_equal(sizes[0].most.h, 180);
    assert_int_equal(sizes[0].step.w, 0);
    assert_int_equal(iris_camera_list_rates(rates, &count, webcam(), "YUYV", sizes[0].least, 64), IRIS_OK);
    for (int32_t i = seen = 0; i < count; i++) {
        seen += rates[i].least_millihz == 30000 && rates[i].most_millihz == 30000;
    }
    assert_int_equal(seen, 1);
    assert_int_equal(iris_camera_list_sizes(sizes, &count, webcam(), "Y16-BE", 16), IRIS_OK);
    assert_int_equal(iris_camera_list_sizes(sizes, &count, webcam(), "ABCD", 16),
                     IRIS_OK); /* it has no such */
    assert_int_equal(count, 0);
    assert_int_equal(iris_camera_list_sizes(sizes, &count, webcam(), "", 16), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_list_sizes(sizes, &count, webcam(), "YUYVX", 16), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_list_sizes(sizes, &count, webcam(), "YUYV", 1), IRIS_ERR_FULL);
    assert_int_equal(iris_camera_list_formats(formats, &count, "/dev/no-such-camera", FORMATS), IRIS_ERR_IO);
    assert_int_equal(iris_camera_list_formats(formats, &count, "/dev/null", FORMATS), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(iris_camera_list_rates(rates, &count, webcam(), "YUYV", (iris_size){3, 3}, 64), IRIS_OK);
    assert_int_equal(count, 0);
}

/* vimc has every size between two. */
static void sizes_may_go_in_steps(void **state)
{
    (void)state;
    iris_camera cameras[16];
    iris_camera_sizes sizes[4];
    int32_t count, camera_count;
    const char *path = NULL;
    assert_int_equal(iris_camera_list(cameras, &camera_count, 16), IRIS_OK);
    for (int32_t i = 0; i < camera_count; i++) {
        path = strcmp(cameras[i].driver, "vimc") == 0 ? cameras[i].path : path;
    }
    if (!path) {
        print_message("no vimc\n");
        skip();
    }
    assert_int_equal(iris_camera_list_sizes(sizes, &count, path, "RGB3", 4), IRIS_OK);
    assert_int_equal(count, 1);
    assert_true(sizes[0].least.w < sizes[0].most.w && sizes[0].step.w >= 1 && sizes[0].step.h >= 1);
}

static void needs_the_virtual_machine(void **state)
{
    (void)state;
    print_message("no camera of the virtual machine (make test-linux)\n");
    skip();
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, open_controls, close_controls)
    const struct CMUnitTest tests[] = {
        CASE(controls_are_listed),
        CASE(what_is_set_reads_back),
        CASE(an_automatic_control_rules_another),
        CASE(what_cannot_be_set_is_said_in_words),
        CASE(menus_have_choices),
        CASE(wrong_calls_are_refused),
        CASE(a_camera_that_is_gone_is_said_to_be),
        CASE(cameras_are_listed),
        CASE(formats_sizes_and_rates_are_listed),
        CASE(sizes_may_go_in_steps),
    };
    const struct CMUnitTest none[] = {cmocka_unit_test(needs_the_virtual_machine)};
    controls.handle = -1;
    return webcam() ? cmocka_run_group_tests(tests, NULL, NULL) : cmocka_run_group_tests(none, NULL, NULL);
}
