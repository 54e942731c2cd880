/* Ends: where a line stops in the image, goes on behind a gap, or turns there, as tape does that is laid in pieces. */
#include "junction_parts.h"

enum { SHARPEST = 24576 }; /* 135 degrees: a sharper corner with a gap in it is two lines beside each other */

/* An end of a way. Its arm leads to the tip. Skeletons of short pieces run into their corners: the line is narrow there,
 * and as wide as it is only before. */
typedef struct {
    iris_junction_arm arm;
    int32_t width, widest; /* of the line there; of the way on its last widths */
    int32_t length;        /* of the way */
} line_end;

static iris_graph_point along(const iris_junction_arm *arm, int32_t step)
{
    int32_t x = arm->tip.x + (int32_t)iris_round_shift((int64_t)arm->dx_q14 * step, 14);
    int32_t y = arm->tip.y + (int32_t)iris_round_shift((int64_t)arm->dy_q14 * step, 14);
    return (iris_graph_point){(int16_t)x, (int16_t)y};
}

/* How many steps of the arm's direction from its tip the mask begins again; `most`: not before. */
static int32_t gap_of(const iris_image *mask, const iris_junction_arm *arm, int32_t most)
{
    for (int32_t step = 2; step < most; step++) {
        iris_graph_point p = along(arm, step);
        if (iris_graph_has(mask, p.x, p.y)) {
            return step;
        }
    }
    return most;
}

/* Does the line go on behind the end, after a gap of up to three widths? What lies across there is another line. */
static int goes_on(const iris_image *mask, const line_end *end)
{
    int32_t gap = gap_of(mask, &end->arm, 4 * end->width), run = 0;
    if (gap <= 2 * end->width || gap == 4 * end->width) {
        return gap <= 2 * end->width;
    }
    iris_junction_arm side = end->arm;
    side.tip = along(&end->arm, gap + end->width / 4);
    side.dx_q14 = -end->arm.dy_q14;
    side.dy_q14 = end->arm.dx_q14;
    for (int by = -1; by <= 1; by += 2) {
        int32_t step = 0;
        for (iris_graph_point p = side.tip; iris_graph_has(mask, p.x, p.y); p = along(&side, step)) {
            step += by;
        }
        run += step * by;
    }
    return run <= 2 * end->width;
}

static void turn_around(iris_graph *g)
{
    for (int32_t i = 0, k = g->path_count - 1; i < k; i++, k--) {
        iris_graph_point kept = g->path[i];
        g->path[i] = g->path[k];
        g->path[k] = kept;
    }
}

/* The line at the last point of a way, or at the first one, as it is seen from some widths before it. Returns 0 when
 * there is too little of it. */
static int end_of(line_end *end, iris_graph *g, const iris_graph_way *way, int first)
{
    iris_graph_walk(g, way);
    if (first) {
        turn_around(g);
    }
    int32_t last = g->path_count - 1, half = last / 2;
    int32_t radius = iris_graph_radius(g->mask, g->path[half].x, g->path[half].y);
    iris_graph part = *g;
    int32_t from = last - 8 * radius - 4 > 0 ? last - 8 * radius - 4 : 0;
    iris_graph_point near = g->path[last - 2 * radius > from ? last - 2 * radius : from];
    radius = iris_graph_radius(g->mask, near.x, near.y);
    part.path += from;
    part.path_count -= from;
    *end = (line_end){.width = 2 * radius + 1, .length = way->length};
    end->arm.exits = iris_junction_near_side(g, g->path[last], 2 * radius + 3);
    for (int32_t i = 0; i < part.path_count; i += 4) {
        int32_t width = 2 * iris_graph_radius(g->mask, part.path[i].x, part.path[i].y) + 1;
        end->widest = width > end->widest ? width : end->widest;
    }
    return iris_junction_arm_of(&end->arm, &part, part.path[0], end->width);
}

/* How far behind a's tip its line meets b's, whose direction is another. */
static int32_t steps_to(const iris_junction_arm *a, const iris_junction_arm *b)
{
    int64_t x = b->tip.x - a->tip.x, y = b->tip.y - a->tip.y;
    int64_t across = ((int64_t)a->dx_q14 * b->dy_q14 - (int64_t)a->dy_q14 * b->dx_q14) >> 14;
    return (int32_t)((x * b->dy_q14 - y * b->dx_q14) / across);
}

