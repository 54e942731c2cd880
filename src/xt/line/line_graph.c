#include "line_graph.h"

#include <string.h>

enum {
    SPURS = 64,  /* that are taken away in one round */
    ROUNDS = 16, /* of taking away */
    AN_END = -1,
    NOTHING = -2 /* a way that leads to a fork that is not kept */
};

int32_t iris_graph_radius(const iris_image *mask, int32_t x, int32_t y)
{
    /* Sixteen directions; a quarter is enough, the others are turned. 8 fraction bits. */
    static const int16_t c[4] = {256, 237, 181, 98}, s[4] = {0, 98, 181, 237};
    int32_t radius = 0;
    for (;; radius++) {
        int32_t r = radius + 1;
        for (int i = 0; i < 4; i++) {
            int32_t a = (c[i] * r + 128) >> 8, b = (s[i] * r + 128) >> 8;
            if (!iris_graph_has(mask, x + a, y + b) || !iris_graph_has(mask, x - b, y + a) ||
                !iris_graph_has(mask, x - a, y - b) || !iris_graph_has(mask, x + b, y - a)) {
                return radius;
            }
        }
    }
}

static int is_fork(const iris_graph *g, int32_t x, int32_t y)
{
    return iris_skeleton_is_branch(iris_skeleton_neighbors(&g->skeleton, x, y));
}

static int touch(iris_graph_point a, iris_graph_point b)
{
    int32_t x = a.x - b.x, y = a.y - b.y;
    return x >= -1 && x <= 1 && y >= -1 && y <= 1;
}

/* Where a walk has come to. */
typedef struct {
    iris_graph_point at;
    uint8_t back;
    int32_t count; /* pixels walked */
} walker;

/* To the next pixel. Returns 1, or 0 at an end, or at a fork: then `at` is the fork. In the first pixels, what touches
 * the fork it started from is passed by. */
static int step(walker *w, const iris_graph *g, const iris_graph_point *start, int *forked)
{
    unsigned next = iris_skeleton_neighbors(&g->skeleton, w->at.x, w->at.y) & ~(unsigned)w->back;
    int to = -1;
    *forked = 0;
    for (int i = 0; i < 8; i++) {
        iris_graph_point there = {(int16_t)(w->at.x + iris_step_x[i]), (int16_t)(w->at.y + iris_step_y[i])};
        if (!(next >> i & 1)) {
            continue;
        }
        int beside = start && w->count <= 2 && touch(there, *start);
        if (!is_fork(g, there.x, there.y)) {
            to = to < 0 || !beside ? i : to;
        } else if (!beside) {
            w->at = there;
            *forked = 1;
            return 0;
        }
    }
    if (to < 0) {
        return 0;
    }
    w->at.x = (int16_t)(w->at.x + iris_step_x[to]);
    w->at.y = (int16_t)(w->at.y + iris_step_y[to]);
    w->back = (uint8_t)(1u << (to + 4) % 8);
    w->count++;
    return 1;
}

/* --- spurs --- */

typedef struct {
    iris_graph_point end;
    int32_t length;
} spur;

/* Pixels from a point to the nearest side of the image. */
static int32_t to_side(const iris_image *mask, iris_graph_point at)
{
    int32_t x = at.x < mask->w - 1 - at.x ? at.x : mask->w - 1 - at.x;
    int32_t y = at.y < mask->h - 1 - at.y ? at.y : mask->h - 1 - at.y;
    return x < y ? x : y;
}

/* Is the way from this end to a fork hardly longer than the line is wide there? Returns its pixels, or 0. */
static int32_t spur_length(const iris_graph *g, iris_graph_point end, int32_t most)
{
    walker w = {end, 0, 1};
    int forked = 0;
    while (w.count < most && step(&w, g, NULL, &forked)) {
    }
    if (!forked) {
        return 0;
    }
    int32_t radius = iris_graph_radius(g->mask, w.at.x, w.at.y), side = to_side(g->mask, end);
    int32_t beyond = side <= radius ? side : 0; /* the image may cut the line off here */
    return w.count + beyond < 2 * radius + 2 ? w.count : 0;
}

static void erase(const iris_graph *g, const spur *s)
{
    iris_graph_point at = s->end;
    unsigned back = 0;
    for (int32_t k = 0; k < s->length; k++) {
        unsigned next = iris_skeleton_neighbors(&g->skeleton, at.x, at.y) & ~back;
        iris_thinning_clear(&g->skeleton, at.x, at.y);
        int to = 0;
        for (int i = 0; i < 8; i++) {
            to = next >> i & 1 ? i : to;
        }
        if (next == 0) {
            return;
        }
        at.x = (int16_t)(at.x + iris_step_x[to]);
        at.y = (int16_t)(at.y + iris_step_y[to]);
        back = 1u << (to + 4) % 8;
    }
}

