/* Runs every operation and prints `name digest` lines. */
#include "digest.h"

#include <string.h>

#define DIGEST_MODULE(module) digest_##module,
static const digest_operation *const tables[] = {
#include "modules.def"
};
#undef DIGEST_MODULE

static IRIS_SCRATCH_BUFFER(arena, DIGEST_ARENA_BYTES);
static struct {
    iris_scratch memory;
    uint64_t hash; /* FNV-1a */
    uint32_t random;
    int exhausted;
} state;

void *digest_take(size_t bytes)
{
    void *block = iris_scratch_take(&state.memory, bytes);
    if (!block) {
        state.exhausted = 1;
        return arena.memory;
    }
    return memset(block, 0, bytes);
}

iris_scratch digest_scratch(size_t bytes)
{
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, digest_take(bytes), bytes);
    return scratch;
}

uint32_t digest_random(void)
{
    state.random = state.random * 1664525u + 1013904223u;
    return state.random >> 8;
}

int32_t digest_between(int32_t low, int32_t high)
{
    return low + (int32_t)(digest_random() % (uint32_t)(high - low + 1));
}

/* Of what one value of a row is made. RGB565 is two bytes in a fixed order. */
static size_t value_bytes(iris_format format)
{
    switch (format) {
    case IRIS_GRAY_S16:
    case IRIS_GRAY_U16:
    case IRIS_HSL48:
        return 2;
    case IRIS_GRAY_U32:
    case IRIS_MASK1:
        return 4;
    default:
        return 1;
    }
}

/* Where the lowest byte of a value comes first there is nothing to do. */
static int lowest_first(void)
{
    const uint16_t one = 1;
    return *(const uint8_t *)&one == 1;
}

iris_image digest_canvas(iris_format format, int32_t w, int32_t h)
{
    iris_image image = {0};
    size_t bytes = iris_format_row_bytes(format, w) * (size_t)h;
    if (iris_image_wrap(&image, digest_take(bytes), bytes, (iris_size){w, h}, 0, format) != IRIS_OK) {
        state.exhausted = 1;
    }
    return image;
}

/* The level of byte i of a row that has n: light falls from left to right, a dark line leans through the picture, one
 * spot is saturated, and noise lies over everything. */
static uint8_t level(int32_t i, int32_t n, int32_t y)
{
    int32_t value = 220 - 120 * i / n;
    int32_t from_line = i - n / 3 - y / 2;
    if (from_line >= 0 && from_line < n / 8 + 1) {
        value /= 4;
    }
    if (i > n * 3 / 4 && y % 16 < 5) {
        value = 255;
    }
    value += digest_between(-8, 8);
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

/* Values of `size` bytes, lowest byte first, become the processor's own. */
static void own_order(uint8_t *row, size_t bytes, size_t size)
{
    for (size_t i = 0; i < bytes && !lowest_first(); i += size) {
        for (size_t k = 0; k < size / 2; k++) {
            uint8_t byte = row[i + k];
            row[i + k] = row[i + size - 1 - k];
            row[i + size - 1 - k] = byte;
        }
    }
}

iris_image digest_picture(iris_format format, int32_t w, int32_t h)
{
    iris_image image = digest_canvas(format, w, h);
    int32_t bytes = (int32_t)iris_format_row_bytes(format, w);
    for (int32_t y = 0; y < h; y++) {
        uint8_t *row = iris_image_row(&image, y);
        for (int32_t i = 0; i < bytes; i++) {
            row[i] = level(i, bytes, y);
        }
        own_order(row, (size_t)bytes, value_bytes(format));
    }
    return image;
}

void digest_bytes(const void *data, size_t bytes)
{
    const uint8_t *byte = data;
    for (size_t i = 0; i < bytes; i++) {
        state.hash = (state.hash ^ byte[i]) * 1099511628211u;
    }
}

void digest_values(const void *data, size_t bytes, size_t size)
{
    const uint8_t *byte = data;
    const size_t turned = lowest_first() ? 0 : size - 1;
    for (size_t i = 0; i < bytes; i++) {
        digest_bytes(&byte[i ^ turned], 1);
    }
}

void digest_view(const iris_image *view)
{
    for (int32_t y = 0; y < view->h; y++) {
        digest_values(iris_image_row(view, y), iris_format_row_bytes(view->format, view->w),
                      value_bytes(view->format));
    }
}

void digest_number(int64_t number)
{
    uint8_t bytes[8];
    for (int i = 0; i < 8; i++) {
        bytes[i] = (uint8_t)((uint64_t)number >> (8 * i));
    }
    digest_bytes(bytes, sizeof bytes);
}

static void print_line(const char *name)
{
    char line[64];
    size_t length = strlen(name);
    memcpy(line, name, length);
    line[length++] = ' ';
    for (int shift = 60; shift >= 0; shift -= 4) {
        line[length++] = "0123456789abcdef"[state.hash >> shift & 15];
    }
    line[length++] = '\n';
    line[length] = '\0';
    target_print(line);
}

int main(void)
{
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) {
        for (const digest_operation *operation = tables[t]; operation->name; operation++) {
            (void)iris_scratch_init(&state.memory, arena.memory, sizeof arena.memory);
            state.hash = 14695981039346656037u;
            state.random = 1;
            operation->run();
            print_line(operation->name);
        }
    }
    if (state.exhausted) {
        target_print("an operation needs more than the arena has\n");
    }
    return state.exhausted;
}
