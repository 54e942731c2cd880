/* Boards in pictures that were made in double precision, so that it is known where their corners are: found, in
 * order, and to a fraction of a pixel; what is no board is refused with the reason. */
#include "iris/3d/board_find.h"

#include <stdio.h>

#include "board_scene.h"
#include "test.h"

#define W      320
#define H      240
#define POINTS 256

static uint8_t pixels[W * H];
static double work[2 * W * H];
static IRIS_SCRATCH_BUFFER(memory, IRIS_BOARD_CORNERS_SCRATCH_BYTES(W, H, 16, 16));
static iris_vec2 found[POINTS];
static iris_board_report report;
static double truth[POINTS][2];

static double real(iris_q32 a)
{
    return (double)a / 4294967296.0;
}

static iris_image view_of(int w, int h)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, pixels, sizeof pixels, (iris_size){w, h}, 0, IRIS_GRAY8),
                     IRIS_OK);
    return image;
}

static void know(const board_scene *s)
{
    scene_know(truth, s);
}

/* Any pose in which lines are `least` pixels apart. */
static board_scene random_scene(int columns, int rows, double tilt, double least)
{
    board_scene s = scene_of(SCENE_CHESS, columns, rows, W, H);
    scene_pose(truth, &s, tilt, least);
    return s;
}

static iris_status find(const iris_image *image, int columns, int rows)
{
    const iris_board_grid grid = {columns, rows};
    iris_scratch scratch;
    const size_t bytes = IRIS_BOARD_CORNERS_SCRATCH_BYTES((size_t)image->w, (size_t)image->h, columns, rows);
    assert_true(bytes <= sizeof memory.memory);
    (void)iris_scratch_init(&scratch, memory.memory, bytes);
    iris_status status = iris_board_corners(found, &report, image, &grid, &scratch);
    assert_int_equal(scratch.used, 0);
    assert_true(status == IRIS_OK || status == IRIS_ERR_DATA);
    assert_int_equal(report.sight == IRIS_BOARD_SEEN, status == IRIS_OK);
    return status;
}

typedef struct {
    double squares, most;
    int count;
} errors;

/* Adds what is off; which way round it was found. */
static int compare(errors *e, const board_scene *s)
{
    int best = -1;
    double least = 1e9;
    for (int turn = 0; turn < 4; turn++) {
        double off = hypot(real(found[0].x) - truth[scene_turned(s, turn, 0)][0],
                           real(found[0].y) - truth[scene_turned(s, turn, 0)][1]);
        if ((!(turn & 1) || s->columns == s->rows) && off < least) {
            least = off;
            best = turn;
        }
    }
    for (int k = 0; k < s->columns * s->rows; k++) {
        const double *at = truth[scene_turned(s, best, k)];
        const double off = hypot(real(found[k].x) - at[0], real(found[k].y) - at[1]);
        e->squares += off * off;
        e->most = fmax(e->most, off);
        e->count++;
    }
    return best;
}

/* As the header says: dark first, and then the first row as level as can be. */
static int turn_wanted(const board_scene *s)
{
    int best = 0;
    double least = 9;
    for (int turn = 0; turn < 4; turn++) {
        const double *from = truth[scene_turned(s, turn, 0)],
                     *to = truth[scene_turned(s, turn, s->columns - 1)];
        const int dark = turn == 0 || (turn == 2 ? (s->columns + s->rows) % 2 == 0 : s->columns % 2 == 0);
        const double angle = fabs(atan2(to[1] - from[1], to[0] - from[0]));
        if (dark && (!(turn & 1) || s->columns == s->rows) && angle < least) {
            least = angle;
            best = turn;
        }
    }
    return best;
}

