/* Space carving: the hull of a real thing beside its published box, and seen again by its cameras. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "iris/3d/carve.h"
#include "iris/xt/threshold.h"
#include "picture.h"
#include "score.h"

#define VIEWS  16
#define SIDE   110
#define VOXELS (SIDE * SIDE * SIDE)
#define FOLDER "carve/dinoSparseRing/"

typedef struct {
    iris_voxel_world world;
    iris_q32 m[VIEWS][12];
    iris_image masks[VIEWS];
} hull;

/* The tight box that was published with the pictures, and how far around it is carved, in meters. */
static const double tight[6] = {-0.061897, -0.018874, -0.057845, 0.010897, 0.068227, 0.015495};
#define AROUND 0.008

static iris_q32 q32(double a)
{
    return (iris_q32)llround(a * 4294967296.0);
}

/* K [R | t] of the next line. */
static int read_camera(iris_q32 m[12], char name[64], FILE *file)
{
    double n[21];
    int good = fscanf(file, "%63s", name) == 1;
    for (int i = 0; i < 21; i++) {
        char word[64];
        good = good && fscanf(file, "%63s", word) == 1;
        n[i] = good ? strtod(word, NULL) : 0;
    }
    for (int i = 0; i < 12; i++) {
        double sum = 0;
        for (int k = 0; k < 3; k++) {
            sum += n[3 * (i / 4) + k] * (i % 4 < 3 ? n[9 + 3 * k + i % 4] : n[18 + k]);
        }
        m[i] = q32(sum);
    }
    return good;
}

static int load_mask(iris_image *mask, const char *picture)
{
    iris_image gray = {0};
    char name[128];
    snprintf(name, sizeof name, FOLDER "%.*s_sil.bmp", (int)strcspn(picture, "."), picture);
    int good = picture_load(&gray, name, IRIS_GRAY8) == IRIS_OK;
    *mask = good ? picture_make(gray.w, gray.h, IRIS_MASK1) : (iris_image){0};
    good = good && mask->data && iris_threshold(mask, &gray, 127, IRIS_SELECT_BRIGHT) == IRIS_OK;
    free(gray.data);
    return good;
}

static int load(hull *h)
{
    FILE *file = data_open(FOLDER "dinoSR_par.txt");
    char name[64];
    int good = file && fscanf(file, "%63s", name) == 1 && atoi(name) == VIEWS;
    for (int i = 0; i < VIEWS; i++) {
        good = good && read_camera(h->m[i], name, file) && load_mask(&h->masks[i], name);
    }
    if (file) {
        fclose(file);
    }
    return good;
}

