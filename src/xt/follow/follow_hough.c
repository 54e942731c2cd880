/* The follower's other estimator. */
#include "follow_parts.h"

/* Pixels per bin of rho: the largest power of two that does not exceed what an angle bin moves a line's ends by. */
static int32_t rho_step(iris_size size)
{
    int32_t longer = size.w > size.h ? size.w : size.h;
    int32_t step = 1;
    while (step * 2 <= longer / 82 && step < IRIS_HOUGH_RHO_STEP_MAX) {
        step *= 2;
    }
    return step;
}

/* rho of the line through the middle of gravity of *line, pixels. */
static int32_t rho_of(const iris_line *line, iris_size size)
{
    int32_t x_q1 = (line->x_q16 >> 15) - (size.w - 1), y_q1 = (line->y_q16 >> 15) - (size.h - 1);
    return (x_q1 * -(line->dy >> 16) + y_q1 * (line->dx >> 16)) >> 15;
}

static iris_angle within_quarter(int32_t angle)
{
    return (iris_angle)(angle > 16384 ? 16384 : angle < -16384 ? -16384 : angle);
}

static iris_status fit_by_hough(iris_line *line, const iris_follow *follow, const int16_t *twice_x,
                                int32_t y0, int32_t y1)
{
    enum { HALF_SPAN = 4096, STEEPEST = 14563 }; /* 22.5 and 80 degrees */
    iris_line guess;
    iris_hough hough;
    iris_scratch scratch;
    iris_hough_config config;
    iris_hough_line peak = {0, 0, 0};
    int32_t found = 0;
    iris_status status = iris_regress_rows(&guess, twice_x, y0, y1, 0);
    if (status != IRIS_OK) {
        return status;
    }
    iris_hough_defaults(&config);
    config.angle_min = within_quarter(guess.angle - HALF_SPAN);
    config.angle_max = within_quarter(guess.angle + HALF_SPAN);
    config.theta_bins = IRIS_FOLLOW_HOUGH_BINS;
    config.rho_step = rho_step(follow->size);
    config.rho_min = rho_of(&guess, follow->size) - IRIS_FOLLOW_HOUGH_BINS / 2 * config.rho_step;
    config.rho_max = config.rho_min + IRIS_FOLLOW_HOUGH_BINS * config.rho_step;
    config.min_votes = 2;
    if (iris_scratch_init(&scratch, follow->votes, IRIS_FOLLOW_HOUGH_BYTES) == IRIS_OK &&
        iris_hough_begin(&hough, follow->size, &config, &scratch) == IRIS_OK) {
        for (int32_t y = y0; y <= y1; y++) {
            if (twice_x[y] != IRIS_REGRESS_NONE) {
                (void)iris_hough_vote(&hough, twice_x[y], 2 * y);
            }
        }
        (void)iris_hough_peaks(&peak, 1, &found, &hough);
    }
    *line = guess;
    if (found > 0 && peak.angle >= -STEEPEST && peak.angle <= STEEPEST) {
        line->angle = peak.angle;
        line->dx = iris_sin_q30(peak.angle);
        line->dy = -iris_cos_q30(peak.angle);
        /* the column where the line passes the row of the guess's center */
        int64_t aside = (int64_t)peak.rho_q16 * 16384 -
                        (int64_t)(guess.y_q16 - (follow->size.h - 1) * 32768) * (line->dx >> 16);
        line->x_q16 = (follow->size.w - 1) * 32768 + (iris_q16)(aside / -(line->dy >> 16));
    }
    return IRIS_OK;
}

iris_status iris_follow_use_hough(iris_follow *follow, iris_scratch *scratch)
{
    if (!follow || !follow->fit || !scratch) {
        return IRIS_ERR_ARG;
    }
    uint8_t *votes = iris_scratch_take(scratch, IRIS_FOLLOW_HOUGH_BYTES);
    if (!votes) {
        return IRIS_ERR_SCRATCH;
    }
    follow->votes = votes;
    follow->fit = fit_by_hough;
    return IRIS_OK;
}
