#include "skeleton_parts.h"

#include <string.h>

/* A one in each of eight bytes. */
#define EIGHT_ONES UINT64_C(0x0101010101010101)

/* The sides that a sub-pass peels, and how many there are to a pass at most. */
typedef enum { NORTH, SOUTH, EAST, WEST, ZHANG_SUEN_FIRST, ZHANG_SUEN_SECOND } side;
#define SIDES 4

iris_status iris_thinning_begin(iris_thinning *thinning, iris_size size, iris_scratch *scratch)
{
    size_t stride = (size_t)iris_skeleton_stride(size.w);
    size_t plane = stride * ((size_t)size.h + 2) + 2;
    size_t ring = stride + 2;
    uint64_t *memory = (uint64_t *)iris_scratch_take(scratch, IRIS_SKELETON_SCRATCH_BYTES(size.w, size.h));
    if (!memory) {
        return IRIS_ERR_SCRATCH;
    }
    memset(memory, 0, IRIS_SKELETON_SCRATCH_BYTES(size.w, size.h));
    thinning->h = size.h;
    thinning->stride = (int32_t)stride;
    thinning->words = memory + stride + 1;
    thinning->snapshot = thinning->words + plane;
    thinning->removed = memory + 2 * plane;
    thinning->at = (uint32_t *)(thinning->removed + ring);
    thinning->lives = (uint8_t *)(thinning->at + ring) + stride + 1;
    return IRIS_OK;
}

/* Lets the words with a pixel that touches one of `bits`, of the word of `lives`, be looked at again. */
static inline void wake(uint8_t *lives, ptrdiff_t stride, uint64_t bits, uint8_t count)
{
    lives[-stride] = lives[0] = lives[stride] = count;
    if (bits & 1) {
        lives[-stride - 1] = lives[-1] = lives[stride - 1] = count;
    }
    if (bits >> 63) {
        lives[-stride + 1] = lives[1] = lives[stride + 1] = count;
    }
}

void iris_thinning_load(iris_thinning *thinning, const iris_image *mask)
{
    for (int32_t y = 0; y < thinning->h; y++) {
        ptrdiff_t row = (ptrdiff_t)y * thinning->stride;
        iris_skeleton_load(thinning->snapshot + row, mask, y);
        for (ptrdiff_t i = row; i < row + thinning->stride; i++) {
            uint64_t changed = thinning->words[i] ^ thinning->snapshot[i];
            if (changed != 0) {
                thinning->words[i] = thinning->snapshot[i];
                wake(thinning->lives + i, thinning->stride, changed, SIDES);
            }
        }
    }
}

void iris_thinning_clear(const iris_thinning *thinning, int32_t x, int32_t y)
{
    ptrdiff_t at = (ptrdiff_t)y * thinning->stride + x / 64;
    uint64_t bit = (uint64_t)1 << x % 64;
    thinning->words[at] &= ~bit;
    wake(thinning->lives + at, thinning->stride, bit, SIDES);
}

void iris_thinning_store(const iris_image *mask, const iris_thinning *thinning)
{
    for (int32_t y = 0; y < thinning->h; y++) {
        for (int32_t i = 0; i < thinning->stride; i++) {
            iris_skeleton_put(mask, y, i, thinning->words[(ptrdiff_t)y * thinning->stride + i]);
        }
    }
}

/* Pixels that are not needed: what is selected around them is one group, even when touching by corners counts, and more
 * than one pixel. A group is counted where it begins behind a neighbor by a side that is not selected; one pixel
 * alone makes no pair. */
static inline uint64_t spare(const iris_around *a)
{
    uint64_t n = a->ne | a->e, e = a->se | a->s, s = a->sw | a->w, w = a->nw | a->n;
    iris_groups groups = {~a->n & n, ~a->e & e, ~a->s & s, ~a->w & w};
    uint64_t pairs =
        (a->n & (n | a->nw)) | (a->e & (e | a->ne)) | (a->s & (s | a->se)) | (a->w & (w | a->sw));
    return iris_groups_one(&groups) & pairs;
}

/* The condition of Zhang and Suen: 2 to 6 neighbors in one group, and the sides of this sub-pass. Of one group, two
 * pixels are one beside the other, and so are two that are missing. */
static inline uint64_t zhang_suen(const iris_around *a, int second)
{
    iris_groups groups = iris_groups_around(a);
    uint64_t pair =
        (a->ne & (a->n | a->e)) | (a->se & (a->e | a->s)) | (a->sw & (a->s | a->w)) | (a->nw & (a->w | a->n));
    uint64_t no_gap =
        (a->ne | (a->n & a->e)) & (a->se | (a->e & a->s)) & (a->sw | (a->s & a->w)) & (a->nw | (a->w & a->n));
    uint64_t closed = second ? a->n & a->w & (a->e | a->s) : a->e & a->s & (a->n | a->w);
    return iris_groups_one(&groups) & pair & ~no_gap & ~closed;
}

