/* IRIS-XT - Hough transform: circles, of one radius or over a range of radii, among edge points that know their
 * direction.
 *
 * The edge of a disc is brighter on one side: its direction points to the center or away from it. So each edge point
 * votes, for each radius, for one place (two when discs may be bright or dark) instead of the whole circle of places
 * of the report. The report's accumulator has three dimensions, x, y, and radius; here one slice of it is in memory
 * at a time, a radius after the other, and only the best peaks are kept. A slice's cells grow with the radius,
 * because the error of a direction does, and the steps between radii with them: 10 to 50 pixels are 18 slices.
 *
 * Peaks are only hypotheses. Each is tested against the edge points, best first: the distance at which most of those
 * points lie whose direction fits, then the circle that fits them best (least squares), and so on with narrower
 * bands. A circle has to be supported along a share of its circumference, the same share for every radius, and what
 * supports it supports no other. Report, section 2.4.5 and 3.3.3 (BasicCircleDetector); C. Kimme, D. Ballard, and J.
 * Sklansky, "Finding circles by an array of accumulators", 1975; I. Kasa, "A circle fitting procedure and its error
 * analysis", 1976.
 */
#ifndef IRIS_XT_HOUGH_CIRCLE_H
#define IRIS_XT_HOUGH_CIRCLE_H

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"
#include "iris/xt/edge_points.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_CIRCLE_RADIUS_MIN     3
#define IRIS_CIRCLE_RADIUS_MAX     1023
#define IRIS_CIRCLE_CELL_MAX       16
#define IRIS_CIRCLE_HYPOTHESES_MAX 4096

/* What is inside of a circle. EITHER: also a mixture, as on a ground that is partly brighter, partly darker; and a
 * line drawn as a circle, whose two edges then count as one. */
typedef enum { IRIS_CIRCLE_EITHER, IRIS_CIRCLE_BRIGHT, IRIS_CIRCLE_DARK } iris_circle_polarity;

/* min_votes and min_share_permil both have to be reached. Of two circles whose centers are nearer than min_distance
 * only the better counts. cell is the least side of the accumulator's cells: larger ones cost precision of the peaks,
 * not of the circles, as long as they are small against the radius. */
typedef struct {
    int32_t radius_min;            /* pixels, IRIS_CIRCLE_RADIUS_MIN..IRIS_CIRCLE_RADIUS_MAX; default 10 */
    int32_t radius_max;            /* the same, at least radius_min; default 50 */
    iris_circle_polarity polarity; /* default IRIS_CIRCLE_EITHER */
    int32_t cell;                  /* pixels, 1..IRIS_CIRCLE_CELL_MAX; default 2 */
    int32_t min_share_permil;      /* 1..1000, supported part of the circumference 2 pi r; default 300 */
    int32_t min_votes;             /* 0..65535, whatever the radius; default 0 */
    int32_t min_distance;          /* pixels, 0..32767; default 10 */
    int32_t max_hypotheses;        /* 1..IRIS_CIRCLE_HYPOTHESES_MAX peaks that are tested; default 256 */
} iris_circle_config;

/* Centers of pixels are at whole numbers. */
typedef struct {
    iris_q16 x_q16, y_q16, r_q16; /* pixels */
    int32_t votes;                /* edge points that support the circle */
} iris_circle;

/* Cells beside each other along a side of so many pixels. */
#define IRIS_CIRCLE_CELLS(side, cell) (((size_t)(side) + (size_t)(cell)-1u) / (size_t)(cell))

#define IRIS_CIRCLE_LARGER(a, b) ((a) > (b) ? (a) : (b))

/* Working memory: sines, one slice (or, if that is more, the points once more), the rows' first points, a bit per
 * point, and the hypotheses. 160x120 with 1500 points and the defaults: 15 KB; 640x480 with 10000 points: 162 KB. */
#define IRIS_CIRCLE_SCRATCH_BYTES(w, h, points, cell, hypotheses)                                            \
    (IRIS_SCRATCH_ROUND(1024u) +                                                                             \
     IRIS_SCRATCH_ROUND(IRIS_CIRCLE_LARGER(2u * IRIS_CIRCLE_CELLS(w, cell) * IRIS_CIRCLE_CELLS(h, cell),     \
                                           6u * (size_t)(points))) +                                         \
     IRIS_SCRATCH_ROUND(4u * ((size_t)(h) + 1u)) +                                                           \
     IRIS_SCRATCH_ROUND(4u * (((size_t)(points) + 31u) / 32u)) +                                             \
     IRIS_SCRATCH_ROUND(16u * (size_t)(hypotheses)))

/* Sensible values, as given above. Null is ignored. */
void iris_circle_defaults(iris_circle_config *config);

/* The circles, best first: those with the greatest product of votes and share of the circumference (votes^2 / r).
 * edges are row by row, as iris_edge_points writes them; they stay as they are. config null: the defaults. circles may
 * be null when capacity is 0. *count is the number of all circles found.
 *
 * A circle's center is inside the picture. Its radius may be beyond the bounds by a pixel, or by a sixteenth of
 * itself if that is more. When part of it is outside the picture, the share still is one of the whole circumference:
 * half a disc at the picture's edge has 500 permil at best (560 of pixels, which are more than the circumference is
 * long).
 *
 * A point supports a circle that is nearer than 1.5 pixels and a 32nd of the radius and whose radius there is within
 * 26 degrees of the point's direction. Points there by chance scatter over all of that, those of a circle hardly: the
 * smaller its share, and the more other points there are, the closer its points have to fit. So 300 permil do in
 * clutter.
 *
 * Center and radius of a whole disc without noise are right within 0.1 pixel. The radius is where the smoothed edge
 * is steepest, which for radii below 8 pixels is up to 0.3 pixels inside of the true edge; that of a drawn line, up
 * to 2 pixels wide, is its middle.
 *
 * IRIS_ERR_FULL: more circles than capacity: circles has the best `capacity` of them.
 * IRIS_ERR_ARG: null pointer, negative number, or a config value out of range; IRIS_ERR_RANGE: a side outside
 * 1..IRIS_SIDE_MAX, a point outside the picture, or above the point before it; IRIS_ERR_SCRATCH. Outputs are
 * untouched then.
 * O(slices * (points + cells) + hypotheses * points in the circle's rows), a few divisions for each hypothesis. */
iris_status iris_hough_circles(iris_circle *circles, int32_t capacity, int32_t *count,
                               const iris_edge_list *edges, const iris_circle_config *config,
                               iris_scratch *scratch);

/* One slice of the accumulator, or several into one picture: adds the votes for this radius to votes, IRIS_GRAY_U16 of
 * IRIS_CIRCLE_CELLS(w, cell) x IRIS_CIRCLE_CELLS(h, cell), saturated. Of config (null: the defaults) polarity and cell
 * count; a cell is that size for every radius.
 * Working memory: IRIS_CIRCLE_VOTE_SCRATCH_BYTES.
 * IRIS_ERR_ARG: null pointer, negative count, a config value or the radius out of range; the errors of
 * iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: votes has another size, or as above; IRIS_ERR_SCRATCH.
 * O(points). */
#define IRIS_CIRCLE_VOTE_SCRATCH_BYTES IRIS_SCRATCH_ROUND(1024u)
iris_status iris_circle_vote(const iris_image *votes, const iris_edge_list *edges, int32_t radius,
                             const iris_circle_config *config, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
