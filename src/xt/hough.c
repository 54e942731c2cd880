#include "iris/xt/hough.h"

#define HALF_TURN 32768 /* in units of iris_angle */
#define VOTES_MAX 65535

void iris_hough_defaults(iris_hough_config *config)
{
    if (config) {
        *config = (iris_hough_config){
            -HALF_TURN / 2, HALF_TURN / 2, 180, -IRIS_SIDE_MAX, IRIS_SIDE_MAX, 1, 50, 8, 12};
    }
}

static int outside(int32_t value, int32_t low, int32_t high)
{
    return value < low || value > high;
}

static int config_is_bad(const iris_hough_config *c)
{
    return outside(c->angle_min, -HALF_TURN / 2, HALF_TURN / 2) ||
           outside(c->angle_max, -HALF_TURN / 2, HALF_TURN / 2) ||
           outside(c->theta_bins, 1, IRIS_HOUGH_THETA_BINS_MAX) || c->rho_min >= c->rho_max ||
           outside(c->rho_step, 1, IRIS_HOUGH_RHO_STEP_MAX) || (c->rho_step & (c->rho_step - 1)) != 0 ||
           outside(c->min_votes, 1, VOTES_MAX) ||
           outside(c->theta_separation, 0, IRIS_HOUGH_SEPARATION_MAX) ||
           outside(c->rho_separation, 0, IRIS_HOUGH_SEPARATION_MAX);
}

static int size_is_bad(iris_size size)
{
    return outside(size.w, 1, IRIS_SIDE_MAX) || outside(size.h, 1, IRIS_SIDE_MAX);
}

/* Cuts the bounds to the image and derives the numbers of bins from them. */
static iris_status lay_out(iris_hough *hough)
{
    iris_hough_config *c = &hough->config;
    int32_t reach = (int32_t)IRIS_HOUGH_REACH(hough->size.w, hough->size.h);
    c->rho_min = c->rho_min < -reach ? -reach : c->rho_min;
    c->rho_max = c->rho_max > reach ? reach : c->rho_max;
    if (c->rho_min >= c->rho_max) {
        return IRIS_ERR_RANGE;
    }
    hough->rho_bins = (c->rho_max - c->rho_min + c->rho_step - 1) / c->rho_step;
    hough->shift = 15;
    while (c->rho_step >> (hough->shift - 15) > 1) {
        hough->shift++;
    }
    int32_t between = (c->angle_max - c->angle_min) & (HALF_TURN - 1);
    hough->span = between == 0 ? HALF_TURN : between;
    return hough->rho_bins > IRIS_SIDE_MAX ? IRIS_ERR_RANGE : IRIS_OK;
}

/* The angle of a theta bin: -90 up to below 270 degrees. */
static int32_t bin_angle(const iris_hough *hough, int32_t theta)
{
    int32_t bins = hough->config.theta_bins;
    return hough->config.angle_min + (theta * hough->span + bins / 2) / bins;
}

static void clear(const iris_hough *hough)
{
    for (int32_t theta = 0; theta < hough->config.theta_bins; theta++) {
        iris_angle angle = iris_angle_wrap(bin_angle(hough, theta));
        uint16_t *row = hough->votes + (size_t)theta * (size_t)hough->rho_bins;
        hough->sines[2 * theta] = (int16_t)iris_round_shift(iris_cos_q30(angle), 16);
        hough->sines[2 * theta + 1] = (int16_t)iris_round_shift(iris_sin_q30(angle), 16);
        for (int32_t rho = 0; rho < hough->rho_bins; rho++) {
            row[rho] = 0;
        }
    }
}

