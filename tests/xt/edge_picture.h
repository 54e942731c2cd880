/* For the tests of edges: pictures inside larger ones, results inside larger ones, and what lies beyond an edge. */
#ifndef IRIS_TEST_EDGE_PICTURE_H
#define IRIS_TEST_EDGE_PICTURE_H

#include "../picture.h"
#include "iris/border.h"
#include "iris/image.h"
#include "iris/scratch.h"

#define SIDE_MAX      132
#define PICTURE_KINDS 5

/* What results are filled with before a call. */
#define UNTOUCHED           0xA5
#define UNTOUCHED_S16       ((int16_t)0xA5A5)
#define UNTOUCHED_BIT(x, y) ((0xA5 >> (x) % 8) & 1)

/* A result's rows are this far apart; they begin 4 rows and 32 bytes into the buffer. */
#define STRIDE (2 * SIDE_MAX + 96)

static uint8_t source[(SIDE_MAX + 8) * STRIDE];
static union {
    uint8_t bytes[(SIDE_MAX + 8) * STRIDE];
    uint32_t word;
} result_memory[3]; /* views of 8 or 16 bits, two of them; a mask */
static IRIS_SCRATCH_BUFFER(working, 1 << 18);

static inline iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_true(bytes <= sizeof working.memory);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, bytes), IRIS_OK);
    return scratch;
}

static inline int pixel(const iris_image *image, int32_t x, int32_t y)
{
    return ((const uint8_t *)iris_image_row(image, y))[x];
}

static inline int bit(const iris_image *mask, int32_t x, int32_t y)
{
    return ((const uint32_t *)iris_image_row(mask, y))[x / 32] >> x % 32 & 1;
}

/* The position that stands for i; -1: the constant. Mirrored step by step. */
static inline int32_t place_beyond(int32_t i, int32_t n, iris_border_rule rule)
{
    while (i < 0 || i >= n) {
        if (rule == IRIS_BORDER_CONSTANT) {
            return -1;
        }
        if (rule != IRIS_BORDER_REFLECT101 || n == 1) {
            return i < 0 ? 0 : n - 1;
        }
        i = i < 0 ? -i : 2 * (n - 1) - i;
    }
    return i;
}

static inline int pixel_beyond(const iris_image *image, int32_t x, int32_t y, iris_border border)
{
    int32_t u = place_beyond(x, image->w, border.rule), v = place_beyond(y, image->h, border.rule);
    return u < 0 || v < 0 ? border.value : pixel(image, u, v);
}

/* A view of 8-bit pixels in the middle of noise, at an odd offset; rows from top to bottom or the other way. */
static inline iris_image source_view(iris_size size, int upwards)
{
    static uint32_t random = 7;
    for (size_t i = 0; i < sizeof source; i++) {
        source[i] = (uint8_t)next_random(&random);
    }
    iris_image image, view;
    assert_int_equal(iris_image_wrap(&image, source, sizeof source, (iris_size){SIDE_MAX + 50, SIDE_MAX + 8},
                                     upwards ? -STRIDE : STRIDE, IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&view, &image, (iris_rect){7, 3, size.w, size.h}), IRIS_OK);
    return view;
}

/* Noise; noise of black and white; noise of few levels; a slope with steps; even. */
static inline iris_image picture_of(int kind, iris_size size)
{
    iris_image view = source_view(size, kind % 2);
    for (int32_t y = 0; y < size.h; y++) {
        uint8_t *row = iris_image_row(&view, y);
        for (int32_t x = 0; x < size.w; x++) {
            int noise = row[x];
            row[x] = (uint8_t)(kind == 0   ? noise
                               : kind == 1 ? noise % 2 * 255
                               : kind == 2 ? noise % 4 + 100
                               : kind == 3 ? (x + 2 * y) / 3 + (x / 5 % 2 ? 60 : 0) + (y / 7 % 2 ? 90 : 0)
                                           : 200);
        }
    }
    return view;
}

/* A part of a photograph. */
static inline iris_image picture_part(const picture *from, int32_t left, int32_t top, iris_size size)
{
    iris_image view = source_view(size, top % 2);
    for (int32_t y = 0; y < size.h; y++) {
        memcpy(iris_image_row(&view, y), from->pixels + (top + y) * from->w + left, (size_t)size.w);
    }
    return view;
}

/* A result of the size of src; slot 0 or 1. */
static inline iris_image other_view(const iris_image *src, iris_format format, int slot)
{
    iris_image view;
    uint8_t *bytes = result_memory[slot].bytes;
    memset(bytes, UNTOUCHED, sizeof result_memory[slot].bytes);
    assert_int_equal(iris_image_wrap(&view, bytes + 4 * STRIDE + 32, (size_t)src->h * STRIDE,
                                     (iris_size){src->w, src->h}, src->w % 2 ? STRIDE : -STRIDE, format),
                     IRIS_OK);
    return view;
}

static inline iris_image mask_view(int32_t w, int32_t h)
{
    iris_image view;
    memset(result_memory[2].bytes, UNTOUCHED, sizeof result_memory[2].bytes);
    assert_int_equal(iris_image_wrap(&view, result_memory[2].bytes + 4 * STRIDE + 32, (size_t)h * STRIDE,
                                     (iris_size){w, h}, w % 2 ? STRIDE : -STRIDE, IRIS_MASK1),
                     IRIS_OK);
    return view;
}

/* Nothing was written before the views, beside them, or far behind. */
static inline void assert_around_untouched(void)
{
    for (int slot = 0; slot < 3; slot++) {
        const uint8_t *bytes = result_memory[slot].bytes;
        for (int32_t i = 0; i < SIDE_MAX + 8; i++) {
            for (int32_t k = 0; k < (i < 4 ? STRIDE : 32); k++) {
                assert_true(bytes[i * STRIDE + k] == UNTOUCHED || bytes[i * STRIDE + k] == 0);
            }
        }
    }
}

static inline void reset_results(void)
{
    for (int slot = 0; slot < 3; slot++) {
        memset(result_memory[slot].bytes, UNTOUCHED, sizeof result_memory[slot].bytes);
    }
}

static inline void assert_all_untouched(void)
{
    for (int slot = 0; slot < 3; slot++) {
        for (size_t i = 0; i < sizeof result_memory[slot].bytes; i++) {
            assert_true(result_memory[slot].bytes[i] == UNTOUCHED || result_memory[slot].bytes[i] == 0);
        }
    }
}

#endif
