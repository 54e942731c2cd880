/* What junctions are made of. Only junction*.c include this. */
#ifndef IRIS_XT_JUNCTION_PARTS_H
#define IRIS_XT_JUNCTION_PARTS_H

#include "iris/xt/junction.h"
#include "iris/xt/regress.h"
#include "line_graph.h"

/* A branch as seen from its junction: a line through (x, y) in the direction (dx, dy). */
typedef struct {
    int32_t x_q4, y_q4;
    int32_t dx_q14, dy_q14; /* of length 1, away from the junction */
    iris_angle angle;
    int32_t length; /* from the junction to where the line is lost, pixels */
    int exits;      /* 1: there it leaves the image */
    int thin;       /* 1: there it is too thin to tell an end from the distance */
    iris_graph_point tip;
} iris_junction_arm;

typedef struct {
    iris_graph *graph;
    const iris_junction_config *config;
    iris_junction *found; /* IRIS_JUNCTIONS_MAX */
    int32_t count;
    int exits; /* 1: the line leaves the image somewhere */
} iris_junction_search;

/* The branch that path is, from its first point away from `center`, of a junction of lines `width` wide. Returns 0 when
 * there are too few points. */
int iris_junction_arm_of(iris_junction_arm *arm, const iris_graph *graph, iris_graph_point center,
                         int32_t width);

/* Where the arms' lines meet, if that is not far from center; else center. */
void iris_junction_meet(iris_junction *junction, const iris_junction_arm *arms, int32_t count,
                        iris_graph_point center, int32_t width);

/* By how much the way bends between two arms: 0 when they are one straight line, never negative. */
int32_t iris_junction_bend(iris_angle a, iris_angle b);

/* Fills in places, angles in order, and confidence, and adds the junction to those found. */
void iris_junction_add(iris_junction_search *search, iris_junction_type type, const iris_junction_arm *arms,
                       int32_t count, iris_graph_point center, int32_t width);

/* Is a point less than `margin` from a side of the image? */
static inline int iris_junction_near_side(const iris_graph *g, iris_graph_point p, int32_t margin)
{
    return p.x < margin || p.y < margin || p.x >= g->mask->w - margin || p.y >= g->mask->h - margin;
}

/* Do the path's points from `width` up to `most` away from center keep to the line, and is it of one width there? */
int iris_junction_is_line(const iris_graph *g, const iris_line *line, iris_graph_point center, int32_t width,
                          int32_t most);

/* Of a line: thinner ones are noise, or so far away that they fade. */
static inline int32_t iris_junction_least_radius(const iris_graph *g)
{
    return 1 + g->mask->w / 240;
}

/* junction_corner.c: corners of the path, which leads from one node or end to another. */
void iris_junction_corners(iris_junction_search *search, int from_node, int to_node);

/* junction_end.c: the ends of a line without a junction: where it stops, or turns behind a gap. Returns 0 when it does
 * not leave the image, which is no robot's line. */
int iris_junction_ends(iris_junction_search *search, const iris_graph_way *way);

/* How far from a junction the points of a branch tell its direction: `widths`, or more where the line is thin. */
static inline int32_t iris_junction_reach(const iris_image *mask, int32_t widths)
{
    return widths > mask->w / 8 ? widths : mask->w / 8;
}

static inline int32_t iris_junction_distance(iris_graph_point a, iris_graph_point b)
{
    return (int32_t)iris_hypot(a.x - b.x, a.y - b.y);
}

#endif