/* Fills points with pixels of the skeleton that `of` names, those nearest to the bottom. Returns how many there are. */
static int32_t collect(iris_graph_point *points, int32_t capacity, const iris_graph *g,
                       uint64_t (*of)(const uint64_t *, const uint64_t *, const uint64_t *))
{
    const iris_thinning *t = &g->skeleton;
    int32_t count = 0;
    for (int32_t y = t->h - 1; y >= 0; y--) {
        const uint64_t *row = t->words + (ptrdiff_t)y * t->stride;
        for (int32_t i = 0; i < t->stride; i++) {
            uint64_t bits = row[i] ? of(row + i - t->stride, row + i, row + i + t->stride) : 0;
            for (int32_t x = 64 * i; bits != 0 && count < capacity; x++, bits >>= 1) {
                if (bits & 1) {
                    points[count++] = (iris_graph_point){(int16_t)x, (int16_t)y};
                }
            }
        }
    }
    return count;
}

/* Takes spurs away, all at once, and thins what they leave, as often as it takes. */
static void prune(iris_graph *g)
{
    spur spurs[SPURS];
    for (int round = 0; round < ROUNDS; round++) {
        int32_t count = 0, ends = collect(g->path, g->path_capacity, g, iris_ends_of_word);
        for (int32_t i = 0; i < ends && count < SPURS; i++) {
            int32_t length = spur_length(g, g->path[i], g->path_capacity);
            if (length > 0) {
                spurs[count++] = (spur){g->path[i], length};
            }
        }
        for (int32_t i = 0; i < count; i++) {
            erase(g, &spurs[i]);
        }
        if (count == 0) {
            return;
        }
        (void)iris_thinning_run(&g->skeleton, IRIS_SKELETON_EXACT);
    }
}

/* --- forks and ways --- */

static int32_t fork_at(const iris_graph *g, iris_graph_point at)
{
    for (int32_t i = 0; i < g->fork_count; i++) {
        if (g->forks[i].at.x == at.x && g->forks[i].at.y == at.y) {
            return i;
        }
    }
    return NOTHING;
}

static void collect_forks(iris_graph *g)
{
    g->fork_count =
        collect(g->path, IRIS_GRAPH_FORKS < g->path_capacity ? IRIS_GRAPH_FORKS : g->path_capacity, g,
                iris_branches_of_word);
    for (int32_t i = 0; i < g->fork_count; i++) {
        g->forks[i] = (iris_graph_fork){g->path[i], (int16_t)i, (int16_t)i, (int16_t)i, 0};
        g->forks[i].radius = (int16_t)iris_graph_radius(g->mask, g->path[i].x, g->path[i].y);
    }
    for (int changed = 1; changed;) { /* the least number goes around */
        changed = 0;
        for (int32_t i = 0; i < g->fork_count; i++) {
            for (int32_t k = 0; k < i; k++) {
                int16_t a = g->forks[i].beside, b = g->forks[k].beside;
                if (a != b && touch(g->forks[i].at, g->forks[k].at)) {
                    g->forks[i].beside = g->forks[k].beside = a < b ? a : b;
                    changed = 1;
                }
            }
        }
    }
    for (int32_t i = 0; i < g->fork_count; i++) {
        g->forks[i].node = g->forks[i].part = g->forks[i].beside;
    }
}

static void add_way(iris_graph *g, iris_graph_point first, int32_t from, uint8_t back)
{
    for (int32_t i = 0; i < g->way_count && from >= 0; i++) {
        const iris_graph_way *other = &g->ways[i];
        if (other->first.x == first.x && other->first.y == first.y && other->from >= 0 &&
            g->forks[other->from].beside == g->forks[from].beside) {
            return;
        }
    }
    if (g->way_count == IRIS_GRAPH_WAYS) {
        return;
    }
    const iris_graph_point *start = from >= 0 ? &g->forks[from].at : NULL;
    walker w = {first, back, 1};
    int forked = 0;
    int32_t most = 4 * g->path_capacity;
    while (w.count < most && step(&w, g, start, &forked)) {
    }
    int32_t to = forked ? fork_at(g, w.at) : AN_END;
    if (from >= 0 || to == AN_END) {
        g->ways[g->way_count++] = (iris_graph_way){first, (int16_t)from, (int16_t)to, back, w.count};
    }
}

