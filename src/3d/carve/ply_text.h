/* Numbers as PLY files have them. */
#ifndef IRIS_3D_PLY_TEXT_H
#define IRIS_3D_PLY_TEXT_H

#include "iris/3d/carve_photo.h"

#define IRIS_PLY_NUMBER_CHARS 21
#define IRIS_PLY_VERTEX_CHARS (3 * (IRIS_PLY_NUMBER_CHARS + 1) + 3 * 4)

/* Writes digits of n, at least `least` of them; where they end. */
char *iris_ply_put_whole(char *to, uint64_t n, int least);

/* The line of a vertex, with its color if there is one, and the end of the line; where it ends. */
char *iris_ply_put_vertex(char *to, iris_vec3 place, const iris_carve_color *color);

#endif
