/* Junctions of masks that are painted here from formulas: type, place, angles; what is no junction; hostile masks. */
#include "iris/xt/junction.h"

#include <math.h>
#include <stdlib.h>

#include "../picture.h"

#define PI  3.14159265358979323846
#define W   160
#define H   120
#define TOP 8 /* junctions asked for */

static uint32_t words[256 * 200 / 32 + 2000];
static IRIS_SCRATCH_BUFFER(memory, 1 << 17);

static iris_image blank(int32_t w, int32_t h)
{
    iris_image mask;
    memset(words, 0, sizeof words);
    assert_int_equal(iris_image_wrap(&mask, words, sizeof words, (iris_size){w, h}, 0, IRIS_MASK1), IRIS_OK);
    return mask;
}

static void set(const iris_image *mask, int32_t x, int32_t y)
{
    uint32_t *row = iris_image_row(mask, y);
    row[x / 32] |= (uint32_t)1 << x % 32;
}

/* A stroke from (x, y) in a direction (degrees, 0 up, right positive), square at its start and `length` long. */
static void stroke(const iris_image *mask, double x, double y, double degrees, double width, double length)
{
    double dx = sin(degrees * PI / 180), dy = -cos(degrees * PI / 180);
    for (int32_t v = 0; v < mask->h; v++) {
        for (int32_t u = 0; u < mask->w; u++) {
            double along = (u - x) * dx + (v - y) * dy, across = (u - x) * dy - (v - y) * dx;
            if (along >= -width / 2 && along <= length && fabs(across) <= width / 2) {
                set(mask, u, v);
            }
        }
    }
}

/* Finds with exactly the working memory that it takes. */
static int32_t find(iris_junction found[TOP], const iris_image *mask)
{
    int32_t count = -1;
    iris_scratch scratch;
    assert_int_equal(
        iris_scratch_init(&scratch, memory.memory, IRIS_JUNCTION_SCRATCH_BYTES(mask->w, mask->h)), IRIS_OK);
    assert_int_equal(iris_junctions_find(found, TOP, &count, mask, NULL, &scratch), IRIS_OK);
    return count;
}

static double away(double degrees, double from)
{
    return fabs(remainder(degrees - from, 360));
}

/* One junction of this type at (x, y), whose branches are these. */
static void expect(const iris_image *mask, iris_junction_type type, double x, double y, const double *degrees,
                   int count)
{
    iris_junction found[TOP];
    int32_t all = find(found, mask);
    if (all != 1 || found[0].type != type) {
        print_error("%d junctions, the first of type %d; expected %d at %g, %g\n", (int)all,
                    (int)found[0].type, (int)type, x, y);
        fail();
    }
    assert_int_equal(found[0].branch_count, count);
    assert_true(hypot(found[0].x_q4 / 16.0 - x, found[0].y_q4 / 16.0 - y) < 2.5);
    assert_int_equal(found[0].distance_rows, mask->h - 1 - (int)floor(found[0].y_q4 / 16.0 + 0.5));
    assert_in_range(found[0].confidence_permil, 500, 1000);
    for (int i = 0; i < count; i++) {
        double nearest = 180;
        for (int k = 0; k < found[0].branch_count; k++) {
            nearest = fmin(nearest, away(found[0].branches[k] * 360.0 / 65536, degrees[i]));
        }
        assert_true(nearest < 4);
    }
    for (int k = 1; k < IRIS_JUNCTION_BRANCHES; k++) {
        assert_true(k < count ? found[0].branches[k - 1] <= found[0].branches[k] : found[0].branches[k] == 0);
    }
}

/* The arms with every turn and several widths. */
static void every_turn(iris_junction_type type, const double *degrees, int count)
{
    for (int width = 5; width <= 17; width += 4) {
        for (int turn = -40; turn <= 40; turn += 8) {
            iris_image mask = blank(W, H);
            double turned[4];
            for (int i = 0; i < count; i++) {
                turned[i] = degrees[i] + turn;
                stroke(&mask, 79.3, 58.6, turned[i], width, 300);
            }
            expect(&mask, type, 79.3, 58.6, turned, count);
        }
    }
}

static void finds_t(void **state)
{
    (void)state;
    static const double from_below[] = {180, -90, 90}, to_the_left[] = {180, 0, -90},
                        slanting[] = {180, 0, 60};
    every_turn(IRIS_JUNCTION_T, from_below, 3);
    every_turn(IRIS_JUNCTION_T, to_the_left, 3);
    every_turn(IRIS_JUNCTION_T, slanting, 3);
}

static void finds_y(void **state)
{
    (void)state;
    static const double wide[] = {180, -60, 60}, narrow[] = {180, -35, 35};
    every_turn(IRIS_JUNCTION_Y, wide, 3);
    every_turn(IRIS_JUNCTION_Y, narrow, 3);
}

