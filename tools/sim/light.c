#include "light.h"

#include <math.h>
#include <stdlib.h>

static const double CELL = 0.4;     /* cm of the map */
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

double sim_light(const sim_track *track, double x, double y)
{
    double across = (x - track->left) / (track->right - track->left);
    double up = (y - track->bottom) / (track->top - track->bottom);
    double t = 1.1 * across + 0.25 * up - 0.15; /* bright in the south west */
    return pow(0.25, t < 0 ? 0 : t > 1 ? 1 : t);
}

double sim_glare(const sim_track *track, double x, double y)
{
    if (track->glare_length <= 0) {
        return 0;
    }
    sim_pose center = sim_track_at(track, track->glare_s);
    double full = hypot(track->glare_length / 2, track->tape / 2);
    double out = hypot(x - center.x, y - center.y) - full;
    return out <= 0 ? 1 : exp(-out * out / 8);
}

static sim_cell make_cell(const sim_track *track, double x, double y, uint32_t seed)
{
    int i = (int)floor(x / CELL), j = (int)floor(y / CELL);
    double texture =
        0.45 * patches(x, y, 9, seed) + 0.3 * patches(x, y, 2.2, seed + 1) + 0.25 * lattice(i, j, seed + 2);
    double light = sim_light(track, x, y), glare = SATURATE * sim_glare(track, x, y);
    return (sim_cell){(float)sim_track_tape(track, x, y), (float)((FLOOR + GRAIN * texture) * light + glare),
                      (float)((TAPE + GRAIN / 4 * texture) * light + glare)};
}

int sim_floor_make(sim_floor *map, const sim_track *track, uint32_t seed)
{
    map->track = track;
    map->w = (int)((track->right - track->left + 2 * MARGIN) / CELL) + 2;
    map->h = (int)((track->top - track->bottom + 2 * MARGIN) / CELL) + 2;
    map->cell = malloc((size_t)map->w * (size_t)map->h * sizeof *map->cell);
    if (!map->cell) {
        return 0;
    }
    for (int j = 0; j < map->h; j++) {
        for (int i = 0; i < map->w; i++) {
            double x = track->left - MARGIN + i * CELL, y = track->bottom - MARGIN + j * CELL;
            map->cell[(size_t)j * (size_t)map->w + (size_t)i] = make_cell(track, x, y, seed);
        }
    }
    return 1;
}

void sim_floor_free(sim_floor *map)
{
    free(map->cell);
    map->cell = NULL;
}

static float between(float low, float high, float share)
{
    return low + (high - low) * share;
}

double sim_floor_gray(const sim_floor *map, double x, double y, double blur)
{
    double u = (x - map->track->left + MARGIN) / CELL, v = (y - map->track->bottom + MARGIN) / CELL;
    u = u < 0 ? 0 : u > map->w - 2 ? map->w - 2 : u;
    v = v < 0 ? 0 : v > map->h - 2 ? map->h - 2 : v;
    int i = (int)u, j = (int)v;
    float a = (float)(u - i), b = (float)(v - j);
    const sim_cell *low = map->cell + (size_t)j * (size_t)map->w + (size_t)i, *high = low + map->w;
    float distance = between(between(low[0].distance, low[1].distance, a),
                             between(high[0].distance, high[1].distance, a), b);
    float bare = between(between(low[0].bare, low[1].bare, a), between(high[0].bare, high[1].bare, a), b);
    float taped =
        between(between(low[0].taped, low[1].taped, a), between(high[0].taped, high[1].taped, a), b);
    float share = 0.5f - distance / (float)blur;
    return between(bare, taped, share < 0 ? 0 : share > 1 ? 1 : share);
}
