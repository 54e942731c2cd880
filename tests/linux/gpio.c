/* GPIO lines over a fake libgpiod: this program has the functions that the library asks of it (port/os/linux/gpiod.h), with
 * chips that can be busy, refuse, disappear, and come back. tests/rig/guest/gpio_chip.c has a real one. */
#include "iris/gpio.h"
#include "test.h"

#include <errno.h>
#include <stdio.h>

/* The one chip that there is. */
static struct {
    const char *path, *label; /* null: no chip */
    int32_t lines;
    int open_error, request_error, set_error; /* of the next calls; 0: none */
    const char *user;                         /* of line 17 */
    int opens, requests, sets, closes;
    int is_open, is_held;
    uint32_t levels;
    uint32_t before_close; /* the levels at that time */
} chip;

int iris_gpiod_open(iris_gpio *gpio, const char *path, const char *label);
int32_t iris_gpiod_line_count(iris_gpio *gpio);
int iris_gpiod_request(iris_gpio *gpio, uint32_t levels);
int iris_gpiod_set(iris_gpio *gpio, uint32_t levels);
int iris_gpiod_is_used(char *name, size_t capacity, iris_gpio *gpio, int32_t line);
void iris_gpiod_close(iris_gpio *gpio);

int iris_gpiod_open(iris_gpio *gpio, const char *path, const char *label)
{
    chip.opens++;
    if (chip.open_error != 0) {
        return chip.open_error;
    }
    if (!chip.path || strcmp(chip.path, path) != 0 || (label && strcmp(chip.label, label) != 0)) {
        return ENOENT;
    }
    assert_false(chip.is_open);
    chip.is_open = 1;
    gpio->chip = &chip;
    return 0;
}

int32_t iris_gpiod_line_count(iris_gpio *gpio)
{
    assert_ptr_equal(gpio->chip, &chip);
    return chip.lines;
}

int iris_gpiod_request(iris_gpio *gpio, uint32_t levels)
{
    assert_true(chip.is_open && !chip.is_held);
    chip.requests++;
    if (chip.request_error != 0) {
        return chip.request_error;
    }
    chip.is_held = 1;
    chip.levels = levels;
    gpio->held[0] = &chip;
    return 0;
}

int iris_gpiod_set(iris_gpio *gpio, uint32_t levels)
{
    assert_true(chip.is_open && chip.is_held && gpio->held[0] == &chip);
    chip.sets++;
    if (chip.set_error != 0) {
        return chip.set_error;
    }
    chip.levels = levels;
    return 0;
}

int iris_gpiod_is_used(char *name, size_t capacity, iris_gpio *gpio, int32_t line)
{
    assert_true(chip.is_open);
    if (!chip.user || gpio->lines[line].offset != 17) {
        return 0;
    }
    snprintf(name, capacity, "%s", chip.user);
    return 1;
}

void iris_gpiod_close(iris_gpio *gpio)
{
    chip.closes += chip.is_open;
    chip.before_close = chip.levels;
    chip.is_open = chip.is_held = 0;
    gpio->chip = NULL;
    memset(gpio->held, 0, sizeof gpio->held);
}

static int fresh(void **state)
{
    (void)state;
    memset(&chip, 0, sizeof chip);
    chip.path = "/dev/gpiochip3";
    chip.label = "pinctrl-bcm2711";
    chip.lines = 58;
    return 0;
}

/* left, right (active low), stop (active when safe), heartbeat (active low, and active at first) */
static const iris_gpio_line four[4] = {{17, 0, 0, 0}, {18, 1, 0, 0}, {27, 0, 1, 1}, {22, 1, 1, 0}};

static void values_become_levels(void **state)
{
    (void)state;
    iris_gpio gpio;
    assert_int_equal(iris_gpio_open(&gpio, "/dev/gpiochip3", four, 4, 250, 0), IRIS_OK);
    assert_int_equal(chip.levels, 6); /* initial 0011 is right's 1, stop's 1, and heartbeat's 0 */
    assert_int_equal(gpio.values, 0xc);
    for (uint32_t values = 0; values < 16; values++) {
        assert_int_equal(iris_gpio_set(&gpio, values, values), IRIS_OK);
        assert_int_equal(chip.levels, values ^ 0xa);
        assert_int_equal(gpio.values, values);
    }
    assert_int_equal(iris_gpio_set(&gpio, 0xffffff01, 20), IRIS_OK);
    assert_int_equal(chip.levels, 1 ^ 0xa);
    assert_int_equal(gpio.values, 1);
    assert_int_equal(chip.sets, 17); /* every call asks the chip */
    assert_int_equal(iris_gpio_safe(&gpio, 21), IRIS_OK);
    assert_int_equal(chip.levels, 0xe);
    assert_int_equal(gpio.values, 4);
    assert_string_equal(iris_gpio_problem(&gpio), "no error");
    iris_gpio_close(&gpio);
}

