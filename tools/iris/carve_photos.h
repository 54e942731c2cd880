/* Photographs for carving, and what they do. */
#ifndef IRIS_TOOL_CARVE_PHOTOS_H
#define IRIS_TOOL_CARVE_PHOTOS_H

#include "carve_views.h"
#include "iris/3d/carve_photo.h"
#include "picture.h"

/* Zeroed: none. */
typedef struct {
    iris_carve_photo *photos;
    picture_buffer *pictures, *masks;
    int count;
    int32_t removed, rounds;  /* voxels that the photos took away, in how many rounds of sweeps */
    iris_carve_color *colors; /* of the voxels at the surface; null: none */
    int32_t colored;
} carve_photos;

/* A silhouette: what is brighter than 127. Complains; returns 1, or 0. */
int carve_silhouette_read(picture_buffer *mask, const char *path);

/* Reads the photographs of the views, and their silhouettes. Complains; returns 1, or 0. */
int carve_photos_read(carve_photos *photos, const carve_views *views);

/* Carves until nothing more goes, and colors what is left. Complains; returns 1, or 0. */
int carve_photos_carve(carve_photos *photos, const iris_voxel_world *world, int32_t levels);

void carve_photos_free(carve_photos *photos);

#endif
