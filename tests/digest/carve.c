#include "digest.h"

#include "iris/3d/carve.h"
#include "iris/3d/rotation.h"

enum { X = 37, Y = 12, Z = 11, W = 40, H = 32 };

static iris_voxel_world world_of(void)
{
    iris_voxel_world world;
    const int32_t counts[3] = {X, Y, Z};
    const iris_vec3 corners[2] = {{-IRIS_Q32_ONE, -IRIS_Q32_ONE / 3, -IRIS_Q32_ONE / 3},
                                  {IRIS_Q32_ONE, IRIS_Q32_ONE / 3, IRIS_Q32_ONE / 3}};
    uint32_t *bits = digest_take(IRIS_VOXEL_BYTES(X, Y, Z));
    digest_number(iris_voxel_world_init(&world, bits, IRIS_VOXEL_BYTES(X, Y, Z), counts, corners));
    return world;
}

/* Cameras around the world, four units away, that look at its middle. */
static void matrix_of(iris_q32 m[12], int32_t which)
{
    iris_sensor sensor = {
        .intrinsics = {70 * IRIS_Q32_ONE, 72 * IRIS_Q32_ONE, 0, 20 * IRIS_Q32_ONE, 15 * IRIS_Q32_ONE}};
    iris_rotation_from_vector(&sensor.pose.turn,
                              (iris_vec3){IRIS_Q32_ONE / 5 * which, IRIS_Q32_ONE / 2 * which, 0});
    sensor.pose.place = iris_mat3_transposed_vector(&sensor.pose.turn, (iris_vec3){0, 0, -4 * IRIS_Q32_ONE});
    iris_sensor_matrix(m, &sensor);
}

static void digest_bits(const iris_voxel_world *world)
{
    digest_values(world->bits, IRIS_VOXEL_BYTES(X, Y, Z), 4);
}

static void hull(void)
{
    iris_voxel_world world = world_of();
    iris_image silhouette = digest_picture(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_CARVE_SCRATCH_BYTES(W, H));
    digest_number(iris_voxel_fill(&world, 1));
    for (int32_t which = 0; which < 3; which++) {
        iris_q32 m[12];
        matrix_of(m, which);
        for (int32_t y = 0; y < H; y++) { /* a disk, with what noise the picture has within */
            uint32_t *row = iris_image_row(&silhouette, y);
            for (int32_t x = 0; x < W; x++) {
                int32_t far = (x - 20) * (x - 20) + (y - 15) * (y - 15);
                row[x / 32] |= (uint32_t)(far < 120 - 30 * which) << x % 32;
            }
        }
        digest_number(iris_carve_view(&world, &silhouette, m, &scratch));
        digest_bits(&world);
    }
}

static void surface(void)
{
    iris_voxel_world world = world_of();
    enum { ROOM = 64 };
    iris_voxel *voxels = digest_take(ROOM * sizeof *voxels);
    int32_t count = 0;
    digest_number(iris_voxel_fill(&world, 1));
    for (int32_t i = 0; i < 300; i++) {
        iris_voxel voxel;
        voxel.x = digest_between(0, X - 1);
        voxel.y = digest_between(0, Y - 1);
        voxel.z = digest_between(0, Z - 1);
        digest_number(iris_voxel_set(&world, voxel, i % 4 == 3));
    }
    digest_number(iris_voxel_count(&count, &world));
    digest_number(count);
    digest_number(iris_voxel_surface(voxels, ROOM, &count, &world));
    digest_number(count);
    for (int32_t i = 0; i < ROOM; i++) {
        digest_number(voxels[i].x + voxels[i].y * 1024 + voxels[i].z * 1048576);
    }
}

static void footprints(void)
{
    iris_voxel_world world = world_of();
    iris_voxel_view view;
    for (int32_t which = 0; which < 3; which++) {
        iris_q32 m[12];
        matrix_of(m, which);
        digest_number(iris_voxel_view_init(&view, &world, m));
        for (int32_t i = 0; i < 20; i++) {
            iris_voxel_bounds bounds = {{0, 0}, {0, 0}};
            iris_vec3 center = {0, 0, 0};
            iris_voxel voxel = {i * 7 % X, i % Y, i * 3 % Z};
            digest_number(iris_voxel_footprint(&bounds, &world, &view, voxel));
            digest_number(bounds.least.x);
            digest_number(bounds.least.y);
            digest_number(bounds.most.x);
            digest_number(bounds.most.y);
            digest_number(iris_voxel_center(&center, &world, voxel));
            digest_number(center.x);
            digest_number(center.z);
        }
    }
}

const digest_operation digest_carve[] = {
    {"voxel.surface", surface},
    {"voxel.footprints", footprints},
    {"carve.hull", hull},
    {NULL, NULL},
};
