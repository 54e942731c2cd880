/* For the tests of blobs: what they are, by flooding pixel after pixel and counting what is around each. */
#ifndef IRIS_TEST_BLOB_TRUTH_H
#define IRIS_TEST_BLOB_TRUTH_H

#include "iris/xt/blob.h"
#include "shape_mask.h"

#define TRUTHS_MAX 90000

static iris_blob truths[TRUTHS_MAX];
static int32_t truth_count;
static int32_t owner[SHAPE_SIDE_MAX][SHAPE_SIDE_MAX]; /* number of the blob, 0: none */

static inline int owned(const shape *s, int32_t x, int32_t y, int32_t by)
{
    return x >= 0 && y >= 0 && x < s->w && y < s->h && owner[y][x] == by;
}

/* Floods the blob at (x, y) and gives it a number. */
static inline void truth_flood(const shape *s, int32_t x, int32_t y, int32_t number, int connectivity)
{
    static int32_t stack[SHAPE_SIDE_MAX * SHAPE_SIDE_MAX];
    static const int32_t dx[8] = {1, -1, 0, 0, 1, 1, -1, -1}, dy[8] = {0, 0, 1, -1, 1, -1, 1, -1};
    int32_t used = 0;
    owner[y][x] = number;
    stack[used++] = y * s->w + x;
    while (used > 0) {
        int32_t i = stack[--used];
        for (int k = 0; k < connectivity; k++) {
            int32_t to_x = i % s->w + dx[k], to_y = i / s->w + dy[k];
            if (shape_at(s, to_x, to_y) && owner[to_y][to_x] == 0) {
                owner[to_y][to_x] = number;
                stack[used++] = to_y * s->w + to_x;
            }
        }
    }
}

/* Edges and corners, from the pixels around each pixel and around each corner of one. */
static inline void truth_outline(iris_blob *b, const shape *s, int32_t number)
{
    for (int32_t y = b->box.y; y <= b->box.y + b->box.h; y++) {
        for (int32_t x = b->box.x; x <= b->box.x + b->box.w; x++) {
            int here = owned(s, x, y, number), left = owned(s, x - 1, y, number);
            int up = owned(s, x, y - 1, number), both = owned(s, x - 1, y - 1, number);
            b->edges += (here != left) + (here != up);
            int count = here + left + up + both;
            b->corners += count == 1 || count == 3 ? 1 : count == 2 && here == both ? 2 : 0;
        }
    }
}

/* Parts of the rest within the box and a margin, less the outside. */
static inline int32_t truth_holes(const iris_blob *b, const shape *s, int32_t number, int connectivity)
{
    static shape rest;
    static int32_t kept[SHAPE_SIDE_MAX][SHAPE_SIDE_MAX];
    rest.w = b->box.w + 2;
    rest.h = b->box.h + 2;
    if (rest.w > SHAPE_SIDE_MAX || rest.h > SHAPE_SIDE_MAX) {
        fail();
    }
    for (int32_t y = 0; y < rest.h; y++) {
        for (int32_t x = 0; x < rest.w; x++) {
            rest.at[y][x] = !owned(s, b->box.x + x - 1, b->box.y + y - 1, number);
        }
    }
    int32_t holes = -1;
    for (int32_t y = 0; y < rest.h; y++) {
        memcpy(kept[y], owner[y], sizeof kept[y]);
        memset(owner[y], 0, sizeof owner[y]);
    }
    for (int32_t i = 0; i < rest.w * rest.h; i++) {
        if (rest.at[i / rest.w][i % rest.w] && owner[i / rest.w][i % rest.w] == 0) {
            truth_flood(&rest, i % rest.w, i / rest.w, 1, connectivity == 8 ? 4 : 8);
            holes++;
        }
    }
    for (int32_t y = 0; y < rest.h; y++) {
        memcpy(owner[y], kept[y], sizeof kept[y]);
    }
    return holes;
}

