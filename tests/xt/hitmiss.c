/* Hit-or-miss: the definition pixel by pixel, and patterns found by hand. */
#include "iris/xt/hitmiss.h"
#include "../picture.h"

enum { PARENT_W = 320, PARENT_H = 40, WORDS = PARENT_W / 32 * PARENT_H };

static uint32_t source[WORDS], target[WORDS], expected[WORDS];
static IRIS_SCRATCH_BUFFER(memory, 4096);
static uint32_t seed = 5;

static int32_t between(int32_t low, int32_t high)
{
    return low + (int32_t)(next_random(&seed) % (uint32_t)(high - low + 1));
}

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_true(bytes <= sizeof memory);
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static int32_t place(int32_t i, int32_t n, iris_border_rule rule)
{
    while (i < 0 || i >= n) {
        if (rule == IRIS_BORDER_CONSTANT || rule == IRIS_BORDER_SKIP) {
            return -1;
        }
        if (rule == IRIS_BORDER_REPLICATE || n == 1) {
            return i < 0 ? 0 : n - 1;
        }
        i = i < 0 ? -i : 2 * (n - 1) - i;
    }
    return i;
}

/* 1: occurs, 0: does not, -1: not evaluated. */
static int occurs(const iris_image *mask, const iris_hitmiss_pattern *pattern, int32_t x, int32_t y,
                  iris_border border)
{
    int found = 1;
    for (int32_t dy = 0; dy < pattern->h; dy++) {
        for (int32_t dx = 0; dx < pattern->w; dx++) {
            int32_t u = place(x + dx - (pattern->w - 1) / 2, mask->w, border.rule);
            int32_t v = place(y + dy - (pattern->h - 1) / 2, mask->h, border.rule);
            if (border.rule == IRIS_BORDER_SKIP && (u < 0 || v < 0)) {
                return -1;
            }
            int value = border.value != 0;
            if (u >= 0 && v >= 0) {
                value = (int)(((uint32_t *)iris_image_row(mask, v))[u / 32] >> u % 32 & 1);
            }
            if ((pattern->set[dy] >> dx & 1 && !value) || (pattern->clear[dy] >> dx & 1 && value)) {
                found = 0;
            }
        }
    }
    return found;
}

static iris_image part(uint32_t *words, int32_t w, int32_t h)
{
    iris_image parent, view;
    assert_int_equal(iris_image_wrap(&parent, words, 4 * WORDS, (iris_size){PARENT_W, PARENT_H},
                                     between(0, 1) ? PARENT_W / 8 : -PARENT_W / 8, IRIS_MASK1),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&view, &parent, (iris_rect){32 * between(0, 2), between(0, 9), w, h}),
                     IRIS_OK);
    return view;
}

static void fill_noise(uint32_t *words)
{
    for (int i = 0; i < WORDS; i++) {
        words[i] = next_random(&seed) ^ next_random(&seed) << 16;
    }
}

static void the_definition(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 2100; i++) {
        iris_hitmiss_pattern pattern = {.w = between(1, 8), .h = between(1, 8)};
        for (int few = between(1, 9); few > 0; few--) {
            int32_t y = between(0, 7), bit = 1 << between(0, 7); /* past w and h, too */
            pattern.set[y] |= (uint8_t)(few % 2 ? bit : 0);
            pattern.clear[y] |= (uint8_t)(few % 2 ? 0 : bit);
        }
        fill_noise(source);
        fill_noise(target);
        int32_t w = i % 7 ? 1 + i % 70 : between(97, 256), h = between(1, 12), in_place = between(0, 1);
        iris_image from = part(source, w, h), to = in_place ? from : part(target, w, h);
        iris_border border = {(iris_border_rule)between(0, 3), (uint8_t)(100 * between(0, 1))};
        uint32_t *words = in_place ? source : target;
        memcpy(expected, words, sizeof expected);
        for (int32_t k = 0; k < w * h; k++) {
            int found = occurs(&from, &pattern, k % w, k / w, border);
            uint32_t *word = &expected[(uint32_t *)iris_image_row(&to, k / w) - words + k % w / 32];
            uint32_t bit = (uint32_t)1 << k % w % 32;
            *word = found == 1 ? *word | bit : found == 0 ? *word & ~bit : *word;
        }
        iris_scratch scratch = arena(IRIS_HITMISS_SCRATCH_BYTES(w, pattern.w, pattern.h));
        assert_int_equal(iris_hitmiss_find(&to, &from, &pattern, border, &scratch), IRIS_OK);
        assert_memory_equal(words, expected, sizeof expected);
        assert_int_equal(scratch.used, 0);
        assert_int_equal(scratch.peak, scratch.bytes);
    }
}

