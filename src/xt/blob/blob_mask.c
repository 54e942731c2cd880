/* The mask of one blob: run by run. Where a run has been reached, the words above and below it are looked at again. */
#include "../../foundation/views.h"
#include "../mask/mask_bits.h"
#include "../mask/mask_runs.h"
#include "blob_parts.h"

#include <string.h>

typedef struct {
    const iris_image *dst, *src;
    int32_t reach;         /* columns beyond a run's ends that touch it in the next row */
    int32_t words, groups; /* of a row, and of its marks */
    uint32_t *dirty;       /* a bit per word in which more may be reached */
} growth;

static inline uint32_t *row_of(const iris_image *image, int32_t y)
{
    return (uint32_t *)iris_image_row(image, y);
}

static inline uint32_t *dirty_of(const growth *g, int32_t y)
{
    return g->dirty + (size_t)y * (size_t)g->groups;
}

/* What is reached above and below a word. */
static uint32_t around(const growth *g, int32_t y, int32_t word)
{
    uint32_t above = y > 0 ? row_of(g->dst, y - 1)[word] : 0;
    uint32_t below = y + 1 < g->src->h ? row_of(g->dst, y + 1)[word] : 0;
    return (above | below) & iris_mask_range(word, 0, g->src->w);
}

/* Pixels of a word that touch what is reached. */
static uint32_t touched(const growth *g, int32_t y, int32_t word)
{
    uint32_t near = around(g, y, word);
    if (g->reach > 0) {
        near |= near << 1 | near >> 1;
        near |= word > 0 ? around(g, y, word - 1) >> 31 : 0;
        near |= word + 1 < g->words ? around(g, y, word + 1) << 31 : 0;
    }
    return near & row_of(g->src, y)[word] & ~row_of(g->dst, y)[word] & iris_mask_range(word, 0, g->src->w);
}

/* Marks the words of row y that columns first up to below end are in. */
static void mark(const growth *g, int32_t y, int32_t first, int32_t end)
{
    if (y < 0 || y >= g->src->h) {
        return;
    }
    first = first < 0 ? 0 : first;
    end = end > g->src->w ? g->src->w : end;
    for (int32_t word = first / 32; 32 * word < end; word++) {
        dirty_of(g, y)[word / 32] |= (uint32_t)1 << word % 32;
    }
}

/* The first pixel of the run that x is in. */
static int32_t run_start(const uint32_t *row, int32_t x)
{
    int32_t word = x / 32;
    uint32_t gaps = ~row[word] & (((uint32_t)1 << x % 32) - 1);
    while (gaps == 0 && word > 0) {
        gaps = ~row[--word];
    }
    return gaps == 0 ? 0 : 32 * word + 32 - __builtin_clz(gaps);
}

/* The run that x is in is reached. */
static void reach_run(const growth *g, int32_t y, int32_t x)
{
    const uint32_t *src = row_of(g->src, y);
    int32_t first = run_start(src, x), end = iris_mask_next(src, x, g->src->w, ~(uint32_t)0);
    for (int32_t word = first / 32; 32 * word < end; word++) {
        row_of(g->dst, y)[word] |= iris_mask_range(word, first, end);
    }
    mark(g, y - 1, first - g->reach, end + g->reach);
    mark(g, y + 1, first - g->reach, end + g->reach);
}

/* Looks at the marked words of a row; 1 when more has been reached. */
static int grow_row(const growth *g, int32_t y)
{
    uint32_t *dirty = dirty_of(g, y);
    int grown = 0;
    for (int32_t i = 0; i < g->groups; i++) {
        for (; dirty[i] != 0; dirty[i] &= dirty[i] - 1) {
            int32_t word = 32 * i + __builtin_ctz(dirty[i]);
            uint32_t seeds = touched(g, y, word);
            for (; seeds != 0; seeds &= ~row_of(g->dst, y)[word]) {
                reach_run(g, y, 32 * word + __builtin_ctz(seeds));
                grown = 1;
            }
        }
    }
    return grown;
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
    size_t start = iris_scratch_mark(scratch), bytes = IRIS_BLOB_MASK_SCRATCH_BYTES(src->w, src->h);
    growth g = {dst, src, connectivity == 8, (src->w + 31) / 32, (src->w + 1023) / 1024, NULL};
    g.dirty = (uint32_t *)iris_scratch_take(scratch, bytes);
    if (!g.dirty) {
        return IRIS_ERR_SCRATCH;
    }
    memset(g.dirty, 0, bytes);
    clear(dst);
    int32_t x = blob->first_x;
    if (row_of(src, blob->box.y)[x / 32] >> x % 32 & 1u) {
        reach_run(&g, blob->box.y, x);
    }
    for (int32_t y = 0; y < src->h;) {
        y += grow_row(&g, y) && y > 0 ? -1 : 1;
    }
    iris_scratch_release(scratch, start);
    return IRIS_OK;
}
