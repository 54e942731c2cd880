/* IRIS - BMP pictures, read and written row by row.
 *
 * Reading needs no memory but the reader and the row that the caller gives, so that a microcontroller reads a BMP from
 * an SD card. Three calls read one:
 *
 *     iris_bmp_begin(&reader, &stream);       the header: reader.w, reader.h; check that they fit your memory
 *     iris_image_wrap(&image, ...);           reader.w x reader.h, IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888
 *     iris_bmp_read(&image, &reader);         all rows; or iris_bmp_row h times, then iris_bmp_finish
 *
 * Read are 1, 2, 4, 8, 16, 24, and 32 bits per pixel, RLE4, RLE8, and RLE24, bit fields with any contiguous masks,
 * bottom-up and top-down, with the headers of OS/2 1.x and 2.x and all of Windows. Alpha, color profiles, and pixel
 * density are ignored. Not read: 64 bits per pixel, Huffman, embedded JPEG and PNG. No number in a file is trusted; all
 * work is O(w h). Report, section 3.2.2.
 */
#ifndef IRIS_BMP_H
#define IRIS_BMP_H

#include "iris/image.h"
#include "iris/status.h"
#include "iris/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most bytes that a file may have between its header and its pixels, and behind its pixels (color profiles). */
#define IRIS_BMP_GAP_MAX 1048576

typedef enum {
    IRIS_BMP_PALETTE,   /* 1, 2, 4, or 8 bits */
    IRIS_BMP_BITFIELDS, /* 16 or 32 bits, with masks given or implied */
    IRIS_BMP_BGR,       /* 24 bits */
    IRIS_BMP_RLE        /* run-length encoded with 4, 8, or 24 bits */
} iris_bmp_kind;

/* What iris_bmp_begin learned from the header. */
typedef struct {
    int32_t w, h; /* pixels, 1 to IRIS_SIDE_MAX */
    int32_t bits; /* per pixel in the file */
    iris_bmp_kind kind;
    int32_t top_down; /* 1: the first row in the file is the top one; 0: the bottom one, as usual */
    int32_t is_gray;  /* 1: every color of the palette is gray; 0: not so, or no palette */
    int32_t next;     /* rows delivered so far */

    /* From here on private. */
    iris_status status; /* the failure that ended reading */
    iris_stream *stream;
    uint64_t start;        /* position of the file in the stream */
    uint64_t pixels;       /* position of the pixels in the file */
    uint32_t file_bytes;   /* as declared */
    uint32_t pixel_bytes;  /* as declared */
    uint32_t mask[3];      /* of red, green, blue in 16 and 32 bits */
    uint32_t scale_q16[3]; /* from a shifted field to 0..255 */
    uint8_t shift[3];
    uint8_t rle_ended;        /* end of bitmap seen */
    int32_t rle_x;            /* where the next run begins */
    int32_t rle_rows_skipped; /* rows to leave out before the next run */
    uint8_t palette[256][4];  /* R, G, B, luma */
} iris_bmp_reader;

/* Reads the header and palette of the picture that begins at the stream's position. The stream must outlive the reader.
 * Nothing is allocated, but the caller is about to: w * h can be a gigapixel in a file of 54 bytes.
 * IRIS_ERR_END: the input ended before the first byte; IRIS_ERR_TRUNCATED: within the header; IRIS_ERR_IO;
 * IRIS_ERR_DATA: not a BMP, or one that contradicts itself; IRIS_ERR_RANGE: a side above IRIS_SIDE_MAX;
 * IRIS_ERR_UNSUPPORTED; IRIS_ERR_ARG: null pointer. O(1) plus a gap of at most IRIS_BMP_GAP_MAX bytes. */
iris_status iris_bmp_begin(iris_bmp_reader *reader, iris_stream *stream);

/* Delivers the next row in file order: w pixels of `format` (IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888) at `row`, and its
 * place from the top, 0 to h - 1, in *y (which may be null). Gray is luma, exact for gray colors. Pixels that RLE
 * leaves out get palette entry 0, black with 24 bits; runs are cut at the end of the row; palette entries that the file
 * lacks are black.
 * IRIS_ERR_END: all h rows were delivered. IRIS_ERR_TRUNCATED, IRIS_ERR_IO, IRIS_ERR_DATA (RLE that goes nowhere): the
 * rows before this one are valid, this one may be partly written, *y is untouched, and there will be no more.
 * IRIS_ERR_FORMAT; IRIS_ERR_ARG: null pointer, or the reader did not begin. O(w). */
iris_status iris_bmp_row(void *row, int32_t *y, iris_bmp_reader *reader, iris_format format);

/* Leaves the stream at the end of this picture, where the next may begin: behind the last pixel (RLE: behind the end of
 * bitmap), or at the end that the header declares where that is at most IRIS_BMP_GAP_MAX further. Rows not read yet are
 * passed over. If the input ends behind the last pixel but before the declared end, that is fine. Otherwise the errors
 * of iris_bmp_row; IRIS_ERR_END: it was finished before. O(bytes left). */
iris_status iris_bmp_finish(iris_bmp_reader *reader);

/* iris_bmp_row for all rows (those not delivered yet), then iris_bmp_finish. image must be reader->w x reader->h, in
 * one of the three formats; any stride.
 * The errors of iris_bmp_row, with the rows behind the one that failed untouched; IRIS_ERR_RANGE: another size. O(w h). */
iris_status iris_bmp_read(const iris_image *image, iris_bmp_reader *reader);

typedef struct {
    iris_sink sink;
    int32_t w, h;
    iris_format format;
    int32_t next;       /* rows written so far */
    iris_status status; /* the failure that ended writing */
} iris_bmp_writer;

/* Writes the header of a picture whose rows are given one by one.
 *   format    IRIS_MASK1: 1 bit, 1 is white; IRIS_GRAY8: 8 bits, gray palette; IRIS_RGB888, IRIS_BGR888: 24 bits
 *   top_down  1: rows will come top first (as from a sensor; some old programs do not read such files); 0: bottom first
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: a side outside 1..IRIS_SIDE_MAX; IRIS_ERR_IO. O(1). */
iris_status iris_bmp_write_begin(iris_bmp_writer *writer, iris_sink sink, iris_size size, iris_format format,
                                 int32_t top_down);

/* Writes the next row: w pixels at `row`.
 * IRIS_ERR_IO: now or before, the file is broken; IRIS_ERR_RANGE: h rows were written; IRIS_ERR_ARG: null pointer;
 * IRIS_ERR_ALIGN: an IRIS_MASK1 row that is not 4-byte aligned. O(w). */
iris_status iris_bmp_write_row(iris_bmp_writer *writer, const void *row);

/* IRIS_OK when the file is whole; IRIS_ERR_TRUNCATED: rows are missing; IRIS_ERR_IO; IRIS_ERR_ARG: null pointer.
 * O(1). */
iris_status iris_bmp_write_end(const iris_bmp_writer *writer);

/* Writes the whole image, bottom-up.
 * The errors of iris_bmp_write_begin and iris_image_check. O(w h). */
iris_status iris_bmp_write(iris_sink sink, const iris_image *image);

#ifdef __cplusplus
}
#endif

#endif
