/* Runs: pixels beside each other whose places in another picture are as far from each other. Levels there are bilinear,
 * from 256 steps between pixels.
 */
#ifndef IRIS_XT_RUNS_H
#define IRIS_XT_RUNS_H

#include "iris/image.h"
#include "iris/status.h"
#include "iris/xt/floor.h"

typedef struct {
    int32_t n;       /* pixels */
    int exists;      /* 0: they have no place there */
    iris_q16 x, y;   /* the place of pixel 0; all places fit 32 bits */
    iris_q16 dx, dy; /* from each to the next */
} iris_run;

/* The place of the run's pixel i. */
iris_place iris_run_place(const iris_run *r, int32_t i);

/* Is the place within the picture's pixels, whose edges are half a pixel around their centers? */
int iris_run_sees(iris_place at, iris_size source);

/* Is the place so far inside that the pixels to the right and below exist, rounded or not? (In a picture that is as wide
 * as iris_row_along_u8 asks.) What is between two such places is as far inside. */
static inline int iris_run_is_inside(iris_place at, const iris_image *src)
{
    return src->w >= 4 && at.x_q16 >= 0 && at.y_q16 >= 0 && at.x_q16 <= (src->w - 1) * 65536 - 256 &&
           at.y_q16 <= (src->h - 1) * 65536 - 256;
}

/* The run's n pixels of 1 or 3 channels from src, which has as many; what it does not see becomes `fill`. */
void iris_run_draw(uint8_t *to, const iris_run *r, const iris_image *src, int channels, uint8_t fill);

/* A picture that is drawn row by row from another one, of gray or color levels. */
typedef struct {
    iris_size size, source; /* its own, and the other one's */
    const void *user;
    void (*row)(uint8_t *to, const void *user, const iris_image *src, int32_t y); /* draws row y */
} iris_run_picture;

/* The whole picture. IRIS_ERR_ARG: invalid image; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: of another size; IRIS_ERR_ALIAS. */
iris_status iris_run_picture_draw(const iris_image *dst, const iris_image *src,
                                  const iris_run_picture *picture);

/* A row of it alone. The same errors, and IRIS_ERR_RANGE: y outside of the picture. */
iris_status iris_run_picture_row(void *pixels, const iris_image *src, const iris_run_picture *picture,
                                 int32_t y);

#endif
