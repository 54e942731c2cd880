/* The cells of the color space that signatures are made of. */
#ifndef IRIS_XT_SIGNATURE_CELLS_H
#define IRIS_XT_SIGNATURE_CELLS_H

#include "iris/xt/signature.h"

/* U and V have 21 steps, 10 is gray, and Y has 9 levels. A cell's number: (step of U * 21 + step of V) * 9 + level. */
#define IRIS_SIGNATURE_STEPS  21
#define IRIS_SIGNATURE_LEVELS 9

extern const uint8_t iris_signature_step[256]; /* of each U or V */

/* First and last U or V of a step, less 128. */
typedef struct {
    int16_t first, last;
} iris_signature_band;
extern const iris_signature_band iris_signature_bands[IRIS_SIGNATURE_STEPS];

/* y: Y less 16, 0 to 219. */
static inline int32_t iris_signature_cell(int32_t y, int32_t step_u, int32_t step_v)
{
    return (step_u * IRIS_SIGNATURE_STEPS + step_v) * IRIS_SIGNATURE_LEVELS + (y * 84 >> 11);
}

static inline int32_t iris_signature_cell_of_yuv(int32_t y, int32_t u, int32_t v)
{
    return iris_signature_cell(y < 16    ? 0
                               : y > 235 ? 219
                                         : y - 16,
                               iris_signature_step[u], iris_signature_step[v]);
}

/* Y less 16, and U and V less 128, of a color. */
typedef struct {
    int32_t y, u, v;
} iris_signature_yuv;

static inline iris_signature_yuv iris_signature_yuv_of(int32_t r, int32_t g, int32_t b)
{
    return (iris_signature_yuv){(66 * r + 129 * g + 25 * b + 128) >> 8,
                                (112 * b - 38 * r - 74 * g + 128) >> 8,
                                (112 * r - 94 * g - 18 * b + 128) >> 8};
}

static inline int32_t iris_signature_cell_of_rgb(int32_t r, int32_t g, int32_t b)
{
    iris_signature_yuv c = iris_signature_yuv_of(r, g, b);
    return iris_signature_cell(c.y, iris_signature_step[c.u + 128], iris_signature_step[c.v + 128]);
}

/* A color of a cell: `along` of y, u, and v is 0 to 4, the place between first and last in quarters.
 * What is no color is limited to one, and *is_color, unless null, 0. */
iris_color iris_signature_color_of(int32_t cell, iris_signature_yuv along, int *is_color);

/* Pixels whose cells are looked up at a time: whole words of a mask, and an even number. */
#define IRIS_SIGNATURE_PIECE 64

/* The cells of n pixels from x on of a row; n is at most IRIS_SIGNATURE_PIECE. x and n are even for YUYV and UYVY. */
void iris_signature_cells_row(uint16_t *cells, const void *row, iris_format format, int32_t x, int32_t n);

/* What is learned from. */
typedef struct {
    const iris_image *image;
    iris_rect rect;
    const iris_signature_lesson *near; /* an earlier lesson, or null */
    int is_all;                        /* 1: what is around the object is not asked */
} iris_signature_scene;

/* As iris_signature_teach, but not far from an earlier lesson (when there is one): hue within 20 degrees of its range,
 * lightness from half to one and a half times of it, no cells outside of the range; and not at all when less than half
 * of the object stands out, when it has turned gray, or from gray to colored, or when much more of what is around it
 * would have the signature than in the earlier lesson: IRIS_ERR_DATA then, and nothing has changed. */
iris_status iris_signature_learn(iris_signature_lesson *lesson, iris_signatures *signatures, int32_t which,
                                 const iris_signature_scene *scene, iris_scratch *scratch);

/* A signature, and one as it was: a bit for each cell. */
#define IRIS_SIGNATURE_KEPT_BYTES (IRIS_SIGNATURE_CELLS / 8 + 1)
void iris_signature_keep(uint8_t *kept, const iris_signatures *signatures, uint32_t bit);
void iris_signature_restore(iris_signatures *signatures, uint32_t bit, const uint8_t *kept);

typedef struct {
    const iris_image *image;
    int32_t most; /* pixels, up to 65534 */
} iris_signature_crowd;

/* Takes the cells from a signature that have more pixels of a picture than the object can have; *cleared: how many. 
 * Takes 2 bytes for each cell. */
iris_status iris_signature_thin(int32_t *cleared, iris_signatures *signatures, uint32_t bit,
                                const iris_signature_crowd *crowd, iris_scratch *scratch);

#endif
