/* Picture files: written to memory, read back, and read again with the end missing. */
#include "digest.h"

#include "iris/bmp.h"
#include "iris/pnm.h"

#define FILE_BYTES 4096

static iris_memory_sink *new_file(void)
{
    iris_memory_sink *file = digest_take(sizeof *file);
    file->data = digest_take(FILE_BYTES);
    file->capacity = FILE_BYTES;
    return file;
}

static void read_bmp(const iris_memory_sink *file, size_t bytes, iris_format format)
{
    iris_memory_source memory = {file->data, bytes, 0};
    iris_bmp_reader *reader = digest_take(sizeof *reader);
    iris_stream stream;
    (void)iris_stream_init(&stream, iris_source_memory(&memory));
    iris_status status = iris_bmp_begin(reader, &stream);
    digest_number(status);
    if (status == IRIS_OK && reader->w <= 40 && reader->h <= 40) {
        iris_image image = digest_canvas(format, reader->w, reader->h);
        digest_number(iris_bmp_read(&image, reader));
        digest_view(&image);
        digest_number((int64_t)stream.position);
    }
}

static void bmp(iris_format format)
{
    iris_memory_sink *file = new_file();
    iris_image image = digest_picture(format, 33, 9);
    digest_number(iris_bmp_write(iris_sink_memory(file), &image));
    digest_bytes(file->data, file->used);
    read_bmp(file, file->used, IRIS_GRAY8);
    read_bmp(file, file->used - 50, IRIS_RGB888);
}

static void bmp_mask(void)
{
    bmp(IRIS_MASK1);
}

static void bmp_gray(void)
{
    bmp(IRIS_GRAY8);
}

static void bmp_rgb(void)
{
    bmp(IRIS_RGB888);
}

/* An RLE8 picture of 8x4 by hand: runs, a literal, a jump, ends of lines. */
static void bmp_rle(void)
{
    static const uint8_t header[] = {
        'B', 'M', 92, 0, 0, 0, 0, 0, 0, 0, 70,  0,  0,  0, 40, 0,   0,  0, 8,  0,  0,   0, 4, 0,
        0,   0,   1,  0, 8, 0, 1, 0, 0, 0, 22,  0,  0,  0, 0,  0,   0,  0, 0,  0,  0,   0, 4, 0,
        0,   0,   0,  0, 0, 0, 0, 0, 0, 0, 200, 10, 20, 0, 3,  190, 50, 0, 80, 70, 160, 0, 5, 1,
        3,   2,   0,  0, 0, 3, 1, 2, 3, 0, 0,   2,  2,  1, 2,  3,   0,  0, 9,  1,  0,   1,
    };
    iris_memory_sink *file = new_file();
    iris_sink sink = iris_sink_memory(file);
    digest_number(iris_sink_write(&sink, header, sizeof header));
    read_bmp(file, file->used, IRIS_RGB888);
    read_bmp(file, file->used - 12, IRIS_RGB888);
}

static void read_pnm(const iris_memory_sink *file, size_t bytes, iris_format format)
{
    iris_memory_source memory = {file->data, bytes, 0};
    iris_pnm_reader reader;
    iris_stream stream;
    (void)iris_stream_init(&stream, iris_source_memory(&memory));
    iris_status status = iris_pnm_begin(&reader, &stream);
    digest_number(status);
    if (status == IRIS_OK && reader.w <= 40 && reader.h <= 40) {
        iris_image image = digest_canvas(format, reader.w, reader.h);
        digest_number(iris_pnm_read(&image, &reader));
        digest_view(&image);
    }
}

static void pnm(iris_format format)
{
    iris_memory_sink *file = new_file();
    iris_image image = digest_picture(format, 33, 9);
    digest_number(iris_pnm_write(iris_sink_memory(file), &image));
    digest_bytes(file->data, file->used);
    read_pnm(file, file->used, IRIS_GRAY8);
    read_pnm(file, file->used - 50, IRIS_RGB888);
}

static void pgm(void)
{
    pnm(IRIS_GRAY8);
}

static void ppm(void)
{
    pnm(IRIS_RGB888);
}

const digest_operation digest_files[] = {
    {"files.bmp_mask", bmp_mask},
    {"files.bmp_gray", bmp_gray},
    {"files.bmp_rgb", bmp_rgb},
    {"files.bmp_rle", bmp_rle},
    {"files.pgm", pgm},
    {"files.ppm", ppm},
    {NULL, NULL},
};
