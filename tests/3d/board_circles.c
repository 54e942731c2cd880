/* Grids of circles in pictures that were made in double precision: found in order, and where the circles' centers
 * are, not those of the ellipses. */
#include <stdio.h>

#include "board_scene.h"
#include "iris/3d/board_find.h"
#include "test.h"

#define W      320
#define H      240
#define POINTS 64

static uint8_t pixels[W * H];
static double work[2 * W * H];
static IRIS_SCRATCH_BUFFER(memory, IRIS_BOARD_CIRCLES_SCRATCH_BYTES(W, H, 8, 8));
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

static iris_status find(const iris_image *image, int kind, int columns, int rows)
{
    const iris_board_grid grid = {columns, rows};
    iris_scratch scratch;
    const size_t bytes = IRIS_BOARD_CIRCLES_SCRATCH_BYTES((size_t)image->w, (size_t)image->h, columns, rows);
    assert_true(bytes <= sizeof memory.memory);
    (void)iris_scratch_init(&scratch, memory.memory, bytes);
    iris_status status =
        iris_board_circles(found, &report, image, &grid,
                           kind == SCENE_SHIFTED ? IRIS_BOARD_CIRCLES_SHIFTED : IRIS_BOARD_CIRCLES, &scratch);
    assert_int_equal(scratch.used, 0);
    assert_true(status == IRIS_OK || status == IRIS_ERR_DATA);
    assert_int_equal(report.sight == IRIS_BOARD_SEEN, status == IRIS_OK);
    return status;
}

/* As the header says: the first row as level as can be. */
static int turn_wanted(const board_scene *s)
{
    int best = 0;
    double least = 9;
    for (int turn = 0; turn < 4; turn++) {
        const double *from = truth[scene_turned(s, turn & (s->columns == s->rows ? 3 : 2), 0)],
                     *to = truth[scene_turned(s, turn & (s->columns == s->rows ? 3 : 2), s->columns - 1)];
        const double angle = fabs(atan2(to[1] - from[1], to[0] - from[0]));
        const int fits = s->kind == SCENE_SHIFTED ? turn == 0 || (turn == 2 && s->rows % 2 == 0)
                                                  : !(turn & 1) || s->columns == s->rows;
        if (fits && angle < least) {
            least = angle;
            best = turn;
        }
    }
    return best;
}

typedef struct {
    double squares, most;
    int count;
} errors;

static void compare(errors *e, const board_scene *s)
{
    const int turn = turn_wanted(s);
    for (int k = 0; k < s->columns * s->rows; k++) {
        const double *at = truth[scene_turned(s, turn, k)];
        const double off = hypot(real(found[k].x) - at[0], real(found[k].y) - at[1]);
        e->squares += off * off;
        e->most = fmax(e->most, off);
        e->count++;
    }
}

static void random_views(void **state)
{
    (void)state;
    static const struct {
        double tilt, least, noise, dark, bright;
        int blur, clutter;
        double rms, most;
    } kinds[] = {{0.9, 14, 0, 30, 220, 1, 0, 0.06, 0.5},
                 {0.9, 14, 4, 220, 30, 1, 0, 0.06, 0.5},
                 {0.7, 15, 10, 30, 220, 1, 1, 0.15, 0.9},
                 {0.7, 15, 0, 70, 110, 2, 1, 0.06, 0.5}};
    static const int boards[][3] = {{SCENE_CIRCLES, 7, 5}, {SCENE_CIRCLES, 6, 6}, {SCENE_CIRCLES, 3, 3},
                                    {SCENE_CIRCLES, 4, 7}, {SCENE_SHIFTED, 3, 7}, {SCENE_SHIFTED, 4, 5},
                                    {SCENE_SHIFTED, 3, 8}, {SCENE_SHIFTED, 4, 7}, {SCENE_CIRCLES, 5, 5}};
    for (size_t kind = 0; kind < sizeof kinds / sizeof kinds[0]; kind++) {
        errors e = {0, 0, 0};
        int missed = 0;
        for (int n = 0; n < 9; n++) {
            iris_image image = view_of(W, H);
            board_scene s = scene_of(boards[n][0], boards[n][1], boards[n][2], W, H);
            s.radius = s.kind == SCENE_SHIFTED ? 0.45 : 0.3;
            s.clutter = kinds[kind].clutter;
            s.dark = kinds[kind].dark;
            s.bright = kinds[kind].bright;
            scene_pose(truth, &s, kinds[kind].tilt, kinds[kind].least);
            scene_render(&image, work, &s, kinds[kind].blur, kinds[kind].noise);
            if (find(&image, s.kind, s.columns, s.rows) != IRIS_OK) {
                printf("#: %dx%d: sight %d, %d of %dx%d\n", s.columns, s.rows, (int)report.sight,
                       (int)report.seen, (int)report.columns, (int)report.rows);
                missed++;
                continue;
            }
            compare(&e, &s);
        }
        printf("#: circles, noise %.0f, blurred %d times, %.0f to %.0f: off by %.4f pixels (rms), %.3f at "
               "most; %d "
               "missed\n",
               kinds[kind].noise, kinds[kind].blur, kinds[kind].dark, kinds[kind].bright,
               sqrt(e.squares / (e.count + !e.count)), e.most, missed);
        assert_true(missed == 0 && sqrt(e.squares / e.count) < kinds[kind].rms && e.most < kinds[kind].most);
    }
}

