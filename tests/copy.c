/* Copy, paste, fill, channels and resize. Pixels are made by hand; resize is held against floating point. */
#include "iris/copy.h"
#include "test.h"

#include <math.h>

static iris_image wrap(void *buffer, size_t bytes, int32_t w, int32_t h, ptrdiff_t stride, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, buffer, bytes, (iris_size){w, h}, stride, format), IRIS_OK);
    return image;
}

static iris_image crop(const iris_image *image, int32_t x, int32_t y, int32_t w, int32_t h)
{
    iris_image view;
    assert_int_equal(iris_image_crop(&view, image, (iris_rect){x, y, w, h}), IRIS_OK);
    return view;
}

static uint32_t random_next(uint32_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed;
}

static void random_bytes(void *bytes, size_t count, uint32_t seed)
{
    for (size_t i = 0; i < count; i++) {
        ((uint8_t *)bytes)[i] = (uint8_t)(random_next(&seed) >> 11);
    }
}

static int bit(const iris_image *mask, int32_t x, int32_t y)
{
    const uint32_t *row = iris_image_row(mask, y);
    return row[x / 32] >> (x % 32) & 1;
}

static const iris_format formats[] = {
    IRIS_GRAY8,       IRIS_GRAY_S16,    IRIS_GRAY_U16, IRIS_GRAY_U32,    IRIS_MASK1,
    IRIS_RGB888,      IRIS_BGR888,      IRIS_RGBA8888, IRIS_RGB565,      IRIS_RGB565_SWAP,
    IRIS_YUYV,        IRIS_UYVY,        IRIS_UV88,     IRIS_BAYER8_RGGB, IRIS_BAYER8_GRBG,
    IRIS_BAYER8_GBRG, IRIS_BAYER8_BGGR, IRIS_HSL24,    IRIS_HSL48,
};
enum { FORMATS = sizeof formats / sizeof formats[0] };

static void copy_of_every_format_into_padded_bottom_up_rows(void **state)
{
    (void)state;
    static uint32_t from[400], to[400];
    for (int f = 0; f < FORMATS; f++) {
        random_bytes(from, sizeof from, 7);
        memset(to, 0xA5, sizeof to);
        iris_image src = wrap(from, sizeof from, 6, 5, 0, formats[f]);
        iris_image dst = wrap(to, sizeof to, 6, 5, -48, formats[f]);
        assert_int_equal(iris_copy(&dst, &src), IRIS_OK);
        size_t bytes = iris_format_row_bytes(formats[f], 6);
        for (int y = 0; y < 5; y++) {
            const uint8_t *a = (const uint8_t *)from + (size_t)y * bytes;
            const uint8_t *b = (const uint8_t *)to + (size_t)(4 - y) * 48;
            if (formats[f] == IRIS_MASK1) { /* six bits copied, the rest as it was */
                uint32_t word_a, word_b;
                memcpy(&word_a, a, sizeof word_a);
                memcpy(&word_b, b, sizeof word_b);
                assert_int_equal(word_b, (word_a & 0x3f) | (0xA5A5A5A5 & ~0x3fu));
            } else {
                assert_memory_equal(a, b, bytes);
            }
            for (size_t i = bytes; i < 48; i++) {
                assert_int_equal(b[i], 0xA5);
            }
        }
    }
}

