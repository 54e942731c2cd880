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

/* Both values shifted right alike until they fit in 30 bits: their ratio is what counts. */
static void shrink(int64_t *a, int64_t *b)
{
    int64_t all = (*a < 0 ? ~*a : *a) | (*b < 0 ? ~*b : *b);
    for (; all > 0x3fffffff; all >>= 1) {
        *a >>= 1;
        *b >>= 1;
    }
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

/* The direction of largest spread, from sums around the center (both of one scale): it has half the angle of
 * (difference, -2 xy), counted from straight up; difference is that of yy and xx. */
static iris_status set_angle(iris_line *line, int64_t difference, int64_t xy)
{
    if (xy == 0 && difference == 0) {
        return IRIS_ERR_RANGE;
    }
    shrink(&xy, &difference);
    int32_t doubled = iris_atan2_angle(-2 * (int32_t)xy, (int32_t)difference);
    line->angle = (iris_angle)(doubled >> 1);
    return IRIS_OK;
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
    iris_status status = set_angle(line,
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

/* sin(pi / 2 * t), t from -1 to 1, both with 15 fraction bits: the odd polynomial of degree 5, within 2^-12. */
static int32_t rough_sine_q15(int32_t t_q15)
{
    int32_t square = t_q15 * t_q15 >> 15;
    int32_t sum = 51466 - ((21077 - (2383 * square >> 15)) * square >> 15);
    return t_q15 * (sum >> 1) >> 14;
}

/* Distance of a point from the line in quarter pixels (12 fraction bits of the direction keep it in 32 bits). */
static int32_t distance_q2(const iris_line *line, int32_t twice_x, int32_t y)
{
    int32_t from_x = twice_x * 2 - (line->x_q16 >> 14);
    int32_t from_y = y * 4 - (line->y_q16 >> 14);
    int32_t across = (from_x * (line->dy >> 18) - from_y * (line->dx >> 18)) >> 12;
    return across < 0 ? -across : across;
}

#define NO_LIMIT INT32_MAX

/* Rows y0 to y1 without those that are farther from `line` than the limit. */
typedef struct {
    const int16_t *twice_x;
    int32_t y0, y1, limit_q2;
    iris_line line;
} row_set;

/* The next row from y on that takes part, or one behind y1. */
static int32_t next_row(const row_set *rows, int32_t y)
{
    while (y <= rows->y1 &&
           (rows->twice_x[y] == IRIS_REGRESS_NONE ||
            (rows->limit_q2 != NO_LIMIT && distance_q2(&rows->line, rows->twice_x[y], y) > rows->limit_q2))) {
        y++;
    }
    return y;
}

/* The line through the rows, in two passes: first the center, then what is around it. At twice the scale, at most 2^14
 * rows are within +-32767 and 0..32766: all products fit in 32 bits. */
static iris_status fit_rows(iris_line *line, const row_set *rows)
{
    int32_t n = 0, x = 0, y = 0;
    for (int32_t row = next_row(rows, rows->y0); row <= rows->y1; row = next_row(rows, row + 1)) {
        n++;
        x += rows->twice_x[row];
        y += 2 * row;
    }
    if (n < 1) {
        return IRIS_ERR_RANGE;
    }
    int32_t center_x = x / n, center_y = y / n;
    int64_t difference = 0, xy = 0;
    for (int32_t row = next_row(rows, rows->y0); row <= rows->y1; row = next_row(rows, row + 1)) {
        int32_t from_x = rows->twice_x[row] - center_x, from_y = 2 * row - center_y;
        difference += from_y * from_y;
        difference -= (uint32_t)from_x * (uint32_t)from_x;
        xy += from_x * from_y;
    }
    /* what the whole numbers miss of the center, as the rest and with 16 fraction bits */
    int32_t rest_x = x - center_x * n, rest_y = y - center_y * n;
    int32_t fraction_x = rest_x * 65536 / n, fraction_y = rest_y * 65536 / n;
    difference = difference * 65536 - (rest_y * fraction_y - rest_x * fraction_x);
    xy = xy * 65536 - rest_x * fraction_y;
    iris_status status = set_angle(line, difference, xy);
    if (status == IRIS_OK) {
        int32_t t_q15 = 2 * line->angle;
        line->dx = rough_sine_q15(t_q15) * 32768;
        line->dy = -rough_sine_q15(t_q15 < 0 ? 32768 + t_q15 : 32768 - t_q15) * 32768;
        line->x_q16 = center_x * 32768 + fraction_x / 2;
        line->y_q16 = center_y * 32768 + fraction_y / 2;
        line->points = n;
    }
    return status;
}

/* 2.5 times the mean distance of the rows' points from the line, in quarter pixels; a pixel at least. */
static int32_t trim_limit_q2(const row_set *rows)
{
    uint32_t sum = 0, twice_points = 0; /* at most 2^14 rows of less than 2^18 each */
    for (int32_t y = next_row(rows, rows->y0); y <= rows->y1; y = next_row(rows, y + 1)) {
        sum += (uint32_t)distance_q2(&rows->line, rows->twice_x[y], y);
        twice_points += 2;
    }
    if (twice_points == 0) {
        return 4;
    }
    int32_t limit = (int32_t)(sum / twice_points * 5 + sum % twice_points * 5 / twice_points);
    return limit < 4 ? 4 : limit;
}

iris_status iris_regress_rows_rough(iris_line *line, const int16_t *twice_x, int32_t y0, int32_t y1,
                                    int32_t trims)
{
    row_set rows = {.twice_x = twice_x, .y0 = y0, .y1 = y1, .limit_q2 = NO_LIMIT};
    iris_status status = fit_rows(&rows.line, &rows);
    if (status != IRIS_OK) {
        return status;
    }
    *line = rows.line;
    for (; trims > 0; trims--) {
        rows.line = *line;
        rows.limit_q2 = NO_LIMIT;
        rows.limit_q2 = trim_limit_q2(&rows);
        /* when what is left has no direction, the line before stays */
        (void)fit_rows(line, &rows);
    }
    return IRIS_OK;
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
