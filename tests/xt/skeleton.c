/* Skeletons: masks worked out by hand; the definition, pixel by pixel; and connectedness, by flooding, of every 4x4
 * mask, of awkward ones, and of real shapes. */
#include "skeleton_truth.h"

/* The paper: P2 to P9 clockwise from above; A, how often 0 is followed by 1; B, how many are selected. */
static int32_t zhang_suen_slowly(shape *s)
{
    static shape old;
    int32_t passes = 0;
    for (int changed = 1; changed; passes++) {
        changed = 0;
        for (int second = 0; second < 2; second++) {
            old = *s;
            for (int32_t y = 0; y < s->h; y++) {
                for (int32_t x = 0; x < s->w; x++) {
                    int p[8], a = 0, b = 0;
                    if (!old.at[y][x]) {
                        continue;
                    }
                    ring(p, &old, x, y);
                    for (int i = 0; i < 8; i++) {
                        a += !p[i] && p[(i + 1) % 8];
                        b += p[i];
                    }
                    int p2 = p[0], p4 = p[2], p6 = p[4], p8 = p[6];
                    int sides = second ? p2 * p4 * p8 == 0 && p2 * p6 * p8 == 0
                                       : p2 * p4 * p6 == 0 && p4 * p6 * p8 == 0;
                    if (a == 1 && b >= 2 && b <= 6 && sides) {
                        s->at[y][x] = 0;
                        changed = 1;
                    }
                }
            }
        }
    }
    return passes;
}

static void assert_thins_to(int32_t w, int32_t h, const char *from, const char *to,
                            iris_skeleton_method method)
{
    shape_draw(&drawn, w, h, from);
    shape_draw(&expected, w, h, to);
    (void)thin(method);
    assert_true(shape_equal(&thinned, &expected));
}

static void by_hand(void **state)
{
    (void)state;
    /* The top goes before the bottom, both go before the sides: then the row that is left has two ends. */
    assert_thins_to(1, 1, "#", "#", IRIS_SKELETON_EXACT);
    assert_thins_to(2, 2, "####", "..##", IRIS_SKELETON_EXACT);
    assert_thins_to(3, 3, "#########", "...###...", IRIS_SKELETON_EXACT);
    assert_thins_to(6, 3, "##################", "......######......", IRIS_SKELETON_EXACT);
    assert_thins_to(5, 4,
                    ".###."
                    "##.##"
                    "##.##"
                    ".###.",
                    "..#.."
                    ".#.#."
                    ".#.#."
                    "..#..",
                    IRIS_SKELETON_EXACT);
    assert_thins_to(5, 3,
                    "#...#"
                    ".#.#."
                    "..#..",
                    "#...#"
                    ".#.#."
                    "..#..",
                    IRIS_SKELETON_EXACT);
    /* Four slanting lines: the square between them is needed. */
    assert_thins_to(4, 4,
                    "#..#"
                    ".##."
                    ".##."
                    "#..#",
                    "#..#"
                    ".##."
                    ".##."
                    "#..#",
                    IRIS_SKELETON_EXACT);
    assert_thins_to(2, 2, "####", "....", IRIS_SKELETON_ZHANG_SUEN);
    /* The first half leaves .##. over ###., the second one pixel. */
    assert_thins_to(4, 3, "############", ".....#......", IRIS_SKELETON_ZHANG_SUEN);
}

static void as_the_header_says(void **state)
{
    (void)state;
    for (int i = 0; i < 120; i++) {
        int32_t w = 1 + (int32_t)(next_random(&seed) % 200), h = 1 + (int32_t)(next_random(&seed) % 40);
        if (i % 3 == 0) {
            draw_blobs(w, h);
        } else {
            draw_random(w, h, 20 + 2 * (uint32_t)i);
        }
        expected = drawn;
        assert_int_equal(thin(IRIS_SKELETON_EXACT), thin_slowly(&expected));
        assert_true(shape_equal(&thinned, &expected));
        expected = drawn;
        assert_int_equal(thin(IRIS_SKELETON_ZHANG_SUEN), zhang_suen_slowly(&expected));
        assert_true(shape_equal(&thinned, &expected));
    }
}

static void every_small_mask(void **state)
{
    (void)state;
    for (uint32_t bits = 0; bits < 512; bits++) {
        draw_bits(3, 3, bits);
        assert_exact();
    }
    for (uint32_t bits = 0; bits < 65536; bits++) {
        draw_bits(4, 4, bits);
        assert_exact();
    }
}