static void finds_crossing(void **state)
{
    (void)state;
    static const double square[] = {180, -90, 0, 90}, slanting[] = {180, 0, -60, 120};
    every_turn(IRIS_JUNCTION_CROSSING, square, 4);
    every_turn(IRIS_JUNCTION_CROSSING, slanting, 4);
}

static void finds_corner(void **state)
{
    (void)state;
    static const double square[] = {180, 90}, blunt[] = {180, -60}, sharp[] = {180, 120};
    every_turn(IRIS_JUNCTION_CORNER, square, 2);
    every_turn(IRIS_JUNCTION_CORNER, blunt, 2);
    every_turn(IRIS_JUNCTION_CORNER, sharp, 2);
}

static void finds_end(void **state)
{
    (void)state;
    for (int width = 5; width <= 17; width += 4) {
        for (int turn = -40; turn <= 40; turn += 8) {
            iris_image mask = blank(W, H);
            double back = 180 + turn, x = 80 - sin(turn * PI / 180) * width / 2;
            stroke(&mask, x, 50 + cos(turn * PI / 180) * width / 2, back, width, 300);
            expect(&mask, IRIS_JUNCTION_END, 80, 50, &back, 1);
        }
    }
}

static void nothing_in_lines_and_curves(void **state)
{
    (void)state;
    iris_junction found[TOP];
    for (int turn = -180; turn < 180; turn += 5) {
        iris_image mask = blank(W, H);
        stroke(&mask, 80, 60, turn, 9, 300);
        stroke(&mask, 80, 60, turn + 180, 9, 300);
        assert_int_equal(find(found, &mask), 0);
    }
    for (int radius = 40; radius <= 150; radius += 10) { /* a quarter of a circle, 9 wide */
        iris_image mask = blank(W, H);
        for (int32_t y = 0; y < H; y++) {
            for (int32_t x = 0; x < W; x++) {
                if (fabs(hypot(x - 10, y - 119) - radius) <= 4.5) {
                    set(&mask, x, y);
                }
            }
        }
        assert_int_equal(find(found, &mask), 0);
    }
    iris_image mask = blank(W, H);
    assert_int_equal(find(found, &mask), 0);
}

static void an_end_before_a_gap_is_none(void **state)
{
    (void)state;
    iris_junction found[TOP];
    iris_image mask = blank(W, H);
    stroke(&mask, 80, 70, 180, 9, 300);
    assert_int_equal(find(found, &mask), 1);
    stroke(&mask, 80, 40, 0, 9, 20);
    assert_int_equal(find(found, &mask), 0);
}

/* A piece from the bottom up to (80, 110), and another, from where a gap behind it ends on. The pieces are butted: `gap`
 * widths are between the first one's end and the other's side. */
static iris_image two_pieces(double width, double gap, double degrees, double beyond, double length)
{
    iris_image mask = blank(W, 200);
    double side = degrees < 0 ? -1 : 1;
    stroke(&mask, 80, 110 + width / 2, 180, width, 300);
    stroke(&mask, 80 - side * beyond * width, 110 - (gap + 0.5) * width, degrees, width, length);
    return mask;
}

static void a_corner_may_have_a_gap(void **state)
{
    (void)state;
    for (int width = 7; width <= 15; width += 4) {
        for (double gap = 0.5; gap <= 1.5; gap += 0.5) {
            for (int turn = -1; turn <= 1; turn += 2) {
                const double square[] = {180, 90.0 * turn}, blunt[] = {180, 60.0 * turn};
                iris_image mask = two_pieces(width, gap, square[1], 0, 300);
                expect(&mask, IRIS_JUNCTION_CORNER, 80, 110 - (gap + 0.5) * width, square, 2);
                mask = two_pieces(width, gap, blunt[1], 0, 300);
                expect(&mask, IRIS_JUNCTION_CORNER, 80, 110 - (gap + 0.5) * width, blunt, 2);
            }
        }
    }
}

/* What lies across three widths behind an end, a piece beside it, a crumb in front of it: no part of the line. */
static void an_end_near_something_else_is_one(void **state)
{
    (void)state;
    const double back = 180;
    for (int width = 7; width <= 11; width += 2) {
        iris_image mask = two_pieces(width, 3, 90, 0, 300);
        expect(&mask, IRIS_JUNCTION_END, 80, 110, &back, 1);
        mask = two_pieces(width, 3, 90, 4, 70);
        expect(&mask, IRIS_JUNCTION_END, 80, 110, &back, 1);
        mask = two_pieces(width, 1, 0, -3, 60); /* beside, and away */
        expect(&mask, IRIS_JUNCTION_END, 80, 110, &back, 1);
        mask = two_pieces(width, 0, 180, -2, 25); /* beside, and back: two lines */
        expect(&mask, IRIS_JUNCTION_END, 80, 110, &back, 1);
        mask = two_pieces(width, 0.5, 90, -1, width * 0.9);
        expect(&mask, IRIS_JUNCTION_END, 80, 110, &back, 1);
    }
}

