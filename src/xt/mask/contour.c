#include "iris/xt/contour.h"

#include <string.h>

#include "../../foundation/views.h"
#include "contour_steps.h"
#include "mask_bits.h"

/* A search. What a bit means changes: first an upright side at the left of a selected pixel that no border has come by;
 * then an upright side, at the left of any pixel, of a border that is kept; then one of these that a border which starts
 * farther right asks for its owner. */
typedef struct {
    const iris_image *mask;
    uint32_t *bits;
    int32_t words;
    iris_contour *kept;
    int32_t capacity, count;
} search;

static uint32_t *bits_row(const search *s, int32_t y)
{
    return s->bits + (size_t)y * (size_t)s->words;
}

static int is_earlier(const iris_contour *a, const iris_contour *b)
{
    return a->y < b->y || (a->y == b->y && a->x < b->x);
}

static int is_later(const iris_contour *a, const iris_contour *b)
{
    return is_earlier(b, a);
}

/* Does b go before a when there is no room? */
static int is_worse(const iris_contour *a, const iris_contour *b)
{
    return a->area < b->area || (a->area == b->area && is_later(a, b));
}

/* A heap: none comes before the one above it. */
static void sink(iris_contour *heap, int32_t at, int32_t count,
                 int (*comes_first)(const iris_contour *, const iris_contour *))
{
    iris_contour moved = heap[at];
    for (int32_t below = 2 * at + 1; below < count; below = 2 * at + 1) {
        if (below + 1 < count && comes_first(&heap[below + 1], &heap[below])) {
            below++;
        }
        if (!comes_first(&heap[below], &moved)) {
            break;
        }
        heap[at] = heap[below];
        at = below;
    }
    heap[at] = moved;
}

static void make_heap(iris_contour *heap, int32_t count,
                      int (*comes_first)(const iris_contour *, const iris_contour *))
{
    for (int32_t at = count / 2 - 1; at >= 0; at--) {
        sink(heap, at, count, comes_first);
    }
}

static void sort(iris_contour *contours, int32_t count)
{
    make_heap(contours, count, is_later);
    for (int32_t last = count - 1; last > 0; last--) {
        iris_contour top = contours[0];
        contours[0] = contours[last];
        contours[last] = top;
        sink(contours, 0, last, is_later);
    }
}

/* Adds a border to those that are kept. */
static void keep(search *s, const iris_contour *contour)
{
    if (s->count < s->capacity) {
        s->kept[s->count] = *contour;
        if (s->count + 1 == s->capacity) {
            make_heap(s->kept, s->capacity, is_worse);
        }
    } else if (s->capacity > 0 && is_worse(&s->kept[0], contour)) {
        s->kept[0] = *contour;
        sink(s->kept, 0, s->capacity, is_worse);
    }
    s->count++;
}

/* Follows the border by the left side of the selected pixel (x, y), whose sides are no longer to be found. */
static iris_contour follow(const search *s, int32_t x, int32_t y)
{
    iris_contour_side start, side;
    (void)iris_contour_start(&start, s->mask, x, y);
    iris_contour c = {x, y, 0, -1, {0, 0, 0, 0}, 0, 0, 0};
    int32_t left = x, right = x, bottom = y; /* corners */
    int64_t area = 0;
    side = start;
    do {
        if ((side.way & 1) == 0) {
            int32_t row = iris_contour_y(&side);
            if (side.way == 0) {
                bits_row(s, row)[side.x >> 5] &= ~((uint32_t)1 << (side.x & 31));
            }
            area += side.way == 0 ? -side.x : side.x;
            if (row < c.y || (row == c.y && side.x < c.x)) {
                c.x = side.x;
                c.y = row;
            }
            left = side.x < left ? side.x : left;
            right = side.x > right ? side.x : right;
            bottom = row > bottom ? row : bottom;
        }
        int turn = iris_contour_step(&side, s->mask);
        c.points += turn <= 0;
        c.diagonals += turn < 0;
    } while (!iris_contour_same(&side, &start));
    c.points += c.points == 0;
    c.is_hole = area < 0;
    c.area = (int32_t)(area < 0 ? -area : area);
    c.box = (iris_rect){left, c.y, right - left, bottom + 1 - c.y};
    return c;
}

/* All borders, found by left sides of selected pixels: each border has one. Ends with all bits 0. */
static void find_all(search *s)
{
    for (int32_t y = 0; y < s->mask->h; y++) {
        const uint32_t *row = (const uint32_t *)iris_image_row(s->mask, y);
        uint32_t *bits = bits_row(s, y), before = 0;
        for (int32_t word = 0; word < s->words; word++) {
            uint32_t pixels = row[word] & iris_mask_range(word, 0, s->mask->w);
            bits[word] = pixels & ~(pixels << 1 | before);
            before = pixels >> 31;
        }
    }
    for (int32_t y = 0; y < s->mask->h; y++) {
        for (int32_t word = 0; word < s->words; word++) {
            uint32_t *bits = bits_row(s, y) + word;
            while (*bits != 0) {
                iris_contour found = follow(s, 32 * word + __builtin_ctz(*bits), y);
                keep(s, &found);
            }
        }
    }
}

