/* Osiris - world files: a world to simulate robots in, as a text that people write. Files are in examples/worlds.
 *
 *     wall X Y X Y [X Y ...]                mm; from place to place
 *     line X Y X Y [X Y ...]                painted on the floor
 *     object X Y [radius MM] [color C]      50, red; C: red, orange, yellow, green, cyan, blue, purple, white, gray, black, or
 *                                           six hexadecimal digits, RRGGBB
 *     start X Y [facing DEGREES]            where a robot begins, the first at the first; counterclockwise from x
 *
 * What follows a # does not count.
 */
#ifndef IRIS_OSIRIS_WORLD_TEXT_H
#define IRIS_OSIRIS_WORLD_TEXT_H

#include <stddef.h>

#include "iris/osiris/problem.h"
#include "iris/osiris/world.h"

#ifdef __cplusplus
extern "C" {
#endif

#define OSIRIS_WALLS_MAX   512
#define OSIRIS_LINES_MAX   1024
#define OSIRIS_OBJECTS_MAX 64
#define OSIRIS_STARTS_MAX  64

/* Where a world from a file lives: 26 KB, the caller's. */
typedef struct {
    osiris_segment walls[OSIRIS_WALLS_MAX];
    osiris_segment lines[OSIRIS_LINES_MAX];
    osiris_object objects[OSIRIS_OBJECTS_MAX];
    osiris_pose starts[OSIRIS_STARTS_MAX];
} osiris_world_memory;

/* Reads `bytes` bytes of any content; a 0 at their end is no part of the text. *world is in *memory then, and
 * osiris_world_check accepts it.
 * IRIS_ERR_ARG: null pointer. The others set *problem, and *world and *memory are of no use: IRIS_ERR_FULL: more of a kind
 * than there is room for; IRIS_ERR_DATA: anything else. O(bytes). */
iris_status osiris_world_read_text(osiris_world *world, osiris_world_memory *memory, osiris_problem *problem,
                                   const char *text, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif
