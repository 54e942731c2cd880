/* The cellular automaton, cell by cell. */
#include "iris/xt/automaton.h"

#include "edge_picture.h"

static uint8_t living[SIDE_MAX * SIDE_MAX], next[SIDE_MAX * SIDE_MAX];

/* The rule, one cell at a time. margin: cells at the edge that are none. */
static void make_reference(const iris_image *src, iris_automaton_config by, iris_border border,
                           int32_t margin)
{
    int32_t w = src->w, h = src->h;
    for (int32_t i = 0; i < w * h; i++) {
        int32_t x = i % w, y = i / w;
        int across = abs(pixel_beyond(src, x - 1, y, border) - pixel_beyond(src, x + 1, y, border));
        int down = abs(pixel_beyond(src, x, y - 1, border) - pixel_beyond(src, x, y + 1, border));
        int inside = x >= margin && y >= margin && x < w - margin && y < h - margin;
        living[i] = inside && (across > by.threshold || down > by.threshold);
    }
    for (int32_t generation = 0; generation < by.generations; generation++) {
        for (int32_t i = 0; i < w * h; i++) {
            int neighbors = -living[i];
            for (int32_t k = 0; k < 9; k++) {
                int32_t x = i % w + k % 3 - 1, y = i / w + k / 3 - 1;
                neighbors += x >= 0 && y >= 0 && x < w && y < h && living[y * w + x];
            }
            next[i] = living[i] && neighbors >= 2;
        }
        memcpy(living, next, sizeof living);
    }
}

static void assert_automaton(const iris_image *src, iris_automaton_config by, iris_border border)
{
    int32_t margin = border.rule == IRIS_BORDER_SKIP ? 1 : 0;
    iris_image mask = mask_view(src->w, src->h);
    iris_scratch scratch = arena(IRIS_AUTOMATON_SCRATCH_BYTES(src->w));
    make_reference(src, by, border, margin);
    assert_int_equal(iris_automaton(&mask, src, &by, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, IRIS_AUTOMATON_SCRATCH_BYTES(src->w));
    assert_int_equal(scratch.used, 0);
    for (int32_t y = 0; y < src->h; y++) {
        for (int32_t x = 0; x < (src->w + 31) / 32 * 32; x++) {
            int inside = x >= margin && y >= margin && x < src->w - margin && y < src->h - margin;
            assert_int_equal(bit(&mask, x, y), inside ? living[y * src->w + x] : UNTOUCHED_BIT(x, y));
        }
    }
    assert_around_untouched();
}

static void every_border_and_size(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1}, {2, 1},  {1, 2},  {2, 2},  {3, 3},  {1, 9},   {9, 1},
                                      {4, 5}, {31, 7}, {32, 8}, {33, 9}, {65, 9}, {64, 33}, {100, 40}};
    static const uint8_t thresholds[] = {0, 1, 30, 100, 254, 255};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int kind = 0; kind < PICTURE_KINDS; kind++) {
            iris_image src = picture_of(kind, sizes[i]);
            for (int k = 0; k < 4 * 6; k++) {
                iris_border border = {(iris_border_rule)(k % 4), (uint8_t)(50 * kind)};
                assert_automaton(&src, (iris_automaton_config){thresholds[k / 4], (kind + k) % 5}, border);
            }
        }
    }
}

static void a_photograph(void **state)
{
    (void)state;
    picture photograph = load_pnm(data_path("edges/classic/camera_256.pgm"));
    if (!photograph.pixels) {
        print_message("skipped: no shared data\n");
        skip();
    }
    for (int part = 0; part < 4; part++) {
        iris_image src = picture_part(&photograph, 31 + 30 * part, 17 + 37 * part, (iris_size){130, 97});
        for (int32_t generations = 0; generations <= IRIS_AUTOMATON_GENERATIONS_MAX; generations += 4) {
            assert_automaton(&src, (iris_automaton_config){20, generations},
                             (iris_border){(iris_border_rule)part, 99});
        }
    }
    free(photograph.pixels);
}

/* A step of 55 between columns 3 and 4 gives these two columns, and a single bright pixel its four neighbors, each of
 * which has the two beside it. */
static void by_hand(void **state)
{
    (void)state;
    iris_scratch scratch = arena(IRIS_AUTOMATON_SCRATCH_BYTES(8));
    for (int kind = 0; kind < 2; kind++) {
        iris_image src = picture_of(4, (iris_size){8, 7}), mask = mask_view(8, 7);
        for (int32_t i = 0; i < 56; i++) {
            if (kind == 0 ? i % 8 >= 4 : i == 3 * 8 + 4) {
                ((uint8_t *)iris_image_row(&src, i / 8))[i % 8] = 255;
            }
        }
        iris_automaton_config by = {54, 1};
        assert_int_equal(iris_automaton(&mask, &src, &by, (iris_border){0}, &scratch), IRIS_OK);
        for (int32_t i = 0; i < 56; i++) {
            int32_t x = i % 8, y = i / 8;
            int expected = kind == 0 ? x == 3 || x == 4 : abs(x - 4) + abs(y - 3) == 1;
            assert_int_equal(bit(&mask, x, y), expected);
        }
        by.threshold = 55;
        assert_int_equal(iris_automaton(&mask, &src, &by, (iris_border){0}, &scratch), IRIS_OK);
        for (int32_t i = 0; i < 56; i++) {
            assert_int_equal(bit(&mask, i % 8, i / 8), 0);
        }
    }
}

static void scratch_is_exact(void **state)
{
    (void)state;
    reset_results();
    iris_image src = picture_of(1, (iris_size){37, 8}), mask = mask_view(37, 8);
    const size_t bytes = IRIS_AUTOMATON_SCRATCH_BYTES(37);
    assert_int_equal(bytes, 4 * 64 + 4 * 16);
    iris_scratch scratch = arena(bytes - 1);
    assert_int_equal(iris_automaton(&mask, &src, NULL, (iris_border){0}, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    assert_all_untouched();
    scratch = arena(bytes);
    assert_int_equal(iris_automaton(&mask, &src, NULL, (iris_border){0}, &scratch), IRIS_OK);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    reset_results();
    iris_image src = picture_of(1, (iris_size){20, 10}), mask = mask_view(20, 10), bad = mask;
    iris_scratch scratch = arena(IRIS_AUTOMATON_SCRATCH_BYTES(20));
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    iris_automaton_config by = {30, -1};
    assert_int_equal(iris_automaton(&mask, &src, &by, border, &scratch), IRIS_ERR_ARG);
    by.generations = IRIS_AUTOMATON_GENERATIONS_MAX + 1;
    assert_int_equal(iris_automaton(&mask, &src, &by, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_automaton(NULL, &src, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_automaton(&mask, NULL, NULL, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_automaton(&mask, &src, NULL, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_automaton(&mask, &src, NULL, (iris_border){(iris_border_rule)9, 0}, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_automaton(&src, &src, NULL, border, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_automaton(&mask, &mask, NULL, border, &scratch), IRIS_ERR_FORMAT);
    bad.w = 19;
    assert_int_equal(iris_automaton(&bad, &src, NULL, border, &scratch), IRIS_ERR_RANGE);
    bad.w = 0;
    assert_int_equal(iris_automaton(&bad, &src, NULL, border, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(scratch.peak, 0);
    assert_all_untouched();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_border_and_size),
        cmocka_unit_test(a_photograph),
        cmocka_unit_test(by_hand),
        cmocka_unit_test(scratch_is_exact),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("automaton", tests, NULL, NULL);
}
