#include "iris/xt/paths.h"

#include "../../foundation/views.h"
#include "junction_parts.h"
#include "paths_list.h"

typedef char
    scratch_as_the_header_says[IRIS_PATHS_SCRATCH_BYTES(161, 121) == IRIS_GRAPH_SCRATCH_BYTES(161, 121) ? 1
                                                                                                        : -1];

/* Which ways belong to one line: the number of the first of them. */
typedef struct {
    iris_graph *graph;
    int16_t line[IRIS_GRAPH_WAYS];
} lines;

static void unite(lines *l, int32_t a, int32_t b)
{
    int16_t one = l->line[a], two = l->line[b];
    for (int32_t i = 0; i < l->graph->way_count; i++) {
        if (l->line[i] == one || l->line[i] == two) {
            l->line[i] = one < two ? one : two;
        }
    }
}

/* Is one the other, walked from its other end? */
static int is_twin(const iris_graph_way *a, const iris_graph_way *b)
{
    return a->from >= 0 && a->to >= 0 && a->from == b->to && a->to == b->from && a->length == b->length;
}

/* The ways out of a node, each with its angle there. */
typedef struct {
    int16_t way[2 * IRIS_JUNCTION_BRANCHES];
    iris_angle angle[2 * IRIS_JUNCTION_BRANCHES];
    int32_t count;
} ways_out;

static void collect(ways_out *out, iris_graph *g, int32_t node)
{
    int32_t x = 0, y = 0, count = 0;
    for (int32_t i = 0; i < g->fork_count; i++) {
        if (g->forks[i].node == node) {
            x += g->forks[i].at.x;
            y += g->forks[i].at.y;
            count++;
        }
    }
    iris_graph_point center = {(int16_t)(x / count), (int16_t)(y / count)};
    out->count = 0;
    for (int32_t i = 0; i < g->way_count; i++) {
        const iris_graph_way *way = &g->ways[i];
        iris_junction_arm arm;
        if (!iris_graph_leaves(g, way, node) || out->count == 2 * IRIS_JUNCTION_BRANCHES) {
            continue;
        }
        iris_graph_walk(g, way);
        if (iris_junction_arm_of(&arm, g, center, 2 * g->forks[node].radius + 1)) {
            out->way[out->count] = (int16_t)i;
            out->angle[out->count++] = arm.angle;
        }
    }
}

/* Joins the two ways that are straightest, then the next two, as long as they are straight. */
static void join_through(lines *l, int32_t node, int32_t straight)
{
    ways_out out;
    collect(&out, l->graph, node);
    for (;;) {
        int32_t best_a = -1, best_b = -1, least = straight + 1;
        for (int32_t a = 0; a < out.count; a++) {
            for (int32_t b = 0; b < a; b++) {
                int32_t bend = out.way[a] >= 0 && out.way[b] >= 0
                                   ? iris_junction_bend(out.angle[a], out.angle[b])
                                   : least;
                if (bend < least) {
                    best_a = a;
                    best_b = b;
                    least = bend;
                }
            }
        }
        if (best_a < 0) {
            return;
        }
        unite(l, out.way[best_a], out.way[best_b]);
        out.way[best_a] = out.way[best_b] = -1;
    }
}

/* Fits a line to its ways, and adds it. Ways that come twice are taken twice: that changes no regression. */
static void fit(iris_path_list *list, const lines *l, int32_t number)
{
    iris_graph *g = l->graph;
    iris_moments moments = {0};
    int64_t radius = 0;
    int32_t count = 0;
    for (int32_t i = 0; i < g->way_count; i++) {
        if (l->line[i] != number) {
            continue;
        }
        iris_graph_walk(g, &g->ways[i]);
        for (int32_t k = 0; k < g->path_count; k++) {
            iris_moments_add(&moments, g->path[k].x, g->path[k].y);
            if (k % 4 == 0) {
                radius += iris_graph_radius(g->mask, g->path[k].x, g->path[k].y);
                count++;
            }
        }
    }
    iris_line line;
    if (count == 0 || iris_regress_moments(&line, &moments) != IRIS_OK) {
        return;
    }
    iris_path_reach reach = {INT32_MAX, INT32_MIN};
    for (int32_t i = 0; i < g->way_count; i++) {
        if (l->line[i] == number) {
            iris_graph_walk(g, &g->ways[i]);
            iris_path_reach_add(&reach, &line, g->path[0].x, g->path[0].y);
            iris_graph_point last = g->path[g->path_count - 1];
            iris_path_reach_add(&reach, &line, last.x, last.y);
        }
    }
    int32_t mean = (int32_t)(radius / count);
    iris_path_list_add(list, &line, &reach, (int32_t)((2 * radius + count / 2) / count) + 1, mean);
}

static void tell_apart(iris_path_list *list, lines *l)
{
    iris_graph *g = l->graph;
    for (int32_t i = 0; i < g->way_count; i++) {
        l->line[i] = (int16_t)i;
    }
    for (int32_t i = 0; i < g->way_count; i++) {
        for (int32_t k = 0; k < i; k++) {
            /* a line without forks is walked from both ends */
            int ends = g->ways[i].from < 0 && g->ways[k].from < 0 && g->ways[i].length == g->ways[k].length;
            if (ends) {
                iris_graph_walk(g, &g->ways[i]);
                iris_graph_point last = g->path[g->path_count - 1];
                ends = last.x == g->ways[k].first.x && last.y == g->ways[k].first.y;
            }
            if (ends || is_twin(&g->ways[i], &g->ways[k])) {
                unite(l, i, k);
            }
        }
    }
    for (int32_t i = 0; i < g->fork_count; i++) {
        if (g->forks[i].node == i) {
            join_through(l, i, list->config->straight);
        }
    }
    for (int32_t i = 0; i < g->way_count; i++) {
        const iris_graph_way *way = &g->ways[i];
        if (l->line[i] == i && (way->from < 0 || iris_graph_leaves(g, way, g->forks[way->from].node))) {
            fit(list, l, i);
        }
    }
}

iris_status iris_paths_find(iris_path *paths, int32_t capacity, int32_t *count, const iris_image *mask,
                            const iris_paths_config *config, iris_scratch *scratch)
{
    iris_paths_config used;
    iris_paths_defaults(&used);
    used = config ? *config : used;
    if ((!paths && capacity != 0) || capacity < 0 || !count || !scratch || !iris_paths_are_valid(&used)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(mask, IRIS_MASK1);
    if (status != IRIS_OK) {
        return status;
    }
    iris_graph graph;
    lines l = {.graph = &graph};
    size_t mark = iris_scratch_mark(scratch);
    status = iris_graph_build(&graph, mask, scratch);
    if (status == IRIS_OK) {
        iris_path_list list = {paths, capacity, 0, &used, {mask->w, mask->h}};
        tell_apart(&list, &l);
        *count = list.count;
        status = list.count > capacity ? IRIS_ERR_FULL : IRIS_OK;
    }
    iris_scratch_release(scratch, mark);
    return status;
}
