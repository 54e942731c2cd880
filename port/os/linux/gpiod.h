/* What gpio.c asks of libgpiod: written once for each of its APIs, and once for a build without it. Functions that return an
 * int return 0 or errno. Levels are those on the wire: bit i is line i's. */
#ifndef IRIS_LINUX_GPIOD_H
#define IRIS_LINUX_GPIOD_H

#include <stddef.h>

#include "iris/gpio.h"

/* Sets gpio->chip. With a label: ENOENT for a chip of another one. */
int iris_gpiod_open(iris_gpio *gpio, const char *path, const char *label);

int32_t iris_gpiod_line_count(iris_gpio *gpio);

/* Sets gpio->held. */
int iris_gpiod_request(iris_gpio *gpio, uint32_t levels);

int iris_gpiod_set(iris_gpio *gpio, uint32_t levels);

/* Is this line of gpio->lines in use, and who says to use it? An empty name: it does not say. */
int iris_gpiod_is_used(char *name, size_t capacity, iris_gpio *gpio, int32_t line);

/* Gives back whatever gpio->chip and gpio->held have, and makes them null. */
void iris_gpiod_close(iris_gpio *gpio);

#endif
