/* Back to the image. */
#include "hough_parts.h"

/* 1 / a for a in 0.7..1: Newton's method from 1.2, where each round squares the error of at first 0.2. */
static iris_q30 reciprocal(iris_q30 a)
{
    iris_q30 r = 1288490189;
    for (int i = 0; i < 4; i++) {
        r += iris_q30_mul(r, IRIS_Q30_ONE - iris_q30_mul(a, r));
    }
    return r;
}

hough_walk hough_walk_along(const iris_hough_line *line, iris_size size)
{
    iris_q30 along = iris_cos_q30(line->angle), across = iris_sin_q30(line->angle);
    int upright = (along < 0 ? -along : along) >= (across < 0 ? -across : across);
    hough_walk path = {
        .is_upright = upright, .a_side = upright ? size.w : size.h, .b_side = upright ? size.h : size.w};
    if (!upright) {
        iris_q30 other = along;
        along = across;
        across = other;
    }
    iris_q30 inverse = along < 0 ? -reciprocal(-along) : reciprocal(along);
    path.straightness = along < 0 ? -along : along;
    path.slope = -iris_q30_mul(across, inverse);
    path.start_q16 = iris_round_shift((int64_t)line->rho_q16 * inverse, 30) +
                     (int64_t)(path.a_side - 1) * 32768 -
                     iris_round_shift((int64_t)path.slope * (path.b_side - 1), 15);
    return path;
}

int64_t hough_walk_at(const hough_walk *path, int32_t b)
{
    return iris_round_shift(path->start_q16 + iris_round_shift((int64_t)path->slope * b, 14), 16);
}

static int is_inside(const hough_walk *path, int32_t b)
{
    int64_t a = hough_walk_at(path, b);
    return a >= 0 && a < path->a_side;
}

/* Of the pixel at b, or the nearest in the image. */
static int32_t a_within(const hough_walk *path, int32_t b)
{
    int64_t a = hough_walk_at(path, b);
    return (int32_t)(a < 0 ? 0 : a >= path->a_side ? path->a_side - 1 : a);
}

iris_hough_ends hough_walk_ends(const hough_walk *path, int32_t first, int32_t last)
{
    int32_t a_first = a_within(path, first), a_last = a_within(path, last);
    if (path->is_upright) {
        return (iris_hough_ends){a_last, last, a_first, first};
    }
    if (a_last > a_first) {
        return (iris_hough_ends){last, a_last, first, a_first};
    }
    return (iris_hough_ends){first, a_first, last, a_last};
}

iris_status iris_hough_clip(iris_hough_ends *ends, const iris_hough_line *line, iris_size size)
{
    if (!ends || !line) {
        return IRIS_ERR_ARG;
    }
    if (hough_size_is_bad(size)) {
        return IRIS_ERR_RANGE;
    }
    hough_walk path = hough_walk_along(line, size);
    int32_t first = 0, last = path.b_side - 1;
    while (first <= last && !is_inside(&path, first)) {
        first++;
    }
    if (first > last) {
        return IRIS_ERR_RANGE;
    }
    while (!is_inside(&path, last)) {
        last--;
    }
    *ends = hough_walk_ends(&path, first, last);
    return IRIS_OK;
}
