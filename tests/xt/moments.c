/* Moments: masks worked out by hand; sums pixel by pixel; double precision; and what must not change, of shapes that are
 * moved, turned, mirrored, and scaled. */
#include <math.h>

#include "iris/xt/moments.h"
#include "shape_mask.h"

static uint32_t words[(SHAPE_SIDE_MAX / 32 + 4) * SHAPE_SIDE_MAX];
static shape drawn, other;
static uint32_t seed = 5;

#define ONE_Q40 1099511627776.0

static iris_mask_moments sum(const shape *s)
{
    iris_mask_moments m;
    size_t bytes = iris_format_row_bytes(IRIS_MASK1, s->w) * (size_t)s->h;
    iris_image mask = shape_mask(words, bytes, s, 0, ~0u);
    assert_int_equal(iris_mask_moments_sum(&m, &mask), IRIS_OK);
    return m;
}

static iris_invariants invariants_of(const shape *s)
{
    iris_mask_moments m = sum(s);
    iris_invariants v;
    assert_int_equal(iris_moments_invariants(&v, &m), IRIS_OK);
    return v;
}

static iris_mask_moments sum_slowly(const shape *s)
{
    iris_mask_moments m = {0};
    for (int64_t y = 0; y < s->h; y++) {
        for (int64_t x = 0; x < s->w; x++) {
            int64_t one = s->at[y][x];
            m.m00 += one;
            m.m10 += one * x;
            m.m01 += one * y;
            m.m20 += one * x * x;
            m.m11 += one * x * y;
            m.m02 += one * y * y;
            m.m30 += one * x * x * x;
            m.m21 += one * x * x * y;
            m.m12 += one * x * y * y;
            m.m03 += one * y * y * y;
        }
    }
    return m;
}

/* mu_pq, in double precision. */
static double mu(const shape *s, int p, int q)
{
    double n = 0, cx = 0, cy = 0, result = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int32_t y = 0; y < s->h; y++) {
            for (int32_t x = 0; x < s->w; x++) {
                if (s->at[y][x] && pass == 0) {
                    n++;
                    cx += x;
                    cy += y;
                } else if (s->at[y][x]) {
                    result += pow(x - cx, p) * pow(y - cy, q);
                }
            }
        }
        cx /= pass == 0 ? n : 1;
        cy /= pass == 0 ? n : 1;
    }
    return result;
}

/* Hu's seven as he wrote them. */
static void hu_of(double hu[7], double n20, double n11, double n02, const double n3[4])
{
    double n30 = n3[0], n21 = n3[1], n12 = n3[2], n03 = n3[3];
    double a = n30 + n12, b = n21 + n03, c = n30 - 3 * n12, d = 3 * n21 - n03;
    hu[0] = n20 + n02;
    hu[1] = (n20 - n02) * (n20 - n02) + 4 * n11 * n11;
    hu[2] = c * c + d * d;
    hu[3] = a * a + b * b;
    hu[4] = c * a * (a * a - 3 * b * b) + d * b * (3 * a * a - b * b);
    hu[5] = (n20 - n02) * (a * a - b * b) + 4 * n11 * a * b;
    hu[6] = d * a * (a * a - 3 * b * b) - c * b * (3 * a * a - b * b);
}

static void assert_near(int64_t fixed, double one, double expected, double within)
{
    double value = (double)fixed / one;
    if (!(fabs(value - expected) <= within)) {
        print_error("%.12g is not %.12g within %.3g\n", value, expected, within);
        fail();
    }
}

