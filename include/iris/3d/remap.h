/* IRIS-3D - pictures without the lens's bends, and turned: undistortion and rectification.
 *
 * A view is the picture that another camera at the same place would take: without a lens, with intrinsics of your
 * choice, and turned if need be, as for stereo pairs. A map says for every 8th pixel of every 8th row of the view
 * where it lies in the camera's picture (or in steps of 1, 2, 4, or 16); it takes 40 KB for 640x480. Between them
 * places are interpolated, by lines: with a lens of k1 = -0.3 and a focal length of 0.8 widths at most 0.06 pixels
 * off, at the corners. Twice the step is four times as far, and a quarter of the memory. Levels are bilinear, from
 * 256 steps between pixels. Rows can be had one by one.
 */
#ifndef IRIS_3D_REMAP_H
#define IRIS_3D_REMAP_H

#include "iris/3d/camera.h"
#include "iris/image.h"
#include "iris/xt/floor.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The longest side of a camera's picture. */
#define IRIS_REMAP_SOURCE_MAX 32000

/* The step from place to place is 2^step_bits pixels, 1 to 16. */
#define IRIS_REMAP_STEP_BITS_MAX 4

/* How many places a map of w x h pixels has. */
#define IRIS_REMAP_PLACES(w, h, step_bits)                                                                   \
    (((((size_t)(w)-1) >> (step_bits)) + 2) * ((((size_t)(h)-1) >> (step_bits)) + 2))

/* The picture that is wanted. */
typedef struct {
    iris_size size;             /* 1..IRIS_SIDE_MAX */
    iris_intrinsics intrinsics; /* of the camera that would take it */
    iris_mat3 turn;             /* from the real camera's frame to that camera's: Xview = turn Xc */
    int step_bits;              /* of the map: 0 to IRIS_REMAP_STEP_BITS_MAX */
    uint8_t fill;               /* the level, in every channel, of what the real camera did not see */
} iris_remap_view;

/* A map that is ready to be used for any number of pictures. The fields are its own. */
typedef struct {
    iris_size size, source;
    iris_place *places; /* INT32_MIN: the camera does not see it */
    int step_bits;
    uint8_t fill;
} iris_remap;

/* The view of the camera itself without its lens: its intrinsics, not turned, a place every 8 pixels, black outside. */
void iris_remap_view_defaults(iris_remap_view *view, const iris_intrinsics *intrinsics, iris_size size);

/* Makes the map.
 *   places  IRIS_REMAP_PLACES of them, the caller's; they must outlive the map
 *   camera  whose pictures are to be remapped; its pose does not matter
 *   source  their size
 * What lies beyond the place where the lens's polynomial turns back (camera.h) is not seen, to a step of the map.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: a side or step_bits out of range, or an alpha that is not above 0.
 * O(places): 40 products of 128 bits each. */
iris_status iris_remap_init(iris_remap *remap, iris_place *places, const iris_remap_view *view,
                            const iris_sensor *camera, iris_size source);

/* The whole view. dst: its size, and src's format; disjoint from src. src: IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888,
 * of the source's size. IRIS_ERR_ARG: null pointer or invalid image; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: another size;
 * IRIS_ERR_ALIAS. O(w h). */
iris_status iris_remap_draw(const iris_image *dst, const iris_image *src, const iris_remap *remap);

/* One row of it alone: `pixels` takes the view's w pixels of src's format, and is no part of src.
 * The same errors, and IRIS_ERR_RANGE: y outside of the view. O(w). */
iris_status iris_remap_row(void *pixels, const iris_remap *remap, const iris_image *src, int32_t y);

#ifdef __cplusplus
}
#endif

#endif
