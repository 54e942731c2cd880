/* The follower's parts, in the order a frame passes them. Only follow*.c include this. */
#ifndef IRIS_FOLLOW_PARTS_H
#define IRIS_FOLLOW_PARTS_H

#include "../../foundation/kernel.h"
#include "iris/xt/follow.h"
#include "iris/xt/regress.h"

/* Runs in successive rows that overlap: a piece of line, or of anything else that is dark. 36 bytes. */
typedef struct iris_follow_chain {
    iris_span top, bottom; /* its runs in the rows top_y and bottom_y */
    int16_t next;          /* chain that continues it towards the robot, or -1 */
    uint8_t used;          /* 1: it belongs to a line that was chosen before */
    uint8_t done;          /* 1: has been looked at */
    uint16_t top_y, bottom_y;
    uint16_t rows;                   /* rows with a run */
    uint16_t widest;                 /* run, pixels */
    int32_t area;                    /* pixels in all runs */
    int32_t contrast_sum, range_sum; /* one sample per row: how far from the floor, of how far it could be */
    int32_t total;                   /* score of it and of those that continue it, once it is done */
} iris_follow_chain;

/* follow.c: what both kinds of init share, in this order: the config or its defaults; the checks of it and of the size, and
 * the memory (null and *status on errors); and, once nothing can fail, the follower, which may hold *config. */
const iris_follow_config *iris_follow_config_of(const iris_follow_config *config);
void *iris_follow_memory(iris_status *status, iris_size size, const iris_follow_config *config,
                         iris_scratch *scratch);
void iris_follow_prepare(iris_follow *follow, iris_size size, const iris_follow_config *config, void *memory);

/* What becomes of the chosen chains. */
typedef struct {
    iris_follow_result *result;
    iris_follow *follow;
    iris_span *spans; /* per row; overlays follow->runs */
    int16_t *twice_x; /* per row, twice the center or IRIS_REGRESS_NONE; overlays follow->owner */
    int is_lane;
    int32_t rows;                /* that show the line */
    int32_t top, bottom;         /* the first and last of them */
    int32_t upright_top;         /* rows upright_top to bottom are fitted by row centers */
    int32_t bar_top, bar_bottom; /* rows that lie across; bar_bottom < bar_top: none */
    int32_t width;               /* of the line near the robot */
    int32_t bottom_x_q12;        /* where the nearest piece, a straight one, meets the bottom row */
} iris_follow_shape;

static inline int32_t iris_span_width(iris_span span)
{
    return span.right - span.left + 1;
}

/* follow_floor.c: from pixels to line bits, by brightness against the floor. */
void iris_follow_mark(iris_follow *follow, const uint8_t *gray);

/* Learns the floor from the blocks of this row that hold no line pixel and are under no run. */
void iris_follow_learn(iris_follow *follow);

/* What a line's contrast with this floor is relative to, 8 fraction bits like the floor. */
int32_t iris_follow_range(const iris_follow *follow, int32_t floor);

/* follow_runs.c: from line bits to runs, and from runs to chains. gray is null when lines are told by color. */
void iris_follow_take_back(iris_follow *follow); /* the rows just above were no line but a darker floor */
void iris_follow_collect(iris_follow *follow, const uint8_t *gray);

/* follow_choose.c: which chains are the line. Puts chains that continue each other together and marks the best of these
 * as used: the farthest chain, then .next towards the robot. Returns the farthest chain's number, or -1 when no line is
 * left. */
int32_t iris_follow_choose(iris_follow *follow);

/* follow_spans.c: the run of row y that belongs to the line whose chain `*chain` covers the rows around y, or an empty
 * one. Rows are asked for in order from the top; *chain moves on towards the robot. */
iris_span iris_follow_run(const iris_follow *follow, int32_t y, int32_t *chain);

/* Makes span row y's, empty for a row in which the line is not seen. Rows come in order from the top: the spans take
 * the place of the runs, row y's is written to where row y / 4's runs were, which are not needed any more. */
void iris_follow_put_span(iris_follow_shape *s, int32_t y, iris_span span);

/* Of row y; 0 when it does not show the line. */
int32_t iris_follow_width(const iris_follow_shape *s, int32_t y);

/* The mean width of the rows that are not wider than `widest`, or widest when all are. */
int32_t iris_follow_mean_width(const iris_follow_shape *s, int32_t widest);

/* From the leftmost to the rightmost column of the rows first to last. */
iris_span iris_follow_hull(const iris_follow_shape *s, int32_t first, int32_t last);

/* follow_bend.c: tells crossing lines, which are bridged, from bends, which become the bar; sets width. */
void iris_follow_find_bend(iris_follow_shape *s);

/* follow_shape.c: a shape without rows. */
iris_follow_shape iris_follow_shape_of(iris_follow_result *result, iris_follow *follow);

/* From the spans to the result: the upright rows, the bar, and all numbers. */
void iris_follow_describe_shape(iris_follow_shape *s);

/* What follow->describe is: from the chosen chains to the result. Returns 0 when there is none. follow_lane.c: the lane
 * between this line and the next best. */
int iris_follow_describe_line(iris_follow_result *result, iris_follow *follow, int32_t line);
int iris_follow_describe_lane(iris_follow_result *result, iris_follow *follow, int32_t line);

#endif
