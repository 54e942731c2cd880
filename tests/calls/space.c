/* Vectors, lines, planes, matrices, and rotations. */
#include "space.h"

#include "calls.h"

iris_q32 draw_q32(int32_t low, int32_t high)
{
    iris_q32 whole = (iris_q32)draw_within(low, high) * IRIS_Q32_ONE;
    iris_q32 part = draw_chance(5) ? 0 : draw_within(INT32_MIN, INT32_MAX);
    return whole + (part > 0 && whole == (iris_q32)high * IRIS_Q32_ONE ? -part : part);
}

iris_q32 draw_any_q32(void)
{
    static const iris_q32 extremes[] = {INT64_MIN,
                                        INT64_MAX,
                                        INT64_MIN + 1,
                                        INT64_MIN / 2,
                                        INT64_MAX / 2,
                                        IRIS_Q32_ONE,
                                        -IRIS_Q32_ONE,
                                        0,
                                        1,
                                        -1,
                                        (iris_q32)1 << 60,
                                        -((iris_q32)1 << 60)};
    uint32_t kind = draw_below(24), bits = draw_below(64);
    uint64_t high = draw_below(UINT32_MAX), low = draw_below(UINT32_MAX);
    return kind < 12 ? extremes[kind] : (iris_q32)(high << 32 | low) >> bits;
}

void draw_spoiled(iris_q32 *numbers, int count, uint32_t one_in)
{
    if (!draw_chance(one_in)) {
        return;
    }
    for (uint32_t i = draw_chance(4) ? 3 * (uint32_t)count : 1 + draw_below(3); i > 0; i--) {
        numbers[draw_below((uint32_t)count)] = draw_any_q32();
    }
}

iris_vec3 draw_vec3(int32_t limit)
{
    iris_vec3 made = {draw_q32(-limit, limit), draw_q32(-limit, limit), draw_q32(-limit, limit)};
    return made;
}

iris_vec3 draw_direction(void)
{
    iris_vec3 made = {0, 0, draw_chance(2) ? IRIS_Q32_ONE : -IRIS_Q32_ONE};
    if (!draw_chance(4)) {
        (void)iris_vec3_normalize(&made, draw_vec3(2));
    }
    return made;
}

iris_mat3 draw_turn(void)
{
    iris_mat3 made;
    iris_vec3 axis = draw_direction();
    iris_rotation_about(&made, axis, draw_q32(-4, 4));
    return made;
}

/* A picture's, where the one drawn may be none. */
static int32_t side_of(int32_t side)
{
    return side >= 1 && side <= IRIS_SIDE_MAX ? side : 20;
}

iris_sensor draw_sensor(iris_size size, int32_t limit)
{
    iris_sensor made = {.lens = {.k1 = 0}};
    int32_t w = side_of(size.w), h = side_of(size.h), focal = w + 2;
    iris_intrinsics *k = &made.intrinsics;
    k->alpha_u = draw_q32(focal / 2 + 1, 3 * focal);
    k->alpha_v = k->alpha_u + k->alpha_u / 64 * draw_within(-8, 8);
    k->shear = draw_chance(3) ? draw_q32(-1, 1) : 0;
    k->u0 = draw_q32(w / 3, w / 2 + 1);
    k->v0 = draw_q32(h / 3, h / 2 + 1);
    if (draw_chance(2)) {
        made.lens = (iris_lens){.k1 = draw_q32(-1, 1) / 4,
                                .k2 = draw_q32(-1, 1) / 4,
                                .k3 = draw_q32(-1, 1) / 8,
                                .p1 = draw_q32(-1, 1) / 64,
                                .p2 = draw_q32(-1, 1) / 64,
                                .center = {draw_q32(-1, 1) / 64, draw_q32(-1, 1) / 64}};
        made.lens.direction = draw_chance(2) ? IRIS_LENS_BENDS : IRIS_LENS_CORRECTS;
    }
    made.pose = (iris_pose){draw_turn(), draw_vec3(limit)};
    return made;
}

const iris_sensor *draw_any_sensor(iris_size size, int32_t limit)
{
    iris_sensor made = draw_sensor(size, limit);
    draw_spoiled(&made.intrinsics.alpha_u, 5, 10);
    draw_spoiled(&made.lens.k1, 7, 10);
    draw_spoiled(made.pose.turn.m, 9, 20);
    draw_spoiled(&made.pose.place.x, 3, 20);
    if (draw_chance(60)) {
        made.lens.direction = (iris_lens_direction)draw_int(IRIS_LENS_BENDS, IRIS_LENS_CORRECTS);
    }
    return draw_given(&made, sizeof made);
}

iris_vec3 draw_seen(const iris_sensor *sensor, int32_t near, int32_t far)
{
    iris_vec3 ahead = {draw_q32(-1, 1) / 3, draw_q32(-1, 1) / 3, IRIS_Q32_ONE};
    return iris_pose_out_of(&sensor->pose, iris_vec3_scale(ahead, draw_q32(near, far)));
}

/* ---- vector.h ---- */

/* Mostly small. */
static iris_vec3 any_vec3(void)
{
    iris_vec3 made = draw_chance(6) ? draw_direction() : draw_vec3(20);
    draw_spoiled(&made.x, 3, 5);
    if (draw_chance(20)) {
        made = (iris_vec3){0, 0, 0};
    }
    return made;
}

static iris_line3 any_line(void)
{
    iris_line3 made = {draw_vec3(20), draw_direction()};
    draw_spoiled(&made.origin.x, 3, 10);
    draw_spoiled(&made.direction.x, 3, 10);
    return made;
}

