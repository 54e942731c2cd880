#include <string.h>

#include "bench.h"
#include "iris/xt/lock.h"

static iris_signatures table;
static iris_lock lock;
static iris_rect rect;
static iris_lock_result seen;

/* A red disc on the floor. */
static void draw(void)
{
    const iris_image *rgb = &bench_frame.rgb;
    int32_t r = rgb->h / 12, at_x = rgb->w / 4, at_y = rgb->h / 2;
    for (int32_t y = at_y - r; y <= at_y + r; y++) {
        for (int32_t x = at_x - r; x <= at_x + r; x++) {
            uint8_t *pixel = (uint8_t *)iris_image_row(rgb, y) + (size_t)(3 * x);
            if ((x - at_x) * (x - at_x) + (y - at_y) * (y - at_y) <= r * r) {
                pixel[0] = 200;
                pixel[1] = pixel[2] = 40;
            }
        }
    }
    rect = (iris_rect){at_x - r, at_y - r, 2 * r + 1, 2 * r + 1};
}

static iris_status teach(void)
{
    return iris_lock_teach(&seen, &lock, &bench_frame.rgb, rect, &bench_frame.scratch);
}

static void prepare(void)
{
    draw();
    (void)memset(&table, 0, sizeof table);
    (void)iris_lock_init(&lock, (iris_size){bench_frame.rgb.w, bench_frame.rgb.h}, &table, 0, NULL);
    (void)teach();
}

static iris_status frame(void)
{
    return iris_lock_frame(&seen, &lock, &bench_frame.rgb, &bench_frame.scratch);
}

const bench_case bench_lock[] = {
    {"lock on: teach", teach, prepare},
    {"lock on: frame", frame, prepare},
    {0},
};
