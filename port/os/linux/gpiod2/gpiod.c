/* libgpiod, API 2. A request outlives its chip's descriptor, but a line's user is asked of the chip. */
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
    if (label) {
        struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
        int error = !info ? errno : strcmp(gpiod_chip_info_get_label(info), label) != 0 ? ENOENT : 0;
        gpiod_chip_info_free(info);
        if (error != 0) {
            gpiod_chip_close(chip);
            return error;
        }
    }
    gpio->chip = chip;
    return 0;
}

int32_t iris_gpiod_line_count(iris_gpio *gpio)
{
    struct gpiod_chip_info *info = gpiod_chip_get_info(gpio->chip);
    int32_t count = info ? (int32_t)gpiod_chip_info_get_num_lines(info) : 0;
    gpiod_chip_info_free(info);
    return count;
}

static enum gpiod_line_value value_of(uint32_t levels, int32_t line)
{
    return levels >> line & 1 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
}

static int configure(struct gpiod_line_config *config, struct gpiod_line_settings *settings,
                     const iris_gpio *gpio, uint32_t levels)
{
    for (int32_t i = 0; i < gpio->count; i++) {
        const unsigned offset = (unsigned)gpio->lines[i].offset;
        if (gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT) != 0 ||
            gpiod_line_settings_set_output_value(settings, value_of(levels, i)) != 0 ||
            gpiod_line_config_add_line_settings(config, &offset, 1, settings) != 0) {
            return errno;
        }
    }
    return 0;
}

int iris_gpiod_request(iris_gpio *gpio, uint32_t levels)
{
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    struct gpiod_line_config *config = gpiod_line_config_new();
    struct gpiod_request_config *request = gpiod_request_config_new();
    int error = !settings || !config || !request ? ENOMEM : configure(config, settings, gpio, levels);
    if (error == 0) {
        gpiod_request_config_set_consumer(request, "iris");
        gpio->held[0] = gpiod_chip_request_lines(gpio->chip, request, config);
        error = gpio->held[0] ? 0 : errno;
    }
    gpiod_request_config_free(request);
    gpiod_line_config_free(config);
    gpiod_line_settings_free(settings);
    return error;
}

int iris_gpiod_set(iris_gpio *gpio, uint32_t levels)
{
    enum gpiod_line_value values[IRIS_GPIO_LINES_MAX];
    for (int32_t i = 0; i < gpio->count; i++) {
        values[i] = value_of(levels, i);
    }
    return gpiod_line_request_set_values(gpio->held[0], values) == 0 ? 0 : errno;
}

int iris_gpiod_is_used(char *name, size_t capacity, iris_gpio *gpio, int32_t line)
{
    struct gpiod_line_info *info = gpiod_chip_get_line_info(gpio->chip, (unsigned)gpio->lines[line].offset);
    int used = info && gpiod_line_info_is_used(info);
    if (used) {
        const char *consumer = gpiod_line_info_get_consumer(info);
        name[0] = '\0';
        strncat(name, consumer ? consumer : "", capacity - 1);
    }
    gpiod_line_info_free(info);
    return used;
}

void iris_gpiod_close(iris_gpio *gpio)
{
    if (gpio->held[0]) {
        gpiod_line_request_release(gpio->held[0]);
    }
    if (gpio->chip) {
        gpiod_chip_close(gpio->chip);
    }
    gpio->chip = NULL;
    gpio->held[0] = NULL;
}