/* What this sub-pass takes from a word, or would, if it spared nothing. */
static inline uint64_t removable(const uint64_t *word, int32_t stride, side from)
{
    const uint64_t *above = word - stride, *below = word + stride;
    uint64_t open = from == NORTH   ? ~*above
                    : from == SOUTH ? ~*below
                    : from == EAST  ? ~iris_skeleton_east(word)
                    : from == WEST  ? ~iris_skeleton_west(word)
                                   : ~(*above & *below & iris_skeleton_east(word) & iris_skeleton_west(word));
    uint64_t candidates = *word & open;
    if (candidates == 0) {
        return 0;
    }
    iris_around around = iris_around_word(above, word, below);
    return candidates &
           (from < ZHANG_SUEN_FIRST ? spare(&around) : zhang_suen(&around, from == ZHANG_SUEN_SECOND));
}

/* Pixels that had a neighbor missing by a side when the pass began. */
static inline uint64_t was_open(const uint64_t *word, int32_t stride)
{
    return ~(word[-stride] & word[stride] & iris_skeleton_east(word) & iris_skeleton_west(word));
}

/* What a sub-pass has found and not removed yet, because words behind it see the old pixels. */
typedef struct {
    int32_t first, count;
} waiting;

/* Removes what no word from `from` on sees. */
static inline void remove_before(waiting *queue, iris_thinning t, int32_t from, uint8_t lives)
{
    while (queue->count > 0 && (int32_t)t.at[queue->first] + t.stride + 1 < from) {
        uint32_t at = t.at[queue->first];
        uint64_t bits = t.removed[queue->first];
        t.words[at] &= ~bits;
        wake(t.lives + at, t.stride, bits, lives);
        queue->first = queue->first == t.stride + 1 ? 0 : queue->first + 1;
        queue->count--;
    }
}

static inline void put(waiting *queue, iris_thinning t, int32_t at, uint64_t bits)
{
    int32_t last = queue->first + queue->count++;
    last -= last < t.stride + 2 ? 0 : t.stride + 2;
    t.removed[last] = bits;
    t.at[last] = (uint32_t)at;
}

/* Takes a life of each of eight words that have one. Returns 1 in the byte of each that had, the first lowest: on most
 * processors as they lie in memory. */
static inline uint64_t live(uint8_t *lives)
{
    uint64_t eight;
    memcpy(&eight, lives, sizeof eight);
    uint64_t had = (eight | eight >> 1 | eight >> 2) & EIGHT_ONES;
    if (had == 0) {
        return 0;
    }
    eight -= had;
    memcpy(lives, &eight, sizeof eight);
    const uint8_t *b = (const uint8_t *)&had;
    return (uint64_t)b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24 |
           (uint64_t)b[4] << 32 | (uint64_t)b[5] << 40 | (uint64_t)b[6] << 48 | (uint64_t)b[7] << 56;
}

/* Peels one side everywhere at once. A word is looked at while it has lives: until every side has come once since it or a
 * pixel beside it last changed. Returns 1 when it removed something. */
static int peel(iris_thinning t, side from, int spares, uint8_t lives)
{
    int32_t words = t.stride * t.h;
    waiting queue = {0, 0};
    int changed = 0;
    for (int32_t block = 0; block < words; block += 8) {
        for (uint64_t had = live(t.lives + block); had != 0; had &= had - 1) {
            int32_t i = block + (int32_t)((((had & (0 - had)) - 1) & EIGHT_ONES) * EIGHT_ONES >> 56);
            if (i >= words) {
                break;
            }
            remove_before(&queue, t, i, lives);
            uint64_t bits = removable(t.words + i, t.stride, from);
            if (spares && bits != 0) {
                uint64_t open = was_open(t.snapshot + i, t.stride);
                if ((bits & ~open) != 0) {
                    t.lives[i] = lives;
                }
                bits &= open;
            }
            if (bits != 0) {
                put(&queue, t, i, bits);
                changed = 1;
            }
        }
    }
    remove_before(&queue, t, INT32_MAX, lives);
    return changed;
}

int32_t iris_thinning_run(iris_thinning *thinning, iris_skeleton_method method)
{
    static const side sides[2][SIDES] = {{NORTH, SOUTH, EAST, WEST}, {ZHANG_SUEN_FIRST, ZHANG_SUEN_SECOND}};
    int exact = method == IRIS_SKELETON_EXACT;
    int count = exact ? SIDES : 2;
    size_t bytes = (size_t)thinning->stride * (size_t)thinning->h * sizeof *thinning->words;
    for (int32_t pass = 0;; pass++) {
        int changed = 0, spares = exact && pass % 3 != 0;
        if (spares) {
            memcpy(thinning->snapshot, thinning->words, bytes);
        }
        for (int i = 0; i < count; i++) {
            changed |= peel(*thinning, sides[!exact][i], spares, (uint8_t)count);
        }
        if (!changed) {
            return pass + 1;
        }
    }
}
