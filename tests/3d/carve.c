/* Worlds of voxels, their footprints, and carving, against double precision and against each voxel asked by itself. */
#include "iris/3d/carve.h"

#include <math.h>
#include <stdio.h>

#include "random3d.h"
#include "test.h"

enum { NX = 37, NY = 19, NZ = 22, W = 96, H = 80 };

static uint32_t bits[IRIS_VOXEL_ROW_WORDS(NX) * NY * NZ];
static uint32_t pixels[IRIS_VOXEL_ROW_WORDS(W) * H];
static IRIS_SCRATCH_BUFFER(working, IRIS_CARVE_SCRATCH_BYTES(W, H));

static iris_q32 q32(double a)
{
    return (iris_q32)llround(a * 4294967296.0);
}

static double random_double(double least, double most)
{
    return least + (most - least) * (double)(random_u64() >> 11) / 9007199254740992.0;
}

static iris_voxel_world world_of(double least, double most)
{
    static const int32_t counts[3] = {NX, NY, NZ};
    const iris_vec3 corners[2] = {{q32(least), q32(least), q32(least)}, {q32(most), q32(most), q32(most)}};
    iris_voxel_world world;
    assert_int_equal(sizeof bits, IRIS_VOXEL_BYTES(NX, NY, NZ));
    assert_int_equal(iris_voxel_world_init(&world, bits, sizeof bits, counts, corners), IRIS_OK);
    assert_int_equal(iris_voxel_fill(&world, 1), IRIS_OK);
    return world;
}

static iris_image empty_silhouette(void)
{
    iris_image image;
    memset(pixels, 0, sizeof pixels);
    assert_int_equal(iris_image_wrap(&image, pixels, sizeof pixels, (iris_size){W, H}, 0, IRIS_MASK1),
                     IRIS_OK);
    return image;
}

static void select_pixel(int x, int y)
{
    pixels[(size_t)y * IRIS_VOXEL_ROW_WORDS(W) + (size_t)x / 32] |= (uint32_t)1 << (x % 32);
}

static int is_selected(int x, int y)
{
    return (pixels[(size_t)y * IRIS_VOXEL_ROW_WORDS(W) + (size_t)x / 32] >> (x % 32) & 1u) != 0;
}

static void carve(const iris_voxel_world *world, const iris_image *silhouette, const iris_q32 m[12])
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    assert_int_equal(iris_carve_view(world, silhouette, m, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, sizeof working.memory);
    assert_int_equal(scratch.used, 0);
}

static int32_t count_of(const iris_voxel_world *world)
{
    int32_t count = -1;
    assert_int_equal(iris_voxel_count(&count, world), IRIS_OK);
    return count;
}

static double along(iris_q32 least, iris_q32 most, double share)
{
    return real(least) + (real(most) - real(least)) * share;
}

/* Where in a brick: 0.5 each is its middle. */
static void place_of(double at[3], const iris_voxel_world *world, iris_voxel v, const double part[3])
{
    at[0] = along(world->least.x, world->most.x, (v.x + part[0]) / world->counts[0]);
    at[1] = along(world->least.y, world->most.y, (v.y + part[1]) / world->counts[1]);
    at[2] = along(world->least.z, world->most.z, (v.z + part[2]) / world->counts[2]);
}

/* W; u and v are where M shows the place. */
static double show(double uv[2], const iris_q32 m[12], const double at[3])
{
    double h[3];
    for (int i = 0; i < 3; i++) {
        h[i] = real(m[4 * i]) * at[0] + real(m[4 * i + 1]) * at[1] + real(m[4 * i + 2]) * at[2] +
               real(m[4 * i + 3]);
    }
    uv[0] = h[0] / h[2];
    uv[1] = h[1] / h[2];
    return h[2];
}

