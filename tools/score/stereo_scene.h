/* Pairs of pictures whose disparities are known, drawn in double precision: surfaces with a texture of all sizes, flat and
 * slanted, that hide each other; a second camera that is a little darker, and noise in both. */
#ifndef SCORE_STEREO_SCENE_H
#define SCORE_STEREO_SCENE_H

#include <stdint.h>

#include "iris/image.h"

/* What there is to see. */
typedef enum {
    STEREO_ROOM,  /* a floor, a back wall, two side walls: steep planes */
    STEREO_STEPS, /* boxes, one before the other */
    STEREO_THIN,  /* poles, 3 to 8 pixels wide */
    STEREO_WEAK,  /* large surfaces with little texture */
    STEREO_SCENES
} stereo_scene_kind;

typedef struct {
    iris_image left, right; /* IRIS_GRAY8 */
    double *truth;          /* of the left picture, in pixels, row by row */
    uint8_t *visible;       /* in both pictures */
} stereo_scene;

const char *stereo_scene_name(stereo_scene_kind kind);

/* 0: no memory; release it all the same. Disparities are below 64. */
int stereo_scene_draw(stereo_scene *scene, stereo_scene_kind kind, uint32_t seed);

void stereo_scene_free(stereo_scene *scene);

#endif