static const iris_line3 *given_line(void)
{
    iris_line3 made = any_line();
    return draw_given(&made, sizeof made);
}

static void normalize(void)
{
    iris_vec3 *unit = draw_results(sizeof *unit), a = any_vec3();
    CALL(iris_vec3_normalize(unit, a));
}

static void line_through(void)
{
    iris_line3 *line = draw_results(sizeof *line);
    iris_vec3 a = any_vec3(), b = draw_chance(8) ? a : any_vec3();
    CALL(iris_line3_through(line, a, b));
}

static void line_meet(void)
{
    iris_vec3 *middle = draw_results(sizeof *middle);
    iris_q32 *gap = draw_results(sizeof *gap);
    iris_line3 first = any_line(), second = any_line();
    if (draw_chance(6)) {
        iris_vec3 little = {draw_within(-1000000, 1000000), 0, 0};
        second.direction = iris_vec3_add(first.direction, little);
    }
    const iris_line3 *a = draw_given(&first, sizeof first), *b = draw_given(&second, sizeof second);
    (void)iris_line3_distance(a, iris_line3_point(b, draw_any_q32()));
    CALL(iris_line3_meet(middle, gap, a, b));
}

static void plane_through(void)
{
    iris_plane *plane = draw_results(sizeof *plane);
    iris_vec3 a = any_vec3(), b = any_vec3(), c = any_vec3();
    if (draw_chance(6)) {
        c = iris_vec3_add(a, iris_vec3_scale(iris_vec3_sub(b, a), draw_q32(-3, 3)));
    }
    CALL(iris_plane_through(plane, a, b, c));
}

static void plane_meet(void)
{
    iris_vec3 *point = draw_results(sizeof *point);
    iris_q32 *t = draw_results(sizeof *t);
    iris_plane made = {draw_direction(), draw_q32(-20, 20)};
    draw_spoiled(&made.normal.x, 4, 8);
    const iris_plane *plane = draw_given(&made, sizeof made);
    const iris_line3 *line = given_line();
    (void)iris_plane_distance(plane, line->origin);
    CALL(iris_plane_meet(point, t, plane, line));
}

/* ---- matrix.h ---- */

/* A motion, perhaps with a scale; or any numbers, perhaps with a row that is the sum of two others. */
static iris_mat4 any_mat4(void)
{
    iris_mat4 made, scaling;
    iris_mat3 turn = draw_turn();
    iris_vec3 center = draw_vec3(20);
    iris_mat4_motion(&made, &turn, center, draw_vec3(20));
    if (draw_chance(2)) {
        iris_mat4_scaling(&scaling, draw_vec3(3));
        iris_mat4_multiply(&made, &scaling, &made);
    }
    if (draw_chance(4)) {
        for (int i = 0; i < 16; i++) {
            made.m[i] = draw_q32(-9, 9);
        }
    }
    if (draw_chance(8)) {
        for (int i = 0; i < 4; i++) {
            made.m[12 + i] = made.m[i] + made.m[4 + i];
        }
    }
    draw_spoiled(made.m, 16, 6);
    return made;
}

/* The inverse may be written where the matrix was. */
static void mat4_invert(void)
{
    iris_mat4 made = any_mat4(), *inverse = draw_results(sizeof *inverse);
    const iris_mat4 *m = draw_given(&made, sizeof made);
    if (draw_chance(4)) {
        *inverse = made;
        m = inverse;
    }
    CALL(iris_mat4_invert(inverse, m));
}

static void mat4_point(void)
{
    iris_mat4 made = any_mat4();
    iris_vec3 *moved = draw_results(sizeof *moved), p = any_vec3();
    const iris_mat4 *m = draw_given(&made, sizeof made);
    CALL(iris_mat4_point(moved, m, p));
}

static void mat3_invert(void)
{
    iris_mat3 made = draw_turn(), *inverse = draw_results(sizeof *inverse);
    if (draw_chance(3)) {
        iris_mat4 other = any_mat4();
        for (int i = 0; i < 9; i++) {
            made.m[i] = other.m[i];
        }
    }
    draw_spoiled(made.m, 9, 5);
    const iris_mat3 *m = draw_given(&made, sizeof made);
    CALL(iris_mat3_invert(inverse, m));
}

/* ---- rotation.h ---- */

/* A rotation that has drifted, or what is none. What reads rotations takes anything, too. */
static void tidy(void)
{
    iris_mat3 made = draw_turn();
    for (int i = 0; i < 9; i++) {
        made.m[i] += draw_chance(2) ? draw_within(-1000, 1000) : 0;
    }
    draw_spoiled(made.m, 9, 3);
    iris_mat3 *r = draw_results(sizeof *r), again;
    *r = made;
    iris_rotation_from_vector(&again, iris_rotation_to_vector(r));
    iris_rotation_from_angles(&again, iris_rotation_to_angles(r));
    iris_rotation_from_quaternion(&again, iris_rotation_to_quaternion(r));
    iris_rotation_from_vector(&again, any_vec3());
    iris_quaternion q = {draw_any_q32(), draw_any_q32(), draw_any_q32(), draw_any_q32()};
    iris_rotation_from_quaternion(&again, q);
    CALL(iris_rotation_tidy(r));
}

const random_call calls_space[] = {
    {"iris_vec3_normalize", normalize}, {"iris_line3_through", line_through},
    {"iris_line3_meet", line_meet},     {"iris_plane_through", plane_through},
    {"iris_plane_meet", plane_meet},    {"iris_mat4_invert", mat4_invert},
    {"iris_mat4_point", mat4_point},    {"iris_mat3_invert", mat3_invert},
    {"iris_rotation_tidy", tidy},       {NULL, NULL},
};
