#include "iris/copy.h"

#include <string.h>

#include "kernel.h"
#include "views.h"

static iris_status check_both(const iris_image *dst, const iris_image *src)
{
    iris_status status = iris_image_check(dst);
    return status != IRIS_OK ? status : iris_image_check(src);
}

/* 32 pixels from x on. The first `count` (1 to 32) are valid, and no word without one of these is read. */
static uint32_t bits_at(const uint32_t *row, int32_t x, int32_t count)
{
    int32_t shift = x % 32;
    uint32_t bits = row[x / 32] >> shift;
    if (shift + count > 32) {
        bits |= row[x / 32 + 1] << (32 - shift);
    }
    return bits;
}

/* n pixels of a mask's row, from src_x to dst_x. */
static void copy_bits(uint32_t *dst, int32_t dst_x, const uint32_t *src, int32_t src_x, int32_t n)
{
    int32_t count;
    for (int32_t done = 0; done < n; done += count) {
        int32_t first = (dst_x + done) % 32;
        count = n - done < 32 - first ? n - done : 32 - first;
        uint32_t select = (~0u >> (32 - count)) << first;
        uint32_t bits = bits_at(src, src_x + done, count) << first;
        uint32_t *word = &dst[(dst_x + done) / 32];
        *word = (*word & ~select) | (bits & select);
    }
}

/* The words of a mask that hold rect; *shift is where it begins in the first. */
static iris_image words_of(int32_t *shift, const iris_image *mask, iris_rect rect)
{
    iris_image words = *mask;
    *shift = rect.x % 32;
    words.data = (uint32_t *)iris_image_row(mask, rect.y) + rect.x / 32;
    words.w = *shift + rect.w;
    words.h = rect.h;
    return words;
}

/* Both rectangles are inside and of one size. */
static iris_status copy_mask(const iris_image *dst, iris_rect to, const iris_image *src, iris_rect from)
{
    int32_t to_shift, from_shift;
    iris_image target = words_of(&to_shift, dst, to);
    iris_image part = words_of(&from_shift, src, from);
    if (iris_views_same_place(&target, &part) && to_shift == from_shift) {
        return IRIS_OK;
    }
    if (iris_image_overlaps(&target, &part)) {
        return IRIS_ERR_ALIAS;
    }
    for (int32_t y = 0; y < to.h; y++) {
        copy_bits(iris_image_row(&target, y), to_shift, iris_image_row(&part, y), from_shift, to.w);
    }
    return IRIS_OK;
}

iris_status iris_copy(const iris_image *dst, const iris_image *src)
{
    iris_status status = check_both(dst, src);
    if (status != IRIS_OK) {
        return status;
    }
    if (dst->format != src->format) {
        return IRIS_ERR_FORMAT;
    }
    if (dst->w != src->w || dst->h != src->h) {
        return IRIS_ERR_RANGE;
    }
    if (dst->format == IRIS_MASK1) {
        iris_rect all = {0, 0, dst->w, dst->h};
        return copy_mask(dst, all, src, all);
    }
    if (iris_views_same_place(dst, src)) {
        return IRIS_OK;
    }
    if (iris_image_overlaps(dst, src)) {
        return IRIS_ERR_ALIAS;
    }
    size_t bytes = iris_format_row_bytes(dst->format, dst->w);
    for (int32_t y = 0; y < dst->h; y++) {
        memcpy(iris_image_row(dst, y), iris_image_row(src, y), bytes);
    }
    return IRIS_OK;
}

iris_status iris_mask_copy(const iris_image *dst, const iris_image *src, int32_t x, int32_t y)
{
    iris_status status = check_both(dst, src);
    if (status != IRIS_OK) {
        return status;
    }
    if (dst->format != IRIS_MASK1 || src->format != IRIS_MASK1) {
        return IRIS_ERR_FORMAT;
    }
    if (x < 0 || y < 0 || x > src->w - dst->w || y > src->h - dst->h) {
        return IRIS_ERR_RANGE;
    }
    return copy_mask(dst, (iris_rect){0, 0, dst->w, dst->h}, src, (iris_rect){x, y, dst->w, dst->h});
}

/* How much of a length that begins at `at` is inside 0..limit-1; *from is the first position inside. */
static int32_t clipped(int32_t *from, int32_t at, int32_t length, int32_t limit)
{
    int64_t first = at < 0 ? 0 : at;
    int64_t end = (int64_t)at + length < limit ? (int64_t)at + length : limit;
    *from = (int32_t)first;
    return end > first ? (int32_t)(end - first) : 0;
}

iris_status iris_paste(const iris_image *dst, const iris_image *src, int32_t x, int32_t y)
{
    iris_status status = check_both(dst, src);
    if (status != IRIS_OK) {
        return status;
    }
    if (dst->format != src->format &&
        !(iris_format_is_bayer(dst->format) && iris_format_is_bayer(src->format))) {
        return IRIS_ERR_FORMAT;
    }
    if ((dst->format == IRIS_YUYV || dst->format == IRIS_UYVY) && x % 2 != 0) {
        return IRIS_ERR_ALIGN;
    }
    iris_rect to;
    to.w = clipped(&to.x, x, src->w, dst->w);
    to.h = clipped(&to.y, y, src->h, dst->h);
    if (to.w == 0 || to.h == 0) {
        return IRIS_OK;
    }
    iris_rect from = {to.x - x, to.y - y, to.w, to.h};
    if (dst->format == IRIS_MASK1) {
        return copy_mask(dst, to, src, from);
    }
    iris_image target, part;
    status = iris_image_crop(&target, dst, to);
    if (status == IRIS_OK) {
        status = iris_image_crop(&part, src, from);
    }
    return status == IRIS_OK ? iris_copy(&target, &part) : status;
}

