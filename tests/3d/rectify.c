/* Rectification against double precision: points that two cameras with lenses see are in one row, and as far away as
 * their disparity says; pictures drawn by hand, rectified and matched, give back the scene. */
#include "iris/3d/rectify.h"

#include <stdio.h>
#include <string.h>

#include "double_camera.h"
#include "iris/3d/stereo.h"
#include "test.h"

enum { W = 240, H = 180 };

static IRIS_SCRATCH_BUFFER(memory, IRIS_RECTIFY_SCRATCH_BYTES);
static iris_place places[2][IRIS_REMAP_PLACES(W, H, 0)];
static iris_remap maps[2];
static uint8_t pixels[2][H][W], views[2][H][W];
static iris_rectified made;

static const int size[2] = {W, H};
static const iris_size sizes[2] = {{W, H}, {W, H}};

static iris_rectify_flaw run(const iris_sensor pair[2], const iris_rectify_config *config)
{
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, memory.memory, IRIS_RECTIFY_SCRATCH_BYTES);
    const iris_status status = iris_rectify(&made, pair, sizes, config, &scratch);
    assert_int_equal(status, made.flaw == IRIS_RECTIFY_FINE ? IRIS_OK : IRIS_ERR_DATA);
    assert_int_equal(scratch.used, 0);
    return made.flaw;
}

static void make_maps(const iris_sensor pair[2])
{
    for (int k = 0; k < 2; k++) {
        assert_int_equal(iris_remap_init(&maps[k], places[k], &made.views[k], &pair[k], sizes[k]), IRIS_OK);
    }
}

/* Where a view has what the camera sees as the straight ray to `world`. */
static double view_pixel(double pixel[2], int k, const iris_sensor *camera, const double world[3])
{
    double c[3], v[3];
    double_into(c, &camera->pose, world);
    for (int i = 0; i < 3; i++) {
        const iris_q32 *row = made.views[k].turn.m + 3 * i;
        v[i] = real(row[0]) * c[0] + real(row[1]) * c[1] + real(row[2]) * c[2];
    }
    double_pixel(pixel, &made.views[k].intrinsics, (const double[2]){v[0] / v[2], v[1] / v[2]});
    return v[2];
}

/* Two cameras whose views have something in common. */
static void some_pair(iris_sensor pair[2], double turned, iris_rectify_keep keep)
{
    const iris_rectify_config config = {{0, 0}, keep};
    for (int tries = 0; tries < 20; tries++) {
        random_pair(pair, between(0.05, 3), turned, W, H);
        const iris_rectify_flaw flaw = run(pair, &config);
        if (flaw == IRIS_RECTIFY_FINE) {
            return;
        }
        assert_int_equal(flaw, IRIS_RECTIFY_APART);
    }
    fail();
}

static void rows_correspond(void **state)
{
    (void)state;
    double row = 0, depth = 0, place = 0;
    int points = 0;
    for (int round = 0; round < 100; round++) {
        iris_sensor pair[2];
        some_pair(pair, 0.6, round % 2 ? IRIS_RECTIFY_ALL : IRIS_RECTIFY_VALID);
        const double b = real(iris_vec3_length(iris_vec3_sub(pair[1].pose.place, pair[0].pose.place)));
        assert_true(fabs(b - real(made.baseline)) < 1e-8);
        for (int i = 0; i < 30; i++) {
            double world[3], seen[2][2], at[2][2], pixel[2] = {0}, z = 0;
            if (!random_seen(world, seen, pair, b * between(3, 60), size)) {
                continue;
            }
            for (int k = 0; k < 2; k++) {
                z = view_pixel(at[k], k, &pair[k], world);
                assert_true(double_project(pixel, &made.cameras[k], world) > 0);
                row = fmax(row, hypot(pixel[0] - at[k][0], pixel[1] - at[k][1]));
            }
            const double d = at[0][0] - at[1][0], f = real(made.focal);
            assert_true(d > 0);
            row = fmax(row, fabs(at[0][1] - at[1][1]));
            depth = fmax(depth, fabs(d - b * f / z));
            points++;
            if (d * 256 < 2 || d * 256 > 65000) {
                continue;
            }
            /* the disparity as a matcher would give it: half of a 256th off, and z b f / d^2 / 512 of the depth */
            iris_vec3 found;
            const iris_vec2 left = {whole(at[0][0]), whole(at[0][1])};
            const double q = floor(d * 256 + 0.5);
            assert_int_equal(iris_rectify_point(&found, &made, left, (uint16_t)q), IRIS_OK);
            const double wanted = hypot(hypot(at[0][0] - real(made.views[0].intrinsics.u0),
                                              at[0][1] - real(made.views[0].intrinsics.v0)),
                                        f) /
                                  f * fabs(z * d * 256 / q - z);
            const double off =
                hypot(hypot(real(found.x) - world[0], real(found.y) - world[1]), real(found.z) - world[2]);
            place = fmax(place, fabs(off - wanted) / z);
        }
    }
    printf("#: %d points: rows %.1e px, disparities %.1e px off; places %.1e of the depth\n", points, row,
           depth, place);
    assert_true(points > 500 && row > 0 && row < 1.0 / 4096 && depth < 1e-3 && place < 1e-6);
}

