/* IRIS-XT - lock on to an object by its color, and follow it from frame to frame.
 *
 * The object is taught by a rectangle in a frame, or it is the largest blob of a signature (signature.h). From then on,
 * in each frame: the pixels of its color make blobs; blobs near each other that together have the object's size count
 * as one, for objects that light or blur has cut to pieces; and each such candidate is compared with what is known of
 * the object:
 *   - place: how far from where it should be by its speed, in units of how well it could be predicted so far;
 *   - size: the logarithms of the ratios of areas, widths, and heights;
 *   - color: U, V, and Y of its mean, with more freedom for Y: light changes;
 *   - strangers: what was seen beside the object in the last frame where it was found, and has not moved far since, is
 *     not the object. So the object may jump anywhere, but a similar thing that was there all along does not become it.
 * The best one, if good enough, is the object. One that has grown into something else of its color is looked at through
 * a window of its size where it should be: when its box is more than 1.7 times as wide or high as the object, or when
 * it has more than 1.6 times the area and not the object's shape any more (sides' ratio, share of the box filled); so
 * what comes nearer is not cut, and what touches is. What stays like that for two seconds or so is believed. A taught
 * signature learns from the object as its light changes, but not farther from what was taught than hue, saturation, and
 * lightness of the lesson allow, and without what is around the object; and when what is around it has come to look
 * like it, colors with more pixels than the object has are given up.
 *
 * When there is none the object is coasting for some frames: it is predicted by its speed. Then it is lost, and looked
 * for everywhere. What is found again with its color and size is the same, with its identity, else a new one.
 * Report, section 2.6.
 *
 *     static iris_signatures table;
 *     iris_lock_init(&lock, (iris_size){160, 120}, &table, 0, NULL);
 *     iris_lock_teach(&seen, &lock, &frame, (iris_rect){70, 50, 20, 20}, &scratch);
 *     for each frame: iris_lock_frame(&seen, &lock, &frame, &scratch);
 */
#ifndef IRIS_XT_LOCK_H
#define IRIS_XT_LOCK_H

#include "iris/fixed.h"
#include "iris/xt/blob.h"
#include "iris/xt/signature.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_LOCK_BLOBS     24 /* the largest of a frame are looked at */
#define IRIS_LOCK_STRANGERS 8  /* remembered, the largest */

typedef enum {
    IRIS_LOCK_LOST = 0,
    IRIS_LOCK_COASTING, /* not seen, but predicted */
    IRIS_LOCK_FOUND
} iris_lock_state;

typedef struct {
    int32_t min_area;      /* pixels, 1 or more: smaller blobs are noise; default 5 */
    int32_t coast_frames;  /* 0 to 10000: how long it is predicted; default 10, a third of a second */
    int32_t forget_frames; /* 0 to 1000000: how long after it was seen it keeps its identity; default 150 */
    int32_t adapt;         /* 1: a taught signature learns as light changes; 0: it stays; default 1 */
} iris_lock_config;

/* Of one frame. */
typedef struct {
    iris_lock_state state;
    int32_t id;     /* of the object: 1, 2, and so on; 0: there was none yet */
    int32_t age;    /* frames since it was first seen, that one and this included; 0 without an object */
    int32_t missed; /* frames since it was last seen; 0: found */
    iris_rect box;  /* around its pixels; coasting: as large as it was last, where it should be; lost: zero */
    iris_q16 x_q16, y_q16; /* center of its pixels; coasting: where it should be; lost: zero */
    int32_t area;          /* its pixels; not found: 0 */
    int32_t score_permil;  /* how much it is like what was expected: 1 to 1000; not found: 0 */
} iris_lock_result;

/* What was seen beside the object, and is not it. */
typedef struct {
    int16_t x, y, w, h;
} iris_lock_stranger;

