/* Drawing: figures drawn by hand as text, clipping against figures on a larger image, and the extremes of
 * int32_t. */
#include "iris/draw.h"
#include "test.h"

static const iris_color white = {255, 255, 255};

/* Compares a gray image with rows of text: '#' is 255, '.' is 0. */
static void assert_drawn(const iris_image *image, const char *const *rows)
{
    for (int32_t y = 0; y < image->h; y++) {
        char line[128] = {0};
        const uint8_t *row = iris_image_row(image, y);
        for (int32_t x = 0; x < image->w; x++) {
            line[x] = row[x] == 255 ? '#' : row[x] == 0 ? '.' : '?';
        }
        assert_string_equal(line, rows[y]);
    }
}

static iris_image gray(uint8_t *buffer, size_t bytes, int32_t w, int32_t h)
{
    iris_image image;
    memset(buffer, 0, bytes);
    assert_int_equal(iris_image_wrap(&image, buffer, bytes, (iris_size){w, h}, 0, IRIS_GRAY8), IRIS_OK);
    return image;
}

static void lines_as_drawn_by_hand(void **state)
{
    (void)state;
    uint8_t buffer[64];
    iris_image image = gray(buffer, sizeof buffer, 8, 8);
    assert_int_equal(iris_draw_line(&image, 0, 0, 7, 2, white), IRIS_OK);
    assert_int_equal(iris_draw_line(&image, 0, 7, 7, 7, white), IRIS_OK);
    assert_int_equal(iris_draw_line(&image, 0, 3, 0, 6, white), IRIS_OK);
    assert_int_equal(iris_draw_line(&image, 5, 6, 3, 3, white), IRIS_OK);
    assert_int_equal(iris_draw_line(&image, 7, 5, 7, 5, white), IRIS_OK);
    const char *const expected[] = {"##......", "..####..", "......##", "#..#....",
                                    "#...#...", "#...#..#", "#....#..", "########"};
    assert_drawn(&image, expected);
}

static void a_line_is_the_same_from_either_end(void **state)
{
    (void)state;
    uint8_t one[15 * 15], two[15 * 15];
    iris_image a, b;
    for (int end = 0; end < 15 * 15; end++) {
        a = gray(one, sizeof one, 15, 15);
        b = gray(two, sizeof two, 15, 15);
        assert_int_equal(iris_draw_line(&a, 7, 7, end % 15, end / 15, white), IRIS_OK);
        assert_int_equal(iris_draw_line(&b, end % 15, end / 15, 7, 7, white), IRIS_OK);
        assert_memory_equal(one, two, sizeof one);
    }
    /* A tie: (0, 0) to (2, 1) passes exactly between (1, 0) and (1, 1); the right end's side is drawn. */
    const char *const tie[] = {"#..", ".##"};
    a = gray(one, sizeof one, 3, 2);
    assert_int_equal(iris_draw_line(&a, 2, 1, 0, 0, white), IRIS_OK);
    assert_drawn(&a, tie);
}

/* Every pixel of a line is the nearest to the exact one, by double arithmetic. */
static void far_lines_stay_on_the_exact_line(void **state)
{
    (void)state;
    static uint8_t buffer[40 * 30];
    const int32_t ends[][4] = {{INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX},
                               {INT32_MIN + 30, INT32_MAX, INT32_MAX, INT32_MIN + 30},
                               {INT32_MIN, -7, INT32_MAX, 37},
                               {-7, INT32_MAX, 44, INT32_MIN},
                               {INT32_MIN, 12, INT32_MAX, 12},
                               {3, INT32_MIN, 3, INT32_MAX},
                               {-1000003, -999999, 2000000, 2000012},
                               {-50, 33, 61, -9}};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        const int32_t *e = ends[i];
        iris_image image = gray(buffer, sizeof buffer, 40, 30);
        assert_int_equal(iris_draw_line(&image, e[0], e[1], e[2], e[3], white), IRIS_OK);
        double dx = (double)e[2] - e[0], dy = (double)e[3] - e[1];
        int steep = (dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx);
        int drawn = 0;
        for (int32_t y = 0; y < 30; y++) {
            for (int32_t x = 0; x < 40; x++) {
                /* distance along the minor axis */
                double off = steep ? x - (e[0] + (y - (double)e[1]) / dy * dx)
                                   : y - (e[1] + (x - (double)e[0]) / dx * dy);
                double far = off < 0 ? -off : off;
                int set = buffer[40 * y + x] == 255;
                assert_true(set ? far < 0.5 + 1e-4 : far > 0.5 - 1e-4);
                drawn += set;
            }
        }
        assert_true(drawn > 20);
    }
}

