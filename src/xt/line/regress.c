#include "iris/xt/regress.h"
#include "regress_rows.h"

#define COORDINATE_MAX 65535
#define POINTS_MAX     ((int64_t)1 << 30)

static int beyond(int64_t value, int64_t limit)
{
    return value < -limit || value > limit;
}

void iris_moments_add(iris_moments *moments, int32_t x, int32_t y)
{
    if (beyond(x, COORDINATE_MAX) || beyond(y, COORDINATE_MAX) || moments->n >= POINTS_MAX) {
        return;
    }
    moments->n += 1;
    moments->x += x;
    moments->y += y;
    moments->xx += (int64_t)x * x;
    moments->xy += (int64_t)x * y;
    moments->yy += (int64_t)y * y;
}

void iris_moments_add_run(iris_moments *moments, int32_t x0, int32_t x1, int32_t y)
{
    int64_t n = (int64_t)x1 - x0 + 1;
    if (x0 > x1 || beyond(x0, COORDINATE_MAX) || beyond(x1, COORDINATE_MAX) || beyond(y, COORDINATE_MAX) ||
        moments->n > POINTS_MAX - n) {
        return;
    }
    int64_t twice_sum = n * ((int64_t)x0 + x1);
    /* sum of squares of x0..x1: n times the squared mean, plus n (n^2 - 1) / 12 around it, over a common
     * denominator */
    int64_t twelve_squares = 3 * twice_sum * ((int64_t)x0 + x1) + n * (n * n - 1);
    moments->n += n;
    moments->x += twice_sum / 2;
    moments->y += n * y;
    moments->xx += twelve_squares / 12;
    moments->xy += twice_sum / 2 * y;
    moments->yy += n * y * y;
}

/* sum (a - mean a)(b - mean b) without products beyond 64 bits: the whole part of the mean first, then the
 * rest. A few points get 8 fraction bits; many do not need them, nor have room for them. */
static int64_t centered(int64_t ab, int64_t a, int64_t b, int64_t n)
{
    int64_t scale = n < 1 << 20 ? 256 : 1;
    int64_t qa = a / n, ra = a % n;
    int64_t qb = b / n, rb = b % n;
    int64_t around_whole = ab - qa * b - qb * ra;
    return around_whole * scale - ra * rb * scale / n;
}

/* sum / n, saturated: centers beyond 32767 do not fit. */
static iris_q16 mean_q16(int64_t sum, int64_t n)
{
    int64_t whole = sum / n, rest = sum % n;
    return iris_sat_s32(whole * 65536 + rest * 65536 / n);
}

/* Can these be the sums of points that iris_moments_add takes? Then all that follows stays within 64 bits. */
static int are_plausible(const iris_moments *m)
{
    if (m->n < 1 || m->n > POINTS_MAX) {
        return 0;
    }
    int64_t most = m->n * COORDINATE_MAX, most_squares = most * COORDINATE_MAX;
    return !beyond(m->x, most) && !beyond(m->y, most) && !beyond(m->xy, most_squares) && m->xx >= 0 &&
           m->xx <= most_squares && m->yy >= 0 && m->yy <= most_squares;
}

static void set_direction(iris_line *line)
{
    line->dx = iris_sin_q30(line->angle);
    line->dy = -iris_cos_q30(line->angle);
}

iris_status iris_regress_moments(iris_line *line, const iris_moments *moments)
{
    if (!line || !moments) {
        return IRIS_ERR_ARG;
    }
    if (!are_plausible(moments)) {
        return IRIS_ERR_RANGE;
    }
    int64_t n = moments->n;
    iris_status status = iris_line_set_angle(line,
                                             centered(moments->yy, moments->y, moments->y, n) -
                                                 centered(moments->xx, moments->x, moments->x, n),
                                             centered(moments->xy, moments->x, moments->y, n));
    if (status == IRIS_OK) {
        set_direction(line);
        line->x_q16 = mean_q16(moments->x, n);
        line->y_q16 = mean_q16(moments->y, n);
        line->points = (int32_t)n;
    }
    return status;
}

iris_status iris_regress_points(iris_line *line, const iris_point *points, int32_t count)
{
    if (!line || !points || count < 0 || count > IRIS_REGRESS_POINTS_MAX) {
        return IRIS_ERR_ARG;
    }
    iris_moments twice = {0};
    for (int32_t i = 0; i < count; i++) {
        if (points[i].twice_x == INT16_MIN || points[i].twice_y == INT16_MIN) {
            return IRIS_ERR_ARG;
        }
        iris_moments_add(&twice, points[i].twice_x, points[i].twice_y);
    }
    iris_status status = iris_regress_moments(line, &twice);
    if (status == IRIS_OK) {
        line->x_q16 /= 2;
        line->y_q16 /= 2;
    }
    return status;
}

iris_status iris_regress_rows(iris_line *line, const int16_t *twice_x, int32_t y0, int32_t y1, int32_t trims)
{
    if (!line || !twice_x || y0 < 0 || y0 > y1 || y1 > IRIS_REGRESS_ROW_MAX || trims < 0 || trims > 4) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_regress_rows_rough(line, twice_x, y0, y1, trims);
    if (status == IRIS_OK) {
        set_direction(line);
    }
    return status;
}

static int32_t bit_at(const uint32_t *row, int32_t x)
{
    return (int32_t)(row[x / 32] >> (x % 32) & 1u);
}

/* The first x at or behind `x` whose bit is `value`, or w. Whole words of the other value are passed in one
 * step. */
static int32_t next_bit(const uint32_t *row, int32_t x, int32_t w, int32_t value)
{
    uint32_t skip = value ? 0u : ~0u;
    while (x < w && bit_at(row, x) != value) {
        x += x % 32 == 0 && row[x / 32] == skip ? 32 : 1;
    }
    return x < w ? x : w;
}

iris_status iris_regress_mask(iris_line *line, const iris_image *mask)
{
    if (!line || iris_image_check(mask) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (mask->format != IRIS_MASK1) {
        return IRIS_ERR_FORMAT;
    }
    iris_moments moments = {0};
    for (int32_t y = 0; y < mask->h; y++) {
        const uint32_t *row = (const uint32_t *)iris_image_row(mask, y);
        int32_t start = next_bit(row, 0, mask->w, 1);
        while (start < mask->w) {
            int32_t end = next_bit(row, start, mask->w, 0);
            iris_moments_add_run(&moments, start, end - 1, y);
            start = next_bit(row, end, mask->w, 1);
        }
    }
    return iris_regress_moments(line, &moments);
}
