/* Following a border along the sides of pixels. */
#ifndef IRIS_XT_CONTOUR_STEPS_H
#define IRIS_XT_CONTOUR_STEPS_H

#include "iris/image.h"

/* The side of a pixel that leads from the corner (x, y), which is the upper left one of pixel (x, y), to the next
 * corner, with a selected pixel at the right hand and none at the left. */
typedef struct {
    int32_t x, y;
    int32_t way; /* 0 up, 1 right, 2 down, 3 left */
} iris_contour_side;

/* Is the pixel selected? Beyond the mask none is. */
static inline int iris_contour_selected(const iris_image *mask, int32_t x, int32_t y)
{
    if ((uint32_t)x >= (uint32_t)mask->w || (uint32_t)y >= (uint32_t)mask->h) {
        return 0;
    }
    return (int)(((const uint32_t *)iris_image_row(mask, y))[x >> 5] >> (x & 31) & 1);
}

/* The left side of pixel (x, y), if there is a border: 1, or 0 when there is none. */
static inline int iris_contour_start(iris_contour_side *side, const iris_image *mask, int32_t x, int32_t y)
{
    int here = iris_contour_selected(mask, x, y), left = iris_contour_selected(mask, x - 1, y);
    *side = here ? (iris_contour_side){x, y + 1, 0} : (iris_contour_side){x, y, 2};
    return here != left;
}

/* The selected pixel at the right hand of a side. */
static inline int32_t iris_contour_x(const iris_contour_side *side)
{
    return side->x - (side->way >> 1);
}

static inline int32_t iris_contour_y(const iris_contour_side *side)
{
    return side->y - (side->way == 0 || side->way == 3);
}

/* Goes to the next side. Returns the turn: -1 left (to a pixel diagonally ahead), 0 straight on, 1 right (around the
 * same pixel). */
static inline int iris_contour_step(iris_contour_side *side, const iris_image *mask)
{
    static const int8_t step_x[4] = {0, 1, 0, -1}, step_y[4] = {-1, 0, 1, 0};
    int32_t way = side->way;
    side->x += step_x[way];
    side->y += step_y[way];
    iris_contour_side ahead = {side->x, side->y, way}, across = {side->x, side->y, (way + 3) & 3};
    int turn = 1;
    if (iris_contour_selected(mask, iris_contour_x(&across), iris_contour_y(&across))) {
        turn = -1;
    } else if (iris_contour_selected(mask, iris_contour_x(&ahead), iris_contour_y(&ahead))) {
        turn = 0;
    }
    side->way = (way + turn) & 3;
    return turn;
}

static inline int iris_contour_same(const iris_contour_side *a, const iris_contour_side *b)
{
    return a->x == b->x && a->y == b->y && a->way == b->way;
}

#endif