/* The camera's pixel that a map has at a place of the view: bilinear between its four. */
static int map_place(double at[2], const iris_remap *map, const double pixel[2])
{
    const double step = 1 << map->step_bits;
    const int columns = ((map->size.w - 1) >> map->step_bits) + 2;
    const int x = (int)(pixel[0] / step), y = (int)(pixel[1] / step);
    const double right = pixel[0] / step - x, down = pixel[1] / step - y;
    at[0] = at[1] = 0;
    for (int i = 0; i < 4; i++) {
        const iris_place p = map->places[(y + i / 2) * columns + x + i % 2];
        const double share = (i % 2 ? right : 1 - right) * (i / 2 ? down : 1 - down);
        if (p.x_q16 == INT32_MIN) {
            return 0;
        }
        at[0] += share * p.x_q16 / 65536;
        at[1] += share * p.y_q16 / 65536;
    }
    return 1;
}

/* By the maps: what the left camera sees at one place, and the right one at another, is at places of the views whose
 * rows differ by little. Where a view has it is found by steps: the map says where the camera has a view's place. */
static void rows_of_maps_correspond(void **state)
{
    (void)state;
    double worst[5] = {0};
    int points = 0;
    for (int round = 0; round < 100; round++) {
        iris_sensor pair[2];
        const int bits = round % 5;
        some_pair(pair, 0.4, IRIS_RECTIFY_VALID);
        made.views[0].step_bits = made.views[1].step_bits = bits;
        make_maps(pair);
        for (int i = 0; i < 30; i++) {
            double world[3], seen[2][2], at[2][2], mapped[2];
            int inside = random_seen(world, seen, pair, real(made.baseline) * between(4, 60), size);
            for (int k = 0; k < 2 && inside; k++) {
                (void)view_pixel(at[k], k, &pair[k], world);
                for (int step = 0; step < 12 && inside; step++) {
                    inside = at[k][0] >= 0 && at[k][0] <= W - 1 && at[k][1] >= 0 && at[k][1] <= H - 1 &&
                             map_place(mapped, &maps[k], at[k]);
                    double slopes[2][2];
                    for (int n = 0; n < 2 && inside; n++) {
                        const double beside[2] = {at[k][0] + (n == 0) * 0.5, at[k][1] + (n == 1) * 0.5};
                        inside = map_place(slopes[n], &maps[k], beside);
                        slopes[n][0] = 2 * (slopes[n][0] - mapped[0]);
                        slopes[n][1] = 2 * (slopes[n][1] - mapped[1]);
                    }
                    if (inside) {
                        const double det = slopes[0][0] * slopes[1][1] - slopes[0][1] * slopes[1][0];
                        const double x = seen[k][0] - mapped[0], y = seen[k][1] - mapped[1];
                        at[k][0] += (slopes[1][1] * x - slopes[1][0] * y) / det;
                        at[k][1] += (slopes[0][0] * y - slopes[0][1] * x) / det;
                    }
                }
            }
            if (inside) {
                worst[bits] = fmax(worst[bits], fabs(at[0][1] - at[1][1]));
                points++;
            }
        }
    }
    printf("#: %d points by maps, rows apart: places every pixel %.4f, 4 %.4f, 8 %.4f, 16 %.4f px\n", points,
           worst[0], worst[2], worst[3], worst[4]);
    assert_true(points > 1000 && worst[0] < 0.01 && worst[2] < 0.05 && worst[3] < 0.15 && worst[4] < 0.6);
}

