/* What blobs look like, which pass a filter, and the mask of one: against double precision and flooding. */
#include <math.h>

#include "blob_truth.h"

#define DEGREE (65536.0 / 360)

static uint32_t words[(SHAPE_SIDE_MAX / 32 + 4) * SHAPE_SIDE_MAX], to_words[sizeof words / sizeof words[0]];
static iris_blob found[TRUTHS_MAX];
static IRIS_SCRATCH_BUFFER(memory, IRIS_BLOB_SCRATCH_BYTES(SHAPE_SIDE_MAX, 5000));
static shape drawn;
static uint32_t seed = 7;

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image mask_of_drawn(void)
{
    return shape_mask(words, iris_format_row_bytes(IRIS_MASK1, drawn.w) * (size_t)drawn.h, &drawn, 0, 0);
}

static int32_t find(const iris_blob_config *config)
{
    iris_image mask = mask_of_drawn();
    iris_blob_table table = {found, 5000, 0};
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_blobs(&table, &mask, NULL, config, &scratch), IRIS_OK);
    return table.count;
}

static iris_blob only(void)
{
    assert_int_equal(find(NULL), 1);
    return found[0];
}

/* Pixels whose middle is in the rectangle or ellipse of these sides, turned so that its long side leans right. */
static void draw_turned(double length, double breadth, double degrees, int is_round)
{
    double turn = degrees * 3.14159265358979 / 180, middle = 150;
    drawn.w = drawn.h = 300;
    for (int32_t y = 0; y < 300; y++) {
        for (int32_t x = 0; x < 300; x++) {
            double dx = x - middle, dy = y - middle, along = dx * sin(turn) - dy * cos(turn),
                   across = dx * cos(turn) + dy * sin(turn);
            double u = along / (length / 2), v = across / (breadth / 2);
            drawn.at[y][x] = is_round ? u * u + v * v <= 1 : fabs(u) <= 1 && fabs(v) <= 1;
        }
    }
}

static void upright_rectangles_are_exact(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 400; i++) {
        int32_t w = 1 + i % 20, h = 1 + i / 20 * 7;
        drawn.w = 40;
        drawn.h = 200;
        memset(drawn.at, 0, sizeof drawn.at);
        for (int32_t k = 0; k < w * h; k++) {
            drawn.at[30 + k / w][11 + k % w] = 1;
        }
        iris_blob blob = only();
        iris_blob_shape s;
        assert_int_equal(iris_blob_shape_of(&s, &blob), IRIS_OK);
        int32_t longer = w > h ? w : h, shorter = w > h ? h : w;
        assert_int_equal(s.length_q16, longer * 65536);
        assert_int_equal(s.breadth_q16, shorter * 65536);
        assert_int_equal(s.elongation_q16, floor(longer * 65536.0 / shorter + 0.5));
        assert_int_equal(s.angle, w > h ? -16384 : 0);
        assert_int_equal(blob.edges, 2 * (w + h));
        assert_int_equal(blob.corners, 4);
    }
}

/* What the sums say, in double precision. */
static void assert_shape(const iris_blob *blob)
{
    const iris_moments *m = &blob->moments;
    long double n = m->n, x = m->x / n, y = m->y / n;
    double xx = (double)(m->xx / n - x * x), yy = (double)(m->yy / n - y * y),
           xy = (double)(m->xy / n - x * y);
    double root = hypot(xx - yy, 2 * xy), angle = 0.5 * atan2(-2 * xy, yy - xx) * 32768 / 3.14159265358979;
    double length = sqrt(6 * (xx + yy + root) + 1), breadth = sqrt(6 * (xx + yy - root) + 1);
    iris_blob_shape s;
    assert_int_equal(iris_blob_shape_of(&s, blob), IRIS_OK);
    assert_true(fabs(s.length_q16 / 65536.0 - length) <= 1e-4 + 1e-5 * length);
    assert_true(fabs(s.breadth_q16 / 65536.0 - breadth) <= 1e-4 + 1e-3 * breadth);
    assert_true(fabs(s.elongation_q16 / 65536.0 - length / breadth) <= 2e-3 * length / breadth);
    if (root > 1e-3) {
        assert_true(fabs(remainder(s.angle - angle, 32768)) <= 2);
    }
    iris_line line;
    if (iris_regress_moments(&line, m) == IRIS_OK && m->n > 100 && root > 10) {
        assert_true(abs(iris_angle_wrap(2 * (line.angle - s.angle))) <= 8);
    }
    double outline = 0.948059449 * (blob->edges - blob->corners * (1 - sqrt(0.5)));
    assert_true(fabs(s.perimeter_q16 / 65536.0 - outline) <= 1e-4 * outline);
}

