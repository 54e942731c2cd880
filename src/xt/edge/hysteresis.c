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

/* A row on its way, and its neighbors above and below: [1] is the row itself. A neighbor that is not there has zeros, and
 * no marks. */
typedef struct {
    uint32_t *here;
    const uint32_t *strong[3], *weak[3], *part;
    uint32_t *dirty[3];
    int32_t words;
} row;

static inline uint32_t strong_around(const row *r, int32_t word)
{
    return (r->strong[0][word] | r->here[word] | r->strong[2][word]) & r->part[word];
}

/* Marks a word of a row when pixels of it may be found beside those in `near`. */
static inline void mark(const row *r, int which, int32_t word, uint32_t near)
{
    if (near & r->weak[which][word] & ~r->strong[which][word]) {
        r->dirty[which][word / 32] |= (uint32_t)1 << word % 32;
    }
}

/* The words that pixels found in this one may change. */
static void mark_around(const row *r, int32_t word, uint32_t found)
{
    for (int i = 0; i < 3; i++) {
        if (!r->dirty[i]) {
            continue;
        }
        if (i != 1) {
            mark(r, i, word, found | found << 1 | found >> 1);
        }
        if ((found & 1u) && word > 0) {
            mark(r, i, word - 1, (uint32_t)1 << 31);
        }
        if (found >> 31 && word + 1 < r->words) {
            mark(r, i, word + 1, 1u);
        }
    }
}

/* Looks at one word. */
static void look(const row *r, int32_t word)
{
    uint32_t around = strong_around(r, word), weak = r->weak[1][word];
    uint32_t near = around | around << 1 | around >> 1;
    if (word > 0) {
        near |= strong_around(r, word - 1) >> 31;
    }
    if (word + 1 < r->words) {
        near |= strong_around(r, word + 1) << 31;
    }
    near &= weak;
    if (near & ~r->here[word]) {
        uint32_t found = fill(near, weak) & ~r->here[word];
        r->here[word] |= found;
        mark_around(r, word, found);
    }
}

/* Looks at all words of a row that are marked, until none is. */
static void look_along(const row *r)
{
    uint32_t *dirty = r->dirty[1];
    for (int32_t i = 0; 32 * i < r->words;) {
        if (dirty[i] == 0) {
            i++;
            continue;
        }
        int32_t bit = __builtin_ctz(dirty[i]);
        dirty[i] &= dirty[i] - 1;
        look(r, 32 * i + bit);
        i -= i > 0 && dirty[i - 1] != 0;
    }
}

/* Row y has marks. */
static int is_marked(const iris_hysteresis *h, int32_t y, int32_t groups)
{
    if (y < h->top || y >= h->bottom) {
        return 0;
    }
    const uint32_t *dirty = h->dirty + (size_t)y * (size_t)groups;
    uint32_t any = 0;
    for (int32_t i = 0; i < groups; i++) {
        any |= dirty[i];
    }
    return any != 0;
}

static void look_at_row(const iris_hysteresis *h, int32_t y, int32_t words, int32_t groups)
{
    uint32_t *dirty = h->dirty + (size_t)y * (size_t)groups, *here = (uint32_t *)iris_image_row(h->strong, y);
    const uint32_t *weak = h->weak + (size_t)y * (size_t)words;
    const int has_above = y > h->top, has_below = y + 1 < h->bottom;
    const row r = {here,
                   {has_above ? (const uint32_t *)iris_image_row(h->strong, y - 1) : h->zeros, here,
                    has_below ? (const uint32_t *)iris_image_row(h->strong, y + 1) : h->zeros},
                   {has_above ? weak - words : h->zeros, weak, has_below ? weak + words : h->zeros},
                   h->part,
                   {has_above ? dirty - groups : NULL, dirty, has_below ? dirty + groups : NULL},
                   words};
    look_along(&r);
}

/* Down the picture, and then to and fro over the rows that have got marks behind the one that was looked at. */
void iris_hysteresis_run(const iris_hysteresis *h)
{
    const int32_t words = (h->strong->w + 31) / 32, groups = (words + 31) / 32;
    int32_t step = 1, y = h->top, last = h->bottom - 1;
    for (int is_behind = 1; is_behind; step = -step) {
        int32_t nearest = y, farthest = y;
        for (is_behind = 0; step * (last - y) >= 0; y += step) {
            if (!is_marked(h, y, groups)) {
                continue;
            }
            look_at_row(h, y, words, groups);
            if (y == last && is_marked(h, y + step, groups)) {
                last += step;
            }
            if (is_marked(h, y - step, groups)) {
                nearest = y - step;
                farthest = is_behind ? farthest : nearest;
                is_behind = 1;
            }
        }
        y = nearest;
        last = farthest;
    }
}
