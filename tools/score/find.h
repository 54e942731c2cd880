/* The follower and the controller on one still picture, as `iris follow --stills` uses them. */
#ifndef SCORE_FIND_H
#define SCORE_FIND_H

#include "iris/xt/follow.h"
#include "iris/xt/steer.h"
#include "score.h"

typedef struct {
    iris_follow_result line; /* line.rows is valid until the next call of find_line */
    double steer_deg;        /* positive right */
} found;

/* A follower and a controller that have seen nothing before look at the frame. config: null for the defaults.
 * A frame that the library refuses is answered as a line that was lost. */
found find_line(const iris_image *frame, const iris_follow_config *config);

/* The distance of (x, y) from the segment, and from the straight line through it. */
double segment_distance(const iris_segment *segment, double x, double y);
double extended_distance(const iris_segment *segment, double x, double y);

/* Writes the frame with what was found, and white crosses on the true points, into the folder s->pictures, if
 * there is one. at: x, y of each point. */
void save_found(const score *s, const char *name, const iris_image *frame, const found *result,
                double (*at)[2], int points);

#endif
