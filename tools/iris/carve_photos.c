#include "carve_photos.h"

#include <stdlib.h>

#include "complain.h"
#include "frame_reader.h"
#include "iris/xt/threshold.h"
#include "progress.h"
#include "system.h"

static int read_picture(picture_buffer *picture, const char *path, iris_format format)
{
    static frame_reader reader;
    iris_status status = frame_reader_open(&reader, path);
    status = status == IRIS_OK ? frame_reader_next(&reader, picture, format) : status;
    frame_reader_close(&reader);
    if (status != IRIS_OK) {
        complain(path, "%s", frame_reader_problem(&reader));
    }
    return status == IRIS_OK;
}

/* Black and white, but for grays along edges? A picture without any white is all black. */
static int is_silhouette(const iris_image *gray)
{
    int64_t dark = 0, between = 0, bright = 0;
    int most = 0;
    for (int32_t y = 0; y < gray->h; y++) {
        const uint8_t *row = iris_image_row(gray, y);
        for (int32_t x = 0; x < gray->w; x++) {
            dark += row[x] < 32;
            bright += row[x] >= 224;
            most = row[x] > most ? row[x] : most;
        }
    }
    between = (int64_t)gray->w * gray->h - dark - bright;
    if (bright == 0) {
        return most == 0;
    }
    return 2 * between <= (dark < bright ? dark : bright) || 500 * between <= dark + between + bright;
}

int carve_silhouette_read(picture_buffer *mask, const char *path)
{
    picture_buffer gray = {0};
    int done = read_picture(&gray, path, IRIS_GRAY8);
    if (done && !is_silhouette(&gray.image)) {
        complain(path,
                 "a silhouette is black and white (white: the thing), and this has grays: iris threshold "
                 "makes one of it");
        done = 0;
    }
    if (done) {
        const iris_size size = {gray.image.w, gray.image.h};
        iris_status status = picture_reserve(mask, size, IRIS_MASK1);
        status =
            status == IRIS_OK ? iris_threshold(&mask->image, &gray.image, 127, IRIS_SELECT_BRIGHT) : status;
        done = status == IRIS_OK;
        if (!done) {
            complain(path, "%s", picture_problem(status, size));
        }
    }
    picture_free(&gray);
    return done;
}

static int read_photo(carve_photos *p, const carve_view *view)
{
    picture_buffer *picture = &p->pictures[p->count], *mask = &p->masks[p->count];
    iris_carve_photo *photo = &p->photos[p->count++];
    if (!read_picture(picture, view->photo, IRIS_RGB888) ||
        (view->silhouette && !carve_silhouette_read(mask, view->silhouette))) {
        return 0;
    }
    photo->picture = picture->image;
    photo->silhouette = view->silhouette ? &mask->image : NULL;
    for (int i = 0; i < 12; i++) {
        photo->m[i] = view->m[i];
    }
    if (view->silhouette && (mask->image.w != picture->image.w || mask->image.h != picture->image.h)) {
        complain(view->photo, "%dx%d pixels, but its silhouette has %dx%d: the camera is one for both",
                 (int)picture->image.w, (int)picture->image.h, (int)mask->image.w, (int)mask->image.h);
        return 0;
    }
    return 1;
}

int carve_photos_read(carve_photos *p, const carve_views *views)
{
    int photos = 0;
    for (int i = 0; i < views->count; i++) {
        photos += views->views[i].photo != NULL;
    }
    if (photos > IRIS_CARVE_PHOTOS_MAX) {
        complain("--photos", "at most %d, not %d", IRIS_CARVE_PHOTOS_MAX, photos);
        return 0;
    }
    if (photos == 0) {
        return 1;
    }
    p->photos = calloc((size_t)photos, sizeof *p->photos);
    p->pictures = calloc((size_t)photos, sizeof *p->pictures);
    p->masks = calloc((size_t)photos, sizeof *p->masks);
    if (!p->photos || !p->pictures || !p->masks) {
        complain("--photos", "not enough memory: take fewer");
        return 0;
    }
    for (int i = 0; i < views->count; i++) {
        if (views->views[i].photo) {
            progress_show("carve", p->count + 1, photos, views->views[i].photo);
            if (!read_photo(p, &views->views[i])) {
                progress_clear();
                return 0;
            }
        }
    }
    progress_clear();
    return 1;
}

