/* A branch: its direction by regression, and how far it reaches. */
#include "junction_parts.h"

int32_t iris_junction_bend(iris_angle a, iris_angle b)
{
    int32_t bend = iris_angle_wrap((int32_t)a - b - 32768);
    return bend < 0 ? -bend : bend;
}

/* The points of the path from `least` up to `most` away from center. */
static iris_moments gather(const iris_graph *g, iris_graph_point center, int32_t least, int32_t most,
                           int32_t margin)
{
    iris_moments moments = {0};
    for (int32_t i = 0; i < g->path_count; i++) {
        int32_t away = iris_junction_distance(g->path[i], center);
        if (away >= least && away <= most && !iris_junction_near_side(g, g->path[i], margin)) {
            iris_moments_add(&moments, g->path[i].x, g->path[i].y);
        } else if (away > most) {
            break;
        }
    }
    return moments;
}

/* From the tip on in the arm's direction through the mask. */
static void reach_out(iris_junction_arm *arm, const iris_graph *g)
{
    int32_t step = 0, x = arm->tip.x, y = arm->tip.y;
    while (iris_graph_has(g->mask, x, y)) {
        step++;
        x = arm->tip.x + (int32_t)iris_round_shift((int64_t)arm->dx_q14 * step, 14);
        y = arm->tip.y + (int32_t)iris_round_shift((int64_t)arm->dy_q14 * step, 14);
    }
    arm->length += step;
    arm->tip = (iris_graph_point){(int16_t)x, (int16_t)y};
    arm->exits |= iris_junction_near_side(g, arm->tip, 1);
}

int iris_junction_is_line(const iris_graph *g, const iris_line *line, iris_graph_point center, int32_t width,
                          int32_t most)
{
    int32_t count = 0, away_q4 = 0, widest = 0, narrowest = INT16_MAX;
    for (int32_t i = 0; i < g->path_count; i++) {
        iris_graph_point p = g->path[i];
        int32_t from = iris_junction_distance(p, center);
        if (from < width || from > most || iris_junction_near_side(g, p, 1 + width / 2)) {
            continue;
        }
        int64_t x_q4 = p.x * 16 - (line->x_q16 >> 12), y_q4 = p.y * 16 - (line->y_q16 >> 12);
        int64_t across = x_q4 * (line->dy >> 16) - y_q4 * (line->dx >> 16);
        away_q4 += (int32_t)((across < 0 ? -across : across) >> 14);
        if (count++ % 4 == 0) {
            int32_t radius = iris_graph_radius(g->mask, p.x, p.y);
            widest = radius > widest ? radius : widest;
            narrowest = radius < narrowest ? radius : narrowest;
        }
    }
    return count == 0 || (away_q4 <= count * (16 + 2 * width) && widest <= 3 * narrowest / 2 + width / 4 + 1);
}

int iris_junction_arm_of(iris_junction_arm *arm, const iris_graph *g, iris_graph_point center, int32_t width)
{
    iris_line line;
    int32_t most = iris_junction_reach(g->mask, 3 * width);
    iris_moments moments = gather(g, center, width, most, width / 2);
    if (moments.n < 3 + width / 2) {
        moments = gather(g, center, width, most, 1);
    }
    if (moments.n < 3) {
        moments = gather(g, center, width / 2, most, 0);
    }
    if (iris_regress_moments(&line, &moments) != IRIS_OK ||
        !iris_junction_is_line(g, &line, center, width, most)) {
        return 0;
    }
    arm->x_q4 = (line.x_q16 + 2048) >> 12;
    arm->y_q4 = (line.y_q16 + 2048) >> 12;
    arm->dx_q14 = (line.dx + 32768) >> 16;
    arm->dy_q14 = (line.dy + 32768) >> 16;
    int64_t along = (int64_t)(arm->x_q4 - center.x * 16) * arm->dx_q14 +
                    (int64_t)(arm->y_q4 - center.y * 16) * arm->dy_q14;
    if (along < 0) {
        arm->dx_q14 = -arm->dx_q14;
        arm->dy_q14 = -arm->dy_q14;
    }
    arm->angle = iris_angle_wrap((int32_t)line.angle + (along < 0 ? 32768 : 0));
    arm->tip = g->path[g->path_count - 1];
    iris_graph_point before = g->path[g->path_count > 2 * width ? g->path_count - 2 * width : 0];
    int32_t radius = iris_graph_radius(g->mask, before.x, before.y);
    arm->length = iris_junction_distance(arm->tip, center);
    arm->exits = iris_junction_near_side(g, arm->tip, 2 * radius + 3);
    arm->thin = radius < iris_junction_least_radius(g);
    reach_out(arm, g);
    return 1;
}

void iris_junction_meet(iris_junction *junction, const iris_junction_arm *arms, int32_t count,
                        iris_graph_point center, int32_t width)
{
    int64_t xx = 0, xy = 0, yy = 0, x = 0, y = 0; /* the least squares of the distances from the lines */
    for (int32_t i = 0; i < count; i++) {
        int64_t nx = -arms[i].dy_q14, ny = arms[i].dx_q14;
        int64_t away = nx * (arms[i].x_q4 - center.x * 16) + ny * (arms[i].y_q4 - center.y * 16);
        xx += nx * nx >> 14;
        xy += nx * ny >> 14;
        yy += ny * ny >> 14;
        x += nx * away >> 14;
        y += ny * away >> 14;
    }
    junction->x_q4 = center.x * 16;
    junction->y_q4 = center.y * 16;
    int64_t whole = xx * yy - xy * xy, limit = (int64_t)width * 32;
    if (whole < 1 << 22) { /* a straight line has no place */
        return;
    }
    int64_t dx = (x * yy - y * xy) / whole, dy = (y * xx - x * xy) / whole;
    if (dx <= limit && dx >= -limit && dy <= limit && dy >= -limit) {
        junction->x_q4 += (int32_t)dx;
        junction->y_q4 += (int32_t)dy;
    }
}
