/* Locking on. */
#include "iris/xt/lock.h"

#include <string.h>

#include "calls.h"

static iris_format camera_format(void)
{
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888, IRIS_RGB565, IRIS_YUYV};
    return draw_chance(20) ? draw_format() : formats[draw_below(5)];
}

static iris_lock_config any_config(void)
{
    iris_lock_config config = {draw_int(1, 30), draw_int(0, 10), draw_int(0, 20), draw_int(0, 1)};
    return config;
}

static void init(void)
{
    iris_lock *lock = OR_NULL(draw_results(sizeof *lock));
    iris_signatures *table = OR_NULL(draw_state(NULL, sizeof *table));
    iris_lock_config config = any_config();
    const iris_lock_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_size size = draw_size();
    int32_t which = draw_int(0, 7);
    CALL(iris_lock_init(lock, size, table, which, given));
}

/* A lock of this size, that has seen what it has. */
static iris_lock *any_lock(iris_size size)
{
    iris_signatures *table = draw_state(NULL, sizeof *table);
    iris_lock lock = {.size = {0, 0}};
    if (iris_lock_init(&lock, size, table, (int32_t)draw_below(8), NULL) == IRIS_OK && draw_chance(2)) {
        lock.id = 1 + (int32_t)draw_below(3);
        lock.seen = 1 + (int32_t)draw_below(3);
        lock.missed = (int32_t)draw_below(13);
        lock.x_q16 = (int64_t)draw_below(70) << 16;
        lock.y_q16 = (int64_t)draw_below(70) << 16;
        lock.dx_q16 = ((int64_t)draw_below(40) - 20) * 65536;
        lock.area = 1 + (int32_t)draw_below(200);
        lock.w_q4 = 16 + (int32_t)draw_below(400);
        lock.h_q4 = 16 + (int32_t)draw_below(400);
    }
    return OR_NULL(draw_state(&lock, sizeof lock));
}

static iris_size size_for(iris_format format)
{
    iris_size size = draw_size();
    if (format == IRIS_YUYV || format == IRIS_UYVY) {
        size.w += size.w % 2;
    }
    return size;
}

static void teach(void)
{
    iris_format format = camera_format();
    iris_size size = size_for(format);
    iris_lock *lock = any_lock(size);
    iris_lock_result *result = OR_NULL(draw_results(sizeof *result));
    const iris_image *image = draw_input(format, size);
    iris_rect rect = {draw_int(0, size.w / 2), draw_int(0, size.h / 2), draw_int(1, size.w / 2 + 1),
                      draw_int(1, size.h / 2 + 1)};
    iris_scratch *scratch = draw_scratch(IRIS_LOCK_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_lock_teach(result, lock, image, rect, scratch));
}

static void frame(void)
{
    iris_format format = camera_format();
    iris_size size = size_for(format);
    iris_lock *lock = any_lock(size);
    iris_lock_result *result = OR_NULL(draw_results(sizeof *result));
    const iris_image *image = draw_input(format, size);
    iris_scratch *scratch = draw_scratch(IRIS_LOCK_LOOK_BYTES(size.w, size.h));
    CALL(iris_lock_frame(result, lock, image, scratch));
}

const random_call calls_lock[] = {
    {"iris_lock_init", init},
    {"iris_lock_teach", teach},
    {"iris_lock_frame", frame},
    {NULL, NULL},
};
