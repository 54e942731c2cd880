/* IRIS-XT - generalized Hough transform: any shape, moved, turned, and scaled, in clutter, and partly hidden.
 *
 * A shape is taught once, from the edge points of a template (edge_points.h). What is kept is its R-table: where each
 * point of the outline lies, seen from a reference point, sorted by the direction of the edge there. To find the shape,
 * every edge point of a picture votes for the places where the reference point may be, if it is one of the outline's
 * points of its direction: for one angle and one scale at a time, so that one small plane of votes is all that is
 * needed. The best places of each plane are then fitted: the outline, laid into the picture, is drawn to the nearest
 * edge points of its direction by least squares. A place counts by the share of its outline that is clearly seen.
 *
 * Clearly: edges of a tangle lie within two pixels of a third of any outline, and a fit draws it to more of them; but
 * they lie there by chance, at any distance and in any direction. Edges of the shape itself lie within 11 degrees and
 * half a pixel (of the template, when the shape is found larger, but not more than one). So a point of the outline
 * counts by how exactly the nearest edge point of like direction agrees: in full up to there, and not at all from twice
 * that on. A point that has edge points within two pixels, but of other directions alone, shows something else: it
 * counts minus a half. One that has none may be hidden: it counts nothing.
 *
 * Report, section 2.5.2; D. H. Ballard, "Generalizing the Hough transform to detect arbitrary shapes", 1981.
 *
 * Cost: for each angle and each scale a vote for every edge point and every outline point of nearly its direction (5 %
 * of them), twice that with IRIS_HOUGH_SHAPE_EITHER, 10 instructions each, and 10 for each cell. A picture of 320x240
 * with 4000 edge points, and a table of 256 entries at 72 angles and 8 scales, takes about 30 million votes.
 */
#ifndef IRIS_XT_HOUGH_SHAPE_H
#define IRIS_XT_HOUGH_SHAPE_H

#include "iris/fixed.h"
#include "iris/xt/edge_points.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- teaching --- */

#define IRIS_HOUGH_SHAPE_ENTRIES_MIN 8
#define IRIS_HOUGH_SHAPE_ENTRIES_MAX 1024
#define IRIS_HOUGH_SHAPE_REACH_MAX   2047 /* pixels from the reference point to an outline point */
#define IRIS_HOUGH_SHAPE_BINS        64   /* of the direction, in one turn */

typedef struct {
    int32_t fraction_bits; /* of the points' coordinates, 0 to 4; default 0: pixels */
    int32_t entries;       /* at most so many, MIN to MAX; default 256 */
    int32_t is_chosen;     /* 1: the reference point is given; default 0: it is the centroid of all points */
    iris_q16 x_q16, y_q16; /* of the reference point, pixels, when it is given */
} iris_hough_shape_teaching;

void iris_hough_shape_teaching_defaults(iris_hough_shape_teaching *config);

/* Bytes of a table of so many entries. 256 entries: 1686 bytes.
 *
 * The table is one block of bytes, the same on every processor, and is used where it lies, such as in flash; it needs
 * no alignment. All numbers are little-endian:
 *      0  "IRSH"
 *      4  u16  version, 1
 *      6  u16  entries
 *      8  s32  the reference point's x in the template, 16 fraction bits; then y
 *     16  u32  CRC-32 (of zlib and PNG) of all other bytes, in their order
 *     20  u16  65 numbers: the first entry of each of 64 bins of the direction, and the end of the last
 *    150  entries by their bins, 6 bytes each: s16 x, s16 y from the reference point, 4 fraction bits; u16 direction */
#define IRIS_HOUGH_SHAPE_TABLE_BYTES(entries) ((size_t)150 + (size_t)6 * (size_t)(entries))

/* Makes the table of the shape whose edge points are given, and says how many *bytes it takes. Of more points than
 * entries those are taken that cover the outline evenly: two of like direction keep a distance. config null: the
 * defaults. table and points are disjoint.
 * IRIS_ERR_ARG: null pointer, or a config value outside its range; IRIS_ERR_RANGE: fewer than ENTRIES_MIN points or
 * more than 32767, or a point that is more than REACH_MAX pixels to the side of the reference point or above or below
 * it;
 * IRIS_ERR_FULL: capacity is less than IRIS_HOUGH_SHAPE_TABLE_BYTES(entries taken), nothing is written but *bytes, the
 * bytes needed. O(points * entries). */
