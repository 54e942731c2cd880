/* Several lines in one picture, painted here: how many, where, how wide, at which angle. */
#include "iris/xt/paths.h"

#include <math.h>

#include "../picture.h"

#define PI  3.14159265358979323846
#define W   200
#define H   150
#define TOP 8

static uint8_t levels[H][W];
static uint32_t words[H * (W / 32 + 1)];
static IRIS_SCRATCH_BUFFER(memory, 1 << 18);

/* A stroke from (x, y) in a direction (degrees, 0 up, right positive). */
typedef struct {
    double x, y, degrees, width, length;
} stroke;

static void paint(const stroke *strokes, int count)
{
    for (int32_t v = 0; v < H; v++) {
        for (int32_t u = 0; u < W; u++) {
            int on = 0;
            for (int i = 0; i < count; i++) {
                const stroke *s = &strokes[i];
                double dx = sin(s->degrees * PI / 180), dy = -cos(s->degrees * PI / 180);
                double along = (u - s->x) * dx + (v - s->y) * dy, across = (u - s->x) * dy - (v - s->y) * dx;
                on |= along >= 0 && along <= s->length && fabs(across) <= s->width / 2;
            }
            levels[v][u] = on ? 40 : 200;
        }
    }
}

static iris_image mask_of_levels(void)
{
    iris_image mask;
    memset(words, 0, sizeof words);
    assert_int_equal(iris_image_wrap(&mask, words, sizeof words, (iris_size){W, H}, 0, IRIS_MASK1), IRIS_OK);
    for (int32_t y = 0; y < H; y++) {
        uint32_t *row = iris_image_row(&mask, y);
        for (int32_t x = 0; x < W; x++) {
            row[x / 32] |= (uint32_t)(levels[y][x] < 100) << x % 32;
        }
    }
    return mask;
}

static int32_t by_skeleton(iris_path found[TOP])
{
    int32_t count = -1;
    iris_scratch scratch;
    iris_image mask = mask_of_levels();
    iris_scratch_init(&scratch, memory.memory, IRIS_PATHS_SCRATCH_BYTES(W, H));
    assert_int_equal(iris_paths_find(found, TOP, &count, &mask, NULL, &scratch), IRIS_OK);
    return count;
}

static int32_t by_blocks(iris_path found[TOP])
{
    enum { LEAVES = 6000, REGIONS = 200 };
    static iris_quadtree_leaf leaves[LEAVES];
    static iris_region regions[REGIONS];
    static int32_t labels[LEAVES];
    static IRIS_SCRATCH_BUFFER(merging, IRIS_REGION_SCRATCH_BYTES(W, H, LEAVES));
    int32_t count = -1;
    iris_image gray;
    iris_scratch scratch;
    iris_quadtree tree = {.leaves = leaves, .capacity = LEAVES};
    iris_region_table table = {.regions = regions, .capacity = REGIONS, .labels = labels};
    iris_image_wrap(&gray, levels, sizeof levels, (iris_size){W, H}, 0, IRIS_GRAY8);
    iris_scratch_init(&scratch, merging.memory, sizeof merging.memory);
    assert_int_equal(iris_quadtree_segment(&tree, &gray, NULL), IRIS_OK);
    assert_int_equal(iris_region_merge(&table, &tree, NULL, &scratch), IRIS_OK);
    assert_int_equal(iris_paths_of_regions(found, TOP, &count, &tree, &table, NULL), IRIS_OK);
    return count;
}

static double off(iris_angle angle, double degrees)
{
    return fabs(remainder(angle * 360.0 / 65536 - degrees, 180));
}

/* One of the paths is the stroke: ends within `most` pixels, angle within 3 degrees, width within 2 pixels and a third. */
static void assert_has(const iris_path *found, int32_t count, const stroke *s, double most)
{
    double x = s->x + s->length * sin(s->degrees * PI / 180),
           y = s->y - s->length * cos(s->degrees * PI / 180);
    for (int32_t i = 0; i < count; i++) {
        const iris_path *p = &found[i];
        double ends = fmax(hypot(p->x0 - s->x, p->y0 - s->y), hypot(p->x1 - x, p->y1 - y));
        if (ends <= most && off(p->angle, s->degrees) < 3 &&
            fabs(p->width_px - s->width) <= 2 + s->width / 3 && fabs(p->length_px - s->length) <= most) {
            return;
        }
    }
    for (int32_t i = 0; i < count; i++) {
        print_error("%d,%d %d,%d width %d length %d angle %g\n", (int)found[i].x0, (int)found[i].y0,
                    (int)found[i].x1, (int)found[i].y1, (int)found[i].width_px, (int)found[i].length_px,
                    found[i].angle * 360.0 / 65536);
    }
    fail_msg("no path from %g,%g to %g,%g", s->x, s->y, x, y);
}

static void lines_apart(void **state)
{
    (void)state;
    iris_path found[TOP];
    const stroke strokes[] = {
        {30, 140, 5, 9, 120}, {80, 130, 20, 7, 90}, {130, 140, -12, 11, 60}, {150, 90, 80, 6, 40}};
    paint(strokes, 4);
    assert_int_equal(by_skeleton(found), 4);
    for (int i = 0; i < 4; i++) {
        assert_has(found, 4, &strokes[i], 9);
        assert_true(i == 0 || found[i - 1].length_px >= found[i].length_px);
    }
    assert_int_equal(by_blocks(found), 4);
    for (int i = 0; i < 4; i++) {
        assert_has(found, 4, &strokes[i], 9);
    }
}

