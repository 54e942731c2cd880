#include "carve_pieces.h"

#include <stdlib.h>

static void stretch(int32_t *first, int32_t *last, int32_t at)
{
    *first = at < *first ? at : *first;
    *last = at > *last ? at : *last;
}

static void take_in(carve_pieces *piece, iris_voxel v)
{
    stretch(&piece->first.x, &piece->last.x, v.x);
    stretch(&piece->first.y, &piece->last.y, v.y);
    stretch(&piece->first.z, &piece->last.z, v.z);
}

/* Takes the piece around `from` out of `rest`; `waiting` has room for all voxels. */
static carve_pieces take_piece(const iris_voxel_world *rest, iris_voxel *waiting, iris_voxel from)
{
    static const int8_t beside[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
    carve_pieces piece = {1, 0, from, from};
    int32_t count = 1;
    waiting[0] = from;
    (void)iris_voxel_set(rest, from, 0);
    while (count > 0) {
        const iris_voxel v = waiting[--count];
        take_in(&piece, v);
        piece.largest++;
        for (int i = 0; i < 6; i++) {
            const iris_voxel next = {v.x + beside[i][0], v.y + beside[i][1], v.z + beside[i][2]};
            if (iris_voxel_get(rest, next)) {
                (void)iris_voxel_set(rest, next, 0);
                waiting[count++] = next;
            }
        }
    }
    return piece;
}

int carve_pieces_find(carve_pieces *pieces, const iris_voxel_world *world)
{
    const size_t words = IRIS_VOXEL_BYTES(world->counts[0], world->counts[1], world->counts[2]) / 4;
    iris_voxel_world rest = *world;
    int32_t all = 0;
    (void)iris_voxel_count(&all, world);
    iris_voxel *waiting = malloc(((size_t)all + 1) * sizeof *waiting);
    rest.bits = malloc(4 * words);
    *pieces = (carve_pieces){.pieces = 0};
    if (waiting && rest.bits) {
        for (size_t i = 0; i < words; i++) {
            rest.bits[i] = world->bits[i];
        }
        const int64_t count = (int64_t)world->counts[0] * world->counts[1] * world->counts[2];
        for (int64_t i = 0; i < count; i++) {
            const int32_t row = (int32_t)(i / world->counts[0]);
            const iris_voxel v = {(int32_t)(i % world->counts[0]), row % world->counts[1],
                                  row / world->counts[1]};
            if (iris_voxel_get(&rest, v)) {
                const int32_t before = pieces->pieces;
                const carve_pieces piece = take_piece(&rest, waiting, v);
                *pieces = piece.largest > pieces->largest ? piece : *pieces;
                pieces->pieces = before + 1;
            }
        }
    }
    const int done = waiting && rest.bits;
    free(waiting);
    free(rest.bits);
    return done;
}
