/* Maps of space from pictures of depths: hits first, then what the rays pass, as grids do it with beams. */
#include "iris/3d/voxel_map.h"

#include <string.h>

#include "../../foundation/views.h"
#include "depth_row.h"

static size_t voxels_of(const int32_t counts[3])
{
    return IRIS_VOXEL_MAP_BYTES(counts[0], counts[1], counts[2]);
}

static iris_status check(const iris_voxel_map *map)
{
    if (!map || !map->odds || map->cell_mm < 1 || map->cell_mm > IRIS_GRID_CELL_MAX_MM) {
        return IRIS_ERR_ARG;
    }
    for (int axis = 0; axis < 3; axis++) {
        if (map->counts[axis] < 1 || map->counts[axis] > IRIS_VOXEL_SIDE_MAX ||
            !iris_place_fits(map->least_mm[axis])) {
            return IRIS_ERR_ARG;
        }
    }
    return IRIS_OK;
}

iris_status iris_voxel_map_init(iris_voxel_map *map, int8_t *odds, size_t bytes, const int32_t counts[3],
                                int32_t cell_mm, const int32_t least_mm[3])
{
    if (!map || !odds || !counts || !least_mm) {
        return IRIS_ERR_ARG;
    }
    const iris_voxel_map made = {
        odds, {counts[0], counts[1], counts[2]}, cell_mm, {least_mm[0], least_mm[1], least_mm[2]}};
    if (check(&made) != IRIS_OK || bytes < voxels_of(counts)) {
        return IRIS_ERR_RANGE;
    }
    memset(odds, 0, voxels_of(counts));
    *map = made;
    return IRIS_OK;
}

void iris_voxel_fusion_defaults(iris_voxel_fusion *config)
{
    if (config) {
        iris_fusion_defaults(&config->fusion);
        config->every = 2;
    }
}

typedef struct {
    const iris_voxel_map *map;
    const iris_depth_camera *camera;
    iris_voxel_fusion config;
    iris_heading turn; /* of where the camera looks */
    int32_t lens[3];   /* from the map's corner */
    uint32_t *marks;
    uint32_t product;
} fusing;

/* What a pixel sees. */
typedef struct {
    int32_t end[3]; /* from the map's corner */
    int32_t spread; /* of the depth */
    int hit;
} sight;

static int is_inside(const iris_voxel_map *map, const int32_t at[3])
{
    return at[0] >= 0 && at[0] < map->counts[0] && at[1] >= 0 && at[1] < map->counts[1] && at[2] >= 0 &&
           at[2] < map->counts[2];
}

static void add(const fusing *f, const int32_t at[3], int32_t gain)
{
    const iris_voxel_map *map = f->map;
    const size_t i =
        ((size_t)at[2] * (size_t)map->counts[1] + (size_t)at[1]) * (size_t)map->counts[0] + (size_t)at[0];
    if (iris_mark(f->marks, i)) {
        map->odds[i] = iris_fusion_add(&f->config.fusion, map->odds[i], gain);
    }
}

static void add_hit(const fusing *f, const sight *s)
{
    const int32_t cell = f->map->cell_mm;
    const int32_t worth = s->hit ? iris_fusion_hit(&f->config.fusion, s->spread, cell) : 0;
    const int32_t at[3] = {iris_ray_floor(s->end[0], cell), iris_ray_floor(s->end[1], cell),
                           iris_ray_floor(s->end[2], cell)};
    if (worth > 0 && is_inside(f->map, at)) {
        add(f, at, worth);
    }
}

static void add_misses(const fusing *f, const sight *s)
{
    int32_t way[3], end[3];
    uint64_t square = 0;
    iris_ray ray;
    for (int axis = 0; axis < 3; axis++) {
        way[axis] = s->end[axis] - f->lens[axis];
        square += (uint64_t)((int64_t)way[axis] * way[axis]);
    }
    const int32_t length = (int32_t)iris_sqrt_u64(square);
    const int32_t unsure = s->hit ? 2 * s->spread : 0;
    if (length == 0) {
        return;
    }
    const int32_t part = length > unsure ? length - unsure : 0;
    for (int axis = 0; axis < 3; axis++) {
        end[axis] =
            part == length ? s->end[axis] : f->lens[axis] + (int32_t)((int64_t)way[axis] * part / length);
    }
    iris_ray_start(&ray, f->lens, end, f->map->cell_mm);
    do {
        if (!is_inside(f->map, ray.at)) {
            return;
        }
        add(f, ray.at, -f->config.fusion.miss);
    } while (iris_ray_next(&ray));
}

