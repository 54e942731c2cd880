/* Digests: every operation of the library on generated pictures, one line each, the same on every processor.
 *
 * One file per module with one table of operations; modules.def lists the tables. An operation takes its pictures from a
 * small arena (a microcontroller with 16 KB runs all of this), works, and adds its outputs to the digest.
 * A new operation: a function and a line in its table (a new module: its line in modules.def); `make golden`; look at the
 * difference; commit both.
 */
#ifndef IRIS_DIGEST_H
#define IRIS_DIGEST_H

#include <stddef.h>
#include <stdint.h>

#include "iris/image.h"
#include "iris/scratch.h"

typedef struct {
    const char *name; /* module.operation */
    void (*run)(void);
} digest_operation;

/* digest_<module>: each ends with a null name. */
#define DIGEST_MODULE(module) extern const digest_operation digest_##module[];
#include "modules.def"
#undef DIGEST_MODULE

#define DIGEST_ARENA_BYTES 10240

/* Zeroed bytes, aligned to 16; given back when the operation ends. */
void *digest_take(size_t bytes);

/* Working memory of exactly `bytes` bytes. */
iris_scratch digest_scratch(size_t bytes);

/* A zeroed picture, and one with a floor in uneven light, a dark line, saturated spots, and noise. */
iris_image digest_canvas(iris_format format, int32_t w, int32_t h);
iris_image digest_picture(iris_format format, int32_t w, int32_t h);

/* The next number of a fixed sequence, 0 to 2^24 - 1, the same in every run of an operation. Once per statement:
 * compilers choose the order of two calls in one. */
uint32_t digest_random(void);
int32_t digest_between(int32_t low, int32_t high);

/* What counts: outputs. Pixels of a view without padding between rows; numbers as 8 bytes. Every value counts with its
 * lowest byte first, wherever the processor keeps that: digest_values takes `bytes` bytes of values of `size` bytes each
 * (1, 2, 4, or 8). */
void digest_bytes(const void *data, size_t bytes);
void digest_values(const void *data, size_t bytes, size_t size);
void digest_view(const iris_image *view);
void digest_number(int64_t number);

/* Where the lines go: standard output, or a debugger's console. */
void target_print(const char *text);

#endif
