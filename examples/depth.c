/* How far is the nearest thing? Disparities of two rectified pictures, and from them depths: all memory static. Here the
 * "cameras" stand 60 mm apart and see a box before a wall, both with a pattern. */
#include <stdio.h>

#include "iris/3d/stereo.h"

enum { W = 128, H = 96, MOST = 31, FOCAL = 100, BASELINE_MM = 60 };
enum { WALL = 6, BOX = 16 }; /* their disparities: 6000 / 6 = 1000 mm and 6000 / 16 = 375 mm away */

static const iris_rect box = {50, 30, 40, 36}; /* in the left picture */
static uint8_t left[W * H], right[W * H];
static uint16_t disparity[W * H];
static IRIS_SCRATCH_BUFFER(memory, IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(W, MOST));

static int is_box(int x, int y)
{
    return x >= box.x && x < box.x + box.w && y >= box.y && y < box.y + box.h;
}

/* A gray level for each place of a surface. */
static uint8_t pattern(int x, int y, unsigned surface)
{
    unsigned n = (unsigned)(x + 64) * 374761393u + (unsigned)y * 668265263u + surface * 2246822519u;
    n = (n ^ n >> 13) * 1274126177u;
    return (uint8_t)(60 + (n >> 16) % 140);
}

/* What is at x in the left picture is at x - disparity in the right one; the box hides the wall. */
static void cameras(void)
{
    for (int i = 0; i < W * H; i++) {
        const int x = i % W, y = i / W;
        left[i] = is_box(x, y) ? pattern(x, y, BOX) : pattern(x, y, WALL);
        right[i] = is_box(x + BOX, y) ? pattern(x + BOX, y, BOX) : pattern(x + WALL, y, WALL);
    }
}

static double depth_mm(int x, int y)
{
    const iris_q32 z =
        iris_stereo_depth(disparity[y * W + x], BASELINE_MM * IRIS_Q32_ONE, FOCAL * IRIS_Q32_ONE);
    return (double)z / (double)IRIS_Q32_ONE;
}

int main(void)
{
    const iris_size size = {W, H};
    iris_scratch scratch;
    iris_image left_view, right_view, disparities;
    iris_stereo_semiglobal_config config;
    iris_stereo_semiglobal_defaults(&config);
    config.stereo.max_disparity = MOST; /* nothing is nearer than 6000 / 31 mm */
    cameras();
    if (iris_image_wrap(&left_view, left, sizeof left, size, 0, IRIS_GRAY8) ||
        iris_image_wrap(&right_view, right, sizeof right, size, 0, IRIS_GRAY8) ||
        iris_image_wrap(&disparities, disparity, sizeof disparity, size, 0, IRIS_GRAY_U16) ||
        iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) ||
        iris_stereo_semiglobal(&disparities, &left_view, &right_view, &config, &scratch) ||
        iris_stereo_speckle(&disparities, 30, 256,
                            &scratch)) { /* no single wrong match is the nearest thing */
        return 1;
    }
    int nearest = 0;
    for (int i = 1; i < W * H; i++) {
        nearest = disparity[i] > disparity[nearest] ? i : nearest;
    }
    const int x = nearest % W, y = nearest / W;
    const double box_mm = depth_mm(x, y), wall_mm = depth_mm(110, 20);
    printf("nearest: %.0f mm, at %d, %d; the wall: %.0f mm\n", box_mm, x, y, wall_mm);
    return !is_box(x, y) || box_mm < 365 || box_mm > 385 || wall_mm < 970 || wall_mm > 1030;
}
