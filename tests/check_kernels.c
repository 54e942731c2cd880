/* Row kernels: this port's bodies give the bits of the plain ones and stay inside their rows. */
#include <stdio.h>
#include <sys/mman.h>
#include <unistd.h>

#include "kernel.h"
#include "test.h"

/* ---- the kernels ---- */

typedef void (*any_function)(void);

#define EACH_KERNEL(X)                                                                                       \
    X(iris_row_luma_rgb888)                                                                                  \
    X(iris_row_luma_bgr888)                                                                                  \
    X(iris_row_swap_888)                                                                                     \
    X(iris_row_above_u8)                                                                                     \
    X(iris_row_scan8_u8)                                                                                     \
    X(iris_row_slide_u32)                                                                                    \
    X(iris_row_above_mean_u8)                                                                                \
    X(iris_row_hsl_range)

/* With X(name), name##_c is the plain body, and PORT_BODY(name) what the rest of the library calls. */
#define PORT_BODY(name)  (any_function) name,
#define PLAIN_BODY(name) (any_function) name##_c,
static const any_function port_bodies[] = {EACH_KERNEL(PORT_BODY)};
static const any_function plain_bodies[] = {EACH_KERNEL(PLAIN_BODY)};
enum { KERNELS = sizeof port_bodies / sizeof port_bodies[0] };

static void the_port_overrides_what_it_says(void **state)
{
    (void)state;
    int overrides = 0;
    for (int i = 0; i < KERNELS; i++) {
        overrides += port_bodies[i] != plain_bodies[i];
    }
    assert_int_equal(overrides, IRIS_PORT_OVERRIDES);
}

static void every_kernel_is_in_this_test(void **state)
{
    (void)state;
    FILE *file = fopen("src/foundation/kernel.h", "r");
    assert_non_null(file); /* the tests run in the project's folder */
    char line[256];
    int declared = 0;
    while (fgets(line, sizeof line, file)) {
        declared += strncmp(line, "#ifndef iris_row_", 17) == 0;
    }
    fclose(file);
    assert_int_equal(declared, KERNELS);
}

/* ---- what a kernel is given ---- */

enum { OPERANDS = 3, WIDTHS = 200 };

/* Numbers beside the rows; each kernel takes what it needs. */
typedef struct {
    uint8_t limit;
    iris_row_window window;
    iris_hsl_range_test range;
} settings;

/* A row takes `bytes` for every `per` pixels begun. Its address is a multiple of `align`. */
typedef struct {
    int32_t per, bytes, align;
    enum { BYTES, SUMS, COLUMN_SUMS } content;
} operand;

typedef void (*runner)(int plain, uint8_t **rows, const settings *with, int32_t n);

typedef struct {
    const char *name;
    runner run;
    operand operands[OPERANDS];
} kernel_case;

static uint32_t *words(uint8_t *row)
{
    return (uint32_t *)(void *)row;
}

static void run_luma_rgb888(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (void)with;
    (plain ? iris_row_luma_rgb888_c : iris_row_luma_rgb888)(rows[0], rows[1], n);
}

static void run_luma_bgr888(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (void)with;
    (plain ? iris_row_luma_bgr888_c : iris_row_luma_bgr888)(rows[0], rows[1], n);
}

static void run_swap(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (void)with;
    (plain ? iris_row_swap_888_c : iris_row_swap_888)(rows[0], rows[1], n);
}

static void run_swap_in_place(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (void)with;
    (plain ? iris_row_swap_888_c : iris_row_swap_888)(rows[0], rows[0], n);
}

static void run_above(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (plain ? iris_row_above_u8_c : iris_row_above_u8)(words(rows[0]), rows[1], with->limit, n);
}

static void run_scan8(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (void)with;
    (plain ? iris_row_scan8_u8_c : iris_row_scan8_u8)((iris_block8 *)(void *)rows[0], rows[1], n);
}

static void run_slide(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (void)with;
    (plain ? iris_row_slide_u32_c : iris_row_slide_u32)(words(rows[0]), rows[1], rows[2], n);
}

static void run_above_mean(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (plain ? iris_row_above_mean_u8_c : iris_row_above_mean_u8)(words(rows[0]), rows[1], words(rows[2]),
                                                                with->window, n);
}

static void run_hsl_range(int plain, uint8_t **rows, const settings *with, int32_t n)
{
    (plain ? iris_row_hsl_range_c : iris_row_hsl_range)(words(rows[0]), rows[1], &with->range, n);
}

