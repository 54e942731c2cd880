/* push_frames OUT IN FOURCC MS FILE... : pictures of 640x480 gray pixels into the output device OUT of the kernel's virtual
 * driver, whose loop brings them to the camera IN: the first one until SIGUSR1 comes, each other for so many milliseconds, the
 * last one until SIGTERM ends this program. FOURCC: GREY, or YUYV, whose Y is the gray value. Says "ready" when the first
 * picture is on its way, "last" when the last one is. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <time.h>

#include "guest/video_sender.h"
#include "iris/pnm.h"

enum { W = 640, H = 480 };

static uint8_t gray[W * H];
static volatile sig_atomic_t go_on, end;

static void note(int number)
{
    if (number == SIGUSR1) {
        go_on = 1;
    } else {
        end = 1;
    }
}

static ptrdiff_t read_file(void *user, uint8_t *bytes, size_t count)
{
    return (ptrdiff_t)fread(bytes, 1, count, user);
}

static int load(const char *path)
{
    iris_stream stream;
    iris_pnm_reader reader;
    iris_image image;
    FILE *file = fopen(path, "rb");
    int done = file && iris_stream_init(&stream, (iris_source){read_file, file}) == IRIS_OK &&
               iris_pnm_begin(&reader, &stream) == IRIS_OK &&
               iris_image_wrap(&image, gray, sizeof gray, (iris_size){W, H}, 0, IRIS_GRAY8) == IRIS_OK &&
               iris_pnm_read(&image, &reader) == IRIS_OK;
    if (file) {
        (void)fclose(file);
    }
    if (!done) {
        fprintf(stderr, "push_frames: %s: not a PGM or PPM of 640x480 pixels\n", path);
    }
    return done;
}

static void fill(const video_sender *sender, int index, uint32_t fourcc)
{
    for (int y = 0; y < H; y++) {
        uint8_t *row = sender->memory[index][0] + (ptrdiff_t)y * sender->stride[0];
        if (fourcc == V4L2_PIX_FMT_GREY) {
            memcpy(row, gray + y * W, W);
            continue;
        }
        for (int x = 0; x < W; x++) {
            row[2 * x] = gray[y * W + x];
            row[2 * x + 1] = 128;
        }
    }
}

/* Takes a buffer that has been shown, fills it with the picture, and queues it again; waits a little if there is none. */
static void send_again(const video_sender *sender, uint32_t fourcc)
{
    struct v4l2_buffer buffer;
    struct v4l2_plane planes[2];
    sender_describe(&buffer, planes, sender, 0);
    if (ioctl(sender->handle, VIDIOC_DQBUF, &buffer) == 0) {
        fill(sender, (int)buffer.index, fourcc);
        sender_queue(sender, (int)buffer.index);
    } else {
        nanosleep(&(struct timespec){0, 2000000}, NULL);
    }
}

static int64_t clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* Both ends of the cable, without text in the picture. */
static void connect_loop(const char *path)
{
    int handle = open(path, O_RDWR | O_NONBLOCK);
    assert_true(handle >= 0);
    set_video_timings(handle, 0);
    set_video_control(handle, VIVID_TEXT, 2);
    set_video_control(handle, VIVID_LOOP, 1);
    close(handle);
}

static void say(const char *word)
{
    puts(word);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    video_sender sender;
    if (argc < 6 || strlen(argv[3]) != 4 || !load(argv[5])) {
        fprintf(stderr, "usage: push_frames OUT IN GREY|YUYV MS FILE...\n");
        return 2;
    }
    const char *name = argv[3];
    uint32_t fourcc = v4l2_fourcc(name[0], name[1], name[2], name[3]);
    long hold_ms = strtol(argv[4], NULL, 10);
    (void)signal(SIGUSR1, note);
    (void)signal(SIGTERM, note);
    connect_loop(argv[2]);
    sender_open(&sender, argv[1], fourcc, W, H);
    for (int i = 0; i < SENDER_PICTURES; i++) {
        fill(&sender, i, fourcc);
    }
    sender_start(&sender);
    say("ready");
    while (!go_on && !end) {
        send_again(&sender, fourcc);
    }
    for (int i = 6; i < argc && !end; i++) {
        if (!load(argv[i])) {
            return 2;
        }
        for (int64_t end_ms = clock_ms() + hold_ms; clock_ms() < end_ms && !end;) {
            send_again(&sender, fourcc);
        }
    }
    say("last");
    while (!end) {
        send_again(&sender, fourcc);
    }
    return 0;
}
