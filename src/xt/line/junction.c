#include "iris/xt/junction.h"

#include "../../foundation/views.h"
#include "junction_parts.h"

enum { CLOSEST = 4551 }; /* 25 degrees: arms of a corner or a Y are farther apart than that */

typedef char scratch_as_the_header_says
    [IRIS_JUNCTION_SCRATCH_BYTES(161, 121) == IRIS_GRAPH_SCRATCH_BYTES(161, 121) ? 1 : -1];

void iris_junction_defaults(iris_junction_config *config)
{
    if (config) {
        *config = (iris_junction_config){.branch_permil = 1300, .straight = 3277, .corner = 6372};
    }
}

static int is_valid(const iris_junction_config *config)
{
    return config->branch_permil >= 1000 && config->branch_permil <= 10000 && config->straight >= 0 &&
           config->straight <= 8192 && config->corner >= 1820 && config->corner <= 16384;
}

static void sort_branches(iris_junction *junction)
{
    for (int32_t i = 1; i < junction->branch_count; i++) {
        iris_angle angle = junction->branches[i];
        int32_t k = i;
        for (; k > 0 && junction->branches[k - 1] > angle; k--) {
            junction->branches[k] = junction->branches[k - 1];
        }
        junction->branches[k] = angle;
    }
}

static int32_t confidence(const iris_junction_arm *arms, int32_t count, int32_t width)
{
    int32_t shortest = 3 * width;
    for (int32_t i = 0; i < count; i++) {
        shortest = arms[i].length < shortest ? arms[i].length : shortest;
    }
    return shortest * 1000 / (3 * width);
}

/* The nearest first; of more than there is room for the farthest is dropped. */
static void insert(iris_junction_search *search, const iris_junction *junction)
{
    int32_t last = IRIS_JUNCTIONS_MAX - 1, at = search->count;
    if (at > last) {
        if (search->found[last].y_q4 >= junction->y_q4) {
            return;
        }
        at = last;
    } else {
        search->count++;
    }
    for (; at > 0 && search->found[at - 1].y_q4 < junction->y_q4; at--) {
        search->found[at] = search->found[at - 1];
    }
    search->found[at] = *junction;
}

static int32_t clamp(int32_t value, int32_t most)
{
    return value < 0 ? 0 : value > most ? most : value;
}

/* Do two of the arms run beside each other? Then they are a thick or frayed line, not a corner or a Y. */
static int hug(const iris_junction_arm *arms, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        for (int32_t k = 0; k < i; k++) {
            if (iris_junction_bend(arms[i].angle, arms[k].angle) > 32768 - CLOSEST) {
                return 1;
            }
        }
    }
    return 0;
}

void iris_junction_add(iris_junction_search *search, iris_junction_type type, const iris_junction_arm *arms,
                       int32_t count, iris_graph_point center, int32_t width)
{
    if ((type == IRIS_JUNCTION_CORNER || type == IRIS_JUNCTION_Y) && hug(arms, count)) {
        return;
    }
    iris_junction junction = {.type = type, .width_px = width, .branch_count = count};
    for (int32_t i = 0; i < count; i++) {
        junction.branches[i] = arms[i].angle;
    }
    sort_branches(&junction);
    iris_junction_meet(&junction, arms, count, center, width);
    const iris_image *mask = search->graph->mask;
    junction.x_q4 = clamp(junction.x_q4, (mask->w - 1) * 16);
    junction.y_q4 = clamp(junction.y_q4, (mask->h - 1) * 16);
    junction.distance_rows = mask->h - 1 - ((junction.y_q4 + 8) >> 4);
    junction.distance_rows = junction.distance_rows < 0 ? 0 : junction.distance_rows;
    junction.confidence_permil = confidence(arms, count, width);
    insert(search, &junction);
}

static iris_junction_type type_of(const iris_junction_arm *arms, int32_t count, int32_t straight)
{
    if (count > 3) {
        return IRIS_JUNCTION_CROSSING;
    }
    for (int32_t i = 0; i < 3; i++) {
        if (iris_junction_bend(arms[i].angle, arms[(i + 1) % 3].angle) <= straight) {
            return IRIS_JUNCTION_T;
        }
    }
    return IRIS_JUNCTION_Y;
}

/* The middle of a node's forks. */
static iris_graph_point middle_of(const iris_graph *g, int32_t node)
{
    int32_t x = 0, y = 0, count = 0;
    for (int32_t i = 0; i < g->fork_count; i++) {
        if (g->forks[i].node == node) {
            x += g->forks[i].at.x;
            y += g->forks[i].at.y;
            count++;
        }
    }
    return (iris_graph_point){(int16_t)((x + count / 2) / count), (int16_t)((y + count / 2) / count)};
}

