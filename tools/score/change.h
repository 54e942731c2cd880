/* What can happen to a frame: other light, other noise, another size, another view. */
#ifndef SCORE_CHANGE_H
#define SCORE_CHANGE_H

#include "iris/image.h"

/* Zero means: nothing of this kind. Done in this order; results are rounded and limited to 0..255. */
typedef struct {
    const char *name;
    int required;      /* 1: the issue names it; 0: for information */
    int mirrored;      /* 1: left and right change places */
    int turned;        /* 1: by 180 degrees */
    int smaller;       /* 2: half the size, by means */
    int larger;        /* 2: twice the size, bilinear */
    int blur;          /* means of (2 blur + 1) x (2 blur + 1) pixels, twice */
    double gain, lift; /* value * gain + lift */
    double light[2];   /* gain at the left and right side, linear in between */
    double shadow[3];  /* gain; left of the column (share of the width) at the top, and at the bottom */
    double shade[3];   /* gain; from row, to row (shares of the height) */
    double noise;      /* sigma, Gaussian */
    double specks;     /* share of pixels that become 0 or 255 */
} change;

/* All that are tried; the first is no change. */
extern const change changes[];
extern const int change_count;

/* The changed frame, IRIS_GRAY8 or IRIS_RGB888; given back with free(image.data). seed: of noise and specks.
 * */
iris_image change_frame(const change *how, const iris_image *frame, uint32_t seed);

/* Where a point of a frame of the given size is in the changed frame. */
void change_point(const change *how, iris_size size, double *x, double *y);

/* Pixels of the changed frame per pixel of the frame. */
double change_scale(const change *how);

/* 1: every seed gives another frame. */
int change_is_random(const change *how);

#endif
