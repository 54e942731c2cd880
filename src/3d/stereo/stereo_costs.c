#include "stereo_costs.h"

#include <string.h>

static int32_t between(int32_t a, int32_t least, int32_t most)
{
    return a < least ? least : a > most ? most : a;
}

static iris_status check_config(const iris_stereo_config *config)
{
    int good = config->max_disparity >= 1 && config->max_disparity <= IRIS_STEREO_DISPARITY_MAX &&
               (unsigned)config->cost <= IRIS_STEREO_BOTH && config->check_px >= 0 &&
               config->check_px <= 255 && config->uniqueness_percent >= 0 && config->uniqueness_percent <= 99;
    return good ? IRIS_OK : IRIS_ERR_ARG;
}

static iris_status check_views(const iris_image *disparity, const iris_image *left, const iris_image *right)
{
    const iris_image *views[] = {disparity, left, right};
    for (int i = 0; i < 3; i++) {
        iris_status status = iris_image_check(views[i]);
        if (status != IRIS_OK) {
            return status;
        }
    }
    if (disparity->format != IRIS_GRAY_U16 || left->format != IRIS_GRAY8 || right->format != IRIS_GRAY8) {
        return IRIS_ERR_FORMAT;
    }
    if (left->w != right->w || left->h != right->h || left->w != disparity->w || left->h != disparity->h) {
        return IRIS_ERR_RANGE;
    }
    int meet = iris_image_overlaps(disparity, left) || iris_image_overlaps(disparity, right);
    return meet ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_stereo_check(const iris_image *disparity, const iris_image *left, const iris_image *right,
                              const iris_stereo_config *config)
{
    iris_status status = check_config(config);
    return status == IRIS_OK ? check_views(disparity, left, right) : status;
}

/* 0 when there is too little. */
static int take_rows(iris_stereo_rows *rows, size_t w, size_t most, iris_scratch *scratch)
{
    int good = 1;
    for (int k = 0; k < 4; k++) {
        rows->right[k] = iris_scratch_take(scratch, w + most);
        good &= rows->right[k] != NULL;
    }
    for (int k = 0; k < 3; k++) {
        rows->left[k] = iris_scratch_take(scratch, w);
        good &= rows->left[k] != NULL;
    }
    return good;
}

iris_status iris_stereo_costs_begin(iris_stereo_costs *c, const iris_image *left, const iris_image *right,
                                    const iris_stereo_config *config, int32_t side, iris_scratch *scratch)
{
    size_t w = (size_t)left->w, most = (size_t)config->max_disparity, cells = w * (most + 1);
    *c = (iris_stereo_costs){.left = left,
                             .right = right,
                             .w = left->w,
                             .steps = config->max_disparity + 1,
                             .cost = config->cost,
                             .reach = side / 2};
    int good = take_rows(&c->enter, w, most, scratch);
    if (side > 0) {
        good = good && take_rows(&c->leave, w, most, scratch);
        c->columns = iris_scratch_take(scratch, 2 * cells);
        c->sums = iris_scratch_take(scratch, 2 * (IRIS_STEREO_PIECE + 1) * (most + 1));
        c->last = iris_scratch_take(scratch, 2 * (most + 1));
        good = good && c->columns && c->sums && c->last;
    } else {
        c->costs = iris_scratch_take(scratch, cells);
        good = good && c->costs;
    }
    return good ? IRIS_OK : IRIS_ERR_SCRATCH;
}

/* Pixels near an end of the row, `first` to `end` - 1: rows go on there as they end. */
static void census_at_end(uint8_t *const planes[3], const uint8_t *const rows[5], int32_t w, int32_t first,
                          int32_t end)
{
    uint8_t around[5][5];
    const uint8_t *const middles[5] = {around[0] + 2, around[1] + 2, around[2] + 2, around[3] + 2,
                                       around[4] + 2};
    for (int32_t x = first; x < end; x++) {
        uint8_t *const to[3] = {planes[0] + x, planes[1] + x, planes[2] + x};
        for (int k = 0; k < 25; k++) {
            around[k / 5][k % 5] = rows[k / 5][between(x + k % 5 - 2, 0, w - 1)];
        }
        iris_row_census_u8(to, middles, 1);
    }
}

/* Is each of the 24 pixels around darker? */
static void census(uint8_t *const planes[3], const iris_image *image, int32_t y)
{
    const uint8_t *rows[5];
    int32_t w = image->w, inner = w > 4 ? w - 4 : 0, left = w < 2 ? w : 2;
    for (int k = 0; k < 5; k++) {
        rows[k] = iris_image_row(image, between(y + k - 2, 0, image->h - 1));
    }
    census_at_end(planes, rows, w, 0, left);
    if (inner > 0) {
        const uint8_t *const inner_rows[5] = {rows[0] + 2, rows[1] + 2, rows[2] + 2, rows[3] + 2,
                                              rows[4] + 2};
        uint8_t *const to[3] = {planes[0] + 2, planes[1] + 2, planes[2] + 2};
        iris_row_census_u8(to, inner_rows, inner);
    }
    census_at_end(planes, rows, w, left + inner, w);
}

/* Row y of both pictures. */
static iris_row_pair prepare(const iris_stereo_costs *c, const iris_stereo_rows *rows, int32_t y)
{
    iris_row_pair pair = {.steps = c->steps};
    const int32_t w = c->w;
    const int has_census = c->cost != IRIS_STEREO_SAD, has_gray = c->cost != IRIS_STEREO_CENSUS;
    if (has_census) {
        census(rows->left, c->left, y);
        census(rows->right, c->right, y);
    }
    for (int k = has_census ? 0 : 3; k < (has_gray ? 4 : 3); k++) {
        uint8_t *right = rows->right[k];
        iris_row_reverse_u8(right, k < 3 ? right : iris_image_row(c->right, y), w);
        memset(right + w, right[w - 1], (size_t)c->steps - 1);
        pair.left[k] = k < 3 ? rows->left[k] : iris_image_row(c->left, y);
        pair.right[k] = right + w - 1;
    }
    return pair;
}

const uint8_t *iris_stereo_costs_pixels(const iris_stereo_costs *c, int32_t y)
{
    const iris_row_pair pair = prepare(c, &c->enter, y);
    iris_row_costs_u8(c->costs, &pair, c->w);
    return c->costs;
}

void iris_stereo_costs_begin_row(iris_stereo_costs *c, int32_t y)
{
    const int32_t bottom = c->left->h - 1;
    if (y == 0 || c->reach == 0) {
        memset(c->columns, 0, 2 * (size_t)c->w * (size_t)c->steps);
        for (int32_t k = -c->reach; k <= c->reach; k++) {
            const iris_row_pair enter = prepare(c, &c->enter, between(y + k, 0, bottom));
            iris_row_slide_costs_u16(c->columns, &enter, NULL, c->w);
        }
        c->moved = c->w;
    } else {
        c->entering = prepare(c, &c->enter, between(y + c->reach, 0, bottom));
        c->leaving = prepare(c, &c->leave, between(y - 1 - c->reach, 0, bottom));
        c->moved = 0;
    }
}

static uint16_t *column(const iris_stereo_costs *c, int32_t x)
{
    return c->columns + (size_t)between(x, 0, c->w - 1) * (size_t)c->steps;
}

/* The columns before `end` become those of the row. */
static void move_columns(iris_stereo_costs *c, int32_t end)
{
    iris_row_pair enter = c->entering, leave = c->leaving;
    end = end < c->w ? end : c->w;
    if (end <= c->moved) {
        return;
    }
    for (int k = 0; k < 4; k++) {
        if (enter.left[k]) {
            enter.left[k] += c->moved;
            enter.right[k] -= c->moved;
            leave.left[k] += c->moved;
            leave.right[k] -= c->moved;
        }
    }
    iris_row_slide_costs_u16(column(c, c->moved), &enter, &leave, end - c->moved);
    c->moved = end;
}

/* The window around the row's first pixel, one column after the other: the piece has room for as many. */
static void sum_first(const iris_stereo_costs *c, uint16_t *sums)
{
    const size_t bytes = 2 * (size_t)c->steps;
    memset(c->sums, 0, bytes);
    memset(c->last, 0, bytes);
    for (int32_t k = 0; k <= 2 * c->reach; k++) {
        iris_row_roll_u16(sums + (ptrdiff_t)k * c->steps, column(c, k - c->reach), c->last, c->steps, 1);
    }
    memmove(sums, sums + (ptrdiff_t)(2 * c->reach) * c->steps, bytes);
}

uint16_t *iris_stereo_costs_piece(iris_stereo_costs *c, int32_t x, int32_t count)
{
    const int32_t reach = c->reach, steps = c->steps, end = x + count;
    uint16_t *sums = c->sums + steps;
    move_columns(c, end + reach);
    if (reach == 0) {
        return column(c, x);
    }
    if (x == 0) {
        sum_first(c, sums);
    } else {
        memcpy(c->sums, c->last, 2 * (size_t)steps);
    }
    for (int32_t at = x == 0 ? 1 : x; at < end;) {
        int32_t enter = at + reach, leave = at - 1 - reach, n = 1;
        if (enter < c->w && leave >= 0) { /* so many columns enter and leave */
            n = c->w - enter < end - at ? c->w - enter : end - at;
        }
        iris_row_roll_u16(sums + (ptrdiff_t)(at - x) * steps, column(c, enter), column(c, leave), steps, n);
        at += n;
    }
    memcpy(c->last, sums + (ptrdiff_t)(count - 1) * steps, 2 * (size_t)steps);
    return sums;
}
