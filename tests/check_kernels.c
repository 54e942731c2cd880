/* Row kernels: this port's bodies give the bits of the plain ones and stay inside their rows. The kernels themselves are in
 * tests/kernels. */
#include <stdio.h>

#include "guarded/guarded.h"
#include "kernels/kernels.h"

#define KERNEL_FAMILY(family) &kernels_##family,
static const kernel_family *const families[] = {
#include "kernels/families.def"
};
#undef KERNEL_FAMILY
enum { FAMILIES = sizeof families / sizeof families[0] };

/* ---- the kernels ---- */

/* The first case of a kernel; null when no table has it. */
static const kernel_case *case_of(const char *name)
{
    for (int f = 0; f < FAMILIES; f++) {
        for (size_t i = 0; i < families[f]->count; i++) {
            if (strcmp(families[f]->cases[i].name, name) == 0) {
                return &families[f]->cases[i];
            }
        }
    }
    return NULL;
}

static void every_kernel_has_a_case_and_the_port_overrides_what_it_says(void **state)
{
    (void)state;
    FILE *file = fopen("src/foundation/kernel.h", "r");
    assert_non_null(file); /* the tests run in the project's folder */
    char line[256], name[64];
    int overrides = 0;
    while (fgets(line, sizeof line, file)) {
        if (strncmp(line, "#ifndef iris_row_", 17) == 0 && sscanf(line, "#ifndef %63s", name) == 1) {
            const kernel_case *c = case_of(name);
            if (!c) {
                (void)fclose(file);
                fail_msg("%s has no case in tests/kernels", name);
                return;
            }
            overrides += c->port != c->plain;
        }
    }
    (void)fclose(file);
    assert_int_equal(overrides, IRIS_PORT_OVERRIDES);
}

/* ---- one comparison ---- */

enum { AROUND = 64, WIDTHS = 200 };

/* Memory between two pages that cannot be touched, for each pointer of a kernel. */
static uint8_t *guarded[KERNEL_ROWS];
static size_t guarded_bytes;

static int guard_rows(void **state)
{
    (void)state;
    size_t page = guarded_page_bytes();
    guarded_bytes = (KERNEL_ROOM + page - 1) / page * page;
    for (int k = 0; k < KERNEL_ROWS; k++) {
        guarded[k] = guarded_memory(guarded_bytes);
        if (!guarded[k]) {
            return -1;
        }
    }
    return 0;
}

static int rows_of(const kernel_case *c)
{
    int count = 0;
    while (count < KERNEL_ROWS && c->rows[count].fill) {
        count++;
    }
    return count;
}

/* Bytes in front of pixel 0 that may be touched. */
static size_t bytes_before(const kernel_row *row)
{
    return row->fixed ? 0 : (size_t)(row->left + row->per - 1) / (size_t)row->per * (size_t)row->bytes;
}

/* All that may be touched, from the first byte before pixel 0. */
static size_t row_bytes(const kernel_row *row, int32_t n)
{
    if (row->fixed || n == 0) {
        return row->fixed;
    }
    int32_t pixels = n + row->right + (row->more ? row->more() : 0);
    return bytes_before(row) + (size_t)(pixels + row->per - 1) / (size_t)row->per * (size_t)row->bytes;
}

/* Where a row begins: its first byte is at least `offset` into the guarded memory, or its last byte is at most
 * `offset` from the end, as near as the alignment of pixel 0 allows. */
typedef struct {
    size_t offset;
    int from_end;
} placement;

static size_t place(const kernel_row *row, placement at, size_t bytes)
{
    size_t before = bytes_before(row), align = (size_t)row->align;
    if (at.from_end) {
        return (guarded_bytes - at.offset - bytes + before) / align * align - before;
    }
    return (at.offset + before + align - 1) / align * align - before;
}

/* A row's memory as far as it is checked: itself and AROUND bytes on both sides, as far as there are any. */
typedef struct {
    uint8_t *start;
    size_t bytes;
    size_t pixel0; /* from start */
} extent;

