#include "../mask/mask_runs.h"
#include "iris/color.h"
#include "lock_parts.h"

/* ---- pixels and blobs ---- */

static int is_empty(const uint32_t *row, int32_t w)
{
    iris_mask_span run;
    return !iris_mask_run(&run, row, 0, w);
}

/* Blobs by rows: those without a selected pixel need no colors. */
static iris_status find_blobs(iris_lock_view *view, const iris_lock *lock, uint8_t *rgb,
                              iris_scratch *scratch)
{
    iris_blob_scan scan;
    iris_blob_config config;
    iris_blob_table table = {view->blobs, IRIS_LOCK_BLOBS, 0};
    const iris_image *frame = view->frame;
    iris_blob_defaults(&config);
    (void)lock;
    iris_status status = iris_blob_begin(&scan, &table, (iris_size){frame->w, frame->h}, 3, &config, scratch);
    for (int32_t y = 0; status == IRIS_OK && y < frame->h; y++) {
        const uint32_t *row = (const uint32_t *)iris_image_row(&view->mask, y);
        if (!is_empty(row, frame->w)) {
            (void)iris_color_rgb_row(rgb, iris_image_row(frame, y), frame->format, frame->w);
        }
        status = iris_blob_row(&scan, row, rgb);
    }
    if (status == IRIS_OK) {
        status = iris_blob_end(&scan);
        view->blob_count = table.count < IRIS_LOCK_BLOBS ? table.count : IRIS_LOCK_BLOBS;
    }
    return status == IRIS_ERR_FULL ? IRIS_OK : status;
}

iris_status iris_lock_look(iris_lock_view *view, const iris_lock *lock, const iris_image *frame,
                           iris_scratch *scratch)
{
    const iris_size size = {frame->w, frame->h};
    const size_t mask_bytes = IRIS_LOCK_MASK_BYTES(frame->w, frame->h);
    void *mask = iris_scratch_take(scratch, mask_bytes);
    uint8_t *rgb = (uint8_t *)iris_scratch_take(scratch, 3u * (size_t)frame->w);
    *view = (iris_lock_view){.frame = frame};
    view->blobs = (iris_blob *)iris_scratch_take(scratch, IRIS_LOCK_BLOBS * sizeof(iris_blob));
    view->things =
        (iris_lock_thing *)iris_scratch_take(scratch, (IRIS_LOCK_BLOBS + 1) * IRIS_LOCK_THING_BYTES);
    if (!mask || !rgb || !view->blobs || !view->things) {
        return IRIS_ERR_SCRATCH;
    }
    iris_status status = iris_image_wrap(&view->mask, mask, mask_bytes, size, 0, IRIS_MASK1);
    if (status == IRIS_OK) {
        status = iris_signature_mask(&view->mask, frame, lock->signatures, 1u << lock->which);
    }
    return status == IRIS_OK ? find_blobs(view, lock, rgb, scratch) : status;
}

/* ---- from blobs to things ---- */