static int carve(hull *h, uint32_t *bits)
{
    static const int32_t counts[3] = {SIDE, SIDE, SIDE};
    static IRIS_SCRATCH_BUFFER(memory, IRIS_CARVE_SCRATCH_BYTES(640, 480));
    const iris_vec3 corners[2] = {{q32(tight[0] - AROUND), q32(tight[1] - AROUND), q32(tight[2] - AROUND)},
                                  {q32(tight[3] + AROUND), q32(tight[4] + AROUND), q32(tight[5] + AROUND)}};
    int good = iris_voxel_world_init(&h->world, bits, IRIS_VOXEL_BYTES(SIDE, SIDE, SIDE), counts, corners) ==
                   IRIS_OK &&
               iris_voxel_fill(&h->world, 1) == IRIS_OK;
    for (int i = 0; i < VIEWS && good; i++) {
        iris_scratch scratch;
        (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
        good = iris_carve_view(&h->world, &h->masks[i], h->m[i], &scratch) == IRIS_OK;
    }
    return good;
}

static iris_voxel voxel_of(int32_t i)
{
    return (iris_voxel){i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
}

/* Voxels that are connected to `first` by their sides, marked in `seen` and listed in `queue`: how many. */
static int32_t flood(int32_t *queue, uint8_t *seen, const iris_voxel_world *world, int32_t first)
{
    int32_t count = 1;
    queue[0] = first;
    seen[first] = 1;
    for (int32_t i = 0; i < count; i++) {
        for (int side = 0; side < 6; side++) {
            iris_voxel v = voxel_of(queue[i]);
            const int step = side % 2 ? 1 : -1;
            v.x += side / 2 == 0 ? step : 0;
            v.y += side / 2 == 1 ? step : 0;
            v.z += side / 2 == 2 ? step : 0;
            const int32_t at = (v.z * SIDE + v.y) * SIDE + v.x;
            if (iris_voxel_get(world, v) && !seen[at]) {
                seen[at] = 1;
                queue[count++] = at;
            }
        }
    }
    return count;
}

/* The box of the largest connected part, in meters. */
static void box_of_largest(double box[6], const iris_voxel_world *world)
{
    static int32_t queue[VOXELS];
    static uint8_t seen[VOXELS];
    int32_t most = 0;
    memset(seen, 0, sizeof seen);
    for (int32_t i = 0; i < VOXELS; i++) {
        const int32_t count =
            iris_voxel_get(world, voxel_of(i)) && !seen[i] ? flood(queue, seen, world, i) : 0;
        if (count <= most) {
            continue;
        }
        most = count;
        int32_t edges[6] = {SIDE, SIDE, SIDE, 0, 0, 0};
        for (int32_t k = 0; k < count; k++) {
            const iris_voxel v = voxel_of(queue[k]);
            const int32_t at[3] = {v.x, v.y, v.z};
            for (int axis = 0; axis < 3; axis++) {
                edges[axis] = at[axis] < edges[axis] ? at[axis] : edges[axis];
                edges[3 + axis] = at[axis] + 1 > edges[3 + axis] ? at[axis] + 1 : edges[3 + axis];
            }
        }
        for (int k = 0; k < 6; k++) {
            const double least = tight[k % 3] - AROUND, most_place = tight[k % 3 + 3] + AROUND;
            box[k] = least + (most_place - least) * edges[k] / SIDE;
        }
    }
}

typedef struct {
    double u, v;
} spot;

/* Is the pixel on the side's projection: never left and right of its edges at once. */
static int is_in(const spot corners[8], const int side[4], double u, double v)
{
    int left = 0, right = 0;
    for (int i = 0; i < 4; i++) {
        const spot a = corners[side[i]], b = corners[side[(i + 1) % 4]];
        const double turn = (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
        left += turn < 0;
        right += turn > 0;
    }
    return left == 0 || right == 0;
}

/* Fills the six sides of a voxel in a picture of 640x480 bytes. */
static void draw_voxel(uint8_t *picture, const hull *h, int view, iris_voxel voxel)
{
    static const int sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    const double at[3] = {voxel.x, voxel.y, voxel.z};
    spot corners[8];
    double box[4] = {639, 479, 0, 0};
    for (int corner = 0; corner < 8; corner++) {
        double s[3];
        for (int row = 0; row < 3; row++) {
            s[row] = (double)h->m[view][4 * row + 3];
            for (int axis = 0; axis < 3; axis++) {
                const double least = tight[axis] - AROUND, most = tight[axis + 3] + AROUND;
                const double place = least + (most - least) * (at[axis] + (corner >> axis & 1)) / SIDE;
                s[row] += (double)h->m[view][4 * row + axis] * place;
            }
        }
        corners[corner] = (spot){s[0] / s[2], s[1] / s[2]};
        box[0] = fmin(box[0], corners[corner].u);
        box[1] = fmin(box[1], corners[corner].v);
        box[2] = fmax(box[2], corners[corner].u);
        box[3] = fmax(box[3], corners[corner].v);
    }
    for (int y = (int)ceil(fmax(box[1], 0)); y <= fmin(box[3], 479); y++) {
        for (int x = (int)ceil(fmax(box[0], 0)); x <= fmin(box[2], 639); x++) {
            uint8_t *pixel = picture + 640 * y + x;
            for (int side = 0; side < 6 && !*pixel; side++) {
                *pixel = (uint8_t)is_in(corners, sides[side], x, y);
            }
        }
    }
}

/* Intersection over union of the hull, seen again, with the silhouette. */
static double overlap(const hull *h, int view, const iris_voxel *surface, int32_t count)
{
    static uint8_t picture[640 * 480];
    int32_t both = 0, either = 0;
    memset(picture, 0, sizeof picture);
    for (int32_t i = 0; i < count; i++) {
        draw_voxel(picture, h, view, surface[i]);
    }
    for (int32_t i = 0; i < 640 * 480; i++) {
        const uint32_t *row = iris_image_row(&h->masks[view], i / 640);
        const int selected = (int)(row[i % 640 / 32] >> (i % 32) & 1u);
        both += selected && picture[i];
        either += selected || picture[i];
    }
    return either > 0 ? (double)both / either : 0;
}

static void judge(score *s, const hull *h)
{
    static iris_voxel surface[VOXELS / 8];
    double box[6] = {0}, inside = 0, sum = 0, least = 1;
    int32_t count = 0;
    int near = 0;
    box_of_largest(box, &h->world);
    for (int i = 0; i < 6; i++) {
        const double in = i < 3 ? box[i] - tight[i] : tight[i] - box[i];
        near += fabs(in) <= 0.002;
        inside = fmax(inside, in);
    }
    score_row(s, "a dinosaur carved from 16 silhouettes, 110 voxels an axis: sides of its box within 2 mm",
              "4 of 6, none 4.5 mm inside", score_if(near >= 4 && inside <= 0.0045),
              "%d; at most %.1f mm inside (%.1f %.1f %.1f to %.1f %.1f %.1f mm)", near, 1000 * inside,
              1000 * box[0], 1000 * box[1], 1000 * box[2], 1000 * box[3], 1000 * box[4], 1000 * box[5]);
    if (iris_voxel_surface(surface, VOXELS / 8, &count, &h->world) == IRIS_OK) {
        for (int i = 0; i < VIEWS; i++) {
            const double part = overlap(h, i, surface, count);
            sum += part;
            least = fmin(least, part);
        }
    }
    score_row(s, "the same, seen again: intersection over union with the silhouettes, mean", "at least 0.95",
              score_if(sum / VIEWS >= 0.95), "%.3f; least %.3f", sum / VIEWS, least);
}

void score_carve(score *s)
{
    static uint32_t bits[IRIS_VOXEL_BYTES(SIDE, SIDE, SIDE) / 4];
    static hull h;
    if (!load(&h)) {
        score_row(s, "a dinosaur carved from 16 silhouettes", "4 of 6 sides within 2 mm", SCORE_SKIPPED,
                  "no data (IRIS_DATA)");
    } else if (!carve(&h, bits)) {
        score_row(s, "a dinosaur carved from 16 silhouettes", "4 of 6 sides within 2 mm", SCORE_MISSED,
                  "not carved");
    } else {
        judge(s, &h);
    }
    for (int i = 0; i < VIEWS; i++) {
        free(h.masks[i].data);
    }
}
