/* Writes BMP with 1, 8, or 24 bits per pixel and the header that every program reads. */
#include "iris/bmp.h"
#include "kernel.h"

#include <string.h>

#define HEADER_BYTES 54
#define PIECE        240

static int32_t bits_of(iris_format format)
{
    return format == IRIS_MASK1 ? 1 : format == IRIS_GRAY8 ? 8 : 24;
}

static size_t pixel_row_bytes(const iris_bmp_writer *writer)
{
    return ((size_t)writer->w * (size_t)bits_of(writer->format) + 7) / 8;
}

static size_t padding_bytes(const iris_bmp_writer *writer)
{
    return (4 - pixel_row_bytes(writer) % 4) % 4;
}

static void put_u32(uint8_t *bytes, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (uint8_t)(value >> (8 * i));
    }
}

/* Black to white in `count` steps. */
static iris_status write_palette(const iris_sink *sink, uint32_t count)
{
    iris_status status = IRIS_OK;
    for (uint32_t i = 0; i < count && status == IRIS_OK; i++) {
        uint8_t level = (uint8_t)(i * 255 / (count - 1));
        const uint8_t color[4] = {level, level, level, 0};
        status = iris_sink_write(sink, color, sizeof color);
    }
    return status;
}

static iris_status write_header(const iris_bmp_writer *writer, int32_t top_down)
{
    int32_t bits = bits_of(writer->format);
    uint32_t colors = bits == 24 ? 0 : 1u << bits;
    uint32_t offset = HEADER_BYTES + 4 * colors;
    uint32_t pixels = (uint32_t)(pixel_row_bytes(writer) + padding_bytes(writer)) * (uint32_t)writer->h;
    uint8_t header[HEADER_BYTES] = {'B', 'M'};
    put_u32(header + 2, offset + pixels);
    put_u32(header + 10, offset);
    put_u32(header + 14, 40);
    put_u32(header + 18, (uint32_t)writer->w);
    put_u32(header + 22, top_down ? 0u - (uint32_t)writer->h : (uint32_t)writer->h);
    put_u32(header + 26, 1u | (uint32_t)bits << 16); /* one plane */
    put_u32(header + 34, pixels);
    put_u32(header + 38, 2835); /* 72 dots per inch, in pixels per meter */
    put_u32(header + 42, 2835);
    put_u32(header + 46, colors);
    iris_status status = iris_sink_write(&writer->sink, header, sizeof header);
    return status == IRIS_OK ? write_palette(&writer->sink, colors) : status;
}

iris_status iris_bmp_write_begin(iris_bmp_writer *writer, iris_sink sink, iris_size size, iris_format format,
                                 int32_t top_down)
{
    if (!writer || !sink.write) {
        return IRIS_ERR_ARG;
    }
    if (format != IRIS_MASK1 && format != IRIS_GRAY8 && format != IRIS_RGB888 && format != IRIS_BGR888) {
        return IRIS_ERR_FORMAT;
    }
    if (iris_format_row_bytes(format, size.w) == 0 || size.h < 1 || size.h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    writer->sink = sink;
    writer->w = size.w;
    writer->h = size.h;
    writer->format = format;
    writer->next = 0;
    writer->status = write_header(writer, top_down);
    return writer->status;
}

/* The first pixel goes into the highest bit; bits past w become 0. */
static iris_status write_mask(const iris_bmp_writer *writer, const uint32_t *row)
{
    uint8_t piece[PIECE];
    int32_t bytes = (writer->w + 7) / 8;
    for (int32_t at = 0; at < bytes; at += PIECE) {
        int32_t count = bytes - at < PIECE ? bytes - at : PIECE;
        memset(piece, 0, sizeof piece);
        for (int32_t x = 8 * at; x < 8 * (at + count) && x < writer->w; x++) {
            piece[x / 8 - at] |= (uint8_t)((row[x / 32] >> (x % 32) & 1) << (7 - x % 8));
        }
        iris_status status = iris_sink_write(&writer->sink, piece, (size_t)count);
        if (status != IRIS_OK) {
            return status;
        }
    }
    return IRIS_OK;
}

static iris_status write_rgb(const iris_bmp_writer *writer, const uint8_t *row)
{
    uint8_t piece[PIECE];
    for (int32_t x = 0; x < writer->w; x += PIECE / 3) {
        int32_t count = writer->w - x < PIECE / 3 ? writer->w - x : PIECE / 3;
        iris_row_swap_888(piece, row + 3 * (size_t)x, count);
        iris_status status = iris_sink_write(&writer->sink, piece, 3 * (size_t)count);
        if (status != IRIS_OK) {
            return status;
        }
    }
    return IRIS_OK;
}

iris_status iris_bmp_write_row(iris_bmp_writer *writer, const void *row)
{
    const uint8_t zeros[4] = {0};
    if (!writer || !row) {
        return IRIS_ERR_ARG;
    }
    if (writer->status != IRIS_OK) {
        return writer->status;
    }
    if (writer->next == writer->h) {
        return IRIS_ERR_RANGE;
    }
    if (writer->format == IRIS_MASK1 && (uintptr_t)row % 4 != 0) {
        return IRIS_ERR_ALIGN;
    }
    iris_status status;
    if (writer->format == IRIS_MASK1) {
        status = write_mask(writer, (const uint32_t *)row);
    } else if (writer->format == IRIS_RGB888) {
        status = write_rgb(writer, (const uint8_t *)row);
    } else {
        status = iris_sink_write(&writer->sink, row, pixel_row_bytes(writer));
    }
    if (status == IRIS_OK) {
        status = iris_sink_write(&writer->sink, zeros, padding_bytes(writer));
    }
    writer->next += status == IRIS_OK;
    writer->status = status;
    return status;
}

iris_status iris_bmp_write_end(const iris_bmp_writer *writer)
{
    if (!writer) {
        return IRIS_ERR_ARG;
    }
    if (writer->status != IRIS_OK) {
        return writer->status;
    }
    return writer->next == writer->h ? IRIS_OK : IRIS_ERR_TRUNCATED;
}

iris_status iris_bmp_write(iris_sink sink, const iris_image *image)
{
    iris_bmp_writer writer;
    iris_status status = iris_image_check(image);
    if (status != IRIS_OK) {
        return status;
    }
    iris_size size = {image->w, image->h};
    status = iris_bmp_write_begin(&writer, sink, size, image->format, 0);
    for (int32_t y = image->h - 1; y >= 0 && status == IRIS_OK; y--) {
        status = iris_bmp_write_row(&writer, iris_image_row(image, y));
    }
    return status;
}
