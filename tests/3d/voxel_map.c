/* Maps of space: a wall and a floor in pictures that are drawn in double precision. */
#include "iris/3d/voxel_map.h"

#include <math.h>

#include "random_number.h"
#include "test.h"

enum { NX = 40, NY = 40, NZ = 14, W = 64, H = 48, CELL = 50 };

static int8_t odds[IRIS_VOXEL_MAP_BYTES(NX, NY, NZ)];
static uint32_t bits[IRIS_VOXEL_BYTES(NX, NY, NZ) / 4];
static uint16_t depths[W * H];
static IRIS_SCRATCH_BUFFER(working, IRIS_VOXEL_MAP_FUSE_SCRATCH_BYTES(NX, NY, NZ));
static const int32_t counts[3] = {NX, NY, NZ}, least[3] = {-1000, -1000, -100};

static iris_voxel_map empty_map(void)
{
    iris_voxel_map map;
    assert_int_equal(iris_voxel_map_init(&map, odds, sizeof odds, counts, CELL, least), IRIS_OK);
    return map;
}

static iris_depth_camera camera_of(void)
{
    iris_depth_camera c;
    iris_depth_camera_defaults(&c, (iris_size){W, H}, 60 * 65536, 80 * 65536);
    c.kind = IRIS_DEPTH_MM;
    c.spread_q16 = 0;
    c.height_mm = 225;
    c.tilt = iris_angle_from_degrees(12);
    return c;
}

/* A wall `away` ahead of the lens, up to `top`, and the floor. */
static iris_image draw(const iris_depth_camera *c, double away, double top)
{
    iris_image image;
    const double tilt = c->tilt * 6.283185307179586 / 65536;
    for (int v = 0; v < H; v++) {
        const double y = (v - (H - 1) / 2.0) / 60, ahead = cos(tilt) - y * sin(tilt),
                     down = sin(tilt) + y * cos(tilt), z = away / ahead, height = c->height_mm - z * down;
        const double depth = height >= 0 && height <= top ? z : down > 0 ? c->height_mm / down : 0;
        for (int u = 0; u < W; u++) {
            depths[v * W + u] = (uint16_t)(depth > 65535 ? 0 : floor(depth + 0.5));
        }
    }
    assert_int_equal(iris_image_wrap(&image, depths, sizeof depths, (iris_size){W, H}, 0, IRIS_GRAY_U16),
                     IRIS_OK);
    return image;
}

static iris_status fuse(const iris_voxel_map *map, iris_map_pose robot, const iris_image *image,
                        const iris_depth_camera *c, const iris_voxel_fusion *config)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    const iris_status status = iris_voxel_map_fuse(map, robot, image, c, config, &scratch);
    assert_true(scratch.used == 0 && (status != IRIS_OK || scratch.peak == sizeof working.memory));
    return status;
}

static int at(int x, int y, int z)
{
    return odds[(z * NY + y) * NX + x];
}

static void a_wall_and_a_floor(void **state)
{
    (void)state;
    const iris_voxel_map map = empty_map();
    const iris_depth_camera c = camera_of();
    const iris_image image =
        draw(&c, 820, 430); /* the wall is at x = 20 + 820, in the 37th voxels: 800 to 850 less 1000 */
    const iris_voxel_fusion all = {{14, 6, 64}, 1};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(fuse(&map, (iris_map_pose){20, 25, 0}, &image, &c, &all), IRIS_OK);
    }
    int walls = 0, floors = 0, open = 0;
    for (int y = 0; y < NY; y++) {
        for (int z = 0; z < NZ; z++) {
            assert_true(at(37, y, z) <= 0 &&
                        at(38, y, z) <= 0); /* behind it nothing is known, or free above it */
            const double side = -1000 + CELL * (y + 0.5) - 25;
            if (fabs(side) < 350 && z >= 3 && z < 10) { /* heights 50 to 400, well in view */
                assert_true(at(36, y, z) >= IRIS_ODDS_OCCUPIED);
                walls++;
            }
        }
        for (int x = 0; x < 36; x++) {
            assert_true(at(x, y, 1) <= 0 && at(x, y, 0) <= 0); /* nothing is below the floor */
            floors += at(x, y, 2) >= IRIS_ODDS_OCCUPIED;       /* heights 0 to 50 */
            open += at(x, y, 6) <= IRIS_ODDS_FREE;
            assert_true(at(x, y, 6) <= 0);
        }
    }
    assert_true(walls == 13 * 7 && floors > 100 && open > 100);

    iris_voxel_world world;
    int32_t solid = 0, wanted = 0;
    for (size_t i = 0; i < sizeof odds; i++) {
        wanted += odds[i] >= IRIS_ODDS_OCCUPIED;
    }
    assert_int_equal(iris_voxel_map_solid(&world, bits, sizeof bits, &map, IRIS_ODDS_OCCUPIED), IRIS_OK);
    assert_int_equal(iris_voxel_count(&solid, &world), IRIS_OK);
    assert_int_equal(solid, wanted);
    assert_int_equal(iris_voxel_get(&world, (iris_voxel){36, 20, 5}), 1);
    iris_vec3 center;
    assert_int_equal(iris_voxel_center(&center, &world, (iris_voxel){36, 20, 5}), IRIS_OK);
    assert_true(fabs((double)center.x / 4294967296.0 - 0.825) < 1e-8 &&
                fabs((double)center.z / 4294967296.0 - 0.175) < 1e-8);
    assert_int_equal(iris_voxel_map_solid(&world, bits, sizeof bits - 1, &map, 1), IRIS_ERR_RANGE);
}

