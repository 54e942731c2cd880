/* The mask of one blob: run by run, until no row has another run that touches it. */
#include "../foundation/views.h"
#include "blob_parts.h"
#include "mask_bits.h"
#include "mask_runs.h"

#include <string.h>

typedef struct {
    const iris_image *dst, *src;
    int32_t reach;   /* columns beyond a run's ends that touch it in the next row */
    uint32_t *dirty; /* a bit per row in which more may be reached */
} growth;

static inline uint32_t *row_of(const iris_image *image, int32_t y)
{
    return (uint32_t *)iris_image_row(image, y);
}

static int is_reached(const iris_image *dst, int32_t y, int32_t first, int32_t end)
{
    if (y < 0 || y >= dst->h) {
        return 0;
    }
    first = first < 0 ? 0 : first;
    end = end > dst->w ? dst->w : end;
    uint32_t any = 0;
    for (int32_t word = first / 32; 32 * word < end && any == 0; word++) {
        any = row_of(dst, y)[word] & iris_mask_range(word, first, end);
    }
    return any != 0;
}

static void fill(const iris_image *dst, int32_t y, iris_mask_span run)
{
    for (int32_t word = run.first / 32; 32 * word < run.end; word++) {
        row_of(dst, y)[word] |= iris_mask_range(word, run.first, run.end);
    }
}

static void mark(const growth *g, int32_t y)
{
    if (y >= 0 && y < g->src->h) {
        g->dirty[y / 32] |= (uint32_t)1 << y % 32;
    }
}

/* All runs of a row that touch what is reached in the rows above and below, or hold the pixel at `seed`. */
static void grow_row(const growth *g, int32_t y, int32_t seed)
{
    const uint32_t *src = row_of(g->src, y);
    iris_mask_span run;
    int grown = 0;
    for (int32_t x = 0; iris_mask_run(&run, src, x, g->src->w); x = run.end) {
        if (is_reached(g->dst, y, run.first, run.first + 1)) {
            continue;
        }
        int32_t first = run.first - g->reach, end = run.end + g->reach;
        if ((seed >= run.first && seed < run.end) || is_reached(g->dst, y - 1, first, end) ||
            is_reached(g->dst, y + 1, first, end)) {
            fill(g->dst, y, run);
            grown = 1;
        }
    }
    if (grown) {
        mark(g, y - 1);
        mark(g, y + 1);
    }
}

static void clear(const iris_image *mask)
{
    for (int32_t y = 0; y < mask->h; y++) {
        for (int32_t word = 0; 32 * word < mask->w; word++) {
            row_of(mask, y)[word] &= ~iris_mask_range(word, 0, mask->w);
        }
    }
}

iris_status iris_blob_mask(const iris_image *dst, const iris_image *src, const iris_blob *blob,
                           int32_t connectivity, iris_scratch *scratch)
{
    if (!blob || !scratch || (connectivity != 4 && connectivity != 8)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_formats(dst, IRIS_MASK1, src, IRIS_MASK1);
    if (status != IRIS_OK) {
        return status;
    }
    if (iris_image_overlaps(dst, src)) {
        return IRIS_ERR_ALIAS;
    }
    if (blob->first_x < 0 || blob->first_x >= src->w || blob->box.y < 0 || blob->box.y >= src->h) {
        return IRIS_ERR_RANGE;
    }
    size_t start = iris_scratch_mark(scratch), bytes = IRIS_BLOB_MASK_SCRATCH_BYTES(src->h);
    growth g = {dst, src, connectivity == 8, (uint32_t *)iris_scratch_take(scratch, bytes)};
    if (!g.dirty) {
        return IRIS_ERR_SCRATCH;
    }
    memset(g.dirty, 0, bytes);
    clear(dst);
    grow_row(&g, blob->box.y, blob->first_x);
    for (int32_t y = 0; y < src->h;) {
        uint32_t bit = (uint32_t)1 << y % 32;
        int look = (g.dirty[y / 32] & bit) != 0;
        if (look) {
            g.dirty[y / 32] &= ~bit;
            grow_row(&g, y, -1);
        }
        int again = y > 0 && (g.dirty[(y - 1) / 32] >> (y - 1) % 32 & 1u);
        y += again ? -1 : 1;
    }
    iris_scratch_release(scratch, start);
    return IRIS_OK;
}
