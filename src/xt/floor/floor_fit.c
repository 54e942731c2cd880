/* The floor that fits marks best: see floor.h for the method. */
#include "../../foundation/triangle.h"
#include "floor_parts.h"

#define UNKNOWNS 8
#define ROUNDS   10
#define THIN     4096    /* in line: a variance across of 1/4096 of that along, or less; 1/64 in width */
#define W_LEAST  1048576 /* 2^-12: so much nearer than the marks' mean may a mark be */
#define SINGULAR 4096    /* 2^-20 */
#define FAR      ((iris_q32)1 << 42) /* 1024: so far from the picture's marks no mark is put */

/* Centered at `middle` and at most 1 in both directions. */
typedef struct {
    iris_place middle;
    int64_t reach_q16;
} frame;

/* A mark in both frames. */
typedef struct {
    iris_q32 x, y, u, v;
} pair;

/* What is known of the unknowns so far. */
typedef struct {
    iris_triangle triangle;
    iris_q32 numbers[IRIS_TRIANGLE_NUMBERS(UNKNOWNS)];
} equations;

typedef struct {
    const iris_floor_mark *marks;
    int32_t count;
    frame floor, image;
} problem;

static int64_t magnitude(int64_t value)
{
    return value < 0 ? -value : value;
}

static iris_place place_of(const iris_floor_mark *mark, int of_image)
{
    return of_image ? mark->image : mark->floor;
}

static frame frame_of(const iris_floor_mark *marks, int32_t count, int of_image)
{
    frame made;
    int64_t x = 0, y = 0;
    for (int32_t i = 0; i < count; i++) {
        x += place_of(&marks[i], of_image).x_q16;
        y += place_of(&marks[i], of_image).y_q16;
    }
    made.middle = (iris_place){(iris_q16)(x / count), (iris_q16)(y / count)};
    made.reach_q16 = 1;
    for (int32_t i = 0; i < count; i++) {
        iris_place at = place_of(&marks[i], of_image);
        int64_t right = magnitude((int64_t)at.x_q16 - made.middle.x_q16);
        int64_t down = magnitude((int64_t)at.y_q16 - made.middle.y_q16);
        made.reach_q16 = right > made.reach_q16 ? right : made.reach_q16;
        made.reach_q16 = down > made.reach_q16 ? down : made.reach_q16;
    }
    return made;
}

/* Both coordinates, -1 to 1. */
static void normalize(iris_q32 *x, iris_q32 *y, const frame *in, iris_place at)
{
    *x = ((int64_t)at.x_q16 - in->middle.x_q16) * 1073741824 / in->reach_q16 * 4;
    *y = ((int64_t)at.y_q16 - in->middle.y_q16) * 1073741824 / in->reach_q16 * 4;
}

static pair pair_of(const problem *of, int32_t i)
{
    pair made;
    normalize(&made.x, &made.y, &of->floor, of->marks[i].floor);
    normalize(&made.u, &made.v, &of->image, of->marks[i].image);
    return made;
}

/* How many different places there are among the marks, up to four. */
static int32_t different(const iris_floor_mark *marks, int32_t count, int of_image)
{
    int32_t found = 0;
    for (int32_t i = 0; i < count && found < IRIS_FLOOR_MARKS_MIN; i++) {
        iris_place here = place_of(&marks[i], of_image);
        int32_t k = 0;
        while (k < i && (place_of(&marks[k], of_image).x_q16 != here.x_q16 ||
                         place_of(&marks[k], of_image).y_q16 != here.y_q16)) {
            k++;
        }
        found += k == i;
    }
    return found;
}

/* Sums over normalized places with 11 fraction bits: at most 256 * 2^22. */
typedef struct {
    int64_t n, x, y, xx, xy, yy;
} moments;

static void moments_add(moments *sums, int64_t x, int64_t y, int64_t times)
{
    sums->n += times;
    sums->x += times * x;
    sums->y += times * y;
    sums->xx += times * x * x;
    sums->xy += times * x * y;
    sums->yy += times * y * y;
}

