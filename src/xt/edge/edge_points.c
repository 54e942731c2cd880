#include "iris/xt/edge_points.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"
#include "../filter/smooth_rows.h"
#include "../mask/mask_runs.h"

/* The list while it is written: of `count` points `capacity` are kept, as evenly as they can be. */
typedef struct {
    iris_edge_point *next;
    int32_t capacity, count;
    int32_t due; /* a point is kept when this reaches count */
} selection;

static int is_kept(selection *s)
{
    if (s->count <= s->capacity) {
        return 1;
    }
    s->due += s->capacity; /* both below 2^30 */
    if (s->due < s->count) {
        return 0;
    }
    s->due -= s->count;
    return 1;
}

#define BATCH 64

/* Points whose directions are still to come, and their gradients. */
typedef struct {
    iris_edge_point *points;
    int32_t count;
    int16_t dx[BATCH], dy[BATCH];
} batch;

static void gradient_at(batch *to, const uint8_t *const rows[3], int32_t x)
{
    const uint8_t *a = rows[0] + x, *b = rows[1] + x, *c = rows[2] + x;
    to->dx[to->count] = (int16_t)(a[1] + 2 * b[1] + c[1] - a[-1] - 2 * b[-1] - c[-1]);
    to->dy[to->count] = (int16_t)(c[-1] + 2 * c[0] + c[1] - a[-1] - 2 * a[0] - a[1]);
    to->count++;
}

static void direct(batch *of)
{
    uint16_t angles[BATCH];
    iris_row_direction_s16(angles, of->dx, of->dy, 0, of->count);
    for (int32_t i = 0; i < of->count; i++) {
        of->points[i].angle = (iris_angle)angles[i];
    }
    of->points += of->count;
    of->count = 0;
}

/* The points of row y; the smoothed rows around it are there. */
static void list_row(selection *s, const iris_image *mask, const iris_smooth_rows *smooth, int32_t y)
{
    const uint8_t *const rows[3] = {iris_smooth_row(smooth, y - 1), iris_smooth_row(smooth, y),
                                    iris_smooth_row(smooth, y + 1)};
    const uint32_t *row = iris_image_row(mask, y);
    iris_mask_span run = {0, 0};
    batch some;
    some.points = s->next;
    some.count = 0;
    while (iris_mask_run(&run, row, run.end, mask->w)) {
        for (int32_t x = run.first; x < run.end; x++) {
            if (is_kept(s)) {
                *s->next++ = (iris_edge_point){(int16_t)x, (int16_t)y, 0};
                gradient_at(&some, rows, x);
            }
            if (some.count == BATCH) {
                direct(&some);
            }
        }
    }
    direct(&some);
}

static int32_t count_of(const iris_image *mask)
{
    int32_t count = 0;
    for (int32_t y = 0; y < mask->h; y++) {
        iris_mask_span run = {0, 0};
        while (iris_mask_run(&run, iris_image_row(mask, y), run.end, mask->w)) {
            count += run.end - run.first;
        }
    }
    return count;
}

/* An empty mask of src's size in working memory. */
static iris_status take_mask(iris_image *mask, const iris_image *src, iris_scratch *scratch)
{
    size_t stride = 4u * IRIS_CANNY_WORDS(src->w), bytes = stride * (size_t)src->h;
    *mask = (iris_image){iris_scratch_take(scratch, bytes), (ptrdiff_t)stride, src->w, src->h, IRIS_MASK1};
    if (!mask->data) {
        return IRIS_ERR_SCRATCH;
    }
    memset(mask->data, 0, bytes);
    return IRIS_OK;
}

iris_status iris_edge_points(iris_edge_point *points, int32_t capacity, int32_t *count, const iris_image *src,
                             const iris_canny_config *config, iris_scratch *scratch)
{
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    iris_canny_config settings;
    iris_image mask;
    iris_smooth_rows smooth;
    if (!count || capacity < 0 || (!points && capacity > 0) || !src || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(src, IRIS_GRAY8);
    if (status != IRIS_OK) {
        return status;
    }
    iris_canny_defaults(&settings);
    settings = config ? *config : settings;
    size_t start = iris_scratch_mark(scratch);
    status = take_mask(&mask, src, scratch);
    if (status == IRIS_OK) {
        status = iris_canny(&mask, src, &settings, border, scratch);
    }
    if (status == IRIS_OK) {
        status = iris_smooth_rows_begin(&smooth, src, settings.sigma_q16, border, scratch);
    }
    if (status == IRIS_OK) {
        selection s = {points, capacity, count_of(&mask), 0};
        for (int32_t y = 0; y <= src->h; y++) {
            if (y < src->h) {
                iris_smooth_rows_next(&smooth, y);
            }
            if (y > 0) {
                list_row(&s, &mask, &smooth, y - 1);
            }
        }
        *count = s.count;
        status = s.count > capacity ? IRIS_ERR_FULL : IRIS_OK;
    }
    iris_scratch_release(scratch, start);
    return status;
}
