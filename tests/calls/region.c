/* Regions, of trees as they are made, some leaves of which are then changed. */
#include "iris/xt/region.h"

#include <string.h>

#include "calls.h"

static void merge(void)
{
    static iris_quadtree_leaf leaves[5000];
    iris_quadtree tree = {.leaves = leaves, .capacity = draw_within(1, 5000)};
    iris_quadtree_config by = {draw_within(0, 200), draw_within(1, 9)};
    const iris_image *image = draw_input(draw_gray_or_color(), draw_size());
    iris_status made = iris_quadtree_segment(&tree, image, &by);
    if (made != IRIS_OK && made != IRIS_ERR_FULL) {
        tree.count = 0;
    }
    for (int32_t i = 0; i < tree.count && draw_chance(8); i++) {
        iris_quadtree_leaf *leaf = &leaves[draw_below((uint32_t)tree.count)], other = *leaf;
        uint16_t *places[] = {&leaf->x, &leaf->y};
        *leaf = leaves[i];
        leaves[i] = other;
        *places[draw_below(2)] = (uint16_t)draw_int(0, 70);
    }
    size_t count = (size_t)tree.count;
    tree.leaves = OR_NULL(draw_given(leaves, count * sizeof *leaves));
    const iris_quadtree *given = OR_NULL(draw_given(&tree, sizeof tree));
    iris_region_table table = {NULL, draw_within(-1, 40), NULL, 0};
    size_t room = table.capacity > 0 ? (size_t)table.capacity : 0;
    table.regions = OR_NULL(draw_results(room * sizeof *table.regions));
    table.labels = OR_NULL(draw_results(count * sizeof *table.labels));
    iris_region_table *to = OR_NULL(memcpy(draw_results(sizeof table), &table, sizeof table));
    iris_region_config merge_by = {draw_int(0, 255), draw_int(0, draw_chance(2) ? 5000 : 50)};
    const iris_region_config *with = draw_chance(10) ? NULL : draw_given(&merge_by, sizeof merge_by);
    iris_scratch *scratch = draw_scratch(IRIS_REGION_SCRATCH_BYTES(tree.size.w, tree.size.h, count));
    CALL(iris_region_merge(to, given, with, scratch));
}

const random_call calls_region[] = {{"iris_region_merge", merge}, {NULL, NULL}};
