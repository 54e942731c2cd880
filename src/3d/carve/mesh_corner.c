#include "mesh_corner.h"

#include "voxel_parts.h"

#define NONE 255

static void join(iris_mesh_corner *corner, int a, int b)
{
    const uint8_t from = corner->sheet[b], to = corner->sheet[a];
    for (int i = 0; i < 12; i++) {
        corner->sheet[i] = corner->sheet[i] == from ? to : corner->sheet[i];
    }
}

/* Joins the faces that meet in the edge from the corner along the axis, to its upper or lower side. Of two voxels that meet
 * in nothing else, each keeps its two faces together. */
static void join_at_edge(iris_mesh_corner *corner, int axis, unsigned side)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    int across_u[2], across_v[2], met[4], count = 0;
    for (unsigned bit = 0; bit < 2; bit++) {
        across_u[bit] = iris_mesh_face(u, side << axis | bit << v);
        across_v[bit] = iris_mesh_face(v, side << axis | bit << u);
    }
    for (int i = 0; i < 4; i++) {
        const int face = i < 2 ? across_u[i] : across_v[i - 2];
        if (corner->sheet[face] != NONE) {
            met[count++] = face;
        }
    }
    if (count == 2) {
        join(corner, met[0], met[1]);
    } else if (count == 4) {
        for (unsigned bits = 0; bits < 4; bits++) {
            const unsigned voxel = side << axis | (bits & 1u) << u | (bits >> 1) << v;
            if ((corner->solid >> voxel & 1u) != 0) {
                join(corner, across_u[bits >> 1], across_v[bits & 1u]);
            }
        }
        corner->split |= side << axis;
    }
}

void iris_mesh_corner_look(iris_mesh_corner *corner, const iris_voxel_world *world, iris_voxel at)
{
    uint8_t name[12];
    *corner = (iris_mesh_corner){.solid = 0};
    for (int i = 0; i < 8; i++) {
        const iris_voxel voxel = {at.x - 1 + (i & 1), at.y - 1 + (i >> 1 & 1), at.z - 1 + (i >> 2)};
        corner->solid |= (unsigned)iris_voxel_get(world, voxel) << i;
    }
    if (corner->solid == 0 || corner->solid == 255) {
        return;
    }
    for (int face = 0; face < 12; face++) {
        const unsigned low = iris_mesh_face_low(face), high = low | 1u << (face / 4);
        const int differ = (corner->solid >> low & 1u) != (corner->solid >> high & 1u);
        corner->sheet[face] = differ ? (uint8_t)face : NONE;
        name[face] = NONE;
    }
    for (int i = 0; i < 6; i++) {
        join_at_edge(corner, i / 2, (unsigned)i % 2);
    }
    for (int face = 0; face < 12; face++) {
        const uint8_t sheet = corner->sheet[face];
        if (sheet != NONE && name[sheet] == NONE) {
            name[sheet] = (uint8_t)corner->sheets++;
        }
        corner->sheet[face] = sheet == NONE ? NONE : name[sheet];
    }
}

int iris_mesh_corner_vertices(const iris_mesh_corner *corner)
{
    const unsigned split = corner->split;
    return corner->sheets + (int)(2 * ((split & 1u) + (split >> 1 & 1u) + (split >> 2 & 1u)));
}

int iris_mesh_corner_middle(const iris_mesh_corner *corner, int axis, unsigned voxel)
{
    int before = corner->sheets;
    for (int i = 0; i < axis; i++) {
        before += (int)(2 * (corner->split >> i & 1u));
    }
    /* The other one is across the edge: the higher one has the bit of the later axis. */
    const int later = axis == 2 ? 1 : 2;
    return before + (int)(voxel >> later & 1u);
}
