/* Colors of the voxels at the surface. */
#include <string.h>

#include "photo_parts.h"
#include "voxel_parts.h"

#define NOBODY 128 /* gray: what nobody sees */

typedef struct {
    uint32_t sums[3], count;
} color_sum;

typedef struct {
    color_sum *sums;
    iris_carve_color *colors;
    int32_t *rows; /* the first voxel at the surface of each row: side * side */
} coloring;

/* Which voxel at the surface it is, in their order. */
static int32_t index_of(const coloring *c, const iris_voxel_world *world, iris_voxel voxel)
{
    uint32_t surface[IRIS_VOXEL_ROW_WORDS(IRIS_VOXEL_SIDE_MAX)] = {0};
    (void)iris_voxel_surface_row(surface, world, voxel.y, voxel.z);
    return c->rows[voxel.z * world->counts[1] + voxel.y] + iris_voxel_row_rank(surface, voxel.x);
}

static void add(iris_photo_work *work, int32_t view, iris_photo_voxel *voxel, void *user)
{
    const coloring *c = user;
    iris_photo_pixels seen;
    (void)iris_photo_look(&seen, work, view, voxel);
    if (seen.own == 0) {
        return;
    }
    const int32_t at = index_of(c, work->world, iris_photo_voxel_at(work, voxel));
    color_sum *sum = &c->sums[at];
    c->colors[at].views++;
    if (sum->count <= IRIS_PHOTO_OWN_MAX - (uint32_t)seen.own) {
        sum->count += (uint32_t)seen.own;
        for (int i = 0; i < 3; i++) {
            sum->sums[i] += seen.sums[i];
        }
    }
}

static void look_at_layer(iris_photo_work *work, int32_t view, const coloring *c)
{
    iris_photo_list(work);
    iris_photo_walk(work, view, add, (void *)c);
    iris_photo_keep(work);
}

/* From the layer that the camera is in, or the nearest to it, to both sides. */
static void look_at_world(iris_photo_work *work, int32_t view, const coloring *c)
{
    const int32_t layers = work->world->counts[2];
    int32_t first = 0;
    work->layer = 0;
    while (first < layers && !iris_photo_is_before(work, view, 1)) {
        first++;
        work->layer = first;
    }
    for (work->layer = first; work->layer < layers; work->layer++) {
        look_at_layer(work, view, c);
    }
    for (work->layer = first - 1; work->layer >= 0; work->layer--) {
        look_at_layer(work, view, c);
    }
}

static void mean(iris_carve_color *color, const color_sum *sum)
{
    const uint32_t n = sum->count, half = n / 2;
    const uint8_t views = color->views;
    *color = n == 0 ? (iris_carve_color){NOBODY, NOBODY, NOBODY, views}
                    : (iris_carve_color){(uint8_t)((sum->sums[0] + half) / n),
                                         (uint8_t)((sum->sums[1] + half) / n),
                                         (uint8_t)((sum->sums[2] + half) / n), views};
}

static iris_status color_all(iris_photo_work *work, coloring *c, int32_t count, int32_t room,
                             iris_scratch *scratch)
{
    size_t side = 0;
    for (int axis = 0; axis < 3; axis++) {
        side = (size_t)work->world->counts[axis] > side ? (size_t)work->world->counts[axis] : side;
    }
    c->rows = iris_scratch_take(scratch, side * side * sizeof *c->rows);
    c->sums = iris_scratch_take(scratch, (size_t)room * sizeof *c->sums);
    if (!c->rows || !c->sums) {
        return IRIS_ERR_SCRATCH;
    }
    iris_voxel_surface_rows(c->rows, work->world);
    memset(c->sums, 0, (size_t)count * sizeof *c->sums);
    memset(c->colors, 0, (size_t)count * sizeof *c->colors);
    work->axis = 2;
    iris_photo_clear(work);
    for (int32_t view = 0; view < work->count; view++) {
        look_at_world(work, view, c);
    }
    for (int32_t i = 0; i < count; i++) {
        mean(&c->colors[i], &c->sums[i]);
    }
    return IRIS_OK;
}

iris_status iris_carve_colors(iris_carve_color *colors, int32_t room, int32_t *count,
                              const iris_voxel_world *world, const iris_carve_photos *photos,
                              iris_scratch *scratch)
{
    iris_photo_work work;
    coloring c = {.colors = colors};
    if (!colors || room < 1 || !count || !scratch) {
        return IRIS_ERR_ARG;
    }
    const size_t mark = iris_scratch_mark(scratch);
    int32_t all = 0;
    iris_status status = iris_photo_begin(&work, world, photos, scratch);
    status = status == IRIS_OK ? iris_voxel_surface(NULL, 0, &all, world) : status;
    if (status == IRIS_OK && all > room) {
        status = IRIS_ERR_FULL;
        *count = all;
    } else if (status == IRIS_OK) {
        status = color_all(&work, &c, all, room, scratch);
        *count = status == IRIS_OK ? all : *count;
    }
    iris_scratch_release(scratch, mark);
    return status;
}
