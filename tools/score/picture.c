#include "picture.h"

#include <stdlib.h>

#include "iris/bmp.h"
#include "iris/pnm.h"

static ptrdiff_t read_file(void *user, uint8_t *buffer, size_t bytes)
{
    FILE *file = user;
    size_t count = fread(buffer, 1, bytes, file);
    return count == 0 && ferror(file) ? -1 : (ptrdiff_t)count;
}

static ptrdiff_t write_file(void *user, const uint8_t *data, size_t bytes)
{
    return (ptrdiff_t)fwrite(data, 1, bytes, user);
}

iris_image picture_make(int32_t w, int32_t h, iris_format format)
{
    iris_image image = {0};
    size_t bytes = iris_format_row_bytes(format, w) * (size_t)h;
    void *pixels = bytes <= 192u << 20 ? calloc(bytes, 1) : NULL;
    if (pixels && iris_image_wrap(&image, pixels, bytes, (iris_size){w, h}, 0, format) != IRIS_OK) {
        free(pixels);
    }
    return image;
}

FILE *data_open(const char *name)
{
    char path[512];
    const char *root = getenv("IRIS_DATA");
    int length = snprintf(path, sizeof path, "%s/%s", root ? root : "../shared/data", name);
    return length < (int)sizeof path ? fopen(path, "rb") : NULL;
}

static iris_status read_picture(iris_image *image, FILE *file, iris_format format)
{
    iris_stream stream;
    iris_picture_kind kind;
    iris_bmp_reader bmp;
    iris_pnm_reader pnm;
    iris_stream_init(&stream, (iris_source){read_file, file});
    iris_status status = iris_stream_kind(&kind, &stream);
    if (status != IRIS_OK) {
        return status;
    }
    status = kind == IRIS_PICTURE_BMP ? iris_bmp_begin(&bmp, &stream) : iris_pnm_begin(&pnm, &stream);
    if (status != IRIS_OK) {
        return status;
    }
    *image =
        kind == IRIS_PICTURE_BMP ? picture_make(bmp.w, bmp.h, format) : picture_make(pnm.w, pnm.h, format);
    if (!image->data) {
        return IRIS_ERR_RANGE;
    }
    return kind == IRIS_PICTURE_BMP ? iris_bmp_read(image, &bmp) : iris_pnm_read(image, &pnm);
}

iris_status picture_load(iris_image *image, const char *name, iris_format format)
{
    *image = (iris_image){0};
    FILE *file = data_open(name);
    if (!file) {
        return IRIS_ERR_IO;
    }
    iris_status status = read_picture(image, file, format);
    fclose(file);
    return status;
}

int picture_save(const iris_image *image, const char *folder, const char *name)
{
    char path[512];
    int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = length < (int)sizeof path ? fopen(path, "wb") : NULL;
    if (!file) {
        return 0;
    }
    iris_status status = iris_bmp_write((iris_sink){write_file, file}, image);
    return fclose(file) == 0 && status == IRIS_OK;
}
