#include "digest.h"

#include "iris/xt/region.h"

#define LEAVES  60
#define REGIONS 12

static void merged(iris_format format, int32_t w, int32_t h)
{
    iris_image image = digest_picture(format, w, h);
    iris_quadtree tree = {.leaves = digest_take(LEAVES * sizeof(iris_quadtree_leaf)), .capacity = LEAVES};
    iris_region_table table = {digest_take(REGIONS * sizeof(iris_region)), REGIONS,
                               digest_take(LEAVES * sizeof(int32_t)), 0};
    iris_scratch scratch = digest_scratch(IRIS_REGION_SCRATCH_BYTES(w, h, LEAVES));
    for (int32_t tolerance = 5; tolerance <= 65; tolerance += 20) {
        (void)iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){30, tolerance % 3 + 1});
        digest_number(
            iris_region_merge(&table, &tree, &(iris_region_config){tolerance, tolerance / 3}, &scratch));
        digest_number(table.count);
        for (int32_t i = 0; i < tree.count; i++) {
            digest_number(table.labels[i]);
        }
        for (int32_t i = 0; i < table.count && i < REGIONS; i++) {
            const iris_region *r = &table.regions[i];
            digest_number((int64_t)r->mean.r << 16 | r->mean.g << 8 | r->mean.b);
            digest_number((int64_t)r->area << 32 | r->leaves);
            digest_number((int64_t)r->box.x << 48 | (int64_t)r->box.y << 32 | (int64_t)r->box.w << 16 |
                          r->box.h);
        }
    }
}

static void gray(void)
{
    merged(IRIS_GRAY8, 61, 50);
}

static void color(void)
{
    merged(IRIS_RGB888, 37, 30);
}

const digest_operation digest_region[] = {{"region.gray", gray}, {"region.color", color}, {NULL, NULL}};
