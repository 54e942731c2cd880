#include "iris/xt/lock.h"

#include "iris/color.h"
#include "lock_parts.h"
#include "signature_cells.h"

#define LEARN_FRAMES 4        /* at least so many between lessons */
#define LEARN_LIGHT  (16 * 8) /* and so much change of Y, */
#define LEARN_TINT   (16 * 4) /* or of U and V */
#define LEARN_COST   700      /* of an object like it was expected */
#define SAME_COST    1024 /* of an object like the one that was lost: of half the size up to twice, or so */

void iris_lock_defaults(iris_lock_config *config)
{
    if (config) {
        *config = (iris_lock_config){5, 10, 150, 1};
    }
}

iris_status iris_lock_init(iris_lock *lock, iris_size size, iris_signatures *signatures, int32_t which,
                           const iris_lock_config *config)
{
    iris_lock_config used;
    iris_lock_defaults(&used);
    if (config) {
        used = *config;
    }
    if (!lock || !signatures || used.min_area < 1 || used.coast_frames < 0 || used.coast_frames > 10000 ||
        used.forget_frames < 0 || used.forget_frames > 1000000 || used.adapt < 0 || used.adapt > 1) {
        return IRIS_ERR_ARG;
    }
    if (which < 0 || which >= IRIS_SIGNATURES || size.w < 1 || size.w > IRIS_SIDE_MAX || size.h < 1 ||
        size.h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    *lock = (iris_lock){.config = used, .size = size, .signatures = signatures, .which = which};
    return IRIS_OK;
}

static iris_status check(const iris_lock_result *result, const iris_lock *lock, const iris_image *frame,
                         const iris_scratch *scratch)
{
    if (!result || !lock || !frame || !scratch || !lock->signatures) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(frame);
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_color_takes(frame->format)) {
        return IRIS_ERR_FORMAT;
    }
    return frame->w != lock->size.w || frame->h != lock->size.h ? IRIS_ERR_RANGE : IRIS_OK;
}

/* Is there so much memory? */
static iris_status ask(iris_scratch *scratch, size_t bytes)
{
    size_t start = iris_scratch_mark(scratch);
    iris_status status = iris_scratch_take(scratch, bytes) ? IRIS_OK : IRIS_ERR_SCRATCH;
    iris_scratch_release(scratch, start);
    return status;
}

int64_t iris_lock_length(int64_t dx_q16, int64_t dy_q16)
{
    int64_t dx = dx_q16 >> 8, dy = dy_q16 >> 8;
    return (int64_t)iris_sqrt_u64((uint64_t)(dx * dx + dy * dy)) << 8;
}

/* ---- what the object is ---- */

static void take_size_and_color(iris_lock *lock, const iris_lock_thing *thing)
{
    const iris_lock_yuv yuv = iris_lock_yuv_of(thing->color);
    lock->area = thing->area;
    lock->w_q4 = 16 * thing->box.w;
    lock->h_q4 = 16 * thing->box.h;
    lock->y_q4 = yuv.y;
    lock->u_q4 = yuv.u;
    lock->v_q4 = yuv.v;
}

static void take_place(iris_lock *lock, const iris_lock_thing *thing)
{
    lock->x_q16 = thing->x_q16;
    lock->y_q16 = thing->y_q16;
    lock->missed = 0;
    lock->seen++;
}

/* Standing still, as far as is known. */
static void take_start(iris_lock *lock, const iris_lock_thing *thing)
{
    lock->dx_q16 = lock->dy_q16 = lock->error_q16 = 0;
    lock->seen = 0;
    take_place(lock, thing);
}

/* A new object. */
static void lock_on(iris_lock *lock, const iris_lock_thing *thing)
{
    take_size_and_color(lock, thing);
    take_start(lock, thing);
    lock->id++;
    lock->age = 1;
}

/* A part of the difference, rounded to the nearest. */
static int32_t toward(int32_t from, int32_t to, int shift)
{
    return from + (int32_t)iris_round_shift((int64_t)to - from, shift);
}

