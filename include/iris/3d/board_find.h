/* IRIS-3D - boards in pictures: the inner corners of a chessboard, or the circles of a grid, to a fraction of a pixel.
 *
 * What iris_board_calibrate needs of a view. The places come row by row. Along a row and then down the rows is a turn
 * as from x to y in the picture, so no board is seen mirrored. That leaves a choice of two ends, or of four on a
 * board as high as wide. A chessboard begins where the square between the first four corners is dark; a grid of
 * circles whose rows are shifted begins with a row that is not. Where that does not decide (columns + rows is even,
 * or circles in plain rows) the first row points to the right in the picture, or at least more so than the other ones
 * that could be it.
 *
 * Method for corners: the response of a ring of 16 pixels whose opposite pixels are alike and whose quarter turns are
 * not (Bennett and Lasenby, "ChESS: quick and robust detection of chess-board features", 2014), on the levels of a
 * pyramid, the coarsest first; the ring's two changes from dark to bright give the directions of a corner's edges. From
 * a corner and two neighbors along its edges a lattice grows: each place is predicted by the steps beside it, and taken
 * when a corner is there whose colors are the other way round and which an edge joins, bright on the right side. A
 * place that fits the picture between two pixels is where all gradients around are perpendicular to the way to it
 * (Foerstner and Guelch, 1987), by least squares, again and again, down to the picture itself.
 */
#ifndef IRIS_3D_BOARD_FIND_H
#define IRIS_3D_BOARD_FIND_H

#include "iris/3d/camera.h"
#include "iris/image.h"
#include "iris/pyramid.h"
#include "iris/scratch.h"
#include "iris/xt/blob.h"
#include "iris/xt/threshold.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_BOARD_SIDE_MIN 3 /* corners or circles in a row, and rows */
#define IRIS_BOARD_SIDE_MAX 64

typedef struct {
    int32_t columns, rows; /* inner corners, or circles: IRIS_BOARD_SIDE_MIN to IRIS_BOARD_SIDE_MAX */
} iris_board_grid;

typedef enum {
    IRIS_BOARD_SEEN = 0,
    IRIS_BOARD_UNSEEN, /* nothing like a board */
    IRIS_BOARD_PARTLY, /* a part of it: the rest is covered, or too bright, dark, or small */
    IRIS_BOARD_CUT,    /* a part of it: the rest is beyond the edge of the picture */
    IRIS_BOARD_LARGER  /* a board of more columns or rows */
} iris_board_sight;

typedef struct {
    iris_board_sight sight;
    int32_t seen;          /* how many corners or circles, of that which is most like the board */
    int32_t columns, rows; /* over which they extend, the larger number first */
} iris_board_report;

/* Working memory: a pyramid of the picture, some rows, candidates, and the lattice. 9x6 in 640x480: 144 KB. */
#define IRIS_BOARD_LEVELS                    6
#define IRIS_BOARD_CANDIDATES(columns, rows) (512u + 4u * (size_t)(columns) * (size_t)(rows))
#define IRIS_BOARD_LONGER_(columns, rows)    ((size_t)((columns) > (rows) ? (columns) : (rows)))
#define IRIS_BOARD_CELLS(columns, rows)                                                                      \
    ((2u * IRIS_BOARD_LONGER_(columns, rows) + 3u) * (2u * IRIS_BOARD_LONGER_(columns, rows) + 3u))
#define IRIS_BOARD_CANDIDATE_BYTES 44
#define IRIS_BOARD_CORNERS_SCRATCH_BYTES(w, h, columns, rows)                                                \
    (IRIS_SCRATCH_ROUND(IRIS_PYRAMID_BYTES(w, h, 1, IRIS_BOARD_LEVELS)) +                                    \
     IRIS_SCRATCH_ROUND((size_t)(w)*14u) +                                                                   \
     IRIS_SCRATCH_ROUND(IRIS_BOARD_CANDIDATES(columns, rows) * IRIS_BOARD_CANDIDATE_BYTES) +                 \
     IRIS_SCRATCH_ROUND(IRIS_BOARD_CELLS(columns, rows) * 2u))

