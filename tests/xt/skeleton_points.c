/* Ends, branch points, and pruning: by hand, pixel by pixel, and by what must hold afterwards. */
#include "skeleton_truth.h"

static int slow_end(const shape *s, int32_t x, int32_t y)
{
    int around[8], count = 0, beside = 0;
    ring(around, s, x, y);
    for (int i = 0; i < 8; i++) {
        count += around[i];
        beside += around[i] && around[(i + 1) % 8];
    }
    return s->at[y][x] && (count == 1 || (count == 2 && beside == 1));
}

static int slow_branch(const shape *s, int32_t x, int32_t y)
{
    int around[8], groups = 0, square = 0;
    ring(around, s, x, y);
    for (int i = 0; i < 8; i++) {
        groups += around[i] && !around[(i + 7) % 8];
    }
    for (int i = 0; i < 4; i++) {
        int dx = i % 2 ? 1 : -1, dy = i / 2 ? 1 : -1;
        square |= shape_at(s, x + dx, y) && shape_at(s, x, y + dy) && shape_at(s, x + dx, y + dy);
    }
    return s->at[y][x] && (groups >= 3 || square);
}

static void assert_points(void)
{
    for (int branch = 0; branch < 2; branch++) {
        iris_image src = shape_mask(src_words, mask_bytes(), &drawn, 0, ~0u);
        iris_image dst = shape_mask(dst_words, mask_bytes(), &drawn, 0, ~0u);
        iris_scratch scratch = arena(IRIS_SKELETON_POINTS_SCRATCH_BYTES(drawn.w));
        assert_int_equal(branch ? iris_skeleton_branches(&dst, &src, &scratch)
                                : iris_skeleton_ends(&dst, &src, &scratch),
                         IRIS_OK);
        assert_int_equal(scratch.used, 0);
        assert_int_equal(scratch.peak, IRIS_SKELETON_POINTS_SCRATCH_BYTES(drawn.w));
        shape_read(&thinned, &dst);
        for (int32_t i = 0; i < drawn.w * drawn.h; i++) {
            int32_t x = i % drawn.w, y = i / drawn.w;
            assert_int_equal(thinned.at[y][x], branch ? slow_branch(&drawn, x, y) : slow_end(&drawn, x, y));
        }
        iris_scratch again = arena(IRIS_SKELETON_POINTS_SCRATCH_BYTES(drawn.w));
        assert_int_equal(branch ? iris_skeleton_branches(&src, &src, &again)
                                : iris_skeleton_ends(&src, &src, &again),
                         IRIS_OK);
        assert_memory_equal(src_words, dst_words, mask_bytes());
    }
}

static void points_pixel_by_pixel(void **state)
{
    (void)state;
    for (int32_t w = 1; w <= 140; w++) {
        draw_random(w, 1 + w % 9, 20 + (uint32_t)w);
        assert_points();
    }
    for (uint32_t bits = 0; bits < 512; bits++) {
        draw_bits(3, 3, bits);
        assert_points();
    }
}

static void points_by_hand(void **state)
{
    (void)state;
    shape_draw(&drawn, 9, 5,
               "#...#...#"
               ".#..#..#."
               "..#####.."
               "....#...."
               "....##..#");
    iris_image src = shape_mask(src_words, sizeof src_words, &drawn, 0, 0);
    iris_image dst = shape_mask(dst_words, sizeof dst_words, &drawn, 0, 0);
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_skeleton_ends(&dst, &src, &scratch), IRIS_OK);
    shape_read(&thinned, &dst);
    shape_draw(&expected, 9, 5,
               "#...#...#"
               "........."
               "........."
               "........."
               ".....#...");
    assert_true(shape_equal(&thinned, &expected));
    assert_int_equal(iris_skeleton_branches(&dst, &src, &scratch), IRIS_OK);
    shape_read(&thinned, &dst);
    shape_draw(&expected, 9, 5,
               "........."
               "........."
               "....#...."
               "........."
               ".........");
    assert_true(shape_equal(&thinned, &expected));
}

static void assert_prunes_to(int32_t length, const char *to)
{
    shape_draw(&expected, drawn.w, drawn.h, to);
    prune(length);
    assert_true(shape_equal(&thinned, &expected));
}