/* Is much of the object hidden, as far as its area tells? Then its center is not that of what is seen. */
static int is_cut(const iris_lock *lock, const iris_lock_thing *thing)
{
    return thing->is_part || thing->area * INT64_C(8) < lock->area * INT64_C(5);
}

/* It touches something, or it is larger than was thought: after two seconds or so that is believed. */
static void follow_whole(iris_lock *lock, const iris_lock_thing *thing)
{
    if (thing->whole_area > 0) {
        lock->area = toward(lock->area, thing->whole_area + 64, 7);
        lock->w_q4 = toward(lock->w_q4, 16 * thing->whole_w, 7);
        lock->h_q4 = toward(lock->h_q4, 16 * thing->whole_h, 7);
    }
}

static void follow_size_and_color(iris_lock *lock, const iris_lock_thing *thing)
{
    const iris_lock_yuv yuv = iris_lock_yuv_of(thing->color);
    const int shift = is_cut(lock, thing) ? 4 : 2;
    if (thing->is_part) {
        follow_whole(lock, thing);
        return;
    }
    lock->area = toward(lock->area, thing->area, shift);
    lock->w_q4 = toward(lock->w_q4, 16 * thing->box.w, shift);
    lock->h_q4 = toward(lock->h_q4, 16 * thing->box.h, shift);
    lock->y_q4 = toward(lock->y_q4, yuv.y, 1);
    lock->u_q4 = toward(lock->u_q4, yuv.u, 2);
    lock->v_q4 = toward(lock->v_q4, yuv.v, 2);
}

/* The object has been seen where it may have come by itself. */
static void follow_place(iris_lock *lock, const iris_lock_thing *thing)
{
    const int64_t frames = lock->missed + 1;
    const int64_t dx = (thing->x_q16 - lock->x_q16) / frames, dy = (thing->y_q16 - lock->y_q16) / frames;
    if (lock->seen == 1) {
        lock->dx_q16 = dx;
        lock->dy_q16 = dy;
        lock->error_q16 = iris_lock_length(dx, dy) / 2;
    } else if (!is_cut(lock, thing)) {
        int64_t error = iris_lock_length(dx - lock->dx_q16, dy - lock->dy_q16);
        lock->error_q16 += (error - lock->error_q16) / 2;
        lock->dx_q16 += (dx - lock->dx_q16) * 3 / 4;
        lock->dy_q16 += (dy - lock->dy_q16) * 3 / 4;
    }
    take_place(lock, thing);
}

/* ---- which one it is ---- */

static iris_size expected_size(const iris_lock *lock, int32_t times_q4)
{
    const int64_t speed_w = lock->dx_q16 < 0 ? -lock->dx_q16 : lock->dx_q16;
    const int64_t speed_h = lock->dy_q16 < 0 ? -lock->dy_q16 : lock->dy_q16;
    return (iris_size){(int32_t)((lock->w_q4 * (int64_t)times_q4 >> 8) + (speed_w >> 17)) + 2,
                       (int32_t)((lock->h_q4 * (int64_t)times_q4 >> 8) + (speed_h >> 17)) + 2};
}

static int64_t within(int64_t value, int32_t first, int32_t count)
{
    int64_t low = (int64_t)first << 16, high = (int64_t)(first + count - 1) << 16;
    return value < low ? low : value > high ? high : value;
}

/* Several times larger than the object? */
static int is_vast(const iris_lock *lock, const iris_lock_thing *thing)
{
    const iris_size most = expected_size(lock, 27);
    return thing->box.w > most.w || thing->box.h > most.h;
}

/* Larger than the object, and not in all directions alike: what has come nearer keeps its sides' ratio, and the share
 * of its box that it fills. */
static int has_grown_oddly(const iris_lock *lock, const iris_lock_thing *thing)
{
    const int64_t w = lock->w_q4, h = lock->h_q4, new_w = 16 * thing->box.w, new_h = 16 * thing->box.h;
    const int is_larger = thing->area * INT64_C(5) > lock->area * INT64_C(8);
    const int is_wider = new_w * h * 4 > new_h * w * 5, is_taller = new_h * w * 4 > new_w * h * 5;
    const int is_emptier = thing->area * (w * h) * 5 < lock->area * (new_w * new_h) * 4;
    return is_larger && (is_wider || is_taller || is_emptier);
}

