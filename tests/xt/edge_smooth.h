/* For the tests of edges on a smoothed picture. */
#ifndef IRIS_TEST_EDGE_SMOOTH_H
#define IRIS_TEST_EDGE_SMOOTH_H

#include "edge_picture.h"
#include "iris/xt/blur.h"

static uint8_t smooth_bytes[SIDE_MAX * SIDE_MAX];

/* The picture as the gradients see it. */
static iris_image smooth_of(const iris_image *src, iris_q16 sigma_q16, iris_border border)
{
    iris_image smooth;
    assert_int_equal(iris_image_wrap(&smooth, smooth_bytes, sizeof smooth_bytes, (iris_size){src->w, src->h},
                                     0, IRIS_GRAY8),
                     IRIS_OK);
    for (int32_t y = 0; y < src->h; y++) {
        memcpy(iris_image_row(&smooth, y), iris_image_row(src, y), (size_t)src->w);
    }
    if (sigma_q16 > 0) {
        iris_scratch scratch = arena(IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(src->w, 1, sigma_q16));
        assert_int_equal(iris_blur_gaussian(&smooth, &smooth, sigma_q16, border, &scratch), IRIS_OK);
    }
    return smooth;
}

#endif
