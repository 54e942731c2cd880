#include "lock_parts.h"

#define WHOLE_AT_MOST 16 /* times the rectangle: it is the object, of which the rectangle shows a part */

/* The thing in the rectangle: the largest whose center is in it and that is not much larger; else all pixels there. */
static iris_lock_thing thing_in(iris_lock_view *view, const iris_rect *rect, iris_color color)
{
    const iris_size most = {rect->w + rect->w / 2 + 2, rect->h + rect->h / 2 + 2};
    iris_lock_thing best = {.box = *rect, .area = 0, .color = color};
    iris_lock_group(view, (iris_size){rect->w + rect->w / 4, rect->h + rect->h / 4});
    for (int32_t i = 0; i < view->thing_count; i++) {
        const iris_lock_thing *thing = &view->things[i];
        int64_t x = thing->x_q16 >> 16, y = thing->y_q16 >> 16;
        int is_in = x >= rect->x && y >= rect->y && x < rect->x + rect->w && y < rect->y + rect->h;
        if (is_in && thing->box.w <= most.w && thing->box.h <= most.h && thing->area > best.area) {
            best = *thing;
        }
    }
    if (best.area * INT64_C(6) < (int64_t)rect->w * rect->h) {
        best.area = 1;
        best.x_q16 = ((int64_t)2 * rect->x + rect->w - 1) << 15;
        best.y_q16 = ((int64_t)2 * rect->y + rect->h - 1) << 15;
        best = iris_lock_window(view, &best, (iris_size){rect->w + rect->w / 4, rect->h + rect->h / 4});
    }
    return best;
}

static iris_lock_thing nothing_in(const iris_rect *rect, iris_color color)
{
    return (iris_lock_thing){.box = *rect,
                             .x_q16 = ((int64_t)2 * rect->x + rect->w - 1) << 15,
                             .y_q16 = ((int64_t)2 * rect->y + rect->h - 1) << 15,
                             .color = color};
}

/* What of the frame has the colors learned. */
static iris_status see(iris_lock_lesson *lesson, iris_lock_view *view, const iris_lock *lock,
                       const iris_signature_scene *scene, iris_scratch *scratch)
{
    const iris_status status = iris_lock_look(view, lock, scene->image, scratch);
    if (status == IRIS_OK) {
        lesson->thing = thing_in(view, &scene->rect, lesson->colors.color);
        if (lesson->thing.area == 0) {
            lesson->thing = nothing_in(&scene->rect, lesson->colors.color);
        }
    }
    return status;
}

/* The rest of a blob, of which `in` pixels have this color, has the same? */
static int is_same_behind(const iris_blob *blob, int32_t in, iris_color color)
{
    const iris_lock_yuv all = iris_lock_yuv_of(blob->mean), inner = iris_lock_yuv_of(color);
    const int64_t n = blob->area, rest = n - in;
    const iris_lock_yuv outer = {(int32_t)((all.y * n - (int64_t)inner.y * in) / rest),
                                 (int32_t)((all.u * n - (int64_t)inner.u * in) / rest),
                                 (int32_t)((all.v * n - (int64_t)inner.v * in) / rest)};
    return iris_lock_color_cost(outer, inner) < 256;
}

static int has(const iris_rect *box, int32_t x, int32_t y)
{
    return x >= box->x && y >= box->y && x < box->x + box->w && y < box->y + box->h;
}

/* Is the rectangle, corners and all, within something of its color that may be an object? Then *whole is that blob, the
 * largest around the center, and *area its area, else 0. The colors are taken as they are, whatever else has them. */
static iris_status find_whole(iris_rect *whole, int32_t *area, const iris_lock *lock,
                              const iris_signature_scene *scene, iris_scratch *scratch)
{
    iris_lock_view view;
    iris_signature_lesson lesson;
    const iris_rect *rect = &scene->rect;
    const iris_signature_scene alone = {scene->image, *rect, NULL, 1};
    const iris_blob *best = NULL;
    const int64_t taught = (int64_t)rect->w * rect->h, frame = (int64_t)lock->size.w * lock->size.h;
    const size_t mark = iris_scratch_mark(scratch);
    iris_status status = iris_signature_learn(&lesson, lock->signatures, lock->which, &alone, scratch);
    status = status == IRIS_OK ? iris_lock_look(&view, lock, scene->image, scratch) : status;
    for (int32_t i = 0; status == IRIS_OK && i < view.blob_count; i++) { /* the largest first */
        if (!best && has(&view.blobs[i].box, rect->x + rect->w / 2, rect->y + rect->h / 2)) {
            best = &view.blobs[i];
        }
    }
    *area = 0;
    if (best && best->area * INT64_C(2) > taught * 3 && best->area <= taught * WHOLE_AT_MOST &&
        best->area * INT64_C(4) <= frame) {
        const int32_t in = iris_lock_pixels_in(&view, *rect).area;
        if (in * INT64_C(8) >= taught * 7 && is_same_behind(best, in, lesson.color)) {
            *area = best->area;
            *whole = best->box;
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}

/* Learns the whole; 0 when it then cannot be found. */
static int learn_whole(iris_lock_lesson *lesson, iris_lock_view *view, const iris_lock *lock,
                       const iris_signature_scene *scene, iris_scratch *scratch)
{
    iris_lock_lesson of_whole;
    iris_signature_scene whole = *scene;
    int32_t area;
    const size_t mark = iris_scratch_mark(scratch);
    if (find_whole(&whole.rect, &area, lock, scene, scratch) == IRIS_OK && area > 0 &&
        iris_signature_learn(&of_whole.colors, lock->signatures, lock->which, &whole, scratch) == IRIS_OK &&
        see(&of_whole, view, lock, &whole, scratch) == IRIS_OK) {
        const int64_t seen = of_whole.thing.area;
        if (seen * 3 > area * INT64_C(2) && seen * 2 < area * INT64_C(3)) {
            *lesson = of_whole;
            return 1;
        }
    }
    iris_scratch_release(scratch, mark);
    return 0;
}

iris_status iris_lock_learn(iris_lock_lesson *lesson, iris_lock_view *view, const iris_lock *lock,
                            const iris_signature_scene *scene, iris_scratch *scratch)
{
    uint8_t *kept = (uint8_t *)iris_scratch_take(scratch, IRIS_SIGNATURE_KEPT_BYTES);
    const uint32_t bit = 1u << lock->which;
    iris_status status = kept ? iris_signature_teach(&lesson->colors, lock->signatures, lock->which,
                                                     scene->image, scene->rect, scratch)
                              : IRIS_ERR_SCRATCH;
    if (status != IRIS_OK) {
        return status;
    }
    iris_signature_keep(kept, lock->signatures, bit);
    if (learn_whole(lesson, view, lock, scene, scratch)) {
        return IRIS_OK;
    }
    iris_signature_restore(lock->signatures, bit, kept);
    return see(lesson, view, lock, scene, scratch);
}
