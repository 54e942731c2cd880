/* How the surface goes through a corner of the lattice. */
#ifndef IRIS_3D_MESH_CORNER_H
#define IRIS_3D_MESH_CORNER_H

#include "iris/3d/voxel.h"

/* A corner has eight voxels around it, numbered dx + 2 dy + 4 dz, and twelve faces between them: 4 axis + bu + 2 bv, of the
 * axis across it, where bu and bv say on which side it is along the next axis and the one after. */
typedef struct {
    unsigned solid;    /* bits of the voxels that are there */
    uint8_t sheet[12]; /* of each face, from 0; 255: it is no surface */
    int sheets;        /* connected parts of the surface: a vertex each */
    unsigned
        split; /* bits of the axes along whose edge, on the upper side, two voxels meet only: two vertices each */
} iris_mesh_corner;

/* at: 0 to the count of voxels along each axis. */
void iris_mesh_corner_look(iris_mesh_corner *corner, const iris_voxel_world *world, iris_voxel at);

int iris_mesh_corner_vertices(const iris_mesh_corner *corner);

/* Which of the corner's vertices is in the middle of its split edge along the axis, of the voxel. */
int iris_mesh_corner_middle(const iris_mesh_corner *corner, int axis, unsigned voxel);

/* Number of the face across the axis whose lower voxel is `low`. */
static inline int iris_mesh_face(int axis, unsigned low)
{
    return (int)(4u * (unsigned)axis + (low >> ((axis + 1) % 3) & 1u) + 2u * (low >> ((axis + 2) % 3) & 1u));
}

/* The lower voxel of the face. */
static inline unsigned iris_mesh_face_low(int face)
{
    const int axis = face / 4;
    return (unsigned)(face & 1) << ((axis + 1) % 3) | (unsigned)(face >> 1 & 1) << ((axis + 2) % 3);
}

#endif
