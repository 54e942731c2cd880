#include "iris/xt/region.h"

#include <stdbool.h>

#include "../../foundation/mean.h"

#define NONE (-1)

/* What is known of a region, kept where its first leaf is. 32 bytes, as the header counts. */
typedef struct {
    uint64_t sum[3]; /* of the leaves' means, each times its area */
    uint32_t area;
    union {
        iris_color mean; /* while regions merge */
        int32_t rank;    /* among all of them, afterwards */
    } is;
} region;

/* Parts of the working memory, and the call's labels. */
typedef struct {
    const iris_quadtree *tree;
    int32_t *parent;       /* of each leaf: an earlier one of its region; itself where it is the first */
    region *regions;       /* where parent is itself */
    int32_t *order;        /* first leaves, by the rank of their regions */
    int32_t *above, *left; /* the leaf last met in each column, and in each row */
} work;

/* What one round merges. */
typedef struct {
    int32_t limit; /* of what is compared in this round */
    int32_t tolerance;
    uint32_t least_area; /* 0: regions that are alike; else small ones with any other */
} merging;

void iris_region_defaults(iris_region_config *config)
{
    if (config) {
        *config = (iris_region_config){25, 64};
    }
}

static int32_t difference(iris_color a, iris_color b)
{
    int32_t r = a.r > b.r ? a.r - b.r : b.r - a.r;
    int32_t g = a.g > b.g ? a.g - b.g : b.g - a.g;
    int32_t blue = a.b > b.b ? a.b - b.b : b.b - a.b;
    return r > g ? (r > blue ? r : blue) : (g > blue ? g : blue);
}

/* The first leaf of a leaf's region. The way there gets shorter. */
static int32_t first_of(int32_t *parent, int32_t leaf)
{
    while (parent[leaf] != leaf) {
        parent[leaf] = parent[parent[leaf]];
        leaf = parent[leaf];
    }
    return leaf;
}

static bool is_even(const iris_quadtree *tree, const iris_quadtree_leaf *leaf)
{
    return leaf->w >= IRIS_REGION_EVEN_SIDE && leaf->h >= IRIS_REGION_EVEN_SIDE &&
           leaf->range <= tree->tolerance;
}

/* How far apart the regions of two neighboring leaves may be to become one in this round; NONE: they may not. */
static int32_t most_apart(const work *at, const merging *round, const iris_quadtree_leaf *a,
                          const iris_quadtree_leaf *b)
{
    if (round->least_area > 0) {
        return round->limit;
    }
    int32_t step = difference(a->mean, b->mean);
    if (step > round->limit) {
        return NONE;
    }
    bool is_slow = step <= round->tolerance && is_even(at->tree, a) && is_even(at->tree, b);
    return is_slow ? 255 : round->tolerance;
}

static void join(region *all, const region *joins)
{
    all->area += joins->area;
    for (int c = 0; c < 3; c++) {
        all->sum[c] += joins->sum[c];
    }
    all->is.mean = (iris_color){iris_mean_u8(all->sum[0], all->area), iris_mean_u8(all->sum[1], all->area),
                                iris_mean_u8(all->sum[2], all->area)};
}

static void meet(work *at, const merging *round, int32_t leaf_a, int32_t leaf_b)
{
    if (at->parent[leaf_a] == at->parent[leaf_b]) {
        return;
    }
    int32_t most = most_apart(at, round, &at->tree->leaves[leaf_a], &at->tree->leaves[leaf_b]);
    if (most == NONE) {
        return;
    }
    int32_t a = first_of(at->parent, leaf_a), b = first_of(at->parent, leaf_b);
    int32_t first = a < b ? a : b, second = a < b ? b : a;
    region *all = &at->regions[first], *joins = &at->regions[second];
    bool has_size =
        round->least_area == 0 || all->area < round->least_area || joins->area < round->least_area;
    if (first != second && has_size && difference(all->is.mean, joins->is.mean) <= most) {
        at->parent[second] = first;
        join(all, joins);
    }
}

/* Leaf `leaf` meets those before it that were last in places start..end - 1, and is last there from now on. */
static void meet_side(work *at, const merging *round, int32_t leaf, int32_t *last, int32_t start, int32_t end)
{
    int32_t before = NONE;
    for (int32_t i = start; i < end; i++) {
        if (last[i] != before) {
            before = last[i];
            if (before != NONE) {
                meet(at, round, before, leaf);
            }
        }
        last[i] = leaf;
    }
}

static void merge(work *at, const merging *round)
{
    iris_size size = at->tree->size;
    for (int32_t x = 0; x < size.w; x++) {
        at->above[x] = NONE;
    }
    for (int32_t y = 0; y < size.h; y++) {
        at->left[y] = NONE;
    }
    for (int32_t i = 0; i < at->tree->count; i++) {
        const iris_quadtree_leaf *leaf = &at->tree->leaves[i];
        at->parent[i] = at->parent[at->parent[i]]; /* one step to where its region was before this round */
        meet_side(at, round, i, at->above, leaf->x, leaf->x + leaf->w);
        meet_side(at, round, i, at->left, leaf->y, leaf->y + leaf->h);
    }
}

