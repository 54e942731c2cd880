/* `iris follow --gpio` against the kernel's own lines: what they say during a drive, and that they are safe within the stated time
 * however it ends. Frames come over standard input, one by one; levels are read back from gpio-sim. Every line is pulled to the
 * contrary of its safe level, so that a line that was only let go is not taken for one that was driven. */
#include "rig.h"
#include "rig/guest/gpio_sim.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

enum { LEFT = 1, RIGHT = 2, STOP = 5, HEARTBEAT = 6, WATCHDOG_MS = 300 };
/* A machine that is emulated, and has other things to do, needs some time of its own; sanitizers need more. */
#ifdef IRIS_CHECKED
enum { MARGIN_MS = 3000, TURNS = 1, SEEN_US = 300000, LOOK_US = 9000, DUTY_OFF = 150 };
#else
enum { MARGIN_MS = 1000, TURNS = 3, SEEN_US = 800000, LOOK_US = 9000, DUTY_OFF = 100 };
#endif
enum { GAP_MS = 20, HOLD_MS = 100, MOST_TURNS = 5 }; /* lines are held safe for that long */
enum { SLOW_MS = 60000, FRAME_BYTES = 14 + 64 * 48 };

#define LINES    GPIO_SIM_LABEL ":left=1,right=2:active-low,stop=5,heartbeat=6"
#define MOTORS   GPIO_SIM_LABEL ":left-pwm=1,left-dir=2,right-pwm=5,right-dir=6"
#define WATCHDOG "300ms"

static char sysfs[128];
static struct {
    pid_t pid;
    int in, out; /* frames to it, answers from it */
} tool;

static int64_t clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static void sleep_ms(int64_t ms)
{
    nanosleep(&(struct timespec){(time_t)(ms / 1000), (long)(ms % 1000) * 1000000}, NULL);
}

static int make(void **state)
{
    (void)state;
    if (!getenv("RIG_GPIO") || !*getenv("RIG_GPIO")) {
        return 0; /* the tests skip */
    }
    gpio_sim_make(sysfs);
    (void)signal(SIGPIPE, SIG_IGN);
    (void)setpriority(PRIO_PROCESS, 0, -10); /* levels that last for moments are seen */
    return 0;
}

static int unmake(void **state)
{
    (void)state;
    if (sysfs[0]) {
        gpio_sim_remove();
    }
    return 0;
}

static int kill_rest(void **state)
{
    (void)state;
    if (tool.pid > 0) {
        kill(tool.pid, SIGKILL);
        waitpid(tool.pid, NULL, 0);
        close(tool.in);
        close(tool.out);
    }
    tool.pid = 0;
    return 0;
}

static void pull(int left, int right, int stop, int heartbeat)
{
    gpio_sim_pull(sysfs, LEFT, left);
    gpio_sim_pull(sysfs, RIGHT, right);
    gpio_sim_pull(sysfs, STOP, stop);
    gpio_sim_pull(sysfs, HEARTBEAT, heartbeat);
}

/* iris follow --json --watchdog WATCHDOG --gpio LINES MORE... - ; its complaints are in /tmp/err. */
static void start(const char *lines, const char *watchdog, const char *const *more)
{
    const char *words[16] = {"iris", "follow", "--json", "--watchdog", watchdog, "--gpio", lines};
    size_t count = 7;
    for (size_t i = 0; more && more[i] && i < 6; i++) {
        words[count++] = more[i];
    }
    words[count] = "-";
    int in[2], out[2];
    const char *iris = getenv("IRIS");
    (void)rig_node("RIG_GPIO");
    assert_int_equal(pipe(in), 0);
    assert_int_equal(pipe(out), 0);
    fcntl(in[1], F_SETFD, FD_CLOEXEC);
    fcntl(out[0], F_SETFD, FD_CLOEXEC);
    tool.pid = fork();
    if (tool.pid == 0) {
        int err = open("/tmp/err", O_WRONLY | O_CREAT | O_TRUNC, 0644);
        dup2(in[0], 0);
        dup2(out[1], 1);
        dup2(err, 2);
        close(in[0]);
        close(out[1]);
        (void)signal(SIGPIPE, SIG_DFL);
        (void)setpriority(PRIO_PROCESS, 0, 0);
        execv(iris ? iris : "/bin/iris", (char *const *)words);
        _exit(127);
    }
    close(in[0]);
    close(out[1]);
    tool.in = in[1];
    tool.out = out[0];
}

