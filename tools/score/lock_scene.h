/* Rendered sequences: a colored ball before a textured room, and what may happen to it. */
#ifndef SCORE_LOCK_SCENE_H
#define SCORE_LOCK_SCENE_H

#include "iris/image.h"

#define SCENE_W      240
#define SCENE_H      180
#define SCENE_FRAMES 40

typedef enum {
    SCENE_PLAIN,      /* the ball moves and bounces */
    SCENE_LIGHT,      /* and the light goes down to half and up again, and gets warmer */
    SCENE_HIDDEN,     /* and is hidden for 5 frames */
    SCENE_DISTRACTOR, /* and another ball of a similar color crosses its way */
    SCENE_LEAVES,     /* and leaves the picture for good */
    SCENE_JUMPS,      /* and is somewhere else in each frame, up to a third of the picture away */
    SCENE_BLURRED,    /* and is so quick that it is smeared */
    SCENE_SHADED,     /* and half of it is in the dark */
    SCENE_KINDS
} scene_kind;

extern const char *const scene_names[SCENE_KINDS];

/* Where the ball is in a frame. */
typedef struct {
    double x, y, r; /* pixels */
    double visible; /* share of it, 0 to 1 */
} scene_truth;

/* Frame 0 to SCENE_FRAMES - 1 of a sequence, always the same for the same seed; image: IRIS_RGB888, SCENE_W x SCENE_H.
 * */
scene_truth scene_frame(const iris_image *image, scene_kind kind, unsigned seed, int frame);

#endif
