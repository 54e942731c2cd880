#include "frame_reader.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "system.h"

static ptrdiff_t read_bytes(void *user, uint8_t *bytes, size_t wanted)
{
    frame_reader *reader = user;
    if (reader->count == 0) {
        ssize_t got;
        do {
            got = read(reader->fd, reader->buffer, sizeof reader->buffer);
        } while (got < 0 && errno == EINTR);
        if (got <= 0) {
            reader->error = got < 0 ? errno : 0;
            return got;
        }
        reader->first = 0;
        reader->count = (size_t)got;
    }
    size_t given = wanted < reader->count ? wanted : reader->count;
    memcpy(bytes, reader->buffer + reader->first, given);
    reader->first += given;
    reader->count -= given;
    return (ptrdiff_t)given;
}

static void say_problem(frame_reader *reader)
{
    const char *text = iris_status_text(reader->status);
    char *problem = reader->problem;
    size_t bytes = sizeof reader->problem;
    switch (reader->status) {
    case IRIS_ERR_IO:
        text = strerror(reader->error);
        break;
    case IRIS_ERR_END:
        text = "is empty";
        break;
    case IRIS_ERR_TRUNCATED:
        text = "ends too early";
        break;
    case IRIS_ERR_DATA:
        text = reader->kind ? "damaged, contradicts its own format" : "neither BMP nor PGM/PPM";
        break;
    case IRIS_ERR_RANGE:
        snprintf(problem, bytes, "a side above %d pixels", IRIS_SIDE_MAX);
        return;
    case IRIS_ERR_UNSUPPORTED:
        text = reader->kind == IRIS_PICTURE_BMP
                   ? "a kind of BMP that is not read"
                   : "a kind of PNM that is not read (only binary PGM and PPM of 8 bits)";
        break;
    case IRIS_ERR_SCRATCH:
    case IRIS_ERR_FULL:
        text = picture_problem(reader->status, reader->size);
        break;
    default:
        break;
    }
    snprintf(problem, bytes, "%s", text);
}

/* Keeps the status with its words. */
static iris_status finish(frame_reader *reader, iris_status status)
{
    reader->status = status;
    if (status != IRIS_OK) {
        say_problem(reader);
    }
    return status;
}

iris_status frame_reader_open(frame_reader *reader, const char *path)
{
    int is_stdin = strcmp(path, "-") == 0;
    reader->fd = is_stdin ? STDIN_FILENO : system_open(path);
    reader->close_fd = !is_stdin && reader->fd >= 0;
    reader->error = errno;
    reader->first = reader->count = 0;
    reader->kind = 0;
    reader->frames = 0;
    reader->size = (iris_size){0, 0};
    reader->raw = NULL;
    reader->raw_bytes = (picture_buffer){0};
    if (reader->fd < 0) {
        return finish(reader, IRIS_ERR_IO);
    }
    return finish(reader, iris_stream_init(&reader->stream, (iris_source){read_bytes, reader}));
}

static iris_status begin_bmp(frame_reader *reader)
{
    static const char *const codings[] = {"palette", "bitfields", "raw", "rle"};
    iris_status status = iris_bmp_begin(&reader->bmp, &reader->stream);
    if (status == IRIS_OK) {
        reader->size = (iris_size){reader->bmp.w, reader->bmp.h};
        reader->format = "BMP";
        reader->coding = codings[reader->bmp.kind];
        reader->bits = reader->bmp.bits;
        reader->is_gray = reader->bmp.is_gray;
        reader->top_down = reader->bmp.top_down;
    }
    return status;
}

static iris_status begin_pnm(frame_reader *reader)
{
    iris_status status = iris_pnm_begin(&reader->pnm, &reader->stream);
    if (status == IRIS_OK) {
        reader->size = (iris_size){reader->pnm.w, reader->pnm.h};
        reader->format = reader->pnm.is_gray ? "PGM" : "PPM";
        reader->coding = "raw";
        reader->bits = reader->pnm.is_gray ? 8 : 24;
        reader->is_gray = reader->pnm.is_gray;
        reader->top_down = 1;
    }
    return status;
}

iris_status frame_reader_begin(frame_reader *reader)
{
    reader->kind = 0;
    iris_status status = iris_stream_kind(&reader->kind, &reader->stream);
    if (status == IRIS_OK) {
        status = reader->kind == IRIS_PICTURE_BMP ? begin_bmp(reader) : begin_pnm(reader);
    }
    return finish(reader, status);
}

iris_status frame_reader_skip(frame_reader *reader)
{
    static uint8_t row[3 * IRIS_SIDE_MAX];
    iris_status status = IRIS_OK;
    for (int32_t y = 0; y < reader->size.h && status == IRIS_OK; y++) {
        status = reader->kind == IRIS_PICTURE_BMP ? iris_bmp_row(row, NULL, &reader->bmp, IRIS_RGB888)
                                                  : iris_pnm_row(row, NULL, &reader->pnm, IRIS_RGB888);
    }
    if (status == IRIS_OK && reader->kind == IRIS_PICTURE_BMP) {
        status = iris_bmp_finish(&reader->bmp);
    }
    reader->frames += status == IRIS_OK;
    return finish(reader, status);
}

static iris_status next_raw(frame_reader *reader, picture_buffer *picture)
{
    reader->size = reader->raw->size;
    iris_status status = raw_picture_read(picture, &reader->raw_bytes, &reader->stream, reader->raw);
    if (status == IRIS_OK) {
        reader->is_gray = picture->image.format == IRIS_GRAY8;
        reader->bits = reader->is_gray ? 8 : 24;
        reader->frames++;
    }
    return finish(reader, status);
}

iris_status frame_reader_next(frame_reader *reader, picture_buffer *picture, iris_format format)
{
    if (reader->raw) {
        return next_raw(reader, picture);
    }
    iris_status status = frame_reader_begin(reader);
    if (status != IRIS_OK) {
        return status;
    }
    status = picture_reserve(picture, reader->size,
                             format            ? format
                             : reader->is_gray ? IRIS_GRAY8
                                               : IRIS_RGB888);
    if (status == IRIS_OK) {
        status = reader->kind == IRIS_PICTURE_BMP ? iris_bmp_read(&picture->image, &reader->bmp)
                                                  : iris_pnm_read(&picture->image, &reader->pnm);
    }
    reader->frames += status == IRIS_OK;
    return finish(reader, status);
}

const char *frame_reader_problem(const frame_reader *reader)
{
    return reader->problem;
}

void frame_reader_close(frame_reader *reader)
{
    if (reader->close_fd) {
        close(reader->fd);
        reader->close_fd = 0;
    }
    picture_free(&reader->raw_bytes);
}
