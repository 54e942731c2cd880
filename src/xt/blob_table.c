/* The largest blobs: a heap of their places in the table, whose last in order is on top. */
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

void iris_blob_sort(iris_blob_scan *scan)
{
    iris_blob *blobs = scan->table->blobs;
    int32_t *order = scan->order;
    if (scan->found <= scan->kept) {
        make_heap(scan);
    }
    for (int32_t n = scan->kept - 1; n > 0; n--) {
        int32_t last = order[0];
        order[0] = order[n];
        order[n] = last;
        sink(blobs, order, 0, n);
    }
    for (int32_t i = 0; i < scan->kept; i++) { /* along each circle of places */
        iris_blob first = blobs[i];
        int32_t to = i;
        for (int32_t from = order[i]; from != i; from = order[from]) {
            blobs[to] = blobs[from];
            order[to] = to;
            to = from;
        }
        blobs[to] = first;
        order[to] = to;
    }
}
