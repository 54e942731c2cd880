/* The rows of a BMP, and its end. */
#include "bmp_reader.h"
#include "kernel.h"
#include "picture_read.h"

static size_t pixel_row_bytes(const iris_bmp_reader *reader)
{
    return ((size_t)reader->w * (size_t)reader->bits + 7) / 8;
}

/* Rows are padded to a multiple of 4 bytes. */
static size_t file_row_bytes(const iris_bmp_reader *reader)
{
    return (pixel_row_bytes(reader) + 3) / 4 * 4;
}

/* Pixels that are in the file as they are wanted but for their order. */
static iris_status read_in_place(const iris_bmp_reader *reader, iris_bmp_row_out out)
{
    iris_status status = iris_stream_read(reader->stream, out.pixels, pixel_row_bytes(reader));
    if (status == IRIS_OK && out.format == IRIS_RGB888) {
        iris_row_swap_888(out.pixels, out.pixels, reader->w);
    }
    return status;
}

static iris_status read_in_pieces(const iris_bmp_reader *reader, iris_bmp_row_out out)
{
    uint8_t packed[IRIS_BMP_PIECE];
    int32_t most = iris_bmp_piece_pixels(reader);
    iris_status status = IRIS_OK;
    for (int32_t x = 0; x < reader->w && status == IRIS_OK; x += most) {
        int32_t n = reader->w - x < most ? reader->w - x : most;
        status = iris_stream_read(reader->stream, packed, ((size_t)n * (size_t)reader->bits + 7) / 8);
        if (status == IRIS_OK) {
            iris_bmp_unpack(reader, out, x, packed, n);
        }
    }
    return status;
}

/* The padding behind the last row may be missing. */
static iris_status plain_row(iris_bmp_reader *reader, iris_bmp_row_out out)
{
    int in_place = reader->bits == 24 && out.pixels && out.format != IRIS_GRAY8;
    iris_status status = in_place ? read_in_place(reader, out) : read_in_pieces(reader, out);
    if (status == IRIS_OK && reader->next < reader->h - 1) {
        status = iris_stream_skip(reader->stream, file_row_bytes(reader) - pixel_row_bytes(reader));
    }
    return status == IRIS_ERR_END ? IRIS_ERR_TRUNCATED : status;
}

static iris_status next_row(iris_bmp_reader *reader, iris_bmp_row_out out)
{
    if (reader->status != IRIS_OK) {
        return reader->status;
    }
    if (reader->next == reader->h) {
        return IRIS_ERR_END;
    }
    reader->status = reader->kind == IRIS_BMP_RLE ? iris_bmp_rle_row(reader, out) : plain_row(reader, out);
    if (reader->status == IRIS_OK) {
        reader->next++;
    }
    return reader->status;
}

iris_status iris_bmp_row(void *row, int32_t *y, iris_bmp_reader *reader, iris_format format)
{
    if (!row || !reader || !reader->stream) {
        return IRIS_ERR_ARG;
    }
    if (!iris_picture_gives(format)) {
        return IRIS_ERR_FORMAT;
    }
    iris_bmp_row_out out = {(uint8_t *)row, format};
    iris_status status = next_row(reader, out);
    if (status == IRIS_OK && y) {
        *y = reader->top_down ? reader->next - 1 : reader->h - reader->next;
    }
    return status;
}

/* Where the file ends, as far as it can be believed: `known` bytes at least, or a declared end not far
 * behind. */
static uint64_t believed_end(uint64_t known, uint64_t declared)
{
    return declared > known && declared - known <= IRIS_BMP_GAP_MAX ? declared : known;
}

/* Passes over the rows not delivered. */
static iris_status pass_rows(iris_bmp_reader *reader)
{
    const iris_bmp_row_out nowhere = {0, IRIS_GRAY8};
    if (reader->kind != IRIS_BMP_RLE) {
        uint64_t missing = (uint64_t)file_row_bytes(reader) * (uint64_t)(reader->h - reader->next);
        uint64_t padding = file_row_bytes(reader) - pixel_row_bytes(reader);
        iris_status status =
            reader->next < reader->h ? iris_stream_skip(reader->stream, missing - padding) : IRIS_OK;
        reader->next = status == IRIS_OK ? reader->h : reader->next;
        return status == IRIS_ERR_END ? IRIS_ERR_TRUNCATED : status;
    }
    iris_status status = IRIS_OK;
    while (status == IRIS_OK && reader->next < reader->h) {
        status = next_row(reader, nowhere);
    }
    return status;
}

iris_status iris_bmp_finish(iris_bmp_reader *reader)
{
    if (!reader || !reader->stream) {
        return IRIS_ERR_ARG;
    }
    if (reader->status != IRIS_OK) {
        return reader->status;
    }
    iris_status status = pass_rows(reader);
    uint64_t end = iris_bmp_position(reader);
    if (reader->kind == IRIS_BMP_RLE) {
        end = believed_end(end, reader->pixels + reader->pixel_bytes);
    } else {
        end = reader->pixels + (uint64_t)file_row_bytes(reader) * (uint64_t)reader->h;
    }
    end = believed_end(end, reader->file_bytes);
    if (status == IRIS_OK && reader->kind == IRIS_BMP_RLE && end == iris_bmp_position(reader)) {
        status = iris_bmp_rle_finish(reader);
    } else if (status == IRIS_OK) {
        status = iris_stream_skip(reader->stream, end - iris_bmp_position(reader));
        status = status == IRIS_ERR_IO ? status : IRIS_OK;
    }
    reader->status = status == IRIS_OK ? IRIS_ERR_END : status;
    return status;
}

iris_status iris_bmp_read(const iris_image *image, iris_bmp_reader *reader)
{
    if (!reader || !reader->stream) {
        return IRIS_ERR_ARG;
    }
    if (reader->status != IRIS_OK) {
        return reader->status;
    }
    iris_status status = iris_picture_fits(image, reader->w, reader->h);
    while (status == IRIS_OK && reader->next < reader->h) {
        int32_t y = reader->top_down ? reader->next : reader->h - 1 - reader->next;
        status = iris_bmp_row(iris_image_row(image, y), &y, reader, image->format);
    }
    return status == IRIS_OK ? iris_bmp_finish(reader) : status;
}
