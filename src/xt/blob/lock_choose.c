#include "../../foundation/hsl.h"
#include "lock_parts.h"
#include "signature_cells.h"

#define PLACE_MOST    1024 /* an object may jump anywhere */
#define STRANGER_COST IRIS_LOCK_COST_MOST

/* Logarithm to base 2 in 1/256, within 23. */
static int32_t log2_q8(uint32_t value)
{
    int32_t whole = 0;
    for (uint32_t rest = value; rest > 1; rest >>= 1) {
        whole++;
    }
    return 256 * whole + (int32_t)(((uint64_t)value << 8 >> whole) & 255);
}

iris_lock_yuv iris_lock_yuv_of(iris_color color)
{
    const iris_signature_yuv yuv = iris_signature_yuv_of(color.r, color.g, color.b);
    return (iris_lock_yuv){16 * yuv.y, 16 * yuv.u, 16 * yuv.v};
}

static int32_t capped(int64_t cost, int32_t most)
{
    return cost < most ? (int32_t)cost : most;
}

/* How far from where it should be, in pixels with 16 fraction bits. */
static int64_t way_off(const iris_lock *lock, const iris_lock_thing *thing)
{
    int64_t ahead = lock->missed + 1;
    return iris_lock_length(thing->x_q16 - lock->x_q16 - ahead * lock->dx_q16,
                            thing->y_q16 - lock->y_q16 - ahead * lock->dy_q16);
}

static int32_t place_cost(const iris_lock *lock, int64_t off)
{
    int64_t reach = iris_lock_reach(lock) >> 8;
    off >>= 8;
    return capped(off * off * 256 / (reach * reach), PLACE_MOST);
}

static int64_t squared_ratio(int64_t is, int64_t was)
{
    int64_t ratio = log2_q8((uint32_t)is) - log2_q8((uint32_t)was);
    return ratio * ratio / 256;
}

/* Of the area, and of the sides, so that a stripe is no ball. */
static int32_t size_cost(const iris_lock *lock, const iris_lock_thing *thing)
{
    int64_t sides = squared_ratio((int64_t)16 * thing->box.w, lock->w_q4) +
                    squared_ratio((int64_t)16 * thing->box.h, lock->h_q4);
    return capped((squared_ratio(thing->area, lock->area) + sides) / 2, 4096);
}

int32_t iris_lock_color_cost(iris_lock_yuv is, iris_lock_yuv was)
{
    int64_t du = is.u - was.u, dv = is.v - was.v, dy = is.y - was.y;
    int64_t chroma = iris_sqrt_u32((uint32_t)(was.u * was.u + was.v * was.v));
    int64_t tint = 16 * 6 + chroma / 4, light = 16 * 36;
    return capped((du * du + dv * dv) * 256 / (tint * tint) + dy * dy * 256 / (light * light), 4096);
}

static int32_t color_cost(const iris_lock *lock, const iris_lock_thing *thing)
{
    return iris_lock_color_cost(iris_lock_yuv_of(thing->color),
                                (iris_lock_yuv){lock->y_q4, lock->u_q4, lock->v_q4});
}

static int is_near(const iris_lock_stranger *s, const iris_rect *box)
{
    int32_t dx = 2 * box->x + box->w - (2 * s->x + s->w), dy = 2 * box->y + box->h - (2 * s->y + s->h);
    return (dx < 0 ? -dx : dx) <= s->w + 4 && (dy < 0 ? -dy : dy) <= s->h + 4;
}

static int is_stranger(const iris_lock *lock, const iris_rect *box)
{
    for (int32_t i = 0; i < lock->stranger_count; i++) {
        if (is_near(&lock->strangers[i], box)) {
            return 1;
        }
    }
    return 0;
}

int64_t iris_lock_reach(const iris_lock *lock)
{
    int64_t diagonal = ((int64_t)lock->w_q4 + lock->h_q4) * 2896; /* q4 to q16, times sqrt(1/2) */
    int64_t speed = iris_lock_length(lock->dx_q16, lock->dy_q16);
    int64_t reach = diagonal / 2 + speed / 2 + lock->error_q16 + lock->missed * (diagonal + speed) / 4;
    int64_t most = (int64_t)(lock->size.w > lock->size.h ? lock->size.w : lock->size.h) << 15;
    reach = lock->seen < 2 || reach > most ? most : reach;
    return reach < 65536 ? 65536 : reach;
}

iris_lock_cost iris_lock_cost_of(const iris_lock *lock, const iris_lock_thing *thing)
{
    iris_lock_cost cost = {0, size_cost(lock, thing), color_cost(lock, thing), 0};
    int64_t off = way_off(lock, thing), itself = ((int64_t)lock->w_q4 + lock->h_q4) << 10;
    int is_lost = lock->missed > lock->config.coast_frames;
    cost.place = is_lost ? 0 : place_cost(lock, off);
    if (is_lost || (off > itself && (lock->seen < 2 || cost.place > 128))) {
        cost.stranger = is_stranger(lock, &thing->box) ? STRANGER_COST : 0;
    }
    return cost;
}

/* ---- strangers ---- */

/* Strangers that are still in view where they were, or near it, are now where they are. */
static void follow_strangers(iris_lock *lock, const iris_lock_view *view)
{
    for (int32_t i = 0; i < lock->stranger_count; i++) {
        for (int32_t k = 0; k < view->blob_count; k++) {
            const iris_rect *box = &view->blobs[k].box;
            if (is_near(&lock->strangers[i], box)) {
                lock->strangers[i] = iris_lock_stranger_at(box);
                break;
            }
        }
    }
}

void iris_lock_note_strangers(iris_lock *lock, const iris_lock_view *view, const iris_rect *object)
{
    if (!object) {
        follow_strangers(lock, view);
        return;
    }
    const iris_lock_stranger self = iris_lock_stranger_at(object);
    lock->stranger_count = 0;
    for (int32_t i = 0; i < view->blob_count && lock->stranger_count < IRIS_LOCK_STRANGERS; i++) {
        const iris_blob *blob = &view->blobs[i];
        if (blob->area >= lock->config.min_area && blob->area * INT64_C(8) >= lock->area &&
            !is_near(&self, &blob->box)) {
            lock->strangers[lock->stranger_count++] = iris_lock_stranger_at(&blob->box);
        }
    }
}