static void outside_lines_draw_nothing(void **state)
{
    (void)state;
    uint8_t buffer[64], none[64] = {0};
    iris_image image = gray(buffer, sizeof buffer, 8, 8);
    const int32_t far[] = {INT32_MIN, INT32_MIN + 1, -40, -1, 8, 40, INT32_MAX - 1, INT32_MAX};
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 8; k++) {
            assert_int_equal(iris_draw_line(&image, far[i], far[k], far[i], far[k], white), IRIS_OK);
            assert_int_equal(iris_draw_line(&image, far[i], -1, far[k], -1, white), IRIS_OK);
            assert_int_equal(iris_draw_line(&image, 8, far[i], 8, far[k], white), IRIS_OK);
        }
    }
    assert_memory_equal(buffer, none, sizeof none);
}

static void figures_as_drawn_by_hand(void **state)
{
    (void)state;
    uint8_t buffer[15 * 9];
    iris_image image = gray(buffer, sizeof buffer, 15, 9);
    assert_int_equal(iris_draw_rect(&image, (iris_rect){0, 0, 5, 4}, white), IRIS_OK);
    assert_int_equal(iris_draw_rect_filled(&image, (iris_rect){1, 5, 3, 2}, white), IRIS_OK);
    assert_int_equal(iris_draw_rect(&image, (iris_rect){0, 8, 1, 1}, white), IRIS_OK);
    assert_int_equal(iris_draw_rect_filled(&image, (iris_rect){2, 8, 0, 1}, white), IRIS_OK);
    assert_int_equal(iris_draw_rect(&image, (iris_rect){4, 8, 3, -1}, white), IRIS_OK);
    assert_int_equal(iris_draw_circle(&image, 10, 4, 4, white), IRIS_OK);
    assert_int_equal(iris_draw_cross(&image, 10, 4, 1, white), IRIS_OK);
    const char *const expected[] = {"#####....###...", "#...#..##...##.", "#...#..#.....#.",
                                    "#####.#...#...#", "......#..###..#", ".###..#...#...#",
                                    ".###...#.....#.", ".......##...##.", "#........###..."};
    assert_drawn(&image, expected);
}

static void circles_of_radius_0_to_3(void **state)
{
    (void)state;
    uint8_t buffer[7 * 7];
    const char *const expected[4][7] = {
        {".......", ".......", ".......", "...#...", ".......", ".......", "......."},
        {".......", ".......", "...#...", "..#.#..", "...#...", ".......", "......."},
        {".......", "..###..", ".#...#.", ".#...#.", ".#...#.", "..###..", "......."},
        {"..###..", ".#...#.", "#.....#", "#.....#", "#.....#", ".#...#.", "..###.."}};
    for (int32_t radius = 0; radius < 4; radius++) {
        iris_image image = gray(buffer, sizeof buffer, 7, 7);
        assert_int_equal(iris_draw_circle(&image, 3, 3, radius, white), IRIS_OK);
        assert_drawn(&image, expected[radius]);
    }
}

/* Every pixel of a large circle is the nearest to the exact one in its column or row. */
static void large_circles_are_round(void **state)
{
    (void)state;
    static uint8_t buffer[301 * 301];
    for (int32_t radius = 4; radius <= 150; radius += 73) {
        iris_image image = gray(buffer, sizeof buffer, 301, 301);
        assert_int_equal(iris_draw_circle(&image, 150, 150, radius, white), IRIS_OK);
        int drawn = 0;
        for (int32_t i = 0; i < 301 * 301; i++) {
            double a = i % 301 - 150, b = i / 301 - 150;
            a = a < 0 ? -a : a;
            b = b < 0 ? -b : b;
            double high = a > b ? a : b, low = a > b ? b : a;
            /* on the exact circle between high - 1/2 and high + 1/2, seen along the longer coordinate */
            double inner = (high - 0.5) * (high - 0.5) + low * low,
                   outer = (high + 0.5) * (high + 0.5) + low * low;
            double square = (double)radius * radius;
            int near = inner <= square && square < outer;
            if (high - low > 1) { /* at the diagonal both octants may contribute */
                assert_int_equal(buffer[i] == 255, near);
            }
            drawn += buffer[i] == 255;
        }
        assert_true(drawn > 5 * radius);
    }
}

