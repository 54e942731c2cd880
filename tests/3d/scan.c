/* Scans from ranges, and from pictures of depths that are drawn in double precision. */
#include "iris/3d/scan.h"

#include <math.h>

#include "random_number.h"
#include "test.h"

enum { W = 80, H = 60, ROOM = 400 };

#define UNITS (65536 / 6.283185307179586)

static iris_beam beams[ROOM];
static IRIS_SCRATCH_BUFFER(working, IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(W));
static uint16_t depths[H * W];

static double gauss(void)
{
    double sum = 0;
    for (int k = 0; k < 12; k++) {
        sum += (double)(random_u64() % 100000) / 100000 - 0.5;
    }
    return sum;
}

/* --- ranges --- */

static void ranges_become_beams(void **state)
{
    (void)state;
    int32_t ranges[ROOM], count = -1;
    const iris_range_sensor sensor = {{120, -30, 16384}, -24576 * 65536, 11930465 / 4, 100, 6000, 0, 25};
    for (int i = 0; i < ROOM; i++) {
        ranges[i] = 100 + (int32_t)(random_u64() % 5901);
    }
    assert_int_equal(iris_scan_from_ranges(beams, &count, ranges, ROOM, &sensor), IRIS_OK);
    assert_int_equal(count, ROOM);
    for (int i = 0; i < ROOM; i++) {
        const double turn = (16384 - 24576 + i * (11930465 / 4) / 65536.0) / UNITS;
        assert_true(fabs(beams[i].x_mm - (120 + ranges[i] * cos(turn))) < 0.9);
        assert_true(fabs(beams[i].y_mm - (-30 + ranges[i] * sin(turn))) < 0.9);
        assert_true(beams[i].hit == 1 && beams[i].spread_mm == 25);
    }
}

static void no_return(void **state)
{
    (void)state;
    const int32_t ranges[6] = {0, 99, 100, 3000, 3001, INT32_MIN};
    iris_range_sensor sensor = {{0, 0, 0}, 0, 0, 100, 3000, 0, 7};
    int32_t count = -1;
    assert_int_equal(iris_scan_from_ranges(beams, &count, ranges, 6, &sensor), IRIS_OK);
    assert_int_equal(count, 2);
    assert_true(beams[0].x_mm == 100 && beams[1].x_mm == 3000);
    sensor.quiet_mm = 2000;
    assert_int_equal(iris_scan_from_ranges(beams, &count, ranges, 6, &sensor), IRIS_OK);
    assert_int_equal(count, 6);
    for (int i = 0; i < 6; i++) {
        const int hit = i == 2 || i == 3;
        assert_true(beams[i].hit == hit && beams[i].spread_mm == (hit ? 7 : 0) && beams[i].y_mm == 0);
        assert_int_equal(beams[i].x_mm, hit ? ranges[i] : 2000);
    }
    assert_int_equal(iris_scan_from_ranges(beams, &count, ranges, 0, &sensor), IRIS_OK);
    assert_int_equal(count, 0);
}