/* Are these ends the two sides of a corner with a gap in it? Up to one and a half widths, as tape is laid, and half a
 * width from the side of the other piece to its middle. Crumbs, shorter than about two widths, are no piece. */
static int is_corner(const iris_junction_search *search, const line_end *a, const line_end *b)
{
    const iris_graph *g = search->graph;
    int32_t width = (a->widest + b->widest) / 2, bend = iris_junction_bend(a->arm.angle, b->arm.angle);
    if (b->arm.thin || iris_junction_near_side(g, a->arm.tip, 3) ||
        iris_junction_near_side(g, b->arm.tip, 3) || a->widest > 3 * b->widest || b->widest > 3 * a->widest ||
        b->length < width || bend < search->config->corner || bend > SHARPEST ||
        iris_junction_distance(a->arm.tip, b->arm.tip) > 2 * width) {
        return 0;
    }
    int32_t to_b = steps_to(&a->arm, &b->arm), to_a = steps_to(&b->arm, &a->arm);
    return to_b >= -width && to_a >= -width && to_b <= 2 * width && to_a <= 2 * width;
}

/* As it leads away from the tip. */
static iris_junction_arm away_from_tip(const line_end *end)
{
    iris_junction_arm arm = end->arm;
    arm.angle = iris_angle_wrap((int32_t)arm.angle + 32768);
    arm.length = end->length;
    return arm;
}

/* The skeleton of a piece shorter than it is wide tells no direction, but a place in the piece. */
static void aim(iris_junction_arm *arm, iris_graph_point from, iris_graph_point at)
{
    arm->angle = iris_atan2_angle(at.x - from.x, from.y - at.y);
    arm->x_q4 = at.x * 16;
    arm->y_q4 = at.y * 16;
    arm->dx_q14 = iris_sin_q30(arm->angle) >> 16;
    arm->dy_q14 = -(iris_cos_q30(arm->angle) >> 16);
}

/* Adds the corner that the line has behind this end of a way after a gap. Returns 0 when there is none, as when the way
 * comes back to where it began. */
static int add_corner(iris_junction_search *search, const line_end *end, const line_end *beginning)
{
    iris_graph *g = search->graph;
    line_end other;
    for (int32_t i = 0; i < g->way_count; i++) { /* ways between two ends come twice */
        if (g->ways[i].to != -1 || !end_of(&other, g, &g->ways[i], 0) || !is_corner(search, end, &other) ||
            iris_junction_distance(other.arm.tip, beginning->arm.tip) == 0) {
            continue;
        }
        iris_graph_point a = end->arm.tip, b = other.arm.tip;
        iris_graph_point middle = {(int16_t)((a.x + b.x) / 2), (int16_t)((a.y + b.y) / 2)};
        iris_junction_arm arms[2] = {away_from_tip(end), away_from_tip(&other)};
        if (other.length < other.widest) {
            aim(&arms[1], middle, g->path[0]);
        }
        iris_junction_add(search, IRIS_JUNCTION_CORNER, arms, 2, middle, (end->widest + other.widest) / 2);
        return 1;
    }
    return 0;
}

int iris_junction_ends(iris_junction_search *search, const iris_graph_way *way)
{
    line_end ends[2];
    iris_graph *g = search->graph;
    int known[2];
    for (int i = 0; i < 2; i++) {
        known[i] = end_of(&ends[i], g, way, i == 0);
    }
    if (!ends[0].arm.exits && !ends[1].arm.exits) {
        return 0;
    }
    for (int i = 0; i < 2; i++) {
        const line_end *end = &ends[i];
        int too_short = (end->length + end->width) * 1000 < search->config->branch_permil * end->width;
        if (!known[i] || end->arm.thin || too_short || add_corner(search, end, &ends[1 - i]) ||
            end->arm.exits || goes_on(g->mask, end)) {
            continue;
        }
        iris_junction_arm arm = away_from_tip(end);
        iris_junction_add(search, IRIS_JUNCTION_END, &arm, 1, arm.tip, end->width);
    }
    return 1;
}
