/* GPIO lines of a real kernel, gpio-sim's, whose levels are read back from /sys; outside of the rig, what needs no chip. */
#include "gpio_sim.h"
#include "iris/gpio.h"

#include <errno.h>

static const iris_gpio_line four[4] = {{1, 0, 0, 0}, {2, 1, 0, 0}, {5, 0, 1, 1}, {6, 1, 1, 0}};

/* The chip and its folder in /sys; skips where there is none. */
static const char *rig_chip(const char **sysfs)
{
    const char *chip = getenv("RIG_GPIO");
    *sysfs = getenv("RIG_GPIO_SYSFS");
    if (!chip || !*chip || !*sysfs || !**sysfs) {
        print_message("no GPIO chip to drive (RIG_GPIO)\n");
        skip();
    }
    return chip;
}

static int has_libgpiod(void)
{
    iris_gpio gpio;
    return iris_gpio_open(&gpio, "/dev/null", four, 4, 250, 0) != IRIS_ERR_UNSUPPORTED ||
           gpio.error != ENOSYS;
}

/* The levels of `four`'s lines as bits. */
static uint32_t levels(const char *sysfs)
{
    uint32_t bits = 0;
    for (int i = 0; i < 4; i++) {
        bits |= (uint32_t)gpio_sim_level(sysfs, four[i].offset) << i;
    }
    return bits;
}

static void what_is_no_chip_is_refused(void **state)
{
    (void)state;
    iris_gpio gpio;
    if (!has_libgpiod()) {
        assert_non_null(
            strstr((iris_gpio_open(&gpio, "x", four, 4, 250, 0), iris_gpio_problem(&gpio)), "libgpiod"));
        return;
    }
    assert_int_equal(iris_gpio_open(&gpio, "/dev/gpiochip-none", four, 4, 250, 0), IRIS_ERR_IO);
    assert_string_equal(iris_gpio_problem(&gpio), "no such GPIO chip");
    assert_int_equal(iris_gpio_set(&gpio, 1, 1000), IRIS_ERR_IO);
    assert_int_equal(iris_gpio_open(&gpio, "no-chip-has-this-label", four, 4, 250, 0), IRIS_ERR_IO);
    assert_string_equal(iris_gpio_problem(&gpio), "no such GPIO chip");
    assert_int_equal(iris_gpio_open(&gpio, "gpiochip99", four, 4, 250, 0), IRIS_ERR_IO);
    static const char *const others[] = {"/dev/null", "/dev", "/proc/mounts"};
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(iris_gpio_open(&gpio, others[i], four, 4, 250, 0), IRIS_ERR_UNSUPPORTED);
        assert_string_equal(iris_gpio_problem(&gpio), "not a GPIO chip");
        iris_gpio_close(&gpio);
    }
}

static void the_kernel_has_the_levels(void **state)
{
    (void)state;
    const char *sysfs, *chip = rig_chip(&sysfs);
    iris_gpio gpio;
    assert_int_equal(iris_gpio_open(&gpio, chip, four, 4, 250, 0), IRIS_OK);
    assert_int_equal(levels(sysfs), 6);
    for (uint32_t values = 0; values < 16; values++) {
        assert_int_equal(iris_gpio_set(&gpio, values, 1), IRIS_OK);
        assert_int_equal(levels(sysfs), values ^ 0xa);
    }
    assert_int_equal(iris_gpio_safe(&gpio, 2), IRIS_OK);
    assert_int_equal(levels(sysfs), 0xe);
    assert_int_equal(gpio_sim_level(sysfs, 0), 0);
    assert_int_equal(gpio_sim_level(sysfs, 3), 0);
    iris_gpio_close(&gpio);
}

static void a_chip_by_name_and_by_label(void **state)
{
    (void)state;
    const char *sysfs, *chip = rig_chip(&sysfs);
    char label[64];
    iris_gpio gpio;
    assert_int_equal(iris_gpio_open(&gpio, strrchr(chip, '/') + 1, four, 4, 250, 0), IRIS_OK);
    assert_int_equal(levels(sysfs), 6);
    iris_gpio_close(&gpio);
    const char *node = strstr(sysfs, "gpio-sim."); /* .../gpio-sim.0/gpiochip1: labels are gpio-sim.0-node0 */
    assert_non_null(node);
    snprintf(label, sizeof label, "%.*s-node0", (int)strcspn(node, "/"), node);
    assert_int_equal(iris_gpio_open(&gpio, label, four, 4, 250, 0), IRIS_OK);
    assert_int_equal(levels(sysfs), 6);
    iris_gpio_close(&gpio);
}