static void turned(void **state)
{
    (void)state;
    for (int degrees = -90; degrees < 90; degrees += 3) {
        for (int is_round = 0; is_round < 2; is_round++) {
            draw_turned(200, 61, degrees, is_round);
            iris_blob blob = only();
            iris_blob_shape s;
            assert_shape(&blob);
            iris_blob_shape_of(&s, &blob);
            double length = is_round ? 200 * sqrt(0.75) : 200, breadth = is_round ? 61 * sqrt(0.75) : 61;
            double off = remainder(s.angle / DEGREE - degrees, 180);
            assert_true(fabs(off) < 0.3);
            assert_true(fabs(s.length_q16 / 65536.0 - length) < 1.1);
            assert_true(fabs(s.breadth_q16 / 65536.0 - breadth) < 1.1);
            assert_int_equal(blob.x_q16, 150 * 65536);
        }
    }
}

/* A circle's outline is right within 2 %, a slanting square's as the header says. */
static void outlines(void **state)
{
    (void)state;
    iris_blob_shape s;
    for (int radius = 10; radius < 140; radius += 13) {
        draw_turned(2 * radius + 1, 2 * radius + 1, 0, 1);
        iris_blob blob = only();
        iris_blob_shape_of(&s, &blob);
        double truth = (2 * radius + 1) * 3.14159265358979;
        assert_true(fabs(s.perimeter_q16 / 65536.0 - truth) < 0.02 * truth);
    }
    double sum = 0;
    for (int degrees = 0; degrees < 90; degrees++) {
        draw_turned(180, 180, degrees, 0);
        iris_blob blob = only();
        iris_blob_shape_of(&s, &blob);
        double share = s.perimeter_q16 / 65536.0 / 720;
        assert_true(fabs(share - 1) < 0.06);
        sum += share / 90;
    }
    assert_true(fabs(sum - 1) < 0.01);
}

static void draw_noise(int32_t w, int32_t h, uint32_t permil)
{
    drawn.w = w;
    drawn.h = h;
    for (int32_t i = 0; i < w * h; i++) {
        drawn.at[i / w][i % w] = next_random(&seed) % 1000 < permil;
    }
}

static void noise(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        draw_noise(150, 130, 20 + 16 * (uint32_t)i);
        int32_t count = find(NULL);
        for (int32_t k = 0; k < count; k++) {
            assert_shape(&found[k]);
        }
    }
}

