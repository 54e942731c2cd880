/* Chips of the driver gpio-sim: made, removed, and asked for levels, which are the kernel's own. */
#ifndef IRIS_GPIO_SIM_H
#define IRIS_GPIO_SIM_H

#include "test.h"

#include <stdio.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define GPIO_SIM_LABEL "iris-test-chip"
#define GPIO_SIM_MINE  "/sys/kernel/config/gpio-sim/iris-test"
#define GPIO_SIM_LINES 8

static inline void gpio_sim_write(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static inline void gpio_sim_read(char *text, size_t capacity, const char *path)
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(text, (int)capacity, file));
    fclose(file);
    text[strcspn(text, "\n")] = '\0';
}

/* A chip of our own with that label; where its values are. */
static inline void gpio_sim_make(char sysfs[128])
{
    char name[24], device[32], path[64];
    assert_int_equal(mkdir(GPIO_SIM_MINE, 0755), 0);
    assert_int_equal(mkdir(GPIO_SIM_MINE "/bank0", 0755), 0);
    gpio_sim_write(GPIO_SIM_MINE "/bank0/num_lines", "8");
    gpio_sim_write(GPIO_SIM_MINE "/bank0/label", GPIO_SIM_LABEL);
    gpio_sim_write(GPIO_SIM_MINE "/live", "1");
    gpio_sim_read(name, sizeof name, GPIO_SIM_MINE "/bank0/chip_name");
    gpio_sim_read(device, sizeof device, GPIO_SIM_MINE "/dev_name");
    snprintf(path, 64, "/dev/%s", name);
    snprintf(sysfs, 128, "/sys/devices/platform/%s/%s", device, name);
    for (int i = 0; i < 200 && access(path, F_OK) != 0; i++) {
        nanosleep(&(struct timespec){0, 10000000}, NULL);
    }
}

static inline void gpio_sim_remove(void)
{
    gpio_sim_write(GPIO_SIM_MINE "/live", "0");
    assert_int_equal(rmdir(GPIO_SIM_MINE "/bank0"), 0);
    assert_int_equal(rmdir(GPIO_SIM_MINE), 0);
}

/* The level of a line. */
static inline int gpio_sim_level(const char *sysfs, int line)
{
    char path[256], text[16];
    snprintf(path, sizeof path, "%s/sim_gpio%d/value", sysfs, line);
    gpio_sim_read(text, sizeof text, path);
    return text[0] - '0';
}

/* What a line is at while nobody drives it. */
static inline void gpio_sim_pull(const char *sysfs, int line, int level)
{
    char path[256];
    snprintf(path, sizeof path, "%s/sim_gpio%d/pull", sysfs, line);
    gpio_sim_write(path, level ? "pull-up" : "pull-down");
}

#endif