static iris_image image_of(void *data, iris_format format, size_t bytes)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, data, bytes, sizes[0], 0, format), IRIS_OK);
    return image;
}

/* Both views of white pictures: how many of their pixels are not white. */
static int dark_pixels(const iris_sensor pair[2])
{
    int dark = 0;
    memset(pixels, 255, sizeof pixels);
    make_maps(pair);
    for (int k = 0; k < 2; k++) {
        const iris_image src = image_of(pixels[k], IRIS_GRAY8, sizeof pixels[k]);
        const iris_image dst = image_of(views[k], IRIS_GRAY8, sizeof views[k]);
        assert_int_equal(iris_remap_draw(&dst, &src, &maps[k]), IRIS_OK);
        for (int i = 0; i < W * H; i++) {
            dark += views[k][i / W][i % W] != 255;
        }
    }
    return dark;
}

/* The window is valid, and a wider one would not be. */
static void valid_views(void **state)
{
    (void)state;
    for (int round = 0; round < 16; round++) {
        iris_sensor pair[2];
        some_pair(pair, 0.5, IRIS_RECTIFY_VALID);
        assert_int_equal(dark_pixels(pair), 0);
        for (int k = 0; k < 2; k++) {
            iris_intrinsics *in = &made.views[k].intrinsics;
            in->u0 = (W - 1) * (IRIS_Q32_ONE / 2) +
                     (iris_q32)(0.94 * (double)(in->u0 - (W - 1) * (IRIS_Q32_ONE / 2)));
            in->v0 = (H - 1) * (IRIS_Q32_ONE / 2) +
                     (iris_q32)(0.94 * (double)(in->v0 - (H - 1) * (IRIS_Q32_ONE / 2)));
            in->alpha_u = in->alpha_v = (iris_q32)(0.94 * (double)in->alpha_u);
        }
        assert_true(dark_pixels(pair) > 0);
    }
}

/* All that the cameras see is in the views, and these are not larger than that takes. */
static void whole_views(void **state)
{
    (void)state;
    for (int round = 0; round < 16; round++) {
        iris_sensor pair[2];
        double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
        some_pair(pair, 0.5, IRIS_RECTIFY_ALL);
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < 4 * W; i++) {
                const double along = i % W / (W - 1.0), across = i / W % 2;
                const double pixel[2] = {(i / W < 2 ? along : across) * (W - 1),
                                         (i / W < 2 ? across : along) * (H - 1)};
                double world[3], at[2];
                const iris_vec3 place = pair[k].pose.place;
                const double from[3] = {real(place.x), real(place.y), real(place.z)};
                double_ray(world, &pair[k], pixel);
                for (int n = 0; n < 3; n++) {
                    world[n] += from[n];
                }
                (void)view_pixel(at, k, &pair[k], world);
                for (int n = 0; n < 2; n++) {
                    low[n] = fmin(low[n], at[n]);
                    high[n] = fmax(high[n], at[n]);
                }
            }
        }
        assert_true(low[0] > -0.5 && low[1] > -0.5 && high[0] < W - 0.5 && high[1] < H - 0.5);
        assert_true(low[0] + W - 1 - high[0] < 1 || low[1] + H - 1 - high[1] < 1);
    }
}

/* --- a closed loop on pixels --- */

