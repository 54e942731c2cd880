/* The line through one point per row, as far as the follower needs it. */
#include "regress_rows.h"

/* Both values shifted right alike until they fit in 30 bits: their ratio is what counts. */
static void shrink(int64_t *a, int64_t *b)
{
    int64_t all = (*a < 0 ? -*a : *a) | (*b < 0 ? -*b : *b);
    for (; all > 0x3fffffff; all >>= 1) {
        *a >>= 1;
        *b >>= 1;
    }
}

iris_status iris_line_set_angle(iris_line *line, int64_t difference, int64_t xy)
{
    if (xy == 0 && difference == 0) {
        return IRIS_ERR_RANGE;
    }
    shrink(&xy, &difference);
    int32_t doubled = iris_atan2_angle(-2 * (int32_t)xy, (int32_t)difference);
    line->angle = (iris_angle)(doubled >> 1);
    return IRIS_OK;
}

/* sin(pi / 2 * t), t from -1 to 1, both with 15 fraction bits: the odd polynomial of degree 5, within 2^-12. */
static int32_t rough_sine_q15(int32_t t_q15)
{
    int32_t square = t_q15 * t_q15 >> 15;
    int32_t sum = 51466 - ((21077 - (2383 * square >> 15)) * square >> 15);
    return t_q15 * (sum >> 1) >> 14;
}

/* A row's point is 1 / 4096 of the sum (its twice_x times per_twice_x, its y times per_row, and the rest) in quarter
 * pixels away from a line: 12 fraction bits of the direction keep that in 32 bits. */
typedef struct {
    int32_t per_twice_x, per_row, rest;
} ruler;

static ruler ruler_along(const iris_line *line)
{
    int32_t dx = line->dx >> 18, dy = line->dy >> 18;
    return (ruler){2 * dy, -4 * dx, (line->y_q16 >> 14) * dx - (line->x_q16 >> 14) * dy};
}

static int32_t distance_q2(const ruler *from, int32_t twice_x, int32_t y)
{
    int32_t across = (twice_x * from->per_twice_x + y * from->per_row + from->rest) >> 12;
    return across < 0 ? -across : across;
}

typedef struct {
    const int16_t *twice_x;
    int32_t y0, y1;
} row_range;

/* Of the points, at twice the scale: at most 2^14 of them, within +-32767 and 0..32766. */
typedef struct {
    int32_t n, x, y;
    int64_t difference, xy; /* of the squares of y and of x; products */
} row_sums;

/* Of those points that are at most limit_q2 away from a line; of all where `from` is null. */
static void sum_rows(row_sums *sums, const row_range *rows, const ruler *from, int32_t limit_q2)
{
    int32_t n = 0, sum_x = 0, sum_y = 0;
    int64_t difference = 0, xy = 0;
    for (int32_t row = rows->y0; row <= rows->y1; row++) {
        int32_t x = rows->twice_x[row], y = 2 * row;
        if (x == IRIS_REGRESS_NONE || (from && distance_q2(from, x, row) > limit_q2)) {
            continue;
        }
        n++;
        sum_x += x;
        sum_y += y;
        difference += y * y - x * x;
        xy += x * y;
    }
    *sums = (row_sums){n, sum_x, sum_y, difference, xy};
}

/* a * b for |a| below 2^15 + 1, without the code that a small processor needs for 64 bits. */
static int64_t product(int32_t a, int32_t b)
{
    return (int64_t)(a * (b >> 15)) * 32768 + a * (b & 0x7fff);
}

/* The line through the points, from what is around their center. */
static iris_status fit_rows(iris_line *line, const row_sums *sums)
{
    int32_t n = sums->n, x = sums->x, y = sums->y;
    if (n < 1) {
        return IRIS_ERR_RANGE;
    }
    int32_t center_x = x / n, center_y = y / n;
    int32_t rest_x = x - center_x * n, rest_y = y - center_y * n;
    int64_t difference = sums->difference - product(center_y, y + rest_y) + product(center_x, x + rest_x);
    int64_t xy = sums->xy - product(center_x, y) - center_y * rest_x;
    /* what the whole numbers miss of the center, as the rest and with 16 fraction bits */
    int32_t fraction_x = rest_x * 65536 / n, fraction_y = rest_y * 65536 / n;
    difference = difference * 65536 - (rest_y * fraction_y - rest_x * fraction_x);
    xy = xy * 65536 - rest_x * fraction_y;
    iris_status status = iris_line_set_angle(line, difference, xy);
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

/* 2.5 times the mean distance of all points, in quarter pixels; a pixel at least. INT32_MAX when none is farther. */
static int32_t trim_limit_q2(const row_range *rows, const ruler *from, int32_t points)
{
    uint32_t sum = 0, twice_points = 2u * (uint32_t)points; /* at most 2^14 of less than 2^18 each */
    int32_t most = 0;
    for (int32_t y = rows->y0; y <= rows->y1; y++) {
        if (rows->twice_x[y] != IRIS_REGRESS_NONE) {
            int32_t distance = distance_q2(from, rows->twice_x[y], y);
            sum += (uint32_t)distance;
            most = distance > most ? distance : most;
        }
    }
    int32_t limit = (int32_t)(sum / twice_points * 5 + sum % twice_points * 5 / twice_points);
    limit = limit < 4 ? 4 : limit;
    return most > limit ? limit : INT32_MAX;
}

iris_status iris_regress_rows_rough(iris_line *line, const int16_t *twice_x, int32_t y0, int32_t y1,
                                    int32_t trims)
{
    const row_range rows = {twice_x, y0, y1};
    row_sums sums;
    sum_rows(&sums, &rows, NULL, 0);
    int32_t all = sums.n;
    iris_status status = fit_rows(line, &sums);
    for (; status == IRIS_OK && trims > 0; trims--) {
        ruler from = ruler_along(line);
        int32_t limit = trim_limit_q2(&rows, &from, all);
        if (limit == INT32_MAX && line->points == all) {
            break; /* the line through all points, and none is to be left out */
        }
        sum_rows(&sums, &rows, &from, limit);
        /* when what is left has no direction, the line before stays */
        (void)fit_rows(line, &sums);
    }
    return status;
}