/* Lines as long as a picture can be, and sums that no blob can have. */
static void extremes(void **state)
{
    (void)state;
    const int64_t n = IRIS_SIDE_MAX;
    iris_blob level = {.moments = {n, n * (n - 1) / 2, n * (n - 1), (n - 1) * n * (2 * n - 1) / 6,
                                   n * (n - 1) / 2 * (n - 1), n * (n - 1) * (n - 1)},
                       .edges = 2 * IRIS_SIDE_MAX + 2,
                       .corners = 4};
    iris_blob_shape s;
    assert_int_equal(iris_blob_shape_of(&s, &level), IRIS_OK);
    assert_int_equal(s.length_q16, IRIS_SIDE_MAX * 65536);
    assert_int_equal(s.breadth_q16, 65536);
    assert_int_equal(s.elongation_q16, IRIS_SIDE_MAX * 65536);
    assert_int_equal(s.angle, -16384);
    assert_int_equal(s.perimeter_q16, INT32_MAX);
    iris_blob full = {.moments = {n * n, n * n * (n - 1) / 2, n * n * (n - 1) / 2,
                                  n * ((n - 1) * n * (2 * n - 1) / 6), n * (n - 1) / 2 * (n * (n - 1) / 2),
                                  n * ((n - 1) * n * (2 * n - 1) / 6)}};
    assert_int_equal(iris_blob_shape_of(&s, &full), IRIS_OK);
    assert_true(abs(s.length_q16 - IRIS_SIDE_MAX * 65536) < 1000);
    assert_true(abs(s.breadth_q16 - IRIS_SIDE_MAX * 65536) < 1000);
    int64_t far = n - 1; /* two pixels in opposite corners */
    iris_blob apart = {.moments = {2, far, far, far * far, far * far, far * far}};
    assert_int_equal(iris_blob_shape_of(&s, &apart), IRIS_OK);
    assert_int_equal(s.length_q16, INT32_MAX);
    assert_int_equal(s.angle, -8192);
    assert_int_equal(iris_blob_shape_of(NULL, &full), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_shape_of(&s, NULL), IRIS_ERR_ARG);
    int accepted = 0;
    for (int i = 0; i < 20000; i++) {
        iris_blob wild = full;
        int64_t *sums[] = {&wild.moments.n,  &wild.moments.x,  &wild.moments.y,
                           &wild.moments.xx, &wild.moments.xy, &wild.moments.yy};
        for (int k = 0; k < 6; k++) {
            uint64_t any =
                (uint64_t)next_random(&seed) << 40 ^ (uint64_t)next_random(&seed) << 20 ^ next_random(&seed);
            int64_t value = (int64_t)(any >> next_random(&seed) % 64);
            *sums[k] = next_random(&seed) % 3 ? value : *sums[k];
        }
        accepted += iris_blob_shape_of(&s, &wild) == IRIS_OK;
    }
    assert_true(accepted > 100 && accepted < 19900);
}

/* Does the filter let through what the bound says, on noise? */
static void assert_filter(const iris_blob_filter *filter, int (*truth)(const iris_blob *))
{
    iris_blob_config config;
    iris_blob_defaults(&config);
    find(&config);
    static iris_blob all[5000];
    int32_t total = find(&config), wanted = 0;
    memcpy(all, found, sizeof all[0] * (size_t)total);
    config.filter = *filter;
    int32_t count = find(&config);
    for (int32_t i = 0; i < total; i++) {
        if (truth(&all[i])) {
            assert_true(wanted < count && blob_equal(&found[wanted], &all[i]));
            wanted++;
        }
    }
    assert_int_equal(wanted, count);
    assert_true(count > 0 && count < total);
}

static int of_area(const iris_blob *b)
{
    return b->area >= 3 && b->area <= 9;
}

static int of_width(const iris_blob *b)
{
    return b->box.w >= 2 && b->box.w <= 3;
}

static int of_height(const iris_blob *b)
{
    return b->box.h >= 2 && b->box.h <= 3;
}

static int of_fill(const iris_blob *b)
{
    double fill = 1000.0 * b->area / (b->box.w * b->box.h);
    return fill >= 500 && fill <= 600;
}

static int of_elongation(const iris_blob *b)
{
    iris_blob_shape s;
    iris_blob_shape_of(&s, b);
    return s.elongation_q16 >= 131072 && s.elongation_q16 <= 4 * 65536;
}

static int of_holes(const iris_blob *b)
{
    return b->holes == 1;
}

static int of_inside(const iris_blob *b)
{
    return b->box.x > 0 && b->box.y > 0 && b->box.x + b->box.w < drawn.w && b->box.y + b->box.h < drawn.h;
}

static int of_place(const iris_blob *b)
{
    double x = floor(b->x_q16 / 65536.0 + 0.5), y = floor(b->y_q16 / 65536.0 + 0.5);
    return x >= 20 && x < 60 && y >= 30 && y < 55;
}