/* Three sides of a square and most of the fourth, at the side of the picture. */
static void a_way_does_not_meet_itself(void **state)
{
    (void)state;
    iris_junction found[TOP];
    iris_image mask = blank(W, 200);
    stroke(&mask, 8, 60, 90, 9, 60);
    stroke(&mask, 68, 60, 180, 9, 60);
    stroke(&mask, 68, 120, -90, 9, 60);
    stroke(&mask, 8, 120, 0, 9, 45);
    int32_t count = find(found, &mask);
    for (int32_t i = 0; i < count; i++) {
        assert_true(hypot(found[i].x_q4 / 16.0 - 8, found[i].y_q4 / 16.0 - 60) > 9);
    }
}

static void dashes_are_one_line(void **state)
{
    (void)state;
    iris_junction found[TOP];
    for (int turn = -60; turn <= 60; turn += 15) {
        iris_image mask = blank(W, H);
        for (int from = -150; from < 150; from += 35) {
            stroke(&mask, 80 + from * sin(turn * PI / 180), 60 - from * cos(turn * PI / 180), turn, 9, 20);
        }
        assert_int_equal(find(found, &mask), 0);
    }
}

/* Glare. */
static void holes_are_no_junctions(void **state)
{
    (void)state;
    iris_junction found[TOP];
    for (int length = 1; length < 20; length++) {
        iris_image mask = blank(W, H);
        stroke(&mask, 80, 60, 0, 10, 300);
        stroke(&mask, 80, 60, 180, 10, 300);
        for (int32_t y = 50; y < 50 + length; y++) {
            ((uint32_t *)iris_image_row(&mask, y))[80 / 32] &= ~(uint32_t)(3u << 80 % 32);
        }
        assert_int_equal(find(found, &mask), 0);
    }
}

/* What hangs on a line's side, shorter than the line is wide, is no branch. */
static void short_branches_are_none(void **state)
{
    (void)state;
    iris_junction found[TOP];
    iris_image mask = blank(W, H);
    stroke(&mask, 80, 60, 0, 10, 300);
    stroke(&mask, 80, 60, 180, 10, 300);
    stroke(&mask, 80, 60, 90, 10, 12);
    assert_int_equal(find(found, &mask), 0);
    stroke(&mask, 80, 60, 90, 10, 40);
    assert_int_equal(find(found, &mask), 1);
    assert_int_equal(found[0].type, IRIS_JUNCTION_T);
}

static void the_nearest_comes_first(void **state)
{
    (void)state;
    iris_junction found[TOP];
    iris_image mask = blank(200, 200);
    stroke(&mask, 60, 150, 0, 7, 300);
    stroke(&mask, 60, 150, 180, 7, 300);
    stroke(&mask, 60, 60, 90, 7, 300);
    stroke(&mask, 60, 150, 90, 7, 300);
    stroke(&mask, 60, 150, -90, 7, 300);
    assert_int_equal(find(found, &mask), 2);
    assert_int_equal(found[0].type, IRIS_JUNCTION_CROSSING);
    assert_int_equal(found[1].type, IRIS_JUNCTION_T);
    assert_true(found[0].distance_rows < found[1].distance_rows);

    iris_junction one;
    int32_t count = 0;
    iris_scratch scratch;
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    assert_int_equal(iris_junctions_find(&one, 1, &count, &mask, NULL, &scratch), IRIS_ERR_FULL);
    assert_int_equal(count, 2);
    assert_int_equal(one.type, IRIS_JUNCTION_CROSSING);
    assert_int_equal(iris_junctions_find(NULL, 0, &count, &mask, NULL, &scratch), IRIS_ERR_FULL);
}

static void config_counts(void **state)
{
    (void)state;
    iris_junction found[TOP];
    int32_t count;
    iris_junction_config config;
    iris_scratch scratch;
    iris_image mask = blank(W, H);
    stroke(&mask, 80, 60, 180, 9, 300);
    stroke(&mask, 80, 60, -75, 9, 300);
    stroke(&mask, 80, 60, 75, 9, 300);
    iris_junction_defaults(&config);
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    assert_int_equal(iris_junctions_find(found, TOP, &count, &mask, &config, &scratch), IRIS_OK);
    assert_int_equal(found[0].type, IRIS_JUNCTION_Y);
    config.straight = iris_angle_from_degrees(35);
    assert_int_equal(iris_junctions_find(found, TOP, &count, &mask, &config, &scratch), IRIS_OK);
    assert_int_equal(found[0].type, IRIS_JUNCTION_T);
    config.branch_permil = 10000; /* longer than the picture has room for */
    assert_int_equal(iris_junctions_find(found, TOP, &count, &mask, &config, &scratch), IRIS_OK);
    assert_int_equal(count, 0);
}