static void prunes_by_hand(void **state)
{
    (void)state;
    /* Branches of 1, 2, 2, and 3 pixels, and between two branch points 4 pixels that are none. */
    const char *const all = "..#.........."
                            "..#.........."
                            "##.####.###.."
                            ".......#....."
                            "........#...."
                            ".........#...";
    const char *const without_one = "............."
                                    "..#.........."
                                    "##.####.###.."
                                    ".......#....."
                                    "........#...."
                                    ".........#...";
    const char *const one_line = "............."
                                 "..#.........."
                                 "...####.###.."
                                 ".......#....."
                                 "............."
                                 ".............";
    shape_draw(&drawn, 13, 6, all);
    assert_prunes_to(0, all);
    assert_prunes_to(1, all);
    assert_prunes_to(2, without_one);
    assert_prunes_to(3, one_line);
    assert_prunes_to(1000, "............."
                           "..#.........."
                           "...####......"
                           ".......#....."
                           "............."
                           ".............");
    /* What has no branch point stays, however short. */
    const char *const lines = "##..###.#"
                              "....#.#.."
                              "#...###.."
                              ".#.......";
    shape_draw(&drawn, 9, 4, lines);
    (void)thin(IRIS_SKELETON_EXACT);
    expected = thinned;
    prune(1000);
    assert_true(shape_equal(&thinned, &expected));
    /* A star of short branches leaves its middle. */
    shape_draw(&drawn, 5, 5,
               "#...#"
               ".#.#."
               "..#.."
               ".#.#."
               "#...#");
    assert_prunes_to(3, "............#............");
}

/* A square of 2 by 2 where four slanting lines meet, one of them short. */
static void prunes_beside_a_square(void **state)
{
    (void)state;
    for (int corner = 0; corner < 4; corner++) {
        shape_draw(&drawn, 8, 8,
                   "#......#"
                   ".#....#."
                   "..#..#.."
                   "...##..."
                   "...##..."
                   "..#..#.."
                   ".#....#."
                   "#......#");
        int x = corner % 2 ? 7 : 0, y = corner / 2 ? 7 : 0, in_x = x ? -1 : 1, in_y = y ? -1 : 1;
        drawn.at[y][x] = drawn.at[y + in_y][x + in_x] = 0;
        prune(2);
        assert_int_equal(thinned.at[y + 2 * in_y][x + 2 * in_x], 0);
        assert_int_equal(thinned.at[7 - y][7 - x] + thinned.at[y][7 - x] + thinned.at[7 - y][x], 3);
        assert_skeleton();
    }
}

/* Length of the branch from the end at x, y, up to but without a branch point; 0 when there is none. */
static int32_t slow_branch_length(const shape *s, int32_t x, int32_t y)
{
    static shape scrap;
    scrap = *s;
    for (int32_t length = 1;; length++) {
        int32_t next_x = -1, next_y = -1;
        for (int32_t v = y - 1; v <= y + 1; v++) {
            for (int32_t u = x - 1; u <= x + 1; u++) {
                if (shape_at(s, u, v) && (u != x || v != y) && slow_branch(s, u, v)) {
                    return length;
                }
                if (shape_at(&scrap, u, v) && (u != x || v != y)) {
                    next_x = u;
                    next_y = v;
                }
            }
        }
        if (next_x < 0) {
            return 0;
        }
        scrap.at[y][x] = 0;
        x = next_x;
        y = next_y;
    }
}

static int32_t shortest_branch(const shape *s)
{
    int32_t shortest = INT32_MAX;
    for (int32_t i = 0; i < s->w * s->h; i++) {
        if (slow_end(s, i % s->w, i / s->w)) {
            int32_t length = slow_branch_length(s, i % s->w, i / s->w);
            shortest = length > 0 && length < shortest ? length : shortest;
        }
    }
    return shortest;
}

static void assert_prunes(int32_t length)
{
    (void)thin(IRIS_SKELETON_EXACT);
    expected = thinned;
    prune(length);
    assert_skeleton();
    assert_true(part_of(&thinned, &expected));
    assert_true(shortest_branch(&thinned) >= length);
    if (shortest_branch(&expected) >= length) {
        assert_true(shape_equal(&thinned, &expected));
    }
}

static void prunes_everything_short(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        int32_t w = 1 + (int32_t)(next_random(&seed) % 100), h = 1 + (int32_t)(next_random(&seed) % 30);
        if (i % 2 == 0) {
            draw_blobs(w, h);
        } else {
            draw_random(w, h, 60 + 3 * (uint32_t)i);
        }
        assert_prunes(2 + i % 9);
        assert_prunes(1000);
    }
    for (int i = 0; i < SHAPE_NAMES; i += 6) {
        if (shape_load(&drawn, shape_name(i))) {
            assert_prunes(20);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_pixel_by_pixel),   cmocka_unit_test(points_by_hand),
        cmocka_unit_test(prunes_by_hand),          cmocka_unit_test(prunes_beside_a_square),
        cmocka_unit_test(prunes_everything_short),
    };
    fill_simple_table();
    return cmocka_run_group_tests_name("skeleton points", tests, NULL, NULL);
}