/* A camera that looks from `from` to the middle of the world at (0, 0, 0), its x axis as level as it goes. */
static void looking(iris_q32 m[12], double x, double y, double z, double focal)
{
    const double length = sqrt(x * x + y * y + z * z), f[3] = {-x / length, -y / length, -z / length};
    double r[3] = {f[2], 0, -f[0]};
    const double level = sqrt(r[0] * r[0] + r[2] * r[2]);
    r[0] = level > 0.01 ? r[0] / level : 1;
    r[2] = level > 0.01 ? r[2] / level : 0;
    const double d[3] = {f[1] * r[2] - f[2] * r[1], f[2] * r[0] - f[0] * r[2], f[0] * r[1] - f[1] * r[0]};
    iris_sensor camera = {.intrinsics = {q32(focal), q32(focal), 0, q32(W / 2 - 0.4), q32(H / 2 - 0.3)},
                          .pose = {{{0}}, {q32(x), q32(y), q32(z)}}};
    for (int i = 0; i < 3; i++) {
        camera.pose.turn.m[i] = q32(r[i]);
        camera.pose.turn.m[3 + i] = q32(d[i]);
        camera.pose.turn.m[6 + i] = q32(f[i]);
    }
    iris_sensor_matrix(m, &camera);
}

/* Does the view keep the voxel, in double precision: 1, 0; -1: it is on the edge of a pixel, or of what is seen. */
static int keeps(const iris_voxel_world *world, const iris_q32 m[12], iris_voxel v)
{
    static const double middle[3] = {0.5, 0.5, 0.5};
    double at[3], uv[2];
    place_of(at, world, v, middle);
    const double depth = show(uv, m, at);
    if (fabs(depth) < 1e-6) {
        return -1;
    }
    if (depth < 0) {
        return 1;
    }
    const double x = floor(uv[0] + 0.5), y = floor(uv[1] + 0.5);
    if (fabs(fabs(uv[0] + 0.5 - x) - 0.5) > 0.4999 || fabs(fabs(uv[1] + 0.5 - y) - 0.5) > 0.4999) {
        return -1;
    }
    return x < 0 || y < 0 || x >= W || y >= H || is_selected((int)x, (int)y);
}

/* Each voxel of `before` as `keeps` says; how many were certain and gone. */
static int assert_carved(const iris_voxel_world *world, const uint32_t *before, const iris_q32 m[12])
{
    iris_voxel_world old = *world;
    int gone = 0, certain = 0;
    static uint32_t copy[sizeof bits / 4];
    memcpy(copy, before, sizeof copy);
    old.bits = copy;
    for (int32_t z = 0; z < NZ; z++) {
        for (int32_t y = 0; y < NY; y++) {
            for (int32_t x = 0; x < NX; x++) {
                const iris_voxel v = {x, y, z};
                const int kept = keeps(world, m, v);
                if (kept >= 0) {
                    assert_int_equal(iris_voxel_get(world, v), kept && iris_voxel_get(&old, v));
                    gone += !kept;
                    certain++;
                }
            }
        }
    }
    assert_true(certain > NX * NY * NZ * 9 / 10);
    return gone;
}

/* --- worlds --- */

static void voxels_are_bits(void **state)
{
    (void)state;
    const iris_voxel_world world = world_of(-1, 1);
    const iris_voxel v = {33, 7, 5};
    assert_int_equal(count_of(&world), NX * NY * NZ);
    assert_int_equal(bits[1], 0x1F);
    assert_int_equal(iris_voxel_set(&world, v, 0), IRIS_OK);
    assert_int_equal(count_of(&world), NX * NY * NZ - 1);
    assert_int_equal(iris_voxel_get(&world, v), 0);
    assert_int_equal(bits[2 * (5 * NY + 7) + 1], 0x1D);
    assert_int_equal(iris_voxel_fill(&world, 0), IRIS_OK);
    assert_int_equal(iris_voxel_set(&world, v, 7), IRIS_OK);
    assert_int_equal(iris_voxel_get(&world, v), 1);
    bits[1] |= 0xFFFFFFE0; /* behind the end of a row: not voxels */
    assert_int_equal(count_of(&world), 1);
    assert_int_equal(iris_voxel_get(&world, (iris_voxel){NX, 0, 0}), 0);
    assert_int_equal(iris_voxel_get(&world, (iris_voxel){0, -1, 0}), 0);
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){0, 0, NZ}, 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){NX, 0, 0}, 1), IRIS_ERR_RANGE);
}

