/* Photo-consistent carving of solids that the test renders itself, ray by ray in double precision: what is hollow opens,
 * and what is solid stays. */
#include "iris/3d/carve_photo.h"

#include <math.h>
#include <stdio.h>

#include "iris/3d/carve.h"
#include "random3d.h"
#include "test.h"

enum { N = 24, W = 84, H = 64, VIEWS = 13, ROOM = N * N * 8 };

#define BOX   0.6  /* half a side of the world */
#define BLOCK 0.5  /* of the solid block */
#define PIT   0.38 /* radius of the hollow in its upper side, z = -BLOCK */
#define FOCAL 110.0
#define PI    3.14159265358979323846

typedef enum { PITTED_BLOCK, BALL } solid;

static uint32_t bits[IRIS_VOXEL_ROW_WORDS(N) * N * N];
static uint8_t pixels[VIEWS][H][W][3];
static uint32_t masks[VIEWS][H][IRIS_VOXEL_ROW_WORDS(W)];
static iris_image silhouettes[VIEWS];
static iris_carve_photo photos[VIEWS];
static IRIS_SCRATCH_BUFFER(working, IRIS_CARVE_PHOTO_SCRATCH_BYTES(N, VIEWS, W, H));
static IRIS_SCRATCH_BUFFER(hull_memory, IRIS_CARVE_SCRATCH_BYTES(W, H));
static IRIS_SCRATCH_BUFFER(color_memory, IRIS_CARVE_COLORS_SCRATCH_BYTES(N, VIEWS, W, H, ROOM));
static iris_carve_color colors[ROOM];
static iris_voxel listed[ROOM];

static iris_q32 q32(double a)
{
    return (iris_q32)llround(a * 4294967296.0);
}

/* --- the scene --- */

static int is_solid(solid s, const double p[3])
{
    if (s == BALL) {
        return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] < BLOCK * BLOCK;
    }
    const double above = p[2] + BLOCK;
    return fabs(p[0]) < BLOCK && fabs(p[1]) < BLOCK && fabs(p[2]) < BLOCK &&
           p[0] * p[0] + p[1] * p[1] + above * above > PIT * PIT;
}

/* A color for each place, which changes over several voxels. */
static void paint(double color[3], const double p[3])
{
    for (int k = 0; k < 3; k++) {
        const double f = 7 + 2.3 * k;
        color[k] =
            128 + 32 * (sin(f * p[0] + 1.3 * k) + sin(1.13 * f * p[1] + 2 + k) + sin(0.91 * f * p[2] + k));
    }
}

/* Where the ray first meets the solid: in steps of a fiftieth, and then by halves. */
static int meet(double hit[3], solid s, const double from[3], const double ray[3])
{
    double along = 0, out = 0;
    for (int k = 0; k < 3; k++) {
        along -= from[k] * ray[k];
        out += from[k] * from[k];
    }
    const double half = sqrt(fmax(0.76 - (out - along * along), 0)); /* in a ball around the block */
    for (double t = fmax(along - half, 0); t < along + half; t += 0.02) {
        for (int k = 0; k < 3; k++) {
            hit[k] = from[k] + t * ray[k];
        }
        if (is_solid(s, hit)) {
            double low = t - 0.02, high = t;
            for (int step = 0; step < 12; step++) {
                const double middle = (low + high) / 2;
                for (int k = 0; k < 3; k++) {
                    hit[k] = from[k] + middle * ray[k];
                }
                low = is_solid(s, hit) ? low : middle;
                high = is_solid(s, hit) ? middle : high;
            }
            return 1;
        }
    }
    return 0;
}

/* A camera that looks from `from` to the middle, z up the picture as far as it goes. */
static void look_from(iris_q32 m[12], double turn[9], const double from[3])
{
    const double away = sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]);
    const double level = hypot(from[0], from[1]);
    const double f[3] = {-from[0] / away, -from[1] / away, -from[2] / away};
    const double r[3] = {level > 0.01 ? from[1] / level : 1, level > 0.01 ? -from[0] / level : 0, 0};
    iris_sensor camera = {.intrinsics = {q32(FOCAL), q32(FOCAL), 0, q32(W / 2 - 0.4), q32(H / 2 - 0.3)},
                          .pose = {{{0}}, {q32(from[0]), q32(from[1]), q32(from[2])}}};
    for (int i = 0; i < 3; i++) {
        turn[i] = r[i];
        turn[3 + i] = f[(i + 1) % 3] * r[(i + 2) % 3] - f[(i + 2) % 3] * r[(i + 1) % 3];
        turn[6 + i] = f[i];
    }
    for (int i = 0; i < 9; i++) {
        camera.pose.turn.m[i] = q32(turn[i]);
    }
    iris_sensor_matrix(m, &camera);
}

