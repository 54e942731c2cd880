#include "../steering.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../complain.h"
#include "steering_link.h"
#include "steering_process.h"
#include "steering_rescue.h"
#include "steering_say.h"

#define OPEN_MS 5000
#define STEP_MS 2

/* A steering process that says nothing for the watchdog's time hangs; at least and at most so long. */
#define SILENT_LEAST_MS 500
#define SILENT_MOST_MS  2000

enum { NOT_OPEN, RUNNING, STOPPING, GONE };

/* One per program: a signal must find it. */
static struct {
    const steering_options *options;
    int link;
    pid_t process;
    pthread_t guard;
    int64_t start_ms;
    int condition; /* changed by change_from alone */
} steering;

/* Of the guard, the main thread, and a signal, only one gets its way. */
static int change_from(int from, int to)
{
    return __atomic_compare_exchange_n(&steering.condition, &from, to, 0, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
}

/* Waits for the process to end. Returns 0 if it has not, else 1 with its wait status. */
static int has_ended(int *wait_status, int64_t within_ms)
{
    const int64_t begin_ms = steering_clock_ms();
    pid_t ended;
    while ((ended = waitpid(steering.process, wait_status, WNOHANG)) == 0 || (ended < 0 && errno == EINTR)) {
        if (steering_clock_ms() - begin_ms >= within_ms) {
            return 0;
        }
        steering_sleep_ms(STEP_MS);
    }
    return ended == steering.process;
}

/* The process has ended unasked, or hangs. */
static void stop_without_it(void)
{
    int wait_status;
    (void)kill(steering.process, SIGKILL);
    (void)has_ended(&wait_status, STEERING_STOP_MS); /* so that its lines are free */
    int done = steering_rescue(steering.options);
    steering_say(NULL,
                 done ? "the steering process is gone: the robot was stopped without it"
                      : "the steering process is gone: the robot was NOT stopped, not all of it was reached");
}

/* A thread of its own, so that it sees the process go whatever the rest of the program hangs in. */
static void *keep_watch(void *nothing)
{
    char bytes[64];
    int32_t most_ms =
        steering.options->watchdog_ms < SILENT_MOST_MS ? steering.options->watchdog_ms : SILENT_MOST_MS;
    most_ms = most_ms > SILENT_LEAST_MS ? most_ms : SILENT_LEAST_MS;
    /* Counted in turns, not by the clock: while the whole machine stalls, that process can say nothing. */
    for (int32_t silent_ms = 0; silent_ms < most_ms;) {
        struct pollfd link = {steering.link, POLLIN, 0};
        int ready = poll(&link, 1, STEERING_ALIVE_MS);
        if (ready < 0 && errno == EINTR) {
            continue;
        }
        if (ready == 0) {
            silent_ms += STEERING_ALIVE_MS;
            continue;
        }
        if (ready > 0 && recv(steering.link, bytes, sizeof bytes, MSG_DONTWAIT) > 0) {
            silent_ms = 0;
            continue;
        }
        if (ready > 0 && (link.revents & (POLLHUP | POLLERR)) == 0 && errno == EAGAIN) {
            continue; /* somebody else has read it */
        }
        break;
    }
    if (change_from(RUNNING, GONE)) {
        stop_without_it();
        _exit(EXIT_BAD_DATA);
    }
    return nothing;
}

/* When it is not taken, the guard finds out why. Calls nothing that a signal must not. */
static void send_message(steering_kind kind, const iris_command *command)
{
    steering_message message;
    memset(&message, 0, sizeof message);
    message.kind = kind;
    message.time_ms = steering_clock_ms();
    if (command) {
        message.command = *command;
    }
    (void)send(steering.link, &message, sizeof message, MSG_DONTWAIT | MSG_NOSIGNAL);
}

/* Asks the process to stop the robot and to end. Calls nothing that a signal must not. */
static void say_farewell(void)
{
    send_message(STEERING_FAREWELL, NULL);
    (void)shutdown(steering.link, SHUT_WR);
}

/* The robot would go on with its last command: it is stopped, and then the signal does what it does to every program. Calls
 * nothing that a signal must not. */
static void stop_by_signal(int number)
{
    static const char unanswered[] =
        "iris follow: the steering process does not answer; the robot may move\n";
    const int error = errno;
    if (change_from(RUNNING, STOPPING)) {
        char bytes[64];
        struct timespec pause = {0, STEP_MS * 1000000};
        int turns = STEERING_STOP_MOST_MS / STEP_MS;
        say_farewell();
        ssize_t got = -1;
        while (turns > 0 && got != 0) {
            errno = 0;
            got = recv(steering.link, bytes, sizeof bytes, MSG_DONTWAIT);
            if (got < 0 && errno != EAGAIN && errno != EINTR) {
                break;
            }
            if (got < 0) {
                (void)nanosleep(&pause, NULL);
                turns--;
            }
        }
        if (turns == 0) {
            steering_say_bytes(unanswered, sizeof unanswered - 1);
        }
    }
    errno = error;
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

/* In the child. What waits for the end of this program's input and output does not wait for the robot to stop. */
static void become_the_process(int link, pid_t parent)
{
    complain_to(steering_say);
    /* Halted, it could not stop the robot of a program that is killed. */
    (void)prctl(PR_SET_PDEATHSIG, SIGCONT);
    if (getppid() != parent) {
        _exit(EXIT_BAD_DATA);
    }
    FILE *nowhere = freopen("/dev/null", "r", stdin);
    nowhere = freopen("/dev/null", "w", stdout) ? nowhere : NULL;
    int exit_code = nowhere ? steering_process_run(steering.options, link) : EXIT_BAD_DATA;
    _exit(exit_code);
}

/* Waits until all is open. Returns an exit code; the process has complained. */
static int await_ready(void)
{
    char byte;
    int wait_status;
    struct pollfd link = {steering.link, POLLIN, 0};
    const int ready = poll(&link, 1, OPEN_MS);
    if (ready == 1 && recv(steering.link, &byte, 1, MSG_DONTWAIT) == 1) {
        return EXIT_DONE;
    }
    if (ready == 0) {
        complain(NULL, "the steering process does not open its devices");
        (void)kill(steering.process, SIGKILL);
    }
    if (has_ended(&wait_status, STEERING_STOP_MS) && WIFEXITED(wait_status) &&
        WEXITSTATUS(wait_status) != EXIT_DONE) {
        return WEXITSTATUS(wait_status);
    }
    return EXIT_BAD_DATA;
}

/* The guard gets no signals: they are for the main thread. */
static int start_guard(void)
{
    sigset_t all, before;
    sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before);
    const int error = pthread_create(&steering.guard, NULL, keep_watch, NULL);
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    return error;
}

int steering_open(const steering_options *options)
{
    int links[2];
    const pid_t self = getpid();
    steering.options = options;
    fflush(stdout); /* or both would write it */
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, links) != 0 ||
        (steering.process = fork()) < 0) {
        complain(NULL, "no steering process: %s", strerror(errno));
        return EXIT_BAD_DATA;
    }
    if (steering.process == 0) {
        close(links[0]);
        become_the_process(links[1], self);
    }
    close(links[1]);
    steering.link = links[0];
    const int exit_code = await_ready();
    if (exit_code != EXIT_DONE) {
        close(steering.link);
        return exit_code;
    }
    steering.start_ms = steering_clock_ms();
    steering.condition = RUNNING;
    catch_signals();
    const int error = start_guard();
    if (error != 0) {
        complain(NULL, "no thread to watch the steering process: %s", strerror(error));
        (void)change_from(RUNNING, STOPPING);
        say_farewell();
        return EXIT_BAD_DATA;
    }
    return EXIT_DONE;
}

void steering_send(const iris_command *command)
{
    send_message(STEERING_COMMAND, command);
}

void steering_halt(void)
{
    send_message(STEERING_HALT, NULL);
}

void steering_wait(int64_t ms)
{
    for (int64_t now_ms = steering_clock_ms(); now_ms < steering.start_ms + ms;
         now_ms = steering_clock_ms()) {
        steering_sleep_ms((int32_t)(steering.start_ms + ms - now_ms));
    }
}

int steering_stop(void)
{
    int wait_status;
    while (!change_from(RUNNING, STOPPING)) {
        (void)pause(); /* the guard is about to end the program */
    }
    say_farewell();
    const int ended = has_ended(&wait_status, STEERING_STOP_MOST_MS);
    if (!ended || !WIFEXITED(wait_status)) {
        stop_without_it();
        return EXIT_BAD_DATA;
    }
    (void)pthread_join(steering.guard, NULL);
    close(steering.link);
    return WEXITSTATUS(wait_status);
}