/* A thing that is more than the object: the part of it where the object should be. The pixels around it draw it away,
 * so that only half of what they say is believed. */
static iris_lock_thing part_of(const iris_lock *lock, const iris_lock_view *view,
                               const iris_lock_thing *thing)
{
    const int vast = is_vast(lock, thing);
    if (lock->seen < 2 || (!vast && !has_grown_oddly(lock, thing))) {
        return *thing;
    }
    const int64_t ahead = lock->missed + 1;
    iris_lock_thing from = *thing;
    from.x_q16 = within(lock->x_q16 + ahead * lock->dx_q16, thing->box.x, thing->box.w);
    from.y_q16 = within(lock->y_q16 + ahead * lock->dy_q16, thing->box.y, thing->box.h);
    iris_lock_thing part = iris_lock_window(view, &from, expected_size(lock, vast ? 18 : 16));
    if (part.area * INT64_C(3) < lock->area) {
        return *thing;
    }
    part.is_part = 1;
    part.x_q16 = (part.x_q16 + from.x_q16) / 2;
    part.y_q16 = (part.y_q16 + from.y_q16) / 2;
    if (!vast) {
        part.whole_area = thing->area;
        part.whole_w = (int16_t)thing->box.w;
        part.whole_h = (int16_t)thing->box.h;
    }
    return part;
}

/* The best candidate and what it costs; -1: there is none. */
static int32_t choose(iris_lock_cost *cost, const iris_lock *lock, iris_lock_view *view)
{
    int32_t best = -1, least = INT32_MAX;
    iris_lock_group(view, expected_size(lock, 24));
    for (int32_t i = 0; i < view->thing_count; i++) {
        iris_lock_thing *thing = &view->things[i];
        *thing = part_of(lock, view, thing);
        const iris_lock_cost its = iris_lock_cost_of(lock, thing);
        const int32_t sum = its.place + its.size + its.color + its.stranger;
        if (thing->area >= lock->config.min_area && sum < least) {
            best = i;
            least = sum;
            *cost = its;
        }
    }
    return best;
}

static int is_lost(const iris_lock *lock)
{
    return lock->missed > lock->config.coast_frames;
}

/* Takes the thing for the object, if it is good enough; returns 0 when it is not. */
static int accept(iris_lock *lock, const iris_lock_thing *thing, const iris_lock_cost *cost)
{
    const int32_t sum = cost->place + cost->size + cost->color + cost->stranger;
    if (!is_lost(lock) && sum < IRIS_LOCK_COST_MOST) {
        follow_place(lock, thing);
        follow_size_and_color(lock, thing);
        return 1;
    }
    if (!is_lost(lock) || sum >= IRIS_LOCK_COST_MOST) {
        return 0;
    }
    if (sum < SAME_COST && lock->missed <= lock->config.forget_frames) {
        take_start(lock, thing);
        follow_size_and_color(lock, thing);
    } else {
        lock_on(lock, thing);
    }
    return 1;
}

/* ---- learning ---- */

static int32_t distance(int32_t a, int32_t b)
{
    return a < b ? b - a : a - b;
}

static int is_inside(const iris_rect *box, iris_size size)
{
    return box->x > 0 && box->y > 0 && box->x + box->w < size.w && box->y + box->h < size.h;
}

static void note_lesson(iris_lock *lock)
{
    lock->lesson_y = lock->y_q4;
    lock->lesson_u = lock->u_q4;
    lock->lesson_v = lock->v_q4;
    lock->since_lesson = 0;
}