/* What is drawn on a cut-out must be the cut-out of what is drawn on the whole. */
static void clipping_keeps_the_pixels(void **state)
{
    (void)state;
    static uint8_t small[31 * 23], large[200 * 200];
    unsigned seed = 1;
    for (int round = 0; round < 400; round++) {
        int32_t at[4];
        for (int i = 0; i < 4; i++) {
            seed = seed * 1103515245u + 12345u;
            at[i] = (int32_t)(seed >> 16) % 120 - 40;
        }
        iris_image a = gray(small, sizeof small, 31, 23), b = gray(large, sizeof large, 200, 200), part;
        for (int pass = 0; pass < 2; pass++) {
            iris_image *to = pass ? &b : &a;
            int32_t by = pass ? 80 : 0, x = at[0] + by, y = at[1] + by, wide = at[2] > 0 ? at[2] : -at[2];
            switch (round % 5) {
            case 0:
                iris_draw_line(to, x, y, at[2] + by, at[3] + by, white);
                break;
            case 1:
                iris_draw_rect(to, (iris_rect){x, y, wide, wide / 2}, white);
                break;
            case 2:
                iris_draw_circle(to, x, y, wide, white);
                break;
            case 3:
                iris_draw_cross(to, x, y, wide, white);
                break;
            default:
                iris_draw_text(to, x, y, "Wq@\n9~", 1 + wide % 4, white);
            }
        }
        assert_int_equal(iris_image_crop(&part, &b, (iris_rect){80, 80, 31, 23}), IRIS_OK);
        for (int32_t y = 0; y < 23; y++) {
            assert_memory_equal(iris_image_row(&a, y), iris_image_row(&part, y), 31);
        }
    }
}

static void extremes_are_safe(void **state)
{
    (void)state;
    uint8_t guarded[3 * 64];
    iris_image image;
    const int32_t far[] = {INT32_MIN, INT32_MIN + 1, -1, 0, 3, 7, 8, INT32_MAX - 1, INT32_MAX};
    memset(guarded, 0xA5, sizeof guarded);
    assert_int_equal(iris_image_wrap(&image, guarded + 64, 64, (iris_size){8, 8}, -8, IRIS_GRAY8), IRIS_OK);
    for (int i = 0; i < 9 * 9; i++) {
        int32_t x = far[i / 9], y = far[i % 9];
        for (int k = 0; k < 9 * 9; k++) {
            iris_draw_line(&image, x, y, far[k / 9], far[k % 9], white);
            iris_draw_rect(&image, (iris_rect){x, y, far[k / 9], far[k % 9]}, white);
            iris_draw_rect_filled(&image, (iris_rect){x, y, far[k / 9], far[k % 9]}, white);
        }
        for (int k = 0; k < 9; k++) {
            iris_draw_cross(&image, x, y, far[k], white);
        }
        iris_draw_circle(&image, x, y, 100, white);
        iris_draw_text(&image, x, y, "IRIS\n\x80\x01", IRIS_TEXT_SCALE_MAX, white);
    }
    for (int i = 0; i < 64; i++) {
        assert_int_equal(guarded[i], 0xA5);
        assert_int_equal(guarded[128 + i], 0xA5);
    }
}

static void text_as_drawn_by_hand(void **state)
{
    (void)state;
    uint8_t buffer[24 * 15];
    iris_image image = gray(buffer, sizeof buffer, 17, 15);
    assert_int_equal(iris_draw_text(&image, 0, 0, "A7\x7F\ni", 1, white), IRIS_OK);
    const char *const expected[] = {".###..#####.#####", "#...#.....#.#...#", "#...#....#..#...#",
                                    "#...#...#...#...#", "#####..#....#...#", "#...#..#....#...#",
                                    "#...#..#....#####", ".................", "..#..............",
                                    ".................", ".##..............", "..#..............",
                                    "..#..............", "..#..............", ".###............."};
    assert_drawn(&image, expected);

    iris_image twice = gray(buffer, sizeof buffer, 10, 14);
    assert_int_equal(iris_draw_text(&twice, 0, 0, "-", 2, white), IRIS_OK);
    for (int i = 0; i < 140; i++) {
        assert_int_equal(buffer[i], i / 10 == 6 || i / 10 == 7 ? 255 : 0);
    }
}

static void text_size(void **state)
{
    (void)state;
    iris_size size = iris_draw_text_size("A7\x7F\ni", 1);
    assert_int_equal(size.w, 17);
    assert_int_equal(size.h, 15);
    size = iris_draw_text_size("x", 3);
    assert_int_equal(size.w, 15);
    assert_int_equal(size.h, 21);
    assert_int_equal(iris_draw_text_size("", 1).h, 0);
    assert_int_equal(iris_draw_text_size("x", 0).w, 0);
    assert_int_equal(iris_draw_text_size(NULL, 1).w, 0);
}

/* Each printable character has its own picture. */
static void glyphs_differ(void **state)
{
    (void)state;
    static uint8_t pictures[95][5 * 7];
    for (int i = 0; i < 95; i++) {
        const char text[] = {(char)(' ' + i), 0};
        iris_image image = gray(pictures[i], sizeof pictures[i], 5, 7);
        assert_int_equal(iris_draw_text(&image, 0, 0, text, 1, white), IRIS_OK);
        for (int k = 0; k < i; k++) {
            assert_memory_not_equal(pictures[i], pictures[k], 35);
        }
    }
}

