/* IRIS-XT - Hough transform: the straight lines among many points, most of which belong to none.
 *
 * Every point votes for all lines that pass through it; what many points agree on is a line. Gaps, noise, and other
 * lines do not bend it, as they do a regression (regress.h). A line is written as
 *
 *     (x - (w - 1) / 2) cos theta + (y - (h - 1) / 2) sin theta = rho
 *
 * with the origin in the middle of the image: rho is how far the line passes from there, positive to the right of it
 * (level lines at theta -90: above it). theta is also the line's angle as everywhere in IRIS: 0 straight up the image,
 * positive when it leans right. theta and theta + 180 degrees with rho negated are the same line, so the accumulator
 * needs half a turn only, and its last angle is the neighbor of its first.
 *
 * theta may go through the full circle, too: then it says on which side of the line the picture is bright, for points
 * that know their direction (edge_points.h; theta is where it gets brighter), and both edges of a bright stripe are
 * lines of opposite theta. For points without direction, each line comes twice then, or once with rho_min 0: the form
 * of the report, theta of a whole turn and rho not negative.
 *
 * Points with a direction vote for lines near to it alone: an eighth of the votes, and far fewer by chance.
 *
 * Report, sections 2.4.1 to 2.4.4 and 3.3.3 (StraightLineDetector); R. O. Duda and P. E. Hart, "Use of the Hough
 * transformation to detect lines and curves in pictures", 1972; F. O'Gorman and M. B. Clowes, "Finding picture edges
 * through collinearity of feature points", 1976 (direction).
 */
#ifndef IRIS_XT_HOUGH_H
#define IRIS_XT_HOUGH_H

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"
#include "iris/xt/edge_points.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_HOUGH_THETA_BINS_MAX 4096
#define IRIS_HOUGH_RHO_STEP_MAX   64
#define IRIS_HOUGH_SEPARATION_MAX 255
#define IRIS_HOUGH_SPREAD_MAX     16383

/* theta bin k stands for angle_min + k * span / theta_bins, where span is what lies between the bounds; angle_max is
 * not a bin itself. angle_max below angle_min: through the level lines (60 to -60 degrees is 60 to 120), with
 * full_circle through 180 degrees. Both the same, or half a turn (a full one with full_circle) apart: every direction.
 * rho bin i holds rho_min + i * rho_step up to below rho_min + (i + 1) * rho_step.
 * Of two lines that are not farther apart than both separations, only the better counts. */
typedef struct {
    iris_angle angle_min, angle_max; /* each -16384..16384 (-90 to 90 degrees), with full_circle any;
                                        default -16384 and 16384 */
    int32_t theta_bins;              /* 1..IRIS_HOUGH_THETA_BINS_MAX; default 180 */
    int32_t rho_min, rho_max; /* pixels, rho_min < rho_max; cut to the image's reach; default -32767, 32767 */
    int32_t rho_step;         /* pixels: 1, 2, 4 .. IRIS_HOUGH_RHO_STEP_MAX; default 1 */
    int32_t min_votes;        /* 1..65535: points that a line has at least; default 50 */
    int32_t theta_separation; /* bins, 0..IRIS_HOUGH_SEPARATION_MAX; default 8 */
    int32_t rho_separation;   /* bins, 0..IRIS_HOUGH_SEPARATION_MAX; default 12 */
    int32_t full_circle; /* 1: theta is within a full turn (set the bounds, too); 0: half a turn; default 0 */
    iris_angle spread;   /* of votes by direction, 0..IRIS_HOUGH_SPREAD_MAX; default 1820 (10 degrees) */
} iris_hough_config;

typedef struct {
    iris_angle angle; /* -90 up to below 90 degrees; with full_circle -180 up to below 180 */
    iris_q16 rho_q16; /* pixels from the middle of the image */
    int32_t votes;    /* in the best bin; saturates at 65535 */
} iris_hough_line;

/* Where a line enters and leaves an image, in pixels; (x0, y0) is the lower end (the left one if level). */
typedef struct {
    int32_t x0, y0, x1, y1;
} iris_hough_ends;

/* No pixel of a w x h image is farther from its middle (pixels, rounded up; at the most 8 % more than half the
 * diagonal). */
#define IRIS_HOUGH_REACH(w, h)                                                                               \
    (((w) > (h) ? (size_t)12 * (size_t)(w) + (size_t)5 * (size_t)(h)                                         \
                : (size_t)5 * (size_t)(w) + (size_t)12 * (size_t)(h)) /                                      \
         24 +                                                                                                \
     1)

/* Working memory: sines and the accumulator. The second form is for w x h images without bounds on rho, by steps of one
 * pixel; with bounds or larger steps rho_bins is (rho_max - rho_min) / rho_step, rounded up.
 * 160x120 with 90 angles: 38 KB; with bounds of +-40 pixels by steps of 2 and 32 angles: 2.7 KB. */
#define IRIS_HOUGH_BINS_SCRATCH_BYTES(rho_bins, theta_bins)                                                  \
    (IRIS_SCRATCH_ROUND((size_t)(theta_bins)*4) +                                                            \
     IRIS_SCRATCH_ROUND((size_t)(rho_bins) * (size_t)(theta_bins)*2))
#define IRIS_HOUGH_SCRATCH_BYTES(w, h, theta_bins)                                                           \
    IRIS_HOUGH_BINS_SCRATCH_BYTES(2 * IRIS_HOUGH_REACH(w, h), theta_bins)