/* A frame whose line is 8 pixels wide, its left side at column `left`; 100: none. */
static void send_frame(int left)
{
    char frame[FRAME_BYTES + 1];
    strcpy(frame, "P5 64 48 255\n");
    size_t at = strlen(frame);
    for (int i = 0; i < 64 * 48; i++) {
        frame[at++] = i % 64 >= left && i % 64 < left + 8 ? ' ' : '~';
    }
    assert_int_equal(write(tool.in, frame, at), at);
}

/* The answer to a frame: steering and speed in permil. */
static void read_answer(int *steer, int *speed)
{
    char line[4096] = "";
    size_t length = 0;
    while (length == 0 || line[length - 1] != '\n') {
        struct pollfd out = {tool.out, POLLIN, 0};
        assert_int_equal(poll(&out, 1, SLOW_MS), 1);
        const ssize_t got = read(tool.out, line + length, sizeof line - 1 - length);
        assert_true(got > 0);
        length += (size_t)got;
    }
    line[length] = '\0';
    const char *steer_at = strstr(line, "\"steer\":"), *speed_at = strstr(line, "\"speed\":");
    assert_non_null(steer_at);
    assert_non_null(speed_at);
    *steer = (int)(strtod(steer_at + 8, NULL) * 1000);
    *speed = (int)(strtod(speed_at + 8, NULL) * 1000);
}

/* Levels of left, right, stop, and heartbeat. */
static int levels(void)
{
    return gpio_sim_level(sysfs, LEFT) | gpio_sim_level(sysfs, RIGHT) << 1 |
           gpio_sim_level(sysfs, STOP) << 2 | gpio_sim_level(sysfs, HEARTBEAT) << 3;
}

enum { SAFE_LEVELS = 2 | 4 };

/* The longest time between two looks of time_until. */
static int64_t longest_ms;

/* Waits for these levels. Returns after how many milliseconds; -1: not within `most`. Of a time in which the machine did not let
 * us look, nobody knows what the lines said: little of it counts. */
static int64_t time_until(int wanted, int mask, int64_t most)
{
    int64_t before = clock_ms(), took = 0;
    longest_ms = 0;
    while ((levels() & mask) != wanted) {
        sleep_ms(1);
        const int64_t now = clock_ms(), gap = now - before;
        longest_ms = gap > longest_ms ? gap : longest_ms;
        took += gap < GAP_MS ? gap : GAP_MS;
        before = now;
        if (took > most) {
            return -1;
        }
    }
    return took;
}

static void assert_within(const char *what, int64_t took, int64_t most)
{
    print_message("# %s: %d ms\n", what, (int)took);
    assert_true(took >= 0 && took <= most);
}

static int complains_now(const char *text)
{
    char all[4096];
    FILE *file = fopen("/tmp/err", "r");
    assert_non_null(file);
    all[fread(all, 1, sizeof all - 1, file)] = '\0';
    fclose(file);
    return strstr(all, text) != NULL;
}

/* At once, or a moment after what it tells of. */
static int has_complaint(const char *text)
{
    const int64_t end = clock_ms() + 5000;
    while (!complains_now(text) && clock_ms() < end) {
        sleep_ms(5);
    }
    return complains_now(text);
}

