/* Whether there is a circle where the accumulator has a peak. */
#include <string.h>

#include "hough_circle_parts.h"

#define BINS        128 /* half pixels of distance */
#define SUPPORT_MAX 32768
#define SECTORS     32
#define LINE_BAND   768 /* three pixels */
#define SLACK       256 /* a pixel; until the middle of a line is known, two */

/* The points of a ring whose direction is that of the radius, one after the other. */
typedef struct {
    const circle_search *s;
    int32_t x_q4, y_q4;        /* the center */
    int32_t near2_q8, far2_q8; /* squared bounds of the ring; below 2^30 */
    int32_t next;              /* of the points gathered */
    int32_t all;               /* points of the ring so far, of any direction */
    /* the point: */
    const iris_edge_point *point;
    int32_t dx_q4, dy_q4, distance2_q8, sideways_q5;
    int inward; /* it is brighter inside */
} ring;

static int32_t at_least(int32_t value, int32_t low)
{
    return value < low ? low : value;
}

static ring ring_around(const circle_search *s, const hypothesis *c, int32_t band_q8)
{
    int32_t near_q4 = at_least((c->r_q8 - band_q8) / 16, 0), far_q4 = (c->r_q8 + band_q8) / 16;
    return (ring){.s = s,
                  .x_q4 = c->x_q8 / 16,
                  .y_q4 = c->y_q8 / 16,
                  .near2_q8 = near_q4 * near_q4,
                  .far2_q8 = far_q4 * far_q4};
}

/* Squared cosines, 4 fraction bits: of 26 degrees, and of 41 for as long as the center is not known well. */
#define ALONG       13
#define ALONG_ABOUT 9

/* Is the direction of the point within such an angle of the radius, inwards for bright discs, outwards for dark ones?
 */
static int points_along(ring *r, const iris_edge_point *p, uint32_t cosine2_q4)
{
    const iris_circle_polarity polarity = r->s->config.polarity;
    const int16_t *direction = r->s->sines + 2 * ((uint16_t)p->angle / (65536 / DIRECTIONS));
    int32_t outward_q5 = (direction[0] * r->dx_q4 + direction[1] * r->dy_q4) >> 13;
    if (outward_q5 < 0 ? polarity == IRIS_CIRCLE_DARK : polarity == IRIS_CIRCLE_BRIGHT) {
        return 0;
    }
    r->inward = outward_q5 < 0;
    r->sideways_q5 = (direction[0] * r->dy_q4 - direction[1] * r->dx_q4) >> 13;
    /* with 10 fraction bits; both below 2^31 */
    return (uint32_t)(outward_q5 * outward_q5) >= (uint32_t)(r->distance2_q8 / 4) * cosine2_q4;
}

/* Is it in the ring? No farther than 2^15 from the center. */
static int is_inside(ring *r, const iris_edge_point *p)
{
    r->point = p;
    r->dx_q4 = p->x * 16 - r->x_q4;
    r->dy_q4 = p->y * 16 - r->y_q4;
    r->distance2_q8 = r->dx_q4 * r->dx_q4 + r->dy_q4 * r->dy_q4;
    return r->distance2_q8 >= r->near2_q8 && r->distance2_q8 <= r->far2_q8;
}

static int ring_next(ring *r)
{
    while (r->next < r->s->near_count) {
        const iris_edge_point *p = &r->s->near[r->next++];
        if (is_inside(r, p)) {
            r->all++;
            if (points_along(r, p, ALONG)) {
                return 1;
            }
        }
    }
    return 0;
}

/* The first point of a row, given by its first and its end, that is not left of x. */
static int32_t first_from(const iris_edge_point *points, int32_t first, int32_t end, int32_t x)
{
    while (first < end) {
        int32_t middle = first + (end - first) / 2;
        if (points[middle].x < x) {
            first = middle + 1;
        } else {
            end = middle;
        }
    }
    return first;
}

typedef enum { GATHER_ALL, GATHER_ALONG, TAKE } purpose;

/* Hands the points of a ring that support no circle yet to the test, all or those that point along, about; or makes
 * those that do support this one. */
