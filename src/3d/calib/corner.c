/* A corner of a chessboard: see board_find.h for the method. */
#include "corner.h"

#define TURN     32 /* places on the rings, and */
#define HALF     (TURN / 2)
#define RINGS    3
#define SIXTH    (TURN / 8)
#define CONTRAST 10  /* levels between bright and dark, at least */
#define STEPS    12  /* of settling, at most */
#define ENOUGH   128 /* 1/512 pixel */

/* Cosines of 32nds of a turn, 256 for 1. */
static const int16_t COSINES[TURN] = {256,  251,  237,  213,  181,  142,  98,   50,   0,    -50,  -98,
                                      -142, -181, -213, -237, -251, -256, -251, -237, -213, -181, -142,
                                      -98,  -50,  0,    50,   98,   142,  181,  213,  237,  251};

static int32_t within(int32_t a, int32_t low, int32_t high)
{
    return a < low ? low : a > high ? high : a;
}

static int32_t size_of(int32_t a)
{
    return a < 0 ? -a : a;
}

/* The level at a place in 1/256 pixel, between four pixels; 256 for one level. Beyond the edge its pixels go on. */
static int32_t level_at(const iris_image *picture, int32_t x, int32_t y)
{
    x = within(x, 0, (picture->w - 1) * 256);
    y = within(y, 0, (picture->h - 1) * 256);
    const int32_t left = x >> 8, top = y >> 8, right = left + (left < picture->w - 1);
    const uint8_t *upper = iris_image_row(picture, top);
    const uint8_t *lower = iris_image_row(picture, top + (top < picture->h - 1));
    const int32_t above = upper[left] * 256 + (upper[right] - upper[left]) * (x & 255);
    const int32_t below = lower[left] * 256 + (lower[right] - lower[left]) * (x & 255);
    return above + (((below - above) >> 8) * (y & 255));
}

/* --- where it is --- */

typedef struct {
    int64_t xx, xy, yy, x, y; /* sums of the products of gradients; and of them times the way */
} sums;

/* All pixels within the radius around a place count, the less the further off. Ways begin at pixel `middle`. */
static void sum_up(sums *sum, const iris_image *picture, const iris_q16 place[2], const int32_t middle[2],
                   int32_t radius)
{
    const int32_t reach = radius * radius * 256;
    const int32_t left = within(middle[0] - radius, 1, picture->w - 1),
                  right = within(middle[0] + radius, 0, picture->w - 2);
    const int32_t top = within(middle[1] - radius, 1, picture->h - 1),
                  bottom = within(middle[1] + radius, 0, picture->h - 2);
    for (int32_t y = top; y <= bottom; y++) {
        const uint8_t *above = iris_image_row(picture, y - 1), *row = iris_image_row(picture, y),
                      *below = iris_image_row(picture, y + 1);
        const int32_t dy = (y * 65536 - place[1]) / 4096;
        for (int32_t x = left; x <= right; x++) {
            const int32_t dx = (x * 65536 - place[0]) / 4096; /* 1/16 pixel */
            const int32_t share = reach - (dx * dx + dy * dy);
            if (share <= 0) {
                continue;
            }
            const int32_t part = share * 64 / reach, weight = part * part;
            const int32_t gx = 3 * (above[x + 1] - above[x - 1] + below[x + 1] - below[x - 1]) +
                               10 * (row[x + 1] - row[x - 1]);
            const int32_t gy =
                3 * (below[x - 1] - above[x - 1] + below[x + 1] - above[x + 1]) + 10 * (below[x] - above[x]);
            const int64_t xx = (int64_t)(gx * gx) * weight, xy = (int64_t)(gx * gy) * weight,
                          yy = (int64_t)(gy * gy) * weight;
            sum->xx += xx;
            sum->xy += xy;
            sum->yy += yy;
            sum->x += xx * (x - middle[0]) + xy * (y - middle[1]);
            sum->y += xy * (x - middle[0]) + yy * (y - middle[1]);
        }
    }
}

/* The place of the least squares, from pixel `middle`. Returns 0 when edges go one way only. */
static int solve(iris_q16 place[2], sums sum)
{
    while (sum.xx > 1 << 26 || sum.yy > 1 << 26) {
        sum = (sums){sum.xx >> 1, sum.xy >> 1, sum.yy >> 1, sum.x >> 1, sum.y >> 1};
    }
    const int64_t across = sum.xx * sum.yy - sum.xy * sum.xy;
    if (across < 1 << 30 || across < (sum.xx * sum.yy) >> 4) {
        return 0;
    }
    place[0] = iris_sat_s32((sum.yy * sum.x - sum.xy * sum.y) / (across >> 16));
    place[1] = iris_sat_s32((sum.xx * sum.y - sum.xy * sum.x) / (across >> 16));
    return 1;
}

