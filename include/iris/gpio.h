/* IRIS - output lines of a GPIO chip: all of them at once, and safe when nobody drives.
 *
 * A value of 1 means active, whatever level that is: a line that is active low has the low level then. Every line has a safe
 * value, that iris_gpio_safe and iris_gpio_close drive: choose those with which the robot stands still.
 *
 * A chip that disappears is an error that the loop survives: later calls look for it again, and drive the lines to what they
 * are called with. What a line does while nobody holds it, before opening, after closing, and after a crash, is the board's
 * business: give each a resistor that pulls it to its safe level.
 *
 * Through libgpiod, whose API 1 and 2 are both served; one of them, or none, is built in. The operating system's part is in
 * port/os.
 */
#ifndef IRIS_GPIO_H
#define IRIS_GPIO_H

#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most lines that are held together. */
#define IRIS_GPIO_LINES_MAX 16

/* Room for why something failed, with a terminating 0. */
#define IRIS_GPIO_PROBLEM_BYTES 160

typedef struct {
    int32_t offset;     /* of the line on its chip, from 0 */
    int32_t active_low; /* 1: active is the low level */
    int32_t initial;    /* value when opened: 0 or 1 */
    int32_t safe;       /* value that does no harm: 0 or 1 */
} iris_gpio_line;

/* Read the first four; the rest belongs to the functions. */
typedef struct {
    uint32_t values;     /* that the lines were last driven to: bit i is lines[i]'s */
    uint32_t losses;     /* times that the chip was lost */
    uint32_t reconnects; /* times that it came back */
    int error;           /* errno of the last failure; 0 before the first */

    const char *name; /* null when closed */
    int32_t count;
    int32_t reconnect_ms;
    uint32_t tried_ms;   /* when the chip was lost, or last looked for */
    uint32_t active_low; /* a bit for each line, as in values */
    uint32_t safe;
    iris_gpio_line lines[IRIS_GPIO_LINES_MAX];
    void *chip;                      /* libgpiod's; null while the chip is away */
    void *held[IRIS_GPIO_LINES_MAX]; /* API 1: a line each; API 2: the request, first */
    char problem[IRIS_GPIO_PROBLEM_BYTES];
} iris_gpio;

/* Holds `count` lines of a chip as outputs, at their initial values.
 *   chip          a path (with a slash), a name such as gpiochip0, or a label, of gpiochip0 to gpiochip63; kept, not copied: it
 *                 must outlive *gpio. A chip that comes back may have another number (under Linux 6.1 it does when its lines
 *                 were held): its label is the same
 *   lines         copied; no two of one offset
 *   count         1 to IRIS_GPIO_LINES_MAX
 *   reconnect_ms  the least time between two attempts to find a lost chip, 0..60000
 *   now_ms        any clock of the caller's that counts milliseconds, here and below; may wrap
 * IRIS_ERR_ARG: null pointer, or a value outside these lists, *gpio untouched. Otherwise iris_gpio_problem says why:
 * IRIS_ERR_RANGE: the chip has no such line; IRIS_ERR_UNSUPPORTED: no GPIO chip, or built without libgpiod; IRIS_ERR_IO: not
 * there, a busy line, or no permission. *gpio is ready after these three, too, and the calls below go on trying. Some ms. */
iris_status iris_gpio_open(iris_gpio *gpio, const char *chip, const iris_gpio_line *lines, int32_t count,
                           int32_t reconnect_ms, uint32_t now_ms);

/* Drives all lines: bit i is the value of lines[i], further bits do not count. One call of the system, even if nothing
 * changes: it tells when the chip is gone.
 * IRIS_ERR_IO: the chip is away, or a line is somebody else's; IRIS_ERR_RANGE, IRIS_ERR_UNSUPPORTED: as above, of what came in
 * its place; IRIS_ERR_ARG: null pointer. O(count); looking for a chip takes some ms. */
iris_status iris_gpio_set(iris_gpio *gpio, uint32_t values, uint32_t now_ms);

/* Drives all lines to their safe values; otherwise like iris_gpio_set. */
iris_status iris_gpio_safe(iris_gpio *gpio, uint32_t now_ms);

/* Drives all lines to their safe values and gives them back. Every later call but iris_gpio_open returns IRIS_ERR_IO. Null and
 * a second call do nothing. */
void iris_gpio_close(iris_gpio *gpio);

/* Why the lines failed last, such as "line 17 is in use by 'gpioset'". Never null; belongs to *gpio. */
const char *iris_gpio_problem(const iris_gpio *gpio);

#ifdef __cplusplus
}
#endif

#endif
