/* What `iris follow` was asked for: the kind of line, the rows to report, and plain numbers, read from their texts. */
#ifndef IRIS_TOOL_FOLLOW_OPTIONS_H
#define IRIS_TOOL_FOLLOW_OPTIONS_H

#include "camera.h"
#include "follow_floor.h"
#include "follow_junctions.h"
#include "iris/xt/follow.h"
#include "steering_option.h"

#define FOLLOW_ROWS_MAX 1024

typedef struct {
    iris_follow_config line;
    int32_t rows[FOLLOW_ROWS_MAX]; /* as given */
    int row_count;                 /* 0: none given */
    int32_t rate;                  /* frames per second */
    int json, stills;
    int hough;           /* 1: straight parts by Hough transform, not by regression */
    const char *overlay; /* folder; null: none */
    const char *camera;  /* device or recording; null: files */
    iris_capture_config capture;
    int32_t frames; /* of the camera; 0: no limit */
    int timing;
    steering_options steering;
    follow_floor floor;
    follow_junction_options junctions;
} follow_options;

/* The options as texts, null where not given. */
typedef struct {
    const char *line, *estimator, *rows, *rate, *take, *contrast, *frames;
    camera_texts camera; /* without the rate */
    steering_texts steering;
} follow_texts;

/* Fills everything of `options` that texts decide; what is not given gets its default. Returns 0 after complaining. */
int follow_options_read(follow_options *options, const follow_texts *texts);

#endif
