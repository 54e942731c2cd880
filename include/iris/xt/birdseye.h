/* IRIS-XT - bird's-eye view: the floor as a map, seen from straight above.
 *
 * A window on the floor becomes a picture with so many millimeters to a pixel: far is up, right is right. Lines are as
 * wide, as straight, and as far apart as they are on the floor, and angles are true. A map is wrong for
 * whatever rises above the floor: it leans away from the camera.
 *
 * Where in the camera's picture a pixel comes from is computed exactly every 128 pixels of a row, or as often as is
 * needed to be within 1/32 of a pixel between them, where it is interpolated; levels are bilinear, from 256 steps
 * between pixels.
 */
#ifndef IRIS_XT_BIRDSEYE_H
#define IRIS_XT_BIRDSEYE_H

#include "iris/image.h"
#include "iris/status.h"
#include "iris/xt/floor.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_BIRDSEYE_SCALE_MIN 655      /* 1/100 of a millimeter */
#define IRIS_BIRDSEYE_SCALE_MAX 65536000 /* 1000 mm */

#define IRIS_BIRDSEYE_SOURCE_MAX 32000 /* longest side of a camera's picture */

/* The window. */
typedef struct {
    iris_size size;            /* of the map, 1..IRIS_SIDE_MAX */
    iris_place corner;         /* the place on the floor of the center of the map's top left pixel, mm */
    iris_q16 mm_per_pixel_q16; /* IRIS_BIRDSEYE_SCALE_MIN..IRIS_BIRDSEYE_SCALE_MAX */
    uint8_t fill;              /* the level, in every channel, of what the camera does not see */
} iris_birdseye_window;

/* A map that is ready to be drawn from any number of pictures. The fields are its own, but for `window`. */
typedef struct {
    iris_birdseye_window window;
    iris_size source; /* of the camera's pictures */
    int64_t row[9];   /* map to picture, as iris_floor.to_image, of no particular scale */
} iris_birdseye;

/* IRIS_ERR_ARG: null pointer, or a scale out of range; IRIS_ERR_RANGE: a side of the map out of range,
 * or a side of the floor's pictures above IRIS_BIRDSEYE_SOURCE_MAX. O(1). */
iris_status iris_birdseye_init(iris_birdseye *birdseye, const iris_floor *floor,
                               const iris_birdseye_window *window);

/* The whole map. dst: the window's size and src's format; disjoint from src. src: IRIS_GRAY8, IRIS_RGB888, or
 * IRIS_BGR888, of the size that the floor was made for.
 * IRIS_ERR_ARG: null pointer or invalid image; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: another size; IRIS_ERR_ALIAS.
 * O(w h) of the map: about 45 instructions per gray pixel on a Cortex-M4, 85 per color pixel. */
iris_status iris_birdseye_draw(const iris_image *dst, const iris_image *src, const iris_birdseye *birdseye);

/* One row of it alone: `pixels` takes window.size.w pixels of src's format, and is no part of src.
 * The same errors, and IRIS_ERR_RANGE: y outside of the map. O(w). */
iris_status iris_birdseye_row(void *pixels, const iris_birdseye *birdseye, const iris_image *src, int32_t y);

/* Where in the picture the pixels of row y come from, window.size.w places; INT32_MIN for both coordinates where the
 * camera sees nothing. What iris_birdseye_row draws from, but that it rounds to 1/256 of a pixel.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: y outside of the map. O(w). */
iris_status iris_birdseye_places(iris_place *places, const iris_birdseye *birdseye, int32_t y);

#ifdef __cplusplus
}
#endif

#endif
