#include "steering_rescue.h"

#include "iris/command.h"
#include "iris/serial.h"
#include "steering_link.h"

#define SEND_MS 200
#define STEP_MS 2

/* Opened at their safe values. */
static int take_lines(iris_gpio *gpio, const steering_options *options)
{
    iris_gpio_line lines[STEERING_ROLES];
    for (int32_t i = 0; i < options->line_count; i++) {
        lines[i] = options->lines[i];
        lines[i].initial = lines[i].safe;
    }
    return iris_gpio_open(gpio, options->chip, lines, options->line_count, 0, 0) == IRIS_OK;
}

static int send_stop(iris_serial *serial, const steering_options *options)
{
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length = 0;
    const iris_command stop = {.state = IRIS_LINE_LOST};
    (void)iris_command_format(sentence, sizeof sentence, &length, &stop);
    const int64_t begin_ms = steering_clock_ms();
    (void)iris_serial_open(serial, options->serial, options->baud, 0, (uint32_t)begin_ms);
    iris_status status = iris_serial_send(serial, sentence, length, (uint32_t)begin_ms);
    while (status == IRIS_ERR_FULL && steering_clock_ms() - begin_ms < SEND_MS) {
        steering_sleep_ms(STEP_MS);
        status = iris_serial_continue(serial, (uint32_t)steering_clock_ms());
    }
    return status == IRIS_OK;
}

int steering_rescue(const steering_options *options)
{
    iris_gpio gpio = {0};
    iris_serial serial = {0};
    int all = options->line_count == 0 || take_lines(&gpio, options);
    all &= !options->serial || send_stop(&serial, options);
    if (options->line_count > 0) {
        steering_sleep_ms(STEERING_HOLD_MS);
    }
    iris_gpio_close(&gpio);
    iris_serial_close(&serial);
    return all;
}
