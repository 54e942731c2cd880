/* The follower by color signatures: it takes the pixels that iris_signature_row takes. */
#include "iris/xt/follow.h"

#include <string.h>

#include "../picture.h"

enum { W = 18, H = 16, LINE = 7, LINE_END = 12 };

static iris_signatures signatures;
static IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_SIGNATURE_SCRATCH_BYTES(W, H));

typedef struct {
    uint8_t y, u, v;
} color;

static void put(uint8_t *row, int32_t x, color c, iris_format format)
{
    int luma = format == IRIS_UYVY;
    row[2 * x + luma] = c.y;
    row[2 * (x & ~1) + 1 - luma] = c.u;
    row[2 * (x & ~1) + 3 - luma] = c.v;
}

/* The line lies in columns of whole pairs, but for its first and last one, whose luminance alone is of the line. */
static void paint(uint8_t *row, color floor, color line, iris_format format)
{
    for (int32_t x = 0; x < W; x++) {
        put(row, x, x / 2 >= LINE / 2 && x / 2 <= LINE_END / 2 ? line : floor, format);
    }
    row[2 * (LINE - 1) + (format == IRIS_UYVY)] = floor.y;
    row[2 * (LINE_END + 1) + (format == IRIS_UYVY)] = floor.y;
}

static iris_follow_config config_of(iris_format format)
{
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_COLOR;
    config.format = format;
    return config;
}

static iris_follow follower(iris_format format, uint32_t selected)
{
    iris_follow follow;
    iris_scratch scratch;
    iris_follow_config config = config_of(format);
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, sizeof memory.memory), IRIS_OK);
    assert_int_equal(
        iris_follow_init_signature(&follow, (iris_size){W, H}, &config, &signatures, selected, &scratch),
        IRIS_OK);
    return follow;
}

/* Shows the follower H times the row; each span must be that of the pixels that have the signatures. */
static int assert_spans(iris_follow *follow, const uint8_t *row, iris_format format, uint32_t selected)
{
    uint8_t has[W];
    iris_follow_result result;
    assert_int_equal(iris_signature_row(has, row, format, W, &signatures), IRIS_OK);
    int32_t left = W, right = -1;
    for (int32_t x = 0; x < W; x++) {
        if (has[x] & selected) {
            left = x < left ? x : left;
            right = x;
        }
    }
    assert_int_equal(iris_follow_begin(follow), IRIS_OK);
    for (int32_t y = 0; y < H; y++) {
        assert_int_equal(iris_follow_row(follow, row), IRIS_OK);
    }
    iris_follow_forget(follow);
    assert_int_equal(iris_follow_end(&result, follow, 0), IRIS_OK);
    int is_line = (has[LINE] & selected) != 0;
    if (is_line || right < left) { /* not the two edges alone */
        assert_int_equal(result.state, is_line ? IRIS_LINE_FOUND : IRIS_LINE_LOST);
    }
    for (int32_t y = 0; is_line && y < H; y++) {
        assert_int_equal(result.rows[y].left, left);
        assert_int_equal(result.rows[y].right, right);
    }
    return is_line;
}

/* Every Y, on tables in which half of the cells are selected: the floor's color is one that is not. */
static void every_luminance_with_many_colors(void **state)
{
    (void)state;
    uint32_t seed = 5;
    const color floor = {16, 128, 128};
    int lines = 0;
    for (int round = 0; round < 200; round++) {
        const uint32_t selected = 1u + next_random(&seed) % 255u;
        const iris_format format = round % 2 ? IRIS_UYVY : IRIS_YUYV;
        for (int32_t i = 0; i < IRIS_SIGNATURE_CELLS; i++) {
            signatures.cells[i] = (uint8_t)(next_random(&seed) % 2 ? next_random(&seed) : ~selected);
        }
        signatures.cells[(10 * 21 + 10) * 9] = (uint8_t)~selected; /* black */
        iris_follow follow = follower(format, selected);
        const uint8_t u = (uint8_t)next_random(&seed), v = (uint8_t)next_random(&seed);
        for (int32_t y = 0; y < 256; y++) {
            uint8_t row[2 * W];
            paint(row, floor, (color){(uint8_t)y, u, v}, format);
            lines += assert_spans(&follow, row, format, selected);
        }
    }
    assert_true(lines > 5000);
}

static void the_table_is_not_kept(void **state)
{
    (void)state;
    uint8_t row[2 * W];
    memset(&signatures, 0, sizeof signatures);
    memset(signatures.cells + (15 * 21 + 5) * 9, 4, 9);
    iris_follow follow = follower(IRIS_YUYV, 4);
    paint(row, (color){90, 128, 128}, (color){90, 150, 106}, IRIS_YUYV);
    assert_true(assert_spans(&follow, row, IRIS_YUYV, 4));
    memset(&signatures, 0, sizeof signatures);
    iris_follow_result result;
    assert_int_equal(iris_follow_begin(&follow), IRIS_OK);
    for (int32_t y = 0; y < H; y++) {
        assert_int_equal(iris_follow_row(&follow, row), IRIS_OK);
    }
    assert_int_equal(iris_follow_end(&result, &follow, 0), IRIS_OK);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
}

static iris_status init(iris_size size, const iris_follow_config *config, uint32_t selected, size_t bytes)
{
    iris_follow follow;
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return iris_follow_init_signature(&follow, size, config, &signatures, selected, &scratch);
}

static void wrong_calls_and_too_little_memory_are_refused(void **state)
{
    (void)state;
    const iris_size size = {W, H};
    const size_t bytes = IRIS_FOLLOW_SIGNATURE_SCRATCH_BYTES(W, H);
    iris_follow_config config = config_of(IRIS_YUYV);
    assert_int_equal(init(size, &config, 1, bytes), IRIS_OK);
    assert_int_equal(init(size, &config, 255, bytes), IRIS_OK);
    assert_int_equal(init(size, &config, 1, bytes - 1), IRIS_ERR_SCRATCH);
    assert_int_equal(init(size, &config, 0, bytes), IRIS_ERR_ARG);
    assert_int_equal(init(size, &config, 256, bytes), IRIS_ERR_ARG);
    assert_int_equal(init(size, NULL, 1, bytes), IRIS_ERR_ARG);
    assert_int_equal(init((iris_size){W - 1, H}, &config, 1, bytes), IRIS_ERR_RANGE);
    assert_int_equal(init((iris_size){6, H}, &config, 1, bytes), IRIS_ERR_RANGE);
    config.lane = 1;
    assert_int_equal(init(size, &config, 1, bytes), IRIS_ERR_UNSUPPORTED);
    config = config_of(IRIS_RGB888);
    assert_int_equal(init(size, &config, 1, bytes), IRIS_ERR_FORMAT);
    config = config_of(IRIS_YUYV);
    config.kind = IRIS_FOLLOW_DARK;
    assert_int_equal(init(size, &config, 1, bytes), IRIS_ERR_FORMAT);
    config = config_of(IRIS_YUYV);
    config.contrast_permil = 0;
    assert_int_equal(init(size, &config, 1, bytes), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_init_signature(NULL, size, &config, &signatures, 1, NULL), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_luminance_with_many_colors),
        cmocka_unit_test(the_table_is_not_kept),
        cmocka_unit_test(wrong_calls_and_too_little_memory_are_refused),
    };
    return cmocka_run_group_tests_name("follow_signature", tests, NULL, NULL);
}