/* The exit status, or minus the signal. */
static int wait_end(void)
{
    int status = 0;
    const int64_t end = clock_ms() + SLOW_MS;
    while (waitpid(tool.pid, &status, WNOHANG) == 0) {
        assert_true(clock_ms() < end);
        sleep_ms(2);
    }
    tool.pid = 0;
    close(tool.in);
    close(tool.out);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/* The steering process: the one whose parent is the tool. */
static pid_t steering_process(void)
{
    char path[64], line[64];
    snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)tool.pid, (int)tool.pid);
    gpio_sim_read(line, sizeof line, path);
    return (pid_t)strtol(line, NULL, 10);
}

/* Sends frames until left, right, and stop say so. Returns when the first one was sent that turned to that side. */
static int64_t drive(int place, int wanted)
{
    int steer, speed;
    const int64_t begin = clock_ms();
    int64_t first = -1;
    do {
        const int64_t sent = clock_ms();
        send_frame(place);
        read_answer(&steer, &speed);
        assert_true(sent - begin < SLOW_MS);
        first = first < 0 && (place > 28 ? steer >= 100 : steer <= -100) ? sent : first;
    } while (time_until(wanted, 1 | 2 | 4, 50) < 0);
    return first;
}

/* Drives with the line on the right, with all lines pulled to the contrary of safe. */
static void drive_right(void)
{
    start(LINES, WATCHDOG, NULL);
    pull(1, 0, 0, 1);
    (void)drive(40, 0); /* right is active low */
}

/* The lines are safe within `most`, and for as long as they are held. 0: that was missed, since the machine stalled. */
static int saw_safe(const char *what, int64_t most)
{
    const int64_t took = time_until(SAFE_LEVELS, 15, most);
    if (took < 0 && longest_ms >= HOLD_MS / 2) {
        print_message("# %s: stalled for %d ms, once more\n", what, (int)longest_ms);
        return 0;
    }
    assert_within(what, took, most);
    return 1;
}

static void lines_say_what_commands_say(void **state)
{
    (void)state;
    static const int places[] = {28, 40, 40, 16, 28, 16, 100, 40, 28, 28};
    int steer, speed, beat = 0;
    start(LINES, "10s", NULL);
    assert_true(time_until(SAFE_LEVELS, 15, SLOW_MS) >= 0); /* the initial values */
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        send_frame(places[i]);
        read_answer(&steer, &speed);
        beat = !beat;
        int wanted = (steer <= -100 && speed > 0) | (steer >= 100 && speed > 0 ? 0 : 2) | (speed == 0) << 2 |
                     beat << 3;
        assert_true(steer <= -100 || steer >= 100 ||
                    (steer > -50 && steer < 50)); /* not where lines remember */
        assert_true(time_until(wanted, 15, SLOW_MS) >= 0);
    }
    close(tool.in);
    assert_within("end of frames to safe", time_until(SAFE_LEVELS, 15, 1000), 1000);
    assert_int_equal(wait_end(), 0);
}

/* Found, held, searched for, and given up: the robot stands with the program still there. */
static void a_line_that_is_lost_stops_the_robot(void **state)
{
    (void)state;
    int steer, speed = 1;
    start(LINES, "10s", (const char *[]){"--rate", "2", NULL});
    send_frame(40);
    read_answer(&steer, &speed);
    assert_true(time_until(0, 4, SLOW_MS) >= 0);
    for (int i = 0; i < 12 && speed > 0; i++) {
        send_frame(100);
        read_answer(&steer, &speed);
    }
    assert_int_equal(speed, 0);
    assert_within("lost to stop", time_until(2 | 4, 1 | 2 | 4, MARGIN_MS), MARGIN_MS);
    close(tool.in);
    assert_int_equal(wait_end(), 0);
}

static void signals_stop_the_robot_first(void **state)
{
    (void)state;
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < TURNS; i++) {
        int seen = 0;
        for (int turn = 0; turn < MOST_TURNS && !seen; turn++) {
            drive_right();
            kill(tool.pid, signals[i]);
            seen = saw_safe("signal to safe", MARGIN_MS);
            assert_int_equal(wait_end(), -signals[i]);
        }
        assert_true(seen);
    }
}