static void copy_refuses(void **state)
{
    (void)state;
    uint8_t bytes[100];
    random_bytes(bytes, sizeof bytes, 3);
    uint8_t before[100];
    memcpy(before, bytes, sizeof bytes);
    iris_image image = wrap(bytes, sizeof bytes, 10, 10, 0, IRIS_GRAY8);
    iris_image a = crop(&image, 0, 0, 5, 5), b = crop(&image, 4, 4, 5, 5), c = crop(&image, 5, 0, 5, 5);
    iris_image narrow = crop(&image, 5, 5, 4, 5), other = c, none = a;
    other.format = IRIS_BAYER8_GRBG;
    none.data = NULL;
    assert_int_equal(iris_copy(&a, &a), IRIS_OK);
    assert_int_equal(iris_copy(&a, &b), IRIS_ERR_ALIAS);
    assert_int_equal(iris_copy(&b, &a), IRIS_ERR_ALIAS);
    assert_int_equal(iris_copy(&a, &narrow), IRIS_ERR_RANGE);
    assert_int_equal(iris_copy(&a, &other), IRIS_ERR_FORMAT);
    assert_int_equal(iris_copy(&a, &none), IRIS_ERR_ARG);
    assert_int_equal(iris_copy(&none, &a), IRIS_ERR_ARG);
    assert_int_equal(iris_copy(NULL, &a), IRIS_ERR_ARG);
    assert_int_equal(iris_copy(&a, NULL), IRIS_ERR_ARG);
    iris_image upside = wrap(bytes, sizeof bytes, 10, 10, -10, IRIS_GRAY8);
    assert_int_equal(iris_copy(&upside, &image), IRIS_ERR_ALIAS); /* the same bytes, another picture */
    assert_memory_equal(bytes, before, sizeof bytes);
    assert_int_equal(iris_copy(&a, &c), IRIS_OK); /* side by side */
    assert_memory_equal(bytes + 40, before + 45, 5);
    assert_memory_equal(bytes + 50, before + 50, 50);
}

/* Every format, every position around and on a 8x6 picture, against a pixel-by-pixel truth. */
static void paste_is_clipped_at_every_side(void **state)
{
    (void)state;
    static uint32_t from[100], to[200], expected[200];
    for (int f = 0; f < FORMATS; f++) {
        iris_format format = formats[f];
        int pairs = format == IRIS_YUYV || format == IRIS_UYVY;
        int bayer = format >= IRIS_BAYER8_RGGB && format <= IRIS_BAYER8_BGGR;
        size_t pixel = iris_format_row_bytes(format, 2) / 2;
        random_bytes(from, sizeof from, 11);
        for (int32_t y = -5; y <= 7; y++) {
            for (int32_t x = -6; x <= 10; x++) {
                random_bytes(to, sizeof to, 12);
                memcpy(expected, to, sizeof to);
                iris_image src = wrap(from, sizeof from, 4, 3, -32, format);
                iris_image dst = wrap(to, sizeof to, 8, 6, 64, format);
                iris_image truth = wrap(expected, sizeof expected, 8, 6, 64, format);
                iris_status status = iris_paste(&dst, &src, x, y);
                int inside = x > -4 && x < 8 && y > -3 && y < 6;
                if (pairs && x % 2 != 0) {
                    assert_int_equal(status, IRIS_ERR_ALIGN);
                } else if (bayer && inside && (x % 2 != 0 || y % 2 != 0)) {
                    assert_int_equal(status, IRIS_ERR_FORMAT);
                } else {
                    assert_int_equal(status, IRIS_OK);
                    for (int32_t i = 0; i < 12; i++) {
                        int32_t sx = i % 4, sy = i / 4, dx = x + sx, dy = y + sy;
                        if (dx < 0 || dx > 7 || dy < 0 || dy > 5) {
                            continue;
                        }
                        if (format == IRIS_MASK1) {
                            uint32_t *row = iris_image_row(&truth, dy);
                            row[0] = (row[0] & ~(1u << dx)) | (uint32_t)bit(&src, sx, sy) << dx;
                        } else {
                            memcpy((uint8_t *)iris_image_row(&truth, dy) + (size_t)dx * pixel,
                                   (uint8_t *)iris_image_row(&src, sy) + (size_t)sx * pixel, pixel);
                        }
                    }
                }
                assert_memory_equal(to, expected, sizeof to);
            }
        }
    }
}

