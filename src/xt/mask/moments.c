#include "iris/xt/moments.h"

#include "../../foundation/views.h"
#include "iris/wide.h"
#include "mask_runs.h"

#define AREA_MAX  ((int64_t)IRIS_MOMENTS_SIDE_MAX * IRIS_MOMENTS_SIDE_MAX)
#define ETA_MAX   ((int64_t)1 << 50) /* 1024 with 40 fraction bits */
#define MOST      ((int64_t)1 << 60) /* four of them can be added */
#define MU_BITS   6
#define ETA_BITS  40
#define ROOT_BITS 19

/* Sums over a row: 1, x, 6 x^2, x^3. */
typedef struct {
    int64_t ones, x, six_xx, xxx;
} row_sums;

/* Adds the pixels 0 to end - 1, `sign` times. */
static void add_to(row_sums *sums, int64_t end, int64_t sign)
{
    int64_t x = end * (end - 1) / 2;
    sums->ones += sign * end;
    sums->x += sign * x;
    sums->six_xx += sign * 2 * x * (2 * end - 1);
    sums->xxx += sign * x * x;
}

iris_status iris_mask_moments_sum(iris_mask_moments *moments, const iris_image *mask)
{
    if (!moments || !mask) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(mask, IRIS_MASK1);
    if (status != IRIS_OK) {
        return status;
    }
    if (mask->w > IRIS_MOMENTS_SIDE_MAX || mask->h > IRIS_MOMENTS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    iris_mask_moments m = {0}; /* m20 and m21 six times, until the end */
    for (int64_t y = 0; y < mask->h; y++) {
        const uint32_t *row = (const uint32_t *)iris_image_row(mask, (int32_t)y);
        row_sums sums = {0, 0, 0, 0};
        iris_mask_span run = {0, 0};
        while (iris_mask_run(&run, row, run.end, mask->w)) {
            add_to(&sums, run.end, 1);
            add_to(&sums, run.first, -1);
        }
        if (sums.ones > 0) {
            m.m00 += sums.ones;
            m.m10 += sums.x;
            m.m01 += sums.ones * y;
            m.m20 += sums.six_xx;
            m.m11 += sums.x * y;
            m.m02 += sums.ones * y * y;
            m.m30 += sums.xxx;
            m.m21 += sums.six_xx * y;
            m.m12 += sums.x * y * y;
            m.m03 += sums.ones * y * y * y;
        }
    }
    m.m20 /= 6;
    m.m21 /= 6;
    *moments = m;
    return IRIS_OK;
}

static int within(int64_t value, int64_t most)
{
    return value >= 0 && value <= most;
}

static int are_plausible(const iris_mask_moments *m)
{
    const int64_t side = IRIS_MOMENTS_SIDE_MAX - 1;
    if (m->m00 < 1 || m->m00 > AREA_MAX) {
        return 0;
    }
    int64_t first = m->m00 * side, second = first * side, third = second * side;
    return within(m->m10, first) && within(m->m01, first) && within(m->m20, second) &&
           within(m->m11, second) && within(m->m02, second) && within(m->m30, third) &&
           within(m->m21, third) && within(m->m12, third) && within(m->m03, third);
}

/* Sums about a pixel next to the center of gravity: then they are small, and exact still. */
typedef struct {
    int64_t area, first[2]; /* by x and by y; at most half the area */
    int64_t second[3];      /* xx, xy, yy */
    int64_t third[4];       /* xxx, xxy, xyy, yyy */
} near_sums;

/* sum (u - a)(v - b)(w - c) from sums about 0. Differences wrap; what they end with fits when a mask has these sums. */
static int64_t third_about(const int64_t about[3], int64_t uvw, const int64_t pairs[3], const int64_t ones[3],
                           int64_t area)
{
    uint64_t a = (uint64_t)about[0], b = (uint64_t)about[1], c = (uint64_t)about[2];
    uint64_t sum = (uint64_t)uvw - a * (uint64_t)pairs[0] - b * (uint64_t)pairs[1] - c * (uint64_t)pairs[2];
    sum += a * b * (uint64_t)ones[2] + a * c * (uint64_t)ones[1] + b * c * (uint64_t)ones[0];
    return (int64_t)(sum - a * b * c * (uint64_t)area);
}

static near_sums about_center(const iris_mask_moments *m)
{
    int64_t n = m->m00, x = (m->m10 + n / 2) / n, y = (m->m01 + n / 2) / n;
    near_sums s = {.area = n, .first = {m->m10 - x * n, m->m01 - y * n}};
    s.second[0] = m->m20 - 2 * x * m->m10 + x * x * n;
    s.second[1] = m->m11 - x * m->m01 - y * m->m10 + x * y * n;
    s.second[2] = m->m02 - 2 * y * m->m01 + y * y * n;
    /* clang-format off */
    const int64_t xxx[3] = {x, x, x}, xxy[3] = {x, x, y}, xyy[3] = {x, y, y}, yyy[3] = {y, y, y};
    s.third[0] = third_about(xxx, m->m30, (const int64_t[]){m->m20, m->m20, m->m20},
                             (const int64_t[]){m->m10, m->m10, m->m10}, n);
    s.third[1] = third_about(xxy, m->m21, (const int64_t[]){m->m11, m->m11, m->m20},
                             (const int64_t[]){m->m10, m->m10, m->m01}, n);
    s.third[2] = third_about(xyy, m->m12, (const int64_t[]){m->m02, m->m11, m->m11},
                             (const int64_t[]){m->m10, m->m01, m->m01}, n);
    s.third[3] = third_about(yyy, m->m03, (const int64_t[]){m->m02, m->m02, m->m02},
                             (const int64_t[]){m->m01, m->m01, m->m01}, n);
    /* clang-format on */
    return s;
}

static int64_t limited(int64_t value, int64_t most)
{
    return value > most ? most : value < -most ? -most : value;
}

/* wide * 2^MU_BITS / by. */
static int64_t divided(iris_wide wide, int64_t by)
{
    for (int i = 0; i < MU_BITS; i++) {
        wide = iris_wide_add(wide, wide);
    }
    return limited(iris_wide_div_sat(wide, by), MOST);
}

/* mu of two axes, a and b: 0 for x, 1 for y. */
static int64_t mu_second(const near_sums *s, int a, int b)
{
    iris_wide sum = iris_wide_mul(s->second[a + b], s->area);
    return divided(iris_wide_sub(sum, iris_wide_mul(s->first[a], s->first[b])), s->area);
}

/* mu of three: t - (r s + r s + r s) / n + 2 r r r / n^2. */
static int64_t mu_third(const near_sums *s, int a, int b, int c)
{
    const int64_t *r = s->first, n = s->area;
    iris_wide sum = iris_wide_mul(s->third[a + b + c], n * n);
    sum = iris_wide_sub(sum, iris_wide_mul(r[a] * n, s->second[b + c]));
    sum = iris_wide_sub(sum, iris_wide_mul(r[b] * n, s->second[a + c]));
    sum = iris_wide_sub(sum, iris_wide_mul(r[c] * n, s->second[a + b]));
    sum = iris_wide_add(sum, iris_wide_mul(2 * r[a] * r[b], r[c]));
    return divided(sum, n * n);
}

static int64_t eta_second(int64_t mu_q6, int64_t area)
{
    iris_wide wide = iris_wide_mul(mu_q6, (int64_t)1 << (ETA_BITS - MU_BITS));
    return limited(iris_wide_div_sat(wide, area * area), ETA_MAX);
}

static int64_t eta_third(int64_t mu_q6, int64_t area)
{
    int64_t root = iris_sqrt_u64((uint64_t)area << (2 * ROOT_BITS));
    iris_wide wide = iris_wide_mul(mu_q6, (int64_t)1 << (ETA_BITS - MU_BITS));
    int64_t over_square = iris_wide_div_sat(wide, area * area);
    return limited(iris_wide_div_sat(iris_wide_mul(over_square, (int64_t)1 << ROOT_BITS), root), ETA_MAX);
}

static int64_t times(int64_t a_q40, int64_t b_q40)
{
    return limited(iris_wide_round_shift_sat(iris_wide_mul(a_q40, b_q40), ETA_BITS), MOST / 4);
}

static void set_hu(int64_t hu_q40[7], const iris_invariants *v)
{
    int64_t difference = v->eta20_q40 - v->eta02_q40;
    int64_t p = v->eta30_q40 - 3 * v->eta12_q40, q = 3 * v->eta21_q40 - v->eta03_q40;
    int64_t s = v->eta30_q40 + v->eta12_q40, t = v->eta21_q40 + v->eta03_q40;
    int64_t ss = times(s, s), tt = times(t, t);
    int64_t by_s = times(s, limited(ss - 3 * tt, MOST)), by_t = times(t, limited(3 * ss - tt, MOST));
    hu_q40[0] = v->eta20_q40 + v->eta02_q40;
    hu_q40[1] = times(difference, difference) + 4 * times(v->eta11_q40, v->eta11_q40);
    hu_q40[2] = times(p, p) + times(q, q);
    hu_q40[3] = ss + tt;
    hu_q40[4] = times(p, by_s) + times(q, by_t);
    hu_q40[5] = times(difference, ss - tt) + 4 * times(v->eta11_q40, times(s, t));
    hu_q40[6] = times(q, by_s) - times(p, by_t);
    for (int i = 0; i < 7; i++) {
        hu_q40[i] = limited(hu_q40[i], MOST);
    }
}

iris_status iris_moments_invariants(iris_invariants *invariants, const iris_mask_moments *moments)
{
    if (!invariants || !moments) {
        return IRIS_ERR_ARG;
    }
    if (!are_plausible(moments)) {
        return IRIS_ERR_RANGE;
    }
    near_sums s = about_center(moments);
    int64_t n = s.area;
    iris_invariants *v = invariants;
    v->x_q16 = (iris_q16)((moments->m10 * 65536 + n / 2) / n);
    v->y_q16 = (iris_q16)((moments->m01 * 65536 + n / 2) / n);
    v->mu20_q6 = mu_second(&s, 0, 0);
    v->mu11_q6 = mu_second(&s, 0, 1);
    v->mu02_q6 = mu_second(&s, 1, 1);
    v->mu30_q6 = mu_third(&s, 0, 0, 0);
    v->mu21_q6 = mu_third(&s, 0, 0, 1);
    v->mu12_q6 = mu_third(&s, 0, 1, 1);
    v->mu03_q6 = mu_third(&s, 1, 1, 1);
    v->eta20_q40 = eta_second(v->mu20_q6, n);
    v->eta11_q40 = eta_second(v->mu11_q6, n);
    v->eta02_q40 = eta_second(v->mu02_q6, n);
    v->eta30_q40 = eta_third(v->mu30_q6, n);
    v->eta21_q40 = eta_third(v->mu21_q6, n);
    v->eta12_q40 = eta_third(v->mu12_q6, n);
    v->eta03_q40 = eta_third(v->mu03_q6, n);
    set_hu(v->hu_q40, v);
    return IRIS_OK;
}
