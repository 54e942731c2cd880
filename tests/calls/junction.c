/* Line masks and junctions. */
#include "iris/xt/junction.h"

#include "calls.h"
#include "iris/xt/junction_latch.h"
#include "iris/xt/line_mask.h"
#include "iris/xt/paths.h"

static void line_mask(void)
{
    iris_size size = draw_size();
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *gray = draw_input(IRIS_GRAY8, size);
    int32_t *found = OR_NULL(draw_results(sizeof *found));
    iris_line_mask_config config = {draw_int(0, 1), draw_int(100, 900)};
    const iris_line_mask_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch(IRIS_LINE_MASK_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_line_mask(found, mask, gray, given, scratch));
}

static void junctions(void)
{
    iris_size size = draw_size();
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    int32_t capacity = draw_within(-1, 5);
    size_t room = capacity > 0 ? (size_t)capacity : 0;
    iris_junction *found = OR_NULL(draw_results(room * sizeof *found));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    iris_junction_config config = {draw_int(1000, 10000), (iris_angle)draw_int(0, 8192),
                                   (iris_angle)draw_int(1820, 16384)};
    const iris_junction_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch(IRIS_JUNCTION_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_junctions_find(found, capacity, count, mask, given, scratch));
}

static void latch_init(void)
{
    iris_junction_latch *latch = OR_NULL(draw_results(sizeof *latch));
    iris_size size = {draw_int(8, IRIS_FOLLOW_SIDE_MAX), draw_int(8, IRIS_FOLLOW_SIDE_MAX)};
    CALL(iris_junction_latch_init(latch, size));
}

/* A latch with turns to take, in any state. */
static iris_junction_latch any_latch(void)
{
    iris_junction_latch latch;
    (void)iris_junction_latch_init(&latch, (iris_size){draw_within(8, 200), draw_within(8, 200)});
    for (int32_t i = draw_within(0, IRIS_JUNCTION_TURNS_MAX); i > 0; i--) {
        iris_turn turn = (iris_turn)draw_below(5);
        (void)iris_junction_latch_take(&latch, &turn, 1);
    }
    latch.state = (iris_latch_state)draw_below(5);
    latch.branch = (iris_angle)draw_within(-32768, 32767);
    latch.x = draw_within(0, latch.size.w - 1);
    latch.y = draw_within(0, latch.size.h - 1);
    latch.hits = draw_within(0, 3);
    return latch;
}

static void latch_take(void)
{
    iris_junction_latch made = any_latch(), *latch = OR_NULL(draw_state(&made, sizeof made));
    iris_turn turns[4];
    for (int i = 0; i < 4; i++) {
        turns[i] = (iris_turn)draw_below(draw_chance(20) ? 4 : 3);
    }
    const iris_turn *given = OR_NULL(draw_given(turns, sizeof turns));
    int32_t count = draw_within(-1, 4);
    CALL(iris_junction_latch_take(latch, given, count));
}

static void latch_update(void)
{
    iris_junction_latch made = any_latch(), *latch = OR_NULL(draw_state(&made, sizeof made));
    iris_junction found[3];
    for (int i = 0; i < 3; i++) {
        found[i] = (iris_junction){(iris_junction_type)draw_below(5),
                                   draw_within(0, 3200),
                                   draw_within(0, 3200),
                                   draw_within(0, 200),
                                   draw_within(1, 40),
                                   draw_within(0, IRIS_JUNCTION_BRANCHES),
                                   {0},
                                   draw_within(0, 1000)};
        for (int k = 0; k < IRIS_JUNCTION_BRANCHES; k++) {
            found[i].branches[k] = (iris_angle)draw_within(-32768, 32767);
        }
    }
    iris_follow_result seen = {.state = (iris_line_state)draw_below(3),
                               .angle = (iris_angle)draw_within(-16384, 16384),
                               .offset_q16 = draw_within(-131072, 131072)};
    iris_follow_result *line = OR_NULL(draw_state(&seen, sizeof seen));
    const iris_junction *given = OR_NULL(draw_given(found, sizeof found));
    int32_t count = draw_within(-1, 3), elapsed_ms = draw_int(0, 60000);
    CALL(iris_junction_latch_update(line, latch, given, count, elapsed_ms));
}

static iris_paths_config any_paths(void)
{
    return (iris_paths_config){draw_int(0, 1000), draw_int(1000, 100000), (iris_angle)draw_int(0, 8192),
                               draw_int(0, 1), draw_int(50, 900)};
}

static void paths(void)
{
    iris_size size = draw_size();
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    int32_t capacity = draw_within(-1, 5);
    size_t room = capacity > 0 ? (size_t)capacity : 0;
    iris_path *found = OR_NULL(draw_results(room * sizeof *found));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    iris_paths_config config = any_paths();
    const iris_paths_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch(IRIS_PATHS_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_paths_find(found, capacity, count, mask, given, scratch));
}

/* A picture of four blocks, the first the floor. */
static void paths_of_regions(void)
{
    iris_quadtree_leaf leaves[4];
    iris_region regions[4];
    int32_t labels[4], side = draw_within(1, 40), far = draw_within(1, 40), capacity = draw_within(-1, 3);
    for (int i = 0; i < 4; i++) {
        uint8_t level = (uint8_t)draw_below(256);
        leaves[i] =
            (iris_quadtree_leaf){(uint16_t)(i * side), 0, (uint16_t)side, (uint16_t)far, {0, 0, 0}, 0};
        regions[i] = (iris_region){{level, level, level}, side * far, 1, {0, 0, side, far}};
        labels[i] = draw_within(-1, 4);
    }
    iris_quadtree tree = {.leaves = draw_given(leaves, sizeof leaves),
                          .capacity = 4,
                          .count = draw_chance(10) ? 3 : 4,
                          .size = {4 * side, far},
                          .format = IRIS_GRAY8};
    iris_region_table table = {draw_given(regions, sizeof regions), 4, draw_given(labels, sizeof labels),
                               draw_within(0, 5)};
    size_t room = capacity > 0 ? (size_t)capacity : 0;
    iris_path *found = OR_NULL(draw_results(room * sizeof *found));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const iris_quadtree *given = OR_NULL(draw_given(&tree, sizeof tree));
    const iris_region_table *of = OR_NULL(draw_given(&table, sizeof table));
    iris_paths_config config = any_paths();
    const iris_paths_config *by = OR_NULL(draw_given(&config, sizeof config));
    CALL(iris_paths_of_regions(found, capacity, count, given, of, by));
}

const random_call calls_junction[] = {
    {"iris_paths_find", paths},
    {"iris_paths_of_regions", paths_of_regions},
    {"iris_junction_latch_init", latch_init},
    {"iris_junction_latch_take", latch_take},
    {"iris_junction_latch_update", latch_update},
    {"iris_line_mask", line_mask},
    {"iris_junctions_find", junctions},
    {NULL, NULL},
};
