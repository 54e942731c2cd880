#include "bench.h"

#include "iris/command.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"

static iris_follow follow;
static iris_steer steer;

/* What is measured is the second frame: the floor is known. */
static void follower(void)
{
    iris_follow_result line;
    iris_size size = {bench_frame.gray.w, bench_frame.gray.h};
    (void)iris_follow_init(&follow, size, NULL, &bench_frame.scratch);
    (void)iris_steer_init(&steer, NULL);
    (void)iris_follow_frame(&line, &follow, &bench_frame.gray, 0);
}

static void follower_by_hough(void)
{
    follower();
    (void)iris_follow_use_hough(&follow, &bench_frame.scratch);
}

static iris_status frame_to_sentence(void)
{
    iris_follow_result line;
    iris_command command;
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length;
    (void)iris_follow_frame(&line, &follow, &bench_frame.gray, 33);
    (void)iris_steer_update(&command, &steer, &line, 33);
    return iris_command_format(sentence, sizeof sentence, &length, &command);
}

const bench_case bench_follow[] = {
    {"line follower, gray frame to sentence", frame_to_sentence, follower},
    {"the same by Hough transform of row centers", frame_to_sentence, follower_by_hough},
    {0},
};
