/* IRIS - byte streams: where picture files come from and go to.
 *
 * The library does no input or output. The caller gives a function that reads bytes (a file, an SD card, a serial port,
 * memory) or one that takes them. Pictures may follow each other in one stream; nothing is ever asked from the source
 * before it is needed, so that a picture is complete as soon as its last byte has arrived.
 */
#ifndef IRIS_STREAM_H
#define IRIS_STREAM_H

#include <stddef.h>
#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes in. read stores 1 to `bytes` bytes at `buffer` and returns how many; 0 at the end of the input, negative on
 * failure. bytes is never 0. Fewer than asked is fine: it is called again. */
typedef struct {
    ptrdiff_t (*read)(void *user, uint8_t *buffer, size_t bytes);
    void *user; /* handed to read */
} iris_source;

/* Bytes out. write takes 1 to `bytes` bytes from `data` and returns how many; 0 or negative on failure. bytes is never
 * 0. Fewer than offered is fine: it is called again. */
typedef struct {
    ptrdiff_t (*write)(void *user, const uint8_t *data, size_t bytes);
    void *user; /* handed to write */
} iris_sink;

/* A source in memory: set data and bytes, position to 0. */
typedef struct {
    const uint8_t *data;
    size_t bytes;
    size_t position; /* of the next byte */
} iris_memory_source;

/* A sink in memory: set data and capacity, used to 0. Bytes that do not fit are a failure; those before are there. */
typedef struct {
    uint8_t *data;
    size_t capacity; /* bytes */
    size_t used;     /* bytes written so far */
} iris_memory_sink;

/* The source or sink over *memory, which must outlive it. O(1). */
iris_source iris_source_memory(iris_memory_source *memory);
iris_sink iris_sink_memory(iris_memory_sink *memory);

/* Gives all bytes to the sink.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_IO: the sink failed, some bytes may have been taken. O(bytes). */
iris_status iris_sink_write(const iris_sink *sink, const void *data, size_t bytes);

/* A source that can be looked into two bytes ahead: what the picture readers read from. */
typedef struct {
    iris_source source;
    uint64_t position; /* bytes consumed so far */
    uint8_t ahead[2];  /* looked at, not consumed yet */
    uint8_t ahead_count;
} iris_stream;

/* Makes *stream ready to read from the start of `source`.
 * IRIS_ERR_ARG: null pointer or no read function. O(1). */
iris_status iris_stream_init(iris_stream *stream, iris_source source);

/* Reads exactly `bytes` bytes.
 * IRIS_ERR_END: the input had ended, nothing was read (never for 0 bytes); IRIS_ERR_TRUNCATED: it ended on the way;
 * IRIS_ERR_IO: the source failed. After the last two, the first bytes of buffer are written, how many is not told.
 * IRIS_ERR_ARG: null pointer. O(bytes). */
iris_status iris_stream_read(iris_stream *stream, void *buffer, size_t bytes);

/* The same without keeping the bytes. O(bytes). */
iris_status iris_stream_skip(iris_stream *stream, uint64_t bytes);

/* Shows the next two bytes without consuming them.
 * IRIS_ERR_END: none; IRIS_ERR_TRUNCATED: only one, in next[0]; IRIS_ERR_IO; IRIS_ERR_ARG: null pointer. O(1). */
iris_status iris_stream_peek(uint8_t next[2], iris_stream *stream);

typedef enum {
    IRIS_PICTURE_BMP = 1, /* bmp.h */
    IRIS_PICTURE_PNM      /* pnm.h: PGM or PPM */
} iris_picture_kind;

/* Which reader takes the picture that begins here; consumes nothing.
 * IRIS_ERR_END: the input ended between two pictures; IRIS_ERR_DATA: neither kind; IRIS_ERR_TRUNCATED: one byte;
 * IRIS_ERR_IO; IRIS_ERR_ARG: null pointer. O(1). */
iris_status iris_stream_kind(iris_picture_kind *kind, iris_stream *stream);

#ifdef __cplusplus
}
#endif

#endif