iris_status iris_hough_shape_teach(uint8_t *table, size_t capacity, size_t *bytes,
                                   const iris_edge_point *points, int32_t count,
                                   const iris_hough_shape_teaching *config);

/* The edge points of a silhouette, IRIS_MASK1, to teach from: the middles of the sides that a selected pixel shares
 * with one that is not, by pixels, row by row, each from the left, its right side before its lower one; their direction
 * is where the selected pixels lie around them (within 3.6 pixels). Coordinates are doubled, fraction_bits is 1. Better
 * than Canny's edges of it, which lie half a pixel beside them and break where a slope is perfect. Beyond the picture
 * nothing is selected. *count is the number of all. points may be null when capacity is 0.
 * IRIS_ERR_FULL: more than capacity; the first ones are in points. IRIS_ERR_ARG: null pointer, or a negative capacity;
 * the errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: a side above 16383. O(pixels + 64 * points). */
iris_status iris_hough_shape_silhouette(iris_edge_point *points, int32_t capacity, int32_t *count,
                                        const iris_image *mask);

/* What a table holds: the number of its entries, and where the reference point lies in the template. Checks all of the
 * table.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_TRUNCATED: fewer bytes than the table says; IRIS_ERR_UNSUPPORTED: another
 * version; IRIS_ERR_DATA: no table, or a damaged one. O(bytes). */
iris_status iris_hough_shape_table(int32_t *entries, iris_q16 *x_q16, iris_q16 *y_q16, const uint8_t *table,
                                   size_t bytes);

/* --- finding --- */

#define IRIS_HOUGH_SHAPE_SCALE_MIN  6554   /* 0.1, 16 fraction bits */
#define IRIS_HOUGH_SHAPE_SCALE_MAX  524288 /* 8 */
#define IRIS_HOUGH_SHAPE_SCALES_MAX 256
#define IRIS_HOUGH_SHAPE_CELL_MAX   32
#define IRIS_HOUGH_SHAPE_POINTS_MAX 1000000
#define IRIS_HOUGH_SHAPE_PLACES     32 /* hypotheses that are fitted to the end */

/* The shape is as bright or dark against its surroundings as the template; the other way round; or either of both. */
typedef enum {
    IRIS_HOUGH_SHAPE_SAME,
    IRIS_HOUGH_SHAPE_REVERSED,
    IRIS_HOUGH_SHAPE_EITHER
} iris_hough_shape_polarity;

/* Angles: angle_min, and on by angle_step up to angle_max; through the half turn when angle_max is below angle_min. All
 * directions when angle_max is angle_min - 1, as in the defaults. Scales likewise, up to scale_max. Fitting goes beyond
 * by half a step, but not more than an eighth of a scale. */
typedef struct {
    iris_angle angle_min, angle_max; /* clockwise as seen; default -32768 and 32767 */
    int32_t angle_step;      /* of 65536 in a turn, 91 (half a degree) to 65536; default 910, 5 degrees */
    iris_q16 scale_min_q16;  /* SCALE_MIN to SCALE_MAX; default 1 */
    iris_q16 scale_max_q16;  /* scale_min to SCALE_MAX; default 1 */
    iris_q16 scale_step_q16; /* 1 or more; not more than SCALES_MAX steps; default 0.1 */
    int32_t cell;            /* pixels, 1, 2, 4 .. CELL_MAX: side of a cell of votes; default 4 */
    iris_hough_shape_polarity polarity; /* default EITHER */
    int32_t min_score;                  /* permil, 1 to 1000; default 400 */
    int32_t separation;                 /* permil of the shape's reach, 0 to 1000; default 300 */
    int32_t points;                     /* most edge points of a picture, 1 to POINTS_MAX; default 8192 */
} iris_hough_shape_config;

void iris_hough_shape_defaults(iris_hough_shape_config *config);

typedef struct {
    iris_q16 x_q16, y_q16; /* where the template's reference point lies, pixels */
    iris_angle angle;      /* the template, turned clockwise as seen, */
    iris_q16 scale_q16;    /* and so many times as large */
    int32_t score;         /* permil of the outline that is clearly seen, as told above */
} iris_hough_shape_found;

