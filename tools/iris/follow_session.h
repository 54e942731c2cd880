/* What `iris follow` does with each frame of a sequence, wherever it comes from. */
#ifndef IRIS_TOOL_FOLLOW_SESSION_H
#define IRIS_TOOL_FOLLOW_SESSION_H

#include "follow_options.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"
#include "picture.h"

/* The sequence of frames so far. Set the options and zero the rest. */
typedef struct {
    const follow_options *options;
    int name_width;     /* columns for the names of files in the text */
    int64_t answered;   /* frames with an answer */
    uint32_t last_ms;   /* time of the last of them */
    int halted;         /* no frame since the robot was stopped */
    iris_size size;     /* that the follower is made for; 0x0: none yet */
    iris_format format; /* the same */
    iris_follow_config line;
    iris_follow follow;
    iris_steer steer;
    picture_buffer colors; /* of a frame to draw into */
} follow_session;

typedef struct {
    const char *file;
    int64_t number; /* its place in the sequence, 1 first */
    int64_t time_ms;
    int64_t available_us; /* when it was there, by system_clock_us; 0: does not matter */
    iris_image image;     /* any format that iris_color_takes */
    const char *overlay;  /* what its overlay is named after */
} follow_frame;

void follow_session_begin(follow_session *s, const follow_options *options);

/* Follows the line into this frame, steers, sends the command, and reports. Complains; returns an exit code. */
int follow_session_answer(follow_session *s, const follow_frame *frame);

/* Stops the robot until the next frame; what was seen before is forgotten. */
void follow_session_halt(follow_session *s);

void follow_session_end(follow_session *s);

#endif
