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
    if (hough_size_is_bad(size)) {
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