static int is_thin(const moments *sums)
{
    int64_t xx = sums->xx - sums->x * sums->x / sums->n, yy = sums->yy - sums->y * sums->y / sums->n;
    int64_t xy = sums->xy - sums->x * sums->y / sums->n;
    int64_t trace = xx + yy;
    return xx * yy - xy * xy <= trace * trace / THIN;
}

/* Are all marks but one, whichever, on one line? Then there are not four of which no three are. */
static int in_line(const problem *of, int of_image)
{
    moments all = {0, 0, 0, 0, 0, 0};
    int thin = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int32_t i = 0; i < of->count; i++) {
            iris_q32 x, y;
            normalize(&x, &y, of_image ? &of->image : &of->floor, place_of(&of->marks[i], of_image));
            x = iris_round_shift(x, 21);
            y = iris_round_shift(y, 21);
            if (pass == 0) {
                moments_add(&all, x, y, 1);
            } else {
                moments rest = all;
                moments_add(&rest, x, y, -1);
                thin |= is_thin(&rest);
            }
        }
    }
    return thin;
}

static iris_q32 linear(const iris_q32 row[2], iris_q32 one, const pair *at)
{
    iris_wide sum = iris_wide_add(iris_wide_mul(row[0], at->x), iris_wide_mul(row[1], at->y));
    return iris_wide_round_shift_sat(iris_wide_add(sum, iris_wide_mul(one, IRIS_Q32_ONE)), 32);
}

/* Where the numbers put a mark: at (u, v), of depth w. Returns 0 behind the camera and far off. */
static int place_mark(pair *put, iris_q32 *w, const iris_q32 h[UNKNOWNS], const pair *at)
{
    *w = linear(h + 6, IRIS_Q32_ONE, at);
    if (*w < W_LEAST) {
        return 0;
    }
    put->u = iris_q32_div_sat(linear(h, h[2], at), *w);
    put->v = iris_q32_div_sat(linear(h + 3, h[5], at), *w);
    return put->u < FAR && put->u > -FAR && put->v < FAR && put->v > -FAR;
}

/* The equation of one coordinate: (x, y, 1 at `first`; -t x, -t y at the last two) / w = right. */
static void add_coordinate(equations *e, const pair *at, int first, iris_q32 t, iris_q32 w, iris_q32 right)
{
    iris_q32 row[UNKNOWNS + 1] = {0};
    iris_q32 x = w == IRIS_Q32_ONE ? at->x : iris_q32_div_sat(at->x, w);
    iris_q32 y = w == IRIS_Q32_ONE ? at->y : iris_q32_div_sat(at->y, w);
    row[first] = x;
    row[first + 1] = y;
    row[first + 2] = iris_q32_div_sat(IRIS_Q32_ONE, w);
    row[6] = -iris_q32_mul_sat(t, x);
    row[7] = -iris_q32_mul_sat(t, y);
    row[UNKNOWNS] = right;
    iris_triangle_add(&e->triangle, row);
}

/* The first solution, which makes algebraic errors least. */
static int solve_linear(iris_q32 h[UNKNOWNS], equations *e, const problem *of)
{
    iris_triangle_init(&e->triangle, e->numbers, UNKNOWNS);
    for (int32_t i = 0; i < of->count; i++) {
        pair at = pair_of(of, i);
        add_coordinate(e, &at, 0, at.u, IRIS_Q32_ONE, at.u);
        add_coordinate(e, &at, 3, at.v, IRIS_Q32_ONE, at.v);
    }
    return iris_triangle_solve(h, &e->triangle, SINGULAR);
}

