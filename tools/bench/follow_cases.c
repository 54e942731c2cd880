#include "bench.h"

#include "iris/command.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"

static iris_follow follow;
static iris_steer steer;
static iris_image yuyv;

/* What is measured is the second frame: the floor is known. */
static void follower(void)
{
    iris_follow_result line;
    iris_size size = {bench_frame.gray.w, bench_frame.gray.h};
    (void)iris_follow_init(&follow, size, NULL, &bench_frame.scratch);
    (void)iris_steer_init(&steer, NULL);
    (void)iris_follow_frame(&line, &follow, &bench_frame.gray, 0);
}

/* A red line on a gray floor, a little of either color in every pixel, as from a camera. */
static void paint_yuyv(uint8_t *row, const uint8_t *gray)
{
    for (int32_t x = 0; x < yuyv.w; x += 2, row += 4) {
        int is_line = gray[x] < 60;
        row[0] = is_line ? 90 : gray[x];
        row[1] = (uint8_t)((is_line ? 100 : 126) + gray[x] % 5);
        row[2] = is_line ? 90 : gray[x + 1];
        row[3] = (uint8_t)((is_line ? 180 : 126) + gray[x + 1] % 5);
    }
}

static void follower_by_signature(void)
{
    static iris_signatures signatures;
    iris_size size = {bench_frame.gray.w, bench_frame.gray.h};
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_COLOR;
    config.format = IRIS_YUYV;
    yuyv = bench_canvas(IRIS_YUYV);
    for (int32_t y = 0; y < yuyv.h; y++) {
        paint_yuyv(iris_image_row(&yuyv, y), iris_image_row(&bench_frame.gray, y));
    }
    (void)iris_signature_from_range(&signatures, 0, &(iris_hsl_range){340, 20, 30, 100, 10, 90});
    (void)iris_follow_init_signature(&follow, size, &config, &signatures, 1, &bench_frame.scratch);
    (void)iris_steer_init(&steer, NULL);
}

static void follower_by_hough(void)
{
    follower();
    (void)iris_follow_use_hough(&follow, &bench_frame.scratch);
}

static iris_status sentence_of(const iris_image *frame)
{
    iris_follow_result line;
    iris_command command;
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length;
    (void)iris_follow_frame(&line, &follow, frame, 33);
    (void)iris_steer_update(&command, &steer, &line, 33);
    iris_status status = iris_command_format(sentence, sizeof sentence, &length, &command);
    return line.state == IRIS_LINE_FOUND ? status : IRIS_ERR_ARG; /* a lost line would be cheap */
}

static iris_status frame_to_sentence(void)
{
    return sentence_of(&bench_frame.gray);
}

static iris_status yuyv_to_sentence(void)
{
    return sentence_of(&yuyv);
}

const bench_case bench_follow[] = {
    {"line follower, gray frame to sentence", frame_to_sentence, follower},
    {"line follower, YUYV frame to sentence by color signature", yuyv_to_sentence, follower_by_signature},
    {"the same by Hough transform of row centers", frame_to_sentence, follower_by_hough},
    {0},
};
