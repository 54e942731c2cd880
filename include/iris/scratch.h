/* IRIS - working memory: a bump arena over bytes that belong to the caller.
 *
 * Every operation that needs working memory takes an iris_scratch and has one macro, IRIS_<NAME>_SCRATCH_BYTES(...),
 * which is a constant expression: a static buffer of that size is always enough, one byte less never is.
 */
#ifndef IRIS_SCRATCH_H
#define IRIS_SCRATCH_H

#include <stddef.h>
#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Alignment of the arena's base and of every block, in bytes. */
#define IRIS_SCRATCH_ALIGN 16

/* n bytes rounded up to whole blocks. Constant expression in size_t. */
#define IRIS_SCRATCH_ROUND(n) (((size_t)(n) + 15u) / 16u * 16u)

/* A buffer that may serve as an arena's base, static or not:
 *
 *     static IRIS_SCRATCH_BUFFER(working, IRIS_FOLLOW_SCRATCH_BYTES(160, 120));
 *     iris_scratch_init(&scratch, working.memory, sizeof working.memory);
 */
#define IRIS_SCRATCH_BUFFER(name, bytes)                                                                     \
    union {                                                                                                  \
        uint8_t memory[bytes];                                                                               \
        uint64_t word;                                                                                       \
    } name __attribute__((aligned(IRIS_SCRATCH_ALIGN)))

typedef struct {
    uint8_t *base;
    size_t bytes; /* size of the arena */
    size_t used;  /* bytes taken now */
    size_t peak;  /* most bytes ever taken: what this arena needed */
} iris_scratch;

/* Makes an arena of `bytes` bytes at `base`. base may be null when bytes is 0.
 * IRIS_ERR_ARG: scratch is null, or base is null with bytes > 0; IRIS_ERR_ALIGN: base is not 16-byte aligned. O(1). */
iris_status iris_scratch_init(iris_scratch *scratch, void *base, size_t bytes);

/* Takes a block of `bytes` bytes, aligned to IRIS_SCRATCH_ALIGN, contents undefined. Null when it does not fit (or
 * scratch is null). A block of 0 bytes takes nothing and is not null. O(1). */
void *iris_scratch_take(iris_scratch *scratch, size_t bytes);

/* The position to go back to: everything taken after the mark is given back by iris_scratch_release. O(1). */
size_t iris_scratch_mark(const iris_scratch *scratch);
void iris_scratch_release(iris_scratch *scratch, size_t mark);

#ifdef __cplusplus
}
#endif

#endif
