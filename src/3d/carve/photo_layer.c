/* Layers of voxels, and views that walk through them. */
#include <string.h>

#include "../../foundation/views.h"
#include "photo_parts.h"
#include "voxel_parts.h"

#define EYE_ONE   256                /* a lattice step */
#define EYE_FAR   ((int64_t)1 << 40) /* further away is all the same */
#define PLACE_FAR ((iris_q32)1 << 61)

static iris_q32 within(iris_q32 a, iris_q32 limit)
{
    return a > limit ? limit : a < -limit ? -limit : a;
}

static iris_status check_photo(const iris_carve_photo *photo, const iris_image *first)
{
    iris_status status = iris_image_check(&photo->picture);
    const iris_format format = photo->picture.format;
    if (status != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (!iris_format_is_levels(format) || (format == IRIS_GRAY8) != (first->format == IRIS_GRAY8)) {
        return IRIS_ERR_FORMAT;
    }
    if (!photo->silhouette) {
        return IRIS_OK;
    }
    if (iris_image_check(photo->silhouette) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    status = iris_views_check_one(photo->silhouette, IRIS_MASK1);
    const int same = photo->silhouette->w == photo->picture.w && photo->silhouette->h == photo->picture.h;
    return status == IRIS_OK && !same ? IRIS_ERR_RANGE : status;
}

static iris_status make_eye(iris_photo_eye *eye, const iris_voxel_world *world, const iris_carve_photo *photo)
{
    iris_sensor sensor;
    iris_status status = iris_voxel_view_init(&eye->view, world, photo->m);
    status = status == IRIS_OK ? iris_sensor_decompose(&sensor, photo->m) : status;
    if (status != IRIS_OK) {
        return status;
    }
    for (int row = 0; row < 3; row++) {
        eye->view.at[row] >>= 8;
        for (int axis = 0; axis < 3; axis++) {
            eye->view.step[axis][row] >>= 8;
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        const iris_q32 least = iris_voxel_coordinate(world->least, axis);
        const iris_q32 side = iris_voxel_coordinate(world->most, axis) - least;
        const iris_q32 away = within(iris_voxel_coordinate(sensor.pose.place, axis), PLACE_FAR) - least;
        eye->eye[axis] =
            within(iris_wide_div_sat(iris_wide_mul(away, 2 * EYE_ONE * (int64_t)world->counts[axis]), side),
                   EYE_FAR);
    }
    eye->top = photo->picture.h;
    eye->bottom = 0;
    eye->sides[0] = photo->picture.w;
    eye->sides[1] = photo->picture.h;
    return IRIS_OK;
}

static iris_status check(const iris_voxel_world *world, const iris_carve_photos *photos)
{
    iris_status status = photos && photos->photos ? iris_voxel_check(world) : IRIS_ERR_ARG;
    if (status == IRIS_OK && (photos->count < 1 || photos->count > IRIS_CARVE_PHOTOS_MAX)) {
        status = IRIS_ERR_ARG;
    }
    for (int32_t i = 0; status == IRIS_OK && i < photos->count; i++) {
        status = check_photo(&photos->photos[i], &photos->photos[0].picture);
    }
    return status;
}

iris_status iris_photo_begin(iris_photo_work *work, const iris_voxel_world *world,
                             const iris_carve_photos *photos, iris_scratch *scratch)
{
    iris_status status = scratch ? check(world, photos) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    int32_t w = 0, h = 0, side = 0;
    for (int32_t i = 0; i < photos->count; i++) {
        const iris_image *picture = &photos->photos[i].picture;
        w = picture->w > w ? picture->w : w;
        h = picture->h > h ? picture->h : h;
    }
    for (int axis = 0; axis < 3; axis++) {
        side = world->counts[axis] > side ? world->counts[axis] : side;
    }
    const size_t row_words = IRIS_VOXEL_ROW_WORDS(w), view_words = row_words * (size_t)h;
    const size_t bytes = IRIS_CARVE_PHOTO_SCRATCH_BYTES(side, photos->count, w, h);
    if (view_words > SIZE_MAX / 16 / (size_t)photos->count || scratch->bytes - scratch->used < bytes) {
        return IRIS_ERR_SCRATCH;
    }
    *work = (iris_photo_work){.world = world, .photos = photos->photos, .count = photos->count};
    work->row_words = row_words;
    work->view_words = view_words;
    work->voxels = iris_scratch_take(scratch, (size_t)side * (size_t)side * sizeof *work->voxels);
    work->rows = iris_scratch_take(scratch, ((size_t)side + 1) * sizeof *work->rows);
    work->eyes = iris_scratch_take(scratch, (size_t)photos->count * sizeof *work->eyes);
    work->explained = iris_scratch_take(scratch, 4 * view_words * (size_t)photos->count);
    work->hidden = iris_scratch_take(scratch, 4 * view_words * (size_t)photos->count);
    if (!work->voxels || !work->rows || !work->eyes || !work->explained || !work->hidden) {
        return IRIS_ERR_SCRATCH;
    }
    for (int32_t i = 0; i < photos->count && status == IRIS_OK; i++) {
        status = make_eye(&work->eyes[i], world, &photos->photos[i]);
    }
    return status;
}

void iris_photo_clear(iris_photo_work *work)
{
    memset(work->explained, 0, 4 * work->view_words * (size_t)work->count);
    memset(work->hidden, 0, 4 * work->view_words * (size_t)work->count);
}

static void end_layer(iris_photo_work *work, int keeps)
{
    for (int32_t i = 0; i < work->count; i++) {
        iris_photo_eye *eye = &work->eyes[i];
        if (eye->top < eye->bottom) {
            const size_t first = (size_t)i * work->view_words + (size_t)eye->top * work->row_words;
            const size_t words = (size_t)(eye->bottom - eye->top) * work->row_words;
            for (size_t k = first; k < first + words && keeps; k++) {
                work->explained[k] |= work->hidden[k];
            }
            memset(work->hidden + first, 0, 4 * words);
        }
        eye->top = eye->sides[1];
        eye->bottom = 0;
    }
}

void iris_photo_drop(iris_photo_work *work)
{
    end_layer(work, 0);
}

void iris_photo_keep(iris_photo_work *work)
{
    end_layer(work, 1);
}

int iris_photo_is_before(const iris_photo_work *work, int32_t view, int up)
{
    const int64_t eye = work->eyes[view].eye[work->axis];
    const int64_t layer = 2 * EYE_ONE * (int64_t)work->layer;
    return up ? eye < layer + 2 * EYE_ONE : eye > layer;
}

/* --- the voxels of a layer --- */

static iris_voxel place_in(const iris_photo_work *work, int32_t a, int32_t b)
{
    return work->axis == 0   ? (iris_voxel){work->layer, a, b}
           : work->axis == 1 ? (iris_voxel){b, work->layer, a}
                             : (iris_voxel){a, b, work->layer};
}

iris_voxel iris_photo_voxel_at(const iris_photo_work *work, const iris_photo_voxel *voxel)
{
    return place_in(work, voxel->a, voxel->b);
}

static uint8_t exposed_sides(const iris_voxel_world *world, iris_voxel v)
{
    return (uint8_t)((iris_voxel_get(world, (iris_voxel){v.x - 1, v.y, v.z}) ? 0 : 1) |
                     (iris_voxel_get(world, (iris_voxel){v.x + 1, v.y, v.z}) ? 0 : 2) |
                     (iris_voxel_get(world, (iris_voxel){v.x, v.y - 1, v.z}) ? 0 : 4) |
                     (iris_voxel_get(world, (iris_voxel){v.x, v.y + 1, v.z}) ? 0 : 8) |
                     (iris_voxel_get(world, (iris_voxel){v.x, v.y, v.z - 1}) ? 0 : 16) |
                     (iris_voxel_get(world, (iris_voxel){v.x, v.y, v.z + 1}) ? 0 : 32));
}

void iris_photo_list(iris_photo_work *work)
{
    const int32_t columns = work->world->counts[(work->axis + 1) % 3];
    const int32_t rows = work->world->counts[(work->axis + 2) % 3];
    int32_t count = 0;
    for (int32_t b = 0; b < rows; b++) {
        work->rows[b] = count;
        for (int32_t a = 0; a < columns; a++) {
            const iris_voxel v = place_in(work, a, b);
            const uint8_t exposed = iris_voxel_get(work->world, v) ? exposed_sides(work->world, v) : 0;
            if (exposed != 0) {
                work->voxels[count++] =
                    (iris_photo_voxel){(int16_t)a, (int16_t)b, exposed, 0, {0, 0, 0}, {255, 255, 255}};
            }
        }
    }
    work->rows[rows] = count;
}

/* The voxel that the eye is in, along an axis of the layer: 0 to count. */
static int32_t eye_at(const iris_photo_eye *eye, int axis, int32_t count)
{
    const int64_t at = eye->eye[axis] / (2 * EYE_ONE);
    return eye->eye[axis] < 0 ? 0 : at > count ? count : (int32_t)at;
}

typedef void (*look_at)(iris_photo_work *work, int32_t view, iris_photo_voxel *voxel, void *user);

static void walk_row(iris_photo_work *work, int32_t view, int32_t row, look_at look, void *user)
{
    const int axis = (work->axis + 1) % 3;
    const int32_t eye = eye_at(&work->eyes[view], axis, work->world->counts[axis]);
    const int32_t first = work->rows[row], end = work->rows[row + 1];
    int32_t middle = first;
    while (middle < end && work->voxels[middle].a < eye) {
        middle++;
    }
    for (int32_t i = middle; i < end; i++) {
        look(work, view, &work->voxels[i], user);
    }
    for (int32_t i = middle - 1; i >= first; i--) {
        look(work, view, &work->voxels[i], user);
    }
}

void iris_photo_walk(iris_photo_work *work, int32_t view, look_at look, void *user)
{
    const int axis = (work->axis + 2) % 3;
    const int32_t rows = work->world->counts[axis];
    const int32_t eye = eye_at(&work->eyes[view], axis, rows);
    for (int32_t row = eye; row < rows; row++) {
        walk_row(work, view, row, look, user);
    }
    for (int32_t row = eye - 1; row >= 0; row--) {
        walk_row(work, view, row, look, user);
    }
}
