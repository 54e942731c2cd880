/* Photo-consistent carving: a block with a hollow that no silhouette shows, rendered here in double precision. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "iris/3d/carve.h"
#include "iris/3d/carve_photo.h"
#include "picture.h"
#include "score.h"

#define VIEWS 24
#define SIDE  48
#define W     224
#define H     168
#define FOCAL 291.0
#define BOX   0.6  /* half a side of the world */
#define BLOCK 0.5  /* of the block */
#define PIT   0.36 /* radius of the hollow in its upper side */

typedef struct {
    iris_voxel_world world;
    iris_carve_photo photos[VIEWS];
    iris_image masks[VIEWS];
} scene;

static iris_q32 q32(double a)
{
    return (iris_q32)llround(a * 4294967296.0);
}

static int is_solid(const double p[3])
{
    const double above = p[2] + BLOCK;
    return fabs(p[0]) < BLOCK && fabs(p[1]) < BLOCK && fabs(p[2]) < BLOCK &&
           p[0] * p[0] + p[1] * p[1] + above * above > PIT * PIT;
}

static void paint(double color[3], const double p[3])
{
    for (int k = 0; k < 3; k++) {
        const double f = 7 + 2.3 * k;
        color[k] =
            128 + 32 * (sin(f * p[0] + 1.3 * k) + sin(1.13 * f * p[1] + 2 + k) + sin(0.91 * f * p[2] + k));
    }
}

/* Where the ray first meets the block: in steps, and then by halves. */
static int meet(double hit[3], const double from[3], const double ray[3])
{
    double along = 0, out = 0;
    for (int k = 0; k < 3; k++) {
        along -= from[k] * ray[k];
        out += from[k] * from[k];
    }
    const double half = sqrt(fmax(0.76 - (out - along * along), 0));
    for (double t = along - half; t < along + half; t += 0.01) {
        for (int k = 0; k < 3; k++) {
            hit[k] = from[k] + t * ray[k];
        }
        if (is_solid(hit)) {
            double low = t - 0.01, high = t;
            for (int step = 0; step < 12; step++) {
                const double middle = (low + high) / 2;
                for (int k = 0; k < 3; k++) {
                    hit[k] = from[k] + middle * ray[k];
                }
                low = is_solid(hit) ? low : middle;
                high = is_solid(hit) ? middle : high;
            }
            return 1;
        }
    }
    return 0;
}

/* Rings below, beside, and above the block. */
static void look(iris_carve_photo *photo, double turn[9], double from[3], int view)
{
    static const double rises[3] = {-30, 25, 60};
    const double rise = rises[view / 8] * 3.14159265358979323846 / 180,
                 around = (view % 8 + 0.31 + 0.4 * (view / 8)) * 3.14159265358979323846 / 4;
    const double level = cos(rise);
    iris_sensor camera = {.intrinsics = {q32(FOCAL), q32(FOCAL), 0, q32(W / 2 - 0.4), q32(H / 2 - 0.3)}};
    const double f[3] = {-level * cos(around), -level * sin(around), sin(rise)};
    const double r[3] = {-f[1] / level, f[0] / level, 0};
    for (int i = 0; i < 3; i++) {
        from[i] = -2.2 * f[i];
        turn[i] = r[i];
        turn[3 + i] = f[(i + 1) % 3] * r[(i + 2) % 3] - f[(i + 2) % 3] * r[(i + 1) % 3];
        turn[6 + i] = f[i];
    }
    for (int i = 0; i < 9; i++) {
        camera.pose.turn.m[i] = q32(turn[i]);
    }
    camera.pose.place = (iris_vec3){q32(from[0]), q32(from[1]), q32(from[2])};
    iris_sensor_matrix(photo->m, &camera);
}

static void render(scene *s, int view)
{
    double turn[9], from[3];
    iris_carve_photo *photo = &s->photos[view];
    look(photo, turn, from, view);
    memset(s->masks[view].data, 0, (size_t)H * (size_t)s->masks[view].stride);
    for (int i = 0; i < W * H; i++) {
        const double x = (i % W - (W / 2 - 0.4)) / FOCAL, y = (i / W - (H / 2 - 0.3)) / FOCAL;
        const double length = sqrt(x * x + y * y + 1);
        double ray[3], hit[3], color[3] = {20, 40, 60};
        uint8_t *pixel = (uint8_t *)photo->picture.data + 3 * i;
        for (int k = 0; k < 3; k++) {
            ray[k] = (turn[k] * x + turn[3 + k] * y + turn[6 + k]) / length;
        }
        if (meet(hit, from, ray)) {
            uint32_t *row = iris_image_row(&s->masks[view], i / W);
            row[i % W / 32] |= (uint32_t)1 << (i % W % 32);
            paint(color, hit);
        }
        for (int k = 0; k < 3; k++) {
            pixel[k] = (uint8_t)lround(fmin(fmax(color[k], 0), 255));
        }
    }
}

