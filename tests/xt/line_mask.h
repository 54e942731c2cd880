/* For the tests of the Hough transform: masks with lines drawn in double precision. */
#ifndef IRIS_TEST_LINE_MASK_H
#define IRIS_TEST_LINE_MASK_H

#include <math.h>

#include "../picture.h"
#include "iris/xt/hough.h"

#define PI     3.14159265358979323846
#define SIDE   500
#define DEGREE (32768.0 / 180)

static uint32_t words[(SIDE / 32 + 3) * SIDE];
static IRIS_SCRATCH_BUFFER(memory, 1 << 22);

static inline iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static inline iris_image blank(int32_t w, int32_t h)
{
    iris_image mask;
    memset(words, 0, sizeof words);
    assert_int_equal(iris_image_wrap(&mask, words, sizeof words, (iris_size){w, h}, 0, IRIS_MASK1), IRIS_OK);
    return mask;
}

static inline void set(const iris_image *mask, int32_t x, int32_t y)
{
    if (x >= 0 && y >= 0 && x < mask->w && y < mask->h) {
        uint32_t *row = iris_image_row(mask, y);
        row[x / 32] |= (uint32_t)1 << x % 32;
    }
}

/* One pixel per row, or per column when the line is closer to level. */
static inline void draw(const iris_image *mask, double degrees, double rho)
{
    double c = cos(degrees * PI / 180), s = sin(degrees * PI / 180);
    double middle_x = (mask->w - 1) / 2.0, middle_y = (mask->h - 1) / 2.0;
    if (fabs(c) >= fabs(s)) {
        for (int32_t y = 0; y < mask->h; y++) {
            set(mask, (int32_t)floor(middle_x + (rho - (y - middle_y) * s) / c + 0.5), y);
        }
    } else {
        for (int32_t x = 0; x < mask->w; x++) {
            set(mask, x, (int32_t)floor(middle_y + (rho - (x - middle_x) * c) / s + 0.5));
        }
    }
}

static inline iris_hough_config config_of(int32_t theta_bins, int32_t rho_step, int32_t min_votes)
{
    iris_hough_config config;
    iris_hough_defaults(&config);
    config.theta_bins = theta_bins;
    config.rho_step = rho_step;
    config.min_votes = min_votes;
    return config;
}

#endif