/* One circle in front of the camera, far away, and much tilted: the center of its ellipse is elsewhere. */
static void tilted(void **state)
{
    (void)state;
    board_scene s = scene_of(SCENE_CIRCLES, 5, 4, W, H);
    iris_image image = view_of(W, H);
    double most = 0, ellipse = 0;
    scene_turn(&s, 0, 0.8, 1);
    scene_place(&s, 0, 0, 8.5);
    scene_know(truth, &s);
    scene_render(&image, work, &s, 1, 0);
    assert_int_equal(find(&image, SCENE_CIRCLES, 5, 4), IRIS_OK);
    for (int k = 0; k < 20;
         k++) { /* the middle of what is seen: of all pixels around, by how dark they are */
        double sum = 0, x_sum = 0, y_sum = 0;
        for (int i = 0; i < 41 * 41; i++) {
            const int x = (int)truth[k][0] + i % 41 - 20, y = (int)truth[k][1] + i / 41 - 20;
            double nearest = 1e9;
            int owner = -1;
            for (int m = 0; m < 20; m++) {
                const double away = hypot(x - truth[m][0], y - truth[m][1]);
                owner = away < nearest ? m : owner;
                nearest = fmin(nearest, away);
            }
            const double dark = owner == k && x >= 0 && y >= 0 && x < W && y < H && nearest < 14
                                    ? fmax(0, 220.0 - pixels[y * W + x])
                                    : 0;
            sum += dark;
            x_sum += dark * x;
            y_sum += dark * y;
        }
        ellipse = fmax(ellipse, hypot(x_sum / sum - truth[k][0], y_sum / sum - truth[k][1]));
        most = fmax(most, hypot(real(found[k].x) - truth[k][0], real(found[k].y) - truth[k][1]));
    }
    printf("#: tilted circles: %.3f pixels off at most; the middles of the ellipses are %.3f\n", most,
           ellipse);
    assert_true(ellipse > 0.12 && most < 0.1);
}

static void refused(void **state)
{
    (void)state;
    const int sizes[][2] = {{1, 1}, {3, 2}, {1, 240}, {320, 1}, {W, H}};
    for (int n = 0; n < 5; n++) {
        iris_image image = view_of(sizes[n][0], sizes[n][1]);
        for (int kind = 0; kind < 3; kind++) {
            for (int k = 0; k < sizes[n][0] * sizes[n][1]; k++) {
                const uint64_t random = random_u64();
                pixels[k] = (uint8_t)(kind == 0 ? 77 : kind == 1 ? (random & 1 ? 255 : 0) : random);
            }
            assert_int_equal(find(&image, SCENE_CIRCLES, 5, 4), IRIS_ERR_DATA);
            assert_int_equal(find(&image, SCENE_SHIFTED, 4, 4), IRIS_ERR_DATA);
        }
    }
    board_scene s = scene_of(SCENE_CIRCLES, 7, 5, W, H);
    iris_image image = view_of(W, H), part;
    scene_turn(&s, 0, 0, 0);
    scene_place(&s, 0, 0, 10);
    scene_know(truth, &s);
    scene_render(&image, work, &s, 1, 0);
    assert_int_equal(find(&image, SCENE_CIRCLES, 7, 5), IRIS_OK);
    assert_int_equal(find(&image, SCENE_CIRCLES, 5, 7), IRIS_OK);
    assert_int_equal(find(&image, SCENE_CIRCLES, 6, 5), IRIS_ERR_DATA);
    assert_true(report.sight == IRIS_BOARD_LARGER && report.columns == 7 && report.rows == 5);
    assert_int_equal(find(&image, SCENE_CIRCLES, 4, 3), IRIS_ERR_DATA); /* not every second circle */
    assert_int_equal(find(&image, SCENE_CIRCLES, 8, 5), IRIS_ERR_DATA);
    assert_true(report.sight == IRIS_BOARD_PARTLY && report.seen == 35);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){0, 0, 200, H}), IRIS_OK);
    assert_int_equal(find(&part, SCENE_CIRCLES, 7, 5), IRIS_ERR_DATA);
    assert_true(report.sight == IRIS_BOARD_CUT && report.seen < 35);
}

static void wrong_calls(void **state)
{
    (void)state;
    iris_scratch scratch;
    iris_image image = view_of(W, H), odd = image;
    iris_board_grid grid = {7, 5};
    const size_t bytes = IRIS_BOARD_CIRCLES_SCRATCH_BYTES(W, H, 7, 5);
    const iris_board_report none = {IRIS_BOARD_LARGER, -1, -2, -3};
    report = none;
    (void)iris_scratch_init(&scratch, memory.memory, bytes - 1);
    assert_int_equal(iris_board_circles(found, &report, &image, &grid, IRIS_BOARD_CIRCLES, &scratch),
                     IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    (void)iris_scratch_init(&scratch, memory.memory, bytes);
    assert_int_equal(iris_board_circles(NULL, &report, &image, &grid, IRIS_BOARD_CIRCLES, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_board_circles(found, NULL, &image, &grid, IRIS_BOARD_CIRCLES, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_board_circles(found, &report, NULL, &grid, IRIS_BOARD_CIRCLES, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_board_circles(found, &report, &image, NULL, IRIS_BOARD_CIRCLES, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_board_circles(found, &report, &image, &grid, IRIS_BOARD_CIRCLES, NULL),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_board_circles(found, &report, &image, &grid, (iris_board_circle_rows)2, &scratch),
                     IRIS_ERR_ARG);
    odd.format = IRIS_MASK1;
    assert_int_equal(iris_board_circles(found, &report, &odd, &grid, IRIS_BOARD_CIRCLES, &scratch),
                     IRIS_ERR_FORMAT);
    grid.rows = 65;
    assert_int_equal(iris_board_circles(found, &report, &image, &grid, IRIS_BOARD_CIRCLES, &scratch),
                     IRIS_ERR_RANGE);
    assert_memory_equal(&report, &none, sizeof none);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_views),
        cmocka_unit_test(tilted),
        cmocka_unit_test(refused),
        cmocka_unit_test(wrong_calls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
