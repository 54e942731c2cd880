/* A corner of a chessboard, where two edges cross: is there one, where exactly, and what joins it with the next. */
#ifndef IRIS_CALIB_CORNER_H
#define IRIS_CALIB_CORNER_H

#include "lattice.h"

#define IRIS_CORNER_MARGIN 6 /* pixels inside the picture */

/* Moves a place, 16 fraction bits, to where the gradients within `radius` pixels (2 to 12) are perpendicular to the way
 * to it. Returns 0 when there is no such place within them. */
int iris_corner_settle(iris_q16 place[2], const iris_image *picture, int32_t radius);

/* Looks around the candidate's place: sets axis and size. Returns 0 when no two edges cross there. */
int iris_corner_look(iris_candidate *corner, const iris_image *picture);

/* Does an edge lead from a to b, bright on the side to which angles grow (bright_side 1), or dark (0)? */
int iris_corner_joined(const iris_candidate *a, const iris_candidate *b, int bright_side,
                       const iris_image *picture);

/* Candidates in a picture, the strongest of all: at most lattice->room. responses: rows of working memory. */
void iris_corner_seek(iris_lattice *lattice, int16_t *responses, const iris_image *picture);

#endif
