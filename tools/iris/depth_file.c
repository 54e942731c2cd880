#include "depth_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "complain.h"

#define MOST 65535

/* The next number of a header; -1: there is none. A comment goes from # to the end of its line. */
static int32_t header_number(FILE *file)
{
    int c = getc(file);
    int32_t number = -1;
    for (int left = 1000; left > 0; left--) {
        if (c == '#') {
            while (c != '\n' && c != EOF && left-- > 0) {
                c = getc(file);
            }
        } else if (c >= '0' && c <= '9') {
            number = (number < 0 ? 0 : number) * 10 + (c - '0');
            if (number > MOST) {
                return -1;
            }
        } else if (number >= 0 || (c != ' ' && c != '\t' && c != '\r' && c != '\n')) {
            return number;
        }
        c = getc(file);
    }
    return -1;
}

static int read_rows(const iris_image *image, FILE *file, const char *path)
{
    for (int32_t y = 0; y < image->h; y++) {
        uint16_t *row = iris_image_row(image, y);
        uint8_t *bytes = (uint8_t *)row;
        if (fread(bytes, 2, (size_t)image->w, file) != (size_t)image->w) {
            complain(path, "ends early, in row %d of %d", (int)y + 1, (int)image->h);
            return 0;
        }
        for (int32_t x = 0; x < image->w; x++) {
            row[x] = (uint16_t)(bytes[2 * x] << 8 | bytes[2 * x + 1]);
        }
    }
    return 1;
}

static int read_picture(picture_buffer *picture, FILE *file, const char *path)
{
    char magic[2] = {0};
    const int is_pgm = fread(magic, 1, 2, file) == 2 && magic[0] == 'P' && magic[1] == '5';
    const iris_size size = {is_pgm ? header_number(file) : -1, is_pgm ? header_number(file) : -1};
    const int32_t most = is_pgm ? header_number(file) : -1;
    if (size.w < 1 || size.h < 1 || most != MOST || size.w > IRIS_SIDE_MAX || size.h > IRIS_SIDE_MAX) {
        complain(path, "expected is a PGM of 16 bits (P5, up to 65535), as iris stereo -o writes it");
        return 0;
    }
    const iris_status status = picture_reserve(picture, size, IRIS_GRAY_U16);
    if (status != IRIS_OK) {
        complain(path, "%s", picture_problem(status, size));
        return 0;
    }
    return read_rows(&picture->image, file, path);
}

int depth_file_read(picture_buffer *picture, const char *path)
{
    FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
    if (!file) {
        complain(path, "%s", strerror(errno));
        return 0;
    }
    const int good = read_picture(picture, file, path);
    if (file != stdin) {
        fclose(file);
    }
    return good;
}