static void assert_as_in_double(const shape *s)
{
    iris_mask_moments m = sum(s), slow = sum_slowly(s);
    assert_memory_equal(&m, &slow, sizeof m);
    if (m.m00 == 0) {
        return;
    }
    iris_invariants v = invariants_of(s);
    double n = (double)m.m00, n3[4], hu[7], most = 0;
    const int64_t mus[7] = {v.mu20_q6, v.mu11_q6, v.mu02_q6, v.mu30_q6, v.mu21_q6, v.mu12_q6, v.mu03_q6};
    const int64_t etas[7] = {v.eta20_q40, v.eta11_q40, v.eta02_q40, v.eta30_q40,
                             v.eta21_q40, v.eta12_q40, v.eta03_q40};
    double eta[7];
    for (int i = 0; i < 7; i++) {
        int order = i < 3 ? 2 : 3, q = i < 3 ? i : i - 3;
        double exact = mu(s, order - q, q), scale = pow(n, 1 + order / 2.0);
        assert_near(mus[i], 64, exact, 0.51 / 64 + fabs(exact) * 1e-12 + 1e-6);
        eta[i] = exact / scale;
        assert_near(etas[i], ONE_Q40, eta[i], 0.01 / scale + fabs(eta[i]) * 3e-6 + 2 / ONE_Q40);
        most = fabs(eta[i]) > most ? fabs(eta[i]) : most;
        eta[i] = (double)etas[i] / ONE_Q40;
    }
    memcpy(n3, eta + 3, sizeof n3);
    hu_of(hu, eta[0], eta[1], eta[2], n3);
    for (int i = 0; i < 7 && most < 8; i++) { /* long thin lines saturate */
        assert_near(v.hu_q40[i], ONE_Q40, hu[i], 16 / ONE_Q40 * (1 + most + most * most * most));
    }
    assert_near(v.x_q16, 65536, (double)m.m10 / n, 0.51 / 65536);
    assert_near(v.y_q16, 65536, (double)m.m01 / n, 0.51 / 65536);
}

static void by_hand(void **state)
{
    (void)state;
    shape_draw(&drawn, 4, 2,
               "####"
               "#...");
    const iris_mask_moments expected = {5, 6, 1, 14, 0, 1, 36, 0, 0, 1};
    iris_mask_moments m = sum(&drawn);
    assert_memory_equal(&m, &expected, sizeof m);
    iris_invariants v = invariants_of(&drawn);
    assert_int_equal(v.mu20_q6, 435); /* 14 - 36 / 5 = 6.8 */
    assert_int_equal(v.x_q16, 78643); /* 1.2 */
    shape_draw(&drawn, 2, 2, "####");
    v = invariants_of(&drawn);
    assert_int_equal(v.mu20_q6, 64);
    assert_int_equal(v.eta20_q40, (int64_t)1 << 36); /* 1 / 16 */
    assert_int_equal(v.hu_q40[0], (int64_t)1 << 37);
    for (int i = 1; i < 7; i++) {
        assert_int_equal(v.hu_q40[i], 0);
    }
    shape_draw(&drawn, 3, 1, "...");
    m = sum(&drawn);
    assert_int_equal(m.m00, 0);
    assert_int_equal(iris_moments_invariants(&v, &m), IRIS_ERR_RANGE);
}

static void as_in_double_precision(void **state)
{
    (void)state;
    for (int i = 0; i < 300; i++) {
        drawn.w = 1 + (int32_t)(next_random(&seed) % 100);
        drawn.h = 1 + (int32_t)(next_random(&seed) % 50);
        uint32_t share = next_random(&seed) % 257;
        for (int32_t k = 0; k < drawn.w * drawn.h; k++) {
            drawn.at[k / drawn.w][k % drawn.w] = next_random(&seed) % 256 < share;
        }
        assert_as_in_double(&drawn);
    }
    for (int i = 0; i < SHAPE_NAMES; i++) {
        if (!shape_load(&drawn, shape_name(i))) {
            skip();
        }
        assert_as_in_double(&drawn);
    }
}

/* A shape turned by quarters, mirrored, moved, or three times as large. */
static void change(int kind)
{
    int scale = kind == 7 ? 3 : 1;
    int32_t w = drawn.w, h = drawn.h, off = kind == 6 ? 17 : 0;
    memset(other.at, 0, sizeof other.at);
    other.w = kind % 2 == 1 && kind < 4 ? h : w * scale + off;
    other.h = kind % 2 == 1 && kind < 4 ? w : h * scale + off;
    for (int32_t y = 0; y < other.h - off; y++) {
        for (int32_t x = 0; x < other.w - off; x++) {
            const int32_t from[8][2] = {{x, y},         {y, h - 1 - x}, {w - 1 - x, h - 1 - y},
                                        {w - 1 - y, x}, {w - 1 - x, y}, {x, h - 1 - y},
                                        {x, y},         {x / 3, y / 3}};
            other.at[y + off][x + off] = drawn.at[from[kind][1]][from[kind][0]];
        }
    }
}

