#include "steering_process.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include "../complain.h"
#include "iris/watchdog.h"
#include "steering_lines.h"
#include "steering_link.h"
#include "steering_port.h"

#define REPEAT_MS 100 /* a robot that is stopped is told so again */
#define STEP_MS   2
#define AWAY_MS   10
#define IDLE_MS   50

/* One per process. */
static struct {
    const steering_options *options;
    int link;
    steering_port port;
    steering_lines lines;
    iris_watchdog dog;
    int started;        /* 1: there was a command */
    int halted;         /* 1: to stand still until the next command */
    int has_farewell;   /* 1: the program ends as it should */
    int32_t seq;        /* of the next sentence */
    int64_t opened_ms;  /* when everything was open */
    int64_t stopped_ms; /* when the robot was last told to stop */
    int64_t alive_ms;   /* when the other end was last told that we live */
} robot;

static volatile sig_atomic_t is_told_to_end;

static void end_by_signal(int number)
{
    (void)number;
    is_told_to_end = 1;
}

/* All are counted, those too that no port has taken: the robot sees the gap. */
static int32_t next_number(void)
{
    const int32_t number = robot.seq;
    robot.seq = (robot.seq + 1) % 10000;
    return number;
}

static iris_status send_stop(int64_t now_ms)
{
    const iris_command stop = {.seq = next_number(), .state = IRIS_LINE_LOST};
    robot.stopped_ms = now_ms;
    return steering_port_send(&robot.port, &stop, now_ms);
}

static void take(const steering_message *message)
{
    iris_command command = message->command;
    robot.halted = message->kind == STEERING_HALT;
    if (robot.halted) {
        return;
    }
    robot.started = 1;
    robot.stopped_ms = steering_clock_ms() - REPEAT_MS; /* the next stop is due at once */
    command.seq = next_number();
    iris_watchdog_feed(&robot.dog, (uint32_t)message->time_ms);
    if (iris_watchdog_expired(&robot.dog, (uint32_t)steering_clock_ms())) {
        return; /* it was too long on its way */
    }
    if (robot.options->serial) {
        (void)steering_port_send(&robot.port, &command, steering_clock_ms());
    }
    if (robot.options->line_count > 0) {
        steering_lines_take(&robot.lines, &command);
    }
}

/* Takes the newest message that has come; waits for one at most so long. Returns 0 at the end of the link. */
static int hear(int64_t wait_us, const sigset_t *open_signals)
{
    const struct timespec timeout = {(time_t)(wait_us / 1000000), (long)(wait_us % 1000000) * 1000};
    steering_message message, newest;
    int count = 0;
    ssize_t got;
    fd_set set;
    FD_ZERO(&set);
    FD_SET(robot.link, &set);
    if (pselect(robot.link + 1, &set, NULL, NULL, &timeout, open_signals) < 0 && errno != EINTR) {
        return 0;
    }
    while ((got = recv(robot.link, &message, sizeof message, MSG_DONTWAIT)) > 0) {
        if (got != (ssize_t)sizeof message || message.kind == STEERING_FAREWELL) {
            robot.has_farewell = 1;
        } else {
            if (count > 0 && newest.kind == STEERING_COMMAND) {
                (void)next_number(); /* of one that no robot will see */
            }
            newest = message;
            count++;
        }
    }
    const int is_open = got < 0 && (errno == EAGAIN || errno == EINTR);
    if (count > 0 &&
        (is_open || robot.has_farewell)) { /* the last one of a program that breaks down counts no more */
        take(&newest);
    }
    return is_open && !robot.has_farewell && !is_told_to_end;
}

static void say_alive(int64_t now_ms)
{
    if (now_ms - robot.alive_ms >= STEERING_ALIVE_MS) {
        robot.alive_ms = now_ms;
        (void)send(robot.link, "", 1, MSG_DONTWAIT | MSG_NOSIGNAL);
    }
}

/* The first time is said; how often it was, in the end. */
static void say_expired(void)
{
    static uint32_t said;
    if (robot.dog.expirations > said) {
        if (said == 0) {
            complain("--watchdog", "no command for %d ms: the robot is stopped until the next",
                     (int)robot.options->watchdog_ms);
        }
        said = robot.dog.expirations;
    }
}

/* For how many milliseconds the robot may go on as it does; 0: it has to stand still. */
static int64_t left_ms(int64_t now_ms)
{
    if (robot.halted) {
        return 0;
    }
    if (robot.started) {
        return iris_watchdog_left_ms(&robot.dog, (uint32_t)now_ms);
    }
    const int64_t end_ms = robot.opened_ms + robot.options->watchdog_ms + 1;
    return now_ms < end_ms ? end_ms - now_ms : 0;
}

