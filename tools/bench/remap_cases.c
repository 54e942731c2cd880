#include "bench.h"

#include "iris/3d/remap.h"

static iris_remap remap;
static iris_place *places;
static iris_remap_view view;
static iris_sensor camera;

static iris_status make_map(void)
{
    const iris_size size = {bench_frame.gray.w, bench_frame.gray.h};
    return iris_remap_init(&remap, places, &view, &camera, size);
}

/* A lens of k1 = -0.3, and a focal length of 0.8 widths. */
static void prepare(void)
{
    const iris_size size = {bench_frame.gray.w, bench_frame.gray.h};
    camera = (iris_sensor){0};
    camera.intrinsics.alpha_u = camera.intrinsics.alpha_v = IRIS_Q32_ONE / 5 * 4 * size.w;
    camera.intrinsics.u0 = IRIS_Q32_ONE * size.w / 2;
    camera.intrinsics.v0 = IRIS_Q32_ONE * size.h / 2;
    camera.lens.k1 = -IRIS_Q32_ONE / 10 * 3;
    iris_remap_view_defaults(&view, &camera.intrinsics, size);
    places = iris_scratch_take(&bench_frame.scratch,
                               IRIS_REMAP_PLACES(size.w, size.h, view.step_bits) * sizeof *places);
    (void)make_map();
}

static iris_status gray(void)
{
    return iris_remap_draw(&bench_frame.gray_to, &bench_frame.gray, &remap);
}

static iris_status color(void)
{
    return iris_remap_draw(&bench_frame.rgb_to, &bench_frame.rgb, &remap);
}

const bench_case bench_remap[] = {
    {"lens taken out of gray", gray, prepare},
    {"lens taken out of color", color, prepare},
    {"map for that", make_map, prepare},
    {0},
};