/* Twelve cameras around in two rings, and one above. */
static void place_of_camera(double from[3], int view)
{
    const double rise = (view < 6 ? 25 : 55) * PI / 180, turn = (view % 6 + 0.31 + view / 6 * 0.4) * PI / 3;
    from[0] = view == 12 ? 0.2 : 2.2 * cos(rise) * cos(turn);
    from[1] = view == 12 ? 0.1 : 2.2 * cos(rise) * sin(turn);
    from[2] = view == 12 ? -2.2 : -2.2 * sin(rise);
}

static uint8_t noisy(double level, double noise)
{
    double sum = 0;
    for (int i = 0; i < 12 && noise > 0; i++) {
        sum += noise * ((double)(random_u64() % 65537) / 65536 - 0.5);
    }
    return (uint8_t)lround(fmin(fmax(level + sum, 0), 255));
}

/* The picture of a view, and its silhouette. */
static void cast_rays(int view, solid s, int textured, double noise)
{
    double from[3], turn[9];
    iris_q32 m[12];
    place_of_camera(from, view);
    look_from(m, turn, from);
    memset(masks[view], 0, sizeof masks[view]);
    for (int i = 0; i < W * H; i++) {
        const double x = (i % W - (W / 2 - 0.4)) / FOCAL, y = (i / W - (H / 2 - 0.3)) / FOCAL;
        const double length = sqrt(x * x + y * y + 1);
        double ray[3], hit[3], color[3] = {20, 40, 60};
        for (int k = 0; k < 3; k++) {
            ray[k] = (turn[k] * x + turn[3 + k] * y + turn[6 + k]) / length;
        }
        if (meet(hit, s, from, ray)) {
            masks[view][i / W][i % W / 32] |= (uint32_t)1 << (i % W % 32);
            color[0] = color[1] = color[2] = 150;
            if (textured) {
                paint(color, hit);
            }
        }
        for (int k = 0; k < 3; k++) {
            pixels[view][i / W][i % W][k] = noisy(color[k], noise);
        }
    }
}

/* All views as they are; pictures that are there already are not made again. */
static void render(solid s, int textured, double noise)
{
    static int is_made, made_textured;
    static solid made;
    static double made_noise;
    for (int view = 0; view < VIEWS; view++) {
        double from[3], turn[9];
        if (!is_made || made != s || made_textured != textured || made_noise != noise) {
            cast_rays(view, s, textured, noise);
        }
        place_of_camera(from, view);
        look_from(photos[view].m, turn, from);
        assert_int_equal(iris_image_wrap(&photos[view].picture, pixels[view], sizeof pixels[view],
                                         (iris_size){W, H}, 0, IRIS_RGB888),
                         IRIS_OK);
        assert_int_equal(iris_image_wrap(&silhouettes[view], masks[view], sizeof masks[view],
                                         (iris_size){W, H}, 0, IRIS_MASK1),
                         IRIS_OK);
        photos[view].silhouette = &silhouettes[view];
    }
    is_made = 1;
    made = s;
    made_textured = textured;
    made_noise = noise;
}

static iris_voxel_world whole_world(void)
{
    static const int32_t counts[3] = {N, N, N};
    const iris_vec3 corners[2] = {{q32(-BOX), q32(-BOX), q32(-BOX)}, {q32(BOX), q32(BOX), q32(BOX)}};
    iris_voxel_world world;
    assert_int_equal(iris_voxel_world_init(&world, bits, sizeof bits, counts, corners), IRIS_OK);
    assert_int_equal(iris_voxel_fill(&world, 1), IRIS_OK);
    return world;
}

static iris_voxel_world hull(void)
{
    const iris_voxel_world world = whole_world();
    for (int view = 0; view < VIEWS; view++) {
        iris_scratch scratch;
        assert_int_equal(iris_scratch_init(&scratch, hull_memory.memory, sizeof hull_memory.memory), IRIS_OK);
        assert_int_equal(iris_carve_view(&world, &silhouettes[view], photos[view].m, &scratch), IRIS_OK);
    }
    return world;
}

