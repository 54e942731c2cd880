/* Run-length encoded BMP, a row at a time. Runs beyond the end of a row are cut; every row has a limit of
 * codes, so that codes without effect cannot go on forever. */
#include "bmp_reader.h"

#include <string.h>

enum { END_OF_LINE, END_OF_BITMAP, DELTA };

static iris_status expect(iris_bmp_reader *reader, uint8_t *buffer, size_t bytes)
{
    iris_status status = iris_stream_read(reader->stream, buffer, bytes);
    return status == IRIS_ERR_END ? IRIS_ERR_TRUNCATED : status;
}

static int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* Puts the n pixels packed in a piece at the current column, as far as the row goes. */
static void place(iris_bmp_reader *reader, iris_bmp_row_out out, const uint8_t *packed, int32_t n)
{
    int32_t visible = smaller(n, reader->w - reader->rle_x);
    iris_bmp_unpack(reader, out, reader->rle_x, packed, visible);
    reader->rle_x += visible;
}

/* n pixels that follow one by one, up to an even count of bytes. */
static iris_status literal_run(iris_bmp_reader *reader, iris_bmp_row_out out, int32_t n)
{
    uint8_t packed[IRIS_BMP_PIECE];
    int32_t most = iris_bmp_piece_pixels(reader);
    size_t total = 0;
    while (n > 0) {
        int32_t count = smaller(n, most);
        size_t bytes = ((size_t)count * (size_t)reader->bits + 7) / 8;
        iris_status status = expect(reader, packed, bytes);
        if (status != IRIS_OK) {
            return status;
        }
        place(reader, out, packed, count);
        total += bytes;
        n -= count;
    }
    return total % 2 == 0 ? IRIS_OK : expect(reader, packed, 1);
}

/* n times the same pixel, or with 4 bits the same pair of pixels. */
static iris_status repeat_run(iris_bmp_reader *reader, iris_bmp_row_out out, int32_t n, uint8_t first)
{
    uint8_t packed[IRIS_BMP_PIECE];
    int32_t most = iris_bmp_piece_pixels(reader);
    memset(packed, first, sizeof packed);
    if (reader->bits == 24) {
        iris_status status = expect(reader, packed + 1, 2);
        if (status != IRIS_OK) {
            return status;
        }
        for (size_t i = 3; i < sizeof packed; i++) {
            packed[i] = packed[i - 3];
        }
    }
    while (n > 0) {
        int32_t count = smaller(n, most);
        place(reader, out, packed, count);
        n -= count;
    }
    return IRIS_OK;
}

/* Palette entry 0, or black: what runs leave out. */
static void put_background(const iris_bmp_reader *reader, iris_bmp_row_out out)
{
    const uint8_t packed[IRIS_BMP_PIECE] = {0};
    int32_t most = iris_bmp_piece_pixels(reader);
    for (int32_t x = 0; x < reader->w; x += most) {
        iris_bmp_unpack(reader, out, x, packed, smaller(most, reader->w - x));
    }
}

/* An escape code; *row_done tells whether it ends the row. */
static iris_status escape(iris_bmp_reader *reader, iris_bmp_row_out out, uint8_t code, int *row_done)
{
    uint8_t step[2];
    iris_status status;
    switch (code) {
    case END_OF_LINE:
        reader->rle_x = 0;
        *row_done = 1;
        return IRIS_OK;
    case END_OF_BITMAP:
        reader->rle_ended = 1;
        *row_done = 1;
        return IRIS_OK;
    case DELTA:
        status = expect(reader, step, 2);
        if (status == IRIS_OK) {
            reader->rle_x = smaller(reader->w, reader->rle_x + step[0]);
            reader->rle_rows_skipped = step[1] > 0 ? step[1] - 1 : 0;
            *row_done = step[1] > 0;
        }
        return status;
    default:
        return literal_run(reader, out, code);
    }
}

iris_status iris_bmp_rle_row(iris_bmp_reader *reader, iris_bmp_row_out out)
{
    put_background(reader, out);
    if (reader->rle_ended) {
        return IRIS_OK;
    }
    if (reader->rle_rows_skipped > 0) {
        reader->rle_rows_skipped--;
        return IRIS_OK;
    }
    int last = reader->next == reader->h - 1;
    for (int32_t codes = 2 * reader->w + 64; codes > 0; codes--) {
        uint8_t code[2];
        int row_done = 0;
        iris_status status = expect(reader, code, 2);
        if (status == IRIS_OK && code[0] > 0) {
            status = repeat_run(reader, out, code[0], code[1]);
        } else if (status == IRIS_OK) {
            status = escape(reader, out, code[1], &row_done);
        }
        if (status != IRIS_OK || row_done || (last && reader->rle_x >= reader->w)) {
            return status;
        }
    }
    return IRIS_ERR_DATA;
}

iris_status iris_bmp_rle_finish(iris_bmp_reader *reader)
{
    for (int marks = 0; marks < 2 && !reader->rle_ended; marks++) {
        uint8_t code[2];
        iris_status status = iris_stream_peek(code, reader->stream);
        if (status != IRIS_OK) {
            return status == IRIS_ERR_IO ? status : IRIS_OK;
        }
        if (code[0] != 0 || code[1] > END_OF_BITMAP) {
            return IRIS_OK;
        }
        reader->rle_ended = code[1] == END_OF_BITMAP;
        status = expect(reader, code, 2);
        if (status != IRIS_OK) {
            return status;
        }
    }
    return IRIS_OK;
}
