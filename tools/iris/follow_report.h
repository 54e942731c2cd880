/* What `iris follow` says about a frame: one line of text or one JSON object, at once. */
#ifndef IRIS_TOOL_FOLLOW_REPORT_H
#define IRIS_TOOL_FOLLOW_REPORT_H

#include <stdint.h>

#include "follow_options.h"
#include "iris/command.h"
#include "iris/image.h"
#include "iris/xt/follow.h"

/* Everything that is known about one frame. */
typedef struct {
    const char *file; /* "-": standard input */
    int64_t frame;    /* its place among the inputs, 1 first */
    iris_size size;
    iris_follow_result line;
    iris_command command;
    iris_pursuit_goal goal;     /* of --floor */
    follow_junctions junctions; /* of --junctions */
    int32_t wheel_centideg;     /* the command's steering as a wheel angle */
} follow_answer;

/* Printed to standard output and flushed. name_width: columns for the file name in the text. */
void follow_report(const follow_answer *answer, const follow_options *options, int name_width);

/* The line in row y; left > right where it is not, and in rows outside of the frame. */
iris_span follow_row(const follow_answer *answer, int32_t y);

/* "found", "stale", or "lost". */
const char *follow_state_name(iris_line_state state);

#endif