static void refuses(void **state)
{
    (void)state;
    iris_junction found[TOP], before[TOP];
    int32_t count = 77;
    iris_scratch scratch;
    iris_image mask = blank(W, H), gray;
    iris_junction_config config;
    memset(found, 0x5a, sizeof found);
    memcpy(before, found, sizeof found);
    iris_junction_defaults(NULL);
    stroke(&mask, 80, 60, 180, 9, 300);
    iris_scratch_init(&scratch, memory.memory, IRIS_JUNCTION_SCRATCH_BYTES(W, H) - 1);
    assert_int_equal(iris_junctions_find(found, TOP, &count, &mask, NULL, &scratch), IRIS_ERR_SCRATCH);
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    assert_int_equal(iris_junctions_find(NULL, TOP, &count, &mask, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_junctions_find(found, -1, &count, &mask, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_junctions_find(found, TOP, NULL, &mask, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_junctions_find(found, TOP, &count, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_junctions_find(found, TOP, &count, &mask, NULL, NULL), IRIS_ERR_ARG);
    const int32_t bad[][3] = {{999, 0, 6000},     {10001, 0, 6000}, {1500, -1, 6000},
                              {1500, 8193, 6000}, {1500, 0, 1819},  {1500, 0, 16385}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        config = (iris_junction_config){bad[i][0], (iris_angle)bad[i][1], (iris_angle)bad[i][2]};
        assert_int_equal(iris_junctions_find(found, TOP, &count, &mask, &config, &scratch), IRIS_ERR_ARG);
    }
    iris_image_wrap(&gray, words, sizeof words, (iris_size){80, 60}, 0, IRIS_GRAY8);
    assert_int_equal(iris_junctions_find(found, TOP, &count, &gray, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(count, 77);
    assert_memory_equal(found, before, sizeof found);
}

/* Noise, combs, grids, and solid masks of odd sizes: answers at all, and nothing outside of the picture. */
static void hostile_masks(void **state)
{
    (void)state;
    iris_junction found[TOP];
    uint32_t random = 7;
    for (int round = 0; round < 300; round++) {
        int32_t w = 1 + round * 37 % 200, h = 1 + round * 53 % 190, kind = round % 5;
        iris_image mask = blank(w, h);
        for (int32_t i = 0; i < w * h; i++) {
            random = random * 1664525u + 1013904223u;
            int32_t x = i % w, y = i / w;
            int on = kind == 0   ? random >> 31
                     : kind == 1 ? (int)(random >> 28) < 14
                     : kind == 2 ? x % 9 < 4 || y < 3
                     : kind == 3 ? x % 12 < 3 || y % 10 < 3
                                 : 1;
            if (on) {
                set(&mask, x, y);
            }
        }
        iris_scratch scratch;
        int32_t count = -1;
        iris_scratch_init(&scratch, memory.memory, IRIS_JUNCTION_SCRATCH_BYTES(w, h));
        iris_status status = iris_junctions_find(found, TOP, &count, &mask, NULL, &scratch);
        assert_int_equal(status, IRIS_OK);
        assert_in_range(count, 0, IRIS_JUNCTIONS_MAX);
        for (int32_t k = 0; k < count; k++) {
            assert_in_range(found[k].x_q4, 0, (w - 1) * 16);
            assert_in_range(found[k].y_q4, 0, (h - 1) * 16);
            assert_in_range(found[k].branch_count, 1, IRIS_JUNCTION_BRANCHES);
            assert_in_range(found[k].confidence_permil, 0, 1000);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_t),
        cmocka_unit_test(finds_y),
        cmocka_unit_test(finds_crossing),
        cmocka_unit_test(finds_corner),
        cmocka_unit_test(finds_end),
        cmocka_unit_test(nothing_in_lines_and_curves),
        cmocka_unit_test(an_end_before_a_gap_is_none),
        cmocka_unit_test(a_corner_may_have_a_gap),
        cmocka_unit_test(an_end_near_something_else_is_one),
        cmocka_unit_test(a_way_does_not_meet_itself),
        cmocka_unit_test(dashes_are_one_line),
        cmocka_unit_test(holes_are_no_junctions),
        cmocka_unit_test(short_branches_are_none),
        cmocka_unit_test(the_nearest_comes_first),
        cmocka_unit_test(config_counts),
        cmocka_unit_test(refuses),
        cmocka_unit_test(hostile_masks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