static void filters(void **state)
{
    (void)state;
    iris_blob_filter all, by;
    iris_blob_filter_defaults(&all);
    draw_noise(131, 97, 380);
    by = all, by.min_area = 3, by.max_area = 9;
    assert_filter(&by, of_area);
    by = all, by.min_w = 2, by.max_w = 3;
    assert_filter(&by, of_width);
    by = all, by.min_h = 2, by.max_h = 3;
    assert_filter(&by, of_height);
    by = all, by.min_fill_permil = 500, by.max_fill_permil = 600;
    assert_filter(&by, of_fill);
    by = all, by.min_elongation_q16 = 131072, by.max_elongation_q16 = 4 * 65536;
    assert_filter(&by, of_elongation);
    by = all, by.min_holes = 1, by.max_holes = 1;
    assert_filter(&by, of_holes);
    by = all, by.inside = 1;
    assert_filter(&by, of_inside);
    by = all, by.center_in = (iris_rect){20, 30, 40, 25};
    assert_filter(&by, of_place);
    assert_int_equal(iris_blob_passes(NULL, &all, (iris_size){9, 9}), 0);
    assert_int_equal(iris_blob_passes(&found[0], NULL, (iris_size){9, 9}), 0);
    assert_int_equal(iris_blob_passes(&found[0], &all, (iris_size){9, 9}), 1);
    iris_blob_filter_defaults(NULL);
    iris_blob_defaults(NULL);
}

/* The masks of all blobs are what flooding finds. */
static void assert_masks(int connectivity)
{
    iris_image mask = mask_of_drawn();
    static shape one;
    truth_of(&drawn, connectivity, NULL, 0);
    for (int32_t i = 0; i < truth_count; i += 1 + truth_count / 40) {
        const iris_blob *b = &truths[i];
        for (size_t k = 0; k < sizeof to_words / sizeof to_words[0]; k++) {
            to_words[k] = next_random(&seed) * 257u;
        }
        iris_image dst;
        size_t bytes = iris_format_row_bytes(IRIS_MASK1, drawn.w) * (size_t)drawn.h;
        assert_int_equal(iris_image_wrap(&dst, to_words, bytes, (iris_size){drawn.w, drawn.h}, 0, IRIS_MASK1),
                         IRIS_OK);
        uint32_t last = to_words[bytes / 4 - 1];
        iris_scratch scratch = arena(IRIS_BLOB_MASK_SCRATCH_BYTES(drawn.w, drawn.h));
        assert_int_equal(iris_blob_mask(&dst, &mask, b, connectivity, &scratch), IRIS_OK);
        assert_int_equal(scratch.used, 0);
        shape_read(&one, &dst);
        int32_t number = owner[b->box.y][b->first_x];
        for (int32_t p = 0; p < drawn.w * drawn.h; p++) {
            assert_int_equal(one.at[p / drawn.w][p % drawn.w], owner[p / drawn.w][p % drawn.w] == number);
        }
        if (drawn.w % 32) {
            assert_int_equal((last ^ to_words[bytes / 4 - 1]) >> drawn.w % 32, 0);
        }
    }
}

static void masks(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        draw_noise(1 + (int32_t)(next_random(&seed) % 130), 1 + (int32_t)(next_random(&seed) % 60),
                   100 + 15 * (uint32_t)i);
        assert_masks(i % 2 ? 4 : 8);
    }
    drawn.w = drawn.h = 99; /* a spiral */
    for (int32_t i = 0; i < 99 * 99; i++) {
        int32_t x = i % 99, y = i / 99, ring_of = x < y ? x : y;
        ring_of = 98 - x < ring_of ? 98 - x : ring_of;
        ring_of = 98 - y < ring_of ? 98 - y : ring_of;
        drawn.at[y][x] =
            ring_of % 2 == 0 ? !(x == ring_of && y == ring_of + 1) : x == ring_of && y == ring_of;
    }
    assert_masks(4);
    assert_masks(8);
}