static void random_views(void **state)
{
    (void)state;
    static const struct {
        double tilt, least, noise, dark, bright;
        int blur, clutter;
        double rms, most;
    } kinds[] = {{1.0, 9, 0, 30, 220, 1, 0, 0.03, 0.15},  {1.0, 9, 4, 30, 220, 1, 1, 0.07, 0.25},
                 {1.1, 7, 0, 30, 220, 0, 1, 0.05, 0.2},   {0.8, 10, 10, 30, 220, 1, 1, 0.12, 0.5},
                 {0.8, 11, 0, 30, 220, 8, 0, 0.03, 0.15}, {0.8, 9, 2, 20, 50, 1, 0, 0.15, 0.5}};
    static const int boards[][2] = {{9, 6}, {7, 6}, {6, 4}, {5, 5}, {4, 4}, {3, 3}, {7, 5}, {6, 9}, {3, 8}};
    for (size_t kind = 0; kind < sizeof kinds / sizeof kinds[0]; kind++) {
        errors e = {0, 0, 0};
        int missed = 0;
        for (int n = 0; n < 9; n++) {
            iris_image image = view_of(W, H);
            board_scene s = random_scene(boards[n][0], boards[n][1], kinds[kind].tilt, kinds[kind].least);
            s.clutter = kinds[kind].clutter;
            s.dark = kinds[kind].dark;
            s.bright = kinds[kind].bright;
            scene_render(&image, work, &s, kinds[kind].blur, kinds[kind].noise);
            if (find(&image, s.columns, s.rows) != IRIS_OK) {
                printf("#: %dx%d: sight %d, %d of %dx%d\n", s.columns, s.rows, (int)report.sight,
                       (int)report.seen, (int)report.columns, (int)report.rows);
                missed++;
                continue;
            }
            assert_int_equal(compare(&e, &s), turn_wanted(&s));
        }
        printf("#: noise %.0f, blurred %d times, %.0f to %.0f: off by %.4f pixels (rms), %.3f at most; %d "
               "missed\n",
               kinds[kind].noise, kinds[kind].blur, kinds[kind].dark, kinds[kind].bright,
               sqrt(e.squares / (e.count + !e.count)), e.most, missed);
        assert_true(missed == 0 && sqrt(e.squares / e.count) < kinds[kind].rms && e.most < kinds[kind].most);
    }
}

/* 9x6 corners that face the camera, 24 pixels apart, the first at (64, 60). */
static board_scene plain_scene(void)
{
    board_scene s = scene_of(SCENE_CHESS, 9, 6, W, H);
    scene_turn(&s, 0, 0, 0);
    scene_place(&s, 0, 0, 12.5);
    know(&s);
    return s;
}

/* By whole turns of quarters, mirrored, and in negative: the order follows the board, but a mirror image has none
 * of its own. */
static void other_ways_round(void **state)
{
    (void)state;
    static uint8_t straight[W * H];
    board_scene s = plain_scene();
    iris_image image = view_of(W, H);
    scene_render(&image, work, &s, 1, 0);
    memcpy(straight, pixels, sizeof straight);
    for (int way = 0; way < 5; way++) {
        const int w = way == 1 || way == 3 ? H : W, h = W * H / w;
        image = view_of(w, h);
        for (int y = 0; y < h; y++) {
            for (int x = 0; x < w; x++) {
                const int from_x = way == 0   ? x
                                   : way == 1 ? y
                                   : way == 2 ? W - 1 - x
                                   : way == 3 ? W - 1 - y
                                              : W - 1 - x;
                const int from_y = way == 0   ? y
                                   : way == 1 ? H - 1 - x
                                   : way == 2 ? H - 1 - y
                                   : way == 3 ? x
                                              : y;
                pixels[y * w + x] = straight[from_y * W + from_x];
            }
        }
        assert_int_equal(find(&image, 9, 6), IRIS_OK);
        for (int k = 0; k < 54; k++) {
            const double *at = truth[way == 4 ? 45 - k / 9 * 9 + k % 9 : k];
            const double x = at[0], y = at[1];
            const double want_x = way == 0 ? x : way == 1 ? H - 1 - y : way == 2 || way == 4 ? W - 1 - x : y;
            const double want_y = way == 0 || way == 4 ? y : way == 1 ? x : way == 2 ? H - 1 - y : W - 1 - x;
            if (way < 4) {
                assert_true(hypot(real(found[k].x) - want_x, real(found[k].y) - want_y) < 0.1);
            }
        }
        const double along_x = real(found[8].x - found[0].x), along_y = real(found[8].y - found[0].y);
        const double down_x = real(found[45].x - found[0].x), down_y = real(found[45].y - found[0].y);
        assert_true(along_x * down_y - along_y * down_x > 0);
        assert_int_equal(find(&image, 6, 9), IRIS_OK); /* the same board, by columns */
    }
    for (int k = 0; k < W * H; k++) {
        pixels[k] = (uint8_t)(255 - straight[k]);
    }
    image = view_of(W, H);
    assert_int_equal(find(&image, 9, 6), IRIS_OK);
    assert_true(fabs(real(found[53].x) - truth[0][0]) < 0.1 && fabs(real(found[53].y) - truth[0][1]) < 0.1);
}