/* The sum of squared distances in the picture, and in *e the step that makes it smaller. -1: a mark is behind the camera. */
static int64_t linearize(equations *e, const iris_q32 h[UNKNOWNS], const problem *of)
{
    int64_t sum = 0;
    iris_triangle_init(&e->triangle, e->numbers, UNKNOWNS);
    for (int32_t i = 0; i < of->count; i++) {
        pair at = pair_of(of, i), put;
        iris_q32 w;
        if (!place_mark(&put, &w, h, &at)) {
            return -1;
        }
        iris_q32 right = at.u - put.u, down = at.v - put.v;
        iris_wide square = iris_wide_add(iris_wide_mul(right, right), iris_wide_mul(down, down));
        int64_t share = iris_wide_round_shift_sat(square, 16);
        sum +=
            share < INT64_MAX / (2 * IRIS_FLOOR_MARKS_MAX) ? share : INT64_MAX / (2 * IRIS_FLOOR_MARKS_MAX);
        add_coordinate(e, &at, 0, put.u, w, right);
        add_coordinate(e, &at, 3, put.v, w, down);
    }
    return sum;
}

/* From the first solution to the best. Returns 0 when a mark is behind the camera. */
static int refine(iris_q32 h[UNKNOWNS], equations *e, const problem *of)
{
    iris_q32 better[UNKNOWNS], step[UNKNOWNS];
    int64_t least = linearize(e, h, of);
    for (int round = 0; least > 0 && round < ROUNDS && iris_triangle_solve(step, &e->triangle, SINGULAR);
         round++) {
        for (int i = 0; i < UNKNOWNS; i++) {
            better[i] =
                iris_wide_round_shift_sat(iris_wide_add(iris_wide_from(h[i]), iris_wide_from(step[i])), 0);
        }
        int64_t sum = linearize(e, better, of);
        if (sum < 0 || sum >= least) {
            break;
        }
        least = sum;
        for (int i = 0; i < UNKNOWNS; i++) {
            h[i] = better[i];
        }
    }
    return least >= 0;
}

/* (a p + b q) / c */
static iris_q32 share(int64_t a, int64_t p, int64_t b, int64_t q, int64_t c)
{
    return iris_wide_div_sat(iris_wide_add(iris_wide_mul(a, p), iris_wide_mul(b, q)), c);
}

/* From the frames back to pixels and millimeters: h[0..2] of a coordinate with the image's middle, to m[0..2]. */
static void scale_row(iris_q32 m[3], const iris_q32 h[3], const iris_q32 w[2], const problem *of,
                      iris_q16 middle)
{
    const frame *floor = &of->floor;
    int64_t t = of->image.reach_q16, s = floor->reach_q16;
    m[0] = share(w[0], middle, h[0], t, s);
    m[1] = share(w[1], middle, h[1], t, s);
    iris_q32 center = share(IRIS_Q32_ONE, middle, h[2], t, IRIS_Q16_ONE);
    iris_q32 away = share(m[0], floor->middle.x_q16, m[1], floor->middle.y_q16, IRIS_Q16_ONE);
    m[2] = iris_wide_round_shift_sat(iris_wide_sub(iris_wide_from(center), iris_wide_from(away)), 0);
}

static void scale(iris_q32 m[9], const iris_q32 h[UNKNOWNS], const problem *of)
{
    const frame *floor = &of->floor;
    scale_row(m, h, h + 6, of, of->image.middle.x_q16);
    scale_row(m + 3, h + 3, h + 6, of, of->image.middle.y_q16);
    m[6] = share(h[6], IRIS_Q16_ONE, 0, 0, floor->reach_q16);
    m[7] = share(h[7], IRIS_Q16_ONE, 0, 0, floor->reach_q16);
    iris_q32 away = share(m[6], floor->middle.x_q16, m[7], floor->middle.y_q16, IRIS_Q16_ONE);
    m[8] = iris_wide_round_shift_sat(iris_wide_sub(iris_wide_from(IRIS_Q32_ONE), iris_wide_from(away)), 0);
}