static void colors_in_every_format(void **state)
{
    (void)state;
    const iris_color orange = {255, 128, 0}, dark = {100, 100, 200};
    uint32_t words[8] = {0};
    uint8_t *bytes = (uint8_t *)words;
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, words, 6, (iris_size){2, 1}, 0, IRIS_RGB888), IRIS_OK);
    assert_int_equal(iris_draw_line(&image, 1, 0, 1, 0, orange), IRIS_OK);
    assert_memory_equal(bytes, ((uint8_t[]){0, 0, 0, 255, 128, 0, 0}), 7);
    assert_int_equal(iris_image_wrap(&image, words, 6, (iris_size){2, 1}, 0, IRIS_BGR888), IRIS_OK);
    assert_int_equal(iris_draw_line(&image, 0, 0, 0, 0, orange), IRIS_OK);
    assert_memory_equal(bytes, ((uint8_t[]){0, 128, 255, 255, 128, 0, 0}), 7);
    assert_int_equal(iris_image_wrap(&image, words, 1, (iris_size){1, 1}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_draw_line(&image, 0, 0, 0, 0, orange), IRIS_OK);
    assert_int_equal(bytes[0], 152); /* 0.299 * 255 + 0.587 * 128 = 151.4; with 77 and 150 of 256: 151.7 */

    memset(words, 0, sizeof words);
    assert_int_equal(iris_image_wrap(&image, words, sizeof words, (iris_size){40, 4}, 0, IRIS_MASK1),
                     IRIS_OK);
    assert_int_equal(iris_draw_rect_filled(&image, (iris_rect){30, 1, 99, 2}, orange), IRIS_OK);
    assert_int_equal(iris_draw_line(&image, 32, 2, 33, 2, dark), IRIS_OK);
    const uint32_t expected[8] = {0, 0, 0xC0000000u, 0xFFu, 0xC0000000u, 0xFCu, 0, 0};
    assert_memory_equal(words, expected, sizeof expected);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    uint32_t words[16] = {0};
    iris_image image, bad;
    assert_int_equal(iris_image_wrap(&image, words, sizeof words, (iris_size){8, 8}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_draw_line(NULL, 0, 0, 1, 1, white), IRIS_ERR_ARG);
    assert_int_equal(iris_draw_text(&image, 0, 0, NULL, 1, white), IRIS_ERR_ARG);
    assert_int_equal(iris_draw_text(&image, 0, 0, "x", 0, white), IRIS_ERR_RANGE);
    assert_int_equal(iris_draw_text(&image, 0, 0, "x", IRIS_TEXT_SCALE_MAX + 1, white), IRIS_ERR_RANGE);
    assert_int_equal(iris_draw_circle(&image, 0, 0, -1, white), IRIS_ERR_RANGE);
    assert_int_equal(iris_draw_circle(&image, 0, 0, IRIS_SIDE_MAX + 1, white), IRIS_ERR_RANGE);
    assert_int_equal(iris_draw_cross(&image, 0, 0, -1, white), IRIS_ERR_RANGE);
    bad = image;
    bad.format = IRIS_HSL24;
    bad.w = 2;
    assert_int_equal(iris_draw_rect(&bad, (iris_rect){0, 0, 2, 2}, white), IRIS_ERR_FORMAT);
    assert_int_equal(iris_draw_rect_filled(&bad, (iris_rect){0, 0, 2, 2}, white), IRIS_ERR_FORMAT);
    bad = image;
    bad.h = 0;
    assert_int_equal(iris_draw_cross(&bad, 0, 0, 1, white), IRIS_ERR_RANGE);
    for (int i = 0; i < 16; i++) {
        assert_int_equal(words[i], 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_as_drawn_by_hand),
        cmocka_unit_test(a_line_is_the_same_from_either_end),
        cmocka_unit_test(far_lines_stay_on_the_exact_line),
        cmocka_unit_test(outside_lines_draw_nothing),
        cmocka_unit_test(figures_as_drawn_by_hand),
        cmocka_unit_test(circles_of_radius_0_to_3),
        cmocka_unit_test(large_circles_are_round),
        cmocka_unit_test(clipping_keeps_the_pixels),
        cmocka_unit_test(extremes_are_safe),
        cmocka_unit_test(text_as_drawn_by_hand),
        cmocka_unit_test(text_size),
        cmocka_unit_test(glyphs_differ),
        cmocka_unit_test(colors_in_every_format),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("draw", tests, NULL, NULL);
}