/* When the object is what it was, but its color is not. */
static void learn(iris_lock *lock, const iris_image *frame, const iris_rect *box, int32_t cost,
                  iris_scratch *scratch)
{
    int has_changed =
        distance(lock->y_q4, lock->lesson_y) > LEARN_LIGHT ||
        distance(lock->u_q4, lock->lesson_u) + distance(lock->v_q4, lock->lesson_v) > LEARN_TINT;
    lock->since_lesson += lock->since_lesson < LEARN_FRAMES;
    if (lock->is_taught && lock->config.adapt && has_changed && cost < LEARN_COST &&
        lock->since_lesson >= LEARN_FRAMES && is_inside(box, lock->size)) {
        const iris_signature_scene scene = {frame, *box, &lock->lesson, 0};
        (void)iris_signature_learn(NULL, lock->signatures, lock->which, &scene, scratch);
        note_lesson(lock);
    }
}

/* ---- results ---- */

static iris_lock_result found(const iris_lock *lock, const iris_lock_thing *thing, int32_t cost)
{
    int32_t score = 1000 - cost * 999 / IRIS_LOCK_COST_MOST;
    return (iris_lock_result){IRIS_LOCK_FOUND,
                              lock->id,
                              lock->age,
                              0,
                              thing->box,
                              (iris_q16)thing->x_q16,
                              (iris_q16)thing->y_q16,
                              thing->area,
                              score < 1 ? 1 : score};
}

static iris_lock_result not_found(const iris_lock *lock)
{
    iris_lock_result result = {
        .state = IRIS_LOCK_LOST, .id = lock->id, .age = lock->age, .missed = lock->missed};
    const int64_t x = lock->x_q16 + lock->missed * lock->dx_q16,
                  y = lock->y_q16 + lock->missed * lock->dy_q16;
    const int64_t right = (int64_t)lock->size.w << 16, bottom = (int64_t)lock->size.h << 16;
    if (lock->id > 0 && !is_lost(lock) && x >= 0 && y >= 0 && x < right && y < bottom) {
        const int32_t w = (lock->w_q4 + 8) / 16, h = (lock->h_q4 + 8) / 16;
        result.state = IRIS_LOCK_COASTING;
        result.x_q16 = (iris_q16)x;
        result.y_q16 = (iris_q16)y;
        result.box = (iris_rect){(int32_t)(x >> 16) - w / 2, (int32_t)(y >> 16) - h / 2, w, h};
    }
    return result;
}

/* The frame in which nothing is locked on yet: the largest blob. Returns 0 when there is none. */
static int start(iris_lock *lock, iris_lock_view *view)
{
    iris_lock_group(view, (iris_size){0, 0});
    if (view->thing_count == 0 || view->things[0].area < lock->config.min_area) {
        return 0;
    }
    lock_on(lock, &view->things[0]);
    note_lesson(lock);
    return 1;
}

static void look_for(iris_lock_result *result, iris_lock *lock, iris_lock_view *view, int32_t *sum)
{
    iris_lock_cost cost = {0, 0, 0, 0};
    const int is_first = lock->id == 0;
    int32_t chosen = 0;
    lock->age += !is_first;
    lock->age -= lock->age == INT32_MAX;
    if (is_first) {
        chosen = start(lock, view) ? 0 : -1;
    } else {
        chosen = choose(&cost, lock, view);
        chosen = chosen >= 0 && accept(lock, &view->things[chosen], &cost) ? chosen : -1;
    }
    *sum = cost.place + cost.size + cost.color + cost.stranger;
    if (chosen >= 0) {
        iris_lock_note_strangers(lock, view, &view->things[chosen].box);
        *result = found(lock, &view->things[chosen], *sum);
    } else {
        lock->missed += !is_first && lock->missed <= lock->config.forget_frames;
        iris_lock_note_strangers(lock, view, NULL);
        *result = not_found(lock);
    }
}

/* Is the object where it can be told from all else? */
static int is_clear(const iris_lock *lock, iris_lock_view *view)
{
    iris_lock_cost cost = {0, 0, 0, 0};
    const int32_t best = choose(&cost, lock, view);
    return best >= 0 && (!view->things[best].is_part || view->things[best].whole_area > 0) &&
           cost.place + cost.size + cost.color + cost.stranger < IRIS_LOCK_COST_MOST;
}

