/* The largest blobs: a heap of their places in the table, whose last in order is on top; and their order in the end.
 * */
#include "blob_parts.h"

/* Lets the place at i sink among the first n. */
static void sink(const iris_blob *blobs, int32_t *order, int32_t i, int32_t n)
{
    int32_t moved = order[i];
    for (int32_t child = 2 * i + 1; child < n; child = 2 * i + 1) {
        if (child + 1 < n && iris_blob_is_before(&blobs[order[child]], &blobs[order[child + 1]])) {
            child++;
        }
        if (!iris_blob_is_before(&blobs[moved], &blobs[order[child]])) {
            break;
        }
        order[i] = order[child];
        i = child;
    }
    order[i] = moved;
}

static void make_heap(iris_blob_scan *scan)
{
    for (int32_t i = 0; i < scan->kept; i++) {
        scan->order[i] = i;
    }
    for (int32_t i = scan->kept / 2 - 1; i >= 0; i--) {
        sink(scan->table->blobs, scan->order, i, scan->kept);
    }
}

void iris_blob_keep(iris_blob_scan *scan, const iris_blob *blob)
{
    iris_blob *blobs = scan->table->blobs;
    scan->found++;
    if (scan->kept < scan->table->capacity) {
        blobs[scan->kept++] = *blob;
        return;
    }
    if (scan->kept == 0) {
        return;
    }
    if (scan->found == scan->kept + 1) {
        make_heap(scan);
    }
    if (iris_blob_is_before(blob, &blobs[scan->order[0]])) {
        blobs[scan->order[0]] = *blob;
        sink(blobs, scan->order, 0, scan->kept);
    }
}

/* ---- the order ----
 *
 * Lists of places, linked by `next`. Small blobs are many, and finished nearly in the order of their first pixels: a
 * list for each small area is soon sorted, by merging the runs that already are. */

#define NONE  (-1)
#define AREAS 100 /* areas below have lists of their own */
#define BINS  32

/* The list of two lists in order. */
static int32_t merge(const iris_blob *blobs, int32_t *next, int32_t a, int32_t b)
{
    int32_t first = NONE, *end = &first;
    while (a != NONE && b != NONE) {
        int32_t *least = iris_blob_is_before(&blobs[a], &blobs[b]) ? &a : &b;
        *end = *least;
        end = &next[*least];
        *least = *end;
    }
    *end = a != NONE ? a : b;
    return first;
}

/* A list in order. Bin i holds what 2^i runs have become; there are fewer than 2^31. */
static int32_t sort_list(const iris_blob *blobs, int32_t *next, int32_t list)
{
    int32_t bins[BINS];
    if (list == NONE || next[list] == NONE) {
        return list;
    }
    for (int32_t i = 0; i < BINS; i++) {
        bins[i] = NONE;
    }
    while (list != NONE) {
        int32_t run = list, last = list, i = 0;
        while (next[last] != NONE && iris_blob_is_before(&blobs[last], &blobs[next[last]])) {
            last = next[last];
        }
        list = next[last];
        next[last] = NONE;
        for (; bins[i] != NONE; i++) {
            run = merge(blobs, next, bins[i], run);
            bins[i] = NONE;
        }
        bins[i] = run;
    }
    int32_t all = NONE;
    for (int32_t i = 0; i < BINS; i++) {
        all = merge(blobs, next, bins[i], all);
    }
    return all;
}

/* All places as one list in order. */
static int32_t list_all(const iris_blob_scan *scan)
{
    const iris_blob *blobs = scan->table->blobs;
    int32_t lists[AREAS + 1], all = NONE, *next = scan->order;
    for (int32_t i = 0; i <= AREAS; i++) {
        lists[i] = NONE;
    }
    for (int32_t i = scan->kept - 1; i >= 0; i--) {
        int32_t *list = &lists[(uint32_t)blobs[i].area < AREAS ? blobs[i].area : AREAS];
        next[i] = *list;
        *list = i;
    }
    int32_t *end = &all;
    for (int32_t area = AREAS; area >= 0; area--) {
        *end = sort_list(blobs, next, lists[area]);
        while (*end != NONE) {
            end = &next[*end];
        }
    }
    return all;
}

/* The blobs move to where the list has them. One that has been moved away leaves word of where it went. D. E. Knuth,
 * "The art of computer programming", volume 3, exercise 5.2-12 (M. D. MacLaren). */
void iris_blob_sort(iris_blob_scan *scan)
{
    iris_blob *blobs = scan->table->blobs;
    int32_t *next = scan->order, from = list_all(scan);
    for (int32_t i = 0; i < scan->kept; i++) {
        while (from < i) {
            from = next[from];
        }
        int32_t behind = next[from];
        if (from != i) {
            iris_blob moved = blobs[from];
            blobs[from] = blobs[i];
            blobs[i] = moved;
            next[from] = next[i];
            next[i] = from;
        }
        from = behind;
    }
}