/* So wide that the marks of a row fill many words: the mask of a blob is that blob alone. */
static void wide_masks(void **state)
{
    (void)state;
    enum { W = IRIS_SIDE_MAX, H = 9, ROW = W / 32 + 1 };
    static uint32_t from[ROW * H], to[ROW * H];
    static IRIS_SCRATCH_BUFFER(room, IRIS_BLOB_SCRATCH_BYTES(W, 4) + IRIS_BLOB_MASK_SCRATCH_BYTES(W, H));
    iris_image src = {from, ROW * 4, W, H, IRIS_MASK1}, dst = {to, ROW * 4, W, H, IRIS_MASK1};
    iris_scratch scratch;
    iris_scratch_init(&scratch, room.memory, sizeof room.memory);
    for (int kind = 0; kind < 3; kind++) {
        for (int32_t i = 0; i < W * H; i++) {
            int32_t x = i % W, y = i / W;
            uint32_t serpent = x % 2 == 0 || y == (x % 4 == 1 ? H - 1 : 0),
                     rolled = next_random(&seed) % 1000;
            uint32_t one = kind == 0 ? serpent : kind == 1 ? rolled < 450 : rolled < 800;
            from[y * ROW + x / 32] = (from[y * ROW + x / 32] & ~((uint32_t)1 << x % 32)) | one << x % 32;
        }
        iris_blob blobs[4], again;
        iris_blob_table table = {blobs, 4, 0}, single = {&again, 1, 0};
        iris_blobs(&table, &src, NULL, NULL, &scratch);
        for (int32_t i = 0; i < table.count && i < 4; i++) {
            assert_int_equal(iris_blob_mask(&dst, &src, &blobs[i], 8, &scratch), IRIS_OK);
            assert_int_equal(iris_blobs(&single, &dst, NULL, NULL, &scratch), IRIS_OK);
            assert_true(single.count == 1 && blob_equal(&again, &blobs[i]));
        }
        assert_true(kind == 1 || blobs[0].box.w > 3000);
    }
}

static void refused_masks(void **state)
{
    (void)state;
    draw_noise(40, 30, 300);
    iris_image src = mask_of_drawn(), dst = src, small = src, gray;
    size_t bytes = IRIS_BLOB_MASK_SCRATCH_BYTES(40, 30);
    iris_scratch scratch = arena(bytes), tight = arena(bytes - 1);
    iris_blob blob = {.first_x = 3, .box = {0, 4, 1, 1}}, outside = {.first_x = 40};
    dst.data = to_words;
    small.w = 39;
    small.data = to_words;
    assert_int_equal(iris_image_wrap(&gray, to_words, sizeof to_words, (iris_size){40, 30}, 0, IRIS_GRAY8),
                     IRIS_OK);
    memset(to_words, 0x5a, sizeof to_words);
    assert_int_equal(iris_blob_mask(NULL, &src, &blob, 8, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_mask(&dst, NULL, &blob, 8, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_mask(&dst, &src, NULL, 8, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_mask(&dst, &src, &blob, 8, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_mask(&dst, &src, &blob, 5, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_mask(&small, &src, &blob, 8, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_blob_mask(&dst, &src, &outside, 8, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_blob_mask(&gray, &src, &blob, 8, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_blob_mask(&src, &src, &blob, 8, &scratch), IRIS_ERR_ALIAS);
    assert_int_equal(iris_blob_mask(&dst, &src, &blob, 8, &tight), IRIS_ERR_SCRATCH);
    assert_int_equal(to_words[0], 0x5a5a5a5a);
    memset(words, 0, sizeof words); /* nothing there: nothing selected */
    assert_int_equal(iris_blob_mask(&dst, &src, &blob, 8, &scratch), IRIS_OK);
    assert_int_equal(to_words[8], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(upright_rectangles_are_exact),
        cmocka_unit_test(turned),
        cmocka_unit_test(outlines),
        cmocka_unit_test(noise),
        cmocka_unit_test(extremes),
        cmocka_unit_test(filters),
        cmocka_unit_test(masks),
        cmocka_unit_test(wide_masks),
        cmocka_unit_test(refused_masks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