/* The object followed. The fields are its own. */
typedef struct {
    iris_lock_config config;
    iris_size size;
    iris_signatures *signatures;
    int32_t which;
    int32_t is_taught;
    iris_signature_lesson lesson; /* the first one; learning stays near it */

    int32_t id, age, missed, seen; /* seen: frames in which it was found */
    int64_t x_q16, y_q16;          /* where it was last, */
    int64_t dx_q16, dy_q16;        /* its speed, pixels per frame, */
    int64_t error_q16;             /* how far off predictions are, */
    int32_t area, w_q4, h_q4;      /* its size, smoothed, */
    int32_t y_q4, u_q4, v_q4;      /* its color, smoothed, and as of the last lesson */
    int32_t lesson_y, lesson_u, lesson_v;
    int32_t since_lesson; /* frames */
    int32_t stranger_count;
    iris_lock_stranger strangers[IRIS_LOCK_STRANGERS];
} iris_lock;

/* Working memory. IRIS_LOCK_LOOK_BYTES: a mask of the frame, a row of it in RGB, and the blobs; enough for
 * iris_lock_frame with a signature that was not taught, or without `adapt`. IRIS_LOCK_SCRATCH_BYTES: the same memory
 * serves for learning; for iris_lock_teach, and for every iris_lock_frame after it. 160x120: 15 KB. */
#define IRIS_LOCK_THING_BYTES      48u
#define IRIS_LOCK_MASK_BYTES(w, h) IRIS_SCRATCH_ROUND(((size_t)(w) + 31u) / 32u * 4u * (size_t)(h))
#define IRIS_LOCK_LOOK_BYTES(w, h)                                                                           \
    (IRIS_LOCK_MASK_BYTES(w, h) + IRIS_SCRATCH_ROUND(3u * (size_t)(w)) +                                     \
     IRIS_SCRATCH_ROUND(IRIS_LOCK_BLOBS * sizeof(iris_blob)) +                                               \
     IRIS_SCRATCH_ROUND((IRIS_LOCK_BLOBS + 1) * IRIS_LOCK_THING_BYTES) +                                     \
     IRIS_BLOB_SCRATCH_BYTES(w, IRIS_LOCK_BLOBS) + IRIS_BLOB_COLOR_SCRATCH_BYTES(w))
#define IRIS_LOCK_SCRATCH_BYTES(w, h)                                                                        \
    (IRIS_SCRATCH_ROUND(IRIS_SIGNATURE_CELLS / 8 + 1) +                                                      \
     (IRIS_LOCK_LOOK_BYTES(w, h) > IRIS_SIGNATURE_SCRATCH_BYTES ? IRIS_LOCK_LOOK_BYTES(w, h)                 \
                                                                : IRIS_SIGNATURE_SCRATCH_BYTES))

/* Sensible values, as given above. Null is ignored. */
void iris_lock_defaults(iris_lock_config *config);

/* Nothing is locked on yet; the first frame's largest blob of signature `which` will be, unless one is taught before.
 * config may be null for the defaults; it is copied. signatures stays in use, and is changed by teaching and learning.
 * IRIS_ERR_ARG: null pointer, or a config value out of range; IRIS_ERR_RANGE: which outside 0 to 7, or a side outside
 * 1..IRIS_SIDE_MAX. O(1). */
iris_status iris_lock_init(iris_lock *lock, iris_size size, iris_signatures *signatures, int32_t which,
                           const iris_lock_config *config);

/* Teaches the signature by the object in `rect` of frame (of any format that iris_color_takes), and locks on to it:
 * whatever was followed before is forgotten, and the object gets the next identity. result is this frame's; it is lost
 * when there is nothing in the rectangle that could be told from what is around it. A rectangle that is full of the
 * object's color, corners and all, shows a part of it: when all that hangs together with it is of the same color, has
 * 1.5 to 16 times the rectangle's area, and at most a quarter of the frame, then the whole of it is taught, as if the
 * rectangle were its box. What touches the object in its color belongs to it then, until it goes away.
 * IRIS_ERR_ARG: null pointer or invalid image; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: another size, or rect is empty or not
 * wholly inside; IRIS_ERR_SCRATCH. O(w h): as much as up to three lessons (signature.h) and two
 * frames. */
iris_status iris_lock_teach(iris_lock_result *result, iris_lock *lock, const iris_image *frame,
                            iris_rect rect, iris_scratch *scratch);

/* Looks for the object in the next frame. Errors as above. O(w h): per pixel 54 instructions on a Cortex-M4;
 * and once in a while, when its color or the light has changed, as much as teaching takes. */
iris_status iris_lock_frame(iris_lock_result *result, iris_lock *lock, const iris_image *frame,
                            iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