iris_status iris_hough_begin(iris_hough *hough, iris_size size, const iris_hough_config *config,
                             iris_scratch *scratch)
{
    if (!hough || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_hough made = {.size = size};
    iris_hough_defaults(&made.config);
    if (config) {
        made.config = *config;
    }
    if (config_is_bad(&made.config)) {
        return IRIS_ERR_ARG;
    }
    if (size_is_bad(size) || lay_out(&made) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    size_t start = iris_scratch_mark(scratch), angles = (size_t)made.config.theta_bins;
    made.sines = (int16_t *)iris_scratch_take(scratch, angles * 4);
    made.votes = (uint16_t *)iris_scratch_take(scratch, angles * (size_t)made.rho_bins * 2);
    if (!made.sines || !made.votes) {
        iris_scratch_release(scratch, start);
        return IRIS_ERR_SCRATCH;
    }
    clear(&made);
    *hough = made;
    return IRIS_OK;
}

/* The points (x[i], y) vote; coordinates are doubled and counted from the middle of the image: |x| and
 * |y| at most 32766, so rho with 15 fraction bits is below 2^30, and below 2^31 when counted from
 * rho_min. */
static void vote(const iris_hough *hough, const int16_t *x, int32_t count, int32_t y)
{
    uint16_t *row = hough->votes;
    uint32_t bins = (uint32_t)hough->rho_bins;
    for (int32_t theta = 0; theta < hough->config.theta_bins; theta++, row += bins) {
        int32_t cosine = hough->sines[2 * theta];
        int32_t first = y * hough->sines[2 * theta + 1] - hough->config.rho_min * 32768;
        for (int32_t i = 0; i < count; i++) {
            /* below rho_min this is a large number */
            uint32_t rho = (uint32_t)(first + x[i] * cosine) >> hough->shift;
            if (rho < bins && row[rho] < VOTES_MAX) {
                row[rho]++;
            }
        }
    }
}

iris_status iris_hough_vote(iris_hough *hough, int32_t twice_x, int32_t twice_y)
{
    if (!hough || !hough->votes) {
        return IRIS_ERR_ARG;
    }
    int32_t right = hough->size.w - 1, bottom = hough->size.h - 1;
    if (outside(twice_x, 0, 2 * right) || outside(twice_y, 0, 2 * bottom)) {
        return IRIS_ERR_RANGE;
    }
    int16_t x = (int16_t)(twice_x - right);
    vote(hough, &x, 1, twice_y - bottom);
    return IRIS_OK;
}

iris_status iris_hough_vote_row(iris_hough *hough, const uint32_t *mask_row, int32_t y)
{
    if (!hough || !hough->votes || !mask_row) {
        return IRIS_ERR_ARG;
    }
    int32_t w = hough->size.w, h = hough->size.h;
    if (outside(y, 0, h - 1)) {
        return IRIS_ERR_RANGE;
    }
    for (int32_t start = 0; start < w; start += 32) {
        uint32_t bits = mask_row[start / 32];
        if (w - start < 32) {
            bits &= ((uint32_t)1 << (w - start)) - 1;
        }
        int16_t x[32];
        int32_t count = 0;
        for (int32_t at = 2 * start - (w - 1); bits != 0; bits >>= 1, at += 2) {
            if (bits & 1) {
                x[count++] = (int16_t)at;
            }
        }
        if (count > 0) {
            vote(hough, x, count, 2 * y - (h - 1));
        }
    }
    return IRIS_OK;
}

/* Where the votes of a bin are; -1 outside the bounds. Where theta covers every direction, the angle
 * behind the last is the first, with rho negated. */
static int32_t bin_index(const iris_hough *hough, int32_t theta, int32_t rho)
{
    int32_t angles = hough->config.theta_bins;
    if (outside(theta, 0, angles - 1)) {
        if (hough->span != HALF_TURN) {
            return -1;
        }
        theta += theta < 0 ? angles : -angles;
        rho = -2 * hough->config.rho_min / hough->config.rho_step - 1 - rho;
    }
    if (outside(theta, 0, angles - 1) || outside(rho, 0, hough->rho_bins - 1)) {
        return -1;
    }
    return theta * hough->rho_bins + rho;
}

/* Does no bin within the separations have more votes, or as many and come first? */
static int is_peak(const iris_hough *hough, int32_t theta, int32_t rho)
{
    int32_t reach = hough->config.theta_separation, far = hough->config.rho_separation;
    int32_t here = theta * hough->rho_bins + rho;
    if (reach > (hough->config.theta_bins - 1) / 2 && hough->span == HALF_TURN) {
        reach = (hough->config.theta_bins - 1) / 2; /* each angle once */
    }
    for (int32_t t = -reach; t <= reach; t++) {
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
    int32_t angle =
        bin_angle(hough, theta) + theta_sum * 256 / sum * hough->span / (256 * hough->config.theta_bins);
    int32_t rho_q9 =
        hough->config.rho_min * 512 + (rho * 512 + 256 + rho_sum * 512 / sum) * hough->config.rho_step;
    while (outside(angle, -HALF_TURN / 2, HALF_TURN / 2 - 1)) {
        angle += angle < 0 ? HALF_TURN : -HALF_TURN;
        rho_q9 = -rho_q9;
    }
    return (iris_hough_line){(iris_angle)angle, rho_q9 * 128, votes};
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

iris_status iris_hough_lines(iris_hough_line *lines, int32_t capacity, int32_t *count, const iris_image *mask,
                             const iris_hough_config *config, iris_scratch *scratch)
{
    if (!count || capacity < 0 || (!lines && capacity > 0) || !mask) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(mask);
    if (status != IRIS_OK || mask->format != IRIS_MASK1) {
        return status != IRIS_OK ? status : IRIS_ERR_FORMAT;
    }
    iris_hough hough;
    size_t start = iris_scratch_mark(scratch);
    status = iris_hough_begin(&hough, (iris_size){mask->w, mask->h}, config, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    for (int32_t y = 0; y < mask->h; y++) {
        iris_hough_vote_row(&hough, (const uint32_t *)iris_image_row(mask, y), y);
    }
    status = iris_hough_peaks(lines, capacity, count, &hough);
    iris_scratch_release(scratch, start);
    return status;
}

iris_status iris_hough_accumulator(iris_image *view, const iris_hough *hough)
{
    if (!view || !hough || !hough->votes) {
        return IRIS_ERR_ARG;
    }
    *view = (iris_image){hough->votes, (ptrdiff_t)hough->rho_bins * 2, hough->rho_bins,
                         hough->config.theta_bins, IRIS_GRAY_U16};
    return IRIS_OK;
}

/* 1 / a for a in 0.7..1: Newton's method from 1.2, where each round squares the error of at first 0.2. */
static iris_q30 reciprocal(iris_q30 a)
{
    iris_q30 r = 1288490189;
    for (int i = 0; i < 4; i++) {
        r += iris_q30_mul(r, IRIS_Q30_ONE - iris_q30_mul(a, r));
    }
    return r;
}

/* A line a = start + slope * b, where b is the axis that it follows more closely. */
typedef struct {
    int64_t start_q16;
    iris_q30 slope;
    int32_t a_side; /* of the image along a */
} walk;

/* The pixel a of the line at b, or -1 outside the image. */
static int32_t walk_at(const walk *w, int32_t b)
{
    int64_t a = iris_round_shift(w->start_q16 + iris_round_shift((int64_t)w->slope * b, 14), 16);
    return a >= 0 && a < w->a_side ? (int32_t)a : -1;
}

iris_status iris_hough_clip(iris_hough_ends *ends, const iris_hough_line *line, iris_size size)
{
    if (!ends || !line) {
        return IRIS_ERR_ARG;
    }
    if (size_is_bad(size)) {
        return IRIS_ERR_RANGE;
    }
    iris_q30 along = iris_cos_q30(line->angle), across = iris_sin_q30(line->angle);
    int upright = (along < 0 ? -along : along) >= (across < 0 ? -across : across);
    int32_t b_side = upright ? size.h : size.w;
    walk path = {.a_side = upright ? size.w : size.h};
    if (!upright) {
        iris_q30 other = along;
        along = across;
        across = other;
    }
    iris_q30 inverse = along < 0 ? -reciprocal(-along) : reciprocal(along);
    path.slope = -iris_q30_mul(across, inverse);
    path.start_q16 = iris_round_shift((int64_t)line->rho_q16 * inverse, 30) +
                     (int64_t)(path.a_side - 1) * 32768 -
                     iris_round_shift((int64_t)path.slope * (b_side - 1), 15);
    int32_t first = 0, last = b_side - 1;
    while (first <= last && walk_at(&path, first) < 0) {
        first++;
    }
    if (first > last) {
        return IRIS_ERR_RANGE;
    }
    while (walk_at(&path, last) < 0) {
        last--;
    }
    int32_t a_first = walk_at(&path, first), a_last = walk_at(&path, last);
    if (upright) {
        *ends = (iris_hough_ends){a_last, last, a_first, first};
    } else if (a_last > a_first) {
        *ends = (iris_hough_ends){last, a_last, first, a_first};
    } else {
        *ends = (iris_hough_ends){first, a_first, last, a_last};
    }
    return IRIS_OK;
}
