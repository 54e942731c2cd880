/* A line follower for a microcontroller: gray rows of 160x120 as they arrive from the sensor, a sentence for the motor
 * controller after each frame. No frame buffer, and all memory is static.
 *
 * To start from: write the four hooks for your board, put this file into your firmware as it is, and link with IRIS-Lite
 * (README, "On a microcontroller"). On a computer the hooks are those at the end, and print what a robot would be sent. */
#include "iris/command.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"

enum { W = 160, H = 120 };

/* --- hooks: what the board knows --- */

/* Waits for the sensor to begin a frame. 1: it has; 0: there will be no more, which ends main. */
int sensor_frame(void);

/* Waits for row y of the frame, 0 (the top) to H - 1, and puts its W gray pixels where told: 4-byte aligned,
 * so that it may be where a DMA transfer has put them. */
void sensor_row(uint8_t *pixels, int32_t y);

/* Any clock; it may wrap. */
uint32_t board_milliseconds(void);

/* Sends bytes to the motor controller. They stay as they are until the next frame has been seen. */
void uart_send(const char *bytes, size_t count);

/* --- the follower --- */

static IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_SCRATCH_BYTES(W, H));
static iris_follow follow;
static iris_follow_result line;
static iris_steer steer;
static iris_command command;
static union {
    uint8_t pixels[W];
    uint32_t aligned;
} row;
static char sentence[IRIS_COMMAND_SENTENCE_BYTES];

static iris_status start(void)
{
    iris_scratch scratch;
    iris_status status = iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (status == IRIS_OK) {
        status = iris_follow_init(&follow, (iris_size){W, H}, NULL, &scratch);
    }
    return status == IRIS_OK ? iris_steer_init(&steer, NULL) : status;
}

/* One frame, from its first row to the sentence. */
static iris_status see(uint32_t now_ms, uint32_t elapsed_ms)
{
    size_t length;
    (void)iris_follow_begin(&follow);
    for (int32_t y = 0; y < H; y++) {
        sensor_row(row.pixels, y);
        (void)iris_follow_row(&follow, row.pixels);
    }
    iris_status status = iris_follow_end(&line, &follow, now_ms);
    if (status == IRIS_OK) {
        status = iris_steer_update(&command, &steer, &line, (int32_t)elapsed_ms);
    }
    if (status == IRIS_OK) {
        status = iris_command_format(sentence, sizeof sentence, &length, &command);
    }
    if (status == IRIS_OK) {
        uart_send(sentence, length);
    }
    return status;
}

int main(void)
{
    uint32_t last_ms = board_milliseconds();
    iris_status status = start();
    while (status == IRIS_OK && sensor_frame()) {
        uint32_t now_ms = board_milliseconds();
        status = see(now_ms, now_ms - last_ms);
        last_ms = now_ms;
    }
    return status != IRIS_OK;
}

/* --- on a computer: a dark tape that wanders from frame to frame, 30 frames per second --- */
#if defined(__unix__) || defined(_WIN32) || defined(__APPLE__)
#include <stdio.h>

static int frame;

int sensor_frame(void)
{
    return frame++ < 8;
}

void sensor_row(uint8_t *pixels, int32_t y)
{
    int from = 18 + 12 * frame + (int)(H - y) / 8;
    for (int x = 0; x < W; x++) {
        pixels[x] = (uint8_t)(x >= from && x < from + 14 ? 35 : 190);
    }
}

uint32_t board_milliseconds(void)
{
    return (uint32_t)frame * 33;
}

void uart_send(const char *bytes, size_t count)
{
    (void)fwrite(bytes, 1, count, stdout);
}
#endif