/* Sets the bits of the upright sides of a border. */
static void mark(const search *s, const iris_contour *contour)
{
    iris_contour_side start, side;
    (void)iris_contour_start(&start, s->mask, contour->x, contour->y);
    side = start;
    do {
        if ((side.way & 1) == 0 && side.x < s->mask->w) {
            bits_row(s, iris_contour_y(&side))[side.x >> 5] |= (uint32_t)1 << (side.x & 31);
        }
        (void)iris_contour_step(&side, s->mask);
    } while (!iris_contour_same(&side, &start));
}

/* The nearest bit of a row left of x; -1: none. */
static int32_t nearest_left(const uint32_t *bits, int32_t x)
{
    for (int32_t word = x >> 5; word >= 0; word--) {
        uint32_t some = bits[word] & iris_mask_range(word, 0, x);
        if (some != 0) {
            return 32 * word + 31 - __builtin_clz(some);
        }
    }
    return -1;
}

/* Leaves of the bits those that a border asks for. */
static void ask(const search *s, int32_t kept)
{
    int32_t next = 0;
    for (int32_t y = 0; y < s->mask->h; y++) {
        uint32_t *bits = bits_row(s, y);
        int32_t first = next, asked = -1;
        for (; next < kept && s->kept[next].y == y; next++) {
            s->kept[next].parent = nearest_left(bits, s->kept[next].x); /* for now: where it asks */
        }
        memset(bits, 0, (size_t)s->words * sizeof *bits);
        for (; first < next; first++) {
            asked = s->kept[first].parent;
            if (asked >= 0) {
                bits[asked >> 5] |= (uint32_t)1 << (asked & 31);
            }
        }
    }
}

/* The first of the kept borders that starts in row y behind x. */
static int32_t asker(const search *s, int32_t kept, int32_t x, int32_t y)
{
    const iris_contour wanted = {.x = x, .y = y};
    int32_t low = 0, high = kept;
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        if (is_later(&s->kept[middle], &wanted)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/* Answers who asks for sides of a kept border. What is right of a left wall is in the border; what is right of a right
 * wall lies beside it, in the same one: that is told as -2 - index until all are known. */
static void answer(const search *s, int32_t index, int32_t kept)
{
    iris_contour_side start, side;
    int left_wall = s->kept[index].is_hole ? 2 : 0;
    (void)iris_contour_start(&start, s->mask, s->kept[index].x, s->kept[index].y);
    side = start;
    do {
        int32_t y = iris_contour_y(&side);
        if ((side.way & 1) == 0 && side.x < s->mask->w && bits_row(s, y)[side.x >> 5] >> (side.x & 31) & 1) {
            s->kept[asker(s, kept, side.x, y)].parent = side.way == left_wall ? index : -2 - index;
        }
        (void)iris_contour_step(&side, s->mask);
    } while (!iris_contour_same(&side, &start));
}

static void nest(const search *s)
{
    int32_t kept = s->count < s->capacity ? s->count : s->capacity;
    sort(s->kept, kept);
    for (int32_t i = 0; i < kept; i++) {
        mark(s, &s->kept[i]);
    }
    ask(s, kept);
    for (int32_t i = 0; i < kept; i++) {
        answer(s, i, kept);
    }
    for (int32_t i = 0; i < kept; i++) {
        if (s->kept[i].parent <= -2) {
            s->kept[i].parent = s->kept[-2 - s->kept[i].parent].parent;
        }
    }
}

static iris_status check(const iris_image *mask)
{
    return iris_views_check_one(mask, IRIS_MASK1);
}

iris_status iris_contour_find(iris_contour *contours, int32_t capacity, int32_t *count,
                              const iris_image *mask, iris_scratch *scratch)
{
    if (!count || !mask || !scratch || capacity < 0 || (!contours && capacity > 0)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check(mask);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark_before = iris_scratch_mark(scratch);
    search s = {.mask = mask, .words = (mask->w + 31) / 32, .kept = contours, .capacity = capacity};
    s.bits = (uint32_t *)iris_scratch_take(scratch, IRIS_CONTOUR_SCRATCH_BYTES(mask->w, mask->h));
    if (!s.bits) {
        return IRIS_ERR_SCRATCH;
    }
    find_all(&s);
    nest(&s);
    *count = s.count;
    iris_scratch_release(scratch, mark_before);
    return s.count > capacity ? IRIS_ERR_FULL : IRIS_OK;
}

iris_status iris_contour_points(iris_contour_point *points, int32_t capacity, int32_t *count,
                                const iris_contour *contour, const iris_image *mask)
{
    if (!count || !contour || !mask || capacity < 0 || (!points && capacity > 0)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check(mask);
    if (status != IRIS_OK) {
        return status;
    }
    iris_contour_side start, side;
    if ((uint32_t)contour->x >= (uint32_t)mask->w || (uint32_t)contour->y >= (uint32_t)mask->h ||
        !iris_contour_start(&start, mask, contour->x, contour->y)) {
        return IRIS_ERR_RANGE;
    }
    int32_t changes = 0;
    side = start;
    do { /* a pixel is written when it is left; the last one that is come to is the first again */
        iris_contour_point here = {(int16_t)iris_contour_x(&side), (int16_t)iris_contour_y(&side)};
        if (iris_contour_step(&side, mask) <= 0) {
            if (changes < capacity) {
                points[changes] = here;
            }
            changes++;
        } else if (changes == 0 && capacity > 0) {
            points[0] = here;
        }
    } while (!iris_contour_same(&side, &start));
    *count = changes > 0 ? changes : 1;
    return *count > capacity ? IRIS_ERR_FULL : IRIS_OK;
}