/* A transform. The fields are its own. */
typedef struct {
    iris_hough_config config; /* rho_min and rho_max cut to the image */
    iris_size size;
    int32_t span;     /* between the bounds of the angle, 1..65536 */
    int32_t rho_bins; /* IRIS_SIDE_MAX at most */
    int32_t shift;    /* rho with 15 fraction bits to bin */
    int32_t room;     /* so many points may vote before a bin could saturate; 0 when some are out of bounds */
    /* in the caller's working memory: */
    int16_t *sines;  /* cosine and sine per theta bin, 14 fraction bits */
    uint16_t *votes; /* theta_bins rows of rho_bins */
} iris_hough;

/* Sensible values, as given above. Null is ignored. */
void iris_hough_defaults(iris_hough_config *config);

/* Prepares for votes of points in images of the given size, all bins empty. config may be null for the defaults; it is
 * copied. The working memory stays taken (iris_scratch_release gives it back).
 * IRIS_ERR_ARG: null pointer, or a config value out of range; IRIS_ERR_RANGE: a side outside 1..IRIS_SIDE_MAX, no rho
 * of the image within the bounds, or more than IRIS_SIDE_MAX bins of rho; IRIS_ERR_SCRATCH. O(bins). */
iris_status iris_hough_begin(iris_hough *hough, iris_size size, const iris_hough_config *config,
                             iris_scratch *scratch);

/* One point votes. Coordinates are doubled so that the middle of a run of pixels is a whole number: 0 to 2 (w - 1) and
 * 0 to 2 (h - 1).
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: outside the image (no vote). O(theta_bins). */
iris_status iris_hough_vote(iris_hough *hough, int32_t twice_x, int32_t twice_y);

/* All selected pixels of row y of a mask (w bits, as in IRIS_MASK1) vote.
 * Errors as iris_hough_vote. O(w / 32 + votes), a multiplication per vote. */
iris_status iris_hough_vote_row(iris_hough *hough, const uint32_t *mask_row, int32_t y);

/* All selected pixels of a mask of the transform's size vote: the same as row by row, and quicker.
 * IRIS_ERR_ARG: null pointer; the errors of iris_image_check; IRIS_ERR_FORMAT: mask is not IRIS_MASK1; IRIS_ERR_RANGE:
 * another size. O(pixels / 32 + votes). */
iris_status iris_hough_vote_mask(iris_hough *hough, const iris_image *mask);

/* Points with a direction vote: each in the theta bins from that nearest to its angle - spread to that nearest to its
 * angle + spread, so in one at least when the bounds hold its direction. Without full_circle a direction and its
 * opposite are the same.
 * IRIS_ERR_ARG: null pointer, or a negative count; IRIS_ERR_RANGE: a point outside the image; then none votes.
 * O(count * bins of theta within the spread on both sides), two multiplications per vote. */
iris_status iris_hough_vote_edges(iris_hough *hough, const iris_edge_point *points, int32_t count);

/* More votes than lines get by chance, as min_votes: so that a picture full of noise or texture has no lines, and one
 * with few points has faint ones. That is 9/8 mean + 12 sqrt(mean), 25 at least and 65535 at most. mean is the votes of
 * a line as long as the diagonal when `points` points are strewn over a picture of this size; with_direction 1: by
 * config's spread, on both sides, and one bin more. Both factors are those of smoothed noise, whose edges come in short
 * pieces, and more at some angles than at others: of pictures of noise, uniform and Gaussian of every strength, from
 * 160x120 to 1920x1080, hardly one has a line then. config null: the defaults. O(1). */
int32_t iris_hough_votes_beyond_chance(const iris_hough_config *config, iris_size size, int32_t points,
                                       int with_direction);

/* The best lines, best first; of equal ones that with the smaller theta bin, then the smaller rho bin, first. A line is
 * a bin of at least min_votes that no bin within the separations surpasses (theta wraps around when it covers every
 * direction); angle and rho are refined between the bins. *count is the number of all lines found. votes of earlier
 * calls stay, and more may follow. lines may be null when capacity is 0.
 *
 * A straight line of pixels that are centered on it is found within 0.8 of a theta bin and of a rho bin, 0.3 on
 * average, when the bins match: one theta bin should move the line's ends by one to three rho bins (half the longer
 * side times the theta bin in radians is 1 to 3 times rho_step: 1 for 160x120 and 2 for 320x240 pixels with 180 and 90
 * angles). With rho steps that are too small for its theta bins a line's votes are split among many bins, and with too
 * large ones its angle is uncertain.
 *
 * IRIS_ERR_FULL: more lines than capacity; the best are in lines.
 * IRIS_ERR_ARG: null pointer, or a negative capacity. O(bins + bins of at least min_votes * separated bins). */
iris_status iris_hough_peaks(iris_hough_line *lines, int32_t capacity, int32_t *count,
                             const iris_hough *hough);

/* The lines in a mask: begin, every row, peaks. Afterwards the working memory is given back.
 * Errors of those, and IRIS_ERR_FORMAT when mask is not IRIS_MASK1. O(pixels / 32 + selected pixels * theta_bins), and
 * peaks. */
iris_status iris_hough_lines(iris_hough_line *lines, int32_t capacity, int32_t *count, const iris_image *mask,
                             const iris_hough_config *config, iris_scratch *scratch);

/* The accumulator as a picture: *view is an IRIS_GRAY_U16 view of the votes in the working memory, a column per rho
 * bin, a row per theta bin. votes.h makes it one to look at.
 * IRIS_ERR_ARG: null pointer. O(1). */
iris_status iris_hough_accumulator(iris_image *view, const iris_hough *hough);

/* Back to the image: the first and the last pixel of the line in an image of the given size (the one that the line was
 * found in).
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: a side outside 1..IRIS_SIDE_MAX, or the line does not meet the image.
 * O(longest side). */
iris_status iris_hough_clip(iris_hough_ends *ends, const iris_hough_line *line, iris_size size);

#ifdef __cplusplus
}
#endif

#endif