/* Gray levels of a surface, smooth between places 1 / 40 apart, of the size `grain`. */
static double speckle(double x, double y)
{
    double level = 0;
    for (int octave = 0; octave < 3; octave++) {
        const double sx = x * (14 << octave), sy = y * (14 << octave);
        const int left = (int)floor(sx), top = (int)floor(sy);
        double at[4];
        for (int i = 0; i < 4; i++) {
            uint32_t key = (uint32_t)(left + i % 2) * 73856093u ^ (uint32_t)(top + i / 2) * 19349663u ^
                           (uint32_t)octave * 83492791u;
            key = (key ^ key >> 13) * 1274126177u;
            at[i] = (double)((key ^ key >> 16) & 255);
        }
        const double right = sx - left, down = sy - top;
        level += ((at[0] * (1 - right) + at[1] * right) * (1 - down) +
                  (at[2] * (1 - right) + at[3] * right) * down) /
                 3;
    }
    return level;
}

/* The scene, in the frame of the place between the cameras: a tilted wall, and two boards before it. Where a ray from
 * `from` meets it first: its level, and how far along. */
static double look(double *level, const double from[3], const double d[3])
{
    static const double boards[2][5] = {{2.2, -0.55, -0.1, -0.35, 0.3}, {1.7, 0.15, 0.6, -0.1, 0.4}};
    double t = (3.2 + 0.2 * from[0] - from[2]) / (d[2] - 0.2 * d[0]);
    *level = speckle(from[0] + t * d[0], from[1] + t * d[1]);
    for (int i = 0; i < 2; i++) {
        const double *b = boards[i], s = (b[0] - from[2]) / d[2], x = from[0] + s * d[0],
                     y = from[1] + s * d[1];
        if (s < t && x > b[1] && x < b[2] && y > b[3] && y < b[4]) {
            t = s;
            *level = speckle(x + 5 * (i + 1), y);
        }
    }
    return t;
}

static void draw(int k, const iris_sensor *camera)
{
    const double from[3] = {real(camera->pose.place.x), real(camera->pose.place.y),
                            real(camera->pose.place.z)};
    for (int i = 0; i < W * H; i++) {
        double d[3], level;
        double_ray(d, camera, (const double[2]){i % W, i / W});
        (void)look(&level, from, d);
        pixels[k][i / W][i % W] = (uint8_t)(level + 0.5);
    }
}

/* Toed in by five degrees together, rolled by two, the right one 20 mm higher and 15 mm ahead; barrels. */
static void toed_in(iris_sensor pair[2])
{
    for (int k = 0; k < 2; k++) {
        const double sign = k ? 1 : -1;
        pair[k] = (iris_sensor){
            .intrinsics = {whole(210 + 6 * k), whole(209), 0, whole(121 - 4 * k), whole(88 + 3 * k)},
            .lens = {.k1 = whole(-0.22 + 0.03 * k), .k2 = whole(0.06), .p1 = whole(0.001)}};
        iris_rotation_from_vector(&pair[k].pose.turn,
                                  (iris_vec3){whole(0.02 * sign), whole(0.045 * sign), whole(0.02 * sign)});
        pair[k].pose.place = (iris_vec3){whole(0.09 * sign), whole(-0.01 * sign), whole(0.0075 * sign)};
    }
}

