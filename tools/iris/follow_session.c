#include "follow_session.h"

#include <string.h>

#include "complain.h"
#include "floor_file.h"
#include "follow_overlay.h"
#include "follow_report.h"
#include "iris/color.h"
#include "latency.h"
#include "steering.h"
#include "system.h"

/* Where the library works: enough for the largest frame. */
static IRIS_SCRATCH_BUFFER(memory,
                           IRIS_FOLLOW_FULL_SCRATCH_BYTES(IRIS_FOLLOW_SIDE_MAX, IRIS_FOLLOW_SIDE_MAX) +
                               IRIS_FOLLOW_HOUGH_BYTES);

void follow_session_begin(follow_session *s, const follow_options *options)
{
    s->options = options;
    s->line = options->line;
    iris_steer_init(&s->steer, NULL);
}

/* Makes the follower ready for frames of another kind. Returns an exit code after complaining. */
static int change_to(follow_session *s, const char *file, const iris_image *frame)
{
    iris_scratch scratch;
    const follow_options *options = s->options;
    const iris_size size = {frame->w, frame->h};
    if (options->floor.used && !floor_fits(&options->floor.floor, file, size)) {
        return EXIT_BAD_DATA;
    }
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    s->line.format = frame->format;
    if (iris_follow_init_full(&s->follow, size, &s->line, &scratch) != IRIS_OK) {
        complain(file, "%dx%d pixels: sides of 8 to %d can be followed", (int)size.w, (int)size.h,
                 IRIS_FOLLOW_SIDE_MAX);
        return EXIT_BAD_DATA;
    }
    if (options->hough) {
        iris_follow_use_hough(&s->follow, &scratch);
    }
    for (int i = 0; i < options->row_count && s->answered == 0; i++) {
        if (options->rows[i] >= size.h) {
            complain("--rows", "row %d is outside of %s (%dx%d)", (int)options->rows[i], file, (int)size.w,
                     (int)size.h);
            return EXIT_BAD_CALL;
        }
    }
    s->size = size;
    s->format = frame->format;
    return EXIT_DONE;
}

/* Follows the line into this frame and steers. Returns an exit code after complaining. */
static int look(follow_answer *answer, follow_session *s, const iris_image *image, uint32_t now_ms)
{
    int32_t elapsed_ms = s->answered > 0 && !s->halted ? (int32_t)(now_ms - s->last_ms) : 0;
    s->halted = 0;
    if (s->options->stills) {
        iris_follow_forget(&s->follow);
        iris_steer_init(&s->steer, NULL);
        elapsed_ms = 0;
    }
    iris_follow_frame(&answer->line, &s->follow, image, now_ms);
    answer->junctions.count = -1;
    if (s->options->junctions.used) {
        int afresh = s->answered == 0 || s->options->stills;
        int exit_code = follow_junctions_look(&answer->junctions, &answer->line, image, &s->line,
                                              &s->options->junctions, afresh ? -1 : elapsed_ms);
        if (exit_code != EXIT_DONE) {
            return exit_code;
        }
    }
    follow_floor_steer(&answer->command, &answer->goal, &s->steer, &answer->line, &s->options->floor,
                       elapsed_ms);
    answer->wheel_centideg = iris_steer_wheel_centideg(&s->steer, &answer->command);
    s->answered++;
    s->last_ms = now_ms;
    return EXIT_DONE;
}

/* Draws the answer into the frame's colors. Returns an exit code. */
static int draw(follow_session *s, const follow_frame *frame, follow_answer *answer)
{
    const iris_image *image = &frame->image;
    answer->file = frame->overlay;
    if (image->format != IRIS_RGB888) {
        iris_status status = picture_reserve(&s->colors, answer->size, IRIS_RGB888);
        if (status != IRIS_OK) {
            complain(frame->file, "%s", picture_problem(status, answer->size));
            return EXIT_BAD_DATA;
        }
        iris_color_convert(&s->colors.image, image);
        image = &s->colors.image;
    }
    return follow_overlay_write(s->options->overlay, image, answer);
}

int follow_session_answer(follow_session *s, const follow_frame *frame)
{
    const follow_options *options = s->options;
    const iris_image *image = &frame->image;
    follow_answer answer = {.file = frame->file, .frame = frame->number, .size = {image->w, image->h}};
    int exit_code = EXIT_DONE;
    if (image->w != s->size.w || image->h != s->size.h || image->format != s->format) {
        exit_code = change_to(s, frame->file, image);
    }
    if (exit_code == EXIT_DONE) {
        exit_code = look(&answer, s, image, (uint32_t)frame->time_ms);
    }
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    if (options->steering.used) {
        if (!options->camera && strcmp(frame->file, "-") != 0) {
            steering_wait(frame->time_ms);
        }
        steering_send(&answer.command);
    }
    if (frame->available_us != 0) {
        latency_add(system_clock_us() - frame->available_us);
    }
    follow_report(&answer, options, s->name_width);
    return options->overlay ? draw(s, frame, &answer) : EXIT_DONE;
}

void follow_session_halt(follow_session *s)
{
    iris_follow_forget(&s->follow);
    iris_steer_init(&s->steer, NULL);
    s->halted = 1;
    if (s->options->steering.used) {
        steering_halt();
    }
}

void follow_session_end(follow_session *s)
{
    follow_overlay_end();
    follow_junctions_end();
    picture_free(&s->colors);
}
