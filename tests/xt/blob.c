/* Blobs: by hand, and against flooding, pixel by pixel, on hard masks, noise, and real shapes; what is refused. */
#include "blob_truth.h"

static uint32_t words[(SHAPE_SIDE_MAX / 32 + 4) * SHAPE_SIDE_MAX];
static iris_blob found[TRUTHS_MAX];
static IRIS_SCRATCH_BUFFER(memory, IRIS_BLOB_SCRATCH_BYTES(SHAPE_SIDE_MAX, TRUTHS_MAX) +
                                       IRIS_BLOB_COLOR_SCRATCH_BYTES(SHAPE_SIDE_MAX));
static uint8_t pixels[3 * SHAPE_SIDE_MAX * SHAPE_SIDE_MAX];
static shape drawn;
static uint32_t seed = 1;

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image mask_of_drawn(uint32_t fill)
{
    return shape_mask(words, iris_format_row_bytes(IRIS_MASK1, drawn.w) * (size_t)drawn.h, &drawn, 0, fill);
}

/* Finds the blobs of `drawn` with exactly the working memory that is needed; what does not fit must be the smallest.
 * */
static void assert_truth(int connectivity, int32_t capacity, int channels)
{
    iris_image mask = mask_of_drawn(next_random(&seed) % 2 ? ~0u : 0), colored;
    iris_blob_config config;
    iris_blob_table table = {found, capacity, -1};
    size_t bytes =
        IRIS_BLOB_SCRATCH_BYTES(drawn.w, capacity) + (channels ? IRIS_BLOB_COLOR_SCRATCH_BYTES(drawn.w) : 0);
    iris_scratch scratch = arena(bytes);
    iris_blob_defaults(&config);
    config.connectivity = connectivity;
    if (channels) {
        assert_int_equal(iris_image_wrap(&colored, pixels, sizeof pixels, (iris_size){drawn.w, drawn.h}, 0,
                                         channels == 1 ? IRIS_GRAY8 : IRIS_RGB888),
                         IRIS_OK);
    }
    truth_of(&drawn, connectivity, channels ? pixels : NULL, channels);
    assert_int_equal(iris_blobs(&table, &mask, channels ? &colored : NULL, &config, &scratch),
                     truth_count > capacity ? IRIS_ERR_FULL : IRIS_OK);
    assert_int_equal(table.count, truth_count);
    for (int32_t i = 0; i < truth_count && i < capacity; i++) {
        assert_true(blob_equal(&found[i], &truths[i]));
    }
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, bytes);
}

static void draw_noise(int32_t w, int32_t h, uint32_t permil)
{
    drawn.w = w;
    drawn.h = h;
    for (int32_t i = 0; i < w * h; i++) {
        drawn.at[i / w][i % w] = next_random(&seed) % 1000 < permil;
        for (int c = 0; c < 3; c++) {
            pixels[3 * i + c] = (uint8_t)next_random(&seed);
        }
    }
}

static void by_hand(void **state)
{
    (void)state;
    shape_draw(&drawn, 8, 5,
               ".###..#."
               ".#.#...#"
               ".###...."
               "........"
               "##....#.");
    iris_image mask = mask_of_drawn(0);
    iris_blob_table table = {found, 9, 0};
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_blobs(&table, &mask, NULL, NULL, &scratch), IRIS_OK);
    assert_int_equal(table.count, 4);
    iris_blob ring = {.moments = {8, 16, 8, 38, 16, 14},
                      .box = {1, 0, 3, 3},
                      .first_x = 1,
                      .area = 8,
                      .x_q16 = 2 * 65536,
                      .y_q16 = 65536,
                      .edges = 16,
                      .corners = 8,
                      .holes = 1};
    iris_blob slanting = {.moments = {2, 13, 1, 85, 7, 1},
                          .box = {6, 0, 2, 2},
                          .first_x = 6,
                          .area = 2,
                          .x_q16 = 6 * 65536 + 32768,
                          .y_q16 = 32768,
                          .edges = 8,
                          .corners = 8};
    assert_true(blob_equal(&found[0], &ring));
    assert_true(blob_equal(&found[1], &slanting));
    assert_int_equal(found[2].box.y, 4);
    assert_int_equal(found[2].area, 2);
    assert_int_equal(found[2].edges, 6);
    assert_int_equal(found[2].corners, 4);
    assert_int_equal(found[3].first_x, 6);
    assert_int_equal(found[3].area, 1);
}

