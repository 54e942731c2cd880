/* Depth from two cameras, and pictures without the bends of a lens. */
#include "iris/3d/remap.h"
#include "iris/3d/stereo.h"
#include "peers.h"

#define MOST 63

/* The right picture is the first third of the color's bytes. */
static iris_image right, disparity;

static void prepare_pair(void)
{
    const iris_image *color = &bench_frame.rgb;
    (void)iris_image_wrap(&right, color->data, (size_t)color->w * (size_t)color->h,
                          (iris_size){color->w, color->h}, 0, IRIS_GRAY8);
    disparity = bench_canvas(IRIS_GRAY_U16);
    peer_result = disparity;
}

static iris_status block_plain(void)
{
    const iris_stereo_block_config config = {{MOST, IRIS_STEREO_SAD, 255, 0, 0, 0}, 15};
    return iris_stereo_block(&disparity, &bench_frame.gray, &right, &config, &bench_frame.scratch);
}

/* What the other library does if nothing else is asked for. */
static iris_status block_unique(void)
{
    const iris_stereo_block_config config = {{MOST, IRIS_STEREO_SAD, 255, 13, 0, 0}, 15};
    return iris_stereo_block(&disparity, &bench_frame.gray, &right, &config, &bench_frame.scratch);
}

static iris_status semiglobal(void)
{
    iris_stereo_semiglobal_config config;
    iris_stereo_semiglobal_defaults(&config);
    config.stereo.fill = config.stereo.smooth = 0;
    return iris_stereo_semiglobal(&disparity, &bench_frame.gray, &right, &config, &bench_frame.scratch);
}

/* A lens of k1 = -0.3, and a focal length of 0.8 widths. */
static iris_sensor camera;
static iris_remap_view view;
static iris_remap remap;
static iris_place *places;

static iris_status make_map(void)
{
    return iris_remap_init(&remap, places, &view, &camera, view.size);
}

static void prepare_lens(void)
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
    peer_gives_gray();
}

static void prepare_lens_color(void)
{
    prepare_lens();
    peer_gives_color();
}

static iris_status undistort(void)
{
    return iris_remap_draw(&bench_frame.gray_to, &bench_frame.gray, &remap);
}

static iris_status undistort_color(void)
{
    return iris_remap_draw(&bench_frame.rgb_to, &bench_frame.rgb, &remap);
}

static iris_status undistort_anew(void)
{
    iris_status status = make_map();
    return status == IRIS_OK ? undistort() : status;
}

const peer_case peer_space[] = {
    {"StereoBM 15x15, 64 disparities, plain", block_plain, prepare_pair, NULL},
    {"StereoBM 15x15, 64 disparities, default", block_unique, prepare_pair, NULL},
    {"StereoSGBM, 64 disparities", semiglobal, prepare_pair, NULL},
    {"remap bilinear, fixed-point map", undistort, prepare_lens, NULL},
    {"remap of color", undistort_color, prepare_lens_color, NULL},
    {"undistort, its map made anew", undistort_anew, prepare_lens, NULL},
    {NULL, NULL, NULL, NULL},
};
