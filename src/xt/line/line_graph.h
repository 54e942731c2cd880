/* A mask of lines as a graph: its skeleton without spurs, the nodes where lines meet, and the ways that lead from a
 * node or an end to the next. Distances are pixels; a radius is that of the largest disc around a point inside of the
 * mask.
 */
#ifndef IRIS_XT_LINE_GRAPH_H
#define IRIS_XT_LINE_GRAPH_H

#include "../mask/skeleton_parts.h"

#define IRIS_GRAPH_FORKS 96  /* branch points that are kept, those nearest to the bottom */
#define IRIS_GRAPH_WAYS  160 /* ways that are kept */

typedef struct {
    int16_t x, y;
} iris_graph_point;

/* A branch point of the skeleton. */
typedef struct {
    iris_graph_point at;
    int16_t beside; /* the first of the forks that touch each other in a row */
    int16_t node;   /* the first fork of its node */
    int16_t part;   /* number of the connected part that it belongs to: that of one of its forks */
    int16_t radius; /* of a node's first fork: the largest of the node */
} iris_graph_fork;

/* A way as it is walked from one of its ends; ways between two forks come twice. */
typedef struct {
    iris_graph_point first; /* its first pixel, that is no fork */
    int16_t from, to;       /* forks; -1: an end */
    uint8_t back;           /* the bit of the first pixel's neighbor that it comes from; 0: none */
    int32_t length;         /* pixels */
} iris_graph_way;

typedef struct {
    const iris_image *mask;
    iris_thinning skeleton;
    int32_t fork_count, way_count;
    iris_graph_fork *forks;
    iris_graph_way *ways;
    iris_graph_point *path; /* the way that was walked last */
    int32_t path_count, path_capacity;
} iris_graph;

/* Points of a way that are looked at, from its start. */
#define IRIS_GRAPH_PATH(w, h) (2u * ((size_t)(w) + (size_t)(h)))

#define IRIS_GRAPH_SCRATCH_BYTES(w, h)                                                                       \
    (IRIS_SKELETON_SCRATCH_BYTES(w, h) +                                                                     \
     IRIS_SCRATCH_ROUND(IRIS_GRAPH_FORKS * sizeof(iris_graph_fork) +                                         \
                        IRIS_GRAPH_WAYS * sizeof(iris_graph_way) +                                           \
                        IRIS_GRAPH_PATH(w, h) * sizeof(iris_graph_point)))

/* Thins, prunes, and collects forks and ways. The mask is checked. IRIS_ERR_SCRATCH. */
iris_status iris_graph_build(iris_graph *graph, const iris_image *mask, iris_scratch *scratch);

/* Walks the way into path. */
void iris_graph_walk(iris_graph *graph, const iris_graph_way *way);

/* Is the pixel in the picture, and selected? */
static inline int iris_graph_has(const iris_image *mask, int32_t x, int32_t y)
{
    if (x < 0 || y < 0 || x >= mask->w || y >= mask->h) {
        return 0;
    }
    const uint32_t *row = iris_image_row(mask, y);
    return row[x / 32] >> x % 32 & 1;
}

/* Is a way between two forks so short that two of them are the sides of a hole, and one alone belongs to its node? */
static inline int iris_graph_is_hole(const iris_graph *g, const iris_graph_way *way)
{
    int32_t a = g->forks[way->from].radius, b = g->forks[way->to].radius;
    return way->length <= 10 * (a > b ? a : b) + 4;
}

/* Does the way lead out of the node? The sides of a hole do not. */
static inline int iris_graph_leaves(const iris_graph *g, const iris_graph_way *way, int32_t node)
{
    return way->from >= 0 && g->forks[way->from].node == node &&
           !(way->to >= 0 && g->forks[way->to].node == node && iris_graph_is_hole(g, way));
}

int32_t iris_graph_radius(const iris_image *mask, int32_t x, int32_t y);

#endif