static void surface_as_by_neighbors(void **state)
{
    (void)state;
    static iris_voxel listed[NX * NY * NZ];
    const iris_voxel_world world = world_of(-1, 1);
    for (int i = 0; i < 900; i++) {
        bits[random_u64() % (sizeof bits / 4)] &= ~((uint32_t)1 << (random_u64() % 32));
    }
    bits[1] |= 0xFFFFFFE0; /* not voxels */
    int32_t count = -1, expected = 0;
    assert_int_equal(iris_voxel_surface(listed, NX * NY * NZ, &count, &world), IRIS_OK);
    for (int32_t i = 0; i < NX * NY * NZ; i++) {
        const iris_voxel v = {i % NX, i / NX % NY, i / NX / NY};
        int inner = iris_voxel_get(&world, v);
        for (int side = 0; side < 6; side++) {
            const int step = side % 2 ? 1 : -1;
            const iris_voxel beside = {v.x + (side / 2 == 0) * step, v.y + (side / 2 == 1) * step,
                                       v.z + (side / 2 == 2) * step};
            inner = inner && iris_voxel_get(&world, beside);
        }
        if (iris_voxel_get(&world, v) && !inner) {
            assert_memory_equal(&listed[expected], &v, sizeof v);
            expected++;
        }
    }
    assert_int_equal(count, expected);
    assert_true(expected > 1000 && expected < count_of(&world));
    memset(listed, 0x77, sizeof listed);
    assert_int_equal(iris_voxel_surface(listed, 5, &count, &world), IRIS_ERR_FULL);
    assert_int_equal(count, expected);
    assert_int_equal(listed[5].x, 0x77777777);
    assert_int_equal(iris_voxel_surface(NULL, 0, &count, &world), IRIS_OK);
    assert_int_equal(count, expected);
}

static void centers_and_footprints(void **state)
{
    (void)state;
    static const double sizes[] = {0.05, 1, 300};
    for (int i = 0; i < 300; i++) {
        const double size = sizes[i % 3];
        const iris_voxel_world world = world_of(-size, size);
        const iris_voxel v = {(int32_t)(random_u64() % NX), (int32_t)(random_u64() % NY),
                              (int32_t)(random_u64() % NZ)};
        static const double middle[3] = {0.5, 0.5, 0.5};
        double at[3], uv[2], bounds[4] = {1e9, 1e9, -1e9, -1e9};
        iris_q32 m[12];
        iris_vec3 center;
        iris_voxel_view view;
        iris_voxel_bounds seen;
        looking(m, size * (3 + i % 5), size * (i % 7 - 3), size * (4 - i % 4), 700);
        assert_int_equal(iris_voxel_center(&center, &world, v), IRIS_OK);
        place_of(at, &world, v, middle);
        assert_true(fabs(real(center.x) - at[0]) < 1e-9 && fabs(real(center.y) - at[1]) < 1e-9 &&
                    fabs(real(center.z) - at[2]) < 1e-9);
        for (int corner = 0; corner < 8; corner++) {
            place_of(at, &world, v, (const double[3]){corner & 1, corner >> 1 & 1, corner >> 2});
            show(uv, m, at);
            for (int k = 0; k < 2; k++) {
                bounds[k] = fmin(bounds[k], uv[k]);
                bounds[2 + k] = fmax(bounds[2 + k], uv[k]);
            }
        }
        assert_int_equal(iris_voxel_view_init(&view, &world, m), IRIS_OK);
        assert_int_equal(iris_voxel_footprint(&seen, &world, &view, v), IRIS_OK);
        assert_true(fabs(real(seen.least.x) - bounds[0]) < 1e-6 &&
                    fabs(real(seen.least.y) - bounds[1]) < 1e-6);
        assert_true(fabs(real(seen.most.x) - bounds[2]) < 1e-6 && fabs(real(seen.most.y) - bounds[3]) < 1e-6);
    }
}

