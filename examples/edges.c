/* What is before the robot, as lines? Local contrast, Canny's edges, and a look at what came out, in memory of a fixed size.
 * Here the "camera" paints a disc and a bar into light that falls off from left to right, and noise over both. */
#include <stdio.h>

#include "iris/xt/canny.h"
#include "iris/xt/equalize.h"

enum { W = 76, H = 38, TILES = 3 };

static uint8_t frame[W * H];
static uint32_t edge_words[(W + 31) / 32 * H];
static const iris_canny_config canny = {.sigma_q16 = IRIS_Q16_ONE, .low = 150, .high = 300};
static IRIS_SCRATCH_BUFFER(memory, IRIS_CANNY_SCRATCH_BYTES(W, H, IRIS_Q16_ONE) +
                                       IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(TILES));

static void camera(void)
{
    uint32_t random = 1;
    for (int i = 0; i < W * H; i++) {
        int x = i % W, y = i / W, light = 200 - 2 * x;
        int disc = (x - 20) * (x - 20) + 2 * (y - 18) * (y - 18) < 13 * 13, bar = x >= 50 && x < 62 && y > 6;
        random = random * 1664525u + 1013904223u;
        frame[i] = (uint8_t)((disc || bar ? light / 2 : light) + (int)(random >> 30));
    }
}

int main(void)
{
    const iris_equalize_local_config contrast = {.tiles = TILES, .limit_q16 = 4 * IRIS_Q16_ONE};
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    iris_image gray, edges;
    iris_scratch scratch;
    camera();
    if (iris_image_wrap(&gray, frame, sizeof frame, (iris_size){W, H}, 0, IRIS_GRAY8) ||
        iris_image_wrap(&edges, edge_words, sizeof edge_words, (iris_size){W, H}, 0, IRIS_MASK1) ||
        iris_scratch_init(&scratch, memory.memory, sizeof memory.memory)) {
        return 1;
    }
    if (iris_equalize_local(&gray, &gray, &contrast, &scratch) ||
        iris_canny(&edges, &gray, &canny, border, &scratch)) {
        return 1;
    }
    int count = 0;
    for (int y = 0; y < H; y++) {
        const uint32_t *row = iris_image_row(&edges, y);
        for (int x = 0; x < W; x++) {
            int edge = (int)(row[x / 32] >> x % 32 & 1);
            putchar(edge ? '#' : '.');
            count += edge;
        }
        putchar('\n');
    }
    printf("%d pixels of edges; %lu bytes of working memory\n", count, (unsigned long)scratch.peak);
    return count > 0 ? 0 : 1;
}
