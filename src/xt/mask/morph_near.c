#include "morph_near.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "mask_bits.h"

int iris_morph_is_near(const iris_morph_element *element)
{
    return element->w == 3 && element->h == 3 && !element->exclude_center;
}

iris_morph_near iris_morph_near_of(const iris_image *src, const iris_morph_element *element, int erodes,
                                   iris_border border)
{
    iris_format format = src->format;
    int32_t channels = format == IRIS_RGB888 || format == IRIS_BGR888 ? 3 : 1;
    int set = border.rule == IRIS_BORDER_CONSTANT ? border.value != 0 : erodes;
    return (iris_morph_near){
        src->w, channels, format == IRIS_MASK1, erodes, element->shape == IRIS_MORPH_CROSS, set ? ~0u : 0u};
}

static void join(const iris_morph_near *near, uint8_t *dst, const uint8_t *a, const uint8_t *b,
                 const uint8_t *c, int32_t n)
{
    (near->erodes ? iris_row_min3_u8 : iris_row_max3_u8)(dst, a, b, c, n);
}

/* Word i of three rows joined; beyond the edge what stands for it. */
static uint32_t joined_word(const uint32_t *const rows[3], const iris_morph_near *near, int32_t i)
{
    uint32_t inside = i < 0 ? 0 : iris_mask_range(i, 0, near->w), joined = 0;
    if (inside != 0) {
        uint32_t a = rows[0][i], b = rows[1][i], c = rows[2][i];
        joined = near->erodes ? a & b & c : a | b | c;
    }
    return (joined & inside) | (near->beyond & ~inside);
}

/* Three rows, and to each pixel what is beside it, joined. */
static void join_words(uint32_t *to, const uint32_t *const rows[3], const iris_morph_near *near,
                       int32_t words)
{
    int32_t whole = words < near->w / 32 ? words : near->w / 32;
    const uint32_t beside[2] = {near->beyond, joined_word(rows, near, whole)};
    iris_row_join9_mask(to, rows, beside, near->erodes ? ~0u : 0u, whole);
    if (whole < words) { /* the last word, which has pixels past w */
        uint32_t left = joined_word(rows, near, whole - 1), here = beside[1];
        left = left >> 31 | here << 1;
        to[whole] = near->erodes ? left & here & here >> 1 : left | here | here >> 1;
    }
}

/* n bytes of a mask's row. */
static void join_mask(uint8_t *to, const uint8_t *const rows[3], const iris_morph_near *near, int32_t n)
{
    uint32_t *words = (uint32_t *)(void *)to;
    const uint32_t *above = (const uint32_t *)(const void *)rows[0];
    const uint32_t *middle = (const uint32_t *)(const void *)rows[1];
    const uint32_t *below = (const uint32_t *)(const void *)rows[2];
    if (near->cross) {
        join_words(words, (const uint32_t *const[3]){middle, middle, middle}, near, n / 4);
        iris_row_join_rows_mask(words, words, above, below, near->erodes ? ~0u : 0u, n / 4);
    } else {
        join_words(words, (const uint32_t *const[3]){above, middle, below}, near, n / 4);
    }
}

void iris_morph_near_row(uint8_t *to, const uint8_t *const rows[3], const iris_morph_near *near, int32_t n)
{
    int32_t channels = near->channels;
    if (near->mask) {
        join_mask(to, rows, near, n);
    } else if (near->cross) {
        join(near, to, rows[0], rows[1], rows[2], n);
        join(near, to, to, rows[1] - channels, rows[1] + channels, n);
    } else {
        (near->erodes ? iris_row_min9_u8 : iris_row_max9_u8)(to, rows, channels, n);
    }
}

static inline uint8_t larger(uint32_t a, uint32_t b)
{
    return (uint8_t)(a > b ? a : b);
}

/* Of three samples with the bits of `turn` turned. */
static inline uint8_t largest(const uint8_t *const rows[3], int32_t at, uint8_t turn)
{
    return larger(larger(rows[0][at] ^ turn, rows[1][at] ^ turn), rows[2][at] ^ turn);
}

/* The pixel whose samples are from `at` on, at the left or right edge; its neighbor within is at `beside`. level: null where
 * what is beyond is a copy of what is within. The least is the largest of the negatives. */
static inline void join_edge(uint8_t *to, const uint8_t *const rows[3], const iris_morph_near *near,
                             int32_t at, int32_t beside, const uint8_t *level)
{
    const uint8_t turn = near->erodes ? 255 : 0;
    for (int32_t c = 0; c < near->channels; c++) {
        int32_t next = beside + c;
        uint8_t within = near->cross ? rows[1][next] ^ turn : largest(rows, next, turn);
        uint8_t joined = larger(within, largest(rows, at + c, turn));
        to[at + c] = (level ? larger(joined, level[c] ^ turn) : joined) ^ turn;
    }
}

static void make_row(uint8_t *to, const uint8_t *const rows[3], const iris_morph_near *near,
                     const uint8_t *level, int32_t skipped)
{
    int32_t channels = near->channels, end = (near->w - 1) * channels, beside = near->w > 1 ? channels : 0;
    const uint8_t *inner[3] = {rows[0] + channels, rows[1] + channels, rows[2] + channels};
    if (end > channels) {
        iris_morph_near_row(to + channels, inner, near, end - channels);
    }
    if (!skipped) {
        join_edge(to, rows, near, 0, beside, level);
        join_edge(to, rows, near, end, end - beside, level);
    }
}

/* Pixels skipped..w - skipped - 1 of a mask's row; the others of their words keep their values. */
static void make_mask(uint32_t *to, const uint8_t *const rows[3], const iris_morph_near *near,
                      int32_t skipped)
{
    int32_t end = near->w - skipped, last = (end - 1) / 32;
    uint32_t before = to[0], after = to[last];
    uint32_t first_bits = iris_mask_range(0, skipped, end), last_bits = iris_mask_range(last, skipped, end);
    iris_morph_near_row((uint8_t *)to, rows, near, 4 * (last + 1));
    to[0] = (to[0] & first_bits) | (before & ~first_bits);
    to[last] = (to[last] & last_bits) | (after & ~last_bits);
}

void iris_morph_near_picture(const iris_image *dst, const iris_image *src, const iris_morph_near *near,
                             iris_border border, uint8_t *level)
{
    const uint8_t *rows[3], *beyond = border.rule == IRIS_BORDER_CONSTANT ? level : NULL;
    int32_t skipped = border.rule == IRIS_BORDER_SKIP ? 1 : 0;
    memset(level, near->mask && border.value != 0 ? 255 : border.value,
           iris_format_row_bytes(src->format, src->w));
    for (int32_t y = skipped; y < src->h - skipped; y++) {
        void *to = iris_image_row(dst, y);
        for (int32_t k = 0; k < 3; k++) {
            int32_t row = iris_border_index(y + k - 1, src->h, border.rule);
            rows[k] = row < 0 ? level : (const uint8_t *)iris_image_row(src, row);
        }
        if (near->mask) {
            make_mask((uint32_t *)to, rows, near, skipped);
        } else {
            make_row((uint8_t *)to, rows, near, beyond, skipped);
        }
    }
}
