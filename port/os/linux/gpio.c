/* Lines of GPIO chips: finding a chip, levels, and losing it; libgpiod is asked through gpiod.h. */
#include "iris/gpio.h"

#include <errno.h>
#include <string.h>

#include "gpiod.h"

/* How many names /dev/gpiochipN are looked at for a label. */
#define CHIPS_MAX 64

static void add_text(char *text, size_t capacity, const char *more)
{
    size_t length = strlen(text);
    strncat(text, more, capacity - 1 - length);
}

static void add_number(char *text, size_t capacity, int32_t number)
{
    char digits[12];
    size_t at = sizeof digits - 1;
    digits[at] = '\0';
    do {
        digits[--at] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0 && at > 0);
    add_text(text, capacity, digits + at);
}

static const char *text_of(int error)
{
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return "no such GPIO chip";
    case ENODEV:
    case ENXIO:
        return "the GPIO chip is gone";
    case ENOTTY:
        return "not a GPIO chip";
    case EACCES:
    case EPERM:
        return "no permission (is the user in the group that owns the chip, often gpio?)";
    case ENOSYS:
        return "this build of IRIS has no GPIO: libgpiod was not there";
    case EBUSY:
        return "a line is in use";
    case EINVAL:
        return "the chip does not take these lines as outputs";
    default:
        return "input or output failed";
    }
}

static void say(iris_gpio *gpio, const char *text)
{
    gpio->problem[0] = '\0';
    add_text(gpio->problem, sizeof gpio->problem, text);
}

static void say_line(iris_gpio *gpio, int32_t offset, const char *text)
{
    say(gpio, "line ");
    add_number(gpio->problem, sizeof gpio->problem, offset);
    add_text(gpio->problem, sizeof gpio->problem, text);
}

/* Whose is the line that is busy? */
static void say_who(iris_gpio *gpio)
{
    char user[64];
    for (int32_t i = 0; i < gpio->count; i++) {
        if (iris_gpiod_is_used(user, sizeof user, gpio, i)) {
            say_line(gpio, gpio->lines[i].offset, " is in use by ");
            add_text(gpio->problem, sizeof gpio->problem, user[0] ? "'" : "another program");
            add_text(gpio->problem, sizeof gpio->problem, user);
            add_text(gpio->problem, sizeof gpio->problem, user[0] ? "'" : "");
            return;
        }
    }
}

static iris_status fail(iris_gpio *gpio, int error)
{
    gpio->error = error;
    if (error != ERANGE) {
        say(gpio, text_of(error));
    }
    if (error == EBUSY && gpio->chip) {
        say_who(gpio);
    }
    iris_gpiod_close(gpio);
    return error == ERANGE                      ? IRIS_ERR_RANGE
           : error == ENOTTY || error == ENOSYS ? IRIS_ERR_UNSUPPORTED
                                                : IRIS_ERR_IO;
}

/* Opens /dev/NAME, or the first chip with this label. */
static int find(iris_gpio *gpio)
{
    char path[64] = "/dev/";
    if (strchr(gpio->name, '/')) {
        return iris_gpiod_open(gpio, gpio->name, NULL);
    }
    if (strncmp(gpio->name, "gpiochip", 8) == 0 && strlen(gpio->name) < sizeof path - 5) {
        add_text(path, sizeof path, gpio->name);
        int error = iris_gpiod_open(gpio, path, NULL);
        if (error != ENOENT) {
            return error;
        }
    }
    int error = ENOENT, forbidden = 0;
    for (int32_t i = 0; i < CHIPS_MAX && error != 0 && error != ENOSYS; i++) {
        path[0] = '\0';
        add_text(path, sizeof path, "/dev/gpiochip");
        add_number(path, sizeof path, i);
        error = iris_gpiod_open(gpio, path, gpio->name);
        forbidden |= error == EACCES || error == EPERM;
    }
    return error == 0 || error == ENOSYS ? error : forbidden ? EACCES : ENOENT;
}

