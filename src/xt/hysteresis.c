#include "hysteresis.h"

/* The words around a word, in one row: its own, and the nearest bit on either side. */
static uint32_t near_in_row(const iris_hysteresis *h, int32_t y, int32_t word)
{
    if (y < h->top || y >= h->bottom) {
        return 0;
    }
    const uint32_t *row = (const uint32_t *)iris_image_row(h->strong, y);
    int32_t last = (h->strong->w - 1) / 32;
    uint32_t own = row[word] & h->part[word];
    uint32_t near = own | own << 1 | own >> 1;
    if (word > 0) {
        near |= (row[word - 1] & h->part[word - 1]) >> 31;
    }
    if (word < last) {
        near |= (row[word + 1] & h->part[word + 1]) << 31;
    }
    return near;
}

/* All bits of `within` that hang together with one of `seeds` in a row. A sum carries each seed to the upper end of its
 * run; five steps of doubling length carry it to the lower one. */
static uint32_t fill(uint32_t seeds, uint32_t within)
{
    uint32_t reached = seeds | (((within + seeds) ^ within) & within), open = within;
    for (int32_t step = 1; step < 32; step *= 2) {
        reached |= open & reached >> step;
        open &= open >> step;
    }
    return reached;
}

static void mark(const iris_hysteresis *h, int32_t y, int32_t word)
{
    int32_t words = (h->strong->w + 31) / 32;
    if (y >= h->top && y < h->bottom && word >= 0 && word < words) {
        int32_t index = y * words + word;
        h->dirty[index / 32] |= (uint32_t)1 << index % 32;
    }
}

/* Looks at one word of the picture. Returns 1 when it has changed, and its neighbors that this concerns are marked. */
static int look(const iris_hysteresis *h, int32_t y, int32_t word)
{
    uint32_t *strong = (uint32_t *)iris_image_row(h->strong, y) + word;
    uint32_t weak = h->weak[(size_t)y * (size_t)((h->strong->w + 31) / 32) + (size_t)word];
    uint32_t near = near_in_row(h, y - 1, word) | near_in_row(h, y, word) | near_in_row(h, y + 1, word);
    uint32_t found = fill(near & weak, weak) & ~(*strong & h->part[word]);
    if (found == 0) {
        return 0;
    }
    *strong |= found;
    for (int32_t dy = -1; dy <= 1; dy++) {
        if (dy != 0) {
            mark(h, y + dy, word);
        }
        if (found & 1u) {
            mark(h, y + dy, word - 1);
        }
        if (found >> 31) {
            mark(h, y + dy, word + 1);
        }
    }
    return 1;
}

void iris_hysteresis_run(const iris_hysteresis *h)
{
    const int32_t words = (h->strong->w + 31) / 32, all = words * h->strong->h;
    for (int32_t i = 0; i < all;) {
        uint32_t waiting = h->dirty[i / 32] >> i % 32;
        if (waiting == 0) {
            i = (i / 32 + 1) * 32;
            continue;
        }
        while (!(waiting & 1u)) {
            waiting >>= 1;
            i++;
        }
        h->dirty[i / 32] &= ~((uint32_t)1 << i % 32);
        int32_t back = i - words - 1; /* the first that look marks */
        i = !look(h, i / words, i % words) ? i + 1 : back > 0 ? back : 0;
    }
}
