/* Distances: from pixel to pixel by the formulas of the metrics, a few worked out by hand, and shapes. */
#include "iris/xt/distance.h"
#include "../picture.h"
#include "iris/xt/morph.h"

enum { PARENT_W = 160, PARENT_H = 40 };

static uint32_t words[PARENT_W / 32 * PARENT_H];
static uint16_t found[PARENT_W * PARENT_H], before[PARENT_W * PARENT_H];
static uint32_t seed = 3;

static int32_t between(int32_t low, int32_t high)
{
    return low + (int32_t)(next_random(&seed) % (uint32_t)(high - low + 1));
}

static int is_set(const iris_image *mask, int32_t x, int32_t y)
{
    const uint32_t *row = iris_image_row(mask, y);
    return (int)(row[x / 32] >> x % 32 & 1);
}

/* What n steps cost that lead dx to the side and dy down: as many diagonal ones as there can be, the rest straight. */
static int32_t cost(int32_t dx, int32_t dy, iris_distance_metric metric)
{
    int32_t wide = abs(dx), high = abs(dy), both = wide < high ? wide : high;
    return metric == IRIS_DISTANCE_L1 ? wide + high : 4 * both + 3 * (wide + high - 2 * both);
}

static int32_t nearest(const iris_image *mask, int32_t x, int32_t y, iris_distance_metric metric)
{
    int32_t least = IRIS_DISTANCE_MAX;
    for (int32_t v = 0; v < mask->h; v++) {
        for (int32_t u = 0; u < mask->w; u++) {
            int32_t here = cost(u - x, v - y, metric);
            least = here < least && !is_set(mask, u, v) ? here : least;
        }
    }
    return least;
}

static iris_image part(void *bytes, size_t size, iris_format format, int32_t w, int32_t h)
{
    iris_image parent, view;
    ptrdiff_t stride = (ptrdiff_t)iris_format_row_bytes(format, PARENT_W);
    int32_t x = format == IRIS_MASK1 ? 32 * between(0, 2) : between(0, 60);
    assert_int_equal(iris_image_wrap(&parent, bytes, size, (iris_size){PARENT_W, PARENT_H},
                                     between(0, 1) ? stride : -stride, format),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&view, &parent, (iris_rect){x, between(0, 9), w, h}), IRIS_OK);
    return view;
}

/* The nearest of all pixels; and what is around the view stays. */
static void check_transform(int32_t w, int32_t h, iris_distance_metric metric)
{
    iris_image mask = part(words, sizeof words, IRIS_MASK1, w, h);
    iris_image distance = part(found, sizeof found, IRIS_GRAY_U16, w, h);
    for (int i = 0; i < PARENT_W * PARENT_H; i++) {
        found[i] = (uint16_t)(next_random(&seed) >> 4);
    }
    memcpy(before, found, sizeof found);
    assert_int_equal(iris_distance_transform(&distance, &mask, metric), IRIS_OK);
    for (int32_t i = 0; i < w * h; i++) {
        uint16_t *row = iris_image_row(&distance, i / w);
        assert_int_equal(row[i % w], nearest(&mask, i % w, i / w, metric));
        row[i % w] = before[row + i % w - found];
    }
    assert_memory_equal(found, before, sizeof found);
}

static void random_masks(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 280; i++) {
        uint32_t rare = (uint32_t[]){2, 8, 60, 600}[i / 70];
        for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
            words[k] = 0;
            for (int bit = 0; bit < 32; bit++) {
                words[k] |= (uint32_t)((next_random(&seed) >> 6) % rare != 0) << bit;
            }
        }
        check_transform(1 + i % 70, between(1, 20), (iris_distance_metric)(i / 3 % 2));
    }
}

