/* IRIS-3D - the text beside a map's picture, as map servers of robots read and write it (YAML): a map is a PGM
 * (iris_grid_to_picture) and
 *
 *     image: floor.pgm                  the picture's file
 *     resolution: 0.050                 meters to a cell
 *     origin: [-1.250, 3.000, 0.000]    of the lower left cell's outer corner, meters; turned by no angle
 *     negate: 0                         1: white is occupied
 *     occupied_thresh: 0.650
 *     free_thresh: 0.196
 */
#ifndef IRIS_3D_MAP_TEXT_H
#define IRIS_3D_MAP_TEXT_H

#include "iris/3d/grid.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_MAP_IMAGE_BYTES 200 /* of the picture's file name, with the 0 at its end */
#define IRIS_MAP_TEXT_BYTES  448 /* enough for every map, with the 0 at the end */

typedef struct {
    char image[IRIS_MAP_IMAGE_BYTES];
    int32_t cell_mm, left_mm, bottom_mm; /* as in iris_grid */
    iris_grid_shades shades;
} iris_map_text;

/* *length: without the 0. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: more than `capacity` bytes, a number outside the
 * range that grid.h has, or a file name that is empty, without an end, or has quotes, a #, control characters, or a blank at
 * an end; *text is untouched. O(1). */
iris_status iris_map_write_text(char *text, size_t capacity, size_t *length, const iris_map_text *map);

/* Reads `bytes` bytes of any content; a 0 at their end is no part of the text. Keys in any order; image, resolution, and
 * origin must be there, other keys than those above do not count. What stands behind a # is none of it. Places are rounded
 * to millimeters, thresholds to 16 fraction bits.
 * IRIS_ERR_ARG: null pointer. The others set *line, the line that is wrong, from 1, and nothing else: IRIS_ERR_UNSUPPORTED:
 * cells that are no whole millimeters, an origin with an angle, or a mode that is not trinary; IRIS_ERR_TRUNCATED: a key
 * is missing; IRIS_ERR_DATA: anything else, a key that comes twice among them. O(bytes). */
iris_status iris_map_read_text(iris_map_text *map, int32_t *line, const char *text, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif
