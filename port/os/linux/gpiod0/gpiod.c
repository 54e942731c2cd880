/* Built without libgpiod. */
#include "../gpiod.h"

#include <errno.h>

int iris_gpiod_open(iris_gpio *gpio, const char *path, const char *label)
{
    (void)gpio;
    (void)path;
    (void)label;
    return ENOSYS;
}

int32_t iris_gpiod_line_count(iris_gpio *gpio)
{
    (void)gpio;
    return 0;
}

int iris_gpiod_request(iris_gpio *gpio, uint32_t levels)
{
    (void)gpio;
    (void)levels;
    return ENOSYS;
}

int iris_gpiod_set(iris_gpio *gpio, uint32_t levels)
{
    (void)gpio;
    (void)levels;
    return ENOSYS;
}

int iris_gpiod_is_used(char *name, size_t capacity, iris_gpio *gpio, int32_t line)
{
    (void)capacity;
    (void)gpio;
    (void)line;
    name[0] = '\0';
    return 0;
}

void iris_gpiod_close(iris_gpio *gpio)
{
    (void)gpio;
}