/* Rows behind each other, rows from below, and a part of a picture are the same board. */
static void strides_and_parts(void **state)
{
    (void)state;
    static uint8_t wide[(W + 7) * (H + 3)];
    iris_vec2 straight[54];
    board_scene s = plain_scene();
    iris_image image = view_of(W, H), other, part;
    scene_render(&image, work, &s, 1, 3);
    assert_int_equal(find(&image, 9, 6), IRIS_OK);
    memcpy(straight, found, sizeof straight);
    for (int upside = 0; upside < 2; upside++) {
        assert_int_equal(iris_image_wrap(&other, wide, sizeof wide, (iris_size){W + 5, H + 3},
                                         upside ? -(W + 7) : W + 7, IRIS_GRAY8),
                         IRIS_OK);
        assert_int_equal(iris_image_crop(&part, &other, (iris_rect){5, 2, W, H}), IRIS_OK);
        for (int y = 0; y < H; y++) {
            memcpy(iris_image_row(&part, y), pixels + (size_t)y * W, W);
        }
        memset(found, 0, sizeof found);
        assert_int_equal(find(&part, 9, 6), IRIS_OK);
        assert_memory_equal(found, straight, sizeof straight);
    }
}

static void no_board(void **state)
{
    (void)state;
    const int sizes[][2] = {{1, 1}, {2, 3}, {13, 13}, {1, 240}, {320, 1}, {W, H}};
    for (int n = 0; n < 6; n++) {
        iris_image image = view_of(sizes[n][0], sizes[n][1]);
        for (int kind = 0; kind < 4; kind++) {
            for (int k = 0; k < sizes[n][0] * sizes[n][1]; k++) {
                const uint64_t random = random_u64();
                pixels[k] = (uint8_t)(kind == 0                                 ? 77
                                      : kind == 1                               ? (random & 1 ? 255 : 0)
                                      : kind == 2                               ? random
                                      : (k % sizes[n][0] ^ k / sizes[n][0]) & 1 ? 255
                                                                                : 0);
            }
            assert_int_equal(find(&image, 9, 6), IRIS_ERR_DATA);
            assert_true(kind || report.sight == IRIS_BOARD_UNSEEN);
            assert_true(report.seen < 27);
            assert_true(find(&image, 3, 3) == IRIS_ERR_DATA || kind == 1 || kind == 2);
        }
    }
    board_scene s = plain_scene(); /* stripes, squares, and dots alone */
    iris_image image = view_of(W, H);
    s.clutter = 1;
    scene_place(&s, 3000, 0, 12.5);
    scene_render(&image, work, &s, 1, 2);
    assert_int_equal(find(&image, 9, 6), IRIS_ERR_DATA);
}

