/* Dilation and erosion by the nearest pixels: a square or cross of 3x3 with its center. Nothing is kept from row to row. */
#ifndef IRIS_XT_MORPH_NEAR_H
#define IRIS_XT_MORPH_NEAR_H

#include "iris/xt/morph.h"

typedef struct {
    int32_t w, channels;
    int mask, erodes, cross;
    uint32_t
        beyond; /* of a mask: pixels to the left and right of a row, or what changes nothing where those count anyway */
} iris_morph_near;

/* Is the element one of these? */
int iris_morph_is_near(const iris_morph_element *element);

iris_morph_near iris_morph_near_of(const iris_image *src, const iris_morph_element *element, int erodes,
                                   iris_border border);

/* n bytes of a result's row, from pixel 0 on, of the three rows around: of samples readable from a pixel before to a pixel
 * behind; of a mask whole words, of which nothing past w is looked at. to is none of them. */
void iris_morph_near_row(uint8_t *to, const uint8_t *const rows[3], const iris_morph_near *near, int32_t n);

/* A whole picture, where dst is not src. level: room for a row. O(pixels). */
void iris_morph_near_picture(const iris_image *dst, const iris_image *src, const iris_morph_near *near,
                             iris_border border, uint8_t *level);

#endif
