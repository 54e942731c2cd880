/* IRIS-3D - occupancy grids: a floor in square cells, and how sure it is that something stands in each of them.
 *
 * A cell holds the logarithm of the odds, in sixteenths: 16 ln(p / (1 - p)), where p is the probability that it is
 * occupied. 0 is unknown, as likely as not; what is learned later is added, so that errors average out, and saturates, so
 * that a map can change its mind:
 *
 *     odds   -64     -23     -6      0    10     14     64
 *     p      0.018   0.192   0.407   0.5  0.651  0.706  0.982
 *
 * Method: A. Elfes and H. Moravec 1985; each scan counts once for a cell, as in G. Grisetti and others 2007; rays after
 * J. Amanatides and A. Woo 1987, in integers without an error.
 */
#ifndef IRIS_3D_GRID_H
#define IRIS_3D_GRID_H

#include "iris/3d/scan.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_GRID_SIDE_MAX    4096 /* cells */
#define IRIS_GRID_CELL_MAX_MM 10000

/* What counts as occupied, and as free: p above 0.65, and below 0.196, as map servers of robots have it. */
#define IRIS_ODDS_OCCUPIED 10
#define IRIS_ODDS_FREE     (-23)

/* A floor. Cells are in the caller's memory, row by row: row 0 is the lowest one (y), cell 0 of a row the leftmost (x). */
typedef struct {
    int8_t *odds;               /* w * h of them */
    int32_t w, h;               /* cells, 1 to IRIS_GRID_SIDE_MAX */
    int32_t cell_mm;            /* a cell's side, 1 to IRIS_GRID_CELL_MAX_MM */
    int32_t left_mm, bottom_mm; /* the outer corner of cell (0, 0), within IRIS_MAP_PLACE_MAX_MM */
} iris_grid;

/* Makes *grid in `bytes` bytes at `odds`, which stay the caller's, all cells unknown. corner_mm: left and bottom.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: a number outside its range above, or fewer bytes than cells. O(cells). */
iris_status iris_grid_init(iris_grid *grid, int8_t *odds, size_t bytes, iris_size cells, int32_t cell_mm,
                           const int32_t corner_mm[2]);

/* The odds at a place; 0 outside of the grid. O(1), two divisions. The grid is not checked. */
int32_t iris_grid_at(const iris_grid *grid, int32_t x_mm, int32_t y_mm);

/* What a scan is worth. */
typedef struct {
    int32_t hit;   /* added where a beam ends at something, 1 to 127; default 14: p = 0.706 */
    int32_t miss;  /* taken off where a beam goes through, 1 to 127; default 6: p = 0.407 */
    int32_t limit; /* odds stay within -limit to limit, 1 to 127; default 64: p = 0.018 to 0.982 */
} iris_fusion;

/* As given above. Null is ignored. */
void iris_fusion_defaults(iris_fusion *fusion);

#define IRIS_GRID_FUSE_SCRATCH_BYTES(w, h) IRIS_SCRATCH_ROUND(((size_t)(w) * (size_t)(h) + 31u) / 32u * 4u)

/* Adds a scan taken by a robot at `robot`. A cell counts once in a scan, however many beams meet in it: as hit where one
 * of them ends at something (as the first of them says), else as missed where one goes through. Beams leave the grid at
 * its edge, and what is outside is not kept.
 *
 * A range is not sure: with s the beam's spread and c the cell's side, a hit is worth hit c / (c + s), at least 1; of a
 * beam with s above 2 c it is worth nothing. The beam frees what is nearer than its end less 2 s. What it met is the first
 * occupied cell from there on, if there is one, and else where it ends: walls do not grow backwards.
 *
 * fusion may be null for the defaults. IRIS_ERR_ARG: null pointer, an invalid grid, scan, or fusion; IRIS_ERR_RANGE: the
 * sensor is outside of the grid; IRIS_ERR_SCRATCH: less than IRIS_GRID_FUSE_SCRATCH_BYTES(w, h). Nothing is changed then.
 * O(cells / 32 + beams * cells passed): some comparisons for each. */
iris_status iris_grid_fuse(const iris_grid *grid, iris_map_pose robot, const iris_scan *scan,
                           const iris_fusion *fusion, iris_scratch *scratch);

/* --- as pictures --- */

/* Gray of a map server's picture. */
#define IRIS_GRID_GRAY_OCCUPIED 0
#define IRIS_GRID_GRAY_UNKNOWN  205
#define IRIS_GRID_GRAY_FREE     254

/* The grid as map servers of robots have it, one pixel for a cell, the highest y on top: occupied cells (odds from
 * IRIS_ODDS_OCCUPIED) black, free ones (odds to IRIS_ODDS_FREE) white, others in between.
 * image: IRIS_GRAY8, w x h. IRIS_ERR_ARG: null pointer or invalid grid; errors of iris_image_check; IRIS_ERR_FORMAT;
 * IRIS_ERR_RANGE: another size. O(cells). */
iris_status iris_grid_to_picture(const iris_image *image, const iris_grid *grid);

/* How gray becomes odds. A pixel's p is (255 - gray) / 255, and gray / 255 with negate. */
typedef struct {
    iris_q16 occupied_q16; /* p above this is occupied; default 0.65 */
    iris_q16 free_q16;     /* p below this is free; at most occupied; default 0.196 */
    int32_t negate;        /* not 0: white is occupied */
} iris_grid_shades;

/* As given above. Null is ignored. */
void iris_grid_shades_defaults(iris_grid_shades *shades);

/* The way back: occupied cells get the odds 64, free ones -64, others 0. shades may be null for the defaults.
 * IRIS_ERR_ARG: as above, or thresholds outside 0 to 1 or exchanged; others as above. O(cells). */
iris_status iris_grid_from_picture(const iris_grid *grid, const iris_image *image,
                                   const iris_grid_shades *shades);

#ifdef __cplusplus
}
#endif

#endif