static const kernel_case cases[] = {
    {"luma_rgb888", run_luma_rgb888, {{1, 1, 1, BYTES}, {1, 3, 1, BYTES}}},
    {"luma_bgr888", run_luma_bgr888, {{1, 1, 1, BYTES}, {1, 3, 1, BYTES}}},
    {"swap_888", run_swap, {{1, 3, 1, BYTES}, {1, 3, 1, BYTES}}},
    {"swap_888 in place", run_swap_in_place, {{1, 3, 1, BYTES}}},
    {"above_u8", run_above, {{32, 4, 4, BYTES}, {1, 1, 1, BYTES}}},
    {"scan8_u8", run_scan8, {{8, 4, 2, BYTES}, {1, 1, 1, BYTES}}},
    {"slide_u32", run_slide, {{1, 4, 4, SUMS}, {1, 1, 1, BYTES}, {1, 1, 1, BYTES}}},
    {"above_mean_u8", run_above_mean, {{32, 4, 4, BYTES}, {1, 1, 1, BYTES}, {1, 4, 4, COLUMN_SUMS}}},
    {"hsl_range", run_hsl_range, {{32, 4, 4, BYTES}, {1, 3, 1, BYTES}}},
};
enum { CASES = sizeof cases / sizeof cases[0] };

static size_t row_bytes(const operand *row, const settings *with, int32_t n)
{
    if (row->per == 0 || n == 0) {
        return 0;
    }
    int32_t pixels = n + (row->content == COLUMN_SUMS ? with->window.side - 1 : 0);
    return (size_t)(pixels + row->per - 1) / (size_t)row->per * (size_t)row->bytes;
}

/* ---- adversarial content ---- */

static uint32_t random_state = 1;

static uint32_t random_below(uint32_t end)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)random_state * end >> 32);
}

static void fill_bytes(uint8_t *row, size_t bytes, uint8_t limit)
{
    uint32_t kind = random_below(8), step = 1 + random_below(7), base = random_below(250);
    uint8_t run = 0;
    for (size_t i = 0; i < bytes; i++) {
        run = random_below(6) == 0 ? (uint8_t)(255 - run) : run;
        row[i] = (uint8_t)(kind == 0   ? 0
                           : kind == 1 ? 255
                           : kind == 2 ? run
                           : kind == 3 ? i * step
                           : kind == 4 ? limit + random_below(3) - 1
                           : kind == 5 ? base + random_below(6)
                                       : random_below(256));
    }
}

static void fill_words(uint8_t *row, size_t bytes, uint32_t end)
{
    uint32_t kind = random_below(4), level = random_below(256);
    for (size_t i = 0; i < bytes / 4; i++) {
        uint32_t word = kind == 0   ? 0
                        : kind == 1 ? end - 1
                        : kind == 2 ? (end - 1) / 255 * level /* the mean is this level exactly */
                                    : random_below(end);
        memcpy(row + 4 * i, &word, 4);
    }
}

static void fill(uint8_t *row, size_t bytes, const operand *kind, const settings *with)
{
    if (kind->content == BYTES) {
        fill_bytes(row, bytes, with->limit);
    } else {
        fill_words(row, bytes, kind->content == SUMS ? UINT32_MAX : 255u * (uint32_t)with->window.side + 1);
    }
}

static settings random_settings(void)
{
    static const uint8_t limits[] = {0, 1, 127, 128, 254, 255};
    static const int32_t sides[] = {1, 3, 5, 15, 25, 101, 1023, 2047};
    static const int32_t levels[] = {-255, -1, 0, 1, 20, 255};
    static const int32_t hues[] = {0, 1, 59, 60, 61, 120, 180, 239, 240, 299, 300, 359, 360};
    settings with = {.limit = limits[random_below(6)],
                     .window = {sides[random_below(8)], levels[random_below(6)]}};
    if (random_below(2)) {
        with.limit = (uint8_t)random_below(256);
        with.window.c = (int32_t)random_below(511) - 255;
    }
    iris_hsl_range range = {hues[random_below(13)], hues[random_below(13)], 0, 100, 0, 100};
    if (random_below(2)) {
        range.s0 = (int32_t)random_below(60);
        range.s1 = 100 - (int32_t)random_below(40);
        range.l0 = (int32_t)random_below(40);
        range.l1 = 100 - (int32_t)random_below(60);
    }
    assert_int_equal(iris_hsl_range_prepare(&with.range, &range), IRIS_OK);
    return with;
}

/* ---- one comparison ---- */

enum { AROUND = 64, ROOM = 1 << 14 };

/* Memory between two pages that cannot be touched. */
static struct {
    uint8_t *start;
    size_t bytes;
} guarded[OPERANDS];