static void closed_loop(void **state)
{
    (void)state;
    static uint16_t disparities[H][W];
    static IRIS_SCRATCH_BUFFER(room, IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(W, 40));
    iris_sensor pair[2];
    iris_scratch scratch;
    iris_stereo_semiglobal_config config;
    toed_in(pair);
    assert_int_equal(run(pair, NULL), IRIS_RECTIFY_FINE);
    make_maps(pair);
    iris_image flat[2];
    for (int k = 0; k < 2; k++) {
        draw(k, &pair[k]);
        const iris_image src = image_of(pixels[k], IRIS_GRAY8, sizeof pixels[k]);
        flat[k] = image_of(views[k], IRIS_GRAY8, sizeof views[k]);
        assert_int_equal(iris_remap_draw(&flat[k], &src, &maps[k]), IRIS_OK);
    }
    const iris_image disparity = image_of(disparities, IRIS_GRAY_U16, sizeof disparities);
    iris_stereo_semiglobal_defaults(&config);
    config.stereo.max_disparity = 40;
    (void)iris_scratch_init(&scratch, room.memory, sizeof room.memory);
    assert_int_equal(iris_stereo_semiglobal(&disparity, &flat[0], &flat[1], &config, &scratch), IRIS_OK);
    int good = 0, all = 0;
    double sum = 0;
    const iris_sensor *left = &made.cameras[0];
    const double from[3] = {real(left->pose.place.x), real(left->pose.place.y), real(left->pose.place.z)};
    for (int i = 0; i < W * H; i++) {
        const int x = i % W, y = i / W;
        double d[3], level, beside[2];
        iris_vec3 found;
        double_ray(d, left, (const double[2]){x, y});
        const double t = look(&level, from, d);
        const double there[3] = {from[0] + t * d[0], from[1] + t * d[1], from[2] + t * d[2]};
        if (double_project(beside, &made.cameras[1], there) <= 0 || beside[0] < 0) {
            continue; /* the right view does not reach so far */
        }
        all++;
        if (iris_rectify_point(&found, &made, (iris_vec2){x * IRIS_Q32_ONE, y * IRIS_Q32_ONE},
                               disparities[y][x]) == IRIS_OK) {
            const double off =
                hypot(hypot(real(found.x) - there[0], real(found.y) - there[1]), real(found.z) - there[2]);
            const double share = off / t;
            good += share < 0.05;
            sum += share < 0.05 ? share * share : 0;
        }
    }
    printf("#: closed loop: %.1f %% within 5 %% of the depth, these by %.2f %% (root mean square)\n",
           100.0 * good / all, 100 * sqrt(sum / good));
    assert_true(all > W * H * 3 / 4 && good > 0.93 * all && sqrt(sum / good) < 0.015);
}

/* --- refusals --- */

static void refused(void **state)
{
    (void)state;
    iris_sensor pair[2], other;
    toed_in(pair);
    assert_int_equal(run(pair, NULL), IRIS_RECTIFY_FINE);
    const iris_sensor swapped[2] = {pair[1], pair[0]};
    assert_int_equal(run(swapped, NULL), IRIS_RECTIFY_SWAPPED);
    other = pair[1];
    pair[1].pose.place = pair[0].pose.place;
    pair[1].pose.place.z += 100;
    assert_int_equal(run(pair, NULL), IRIS_RECTIFY_ONE_PLACE);
    pair[1].pose.place = iris_pose_out_of(&pair[0].pose, (iris_vec3){whole(0.1), 0, whole(0.5)});
    assert_int_equal(run(pair, NULL), IRIS_RECTIFY_ALONG);
    pair[1] = other;
    iris_mat3 turn;
    iris_rotation_from_vector(&turn, (iris_vec3){0, whole(0.9), 0});
    iris_mat3_multiply(&pair[1].pose.turn, &turn, &other.pose.turn);
    pair[0].intrinsics.alpha_u = pair[1].intrinsics.alpha_u = whole(400); /* 34 degrees wide, 46 apart */
    assert_int_equal(run(pair, NULL), IRIS_RECTIFY_APART);
    const iris_rectify_config all = {{0, 0}, IRIS_RECTIFY_ALL};
    assert_int_equal(run(pair, &all), IRIS_RECTIFY_FINE);
    iris_rotation_from_vector(&turn, (iris_vec3){whole(2.5), 0, 0});
    iris_mat3_multiply(&pair[1].pose.turn, &turn, &other.pose.turn);
    assert_int_equal(run(pair, NULL), IRIS_RECTIFY_APART);
}

