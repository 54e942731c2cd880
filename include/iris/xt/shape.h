/* IRIS-XT - shapes: what a silhouette is, however it is moved, turned, scaled, or mirrored.
 *
 * Perimeter sampling, the report's way: how far the perimeter is from a point inside, at every step of an angle, and
 * the farthest counts as 1. That is a periodic signal; turning the shape shifts it, so two are compared at all shifts.
 * Height functions, for more: how high all other points of the outline are over the tangent at each of its points.
 * Report, sections 2.5.1 and 3.3.3 (ShapeSampler, SequenceAnalyser); J. Wang, X. Bai, X. You, W. Liu, L. J. Latecki,
 * "Shape matching and classification using height functions", 2012.
 *
 *     iris_contour_find(&outline, 1, &count, &mask, &scratch);       the part that encloses most
 *     iris_shape_describe(&shape, &outline, &mask, &scratch);
 *     iris_shape_match(&found, &shape, &library, NULL, &scratch);    models described alike, once
 *
 * Angles are clockwise as seen; 0 is to the right, as y is down.
 */
#ifndef IRIS_XT_SHAPE_H
#define IRIS_XT_SHAPE_H

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"
#include "iris/xt/contour.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- ShapeSampler: distances to the perimeter ---- */

#define IRIS_SHAPE_SAMPLES_MAX 720
#define IRIS_SHAPE_ONE         32768 /* the largest distance */
#define IRIS_SHAPE_MISSING     65535 /* a ray that meets no perimeter: a false termination */

/* A ray crosses the perimeter where it leaves selected pixels: the far side of a line, the edge of an area. */
typedef enum { IRIS_SHAPE_FIRST = 0, IRIS_SHAPE_LAST } iris_shape_crossing;

typedef struct {
    int32_t samples; /* per turn, 4..IRIS_SHAPE_SAMPLES_MAX: the step is 360 degrees / samples; default 128 */
    iris_shape_crossing crossing; /* where a ray crosses more than once; default the first */
    /* 1: rays start at x, y; 0, the default: at the center of gravity of what is selected */
    int32_t has_point;
    iris_q16 x_q16, y_q16; /* pixels */
} iris_shape_sampling;

typedef struct {
    iris_q16 x_q16, y_q16; /* where the rays start, pixels */
    iris_q16 longest_q16;  /* the distance that IRIS_SHAPE_ONE stands for, pixels */
    int32_t missing;       /* so many rays meet nothing */
} iris_shape_rays;

/* A row of the R-table: at this angle the perimeter is so far from the reference point. */
typedef struct {
    iris_angle angle;
    iris_q16 distance_q16; /* pixels */
} iris_shape_entry;

void iris_shape_sampling_defaults(iris_shape_sampling *config);

/* distances[k], k = 0 to samples - 1, at k steps from 0: 0..IRIS_SHAPE_ONE or IRIS_SHAPE_MISSING. mask is IRIS_MASK1; a
 * silhouette, or an outline of any width, through which no ray slips (gaps let rays through). *rays may be null.
 * IRIS_ERR_ARG: null pointer, a config value out of range; the errors of iris_image_check; IRIS_ERR_FORMAT;
 * IRIS_ERR_RANGE: nothing is selected, or x, y outside the picture. O(samples * (w + h)), less for the first
 * crossing. */
iris_status iris_shape_sample(uint16_t *distances, iris_shape_rays *rays, const iris_image *mask,
                              const iris_shape_sampling *config);

/* The same as an R-table: `entries` has room for `samples`; *count of them are written, for the rays that met
 * something.
 * IRIS_ERR_ARG: null pointer, or samples out of range. O(samples). */
iris_status iris_shape_table(iris_shape_entry *entries, int32_t *count, const uint16_t *distances,
                             int32_t samples, iris_q16 longest_q16);

/* ---- SequenceAnalyser: the degree of correlation of two signatures ---- */

typedef struct {
    /* 0..IRIS_SHAPE_ONE: samples that differ by no more than this are equal; default 256 */
    int32_t tolerance;
    /* 0..1: errors may add up to this share of the signal, then a shift is given up; default .5 */
    iris_q16 cumulative_q16;
    iris_q16 missing_q16; /* 0..1: so many of the samples may be missing in one or the other; default 1/3 */
    int32_t mirrored;     /* 1, the default: also compares with the mirror image; 0 */
} iris_shape_tolerance;

typedef struct {
    iris_q16 degree_q16; /* 0..1; 1: the same within the tolerance; 0: no shift is within all tolerances */
    int32_t shift;       /* b's first sample goes with this one of a: so many steps b is turned clockwise */
    int32_t mirrored;    /* 1: b runs backwards: before the turn by angle, its left and right are swapped */
    iris_angle angle;    /* of the turn, between the steps */
    int32_t compared;    /* samples that both have */
} iris_shape_correlation;

void iris_shape_tolerance_defaults(iris_shape_tolerance *tolerance);

/* The best shift of b against a: degree = 1 - (sum of what samples differ by beyond the tolerance) / (sum of the larger
 * of both), over the samples that both have.
 * IRIS_ERR_ARG: null pointer, samples or a tolerance out of range; IRIS_ERR_RANGE: a sample that is neither 0..
 * IRIS_SHAPE_ONE nor missing. O(samples^2), twice with mirroring; a shift is left when it cannot win any more. */
