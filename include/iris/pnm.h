/* IRIS - PGM (P5) and PPM (P6) pictures, read and written row by row, top row first.
 *
 * 8 bits per channel, maximum value 255. Reading needs no memory but the reader and the row that the caller gives:
 * iris_pnm_begin for the header, then iris_pnm_read for a whole image, or iris_pnm_row h times. Pictures may follow
 * each other in the stream without anything between them.
 */
#ifndef IRIS_PNM_H
#define IRIS_PNM_H

#include "iris/image.h"
#include "iris/status.h"
#include "iris/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The longest header that is read, in bytes, comments included. */
#define IRIS_PNM_HEADER_MAX 65536

typedef struct {
    int32_t w, h;    /* pixels, 1 to IRIS_SIDE_MAX */
    int32_t is_gray; /* 1: PGM; 0: PPM */
    int32_t next;    /* rows delivered so far */

    /* From here on private. */
    iris_stream *stream;
    iris_status status; /* the failure that ended reading */
} iris_pnm_reader;

/* Reads the header. The stream must outlive the reader. The caller checks that w * h pixels fit its memory.
 * IRIS_ERR_END: the input ended before the first byte; IRIS_ERR_TRUNCATED: within the header; IRIS_ERR_IO;
 * IRIS_ERR_DATA: not a PNM, a side or maximum value of 0, or a header above IRIS_PNM_HEADER_MAX; IRIS_ERR_RANGE: a side
 * above IRIS_SIDE_MAX; IRIS_ERR_UNSUPPORTED: text or bitmap kinds (P1 to P4, P7), or another maximum value than 255;
 * IRIS_ERR_ARG: null pointer. O(bytes of the header). */
iris_status iris_pnm_begin(iris_pnm_reader *reader, iris_stream *stream);

/* Delivers the next row: w pixels of `format` (IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888) at `row`, and its place from
 * the top in *y (which may be null). Gray of a color picture is luma.
 * IRIS_ERR_END: all h rows were delivered, the stream is at the end of the picture. IRIS_ERR_TRUNCATED, IRIS_ERR_IO:
 * the rows before this one are valid, this one may be partly written, *y is untouched, and there will be no more.
 * IRIS_ERR_FORMAT; IRIS_ERR_ARG: null pointer, or the reader did not begin. O(w). */
iris_status iris_pnm_row(void *row, int32_t *y, iris_pnm_reader *reader, iris_format format);

/* Passes over the rows not read yet.
 * The errors of iris_pnm_row, without IRIS_ERR_END. O(bytes left). */
iris_status iris_pnm_finish(iris_pnm_reader *reader);

/* iris_pnm_row for all rows not delivered yet. image must be reader->w x reader->h, in one of the three formats; any
 * stride.
 * The errors of iris_pnm_row, with the rows that were not delivered untouched; IRIS_ERR_RANGE: another size. O(w h). */
iris_status iris_pnm_read(const iris_image *image, iris_pnm_reader *reader);

typedef struct {
    iris_sink sink;
    int32_t w, h;
    iris_format format;
    int32_t next;       /* rows written so far */
    iris_status status; /* the failure that ended writing */
} iris_pnm_writer;

/* Writes the header of a picture whose rows are given one by one, top first: IRIS_GRAY8 and IRIS_MASK1 (as 0 and 255)
 * become a PGM, IRIS_GRAY_U16 one of 16 bits, IRIS_RGB888 and IRIS_BGR888 a PPM.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: a side outside 1..IRIS_SIDE_MAX; IRIS_ERR_IO. O(1). */
iris_status iris_pnm_write_begin(iris_pnm_writer *writer, iris_sink sink, iris_size size, iris_format format);

/* Writes the next row: w pixels at `row`.
 * IRIS_ERR_IO: now or before, the file is broken; IRIS_ERR_RANGE: h rows were written; IRIS_ERR_ARG: null pointer;
 * IRIS_ERR_ALIGN: an IRIS_MASK1 row that is not 4-byte aligned, or an IRIS_GRAY_U16 row that is not 2-byte aligned.
 * O(w). */
iris_status iris_pnm_write_row(iris_pnm_writer *writer, const void *row);

/* IRIS_OK when the file is whole; IRIS_ERR_TRUNCATED: rows are missing; IRIS_ERR_IO; IRIS_ERR_ARG: null pointer.
 * O(1). */
iris_status iris_pnm_write_end(const iris_pnm_writer *writer);

/* Writes the whole image.
 * The errors of iris_pnm_write_begin and iris_image_check. O(w h). */
iris_status iris_pnm_write(iris_sink sink, const iris_image *image);

#ifdef __cplusplus
}
#endif

#endif