/* Lines that cross: two by the skeleton, one thing that is no line by blocks. */
static void straight_through_crossings(void **state)
{
    (void)state;
    iris_path found[TOP];
    for (int turn = -30; turn <= 30; turn += 10) {
        double c = cos(turn * PI / 180), s = sin(turn * PI / 180);
        const stroke strokes[] = {{100 - 60 * s, 75 + 60 * c, turn, 9, 120},
                                  {100 - 50 * c, 75 - 50 * s, turn + 90, 7, 100}};
        stroke second = strokes[1];
        if (turn > 0) { /* its lower end is the other one */
            second = (stroke){strokes[1].x + 100 * c, strokes[1].y + 100 * s, turn - 90, 7, 100};
        }
        paint(strokes, 2);
        assert_int_equal(by_skeleton(found), 2);
        assert_has(found, 2, &strokes[0], 8);
        assert_has(found, 2, &second, 8);
        assert_int_equal(by_blocks(found), 0);
    }
}

static void blobs_are_no_lines(void **state)
{
    (void)state;
    iris_path found[TOP];
    paint(&(stroke){100, 110, 0, 50, 60}, 1);
    assert_int_equal(by_skeleton(found), 0);
    assert_int_equal(by_blocks(found), 0);
    paint(NULL, 0);
    assert_int_equal(by_skeleton(found), 0);
    assert_int_equal(by_blocks(found), 0);
}

static void keeps_the_longest(void **state)
{
    (void)state;
    iris_path one;
    int32_t count = 0;
    iris_scratch scratch;
    const stroke strokes[] = {{40, 140, 0, 9, 60}, {90, 140, 0, 9, 120}, {140, 140, 0, 9, 90}};
    paint(strokes, 3);
    iris_image mask = mask_of_levels();
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    assert_int_equal(iris_paths_find(&one, 1, &count, &mask, NULL, &scratch), IRIS_ERR_FULL);
    assert_int_equal(count, 3);
    assert_has(&one, 1, &strokes[1], 6);
    iris_paths_config config;
    iris_paths_defaults(&config);
    config.length_permil = 550;
    assert_int_equal(iris_paths_find(NULL, 0, &count, &mask, &config, &scratch), IRIS_ERR_FULL);
    assert_int_equal(count, 2);
}

static void refuses(void **state)
{
    (void)state;
    iris_path found[TOP];
    int32_t count = 7, labels[1] = {0};
    iris_scratch scratch;
    iris_image mask = mask_of_levels(), gray;
    iris_paths_config bad[6];
    iris_quadtree_leaf leaf = {0, 0, 9, 9, {0, 0, 0}, 0};
    iris_region region = {{0, 0, 0}, 81, 1, {0, 0, 9, 9}};
    iris_quadtree tree = {&leaf, 1, 1, 1, 0, 1, {9, 9}, IRIS_GRAY8};
    iris_region_table table = {&region, 1, labels, 1};
    iris_paths_defaults(NULL);
    for (int i = 0; i < 6; i++) {
        iris_paths_defaults(&bad[i]);
    }
    bad[0].length_permil = 1001;
    bad[1].slender_permil = 999;
    bad[2].straight = -1;
    bad[3].bright = 2;
    bad[4].contrast_permil = 49;
    bad[5].straight = 8193;
    iris_scratch_init(&scratch, memory.memory, IRIS_PATHS_SCRATCH_BYTES(W, H) - 1);
    assert_int_equal(iris_paths_find(found, TOP, &count, &mask, NULL, &scratch), IRIS_ERR_SCRATCH);
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(iris_paths_find(found, TOP, &count, &mask, &bad[i], &scratch), IRIS_ERR_ARG);
        assert_int_equal(iris_paths_of_regions(found, TOP, &count, &tree, &table, &bad[i]), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_paths_find(NULL, TOP, &count, &mask, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_paths_find(found, -1, &count, &mask, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_paths_find(found, TOP, NULL, &mask, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_paths_find(found, TOP, &count, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_paths_find(found, TOP, &count, &mask, NULL, NULL), IRIS_ERR_ARG);
    iris_image_wrap(&gray, levels, sizeof levels, (iris_size){W, H}, 0, IRIS_GRAY8);
    assert_int_equal(iris_paths_find(found, TOP, &count, &gray, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_paths_of_regions(found, TOP, &count, NULL, &table, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_paths_of_regions(found, TOP, &count, &tree, NULL, NULL), IRIS_ERR_ARG);
    table.capacity = 0;
    assert_int_equal(iris_paths_of_regions(found, TOP, &count, &tree, &table, NULL), IRIS_ERR_ARG);
    table.capacity = 1;
    leaf.w = 8;
    assert_int_equal(iris_paths_of_regions(found, TOP, &count, &tree, &table, NULL), IRIS_ERR_RANGE);
    assert_int_equal(count, 7);
    leaf.w = 9;
    assert_int_equal(iris_paths_of_regions(found, TOP, &count, &tree, &table, NULL), IRIS_OK);
    assert_int_equal(count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_apart),
        cmocka_unit_test(straight_through_crossings),
        cmocka_unit_test(blobs_are_no_lines),
        cmocka_unit_test(keeps_the_longest),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
