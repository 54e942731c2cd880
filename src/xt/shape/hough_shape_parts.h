/* What the parts of the generalized Hough transform share: the table's bytes, the outline turned, edge points by their
 * places, and hypotheses that are fitted to them. Positions have 4 fraction bits.
 */
#ifndef IRIS_XT_HOUGH_SHAPE_PARTS_H
#define IRIS_XT_HOUGH_SHAPE_PARTS_H

#include "iris/xt/hough_shape.h"

#define TABLE_HEAD        150
#define TABLE_STARTS      20
#define TABLE_CRC         16
#define TABLE_ENTRY_BYTES 6

#define INDEX_SHIFT 3  /* edge points lie in cells of 8 pixels */
#define TOLERANCE   32 /* 2 pixels: edge points farther away say nothing of an outline point */

/* An outline point seen from the reference point, turned and scaled; and its unit normal, 14 fraction bits, not
 * turned. */
typedef struct iris_hough_shape_entry {
    int32_t x_q4, y_q4;
    int16_t normal_x, normal_y;
} iris_hough_shape_entry;

typedef struct iris_hough_shape_edge {
    int16_t x, y;
    iris_angle angle;
    int16_t is_used; /* a shape that was found has it */
} iris_hough_shape_edge;

/* A hypothesis. */
typedef struct iris_hough_shape_place {
    iris_q16 x_q16, y_q16;
    iris_q16 scale_q16;
    int32_t fit; /* how well, 0 to 1000: near edge points count more */
    int32_t score;
    iris_angle angle;
    int8_t is_reversed, is_gone;
} iris_hough_shape_place;

static inline uint32_t table_u16(const uint8_t *table, int32_t at)
{
    return (uint32_t)table[at] | (uint32_t)table[at + 1] << 8;
}

static inline int32_t table_s16(const uint8_t *table, int32_t at)
{
    return (int16_t)table_u16(table, at);
}

static inline const uint8_t *table_entry(const uint8_t *table, int32_t index)
{
    return table + TABLE_HEAD + (size_t)index * TABLE_ENTRY_BYTES;
}

/* The first entry of a bin, 0 to IRIS_HOUGH_SHAPE_BINS. */
static inline int32_t table_start(const uint8_t *table, int32_t bin)
{
    return (int32_t)table_u16(table, TABLE_STARTS + 2 * bin);
}

/* IRIS_OK, or why these bytes are no table. */
iris_status iris_hough_shape_check(const uint8_t *table, size_t bytes);

/* A turn and a scale as a matrix, 14 fraction bits: x' = x c - y s, y' = x s + y c. */
typedef struct {
    int32_t c, s;
} iris_hough_shape_turn;

static inline iris_hough_shape_turn turn_of(iris_angle angle, iris_q16 scale_q16)
{
    return (iris_hough_shape_turn){(int32_t)iris_round_shift((int64_t)iris_cos_q30(angle) * scale_q16, 32),
                                   (int32_t)iris_round_shift((int64_t)iris_sin_q30(angle) * scale_q16, 32)};
}

/* An entry of the table, turned and scaled. */
static inline void turn_entry(int32_t *x_q4, int32_t *y_q4, const uint8_t *table, int32_t index,
                              iris_hough_shape_turn turn)
{
    const uint8_t *entry = table_entry(table, index);
    int64_t x = table_s16(entry, 0), y = table_s16(entry, 2);
    *x_q4 = (int32_t)iris_round_shift(x * turn.c - y * turn.s, 14);
    *y_q4 = (int32_t)iris_round_shift(x * turn.s + y * turn.c, 14);
}

/* Sorts the edge points into shape->edges. */
void iris_hough_shape_index(const iris_hough_shape *shape, const iris_edge_point *points, int32_t count);

/* Moves, turns, and scales the place so that its outline meets the edge points within `reach_q4`; by every step-th
 * entry. Sets its fit. */
void iris_hough_shape_fit(iris_hough_shape_place *place, const iris_hough_shape *shape, int32_t reach_q4,
                          int32_t step);

/* Sets the place's fit by every step-th entry: edge points nearer than reach_q4 confirm it. */
void iris_hough_shape_rate(iris_hough_shape_place *place, const iris_hough_shape *shape, int32_t reach_q4,
                           int32_t step);

/* Sets the place's score, as the header says it. */
void iris_hough_shape_score(iris_hough_shape_place *place, const iris_hough_shape *shape);

/* The edge points that confirm the place confirm no other from now on. */
void iris_hough_shape_use(const iris_hough_shape_place *place, const iris_hough_shape *shape);

#endif
