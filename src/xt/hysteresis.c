#include "hysteresis.h"

/* All bits of `within` that hang together with one of `seeds`, which is part of it. A sum carries each seed to the
 * upper end of its run; steps of doubling length carry it to the lower one. */
static inline uint32_t fill(uint32_t seeds, uint32_t within)
{
    uint32_t reached = seeds | (((within + seeds) ^ within) & within), open = within;
    reached |= open & reached >> 1;
    open &= open >> 1;
    reached |= open & reached >> 2;
    open &= open >> 2;
    reached |= open & reached >> 4;
    open &= open >> 4;
    reached |= open & reached >> 8;
    open &= open >> 8;
    return reached | (open & reached >> 16);
}

/* A row on its way: its words, those of its neighbors, and the marks of all three (null: there is no such row). */
typedef struct {
    uint32_t *here;
    const uint32_t *above, *below, *weak, *part;
    uint32_t *dirty[3];
    int32_t words;
} row;

static inline uint32_t strong_around(const row *r, int32_t word)
{
    return (r->above[word] | r->here[word] | r->below[word]) & r->part[word];
}

static inline void mark(uint32_t *dirty, int32_t word)
{
    dirty[word / 32] |= (uint32_t)1 << word % 32;
}

/* The words that pixels found in this one may change. */
static void mark_around(const row *r, int32_t word, uint32_t found)
{
    for (int i = 0; i < 3; i++) {
        if (!r->dirty[i]) {
            continue;
        }
        if (i != 1) {
            mark(r->dirty[i], word);
        }
        if ((found & 1u) && word > 0) {
            mark(r->dirty[i], word - 1);
        }
        if (found >> 31 && word + 1 < r->words) {
            mark(r->dirty[i], word + 1);
        }
    }
}

/* Looks at one word; 1 when it has changed. */
static int look(const row *r, int32_t word)
{
    uint32_t around = strong_around(r, word), own = r->here[word] & r->part[word], weak = r->weak[word];
    uint32_t near = around | around << 1 | around >> 1;
    if (word > 0) {
        near |= strong_around(r, word - 1) >> 31;
    }
    if (word + 1 < r->words) {
        near |= strong_around(r, word + 1) << 31;
    }
    near &= weak;
    if ((near & ~own) == 0) {
        return 0;
    }
    uint32_t found = fill(near, weak) & ~own;
    r->here[word] |= found;
    mark_around(r, word, found);
    return 1;
}

/* Looks at all words of a row that are marked, until none is; 1 when any has changed. */
static int look_along(const row *r)
{
    int changed = 0;
    uint32_t *dirty = r->dirty[1];
    for (int32_t i = 0; 32 * i < r->words;) {
        if (dirty[i] == 0) {
            i++;
            continue;
        }
        int32_t bit = __builtin_ctz(dirty[i]);
        dirty[i] &= dirty[i] - 1;
        changed |= look(r, 32 * i + bit);
        i -= i > 0 && dirty[i - 1] != 0;
    }
    return changed;
}

void iris_hysteresis_run(const iris_hysteresis *h)
{
    const int32_t words = (h->strong->w + 31) / 32, groups = (words + 31) / 32;
    for (int32_t y = h->top; y < h->bottom;) {
        uint32_t *dirty = h->dirty + (size_t)y * (size_t)groups;
        int has_above = y > h->top, has_below = y + 1 < h->bottom;
        const row r = {(uint32_t *)iris_image_row(h->strong, y),
                       has_above ? (const uint32_t *)iris_image_row(h->strong, y - 1) : h->zeros,
                       has_below ? (const uint32_t *)iris_image_row(h->strong, y + 1) : h->zeros,
                       h->weak + (size_t)y * (size_t)words,
                       h->part,
                       {has_above ? dirty - groups : NULL, dirty, has_below ? dirty + groups : NULL},
                       words};
        y += look_along(&r) && has_above ? -1 : 1;
    }
}