static void look_at_node(iris_junction_search *search, int32_t node)
{
    iris_junction_arm arms[IRIS_JUNCTION_BRANCHES], arm;
    iris_graph *g = search->graph;
    iris_graph_point center = middle_of(g, node);
    int32_t width = 2 * g->forks[node].radius + 1, count = 0;
    int32_t least = search->config->branch_permil * width / 1000;
    if (g->forks[node].radius < iris_junction_least_radius(g) ||
        iris_junction_near_side(g, center, width / 2 + 2)) {
        return;
    }
    for (int32_t i = 0; i < g->way_count; i++) {
        if (!iris_graph_leaves(g, &g->ways[i], node)) {
            continue;
        }
        iris_graph_walk(g, &g->ways[i]);
        if (iris_junction_arm_of(&arm, g, center, width) && count < IRIS_JUNCTION_BRANCHES &&
            arm.length >= least) {
            arms[count++] = arm;
        }
    }
    if (count >= 3) {
        iris_junction_add(search, type_of(arms, count, search->config->straight), arms, count, center, width);
    } else if (count == 2 && iris_junction_bend(arms[0].angle, arms[1].angle) >= search->config->corner) {
        iris_junction_add(search, IRIS_JUNCTION_CORNER, arms, 2, center, width);
    }
}

/* The connected part whose ways are longest: a fork's part, or -1 - the number of a way without forks. */
static int32_t largest_part(const iris_graph *g)
{
    int32_t best = INT32_MIN, most = 0;
    for (int32_t part = 0; part < g->fork_count; part++) {
        int32_t length = 0;
        for (int32_t i = 0; i < g->way_count && g->forks[part].part == part; i++) {
            const iris_graph_way *way = &g->ways[i];
            int mine = way->from >= 0 && g->forks[way->from].part == part;
            length += !mine ? 0 : way->to >= 0 ? way->length : 2 * way->length;
        }
        if (length > most) {
            best = part;
            most = length;
        }
    }
    for (int32_t i = 0; i < g->way_count; i++) {
        if (g->ways[i].from < 0 && 2 * g->ways[i].length > most) {
            best = -1 - i;
            most = 2 * g->ways[i].length;
        }
    }
    return best;
}

/* Does the part touch a side of the image? */
static int reaches_side(iris_graph *g, int32_t part)
{
    for (int32_t i = 0; i < g->way_count; i++) {
        const iris_graph_way *way = &g->ways[i];
        if (way->from < 0 || g->forks[way->from].part != part || way->to >= 0) {
            continue;
        }
        iris_graph_walk(g, way);
        iris_graph_point tip = g->path[g->path_count - 1], before = g->path[g->path_count * 3 / 4];
        int32_t radius = iris_graph_radius(g->mask, before.x, before.y);
        if (iris_junction_near_side(g, tip, 2 * radius + 3)) {
            return 1;
        }
    }
    return 0;
}

/* Ways between two nodes come twice: the one that starts at the lesser fork counts. */
static int is_second(const iris_graph_way *way)
{
    return way->to >= 0 && way->to < way->from;
}

static void search_part(iris_junction_search *search, int32_t part)
{
    iris_graph *g = search->graph;
    if (part < 0) {
        const iris_graph_way *way = &g->ways[-1 - part];
        if (iris_junction_ends(search, way)) {
            iris_graph_walk(g, way);
            iris_junction_corners(search, 0, 0);
        }
        return;
    }
    if (!reaches_side(g, part)) {
        return;
    }
    for (int32_t i = 0; i < g->fork_count; i++) {
        if (g->forks[i].part == part && g->forks[i].node == i) {
            look_at_node(search, i);
        }
    }
    for (int32_t i = 0; i < g->way_count; i++) {
        const iris_graph_way *way = &g->ways[i];
        if (way->from >= 0 && g->forks[way->from].part == part && !is_second(way) &&
            iris_graph_leaves(g, way, g->forks[way->from].node)) {
            iris_graph_walk(g, way);
            iris_junction_corners(search, 1, way->to >= 0);
        }
    }
}

iris_status iris_junctions_find(iris_junction *junctions, int32_t capacity, int32_t *count,
                                const iris_image *mask, const iris_junction_config *config,
                                iris_scratch *scratch)
{
    iris_junction found[IRIS_JUNCTIONS_MAX];
    iris_junction_config used;
    iris_junction_defaults(&used);
    used = config ? *config : used;
    if ((!junctions && capacity != 0) || capacity < 0 || !count || !scratch || !is_valid(&used)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(mask, IRIS_MASK1);
    if (status != IRIS_OK) {
        return status;
    }
    iris_graph graph;
    size_t mark = iris_scratch_mark(scratch);
    status = iris_graph_build(&graph, mask, scratch);
    if (status != IRIS_OK) {
        iris_scratch_release(scratch, mark);
        return status;
    }
    iris_junction_search search = {&graph, &used, found, 0, 0};
    int32_t part = largest_part(&graph);
    if (part != INT32_MIN) {
        search_part(&search, part);
    }
    iris_scratch_release(scratch, mark);
    for (int32_t i = 0; i < search.count && i < capacity; i++) {
        junctions[i] = found[i];
    }
    *count = search.count;
    return search.count > capacity ? IRIS_ERR_FULL : IRIS_OK;
}
