#include "follower.h"

#include "iris/command.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"

static IRIS_SCRATCH_BUFFER(working, IRIS_FOLLOW_SCRATCH_BYTES(FOLLOWER_W, FOLLOWER_H));
static struct {
    iris_follow follow;
    iris_steer steer;
    uint32_t last_ms;
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
} robot;
static uint8_t sensor_row[FOLLOWER_W];

uint32_t follower_memory(void)
{
    return (uint32_t)(sizeof working + sizeof robot);
}

int follower_start(void)
{
    iris_scratch scratch;
    return iris_scratch_init(&scratch, working.memory, sizeof working.memory) != IRIS_OK ||
           iris_follow_init(&robot.follow, (iris_size){FOLLOWER_W, FOLLOWER_H}, NULL, &scratch) != IRIS_OK ||
           iris_steer_init(&robot.steer, NULL) != IRIS_OK;
}

const char *follower_frame(void (*sensor)(uint8_t *row, int32_t y), uint32_t now_ms)
{
    iris_follow_result line;
    iris_command command;
    size_t length;
    (void)iris_follow_begin(&robot.follow);
    for (int32_t y = 0; y < FOLLOWER_H; y++) {
        sensor(sensor_row, y);
        (void)iris_follow_row(&robot.follow, sensor_row);
    }
    if (iris_follow_end(&line, &robot.follow, now_ms) != IRIS_OK ||
        iris_steer_update(&command, &robot.steer, &line, (int32_t)(now_ms - robot.last_ms)) != IRIS_OK ||
        iris_command_format(robot.sentence, sizeof robot.sentence, &length, &command) != IRIS_OK) {
        return NULL;
    }
    robot.last_ms = now_ms;
    return robot.sentence;
}
