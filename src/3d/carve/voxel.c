/* A world of voxels: bits in rows. */
#include "iris/3d/voxel.h"

#include <string.h>

#include "voxel_parts.h"

static int fits(iris_q32 place)
{
    return place > -IRIS_VOXEL_PLACE_MAX && place < IRIS_VOXEL_PLACE_MAX;
}

iris_status iris_voxel_check(const iris_voxel_world *world)
{
    if (!world || !world->bits) {
        return IRIS_ERR_ARG;
    }
    for (int axis = 0; axis < 3; axis++) {
        iris_q32 least = iris_voxel_coordinate(world->least, axis),
                 most = iris_voxel_coordinate(world->most, axis);
        if (world->counts[axis] < 1 || world->counts[axis] > IRIS_VOXEL_SIDE_MAX || !fits(least) ||
            !fits(most) || most <= least) {
            return IRIS_ERR_ARG;
        }
    }
    return IRIS_OK;
}

iris_status iris_voxel_world_init(iris_voxel_world *world, uint32_t *bits, size_t bytes,
                                  const int32_t counts[3], const iris_vec3 corners[2])
{
    if (!world || !bits || !counts || !corners) {
        return IRIS_ERR_ARG;
    }
    iris_voxel_world made = {NULL, {counts[0], counts[1], counts[2]}, corners[0], corners[1]};
    made.bits = bits;
    if (iris_voxel_check(&made) != IRIS_OK ||
        bytes / ((size_t)counts[1] * (size_t)counts[2]) < 4 * IRIS_VOXEL_ROW_WORDS(counts[0])) {
        return IRIS_ERR_RANGE;
    }
    *world = made;
    return IRIS_OK;
}

/* The bits of the last word of a row that are voxels. */
static uint32_t last_bits(const iris_voxel_world *world)
{
    return UINT32_MAX >> (31 - (world->counts[0] - 1) % 32);
}

iris_status iris_voxel_fill(const iris_voxel_world *world, int there)
{
    iris_status status = iris_voxel_check(world);
    if (status != IRIS_OK) {
        return status;
    }
    const size_t words = IRIS_VOXEL_ROW_WORDS(world->counts[0]);
    for (int32_t z = 0; z < world->counts[2]; z++) {
        for (int32_t y = 0; y < world->counts[1]; y++) {
            uint32_t *row = iris_voxel_row(world, y, z);
            memset(row, there ? 0xFF : 0, 4 * words);
            row[words - 1] &= last_bits(world);
        }
    }
    return IRIS_OK;
}

int iris_voxel_is_inside(const iris_voxel_world *world, iris_voxel voxel)
{
    return voxel.x >= 0 && voxel.x < world->counts[0] && voxel.y >= 0 && voxel.y < world->counts[1] &&
           voxel.z >= 0 && voxel.z < world->counts[2];
}

iris_status iris_voxel_set(const iris_voxel_world *world, iris_voxel voxel, int there)
{
    iris_status status = iris_voxel_check(world);
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_voxel_is_inside(world, voxel)) {
        return IRIS_ERR_RANGE;
    }
    uint32_t *word = iris_voxel_row(world, voxel.y, voxel.z) + voxel.x / 32;
    const uint32_t bit = (uint32_t)1 << (voxel.x % 32);
    *word = there ? *word | bit : *word & ~bit;
    return IRIS_OK;
}

static int32_t ones(uint32_t word)
{
    word -= word >> 1 & 0x55555555u;
    word = (word & 0x33333333u) + (word >> 2 & 0x33333333u);
    word = (word + (word >> 4)) & 0x0F0F0F0Fu;
    return (int32_t)((word * 0x01010101u) >> 24);
}

int32_t iris_voxel_row_rank(const uint32_t *bits, int32_t x)
{
    int32_t before = 0;
    for (int32_t i = 0; i < x / 32; i++) {
        before += ones(bits[i]);
    }
    return x % 32 == 0 ? before : before + ones(bits[x / 32] & (UINT32_MAX >> (32 - x % 32)));
}