static void every_small_mask(void **state)
{
    (void)state;
    for (uint32_t bits = 0; bits < 65536; bits++) {
        drawn.w = drawn.h = 4;
        for (int32_t i = 0; i < 16; i++) {
            drawn.at[i / 4][i % 4] = bits >> i & 1;
        }
        assert_truth(bits % 2 ? 4 : 8, 8, 0);
        assert_truth(bits % 2 ? 8 : 4, 1, 0);
    }
}

static void noise(void **state)
{
    (void)state;
    for (int i = 0; i < 300; i++) {
        int32_t w = 1 + (int32_t)(next_random(&seed) % 140), h = 1 + (int32_t)(next_random(&seed) % 60);
        draw_noise(w, h, next_random(&seed) % 1001);
        int32_t capacity = i % 3 == 0 ? 5000 : (int32_t)(next_random(&seed) % 60);
        assert_truth(i % 2 ? 4 : 8, capacity, i % 4 == 0 ? 0 : i % 4 == 1 ? 1 : 3);
    }
}

/* Kinds of masks that are hard: one pixel at x, y. */
static int awkward(int kind, int32_t x, int32_t y, int32_t w, int32_t h)
{
    int32_t ring_of = x < y ? x : y;
    ring_of = w - 1 - x < ring_of ? w - 1 - x : ring_of;
    ring_of = h - 1 - y < ring_of ? h - 1 - y : ring_of;
    switch (kind) {
    case 0:
        return 1;
    case 1:
        return (x + y) % 2;
    case 2:
        return (x / 2 + y / 2) % 2;
    case 3:
        return ring_of % 2 == 0; /* frames in frames */
    case 4:
        return ring_of % 2 == 0 ? !(x == ring_of && y == ring_of + 1)
                                : x == ring_of && y == ring_of; /* a spiral */
    case 5:
        return y == h - 1 || x % 2; /* a comb, teeth up: all join in the last row */
    case 6:
        return y == 0 || x % 2; /* teeth down */
    case 7:
        return (x % 2 == 0 && y < h - 2 - x % 7) || (x % 4 < 3 && y == h - 2 - x % 7); /* Us that join late */
    case 8:
        return y % 2 ? x % 4 == 0 : x % 4 == 2; /* new runs between old ones */
    case 9:
        return x % 4 == 0 ? y % 2
                          : x % 4 != 3 && (x % 4 == 2 || y % 2 == 0); /* hooks between which runs begin */
    case 10:
        return (x ^ y) & 1 ? (x & y & 2) == 0 : x % 3 == 0;
    default:
        return (x & y) == 0; /* Sierpinski */
    }
}

static void hard_masks(void **state)
{
    (void)state;
    const int32_t sides[][2] = {{1, 1},   {2, 2},   {3, 7},    {31, 9}, {32, 32},
                                {33, 17}, {64, 40}, {101, 50}, {1, 50}, {90, 1}};
    for (int kind = 0; kind <= 11; kind++) {
        for (size_t k = 0; k < sizeof sides / sizeof sides[0]; k++) {
            drawn.w = sides[k][0];
            drawn.h = sides[k][1];
            for (int32_t i = 0; i < drawn.w * drawn.h; i++) {
                int32_t x = i % drawn.w, y = i / drawn.w;
                drawn.at[y][x] = awkward(kind, x, y, drawn.w, drawn.h) != 0;
            }
            for (int connectivity = 4; connectivity <= 8; connectivity += 4) {
                assert_truth(connectivity, 5000, 0);
                assert_truth(connectivity, 3, 0);
                assert_truth(connectivity, 0, 0);
            }
        }
    }
}

static void real_shapes(void **state)
{
    (void)state;
    int there = 0;
    for (int i = 0; i < SHAPE_NAMES; i++) {
        if (shape_load(&drawn, shape_name(i))) {
            there++;
            assert_truth(4, 100, 0);
            assert_truth(8, 100, 0);
        }
    }
    if (there == 0) {
        skip();
    }
}