/* Kinds of pictures that are hard: one pixel at x, y. */
static int awkward(int kind, int32_t x, int32_t y, int32_t w, int32_t h)
{
    int32_t ring_of = x < y ? x : y;
    ring_of = w - 1 - x < ring_of ? w - 1 - x : ring_of;
    ring_of = h - 1 - y < ring_of ? h - 1 - y : ring_of;
    switch (kind) {
    case 0:
        return 1;
    case 1:
        return (x + y) % 2;
    case 2:
        return (x / 2 + y / 2) % 2;
    case 3:
        return ring_of == 0;
    case 4:
        return ring_of % 2 == 0; /* frames in frames */
    case 5:
        return ring_of / 3 % 2 == 0;
    case 6:
        return y == h / 2 || x % 2; /* combs on both sides */
    case 7:
        return y < 3 || x % 4 < 2;
    case 8:
        return ring_of % 2 == 0 ? !(x == ring_of && y == ring_of + 1)
                                : x == ring_of && y == ring_of; /* a spiral */
    case 9:
        return ring_of / 3 % 2 == 0 || (x == y + 3 && x < w / 2);
    case 10:
        return x % 3 != 1 || y % 3 != 1; /* holes */
    case 11:
        return (x + y) % 4 < 2;
    case 12:
        return (x + 2 * y) % 5 < 3;
    default:
        return x % 64 >= 62 || x % 64 <= 1 || y % 7 == 0;
    }
}

#define AWKWARD 14

static void awkward_masks(void **state)
{
    (void)state;
    const int32_t sizes[][2] = {{1, 1},   {1, 70},  {70, 1},  {2, 33},  {31, 9},   {32, 11}, {33, 12},
                                {63, 10}, {64, 12}, {65, 13}, {96, 17}, {127, 15}, {128, 9}, {130, 61}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int kind = 0; kind < AWKWARD; kind++) {
            drawn.w = sizes[i][0];
            drawn.h = sizes[i][1];
            for (int32_t k = 0; k < drawn.w * drawn.h; k++) {
                int32_t x = k % drawn.w, y = k / drawn.w;
                drawn.at[y][x] = (uint8_t)awkward(kind, x, y, drawn.w, drawn.h);
            }
            assert_exact();
        }
    }
}

static void random_masks(void **state)
{
    (void)state;
    for (int i = 0; i < 300; i++) {
        int32_t w = 1 + (int32_t)(next_random(&seed) % 140), h = 1 + (int32_t)(next_random(&seed) % 50);
        if (i % 4 == 0) {
            draw_blobs(w, h);
        } else {
            draw_random(w, h, 8 * (1 + (uint32_t)i % 32));
        }
        assert_exact();
    }
}

static void real_shapes(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPE_NAMES; i++) {
        if (!shape_load(&drawn, shape_name(i))) {
            skip();
        }
        assert_exact();
        if (i % 6 == 0) {
            expected = drawn;
            (void)thin(IRIS_SKELETON_ZHANG_SUEN);
            (void)zhang_suen_slowly(&expected);
            assert_true(shape_equal(&thinned, &expected));
        }
    }
}

/* A disc around a pixel keeps this pixel, and an upright cross of bars its middle. */
static void keeps_to_the_middle(void **state)
{
    (void)state;
    for (int32_t r = 1; r <= 60; r++) {
        draw_random(131, 131, 0);
        for (int32_t i = 0; i < 131 * 131; i++) {
            int32_t x = i % 131 - 65, y = i / 131 - 65;
            drawn.at[i / 131][i % 131] = x * x + y * y <= r * r;
        }
        (void)thin(IRIS_SKELETON_EXACT);
        for (int32_t i = 0; i < 131 * 131; i++) {
            int32_t x = i % 131 - 65, y = i / 131 - 65;
            assert_true(!thinned.at[i / 131][i % 131] || x * x + y * y <= r * r / 16 + 2);
        }
    }
}

static void views_of_every_kind(void **state)
{
    (void)state;
    for (int i = 0; i < 40; i++) {
        draw_random(1 + (int32_t)(next_random(&seed) % 100), 20, 180);
        ptrdiff_t bytes = (drawn.w + 31) / 32 * 4 + 4 * (i % 3);
        uint32_t fill = i % 2 ? ~0u : 0;
        iris_image src = shape_mask(src_words, sizeof src_words, &drawn, i % 4 < 2 ? bytes : -bytes, fill);
        iris_image dst = shape_mask(dst_words, sizeof dst_words, &drawn, i % 4 < 2 ? bytes : -bytes, fill);
        int pruned = i % 5 == 0;
        (void)thin_slowly(&drawn);
        iris_scratch scratch = arena(sizeof memory);
        assert_int_equal(pruned ? iris_skeleton_prune(&dst, &src, 0, &scratch)
                                : iris_skeleton(NULL, &dst, &src, IRIS_SKELETON_EXACT, &scratch),
                         IRIS_OK);
        assert_int_equal(pruned ? iris_skeleton_prune(&src, &src, 0, &scratch)
                                : iris_skeleton(NULL, &src, &src, IRIS_SKELETON_EXACT, &scratch),
                         IRIS_OK);
        assert_memory_equal(src_words, dst_words, sizeof src_words);
        (void)shape_mask(src_words, sizeof src_words, &drawn, i % 4 < 2 ? bytes : -bytes, fill);
        assert_memory_equal(src_words, dst_words, sizeof src_words); /* nothing else was written */
    }
}