static int guard_rows(void **state)
{
    (void)state;
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    size_t bytes = (ROOM + page - 1) / page * page;
    for (int k = 0; k < OPERANDS; k++) {
        uint8_t *map =
            mmap(NULL, bytes + 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (map == MAP_FAILED || mprotect(map, page, PROT_NONE) != 0 ||
            mprotect(map + page + bytes, page, PROT_NONE) != 0) {
            return -1;
        }
        guarded[k].start = map + page;
        guarded[k].bytes = bytes;
    }
    return 0;
}

/* Where the rows begin: offsets into the guarded memory. */
typedef struct {
    size_t offset[OPERANDS];
} placement;

/* The bytes in front of and behind a row that are checked too, as far as there are any. */
static uint8_t *window_of(int k, size_t offset, size_t bytes, size_t *window_bytes)
{
    size_t first = offset < AROUND ? 0 : offset - AROUND;
    size_t end = offset + bytes + AROUND > guarded[k].bytes ? guarded[k].bytes : offset + bytes + AROUND;
    *window_bytes = end - first;
    return guarded[k].start + first;
}

/* Runs one body on guarded rows and the plain one on a copy; all bytes of both, and around, must be the same. */
static void compare(const kernel_case *c, int plain, placement at, const settings *with, int32_t n)
{
    static uint32_t copies[OPERANDS][ROOM / 4];
    uint8_t *rows[OPERANDS], *copied_rows[OPERANDS], *windows[OPERANDS];
    size_t sizes[OPERANDS];
    for (int k = 0; k < OPERANDS; k++) {
        size_t bytes = row_bytes(&c->operands[k], with, n);
        rows[k] = guarded[k].start + at.offset[k];
        windows[k] = window_of(k, at.offset[k], bytes, &sizes[k]);
        if (bytes > 0) {
            fill_bytes(windows[k], sizes[k], 0);
            fill(rows[k], bytes, &c->operands[k], with);
        }
        copied_rows[k] = (uint8_t *)copies[k] + 64 + at.offset[k] % 4;
        memcpy(copied_rows[k] - (rows[k] - windows[k]), windows[k], sizes[k]);
    }
    c->run(plain, rows, with, n);
    c->run(1, copied_rows, with, n);
    for (int k = 0; k < OPERANDS; k++) {
        if (memcmp(copied_rows[k] - (rows[k] - windows[k]), windows[k], sizes[k]) != 0) {
            fail_msg("%s %s, row %d of %d pixels at offset %d", plain ? "plain" : IRIS_PORT_NAME, c->name, k,
                     (int)n, (int)at.offset[k]);
        }
    }
}

static void every_width_and_alignment_gives_the_plain_bits(void **state)
{
    (void)state;
    for (int i = 0; i < CASES; i++) {
        for (int32_t n = 0; n < WIDTHS; n++) {
            for (size_t alignment = 0; alignment < 32; alignment++) {
                settings with = random_settings();
                placement at;
                size_t varied = (size_t)n % OPERANDS; /* this row is at `alignment`, the others anywhere */
                for (size_t k = 0; k < OPERANDS; k++) {
                    size_t offset = k == varied ? alignment : random_below(32);
                    int32_t align = cases[i].operands[k].align;
                    at.offset[k] = 64 + (align > 1 ? offset / (size_t)align * (size_t)align : offset);
                }
                compare(&cases[i], 0, at, &with, n);
            }
        }
    }
}

static void rows_flush_against_unreadable_pages(void **state)
{
    (void)state;
    for (int i = 0; i < CASES; i++) {
        for (int32_t n = 0; n < WIDTHS; n++) {
            for (int round = 0; round < 8; round++) {
                settings with = random_settings();
                placement at;
                for (int k = 0; k < OPERANDS; k++) {
                    size_t bytes = row_bytes(&cases[i].operands[k], &with, n);
                    int at_start = round & 2;
                    at.offset[k] = at_start ? 0 : guarded[k].bytes - bytes;
                }
                compare(&cases[i], round & 1, at, &with, n);
            }
        }
    }
}

/* ---- colors, where the comparison is finer than random rows find ---- */

static void hsl_range_of_many_colors(void **state)
{
    (void)state;
    static const iris_hsl_range ranges[] = {{0, 360, 0, 100, 0, 100},  {350, 10, 30, 100, 20, 80},
                                            {40, 70, 40, 100, 25, 75}, {60, 60, 0, 100, 0, 100},
                                            {120, 240, 1, 99, 1, 99},  {300, 299, 0, 50, 40, 60},
                                            {90, 330, 33, 67, 0, 50},  {200, 180, 10, 90, 50, 100}};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        iris_hsl_range_test test;
        assert_int_equal(iris_hsl_range_prepare(&test, &ranges[i]), IRIS_OK);
        for (int r = 0; r < 256; r += 5) {
            for (int g = 0; g < 256; g += 3) {
                uint8_t rgb[3 * 256];
                uint32_t plain[8], port[8];
                for (int b = 0; b < 256; b++) {
                    rgb[3 * b] = (uint8_t)r;
                    rgb[3 * b + 1] = (uint8_t)g;
                    rgb[3 * b + 2] = (uint8_t)b;
                }
                iris_row_hsl_range_c(plain, rgb, &test, 256);
                iris_row_hsl_range(port, rgb, &test, 256);
                assert_memory_equal(plain, port, sizeof plain);
            }
        }
    }
}

