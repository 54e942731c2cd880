#include "follow_camera.h"

#include <stdio.h>

#include "camera.h"
#include "complain.h"
#include "frame_picture.h"
#include "iris/color.h"
#include "latency.h"
#include "stop_signal.h"
#include "system.h"

#define STEP_MS                                                                                              \
    100 /* how often somebody who wants to end the program is heard, and a robot told to stand still */
#define PATIENCE_MS 250 /* at least, until frames that do not come are lost */
#define UNKNOWN_MS  500 /* the same of a camera that does not tell its rate */

/* A frame's colors, where the follower does not take it as it is. */
static picture_buffer colors;

int follow_camera_begin(const follow_options *options)
{
    return camera_open(options->camera, &options->capture);
}

void follow_camera_end(void)
{
    camera_close();
    picture_free(&colors);
}

/* The frame itself wherever the follower takes it. */
static iris_status view_of(iris_image *view, const iris_frame *frame, iris_follow_kind kind)
{
    int is_nv12 = frame->chroma.data != NULL;
    if (is_nv12 ? kind != IRIS_FOLLOW_COLOR : iris_color_takes(frame->image.format)) {
        *view = frame->image;
        return IRIS_OK;
    }
    return frame_picture(view, &colors, frame);
}

static int answer(follow_session *s, const iris_frame *frame, int64_t start_us)
{
    const follow_options *options = s->options;
    follow_frame f = {.file = options->camera,
                      .number = (int64_t)frame->sequence + 1,
                      .time_ms = camera_is_recording() ? (int64_t)frame->sequence * 1000 / options->rate
                                                       : (frame->time_us - start_us) / 1000,
                      .available_us = frame->time_us,
                      .overlay = "-"};
    iris_status status = view_of(&f.image, frame, options->line.kind);
    if (status != IRIS_OK) {
        complain(options->camera, "%s", picture_problem(status, (iris_size){frame->image.w, frame->image.h}));
        return EXIT_BAD_DATA;
    }
    return follow_session_answer(s, &f);
}

/* How long frames may stay away: three of their times. */
static int64_t patience_ms(void)
{
    int32_t rate_millihz = camera_capture()->granted.rate_millihz;
    int64_t three_ms = rate_millihz > 0 ? 3000000 / rate_millihz : UNKNOWN_MS;
    return three_ms > PATIENCE_MS ? three_ms : PATIENCE_MS;
}

static void report_end(const follow_options *options)
{
    const iris_capture *capture = camera_capture();
    if (capture->dropped + capture->skipped + capture->damaged + capture->restarts + capture->returns > 0) {
        complain(options->camera,
                 "%llu frames, %llu dropped, %llu skipped, %llu damaged, %u restarts, %u returns",
                 (unsigned long long)capture->frames, (unsigned long long)capture->dropped,
                 (unsigned long long)capture->skipped, (unsigned long long)capture->damaged,
                 (unsigned)capture->restarts, (unsigned)capture->returns);
    }
    if (options->timing) {
        latency_print(options->json ? stdout : stderr, options->json);
    }
}

/* No frame for a while, or no camera. */
static void lose(follow_session *s, int *lost, const char *why)
{
    if (!*lost) {
        complain(s->options->camera, "%s; the robot stands still until there are frames again", why);
        *lost = 1;
    }
    follow_session_halt(s);
}

int follow_camera_run(follow_session *s)
{
    const follow_options *options = s->options;
    const int64_t start_us = system_clock_us();
    int64_t seen_ms = start_us / 1000;
    int exit_code = EXIT_DONE, lost = 0, over = 0;
    while (!over && !stop_signal_came() && !ferror(stdout)) {
        iris_frame frame;
        iris_status status = camera_next(&frame, STEP_MS);
        switch (status) {
        case IRIS_OK:
            if (lost) {
                complain(options->camera, "frames again");
            }
            lost = 0;
            exit_code = answer(s, &frame, start_us);
            camera_give(&frame);
            seen_ms = system_clock_ms();
            over = exit_code != EXIT_DONE || (options->frames > 0 && s->answered >= options->frames);
            break;
        case IRIS_ERR_TIMEOUT:
            if (system_clock_ms() - seen_ms >= patience_ms()) {
                lose(s, &lost, "no frame comes");
            }
            break;
        case IRIS_ERR_IO:
            lose(s, &lost, camera_problem());
            break;
        case IRIS_ERR_END:
            over = 1;
            break;
        default:
            complain(options->camera, "%s", camera_problem());
            exit_code = EXIT_BAD_DATA;
            over = 1;
            break;
        }
    }
    report_end(options);
    return exit_code;
}
