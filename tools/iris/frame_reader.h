/* Pictures from a file or from standard input: BMP, PGM, and PPM, told apart by their first bytes, one after another.
 * Nothing is asked from the input before it is needed, so that a picture in a pipe is answered when its last byte has
 * come. Nothing is complained about here: see frame_reader_problem.
 */
#ifndef IRIS_TOOL_FRAME_READER_H
#define IRIS_TOOL_FRAME_READER_H

#include "iris/bmp.h"
#include "iris/pnm.h"
#include "iris/stream.h"
#include "picture.h"
#include "raw_picture.h"

typedef struct {
    /* Of the picture that frame_reader_begin found: */
    iris_size size;
    const char *format; /* "BMP", "PGM", "PPM" */
    const char *coding; /* "raw", "palette", "bitfields", "rle" */
    int bits;           /* per pixel */
    int is_gray;
    int top_down;
    int64_t frames; /* pictures read so far */

    const raw_layout
        *raw; /* set by who has opened the reader for frame_reader_next; null: BMP, PGM, or PPM */

    /* Private. */
    int fd, close_fd;
    int error;           /* errno of what failed */
    size_t first, count; /* bytes waiting in buffer */
    uint8_t buffer[65536];
    iris_stream stream;
    iris_picture_kind kind; /* 0: not known yet */
    iris_bmp_reader bmp;
    iris_pnm_reader pnm;
    iris_status status;
    char problem[120];
    picture_buffer raw_bytes;
} frame_reader;

/* path "-" is standard input. IRIS_ERR_IO: it cannot be opened. Close the reader in any case. */
iris_status frame_reader_open(frame_reader *reader, const char *path);

/* Reads the next picture into *picture, which grows as needed. format: IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888, or 0 for
 * what the file holds (IRIS_GRAY8 or IRIS_RGB888).
 * IRIS_ERR_END: the input ended where it may, behind a picture, or without any; IRIS_ERR_TRUNCATED: within a picture;
 * IRIS_ERR_DATA: garbage; IRIS_ERR_UNSUPPORTED; IRIS_ERR_RANGE: a side is too long; IRIS_ERR_FULL, IRIS_ERR_SCRATCH:
 * see picture_reserve; IRIS_ERR_IO. There is no way to go on after an error. */
iris_status frame_reader_next(frame_reader *reader, picture_buffer *picture, iris_format format);

/* The two halves for who wants to look only: the header, then all pixels, checked and thrown away. */
iris_status frame_reader_begin(frame_reader *reader);
iris_status frame_reader_skip(frame_reader *reader);

/* What the last status means, in words for a complaint. */
const char *frame_reader_problem(const frame_reader *reader);

void frame_reader_close(frame_reader *reader);

#endif
