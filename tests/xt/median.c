/* Medians: against sorting, on random and on real pictures. */
#include "iris/xt/median.h"

#include "../picture.h"

#define SIDE 70

static uint8_t source[4 * SIDE * SIDE], result[4 * SIDE * SIDE], expected[4 * SIDE * SIDE];
static IRIS_SCRATCH_BUFFER(memory, IRIS_MEDIAN_SCRATCH_BYTES(SIDE, 3, 5));

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image view(uint8_t *pixels, int32_t w, int32_t h, iris_format format)
{
    iris_image image;
    ptrdiff_t stride = (ptrdiff_t)iris_format_row_bytes(format, w) + 5;
    assert_int_equal(iris_image_wrap(&image, pixels + 1, 4 * SIDE * SIDE - 1, (iris_size){w, h},
                                     h % 2 ? -stride : stride, format),
                     IRIS_OK);
    return image;
}

static uint8_t *at(const iris_image *image, int32_t i, int32_t y)
{
    return (uint8_t *)iris_image_row(image, y) + i;
}

static int compare(const void *a, const void *b)
{
    return *(const uint8_t *)a - *(const uint8_t *)b;
}

static uint8_t sample(const iris_image *src, int x, int y, int c, iris_border border)
{
    int channels = src->format == IRIS_GRAY8 ? 1 : 3;
    x = iris_border_index(x, src->w, border.rule);
    y = iris_border_index(y, src->h, border.rule);
    return x < 0 || y < 0 ? border.value : *at(src, x * channels + c, y);
}

static uint8_t median_by_sorting(const iris_image *src, int i, int y, int side, iris_border border)
{
    int channels = src->format == IRIS_GRAY8 ? 1 : 3, count = 0;
    uint8_t values[25] = {0};
    for (int dy = -side / 2; dy <= side / 2; dy++) {
        for (int dx = -side / 2; dx <= side / 2; dx++) {
            values[count++] = sample(src, i / channels + dx, y + dy, i % channels, border);
        }
    }
    qsort(values, (size_t)count, 1, compare);
    return values[count / 2];
}

static void check(const iris_image *src, int side, iris_border border, int in_place)
{
    int channels = src->format == IRIS_GRAY8 ? 1 : 3;
    size_t bytes = IRIS_MEDIAN_SCRATCH_BYTES(src->w, channels, side);
    memcpy(result, source, sizeof result);
    memcpy(expected, source, sizeof expected);
    iris_image dst = view(result, src->w, src->h, src->format),
               wanted = view(expected, src->w, src->h, src->format);
    for (int y = 0; y < src->h; y++) {
        for (int i = 0; i < src->w * channels; i++) {
            int x = i / channels, r = side / 2;
            if (border.rule != IRIS_BORDER_SKIP || (x >= r && y >= r && x < src->w - r && y < src->h - r)) {
                *at(&wanted, i, y) = median_by_sorting(src, i, y, side, border);
            }
        }
    }
    iris_scratch scratch = arena(bytes);
    assert_int_equal(iris_median(&dst, in_place ? &dst : src, side, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, bytes);
    assert_int_equal(scratch.used, 0);
    assert_memory_equal(result, expected, sizeof result);
}

static void against_sorting(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1},  {1, 9},   {9, 1},  {2, 2}, {5, 4},
                                      {16, 3}, {17, 12}, {47, 9}, {66, 5}};
    uint32_t seed = 11;
    for (int s = 0; s < 9; s++) {
        for (int k = 0; k < 16; k++) {
            uint32_t levels = k < 8 ? 256 : 3; /* many different, and many alike */
            for (size_t i = 0; i < sizeof source; i++) {
                source[i] = (uint8_t)(next_random(&seed) % levels);
            }
            iris_border border = {(iris_border_rule)(k % 4), 200};
            iris_image src = view(source, sizes[s].w, sizes[s].h, (s + k) % 3 ? IRIS_GRAY8 : IRIS_BGR888);
            check(&src, k / 4 % 2 ? 5 : 3, border, (s + k) % 2);
        }
    }
}

/* A network that is right for values of 0 and 1 is right for all. Of 3x3 all pictures of zeros and ones; of 5x5 all counts of
 * ones in the columns, in four arrangements each. One window stands beside the other. */
