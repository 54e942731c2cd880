/* What photo-consistent carving and coloring share: views that look at the voxels of one layer after another. */
#ifndef IRIS_3D_PHOTO_PARTS_H
#define IRIS_3D_PHOTO_PARTS_H

#include "iris/3d/carve_photo.h"

/* A view made ready. 136 bytes. */
typedef struct {
    iris_voxel_view view; /* homogeneous places below 2^51 */
    int64_t eye[3];       /* the camera's place: lattice points (halves of a voxel) with 8 fraction bits */
    int32_t top, bottom;  /* rows of the picture that the layer has touched, bottom excluded */
    int32_t sides[2];     /* w, h */
} iris_photo_eye;

/* A voxel of the layer that is at the surface. 12 bytes. */
typedef struct {
    int16_t a, b;              /* its place in the layer */
    uint8_t exposed;           /* bits 2 k and 2 k + 1: no voxel below and above it along axis k */
    uint8_t views;             /* that have judged it */
    uint8_t least[3], most[3]; /* levels: the greatest of their least ones, and the least of their greatest */
} iris_photo_voxel;

typedef struct {
    const iris_voxel_world *world;
    const iris_carve_photo *photos;
    int32_t count;
    iris_photo_eye *eyes;
    uint32_t *explained; /* flags of pixels: of layers before this one */
    uint32_t *hidden;    /* and of this one */
    size_t row_words, view_words;
    iris_photo_voxel *voxels; /* of the layer, along a, then along b */
    int32_t *rows;            /* where each row of them begins; side + 1 */
    int axis;                 /* which the layer is across; a and b are the next ones */
    int32_t layer;
} iris_photo_work;

#define IRIS_PHOTO_OWN_MAX (1 << 24) /* pixels whose levels still fit a sum */

/* What a view sees of a voxel. */
typedef struct {
    int32_t own, all;          /* pixels that belong to it, and that would with nothing before it */
    uint8_t least[3], most[3]; /* of all pixels whose squares touch it, whatever they belong to */
    uint32_t sums[3];          /* of those that belong to it */
} iris_photo_pixels;

/* Takes the memory and makes the views ready; errors as in the header. */
iris_status iris_photo_begin(iris_photo_work *work, const iris_voxel_world *world,
                             const iris_carve_photos *photos, iris_scratch *scratch);

/* Lists the voxels of layer work->layer across work->axis. */
void iris_photo_list(iris_photo_work *work);

iris_voxel iris_photo_voxel_at(const iris_photo_work *work, const iris_photo_voxel *voxel);

/* Hands the layer's voxels to `look` from the eye outwards: what hides comes before what is hidden. */
void iris_photo_walk(iris_photo_work *work, int32_t view,
                     void (*look)(iris_photo_work *work, int32_t view, iris_photo_voxel *voxel, void *user),
                     void *user);

/* What the view sees of the voxel, which then hides its pixels. 1 when at least half of them belong to it, and one. */
int iris_photo_look(iris_photo_pixels *seen, iris_photo_work *work, int32_t view,
                    const iris_photo_voxel *voxel);

/* Forgets the flags of this layer. */
void iris_photo_drop(iris_photo_work *work);

/* Adds them to those of the layers before. */
void iris_photo_keep(iris_photo_work *work);

/* Forgets all flags. */
void iris_photo_clear(iris_photo_work *work);

/* Is the camera in the layer or where the layers before it are: is all between it and the layer known? */
int iris_photo_is_before(const iris_photo_work *work, int32_t view, int up);

#endif
