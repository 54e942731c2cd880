/* Row kernels under test: what tests/check_kernels.c needs to know of each.
 *
 * One file per family: its table of cases, and truths worked out by hand. A new kernel: a case in the table and a truth.
 * A new family: a file that defines kernels_<family>, and its line in families.def.
 */
#ifndef IRIS_TEST_KERNELS_H
#define IRIS_TEST_KERNELS_H

#include <stddef.h>
#include <stdint.h>

#include "kernel.h"
#include "test.h"

enum { KERNEL_ROWS = 12, KERNEL_ROOM = 1 << 14 };

typedef void (*any_function)(void);

/* What one pointer of a kernel leads to: a row of pixels, words of a mask, or a table of fixed size. */
typedef struct {
    int32_t per, bytes; /* the row takes `bytes` for every `per` pixels begun */
    int32_t align;      /* of pixel 0 */
    void (*fill)(uint8_t *row, size_t bytes);
    int32_t left, right;   /* pixels before and behind the row that may be touched too */
    int32_t (*more)(void); /* pixels behind the row by the chosen parameters; may be null */
    size_t fixed;          /* a table of so many bytes instead of a row; per and bytes are 0 */
} kernel_row;

/* clang-format off */
#define ROW(per, bytes, align, fill)                     {per, bytes, align, fill, 0, 0, NULL, 0}
#define ROW_MORE(per, bytes, align, fill, more)          {per, bytes, align, fill, 0, 0, more, 0}
#define ROW_AROUND(per, bytes, align, fill, left, right) {per, bytes, align, fill, left, right, NULL, 0}
#define TABLE(bytes, align, fill)                        {0, 0, align, fill, 0, 0, NULL, bytes}
/* clang-format on */

#define ROW_U8   ROW(1, 1, 1, fill_u8)
#define ROW_888  ROW(1, 3, 1, fill_u8)
#define ROW_S16  ROW(1, 2, 2, fill_u16)
#define ROW_U16  ROW(1, 2, 2, fill_u16)
#define ROW_U32  ROW(1, 4, 4, fill_u32)
#define ROW_MASK ROW(32, 4, 4, fill_u8)

/* A row that may be touched from -left to n + right. */
#define ROW_U8_AROUND(left, right)   ROW_AROUND(1, 1, 1, fill_u8, left, right)
#define ROW_S16_AROUND(left, right)  ROW_AROUND(1, 2, 2, fill_u16, left, right)
#define ROW_MASK_AROUND(left, right) ROW_AROUND(32, 4, 4, fill_u8, left, right)

/* One way to call a kernel. The parameters beside the rows are variables of the family's file: choose() draws new ones. */
typedef struct {
    const char *name;
    any_function port, plain;
    void (*run)(int plain, uint8_t **rows, int32_t n);
    void (*choose)(void); /* may be null */
    kernel_row rows[KERNEL_ROWS];
} kernel_case;

/* The first fields of a case, and the body that run() calls: the plain one, or what the library calls. A macro's argument
 * is not expanded beside # and ##, so that these see the kernel's own name where a port has another for it. */
#define KERNEL(kernel)      #kernel, (any_function)(kernel), (any_function)(kernel##_c)
#define BODY(plain, kernel) ((plain) ? kernel##_c : (kernel))

typedef struct {
    const kernel_case *cases;
    size_t count;
    int (*truths)(void); /* runs them as a group; the number that failed */
} kernel_family;

/* Numbers of a fixed sequence: 0 to end - 1. */
uint32_t random_below(uint32_t end);

/* Adversarial content: runs of the extremes, ramps, values that hardly differ, noise; signed or not is the reader's. */
void fill_u8(uint8_t *row, size_t bytes);
void fill_u16(uint8_t *row, size_t bytes);
void fill_u32(uint8_t *row, size_t bytes);

/* The same bytes, but sometimes all within one of a value. */
void fill_u8_near(uint8_t *row, size_t bytes, uint8_t value);

/* Truths: 53 pixels are whole vectors and a tail. */
enum { N = 53, MASK_WORDS = 2 };

#define BOTH_BODIES(plain) for (int plain = 0; plain < 2; plain++)

static inline int bit(const uint32_t *mask, int32_t i)
{
    return (int)(mask[i / 32] >> i % 32 & 1u);
}

static inline uint32_t *words(uint8_t *row)
{
    return (uint32_t *)(void *)row;
}

static inline int16_t *halves(uint8_t *row)
{
    return (int16_t *)(void *)row;
}

#define KERNEL_FAMILY(family) extern const kernel_family kernels_##family;
#include "families.def"
#undef KERNEL_FAMILY

#endif