/* A lamp 2 above the floor z = 1, over a world from -0.5 to 0.5: shadows are 2 / (z + 1) times as large. */
static void shadows_on_a_plane(void **state)
{
    (void)state;
    const iris_voxel_world world = world_of(-0.5, 0.5);
    iris_pose plane = {.place = {q32(0.25), 0, q32(1)}};
    iris_q32 m[12];
    iris_voxel_view view;
    iris_voxel_bounds shadow;
    iris_mat3_identity(&plane.turn);
    assert_int_equal(iris_voxel_plane_matrix(m, &plane, (iris_vec3){0, 0, q32(-1)}), IRIS_OK);
    assert_int_equal(iris_voxel_view_init(&view, &world, m), IRIS_OK);
    assert_int_equal(iris_voxel_footprint(&shadow, &world, &view, (iris_voxel){0, NY - 1, 0}), IRIS_OK);
    /* Its upper face is at z = -0.5, its lower one nearer to the floor; x from -0.5, y up to 0.5. */
    assert_true(fabs(real(shadow.least.x) - (-0.5 * 4 - 0.25)) < 1e-6);
    assert_true(fabs(real(shadow.most.x) - ((-0.5 + 1.0 / NX) * 2 / (0.5 + 1.0 / NZ) - 0.25)) < 1e-6);
    assert_true(fabs(real(shadow.least.y) - (0.5 - 1.0 / NY) * 2 / (0.5 + 1.0 / NZ)) < 1e-6);
    assert_true(fabs(real(shadow.most.y) - 0.5 * 4) < 1e-6);
    m[0] = 77;
    assert_int_equal(iris_voxel_plane_matrix(m, &plane, (iris_vec3){0, 0, q32(1)}), IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_plane_matrix(m, &plane, (iris_vec3){0, 0, q32(3)}), IRIS_ERR_RANGE);
    assert_int_equal(m[0], 77);
}

/* --- carving --- */

/* Cameras so far away that rays are parallel: along each axis they see a rectangle, and a box is left. */
static void box_from_three_far_cameras(void **state)
{
    (void)state;
    static const double from[3][3] = {{20000, 0, 0}, {0, 20000, 0}, {0, 0, 20000}};
    const double low[3] = {-0.52, -0.31, -0.71}, high[3] = {0.33, 0.48, 0.22};
    const iris_voxel_world world = world_of(-1, 1);
    for (int i = 0; i < 3; i++) {
        const iris_image silhouette = empty_silhouette();
        iris_q32 m[12];
        double corner[2], other[2];
        looking(m, from[i][0], from[i][1], from[i][2], 700000);
        show(corner, m, low);
        show(other, m, high);
        for (int32_t n = 0; n < W * H; n++) {
            const double x = n % W, y = n / W;
            if ((x - corner[0]) * (x - other[0]) <= 0 && (y - corner[1]) * (y - other[1]) <= 0) {
                select_pixel(n % W, n / W);
            }
        }
        carve(&world, &silhouette, m);
    }
    int32_t inside = 0;
    for (int32_t i = 0; i < NX * NY * NZ; i++) {
        static const double middle[3] = {0.5, 0.5, 0.5};
        const iris_voxel v = {i % NX, i / NX % NY, i / NX / NY};
        double at[3], least = 1;
        place_of(at, &world, v, middle);
        for (int k = 0; k < 3; k++) {
            least = fmin(least, fmin(at[k] - low[k], high[k] - at[k]));
        }
        if (fabs(least) > 0.016) { /* half a pixel is 1/70 */
            assert_int_equal(iris_voxel_get(&world, v), least > 0);
        }
        inside += least > 0;
    }
    assert_true(abs(inside - count_of(&world)) < inside / 6 && inside > 500);
}

/* A ball's silhouettes from six sides, pixel by pixel: the hull is what all views keep, and contains the ball. */
static void sphere_from_six_sides(void **state)
{
    (void)state;
    static const double from[6][3] = {{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0, -3}};
    static uint32_t before[sizeof bits / 4];
    const iris_voxel_world world = world_of(-1, 1);
    const double radius = 0.7;
    for (int i = 0; i < 6; i++) {
        const iris_image silhouette = empty_silhouette();
        const double focal = 95, tangent = radius / sqrt(9 - radius * radius);
        iris_q32 m[12];
        looking(m, from[i][0], from[i][1], from[i][2], focal);
        for (int32_t n = 0; n < W * H;
             n++) { /* the ball is in the middle of the view: a cone around its axis */
            if (hypot(n % W - (W / 2 - 0.4), n / W - (H / 2 - 0.3)) <= focal * tangent + 0.71) {
                select_pixel(n % W, n / W);
            }
        }
        memcpy(before, bits, sizeof bits);
        carve(&world, &silhouette, m);
        assert_true(assert_carved(&world, before, m) > 1000);
    }
    for (int32_t i = 0; i < NX * NY * NZ; i++) {
        static const double middle[3] = {0.5, 0.5, 0.5};
        const iris_voxel v = {i % NX, i / NX % NY, i / NX / NY};
        double at[3];
        place_of(at, &world, v, middle);
        const double away = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
        assert_true(away > radius || iris_voxel_get(&world, v));
        assert_true(away < radius * 1.5 || !iris_voxel_get(&world, v));
    }
}