static void closing_is_safe_first(void **state)
{
    (void)state;
    iris_gpio gpio;
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 250, 0), IRIS_OK);
    assert_int_equal(iris_gpio_set(&gpio, 3, 1), IRIS_OK);
    iris_gpio_close(&gpio);
    assert_int_equal(chip.before_close, 0xe);
    assert_int_equal(chip.closes, 1);
    assert_false(chip.is_held);
    iris_gpio_close(&gpio);
    iris_gpio_close(NULL);
    assert_int_equal(chip.closes, 1);
    assert_int_equal(iris_gpio_set(&gpio, 3, 100000), IRIS_ERR_IO); /* closed is closed */
    assert_int_equal(iris_gpio_safe(&gpio, 200000), IRIS_ERR_IO);
    assert_int_equal(chip.opens, 1);
    iris_gpio zeroed = {0};
    iris_gpio_close(&zeroed);
    assert_int_equal(iris_gpio_set(&zeroed, 1, 100000), IRIS_ERR_IO);
}

static void a_chip_by_path_name_or_label(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        iris_status status;
    } names[] = {
        {"/dev/gpiochip3", IRIS_OK},
        {"gpiochip3", IRIS_OK},
        {"pinctrl-bcm2711", IRIS_OK},
        {"gpiochip4", IRIS_ERR_IO},
        {"pinctrl", IRIS_ERR_IO},
        {"", IRIS_ERR_IO},
        {"/dev/pinctrl-bcm2711", IRIS_ERR_IO},
        {"./gpiochip3", IRIS_ERR_IO},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        iris_gpio gpio;
        assert_int_equal(iris_gpio_open(&gpio, names[i].name, four, 4, 250, 0), names[i].status);
        assert_int_equal(chip.is_held, names[i].status == IRIS_OK);
        if (names[i].status != IRIS_OK) {
            assert_string_equal(iris_gpio_problem(&gpio), "no such GPIO chip");
            assert_int_equal(gpio.error, ENOENT);
        }
        iris_gpio_close(&gpio);
    }
    chip.path = "/dev/gpiochip63";
    chip.label = "gpiochip-like";
    iris_gpio gpio;
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip-like", four, 4, 250, 0), IRIS_OK);
    iris_gpio_close(&gpio);
    char long_name[300];
    memset(long_name, 'x', sizeof long_name);
    memcpy(long_name, "gpiochip", 8);
    long_name[299] = '\0';
    assert_int_equal(iris_gpio_open(&gpio, long_name, four, 4, 250, 0), IRIS_ERR_IO);
    chip.open_error = EACCES;
    assert_int_equal(iris_gpio_open(&gpio, "pinctrl-bcm2711", four, 4, 250, 0), IRIS_ERR_IO);
    assert_non_null(strstr(iris_gpio_problem(&gpio), "no permission"));
}

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    iris_gpio gpio;
    chip.request_error = EBUSY;
    chip.user = "gpioset";
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 250, 0), IRIS_ERR_IO);
    assert_string_equal(iris_gpio_problem(&gpio), "line 17 is in use by 'gpioset'");
    assert_int_equal(gpio.error, EBUSY);
    assert_false(chip.is_open);
    chip.user = "";
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 250, 0), IRIS_ERR_IO);
    assert_string_equal(iris_gpio_problem(&gpio), "line 17 is in use by another program");
    chip.user = NULL; /* given back in between */
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 250, 0), IRIS_ERR_IO);
    assert_string_equal(iris_gpio_problem(&gpio), "a line is in use");
    char longest[200];
    memset(longest, 'u', sizeof longest);
    longest[199] = '\0';
    chip.user = longest;
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 250, 0), IRIS_ERR_IO);
    assert_true(strlen(iris_gpio_problem(&gpio)) < IRIS_GPIO_PROBLEM_BYTES);
    fresh(NULL);
    chip.lines = 27;
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 250, 0), IRIS_ERR_RANGE);
    assert_string_equal(iris_gpio_problem(&gpio), "line 27: the chip has lines 0 to 26");
    assert_false(chip.is_open);
    assert_int_equal(chip.requests, 0);
    for (int error = ENOTTY; error != 0; error = error == ENOTTY ? ENODEV : error == ENODEV ? ENOSYS : 0) {
        chip.open_error = error;
        assert_int_equal(iris_gpio_open(&gpio, "/dev/null", four, 4, 250, 0), IRIS_ERR_UNSUPPORTED);
        assert_non_null(strstr(iris_gpio_problem(&gpio), error == ENOSYS ? "libgpiod" : "not a GPIO chip"));
    }
    for (int error = 1; error < 200; error++) {
        chip.open_error = error;
        assert_int_not_equal(iris_gpio_open(&gpio, "/dev/gpiochip3", four, 4, 250, 0), IRIS_OK);
        assert_true(strlen(iris_gpio_problem(&gpio)) > 5);
    }
    assert_string_equal(iris_gpio_problem(NULL), "no error");
}