/* Looks again without the colors that have too many pixels, when the object is not clear with them. If that does not
 * help, all is as it was. */
static iris_status look_clearer(iris_lock_view *view, iris_lock *lock, const iris_image *frame,
                                iris_scratch *scratch)
{
    const uint32_t bit = 1u << lock->which;
    const int32_t most = lock->area < 40000 ? lock->area * 3 / 2 + 8 : 65534;
    const size_t mark = iris_scratch_mark(scratch);
    uint8_t *kept = (uint8_t *)iris_scratch_take(scratch, IRIS_SIGNATURE_KEPT_BYTES);
    const size_t behind = iris_scratch_mark(scratch);
    iris_status status = kept ? iris_lock_look(view, lock, frame, scratch) : IRIS_ERR_SCRATCH;
    int32_t cleared = 0;
    if (status != IRIS_OK || lock->seen < 2 || is_lost(lock) || is_clear(lock, view)) {
        return status;
    }
    iris_scratch_release(scratch, behind);
    iris_signature_keep(kept, lock->signatures, bit);
    status =
        iris_signature_thin(&cleared, lock->signatures, bit, &(iris_signature_crowd){frame, most}, scratch);
    status = status == IRIS_OK ? iris_lock_look(view, lock, frame, scratch) : status;
    if (status == IRIS_OK && cleared > 0 && !is_clear(lock, view)) {
        iris_signature_restore(lock->signatures, bit, kept);
        iris_scratch_release(scratch, mark);
        (void)iris_scratch_take(scratch, IRIS_SIGNATURE_KEPT_BYTES);
        status = iris_lock_look(view, lock, frame, scratch);
    }
    return status;
}

iris_status iris_lock_frame(iris_lock_result *result, iris_lock *lock, const iris_image *frame,
                            iris_scratch *scratch)
{
    iris_lock_view view;
    iris_status status = check(result, lock, frame, scratch);
    const int learns = status == IRIS_OK && lock->is_taught && lock->config.adapt;
    if (status == IRIS_OK) {
        status = ask(scratch, learns ? IRIS_LOCK_SCRATCH_BYTES(frame->w, frame->h)
                                     : IRIS_LOCK_LOOK_BYTES(frame->w, frame->h));
    }
    if (status != IRIS_OK) {
        return status;
    }
    int32_t cost = 0;
    size_t mark = iris_scratch_mark(scratch);
    status = learns ? look_clearer(&view, lock, frame, scratch) : iris_lock_look(&view, lock, frame, scratch);
    if (status == IRIS_OK) {
        look_for(result, lock, &view, &cost);
    }
    iris_scratch_release(scratch, mark);
    if (status == IRIS_OK && result->state == IRIS_LOCK_FOUND) {
        learn(lock, frame, &result->box, cost, scratch);
    }
    return status;
}

iris_status iris_lock_teach(iris_lock_result *result, iris_lock *lock, const iris_image *frame,
                            iris_rect rect, iris_scratch *scratch)
{
    iris_lock_view view;
    iris_lock_lesson lesson;
    iris_status status = check(result, lock, frame, scratch);
    if (status == IRIS_OK) {
        status = ask(scratch, IRIS_LOCK_SCRATCH_BYTES(frame->w, frame->h));
    }
    const size_t mark = iris_scratch_mark(scratch);
    const iris_signature_scene scene = {frame, rect, NULL, 0};
    status = status == IRIS_OK ? iris_lock_learn(&lesson, &view, lock, &scene, scratch) : status;
    if (status != IRIS_OK) {
        iris_scratch_release(scratch, mark);
        return status;
    }
    lock->is_taught = 1;
    lock->lesson = lesson.colors;
    lock_on(lock, &lesson.thing);
    lock->missed = lesson.thing.area == 0;
    note_lesson(lock);
    iris_lock_note_strangers(lock, &view, &lesson.thing.box);
    iris_scratch_release(scratch, mark);
    *result = lesson.thing.area > 0 ? found(lock, &lesson.thing, 0) : not_found(lock);
    return IRIS_OK;
}
