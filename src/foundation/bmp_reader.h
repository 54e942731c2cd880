/* What the parts of the BMP reader share: bmp_header.c, bmp_pixels.c, bmp_rle.c, bmp_read.c. */
#ifndef IRIS_BMP_READER_H
#define IRIS_BMP_READER_H

#include "iris/bmp.h"

/* Bytes taken from the stream at a time: whole pixels of every depth. */
#define IRIS_BMP_PIECE 240

/* Where a row goes. Null pixels: nowhere. */
typedef struct {
    uint8_t *pixels;
    iris_format format;
} iris_bmp_row_out;

/* Bytes so far from the start of the file. */
static inline uint64_t iris_bmp_position(const iris_bmp_reader *reader)
{
    return reader->stream->position - reader->start;
}

/* Pixels of this file's depth in a piece, in which they take at most IRIS_BMP_PIECE bytes packed and
 * unpacked. */
int32_t iris_bmp_piece_pixels(const iris_bmp_reader *reader);

/* Writes n pixels, packed at `packed` as in the file, to columns x to x + n - 1 of the row. */
void iris_bmp_unpack(const iris_bmp_reader *reader, iris_bmp_row_out out, int32_t x, const uint8_t *packed,
                     int32_t n);

/* Decodes the next row of a run-length encoded picture. */
iris_status iris_bmp_rle_row(iris_bmp_reader *reader, iris_bmp_row_out out);

/* Passes over the end of line and end of bitmap marks behind the last row. */
iris_status iris_bmp_rle_finish(iris_bmp_reader *reader);

#endif
