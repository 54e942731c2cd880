/* Where `iris capture` puts frames: numbered files in a folder, or one after another to standard output. */
#ifndef IRIS_TOOL_CAPTURE_OUTPUT_H
#define IRIS_TOOL_CAPTURE_OUTPUT_H

#include "iris/capture.h"

typedef struct {
    const char *folder; /* "-": standard output */
    int raw, json;
} capture_output;

/* Writes the frame and says so with json. Complains; returns an exit code. */
int capture_output_write(const capture_output *output, const iris_frame *frame);

/* Says what was granted, and how many frames came and did not. */
void capture_output_end(const capture_output *output, const char *device, const iris_capture *capture);

void capture_output_free(void);

#endif
