#include "stereo_scene.h"

#include <math.h>
#include <stdlib.h>

#include "picture.h"

enum { W = 320, H = 240, SURFACES = 24, FINE = 3, NOISE_LEVELS = 2 };

/* Which places of the left picture belong to a surface. */
typedef enum { EVERYWHERE, BOX, ELLIPSE, POLE } outline;

/* d = a x + b y + c at (x, y) of the left picture. */
typedef struct {
    outline shape;
    double x, y, w, h; /* middle and half sides; of a pole: a point, half its width, and how far it leans */
    double a, b, c;
    double level, contrast; /* gray levels: mean, and about so many to both sides */
    uint32_t seed;
} surface;

typedef struct {
    surface surfaces[SURFACES];
    int count;
    uint32_t random;
} world;

static uint32_t mix(uint32_t n)
{
    n = (n ^ n >> 16) * 0x7FEB352Du;
    n = (n ^ n >> 15) * 0x846CA68Bu;
    return n ^ n >> 16;
}

static double between(world *w, double least, double most)
{
    w->random = mix(w->random + 0x9E3779B9u);
    return least + (most - least) * (w->random / 4294967296.0);
}

/* --- textures --- */

static double lattice(int32_t x, int32_t y, uint32_t seed)
{
    return mix(mix(mix(seed) + (uint32_t)x) + (uint32_t)y) / 2147483648.0 - 1;
}

/* Smooth, with about one hill in each square of the lattice. */
static double hills(double x, double y, uint32_t seed)
{
    double left = floor(x), top = floor(y), u = x - left, v = y - top;
    int32_t i = (int32_t)left, k = (int32_t)top;
    u = u * u * (3 - 2 * u);
    v = v * v * (3 - 2 * v);
    double above = lattice(i, k, seed) * (1 - u) + lattice(i + 1, k, seed) * u;
    double below = lattice(i, k + 1, seed) * (1 - u) + lattice(i + 1, k + 1, seed) * u;
    return above * (1 - v) + below * v;
}

/* As much of each size, from 64 pixels to one: noise whose strength falls as the frequency rises, as in photographs. */
static double texture(const surface *s, double x, double y)
{
    double sum = 0;
    uint32_t seed = s->seed;
    for (double size = 64; size >= 1; size /= 2) {
        sum += hills(x / size, y / size, ++seed);
    }
    return s->level + s->contrast * sum;
}

/* --- surfaces --- */

static int covers(const surface *s, double x, double y)
{
    double u = (x - s->x) / s->w, v = (y - s->y) / s->h;
    switch (s->shape) {
    case BOX:
        return fabs(u) <= 1 && fabs(v) <= 1;
    case ELLIPSE:
        return u * u + v * v <= 1;
    case POLE:
        return fabs(x - s->x - s->h * (y - s->y)) <= s->w;
    default:
        return 1;
    }
}

static double disparity_of(const surface *s, double x, double y)
{
    double d = s->a * x + s->b * y + s->c;
    return d < 0 ? 0 : d;
}

/* The nearest surface at a place of the left picture, or (from_right) of the right one, and where it is in the left
 * picture. What has no disparity is at the same place in both. */
static const surface *nearest(const world *w, double x, double y, int from_right, double *left_x)
{
    const surface *best = NULL;
    double most = -1;
    for (int i = 0; i < w->count; i++) {
        const surface *s = &w->surfaces[i];
        double at = from_right ? (x + s->b * y + s->c) / (1 - s->a) : x, d = disparity_of(s, at, y);
        at = from_right && d <= 0 ? x : at;
        if (d > most && covers(s, at, y)) {
            best = s;
            most = d;
            *left_x = at;
        }
    }
    return best;
}

static double seen_at(const world *w, int32_t x, int32_t y, int from_right)
{
    double sum = 0;
    for (int k = 0; k < FINE * FINE; k++) {
        double at_x = x + (k % FINE + 0.5) / FINE - 0.5, at_y = y + (k / FINE + 0.5) / FINE - 0.5,
               left_x = at_x;
        const surface *s = nearest(w, at_x, at_y, from_right, &left_x);
        sum += texture(s, left_x, at_y);
    }
    return sum / (FINE * FINE);
}

/* --- scenes --- */

static surface *put(world *w, outline shape, double contrast)
{
    surface *s = &w->surfaces[w->count++];
    *s = (surface){.shape = shape,
                   .level = between(w, 80, 170),
                   .contrast = contrast,
                   .seed = (uint32_t)between(w, 0, 4e9)};
    return s;
}