static inline void truth_add(iris_blob *b, int32_t x, int32_t y)
{
    int32_t right = b->box.x + b->box.w;
    if (b->area == 0) {
        b->first_x = x;
        b->box = (iris_rect){x, y, 1, 1};
        right = x + 1;
    }
    b->area++;
    b->box.x = x < b->box.x ? x : b->box.x;
    b->box.w = (x >= right ? x + 1 : right) - b->box.x;
    b->box.h = y - b->box.y + 1;
    iris_moments *m = &b->moments;
    m->n++;
    m->x += x;
    m->y += y;
    m->xx += (int64_t)x * x;
    m->xy += (int64_t)x * y;
    m->yy += (int64_t)y * y;
}

static inline int truth_order(const void *a, const void *b)
{
    const iris_blob *p = a, *q = b;
    if (p->area != q->area) {
        return p->area > q->area ? -1 : 1;
    }
    int32_t down = p->box.y - q->box.y, right = p->first_x - q->first_x;
    return down != 0 ? down : right;
}

/* color: h rows of w pixels of `channels` bytes, or null. */
static inline void truth_means(const shape *s, const uint8_t *color, int channels)
{
    static int64_t sums[TRUTHS_MAX + 1][3];
    memset(sums, 0, sizeof sums[0] * (size_t)(truth_count + 1));
    for (int32_t i = 0; i < s->w * s->h; i++) {
        for (int c = 0; c < 3; c++) {
            sums[owner[i / s->w][i % s->w]][c] += color[i * channels + (channels == 3 ? c : 0)];
        }
    }
    for (int32_t i = 0; i < truth_count; i++) {
        double area = truths[i].area;
        truths[i].mean = (iris_color){(uint8_t)((double)sums[i + 1][0] / area + 0.5),
                                      (uint8_t)((double)sums[i + 1][1] / area + 0.5),
                                      (uint8_t)((double)sums[i + 1][2] / area + 0.5)};
    }
}

/* The truth about a shape, in the table's order. */
static inline void truth_of(const shape *s, int connectivity, const uint8_t *color, int channels)
{
    memset(owner, 0, sizeof owner[0] * (size_t)s->h);
    truth_count = 0;
    for (int32_t y = 0; y < s->h; y++) {
        for (int32_t x = 0; x < s->w; x++) {
            if (s->at[y][x] && owner[y][x] == 0) {
                assert_true(truth_count < TRUTHS_MAX);
                truths[truth_count++] = (iris_blob){.area = 0};
                truth_flood(s, x, y, truth_count, connectivity);
            }
            if (s->at[y][x]) {
                truth_add(&truths[owner[y][x] - 1], x, y);
            }
        }
    }
    for (int32_t i = 0; i < truth_count; i++) {
        iris_blob *b = &truths[i];
        b->x_q16 = (iris_q16)((double)b->moments.x * 65536.0 / b->area + 0.5);
        b->y_q16 = (iris_q16)((double)b->moments.y * 65536.0 / b->area + 0.5);
        truth_outline(b, s, i + 1);
        b->holes = truth_holes(b, s, i + 1, connectivity);
    }
    if (color) {
        truth_means(s, color, channels);
    }
    qsort(truths, (size_t)truth_count, sizeof truths[0], truth_order);
}

static inline int blob_equal(const iris_blob *a, const iris_blob *b)
{
    const iris_moments *m = &a->moments, *n = &b->moments;
    return memcmp(m, n, sizeof *m) == 0 && memcmp(&a->box, &b->box, sizeof a->box) == 0 &&
           a->first_x == b->first_x && a->area == b->area && a->x_q16 == b->x_q16 && a->y_q16 == b->y_q16 &&
           a->edges == b->edges && a->corners == b->corners && a->holes == b->holes &&
           memcmp(&a->mean, &b->mean, sizeof a->mean) == 0;
}

#endif
