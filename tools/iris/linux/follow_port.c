#include "../follow_port.h"

#include <signal.h>
#include <string.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "../complain.h"
#include "iris/serial.h"

#define RECONNECT_MS 250
#define BLOCKED_MS   1000 /* a port that took nothing for so long is blocked */
#define STOP_MS      500
#define STEP_MS      2

typedef enum { PORT_WORKS, PORT_AWAY, PORT_BLOCKED } port_condition;

/* One per program: a signal must find it. */
static struct {
    iris_serial serial;
    port_condition condition;
    int64_t start_ms;
    int64_t busy_since_ms; /* -1: not busy */
    uint32_t sent;         /* serial.sent when last looked at */
    volatile sig_atomic_t next_seq;
} port;

static int64_t clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static void sleep_ms(int64_t ms)
{
    const struct timespec pause = {(time_t)(ms / 1000), (long)(ms % 1000) * 1000000};
    nanosleep(&pause, NULL);
}

static void change_to(port_condition condition)
{
    if (condition == port.condition) {
        return;
    }
    port.condition = condition;
    switch (condition) {
    case PORT_WORKS:
        complain(port.serial.path, "works again");
        break;
    case PORT_AWAY:
        complain(port.serial.path, "%s; going on without it", iris_serial_error(&port.serial));
        break;
    case PORT_BLOCKED:
        complain(port.serial.path, "blocked, takes no more commands; going on");
        break;
    }
}

/* What the last call says about the port. */
static void judge(iris_status status, int64_t now_ms)
{
    if (status == IRIS_ERR_IO) {
        port.busy_since_ms = -1;
        change_to(PORT_AWAY);
    } else if (status == IRIS_OK || port.serial.sent != port.sent) {
        port.busy_since_ms = -1;
        change_to(PORT_WORKS);
    } else if (port.busy_since_ms < 0) {
        port.busy_since_ms = now_ms;
    } else if (now_ms - port.busy_since_ms > BLOCKED_MS) {
        change_to(PORT_BLOCKED);
    }
    port.sent = port.serial.sent;
}

static size_t format_stop(char sentence[IRIS_COMMAND_SENTENCE_BYTES])
{
    size_t length = 0;
    const iris_command stop = {.seq = (int32_t)port.next_seq, .state = IRIS_LINE_LOST};
    (void)iris_command_format(sentence, IRIS_COMMAND_SENTENCE_BYTES, &length, &stop);
    return length;
}

/* The robot would go on with its last command: what waits is thrown away, and it is told to stop. Then the signal does
 * what it does to every program. Calls nothing that a signal must not. */
static void stop_by_signal(int number)
{
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length = format_stop(sentence);
    if (port.serial.handle >= 0) {
        (void)tcflush(port.serial.handle, TCOFLUSH);
        (void)!write(port.serial.handle, sentence, length);
    }
    (void)raise(number); /* SA_RESETHAND: the default action now */
}

static void catch_signals(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
    struct sigaction action, old;
    memset(&action, 0, sizeof action);
    action.sa_handler = stop_by_signal;
    action.sa_flags = (int)SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL) {
            sigaction(signals[i], &action, NULL);
        }
    }
}

int follow_port_open(const char *path, int32_t baud)
{
    port.start_ms = clock_ms();
    port.busy_since_ms = -1;
    iris_status status = iris_serial_open(&port.serial, path, baud, RECONNECT_MS, (uint32_t)port.start_ms);
    if (status == IRIS_ERR_ARG) {
        complain("--baud", "%d is no usual speed (9600, 19200, 38400, 57600, 115200, ...)", (int)baud);
        return EXIT_BAD_CALL;
    }
    if (status != IRIS_OK) {
        complain(path, "%s", iris_serial_error(&port.serial));
        iris_serial_close(&port.serial);
        return EXIT_BAD_DATA;
    }
    catch_signals();
    return EXIT_DONE;
}

void follow_port_send(const iris_command *command)
{
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length;
    if (iris_command_format(sentence, sizeof sentence, &length, command) == IRIS_OK) {
        port.next_seq = (command->seq + 1) % 10000;
        int64_t now_ms = clock_ms();
        judge(iris_serial_send(&port.serial, sentence, length, (uint32_t)now_ms), now_ms);
    }
}

void follow_port_wait(int64_t ms)
{
    for (int64_t now_ms = clock_ms(); now_ms < port.start_ms + ms; now_ms = clock_ms()) {
        judge(iris_serial_continue(&port.serial, (uint32_t)now_ms), now_ms);
        int64_t rest = port.start_ms + ms - now_ms;
        sleep_ms(rest < STEP_MS ? rest : STEP_MS);
    }
}

int follow_port_stop(void)
{
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length = format_stop(sentence);
    int64_t end_ms = clock_ms() + STOP_MS;
    int64_t now_ms = clock_ms();
    iris_status status = iris_serial_send(&port.serial, sentence, length, (uint32_t)now_ms);
    while (status != IRIS_OK && now_ms < end_ms) {
        sleep_ms(STEP_MS);
        now_ms = clock_ms();
        status = status == IRIS_ERR_FULL ? iris_serial_continue(&port.serial, (uint32_t)now_ms)
                                         : iris_serial_send(&port.serial, sentence, length, (uint32_t)now_ms);
    }
    if (status != IRIS_OK) {
        complain(port.serial.path, "the command to stop was not taken");
    }
    iris_serial_close(&port.serial);
    return status == IRIS_OK ? EXIT_DONE : EXIT_BAD_DATA;
}
