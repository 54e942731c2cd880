#include "light.h"

#include <math.h>
#include <stdlib.h>

static const double CELL = 0.4;     /* cm of the maps */
static const double MARGIN = 90;    /* cm around the course that a camera may still see */
static const double FLOOR = 215;    /* gray of the floor in full light */
static const double TAPE = 38;      /* of the tape */
static const double GRAIN = 12;     /* amplitude of the floor's texture */
static const double SATURATE = 420; /* gray that full glare adds */

void sim_random_seed(sim_random *random, uint32_t seed)
{
    random->state = seed * 2654435761u + 0x9e3779b9u;
    random->state += random->state == 0;
}

uint32_t sim_random_next(sim_random *random)
{
    uint32_t x = random->state;
    x ^= x << 13;
    x ^= x >> 17;
    x ^= x << 5;
    random->state = x;
    return x;
}

/* A repeatable value of -1..1 for a lattice point. */
static double lattice(int x, int y, uint32_t seed)
{
    uint32_t n = (uint32_t)x * 374761393u + (uint32_t)y * 668265263u + seed * 2246822519u;
    n = (n ^ n >> 13) * 1274126177u;
    n ^= n >> 16;
    return (double)(n & 0xffff) / 32767.5 - 1;
}

static double smooth(double t)
{
    return t * t * (3 - 2 * t);
}

/* Value noise with patches of `size` cm. */
static double patches(double x, double y, double size, uint32_t seed)
{
    double u = x / size, v = y / size;
    int i = (int)floor(u), j = (int)floor(v);
    double a = smooth(u - i), b = smooth(v - j);
    double low = lattice(i, j, seed) * (1 - a) + lattice(i + 1, j, seed) * a;
    double high = lattice(i, j + 1, seed) * (1 - a) + lattice(i + 1, j + 1, seed) * a;
    return low * (1 - b) + high * b;
}

int sim_floor_make(sim_floor *floor, const sim_track *track, uint32_t seed)
{
    floor->track = track;
    floor->w = (int)((track->right - track->left + 2 * MARGIN) / CELL) + 2;
    floor->h = (int)((track->top - track->bottom + 2 * MARGIN) / CELL) + 2;
    size_t cells = (size_t)floor->w * (size_t)floor->h;
    floor->distance = malloc(cells * sizeof(float));
    floor->texture = malloc(cells * sizeof(float));
    if (!floor->distance || !floor->texture) {
        sim_floor_free(floor);
        return 0;
    }
    for (int j = 0; j < floor->h; j++) {
        for (int i = 0; i < floor->w; i++) {
            double x = track->left - MARGIN + i * CELL, y = track->bottom - MARGIN + j * CELL;
            size_t at = (size_t)j * (size_t)floor->w + (size_t)i;
            floor->distance[at] = (float)sim_track_tape(track, x, y);
            floor->texture[at] = (float)(0.45 * patches(x, y, 9, seed) + 0.3 * patches(x, y, 2.2, seed + 1) +
                                         0.25 * lattice(i, j, seed + 2));
        }
    }
    return 1;
}

void sim_floor_free(sim_floor *floor)
{
    free(floor->distance);
    free(floor->texture);
    floor->distance = floor->texture = NULL;
}

double sim_light(const sim_track *track, double x, double y)
{
    double across = (x - track->left) / (track->right - track->left);
    double up = (y - track->bottom) / (track->top - track->bottom);
    double t = 1.1 * across + 0.25 * up - 0.15; /* bright in the south west */
    return pow(0.25, t < 0 ? 0 : t > 1 ? 1 : t);
}

double sim_glare(const sim_track *track, double x, double y)
{
    sim_pose center = sim_track_at(track, track->glare_s);
    double full = hypot(track->glare_length / 2, track->tape / 2);
    double out = hypot(x - center.x, y - center.y) - full;
    return out <= 0 ? 1 : exp(-out * out / 8);
}

double sim_floor_gray(const sim_floor *floor, double x, double y, double blur)
{
    const sim_track *track = floor->track;
    double u = (x - track->left + MARGIN) / CELL, v = (y - track->bottom + MARGIN) / CELL;
    u = u < 0 ? 0 : u > floor->w - 2 ? floor->w - 2 : u;
    v = v < 0 ? 0 : v > floor->h - 2 ? floor->h - 2 : v;
    int i = (int)u, j = (int)v;
    double a = u - i, b = v - j;
    size_t at = (size_t)j * (size_t)floor->w + (size_t)i, next = at + (size_t)floor->w;
    const float *d = floor->distance, *t = floor->texture;
    double distance = (d[at] * (1 - a) + d[at + 1] * a) * (1 - b) + (d[next] * (1 - a) + d[next + 1] * a) * b;
    double texture = (t[at] * (1 - a) + t[at + 1] * a) * (1 - b) + (t[next] * (1 - a) + t[next + 1] * a) * b;
    double taped = 0.5 - distance / blur;
    taped = taped < 0 ? 0 : taped > 1 ? 1 : taped;
    double gray = (FLOOR + GRAIN * texture) * (1 - taped) + (TAPE + 0.25 * GRAIN * texture) * taped;
    return gray * sim_light(track, x, y) + SATURATE * sim_glare(track, x, y);
}