/* Blots at random, cameras near and inside of the world: blocks decide as each of their voxels does. */
static void blocks_as_voxels(void **state)
{
    (void)state;
    static uint32_t before[sizeof bits / 4];
    int gone = 0;
    for (int i = 0; i < 24; i++) {
        static const double sizes[] = {0.05, 1, 400};
        const double size = sizes[i % 3], away = 0.3 + i % 5;
        const iris_voxel_world world = world_of(-size, size);
        const iris_image silhouette = empty_silhouette();
        iris_q32 m[12];
        looking(m, size * away * (1 + i % 2), size * (i % 7 - 3), size * (i % 4 - 1.5), 40 + 10 * (i % 9));
        for (int blot = 0; blot < 1 + i % 6; blot++) {
            const double x = random_double(0, W), y = random_double(0, H), r = random_double(2, 30);
            for (int32_t n = 0; n < W * H; n++) {
                if (hypot(n % W - x, n / W - y) < r) {
                    select_pixel(n % W, n / W);
                }
            }
        }
        memcpy(before, bits, sizeof bits);
        carve(&world, &silhouette, m);
        gone += assert_carved(&world, before, m);
    }
    assert_true(gone > 24 * NX * NY * NZ / 10);
}

static void what_is_not_seen_stays(void **state)
{
    (void)state;
    const iris_image nothing = empty_silhouette();
    iris_voxel_world world = world_of(-1, 1);
    iris_q32 m[12], behind[12];
    looking(m, 5, 0.1, 0.2, 60);
    for (int i = 0; i < 12; i++) {
        behind[i] = -m[i];
    }
    carve(&world, &nothing, behind);
    assert_int_equal(count_of(&world), NX * NY * NZ);
    for (int i = 0; i < 4; i++) { /* beside the picture: u and v moved by 300 pixels */
        iris_q32 beside[12];
        memcpy(beside, m, sizeof m);
        for (int k = 0; k < 4; k++) {
            beside[4 * (i / 2) + k] += (i % 2 ? 300 : -300) * m[8 + k];
        }
        carve(&world, &nothing, beside);
        assert_int_equal(count_of(&world), NX * NY * NZ);
    }
    carve(&world, &nothing, m); /* all in the picture, and no object */
    assert_int_equal(count_of(&world), 0);
    world = world_of(-1, 1);
    memset(pixels, 0xFF, sizeof pixels); /* all object */
    carve(&world, &nothing, m);
    assert_int_equal(count_of(&world), NX * NY * NZ);
}

/* --- the file --- */

static void ply(void **state)
{
    (void)state;
    static char text[4000];
    iris_memory_sink memory = {(uint8_t *)text, sizeof text - 1, 0};
    const iris_voxel_world world = world_of(-0.037, 0.037);
    double x, y, z, second[3];
    int count = 0, at = 0;
    assert_int_equal(iris_voxel_fill(&world, 0), IRIS_OK);
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){0, 0, 0}, 1), IRIS_OK);
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){NX / 2, NY / 2, NZ - 1}, 1), IRIS_OK);
    assert_int_equal(iris_carve_write_ply(iris_sink_memory(&memory), &world), IRIS_OK);
    assert_int_equal(sscanf(text,
                            "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double "
                            "y\nproperty double z\nend_header\n%n",
                            &count, &at),
                     1);
    assert_int_equal(count, 2);
    assert_int_equal(
        sscanf(text + at, "%lf %lf %lf\n%lf %lf %lf\n", &x, &y, &z, second, second + 1, second + 2), 6);
    assert_true(fabs(x + 0.036) < 2e-9 && fabs(y + 0.037 * 18 / 19) < 2e-9 &&
                fabs(z + 0.037 * 21 / 22) < 2e-9);
    assert_true(fabs(second[0]) < 2e-9 && fabs(second[1]) < 2e-9 && fabs(second[2] - 0.037 * 21 / 22) < 2e-9);
    assert_int_equal(text[memory.used - 1], '\n');
    for (size_t room = 0; room < memory.used; room += 7) {
        iris_memory_sink small = {(uint8_t *)text, room, 0};
        assert_int_equal(iris_carve_write_ply(iris_sink_memory(&small), &world), IRIS_ERR_IO);
    }
}