static void bad_range_sensors(void **state)
{
    (void)state;
    const int32_t ranges[2] = {500, 500};
    const iris_range_sensor good = {{0, 0, 0}, 0, 0, 100, 3000, 0, 0},
                            all_bad[] = {{{0, 0, 0}, 0, 0, 0, 3000, 0, 0},
                                         {{0, 0, 0}, 0, 0, 100, 100, 0, 0},
                                         {{0, 0, 0}, 0, 0, 100, 125000, 0, 0},
                                         {{0, 0, 0}, 0, 0, 100, 3000, 3001, 0},
                                         {{0, 0, 0}, 0, 0, 100, 3000, -1, 0},
                                         {{0, 0, 0}, 0, 0, 100, 3000, 0, -1},
                                         {{125000, 0, 0}, 0, 0, 100, 3000, 0, 0},
                                         {{0, INT32_MIN, 0}, 0, 0, 100, 3000, 0, 0}};
    int32_t count = 77;
    for (size_t i = 0; i < sizeof all_bad / sizeof all_bad[0]; i++) {
        assert_int_equal(iris_scan_from_ranges(beams, &count, ranges, 2, &all_bad[i]), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_scan_from_ranges(beams, &count, ranges, -1, &good), IRIS_ERR_RANGE);
    assert_int_equal(iris_scan_from_ranges(beams, &count, ranges, 32768, &good), IRIS_ERR_RANGE);
    assert_int_equal(iris_scan_from_ranges(beams, &count, NULL, 2, &good), IRIS_ERR_ARG);
    assert_int_equal(iris_scan_from_ranges(NULL, &count, ranges, 2, &good), IRIS_ERR_ARG);
    assert_int_equal(count, 77);
    iris_range_sensor wild = good;
    wild.first_q16 = INT32_MIN;
    wild.step_q16 = INT32_MAX;
    wild.mount.heading = -32768;
    assert_int_equal(iris_scan_from_ranges(beams, &count, ranges, 2, &wild), IRIS_OK);
}

/* --- depths --- */

/* A floor, and a wall `wall` mm ahead of the lens with its lower edge `edge` mm above the floor. */
typedef struct {
    double wall, edge, top;
} scene;

static double real(iris_q16 a)
{
    return a / 65536.0;
}

/* The depth of what a pixel sees of the scene; 0: nothing. */
static double depth_at(const iris_depth_camera *c, const scene *s, int u, int v)
{
    const double tilt = c->tilt / UNITS, y = (v - real(c->v0_q16)) / real(c->focal_q16);
    const double ahead = cos(tilt) - y * sin(tilt), down = sin(tilt) + y * cos(tilt);
    double depth = down > 1e-6 ? c->height_mm / down : 0;
    (void)u;
    if (ahead > 1e-6) {
        const double z = s->wall / ahead, height = c->height_mm - z * down;
        if (height >= s->edge && height <= s->top && (depth == 0 || z < depth)) {
            depth = z;
        }
    }
    return depth;
}

static iris_image draw(const iris_depth_camera *c, const scene *s, double noise_px)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, depths, sizeof depths, (iris_size){W, H}, 0, IRIS_GRAY_U16),
                     IRIS_OK);
    for (int v = 0; v < H; v++) {
        for (int u = 0; u < W; u++) {
            double value = depth_at(c, s, u, v);
            if (value > 0 && c->kind == IRIS_DEPTH_DISPARITY) {
                value = 256 * (real(c->focal_q16) * real(c->baseline_q16) / value + noise_px * gauss());
            }
            depths[v * W + u] = (uint16_t)(value < 1 || value > 65535 ? 0 : floor(value + 0.5));
        }
    }
    return image;
}

static int32_t scan(const iris_image *image, const iris_depth_camera *c)
{
    iris_scratch scratch;
    int32_t count = -1;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    assert_int_equal(iris_scan_from_depth(beams, &count, image, c, &scratch), IRIS_OK);
    assert_true(scratch.used == 0 && scratch.peak == sizeof working.memory);
    return count;
}

static iris_depth_camera camera_of(iris_depth_kind kind, int degrees)
{
    iris_depth_camera c;
    iris_depth_camera_defaults(&c, (iris_size){W, H}, 70 * 65536, 100 * 65536);
    c.kind = kind;
    c.tilt = iris_angle_from_degrees(degrees);
    return c;
}

static void a_wall_ahead(void **state)
{
    (void)state;
    for (int i = 0; i < 24; i++) {
        iris_depth_camera c = camera_of(i % 2 ? IRIS_DEPTH_MM : IRIS_DEPTH_DISPARITY, i % 3 * 12 - 6);
        const scene s = {600 + 100 * i, 0, 5000};
        c.mount = (iris_map_pose){150, -20, (iris_angle)(i % 5 * 16384)};
        const iris_image image = draw(&c, &s, 0);
        const int32_t count = scan(&image, &c);
        const double turn = c.mount.heading / UNITS;
        assert_true(count > W / 2);
        for (int k = 4; k < count - 4;
             k++) { /* back into the camera's frame; tilted, its edges see floor alone */
            const double x = beams[k].x_mm - 150, y = beams[k].y_mm + 20;
            const double ahead = x * cos(turn) + y * sin(turn), left = y * cos(turn) - x * sin(turn);
            assert_true(beams[k].hit == 1 && fabs(ahead - s.wall) < 2 + s.wall * s.wall / 7000 / 256);
            const double u = real(c.u0_q16) - left / ahead * 70;
            assert_true(u > -1 && u < W && fabs(u - floor(u + 0.5)) < 0.2);
        }
    }
}