/* Seen from any side, the wall is where it is; and it saturates. */
static void from_all_sides(void **state)
{
    (void)state;
    const iris_depth_camera c = camera_of();
    const iris_image image = draw(&c, 500, 430);
    for (int side = 0; side < 4; side++) {
        const iris_voxel_map map = empty_map();
        for (int i = 0; i < 40; i++) {
            assert_int_equal(
                fuse(&map, (iris_map_pose){25, 25, iris_angle_wrap(16384 * side)}, &image, &c, NULL),
                IRIS_OK);
        }
        const int x = side == 0 ? 30 : side == 2 ? 10 : 20, y = side == 1 ? 30 : side == 3 ? 10 : 20;
        assert_int_equal(at(x, y, 6), 64);
        assert_int_equal(at(20, 20, 6), -64);
    }
}

static void far_and_unsure(void **state)
{
    (void)state;
    iris_depth_camera c = camera_of();
    const iris_image image = draw(&c, 820, 430);
    iris_voxel_map map = empty_map();
    c.far_mm = 600; /* all that is farther frees so far */
    assert_int_equal(fuse(&map, (iris_map_pose){20, 25, 0}, &image, &c, NULL), IRIS_OK);
    assert_true(at(30, 20, 6) < 0 && at(31, 20, 6) < 0 && at(33, 20, 6) == 0 && at(36, 20, 6) == 0);
    map = empty_map();
    c = camera_of();
    c.spread_q16 = 65536 * 300; /* 202 mm */
    assert_int_equal(fuse(&map, (iris_map_pose){20, 25, 0}, &image, &c, NULL), IRIS_OK);
    assert_true(at(36, 20, 6) == 0 && at(32, 20, 6) == 0 && at(22, 20, 6) < 0);
}

static void refusals(void **state)
{
    (void)state;
    iris_voxel_map map = empty_map(), other = map;
    const iris_depth_camera c = camera_of();
    iris_image image = draw(&c, 500, 430);
    iris_scratch scratch;
    const int32_t none[3] = {NX, 0, NZ}, many[3] = {1025, 1, 1}, far[3] = {IRIS_MAP_PLACE_MAX_MM, 0, 0};
    assert_int_equal(iris_voxel_map_init(&other, odds, sizeof odds, none, CELL, least), IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_map_init(&other, odds, sizeof odds, many, CELL, least), IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_map_init(&other, odds, sizeof odds, counts, 0, least), IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_map_init(&other, odds, sizeof odds, counts, CELL, far), IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_map_init(&other, odds, sizeof odds - 1, counts, CELL, least), IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_map_init(NULL, odds, sizeof odds, counts, CELL, least), IRIS_ERR_ARG);
    const iris_map_pose in = {0, 0, 0};
    assert_int_equal(fuse(&map, (iris_map_pose){1000, 0, 0}, &image, &c, NULL), IRIS_ERR_RANGE);
    assert_int_equal(fuse(&map, (iris_map_pose){INT32_MIN, INT32_MAX, 0}, &image, &c, NULL), IRIS_ERR_RANGE);
    const iris_voxel_fusion bad = {{14, 6, 64}, 0};
    assert_int_equal(fuse(&map, in, &image, &c, &bad), IRIS_ERR_ARG);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory - 1), IRIS_OK);
    assert_int_equal(iris_voxel_map_fuse(&map, in, &image, &c, NULL, &scratch), IRIS_ERR_SCRATCH);
    image.format = IRIS_GRAY_S16;
    assert_int_equal(fuse(&map, in, &image, &c, NULL), IRIS_ERR_FORMAT);
    map.counts[0] = 0;
    assert_int_equal(fuse(&map, in, &image, &c, NULL), IRIS_ERR_ARG);
    for (size_t i = 0; i < sizeof odds; i++) {
        assert_int_equal(odds[i], 0);
    }
}

static void any_pictures(void **state)
{
    (void)state;
    const iris_voxel_map map = empty_map();
    for (int i = 0; i < 60; i++) {
        iris_depth_camera c = camera_of();
        iris_image image;
        c.kind = i % 2 ? IRIS_DEPTH_DISPARITY : IRIS_DEPTH_MM;
        c.focal_q16 = i % 3 ? c.focal_q16 : 65536;
        c.far_mm = i % 5 ? 5000 : 65535;
        c.tilt = (iris_angle)(random_u64() % 20000 - 10000);
        c.u0_q16 = i % 7 ? c.u0_q16 : INT32_MIN;
        for (size_t k = 0; k < W * H; k++) {
            depths[k] = (uint16_t)(random_u64() >> (k % 16));
        }
        assert_int_equal(iris_image_wrap(&image, depths, sizeof depths, (iris_size){W, H}, 0, IRIS_GRAY_U16),
                         IRIS_OK);
        assert_int_equal(fuse(&map, (iris_map_pose){0, 0, (iris_angle)random_u64()}, &image, &c, NULL),
                         IRIS_OK);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wall_and_a_floor), cmocka_unit_test(from_all_sides),
        cmocka_unit_test(far_and_unsure),     cmocka_unit_test(refusals),
        cmocka_unit_test(any_pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
