#include "digest.h"

#include "iris/xt/junction.h"
#include "iris/xt/junction_latch.h"
#include "iris/xt/line_mask.h"
#include "iris/xt/paths.h"
#include "iris/xt/threshold.h"

#define W 48
#define H 40

static void digest_junctions(const iris_image *mask)
{
    iris_junction found[IRIS_JUNCTIONS_MAX];
    int32_t count = 0;
    iris_scratch scratch = digest_scratch(IRIS_JUNCTION_SCRATCH_BYTES(W, H));
    digest_number(iris_junctions_find(found, IRIS_JUNCTIONS_MAX, &count, mask, NULL, &scratch));
    digest_number(count);
    for (int32_t i = 0; i < count; i++) {
        digest_values(&found[i], offsetof(iris_junction, branches), 4);
        digest_values(found[i].branches, sizeof found[i].branches, sizeof found[i].branches[0]);
        digest_values(&found[i].confidence_permil, 4, 4);
    }
}

/* Strokes of constant thickness along a slope, from (x, y) on in whole steps. */
static void stroke(const iris_image *gray, int32_t x, int32_t y, int32_t dx, int32_t dy)
{
    for (int32_t k = 0; k < 120; k++) {
        int32_t u = x + dx * k / 4, v = y + dy * k / 4;
        for (int32_t i = 0; i < 25; i++) {
            int32_t a = u + i % 5 - 2, b = v + i / 5 - 2;
            if (a >= 0 && b >= 0 && a < W && b < H) {
                ((uint8_t *)iris_image_row(gray, b))[a] = (uint8_t)(30 + (a + b) / 8);
            }
        }
    }
}

static void crossing(void)
{
    iris_image gray = digest_canvas(IRIS_GRAY8, W, H), mask = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_LINE_MASK_SCRATCH_BYTES(W, H));
    int32_t found = 0;
    for (int32_t y = 0; y < H; y++) {
        for (int32_t x = 0; x < W; x++) {
            ((uint8_t *)iris_image_row(&gray, y))[x] = (uint8_t)(140 + x / 2);
        }
    }
    stroke(&gray, 24, 18, 1, 4);
    stroke(&gray, 24, 18, 4, -1);
    stroke(&gray, 24, 18, -4, 1);
    digest_number(iris_line_mask(&found, &mask, &gray, NULL, &scratch));
    digest_number(found);
    digest_view(&mask);
    digest_junctions(&mask);
}

static void anything(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), mask = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_LINE_MASK_SCRATCH_BYTES(W, H));
    const iris_line_mask_config bright = {1, 200};
    (void)iris_threshold(&mask, &gray, 140, IRIS_SELECT_BRIGHT);
    digest_junctions(&mask);
    digest_number(iris_line_mask(NULL, &mask, &gray, &bright, &scratch));
    digest_view(&mask);
}

/* A crossing comes nearer, passes, and the branch comes around. */
static void latch(void)
{
    for (int turn = 0; turn < 3; turn++) {
        iris_junction_latch latch;
        iris_turn take = (iris_turn)turn;
        digest_number(iris_junction_latch_init(&latch, (iris_size){160, 120}));
        digest_number(iris_junction_latch_take(&latch, &take, 1));
        for (int32_t y = 20; y < 200; y += 5) {
            iris_junction found = {IRIS_JUNCTION_CROSSING,       1200 + y, y * 16, 119 - y, 14, 4,
                                   {-30000, -16000, 900, 17000}, 900};
            iris_follow_result line = {.state = IRIS_LINE_FOUND, .angle = (iris_angle)((y - 110) * 300)};
            digest_number(iris_junction_latch_update(&line, &latch, &found, y < 120, 33));
            digest_number((int32_t)line.state);
            digest_number(line.angle);
            digest_number(line.next_angle);
            digest_number(line.offset_q16);
            digest_number(line.lookahead_offset_q16);
            digest_values(line.segments, sizeof line.segments, 4);
            digest_number((int32_t)latch.state);
        }
    }
}

static void digest_paths(const iris_path *found, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        digest_values(&found[i], offsetof(iris_path, angle), 4);
        digest_values(&found[i].angle, sizeof found[i] - offsetof(iris_path, angle), 2);
    }
}

static void paths(void)
{
    iris_path found[4];
    int32_t count = 0;
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), mask = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_PATHS_SCRATCH_BYTES(W, H));
    const iris_paths_config config = {100, 1500, 5000, 0, 100};
    (void)iris_threshold(&mask, &gray, 140, IRIS_SELECT_BRIGHT);
    digest_number(iris_paths_find(found, 4, &count, &mask, &config, &scratch));
    digest_number(count);
    digest_paths(found, count < 4 ? count : 4);
}

/* A floor, two upright lines on it, and a square. */
static void paths_by_blocks(void)
{
    iris_path found[4];
    iris_quadtree_leaf leaves[5] = {{0, 0, 20, 64, {200, 200, 200}, 0},
                                    {20, 0, 4, 64, {50, 50, 50}, 0},
                                    {24, 0, 8, 64, {200, 200, 200}, 0},
                                    {32, 0, 3, 64, {70, 70, 70}, 0},
                                    {35, 0, 64, 64, {60, 60, 60}, 0}};
    iris_region regions[4] = {{{200, 200, 200}, 1792, 2, {0, 0, 32, 64}},
                              {{60, 60, 60}, 4096, 1, {35, 0, 64, 64}},
                              {{50, 50, 50}, 256, 1, {20, 0, 4, 64}},
                              {{70, 70, 70}, 192, 1, {32, 0, 3, 64}}};
    int32_t labels[5] = {0, 2, 0, 3, 1}, count = 0;
    iris_quadtree tree = {leaves, 5, 5, 5, 0, 1, {99, 64}, IRIS_GRAY8};
    iris_region_table table = {regions, 4, labels, 4};
    digest_number(iris_paths_of_regions(found, 4, &count, &tree, &table, NULL));
    digest_number(count);
    digest_paths(found, count);
}

const digest_operation digest_junction[] = {
    {"junction.paths", paths},       {"junction.paths_by_blocks", paths_by_blocks},
    {"junction.latch", latch},       {"junction.crossing", crossing},
    {"junction.anything", anything}, {NULL, NULL},
};
