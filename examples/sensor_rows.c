/* Rows as they arrive from a sensor: no frame buffer, a sentence per frame for the motor controller. */
#include <stdio.h>

#include "iris/command.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"

enum { W = 160, H = 120 };

static IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_SCRATCH_BYTES(W, H));
static iris_follow follow;
static iris_steer steer;

/* Stands for a DMA transfer of one line: a tape that wanders from frame to frame. */
static void sensor(uint8_t *row, int y, int frame)
{
    for (int x = 0; x < W; x++) {
        int from = 30 + 12 * frame + (H - y) / 8;
        row[x] = (uint8_t)(x >= from && x < from + 14 ? 35 : 190);
    }
}

int main(void)
{
    iris_scratch scratch;
    if (iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) ||
        iris_follow_init(&follow, (iris_size){W, H}, NULL, &scratch) || iris_steer_init(&steer, NULL)) {
        return 1;
    }
    for (int frame = 0; frame < 8; frame++) {
        static uint8_t row[W];
        char sentence[IRIS_COMMAND_SENTENCE_BYTES];
        size_t length;
        iris_follow_result line;
        iris_command command;
        (void)iris_follow_begin(&follow);
        for (int y = 0; y < H; y++) {
            sensor(row, y, frame);
            (void)iris_follow_row(&follow, row);
        }
        if (iris_follow_end(&line, &follow, (uint32_t)frame * 33) ||
            iris_steer_update(&command, &steer, &line, 33) ||
            iris_command_format(sentence, sizeof sentence, &length, &command)) {
            return 1;
        }
        fputs(sentence, stdout);
    }
    return 0;
}