/* ---- truths worked out by hand, on both bodies: 53 pixels are whole vectors and a tail ---- */

enum { N = 53, MASK_WORDS = 2 };

#define BOTH_BODIES(plain) for (int plain = 0; plain < 2; plain++)

static int bit(const uint32_t *mask, int32_t i)
{
    return (int)(mask[i / 32] >> i % 32 & 1u);
}

static void truth_of_luma(void **state)
{
    (void)state;
    static const uint8_t colors[6][3] = {{255, 255, 255}, {0, 0, 0},   {255, 0, 0},
                                         {0, 255, 0},     {0, 0, 255}, {1, 2, 3}};
    static const uint8_t as_rgb[6] = {255, 0, 77, 149, 29, 2}, as_bgr[6] = {255, 0, 29, 149, 77, 2};
    uint8_t src[3 * N], dst[N];
    for (int i = 0; i < N; i++) {
        memcpy(src + 3 * i, colors[i % 6], 3);
    }
    uint8_t *rows[] = {dst, src};
    BOTH_BODIES(plain)
    {
        run_luma_rgb888(plain, rows, NULL, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], as_rgb[i % 6]);
        }
        run_luma_bgr888(plain, rows, NULL, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], as_bgr[i % 6]);
        }
    }
}

static void truth_of_swap(void **state)
{
    (void)state;
    uint8_t src[3 * N], dst[3 * N], *rows[] = {dst, src};
    for (int i = 0; i < 3 * N; i++) {
        src[i] = (uint8_t)i;
    }
    BOTH_BODIES(plain)
    {
        run_swap(plain, rows, NULL, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[3 * i], 3 * i + 2);
            assert_int_equal(dst[3 * i + 1], 3 * i + 1);
            assert_int_equal(dst[3 * i + 2], 3 * i);
        }
        run_swap_in_place(plain, rows, NULL, N);
        assert_memory_equal(dst, src, sizeof src);
    }
}

static void truth_of_above(void **state)
{
    (void)state;
    static const uint8_t pattern[4] = {99, 100, 101, 255};
    static const struct {
        uint8_t limit, bits; /* one for each of the pattern */
    } expected[] = {{100, 12}, {0, 15}, {98, 15}, {254, 8}, {255, 0}};
    uint8_t src[N];
    for (int i = 0; i < N; i++) {
        src[i] = pattern[i % 4];
    }
    BOTH_BODIES(plain)
    {
        for (size_t e = 0; e < sizeof expected / sizeof expected[0]; e++) {
            uint32_t mask[MASK_WORDS] = {0x12345678u, 0xffffffffu};
            uint8_t *rows[] = {(uint8_t *)mask, src};
            settings with = {.limit = expected[e].limit};
            run_above(plain, rows, &with, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(bit(mask, i), expected[e].bits >> i % 4 & 1);
            }
            assert_int_equal(mask[1] >> (N - 32), 0xffffffffu >> (N - 32));
        }
    }
}

static void truth_of_scan8(void **state)
{
    (void)state;
    uint8_t src[N];
    for (int i = 0; i < N; i++) {
        src[i] = (uint8_t)(i % 8 * 36); /* 0, 36, ... 252 */
    }
    static const uint8_t limits[7] = {0, 1, 36, 37, 252, 253, 100}, below[7] = {0, 1, 1, 3, 127, 255, 7};
    BOTH_BODIES(plain)
    {
        iris_block8 blocks[7];
        for (int b = 0; b < 7; b++) {
            blocks[b] = (iris_block8){0xffff, limits[b], 0xaa};
        }
        uint8_t *rows[] = {(uint8_t *)blocks, src};
        run_scan8(plain, rows, NULL, N);
        for (int b = 0; b < 7; b++) {
            assert_int_equal(blocks[b].sum, b < 6 ? 28 * 36 : 10 * 36); /* the last has 5 pixels */
            assert_int_equal(blocks[b].below, below[b]);
            assert_int_equal(blocks[b].limit, limits[b]);
        }
    }
}