static extent extent_of(int k, size_t first, size_t bytes, size_t before)
{
    size_t start = first < AROUND ? 0 : first - AROUND;
    size_t end = first + bytes + AROUND > guarded_bytes ? guarded_bytes : first + bytes + AROUND;
    return (extent){guarded[k] + start, end - start, first + (bytes ? before : 0) - start};
}

/* Runs one body on guarded rows and the plain one on a copy; all bytes of both, and around, must be the same. */
static void compare(const kernel_case *c, int plain, const placement *at, int32_t n)
{
    static uint32_t copies[KERNEL_ROWS][KERNEL_ROOM / 4 + 64];
    uint8_t *rows[KERNEL_ROWS], *copied_rows[KERNEL_ROWS], *copied[KERNEL_ROWS];
    extent extents[KERNEL_ROWS];
    int count = rows_of(c);
    for (int k = 0; k < count; k++) {
        size_t bytes = row_bytes(&c->rows[k], n), first = place(&c->rows[k], at[k], bytes);
        extents[k] = extent_of(k, first, bytes, bytes_before(&c->rows[k]));
        fill_u8(extents[k].start, extents[k].bytes);
        if (bytes > 0) {
            c->rows[k].fill(guarded[k] + first, bytes);
        }
        rows[k] = extents[k].start + extents[k].pixel0;
        copied[k] = (uint8_t *)copies[k] + ((uintptr_t)extents[k].start - (uintptr_t)copies[k]) % 16;
        copied_rows[k] = copied[k] + extents[k].pixel0;
        memcpy(copied[k], extents[k].start, extents[k].bytes);
    }
    c->run(plain, rows, n);
    c->run(1, copied_rows, n);
    for (int k = 0; k < count; k++) {
        if (memcmp(copied[k], extents[k].start, extents[k].bytes) != 0) {
            fail_msg("%s body of %s, pointer %d, %d pixels, %d bytes into memory",
                     plain ? "plain" : IRIS_PORT_NAME, c->name, k, (int)n, (int)(rows[k] - guarded[k]));
        }
    }
}

/* On bare metal, in an emulator, those alone of which the port has its own body. */
static void each_case(void (*check)(const kernel_case *c, int32_t n))
{
    for (int f = 0; f < FAMILIES; f++) {
        for (size_t i = 0; i < families[f]->count; i++) {
            const kernel_case *c = &families[f]->cases[i];
            for (int32_t n = 0; n < WIDTHS && (guarded_by_pages() || c->port != c->plain); n++) {
                check(c, n);
            }
        }
    }
}

static void choose(const kernel_case *c)
{
    if (c->choose) {
        c->choose();
    }
}

/* One row is at each alignment in turn, the others anywhere. */
static void compare_alignments(const kernel_case *c, int32_t n)
{
    for (size_t alignment = 0; alignment < 32; alignment++) {
        placement at[KERNEL_ROWS];
        for (int k = 0; k < KERNEL_ROWS; k++) {
            at[k] = (placement){64 + (k == n % rows_of(c) ? alignment : random_below(32)), 0};
        }
        choose(c);
        compare(c, 0, at, n);
    }
}

static void compare_flush(const kernel_case *c, int32_t n)
{
    for (int round = 0; round < 8; round++) {
        placement at[KERNEL_ROWS];
        for (int k = 0; k < KERNEL_ROWS; k++) {
            at[k] = (placement){0, (round & 2) == 0};
        }
        choose(c);
        compare(c, round & 1, at, n);
    }
}

static void every_width_and_alignment_gives_the_plain_bits(void **state)
{
    (void)state;
    each_case(compare_alignments);
}

static void rows_flush_against_unreadable_pages(void **state)
{
    (void)state;
    each_case(compare_flush);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kernel_has_a_case_and_the_port_overrides_what_it_says),
        cmocka_unit_test(every_width_and_alignment_gives_the_plain_bits),
        cmocka_unit_test(rows_flush_against_unreadable_pages),
    };
    int failed = cmocka_run_group_tests_name("kernels " IRIS_PORT_NAME, tests, guard_rows, NULL);
    for (int f = 0; f < FAMILIES; f++) {
        failed += families[f]->truths();
    }
    return failed;
}
