/* The frames of one input among several that are one sequence. */
#ifndef IRIS_TOOL_FRAME_SEQUENCE_H
#define IRIS_TOOL_FRAME_SEQUENCE_H

#include <stdint.h>

#include "picture.h"

typedef struct {
    picture_buffer *picture; /* IRIS_RGB888: the frame */
    int64_t *frame;          /* its place in the sequence, 1 first; a bad one counts, too */

    /* Answers the frame; an exit code, after complaining. */
    int (*answer)(void *context, const char *file);
    void *context;
} frame_sequence;

/* The first picture of a file; of standard input every one, until it ends, an answer fails, or nobody reads standard
 * output any more. Complains; returns an exit code. */
int frame_sequence_run(const frame_sequence *sequence, const char *file);

#endif