static int32_t carve(const iris_voxel_world *world, int32_t levels)
{
    const iris_carve_photo_config config = {levels, 50};
    const iris_carve_photos views = {photos, VIEWS};
    int32_t removed = -1, before = 0, after = 0;
    iris_scratch scratch;
    assert_int_equal(iris_voxel_count(&before, world), IRIS_OK);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    assert_int_equal(iris_carve_photo_world(&removed, world, &views, &config, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, sizeof working.memory);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(iris_voxel_count(&after, world), IRIS_OK);
    assert_int_equal(before - after, removed);
    return removed;
}

typedef struct {
    int solid, lost;    /* voxels whose middles are in the solid; those that are not left */
    int hollow, opened; /* of the pit, and those that are not left */
    int both, either;
} verdict;

static verdict compare(const iris_voxel_world *world, solid s)
{
    verdict v = {0, 0, 0, 0, 0, 0};
    for (int32_t i = 0; i < N * N * N; i++) {
        const iris_voxel at = {i % N, i / N % N, i / N / N};
        const double p[3] = {BOX * ((2 * at.x + 1.0) / N - 1), BOX * ((2 * at.y + 1.0) / N - 1),
                             BOX * ((2 * at.z + 1.0) / N - 1)};
        const int is = is_solid(s, p), there = iris_voxel_get(world, at);
        const int in_pit = !is && fabs(p[0]) < BLOCK && fabs(p[1]) < BLOCK && fabs(p[2]) < BLOCK;
        v.solid += is;
        v.lost += is && !there;
        v.hollow += in_pit;
        v.opened += in_pit && !there;
        v.both += is && there;
        v.either += is || there;
    }
    return v;
}

static void tell(const char *what, verdict v)
{
    printf("# %s: %d of %d hollow ones opened, %d of %d solid ones lost, overlap %.3f\n", what, v.opened,
           v.hollow, v.lost, v.solid, (double)v.both / v.either);
}

/* --- tests --- */

/* Silhouettes do not see the pit; photographs open it and take nothing of the block. */
static void what_is_hollow_opens(void **state)
{
    (void)state;
    render(PITTED_BLOCK, 1, 0);
    const iris_voxel_world world = hull();
    const verdict before = compare(&world, PITTED_BLOCK);
    assert_true(before.opened == 0 && before.hollow > 700 && before.lost == 0);
    carve(&world, 16);
    const verdict after = compare(&world, PITTED_BLOCK);
    tell("16 levels", after);
    assert_true(after.opened > before.hollow * 0.42);
    assert_int_equal(after.lost, 0);
    const iris_voxel_world again =
        hull(); /* fewer levels open more, and still lose nothing of exact colors */
    carve(&again, 4);
    const verdict strict = compare(&again, PITTED_BLOCK);
    tell("4 levels", strict);
    assert_true(strict.opened > after.opened && strict.opened > before.hollow * 0.52);
    assert_int_equal(strict.lost, 0);
}

/* Without silhouettes the background is a color like others: no worse. */
static void without_silhouettes(void **state)
{
    (void)state;
    render(PITTED_BLOCK, 1, 0);
    for (int view = 0; view < VIEWS; view++) {
        photos[view].silhouette = NULL;
    }
    const iris_voxel_world world = whole_world();
    carve(&world, 16);
    const verdict after = compare(&world, PITTED_BLOCK);
    tell("no silhouettes", after);
    assert_true(after.opened > after.hollow * 0.42 && after.lost <= after.solid / 500);
}

static void noise_takes_nothing_away(void **state)
{
    (void)state;
    render(PITTED_BLOCK, 1, 4);
    const iris_voxel_world world = hull();
    carve(&world, 16);
    const verdict after = compare(&world, PITTED_BLOCK);
    tell("noise of 4 levels", after);
    assert_true(after.opened > after.hollow * 0.4);
    assert_int_equal(after.lost, 0);
}

/* A ball is its hull but for what silhouettes cannot do: nothing of it goes. */
static void a_ball_stays(void **state)
{
    (void)state;
    render(BALL, 1, 0);
    const iris_voxel_world world = hull();
    const verdict before = compare(&world, BALL);
    carve(&world, 16);
    const verdict after = compare(&world, BALL);
    tell("a ball", after);
    assert_int_equal(after.lost, before.lost);
    assert_true(after.either <= before.either);
}

/* What has one color all over shows nothing: the hull, bit by bit. */
static void one_color_stays_the_hull(void **state)
{
    (void)state;
    static uint32_t before[sizeof bits / 4];
    render(PITTED_BLOCK, 0, 0);
    const iris_voxel_world world = hull();
    memcpy(before, bits, sizeof bits);
    assert_int_equal(carve(&world, 0), 0);
    assert_memory_equal(before, bits, sizeof bits);
}

/* The matrix of view `view` with the picture moved by (x, y) pixels, or looking the other way. */
static void turn_away(int view, int32_t x, int32_t y, int behind)
{
    iris_q32 *m = photos[view].m;
    for (int k = 0; k < 4; k++) {
        m[k] += x * m[8 + k];
        m[4 + k] += y * m[8 + k];
    }
    for (int k = 0; k < 12 && behind; k++) {
        m[k] = -m[k];
    }
}

static void who_sees_nothing_carves_nothing(void **state)
{
    (void)state;
    render(PITTED_BLOCK, 1, 0);
    for (int view = 0; view < VIEWS; view++) {
        turn_away(view,
                  view % 4 == 0   ? 500
                  : view % 4 == 1 ? -500
                                  : 0,
                  view % 4 == 2 ? 500 : 0, view % 4 == 3);
    }
    const iris_voxel_world world = whole_world();
    assert_int_equal(carve(&world, 0), 0);
    render(PITTED_BLOCK, 1, 0); /* one that sees all, alone */
    const iris_carve_photos one = {photos, 1};
    int32_t removed = -1;
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    assert_int_equal(iris_carve_photo_world(&removed, &world, &one, NULL, &scratch), IRIS_OK);
    assert_int_equal(removed, 0);
}

/* Sweeps one by one are the whole, and any of them takes away what the count says. */
static void sweeps_are_the_whole(void **state)
{
    (void)state;
    static uint32_t whole[sizeof bits / 4];
    const iris_carve_photos views = {photos, VIEWS};
    int32_t all = 0, of_round = 1;
    render(PITTED_BLOCK, 1, 0);
    const iris_voxel_world world = hull();
    const int32_t expected = carve(&world, 16);
    memcpy(whole, bits, sizeof bits);
    (void)hull();
    for (int round = 0; of_round > 0; round++) {
        of_round = 0;
        for (int i = IRIS_SWEEP_X_UP; i <= IRIS_SWEEP_Z_DOWN; i++) {
            int32_t removed = -1;
            iris_scratch scratch;
            assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
            assert_int_equal(iris_carve_photo_sweep(&removed, &world, &views, (iris_sweep)i, NULL, &scratch),
                             IRIS_OK);
            of_round += removed;
        }
        all += of_round;
        assert_true(round < 50);
    }
    assert_int_equal(all, expected);
    assert_memory_equal(whole, bits, sizeof bits);
}

static void colors_are_those_of_the_solid(void **state)
{
    (void)state;
    const iris_carve_photos views = {photos, VIEWS};
    int32_t count = 0, seen = 0, far = 0, expected = 0;
    iris_scratch scratch;
    render(BALL, 1, 0);
    const iris_voxel_world world = hull();
    assert_int_equal(iris_scratch_init(&scratch, color_memory.memory, sizeof color_memory.memory), IRIS_OK);
    assert_int_equal(iris_carve_colors(colors, ROOM, &count, &world, &views, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, sizeof color_memory.memory);
    assert_int_equal(iris_voxel_surface(listed, ROOM, &expected, &world), IRIS_OK);
    assert_int_equal(count, expected);
    for (int32_t i = 0; i < count; i++) {
        const double p[3] = {BOX * ((2 * listed[i].x + 1.0) / N - 1), BOX * ((2 * listed[i].y + 1.0) / N - 1),
                             BOX * ((2 * listed[i].z + 1.0) / N - 1)};
        const double away = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        double color[3];
        if (colors[i].views == 0) {
            assert_true(colors[i].r == 128 && colors[i].g == 128 && colors[i].b == 128);
            assert_true(p[2] > 0); /* all cameras are above */
        } else if (away < BLOCK + BOX / N) {
            paint(color, (const double[3]){p[0] * BLOCK / away, p[1] * BLOCK / away, p[2] * BLOCK / away});
            far +=
                fabs(colors[i].r - color[0]) + fabs(colors[i].g - color[1]) + fabs(colors[i].b - color[2]) >
                60;
            seen++;
        }
    }
    printf("# colors: %d voxels seen, %d of them by more than 20 levels a channel off\n", (int)seen,
           (int)far);
    assert_true(seen > 600 && far < seen / 20);
    assert_int_equal(iris_carve_colors(colors, 10, &count, &world, &views, &scratch), IRIS_ERR_FULL);
    assert_int_equal(count, expected);
    assert_int_equal(iris_scratch_init(&scratch, color_memory.memory, sizeof color_memory.memory - 1),
                     IRIS_OK);
    assert_int_equal(iris_carve_colors(colors, ROOM, &count, &world, &views, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(iris_carve_colors(NULL, ROOM, &count, &world, &views, &scratch), IRIS_ERR_ARG);
}

/* Cameras in the middle of the voxels, and any numbers as cameras: nothing is overrun, and it ends. */
static void anywhere(void **state)
{
    (void)state;
    const iris_carve_photos views = {photos, VIEWS};
    int done = 0;
    render(PITTED_BLOCK, 1, 0);
    for (int round = 0; round < 6; round++) {
        const iris_voxel_world world = whole_world();
        int32_t removed = 0;
        iris_scratch scratch;
        for (int32_t i = 0; i < 500; i++) {
            bits[random_u64() % (sizeof bits / 4)] &= (uint32_t)random_u64();
        }
        for (int view = 0; view < VIEWS; view++) {
            double turn[9];
            const double from[3] = {real(random_q32(q32(0.7))), real(random_q32(q32(0.7))),
                                    real(random_q32(q32(0.7)))};
            look_from(photos[view].m, turn, from);
            for (int k = 0; k < 12 && round > 3; k++) {
                photos[view].m[k] = any_q32();
            }
        }
        assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
        const iris_status status =
            iris_carve_photo_sweep(&removed, &world, &views, (iris_sweep)round, NULL, &scratch);
        assert_true(status == IRIS_OK || (status == IRIS_ERR_RANGE && round > 3));
        assert_int_equal(scratch.used, 0);
        done += status == IRIS_OK;
    }
    assert_true(done >= 4);
}

static void refusals(void **state)
{
    (void)state;
    const iris_carve_photo_config dark = {-1, 5}, light = {256, 5}, never = {16, 0};
    iris_carve_photos views = {photos, VIEWS};
    iris_scratch scratch;
    int32_t removed = 77;
    render(PITTED_BLOCK, 0, 0);
    const iris_voxel_world world = whole_world();
    iris_voxel_world broken = world;
    broken.counts[2] = 0;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory - 1), IRIS_OK);
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, NULL, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    assert_int_equal(iris_carve_photo_world(NULL, &world, &views, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_photo_world(&removed, &broken, &views, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_photo_world(&removed, &world, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, &dark, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, &light, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, &never, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_photo_sweep(&removed, &world, &views, (iris_sweep)6, NULL, &scratch),
                     IRIS_ERR_ARG);
    views.count = 0;
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, NULL, &scratch), IRIS_ERR_ARG);
    views.count = VIEWS;
    photos[3].picture.format = IRIS_GRAY8;
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, NULL, &scratch), IRIS_ERR_FORMAT);
    photos[3].picture.format = IRIS_BGR888;
    silhouettes[5].h--;
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, NULL, &scratch), IRIS_ERR_RANGE);
    silhouettes[5].h++;
    memset(photos[12].m, 0, sizeof photos[12].m);
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, NULL, &scratch), IRIS_ERR_RANGE);
    photos[12].picture.w = 0;
    assert_int_equal(iris_carve_photo_world(&removed, &world, &views, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(removed, 77);
    assert_int_equal(scratch.used, 0);
}

/* As many lines as voxels, the colors behind the places. */
static void colored_points(void **state)
{
    (void)state;
    static char text[600];
    iris_memory_sink memory = {(uint8_t *)text, sizeof text - 1, 0};
    const iris_voxel_world world = whole_world();
    static const iris_carve_color two[2] = {{255, 0, 7, 1}, {1, 20, 128, 0}};
    static const char expected[] =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
        "-0.575000000 -0.575000000 -0.575000000 255 0 7\n0.575000000 0.025000000 0.575000000 1 20 128\n";
    assert_int_equal(iris_voxel_fill(&world, 0), IRIS_OK);
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){0, 0, 0}, 1), IRIS_OK);
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){N - 1, N / 2, N - 1}, 1), IRIS_OK);
    assert_int_equal(iris_carve_write_colored_ply(iris_sink_memory(&memory), &world, two, 3), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_write_colored_ply(iris_sink_memory(&memory), &world, NULL, 2), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_write_colored_ply(iris_sink_memory(&memory), &world, two, 2), IRIS_OK);
    assert_string_equal(text, expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_hollow_opens),
        cmocka_unit_test(without_silhouettes),
        cmocka_unit_test(who_sees_nothing_carves_nothing),
        cmocka_unit_test(sweeps_are_the_whole),
        cmocka_unit_test(anywhere),
        cmocka_unit_test(noise_takes_nothing_away),
        cmocka_unit_test(a_ball_stays),
        cmocka_unit_test(colors_are_those_of_the_solid),
        cmocka_unit_test(one_color_stays_the_hull),
        cmocka_unit_test(refusals),
        cmocka_unit_test(colored_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
