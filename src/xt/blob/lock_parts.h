/* The steps of a lock: what is seen in a frame, and what of it is the object. */
#ifndef IRIS_XT_LOCK_PARTS_H
#define IRIS_XT_LOCK_PARTS_H

#include "iris/xt/lock.h"
#include "signature_cells.h"

/* A blob, or several that are taken for one. */
typedef struct {
    iris_rect box;
    int64_t x_q16, y_q16;
    int32_t area;
    iris_color color;
    uint8_t is_part;          /* 1: of something larger of the same color, */
    int16_t whole_w, whole_h; /* which is so large; 0: several times larger than the object */
    int32_t whole_area;
} iris_lock_thing;
typedef char iris_lock_thing_fits[sizeof(iris_lock_thing) <= IRIS_LOCK_THING_BYTES ? 1 : -1];

/* What is in a frame. */
typedef struct {
    const iris_image *frame;
    iris_image mask;
    iris_blob *blobs;
    int32_t blob_count;
    iris_lock_thing *things; /* candidates; room for one more than blobs */
    int32_t thing_count;
} iris_lock_view;

/* Fills view: pixels of the signature, and their blobs. Takes IRIS_LOCK_LOOK_BYTES. */
iris_status iris_lock_look(iris_lock_view *view, const iris_lock *lock, const iris_image *frame,
                           iris_scratch *scratch);

/* Makes things of the blobs: each with those around it, the nearest first, while all of them fit into this size. */
void iris_lock_group(iris_lock_view *view, iris_size most);

/* The selected pixels in a part of the frame, which need not be wholly inside. */
iris_lock_thing iris_lock_pixels_in(const iris_lock_view *view, iris_rect part);

/* The selected pixels in a window of this size around the center of `thing`, and then around theirs. Its color stays.
 * area 0: there are none. */
iris_lock_thing iris_lock_window(const iris_lock_view *view, const iris_lock_thing *thing, iris_size size);

/* What was taught: the object, area 0 when it cannot be told from what is around it, and its colors. */
typedef struct {
    iris_lock_thing thing;
    iris_signature_lesson colors;
} iris_lock_lesson;

/* Learns the object in scene->rect, or the whole of which the rectangle shows a part. view is then
 * of the frame taught. Takes IRIS_LOCK_SCRATCH_BYTES. */
iris_status iris_lock_learn(iris_lock_lesson *lesson, iris_lock_view *view, const iris_lock *lock,
                            const iris_signature_scene *scene, iris_scratch *scratch);

/* How far from where it should be the object may well be, at least a pixel. */
int64_t iris_lock_reach(const iris_lock *lock);
int64_t iris_lock_length(int64_t dx_q16, int64_t dy_q16);

static inline iris_lock_stranger iris_lock_stranger_at(const iris_rect *box)
{
    return (iris_lock_stranger){(int16_t)box->x, (int16_t)box->y, (int16_t)box->w, (int16_t)box->h};
}

/* How unlike what is expected a thing is: 256 is as much as is usual. */
typedef struct {
    int32_t place, size, color, stranger;
} iris_lock_cost;

#define IRIS_LOCK_COST_MOST 2048 /* at which it is something else */

iris_lock_cost iris_lock_cost_of(const iris_lock *lock, const iris_lock_thing *thing);

/* Y, U, and V in sixteenths. */
typedef struct {
    int32_t y, u, v;
} iris_lock_yuv;
iris_lock_yuv iris_lock_yuv_of(iris_color color);
int32_t iris_lock_color_cost(iris_lock_yuv is, iris_lock_yuv was);

/* What is in view beside the object: where it was found, or, null, what of the strangers is still there. */
void iris_lock_note_strangers(iris_lock *lock, const iris_lock_view *view, const iris_rect *object);

#endif
