/* What the files of the Hough transform for circles share. */
#ifndef IRIS_XT_HOUGH_CIRCLE_PARTS_H
#define IRIS_XT_HOUGH_CIRCLE_PARTS_H

#include "iris/xt/hough_circle.h"

#define DIRECTIONS 256

/* A peak of a slice; later what the test has made of it. Centers of pixels at whole numbers. */
typedef struct {
    int32_t x_q8, y_q8, r_q8; /* pixels */
    int32_t votes;
} hypothesis;

typedef struct {
    const iris_edge_point *points;
    int32_t count;
    iris_size size;
    iris_circle_config config;
    /* in the caller's working memory: */
    int16_t *sines;        /* cosine and sine of each direction, 14 fraction bits */
    uint16_t *votes;       /* the slice, rows of cells; later, in the same place, */
    iris_edge_point *near; /* the points near a peak */
    int32_t near_count;
    int32_t *row_first; /* the first point of each row, and behind the last */
    uint32_t *taken;    /* a bit per point: supports a circle */
    hypothesis *peaks;
    int32_t peak_count;
} circle_search;

/* The side of a cell for this radius: its area grows as the circumference, so that chance brings as large a share of
 * the votes that a circle needs for every radius. */
static inline int32_t cell_of(const iris_circle_config *config, int32_t radius)
{
    int32_t cell = (int32_t)iris_sqrt_u32((uint32_t)radius / 4);
    return cell < config->cell ? config->cell : cell;
}

/* Fits a circle to the points around a peak. 1 when it is one. */
int iris_circle_test(hypothesis *circle, circle_search *s);

/* The circle once more, by those points alone that support no other. 1 when it still is one: then they support it. */
int iris_circle_take(hypothesis *circle, circle_search *s);

#endif
