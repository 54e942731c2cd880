/* For the tests of BMP, PNM, and streams: files of the shared data, awkward sources, and a PNM reader of their own. */
#ifndef IRIS_TEST_PICTURE_H
#define IRIS_TEST_PICTURE_H

#include <stdio.h>

#include "iris/stream.h"
#include "test.h"

typedef struct {
    int w, h, channels;
    uint8_t *pixels; /* rows without padding; malloc */
} picture;

/* The whole file, or null. Longer by nothing, so that a sanitizer sees reads past its end. */
static inline uint8_t *load_file(const char *path, size_t *bytes)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        return NULL;
    }
    fseek(file, 0, SEEK_END);
    *bytes = (size_t)ftell(file);
    rewind(file);
    uint8_t *data = malloc(*bytes ? *bytes : 1);
    assert_int_equal(fread(data, 1, *bytes, file), *bytes);
    fclose(file);
    return data;
}

/* Path of a file of the shared data; static storage. */
static inline const char *data_path(const char *name)
{
    static char path[512];
    const char *root = getenv("IRIS_DATA");
    snprintf(path, sizeof path, "%s/%s", root ? root : "../shared/data", name);
    return path;
}

/* A P5 or P6 file without comments, by scanf: independent of the library. pixels is null when there is no such file. */
static inline picture load_pnm(const char *path)
{
    picture result = {0, 0, 0, NULL};
    FILE *file = fopen(path, "rb");
    if (!file) {
        return result;
    }
    char kind;
    assert_int_equal(fscanf(file, "P%c %d %d 255", &kind, &result.w, &result.h), 3);
    assert_true(fgetc(file) >= 0);
    result.channels = kind == '6' ? 3 : 1;
    size_t bytes = (size_t)result.w * (size_t)result.h * (size_t)result.channels;
    result.pixels = malloc(bytes);
    assert_int_equal(fread(result.pixels, 1, bytes, file), bytes);
    fclose(file);
    return result;
}

/* A source over memory that gives at most `most` bytes per call, fails when `fail_at` bytes have been given, and after
 * its end either ends or goes on forever with what it repeats. */
typedef struct {
    const uint8_t *data;
    size_t bytes, position, most, fail_at;
    const uint8_t *forever; /* null: ends */
    size_t forever_bytes;
} awkward_source;

static inline ptrdiff_t awkward_read(void *user, uint8_t *buffer, size_t bytes)
{
    awkward_source *from = user;
    assert_true(bytes > 0);
    size_t count = 0;
    while (count < bytes && count < from->most && from->position < from->fail_at) {
        if (from->position < from->bytes) {
            buffer[count] = from->data[from->position];
        } else if (from->forever) {
            buffer[count] = from->forever[(from->position - from->bytes) % from->forever_bytes];
        } else {
            return (ptrdiff_t)count;
        }
        count++;
        from->position++;
    }
    return count == 0 ? -1 : (ptrdiff_t)count;
}

/* A sink into memory that takes at most `most` bytes per call and fails when `fail_at` bytes have been taken. */
typedef struct {
    uint8_t *data;
    size_t used, most, fail_at;
} awkward_sink;

static inline ptrdiff_t awkward_write(void *user, const uint8_t *data, size_t bytes)
{
    awkward_sink *to = user;
    assert_true(bytes > 0);
    size_t count = 0;
    while (count < bytes && count < to->most && to->used < to->fail_at) {
        to->data[to->used++] = data[count++];
    }
    return count == 0 ? -1 : (ptrdiff_t)count;
}

/* The next number of a fixed sequence. */
static inline uint32_t next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

#endif
