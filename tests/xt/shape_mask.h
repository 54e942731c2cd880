/* For the tests of what works on shapes: masks as one byte per pixel, how many parts and holes they have by flooding, and the
 * shapes of the shared data. Independent of the code under test. */
#ifndef IRIS_TEST_SHAPE_MASK_H
#define IRIS_TEST_SHAPE_MASK_H

#include <stdio.h>

#include "../picture.h"
#include "iris/bmp.h"

#define SHAPE_SIDE_MAX 402

typedef struct {
    int32_t w, h;
    uint8_t at[SHAPE_SIDE_MAX][SHAPE_SIDE_MAX]; /* [y][x], 0 or 1 */
} shape;

static inline int shape_at(const shape *s, int32_t x, int32_t y)
{
    return x >= 0 && y >= 0 && x < s->w && y < s->h && s->at[y][x];
}

/* A shape from rows of text; anything but '.' is selected. */
static inline void shape_draw(shape *s, int32_t w, int32_t h, const char *rows)
{
    s->w = w;
    s->h = h;
    assert_int_equal(strlen(rows), w * h);
    for (int32_t i = 0; i < w * h; i++) {
        s->at[i / w][i % w] = rows[i] != '.';
    }
}

/* A mask with the shape in it, rows of w / 32 + 1 words or `stride` bytes, in words that hold `fill` else. */
static inline iris_image shape_mask(uint32_t *words, size_t bytes, const shape *s, ptrdiff_t stride,
                                    uint32_t fill)
{
    iris_image mask;
    for (size_t i = 0; i < bytes / sizeof *words; i++) {
        words[i] = fill;
    }
    assert_int_equal(iris_image_wrap(&mask, words, bytes, (iris_size){s->w, s->h}, stride, IRIS_MASK1),
                     IRIS_OK);
    for (int32_t y = 0; y < s->h; y++) {
        uint32_t *row = iris_image_row(&mask, y);
        for (int32_t x = 0; x < s->w; x++) {
            uint32_t one = (uint32_t)1 << x % 32;
            row[x / 32] = s->at[y][x] ? row[x / 32] | one : row[x / 32] & ~one;
        }
    }
    return mask;
}

static inline void shape_read(shape *s, const iris_image *mask)
{
    s->w = mask->w;
    s->h = mask->h;
    for (int32_t y = 0; y < s->h; y++) {
        const uint32_t *row = iris_image_row(mask, y);
        for (int32_t x = 0; x < s->w; x++) {
            s->at[y][x] = row[x / 32] >> x % 32 & 1;
        }
    }
}

static inline int shape_equal(const shape *a, const shape *b)
{
    int same = a->w == b->w && a->h == b->h;
    for (int32_t y = 0; same && y < a->h; y++) {
        same = memcmp(a->at[y], b->at[y], (size_t)a->w) == 0;
    }
    return same;
}

typedef struct {
    int parts; /* selected pixels that touch by a side or a corner */
    int holes; /* pixels that are not selected and touch by a side, cut off from the outside */
} shape_topology;

/* Floods over a copy with a margin of one pixel, which is all outside: a step over the edge of a row changes nothing. */
static inline shape_topology shape_count(const shape *s)
{
    static uint8_t value[(SHAPE_SIDE_MAX + 2) * (SHAPE_SIDE_MAX + 2)]; /* 2: seen */
    static int32_t stack[(SHAPE_SIDE_MAX + 2) * (SHAPE_SIDE_MAX + 2)];
    int32_t w = s->w + 2, h = s->h + 2;
    const int32_t step[8] = {-1, 1, -w, w, -w - 1, -w + 1, w - 1, w + 1};
    shape_topology result = {0, -1};
    memset(value, 0, (size_t)w * (size_t)h);
    for (int32_t y = 0; y < s->h; y++) {
        memcpy(value + (y + 1) * w + 1, s->at[y], (size_t)s->w);
    }
    for (int32_t start = 0; start < w * h; start++) {
        uint8_t of = value[start];
        if (of == 2) {
            continue;
        }
        result.parts += of == 1;
        result.holes += of == 0;
        int32_t used = 0;
        stack[used++] = start;
        value[start] = 2;
        while (used > 0) {
            int32_t i = stack[--used];
            for (int k = 0; k < (of ? 8 : 4); k++) {
                int32_t to = i + step[k];
                if (to >= 0 && to < w * h && value[to] == of) {
                    value[to] = 2;
                    stack[used++] = to;
                }
            }
        }
    }
    return result;
}

static inline ptrdiff_t shape_bytes_read(void *user, uint8_t *buffer, size_t bytes)
{
    return (ptrdiff_t)fread(buffer, 1, bytes, user);
}

/* Reads a shape of the shared data. Returns 0 when it is not there. */
static inline int shape_load(shape *s, const char *name)
{
    FILE *file = fopen(data_path(name), "rb");
    if (!file) {
        return 0;
    }
    iris_stream stream;
    iris_bmp_reader reader;
    iris_image gray;
    iris_stream_init(&stream, (iris_source){shape_bytes_read, file});
    assert_int_equal(iris_bmp_begin(&reader, &stream), IRIS_OK);
    assert_true(reader.w <= SHAPE_SIDE_MAX && reader.h <= SHAPE_SIDE_MAX);
    s->w = reader.w;
    s->h = reader.h;
    assert_int_equal(
        iris_image_wrap(&gray, s->at, sizeof s->at, (iris_size){s->w, s->h}, SHAPE_SIDE_MAX, IRIS_GRAY8),
        IRIS_OK);
    assert_int_equal(iris_bmp_read(&gray, &reader), IRIS_OK);
    fclose(file);
    for (int32_t y = 0; y < s->h; y++) {
        for (int32_t x = 0; x < s->w; x++) {
            s->at[y][x] = s->at[y][x] > 127;
        }
    }
    return 1;
}

/* The names of the 31 shapes: shape_name(0) to shape_name(30). */
static inline const char *shape_name(int i)
{
    static const char *const classes[] = {"apple", "bell",   "bone",   "bottle", "camel",
                                          "fork",  "guitar", "hammer", "heart",  "key"};
    static char name[64];
    if (i == 30) {
        return "shapes/horse.bmp";
    }
    snprintf(name, sizeof name, "shapes/mpeg7/%s-0%d.bmp", classes[i / 3], 1 + i % 3 * 4);
    return name;
}

#define SHAPE_NAMES 31

#endif
