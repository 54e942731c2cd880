/* IRIS - images: borrowed views of the caller's pixels.
 *
 * A view is a start, a stride, a size, and a format. Copying it copies no pixels. A region of interest is a view
 * (iris_image_crop), so no operation takes a rectangle, and every operation works on any region.
 * Pixel (0, 0) is the top left one; x grows to the right, y down. Report, sections 2.1 and 3.2.2 (Buffer).
 */
#ifndef IRIS_IMAGE_H
#define IRIS_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The longest side of an image, in pixels: coordinates fit an iris_q16. */
#define IRIS_SIDE_MAX 32767

typedef enum {
    IRIS_GRAY8 = 1, /* uint8_t, 0 black to 255 white */
    IRIS_GRAY_S16,  /* int16_t: gradients */
    IRIS_GRAY_U16,  /* uint16_t: direction, disparity, distance */
    IRIS_GRAY_U32,  /* uint32_t: integral images */
    IRIS_MASK1, /* one bit per pixel in uint32_t words, first pixel in the least significant bit, 1 = selected */
    IRIS_RGB888,      /* bytes R, G, B */
    IRIS_BGR888,      /* bytes B, G, R: 24-bit BMP in memory */
    IRIS_RGBA8888,    /* bytes R, G, B, A */
    IRIS_RGB565,      /* uint16_t, R in the high 5 bits; little-endian in memory */
    IRIS_RGB565_SWAP, /* the same, big-endian in memory, as most small camera modules send it */
    IRIS_YUYV,        /* bytes Y0 U Y1 V for two pixels; w is even */
    IRIS_UYVY,        /* bytes U Y0 V Y1 for two pixels; w is even */
    IRIS_UV88,        /* bytes U, V: the second plane of NV12 */
    IRIS_BAYER8_RGGB, /* one byte per pixel behind a color filter; the first two pixels of the first two rows */
    IRIS_BAYER8_GRBG,
    IRIS_BAYER8_GBRG,
    IRIS_BAYER8_BGGR,
    IRIS_HSL24, /* bytes H, S, L (compact): see color.h */
    IRIS_HSL48  /* uint16_t H, S, L (lossless): see color.h */
} iris_format;

typedef struct {
    int32_t w, h; /* pixels */
} iris_size;

typedef struct {
    int32_t x, y, w, h; /* pixels */
} iris_rect;

typedef struct {
    void *data;       /* first byte of row 0 */
    ptrdiff_t stride; /* BYTES from one row to the next; negative for bottom-up images */
    int32_t w, h;     /* pixels, 1 to IRIS_SIDE_MAX */
    iris_format format;
} iris_image;

/* Bytes that one row of w pixels occupies, without padding: 4 * ceil(w / 32) for IRIS_MASK1.
 * 0 for an unknown format, for w outside 1..IRIS_SIDE_MAX, or for an odd w of IRIS_YUYV and IRIS_UYVY. O(1). */
size_t iris_format_row_bytes(iris_format format, int32_t w);

/* Makes *image a view of `bytes` bytes at `buffer`.
 *   stride  0 for rows that follow each other without padding (IRIS_MASK1: whole words); else bytes from one row to
 *           the next, at least the bytes of a row. Negative: the buffer starts with the LAST row (bottom-up), and
 *           row 0 is found at its end.
 * The last row needs no padding behind it. data and stride must be multiples of 2 for the 16-bit formats and of 4 for
 * IRIS_GRAY_U32 and IRIS_MASK1.
 * IRIS_ERR_ARG: null pointer or unknown format; IRIS_ERR_RANGE: a side outside 1..IRIS_SIDE_MAX, odd w of a YUV 4:2:2
 * format, |stride| below a row, more bytes needed than given, or more given than PTRDIFF_MAX; IRIS_ERR_ALIGN. O(1). */
iris_status iris_image_wrap(iris_image *image, void *buffer, size_t bytes, iris_size size, ptrdiff_t stride,
                            iris_format format);

/* Makes *view the part `rect` of `image`. The pixels are shared. view may be image.
 * A Bayer crop at odd x or y has another of the four formats.
 * IRIS_ERR_ARG: null pointer or invalid image; IRIS_ERR_RANGE: rect empty or not wholly inside, or an odd width of a
 * YUV 4:2:2 format; IRIS_ERR_ALIGN: x is not a multiple of 32 (IRIS_MASK1) or of 2 (YUV 4:2:2). O(1). */
iris_status iris_image_crop(iris_image *view, const iris_image *image, iris_rect rect);

/* Is this a view that operations may work on? For views that did not come from iris_image_wrap.
 * Same errors as iris_image_wrap; the buffer's size cannot be checked. O(1). */
iris_status iris_image_check(const iris_image *image);

/* 1 when a and b share at least one byte, 0 when they do not. Exact for views of one image (same
 * stride up to sign, so two crops side by side do not overlap); views with different strides count as overlapping
 * when their address ranges meet. O(1). */
int iris_image_overlaps(const iris_image *a, const iris_image *b);

/* Address of row y. y must be in 0..h-1. */
static inline void *iris_image_row(const iris_image *image, int32_t y)
{
    return (uint8_t *)image->data + (ptrdiff_t)y * image->stride;
}

#ifdef __cplusplus
}
#endif

#endif