static void a_chip_that_goes_away_comes_back(void **state)
{
    (void)state;
    iris_gpio gpio;
    uint32_t now_ms = 0xffffff00u; /* the clock wraps meanwhile */
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 250, now_ms), IRIS_OK);
    assert_int_equal(iris_gpio_set(&gpio, 1, now_ms), IRIS_OK);
    chip.set_error = ENODEV;
    chip.path = NULL;
    assert_int_equal(iris_gpio_set(&gpio, 2, now_ms), IRIS_ERR_IO);
    assert_string_equal(iris_gpio_problem(&gpio), "the GPIO chip is gone");
    assert_int_equal(chip.closes, 1);
    assert_int_equal(gpio.losses, 1);
    assert_int_equal(gpio.values, 1); /* as far as anybody knows */
    int opens = chip.opens;
    for (uint32_t ms = 1; ms < 250; ms += 31) {
        assert_int_equal(iris_gpio_set(&gpio, 2, now_ms + ms), IRIS_ERR_IO);
    }
    assert_int_equal(chip.opens, opens); /* not yet */
    assert_int_equal(iris_gpio_set(&gpio, 2, now_ms += 250), IRIS_ERR_IO);
    assert_true(chip.opens > opens);
    fresh(NULL);
    assert_int_equal(iris_gpio_safe(&gpio, now_ms + 249), IRIS_ERR_IO);
    assert_int_equal(iris_gpio_safe(&gpio, now_ms + 250),
                     IRIS_OK); /* to what is wanted now, not to initial */
    assert_int_equal(chip.levels, 0xe);
    assert_int_equal(gpio.values, 4);
    assert_int_equal(gpio.reconnects, 1);
    assert_int_equal(chip.sets, 0);
    assert_int_equal(gpio.error, ENOENT);
    iris_gpio_close(&gpio);
}

/* A program may start before its chip is there, and a line may become free. */
static void what_is_not_there_yet_is_waited_for(void **state)
{
    (void)state;
    iris_gpio gpio;
    chip.request_error = EBUSY;
    chip.user = "gpioset";
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 0, 0), IRIS_ERR_IO);
    assert_int_equal(iris_gpio_set(&gpio, 3, 0), IRIS_ERR_IO);
    chip.request_error = 0;
    assert_int_equal(iris_gpio_set(&gpio, 3, 0), IRIS_OK);
    assert_int_equal(chip.levels, 3 ^ 0xa);
    iris_gpio_close(&gpio);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    iris_gpio gpio, before;
    memset(&gpio, 0x5a, sizeof gpio);
    before = gpio;
    iris_gpio_line many[IRIS_GPIO_LINES_MAX + 1];
    memset(many, 0, sizeof many);
    for (int32_t i = 0; i <= IRIS_GPIO_LINES_MAX; i++) {
        many[i].offset = i;
    }
    static const iris_gpio_line bad[][2] = {
        {{5, 0, 0, 0}, {5, 1, 0, 0}},  {{5, 0, 0, 0}, {-1, 0, 0, 0}}, {{5, 0, 0, 0}, {6, 2, 0, 0}},
        {{5, 0, 0, 0}, {6, 0, -1, 0}}, {{5, 0, 0, 0}, {6, 0, 0, 2}},  {{INT32_MIN, 0, 0, 0}, {6, 0, 0, 0}}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", bad[i], 2, 250, 0), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_gpio_open(NULL, "gpiochip3", four, 4, 250, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_gpio_open(&gpio, NULL, four, 4, 250, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", NULL, 4, 250, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 0, 250, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", many, IRIS_GPIO_LINES_MAX + 1, 250, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, -1, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", four, 4, 60001, 0), IRIS_ERR_ARG);
    assert_memory_equal(&gpio, &before, sizeof gpio);
    assert_int_equal(chip.opens, 0);
    assert_int_equal(iris_gpio_set(NULL, 0, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_gpio_safe(NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip3", many, IRIS_GPIO_LINES_MAX, 60000, 0), IRIS_OK);
    assert_int_equal(iris_gpio_set(&gpio, 0xffffffff, 0), IRIS_OK);
    assert_int_equal(chip.levels, 0xffff);
    iris_gpio_close(&gpio);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(values_become_levels, fresh),
        cmocka_unit_test_setup(closing_is_safe_first, fresh),
        cmocka_unit_test_setup(a_chip_by_path_name_or_label, fresh),
        cmocka_unit_test_setup(what_is_wrong_is_said, fresh),
        cmocka_unit_test_setup(a_chip_that_goes_away_comes_back, fresh),
        cmocka_unit_test_setup(what_is_not_there_yet_is_waited_for, fresh),
        cmocka_unit_test_setup(arguments_are_checked, fresh),
    };
    return cmocka_run_group_tests_name("gpio", tests, NULL, NULL);
}