/* Does all that is due. Returns in how many microseconds something will be. */
static int64_t steer(void)
{
    const int64_t now_us = steering_clock_us(), now_ms = now_us / 1000;
    const int64_t rest_ms = left_ms(now_ms);
    const steering_lines_mode mode = rest_ms == 0 ? LINES_SAFE : robot.started ? LINES_DRIVEN : LINES_INITIAL;
    int64_t wait_us = STEERING_ALIVE_MS * 1000;
    if (robot.options->line_count > 0) { /* lines first: they are the faster */
        wait_us = steering_lines_drive(&robot.lines, mode, now_us);
    }
    if (robot.options->serial) {
        if (mode == LINES_SAFE && now_ms - robot.stopped_ms >= REPEAT_MS) {
            (void)send_stop(now_ms);
        }
        iris_status port = steering_port_continue(&robot.port, now_ms);
        int64_t port_us = (port == IRIS_OK         ? IDLE_MS
                           : port == IRIS_ERR_FULL ? STEP_MS
                                                   : AWAY_MS) *
                          (int64_t)1000;
        wait_us = port_us < wait_us ? port_us : wait_us;
    }
    say_alive(now_ms);
    say_expired();
    if (rest_ms > 0 && rest_ms * 1000 < wait_us) {
        wait_us = rest_ms * 1000;
    }
    return wait_us;
}

/* Lines to safe, and the stop over the port, for half a second at most. Returns 1 when all of it was taken. */
static int stop_robot(void)
{
    const steering_options *options = robot.options;
    const int64_t begin_ms = steering_clock_ms();
    int lines_safe = options->line_count == 0;
    iris_status port = options->serial ? IRIS_ERR_IO : IRIS_OK;
    robot.lines.driven_us = 0; /* asks the chip, whatever it was last told */
    for (int64_t now_ms = begin_ms; now_ms - begin_ms < STEERING_STOP_MS; now_ms = steering_clock_ms()) {
        if (!lines_safe) {
            (void)steering_lines_drive(&robot.lines, LINES_SAFE, now_ms * 1000);
            lines_safe = !robot.lines.is_away;
        }
        if (port != IRIS_OK) { /* what a port that is away gets is lost with it: again */
            port = port == IRIS_ERR_FULL ? steering_port_continue(&robot.port, now_ms) : send_stop(now_ms);
        }
        if (lines_safe && port == IRIS_OK) {
            return 1;
        }
        say_alive(now_ms);
        steering_sleep_ms(STEP_MS);
    }
    if (port != IRIS_OK) {
        complain(options->serial, "the command to stop was not taken");
    }
    if (!lines_safe) {
        complain(options->chip, "the lines were not driven to their safe values");
    }
    return 0;
}

static void close_all(void)
{
    if (robot.options->line_count > 0) {
        steering_sleep_ms(STEERING_HOLD_MS);
        iris_gpio_close(&robot.lines.gpio);
    }
    if (robot.options->serial) {
        iris_serial_close(&robot.port.serial);
    }
}

static int open_all(const steering_options *options)
{
    robot.options = options;
    int exit_code = EXIT_DONE;
    if (options->serial) {
        exit_code = steering_port_open(&robot.port, options->serial, options->baud, steering_clock_ms());
    }
    if (options->line_count > 0 && exit_code == EXIT_DONE) {
        exit_code = steering_lines_open(&robot.lines, options, steering_clock_us());
    }
    return exit_code;
}

/* In a session of its own no terminal's signals reach this process; only SIGTERM means it, and waits until it is listened to. */
static void arrange_signals(sigset_t *open_signals)
{
    static const int ignored[] = {SIGINT, SIGQUIT, SIGHUP, SIGPIPE, SIGTSTP, SIGTTOU, SIGUSR1, SIGUSR2};
    struct sigaction action;
    sigset_t blocked;
    (void)setsid();
    for (size_t i = 0; i < sizeof ignored / sizeof ignored[0]; i++) {
        (void)signal(ignored[i], SIG_IGN);
    }
    memset(&action, 0, sizeof action);
    action.sa_handler = end_by_signal;
    sigemptyset(&action.sa_mask);
    (void)sigaction(SIGTERM, &action, NULL);
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGTERM);
    (void)sigprocmask(SIG_BLOCK, &blocked, open_signals);
    sigdelset(open_signals, SIGTERM);
}

int steering_process_run(const steering_options *options, int link)
{
    sigset_t open_signals;
    arrange_signals(&open_signals);
    (void)prctl(PR_SET_TIMERSLACK, 1000UL); /* ns: pulses end when they have to */
    robot.link = link;
    int exit_code = open_all(options);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    (void)iris_watchdog_init(&robot.dog, options->watchdog_ms);
    robot.opened_ms = steering_clock_ms();
    say_alive(robot.opened_ms);
    while (hear(steer(), &open_signals)) {
    }
    if (!robot.has_farewell) {
        complain(NULL, is_told_to_end ? "told to end: the robot is stopped"
                                      : "ended without a word: the robot is stopped");
    }
    exit_code = stop_robot() && robot.has_farewell ? EXIT_DONE : EXIT_BAD_DATA;
    close_all();
    if (robot.dog.expirations > 1) {
        complain("--watchdog", "the robot was stopped %lu times", (unsigned long)robot.dog.expirations);
    }
    return exit_code;
}