static void a_killed_program_is_a_stopped_robot(void **state)
{
    (void)state;
    static const int signals[] = {SIGKILL, SIGABRT, SIGQUIT};
    for (size_t i = 0; i < TURNS; i++) {
        int seen = 0;
        for (int turn = 0; turn < MOST_TURNS && !seen; turn++) {
            drive_right();
            kill(tool.pid, signals[i]);
            /* at once, and at the watchdog's time if the system takes longer to end a program */
            seen = saw_safe("killed to safe", WATCHDOG_MS + MARGIN_MS);
            assert_int_equal(wait_end(), -signals[i]);
        }
        assert_true(seen);
        for (int wait = 0; wait < 100 && levels() == SAFE_LEVELS; wait++) {
            sleep_ms(20);
        }
        assert_true(has_complaint("ended without a word: the robot is stopped"));
    }
}

static void a_program_that_hangs_is_a_stopped_robot(void **state)
{
    (void)state;
    drive_right();
    const int64_t first = drive(16, 1 | 2); /* to the left: no command before that one is meant */
    kill(tool.pid, SIGSTOP);
    assert_within("lines to safe, of 300", time_until(SAFE_LEVELS, 15, WATCHDOG_MS + MARGIN_MS),
                  WATCHDOG_MS + MARGIN_MS);
    assert_true(first >= 0 && clock_ms() - first >= WATCHDOG_MS); /* not before its time */
    kill(tool.pid, SIGCONT);
    sleep_ms(100);
    assert_int_equal(levels(), SAFE_LEVELS); /* until there is a command */
    (void)drive(40, 0);
    assert_true(has_complaint("--watchdog: no command for 300 ms: the robot is stopped"));
    /* and the same when frames stay away */
    assert_within("last frame to safe, of 300", time_until(SAFE_LEVELS, 15, WATCHDOG_MS + MARGIN_MS),
                  WATCHDOG_MS + MARGIN_MS);
    close(tool.in);
    assert_int_equal(wait_end(), 0);
    assert_true(has_complaint("--watchdog: the robot was stopped "));
}

/* None has a value by itself here: safe and default differ. */
#define OTHERS GPIO_SIM_LABEL ":left=1:safe=1:initial=0,right=2:active-low,stop=5:safe=0,heartbeat=6"
enum { OTHERS_SAFE = 1 | 2 };

static void without_a_first_frame_the_lines_are_safe(void **state)
{
    (void)state;
    start(OTHERS, WATCHDOG, NULL);
    pull(0, 0, 1, 1);
    assert_true(time_until(OTHERS_SAFE, 15, SLOW_MS / 4) >= 0);
    (void)drive(40, 0);
    close(tool.in);
    assert_int_equal(wait_end(), 0);
}

/* Long before the watchdog's time; and the heartbeat says so, too. */
static void a_camera_without_frames_is_a_stopped_robot(void **state)
{
    (void)state;
    start(OTHERS, "60s", (const char *[]){"--camera", NULL});
    pull(0, 0, 1, 1);
    (void)drive(40, 0);
    assert_within("last frame to safe, of 250 to 350", time_until(OTHERS_SAFE, 15, 350 + 2 * MARGIN_MS),
                  350 + 2 * MARGIN_MS);
    for (int i = 0; i < 30; i++) {
        assert_int_equal(levels(), OTHERS_SAFE);
        sleep_ms(15);
    }
    (void)drive(40, 0);
    close(tool.in);
    assert_int_equal(wait_end(), 0);
}