/* Working memory: votes; the outline turned; edge points, and where to find them; and the places. 160x120 with cells of
 * 4 pixels, 256 entries, and 2000 edge points: 24 KB. */
#define IRIS_HOUGH_SHAPE_SCRATCH_BYTES(w, h, cell, entries, points)                                          \
    (IRIS_SCRATCH_ROUND(2u * IRIS_HOUGH_SHAPE_CELLS(w, cell) * IRIS_HOUGH_SHAPE_CELLS(h, cell)) +            \
     IRIS_SCRATCH_ROUND((size_t)12 * (size_t)(entries)) + IRIS_SCRATCH_ROUND((size_t)8 * (size_t)(points)) + \
     IRIS_SCRATCH_ROUND(4u * (IRIS_HOUGH_SHAPE_CELLS(w, 8) * IRIS_HOUGH_SHAPE_CELLS(h, 8) + 1u)) +           \
     IRIS_SCRATCH_ROUND((size_t)24 * IRIS_HOUGH_SHAPE_PLACES))
#define IRIS_HOUGH_SHAPE_CELLS(side, cell) (((size_t)(side) + (size_t)(cell)-1u) / (size_t)(cell))

/* A finder of one shape in pictures of one size. The fields are its own. */
typedef struct {
    iris_hough_shape_config config;
    iris_size size;
    const uint8_t *table; /* the caller's: it stays there as long as the finder is used */
    int32_t entries;
    int32_t reach_q4; /* from the reference point to the farthest outline point, pixels, 4 fraction bits */
    int32_t cells_w, cells_h;     /* of votes */
    int32_t shift;                /* cell is 1 << shift */
    int32_t indexes_w, indexes_h; /* cells of 8 pixels by which edge points are found */
    /* in the caller's working memory: */
    uint16_t *votes;
    struct iris_hough_shape_entry *turned;
    struct iris_hough_shape_edge *edges;
    int32_t *first;
    struct iris_hough_shape_place *places;
} iris_hough_shape;

/* Prepares for pictures of the given size. The table is checked, whoever made it. config null: the defaults. The
 * working memory stays taken (iris_scratch_release gives it back).
 * IRIS_ERR_ARG: null pointer, or a config value outside its range; IRIS_ERR_RANGE: a side outside 1..IRIS_SIDE_MAX;
 * the errors of iris_hough_shape_table; IRIS_ERR_SCRATCH. O(bytes). */
iris_status iris_hough_shape_begin(iris_hough_shape *shape, const uint8_t *table, size_t bytes,
                                   iris_size size, const iris_hough_shape_config *config,
                                   iris_scratch *scratch);

/* The shapes among the edge points of a picture, best first; *count is the number of all. Each edge point shows one
 * shape at most, and of two whose reference points are not farther apart than `separation` only the better counts. Not
 * more than PLACES are found. A reference point outside of the picture is not found. found may be null when capacity is
 * 0.
 *
 * With the default steps position, angle, and scale are typically within 1 pixel, 1 degree, and 1 %. A shape with a
 * third hidden, in noise, scores 430 to 700. Photographs and other shapes seldom score more than 350; what is as good
 * as a part of the shape, such as the straight sides of a grid for a hammer, reaches 450.
 *
 * IRIS_ERR_FULL: more shapes than capacity; the best are in found.
 * IRIS_ERR_ARG: null pointer, or a negative capacity; IRIS_ERR_RANGE: more points than config.points, or one
 * outside of the picture. Time: above. */
iris_status iris_hough_shape_find(iris_hough_shape_found *found, int32_t capacity, int32_t *count,
                                  iris_hough_shape *shape, const iris_edge_point *points,
                                  int32_t point_count);

/* The outline where it was found: where entry `index` of the table, 0 up to shape->entries - 1, lies in the picture,
 * and its direction there. Positions beyond 32767 pixels are limited to that.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: no such entry, or a scale outside 0..2 * SCALE_MAX. O(1). */
iris_status iris_hough_shape_outline(iris_q16 *x_q16, iris_q16 *y_q16, iris_angle *direction,
                                     const iris_hough_shape *shape, const iris_hough_shape_found *found,
                                     int32_t index);

#ifdef __cplusplus
}
#endif

#endif
