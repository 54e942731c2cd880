/* Reads a stream of BMP pictures, in all formats, and passes over every fourth.
 * seeds: bmp/g bmp/q bmp/b */
#include <stdlib.h>

#include "iris/bmp.h"

#define PIXELS_MAX 200000 /* of a picture that is decoded */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    static const iris_format formats[] = {IRIS_RGB888, IRIS_GRAY8, IRIS_BGR888};
    iris_memory_source memory = {data, bytes, 0};
    iris_stream stream;
    iris_bmp_reader reader;
    iris_stream_init(&stream, iris_source_memory(&memory));
    for (int i = 0; iris_bmp_begin(&reader, &stream) == IRIS_OK; i++) {
        if (i % 4 < 3 && (int64_t)reader.w * reader.h <= PIXELS_MAX) {
            iris_format format = formats[i % 4];
            iris_size size = {reader.w, reader.h};
            size_t room = iris_format_row_bytes(format, size.w) * (size_t)size.h;
            void *pixels = malloc(room);
            iris_image image;
            if (iris_image_wrap(&image, pixels, room, size, 0, format) == IRIS_OK) {
                iris_bmp_read(&image, &reader);
            }
            free(pixels);
        } else {
            iris_bmp_finish(&reader);
        }
    }
    return 0;
}