static void truth_of_slide(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint32_t sums[N];
        uint8_t enter[N], leave[N], *rows[] = {(uint8_t *)sums, enter, leave};
        for (int i = 0; i < N; i++) {
            sums[i] = i % 3 == 0 ? 1000u : i % 3 == 1 ? 0u : 0xffffffffu;
            enter[i] = i % 3 == 1 ? 0 : 255;
            leave[i] = i % 3 == 2 ? 254 : 255;
        }
        run_slide(plain, rows, NULL, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(sums[i], i % 3 == 0 ? 1000u : i % 3 == 1 ? 0xffffff01u : 0u);
        }
    }
}

/* Columns that rise by 9 * k: over 3 of them and 3 rows the mean at pixel i is 3 (i + 1). */
static void truth_of_above_mean(void **state)
{
    (void)state;
    uint32_t sums[N + 2];
    uint8_t src[N];
    for (uint32_t i = 0; i < N + 2; i++) {
        sums[i] = 9 * i;
    }
    for (int i = 0; i < N; i++) {
        src[i] = (uint8_t)(3 * (i + 1) + i % 3 - 1); /* one below, at, and above the mean */
    }
    BOTH_BODIES(plain)
    {
        for (int c = -2; c <= 2; c++) {
            uint32_t mask[MASK_WORDS] = {0, 0};
            uint8_t *rows[] = {(uint8_t *)mask, src, (uint8_t *)sums};
            settings with = {.window = {3, c}};
            run_above_mean(plain, rows, &with, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(bit(mask, i), i % 3 - 1 > -c);
            }
            assert_int_equal(mask[1] >> (N - 32), 0);
        }
    }
}

static void truth_of_hsl_range(void **state)
{
    (void)state;
    static const struct {
        uint8_t rgb[3];
        int in; /* bit 0: red 350-10, S 50-100, L 20-80; bit 1: 60-240, S 0-100, L 0-100 */
    } colors[] = {{{255, 0, 0}, 1},     {{255, 0, 42}, 1},  {{255, 0, 43}, 0},    {{255, 42, 0}, 1},
                  {{255, 43, 0}, 0},    {{255, 255, 0}, 2}, {{255, 254, 0}, 0},   {{0, 255, 0}, 2},
                  {{0, 0, 255}, 2},     {{1, 0, 255}, 0},   {{0, 255, 255}, 2},   {{255, 0, 255}, 0},
                  {{128, 128, 128}, 0}, {{0, 0, 0}, 0},     {{102, 0, 0}, 1},     {{101, 0, 0}, 0},
                  {{150, 50, 50}, 1},   {{150, 51, 51}, 0}, {{255, 153, 153}, 1}, {{255, 154, 154}, 0}};
    enum { COLORS = sizeof colors / sizeof colors[0] };
    static const iris_hsl_range ranges[2] = {{350, 10, 50, 100, 20, 80}, {60, 240, 0, 100, 0, 100}};
    uint8_t src[3 * N];
    for (int i = 0; i < N; i++) {
        memcpy(src + 3 * i, colors[i % COLORS].rgb, 3);
    }
    BOTH_BODIES(plain)
    {
        for (int k = 0; k < 2; k++) {
            uint32_t mask[MASK_WORDS] = {0, 0xffffffffu};
            uint8_t *rows[] = {(uint8_t *)mask, src};
            settings with = {0};
            assert_int_equal(iris_hsl_range_prepare(&with.range, &ranges[k]), IRIS_OK);
            run_hsl_range(plain, rows, &with, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(bit(mask, i), colors[i % COLORS].in >> k & 1);
            }
            assert_int_equal(mask[1] >> (N - 32), 0xffffffffu >> (N - 32));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_port_overrides_what_it_says),
        cmocka_unit_test(every_kernel_is_in_this_test),
        cmocka_unit_test(every_width_and_alignment_gives_the_plain_bits),
        cmocka_unit_test(rows_flush_against_unreadable_pages),
        cmocka_unit_test(hsl_range_of_many_colors),
        cmocka_unit_test(truth_of_luma),
        cmocka_unit_test(truth_of_swap),
        cmocka_unit_test(truth_of_above),
        cmocka_unit_test(truth_of_scan8),
        cmocka_unit_test(truth_of_slide),
        cmocka_unit_test(truth_of_above_mean),
        cmocka_unit_test(truth_of_hsl_range),
    };
    return cmocka_run_group_tests_name("kernels " IRIS_PORT_NAME, tests, guard_rows, NULL);
}
