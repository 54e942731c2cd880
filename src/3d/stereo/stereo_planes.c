#include "stereo_planes.h"

#include <string.h>

#include "stereo_pick.h"

#define ONE (1 << IRIS_STEREO_FRACTION)

/* --- one disparity each --- */

/* At most (25 * 3 + 24 * 2) * 8 * 56, which is below 2^16. */
static void sum_window(uint16_t *sums, const iris_stereo_level *l, const iris_stereo_window *window)
{
    memset(sums, 0, sizeof *sums * (size_t)l->steps);
    for (int32_t k = 0; k < window->count; k++) {
        if (window->member[k].weight > 0) {
            iris_row_weigh_u16(sums, l->costs + (size_t)window->member[k].tile * (size_t)l->steps,
                               (uint16_t)window->member[k].weight, l->steps);
        }
    }
}

void iris_stereo_match_flat(const iris_stereo_level *level, iris_stereo_window *window, uint16_t *sums)
{
    for (int32_t i = 0; i < level->count; i++) {
        iris_stereo_patch *p = &level->patches[i];
        int32_t inside = p->x + p->w / 2; /* larger ones are left of the other picture */
        iris_stereo_window_gather(window, level, p);
        sum_window(sums, level, window);
        uint16_t found = iris_stereo_best(sums, (inside < level->most ? inside : level->most) + 1);
        p->d = found <= 1 ? 0 : found << (IRIS_STEREO_FRACTION - 8);
        p->cost = (uint16_t)(64u * sums[(found + 128) >> 8] / window->weight);
    }
}

/* --- planes --- */

/* Where the parabola through three costs is lowest, the middle one being the least. */
static int32_t lowest(uint32_t before, uint32_t least, uint32_t behind)
{
    int32_t bend = (int32_t)(before + behind - 2 * least);
    return bend > 0 ? (int32_t)((int64_t)(ONE / 2) * ((int32_t)before - (int32_t)behind) / bend) : 0;
}

static int32_t size_of(int32_t n)
{
    return n < 0 ? -n : n;
}

/* Is it nearly the plane that the patch has: nowhere in it a quarter of a pixel away? */
static int is_like(const iris_stereo_patch *p, int32_t d, int32_t a, int32_t b)
{
    int32_t far = size_of(a - p->a) * (p->w / 2) + size_of(b - p->b) * (p->h / 2);
    return size_of(d - p->d) + far < ONE / 4;
}

/* The plane, moved by up to a pixel to where it is best, becomes the patch's if it explains the window better. */
static void try_plane(iris_stereo_patch *p, const iris_stereo_level *l, const iris_stereo_window *window,
                      int32_t d, const int32_t slopes[2])
{
    int32_t a = slopes[0], b = slopes[1];
    if (is_like(p, d, a, b)) {
        return;
    }
    uint32_t cost = iris_stereo_window_cost(window, l, d, a, b);
    if (cost > p->cost + p->cost / 8u) {
        return;
    }
    uint32_t before = iris_stereo_window_cost(window, l, d - ONE, a, b);
    uint32_t behind = iris_stereo_window_cost(window, l, d + ONE, a, b);
    if (before < cost || behind < cost) {
        int32_t step = before < behind ? -ONE : ONE;
        uint32_t beyond = iris_stereo_window_cost(window, l, d + 2 * step, a, b), was = cost;
        cost = step < 0 ? before : behind;
        before = step < 0 ? beyond : was;
        behind = step < 0 ? was : beyond;
        d += step;
    }
    if (cost < p->cost) {
        int32_t most = l->most * ONE;
        d += cost <= before && cost <= behind ? lowest(before, cost, behind) : 0;
        p->d = d < 0 ? 0 : d > most ? most : d;
        p->a = a;
        p->b = b;
        p->cost = (uint16_t)cost;
    }
}

/* Sums over points; x and y in half pixels, z with its fraction. */
typedef struct {
    int64_t n, x, y, xx, xy, yy, z, xz, yz;
} moments;

static void add_point(moments *m, int32_t x, int32_t y, int32_t z)
{
    m->n++;
    m->x += x;
    m->y += y;
    m->xx += x * x;
    m->xy += x * y;
    m->yy += y * y;
    m->z += z;
    m->xz += (int64_t)x * z;
    m->yz += (int64_t)y * z;
}

/* Least squares. *z: where x and y are 0; slopes: by pixel. 0: the points do not tell, or the plane is too steep. */
static int solve(int32_t *z, int32_t slopes[2], const moments *m)
{
    int64_t xx = m->n * m->xx - m->x * m->x, xy = m->n * m->xy - m->x * m->y, yy = m->n * m->yy - m->y * m->y;
    int64_t xz = m->n * m->xz - m->x * m->z, yz = m->n * m->yz - m->y * m->z;
    int64_t det = xx * yy - xy * xy;
    if (det <= 0) {
        return 0;
    }
    int64_t a = (xz * yy - yz * xy) / det, b = (yz * xx - xz * xy) / det;
    if (a > ONE / 2 || a < -ONE / 2 || b > ONE / 2 || b < -ONE / 2) {
        return 0;
    }
    *z = (int32_t)((m->z - a * m->x - b * m->y) / m->n);
    slopes[0] = (int32_t)(2 * a);
    slopes[1] = (int32_t)(2 * b);
    return 1;
}

/* The plane through the middles of the patches around, those that may lie on one surface with this. */
static void fit(iris_stereo_patch *p, const iris_stereo_level *l, const iris_stereo_window *window)
{
    moments m = {0};
    for (int32_t k = 0; k < window->count; k++) {
        const iris_stereo_patch *other = &l->patches[l->owner[window->member[k].tile]];
        int32_t x = 2 * (other->x - p->x) + other->w - p->w, y = 2 * (other->y - p->y) + other->h - p->h;
        int32_t far = (x < 0 ? -x : x) + (y < 0 ? -y : y), z = other->d - p->d;
        int32_t most = ONE * 3 / 4 + far * (ONE / 5);
        if (z <= most && -z <= most) {
            add_point(&m, x, y, z);
        }
    }
    int32_t z, slopes[2];
    if (solve(&z, slopes, &m)) {
        try_plane(p, l, window, p->d + z, slopes);
    }
}

/* The patch of a tile; null if the tile to the left of it or above it in the window has the same. */
static const iris_stereo_patch *another(const iris_stereo_level *l, const iris_stereo_window *window,
                                        int32_t k)
{
    int32_t own = l->owner[window->member[k].tile];
    int known = (k % window->across > 0 && l->owner[window->member[k - 1].tile] == own) ||
                (k >= window->across && l->owner[window->member[k - window->across].tile] == own);
    return known ? NULL : &l->patches[own];
}

static void take_over(iris_stereo_patch *p, const iris_stereo_level *l, const iris_stereo_window *window)
{
    for (int32_t k = 0; k < window->count; k++) {
        const iris_stereo_patch *other = another(l, window, k);
        if (other && other != p) {
            const int32_t slopes[2] = {other->a, other->b};
            int32_t d = iris_stereo_plane_at(other, 2 * p->x + p->w - 1, 2 * p->y + p->h - 1, l->most);
            try_plane(p, l, window, d, slopes);
        }
    }
}

void iris_stereo_match_planes(const iris_stereo_level *level, iris_stereo_window *window)
{
    for (int32_t i = 0; i < level->count; i++) {
        iris_stereo_window_gather(window, level, &level->patches[i]);
        fit(&level->patches[i], level, window);
        take_over(&level->patches[i], level, window);
    }
}
