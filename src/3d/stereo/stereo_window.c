#include "stereo_window.h"

#define TILE IRIS_STEREO_TILE

/* Weights of tiles: of the patch, and outside of it. */
enum { OWN = 3, ALIKE = 2 };

#define ALIKE_LEVELS 10 /* at most so many gray levels are between the means of what is alike */

/* Tiles that a side of a patch touches, and one more at each end. */
static void reach(int32_t *first, int32_t *last, int32_t at, int32_t side, int32_t count)
{
    *first = at / TILE - 1 < 0 ? 0 : at / TILE - 1;
    *last = (at + side - 1) / TILE + 1 >= count ? count - 1 : (at + side - 1) / TILE + 1;
}

/* 0: it only lies beside the window. */
static uint32_t weight_of(const iris_stereo_level *l, const iris_stereo_patch *p, int32_t x, int32_t y)
{
    int32_t apart = l->means[y * l->columns + x] - p->mean;
    int inside = x >= p->x / TILE && x <= (p->x + p->w - 1) / TILE && y >= p->y / TILE &&
                 y <= (p->y + p->h - 1) / TILE;
    return inside ? OWN : apart <= ALIKE_LEVELS && -apart <= ALIKE_LEVELS ? ALIKE : 0;
}

void iris_stereo_window_gather(iris_stereo_window *window, const iris_stereo_level *level,
                               const iris_stereo_patch *patch)
{
    int32_t left, right, top, bottom;
    reach(&left, &right, patch->x, patch->w, level->columns);
    reach(&top, &bottom, patch->y, patch->h, level->rows);
    window->count = 0;
    window->across = right - left + 1;
    window->weight = 0;
    for (int32_t y = top; y <= bottom; y++) {
        for (int32_t x = left; x <= right; x++) {
            int32_t k = window->count++;
            window->member[k].tile = y * level->columns + x;
            window->member[k].dx = (int16_t)(2 * (TILE * x - patch->x) + TILE - patch->w);
            window->member[k].dy = (int16_t)(2 * (TILE * y - patch->y) + TILE - patch->h);
            window->member[k].weight = weight_of(level, patch, x, y);
            window->weight += window->member[k].weight;
        }
    }
}

uint32_t iris_stereo_window_cost(const iris_stereo_window *window, const iris_stereo_level *level, int32_t d,
                                 int32_t a, int32_t b)
{
    const int32_t most = level->most << IRIS_STEREO_FRACTION;
    const int32_t half_a = a / 2, half_b = b / 2, start = d + (1 << (IRIS_STEREO_FRACTION - 1));
    uint32_t sum = 0;
    for (int32_t k = 0; k < window->count; k++) {
        if (window->member[k].weight > 0) {
            int32_t at = start + half_a * window->member[k].dx + half_b * window->member[k].dy;
            at = at < 0 ? 0 : at > most ? most : at;
            sum += window->member[k].weight *
                   level->costs[(size_t)window->member[k].tile * (size_t)level->steps +
                                (size_t)(at >> IRIS_STEREO_FRACTION)];
        }
    }
    return 64 * sum / window->weight;
}
