#include "nothing.h"

#include <math.h>

#include "picture.h"

#define W 320
#define H 240

static uint32_t state;

/* 0 to below 1. */
static double random_share(void)
{
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 16777216.0;
}

/* Close to a bell with a standard deviation of 1. */
static double random_bell(void)
{
    double sum = 0;
    for (int k = 0; k < 12; k++) {
        sum += random_share();
    }
    return sum - 6;
}

/* What a slope in a direction of its own, 0 at a node of a grid, is (u, v) away from there. */
static double slope_of(int seed, int x, int y, double u, double v)
{
    uint32_t hash = (uint32_t)seed * 668265263u ^ (uint32_t)x * 374761393u ^ (uint32_t)y * 2246822519u;
    hash = (hash ^ hash >> 15) * 2654435761u;
    hash = (hash ^ hash >> 13) * 3266489917u;
    double angle = (hash ^ hash >> 16) / 4294967296.0 * 6.283185307179586;
    return u * cos(angle) + v * sin(angle);
}

static double smooth_step(double t)
{
    return t * t * t * (t * (6 * t - 15) + 10);
}

/* Gradient noise, about -1 to 1, as large as 1. */
static double swell(int seed, double x, double y)
{
    int a = (int)floor(x), b = (int)floor(y);
    double u = x - a, v = y - b, s = smooth_step(u), t = smooth_step(v);
    double above = slope_of(seed, a, b, u, v) * (1 - s) + slope_of(seed, a + 1, b, u - 1, v) * s;
    double below =
        slope_of(seed, a, b + 1, u, v - 1) * (1 - s) + slope_of(seed, a + 1, b + 1, u - 1, v - 1) * s;
    return 1.4 * (above * (1 - t) + below * t);
}

/* Soft clouds, about -1 to 1, as large as `cell` pixels: two layers, turned so that no grid shows. */
static double cloud(int seed, double x, double y, double cell)
{
    double u = x / cell, v = y / cell;
    return swell(seed, 0.8 * u - 0.6 * v, 0.6 * u + 0.8 * v) * 0.7 +
           swell(seed + 99, 0.9 * u + 1.6 * v, 0.9 * v - 1.6 * u) * 0.3;
}

/* What is mixed: its strength in gray levels. */
typedef struct {
    double level, noise, slope, corners, clouds, cell;
} recipe;

static recipe recipe_of(int i)
{
    static const recipe plain[] = {
        {0, 0, 0, 0, 0, 1},     {255, 0, 0, 0, 0, 1},   {128, 0, 0, 0, 0, 1},    {60, 0, 0, 0, 0, 1},
        {128, 2, 0, 0, 0, 1},   {128, 6, 0, 0, 0, 1},   {128, 15, 0, 0, 0, 1},   {128, 40, 0, 0, 0, 1},
        {128, 0, 100, 0, 0, 1}, {90, 0, 60, 0, 0, 1},   {200, 0, 0, 100, 0, 1},  {128, 3, 0, 60, 0, 1},
        {128, 0, 0, 0, 40, 80}, {128, 0, 0, 0, 60, 40}, {128, 2, 0, 0, 30, 20},  {128, 4, 0, 0, 80, 120},
        {150, 4, 60, 30, 0, 1}, {60, 3, 30, 0, 10, 30}, {220, 8, 0, 60, 20, 60}, {100, 20, 60, 0, 0, 1},
    };
    const int count = sizeof plain / sizeof plain[0];
    if (i < count) {
        return plain[i];
    }
    double share[6];
    for (int k = 0; k < 6; k++) {
        share[k] = random_share();
    }
    return (recipe){90 + 80 * share[0], 12 * share[1], 30 * share[2],
                    20 * share[3],      30 * share[4], 20 + 80 * share[5]};
}

iris_image nothing_picture(int i)
{
    iris_image image = picture_make(W, H, IRIS_GRAY8);
    state = 77u + (uint32_t)i * 7919u;
    recipe r = recipe_of(i);
    double turn = 6.283185307179586 * random_share();
    for (int y = 0; y < H && image.data; y++) {
        uint8_t *row = iris_image_row(&image, y);
        for (int x = 0; x < W; x++) {
            double u = (x - W / 2) / (W / 2.0), v = (y - H / 2) / (W / 2.0);
            double level = r.level + r.slope * (u * cos(turn) + v * sin(turn)) - r.corners * (u * u + v * v);
            level += r.clouds > 0 ? r.clouds * cloud(i, x, y, r.cell) : 0;
            level += r.noise > 0 ? r.noise * random_bell() : 0;
            row[x] = (uint8_t)(level < 0 ? 0 : level > 255 ? 255 : lround(level));
        }
    }
    return image;
}