iris_status iris_voxel_count(int32_t *count, const iris_voxel_world *world)
{
    iris_status status = count ? iris_voxel_check(world) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    const size_t words = IRIS_VOXEL_ROW_WORDS(world->counts[0]);
    int32_t sum = 0;
    for (int32_t z = 0; z < world->counts[2]; z++) {
        for (int32_t y = 0; y < world->counts[1]; y++) {
            const uint32_t *row = iris_voxel_row(world, y, z);
            for (size_t i = 0; i < words; i++) {
                sum += ones(i == words - 1 ? row[i] & last_bits(world) : row[i]);
            }
        }
    }
    *count = sum;
    return IRIS_OK;
}

static iris_q32 middle(iris_q32 least, iris_q32 most, int32_t index, int32_t count)
{
    iris_wide along = iris_wide_mul(most - least, 2 * (int64_t)index + 1);
    return least + iris_wide_div_sat(along, 2 * (int64_t)count);
}

iris_status iris_voxel_center(iris_vec3 *center, const iris_voxel_world *world, iris_voxel voxel)
{
    iris_status status = center ? iris_voxel_check(world) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_voxel_is_inside(world, voxel)) {
        return IRIS_ERR_RANGE;
    }
    center->x = middle(world->least.x, world->most.x, voxel.x, world->counts[0]);
    center->y = middle(world->least.y, world->most.y, voxel.y, world->counts[1]);
    center->z = middle(world->least.z, world->most.z, voxel.z, world->counts[2]);
    return IRIS_OK;
}

/* Word i of the row at (y, z), as voxels that are there: none outside of the world. */
static uint32_t word_at(const iris_voxel_world *world, int32_t i, int32_t y, int32_t z)
{
    const int32_t words = (int32_t)IRIS_VOXEL_ROW_WORDS(world->counts[0]);
    if (i < 0 || i >= words || y < 0 || y >= world->counts[1] || z < 0 || z >= world->counts[2]) {
        return 0;
    }
    uint32_t word = iris_voxel_row(world, y, z)[i];
    return i == words - 1 ? word & last_bits(world) : word;
}

iris_status iris_voxel_surface_row(uint32_t *surface, const iris_voxel_world *world, int32_t y, int32_t z)
{
    iris_status status = surface ? iris_voxel_check(world) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    if (y < 0 || y >= world->counts[1] || z < 0 || z >= world->counts[2]) {
        return IRIS_ERR_RANGE;
    }
    const int32_t words = (int32_t)IRIS_VOXEL_ROW_WORDS(world->counts[0]);
    for (int32_t i = 0; i < words; i++) {
        const uint32_t here = word_at(world, i, y, z);
        const uint32_t left = here << 1 | word_at(world, i - 1, y, z) >> 31;
        const uint32_t right = here >> 1 | word_at(world, i + 1, y, z) << 31;
        surface[i] = here & ~(left & right & word_at(world, i, y - 1, z) & word_at(world, i, y + 1, z) &
                              word_at(world, i, y, z - 1) & word_at(world, i, y, z + 1));
    }
    return IRIS_OK;
}

iris_status iris_voxel_surface(iris_voxel *voxels, int32_t room, int32_t *count,
                               const iris_voxel_world *world)
{
    uint32_t surface[IRIS_VOXEL_ROW_WORDS(IRIS_VOXEL_SIDE_MAX)] = {0};
    iris_status status = count && room >= 0 && (voxels || room == 0) ? iris_voxel_check(world) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    int32_t found = 0;
    for (int32_t z = 0; z < world->counts[2]; z++) {
        for (int32_t y = 0; y < world->counts[1]; y++) {
            (void)iris_voxel_surface_row(surface, world, y, z);
            for (int32_t x = 0; x < world->counts[0]; x++) {
                if ((surface[x / 32] >> (x % 32) & 1u) != 0) {
                    if (found < room) {
                        voxels[found] = (iris_voxel){x, y, z};
                    }
                    found++;
                }
            }
        }
    }
    *count = found;
    return found > room && room > 0 ? IRIS_ERR_FULL : IRIS_OK;
}

void iris_voxel_surface_rows(int32_t *rows, const iris_voxel_world *world)
{
    uint32_t surface[IRIS_VOXEL_ROW_WORDS(IRIS_VOXEL_SIDE_MAX)] = {0};
    int32_t count = 0;
    for (int32_t i = 0; i < world->counts[1] * world->counts[2]; i++) {
        (void)iris_voxel_surface_row(surface, world, i % world->counts[1], i / world->counts[1]);
        rows[i] = count;
        count += iris_voxel_row_rank(surface, world->counts[0]);
    }
}
