/* From costs to disparities: the least cost of each place, and whether it can be believed. */
#ifndef IRIS_3D_STEREO_PICK_H
#define IRIS_3D_STEREO_PICK_H

#include "iris/3d/stereo.h"

typedef struct {
    iris_stereo_config config;
    int32_t w;
    uint16_t *right_cost; /* least one of each place of the right picture, from right to left */
    uint16_t *right;      /* and its disparity */
} iris_stereo_pick;

/* Takes IRIS_STEREO_PICK_SCRATCH_BYTES. */
iris_status iris_stereo_pick_begin(iris_stereo_pick *p, const iris_stereo_config *config, int32_t w,
                                   iris_scratch *scratch);

/* A row of disparities: begin, pieces of at most IRIS_STEREO_PIECE pixels from left to right, each with
 * max_disparity + 1 costs, end. The costs of disparity d at x < d are not looked at. Costs are below 65535, and may be
 * changed. */
void iris_stereo_pick_begin_row(const iris_stereo_pick *p);
void iris_stereo_pick_piece(uint16_t *disparity, const iris_stereo_pick *p, uint16_t *costs, int32_t x,
                            int32_t count);
void iris_stereo_pick_end_row(uint16_t *disparity, const iris_stereo_pick *p);

/* The disparity of the least of n >= 1 costs, with its fraction. */
uint16_t iris_stereo_best(const uint16_t *costs, int32_t n);

#endif
