/* libgpiod, API 1. Its line requests have one set of flags for all lines, so levels are worked out in gpio.c. */
#include "../gpiod.h"

#include <errno.h>
#include <gpiod.h>
#include <string.h>

int iris_gpiod_open(iris_gpio *gpio, const char *path, const char *label)
{
    struct gpiod_chip *chip = gpiod_chip_open(path);
    if (!chip) {
        return errno;
    }
    if (label && strcmp(gpiod_chip_label(chip), label) != 0) {
        gpiod_chip_close(chip);
        return ENOENT;
    }
    gpio->chip = chip;
    return 0;
}

int32_t iris_gpiod_line_count(iris_gpio *gpio)
{
    return (int32_t)gpiod_chip_num_lines(gpio->chip);
}

/* The held lines as libgpiod wants them together. */
static void gather(struct gpiod_line_bulk *bulk, int *values, iris_gpio *gpio, uint32_t levels)
{
    gpiod_line_bulk_init(bulk);
    for (int32_t i = 0; i < gpio->count; i++) {
        gpiod_line_bulk_add(bulk, gpio->held[i]);
        values[i] = (int)(levels >> i & 1);
    }
}

int iris_gpiod_request(iris_gpio *gpio, uint32_t levels)
{
    struct gpiod_line_bulk bulk;
    int values[IRIS_GPIO_LINES_MAX];
    for (int32_t i = 0; i < gpio->count; i++) {
        gpio->held[i] = gpiod_chip_get_line(gpio->chip, (unsigned)gpio->lines[i].offset);
        if (!gpio->held[i]) {
            return errno;
        }
    }
    gather(&bulk, values, gpio, levels);
    return gpiod_line_request_bulk_output(&bulk, "iris", values) == 0 ? 0 : errno;
}

int iris_gpiod_set(iris_gpio *gpio, uint32_t levels)
{
    struct gpiod_line_bulk bulk;
    int values[IRIS_GPIO_LINES_MAX];
    gather(&bulk, values, gpio, levels);
    return gpiod_line_set_value_bulk(&bulk, values) == 0 ? 0 : errno;
}

int iris_gpiod_is_used(char *name, size_t capacity, iris_gpio *gpio, int32_t line)
{
    struct gpiod_line *handle = gpiod_chip_get_line(gpio->chip, (unsigned)gpio->lines[line].offset);
    if (!handle || !gpiod_line_is_used(handle)) {
        return 0;
    }
    const char *consumer = gpiod_line_consumer(handle);
    name[0] = '\0';
    strncat(name, consumer ? consumer : "", capacity - 1);
    return 1;
}

void iris_gpiod_close(iris_gpio *gpio)
{
    if (gpio->chip) {
        gpiod_chip_close(gpio->chip); /* with all of its lines */
    }
    gpio->chip = NULL;
    memset(gpio->held, 0, sizeof gpio->held);
}