/* Finds the chip and takes the lines, at these values. */
static iris_status connect_lines(iris_gpio *gpio, uint32_t values, uint32_t now_ms)
{
    gpio->tried_ms = now_ms;
    int error = find(gpio);
    if (error != 0) {
        return fail(gpio, error == ENODEV || error == EISDIR ? ENOTTY
                                                             : error); /* libgpiod says so of other files */
    }
    const int32_t lines = iris_gpiod_line_count(gpio);
    for (int32_t i = 0; i < gpio->count; i++) {
        if (gpio->lines[i].offset >= lines) {
            say_line(gpio, gpio->lines[i].offset, ": the chip has lines 0 to ");
            add_number(gpio->problem, sizeof gpio->problem, lines - 1);
            return fail(gpio, ERANGE);
        }
    }
    error = iris_gpiod_request(gpio, values ^ gpio->active_low);
    if (error != 0) {
        return fail(gpio, error);
    }
    gpio->values = values;
    return IRIS_OK;
}

static int are_good(const iris_gpio_line *lines, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        if (lines[i].offset < 0 || (uint32_t)lines[i].active_low > 1 || (uint32_t)lines[i].initial > 1 ||
            (uint32_t)lines[i].safe > 1) {
            return 0;
        }
        for (int32_t j = 0; j < i; j++) {
            if (lines[j].offset == lines[i].offset) {
                return 0;
            }
        }
    }
    return 1;
}

iris_status iris_gpio_open(iris_gpio *gpio, const char *chip, const iris_gpio_line *lines, int32_t count,
                           int32_t reconnect_ms, uint32_t now_ms)
{
    if (!gpio || !chip || !lines || count < 1 || count > IRIS_GPIO_LINES_MAX || reconnect_ms < 0 ||
        reconnect_ms > 60000 || !are_good(lines, count)) {
        return IRIS_ERR_ARG;
    }
    uint32_t values = 0;
    memset(gpio, 0, sizeof *gpio);
    gpio->name = chip;
    gpio->count = count;
    gpio->reconnect_ms = reconnect_ms;
    for (int32_t i = 0; i < count; i++) {
        gpio->lines[i] = lines[i];
        gpio->active_low |= (uint32_t)lines[i].active_low << i;
        gpio->safe |= (uint32_t)lines[i].safe << i;
        values |= (uint32_t)lines[i].initial << i;
    }
    return connect_lines(gpio, values, now_ms);
}

iris_status iris_gpio_set(iris_gpio *gpio, uint32_t values, uint32_t now_ms)
{
    if (!gpio) {
        return IRIS_ERR_ARG;
    }
    if (!gpio->name || (!gpio->chip && now_ms - gpio->tried_ms < (uint32_t)gpio->reconnect_ms)) {
        return IRIS_ERR_IO;
    }
    values &= (1u << gpio->count) - 1;
    if (!gpio->chip) {
        iris_status status = connect_lines(gpio, values, now_ms);
        gpio->reconnects += status == IRIS_OK;
        return status;
    }
    int error = iris_gpiod_set(gpio, values ^ gpio->active_low);
    if (error != 0) {
        gpio->tried_ms = now_ms;
        gpio->losses++;
        return fail(gpio, error);
    }
    gpio->values = values;
    return IRIS_OK;
}

iris_status iris_gpio_safe(iris_gpio *gpio, uint32_t now_ms)
{
    return gpio ? iris_gpio_set(gpio, gpio->safe, now_ms) : IRIS_ERR_ARG;
}

void iris_gpio_close(iris_gpio *gpio)
{
    if (!gpio || !gpio->name) {
        return;
    }
    if (gpio->chip) {
        (void)iris_gpiod_set(gpio, gpio->safe ^ gpio->active_low);
        gpio->values = gpio->safe;
        iris_gpiod_close(gpio);
    }
    gpio->name = NULL;
}

const char *iris_gpio_problem(const iris_gpio *gpio)
{
    return gpio && gpio->problem[0] ? gpio->problem : "no error";
}