static int32_t lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static int32_t greater(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static iris_rect around(const iris_rect *a, const iris_rect *b)
{
    int32_t x = lesser(a->x, b->x), y = lesser(a->y, b->y);
    return (iris_rect){x, y, greater(a->x + a->w, b->x + b->w) - x, greater(a->y + a->h, b->y + b->h) - y};
}

static uint8_t mean(int32_t a, int32_t weight_a, int32_t b, int32_t weight_b)
{
    return (uint8_t)(((int64_t)a * weight_a + (int64_t)b * weight_b) / ((int64_t)weight_a + weight_b));
}

static iris_lock_thing thing_of(const iris_blob *blob)
{
    return (iris_lock_thing){blob->box, blob->x_q16, blob->y_q16, blob->area, blob->mean, 0, 0, 0, 0};
}

static void join(iris_lock_thing *thing, const iris_blob *blob)
{
    const int64_t n = thing->area, m = blob->area;
    const iris_color a = thing->color, b = blob->mean;
    thing->box = around(&thing->box, &blob->box);
    thing->x_q16 += (blob->x_q16 - thing->x_q16) * m / (n + m);
    thing->y_q16 += (blob->y_q16 - thing->y_q16) * m / (n + m);
    thing->color =
        (iris_color){mean(a.r, thing->area, b.r, blob->area), mean(a.g, thing->area, b.g, blob->area),
                     mean(a.b, thing->area, b.b, blob->area)};
    thing->area += blob->area;
}

/* Rows or columns between two boxes; 0 when they touch or overlap. */
static int32_t gap(const iris_rect *a, const iris_rect *b)
{
    int32_t x = greater(a->x, b->x) - lesser(a->x + a->w, b->x + b->w);
    int32_t y = greater(a->y, b->y) - lesser(a->y + a->h, b->y + b->h);
    return greater(0, greater(x, y));
}

/* The nearest blob that is not in the thing yet, fits, and is no scrap; -1: none. */
static int32_t nearest(const iris_lock_view *view, const iris_lock_thing *thing, uint32_t taken,
                       iris_size most)
{
    int32_t best = -1, best_gap = greater(2, lesser(most.w, most.h) / 3) + 1;
    for (int32_t i = 0; i < view->blob_count; i++) {
        const iris_rect *box = &view->blobs[i].box;
        iris_rect all = around(&thing->box, box);
        int32_t apart = gap(&thing->box, box);
        int is_scrap = view->blobs[i].area * INT64_C(12) < thing->area;
        if (!(taken >> i & 1) && !is_scrap && apart < best_gap && all.w <= most.w && all.h <= most.h) {
            best = i;
            best_gap = apart;
        }
    }
    return best;
}

void iris_lock_group(iris_lock_view *view, iris_size most)
{
    for (int32_t i = 0; i < view->blob_count; i++) {
        iris_lock_thing *thing = &view->things[i];
        uint32_t taken = 1u << i;
        *thing = thing_of(&view->blobs[i]);
        for (int32_t next = nearest(view, thing, taken, most); next >= 0;
             next = nearest(view, thing, taken, most)) {
            join(thing, &view->blobs[next]);
            taken |= 1u << next;
        }
    }
    view->thing_count = view->blob_count;
}

/* ---- a window ---- */

iris_lock_thing iris_lock_pixels_in(const iris_lock_view *view, iris_rect part)
{
    iris_lock_thing in = {.area = 0};
    int64_t twice_x = 0, y_sum = 0;
    int32_t left = INT32_MAX, right = -1, top = -1, bottom = -1;
    int32_t x_end = lesser(part.x + part.w, view->frame->w);
    for (int32_t y = greater(part.y, 0); y < part.y + part.h && y < view->frame->h; y++) {
        iris_mask_span run = {0, greater(part.x, 0)};
        while (iris_mask_run(&run, (const uint32_t *)iris_image_row(&view->mask, y), run.end, x_end)) {
            int64_t n = run.end - run.first;
            twice_x += n * (run.first + run.end - 1);
            y_sum += n * y;
            in.area += (int32_t)n;
            left = lesser(left, run.first);
            right = greater(right, run.end - 1);
            top = top < 0 ? y : top;
            bottom = y;
        }
    }
    if (in.area > 0) {
        in.x_q16 = twice_x * 32768 / in.area;
        in.y_q16 = y_sum * 65536 / in.area;
        in.box = (iris_rect){left, top, right - left + 1, bottom - top + 1};
    }
    return in;
}

static iris_rect centered(int64_t x_q16, int64_t y_q16, iris_size size)
{
    return (iris_rect){(int32_t)((x_q16 + 32768) >> 16) - size.w / 2,
                       (int32_t)((y_q16 + 32768) >> 16) - size.h / 2, size.w, size.h};
}

iris_lock_thing iris_lock_window(const iris_lock_view *view, const iris_lock_thing *thing, iris_size size)
{
    iris_lock_thing in = *thing;
    for (int i = 0; i < 2 && in.area > 0; i++) {
        in = iris_lock_pixels_in(view, centered(in.x_q16, in.y_q16, size));
    }
    in.color = thing->color;
    return in;
}