int iris_corner_settle(iris_q16 place[2], const iris_image *picture, int32_t radius)
{
    const iris_q16 start[2] = {place[0], place[1]};
    iris_q16 at[2] = {place[0], place[1]};
    for (int k = 0; k < STEPS; k++) {
        const int32_t middle[2] = {iris_q16_to_int(at[0]), iris_q16_to_int(at[1])};
        iris_q16 next[2];
        sums sum = {0, 0, 0, 0, 0};
        sum_up(&sum, picture, at, middle, radius);
        if (!solve(next, sum)) {
            return 0;
        }
        int32_t moved = 0, away = 0;
        for (int i = 0; i < 2; i++) {
            next[i] = iris_add_sat(next[i], middle[i] * 65536);
            moved += size_of(within(next[i] - at[i], -(1 << 28), 1 << 28));
            away += size_of(within(next[i] - start[i], -(1 << 28), 1 << 28));
            at[i] = next[i];
        }
        if (away > radius * 65536 || at[0] < 65536 || at[1] < 65536 || at[0] > (picture->w - 2) * 65536 ||
            at[1] > (picture->h - 2) * 65536) {
            return 0;
        }
        if (moved < ENOUGH || (k == STEPS - 1 && moved < 16 * ENOUGH)) {
            place[0] = at[0];
            place[1] = at[1];
            return 1;
        }
    }
    return 0;
}

/* --- what it looks like --- */

/* The levels of half a turn, each the sum over the rings of both opposite places; 0 when these differ much. */
static int half_turn(int32_t levels[HALF], const iris_image *picture, iris_candidate *corner)
{
    int32_t differ = 0, low = INT32_MAX, high = 0;
    for (int k = 0; k < HALF; k++) {
        int32_t side[2] = {0, 0};
        for (int ring = 0; ring < RINGS; ring++) {
            const int32_t dx = (ring + 3) * COSINES[k], dy = (ring + 3) * COSINES[(k + 24) % TURN];
            side[0] += level_at(picture, corner->x + dx, corner->y + dy) >> 4;
            side[1] += level_at(picture, corner->x - dx, corner->y - dy) >> 4;
        }
        levels[k] = side[0] + side[1];
        differ += size_of(side[0] - side[1]);
        low = levels[k] < low ? levels[k] : low;
        high = levels[k] > high ? levels[k] : high;
    }
    if (high - low < CONTRAST * 16 * 2 * RINGS || differ >= (high - low) * (HALF / 4)) {
        return 0;
    }
    corner->uneven = (int16_t)(differ * 1000 / ((high - low) * HALF));
    return 1;
}

int iris_corner_look(iris_candidate *corner, const iris_image *picture)
{
    int32_t levels[HALF], low = INT32_MAX, high = 0;
    int32_t changes = 0, where[2] = {0, 0};
    if (!half_turn(levels, picture, corner)) {
        return 0;
    }
    for (int k = 0; k < HALF; k++) {
        low = levels[k] < low ? levels[k] : low;
        high = levels[k] > high ? levels[k] : high;
    }
    const int32_t limit = low + (high - low) / 2;
    for (int k = 0; k < HALF; k++) {
        const int32_t from = levels[k], to = levels[(k + 1) % HALF];
        if ((from > limit) != (to > limit)) {
            where[to > limit ? 0 : 1] = k * 2048 + 2048 * (limit - from) / (to - from);
            changes++;
        }
    }
    const int32_t between = (where[1] - where[0]) & 32767; /* the bright part of half a turn */
    if (changes != 2 || between < 2 * 2048 || between > 32768 - 2 * 2048) {
        return 0;
    }
    corner->axis[0] = iris_angle_wrap(where[0]);
    corner->axis[1] = iris_angle_wrap(where[0] + between);
    corner->size = (int16_t)((high - low) / (16 * 2 * RINGS));
    return 1;
}

/* Is a way along an axis, to 20 degrees? */
static int is_along(iris_angle axis, int32_t dx, int32_t dy)
{
    const int64_t c = iris_cos_q30(axis) >> 16, s = iris_sin_q30(axis) >> 16;
    const int64_t along = c * dx + s * dy, across = c * dy - s * dx;
    return (across < 0 ? -across : across) * 11 < (along < 0 ? -along : along) * 4;
}

int iris_corner_joined(const iris_candidate *a, const iris_candidate *b, int bright_side,
                       const iris_image *picture)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    const int32_t length = (int32_t)iris_hypot(dx, dy), least = (a->size < b->size ? a->size : b->size) * 64;
    if (length < 3 * 256 || !is_along(a->axis[bright_side ? 0 : 1], dx, dy) ||
        !is_along(b->axis[bright_side ? 1 : 0], dx, dy)) {
        return 0;
    }
    const int32_t off = within(length / 8, 320, 1024); /* to both sides of the edge */
    const int32_t ox = (int32_t)(-(int64_t)dy * off / length), oy = (int32_t)((int64_t)dx * off / length);
    for (int k = 1; k <= 5; k++) {
        const int32_t x = a->x + (int32_t)((int64_t)dx * k / 6), y = a->y + (int32_t)((int64_t)dy * k / 6);
        const int32_t more = level_at(picture, x + ox, y + oy) - level_at(picture, x - ox, y - oy);
        if ((bright_side ? more : -more) < least) {
            return 0;
        }
    }
    return 1;
}
