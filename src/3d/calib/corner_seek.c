/* Candidates for corners: see board_find.h for the method. */
#include "corner.h"

#define RING     5 /* radius */
#define ALONE    3 /* a candidate is the strongest within that, in pixels */
#define ROWS     (2 * ALONE + 1)
#define RESPONSE 80

static int32_t size_of(int32_t a)
{
    return a < 0 ? -a : a;
}

/* The response of a row: pixels nearer to the edge than the ring have none. */
static void respond(int16_t *response, const iris_image *picture, int32_t y)
{
    static const int8_t ring[16][2] = {{0, -5}, {2, -5},  {3, -3},  {5, -2}, {5, 0},  {5, 2},
                                       {3, 3},  {2, 5},   {0, 5},   {-2, 5}, {-3, 3}, {-5, 2},
                                       {-5, 0}, {-5, -2}, {-3, -3}, {-2, -5}};
    const uint8_t *at[16];
    const int32_t w = picture->w;
    for (int32_t x = 0; x < w; x++) {
        response[x] = 0;
    }
    if (y < RING || y >= picture->h - RING) {
        return;
    }
    for (int k = 0; k < 16; k++) {
        at[k] = (const uint8_t *)iris_image_row(picture, y + ring[k][1]);
    }
    const uint8_t *above = iris_image_row(picture, y - 1), *row = iris_image_row(picture, y),
                  *below = iris_image_row(picture, y + 1);
    for (int32_t x = RING; x < w - RING; x++) {
        int32_t sum = 0, all = 0, differ = 0;
        for (int k = 0; k < 4; k++) {
            const int32_t a = at[k][x + ring[k][0]], b = at[k + 4][x + ring[k + 4][0]],
                          c = at[k + 8][x + ring[k + 8][0]], d = at[k + 12][x + ring[k + 12][0]];
            sum += size_of(a + c - b - d);
            differ += size_of(a - c) + size_of(b - d);
            all += a + b + c + d;
        }
        if (sum - differ > RESPONSE) {
            const int32_t middle = 16 * (row[x - 1] + row[x] + row[x + 1] + above[x] + below[x]);
            const int32_t left = sum - differ - size_of(all * 5 - middle) / 5;
            response[x] = (int16_t)(left > 0 ? left : 0);
        }
    }
}

/* Is it the strongest around? Of equal ones the first is. */
static int is_alone(const int16_t *const rows[ROWS], int32_t x)
{
    const int16_t own = rows[ALONE][x];
    for (int dy = 0; dy < ROWS; dy++) {
        for (int dx = -ALONE; dx <= ALONE; dx++) {
            const int before = dy < ALONE || (dy == ALONE && dx < 0);
            if (rows[dy][x + dx] > own || (before && rows[dy][x + dx] == own)) {
                return 0;
            }
        }
    }
    return 1;
}

/* Where the next candidate goes: the weakest makes room for a stronger one. Null: there is none. */
static iris_candidate *room_for(iris_lattice *lattice, int16_t strength, int32_t *weakest)
{
    if (lattice->count < lattice->room) {
        return &lattice->all[lattice->count];
    }
    if (*weakest < 0) {
        *weakest = 0;
        for (int32_t k = 1; k < lattice->count; k++) {
            *weakest = lattice->all[k].strength < lattice->all[*weakest].strength ? k : *weakest;
        }
    }
    return lattice->all[*weakest].strength < strength ? &lattice->all[*weakest] : NULL;
}

static void seek_row(iris_lattice *lattice, const int16_t *const rows[ROWS], int32_t y, int32_t *weakest)
{
    const iris_image *picture = lattice->picture;
    for (int32_t x = IRIS_CORNER_MARGIN; x < picture->w - IRIS_CORNER_MARGIN; x++) {
        const int16_t strength = rows[ALONE][x];
        if (strength <= RESPONSE || !is_alone(rows, x)) {
            continue;
        }
        iris_candidate *to = room_for(lattice, strength, weakest);
        iris_q16 at[2] = {x * 65536, y * 65536};
        if (to && iris_corner_settle(at, picture, 4)) {
            iris_candidate made = {.x = (int32_t)iris_round_shift(at[0], 8),
                                   .y = (int32_t)iris_round_shift(at[1], 8),
                                   .i = INT16_MAX,
                                   .j = INT16_MAX,
                                   .strength = strength};
            if (iris_corner_look(&made, picture)) {
                *to = made;
                lattice->count += to == &lattice->all[lattice->count];
                *weakest = -1;
            }
        }
    }
}

void iris_corner_seek(iris_lattice *lattice, int16_t *responses, const iris_image *picture)
{
    const int16_t *rows[ROWS];
    int32_t weakest = -1;
    lattice->picture = picture;
    lattice->count = 0;
    for (int32_t y = 0; y < picture->h; y++) {
        respond(responses + (ptrdiff_t)(y % ROWS) * picture->w, picture, y);
        if (y >= ROWS - 1) {
            for (int k = 0; k < ROWS; k++) {
                rows[k] = responses + (ptrdiff_t)((y + 1 + k) % ROWS) * picture->w;
            }
            seek_row(lattice, rows, y - ALONE, &weakest);
        }
    }
}