/* The most blobs that can grow at a time need all of the memory: every second pixel, and each row one to the side. */
static void widest(void **state)
{
    (void)state;
    enum { W = IRIS_SIDE_MAX };
    static uint32_t row[3][W / 32 + 1];
    static IRIS_SCRATCH_BUFFER(room, IRIS_BLOB_SCRATCH_BYTES(W, 1));
    iris_blob best;
    iris_blob_table table = {&best, 1, 0};
    iris_scratch scratch;
    iris_blob_scan scan;
    iris_blob_config config;
    iris_blob_defaults(&config);
    config.connectivity = 4;
    memset(row[0], 0x55, sizeof row[0]);
    memset(row[1], 0xaa, sizeof row[1]);
    memset(row[2], 0xff, sizeof row[2]);
    iris_scratch_init(&scratch, room.memory, sizeof room.memory);
    assert_int_equal(iris_blob_begin(&scan, &table, (iris_size){W, W}, 0, &config, &scratch), IRIS_OK);
    for (int y = 0; y < 40; y++) {
        assert_int_equal(iris_blob_row(&scan, row[y % 2], NULL), IRIS_OK);
    }
    assert_int_equal(iris_blob_end(&scan), IRIS_ERR_FULL);
    assert_int_equal(table.count, 20 * W);
    assert_int_equal(best.first_x, 0);
    assert_int_equal(best.box.y, 0);
    for (int y = 0; y < 41; y++) { /* a comb, joined by its last row */
        assert_int_equal(iris_blob_row(&scan, row[y < 40 ? 0 : 2], NULL), IRIS_OK);
    }
    assert_int_equal(iris_blob_end(&scan), IRIS_OK);
    assert_int_equal(table.count, 1);
    assert_int_equal(best.area, 40 * ((W + 1) / 2) + W);
    assert_int_equal(best.edges, 2 * 41 + 2 * W + 40 * (W - 1));
    for (int y = 0; y < W; y++) { /* the greatest sums */
        assert_int_equal(iris_blob_row(&scan, row[2], NULL), IRIS_OK);
    }
    assert_int_equal(iris_blob_row(&scan, row[2], NULL), IRIS_ERR_RANGE);
    assert_int_equal(iris_blob_end(&scan), IRIS_OK);
    assert_int_equal(best.area, W * W);
    const int64_t n = W;
    assert_true(best.moments.xx == n * ((n - 1) * n * (2 * n - 1) / 6) && best.moments.xx == best.moments.yy);
    assert_true(best.moments.xy == n * (n - 1) / 2 * (n * (n - 1) / 2));
    assert_int_equal(best.x_q16, (W - 1) / 2 * 65536);
}

static void rows_as_they_arrive(void **state)
{
    (void)state;
    iris_blob_scan scan;
    iris_blob_table table = {found, 2000, 0};
    iris_scratch scratch = arena(IRIS_BLOB_SCRATCH_BYTES(67, 2000) + IRIS_BLOB_COLOR_SCRATCH_BYTES(67));
    assert_int_equal(iris_blob_begin(&scan, &table, (iris_size){67, 40}, 3, NULL, &scratch), IRIS_OK);
    for (int frame = 0; frame < 20; frame++) {
        draw_noise(67, 40, 30 + 40 * (uint32_t)frame);
        int32_t rows = frame % 3 == 1 ? 25 : 40; /* a frame that ends early */
        iris_image mask = mask_of_drawn(0);
        for (int32_t y = 0; y < rows; y++) {
            const uint32_t *row = iris_image_row(&mask, y);
            assert_int_equal(iris_blob_row(&scan, row, pixels + (ptrdiff_t)3 * 67 * y), IRIS_OK);
        }
        drawn.h = rows;
        truth_of(&drawn, 8, pixels, 3);
        assert_int_equal(iris_blob_end(&scan), IRIS_OK);
        assert_int_equal(table.count, truth_count);
        for (int32_t i = 0; i < truth_count; i++) {
            assert_true(blob_equal(&found[i], &truths[i]));
        }
    }
    assert_int_equal(iris_blob_end(&scan), IRIS_OK);
    assert_int_equal(table.count, 0);
}

