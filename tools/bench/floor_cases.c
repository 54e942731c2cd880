#include "bench.h"

#include "iris/xt/floor.h"

/* A camera 200 mm above the floor and 45 degrees down, for the frame's size. */
static iris_floor floor_below;

static void prepare(void)
{
    int32_t w = bench_frame.gray.w, h = bench_frame.gray.h;
    iris_floor_mark marks[4];
    iris_floor_quality quality;
    for (int32_t i = 0; i < 4; i++) {
        int32_t x = i & 1 ? 100 : -100, y = i & 2 ? 400 : 150;
        marks[i].floor = iris_place_of(x, y);
        marks[i].image = iris_place_of(w / 2 + w * x / (y + 200), h / 2 + h * (200 - y) / (y + 200));
    }
    (void)iris_floor_fit(&floor_below, &quality, (iris_size){w, h}, marks, 4);
}

/* 192 on a frame of 160x120: an instruction per pixel is a hundred for one. */
#define TIMES 192

static iris_status point(void)
{
    iris_place mm;
    iris_status status = IRIS_OK;
    for (int32_t i = 0; i < TIMES && status == IRIS_OK; i++) {
        status = iris_floor_point(&mm, &floor_below, iris_place_of(i * bench_frame.gray.w / TIMES, 40));
    }
    return status;
}

static iris_status angle(void)
{
    iris_angle to;
    iris_status status = IRIS_OK;
    for (int32_t i = 0; i < TIMES && status == IRIS_OK; i++) {
        iris_place at = iris_place_of(i * bench_frame.gray.w / TIMES, 40);
        status = iris_floor_angle(&to, &floor_below, at, (iris_angle)(100 * i));
    }
    return status;
}

const bench_case bench_floor[] = {
    {"floor: 192 points to millimeters", point, prepare},
    {"floor: 192 directions to true angles", angle, prepare},
    {0},
};