static void without_its_steering_process_the_program_stops_the_robot(void **state)
{
    (void)state;
    drive_right();
    kill(steering_process(), SIGKILL);
    assert_within("steering process killed to safe", time_until(SAFE_LEVELS, 15, 2 * MARGIN_MS),
                  2 * MARGIN_MS);
    assert_int_equal(wait_end(), 1);
    assert_true(has_complaint("the steering process is gone: the robot was stopped without it"));
    drive_right();
    kill(steering_process(), SIGSTOP); /* it hangs: half a second is stated */
    assert_within("steering process halted to safe", time_until(SAFE_LEVELS, 15, 500 + 2 * MARGIN_MS),
                  500 + 2 * MARGIN_MS);
    assert_int_equal(wait_end(), 1);
    if (TURNS == 1) {
        return;
    }
    drive_right();
    kill(steering_process(), SIGTERM);
    assert_within("steering process told to end", time_until(SAFE_LEVELS, 15, MARGIN_MS), MARGIN_MS);
    assert_int_equal(wait_end(), 1);
}

static void a_chip_that_comes_back_is_driven_again(void **state)
{
    (void)state;
    int steer, speed;
    drive_right();
    gpio_sim_remove();
    const int64_t begin = clock_ms();
    do {
        send_frame(40);
        read_answer(&steer, &speed);
        sleep_ms(20);
    } while (!complains_now(GPIO_SIM_LABEL ": the GPIO chip is gone; going on without it") &&
             clock_ms() - begin < SLOW_MS);
    gpio_sim_make(sysfs);
    gpio_sim_pull(sysfs, STOP, 1);
    do {
        send_frame(16);
        read_answer(&steer, &speed);
    } while (time_until(1 | 2, 7, 50) < 0 && clock_ms() - begin < SLOW_MS); /* left, not right, no stop */
    assert_int_equal(levels() & 7, 1 | 2);
    assert_true(has_complaint(GPIO_SIM_LABEL ": works again"));
    close(tool.in);
    assert_int_equal(wait_end(), 0);
    /* gone at the end, too: that cannot be a good one */
    drive_right();
    gpio_sim_remove();
    close(tool.in);
    assert_int_equal(wait_end(), 1);
    assert_true(has_complaint("the lines were not driven to their safe values"));
    gpio_sim_make(sysfs);
}

/* A port that is unplugged does not stop what is steered by lines, nor the other way round. */
static void a_port_unplugged_beside_the_lines(void **state)
{
    (void)state;
    int steer, speed, beats = 0;
    const char *port = rig_node("RIG_USB_SERIAL");
    start(LINES, "10s", (const char *[]){"--serial", port, NULL});
    send_frame(40);
    read_answer(&steer, &speed);
    assert_true(time_until(8, 15, SLOW_MS) >= 0); /* right, with its heartbeat */
    rig("unplug");
    const int64_t begin = clock_ms();
    do {
        send_frame(40);
        read_answer(&steer, &speed);
        beats = !beats;
        assert_true(time_until(beats ? 0 : 8, 15, SLOW_MS) >= 0);
    } while (!complains_now("going on without it") && clock_ms() - begin < SLOW_MS);
    assert_true(has_complaint("going on without it"));
    rig("plug");
    do {
        send_frame(16);
        read_answer(&steer, &speed);
    } while (!complains_now("works again") && clock_ms() - begin < SLOW_MS);
    assert_true(has_complaint("works again"));
    assert_true(time_until(3, 7, SLOW_MS) >= 0);
    close(tool.in);
    assert_int_equal(wait_end(), 0);
}

static void what_cannot_be_had_is_said(void **state)
{
    (void)state;
    drive_right();
    const pid_t first = tool.pid;
    const int in = tool.in, out = tool.out;
    start(LINES, WATCHDOG, NULL);
    assert_int_equal(wait_end(), 1);
    assert_true(has_complaint("iris follow: " GPIO_SIM_LABEL ": line 1 is in use by 'iris'\n"));
    start(GPIO_SIM_LABEL ":stop=8", WATCHDOG, NULL);
    assert_int_equal(wait_end(), 1);
    assert_true(has_complaint("line 8: the chip has lines 0 to 7\n"));
    start("no-such-chip:stop=1", WATCHDOG, NULL);
    assert_int_equal(wait_end(), 1);
    assert_true(has_complaint("no-such-chip: no such GPIO chip\n"));
    tool.pid = first;
    tool.in = in;
    tool.out = out;
    close(tool.in);
    assert_int_equal(wait_end(), 0);
}