/* One above the other: the views are turned by a right angle, and all is as it was. */
static void one_above_the_other(void **state)
{
    (void)state;
    iris_sensor pair[2];
    toed_in(pair);
    pair[1].pose.place = (iris_vec3){0, whole(0.15), 0};
    pair[1].pose.turn = pair[0].pose.turn;
    pair[0].pose.place = (iris_vec3){0, 0, 0};
    assert_int_equal(run(pair, NULL), IRIS_RECTIFY_FINE);
    assert_int_equal(dark_pixels(pair), 0);
    double at[2][2];
    const double world[3] = {0.1, 0.05, 2};
    const double z = view_pixel(at[0], 0, &pair[0], world);
    (void)view_pixel(at[1], 1, &pair[1], world);
    assert_true(fabs(at[0][1] - at[1][1]) < 1e-4 &&
                fabs((at[0][0] - at[1][0]) * z - 0.15 * real(made.focal)) < 1e-3);
}

static void wrong_calls(void **state)
{
    (void)state;
    iris_sensor pair[2];
    iris_scratch scratch;
    iris_vec3 world = {1, 2, 3};
    iris_rectify_config config = {{0, 0}, (iris_rectify_keep)2};
    toed_in(pair);
    assert_int_equal(run(pair, NULL), IRIS_RECTIFY_FINE);
    const iris_rectified before = made;
    (void)iris_scratch_init(&scratch, memory.memory, IRIS_RECTIFY_SCRATCH_BYTES - 1);
    assert_int_equal(iris_rectify(&made, pair, sizes, NULL, &scratch), IRIS_ERR_SCRATCH);
    (void)iris_scratch_init(&scratch, memory.memory, IRIS_RECTIFY_SCRATCH_BYTES);
    assert_int_equal(iris_rectify(NULL, pair, sizes, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_rectify(&made, NULL, sizes, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_rectify(&made, pair, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_rectify(&made, pair, sizes, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_rectify(&made, pair, sizes, &config, &scratch), IRIS_ERR_RANGE);
    config = (iris_rectify_config){{15, 200}, IRIS_RECTIFY_ALL};
    assert_int_equal(iris_rectify(&made, pair, sizes, &config, &scratch), IRIS_ERR_RANGE);
    config.size = (iris_size){0, 200};
    assert_int_equal(iris_rectify(&made, pair, sizes, &config, &scratch), IRIS_ERR_RANGE);
    const iris_size wrong[2] = {{W, H}, {W, 1}};
    assert_int_equal(iris_rectify(&made, pair, wrong, NULL, &scratch), IRIS_ERR_RANGE);
    pair[1].intrinsics.alpha_v = 0;
    assert_int_equal(iris_rectify(&made, pair, sizes, NULL, &scratch), IRIS_ERR_RANGE);
    const iris_vec2 pixel = {whole(50), whole(60)};
    assert_int_equal(iris_rectify_point(NULL, &made, pixel, 300), IRIS_ERR_ARG);
    assert_int_equal(iris_rectify_point(&world, NULL, pixel, 300), IRIS_ERR_ARG);
    assert_int_equal(iris_rectify_point(&world, &made, pixel, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_rectify_point(&world, &made, pixel, 1), IRIS_ERR_RANGE);
    assert_true(world.x == 1 && world.y == 2 && world.z == 3);
    assert_memory_equal(&made, &before, sizeof made);
}

static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        iris_sensor pair[2];
        iris_scratch scratch;
        iris_vec3 world;
        const iris_rectify_config config = {{16 + i, 400 - i}, i % 2 ? IRIS_RECTIFY_ALL : IRIS_RECTIFY_VALID};
        random_pair(pair, 1, 0.5, W, H);
        for (int k = 0; k < i % 4; k++) {
            spoil(&pair[k % 2]);
        }
        (void)iris_scratch_init(&scratch, memory.memory, IRIS_RECTIFY_SCRATCH_BYTES);
        if (iris_rectify(&made, pair, sizes, &config, &scratch) == IRIS_OK) {
            (void)iris_rectify_point(&world, &made, (iris_vec2){any_q32(), any_q32()},
                                     (uint16_t)random_u64());
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_correspond),     cmocka_unit_test(rows_of_maps_correspond),
        cmocka_unit_test(valid_views),         cmocka_unit_test(whole_views),
        cmocka_unit_test(closed_loop),         cmocka_unit_test(refused),
        cmocka_unit_test(one_above_the_other), cmocka_unit_test(wrong_calls),
        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