static void a_busy_line_and_its_user(void **state)
{
    (void)state;
    const char *sysfs, *chip = rig_chip(&sysfs);
    iris_gpio first, second;
    const iris_gpio_line other[2] = {{9, 0, 0, 0}, {5, 0, 0, 0}};
    assert_int_equal(iris_gpio_open(&first, chip, four, 4, 250, 0), IRIS_OK);
    assert_int_equal(iris_gpio_open(&second, chip, other, 2, 0, 0), IRIS_ERR_IO);
    assert_int_equal(second.error, EBUSY);
    assert_string_equal(iris_gpio_problem(&second), "line 5 is in use by 'iris'");
    assert_int_equal(iris_gpio_set(&first, 1, 1), IRIS_OK);
    assert_int_equal(levels(sysfs), 1 ^ 0xa); /* the first user does not notice */
    iris_gpio_close(&first);
    assert_int_equal(iris_gpio_set(&second, 2, 1), IRIS_OK); /* free now */
    assert_int_equal(gpio_sim_level(sysfs, 5), 1);
    iris_gpio_close(&second);
}

static void a_line_that_the_chip_lacks(void **state)
{
    (void)state;
    const char *sysfs, *chip = rig_chip(&sysfs);
    const iris_gpio_line far[1] = {{500, 0, 0, 0}};
    iris_gpio gpio;
    assert_int_equal(iris_gpio_open(&gpio, chip, far, 1, 250, 0), IRIS_ERR_RANGE);
    assert_non_null(strstr(iris_gpio_problem(&gpio), "line 500: the chip has lines 0 to "));
    iris_gpio_close(&gpio);
}

static int open_descriptors(void)
{
    int count = 0;
    for (int i = 0; i < 256; i++) {
        char path[64], target[64];
        snprintf(path, sizeof path, "/proc/self/fd/%d", i);
        count += readlink(path, target, sizeof target) >= 0;
    }
    return count;
}

/* By its label: kernels such as 6.1 keep the number of a chip that goes away with lines held, and it gets another one. */
static void a_chip_removed_while_its_lines_are_held(void **state)
{
    (void)state;
    const char *rig_sysfs;
    char sysfs[128];
    (void)rig_chip(&rig_sysfs);
    iris_gpio gpio;
    gpio_sim_make(sysfs);
    const int descriptors = open_descriptors();
    assert_int_equal(iris_gpio_open(&gpio, GPIO_SIM_LABEL, four, 4, 250, 0), IRIS_OK);
    for (uint32_t turn = 1; turn <= 5; turn++) {
        uint32_t now_ms = turn * 1000;
        assert_int_equal(iris_gpio_set(&gpio, 3, now_ms), IRIS_OK);
        assert_int_equal(levels(sysfs), 3 ^ 0xa);
        gpio_sim_remove();
        assert_int_equal(iris_gpio_set(&gpio, 1, now_ms), IRIS_ERR_IO);
        assert_string_equal(iris_gpio_problem(&gpio), "the GPIO chip is gone");
        assert_int_equal(gpio.losses, turn);
        assert_int_equal(iris_gpio_set(&gpio, 1, now_ms + 100), IRIS_ERR_IO);
        assert_int_equal(iris_gpio_set(&gpio, 1, now_ms + 250), IRIS_ERR_IO);
        assert_string_equal(iris_gpio_problem(&gpio), "no such GPIO chip");
        gpio_sim_make(sysfs);
        assert_int_equal(iris_gpio_safe(&gpio, now_ms + 500), IRIS_OK);
        assert_int_equal(levels(sysfs), 0xe);
        assert_int_equal(gpio.reconnects, turn);
    }
    iris_gpio_close(&gpio);
    assert_int_equal(open_descriptors(), descriptors);
    gpio_sim_remove();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_no_chip_is_refused),
        cmocka_unit_test(the_kernel_has_the_levels),
        cmocka_unit_test(a_chip_by_name_and_by_label),
        cmocka_unit_test(a_busy_line_and_its_user),
        cmocka_unit_test(a_line_that_the_chip_lacks),
        cmocka_unit_test(a_chip_removed_while_its_lines_are_held),
    };
    return cmocka_run_group_tests_name("gpio_chip", tests, NULL, NULL);
}