static void refusals(void **state)
{
    (void)state;
    iris_voxel_world world = world_of(-1, 1), made = {.bits = NULL};
    iris_image silhouette = empty_silhouette();
    iris_q32 m[12], zero[12] = {0};
    iris_scratch scratch;
    iris_vec3 corners[2] = {world.least, world.most};
    looking(m, 5, 0, 0, 60);
    assert_int_equal(iris_voxel_world_init(&made, bits, sizeof bits - 1, world.counts, corners),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_world_init(&made, bits, sizeof bits, (const int32_t[3]){0, 1, 1}, corners),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_voxel_world_init(&made, bits, sizeof bits, (const int32_t[3]){1, 1025, 1}, corners),
                     IRIS_ERR_RANGE);
    corners[1].y = corners[0].y;
    assert_int_equal(iris_voxel_world_init(&made, bits, sizeof bits, world.counts, corners), IRIS_ERR_RANGE);
    corners[1].y = IRIS_VOXEL_PLACE_MAX;
    assert_int_equal(iris_voxel_world_init(&made, bits, sizeof bits, world.counts, corners), IRIS_ERR_RANGE);
    assert_null(made.bits);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory - 1), IRIS_OK);
    assert_int_equal(iris_carve_view(&world, &silhouette, m, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    assert_int_equal(iris_carve_view(&world, &silhouette, zero, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_carve_view(&world, &silhouette, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_view(&made, &silhouette, m, &scratch), IRIS_ERR_ARG);
    silhouette.format = IRIS_GRAY8;
    silhouette.w = 8;
    assert_int_equal(iris_carve_view(&world, &silhouette, m, &scratch), IRIS_ERR_FORMAT);
    silhouette.w = 0;
    assert_int_equal(iris_carve_view(&world, &silhouette, m, &scratch), IRIS_ERR_ARG);
    assert_int_equal(count_of(&world), NX * NY * NZ);
    assert_int_equal(iris_voxel_surface(NULL, 1, &(int32_t){0}, &world), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_write_ply((iris_sink){NULL, NULL}, &world), IRIS_ERR_ARG);
}

/* Any matrix, any box: the sanitizers look on. */
static void any_numbers(void **state)
{
    (void)state;
    const iris_image silhouette = empty_silhouette();
    for (int i = 0; i < 60; i++) {
        iris_voxel_world world = world_of(-1, 1);
        const int bits_of_place = (int)(random_u64() % 60);
        iris_q32 m[12];
        iris_voxel_view view;
        iris_voxel_bounds bounds;
        world.least.x = -((iris_q32)1 << bits_of_place);
        world.most.x = IRIS_VOXEL_PLACE_MAX - 1;
        for (int k = 0; k < 12; k++) {
            m[k] = (int64_t)random_u64() >> (i % 5 * 15);
            m[k] = i % 7 == 0 ? INT64_MIN : m[k];
        }
        carve(&world, &silhouette, m);
        assert_int_equal(iris_voxel_view_init(&view, &world, m), IRIS_OK);
        (void)iris_voxel_footprint(&bounds, &world, &view, (iris_voxel){i % NX, i % NY, i % NZ});
        for (int k = 0; k < 3; k++) {
            view.at[k] = (int64_t)random_u64();
            view.step[k][i % 3] = (int64_t)random_u64();
        }
        (void)iris_voxel_footprint(&bounds, &world, &view, (iris_voxel){i % NX, i % NY, i % NZ});
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(voxels_are_bits),
        cmocka_unit_test(surface_as_by_neighbors),
        cmocka_unit_test(centers_and_footprints),
        cmocka_unit_test(shadows_on_a_plane),
        cmocka_unit_test(box_from_three_far_cameras),
        cmocka_unit_test(sphere_from_six_sides),
        cmocka_unit_test(blocks_as_voxels),
        cmocka_unit_test(what_is_not_seen_stays),
        cmocka_unit_test(ply),
        cmocka_unit_test(refusals),
        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