static int make(scene *s, uint32_t *bits)
{
    static const int32_t counts[3] = {SIDE, SIDE, SIDE};
    const iris_vec3 corners[2] = {{q32(-BOX), q32(-BOX), q32(-BOX)}, {q32(BOX), q32(BOX), q32(BOX)}};
    int good = iris_voxel_world_init(&s->world, bits, IRIS_VOXEL_BYTES(SIDE, SIDE, SIDE), counts, corners) ==
                   IRIS_OK &&
               iris_voxel_fill(&s->world, 1) == IRIS_OK;
    for (int i = 0; i < VIEWS && good; i++) {
        s->photos[i].picture = picture_make(W, H, IRIS_RGB888);
        s->masks[i] = picture_make(W, H, IRIS_MASK1);
        s->photos[i].silhouette = &s->masks[i];
        good = s->photos[i].picture.data && s->masks[i].data;
        if (good) {
            render(s, i);
        }
    }
    return good;
}

typedef struct {
    int both, either, lost, hollow, opened;
} verdict;

static verdict compare(const iris_voxel_world *world)
{
    verdict v = {0, 0, 0, 0, 0};
    for (int32_t i = 0; i < SIDE * SIDE * SIDE; i++) {
        const iris_voxel at = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        const double p[3] = {BOX * ((2 * at.x + 1.0) / SIDE - 1), BOX * ((2 * at.y + 1.0) / SIDE - 1),
                             BOX * ((2 * at.z + 1.0) / SIDE - 1)};
        const int is = is_solid(p), there = iris_voxel_get(world, at);
        const int hollow = !is && fabs(p[0]) < BLOCK && fabs(p[1]) < BLOCK && fabs(p[2]) < BLOCK;
        v.both += is && there;
        v.either += is || there;
        v.lost += is && !there;
        v.hollow += hollow;
        v.opened += hollow && !there;
    }
    return v;
}

/* Both carvings; 0: refused. */
static int carve(verdict *hull, verdict *photo, double *seconds, const scene *s)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_CARVE_PHOTO_SCRATCH_BYTES(SIDE, VIEWS, W, H) +
                                           IRIS_CARVE_SCRATCH_BYTES(W, H));
    const iris_carve_photos photos = {s->photos, VIEWS};
    iris_scratch scratch;
    int32_t removed = 0;
    int good = iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) == IRIS_OK;
    for (int i = 0; i < VIEWS && good; i++) {
        good = iris_carve_view(&s->world, &s->masks[i], s->photos[i].m, &scratch) == IRIS_OK;
    }
    *hull = compare(&s->world);
    const clock_t start = clock();
    good = good && iris_carve_photo_world(&removed, &s->world, &photos, NULL, &scratch) == IRIS_OK;
    *seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    *photo = compare(&s->world);
    return good;
}

void score_carve_photo(score *s)
{
    static uint32_t bits[IRIS_VOXEL_BYTES(SIDE, SIDE, SIDE) / 4];
    static scene made;
    verdict hull = {0, 0, 0, 0, 0}, photo = hull;
    double seconds = 0;
    const int good = make(&made, bits) && carve(&hull, &photo, &seconds, &made);
    score_row(s, "a hollow block from 24 rendered photographs, 48 voxels an axis: intersection over union",
              "at least 0.88, from the hull's", score_if(good && photo.both >= 0.88 * photo.either),
              "%.3f; hull %.3f; %.1f s", (double)photo.both / photo.either, (double)hull.both / hull.either,
              seconds);
    score_row(s, "the same: of the hollow's voxels opened; of the block's lost", "at least 55 %; none",
              score_if(good && photo.opened >= 0.55 * photo.hollow && photo.lost == hull.lost),
              "%.0f %% (hull %.0f %%); %d", 100.0 * photo.opened / photo.hollow,
              100.0 * hull.opened / hull.hollow, photo.lost - hull.lost);
    for (int i = 0; i < VIEWS; i++) {
        free(made.photos[i].picture.data);
        free(made.masks[i].data);
    }
}