/* Squared distance of two places, at most 2^62: farther ones count as so far. */
static uint64_t squared(iris_place a, iris_place b)
{
    int64_t x = magnitude((int64_t)a.x_q16 - b.x_q16), y = magnitude((int64_t)a.y_q16 - b.y_q16);
    x = x > 1073741823 ? 1073741823 : x;
    y = y > 1073741823 ? 1073741823 : y;
    return (uint64_t)(x * x + y * y);
}

/* The largest and the root of the mean square of distances; returns the index of the largest. */
static int32_t distances(iris_q16 *most, iris_q16 *rms, const iris_floor *floor, const problem *of,
                         int of_image)
{
    uint64_t largest = 0, sum = 0;
    int32_t worst = 0;
    for (int32_t i = 0; i < of->count; i++) {
        const iris_floor_mark *mark = &of->marks[i];
        iris_place put = {INT32_MAX, INT32_MAX};
        (void)(of_image ? iris_floor_image(&put, floor, mark->floor)
                        : iris_floor_point(&put, floor, mark->image));
        uint64_t square = squared(put, place_of(mark, of_image));
        worst = square > largest ? i : worst;
        largest = square > largest ? square : largest;
        sum += square >> 8;
    }
    uint64_t mean = sum / (uint64_t)of->count;
    *most = (iris_q16)iris_sqrt_u64(largest);
    *rms = (iris_q16)(mean >> 54 ? 16 * (uint64_t)iris_sqrt_u64(mean) : iris_sqrt_u64(mean << 8));
    return worst;
}

static iris_floor_flaw flaw_of(const problem *of)
{
    if (of->count < IRIS_FLOOR_MARKS_MIN || different(of->marks, of->count, 0) < IRIS_FLOOR_MARKS_MIN ||
        different(of->marks, of->count, 1) < IRIS_FLOOR_MARKS_MIN) {
        return IRIS_FLOOR_TOO_FEW;
    }
    return in_line(of, 0) || in_line(of, 1) ? IRIS_FLOOR_IN_LINE : IRIS_FLOOR_FINE;
}

/* The nine numbers that fit best. */
static iris_floor_flaw solve(iris_q32 m[9], const problem *of)
{
    iris_q32 h[UNKNOWNS];
    equations e;
    iris_floor_flaw flaw = flaw_of(of);
    if (flaw != IRIS_FLOOR_FINE) {
        return flaw;
    }
    if (!solve_linear(h, &e, of) || !refine(h, &e, of)) {
        return IRIS_FLOOR_HORIZON;
    }
    scale(m, h, of);
    return IRIS_FLOOR_FINE;
}

iris_status iris_floor_fit(iris_floor *floor, iris_floor_quality *quality, iris_size size,
                           const iris_floor_mark *marks, int32_t count)
{
    if (!floor || !quality || (!marks && count > 0)) {
        return IRIS_ERR_ARG;
    }
    if (count < 0 || count > IRIS_FLOOR_MARKS_MAX || size.w < 1 || size.w > IRIS_SIDE_MAX || size.h < 1 ||
        size.h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    problem of = {.marks = marks, .count = count};
    iris_floor_quality found = {.flaw = IRIS_FLOOR_TOO_FEW};
    iris_floor made;
    iris_q32 m[9];
    if (count > 0) {
        of.floor = frame_of(marks, count, 0);
        of.image = frame_of(marks, count, 1);
        found.flaw = solve(m, &of);
    }
    if (found.flaw == IRIS_FLOOR_FINE) {
        found.flaw = iris_floor_init(&made, size, m) == IRIS_OK ? IRIS_FLOOR_FINE : IRIS_FLOOR_MIRRORED;
    }
    if (found.flaw == IRIS_FLOOR_FINE) {
        (void)distances(&found.max_mm_q16, &found.rms_mm_q16, &made, &of, 0);
        found.worst = distances(&found.max_px_q16, &found.rms_px_q16, &made, &of, 1);
        *floor = made;
    }
    *quality = found;
    return found.flaw == IRIS_FLOOR_FINE ? IRIS_OK : IRIS_ERR_DATA;
}
