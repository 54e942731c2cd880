/* A line follower in three calls: init, frame, command. Here the "camera" paints a line that leans to the right. */
#include <stdio.h>

#include "iris/xt/follow.h"
#include "iris/xt/steer.h"

enum { W = 160, H = 120 };

static uint8_t frame[W * H];
static IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_SCRATCH_BYTES(W, H));
static iris_follow follow;
static iris_steer steer;

static void camera(void)
{
    for (int i = 0; i < W * H; i++) {
        int x = i % W - (60 + (H - i / W) / 4);
        frame[i] = x > 0 && x < 16 ? 30 : 200;
    }
}

int main(void)
{
    iris_scratch scratch;
    iris_image image;
    iris_follow_result line;
    iris_command command;
    camera();
    if (iris_image_wrap(&image, frame, sizeof frame, (iris_size){W, H}, 0, IRIS_GRAY8) ||
        iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) ||
        iris_follow_init(&follow, (iris_size){W, H}, NULL, &scratch) || iris_steer_init(&steer, NULL) ||
        iris_follow_frame(&line, &follow, &image, 0) || iris_steer_update(&command, &steer, &line, 33)) {
        return 1;
    }
    printf("angle %.1f degrees, steer %.3f, speed %.3f\n", command.angle_centideg / 100.0,
           command.steer_permil / 1000.0, command.speed_permil / 1000.0);
    return command.state == IRIS_LINE_FOUND ? 0 : 1;
}
