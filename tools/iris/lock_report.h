/* What `iris lock` says about a frame: a line, and a picture. */
#ifndef IRIS_TOOL_LOCK_REPORT_H
#define IRIS_TOOL_LOCK_REPORT_H

#include <stdint.h>

#include "canvas.h"
#include "iris/xt/lock.h"

/* Where the object was, the latest last. */
#define LOCK_TRAIL 64
typedef struct {
    canvas_point places[LOCK_TRAIL];
    int count;
    int32_t id; /* whose they are */
} lock_trail;

typedef struct {
    const char *file;
    int64_t number;          /* 1 first */
    const iris_image *image; /* drawn into */
} lock_frame;

void lock_report(const iris_lock_result *result, const lock_frame *frame, int json);

/* Writes the frame with the object and its trail, which gets longer. Returns an exit code. */
int lock_overlay_write(const char *folder, const lock_frame *frame, const iris_lock_result *result,
                       lock_trail *trail);
void lock_overlay_end(void);

#endif
