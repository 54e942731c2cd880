/* For the tests of skeletons: calls with exactly the working memory that is needed, what is simple counted by flooding, and
 * pictures to thin. Each test program starts with fill_simple_table. */
#ifndef IRIS_TEST_SKELETON_TRUTH_H
#define IRIS_TEST_SKELETON_TRUTH_H

#include "iris/xt/skeleton.h"
#include "shape_mask.h"

static uint32_t src_words[(SHAPE_SIDE_MAX / 32 + 4) * SHAPE_SIDE_MAX],
    dst_words[(SHAPE_SIDE_MAX / 32 + 4) * SHAPE_SIDE_MAX];
static IRIS_SCRATCH_BUFFER(memory, IRIS_SKELETON_SCRATCH_BYTES(SHAPE_SIDE_MAX, SHAPE_SIDE_MAX));
static shape drawn, thinned, expected;

static inline iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static inline size_t mask_bytes(void)
{
    return iris_format_row_bytes(IRIS_MASK1, drawn.w) * (size_t)drawn.h;
}

/* Thins `drawn` into `thinned`, with exactly the working memory that the header names. Returns the passes. */
static inline int32_t thin(iris_skeleton_method method)
{
    iris_image src = shape_mask(src_words, mask_bytes(), &drawn, 0, 0);
    iris_image dst = shape_mask(dst_words, mask_bytes(), &drawn, 0, 0);
    iris_scratch scratch = arena(IRIS_SKELETON_SCRATCH_BYTES(drawn.w, drawn.h));
    int32_t passes = -1;
    assert_int_equal(iris_skeleton(&passes, &dst, &src, method, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, IRIS_SKELETON_SCRATCH_BYTES(drawn.w, drawn.h));
    shape_read(&thinned, &dst);
    return passes;
}

static inline void prune(int32_t length)
{
    iris_image src = shape_mask(src_words, mask_bytes(), &drawn, 0, 0);
    iris_image dst = shape_mask(dst_words, mask_bytes(), &drawn, 0, 0);
    iris_scratch scratch = arena(IRIS_SKELETON_SCRATCH_BYTES(drawn.w, drawn.h));
    assert_int_equal(iris_skeleton_prune(&dst, &src, length, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, IRIS_SKELETON_SCRATCH_BYTES(drawn.w, drawn.h));
    shape_read(&thinned, &dst);
}

/* The eight pixels around, clockwise from the one above. */
static inline void ring(int around[8], const shape *s, int32_t x, int32_t y)
{
    static const int dx[8] = {0, 1, 1, 1, 0, -1, -1, -1}, dy[8] = {-1, -1, 0, 1, 1, 1, 0, -1};
    for (int i = 0; i < 8; i++) {
        around[i] = shape_at(s, x + dx[i], y + dy[i]);
    }
}

/* Groups of the eight pixels around the middle of 3x3: of selected ones, which touch by a side or a corner, or of
 * others, which touch by a side, and of which those count that touch the middle so too. */
static inline int groups_of(const int value[9], int selected)
{
    int group[9], count = 0;
    for (int i = 0; i < 9; i++) {
        group[i] = i != 4 && value[i] == selected ? i : -1;
    }
    for (int again = 0; again < 8; again++) {
        for (int i = 0; i < 81; i++) {
            int a = i / 9, b = i % 9;
            int across = abs(a % 3 - b % 3), down = abs(a / 3 - b / 3);
            int touch = selected ? across <= 1 && down <= 1 : across + down <= 1;
            if (touch && group[b] >= 0 && group[b] < group[a]) {
                group[a] = group[b];
            }
        }
    }
    for (int i = 0; i < 9; i++) {
        int counts = 0;
        for (int k = 0; k < 9; k++) {
            counts |= group[k] == i && (selected || k % 2 == 1);
        }
        count += counts;
    }
    return count;
}

/* Can the pixel go, and everything stays connected as it was? */
static inline int simple_by_count(const int around[8])
{
    int value[9] = {around[7], around[0], around[1], around[6], 1,
                    around[2], around[5], around[4], around[3]};
    return groups_of(value, 1) == 1 && groups_of(value, 0) == 1;
}

static uint8_t simple_table[256];

static inline void fill_simple_table(void)
{
    for (int bits = 0; bits < 256; bits++) {
        int around[8];
        for (int i = 0; i < 8; i++) {
            around[i] = bits >> i & 1;
        }
        simple_table[bits] = (uint8_t)simple_by_count(around);
    }
}

static inline int bits_of(const shape *s, int32_t x, int32_t y)
{
    int around[8], bits = 0;
    ring(around, s, x, y);
    for (int i = 0; i < 8; i++) {
        bits |= around[i] << i;
    }
    return bits;
}

static inline int count_of(int bits)
{
    int count = 0;
    for (; bits; bits >>= 1) {
        count += bits & 1;
    }
    return count;
}

/* The header's definition: each pixel left is needed, or an end, or alone. */
static inline int one_pixel_wide(const shape *s)
{
    for (int32_t y = 0; y < s->h; y++) {
        for (int32_t x = 0; x < s->w; x++) {
            if (s->at[y][x]) {
                int bits = bits_of(s, x, y);
                if (simple_table[bits] && count_of(bits) > 1) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

static inline int part_of(const shape *part, const shape *whole)
{
    for (int32_t i = 0; i < part->w * part->h; i++) {
        if (part->at[i / part->w][i % part->w] > whole->at[i / part->w][i % part->w]) {
            return 0;
        }
    }
    return 1;
}

/* `thinned` is a skeleton of `drawn`. */
static inline void assert_skeleton(void)
{
    shape_topology before = shape_count(&drawn), after = shape_count(&thinned);
    if (before.parts != after.parts || before.holes != after.holes || !one_pixel_wide(&thinned)) {
        print_error("%d x %d: %d parts and %d holes became %d and %d\n", drawn.w, drawn.h, before.parts,
                    before.holes, after.parts, after.holes);
        fail();
    }
    assert_true(part_of(&thinned, &drawn));
}

static inline void assert_exact(void)
{
    (void)thin(IRIS_SKELETON_EXACT);
    assert_skeleton();
}

/* What the header says, pixel by pixel. */
static inline int32_t thin_slowly(shape *s)
{
    static const int side_x[4] = {0, 0, 1, -1}, side_y[4] = {-1, 1, 0, 0};
    static shape begun, old;
    int32_t passes = 0;
    for (int changed = 1; changed; passes++) {
        changed = 0;
        begun = *s;
        for (int side = 0; side < 4; side++) {
            old = *s;
            for (int32_t y = 0; y < s->h; y++) {
                for (int32_t x = 0; x < s->w; x++) {
                    int bits = bits_of(&old, x, y);
                    if (!old.at[y][x] || shape_at(&old, x + side_x[side], y + side_y[side]) ||
                        !simple_table[bits] || count_of(bits) < 2 ||
                        (passes % 3 != 0 && (bits_of(&begun, x, y) & 0x55) == 0x55)) {
                        continue;
                    }
                    s->at[y][x] = 0;
                    changed = 1;
                }
            }
        }
    }
    return passes;
}

static uint32_t seed = 7;

static inline void draw_random(int32_t w, int32_t h, uint32_t of_256)
{
    drawn.w = w;
    drawn.h = h;
    for (int32_t i = 0; i < w * h; i++) {
        drawn.at[i / w][i % w] = next_random(&seed) % 256 < of_256;
    }
}

/* Discs and bars, as thick as half the picture. */
static inline void draw_blobs(int32_t w, int32_t h)
{
    draw_random(w, h, 0);
    for (int blob = 0; blob < 6; blob++) {
        int32_t x = (int32_t)(next_random(&seed) % (uint32_t)w),
                y = (int32_t)(next_random(&seed) % (uint32_t)h);
        int32_t r = 1 + (int32_t)(next_random(&seed) % (uint32_t)((w < h ? w : h) / 4 + 1));
        uint32_t kind = next_random(&seed) % 3;
        for (int32_t i = 0; i < w * h; i++) {
            int32_t dx = i % w - x, dy = i / w - y;
            int in = kind == 0   ? dx * dx + dy * dy <= r * r
                     : kind == 1 ? abs(dx) <= r && abs(dy) <= 2
                                 : abs(dx + dy) <= r / 2 && abs(dx - dy) <= 3 * r;
            drawn.at[i / w][i % w] |= (uint8_t)in;
        }
    }
}

static inline void draw_bits(int32_t w, int32_t h, uint32_t bits)
{
    drawn.w = w;
    drawn.h = h;
    for (int32_t i = 0; i < w * h; i++) {
        drawn.at[i / w][i % w] = bits >> i & 1;
    }
}

#endif
