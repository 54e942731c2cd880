/* Where is the ball? Rows as they arrive from a sensor, a mask of each by its color, and the blobs in it: no frame buffer,
 * all memory static, 10 KB. Here the "camera" paints a red ball that rolls to the right, a red stick, and noise. */
#include <stdio.h>

#include "iris/color.h"
#include "iris/xt/blob.h"

enum { W = 160, H = 120, BLOBS = 8 };

static IRIS_SCRATCH_BUFFER(memory, IRIS_BLOB_SCRATCH_BYTES(W, BLOBS) + IRIS_BLOB_COLOR_SCRATCH_BYTES(W));
static iris_blob blobs[BLOBS];

/* Stands for a DMA transfer of one line. */
static void sensor(uint8_t *rgb, int y, int frame)
{
    static unsigned noise = 1;
    for (int x = 0; x < W; x++, rgb += 3) {
        int ball_x = 30 + 12 * frame, ball = (x - ball_x) * (x - ball_x) + (y - 80) * (y - 80) < 12 * 12;
        int stick = y >= 20 && y < 25 && x >= 40 && x < 120;
        noise = noise * 1664525u + 1013904223u;
        int red = ball || stick || noise >> 24 < 2;
        rgb[0] = (uint8_t)(red ? 200 : 120);
        rgb[1] = rgb[2] = (uint8_t)(red ? 40 + x / 8 : 120);
    }
}

/* Red: far more of it than of the other two. */
static void classify(uint32_t *mask, const uint8_t *rgb)
{
    for (int x = 0; x < W; x++, rgb += 3) {
        uint32_t bit = (uint32_t)1 << x % 32;
        mask[x / 32] = rgb[0] > 2 * rgb[1] && rgb[0] > 2 * rgb[2] ? mask[x / 32] | bit : mask[x / 32] & ~bit;
    }
}

int main(void)
{
    iris_scratch scratch;
    iris_blob_scan scan;
    iris_blob_table table = {blobs, BLOBS, 0};
    iris_blob_config config;
    iris_blob_defaults(&config);
    config.filter.min_area = 30;                             /* no noise */
    config.filter.max_elongation_q16 = IRIS_Q16_ONE * 5 / 4; /* as long as broad: no sticks */
    if (iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) ||
        iris_blob_begin(&scan, &table, (iris_size){W, H}, 3, &config, &scratch)) {
        return 1;
    }
    for (int frame = 0; frame < 8; frame++) {
        static uint8_t rgb[3 * W];
        static uint32_t mask[W / 32];
        for (int y = 0; y < H; y++) {
            sensor(rgb, y, frame);
            classify(mask, rgb);
            if (iris_blob_row(&scan, mask, rgb)) {
                return 1;
            }
        }
        iris_status status =
            iris_blob_end(&scan); /* full: the largest are there, which is all that is asked for */
        if ((status != IRIS_OK && status != IRIS_ERR_FULL) || table.count != 1) {
            return 1;
        }
        printf("frame %d: ball of %d pixels at %d, %d, color %d %d %d\n", frame, (int)blobs[0].area,
               (int)iris_q16_to_int(blobs[0].x_q16), (int)iris_q16_to_int(blobs[0].y_q16), blobs[0].mean.r,
               blobs[0].mean.g, blobs[0].mean.b);
    }
    return 0;
}
