#include "iris/pnm.h"
#include "kernel.h"

#include <string.h>

#define PIECE        240
#define HEADER_BYTES 21 /* of the longest: P5\n32767 32767\n65535\n */

/* Writes a number in decimals behind `text` and returns the place behind it. */
static char *put_number(char *text, int32_t number)
{
    int32_t unit = 10000;
    while (unit > number) {
        unit /= 10;
    }
    for (; unit > 0; unit /= 10) {
        *text++ = (char)('0' + number / unit % 10);
    }
    return text;
}

static iris_status write_header(const iris_pnm_writer *writer)
{
    char header[HEADER_BYTES];
    char *end = header;
    *end++ = 'P';
    *end++ = writer->format == IRIS_RGB888 || writer->format == IRIS_BGR888 ? '6' : '5';
    *end++ = '\n';
    end = put_number(end, writer->w);
    *end++ = ' ';
    end = put_number(end, writer->h);
    *end++ = '\n';
    end = put_number(end, writer->format == IRIS_GRAY_U16 ? UINT16_MAX : UINT8_MAX);
    *end++ = '\n';
    return iris_sink_write(&writer->sink, header, (size_t)(end - header));
}

iris_status iris_pnm_write_begin(iris_pnm_writer *writer, iris_sink sink, iris_size size, iris_format format)
{
    if (!writer || !sink.write) {
        return IRIS_ERR_ARG;
    }
    if (format != IRIS_MASK1 && format != IRIS_GRAY8 && format != IRIS_GRAY_U16 && format != IRIS_RGB888 &&
        format != IRIS_BGR888) {
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
    writer->status = write_header(writer);
    return writer->status;
}

static iris_status write_mask(const iris_pnm_writer *writer, const uint32_t *row)
{
    uint8_t piece[PIECE];
    iris_status status = IRIS_OK;
    for (int32_t start = 0; start < writer->w && status == IRIS_OK; start += PIECE) {
        int32_t n = writer->w - start < PIECE ? writer->w - start : PIECE;
        for (int32_t i = 0; i < n; i++) {
            int32_t x = start + i;
            piece[i] = (row[x / 32] >> (x % 32) & 1) != 0 ? 255 : 0;
        }
        status = iris_sink_write(&writer->sink, piece, (size_t)n);
    }
    return status;
}

static iris_status write_bgr(const iris_pnm_writer *writer, const uint8_t *row)
{
    uint8_t piece[PIECE];
    iris_status status = IRIS_OK;
    for (int32_t x = 0; x < writer->w && status == IRIS_OK; x += PIECE / 3) {
        int32_t n = writer->w - x < PIECE / 3 ? writer->w - x : PIECE / 3;
        iris_row_swap_888(piece, row + 3 * (size_t)x, n);
        status = iris_sink_write(&writer->sink, piece, 3 * (size_t)n);
    }
    return status;
}

/* The high byte of each sample goes first. */
static iris_status write_u16(const iris_pnm_writer *writer, const uint16_t *row)
{
    uint8_t piece[PIECE];
    iris_status status = IRIS_OK;
    for (int32_t x = 0; x < writer->w && status == IRIS_OK; x += PIECE / 2) {
        int32_t n = writer->w - x < PIECE / 2 ? writer->w - x : PIECE / 2;
        for (int32_t i = 0; i < n; i++) {
            piece[2 * i] = (uint8_t)(row[x + i] >> 8);
            piece[2 * i + 1] = (uint8_t)row[x + i];
        }
        status = iris_sink_write(&writer->sink, piece, 2 * (size_t)n);
    }
    return status;
}

iris_status iris_pnm_write_row(iris_pnm_writer *writer, const void *row)
{
    if (!writer || !row) {
        return IRIS_ERR_ARG;
    }
    if (writer->status != IRIS_OK) {
        return writer->status;
    }
    if (writer->next == writer->h) {
        return IRIS_ERR_RANGE;
    }
    uintptr_t unit = writer->format == IRIS_MASK1 ? 4 : writer->format == IRIS_GRAY_U16 ? 2 : 1;
    if ((uintptr_t)row % unit != 0) {
        return IRIS_ERR_ALIGN;
    }
    if (writer->format == IRIS_MASK1) {
        writer->status = write_mask(writer, (const uint32_t *)row);
    } else if (writer->format == IRIS_GRAY_U16) {
        writer->status = write_u16(writer, (const uint16_t *)row);
    } else if (writer->format == IRIS_BGR888) {
        writer->status = write_bgr(writer, (const uint8_t *)row);
    } else {
        writer->status =
            iris_sink_write(&writer->sink, row, iris_format_row_bytes(writer->format, writer->w));
    }
    writer->next += writer->status == IRIS_OK;
    return writer->status;
}

iris_status iris_pnm_write_end(const iris_pnm_writer *writer)
{
    if (!writer) {
        return IRIS_ERR_ARG;
    }
    if (writer->status != IRIS_OK) {
        return writer->status;
    }
    return writer->next == writer->h ? IRIS_OK : IRIS_ERR_TRUNCATED;
}

iris_status iris_pnm_write(iris_sink sink, const iris_image *image)
{
    iris_pnm_writer writer;
    iris_status status = iris_image_check(image);
    if (status != IRIS_OK) {
        return status;
    }
    iris_size size = {image->w, image->h};
    status = iris_pnm_write_begin(&writer, sink, size, image->format);
    for (int32_t y = 0; y < image->h && status == IRIS_OK; y++) {
        status = iris_pnm_write_row(&writer, iris_image_row(image, y));
    }
    return status;
}