static void noise_averages_out(void **state)
{
    (void)state;
    const iris_depth_camera c = camera_of(IRIS_DEPTH_DISPARITY, 5);
    const scene s = {2000, 0, 5000};
    const iris_image image = draw(&c, &s, 0.25);
    const double single = 2000.0 * 2000 / 7000 * 0.25; /* 143 mm */
    for (int i = 0; i < W * H; i += 97) {
        depths[i] = i % 2 ? 0 : 40000; /* dropouts, and wrong matches, fewer than three to a column */
    }
    const int32_t count = scan(&image, &c);
    double sum = 0, spread = 0;
    assert_int_equal(count, W);
    for (int k = 0; k < count; k++) {
        spread += beams[k].spread_mm / (double)count;
        assert_true(abs(beams[k].x_mm - 2000) < single);
        sum += (beams[k].x_mm - 2000) / (double)count;
    }
    assert_true(fabs(sum) < 0.2 * single);
    assert_true(spread > 0.4 * single && spread < 0.7 * single); /* of about 26 pixels: 0.55 */
}

static void what_is_in_the_way(void **state)
{
    (void)state;
    iris_depth_camera c = camera_of(IRIS_DEPTH_MM, 20);
    scene s = {1500, 0, 0}; /* floor alone: free as far as it is seen, to the row that sees farthest */
    iris_image image = draw(&c, &s, 0);
    int32_t count = scan(&image, &c);
    double farthest = 0;
    for (int v = 0; v < H; v++) {
        const double y = (v - real(c.v0_q16)) / 70, tilt = c.tilt / UNITS;
        const double ahead = 200 / (sin(tilt) + y * cos(tilt)) * (cos(tilt) - y * sin(tilt));
        farthest = ahead > farthest ? fmin(ahead, 5000) : farthest;
    }
    assert_int_equal(count, W);
    for (int k = 4; k < count - 4; k++) {
        assert_true(beams[k].hit == 0 && beams[k].spread_mm == 0 && fabs(beams[k].x_mm - farthest) < 60);
    }
    s = (scene){800, 0, 300}; /* a low wall before the floor behind it */
    image = draw(&c, &s, 0);
    count = scan(&image, &c);
    assert_true(count > W - 10);
    for (int k = 0; k < count; k++) {
        assert_true(beams[k].hit == 1 && abs(beams[k].x_mm - 800) <= 2);
    }
    s = (scene){800, 1001, 3000}; /* a lintel */
    c.tilt = -6000;
    image = draw(&c, &s, 0);
    assert_int_equal(scan(&image, &c), 0);
    s = (scene){800, 0, 45}; /* a door sill */
    c.tilt = 4000;
    image = draw(&c, &s, 0);
    count = scan(&image, &c);
    for (int k = 0; k < count; k++) {
        assert_int_equal(beams[k].hit, 0);
    }
    memset(depths, 0, sizeof depths);
    assert_int_equal(scan(&image, &c), 0);
    c.tilt = 0;
    s = (scene){9000, 0, 90000}; /* beyond reach: free so far */
    image = draw(&c, &s, 0);
    count = scan(&image, &c);
    assert_int_equal(count, W);
    for (int k = 0; k < count; k++) {
        assert_true(beams[k].hit == 0 && beams[k].x_mm == 5000);
    }
}

/* A post from 150 to 350 mm to the right, 1000 ahead, seen by a camera that looks down: as wide as it is. */
static void a_post_where_it_is(void **state)
{
    (void)state;
    for (int degrees = -20; degrees <= 20; degrees += 20) {
        const iris_depth_camera c = camera_of(IRIS_DEPTH_MM, degrees);
        const scene none = {0, 1, 0}, post = {1000, 0, 5000};
        double least = 1e9, most = -1e9;
        const iris_image image = draw(&c, &none, 0);
        for (int v = 0; v < H; v++) {
            for (int u = 0; u < W; u++) {
                const double z = depth_at(&c, &post, u, v), right = z * (u - real(c.u0_q16)) / 70;
                if (right >= 150 && right <= 350) {
                    depths[v * W + u] = (uint16_t)floor(z + 0.5);
                }
            }
        }
        const int32_t count = scan(&image, &c);
        for (int k = 0; k < count; k++) {
            if (beams[k].hit && abs(beams[k].x_mm - 1000) < 10) {
                least = fmin(least, -beams[k].y_mm);
                most = fmax(most, -beams[k].y_mm);
            }
        }
        assert_true(fabs(least - 150) < 15 && fabs(most - 350) < 15); /* a column is 14 mm */
    }
}