/* Where a line that runs to the right begins: nothing set before, above, and below. */
static void ends_of_lines_by_hand(void **state)
{
    (void)state;
    static const char *const start[] = {"0000000000", "0111100110", "0000000110", "0001000000"};
    static const char *const found[] = {"0000000000", "0100000000", "0000000000", "0000000000"};
    uint32_t words[4] = {0};
    iris_image mask;
    iris_hitmiss_pattern pattern;
    iris_scratch scratch = arena(sizeof memory);
    for (int i = 0; i < 40; i++) {
        words[i / 10] |= (uint32_t)(start[i / 10][i % 10] == '1') << i % 10;
    }
    assert_int_equal(iris_image_wrap(&mask, words, sizeof words, (iris_size){10, 4}, 0, IRIS_MASK1), IRIS_OK);
    assert_int_equal(iris_hitmiss_pattern_read(&pattern, "000/011/000"), IRIS_OK);
    assert_int_equal(iris_hitmiss_find(&mask, &mask, &pattern, (iris_border){0}, &scratch), IRIS_OK);
    for (int i = 0; i < 40; i++) {
        assert_int_equal(words[i / 10] >> i % 10 & 1, found[i / 10][i % 10] == '1');
    }
}

static void texts(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        iris_status status;
    } cases[] = {{"", IRIS_ERR_RANGE},
                 {"1/", IRIS_ERR_RANGE},
                 {"/1", IRIS_ERR_RANGE},
                 {"11/1", IRIS_ERR_DATA},
                 {"1/11", IRIS_ERR_DATA},
                 {"1x", IRIS_ERR_DATA},
                 {"1 0", IRIS_ERR_DATA},
                 {"........1", IRIS_ERR_RANGE},
                 {".", IRIS_OK},
                 {"........", IRIS_OK},
                 {"1/1/1/1/1/1/1/1", IRIS_OK},
                 {"1/1/1/1/1/1/1/1/1", IRIS_ERR_RANGE},
                 {"1/1/1/1/1/1/1/1/", IRIS_ERR_RANGE}};
    iris_hitmiss_pattern pattern, before;
    assert_int_equal(iris_hitmiss_pattern_read(&pattern, "10./.11"), IRIS_OK);
    assert_int_equal(pattern.w * 10 + pattern.h, 32);
    assert_int_equal(pattern.set[0], 1);
    assert_int_equal(pattern.clear[0], 2);
    assert_int_equal(pattern.set[1], 6);
    assert_int_equal(pattern.clear[1] | pattern.set[2], 0);
    assert_int_equal(iris_hitmiss_pattern_read(NULL, "1"), IRIS_ERR_ARG);
    assert_int_equal(iris_hitmiss_pattern_read(&pattern, NULL), IRIS_ERR_ARG);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        memcpy(&before, &pattern, sizeof before);
        assert_int_equal(iris_hitmiss_pattern_read(&pattern, cases[i].text), cases[i].status);
        if (cases[i].status != IRIS_OK) {
            assert_memory_equal(&pattern, &before, sizeof before);
        }
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static const uint8_t constant[IRIS_HITMISS_SCRATCH_BYTES(160, 3, 3)];
    assert_int_equal(sizeof constant, 4 * (16 + 32));
    iris_scratch scratch = arena(sizeof memory);
    iris_hitmiss_pattern pattern = {3, 3, {1}, {2}}, wrong = pattern;
    iris_border border = {IRIS_BORDER_REPLICATE, 0};
    memcpy(expected, target, sizeof expected);
    iris_image from = part(source, 30, 9), to = part(target, 30, 9), bad = to;
    assert_int_equal(iris_hitmiss_find(NULL, &from, &pattern, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hitmiss_find(&to, NULL, &pattern, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hitmiss_find(&to, &from, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hitmiss_find(&to, &from, &pattern, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hitmiss_find(&to, &from, &pattern, (iris_border){(iris_border_rule)4, 0}, &scratch),
                     IRIS_ERR_ARG);
    wrong.w = 9;
    assert_int_equal(iris_hitmiss_find(&to, &from, &wrong, border, &scratch), IRIS_ERR_RANGE);
    wrong = pattern;
    wrong.h = 0;
    assert_int_equal(iris_hitmiss_find(&to, &from, &wrong, border, &scratch), IRIS_ERR_RANGE);
    bad.w = 29;
    assert_int_equal(iris_hitmiss_find(&bad, &from, &pattern, border, &scratch), IRIS_ERR_RANGE);
    bad.w = 0;
    assert_int_equal(iris_hitmiss_find(&to, &bad, &pattern, border, &scratch), IRIS_ERR_RANGE);
    bad = to;
    bad.format = IRIS_GRAY8;
    bad.w = 9;
    assert_int_equal(iris_hitmiss_find(&bad, &bad, &pattern, border, &scratch), IRIS_ERR_FORMAT);
    bad = to;
    bad.data = (uint8_t *)bad.data + to.stride;
    assert_int_equal(iris_hitmiss_find(&to, &bad, &pattern, border, &scratch), IRIS_ERR_ALIAS);
    scratch = arena(IRIS_HITMISS_SCRATCH_BYTES(30, 3, 3) - 1);
    assert_int_equal(iris_hitmiss_find(&to, &from, &pattern, border, &scratch), IRIS_ERR_SCRATCH);
    assert_memory_equal(target, expected, sizeof expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_definition),
        cmocka_unit_test(ends_of_lines_by_hand),
        cmocka_unit_test(texts),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