static void views(void **state)
{
    (void)state;
    iris_image mask, part;
    draw_noise(150, 60, 400);
    mask = shape_mask(words, sizeof words, &drawn, -28, 0); /* bottom-up, padded */
    assert_int_equal(iris_image_crop(&part, &mask, (iris_rect){32, 7, 71, 44}), IRIS_OK);
    shape_read(&drawn, &part);
    truth_of(&drawn, 8, NULL, 0);
    iris_blob_table table = {found, 5000, 0};
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_blobs(&table, &part, NULL, NULL, &scratch), IRIS_OK);
    assert_int_equal(table.count, truth_count);
    for (int32_t i = 0; i < truth_count; i++) {
        assert_true(blob_equal(&found[i], &truths[i]));
    }
}

static void refused(void **state)
{
    (void)state;
    draw_noise(50, 20, 300);
    iris_image mask = mask_of_drawn(0), gray, small, broken = mask;
    iris_image_wrap(&gray, pixels, sizeof pixels, (iris_size){50, 20}, 0, IRIS_GRAY8);
    iris_image_wrap(&small, pixels, sizeof pixels, (iris_size){49, 20}, 0, IRIS_GRAY8);
    broken.w = 0;
    iris_blob_table table = {found, 10, -7}, none = {NULL, 10, -7}, negative = {found, -1, -7},
                    empty = {NULL, 0, -7};
    iris_scratch scratch = arena(sizeof memory);
    iris_blob_config config;
    iris_blob_defaults(&config);
    memset(found, 0x5a, sizeof found[0]);
    assert_int_equal(iris_blobs(NULL, &mask, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blobs(&none, &mask, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blobs(&negative, &mask, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blobs(&table, NULL, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blobs(&table, &mask, NULL, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_blobs(&table, &broken, NULL, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_blobs(&table, &gray, NULL, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_blobs(&table, &mask, &mask, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_blobs(&table, &mask, &small, NULL, &scratch), IRIS_ERR_RANGE);
    config.connectivity = 6;
    assert_int_equal(iris_blobs(&table, &mask, NULL, &config, &scratch), IRIS_ERR_ARG);
    config.connectivity = 4;
    config.filter.inside = 2;
    assert_int_equal(iris_blobs(&table, &mask, NULL, &config, &scratch), IRIS_ERR_ARG);
    size_t need = IRIS_BLOB_SCRATCH_BYTES(50, 10), more = IRIS_BLOB_COLOR_SCRATCH_BYTES(50);
    iris_scratch tight = arena(need - 1);
    assert_int_equal(iris_blobs(&table, &mask, NULL, NULL, &tight), IRIS_ERR_SCRATCH);
    tight = arena(need + more - 1);
    assert_int_equal(iris_blobs(&table, &mask, &gray, NULL, &tight), IRIS_ERR_SCRATCH);
    assert_int_equal(tight.used, 0);
    assert_int_equal(table.count, -7);
    assert_int_equal(found[0].area, 0x5a5a5a5a);
    assert_int_equal(iris_blobs(&empty, &mask, NULL, NULL, &scratch), IRIS_ERR_FULL);
    assert_true(empty.count > 20);
    iris_blob_scan scan = {.table = NULL};
    assert_int_equal(iris_blob_row(&scan, words, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_end(&scan), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_begin(&scan, &table, (iris_size){50, 20}, 2, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_begin(&scan, &table, (iris_size){50, 0}, 1, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_blob_begin(&scan, &table, (iris_size){50, 20}, 1, NULL, &scratch), IRIS_OK);
    assert_int_equal(iris_blob_row(&scan, words, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_blob_row(&scan, NULL, pixels), IRIS_ERR_ARG);
    assert_int_equal(scratch.used, need + more);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),    cmocka_unit_test(every_small_mask),    cmocka_unit_test(noise),
        cmocka_unit_test(hard_masks), cmocka_unit_test(real_shapes),         cmocka_unit_test(widest),
        cmocka_unit_test(views),      cmocka_unit_test(rows_as_they_arrive), cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