iris_status iris_shape_correlate(iris_shape_correlation *best, const uint16_t *a, const uint16_t *b,
                                 int32_t samples, const iris_shape_tolerance *tolerance);

/* ---- prototypes ---- */

#define IRIS_SHAPE_POINTS   64
#define IRIS_SHAPE_RAYS     128
#define IRIS_SHAPE_DIAMETER 4096

/* A described shape, 560 bytes: may be kept in flash. */
typedef struct {
    int32_t class_index;            /* the caller's, 0 or more; iris_shape_describe sets 0 */
    iris_q16 x_q16, y_q16;          /* center of gravity of what the outline encloses, pixels */
    iris_q16 diameter_q16;          /* the largest distance of two of its points, pixels */
    int16_t x[IRIS_SHAPE_POINTS],   /* evenly along the outline, clockwise, about their mean; */
        y[IRIS_SHAPE_POINTS];       /* IRIS_SHAPE_DIAMETER is the diameter */
    uint16_t rays[IRIS_SHAPE_RAYS]; /* as iris_shape_sample has them, of the part with its holes */
    /* Hu's first number and the roots of the next three, holes filled; at most 1024 */
    int32_t moments_q20[4];
} iris_shape;

/* Working memory: what the outline encloses, one bit per pixel. 160x120: 2.4 KB. */
#define IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(w, h) IRIS_CONTOUR_SCRATCH_BYTES(w, h)

/* Describes what the contour encloses in mask. Only x and y of the contour are looked at.
 * IRIS_ERR_ARG: null pointer; the errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: a side of the mask above
 * IRIS_MOMENTS_SIDE_MAX, no border of this mask has x, y at its right side, or a single pixel; IRIS_ERR_SCRATCH.
 * O(pixels / 32 + outline + rays). */
iris_status iris_shape_describe(iris_shape *shape, const iris_contour *contour, const iris_image *mask,
                                iris_scratch *scratch);

typedef enum {
    IRIS_SHAPE_HEIGHTS = 0, /* height functions, the outlines laid on each other with some give */
    IRIS_SHAPE_RADIAL,      /* the report's: correlation of the rays */
    IRIS_SHAPE_MOMENTS      /* Hu's first four numbers; no angle */
} iris_shape_method;

typedef struct {
    iris_shape_method method; /* default IRIS_SHAPE_HEIGHTS */
    int32_t mirrored;         /* 1, the default: mirror images match, too; 0 */
    iris_q16 least_q16;       /* 0..1: a score below is unknown; default IRIS_SHAPE_LEAST of the method */
    int32_t except;           /* a model that is left out; default -1: none */
    iris_shape_tolerance tolerance; /* for IRIS_SHAPE_RADIAL; its mirrored is not looked at */
} iris_shape_matching;

/* Default least scores: 1/3, 0.7, 0.75. Few blobs and no noise reach the first with thirty models, nearly all shapes of
 * the same class do (make score prints how many); rays and moments tell less what is like nothing. */
#define IRIS_SHAPE_LEAST(method)                                                                             \
    ((method) == IRIS_SHAPE_HEIGHTS ? 21845 : (method) == IRIS_SHAPE_RADIAL ? 45875 : 49152)

typedef struct {
    const iris_shape *models;
    int32_t count; /* 0 or more */
} iris_shape_library;

#define IRIS_SHAPE_UNKNOWN (-1)

typedef struct {
    int32_t class_index; /* of the model; IRIS_SHAPE_UNKNOWN when the score is below the least */
    int32_t index;       /* the best model; -1: there is none */
    /* 0..1; 1: the same. Scores of different methods do not compare. Heights: 0 when they differ by as much as they
     * vary along the outlines; rays: the degree of correlation */
    iris_q16 score_q16;
    iris_angle angle; /* by which the model must be turned clockwise to lie like the shape */
    /* 1: after left and right of the model have been swapped, which must be better by 0.03 */
    int32_t mirrored;
} iris_shape_found;

/* Working memory of a match: 5 KB. */
#define IRIS_SHAPE_HEIGHTS_PER_POINT 21 /* of three points each */
#define IRIS_SHAPE_GIVE              6  /* points that one outline may be ahead of the other */
#define IRIS_SHAPE_MATCH_SCRATCH_BYTES                                                                       \
    (3u * IRIS_SCRATCH_ROUND(IRIS_SHAPE_POINTS * IRIS_SHAPE_HEIGHTS_PER_POINT) +                             \
     IRIS_SCRATCH_ROUND(IRIS_SHAPE_POINTS * (2u * IRIS_SHAPE_GIVE + 1u)))

void iris_shape_matching_defaults(iris_shape_matching *config, iris_shape_method method);

/* The model that is most like the shape; of equal ones the first. config null: the defaults for IRIS_SHAPE_HEIGHTS.
 * IRIS_ERR_ARG: null pointer, a negative count, or a config value out of range; IRIS_ERR_RANGE: a shape or model that
 * iris_shape_describe does not make; IRIS_ERR_SCRATCH. O(count): per model about 250 000 additions for heights and
 * 33 000 for rays, half of it without mirroring. */
iris_status iris_shape_match(iris_shape_found *found, const iris_shape *shape,
                             const iris_shape_library *library, const iris_shape_matching *config,
                             iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