/* Every leaf is a region. */
static void begin(work *at)
{
    for (int32_t i = 0; i < at->tree->count; i++) {
        const iris_quadtree_leaf *leaf = &at->tree->leaves[i];
        uint32_t area = (uint32_t)leaf->w * leaf->h;
        at->parent[i] = i;
        at->regions[i] = (region){
            {(uint64_t)leaf->mean.r * area, (uint64_t)leaf->mean.g * area, (uint64_t)leaf->mean.b * area},
            area,
            {leaf->mean}};
    }
}

/* Does the region of first leaf a come after that of b? */
static bool is_after(const work *at, int32_t a, int32_t b)
{
    uint32_t area_a = at->regions[a].area, area_b = at->regions[b].area;
    return area_a < area_b || (area_a == area_b && a > b);
}

/* Lets order[i] sink in the heap of the first n, whose latest is on top. */
static void sink(work *at, int32_t i, int32_t n)
{
    int32_t moved = at->order[i];
    for (int32_t child = 2 * i + 1; child < n; child = 2 * i + 1) {
        if (child + 1 < n && is_after(at, at->order[child + 1], at->order[child])) {
            child++;
        }
        if (!is_after(at, at->order[child], moved)) {
            break;
        }
        at->order[i] = at->order[child];
        i = child;
    }
    at->order[i] = moved;
}

/* Puts the regions in order (heap sort). Returns how many they are. */
static int32_t sort(work *at)
{
    int32_t count = 0;
    for (int32_t i = 0; i < at->tree->count; i++) {
        if (at->parent[i] == i) {
            at->order[count++] = i;
        }
    }
    for (int32_t i = count / 2 - 1; i >= 0; i--) {
        sink(at, i, count);
    }
    for (int32_t n = count - 1; n > 0; n--) {
        int32_t last = at->order[0];
        at->order[0] = at->order[n];
        at->order[n] = last;
        sink(at, 0, n);
    }
    return count;
}

/* Adds a leaf to its region in the table. */
static void count_leaf(iris_region *to, const iris_quadtree_leaf *leaf)
{
    int32_t right = leaf->x + leaf->w, below = leaf->y + leaf->h;
    if (to->leaves++ == 0) {
        to->box = (iris_rect){leaf->x, leaf->y, leaf->w, leaf->h};
        return;
    }
    int32_t box_right = to->box.x + to->box.w, box_below = to->box.y + to->box.h;
    to->box.x = leaf->x < to->box.x ? leaf->x : to->box.x;
    to->box.y = leaf->y < to->box.y ? leaf->y : to->box.y;
    to->box.w = (right > box_right ? right : box_right) - to->box.x;
    to->box.h = (below > box_below ? below : box_below) - to->box.y;
}

/* Makes labels of parents, and the table. */
static void finish(iris_region_table *table, work *at)
{
    for (int32_t rank = 0; rank < table->count; rank++) {
        region *from = &at->regions[at->order[rank]];
        if (rank < table->capacity) {
            table->regions[rank] = (iris_region){from->is.mean, (int32_t)from->area, 0, {0, 0, 0, 0}};
        }
        from->is.rank = rank;
    }
    for (int32_t i = at->tree->count - 1; i >= 0; i--) { /* a first leaf after all others of its region */
        int32_t rank = at->regions[first_of(at->parent, i)].is.rank;
        at->parent[i] = rank;
        if (rank < table->capacity) {
            count_leaf(&table->regions[rank], &at->tree->leaves[i]);
        }
    }
}

static iris_status take(work *at, iris_scratch *scratch)
{
    size_t count = (size_t)at->tree->count;
    if (count > SIZE_MAX / 64) {
        return IRIS_ERR_RANGE;
    }
    at->regions = (region *)iris_scratch_take(scratch, count * sizeof(region));
    at->order = (int32_t *)iris_scratch_take(scratch, count * sizeof(int32_t));
    at->above = (int32_t *)iris_scratch_take(scratch, (size_t)at->tree->size.w * sizeof(int32_t));
    at->left = (int32_t *)iris_scratch_take(scratch, (size_t)at->tree->size.h * sizeof(int32_t));
    return at->regions && at->order && at->above && at->left ? IRIS_OK : IRIS_ERR_SCRATCH;
}

iris_status iris_region_merge(iris_region_table *table, const iris_quadtree *tree,
                              const iris_region_config *config, iris_scratch *scratch)
{
    iris_region_config by;
    iris_region_defaults(&by);
    by = config ? *config : by;
    if (!table || !scratch || !table->labels || table->capacity < 0 ||
        (!table->regions && table->capacity > 0) || by.tolerance < 0 || by.tolerance > 255 ||
        by.least_area < 0) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_quadtree_check(tree);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    work at = {tree, table->labels, NULL, NULL, NULL, NULL};
    status = take(&at, scratch);
    if (status == IRIS_OK) {
        begin(&at);
        for (int32_t limit = 15; limit <= 255; limit = 4 * limit + 3) {
            merge(&at, &(merging){limit, by.tolerance, 0});
        }
        for (int32_t limit = 15; limit <= 255 && by.least_area > 0; limit = 4 * limit + 3) {
            merge(&at, &(merging){limit, 0, (uint32_t)by.least_area});
        }
        table->count = sort(&at);
        finish(table, &at);
        status = table->count > table->capacity ? IRIS_ERR_FULL : IRIS_OK;
    }
    iris_scratch_release(scratch, mark);
    return status;
}