static void walk(circle_search *s, const hypothesis *c, int32_t band_q8, purpose of)
{
    ring r = ring_around(s, c, band_q8);
    const int32_t far = (c->r_q8 + band_q8) / 256 + 1, x = r.x_q4 >> 4, y = r.y_q4 >> 4;
    const int32_t bottom = y + far + 2 > s->size.h ? s->size.h : y + far + 2;
    s->near_count = of == TAKE ? s->near_count : 0;
    for (int32_t row = at_least(y - far, 0); row < bottom; row++) {
        const int32_t end = s->row_first[row + 1];
        int32_t i = first_from(s->points, s->row_first[row], end, x - far);
        for (; i < end && s->points[i].x <= x + far + 1; i++) {
            const iris_edge_point *p = &s->points[i];
            if (!is_inside(&r, p) || (s->taken[i / 32] >> i % 32 & 1)) {
                continue;
            }
            const int fits = of == GATHER_ALL || points_along(&r, p, of == TAKE ? ALONG : ALONG_ABOUT);
            if (of == TAKE) {
                s->taken[i / 32] |= (uint32_t)fits << i % 32;
            } else {
                s->near[s->near_count] = *p; /* the next one takes its place if it does not fit */
                s->near_count += fits;
            }
        }
    }
}

/* Sets the radius to where, within `reach` of it, most points lie in a band of this half width. Returns how many. */
static int32_t find_radius(hypothesis *c, const circle_search *s, int32_t reach_q8, int32_t half_q8)
{
    uint16_t count[BINS] = {0};
    const int32_t r_q4 = c->r_q8 / 16, bins = reach_q8 / 64 + 1, width = half_q8 / 64 + 1;
    const int64_t inverse = (int64_t)1048576 * 8 / r_q4; /* of the diameter in pixels, 20 fraction bits */
    ring r = ring_around(s, c, reach_q8);
    while (ring_next(&r)) {
        int32_t beyond_q8 = (int32_t)(((r.distance2_q8 - r_q4 * r_q4) * inverse) >> 20);
        int32_t bin = (beyond_q8 + reach_q8) >> 7;
        if (bin >= 0 && bin < bins && count[bin] < 65535) {
            count[bin]++;
        }
    }
    int32_t best = 0, best_from = 0, sum = 0;
    for (int32_t i = 0; i < bins; i++) {
        sum += count[i] - (i >= width ? count[i - width] : 0);
        if (sum > best) {
            best = sum;
            best_from = i - width + 1;
        }
    }
    if (best > 0) {
        c->r_q8 = at_least(c->r_q8 - reach_q8 + best_from * 128 + width * 64, 256);
    }
    return best;
}

/* Sums over points, counted from a whole pixel: u, v, and z = u^2 + v^2 - r^2. |u|, |v| below 2^11, |z| below 2^17 in
 * the rings that are asked for, n at most 2^15. */
typedef struct {
    int64_t n, u, v, uu, uv, vv, z, uz, vz;
} sums;