static int64_t clock_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

/* Sends frames, and looks at both motors meanwhile, for so long: permil of the time in which their pulses are on. What lies
 * between two looks that are too far from each other does not count: the machine stalled, or a frame was sent. */
static void sample(int *left, int *right, int *steer, int *speed, int64_t most_us)
{
    int64_t next = 0, left_us = 0, right_us = 0, seen_us = 1, before = 0; /* never 0 */
    const int64_t end = clock_ms() + SLOW_MS;
    int left_on = 0, right_on = 0;
    while (seen_us < most_us) {
        assert_true(clock_ms() < end);
        if (clock_ms() >= next) {
            send_frame(34);
            read_answer(steer, speed);
            next = clock_ms() + 30;
            before = 0;
        }
        const int64_t now = clock_us(), gap = now - before;
        if (gap <= LOOK_US) {
            seen_us += gap;
            left_us += left_on ? gap : 0;
            right_us += right_on ? gap : 0;
        }
        left_on = gpio_sim_level(sysfs, 1);
        right_on = gpio_sim_level(sysfs, 5);
        before = now;
    }
    *left = (int)(left_us * 1000 / seen_us);
    *right = (int)(right_us * 1000 / seen_us);
    print_message("# in %d ms: left %d, right %d permil; speed %d, steer %d\n", (int)(seen_us / 1000), *left,
                  *right, *speed, *steer);
}

static void pulses_are_as_long_as_wheels_are_fast(void **state)
{
    (void)state;
    int left, right, steer, speed;
    (void)setpriority(PRIO_PROCESS, 0, 5); /* who looks all the time must not keep the pulses from changing */
    start(MOTORS, "20s", NULL);
    sample(&left, &right, &steer, &speed, SEEN_US / 8); /* the controller settles */
    sample(&left, &right, &steer, &speed, SEEN_US);
    assert_true(steer > 20 && speed > 100);
    assert_in_range(left, speed + speed * steer / 1000 - DUTY_OFF, speed + speed * steer / 1000 + DUTY_OFF);
    assert_in_range(right, speed - speed * steer / 1000 - DUTY_OFF, speed - speed * steer / 1000 + DUTY_OFF);
    assert_int_equal(gpio_sim_level(sysfs, 2), 0);
    assert_int_equal(gpio_sim_level(sysfs, 6), 0);
    pull(1, 1, 1, 1);
    kill(tool.pid, SIGKILL);
    assert_true(time_until(0, 15, SLOW_MS) >= 0);
    assert_int_equal(wait_end(), -SIGKILL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(lines_say_what_commands_say, kill_rest),
        cmocka_unit_test_teardown(a_line_that_is_lost_stops_the_robot, kill_rest),
        cmocka_unit_test_teardown(signals_stop_the_robot_first, kill_rest),
        cmocka_unit_test_teardown(a_killed_program_is_a_stopped_robot, kill_rest),
        cmocka_unit_test_teardown(a_program_that_hangs_is_a_stopped_robot, kill_rest),
        cmocka_unit_test_teardown(without_a_first_frame_the_lines_are_safe, kill_rest),
        cmocka_unit_test_teardown(a_camera_without_frames_is_a_stopped_robot, kill_rest),
        cmocka_unit_test_teardown(without_its_steering_process_the_program_stops_the_robot, kill_rest),
        cmocka_unit_test_teardown(a_chip_that_comes_back_is_driven_again, kill_rest),
        cmocka_unit_test_teardown(a_port_unplugged_beside_the_lines, kill_rest),
        cmocka_unit_test_teardown(what_cannot_be_had_is_said, kill_rest),
        cmocka_unit_test_teardown(pulses_are_as_long_as_wheels_are_fast, kill_rest),
    };
    return cmocka_run_group_tests_name("gpio_follow", tests, make, unmake);
}
