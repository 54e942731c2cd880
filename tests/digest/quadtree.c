#include "digest.h"

#include "iris/quadtree.h"

#define LEAVES 200

static void digest_tree(const iris_quadtree *tree)
{
    digest_number(tree->count);
    digest_number(tree->wanted);
    digest_number(tree->least_side);
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        digest_number((int64_t)leaf->x << 48 | (int64_t)leaf->y << 32 | (int64_t)leaf->w << 16 | leaf->h);
        digest_number((int64_t)leaf->mean.r << 24 | leaf->mean.g << 16 | leaf->mean.b << 8 | leaf->range);
    }
}

static void trees(iris_format format, int32_t w, int32_t h)
{
    iris_image image = digest_picture(format, w, h), means = digest_canvas(format, w, h);
    iris_quadtree tree = {.leaves = digest_take(LEAVES * sizeof(iris_quadtree_leaf)), .capacity = LEAVES};
    for (int32_t tolerance = 15; tolerance <= 255; tolerance += 48) {
        iris_quadtree_config by = {tolerance, tolerance % 5 + 1};
        digest_number(iris_quadtree_segment(&tree, &image, &by));
        digest_tree(&tree);
        digest_number(iris_quadtree_means(&means, &tree));
        digest_view(&means);
    }
}

static void gray(void)
{
    trees(IRIS_GRAY8, 61, 50);
}

static void color(void)
{
    trees(IRIS_BGR888, 37, 30);
}

const digest_operation digest_quadtree[] = {{"quadtree.gray", gray}, {"quadtree.color", color}, {NULL, NULL}};
