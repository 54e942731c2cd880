#include "calls.h"

#include <stdio.h>

#include "test.h"

#if defined(IRIS_CHECKED)
#include <sanitizer/asan_interface.h>
#define FORBID(start, bytes) __asan_poison_memory_region(start, bytes)
#define ALLOW(start, bytes)  __asan_unpoison_memory_region(start, bytes)
#else
#define FORBID(start, bytes) ((void)(start), (void)(bytes))
#define ALLOW(start, bytes)  ((void)(start), (void)(bytes))
#endif

enum { POOL = 1 << 20, VIEWS = 16, BLOCKS = 4096, MARGIN = 64 };

typedef enum { SCRATCH_UNKNOWN, SCRATCH_ENOUGH, SCRATCH_SHORT } scratch_kind;

/* Everything that a call gets, and what is known about it; aligned as scratch is to be. */
static struct __attribute__((aligned(IRIS_SCRATCH_ALIGN))) {
    union {
        uint8_t bytes[POOL];
        uint64_t words[POOL / 8];
    } now, before,  /* the memory, and as it was before the call */
        may_change, /* the bits that a call may change unless it is refused */
        may_always;
    size_t used;
    struct {
        uint8_t *start;
        size_t bytes;
    } readable[BLOCKS];
    int blocks;
    iris_image views[VIEWS];
    int is_output[VIEWS], view_count;
    iris_scratch scratch;
    size_t scratch_used;
    scratch_kind kind;
    int has_scratch, keeps_scratch, overlaps, is_wrong;
    uint64_t random;
    const uint8_t *choices; /* what the draws are, as long as there are any */
    size_t choice_bytes;
    uint32_t number;
    const char *name;
    int accepted;
} world;

/* ---- numbers ---- */

