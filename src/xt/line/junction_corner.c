/* Corners: where a line between two junctions or ends bends sharply, and not all along. */
#include "junction_parts.h"

/* The first point of the path from i on in steps of `by` that is `away` from point i; -1: none. */
static int32_t far_point(const iris_graph *g, int32_t i, int32_t by, int32_t away)
{
    for (int32_t k = i; k >= 0 && k < g->path_count; k += by) {
        if (iris_junction_distance(g->path[k], g->path[i]) >= away) {
            return k;
        }
    }
    return -1;
}

static iris_angle direction(iris_graph_point from, iris_graph_point to)
{
    return iris_atan2_angle(to.x - from.x, from.y - to.y);
}

/* By how much the path bends at point i, seen over `away` pixels to both sides; -1: a side is too short. */
static int32_t bend_at(const iris_graph *g, int32_t i, int32_t away)
{
    int32_t before = far_point(g, i, -1, away), behind = far_point(g, i, 1, away);
    if (before < 0 || behind < 0) {
        return -1;
    }
    return iris_junction_bend(direction(g->path[i], g->path[before]), direction(g->path[i], g->path[behind]));
}

/* One side of a corner at point i: its arm by the path's points on that side, and its direction farther away. */
static int side_of(iris_junction_arm *arm, iris_angle *farther, const iris_graph *g, int32_t i, int32_t by,
                   int32_t width)
{
    int32_t reach = iris_junction_reach(g->mask, 5 * width / 2);
    iris_moments moments = {0};
    iris_line line;
    for (int32_t k = i; k >= 0 && k < g->path_count; k += by) {
        int32_t away = iris_junction_distance(g->path[k], g->path[i]);
        if (away * 4 >= 3 * width && away <= reach) {
            iris_moments_add(&moments, g->path[k].x, g->path[k].y);
        }
    }
    iris_graph side = *g;
    side.path = by > 0 ? g->path + i : g->path;
    side.path_count = by > 0 ? g->path_count - i : i + 1;
    if (moments.n < 3 || iris_regress_moments(&line, &moments) != IRIS_OK ||
        !iris_junction_is_line(&side, &line, g->path[i], 3 * width / 2, reach)) {
        return 0;
    }
    *arm = (iris_junction_arm){.x_q4 = (line.x_q16 + 2048) >> 12, .y_q4 = (line.y_q16 + 2048) >> 12};
    arm->dx_q14 = (line.dx + 32768) >> 16;
    arm->dy_q14 = (line.dy + 32768) >> 16;
    int64_t along = (int64_t)(arm->x_q4 - g->path[i].x * 16) * arm->dx_q14 +
                    (int64_t)(arm->y_q4 - g->path[i].y * 16) * arm->dy_q14;
    arm->angle = iris_angle_wrap((int32_t)line.angle + (along < 0 ? 32768 : 0));
    arm->tip = g->path[by > 0 ? g->path_count - 1 : 0];
    arm->length = iris_junction_distance(arm->tip, g->path[i]) + width;
    int32_t near = far_point(g, i, by, reach), far = far_point(g, i, by, reach + 3 * width / 2);
    *farther = far >= 0 ? direction(g->path[near], g->path[far]) : arm->angle;
    return 1;
}

static int try_corner(iris_junction_search *search, int32_t i, int32_t width)
{
    iris_junction_arm arms[2];
    iris_angle farther[2];
    const iris_graph *g = search->graph;
    if (!side_of(&arms[0], &farther[0], g, i, -1, width) || !side_of(&arms[1], &farther[1], g, i, 1, width)) {
        return 0;
    }
    int32_t bend = iris_junction_bend(arms[0].angle, arms[1].angle);
    int32_t bend_farther = iris_junction_bend(farther[0], farther[1]);
    int32_t least = search->config->branch_permil * width / 1000;
    if (bend < search->config->corner || bend * 4 < bend_farther * 3 || arms[0].length < least ||
        arms[1].length < least) {
        return 0;
    }
    iris_junction_add(search, IRIS_JUNCTION_CORNER, arms, 2, g->path[i], width);
    return 1;
}

/* Does a side of the image cut the line here? */
static int is_cut(const iris_graph *g, iris_graph_point p)
{
    return iris_junction_near_side(g, p, 1 + iris_graph_radius(g->mask, p.x, p.y));
}

/* Where the image cuts a line off slantwise, the middle of what is left bends: without these points. */
static void trim(iris_graph *g)
{
    while (g->path_count > 0 && is_cut(g, g->path[g->path_count - 1])) {
        g->path_count--;
    }
    while (g->path_count > 0 && is_cut(g, g->path[0])) {
        g->path++;
        g->path_count--;
    }
}

void iris_junction_corners(iris_junction_search *search, int from_node, int to_node)
{
    iris_graph *g = search->graph;
    iris_graph_point *path = g->path;
    trim(g);
    for (int32_t i = 0; i < g->path_count;) {
        int32_t radius = iris_graph_radius(g->mask, g->path[i].x, g->path[i].y), width = 2 * radius + 1;
        int32_t margin = 2 * width, away = width > 5 ? width : 5, best = -1, most = 0, k = i;
        for (; k < g->path_count && (k < i + 2 * width || (best >= 0 && k <= best + 2 * away)); k++) {
            int32_t bend = (from_node && k < margin) || (to_node && g->path_count - 1 - k < margin) ||
                                   iris_junction_near_side(g, g->path[k], width)
                               ? -1
                               : bend_at(g, k, away);
            if (bend > most) {
                best = k;
                most = bend;
            }
        }
        if (best >= 0 && most * 4 >= search->config->corner * 3) {
            width = 2 * iris_graph_radius(g->mask, g->path[best].x, g->path[best].y) + 1;
            if (try_corner(search, best, width)) {
                k = best + 3 * (width > 5 ? width : 5);
            }
        }
        i = k;
    }
    g->path = path;
}
