/* Decodes BMP with the library, row by row, for the tests. */
#ifndef IRIS_TEST_BMP_DECODE_H
#define IRIS_TEST_BMP_DECODE_H

#include "iris/bmp.h"
#include "picture.h"

typedef struct {
    iris_status status;
    iris_bmp_reader reader;
    picture image; /* null pixels when the header was refused */
    int rows;      /* delivered */
} decoded;

/* Decodes the picture at the stream's position row by row. Rows not delivered are 0xAA. */
static inline decoded decode_stream(iris_stream *stream, iris_format format)
{
    decoded result = {0};
    result.status = iris_bmp_begin(&result.reader, stream);
    if (result.status != IRIS_OK) {
        return result;
    }
    iris_bmp_reader *reader = &result.reader;
    int channels = format == IRIS_GRAY8 ? 1 : 3;
    size_t row_bytes = (size_t)reader->w * (size_t)channels;
    if (row_bytes * (size_t)reader->h > 4u << 20) {
        result.status = iris_bmp_finish(reader);
        return result;
    }
    result.image = (picture){reader->w, reader->h, channels, malloc(row_bytes * (size_t)reader->h)};
    memset(result.image.pixels, 0xAA, row_bytes * (size_t)reader->h);
    uint8_t *row = malloc(row_bytes);
    while (result.status == IRIS_OK && result.rows < reader->h) {
        int32_t y = -1;
        result.status = iris_bmp_row(row, &y, reader, format);
        if (result.status == IRIS_OK) {
            assert_true(y >= 0 && y < reader->h);
            memcpy(result.image.pixels + (size_t)y * row_bytes, row, row_bytes);
            result.rows++;
        }
    }
    free(row);
    if (result.status == IRIS_OK) {
        assert_int_equal(iris_bmp_row(&channels, NULL, reader, format), IRIS_ERR_END);
        result.status = iris_bmp_finish(reader);
    }
    return result;
}

static inline decoded decode_from(awkward_source *from, iris_format format)
{
    iris_stream stream;
    assert_int_equal(iris_stream_init(&stream, (iris_source){awkward_read, from}), IRIS_OK);
    return decode_stream(&stream, format);
}

static inline decoded decode(const uint8_t *data, size_t bytes, iris_format format)
{
    awkward_source from = {data, bytes, 0, SIZE_MAX, SIZE_MAX, NULL, 0};
    return decode_from(&from, format);
}

#endif
