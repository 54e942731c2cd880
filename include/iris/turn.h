/* IRIS - turning: mirror images, quarter turns, and transposition.
 *
 * For cameras that are mounted on their side or upside down, or look through a mirror.
 */
#ifndef IRIS_TURN_H
#define IRIS_TURN_H

#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What becomes of a picture
 *                 abc
 *                 def
 * in the order of the names below. Bit 2 of a turning transposes, then bit 0 exchanges left and right, and bit 1 top and
 * bottom.
 *                                         ad    da    cf    fc
 *     abc   cba   def   fed               be    eb    be    eb
 *     def   fed   abc   cba               cf    fc    ad    da   */
typedef enum {
    IRIS_TURN_NONE = 0,
    IRIS_FLIP_HORIZONTAL, /* left and right exchanged */
    IRIS_FLIP_VERTICAL,   /* top and bottom exchanged */
    IRIS_TURN_180,
    IRIS_TRANSPOSE, /* mirrored at the diagonal through the top left pixel: x and y exchanged */
    IRIS_TURN_90,   /* clockwise */
    IRIS_TURN_270,  /* clockwise: a quarter turn to the left */
    IRIS_TRANSVERSE /* mirrored at the other diagonal */
} iris_turning;

/* dst = src turned. From IRIS_TRANSPOSE on, dst has src's height as its width and src's width as its height, and the
 * two are disjoint; the others keep the size, and dst may be src or is disjoint from it.
 *
 * Any format whose pixels stand alone: gray, masks (bits past w are kept), colors. Two that share something:
 *   IRIS_YUYV, IRIS_UYVY   only IRIS_FLIP_VERTICAL (and IRIS_TURN_NONE): elsewhere pairs would fall apart
 *   IRIS_BAYER8_...        dst has the order that the filter has after turning: iris_turn_format
 * IRIS_ERR_ARG: null pointer or invalid view, or an unknown turning; IRIS_ERR_FORMAT: formats differ, or as above;
 * IRIS_ERR_RANGE: wrong size; IRIS_ERR_ALIAS. O(w h). */
iris_status iris_turn(const iris_image *dst, const iris_image *src, iris_turning turning);

/* The format of a Bayer picture of this format and size after turning; other formats stay. O(1). */
iris_format iris_turn_format(iris_format format, iris_size size, iris_turning turning);

#ifdef __cplusplus
}
#endif

#endif
