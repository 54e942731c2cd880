/* The line through one point per row, as far as the follower needs it. */
#include "regress_rows.h"

/* Both values shifted right alike until they fit in 30 bits: their ratio is what counts. */
static void shrink(int64_t *a, int64_t *b)
{
    int64_t all = (*a < 0 ? ~*a : *a) | (*b < 0 ? ~*b : *b);
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
