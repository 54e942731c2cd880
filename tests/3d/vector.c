/* Points, lines, and planes against double precision. */
#include "iris/3d/vector.h"

#include "random3d.h"
#include "test.h"

typedef struct {
    double x, y, z;
} vec;

static vec of(iris_vec3 a)
{
    return (vec){real(a.x), real(a.y), real(a.z)};
}

static vec plus(vec a, double t, vec b)
{
    return (vec){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

static double dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec cross(vec a, vec b)
{
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double length(vec a)
{
    return sqrt(dot(a, a));
}

static double off(iris_vec3 a, vec b)
{
    return length(plus(of(a), -1, b));
}

static const double unit = 1 / 4294967296.0;

static iris_vec3 whole(int x, int y, int z)
{
    return (iris_vec3){x * IRIS_Q32_ONE, y * IRIS_Q32_ONE, z * IRIS_Q32_ONE};
}

static int same(iris_vec3 a, iris_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void by_hand(void **state)
{
    (void)state;
    iris_vec3 a = whole(1, 2, 3), b = whole(4, -5, 6), middle;
    iris_q32 gap, t;
    assert_true(same(iris_vec3_add(a, b), whole(5, -3, 9)));
    assert_true(same(iris_vec3_sub(a, b), whole(-3, 7, -3)));
    assert_true(same(iris_vec3_scale(a, 2 * IRIS_Q32_ONE), whole(2, 4, 6)));
    assert_true(iris_vec3_dot(a, b) == 12 * IRIS_Q32_ONE);
    assert_true(same(iris_vec3_cross(a, b), whole(27, 6, -13)));
    assert_true(iris_vec3_length(whole(2, 3, 6)) == 7 * IRIS_Q32_ONE);
    iris_line3 right = {whole(0, 0, 5), whole(1, 0, 0)}, down = {whole(3, -4, 9), whole(0, 1, 0)};
    assert_int_equal(iris_line3_meet(&middle, &gap, &right, &down), IRIS_OK);
    assert_true(same(middle, whole(3, 0, 7)) && gap == 4 * IRIS_Q32_ONE);
    assert_true(iris_line3_distance(&right, whole(100, 3, 9)) == 5 * IRIS_Q32_ONE);
    iris_plane plane;
    assert_int_equal(iris_plane_through(&plane, whole(0, 0, 2), whole(1, 0, 2), whole(0, 1, 2)), IRIS_OK);
    assert_true(same(plane.normal, whole(0, 0, 1)) && plane.offset == 2 * IRIS_Q32_ONE);
    iris_line3 slanting = {whole(1, 1, 0), whole(2, 0, 1)};
    assert_int_equal(iris_plane_meet(&middle, &t, &plane, &slanting), IRIS_OK);
    assert_true(same(middle, whole(5, 1, 2)) && t == 2 * IRIS_Q32_ONE);
}

static void as_in_double_precision(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        iris_q32 limit = IRIS_Q32_ONE << i % 10;
        iris_vec3 a = random_vec3(limit), b = random_vec3(limit), n;
        double size = real(limit);
        assert_true(fabs(real(iris_vec3_dot(a, b)) - dot(of(a), of(b))) <= unit + size * size * 1e-15);
        assert_true(off(iris_vec3_cross(a, b), cross(of(a), of(b))) <= 2 * unit + size * size * 1e-15);
        assert_true(fabs(real(iris_vec3_length(a)) - length(of(a))) <= 2 * unit);
        assert_int_equal(iris_vec3_normalize(&n, a), IRIS_OK);
        assert_true(off(n, plus((vec){0, 0, 0}, 1 / length(of(a)), of(a))) <= 2 * unit);
    }
}

static void lines_meet(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        iris_line3 a = {random_vec3(100 * IRIS_Q32_ONE), random_direction()};
        iris_line3 b = {random_vec3(100 * IRIS_Q32_ONE), random_direction()};
        iris_vec3 middle;
        iris_q32 gap;
        vec n = cross(of(a.direction), of(b.direction));
        double sine = length(n);
        if (sine < 0.01) {
            continue;
        }
        n = plus((vec){0, 0, 0}, 1 / sine, n);
        double distance = fabs(dot(n, plus(of(b.origin), -1, of(a.origin))));
        assert_int_equal(iris_line3_meet(&middle, &gap, &a, &b), IRIS_OK);
        assert_true(fabs(real(gap) - distance) <= 1e-6);
        assert_true(fabs(real(iris_line3_distance(&a, middle)) - distance / 2) <= 1e-6);
        assert_true(fabs(real(iris_line3_distance(&b, middle)) - distance / 2) <= 1e-6);
    }
}

static void planes(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        iris_vec3 a = random_vec3(10 * IRIS_Q32_ONE), b = random_vec3(10 * IRIS_Q32_ONE),
                  c = random_vec3(10 * IRIS_Q32_ONE), at;
        iris_plane plane;
        iris_q32 t;
        if (iris_plane_through(&plane, a, b, c) != IRIS_OK ||
            length(cross(plus(of(b), -1, of(a)), plus(of(c), -1, of(a)))) < 1) {
            continue;
        }
        assert_true(fabs(real(iris_plane_distance(&plane, a))) < 1e-5);
        assert_true(fabs(real(iris_plane_distance(&plane, b))) < 1e-5);
        assert_true(fabs(real(iris_plane_distance(&plane, c))) < 1e-5);
        iris_line3 line = {random_vec3(10 * IRIS_Q32_ONE), random_direction()};
        if (fabs(dot(of(line.direction), of(plane.normal))) > 0.1) {
            assert_int_equal(iris_plane_meet(&at, &t, &plane, &line), IRIS_OK);
            assert_true(fabs(real(iris_plane_distance(&plane, at))) < 1e-5);
            assert_true(iris_line3_distance(&line, at) < 1000);
        }
    }
}

static void what_is_nothing(void **state)
{
    (void)state;
    iris_vec3 v = whole(7, 7, 7);
    iris_line3 line = {v, v}, parallel = {whole(0, 0, 0), whole(0, 1, 0)},
               other = {whole(1, 0, 0), whole(0, 1, 0)};
    iris_plane plane = {v, 7};
    iris_q32 gap = 7;
    assert_int_equal(iris_vec3_normalize(&v, whole(0, 0, 0)), IRIS_ERR_RANGE);
    assert_int_equal(iris_line3_through(&line, whole(1, 2, 3), whole(1, 2, 3)), IRIS_ERR_RANGE);
    assert_int_equal(iris_line3_meet(&v, &gap, &parallel, &other), IRIS_ERR_RANGE);
    assert_int_equal(iris_plane_through(&plane, whole(1, 1, 1), whole(2, 2, 2), whole(5, 5, 5)),
                     IRIS_ERR_RANGE);
    plane = (iris_plane){whole(1, 0, 0), 0};
    assert_int_equal(iris_plane_meet(&v, &gap, &plane, &other), IRIS_ERR_RANGE);
    assert_true(same(v, whole(7, 7, 7)) && gap == 7 && same(line.origin, v));
    iris_vec3 n;
    assert_int_equal(iris_vec3_normalize(&n, (iris_vec3){0, -1, 0}), IRIS_OK); /* however short */
    assert_true(same(n, whole(0, -1, 0)));
}

/* Nothing overflows: the sanitizers look on. */
static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        iris_vec3 a = {any_q32(), any_q32(), any_q32()}, b = {any_q32(), any_q32(), any_q32()}, c;
        iris_line3 line = {a, b}, other = {b, a};
        iris_plane plane = {b, any_q32()};
        iris_q32 t;
        (void)iris_vec3_normalize(&c, iris_vec3_cross(a, b));
        (void)iris_line3_meet(&c, &t, &line, &other);
        (void)iris_line3_through(&line, a, b);
        (void)iris_plane_meet(&c, &t, &plane, &line);
        (void)iris_plane_through(&plane, a, b, c);
        assert_true(iris_vec3_length(a) >= 0 && iris_line3_distance(&other, b) >= 0);
    }
    iris_vec3 far = {INT64_MAX, INT64_MAX, INT64_MAX};
    assert_true(iris_vec3_length(far) == INT64_MAX && iris_vec3_dot(far, far) == INT64_MAX);
    assert_true(iris_vec3_add(far, far).x == INT64_MAX &&
                iris_vec3_sub((iris_vec3){INT64_MIN, 0, 0}, far).x == INT64_MIN);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand), cmocka_unit_test(as_in_double_precision), cmocka_unit_test(lines_meet),
        cmocka_unit_test(planes),  cmocka_unit_test(what_is_nothing),        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