static void paste_takes_any_coordinate(void **state)
{
    (void)state;
    static const int32_t far_away[] = {INT32_MIN, INT32_MIN + 1, -32768, 32767, INT32_MAX - 1, INT32_MAX};
    static uint32_t from[16], to[64], before[64];
    random_bytes(to, sizeof to, 5);
    memcpy(before, to, sizeof to);
    for (int f = 0; f < FORMATS; f++) {
        iris_image src = wrap(from, sizeof from, 2, 2, 0, formats[f]);
        iris_image dst = wrap(to, sizeof to, 4, 4, 0, formats[f]);
        int pairs = formats[f] == IRIS_YUYV || formats[f] == IRIS_UYVY;
        for (int i = 0; i < 6; i++) {
            iris_status expected = pairs && far_away[i] % 2 != 0 ? IRIS_ERR_ALIGN : IRIS_OK;
            assert_int_equal(iris_paste(&dst, &src, far_away[i], 0), expected);
            assert_int_equal(iris_paste(&dst, &src, 0, far_away[i]), IRIS_OK);
            assert_int_equal(iris_paste(&dst, &src, far_away[i], far_away[5 - i]), expected);
        }
    }
    assert_memory_equal(to, before, sizeof to);
    iris_image gray = wrap(to, sizeof to, 4, 4, 0, IRIS_GRAY8);
    iris_image mask = wrap(from, sizeof from, 4, 4, 0, IRIS_MASK1);
    assert_int_equal(iris_paste(&gray, &mask, 0, 0), IRIS_ERR_FORMAT);
    assert_int_equal(iris_paste(&gray, &mask, 99, 0), IRIS_ERR_FORMAT);
    assert_int_equal(iris_paste(&gray, NULL, 0, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_paste(NULL, &gray, 0, 0), IRIS_ERR_ARG);
    /* into itself: a part onto a disjoint part, onto itself, and onto half of itself */
    iris_image part = crop(&gray, 0, 0, 2, 2);
    assert_int_equal(iris_paste(&gray, &part, 2, 1), IRIS_OK);
    assert_int_equal(((uint8_t *)to)[6], ((uint8_t *)before)[0]);
    assert_int_equal(((uint8_t *)to)[11], ((uint8_t *)before)[5]);
    assert_int_equal(iris_paste(&gray, &part, 0, 0), IRIS_OK);
    assert_int_equal(iris_paste(&gray, &part, 1, 0), IRIS_ERR_ALIAS);
    assert_int_equal(iris_paste(&gray, &gray, 3, 0), IRIS_OK); /* clipped: column 0 onto column 3 */
    assert_int_equal(((uint8_t *)to)[3], ((uint8_t *)before)[0]);
    assert_int_equal(((uint8_t *)to)[0], ((uint8_t *)before)[0]);
    assert_int_equal(iris_paste(&gray, &gray, 0, 1), IRIS_ERR_ALIAS);
}

/* A Bayer picture meets another pattern in step when it is pasted at the matching odd position. */
static void bayer_meets_in_step(void **state)
{
    (void)state;
    uint8_t from[4] = {1, 2, 3, 4}, to[16] = {0};
    iris_image src = wrap(from, sizeof from, 2, 2, 0, IRIS_BAYER8_GRBG);
    iris_image dst = wrap(to, sizeof to, 4, 4, 0, IRIS_BAYER8_RGGB);
    assert_int_equal(iris_paste(&dst, &src, 0, 0), IRIS_ERR_FORMAT);
    assert_int_equal(iris_paste(&dst, &src, 1, 0), IRIS_OK);
    const uint8_t expected[16] = {0, 1, 2, 0, 0, 3, 4};
    assert_memory_equal(to, expected, 16);
    assert_int_equal(iris_copy(&dst, &dst), IRIS_OK);
}

/* Every shift of source and destination, widths around the word, both directions; bits outside are kept. */
static void masks_move_by_any_number_of_bits(void **state)
{
    (void)state;
    static uint32_t from[4 * 2], to[4 * 2], before[4 * 2];
    random_bytes(from, sizeof from, 21);
    iris_image src = wrap(from, sizeof from, 128, 2, 0, IRIS_MASK1);
    static const int32_t widths[] = {1, 2, 31, 32, 33, 63, 64, 65, 96};
    for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        for (int32_t x = 0; x < 33; x++) {
            int32_t w = widths[i];
            if (x + w > 128) {
                continue;
            }
            random_bytes(to, sizeof to, 22);
            memcpy(before, to, sizeof to);
            iris_image dst = wrap(to, sizeof to, w, 2, 16, IRIS_MASK1);
            iris_image old = wrap(before, sizeof before, 128, 2, 16, IRIS_MASK1);
            iris_image whole = wrap(to, sizeof to, 128, 2, 16, IRIS_MASK1);
            assert_int_equal(iris_mask_copy(&dst, &src, x, 0), IRIS_OK);
            for (int32_t p = 0; p < 128; p++) {
                assert_int_equal(bit(&whole, p, 0), p < w ? bit(&src, x + p, 0) : bit(&old, p, 0));
                assert_int_equal(bit(&whole, p, 1), p < w ? bit(&src, x + p, 1) : bit(&old, p, 1));
            }
            iris_image narrow = wrap(from, sizeof from, w, 2, 16, IRIS_MASK1);
            random_bytes(to, sizeof to, 22);
            assert_int_equal(iris_paste(&whole, &narrow, x, -1), IRIS_OK);
            for (int32_t p = 0; p < 128; p++) {
                assert_int_equal(bit(&whole, p, 0),
                                 p >= x && p < x + w ? bit(&src, p - x, 1) : bit(&old, p, 0));
                assert_int_equal(bit(&whole, p, 1), bit(&old, p, 1));
            }
        }
    }
}

