/* Carving by silhouettes: blocks of voxels at once where a view shows all of a block alike. */
#include "iris/3d/carve.h"

#include "../../foundation/views.h"
#include "iris/integral.h"
#include "voxel_parts.h"

#define SIDE 8 /* of a block: a byte of a row's words */

typedef struct {
    const iris_voxel_world *world;
    const iris_image *silhouette;
    iris_image integral;
    iris_voxel_view view;
} carving;

typedef enum { KEPT, GOES, MIXED } verdict;

/* The pixel nearest to numerator / depth, for depth > 0: halves go up. */
static int64_t pixel_of(int64_t numerator, int64_t depth)
{
    const int64_t doubled = 2 * numerator + depth, by = 2 * depth;
    const int64_t quotient = doubled / by;
    return quotient - (doubled % by < 0);
}

static iris_voxel center_of(int32_t x, int32_t y, int32_t z)
{
    return (iris_voxel){2 * x + 1, 2 * y + 1, 2 * z + 1};
}

/* Where the view shows the middles of a block, from `first` to `last`. Each of them is a weighted mean of the corners, in
 * whole numbers without an error, and so within their bounds. */
static verdict judge_block(const carving *c, iris_voxel first, iris_voxel last)
{
    int64_t left = INT64_MAX, right = INT64_MIN, top = INT64_MAX, bottom = INT64_MIN;
    int behind = 0;
    for (int corner = 0; corner < 8; corner++) {
        const iris_voxel at = center_of(corner & 1 ? last.x : first.x, corner & 2 ? last.y : first.y,
                                        corner & 4 ? last.z : first.z);
        const int64_t depth = iris_voxel_homogeneous(&c->view, 2, at);
        if (depth <= 0) {
            behind++;
            continue;
        }
        const int64_t x = pixel_of(iris_voxel_homogeneous(&c->view, 0, at), depth);
        const int64_t y = pixel_of(iris_voxel_homogeneous(&c->view, 1, at), depth);
        left = x < left ? x : left;
        right = x > right ? x : right;
        top = y < top ? y : top;
        bottom = y > bottom ? y : bottom;
    }
    const int32_t w = c->silhouette->w, h = c->silhouette->h;
    if (behind > 0) {
        return behind == 8 ? KEPT : MIXED;
    }
    if (right < 0 || left >= w || bottom < 0 || top >= h) {
        return KEPT;
    }
    if (left < 0 || right >= w || top < 0 || bottom >= h) {
        return MIXED;
    }
    const uint32_t *above = iris_image_row(&c->integral, (int32_t)top);
    const uint32_t *below = iris_image_row(&c->integral, (int32_t)bottom + 1);
    const uint32_t selected = below[right + 1] - below[left] - above[right + 1] + above[left];
    const uint32_t pixels = (uint32_t)((right - left + 1) * (bottom - top + 1));
    return selected == 0 ? GOES : selected == pixels ? KEPT : MIXED;
}

/* Is the middle shown outside of the object? */
static int voxel_goes(const carving *c, iris_voxel lattice)
{
    const int64_t depth = iris_voxel_homogeneous(&c->view, 2, lattice);
    if (depth <= 0) {
        return 0;
    }
    const int64_t x = pixel_of(iris_voxel_homogeneous(&c->view, 0, lattice), depth);
    const int64_t y = pixel_of(iris_voxel_homogeneous(&c->view, 1, lattice), depth);
    if (x < 0 || x >= c->silhouette->w || y < 0 || y >= c->silhouette->h) {
        return 0;
    }
    const uint32_t *row = iris_image_row(c->silhouette, (int32_t)y);
    return (row[x / 32] >> (x % 32) & 1u) == 0;
}

/* Those of the voxels in `word` (bits of the block at x) that stay. */
static uint32_t carve_voxels(const carving *c, uint32_t word, iris_voxel first, iris_voxel last)
{
    for (int32_t x = first.x; x <= last.x; x++) {
        const uint32_t bit = (uint32_t)1 << (x % 32);
        if ((word & bit) != 0 && voxel_goes(c, center_of(x, first.y, first.z))) {
            word &= ~bit;
        }
    }
    return word;
}

static void carve_block(const carving *c, iris_voxel first, iris_voxel last)
{
    const uint32_t block = (uint32_t)0xFF << (first.x % 32);
    uint32_t any = 0;
    for (int32_t z = first.z; z <= last.z; z++) {
        for (int32_t y = first.y; y <= last.y; y++) {
            any |= iris_voxel_row(c->world, y, z)[first.x / 32] & block;
        }
    }
    const verdict is = any ? judge_block(c, first, last) : KEPT;
    if (is == KEPT) {
        return;
    }
    for (int32_t z = first.z; z <= last.z; z++) {
        for (int32_t y = first.y; y <= last.y; y++) {
            uint32_t *word = iris_voxel_row(c->world, y, z) + first.x / 32;
            if (is == GOES) {
                *word &= ~block;
            } else if ((*word & block) != 0) {
                *word = carve_voxels(c, *word, (iris_voxel){first.x, y, z}, last);
            }
        }
    }
}

static int32_t last_of(int32_t first, int32_t count)
{
    return first + SIDE < count ? first + SIDE - 1 : count - 1;
}

static void carve_world(const carving *c)
{
    const int32_t *counts = c->world->counts;
    for (int32_t z = 0; z < counts[2]; z += SIDE) {
        for (int32_t y = 0; y < counts[1]; y += SIDE) {
            for (int32_t x = 0; x < counts[0]; x += SIDE) {
                carve_block(
                    c, (iris_voxel){x, y, z},
                    (iris_voxel){last_of(x, counts[0]), last_of(y, counts[1]), last_of(z, counts[2])});
            }
        }
    }
}

iris_status iris_carve_view(const iris_voxel_world *world, const iris_image *silhouette, const iris_q32 m[12],
                            iris_scratch *scratch)
{
    carving c = {.world = world, .silhouette = silhouette};
    iris_status status = scratch && silhouette && m ? iris_voxel_check(world) : IRIS_ERR_ARG;
    if (status == IRIS_OK && iris_image_check(silhouette) != IRIS_OK) {
        status = IRIS_ERR_ARG;
    }
    status = status == IRIS_OK ? iris_views_check_one(silhouette, IRIS_MASK1) : status;
    if (status != IRIS_OK) {
        return status;
    }
    const iris_size size = {silhouette->w + 1, silhouette->h + 1};
    if (size.w > IRIS_SIDE_MAX || size.h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    status = iris_voxel_view_init(&c.view, world, m);
    if (status != IRIS_OK) {
        return status;
    }
    const size_t mark = iris_scratch_mark(scratch);
    const size_t bytes = IRIS_CARVE_SCRATCH_BYTES(silhouette->w, silhouette->h);
    void *sums = iris_scratch_take(scratch, bytes);
    if (!sums) {
        return IRIS_ERR_SCRATCH;
    }
    status = iris_image_wrap(&c.integral, sums, bytes, size, 0, IRIS_GRAY_U32);
    status = status == IRIS_OK ? iris_integral(&c.integral, silhouette) : status;
    if (status == IRIS_OK) {
        carve_world(&c);
    }
    iris_scratch_release(scratch, mark);
    return status;
}
