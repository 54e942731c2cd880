/* What the files of blob.h share. */
#ifndef IRIS_XT_BLOB_PARTS_H
#define IRIS_XT_BLOB_PARTS_H

#include "iris/xt/blob.h"

/* A blob that still grows. 72 bytes, as the header counts. */
typedef struct iris_open_blob {
    int64_t twice_x, y, twelve_xx, twice_xy, yy; /* sums over its pixels, of 12 x^2 at most 2^62 */
    int32_t area, half_edges, corners;
    int32_t euler;            /* runs, less contacts between runs: 1 - holes */
    int16_t left, right, top; /* right: the first column behind it */
    int16_t bottom, first_x;
    uint16_t link; /* to itself, or to the one that it has joined; of an unused one: to the next unused one */
    uint16_t next; /* of those that have joined another in this row */
    uint16_t refs; /* runs of the last two rows that are its own and may touch more */
} iris_open_blob;

typedef struct iris_blob_run {
    uint16_t first, end; /* columns first up to below end */
    uint16_t open;
} iris_blob_run;

/* Is a more than b in the order of the table? */
static inline int iris_blob_is_before(const iris_blob *a, const iris_blob *b)
{
    if (a->area != b->area) {
        return a->area > b->area;
    }
    return a->box.y != b->box.y ? a->box.y < b->box.y : a->first_x < b->first_x;
}

/* One more blob that counts: into the table, if it is among the largest. */
void iris_blob_keep(iris_blob_scan *scan, const iris_blob *blob);

/* Puts the table in order. */
void iris_blob_sort(iris_blob_scan *scan);

/* 1 when a bound of the filter, or the config, has no meaning. */
int iris_blob_config_is_bad(const iris_blob_config *config);

#endif
