/* Quadtrees. */
#include "iris/quadtree.h"

#include <string.h>

#include "calls.h"

static void segment(void)
{
    iris_quadtree tree = {0};
    iris_quadtree_config config;
    iris_quadtree_defaults(&config);
    tree.capacity = draw_int(1, draw_chance(2) ? 500 : 20);
    if (draw_chance(2)) {
        config.tolerance = draw_int(0, 255);
        config.least_side = draw_int(1, 20);
    }
    int fits = tree.capacity >= 0 && tree.capacity <= 500;
    tree.leaves = OR_NULL(draw_results(fits ? (size_t)tree.capacity * sizeof *tree.leaves : 0));
    tree.capacity = fits ? tree.capacity : draw_within(-1, 0);
    iris_quadtree *given = OR_NULL(memcpy(draw_results(sizeof tree), &tree, sizeof tree));
    const iris_image *image = draw_input(draw_gray_or_color(), draw_size());
    const iris_quadtree_config *with = draw_chance(10) ? NULL : draw_given(&config, sizeof config);
    CALL(iris_quadtree_segment(given, image, with));
}

static iris_quadtree_leaf leaves[5000];

/* A tree of src as it is made, some numbers of which are then changed. */
static const iris_quadtree *any_tree(const iris_image *src)
{
    iris_quadtree tree = {.leaves = leaves, .capacity = draw_within(1, 5000)};
    iris_quadtree_config config = {draw_within(0, 200), draw_within(1, 9)};
    iris_status made = iris_quadtree_segment(&tree, src, &config);
    if (made != IRIS_OK && made != IRIS_ERR_FULL) {
        tree.count = 0;
    }
    for (int32_t i = 0; i < tree.count && draw_chance(8); i++) {
        iris_quadtree_leaf *leaf = &leaves[draw_below((uint32_t)tree.count)];
        uint16_t *sides[] = {&leaf->x, &leaf->y, &leaf->w, &leaf->h};
        *sides[draw_below(4)] = (uint16_t)draw_int(0, draw_chance(2) ? 70 : UINT16_MAX);
    }
    tree.leaves = OR_NULL(draw_given(leaves, (size_t)tree.count * sizeof *leaves));
    if (draw_chance(10)) {
        int32_t *sides[] = {&tree.size.w, &tree.size.h};
        *sides[draw_below(2)] = draw_int(1, IRIS_SIDE_MAX);
    }
    return OR_NULL(draw_given(&tree, sizeof tree));
}

static void check(void)
{
    const iris_quadtree *tree = any_tree(draw_input(draw_gray_or_color(), draw_size()));
    CALL(iris_quadtree_check(tree));
}

static void means(void)
{
    iris_size size = draw_size();
    iris_format format = draw_gray_or_color();
    const iris_image *src = draw_input(format, size);
    const iris_image *dst = draw_output(draw_chance(3) ? draw_gray_or_color() : format, size);
    const iris_quadtree *tree = any_tree(src);
    draw_overlap_is_fine();
    CALL(iris_quadtree_means(dst, tree));
}

const random_call calls_quadtree[] = {
    {"iris_quadtree_segment", segment},
    {"iris_quadtree_check", check},
    {"iris_quadtree_means", means},
    {NULL, NULL},
};
