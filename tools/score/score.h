/* iris-score: every figure that IRIS promises, measured again, in one table. */
#ifndef SCORE_SCORE_H
#define SCORE_SCORE_H

#include <stddef.h>

/* SCORE_SHORT: missed, known, and no worse than when it was last said: the tests report it as skipped, by name. */
typedef enum { SCORE_MISSED, SCORE_REACHED, SCORE_SKIPPED, SCORE_SHORT, SCORE_INFORMATION } score_verdict;

typedef struct {
    int tap;              /* 1: print TAP instead of a table */
    const char *figures;  /* folder with what other programs measured; null: none */
    const char *pictures; /* folder for pictures of what was found; null: none */
    int reached, missed, skipped, falls_short;
} score;

/* The head of the table, a row of it, and the totals. `required` is null for SCORE_INFORMATION; `format`
 * makes the text of what was reached, or why it was skipped. */
void score_head(const score *s);
void score_row(score *s, const char *what, const char *required, score_verdict verdict, const char *format,
               ...);
void score_totals(const score *s);

/* What an operation costs at 160x120: `memory` bytes, and instructions for a frame on a Cortex-M4, as counted for the case of
 * this name in tools/bench. */
void score_cost_row(score *s, const char *what, const char *bench_case, size_t memory);

static inline score_verdict score_if(int condition)
{
    return condition ? SCORE_REACHED : SCORE_MISSED;
}

/* The figures, in the table's order; one file each. */
void score_tape(score *s);
void score_dashes(score *s);
void score_lane(score *s);
void score_drive(score *s);
void score_hsl(score *s);
void score_tone(score *s);
void score_bmp(score *s);
void score_blur(score *s);
void score_skeleton(score *s);
void score_shapes(score *s);
void score_quadtree(score *s);
void score_edges(score *s);
void score_blobs(score *s);
void score_circles(score *s);
void score_shapes_found(score *s);
void score_floor(score *s);
void score_lines(score *s);
void score_junctions(score *s);
void score_paths(score *s);
void score_lock(score *s);
void score_camera(score *s);
void score_calib(score *s);
void score_motion(score *s);
void score_stereo(score *s);
void score_pair(score *s);
void score_carve(score *s);
void score_map(score *s);
void score_carve_photo(score *s);
void score_cost(score *s);

#endif
