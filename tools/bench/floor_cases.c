#include "bench.h"

#include "iris/xt/birdseye.h"
#include "iris/xt/pursuit.h"

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

/* The floor of eight marks that are a little off. */
static iris_status fit(void)
{
    iris_floor_mark marks[8];
    iris_floor_quality quality;
    iris_floor found;
    for (int32_t i = 0; i < 8; i++) {
        iris_place at = iris_place_of((i & 1) * 200 - 100 + 9 * i, 150 + 40 * i);
        marks[i].floor = at;
        (void)iris_floor_image(&marks[i].image, &floor_below, at);
        marks[i].image.x_q16 += i * 7919 % 65536 - 32768;
    }
    return iris_floor_fit(&found, &quality, floor_below.size, marks, 8);
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

/* A line of two pieces, across the picture. */
static iris_status pursuit(void)
{
    int32_t w = bench_frame.gray.w, h = bench_frame.gray.h;
    iris_follow_result line = {.state = IRIS_LINE_FOUND, .segment_count = 2};
    iris_pursuit_goal goal;
    line.segments[0] = (iris_segment){w / 2, h - 1, w / 3, h / 2};
    line.segments[1] = (iris_segment){w / 3, h / 2, w / 2, h / 4};
    return iris_pursuit_find(&goal, &floor_below, &line, 0, NULL);
}

/* A window that the frame fills but for its corners. */
static iris_status draw(const iris_image *dst, const iris_image *src)
{
    iris_birdseye birdseye;
    iris_birdseye_window window = {.size = {src->w, src->h}, .corner = iris_place_of(-80, 300)};
    window.mm_per_pixel_q16 = 160 * 65536 / src->w;
    iris_status status = iris_birdseye_init(&birdseye, &floor_below, &window);
    return status == IRIS_OK ? iris_birdseye_draw(dst, src, &birdseye) : status;
}

static iris_status birdseye_gray(void)
{
    return draw(&bench_frame.gray_to, &bench_frame.gray);
}

static iris_status birdseye_color(void)
{
    return draw(&bench_frame.rgb_to, &bench_frame.rgb);
}

const bench_case bench_floor[] = {
    {"floor from eight marks", fit, prepare},
    {"floor: 192 points to millimeters", point, prepare},
    {"floor: 192 directions to true angles", angle, prepare},
    {"floor: goal of a pursuit", pursuit, prepare},
    {"bird's-eye view of gray", birdseye_gray, prepare},
    {"bird's-eye view of color", birdseye_color, prepare},
    {0},
};