/* The last words of exact blocks, so that a sanitizer sees any word too many. */
static void mask_copy_reads_and_writes_no_word_too_many(void **state)
{
    (void)state;
    for (int32_t w = 1; w <= 96; w++) {
        for (int32_t x = 0; x < 40; x++) {
            size_t from_bytes = iris_format_row_bytes(IRIS_MASK1, x + w),
                   to_bytes = iris_format_row_bytes(IRIS_MASK1, w);
            uint32_t *from = malloc(from_bytes), *to = malloc(to_bytes);
            memset(from, 0x5c, from_bytes);
            memset(to, 0xff, to_bytes);
            iris_image src = wrap(from, from_bytes, x + w, 1, 0, IRIS_MASK1);
            iris_image dst = wrap(to, to_bytes, w, 1, 0, IRIS_MASK1);
            assert_int_equal(iris_mask_copy(&dst, &src, x, 0), IRIS_OK);
            for (int32_t p = 0; p < w; p++) {
                assert_int_equal(bit(&dst, p, 0), 0x5c >> ((x + p) % 8) & 1);
            }
            free(from);
            free(to);
        }
    }
}

static void mask_copy_refuses(void **state)
{
    (void)state;
    uint32_t words[16] = {0x12345678, 0x9abcdef0}, other[4] = {0};
    iris_image src = wrap(words, sizeof words, 60, 4, 0, IRIS_MASK1);
    iris_image dst = wrap(other, sizeof other, 20, 4, 0, IRIS_MASK1);
    assert_int_equal(iris_mask_copy(&dst, &src, 41, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_mask_copy(&dst, &src, 0, 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_mask_copy(&dst, &src, -1, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_mask_copy(&dst, &src, INT32_MAX, INT32_MAX), IRIS_ERR_RANGE);
    assert_int_equal(iris_mask_copy(&dst, &src, INT32_MIN, INT32_MIN), IRIS_ERR_RANGE);
    assert_int_equal(iris_mask_copy(&src, &dst, 0, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_mask_copy(&dst, NULL, 0, 0), IRIS_ERR_ARG);
    iris_image gray = wrap(words, sizeof words, 20, 3, 0, IRIS_GRAY8);
    assert_int_equal(iris_mask_copy(&dst, &gray, 0, 0), IRIS_ERR_FORMAT);
    iris_image part = crop(&src, 32, 0, 20, 4);
    assert_int_equal(iris_mask_copy(&part, &src, 32, 0), IRIS_OK); /* onto itself */
    assert_int_equal(iris_mask_copy(&part, &src, 33, 0), IRIS_ERR_ALIAS);
    assert_int_equal(iris_mask_copy(&part, &src, 0, 0), IRIS_OK); /* words side by side */
    assert_int_equal(words[1], 0x9ab45678);
    assert_int_equal(other[0], 0);
}

static void fill_of_every_format(void **state)
{
    (void)state;
    static const struct {
        iris_format format;
        uint64_t value, too_large;
        uint8_t bytes[8]; /* two pixels, as far as they fit */
    } cases[] = {
        {IRIS_GRAY8, 0x7f, 0x100, {0x7f, 0x7f}},
        {IRIS_RGB888, 0x102030, 0x1000000, {0x10, 0x20, 0x30, 0x10, 0x20, 0x30}},
        {IRIS_BGR888, 0x102030, 0x1000000, {0x30, 0x20, 0x10, 0x30, 0x20, 0x10}},
        {IRIS_HSL24, 0x102030, 0x1000000, {0x10, 0x20, 0x30, 0x10, 0x20, 0x30}},
        {IRIS_RGBA8888, 0x10203040, 0x100000000, {0x10, 0x20, 0x30, 0x40, 0x10, 0x20, 0x30, 0x40}},
        {IRIS_RGB565, 0xf812, 0x10000, {0x12, 0xf8, 0x12, 0xf8}},
        {IRIS_RGB565_SWAP, 0xf812, 0x10000, {0xf8, 0x12, 0xf8, 0x12}},
        {IRIS_YUYV, 0x708192, 0x1000000, {0x70, 0x81, 0x70, 0x92}},
        {IRIS_UYVY, 0x708192, 0x1000000, {0x81, 0x70, 0x92, 0x70}},
        {IRIS_UV88, 0x8192, 0x10000, {0x81, 0x92, 0x81, 0x92}},
        {IRIS_BAYER8_BGGR, 9, 256, {9, 9}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint8_t bytes[3 * 40];
        memset(bytes, 0xEE, sizeof bytes);
        iris_image image = wrap(bytes, sizeof bytes, 6, 3, 40, cases[i].format);
        iris_image part = crop(&image, 2, 1, 4, 2);
        assert_int_equal(iris_fill(&part, cases[i].too_large), IRIS_ERR_RANGE);
        assert_int_equal(iris_fill(&part, UINT64_MAX), IRIS_ERR_RANGE);
        assert_int_equal(bytes[60], 0xEE);
        assert_int_equal(iris_fill(&part, cases[i].value), IRIS_OK);
        size_t pair = iris_format_row_bytes(cases[i].format, 2);
        for (size_t at = 0; at < sizeof bytes; at++) {
            size_t x = at % 40;
            int inside = at >= 40 && x >= pair && x < 3 * pair;
            assert_int_equal(bytes[at], inside ? cases[i].bytes[(x - pair) % pair] : 0xEE);
        }
    }
}

static void fill_of_words_and_bits(void **state)
{
    (void)state;
    uint16_t words[12] = {0};
    iris_image image = wrap(words, sizeof words, 3, 3, 8, IRIS_GRAY_S16);
    assert_int_equal(iris_fill(&image, (uint16_t)-5), IRIS_OK);
    assert_int_equal((int16_t)words[0], -5);
    assert_int_equal((int16_t)words[10], -5);
    assert_int_equal(words[3], 0);
    assert_int_equal(iris_fill(&image, (uint64_t)-5), IRIS_ERR_RANGE);
    image = wrap(words, sizeof words, 2, 2, 12, IRIS_HSL48);
    assert_int_equal(iris_fill(&image, 0x07ff00aa01ff), IRIS_OK);
    for (int i = 0; i < 12; i += 3) {
        assert_int_equal(words[i], 0x7ff);
        assert_int_equal(words[i + 1], 0xaa);
        assert_int_equal(words[i + 2], 0x1ff);
    }
    uint32_t longs[6] = {0};
    image = wrap(longs, sizeof longs, 2, 3, -8, IRIS_GRAY_U32);
    assert_int_equal(iris_fill(&image, 0xfedcba98), IRIS_OK);
    assert_int_equal(longs[5], 0xfedcba98);
    memset(longs, 0x77, sizeof longs);
    image = wrap(longs, sizeof longs, 35, 3, 0, IRIS_MASK1);
    assert_int_equal(iris_fill(&image, 2), IRIS_ERR_RANGE);
    assert_int_equal(iris_fill(&image, 1), IRIS_OK);
    assert_int_equal(longs[0], 0xffffffff);
    assert_int_equal(longs[5], 0x77777777);
    assert_int_equal(iris_fill(&image, 0), IRIS_OK);
    assert_int_equal(longs[4], 0);
    assert_int_equal(longs[5], 0x77777770);
    assert_int_equal(iris_fill(NULL, 0), IRIS_ERR_ARG);
}

static void channels_out_and_in(void **state)
{
    (void)state;
    static const iris_format colors[] = {IRIS_RGB888, IRIS_BGR888, IRIS_HSL24, IRIS_RGBA8888};
    for (int f = 0; f < 4; f++) {
        int32_t step = f == 3 ? 4 : 3;
        uint8_t color[3 * 24], gray[3 * 7], before[3 * 24];
        random_bytes(color, sizeof color, 31);
        memcpy(before, color, sizeof color);
        iris_image image = wrap(color, sizeof color, 5, 3, 24, colors[f]);
        iris_image plane = wrap(gray, sizeof gray, 5, 3, -7, IRIS_GRAY8);
        for (int32_t channel = 0; channel < step; channel++) {
            memset(gray, 0xEE, sizeof gray);
            assert_int_equal(iris_channel_extract(&plane, &image, channel), IRIS_OK);
            for (int i = 0; i < 21; i++) {
                int x = i % 7, y = 2 - i / 7;
                assert_int_equal(gray[i], x < 5 ? before[y * 24 + x * step + channel] : 0xEE);
            }
            for (int i = 0; i < 21; i++) {
                gray[i] = (uint8_t)(gray[i] ^ 0xff);
            }
            assert_int_equal(iris_channel_insert(&image, &plane, channel), IRIS_OK);
            for (int i = 0; i < 72; i++) {
                int inside = i % 24 < 5 * step && i % 24 % step == channel;
                assert_int_equal(color[i], inside ? before[i] ^ 0xff : before[i]);
            }
            memcpy(color, before, sizeof color);
        }
        assert_int_equal(iris_channel_extract(&plane, &image, step), IRIS_ERR_ARG);
        assert_int_equal(iris_channel_insert(&image, &plane, -1), IRIS_ERR_ARG);
        iris_image narrow = crop(&plane, 0, 0, 4, 3);
        assert_int_equal(iris_channel_extract(&narrow, &image, 0), IRIS_ERR_RANGE);
        assert_int_equal(iris_channel_extract(&image, &plane, 0), IRIS_ERR_FORMAT);
        assert_int_equal(iris_channel_insert(&plane, &plane, 0), IRIS_ERR_FORMAT);
        iris_image inside = wrap(color, sizeof color, 5, 3, 24, IRIS_GRAY8);
        assert_int_equal(iris_channel_extract(&inside, &image, 0), IRIS_ERR_ALIAS);
        assert_int_equal(iris_channel_insert(&image, &inside, 0), IRIS_ERR_ALIAS);
        assert_int_equal(iris_channel_insert(&image, NULL, 0), IRIS_ERR_ARG);
        assert_memory_equal(color, before, sizeof color);
    }
}

/* The src pixel whose center is nearest, by trying all; the later of two. Distances times 2 * dst_side. */
static int32_t nearest(int32_t i, int32_t dst_side, int32_t src_side)
{
    int32_t best = 0;
    int64_t best_distance = INT64_MAX;
    for (int32_t s = 0; s < src_side; s++) {
        int64_t distance = llabs((int64_t)(2 * i + 1) * src_side - (int64_t)(2 * s + 1) * dst_side);
        if (distance <= best_distance) {
            best = s;
            best_distance = distance;
        }
    }
    return best;
}

static double between(const iris_image *src, double x, double y, int32_t step, int32_t channel)
{
    x = fmin(fmax(x, 0), src->w - 1);
    y = fmin(fmax(y, 0), src->h - 1);
    int32_t x0 = (int32_t)x, y0 = (int32_t)y;
    int32_t x1 = x0 + (x0 < src->w - 1), y1 = y0 + (y0 < src->h - 1);
    const uint8_t *a = iris_image_row(src, y0), *b = iris_image_row(src, y1);
    double upper = a[x0 * step + channel] * (1 - (x - x0)) + a[x1 * step + channel] * (x - x0);
    double lower = b[x0 * step + channel] * (1 - (x - x0)) + b[x1 * step + channel] * (x - x0);
    return upper * (1 - (y - y0)) + lower * (y - y0);
}

static void check_resize(iris_size from, iris_size to, iris_format format)
{
    static uint8_t src_bytes[60 * 60 * 3], dst_bytes[64 * 64 * 3];
    random_bytes(src_bytes, sizeof src_bytes, 41);
    int32_t step = format == IRIS_GRAY8 ? 1 : 3;
    iris_image src = wrap(src_bytes, sizeof src_bytes, from.w, from.h, -(from.w * step + 1), format);
    iris_image dst = wrap(dst_bytes, sizeof dst_bytes, to.w, to.h, to.w * step + 2, format);
    for (int method = 0; method < 2; method++) {
        memset(dst_bytes, 0xEE, sizeof dst_bytes);
        assert_int_equal((method ? iris_resize_bilinear : iris_resize_nearest)(&dst, &src), IRIS_OK);
        for (int32_t y = 0; y < to.h; y++) {
            const uint8_t *row = iris_image_row(&dst, y);
            double sy = (y + 0.5) * from.h / to.h - 0.5;
            int32_t ny = nearest(y, to.h, from.h);
            for (int32_t i = 0; i < to.w * step; i++) {
                int32_t x = i / step, c = i % step;
                if (method == 0) {
                    const uint8_t *near = iris_image_row(&src, ny);
                    assert_int_equal(row[i], near[nearest(x, to.w, from.w) * step + c]);
                } else {
                    double real = between(&src, (x + 0.5) * from.w / to.w - 0.5, sy, step, c);
                    assert_true(fabs(row[i] - real) <= 0.625);
                }
            }
            assert_int_equal(row[to.w * step], 0xEE);
            assert_int_equal(row[to.w * step + 1], 0xEE);
        }
    }
}

static void resize_against_floating_point(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1},   {1, 7},   {2, 2},  {3, 2},  {5, 31},
                                      {17, 13}, {32, 24}, {59, 1}, {59, 59}};
    static const iris_format three[] = {IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};
    enum { SIZES = sizeof sizes / sizeof sizes[0] };
    for (int f = 0; f < 3; f++) {
        for (int i = 0; i < SIZES * SIZES; i++) {
            check_resize(sizes[i / SIZES], sizes[i % SIZES], three[f]);
        }
    }
}

static void resize_by_hand(void **state)
{
    (void)state;
    uint8_t two[4] = {0, 255, 100, 10}, four[16], one[1];
    iris_image src = wrap(two, sizeof two, 2, 2, 0, IRIS_GRAY8);
    iris_image dst = wrap(four, sizeof four, 4, 4, 0, IRIS_GRAY8);
    assert_int_equal(iris_resize_bilinear(&dst, &src), IRIS_OK);
    /* weights 3/4 and 1/4: row 0 is 0 63.75 191.25 255, column 3 is 255 193.75 71.25 10 */
    const uint8_t row0[4] = {0, 64, 191, 255}, column0[4] = {0, 25, 75, 100}, column3[4] = {255, 194, 71, 10};
    assert_memory_equal(four, row0, 4);
    for (int y = 0; y < 4; y++) {
        assert_int_equal(four[4 * y], column0[y]);
        assert_int_equal(four[4 * y + 3], column3[y]);
    }
    assert_int_equal(four[5], 67);  /* (9 * 0 + 3 * 255 + 3 * 100 + 10) / 16 = 67.1875 */
    assert_int_equal(four[10], 72); /* (0 + 3 * 255 + 3 * 100 + 9 * 10) / 16 = 72.1875 */
    const uint8_t near[16] = {0, 0, 255, 255, 0, 0, 255, 255, 100, 100, 10, 10, 100, 100, 10, 10};
    assert_int_equal(iris_resize_nearest(&dst, &src), IRIS_OK);
    assert_memory_equal(four, near, 16);

    iris_image single = wrap(one, sizeof one, 1, 1, 0, IRIS_GRAY8);
    assert_int_equal(iris_resize_bilinear(&single, &src), IRIS_OK);
    assert_int_equal(one[0], 91); /* 365 / 4 = 91.25 */
    two[3] = 11;
    assert_int_equal(iris_resize_bilinear(&single, &src), IRIS_OK);
    assert_int_equal(one[0], 92); /* 366 / 4 = 91.5: half up */
    assert_int_equal(iris_resize_nearest(&single, &src), IRIS_OK);
    assert_int_equal(one[0], 11); /* four centers are equally near: the right one of the lower two */
    assert_int_equal(iris_resize_bilinear(&dst, &single), IRIS_OK);
    assert_int_equal(four[0] + four[15], 22);

    random_bytes(four, sizeof four, 9);
    uint8_t same[16];
    iris_image copy = wrap(same, sizeof same, 4, 4, 0, IRIS_GRAY8);
    assert_int_equal(iris_resize_bilinear(&copy, &dst), IRIS_OK);
    assert_memory_equal(same, four, 16);
}

/* The longest sides: no drift, no overflow. */
static void resize_of_the_longest_rows(void **state)
{
    (void)state;
    static uint8_t from[IRIS_SIDE_MAX], to[IRIS_SIDE_MAX];
    static const int32_t widths[][2] = {{IRIS_SIDE_MAX, IRIS_SIDE_MAX},
                                        {IRIS_SIDE_MAX, IRIS_SIDE_MAX - 1},
                                        {IRIS_SIDE_MAX - 1, IRIS_SIDE_MAX},
                                        {3, IRIS_SIDE_MAX},
                                        {IRIS_SIDE_MAX, 3},
                                        {1, IRIS_SIDE_MAX},
                                        {IRIS_SIDE_MAX, 1},
                                        {16, IRIS_SIDE_MAX}};
    random_bytes(from, sizeof from, 77);
    for (int i = 0; i < 8; i++) {
        for (int tall = 0; tall < 2; tall++) {
            int32_t n = widths[i][0], m = widths[i][1];
            iris_image src = wrap(from, sizeof from, tall ? 1 : n, tall ? n : 1, 0, IRIS_GRAY8);
            iris_image dst = wrap(to, sizeof to, tall ? 1 : m, tall ? m : 1, 0, IRIS_GRAY8);
            assert_int_equal(iris_resize_nearest(&dst, &src), IRIS_OK);
            for (int64_t x = 0; x < m; x++) {
                assert_int_equal(to[x], from[(2 * x + 1) * n / (2 * m)]);
            }
            assert_int_equal(iris_resize_bilinear(&dst, &src), IRIS_OK);
            for (int32_t x = 0; x < m; x++) {
                double at = (x + 0.5) * n / m - 0.5;
                double real = between(&src, tall ? 0 : at, tall ? at : 0, 1, 0);
                assert_true(fabs(to[x] - real) <= 0.5625);
            }
        }
    }
}

static void resize_refuses(void **state)
{
    (void)state;
    static uint32_t words[64], others[64];
    iris_image a = wrap(words, sizeof words, 8, 4, 0, IRIS_RGB888),
               b = wrap(others, sizeof others, 4, 4, 0, IRIS_BGR888);
    assert_int_equal(iris_resize_nearest(&b, &a), IRIS_ERR_FORMAT);
    assert_int_equal(iris_resize_bilinear(&b, &a), IRIS_ERR_FORMAT);
    assert_int_equal(iris_resize_nearest(&a, &a), IRIS_ERR_ALIAS);
    assert_int_equal(iris_resize_bilinear(&a, &a), IRIS_ERR_ALIAS);
    assert_int_equal(iris_resize_bilinear(NULL, &a), IRIS_ERR_ARG);
    assert_int_equal(iris_resize_nearest(&a, NULL), IRIS_ERR_ARG);
    a = wrap(words, sizeof words, 8, 4, 0, IRIS_MASK1);
    b = wrap(others, sizeof others, 4, 4, 0, IRIS_MASK1);
    assert_int_equal(iris_resize_nearest(&b, &a), IRIS_ERR_FORMAT);
    assert_int_equal(iris_resize_bilinear(&b, &a), IRIS_ERR_FORMAT);
    b.w = 0;
    assert_int_equal(iris_resize_nearest(&b, &a), IRIS_ERR_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copy_of_every_format_into_padded_bottom_up_rows),
        cmocka_unit_test(copy_refuses),
        cmocka_unit_test(paste_is_clipped_at_every_side),
        cmocka_unit_test(paste_takes_any_coordinate),
        cmocka_unit_test(bayer_meets_in_step),
        cmocka_unit_test(masks_move_by_any_number_of_bits),
        cmocka_unit_test(mask_copy_reads_and_writes_no_word_too_many),
        cmocka_unit_test(mask_copy_refuses),
        cmocka_unit_test(fill_of_every_format),
        cmocka_unit_test(fill_of_words_and_bits),
        cmocka_unit_test(channels_out_and_in),
        cmocka_unit_test(resize_against_floating_point),
        cmocka_unit_test(resize_by_hand),
        cmocka_unit_test(resize_of_the_longest_rows),
        cmocka_unit_test(resize_refuses),
    };
    return cmocka_run_group_tests_name("copy", tests, NULL, NULL);
}