static int64_t largest(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* Moves the center by least squares of z - 2 a u - 2 b v - c. 0 when the points do not say where it is. */
static int solve(hypothesis *c, const sums *m, int32_t x, int32_t y, int32_t r)
{
    int64_t uu = m->n * m->uu - m->u * m->u, vv = m->n * m->vv - m->v * m->v, uv = m->n * m->uv - m->u * m->v;
    int64_t uz = m->n * m->uz - m->u * m->z, vz = m->n * m->vz - m->v * m->z;
    int shift = 0;
    while (largest(uu, vv) >> shift >= (int64_t)1 << 26) {
        shift++;
    }
    uu >>= shift, vv >>= shift, uv >>= shift, uz >>= shift, vz >>= shift;
    const int64_t limit = (int64_t)1 << 33, determinant = uu * vv - uv * uv;
    if (determinant <= (uu + vv) * (uu + vv) / 1024 || determinant < 256 || largest(uz, -uz) > limit ||
        largest(vz, -vz) > limit) {
        return 0;
    }
    int64_t a_q8 = (uz * vv - vz * uv) / (determinant >> 7 > 0 ? determinant >> 7 : 1);
    int64_t b_q8 = (vz * uu - uz * uv) / (determinant >> 7 > 0 ? determinant >> 7 : 1);
    if (largest(a_q8, -a_q8) > 65536 || largest(b_q8, -b_q8) > 65536) {
        return 0;
    }
    int64_t square_q16 = (int64_t)r * r * 65536 + a_q8 * a_q8 + b_q8 * b_q8 +
                         (m->z * 65536 - 512 * (a_q8 * m->u + b_q8 * m->v)) / m->n;
    if (square_q16 < 65536) {
        return 0;
    }
    c->x_q8 = x * 256 + (int32_t)a_q8;
    c->y_q8 = y * 256 + (int32_t)b_q8;
    c->r_q8 = (int32_t)iris_sqrt_u64((uint64_t)square_q16);
    return 1;
}

/* The circle that fits the points of a band around it best. */
static int fit(hypothesis *c, const circle_search *s, int32_t band_q8)
{
    sums m = {0};
    const int32_t x = (c->x_q8 + 128) >> 8, y = (c->y_q8 + 128) >> 8, radius = (c->r_q8 + 128) >> 8;
    ring r = ring_around(s, c, band_q8);
    while (m.n < SUPPORT_MAX && ring_next(&r)) {
        int32_t u = r.point->x - x, v = r.point->y - y;
        int32_t z = u * u + v * v - radius * radius;
        m.n++;
        m.u += u;
        m.v += v;
        m.uu += u * u;
        m.uv += u * v;
        m.vv += v * v;
        m.z += z;
        m.uz += (int64_t)u * z;
        m.vz += (int64_t)v * z;
    }
    return m.n >= 5 && solve(c, &m, x, y, radius);
}

/* Which of 32 sectors around the center a vector is in: eight in each quadrant, by |y| / (|x| + |y|). */
static int32_t sector_of(int32_t x, int32_t y)
{
    int32_t across = x < 0 ? -x : x, down = y < 0 ? -y : y;
    int32_t part = down * 8 / at_least(across + down, 1);
    return (part > 7 ? 7 : part) + (x < 0 ? 8 : 0) + (y < 0 ? 16 : 0);
}

/* How far from a circle its points are. */
static int32_t band_of(const hypothesis *c)
{
    return 384 + c->r_q8 / 32;
}

/* What supports a circle. */
typedef struct {
    int32_t votes, all;
    uint32_t seen; /* sectors */
    /* sums of squares: of the sine of the angle between direction and radius, times r, 10 fraction bits (each below
     * 2^28); of the distance from the circle, times 2 r, 8 fraction bits (each below 2^41) */
    int64_t sideways, beyond;
} support;

/* Points that it is brighter outside of, inside of, and both. */
static void support_of(support by[3], const hypothesis *c, const circle_search *s)
{
    const int32_t r2_q8 = (c->r_q8 / 16) * (c->r_q8 / 16);
    ring r = ring_around(s, c, band_of(c));
    by[0] = by[1] = (support){0};
    while (by[0].votes + by[1].votes < SUPPORT_MAX && ring_next(&r)) {
        const int32_t beyond_q4 = (r.distance2_q8 - r2_q8) / 16;
        support *t = &by[r.inward];
        t->votes++;
        t->sideways += (int64_t)r.sideways_q5 * r.sideways_q5;
        t->beyond += (int64_t)beyond_q4 * beyond_q4;
        t->seen |= (uint32_t)1 << sector_of(r.dx_q4, r.dy_q4);
    }
    by[0].all = by[1].all = r.all;
    by[2] = (support){by[0].votes + by[1].votes, r.all, by[0].seen | by[1].seen,
                      by[0].sideways + by[1].sideways, by[0].beyond + by[1].beyond};
}

/* Points that a circle has by chance have any direction and distance that counts: the mean square of the sine is 1/16
 * then, that of the distance a third of the band's. A circle's points have a tenth of that. 0 to 2048: as by chance. */
static int64_t scatter_of(const support *t, const hypothesis *c)
{
    const int64_t r2_q8 = (int64_t)c->r_q8 * c->r_q8 / 256, band2_q16 = (int64_t)band_of(c) * band_of(c);
    int64_t turned_q10 = t->sideways / t->votes * 16 * 256 / r2_q8;
    int64_t distance2_q16 = t->beyond / t->votes * 64 * 256 / r2_q8;
    return turned_q10 + distance2_q16 * 3 * 1024 / band2_q16;
}

/* The votes, fewer the more they scatter; 0 when they are not enough, or not more than chance would bring: the more of
 * the circumference there is, and the fewer other points are in the band, the more they may scatter. */
static int32_t weight_of(const support *t, const hypothesis *c, const iris_circle_config *config)
{
    int32_t sectors = 0;
    for (uint32_t seen = t->seen; seen != 0; seen &= seen - 1) {
        sectors++;
    }
    /* of 2 pi r; a whole circle of pixels has an eighth more than that */
    int64_t share_permil = (int64_t)t->votes * 40744 / c->r_q8, around_permil = sectors * 1000 / SECTORS;
    if (share_permil < config->min_share_permil || around_permil < config->min_share_permil ||
        t->votes < config->min_votes || t->votes == 0) {
        return 0;
    }
    share_permil = share_permil * 8 / 9;
    share_permil = around_permil < share_permil ? around_permil : share_permil;
    /* scatter / 1024 at most share * votes / all * 1.25, of a circle that is nearly whole up to 1.7 */
    int64_t scatter = scatter_of(t, c), times_permil = share_permil * 17 / 10;
    times_permil = times_permil < 1250 ? 1250 : times_permil;
    int is_neat = scatter * t->all * 1000 <= share_permil * times_permil * t->votes * 1024 / 1000;
    return is_neat ? (int32_t)(t->votes - t->votes * scatter / 2048) : 0;
}

/* Counts what supports the circle, of one polarity or both. Returns its weight; 0: not enough. */
static int32_t measure(hypothesis *c, const circle_search *s)
{
    support by[3];
    int32_t best = 0;
    support_of(by, c, s);
    for (int i = 0; i < 3; i++) {
        int32_t weight = weight_of(&by[i], c, &s->config);
        if (weight > best) {
            best = weight;
            c->votes = by[i].votes;
        }
    }
    return best;
}

/* Is the center in the picture, and the radius asked for, or beyond the bounds by no more than `slack`? */
static int is_asked_for(const hypothesis *c, const circle_search *s, int32_t slack_q8)
{
    slack_q8 = at_least(c->r_q8 / 16, slack_q8);
    return c->x_q8 >= -128 && c->y_q8 >= -128 && c->x_q8 < s->size.w * 256 - 128 &&
           c->y_q8 < s->size.h * 256 - 128 && c->r_q8 >= s->config.radius_min * 256 - slack_q8 &&
           c->r_q8 <= s->config.radius_max * 256 + slack_q8;
}

/* Are these the points of a circle? */
static int are_enough(int32_t points, const hypothesis *c, const circle_search *s)
{
    return (int64_t)points * 40744 * 5 / 4 >= (int64_t)s->config.min_share_permil * c->r_q8;
}

int iris_circle_test(hypothesis *circle, circle_search *s)
{
    const int32_t cell_q8 = cell_of(&s->config, circle->r_q8 / 256) * 256;
    walk(s, circle, cell_q8 * 2 + 768, GATHER_ALONG);
    int32_t points = find_radius(circle, s, cell_q8 * 3 / 2 + 256, cell_q8 / 2 + 256);
    if (!are_enough(points, circle, s) || !fit(circle, s, cell_q8 / 2 + 384) ||
        !is_asked_for(circle, s, 2 * SLACK)) {
        return 0;
    }
    points = find_radius(circle, s, cell_q8 / 2 + 640, 320);
    if (!are_enough(points, circle, s) || !fit(circle, s, band_of(circle)) || measure(circle, s) == 0 ||
        !fit(circle, s, band_of(circle)) || !is_asked_for(circle, s, 2 * SLACK)) {
        return 0;
    }
    walk(s, circle, band_of(circle) + 16, GATHER_ALL);
    circle->votes = measure(circle, s); /* a neat circle comes before one of two edges */
    return circle->votes > 0;
}

/* The edges of a thin line along the circle lie to both sides of its middle: then the circle moves there. 1 when it
 * does. */
static int find_middle(hypothesis *c, const circle_search *s)
{
    hypothesis middle = *c;
    for (int i = 0; i < 2; i++) {
        int32_t points = find_radius(&middle, s, LINE_BAND + 256, LINE_BAND - 128);
        if (points * 4 <= c->votes * 5 || !fit(&middle, s, LINE_BAND) || !is_asked_for(&middle, s, SLACK)) {
            return 0;
        }
    }
    *c = middle;
    return 1;
}

int iris_circle_take(hypothesis *circle, circle_search *s)
{
    int32_t band = band_of(circle);
    walk(s, circle, at_least(band, 2 * LINE_BAND), GATHER_ALL);
    if (measure(circle, s) == 0) {
        return 0;
    }
    if (s->config.polarity == IRIS_CIRCLE_EITHER && find_middle(circle, s)) {
        band = LINE_BAND;
    }
    if (!is_asked_for(circle, s, SLACK)) {
        return 0;
    }
    walk(s, circle, band + 256, TAKE);
    return 1;
}