static void reasons(void **state)
{
    (void)state;
    board_scene s = plain_scene();
    iris_image image = view_of(W, H), part;
    scene_render(&image, work, &s, 1, 0);
    assert_int_equal(find(&image, 8, 6), IRIS_ERR_DATA);
    assert_int_equal(report.sight, IRIS_BOARD_LARGER);
    assert_true(report.seen == 54 && report.columns == 9 && report.rows == 6);
    assert_int_equal(find(&image, 9, 5), IRIS_ERR_DATA);
    assert_int_equal(report.sight, IRIS_BOARD_LARGER);
    assert_int_equal(find(&image, 10, 6), IRIS_ERR_DATA);
    assert_true(report.sight == IRIS_BOARD_PARTLY && report.seen == 54);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){0, 0, 200, H}), IRIS_OK);
    assert_int_equal(find(&part, 9, 6), IRIS_ERR_DATA); /* corners at 64, 88, ... 184 */
    assert_true(report.sight == IRIS_BOARD_CUT && report.seen == 36 && report.columns == 6 &&
                report.rows == 6);
    for (int y = 96; y < 144; y++) { /* a hand before it */
        memset(pixels + y * W + 140, 140, 40);
    }
    assert_int_equal(find(&image, 9, 6), IRIS_ERR_DATA);
    assert_true(report.sight == IRIS_BOARD_PARTLY && report.seen < 54 && report.seen > 40);
}

static void wrong_calls(void **state)
{
    (void)state;
    iris_scratch scratch;
    board_scene s = plain_scene();
    iris_image image = view_of(W, H), odd;
    scene_render(&image, work, &s, 1, 0);
    const size_t bytes = IRIS_BOARD_CORNERS_SCRATCH_BYTES(W, H, 9, 6);
    iris_board_grid grid = {9, 6};
    const iris_vec2 nowhere = {-5, -7};
    const iris_board_report none = {IRIS_BOARD_LARGER, -1, -2, -3};
    for (int k = 0; k < POINTS; k++) {
        found[k] = nowhere;
    }
    report = none;
    (void)iris_scratch_init(&scratch, memory.memory, bytes - 1);
    assert_int_equal(iris_board_corners(found, &report, &image, &grid, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    (void)iris_scratch_init(&scratch, memory.memory, bytes);
    assert_int_equal(iris_board_corners(NULL, &report, &image, &grid, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_board_corners(found, NULL, &image, &grid, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_board_corners(found, &report, NULL, &grid, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_board_corners(found, &report, &image, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_board_corners(found, &report, &image, &grid, NULL), IRIS_ERR_ARG);
    const iris_board_grid wrong[] = {{2, 6}, {9, 2}, {65, 6}, {9, 65}, {-1, INT32_MAX}};
    for (int k = 0; k < 5; k++) {
        assert_int_equal(iris_board_corners(found, &report, &image, &wrong[k], &scratch), IRIS_ERR_RANGE);
    }
    odd = image;
    odd.format = IRIS_MASK1;
    assert_int_equal(iris_board_corners(found, &report, &odd, &grid, &scratch), IRIS_ERR_FORMAT);
    odd = image;
    odd.w = 0;
    assert_int_equal(iris_board_corners(found, &report, &odd, &grid, &scratch), IRIS_ERR_RANGE);
    assert_memory_equal(&report, &none, sizeof none);
    for (int k = 0; k < POINTS; k++) {
        assert_memory_equal(&found[k], &nowhere, sizeof nowhere);
    }
    grid.columns = 8;
    assert_int_equal(iris_board_corners(found, &report, &image, &grid, &scratch), IRIS_ERR_DATA);
    assert_memory_equal(&found[0], &nowhere, sizeof nowhere);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_views),      cmocka_unit_test(other_ways_round),
        cmocka_unit_test(strides_and_parts), cmocka_unit_test(no_board),
        cmocka_unit_test(reasons),           cmocka_unit_test(wrong_calls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
