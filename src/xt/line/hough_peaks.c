/* What many points agree on. */
#include "hough_parts.h"

/* Where the votes of a bin are; -1 outside the bounds. Where theta covers every direction, the angle behind the last is
 * the first: with rho negated when it took half a turn. Where it is a whole turn and rho begins at 0, what is below 0 is
 * the opposite direction's. */
static int32_t bin_index(const iris_hough *hough, int32_t theta, int32_t rho)
{
    int32_t angles = hough->config.theta_bins, full = hough->config.full_circle;
    int wraps = hough->span == hough_turn(hough);
    if (wraps && full && rho < 0 && hough->config.rho_min == 0 && angles % 2 == 0) {
        theta += theta < angles / 2 ? angles / 2 : -angles / 2;
        rho = -1 - rho;
    }
    if (wraps && hough_outside(theta, 0, angles - 1)) {
        theta += theta < 0 ? angles : -angles;
        rho = full ? rho : -2 * hough->config.rho_min / hough->config.rho_step - 1 - rho;
    }
    if (hough_outside(theta, 0, angles - 1) || hough_outside(rho, 0, hough->rho_bins - 1)) {
        return -1;
    }
    return theta * hough->rho_bins + rho;
}

/* Does no bin within the separations have more votes, or as many and come first? */
static int is_peak(const iris_hough *hough, int32_t theta, int32_t rho)
{
    int32_t reach = hough->config.theta_separation, far = hough->config.rho_separation;
    int32_t here = theta * hough->rho_bins + rho;
    if (reach > (hough->config.theta_bins - 1) / 2 && hough->span == hough_turn(hough)) {
        reach = (hough->config.theta_bins - 1) / 2; /* each angle once */
    }
    for (int32_t k = 0; k <= 2 * reach; k++) {
        int32_t t = k % 2 ? k / 2 + 1 : -k / 2; /* nearest first: there most bins find their better */
        for (int32_t r = -far; r <= far; r++) {
            int32_t there = bin_index(hough, theta + t, rho + r);
            if (there >= 0 && (hough->votes[there] > hough->votes[here] ||
                               (there < here && hough->votes[there] == hough->votes[here]))) {
                return 0;
            }
        }
    }
    return 1;
}

/* The line of a peak. Between the bins it is at the center of gravity of what the peak and its eight
 * neighbors have beyond half of the peak's votes. */
static iris_hough_line line_at(const iris_hough *hough, int32_t theta, int32_t rho)
{
    int32_t votes = hough->votes[theta * hough->rho_bins + rho];
    int32_t sum = votes - votes / 2, theta_sum = 0, rho_sum = 0; /* of the peak itself: above 0 */
    for (int32_t t = -1; t <= 1; t++) {
        for (int32_t r = -1; r <= 1; r++) {
            int32_t there = bin_index(hough, theta + t, rho + r);
            int32_t weight = there < 0 ? 0 : hough->votes[there] - votes / 2;
            if (weight > 0 && (t != 0 || r != 0)) {
                sum += weight;
                theta_sum += t * weight;
                rho_sum += r * weight;
            }
        }
    }
    /* six weights, each of at most 2^15, times 2^9 stay below 2^27 */
    int32_t angle = hough_bin_angle(hough, theta) +
                    theta_sum * 256 / sum * hough->span / (256 * hough->config.theta_bins);
    int32_t rho_q9 =
        hough->config.rho_min * 512 + (rho * 512 + 256 + rho_sum * 512 / sum) * hough->config.rho_step;
    while (!hough->config.full_circle &&
           hough_outside(angle, -HOUGH_HALF_TURN / 2, HOUGH_HALF_TURN / 2 - 1)) {
        angle += angle < 0 ? HOUGH_HALF_TURN : -HOUGH_HALF_TURN;
        rho_q9 = -rho_q9;
    }
    return (iris_hough_line){iris_angle_wrap(angle), rho_q9 * 128, votes};
}

/* Puts a line behind those that are as good, if there is room. */
static void insert(iris_hough_line *lines, int32_t capacity, int32_t count, iris_hough_line line)
{
    int32_t at = count < capacity ? count : capacity;
    while (at > 0 && lines[at - 1].votes < line.votes) {
        if (at < capacity) {
            lines[at] = lines[at - 1];
        }
        at--;
    }
    if (at < capacity) {
        lines[at] = line;
    }
}

iris_status iris_hough_peaks(iris_hough_line *lines, int32_t capacity, int32_t *count,
                             const iris_hough *hough)
{
    if (!count || !hough || !hough->votes || capacity < 0 || (!lines && capacity > 0)) {
        return IRIS_ERR_ARG;
    }
    int32_t found = 0;
    const uint16_t *row = hough->votes;
    for (int32_t theta = 0; theta < hough->config.theta_bins; theta++, row += hough->rho_bins) {
        for (int32_t rho = 0; rho < hough->rho_bins; rho++) {
            if (row[rho] >= hough->config.min_votes && is_peak(hough, theta, rho)) {
                insert(lines, capacity, found, line_at(hough, theta, rho));
                found++;
            }
        }
    }
    *count = found;
    return found > capacity ? IRIS_ERR_FULL : IRIS_OK;
}

static int32_t side_of(int32_t side)
{
    return side < 1 ? 1 : side > IRIS_SIDE_MAX ? IRIS_SIDE_MAX : side;
}

/* The part of all theta bins that a point votes in. One more than its spread is wide, as both ends count. */
static int64_t share_q16(const iris_hough_config *by)
{
    int32_t turn = by->full_circle ? 2 * HOUGH_HALF_TURN : HOUGH_HALF_TURN;
    int32_t span = (int32_t)(((uint32_t)by->angle_max - (uint32_t)by->angle_min) & (uint32_t)(turn - 1));
    int32_t bins = by->theta_bins > 0 ? by->theta_bins : 1;
    int64_t wide = 2 * (int64_t)(by->spread > 0 ? by->spread : 0) + (span == 0 ? turn : span) / bins;
    return wide < turn ? wide * 65536 / turn : 65536;
}

int32_t iris_hough_votes_beyond_chance(const iris_hough_config *config, iris_size size, int32_t points,
                                       int with_direction)
{
    enum { LEAST = 25, FACTOR = 12 };
    iris_hough_config by;
    iris_hough_defaults(&by);
    by = config ? *config : by;
    int64_t w = side_of(size.w), h = side_of(size.h);
    int64_t diagonal_q8 = iris_sqrt_u64((uint64_t)(w * w + h * h) << 16);
    int64_t step = hough_outside(by.rho_step, 1, IRIS_HOUGH_RHO_STEP_MAX) ? 1 : by.rho_step;
    int64_t votes_q16 = (points > 0 ? points : 0) * step * (with_direction ? share_q16(&by) : 65536);
    int64_t mean_q16 = votes_q16 * 256 / (w * h * 65536 / diagonal_q8);
    int64_t votes = (mean_q16 * 9 / 8 >> 16) + (iris_sqrt_u64((uint64_t)mean_q16 * (FACTOR * FACTOR)) >> 8);
    return (int32_t)(votes < LEAST ? LEAST : votes > HOUGH_VOTES_MAX ? HOUGH_VOTES_MAX : votes);
}