static void stay_the_same(void **state)
{
    (void)state;
    static const char *const names[] = {"shapes/mpeg7/fork-05.bmp", "shapes/mpeg7/key-01.bmp"};
    for (int i = 0; i < 2; i++) {
        if (!shape_load(&drawn, names[i])) {
            skip();
        }
        drawn.w = drawn.w > 130 ? 130 : drawn.w; /* three times fits; any shape will do */
        drawn.h = drawn.h > 130 ? 130 : drawn.h;
        iris_invariants before = invariants_of(&drawn);
        for (int kind = 1; kind < 8; kind++) {
            change(kind);
            iris_invariants after = invariants_of(&other);
            double within = kind == 7 ? 2e-4 : 1e-9;
            int mirrored = kind == 4 || kind == 5;
            for (int k = 0; k < 7; k++) {
                double value = (double)before.hu_q40[k] / ONE_Q40;
                assert_near(after.hu_q40[k], ONE_Q40, k == 6 && mirrored ? -value : value, within);
            }
        }
    }
}

/* The largest mask, all selected: known sums, and a square's moments. */
static void largest(void **state)
{
    (void)state;
    const int64_t n = IRIS_MOMENTS_SIDE_MAX, s1 = n * (n - 1) / 2, s2 = (n - 1) * n * (2 * n - 1) / 6;
    size_t bytes = (size_t)(n * n / 8);
    uint32_t *all = malloc(bytes);
    memset(all, 0xff, bytes);
    iris_image mask;
    assert_int_equal(iris_image_wrap(&mask, all, bytes, (iris_size){(int32_t)n, (int32_t)n}, 0, IRIS_MASK1),
                     IRIS_OK);
    iris_mask_moments m;
    iris_invariants v;
    assert_int_equal(iris_mask_moments_sum(&m, &mask), IRIS_OK);
    assert_true(m.m00 == n * n && m.m10 == n * s1 && m.m11 == s1 * s1 && m.m20 == n * s2);
    assert_true(m.m30 == n * s1 * s1 && m.m21 == s2 * s1 && m.m12 == s2 * s1 && m.m03 == m.m30);
    assert_int_equal(iris_moments_invariants(&v, &m), IRIS_OK);
    assert_near(v.eta20_q40, ONE_Q40, 1.0 / 12, 1e-7);
    assert_int_equal(v.eta30_q40, 0);
    assert_int_equal(iris_image_wrap(&mask, all, bytes, (iris_size){(int32_t)n + 1, 1}, 0, IRIS_MASK1),
                     IRIS_OK);
    assert_int_equal(iris_mask_moments_sum(&m, &mask), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_wrap(&mask, all, bytes, (iris_size){(int32_t)n, 1}, 0, IRIS_MASK1), IRIS_OK);
    assert_int_equal(iris_mask_moments_sum(&m, &mask), IRIS_OK); /* the longest row, one pixel high */
    assert_int_equal(iris_moments_invariants(&v, &m), IRIS_OK);
    assert_near(v.eta20_q40, ONE_Q40, 4096 / 12.0, 1e-3);
    free(all);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static uint8_t bytes[64];
    iris_image gray;
    iris_mask_moments m = {77, 77, 77, 77, 77, 77, 77, 77, 77, 77}, kept = m;
    iris_invariants v = {.x_q16 = 77};
    assert_int_equal(iris_image_wrap(&gray, bytes, sizeof bytes, (iris_size){8, 8}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_mask_moments_sum(NULL, &gray), IRIS_ERR_ARG);
    assert_int_equal(iris_mask_moments_sum(&m, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_mask_moments_sum(&m, &gray), IRIS_ERR_FORMAT);
    assert_memory_equal(&m, &kept, sizeof m);
    assert_int_equal(iris_moments_invariants(NULL, &m), IRIS_ERR_ARG);
    assert_int_equal(iris_moments_invariants(&v, NULL), IRIS_ERR_ARG);
    m.m30 = -1;
    assert_int_equal(iris_moments_invariants(&v, &m), IRIS_ERR_RANGE);
    m = (iris_mask_moments){.m00 = (int64_t)IRIS_MOMENTS_SIDE_MAX * IRIS_MOMENTS_SIDE_MAX + 1};
    assert_int_equal(iris_moments_invariants(&v, &m), IRIS_ERR_RANGE);
    assert_int_equal(v.x_q16, 77);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand), cmocka_unit_test(as_in_double_precision),  cmocka_unit_test(stay_the_same),
        cmocka_unit_test(largest), cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("moments", tests, NULL, NULL);
}