static void by_hand(void **state)
{
    (void)state;
    static const uint16_t l1[15] = {3, 2, 1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 2, 3};
    static const uint16_t chamfer[15] = {7, 4, 3, 4, 7, 6, 3, 0, 3, 6, 7, 4, 3, 4, 7};
    uint32_t rows[3] = {~0u, ~0u & ~4u, ~0u};
    uint16_t out[15];
    iris_image mask, distance;
    assert_int_equal(iris_image_wrap(&mask, rows, sizeof rows, (iris_size){5, 3}, 0, IRIS_MASK1), IRIS_OK);
    assert_int_equal(iris_image_wrap(&distance, out, sizeof out, (iris_size){5, 3}, 0, IRIS_GRAY_U16),
                     IRIS_OK);
    assert_int_equal(iris_distance_transform(&distance, &mask, IRIS_DISTANCE_L1), IRIS_OK);
    assert_memory_equal(out, l1, sizeof l1);
    assert_int_equal(iris_distance_transform(&distance, &mask, IRIS_DISTANCE_CHAMFER), IRIS_OK);
    assert_memory_equal(out, chamfer, sizeof chamfer);
    rows[1] = ~0u; /* what is past w does not count, nor what is beyond the edge */
    rows[0] = 0x1F;
    for (int metric = 0; metric < 2; metric++) {
        assert_int_equal(iris_distance_transform(&distance, &mask, (iris_distance_metric)metric), IRIS_OK);
        for (int i = 0; i < 15; i++) {
            assert_int_equal(out[i], IRIS_DISTANCE_MAX);
        }
    }
}

/* One clear pixel at the end of the longest row there can be: chamfer distances end at 65535, L1 ones do not. */
static void the_longest_way(void **state)
{
    (void)state;
    static uint32_t bits[2 * (IRIS_SIDE_MAX + 31) / 32];
    static uint16_t out[2 * IRIS_SIDE_MAX];
    for (int turn = 0; turn < 2; turn++) {
        iris_image mask, distance;
        int32_t clear = turn ? IRIS_SIDE_MAX - 1 : 0;
        memset(bits, 255, sizeof bits);
        bits[clear / 32] &= ~((uint32_t)1 << clear % 32);
        iris_size size = {IRIS_SIDE_MAX, 2};
        assert_int_equal(iris_image_wrap(&mask, bits, sizeof bits, size, 0, IRIS_MASK1), IRIS_OK);
        assert_int_equal(iris_image_wrap(&distance, out, sizeof out, size, 0, IRIS_GRAY_U16), IRIS_OK);
        for (int metric = 0; metric < 2; metric++) {
            assert_int_equal(iris_distance_transform(&distance, &mask, (iris_distance_metric)metric),
                             IRIS_OK);
            for (int32_t i = 0; i < 2 * IRIS_SIDE_MAX; i++) {
                int32_t far =
                    cost(i % IRIS_SIDE_MAX - clear, i / IRIS_SIDE_MAX, (iris_distance_metric)metric);
                assert_int_equal(out[i], far < IRIS_DISTANCE_MAX ? far : IRIS_DISTANCE_MAX);
            }
        }
    }
}

/* A pixel is clear, or one step farther than the nearest of its neighbors: that leaves no choice but the distances. */
static void assert_steps(const iris_image *distance, const iris_image *mask, iris_distance_metric metric)
{
    for (int32_t i = 0; i < mask->w * mask->h; i++) {
        int32_t x = i % mask->w, y = i / mask->w, least = is_set(mask, x, y) ? IRIS_DISTANCE_MAX : 0;
        for (int32_t k = 0; k < 9 && least > 0; k++) {
            int32_t u = x + k % 3 - 1, v = y + k / 3 - 1;
            if (k != 4 && u >= 0 && u < mask->w && v >= 0 && v < mask->h) {
                int32_t here = ((uint16_t *)iris_image_row(distance, v))[u] + cost(u - x, v - y, metric);
                least = here < least ? here : least;
            }
        }
        assert_int_equal(((uint16_t *)iris_image_row(distance, y))[x], least);
    }
}

