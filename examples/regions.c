/* What colors lie before the robot, and where? Blocks of even color, merged into regions, in memory of a fixed size.
 * Here the "camera" paints a floor in uneven light, a red ball, and a blue box. */
#include <stdio.h>

#include "iris/xt/region.h"

enum { W = 160, H = 120, LEAVES = 600, REGIONS = 8 };

static uint8_t frame[3 * W * H];
static iris_quadtree_leaf leaves[LEAVES];
static int32_t labels[LEAVES];
static iris_region regions[REGIONS];
static IRIS_SCRATCH_BUFFER(memory, IRIS_REGION_SCRATCH_BYTES(W, H, LEAVES));

static void camera(void)
{
    for (int i = 0; i < W * H; i++) {
        int x = i % W, y = i / W, light = 200 - x / 2;
        int ball = (x - 40) * (x - 40) + (y - 70) * (y - 70) < 15 * 15,
            box = x >= 100 && x < 130 && y >= 30 && y < 60;
        frame[3 * i] = (uint8_t)(ball ? 190 : box ? 30 : light);
        frame[3 * i + 1] = (uint8_t)(ball ? 40 : box ? 50 : light);
        frame[3 * i + 2] = (uint8_t)(ball ? 40 : box ? 160 : light - 10);
    }
}

int main(void)
{
    iris_image image;
    iris_scratch scratch;
    iris_quadtree tree = {.leaves = leaves, .capacity = LEAVES};
    iris_region_table table = {.regions = regions, .capacity = REGIONS, .labels = labels};
    camera();
    if (iris_image_wrap(&image, frame, sizeof frame, (iris_size){W, H}, 0, IRIS_RGB888) ||
        iris_scratch_init(&scratch, memory.memory, sizeof memory.memory)) {
        return 1;
    }
    /* IRIS_ERR_FULL is no failure here: coarser blocks that cover the whole frame, and the largest regions. */
    iris_status status = iris_quadtree_segment(&tree, &image, NULL);
    if (status == IRIS_OK || status == IRIS_ERR_FULL) {
        status = iris_region_merge(&table, &tree, NULL, &scratch);
    }
    if (status != IRIS_OK && status != IRIS_ERR_FULL) {
        return 1;
    }
    printf("%d blocks of at least %d pixels\n", (int)tree.count, (int)tree.least_side);
    int red = -1;
    for (int i = 0; i < table.count && i < REGIONS; i++) {
        const iris_region *r = &regions[i];
        printf("%d: color %d %d %d, %d pixels in %dx%d at (%d, %d)\n", i, r->mean.r, r->mean.g, r->mean.b,
               (int)r->area, (int)r->box.w, (int)r->box.h, (int)r->box.x, (int)r->box.y);
        red = r->mean.r > 2 * r->mean.g && r->mean.r > 2 * r->mean.b ? i : red;
    }
    return red >= 0 ? 0 : 1;
}