/* 0: the pixel sees nothing that is taken. */
static int see(sight *s, const fusing *f, const iris_depth_row *row, int32_t u, uint16_t pixel)
{
    const iris_depth_camera *c = f->camera;
    const int32_t reach = IRIS_SCAN_REACH_MAX_MM;
    uint32_t depth = pixel == 0 ? 0 : iris_depth_of(f->product, pixel);
    int32_t ahead = iris_depth_ahead(row, depth);
    s->hit = ahead <= c->far_mm;
    if (ahead < c->near_mm) {
        return 0;
    }
    if (!s->hit) {
        depth = (uint32_t)((int64_t)c->far_mm * IRIS_Q16_ONE / row->ahead);
        ahead = c->far_mm;
    }
    const int64_t left = ((int64_t)c->u0_q16 - (int64_t)u * IRIS_Q16_ONE) * depth / c->focal_q16;
    const int32_t height = iris_depth_height(row, depth, c);
    if (left <= -reach || left >= reach || height <= -reach || height >= reach) {
        return 0;
    }
    s->spread = iris_depth_spread(c, ahead);
    s->end[0] = f->lens[0] + iris_heading_x(f->turn, ahead, (int32_t)left);
    s->end[1] = f->lens[1] + iris_heading_y(f->turn, ahead, (int32_t)left);
    s->end[2] = f->lens[2] + height - c->height_mm;
    return 1;
}

static void look(const fusing *f, const iris_image *depth, void (*take)(const fusing *, const sight *))
{
    for (int32_t v = 0; v < depth->h; v += f->config.every) {
        const uint16_t *pixels = iris_image_row(depth, v);
        iris_depth_row row;
        if (!iris_depth_row_of(&row, f->camera, v)) {
            continue;
        }
        for (int32_t u = 0; u < depth->w; u += f->config.every) {
            sight s;
            if (see(&s, f, &row, u, pixels[u])) {
                take(f, &s);
            }
        }
    }
}

/* IRIS_ERR_RANGE: the lens is outside of the map. */
static iris_status place_lens(fusing *f, iris_map_pose robot)
{
    const iris_map_pose at = iris_map_pose_after(robot, f->camera->mount);
    const int32_t cell = f->map->cell_mm, place[3] = {at.x_mm, at.y_mm, f->camera->height_mm};
    int32_t voxel[3];
    for (int axis = 0; axis < 3; axis++) {
        if (!iris_place_fits(place[axis])) {
            return IRIS_ERR_RANGE;
        }
        f->lens[axis] = place[axis] - f->map->least_mm[axis];
        voxel[axis] = iris_ray_floor(f->lens[axis], cell);
    }
    f->turn = iris_heading_of(at.heading);
    return is_inside(f->map, voxel) ? IRIS_OK : IRIS_ERR_RANGE;
}

iris_status iris_voxel_map_fuse(const iris_voxel_map *map, iris_map_pose robot, const iris_image *depth,
                                const iris_depth_camera *camera, const iris_voxel_fusion *config,
                                iris_scratch *scratch)
{
    fusing f = {.map = map, .camera = camera};
    iris_voxel_fusion_defaults(&f.config);
    f.config = config ? *config : f.config;
    if (!depth || !camera || !scratch || check(map) != IRIS_OK ||
        iris_depth_camera_check(camera) != IRIS_OK || iris_fusion_check(&f.config.fusion) != IRIS_OK ||
        f.config.every < 1 || f.config.every > IRIS_SIDE_MAX) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(depth, IRIS_GRAY_U16);
    status = status == IRIS_OK ? place_lens(&f, robot) : status;
    if (status != IRIS_OK) {
        return status;
    }
    const size_t mark = iris_scratch_mark(scratch),
                 bytes = IRIS_VOXEL_MAP_FUSE_SCRATCH_BYTES(map->counts[0], map->counts[1], map->counts[2]);
    f.product = iris_depth_product(camera);
    f.marks = iris_scratch_take(scratch, bytes);
    if (!f.marks) {
        return IRIS_ERR_SCRATCH;
    }
    memset(f.marks, 0, bytes);
    look(&f, depth, add_hit);
    look(&f, depth, add_misses);
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}

/* Millimeters to meters with 32 fraction bits, of places below 2^30. */
static iris_q32 meters(int64_t mm)
{
    return mm * IRIS_Q32_ONE / 1000;
}

iris_status iris_voxel_map_solid(iris_voxel_world *world, uint32_t *bits, size_t bytes,
                                 const iris_voxel_map *map, int32_t odds)
{
    if (!world || !bits || check(map) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    const int32_t *n = map->counts, *least = map->least_mm;
    const int64_t cell = map->cell_mm;
    const iris_vec3 corners[2] = {
        {meters(least[0]), meters(least[1]), meters(least[2])},
        {meters(least[0] + n[0] * cell), meters(least[1] + n[1] * cell), meters(least[2] + n[2] * cell)}};
    const iris_status status = iris_voxel_world_init(world, bits, bytes, n, corners);
    if (status != IRIS_OK) {
        return status;
    }
    (void)iris_voxel_fill(world, 0);
    const int8_t *from = map->odds;
    for (int32_t z = 0; z < n[2]; z++) {
        for (int32_t y = 0; y < n[1]; y++) {
            uint32_t *row = iris_voxel_row(world, y, z);
            for (int32_t x = 0; x < n[0]; x++) {
                row[x / 32] |= (uint32_t)(*from++ >= odds) << (x % 32);
            }
        }
    }
    return IRIS_OK;
}