/* Splitmix64: S. Vigna, 2015. */
static uint64_t noise(void)
{
    uint64_t z = world.random += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static uint64_t next_random(void)
{
    if (world.choice_bytes < 2) {
        return noise();
    }
    uint64_t choice = world.choices[0] | (uint64_t)world.choices[1] << 8;
    world.choices += 2;
    world.choice_bytes -= 2;
    return choice * 0x0001000100010001u;
}

uint32_t draw_below(uint32_t end)
{
    return (uint32_t)((next_random() >> 32) * end >> 32);
}

int draw_chance(uint32_t one_in)
{
    return draw_below(one_in) == 0;
}

int32_t draw_within(int32_t low, int32_t high)
{
    return (int32_t)(low + (int64_t)(((next_random() >> 32) * (uint64_t)((int64_t)high - low + 1)) >> 32));
}

int32_t draw_int(int32_t low, int32_t high)
{
    const int32_t extremes[] = {
        INT32_MIN, INT32_MAX, low == INT32_MIN ? low : low - 1, high == INT32_MAX ? high : high + 1, 0,
        -1,        1};
    switch (draw_below(12)) {
    case 0:
        return extremes[draw_below(7)];
    case 1:
        return low;
    case 2:
        return high;
    default:
        return draw_within(low, high);
    }
}

iris_size draw_size(void)
{
    int32_t most = draw_chance(2) ? 20 : 70;
    iris_size size = {draw_within(1, most), draw_within(1, draw_chance(2) ? most : 70)};
    if (draw_chance(60)) {
        *(draw_chance(2) ? &size.w : &size.h) = 0;
    }
    return size;
}

iris_format draw_format(void)
{
    return (iris_format)draw_within(IRIS_GRAY8, IRIS_HSL48);
}

iris_format draw_either(iris_format a, iris_format b)
{
    return draw_chance(2) ? a : b;
}

iris_format draw_gray_or_color(void)
{
    return draw_chance(2) ? IRIS_GRAY8 : draw_either(IRIS_RGB888, IRIS_BGR888);
}

iris_border draw_border(void)
{
    return (iris_border){(iris_border_rule)draw_int(IRIS_BORDER_REPLICATE, IRIS_BORDER_SKIP),
                         (uint8_t)draw_below(256)};
}

/* ---- memory ---- */

/* Bytes of one kind: constant, two levels in runs, a ramp, or noise. */
static void fill(uint8_t *bytes, size_t count)
{
    uint32_t kind = draw_below(6), step = draw_below(8), level = draw_below(256);
    for (size_t i = 0; i < count; i++) {
        if (kind == 1 && noise() % 8 == 0) {
            level = 255 - level;
        }
        bytes[i] = (uint8_t)(kind < 2 ? level : kind == 2 ? i * step : noise());
    }
}

/* Memory with room in front and behind that nobody may touch. */
static uint8_t *take(size_t bytes, size_t room)
{
    size_t first = (world.used + room + 15) / 16 * 16;
    if (first + bytes + room > POOL) {
        fail_msg("call %lu, %s: needs more memory than tests/calls has", (unsigned long)world.number,
                 world.name);
    }
    for (size_t i = world.used / 8; i < (first + bytes + room + 7) / 8; i++) {
        world.now.words[i] = i * 8 < world.used ? world.now.words[i] : noise();
    }
    world.used = first + bytes + room;
    return world.now.bytes + first;
}

static void let_read(uint8_t *start, size_t bytes)
{
    assert_true(world.blocks < BLOCKS);
    assert_true(start >= world.now.bytes && start + bytes <= world.now.bytes + world.used);
    world.readable[world.blocks].start = start;
    world.readable[world.blocks++].bytes = bytes;
}

static void let_change(uint8_t *bits, const uint8_t *start, size_t bytes)
{
    memset(bits + (start - world.now.bytes), 0xff, bytes);
}

static uint8_t *block_of(const void *data, size_t bytes)
{
    uint8_t *block = take(bytes, MARGIN);
    if (data) {
        memcpy(block, data, bytes);
    } else {
        fill(block, bytes);
    }
    let_read(block, bytes);
    return block;
}

void *draw_given(const void *data, size_t bytes)
{
    return block_of(data, bytes);
}

void *draw_results(size_t bytes)
{
    uint8_t *block = block_of(NULL, bytes);
    let_change(world.may_change.bytes, block, bytes);
    return block;
}

void *draw_state(const void *data, size_t bytes)
{
    uint8_t *block = block_of(data, bytes);
    let_change(world.may_always.bytes, block, bytes);
    return block;
}

iris_scratch *draw_scratch(size_t needed)
{
    uint32_t roll = draw_below(16);
    size_t taken = roll >= 12 && roll < 14 ? 16 * draw_below(4) : 0, bytes = needed;
    world.kind = SCRATCH_ENOUGH;
    if (needed > POOL / 2 || roll == 0) {
        world.kind = SCRATCH_UNKNOWN;
        bytes = draw_below(2000);
    } else if (roll < 3) {
        world.kind = needed > 0 ? SCRATCH_SHORT : SCRATCH_ENOUGH;
        bytes = needed > 0 ? roll == 1 ? needed - 1 : draw_below((uint32_t)needed) : 0;
    } else if (roll >= 12) {
        bytes = needed + taken + draw_below(100);
    }
    uint8_t *memory = take(bytes, MARGIN);
    let_read(memory, bytes);
    let_change(world.may_always.bytes, memory, bytes);
    assert_int_equal(iris_scratch_init(&world.scratch, memory, bytes), IRIS_OK);
    if (world.kind == SCRATCH_ENOUGH) {
        assert_non_null(iris_scratch_take(&world.scratch, taken));
    }
    world.scratch_used = world.scratch.used;
    world.has_scratch = 1;
    if (draw_chance(60)) {
        world.is_wrong = 1;
        return NULL;
    }
    return &world.scratch;
}

iris_scratch *draw_scratch_up_to(size_t most)
{
    iris_scratch *scratch = draw_scratch(most);
    world.kind = SCRATCH_UNKNOWN;
    return scratch;
}

void draw_scratch_is_kept(void)
{
    world.keeps_scratch = 1;
}

/* ---- views ---- */

static size_t unit_of(iris_format format)
{
    switch (format) {
    case IRIS_GRAY_U32:
    case IRIS_MASK1:
        return 4;
    case IRIS_GRAY_S16:
    case IRIS_GRAY_U16:
    case IRIS_RGB565:
    case IRIS_RGB565_SWAP:
    case IRIS_HSL48:
        return 2;
    default:
        return 1;
    }
}

/* A view of memory of its own: rows packed or with padding, top first or bottom first, at any address that will do. */
static iris_image fresh(iris_format format, iris_size size)
{
    size_t row = iris_format_row_bytes(format, size.w), unit = unit_of(format);
    size_t stride = row + (draw_chance(2) ? unit * draw_below(12) : 0);
    size_t rows = (size_t)(size.h > 0 ? size.h : 1);
    size_t offset = unit * draw_below((uint32_t)(16 / unit));
    uint8_t *memory = take(stride * rows + 16, stride + MARGIN) + offset;
    fill(memory, stride * rows);
    iris_image image = {memory, (ptrdiff_t)stride, size.w, size.h, format};
    if (draw_chance(4)) {
        image.data = memory + stride * (rows - 1);
        image.stride = -image.stride;
    }
    return image;
}

/* Memory of a view drawn before: the same pixels, the same but one row or a few bytes further, or as another format. */
static int shared(iris_image *image, iris_format format, iris_size size)
{
    iris_image other = world.views[draw_below((uint32_t)world.view_count)];
    if (other.w != size.w || other.h != size.h ||
        iris_format_row_bytes(format, size.w) > iris_format_row_bytes(other.format, size.w) ||
        unit_of(format) > unit_of(other.format)) {
        return 0;
    }
    *image = other;
    image->format = format;
    uint32_t roll = draw_below(6);
    if (roll == 0 && image->stride > -POOL && image->stride < POOL) {
        image->data = (uint8_t *)image->data + (draw_chance(2) ? image->stride : -image->stride);
    } else if (roll == 1) {
        image->data = (uint8_t *)image->data + 4 * draw_within(-4, 4);
    }
    return 1;
}

static void spoil(iris_image *image)
{
    static const int32_t sides[] = {0, -1, INT32_MIN, INT32_MAX, IRIS_SIDE_MAX + 1};
    static const ptrdiff_t strides[] = {0, 1, -1, PTRDIFF_MIN, PTRDIFF_MAX, PTRDIFF_MAX - 3};
    static const int formats[] = {0, -1, IRIS_HSL48 + 1, INT32_MAX, INT32_MIN};
    switch (draw_below(5)) {
    case 0:
        image->data = NULL;
        break;
    case 1:
        *(draw_chance(2) ? &image->w : &image->h) = sides[draw_below(5)];
        break;
    case 2:
        image->stride = strides[draw_below(6)];
        break;
    case 3:
        image->format = (iris_format)formats[draw_below(5)];
        break;
    default:
        image->data = (uint8_t *)image->data + 1;
        break;
    }
}

/* What a call may read of a view, and change of an output. */
static void register_view(const iris_image *image, int is_output)
{
    size_t row = iris_format_row_bytes(image->format, image->w);
    for (int32_t y = 0; y < image->h; y++) {
        uint8_t *start = iris_image_row(image, y);
        let_read(start, row);
        if (is_output) {
            uint8_t *bits = world.may_change.bytes + (start - world.now.bytes);
            size_t whole = image->format == IRIS_MASK1 ? (size_t)image->w / 32 * 4 : row;
            memset(bits, 0xff, whole);
            if (whole < row) {
                uint32_t word;
                memcpy(&word, bits + whole, sizeof word);
                word |= ((uint32_t)1 << image->w % 32) - 1;
                memcpy(bits + whole, &word, sizeof word);
            }
        }
    }
}

static const iris_image *draw_view(iris_format format, iris_size size, int is_output)
{
    iris_image image;
    uint32_t roll = draw_below(200);
    if (roll < 14) {
        world.is_wrong = 1;
    }
    if (roll < 2) {
        return NULL;
    }
    if (roll < 6) {
        size.w += draw_within(-1, 1);
        size.h += draw_within(-1, 1);
    } else if (roll < 10) {
        format = draw_format();
    }
    if (world.view_count == 0 || !draw_chance(5) || !shared(&image, format, size)) {
        image = fresh(format, size);
    }
    if (roll >= 10 && roll < 14) {
        spoil(&image);
    }
    if (iris_image_check(&image) == IRIS_OK) {
        assert_true(world.view_count < VIEWS);
        world.is_output[world.view_count] = is_output;
        world.views[world.view_count++] = image;
        register_view(&image, is_output);
    }
    return draw_given(&image, sizeof image);
}

const iris_image *draw_input(iris_format format, iris_size size)
{
    return draw_view(format, size, 0);
}

const iris_image *draw_output(iris_format format, iris_size size)
{
    return draw_view(format, size, 1);
}

void draw_overlap_is_fine(void)
{
    world.overlaps = 1;
}

/* ---- the call ---- */

void calls_start(uint32_t number, const char *name)
{
    ALLOW(world.now.bytes, POOL);
    memset(world.may_change.bytes, 0, world.used);
    memset(world.may_always.bytes, 0, world.used);
    world.used = 0;
    world.blocks = world.view_count = 0;
    world.has_scratch = world.keeps_scratch = world.overlaps = world.is_wrong = 0;
    world.random = number;
    world.choice_bytes = 0;
    world.number = number;
    world.name = name;
    world.accepted = 0;
}

void calls_choose(const uint8_t *choices, size_t bytes)
{
    world.choices = choices;
    world.choice_bytes = bytes;
}

int calls_accepted(void)
{
    return world.accepted;
}

void calls_begin(void)
{
    (void)take(0, MARGIN);
    memcpy(world.before.bytes, world.now.bytes, world.used);
    FORBID(world.now.bytes, world.used);
    for (int i = 0; i < world.blocks; i++) {
        ALLOW(world.readable[i].start, world.readable[i].bytes);
    }
}

static void report(iris_status status, const char *what, long where)
{
    fail_msg("call %lu, %s, which returned %d (%s): %s %ld", (unsigned long)world.number, world.name,
             (int)status, iris_status_text(status), what, where);
}

static void check_scratch(iris_status status, int refused)
{
    if (world.scratch.used != world.scratch_used && (refused || !world.keeps_scratch)) {
        report(status, "working memory is not given back", (long)world.scratch.used);
    }
    if (!world.is_wrong && world.kind == SCRATCH_ENOUGH && status == IRIS_ERR_SCRATCH) {
        report(status, "working memory was enough:", (long)world.scratch.bytes);
    }
    if (!world.is_wrong && world.kind == SCRATCH_SHORT && status == IRIS_OK) {
        report(status, "working memory was too small:", (long)world.scratch.bytes);
    }
}

/* An accepted call's outputs are one of its views or disjoint from them. */
static void check_overlap(iris_status status)
{
    for (int i = 0; i < world.view_count; i++) {
        for (int k = 0; k < world.view_count && world.is_output[i]; k++) {
            const iris_image *a = &world.views[i], *b = &world.views[k];
            int same = a->data == b->data && (a->stride == b->stride || a->h == 1);
            if (k != i && !same && iris_image_overlaps(a, b)) {
                report(status, "works with a view that overlaps its output: view", k);
            }
        }
    }
}

void calls_end(iris_status status)
{
    int refused = status >= IRIS_ERR_ARG && status <= IRIS_ERR_SCRATCH;
    ALLOW(world.now.bytes, world.used);
    if ((int)status < 0 || status > IRIS_ERR_TIMEOUT) {
        report(status, "no status:", status);
    }
    world.accepted = !refused;
    if (!refused && !world.overlaps) {
        check_overlap(status);
    }
    for (size_t i = 0; i < (world.used + 7) / 8; i++) {
        uint64_t may = world.may_always.words[i] | (refused ? 0 : world.may_change.words[i]);
        if ((world.now.words[i] ^ world.before.words[i]) & ~may) {
            report(status, "changed what it may not, at byte", (long)i * 8);
        }
    }
    if (world.has_scratch) {
        check_scratch(status, refused);
    }
}
