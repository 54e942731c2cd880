#include "iris/image.h"

/* Bytes that a pixel occupies; 0 for unknown formats and for IRIS_MASK1, whose pixels are bits. */
static size_t pixel_bytes(iris_format format)
{
    switch (format) {
    case IRIS_GRAY8:
    case IRIS_BAYER8_RGGB:
    case IRIS_BAYER8_GRBG:
    case IRIS_BAYER8_GBRG:
    case IRIS_BAYER8_BGGR:
        return 1;
    case IRIS_GRAY_S16:
    case IRIS_GRAY_U16:
    case IRIS_RGB565:
    case IRIS_RGB565_SWAP:
    case IRIS_YUYV:
    case IRIS_UYVY:
    case IRIS_UV88:
        return 2;
    case IRIS_RGB888:
    case IRIS_BGR888:
    case IRIS_HSL24:
        return 3;
    case IRIS_GRAY_U32:
    case IRIS_RGBA8888:
        return 4;
    case IRIS_HSL48:
        return 6;
    case IRIS_MASK1:
        break;
    }
    return 0;
}

/* What the address and the stride must be multiples of. */
static size_t alignment(iris_format format)
{
    switch (format) {
    case IRIS_GRAY_U32:
    case IRIS_MASK1:
        return 4;
    case IRIS_GRAY_S16:
    case IRIS_GRAY_U16:
    case IRIS_RGB565:
    case IRIS_RGB565_SWAP:
    case IRIS_HSL48:
        return 2;
    default:
        return 1;
    }
}

static int in_pairs(iris_format format)
{
    return format == IRIS_YUYV || format == IRIS_UYVY;
}

static size_t magnitude(ptrdiff_t stride)
{
    return stride < 0 ? (size_t)0 - (size_t)stride : (size_t)stride;
}

size_t iris_format_row_bytes(iris_format format, int32_t w)
{
    if (w < 1 || w > IRIS_SIDE_MAX || (in_pairs(format) && w % 2 != 0)) {
        return 0;
    }
    if (format == IRIS_MASK1) {
        return ((size_t)w + 31) / 32 * 4;
    }
    return pixel_bytes(format) * (size_t)w;
}

iris_status iris_image_wrap(iris_image *image, void *buffer, size_t bytes, iris_size size, ptrdiff_t stride,
                            iris_format format)
{
    if (!image || !buffer || (format != IRIS_MASK1 && pixel_bytes(format) == 0)) {
        return IRIS_ERR_ARG;
    }
    size_t row = iris_format_row_bytes(format, size.w);
    if (row == 0 || size.h < 1 || size.h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    size_t step = stride == 0 ? row : magnitude(stride);
    size_t rows_before = (size_t)size.h - 1;
    if (step < row || bytes < row || bytes > PTRDIFF_MAX ||
        (rows_before > 0 && step > (bytes - row) / rows_before)) {
        return IRIS_ERR_RANGE;
    }
    if ((uintptr_t)buffer % alignment(format) != 0 || step % alignment(format) != 0) {
        return IRIS_ERR_ALIGN;
    }
    image->data = stride < 0 ? (uint8_t *)buffer + rows_before * step : (uint8_t *)buffer;
    image->stride = stride == 0 ? (ptrdiff_t)row : stride;
    image->w = size.w;
    image->h = size.h;
    image->format = format;
    return IRIS_OK;
}

iris_status iris_image_check(const iris_image *image)
{
    if (!image || !image->data || (image->format != IRIS_MASK1 && pixel_bytes(image->format) == 0)) {
        return IRIS_ERR_ARG;
    }
    size_t row = iris_format_row_bytes(image->format, image->w);
    if (row == 0 || image->h < 1 || image->h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    size_t step = magnitude(image->stride);
    if (image->h > 1 && (step < row || step > (size_t)PTRDIFF_MAX / (size_t)image->h)) {
        return IRIS_ERR_RANGE;
    }
    if ((uintptr_t)image->data % alignment(image->format) != 0 || step % alignment(image->format) != 0) {
        return IRIS_ERR_ALIGN;
    }
    return IRIS_OK;
}

/* The format of a Bayer crop: an odd x swaps the columns of the pattern, an odd y its rows. */
static iris_format bayer_shifted(iris_format format, iris_rect rect)
{
    if (format < IRIS_BAYER8_RGGB || format > IRIS_BAYER8_BGGR) {
        return format;
    }
    int order = (int)format - IRIS_BAYER8_RGGB;
    order ^= (rect.x & 1) | (rect.y & 1) << 1;
    return (iris_format)(IRIS_BAYER8_RGGB + order);
}

iris_status iris_image_crop(iris_image *view, const iris_image *image, iris_rect rect)
{
    if (!view || iris_image_check(image) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (rect.x < 0 || rect.y < 0 || rect.w < 1 || rect.h < 1 || rect.x > image->w - rect.w ||
        rect.y > image->h - rect.h || (in_pairs(image->format) && rect.w % 2 != 0)) {
        return IRIS_ERR_RANGE;
    }
    if ((image->format == IRIS_MASK1 && rect.x % 32 != 0) || (in_pairs(image->format) && rect.x % 2 != 0)) {
        return IRIS_ERR_ALIGN;
    }
    size_t before =
        image->format == IRIS_MASK1 ? (size_t)rect.x / 8 : (size_t)rect.x * pixel_bytes(image->format);
    iris_image result = *image;
    result.data = (uint8_t *)iris_image_row(image, rect.y) + before;
    result.w = rect.w;
    result.h = rect.h;
    result.format = bayer_shifted(image->format, rect);
    *view = result;
    return IRIS_OK;
}

int iris_image_overlaps(const iris_image *a, const iris_image *b)
{
    size_t row_a = iris_format_row_bytes(a->format, a->w);
    size_t row_b = iris_format_row_bytes(b->format, b->w);
    size_t step_a = magnitude(a->stride);
    size_t step_b = magnitude(b->stride);
    uintptr_t low_a = (uintptr_t)a->data - (a->stride < 0 ? ((size_t)a->h - 1) * step_a : 0);
    uintptr_t low_b = (uintptr_t)b->data - (b->stride < 0 ? ((size_t)b->h - 1) * step_b : 0);
    uintptr_t end_a = low_a + ((size_t)a->h - 1) * step_a + row_a;
    uintptr_t end_b = low_b + ((size_t)b->h - 1) * step_b + row_b;
    if (end_a <= low_b || end_b <= low_a) {
        return 0;
    }
    if (step_a != step_b || step_a == 0) {
        return 1;
    }
    /* Same stride: compare the columns of bytes, b's start counted from a's within one stride. */
    size_t start = low_b >= low_a ? (low_b - low_a) % step_a : (step_a - (low_a - low_b) % step_a) % step_a;
    return start < row_a || start + row_b > step_a;
}