static void parts_of_pictures(void **state)
{
    (void)state;
    const iris_depth_camera c = camera_of(IRIS_DEPTH_MM, 0);
    const scene s = {1000, 0, 9000};
    iris_image image = draw(&c, &s, 0), part;
    iris_scratch scratch;
    int32_t count = 5;
    iris_depth_camera cut = c;
    cut.u0_q16 -= 10 * 65536;
    cut.v0_q16 -= 20 * 65536;
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){10, 20, 33, 15}), IRIS_OK);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(33)),
                     IRIS_OK);
    assert_int_equal(iris_scan_from_depth(beams, &count, &part, &cut, &scratch), IRIS_OK);
    assert_int_equal(count, 33);
    for (int k = 0; k < count; k++) {
        assert_true(beams[k].x_mm == 1000 &&
                    abs(beams[k].y_mm - (int)lround((39.5 - (k + 10)) * 1000 / 70)) <= 1);
    }
    scratch.bytes--;
    count = 5;
    assert_int_equal(iris_scan_from_depth(beams, &count, &part, &cut, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_scan_from_depth(beams, &count, &part, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_scan_from_depth(beams, &count, NULL, &c, &scratch), IRIS_ERR_ARG);
    part.format = IRIS_GRAY_S16;
    assert_int_equal(iris_scan_from_depth(beams, &count, &part, &c, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(count, 5);
}

/* Fields of any value: taken or refused, and nothing else. */
static void any_cameras(void **state)
{
    (void)state;
    int taken = 0;
    for (int i = 0; i < 3000; i++) {
        iris_depth_camera c = camera_of(i % 2 ? IRIS_DEPTH_MM : IRIS_DEPTH_DISPARITY, 0);
        static const int32_t extremes[] = {INT32_MIN, -65536, -1, 0, 1, 65535, 65536, 1 << 24, INT32_MAX};
        int32_t *fields[] = {&c.focal_q16,  &c.baseline_q16, &c.u0_q16,     &c.v0_q16,
                             &c.mount.x_mm, &c.height_mm,    &c.low_mm,     &c.high_mm,
                             &c.near_mm,    &c.far_mm,       &c.spread_q16, &c.mount.y_mm};
        for (int k = 0; k < 3; k++) {
            *fields[random_u64() % 12] =
                random_u64() % 2 ? extremes[random_u64() % 9] : (int32_t)(random_u64() >> random_u64() % 32);
        }
        c.tilt = (iris_angle)(random_u64() >> random_u64() % 16);
        for (size_t k = 0; k < W * H; k++) {
            depths[k] = (uint16_t)(random_u64() >> (k % 16));
        }
        iris_image image;
        iris_scratch scratch;
        int32_t count = 0;
        assert_int_equal(
            iris_image_wrap(&image, depths, sizeof depths, (iris_size){W, H / 4}, 0, IRIS_GRAY_U16), IRIS_OK);
        assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
        const iris_status status = iris_scan_from_depth(beams, &count, &image, &c, &scratch);
        assert_true(status == IRIS_OK || (status == IRIS_ERR_ARG && count == 0));
        assert_true(count >= 0 && count <= W);
        for (int k = 0; k < count; k++) {
            assert_true(abs(beams[k].x_mm) < IRIS_SCAN_REACH_MAX_MM &&
                        abs(beams[k].y_mm) < IRIS_SCAN_REACH_MAX_MM && beams[k].spread_mm >= 0 &&
                        beams[k].spread_mm <= IRIS_SCAN_REACH_MAX_MM);
        }
        taken += status == IRIS_OK;
    }
    assert_true(taken > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges_become_beams), cmocka_unit_test(no_return),
        cmocka_unit_test(bad_range_sensors),   cmocka_unit_test(a_wall_ahead),
        cmocka_unit_test(noise_averages_out),  cmocka_unit_test(what_is_in_the_way),
        cmocka_unit_test(a_post_where_it_is),  cmocka_unit_test(parts_of_pictures),
        cmocka_unit_test(any_cameras),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