/* What is left after n erosions by a cross is farther than n; of a photograph, bright and dark. */
static void a_photograph(void **state)
{
    (void)state;
    static uint32_t bits[8 * 256];
    static uint16_t out[256 * 256];
    static IRIS_SCRATCH_BUFFER(memory, IRIS_MORPH_SCRATCH_BYTES(IRIS_MASK1, 256, 3, 3));
    picture camera = load_pnm(data_path("edges/classic/camera_256.pgm"));
    if (!camera.pixels) {
        skip();
    }
    iris_image mask, distance;
    iris_scratch scratch;
    assert_int_equal(camera.w * camera.h, 256 * 256);
    assert_int_equal(iris_image_wrap(&mask, bits, sizeof bits, (iris_size){256, 256}, 0, IRIS_MASK1),
                     IRIS_OK);
    assert_int_equal(iris_image_wrap(&distance, out, sizeof out, (iris_size){256, 256}, 0, IRIS_GRAY_U16),
                     IRIS_OK);
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, sizeof memory.memory), IRIS_OK);
    for (int dark = 0; dark < 2; dark++) {
        memset(bits, 0, sizeof bits);
        for (int i = 0; i < 256 * 256; i++) {
            bits[i / 32] |= (uint32_t)((camera.pixels[i] > 100) != dark) << i % 32;
        }
        assert_int_equal(iris_distance_transform(&distance, &mask, IRIS_DISTANCE_CHAMFER), IRIS_OK);
        assert_steps(&distance, &mask, IRIS_DISTANCE_CHAMFER);
        assert_int_equal(iris_distance_transform(&distance, &mask, IRIS_DISTANCE_L1), IRIS_OK);
        assert_steps(&distance, &mask, IRIS_DISTANCE_L1);
        iris_morph_element cross = {3, 3, IRIS_MORPH_CROSS, 0};
        for (int n = 0; n < 60; n++) {
            for (int i = 0; i < 256 * 256; i++) {
                assert_int_equal(bits[i / 32] >> i % 32 & 1, out[i] > n);
            }
            assert_int_equal(iris_morph_erode(&mask, &mask, &cross, (iris_border){0}, &scratch), IRIS_OK);
        }
    }
    free(camera.pixels);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_image mask = part(words, sizeof words, IRIS_MASK1, 30, 9);
    iris_image distance = part(found, sizeof found, IRIS_GRAY_U16, 30, 9), bad;
    memcpy(before, found, sizeof found);
    assert_int_equal(iris_distance_transform(NULL, &mask, IRIS_DISTANCE_L1), IRIS_ERR_ARG);
    assert_int_equal(iris_distance_transform(&distance, NULL, IRIS_DISTANCE_L1), IRIS_ERR_ARG);
    assert_int_equal(iris_distance_transform(&distance, &mask, (iris_distance_metric)2), IRIS_ERR_ARG);
    assert_int_equal(iris_distance_transform(&mask, &mask, IRIS_DISTANCE_L1), IRIS_ERR_FORMAT);
    assert_int_equal(iris_distance_transform(&distance, &distance, IRIS_DISTANCE_L1), IRIS_ERR_FORMAT);
    bad = distance;
    bad.w = 29;
    assert_int_equal(iris_distance_transform(&bad, &mask, IRIS_DISTANCE_L1), IRIS_ERR_RANGE);
    bad.w = 0;
    assert_int_equal(iris_distance_transform(&bad, &mask, IRIS_DISTANCE_L1), IRIS_ERR_RANGE);
    bad = mask;
    bad.h = 8;
    assert_int_equal(iris_distance_transform(&distance, &bad, IRIS_DISTANCE_L1), IRIS_ERR_RANGE);
    bad = distance;
    bad.data = mask.data;
    assert_int_equal(iris_distance_transform(&bad, &mask, IRIS_DISTANCE_L1), IRIS_ERR_ALIAS);
    assert_memory_equal(found, before, sizeof found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(random_masks),
        cmocka_unit_test(the_longest_way),
        cmocka_unit_test(a_photograph),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
