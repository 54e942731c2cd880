#include "iris/stream.h"

#include <string.h>

static ptrdiff_t memory_read(void *user, uint8_t *buffer, size_t bytes)
{
    iris_memory_source *memory = (iris_memory_source *)user;
    size_t left = memory->bytes - memory->position;
    size_t count = bytes < left ? bytes : left;
    if (count > 0) {
        memcpy(buffer, memory->data + memory->position, count);
    }
    memory->position += count;
    return (ptrdiff_t)count;
}

static ptrdiff_t memory_write(void *user, const uint8_t *data, size_t bytes)
{
    iris_memory_sink *memory = (iris_memory_sink *)user;
    size_t left = memory->capacity - memory->used;
    size_t count = bytes < left ? bytes : left;
    if (count > 0) {
        memcpy(memory->data + memory->used, data, count);
    }
    memory->used += count;
    return (ptrdiff_t)count;
}

iris_source iris_source_memory(iris_memory_source *memory)
{
    iris_source source = {memory_read, memory};
    return source;
}

iris_sink iris_sink_memory(iris_memory_sink *memory)
{
    iris_sink sink = {memory_write, memory};
    return sink;
}

iris_status iris_sink_write(const iris_sink *sink, const void *data, size_t bytes)
{
    if (!sink || !sink->write || !data) {
        return IRIS_ERR_ARG;
    }
    const uint8_t *next = (const uint8_t *)data;
    while (bytes > 0) {
        ptrdiff_t taken = sink->write(sink->user, next, bytes);
        if (taken <= 0 || (size_t)taken > bytes) {
            return IRIS_ERR_IO;
        }
        next += taken;
        bytes -= (size_t)taken;
    }
    return IRIS_OK;
}

iris_status iris_stream_init(iris_stream *stream, iris_source source)
{
    if (!stream || !source.read) {
        return IRIS_ERR_ARG;
    }
    stream->source = source;
    stream->position = 0;
    stream->ahead_count = 0;
    return IRIS_OK;
}

/* Reads from the source, past what was looked at, until `bytes` are there or the input ends; *count tells how
 * many. */
static iris_status fill(iris_stream *stream, uint8_t *buffer, size_t bytes, size_t *count)
{
    *count = 0;
    while (*count < bytes) {
        ptrdiff_t got = stream->source.read(stream->source.user, buffer + *count, bytes - *count);
        if (got < 0 || (size_t)(got > 0 ? got : 0) > bytes - *count) {
            return IRIS_ERR_IO;
        }
        if (got == 0) {
            return IRIS_ERR_END;
        }
        *count += (size_t)got;
    }
    return IRIS_OK;
}

iris_status iris_stream_read(iris_stream *stream, void *buffer, size_t bytes)
{
    if (!stream || !buffer) {
        return IRIS_ERR_ARG;
    }
    uint8_t *next = (uint8_t *)buffer;
    size_t before = bytes < stream->ahead_count ? bytes : stream->ahead_count;
    for (size_t i = 0; i < before; i++) {
        next[i] = stream->ahead[0];
        stream->ahead[0] = stream->ahead[1];
    }
    stream->ahead_count = (uint8_t)(stream->ahead_count - before);
    size_t count;
    iris_status status = fill(stream, next + before, bytes - before, &count);
    stream->position += before + count;
    return status == IRIS_ERR_END && before + count > 0 ? IRIS_ERR_TRUNCATED : status;
}

iris_status iris_stream_skip(iris_stream *stream, uint64_t bytes)
{
    uint8_t dropped[128];
    iris_status status = stream ? IRIS_OK : IRIS_ERR_ARG;
    uint64_t left = bytes;
    while (status == IRIS_OK && left > 0) {
        size_t part = left < sizeof dropped ? (size_t)left : sizeof dropped;
        status = iris_stream_read(stream, dropped, part);
        if (status == IRIS_ERR_END && left < bytes) {
            status = IRIS_ERR_TRUNCATED;
        }
        left -= part;
    }
    return status;
}

iris_status iris_stream_peek(uint8_t next[2], iris_stream *stream)
{
    if (!next || !stream) {
        return IRIS_ERR_ARG;
    }
    size_t count;
    size_t held = stream->ahead_count;
    iris_status status = fill(stream, stream->ahead + held, sizeof stream->ahead - held, &count);
    stream->ahead_count = (uint8_t)(held + count);
    memcpy(next, stream->ahead, stream->ahead_count);
    return status == IRIS_ERR_END && stream->ahead_count > 0 ? IRIS_ERR_TRUNCATED : status;
}

iris_status iris_stream_kind(iris_picture_kind *kind, iris_stream *stream)
{
    uint8_t next[2];
    if (!kind) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_stream_peek(next, stream);
    if (status != IRIS_OK) {
        return status;
    }
    if (next[0] == 'B' && next[1] == 'M') {
        *kind = IRIS_PICTURE_BMP;
    } else if (next[0] == 'P' && next[1] >= '1' && next[1] <= '7') {
        *kind = IRIS_PICTURE_PNM;
    } else {
        return IRIS_ERR_DATA;
    }
    return IRIS_OK;
}