/* What carving and coloring take, and a world of any size. */
static size_t memory_for(const carve_photos *p, const iris_voxel_world *world, int32_t surface)
{
    size_t side = 0, w = 0, h = 0;
    for (int i = 0; i < 3; i++) {
        side = (size_t)world->counts[i] > side ? (size_t)world->counts[i] : side;
    }
    for (int i = 0; i < p->count; i++) {
        const iris_image *picture = &p->photos[i].picture;
        w = (size_t)picture->w > w ? (size_t)picture->w : w;
        h = (size_t)picture->h > h ? (size_t)picture->h : h;
    }
    return surface > 0 ? IRIS_CARVE_COLORS_SCRATCH_BYTES(side, p->count, w, h, surface)
                       : IRIS_CARVE_PHOTO_SCRATCH_BYTES(side, p->count, w, h);
}

static iris_status sweep_all(carve_photos *p, const iris_voxel_world *world, int32_t levels,
                             iris_scratch *scratch)
{
    static const char *const names[] = {"x up", "x down", "y up", "y down", "z up", "z down"};
    const iris_carve_photos photos = {p->photos, p->count};
    iris_carve_photo_config config;
    iris_status status = IRIS_OK;
    int32_t of_round = 1;
    iris_carve_photo_defaults(&config);
    config.levels = levels;
    for (; status == IRIS_OK && of_round > 0 && p->rounds < config.rounds; p->rounds++) {
        of_round = 0;
        for (int i = IRIS_SWEEP_X_UP; status == IRIS_OK && i <= IRIS_SWEEP_Z_DOWN; i++) {
            int32_t removed = 0;
            progress_show("carve by photos, sweep", 6 * (int)p->rounds + i + 1, 0, names[i]);
            status = iris_carve_photo_sweep(&removed, world, &photos, (iris_sweep)i, &config, scratch);
            of_round += removed;
        }
        p->removed += of_round;
    }
    progress_clear();
    return status;
}

static iris_status color(carve_photos *p, const iris_voxel_world *world, int32_t surface,
                         iris_scratch *scratch)
{
    const iris_carve_photos photos = {p->photos, p->count};
    p->colors = calloc((size_t)surface, sizeof *p->colors);
    return p->colors ? iris_carve_colors(p->colors, surface, &p->colored, world, &photos, scratch)
                     : IRIS_ERR_SCRATCH;
}

static iris_status with_memory(carve_photos *p, const iris_voxel_world *world, int32_t surface,
                               int32_t levels)
{
    const size_t bytes = memory_for(p, world, surface);
    void *memory = system_scratch(bytes);
    iris_scratch scratch;
    iris_status status = memory ? iris_scratch_init(&scratch, memory, bytes) : IRIS_ERR_SCRATCH;
    if (status == IRIS_OK) {
        status = surface > 0 ? color(p, world, surface, &scratch) : sweep_all(p, world, levels, &scratch);
    }
    free(memory);
    return status;
}

int carve_photos_carve(carve_photos *p, const iris_voxel_world *world, int32_t levels)
{
    int32_t surface = 0;
    iris_status status = with_memory(p, world, 0, levels);
    (void)iris_voxel_surface(NULL, 0, &surface, world);
    if (status == IRIS_OK && surface > 0) {
        status = with_memory(p, world, surface, levels);
    }
    if (status != IRIS_OK) {
        complain("--photos", status == IRIS_ERR_RANGE ? "a camera's numbers are those of no camera at a place"
                                                      : "not enough memory: take fewer voxels");
    }
    return status == IRIS_OK;
}

void carve_photos_free(carve_photos *p)
{
    for (int i = 0; i < p->count; i++) {
        picture_free(&p->pictures[i]);
        picture_free(&p->masks[i]);
    }
    free(p->photos);
    free(p->pictures);
    free(p->masks);
    free(p->colors);
    *p = (carve_photos){.photos = NULL};
}
