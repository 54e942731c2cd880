#include "iris/3d/vector.h"

#define PARALLEL ((iris_q32)1 << 18) /* a sine of 2^-14 */

static iris_q32 sat(iris_wide a)
{
    return iris_wide_round_shift_sat(a, 0);
}

static iris_q32 add(iris_q32 a, iris_q32 b)
{
    return sat(iris_wide_add(iris_wide_from(a), iris_wide_from(b)));
}

static iris_q32 sub(iris_q32 a, iris_q32 b)
{
    return sat(iris_wide_sub(iris_wide_from(a), iris_wide_from(b)));
}

iris_vec3 iris_vec3_add(iris_vec3 a, iris_vec3 b)
{
    return (iris_vec3){add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)};
}

iris_vec3 iris_vec3_sub(iris_vec3 a, iris_vec3 b)
{
    return (iris_vec3){sub(a.x, b.x), sub(a.y, b.y), sub(a.z, b.z)};
}

iris_vec3 iris_vec3_scale(iris_vec3 a, iris_q32 factor)
{
    return (iris_vec3){iris_q32_mul_sat(a.x, factor), iris_q32_mul_sat(a.y, factor),
                       iris_q32_mul_sat(a.z, factor)};
}

static int64_t magnitude(int64_t value)
{
    return value >= 0 ? value : value == INT64_MIN ? INT64_MAX : -value;
}

/* How many bits the longest coordinate has. */
static int bits_of(iris_vec3 a)
{
    return iris_wide_bits(iris_wide_from(magnitude(a.x) | magnitude(a.y) | magnitude(a.z)));
}

/* a 2^bits, or a / 2^-bits. */
static iris_vec3 shifted(iris_vec3 a, int bits)
{
    if (bits >= 0) {
        int64_t factor = (int64_t)1 << bits;
        return (iris_vec3){a.x * factor, a.y * factor, a.z * factor};
    }
    return (iris_vec3){a.x >> -bits, a.y >> -bits, a.z >> -bits};
}

static iris_wide exact_dot(iris_vec3 a, iris_vec3 b)
{
    return iris_wide_add(iris_wide_add(iris_wide_mul(a.x, b.x), iris_wide_mul(a.y, b.y)),
                         iris_wide_mul(a.z, b.z));
}

/* So that a sum of three products with b does not leave 128 bits: by how much both together are shortened. */
static int spare_bits(iris_vec3 a, iris_vec3 b)
{
    int bits = bits_of(a) + bits_of(b) - 124;
    return bits > 0 ? bits : 0;
}

iris_q32 iris_vec3_dot(iris_vec3 a, iris_vec3 b)
{
    int spare = spare_bits(a, b);
    return iris_wide_round_shift_sat(exact_dot(shifted(a, -spare), b), 32 - spare);
}

static iris_q32 crossed(iris_q32 a, iris_q32 b, iris_q32 c, iris_q32 d, int bits)
{
    return iris_wide_round_shift_sat(iris_wide_sub(iris_wide_mul(a, b), iris_wide_mul(c, d)), bits);
}

iris_vec3 iris_vec3_cross(iris_vec3 a, iris_vec3 b)
{
    int spare = spare_bits(a, b);
    a = shifted(a, -spare);
    return (iris_vec3){crossed(a.y, b.z, a.z, b.y, 32 - spare), crossed(a.z, b.x, a.x, b.z, 32 - spare),
                       crossed(a.x, b.y, a.y, b.x, 32 - spare)};
}

iris_q32 iris_vec3_length(iris_vec3 a)
{
    int spare = bits_of(a) - 60;
    if (spare <= 0) {
        return iris_wide_sqrt(exact_dot(a, a));
    }
    a = shifted(a, -spare);
    int64_t length = iris_wide_sqrt(exact_dot(a, a));
    return length > INT64_MAX >> spare ? INT64_MAX : length << spare;
}

iris_status iris_vec3_normalize(iris_vec3 *unit, iris_vec3 a)
{
    int bits = bits_of(a);
    if (bits == 0) {
        return IRIS_ERR_RANGE;
    }
    a = shifted(a, 60 - bits);
    int64_t length = iris_wide_sqrt(exact_dot(a, a));
    unit->x = iris_q32_div_sat(a.x, length);
    unit->y = iris_q32_div_sat(a.y, length);
    unit->z = iris_q32_div_sat(a.z, length);
    return IRIS_OK;
}

iris_status iris_line3_through(iris_line3 *line, iris_vec3 a, iris_vec3 b)
{
    iris_vec3 direction;
    iris_status status = iris_vec3_normalize(&direction, iris_vec3_sub(b, a));
    if (status == IRIS_OK) {
        line->origin = a;
        line->direction = direction;
    }
    return status;
}

iris_vec3 iris_line3_point(const iris_line3 *line, iris_q32 t)
{
    return iris_vec3_add(line->origin, iris_vec3_scale(line->direction, t));
}

iris_q32 iris_line3_distance(const iris_line3 *line, iris_vec3 p)
{
    return iris_vec3_length(iris_vec3_cross(line->direction, iris_vec3_sub(p, line->origin)));
}

iris_status iris_line3_meet(iris_vec3 *middle, iris_q32 *gap, const iris_line3 *a, const iris_line3 *b)
{
    iris_vec3 across = iris_vec3_cross(a->direction, b->direction), normal;
    iris_vec3 between = iris_vec3_sub(b->origin, a->origin);
    iris_q32 sine = iris_vec3_length(across);
    if (sine < PARALLEL || iris_vec3_normalize(&normal, across) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    iris_q32 along_a = iris_vec3_dot(iris_vec3_cross(between, b->direction), normal);
    iris_q32 along_b = iris_vec3_dot(iris_vec3_cross(between, a->direction), normal);
    iris_vec3 on_a = iris_line3_point(a, iris_q32_div_sat(along_a, sine));
    iris_vec3 on_b = iris_line3_point(b, iris_q32_div_sat(along_b, sine));
    iris_vec3 apart = iris_vec3_sub(on_b, on_a);
    *gap = iris_vec3_length(apart);
    *middle = iris_vec3_add(on_a, iris_vec3_scale(apart, IRIS_Q32_ONE / 2));
    return IRIS_OK;
}

iris_status iris_plane_through(iris_plane *plane, iris_vec3 a, iris_vec3 b, iris_vec3 c)
{
    iris_vec3 first, second, normal;
    if (iris_vec3_normalize(&first, iris_vec3_sub(b, a)) != IRIS_OK ||
        iris_vec3_normalize(&second, iris_vec3_sub(c, a)) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    iris_vec3 across = iris_vec3_cross(first, second);
    if (iris_vec3_length(across) < PARALLEL || iris_vec3_normalize(&normal, across) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    plane->normal = normal;
    plane->offset = iris_vec3_dot(normal, a);
    return IRIS_OK;
}

iris_q32 iris_plane_distance(const iris_plane *plane, iris_vec3 p)
{
    return sub(iris_vec3_dot(plane->normal, p), plane->offset);
}

iris_status iris_plane_meet(iris_vec3 *point, iris_q32 *t, const iris_plane *plane, const iris_line3 *line)
{
    iris_q32 approach = iris_vec3_dot(plane->normal, line->direction);
    iris_q32 along =
        iris_q32_div_sat(sub(plane->offset, iris_vec3_dot(plane->normal, line->origin)), approach);
    if (approach == 0 || along == INT64_MAX || along <= -INT64_MAX) {
        return IRIS_ERR_RANGE;
    }
    *t = along;
    *point = iris_line3_point(line, along);
    return IRIS_OK;
}