static void place(world *w, surface *s, double least, double most)
{
    s->x = between(w, 0, W);
    s->y = between(w, 0, H);
    s->w = between(w, least, most);
    s->h = between(w, least, most);
}

static void build_room(world *w)
{
    double far = between(w, 3, 8);
    put(w, EVERYWHERE, 22)->c = far;
    for (int i = 0; i < 3; i++) {
        surface *s = put(w, EVERYWHERE, 22);
        double slope = between(w, 0.12, 0.3);
        s->a = i == 0 ? -slope : i == 1 ? slope : 0;
        s->b = i == 2 ? slope : 0;
        s->c = far - (i == 0 ? -slope * W / 3 : i == 1 ? slope * W * 2 / 3 : slope * H / 2);
    }
}

static void build_steps(world *w)
{
    put(w, EVERYWHERE, 20)->c = between(w, 2, 6);
    for (int i = 0; i < 10; i++) {
        surface *s = put(w, i % 3 ? BOX : ELLIPSE, between(w, 8, 24));
        place(w, s, 12, 60);
        s->a = between(w, -0.04, 0.04);
        s->b = between(w, -0.04, 0.04);
        s->c = between(w, 8, 45) - s->a * s->x - s->b * s->y;
    }
}

static void build_thin(world *w)
{
    surface *back = put(w, EVERYWHERE, 16);
    back->c = between(w, 3, 6);
    back->b = 0.03;
    for (int i = 0; i < 12; i++) {
        surface *s = put(w, POLE, 10);
        s->x = (i + between(w, 0.2, 0.8)) * W / 12;
        s->y = H / 2.0;
        s->w = between(w, 1.5, 4);
        s->h = between(w, -0.3, 0.3);
        s->level = i % 2 ? between(w, 20, 60) : between(w, 190, 235);
        s->c = between(w, 12, 40);
    }
}

static void build_weak(world *w)
{
    surface *back = put(w, EVERYWHERE, 2);
    back->a = 0.02;
    back->c = between(w, 3, 6);
    for (int i = 0; i < 7; i++) {
        surface *s = put(w, i % 2 ? BOX : ELLIPSE, between(w, 1.5, 4));
        place(w, s, 25, 70);
        s->c = between(w, 10, 30);
    }
}

const char *stereo_scene_name(stereo_scene_kind kind)
{
    static const char *const names[STEREO_SCENES] = {"room", "steps", "thin", "weak"};
    return names[kind];
}

/* --- pictures --- */

static uint8_t to_pixel(world *w, double level)
{
    double noise = -6;
    for (int i = 0; i < 12; i++) {
        noise += between(w, 0, 1);
    }
    level = floor(level + NOISE_LEVELS * noise + 0.5);
    return (uint8_t)(level < 0 ? 0 : level > 255 ? 255 : level);
}

int stereo_scene_draw(stereo_scene *scene, stereo_scene_kind kind, uint32_t seed)
{
    static void (*const build[STEREO_SCENES])(world *) = {build_room, build_steps, build_thin, build_weak};
    world w = {.random = mix(seed + 1)};
    *scene = (stereo_scene){picture_make(W, H, IRIS_GRAY8), picture_make(W, H, IRIS_GRAY8),
                            malloc(W * H * sizeof(double)), malloc(W * H)};
    if (!scene->left.data || !scene->right.data || !scene->truth || !scene->visible) {
        return 0;
    }
    build[kind](&w);
    for (int32_t y = 0; y < H; y++) {
        uint8_t *left = iris_image_row(&scene->left, y), *right = iris_image_row(&scene->right, y);
        for (int32_t x = 0; x < W; x++) {
            double at = x, other = x;
            const surface *s = nearest(&w, x, y, 0, &at);
            double d = disparity_of(s, x, y);
            scene->truth[y * W + x] = d;
            scene->visible[y * W + x] = x - d >= 0 && nearest(&w, x - d, y, 1, &other) == s;
            left[x] = to_pixel(&w, seen_at(&w, x, y, 0));
            right[x] = to_pixel(&w, 0.94 * seen_at(&w, x, y, 1) + 3);
        }
    }
    return 1;
}

void stereo_scene_free(stereo_scene *scene)
{
    free(scene->left.data);
    free(scene->right.data);
    free(scene->truth);
    free(scene->visible);
}
