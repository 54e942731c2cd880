/* Photo-consistent carving: planes swept through the world. */
#include "photo_parts.h"
#include "voxel_parts.h"

void iris_carve_photo_defaults(iris_carve_photo_config *config)
{
    if (config) {
        *config = (iris_carve_photo_config){16, 100};
    }
}

static void judge(iris_photo_work *work, int32_t view, iris_photo_voxel *voxel, void *user)
{
    iris_photo_pixels seen;
    (void)user;
    if (!iris_photo_look(&seen, work, view, voxel)) {
        return;
    }
    voxel->views++;
    for (int i = 0; i < 3; i++) {
        voxel->least[i] = seen.least[i] > voxel->least[i] ? seen.least[i] : voxel->least[i];
        voxel->most[i] = seen.most[i] < voxel->most[i] ? seen.most[i] : voxel->most[i];
    }
}

static void hide(iris_photo_work *work, int32_t view, iris_photo_voxel *voxel, void *user)
{
    iris_photo_pixels seen;
    (void)user;
    (void)iris_photo_look(&seen, work, view, voxel);
}

static void walk_all(iris_photo_work *work, int up,
                     void (*look)(iris_photo_work *, int32_t, iris_photo_voxel *, void *))
{
    for (int32_t view = 0; view < work->count; view++) {
        if (iris_photo_is_before(work, view, up)) {
            iris_photo_walk(work, view, look, NULL);
        }
    }
}

static int disagree(const iris_photo_voxel *voxel, int32_t levels)
{
    for (int i = 0; i < 3; i++) {
        if (voxel->least[i] - voxel->most[i] > levels) {
            return 1;
        }
    }
    return 0;
}

static int32_t judge_layer(iris_photo_work *work, int up, int32_t levels)
{
    int32_t removed = 0;
    iris_photo_list(work);
    const int32_t count = work->rows[work->world->counts[(work->axis + 2) % 3]];
    if (count == 0) {
        return 0;
    }
    walk_all(work, up, judge);
    for (int32_t i = 0; i < count; i++) {
        if (disagree(&work->voxels[i], levels)) {
            (void)iris_voxel_set(work->world, iris_photo_voxel_at(work, &work->voxels[i]), 0);
            removed++;
        }
    }
    if (removed > 0) { /* what is left of the layer hides less, and other sides of it are open */
        iris_photo_drop(work);
        iris_photo_list(work);
        walk_all(work, up, hide);
    }
    iris_photo_keep(work);
    return removed;
}

static int32_t sweep(iris_photo_work *work, iris_sweep direction, int32_t levels)
{
    const int up = (int)direction % 2 == 0;
    int32_t removed = 0;
    iris_photo_clear(work);
    work->axis = (int)direction / 2;
    const int32_t layers = work->world->counts[work->axis];
    for (int32_t i = 0; i < layers; i++) {
        work->layer = up ? i : layers - 1 - i;
        removed += judge_layer(work, up, levels);
    }
    return removed;
}

/* Rounds of sweeps, or one sweep. */
static iris_status carve(int32_t *removed, iris_photo_work *work, const iris_sweep *direction,
                         const iris_carve_photo_config *config)
{
    if (direction) {
        *removed = sweep(work, *direction, config->levels);
        return IRIS_OK;
    }
    int32_t all = 0, before = -1;
    for (int32_t round = 0; round < config->rounds && all != before; round++) {
        before = all;
        for (int i = IRIS_SWEEP_X_UP; i <= IRIS_SWEEP_Z_DOWN; i++) {
            all += sweep(work, (iris_sweep)i, config->levels);
        }
    }
    *removed = all;
    return IRIS_OK;
}

static iris_status check_config(iris_carve_photo_config *to, const iris_carve_photo_config *config)
{
    iris_carve_photo_defaults(to);
    *to = config ? *config : *to;
    return to->levels < 0 || to->levels > 255 || to->rounds < 1 ? IRIS_ERR_ARG : IRIS_OK;
}

iris_status iris_carve_photo_sweep(int32_t *removed, const iris_voxel_world *world,
                                   const iris_carve_photos *photos, iris_sweep direction,
                                   const iris_carve_photo_config *config, iris_scratch *scratch)
{
    iris_photo_work work;
    iris_carve_photo_config use;
    iris_status status = removed && scratch && (unsigned)direction <= IRIS_SWEEP_Z_DOWN
                             ? check_config(&use, config)
                             : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    const size_t mark = iris_scratch_mark(scratch);
    status = iris_photo_begin(&work, world, photos, scratch);
    status = status == IRIS_OK ? carve(removed, &work, &direction, &use) : status;
    iris_scratch_release(scratch, mark);
    return status;
}

iris_status iris_carve_photo_world(int32_t *removed, const iris_voxel_world *world,
                                   const iris_carve_photos *photos, const iris_carve_photo_config *config,
                                   iris_scratch *scratch)
{
    iris_photo_work work;
    iris_carve_photo_config use;
    iris_status status = removed && scratch ? check_config(&use, config) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    const size_t mark = iris_scratch_mark(scratch);
    status = iris_photo_begin(&work, world, photos, scratch);
    status = status == IRIS_OK ? carve(removed, &work, NULL, &use) : status;
    iris_scratch_release(scratch, mark);
    return status;
}
