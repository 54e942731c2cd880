/* What blobs look like, and which of them count. */
#include "blob_parts.h"

void iris_blob_filter_defaults(iris_blob_filter *filter)
{
    if (filter) {
        *filter = (iris_blob_filter){0, INT32_MAX,
                                     0, INT32_MAX,
                                     0, INT32_MAX,
                                     0, 1000,
                                     0, INT32_MAX,
                                     0, INT32_MAX,
                                     0, {0, 0, IRIS_SIDE_MAX, IRIS_SIDE_MAX}};
    }
}

void iris_blob_defaults(iris_blob_config *config)
{
    if (config) {
        config->connectivity = 8;
        iris_blob_filter_defaults(&config->filter);
    }
}

int iris_blob_config_is_bad(const iris_blob_config *config)
{
    return (config->connectivity != 4 && config->connectivity != 8) ||
           (config->filter.inside != 0 && config->filter.inside != 1);
}

/* ---- shapes ---- */

/* Could these be the sums of a blob of n pixels? */
static int are_plausible(const iris_moments *m)
{
    if (m->n < 1 || m->n > (int64_t)1 << 30) {
        return 0;
    }
    int64_t most = m->n * IRIS_SIDE_MAX, most_squares = most * IRIS_SIDE_MAX;
    return m->x >= 0 && m->x <= most && m->y >= 0 && m->y <= most && m->xx >= 0 && m->xx <= most_squares &&
           m->yy >= 0 && m->yy <= most_squares && m->xy >= 0 && m->xy <= most_squares;
}

#define TOO_FAR INT64_MAX

/* 12 times the mean of (a - mean a)(b - mean b), with 20 fraction bits, 2^52 at most; TOO_FAR when no picture is as
 * wide as that. The whole part of the means first, then the rest, so that no product leaves 64 bits; few points get
 * more fraction bits on the way. */
static int64_t spread_q20(int64_t ab, int64_t a, int64_t b, int64_t n)
{
    int bits = 0;
    while (bits < 20 && n >> (30 - bits) == 0) {
        bits++;
    }
    int64_t qa = a / n, ra = a % n, qb = b / n, rb = b % n, most = n * ((int64_t)1 << 28);
    int64_t around_whole = ab - qa * b - qb * ra;
    if (around_whole > most || around_whole < -most) {
        return TOO_FAR;
    }
    int64_t sum = 12 * (around_whole * ((int64_t)1 << bits) - ra * rb * ((int64_t)1 << bits) / n);
    int64_t scale = (int64_t)1 << (20 - bits);
    return sum / n * scale + sum % n * scale / n;
}

/* Half the difference of the sides' squares; sets where the long side points. Both spreads are shifted alike until
 * they fit. */
static int64_t turn(iris_blob_shape *shape, int64_t yy_less_xx, int64_t twice_xy)
{
    int64_t a = yy_less_xx, b = twice_xy;
    int shift = 0;
    while ((a < 0 ? ~a : a) >> 30 != 0 || (b < 0 ? ~b : b) >> 30 != 0) {
        a >>= 1;
        b >>= 1;
        shift++;
    }
    shape->angle = (iris_angle)(iris_atan2_angle(-(int32_t)b, (int32_t)a) >> 1);
    if (twice_xy == 0) {
        return yy_less_xx < 0 ? -yy_less_xx : yy_less_xx;
    }
    return (int64_t)iris_hypot((int32_t)a, (int32_t)b) << shift;
}

/* The side of which the square has 20 fraction bits. */
static iris_q16 side_q16(int64_t square_q20)
{
    if (square_q20 >= (int64_t)1 << 50) {
        return INT32_MAX;
    }
    return iris_sat_s32(iris_sqrt_u64((uint64_t)square_q20 << 12));
}

iris_status iris_blob_shape_of(iris_blob_shape *shape, const iris_blob *blob)
{
    if (!shape || !blob) {
        return IRIS_ERR_ARG;
    }
    const iris_moments *m = &blob->moments;
    if (!are_plausible(m)) {
        return IRIS_ERR_RANGE;
    }
    int64_t xx = spread_q20(m->xx, m->x, m->x, m->n), yy = spread_q20(m->yy, m->y, m->y, m->n),
            xy = spread_q20(m->xy, m->x, m->y, m->n);
    if (xx < 0 || xx == TOO_FAR || yy < 0 || yy == TOO_FAR || xy == TOO_FAR) {
        return IRIS_ERR_RANGE;
    }
    int64_t root = turn(shape, yy - xx, 2 * xy), pixel = (int64_t)1 << 20;
    int64_t least = xx + yy > root ? (xx + yy - root) / 2 : 0;
    shape->length_q16 = side_q16((xx + yy + root) / 2 + pixel);
    shape->breadth_q16 = side_q16(least + pixel);
    shape->elongation_q16 = iris_q16_div_sat(shape->length_q16, shape->breadth_q16);
    shape->perimeter_q16 = iris_sat_s32((int64_t)blob->edges * 62132 - (int64_t)blob->corners * 18198);
    return IRIS_OK;
}

/* ---- filters ---- */

static int is_within(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

static int fills(const iris_blob *blob, const iris_blob_filter *by)
{
    int64_t box = (int64_t)blob->box.w * blob->box.h, area = (int64_t)blob->area * 1000;
    return area >= by->min_fill_permil * box && area <= by->max_fill_permil * box;
}

static int is_inside(iris_rect box, iris_size size)
{
    return box.x > 0 && box.y > 0 && (int64_t)box.x + box.w < size.w && (int64_t)box.y + box.h < size.h;
}

static int contains(iris_rect rect, int32_t x, int32_t y)
{
    int64_t from_x = (int64_t)x - rect.x, from_y = (int64_t)y - rect.y;
    return from_x >= 0 && from_x < rect.w && from_y >= 0 && from_y < rect.h;
}

static int is_elongated(const iris_blob *blob, int32_t low, int32_t high)
{
    iris_blob_shape shape;
    return (low <= IRIS_Q16_ONE && high == INT32_MAX) ||
           (iris_blob_shape_of(&shape, blob) == IRIS_OK && is_within(shape.elongation_q16, low, high));
}

int iris_blob_passes(const iris_blob *blob, const iris_blob_filter *filter, iris_size size)
{
    if (!blob || !filter || !is_within(blob->box.w, 1, IRIS_SIDE_MAX) ||
        !is_within(blob->box.h, 1, IRIS_SIDE_MAX)) {
        return 0;
    }
    return is_within(blob->area, filter->min_area, filter->max_area) &&
           is_within(blob->box.w, filter->min_w, filter->max_w) &&
           is_within(blob->box.h, filter->min_h, filter->max_h) &&
           is_within(blob->holes, filter->min_holes, filter->max_holes) &&
           (!filter->inside || is_inside(blob->box, size)) &&
           contains(filter->center_in, iris_q16_to_int(blob->x_q16), iris_q16_to_int(blob->y_q16)) &&
           fills(blob, filter) && is_elongated(blob, filter->min_elongation_q16, filter->max_elongation_q16);
}
