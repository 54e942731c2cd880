#include "carve_shows.h"

#include <stdlib.h>

#include "iris/3d/carve.h"
#include "picture.h"
#include "system.h"

/* A silhouette without anything takes away all that is shown. */
static iris_status carve_black(const iris_voxel_world *whole, const iris_q32 m[12], iris_size size)
{
    picture_buffer black = {0};
    const size_t bytes = IRIS_CARVE_SCRATCH_BYTES(size.w, size.h);
    void *memory = system_scratch(bytes);
    iris_scratch scratch;
    iris_status status = memory ? picture_reserve(&black, size, IRIS_MASK1) : IRIS_ERR_SCRATCH;
    status = status == IRIS_OK ? iris_scratch_init(&scratch, memory, bytes) : status;
    if (status == IRIS_OK) {
        for (int32_t y = 0; y < size.h; y++) {
            uint32_t *row = iris_image_row(&black.image, y);
            for (int32_t x = 0; x < size.w; x += 32) {
                row[x / 32] = 0;
            }
        }
        status = iris_carve_view(whole, &black.image, m, &scratch);
    }
    free(memory);
    picture_free(&black);
    return status;
}

int carve_shows(const iris_voxel_world *world, const iris_q32 m[12], iris_size size)
{
    const int32_t *counts = world->counts;
    const size_t bytes = IRIS_VOXEL_BYTES(counts[0], counts[1], counts[2]);
    const iris_vec3 corners[2] = {world->least, world->most};
    iris_voxel_world whole;
    int32_t all = 0, left = 0;
    uint32_t *bits = malloc(bytes);
    if (bits && iris_voxel_world_init(&whole, bits, bytes, counts, corners) == IRIS_OK) {
        (void)iris_voxel_fill(&whole, 1);
        (void)iris_voxel_count(&all, &whole);
        left = carve_black(&whole, m, size) == IRIS_OK ? 0 : -1;
        if (left == 0) {
            (void)iris_voxel_count(&left, &whole);
        }
    }
    free(bits);
    return !bits || left < all;
}