/* In made pictures with squares 8 pixels high and more, through lenses, tilted by up to 60 degrees, corners are off
 * by 0.03 pixels (root mean square) and 0.15 at most, with noise of 4 levels of 190 by 0.06 and 0.2, of 10 by 0.1 and
 * 0.3.
 *
 * The corners of a chessboard: columns * rows places in pixels, where 0, 0 is the middle of the first pixel. gray:
 * IRIS_GRAY8. The squares are 8 pixels high or more, seen at a slant too, and corners 6 pixels inside the picture.
 * IRIS_ERR_ARG: null pointer; errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: a grid beyond its limits;
 * IRIS_ERR_SCRATCH; IRIS_ERR_DATA: no such board is seen: *report says why, and corners are untouched. O(w h) for the
 * levels it takes, most of them small, and about candidates * corners for lattices: mazes of candidates take the
 * most, their number squared. */
iris_status iris_board_corners(iris_vec2 *corners, iris_board_report *report, const iris_image *gray,
                               const iris_board_grid *grid, iris_scratch *scratch);

typedef enum {
    IRIS_BOARD_CIRCLES = 0,    /* circle c of row r is at (c, r) */
    IRIS_BOARD_CIRCLES_SHIFTED /* every second row is shifted to the right: at (2 c + (r odd), r) */
} iris_board_circle_rows;

#define IRIS_BOARD_CIRCLE_CELLS_(columns, rows)                                                              \
    ((2u * ((size_t)(columns) + (size_t)(rows)) + 3u) * (2u * ((size_t)(columns) + (size_t)(rows)) + 3u))
#define IRIS_BOARD_CIRCLES_SCRATCH_BYTES(w, h, columns, rows)                                                \
    (IRIS_SCRATCH_ROUND(((size_t)(w) + 31u) / 32u * 4u * (size_t)(h)) +                                      \
     IRIS_SCRATCH_ROUND(IRIS_BOARD_CANDIDATES(columns, rows) * IRIS_BOARD_CANDIDATE_BYTES) +                 \
     IRIS_SCRATCH_ROUND(IRIS_BOARD_CIRCLE_CELLS_(columns, rows) * 2u) +                                      \
     IRIS_SCRATCH_ROUND(IRIS_BOARD_CANDIDATES(columns, rows) * sizeof(iris_blob)) +                          \
     IRIS_THRESHOLD_SCRATCH_BYTES(w, IRIS_THRESHOLD_RADIUS_MAX) +                                            \
     IRIS_BLOB_SCRATCH_BYTES(w, IRIS_BOARD_CANDIDATES(columns, rows)))

/* The same of circles: dark ones on bright ground, or bright ones on dark. They are 5 to 1000 pixels across the short
 * way, of a third to two thirds of the distance from one to the next, and all of them inside the picture.
 *
 * Method: what is darker than its surroundings on average hangs together (threshold.h, blob.h); as large as an ellipse
 * of its moments is; and its center of gravity, by how much darker each pixel is, is the place. The lattice grows from
 * a circle and two of its neighbors.
 *
 * What is seen of a tilted circle is an ellipse, whose center is not the circle's: that is nearer to the far side, by
 * r^2 sin(tilt) cos(tilt) f / z^2 pixels (radius r, distance z, focal length f), which are 0.17 pixels of a circle 20
 * pixels across, 30 of its radii away, tilted by 45 degrees. How steps get shorter from circle to circle tells it,
 * and it is put right.
 *
 * In made pictures they are then off by 0.04 pixels (root mean square) and 0.3 at most, with noise of 10 levels of
 * 190 by 0.08 and 0.5; the outermost ones most, to whose far side no circle is. 9x6 in 640x480 takes 183 KB. Errors
 * as above. Up to eight thresholds of the picture, one after another. */
iris_status iris_board_circles(iris_vec2 *centers, iris_board_report *report, const iris_image *gray,
                               const iris_board_grid *grid, iris_board_circle_rows rows,
                               iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