static void of_all_zeros_and_ones(void **state)
{
    (void)state;
    static uint8_t pixels[5 * 5 * 7776], medians[5 * 5 * 7776];
    static IRIS_SCRATCH_BUFFER(room, IRIS_MEDIAN_SCRATCH_BYTES(25000, 1, 5));
    for (int side = 3; side <= 5; side += 2) {
        int patterns = side == 3 ? 512 : 4 * 7776, ones_most = 0;
        for (int first = 0; first < patterns; first += 3888) {
            int count = patterns - first < 3888 ? patterns - first : 3888, w = side * count;
            memset(pixels, 0, sizeof pixels);
            for (int p = 0; p < count; p++) {
                int code = first + p, turn = code % 4;
                code = side == 3 ? code : code / 4;
                for (int c = 0; c < side; c++) {
                    int ones = code % (side + 1);
                    code /= side + 1;
                    for (int r = 0; r < side; r++) {
                        int set = side == 3 ? (first + p) >> (3 * c + r) & 1 : (r + turn * c) % 5 < ones;
                        pixels[r * w + side * p + c] = (uint8_t)set;
                    }
                }
            }
            iris_image src, dst;
            iris_scratch scratch;
            assert_int_equal(iris_scratch_init(&scratch, room.memory, sizeof room), IRIS_OK);
            assert_int_equal(
                iris_image_wrap(&src, pixels, sizeof pixels, (iris_size){w, side}, 0, IRIS_GRAY8), IRIS_OK);
            assert_int_equal(
                iris_image_wrap(&dst, medians, sizeof medians, (iris_size){w, side}, 0, IRIS_GRAY8), IRIS_OK);
            assert_int_equal(iris_median(&dst, &src, side, (iris_border){0}, &scratch), IRIS_OK);
            for (int p = 0; p < count; p++) {
                int ones = 0;
                for (int i = 0; i < side * side; i++) {
                    ones += pixels[i / side * w + side * p + i % side];
                }
                ones_most = ones > ones_most ? ones : ones_most;
                assert_int_equal(medians[side / 2 * w + side * p + side / 2], ones > side * side / 2);
            }
        }
        assert_int_equal(ones_most, side * side);
    }
}

static void of_a_real_picture(void **state)
{
    (void)state;
    picture from = load_pnm(data_path("edges/bsds/69007.pgm"));
    if (!from.pixels) {
        print_message("edges/bsds/69007.pgm is missing\n");
        skip();
    }
    iris_image src = view(source, 69, 67, IRIS_GRAY8);
    for (int y = 0; y < src.h; y++) {
        memcpy(at(&src, 0, y), from.pixels + (y + 120) * from.w + 200, (size_t)src.w);
    }
    free(from.pixels);
    check(&src, 3, (iris_border){0}, 0);
    check(&src, 5, (iris_border){IRIS_BORDER_REFLECT101, 0}, 1);
}

/* A bright spot of up to 4 or 12 pixels goes, an edge stays where it is. */
static void takes_away_spots_and_keeps_edges(void **state)
{
    (void)state;
    iris_image image = view(source, 40, 30, IRIS_GRAY8);
    for (int side = 3; side <= 5; side += 2) {
        for (int i = 0; i < 40 * 30; i++) {
            int x = i % 40, y = i / 40;
            int spot = x >= 5 && x < 3 + side && y >= 5 && y < 3 + side;
            *at(&image, x, y) = spot ? 255 : x < 20 ? 10 : 90;
        }
        iris_scratch scratch = arena(sizeof memory);
        assert_int_equal(iris_median(&image, &image, side, (iris_border){0}, &scratch), IRIS_OK);
        for (int i = 0; i < 40 * 30; i++) {
            assert_int_equal(*at(&image, i % 40, i / 40), i % 40 < 20 ? 10 : 90);
        }
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    memset(source, 1, sizeof source);
    memset(result, 2, sizeof result);
    iris_image src = view(source, 20, 20, IRIS_GRAY8), dst = view(result, 20, 20, IRIS_GRAY8), bad = dst;
    iris_scratch scratch = arena(sizeof memory);
    iris_border border = {0};
    assert_int_equal(iris_median(NULL, &src, 3, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_median(&dst, NULL, 3, border, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_median(&dst, &src, 3, border, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_median(&dst, &src, 3, (iris_border){(iris_border_rule)9, 0}, &scratch),
                     IRIS_ERR_ARG);
    static const int32_t sides[] = {INT32_MIN, -3, 0, 1, 2, 4, 6, 7, INT32_MAX};
    for (int i = 0; i < 9; i++) {
        assert_int_equal(iris_median(&dst, &src, sides[i], border, &scratch), IRIS_ERR_RANGE);
    }
    bad.h = 19;
    assert_int_equal(iris_median(&bad, &src, 3, border, &scratch), IRIS_ERR_RANGE);
    bad = view(result, 20, 20, IRIS_UV88);
    assert_int_equal(iris_median(&bad, &bad, 3, border, &scratch), IRIS_ERR_FORMAT);
    bad = src;
    bad.data = at(&src, 1, 0);
    assert_int_equal(iris_median(&bad, &src, 3, border, &scratch), IRIS_ERR_ALIAS);
    for (int32_t side = 3; side <= 5; side += 2) {
        scratch = arena(IRIS_MEDIAN_SCRATCH_BYTES(20, 1, side) - 1);
        assert_int_equal(iris_median(&dst, &src, side, border, &scratch), IRIS_ERR_SCRATCH);
        assert_int_equal(scratch.used, 0);
    }
    for (size_t i = 0; i < sizeof result; i++) {
        assert_int_equal(result[i], 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_sorting),         cmocka_unit_test(of_all_zeros_and_ones),
        cmocka_unit_test(of_a_real_picture),       cmocka_unit_test(takes_away_spots_and_keeps_edges),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("median", tests, NULL, NULL);
}
