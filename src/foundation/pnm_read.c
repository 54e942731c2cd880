#include "iris/pnm.h"
#include "kernel.h"
#include "picture_read.h"

#include <string.h>

#define PIECE 240 /* bytes at a time, whole pixels of both kinds */

static iris_status next_byte(iris_pnm_reader *reader, uint8_t *byte)
{
    iris_status status = iris_stream_read(reader->stream, byte, 1);
    return status == IRIS_ERR_END ? IRIS_ERR_TRUNCATED : status;
}

static int is_space(uint8_t byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

/* Reads one number of the header and the one byte behind it. White space and comments, from # to the end of
 * the line, may come before it. *left counts down the bytes that the header may still have. Numbers stop
 * growing at a million. */
static iris_status read_number(iris_pnm_reader *reader, int32_t *number, int32_t *left)
{
    int in_comment = 0;
    int digits = 0;
    *number = 0;
    while ((*left)-- > 0) {
        uint8_t byte;
        iris_status status = next_byte(reader, &byte);
        if (status != IRIS_OK) {
            return status;
        }
        if (in_comment) {
            in_comment = byte != '\n' && byte != '\r';
        } else if (byte >= '0' && byte <= '9') {
            digits++;
            *number = *number < 1000000 ? 10 * *number + (byte - '0') : *number;
        } else if (digits > 0) {
            return is_space(byte) ? IRIS_OK : IRIS_ERR_DATA;
        } else if (byte == '#') {
            in_comment = 1;
        } else if (!is_space(byte)) {
            return IRIS_ERR_DATA;
        }
    }
    return IRIS_ERR_DATA;
}

static iris_status parse(iris_pnm_reader *reader)
{
    uint8_t magic[2];
    int32_t maximum;
    int32_t left = IRIS_PNM_HEADER_MAX - 2;
    iris_status status = iris_stream_read(reader->stream, magic, 2);
    if (status != IRIS_OK) {
        return status;
    }
    if (magic[0] != 'P' || magic[1] < '1' || magic[1] > '7') {
        return IRIS_ERR_DATA;
    }
    if (magic[1] != '5' && magic[1] != '6') {
        return IRIS_ERR_UNSUPPORTED;
    }
    reader->is_gray = magic[1] == '5';
    status = read_number(reader, &reader->w, &left);
    if (status == IRIS_OK) {
        status = read_number(reader, &reader->h, &left);
    }
    if (status == IRIS_OK) {
        status = read_number(reader, &maximum, &left);
    }
    if (status != IRIS_OK) {
        return status;
    }
    if (reader->w == 0 || reader->h == 0 || maximum == 0 || maximum > 65535) {
        return IRIS_ERR_DATA;
    }
    if (reader->w > IRIS_SIDE_MAX || reader->h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    return maximum == 255 ? IRIS_OK : IRIS_ERR_UNSUPPORTED;
}

iris_status iris_pnm_begin(iris_pnm_reader *reader, iris_stream *stream)
{
    if (!reader || !stream) {
        return IRIS_ERR_ARG;
    }
    memset(reader, 0, sizeof *reader);
    reader->stream = stream;
    reader->status = parse(reader);
    return reader->status;
}

/* n gray pixels to gray or color. */
static void put_gray(uint8_t *dst, iris_format format, const uint8_t *gray, int32_t n)
{
    if (format == IRIS_GRAY8) {
        memcpy(dst, gray, (size_t)n);
        return;
    }
    for (int32_t i = 0; i < n; i++) {
        memset(dst + 3 * (size_t)i, gray[i], 3);
    }
}

/* n RGB pixels to gray or color. */
static void put_rgb(uint8_t *dst, iris_format format, const uint8_t *rgb, int32_t n)
{
    if (format == IRIS_GRAY8) {
        iris_row_luma_rgb888(dst, rgb, n);
    } else if (format == IRIS_BGR888) {
        iris_row_swap_888(dst, rgb, n);
    } else {
        memcpy(dst, rgb, 3 * (size_t)n);
    }
}

static iris_status next_row(uint8_t *row, iris_pnm_reader *reader, iris_format format)
{
    uint8_t piece[PIECE];
    size_t in = reader->is_gray ? 1 : 3;
    size_t out = format == IRIS_GRAY8 ? 1 : 3;
    int32_t most = (int32_t)(PIECE / in);
    for (int32_t x = 0; x < reader->w; x += most) {
        int32_t n = reader->w - x < most ? reader->w - x : most;
        iris_status status = iris_stream_read(reader->stream, piece, (size_t)n * in);
        if (status != IRIS_OK) {
            return status == IRIS_ERR_END ? IRIS_ERR_TRUNCATED : status;
        }
        if (reader->is_gray) {
            put_gray(row + (size_t)x * out, format, piece, n);
        } else {
            put_rgb(row + (size_t)x * out, format, piece, n);
        }
    }
    return IRIS_OK;
}

iris_status iris_pnm_row(void *row, int32_t *y, iris_pnm_reader *reader, iris_format format)
{
    if (!row || !reader || !reader->stream) {
        return IRIS_ERR_ARG;
    }
    if (!iris_picture_gives(format)) {
        return IRIS_ERR_FORMAT;
    }
    if (reader->status != IRIS_OK) {
        return reader->status;
    }
    if (reader->next == reader->h) {
        return IRIS_ERR_END;
    }
    reader->status = next_row((uint8_t *)row, reader, format);
    if (reader->status == IRIS_OK) {
        if (y) {
            *y = reader->next;
        }
        reader->next++;
    }
    return reader->status;
}

iris_status iris_pnm_finish(iris_pnm_reader *reader)
{
    if (!reader || !reader->stream) {
        return IRIS_ERR_ARG;
    }
    if (reader->status == IRIS_OK) {
        uint64_t row = (uint64_t)reader->w * (reader->is_gray ? 1 : 3);
        iris_status status = iris_stream_skip(reader->stream, row * (uint64_t)(reader->h - reader->next));
        reader->status = status == IRIS_ERR_END ? IRIS_ERR_TRUNCATED : status;
        reader->next = status == IRIS_OK ? reader->h : reader->next;
    }
    return reader->status;
}

iris_status iris_pnm_read(const iris_image *image, iris_pnm_reader *reader)
{
    if (!reader || !reader->stream) {
        return IRIS_ERR_ARG;
    }
    if (reader->status != IRIS_OK) {
        return reader->status;
    }
    iris_status status = iris_picture_fits(image, reader->w, reader->h);
    while (status == IRIS_OK && reader->next < reader->h) {
        status = iris_pnm_row(iris_image_row(image, reader->next), 0, reader, image->format);
    }
    return status;
}