/* A region ends at its edge: what is beyond counts as not selected, and stays. */
static void regions(void **state)
{
    (void)state;
    draw_random(150, 40, 256);
    iris_image all = shape_mask(src_words, sizeof src_words, &drawn, 0, 0), part;
    assert_int_equal(iris_image_crop(&part, &all, (iris_rect){64, 5, 50, 21}), IRIS_OK);
    iris_scratch scratch = arena(IRIS_SKELETON_SCRATCH_BYTES(50, 21));
    assert_int_equal(iris_skeleton(NULL, &part, &part, IRIS_SKELETON_EXACT, &scratch), IRIS_OK);
    expected.w = 50;
    expected.h = 21;
    memset(expected.at, 1, sizeof expected.at);
    (void)thin_slowly(&expected);
    for (int32_t y = 0; y < 21; y++) {
        memcpy(&drawn.at[y + 5][64], expected.at[y], 50);
    }
    shape_read(&thinned, &all);
    assert_true(shape_equal(&thinned, &drawn));
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    draw_random(70, 9, 128);
    iris_image src = shape_mask(src_words, sizeof src_words, &drawn, 0, 0);
    iris_image dst = shape_mask(dst_words, sizeof dst_words, &drawn, 0, 0), gray, other, below;
    memset(dst_words, 0x35, sizeof dst_words);
    iris_scratch scratch = arena(sizeof memory), less = arena(IRIS_SKELETON_SCRATCH_BYTES(70, 9) - 1);
    iris_scratch fewer = arena(IRIS_SKELETON_POINTS_SCRATCH_BYTES(70) - 1);
    int32_t passes = 99;
    const iris_skeleton_method exact = IRIS_SKELETON_EXACT;
    assert_int_equal(iris_image_wrap(&gray, dst_words, sizeof dst_words, (iris_size){70, 9}, 0, IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&other, &dst, (iris_rect){0, 0, 70, 8}), IRIS_OK);
    below = src;
    below.data = iris_image_row(&src, 1);
    iris_image broken = dst;
    broken.w = 0;
    assert_int_equal(iris_skeleton(&passes, NULL, &src, exact, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_skeleton(&passes, &dst, NULL, exact, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_skeleton(&passes, &dst, &src, exact, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_skeleton(&passes, &dst, &src, (iris_skeleton_method)2, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_skeleton(&passes, &gray, &src, exact, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_skeleton(&passes, &other, &src, exact, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_skeleton(&passes, &broken, &src, exact, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_skeleton(&passes, &below, &src, exact, &scratch), IRIS_ERR_ALIAS);
    assert_int_equal(iris_skeleton(&passes, &dst, &src, exact, &less), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_skeleton_prune(NULL, &src, 3, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_skeleton_prune(&dst, &src, -1, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_skeleton_prune(&dst, &gray, 3, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_skeleton_prune(&dst, &src, 3, &less), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_skeleton_ends(&dst, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_skeleton_ends(&dst, &src, &fewer), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_skeleton_ends(&below, &src, &scratch), IRIS_ERR_ALIAS);
    assert_int_equal(iris_skeleton_branches(&dst, &src, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_skeleton_branches(&other, &src, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_skeleton_branches(&dst, &src, &fewer), IRIS_ERR_SCRATCH);
    assert_int_equal(passes, 99);
    for (size_t i = 0; i < sizeof dst_words / sizeof dst_words[0]; i++) {
        assert_int_equal(dst_words[i], 0x35353535);
    }
    shape_read(&thinned, &src);
    assert_true(shape_equal(&thinned, &drawn));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(as_the_header_says),
        cmocka_unit_test(every_small_mask),
        cmocka_unit_test(awkward_masks),
        cmocka_unit_test(random_masks),
        cmocka_unit_test(real_shapes),
        cmocka_unit_test(keeps_to_the_middle),
        cmocka_unit_test(views_of_every_kind),
        cmocka_unit_test(regions),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    fill_simple_table();
    return cmocka_run_group_tests_name("skeleton", tests, NULL, NULL);
}