static void collect_ways(iris_graph *g)
{
    for (int32_t f = 0; f < g->fork_count; f++) {
        iris_graph_point at = g->forks[f].at;
        unsigned around = iris_skeleton_neighbors(&g->skeleton, at.x, at.y);
        for (int i = 0; i < 8; i++) {
            iris_graph_point first = {(int16_t)(at.x + iris_step_x[i]), (int16_t)(at.y + iris_step_y[i])};
            if (around >> i & 1 && !is_fork(g, first.x, first.y)) {
                add_way(g, first, f, (uint8_t)(1u << (i + 4) % 8));
            }
        }
    }
    int32_t ends = collect(g->path, g->path_capacity, g, iris_ends_of_word);
    for (int32_t i = 0; i < ends; i++) {
        add_way(g, g->path[i], AN_END, 0);
    }
}

/* Gives what has the number of one fork in `member` the other's, the lesser. */
static void unite(iris_graph *g, int16_t *(*member)(iris_graph_fork *), int32_t a, int32_t b)
{
    int16_t one = *member(&g->forks[a]), two = *member(&g->forks[b]);
    for (int32_t i = 0; i < g->fork_count; i++) {
        int16_t *number = member(&g->forks[i]);
        if (*number == one || *number == two) {
            *number = one < two ? one : two;
        }
    }
}

static int16_t *node_of(iris_graph_fork *fork)
{
    return &fork->node;
}

static int16_t *part_of(iris_graph_fork *fork)
{
    return &fork->part;
}

/* Two short ways between the same two nodes are a line with a hole in it, such as glare: one node. */
static void close_holes(iris_graph *g)
{
    for (int32_t i = 0; i < g->way_count; i++) {
        const iris_graph_way *a = &g->ways[i];
        for (int32_t k = 0; k < i; k++) {
            const iris_graph_way *b = &g->ways[k];
            if (a->from >= 0 && a->to >= 0 && b->from >= 0 && b->to >= 0 &&
                g->forks[a->from].node == g->forks[b->from].node &&
                g->forks[a->to].node == g->forks[b->to].node && iris_graph_is_hole(g, a) &&
                iris_graph_is_hole(g, b)) {
                unite(g, node_of, a->from, a->to);
            }
        }
    }
}

/* Forks that are hardly farther from each other than the line is wide are one node. */
static void join_forks(iris_graph *g)
{
    for (int32_t i = 0; i < g->way_count; i++) {
        const iris_graph_way *way = &g->ways[i];
        if (way->from < 0 || way->to < 0) {
            continue;
        }
        int32_t a = g->forks[way->from].radius, b = g->forks[way->to].radius;
        unite(g, part_of, way->from, way->to);
        if (way->length <= 2 * (a > b ? a : b) + 1) {
            unite(g, node_of, way->from, way->to);
        }
    }
    close_holes(g);
    for (int32_t i = 0; i < g->fork_count; i++) {
        iris_graph_fork *first = &g->forks[g->forks[i].node];
        first->radius = g->forks[i].radius > first->radius ? g->forks[i].radius : first->radius;
    }
}

iris_status iris_graph_build(iris_graph *graph, const iris_image *mask, iris_scratch *scratch)
{
    iris_size size = {mask->w, mask->h};
    size_t bytes = IRIS_GRAPH_SCRATCH_BYTES(size.w, size.h) - IRIS_SKELETON_SCRATCH_BYTES(size.w, size.h);
    *graph = (iris_graph){.mask = mask, .path_capacity = (int32_t)IRIS_GRAPH_PATH(size.w, size.h)};
    graph->ways = iris_scratch_take(scratch, bytes);
    if (!graph->ways || iris_thinning_begin(&graph->skeleton, size, scratch) != IRIS_OK) {
        return IRIS_ERR_SCRATCH;
    }
    graph->forks = (void *)(graph->ways + IRIS_GRAPH_WAYS);
    graph->path = (void *)(graph->forks + IRIS_GRAPH_FORKS);
    iris_thinning_load(&graph->skeleton, mask);
    (void)iris_thinning_run(&graph->skeleton, IRIS_SKELETON_EXACT);
    prune(graph);
    collect_forks(graph);
    collect_ways(graph);
    join_forks(graph);
    return IRIS_OK;
}

void iris_graph_walk(iris_graph *graph, const iris_graph_way *way)
{
    const iris_graph_point *start = way->from >= 0 ? &graph->forks[way->from].at : NULL;
    walker w = {way->first, way->back, 1};
    int forked = 0;
    graph->path[0] = way->first;
    graph->path_count = 1;
    while (graph->path_count < graph->path_capacity && step(&w, graph, start, &forked)) {
        graph->path[graph->path_count++] = w.at;
    }
}
