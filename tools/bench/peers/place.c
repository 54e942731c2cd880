/* Pixels that move, and sums over places. */
#include "iris/copy.h"
#include "iris/integral.h"
#include "iris/pyramid.h"
#include "iris/turn.h"
#include "iris/xt/birdseye.h"
#include "peers.h"

static const iris_border mirrored = {IRIS_BORDER_REFLECT101, 0};
static iris_image to;

static void gives(iris_format format, int32_t w, int32_t h)
{
    to = bench_canvas_of(format, w, h);
    peer_result = to;
}

static void prepare_half(void)
{
    gives(IRIS_GRAY8, (bench_frame.gray.w + 1) / 2, (bench_frame.gray.h + 1) / 2);
}

static void prepare_smaller(void)
{
    gives(IRIS_GRAY8, bench_frame.gray.w * 3 / 4, bench_frame.gray.h * 3 / 4);
}

static void prepare_two_thirds(void)
{
    gives(IRIS_GRAY8, bench_frame.gray.w * 2 / 3, bench_frame.gray.h * 2 / 3);
}

static void prepare_turned(void)
{
    gives(IRIS_GRAY8, bench_frame.gray.h, bench_frame.gray.w);
}

static void prepare_integral(void)
{
    gives(IRIS_GRAY_U32, bench_frame.gray.w + 1, bench_frame.gray.h + 1);
}

static iris_status copy(void)
{
    return iris_copy(&bench_frame.gray_to, &bench_frame.gray);
}

static iris_status half_area(void)
{
    return iris_resize_area(&to, &bench_frame.gray);
}

static iris_status smaller_bilinear(void)
{
    return iris_resize_bilinear(&to, &bench_frame.gray);
}

static iris_status smaller_nearest(void)
{
    return iris_resize_nearest(&to, &bench_frame.gray);
}

/* The level below is the left upper quarter. */
static iris_image quarter;

static void prepare_quarter(void)
{
    quarter = bench_frame.gray;
    quarter.w /= 2;
    quarter.h /= 2;
    peer_gives_gray();
}

static iris_status pyramid_up(void)
{
    return iris_pyramid_up(&bench_frame.gray_to, &quarter, mirrored, &bench_frame.scratch);
}

static iris_status pyramid_down(void)
{
    return iris_pyramid_down(&to, &bench_frame.gray, mirrored, &bench_frame.scratch);
}

static iris_status quarter_turn(void)
{
    return iris_turn(&to, &bench_frame.gray, IRIS_TURN_90);
}

static iris_status flip(void)
{
    return iris_turn(&bench_frame.gray_to, &bench_frame.gray, IRIS_FLIP_HORIZONTAL);
}

static iris_status integral(void)
{
    return iris_integral(&to, &bench_frame.gray);
}

/* A camera 200 mm above the floor and 45 degrees down; a window of 160 mm across that it sees but for corners. */
static iris_birdseye birdseye;

static void prepare_birdseye(void)
{
    int32_t w = bench_frame.gray.w, h = bench_frame.gray.h;
    iris_floor_mark marks[4];
    iris_floor_quality quality;
    iris_floor below;
    iris_birdseye_window window = {.size = {w, h}, .corner = iris_place_of(-80, 300)};
    window.mm_per_pixel_q16 = 160 * 65536 / w;
    for (int32_t i = 0; i < 4; i++) {
        int32_t x = i & 1 ? 100 : -100, y = i & 2 ? 400 : 150;
        marks[i].floor = iris_place_of(x, y);
        marks[i].image = iris_place_of(w / 2 + w * x / (y + 200), h / 2 + h * (200 - y) / (y + 200));
    }
    (void)iris_floor_fit(&below, &quality, (iris_size){w, h}, marks, 4);
    (void)iris_birdseye_init(&birdseye, &below, &window);
    peer_gives_gray();
}

static iris_status draw_birdseye(void)
{
    return iris_birdseye_draw(&bench_frame.gray_to, &bench_frame.gray, &birdseye);
}

const peer_case peer_place[] = {
    {"copy", copy, peer_gives_gray, NULL},
    {"half the size, area", half_area, prepare_half, NULL},
    {"three quarters of the size, bilinear", smaller_bilinear, prepare_smaller, NULL},
    {"two thirds of the size, nearest", smaller_nearest, prepare_two_thirds, NULL},
    {"pyramid, one level up", pyramid_up, prepare_quarter, NULL},
    {"pyramid, one level down", pyramid_down, prepare_half, NULL},
    {"quarter turn", quarter_turn, prepare_turned, NULL},
    {"mirror", flip, peer_gives_gray, NULL},
    {"integral, 32 bit", integral, prepare_integral, NULL},
    {"bird's-eye beside remap, its map ready", draw_birdseye, prepare_birdseye, NULL},
    {"bird's-eye beside warpPerspective", draw_birdseye, prepare_birdseye, NULL},
    {NULL, NULL, NULL, NULL},
};