/* Stores the low `bytes` bytes of value, the highest first. */
static void put_bytes(uint8_t *pixel, uint64_t value, size_t bytes)
{
    while (bytes > 0) {
        pixel[--bytes] = (uint8_t)value;
        value >>= 8;
    }
}

/* Stores 16 bits in the order of this processor. */
static void put_word(uint8_t *pixel, uint64_t value)
{
    uint16_t word = (uint16_t)value;
    memcpy(pixel, &word, sizeof word);
}

/* The bytes of one pixel, of two in a YUV 4:2:2 format. Returns how many. */
static size_t pixel_of(uint8_t pixel[6], iris_format format, uint64_t value)
{
    size_t bytes = iris_format_row_bytes(format, 1);
    uint32_t word = (uint32_t)value;
    uint8_t luma = (uint8_t)(value >> 16), u = (uint8_t)(value >> 8), v = (uint8_t)value;
    switch (format) {
    case IRIS_GRAY_S16:
    case IRIS_GRAY_U16:
        put_word(pixel, value);
        return bytes;
    case IRIS_GRAY_U32:
        memcpy(pixel, &word, sizeof word);
        return bytes;
    case IRIS_HSL48:
        put_word(pixel, value >> 32);
        put_word(pixel + 2, value >> 16);
        put_word(pixel + 4, value);
        return bytes;
    case IRIS_BGR888:
        put_bytes(pixel, (uint64_t)v << 16 | (uint64_t)u << 8 | luma, bytes);
        return bytes;
    case IRIS_RGB565:
        put_bytes(pixel, (uint64_t)v << 8 | u, bytes);
        return bytes;
    case IRIS_YUYV:
        put_bytes(pixel, (uint64_t)luma << 24 | (uint64_t)u << 16 | (uint64_t)luma << 8 | v, 4);
        return 4;
    case IRIS_UYVY:
        put_bytes(pixel, (uint64_t)u << 24 | (uint64_t)luma << 16 | (uint64_t)v << 8 | luma, 4);
        return 4;
    default:
        put_bytes(pixel, value, bytes);
        return bytes;
    }
}

static int32_t pixel_bits(iris_format format)
{
    switch (format) {
    case IRIS_MASK1:
        return 1;
    case IRIS_YUYV:
    case IRIS_UYVY:
        return 24;
    default:
        return (int32_t)iris_format_row_bytes(format, 1) * 8;
    }
}

iris_status iris_fill(const iris_image *dst, uint64_t value)
{
    iris_status status = iris_image_check(dst);
    if (status != IRIS_OK) {
        return status;
    }
    if (value >> pixel_bits(dst->format) != 0) {
        return IRIS_ERR_RANGE;
    }
    if (dst->format == IRIS_MASK1) {
        const uint32_t word = value ? ~0u : 0u;
        for (int32_t y = 0; y < dst->h; y++) {
            uint32_t *row = iris_image_row(dst, y);
            for (int32_t x = 0; x < dst->w; x += 32) {
                copy_bits(row, x, &word, 0, dst->w - x < 32 ? dst->w - x : 32);
            }
        }
        return IRIS_OK;
    }
    uint8_t pixel[6];
    size_t step = pixel_of(pixel, dst->format, value);
    size_t bytes = iris_format_row_bytes(dst->format, dst->w);
    uint8_t *first = iris_image_row(dst, 0);
    for (size_t i = 0; i < bytes; i += step) {
        memcpy(first + i, pixel, step);
    }
    for (int32_t y = 1; y < dst->h; y++) {
        memcpy(iris_image_row(dst, y), first, bytes);
    }
    return IRIS_OK;
}

/* Bytes of a pixel whose bytes are channels; 0 for other formats. */
static int32_t channels_of(iris_format format)
{
    switch (format) {
    case IRIS_RGB888:
    case IRIS_BGR888:
    case IRIS_HSL24:
        return 3;
    case IRIS_RGBA8888:
        return 4;
    default:
        return 0;
    }
}

static iris_status check_channel(const iris_image *color, const iris_image *gray, int32_t channel)
{
    iris_status status = check_both(color, gray);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t channels = channels_of(color->format);
    if (channels == 0 || gray->format != IRIS_GRAY8) {
        return IRIS_ERR_FORMAT;
    }
    if (channel < 0 || channel >= channels) {
        return IRIS_ERR_ARG;
    }
    if (color->w != gray->w || color->h != gray->h) {
        return IRIS_ERR_RANGE;
    }
    return iris_image_overlaps(color, gray) ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_channel_extract(const iris_image *dst, const iris_image *src, int32_t channel)
{
    iris_status status = check_channel(src, dst, channel);
    for (int32_t y = 0; status == IRIS_OK && y < dst->h; y++) {
        uint8_t *to = iris_image_row(dst, y);
        const uint8_t *from = (const uint8_t *)iris_image_row(src, y) + channel;
        int32_t step = channels_of(src->format);
        if (step == 3) {
            iris_row_every_third_u8(to, from, dst->w);
            continue;
        }
        for (int32_t x = 0; x < dst->w; x++) {
            to[x] = from[x * step];
        }
    }
    return status;
}

iris_status iris_channel_insert(const iris_image *dst, const iris_image *src, int32_t channel)
{
    iris_status status = check_channel(dst, src, channel);
    for (int32_t y = 0; status == IRIS_OK && y < dst->h; y++) {
        uint8_t *to = (uint8_t *)iris_image_row(dst, y) + channel;
        const uint8_t *from = iris_image_row(src, y);
        int32_t step = channels_of(dst->format);
        for (int32_t x = 0; x < dst->w; x++) {
            to[x * step] = from[x];
        }
    }
    return status;
}
