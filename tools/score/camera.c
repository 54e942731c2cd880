/* The camera functions against double precision, on a million random cameras, points, and rotations: the errors as shares of
 * the bounds that the headers state. Each point is projected; what takes longer takes its turn. */
#include <math.h>
#include <stdio.h>

#include "iris/3d/camera.h"
#include "score.h"

#define CAMERAS 1000000
#define TURNS   8
#define UNIT    (1 / 4294967296.0)

static uint64_t state = 88172645463325252u;

static uint64_t random_bits(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

static double real(iris_q32 a)
{
    return (double)a * UNIT;
}

/* Within -limit..limit. */
static iris_q32 random_q32(iris_q32 limit)
{
    return (iris_q32)(random_bits() % (2 * (uint64_t)limit + 1)) - limit;
}

/* From `least` to `most`. */
static iris_q32 random_from(int32_t least, int32_t most)
{
    return least * IRIS_Q32_ONE + (iris_q32)(random_bits() % ((uint64_t)(most - least) << 32));
}

/* A rotation in double precision, rounded: by a quaternion whose numbers are random. */
static void random_rotation(iris_mat3 *r)
{
    double q[4], length = 0;
    do {
        length = 0;
        for (int i = 0; i < 4; i++) {
            q[i] = real(random_q32(IRIS_Q32_ONE));
            length += q[i] * q[i];
        }
    } while (length < 0.01 || length > 1);
    const double w = q[0], x = q[1], y = q[2], z = q[3], by = 2 / length;
    const double m[9] = {1 - by * (y * y + z * z), by * (x * y - w * z),     by * (x * z + w * y),
                         by * (x * y + w * z),     1 - by * (x * x + z * z), by * (y * z - w * x),
                         by * (x * z - w * y),     by * (y * z + w * x),     1 - by * (x * x + y * y)};
    for (int i = 0; i < 9; i++) {
        r->m[i] = (iris_q32)llround(m[i] / UNIT);
    }
}

static iris_sensor random_sensor(int with_lens)
{
    const iris_q32 one = IRIS_Q32_ONE;
    iris_sensor s = {.intrinsics = {random_from(100, 4100), random_from(100, 4100), random_q32(10 * one),
                                    random_from(0, 1000), random_from(0, 1000)}};
    s.pose.place = (iris_vec3){random_q32(1000 * one), random_q32(1000 * one), random_q32(1000 * one)};
    random_rotation(&s.pose.turn);
    if (with_lens) {
        s.lens = (iris_lens){random_q32(one / 4),   random_q32(one / 16),
                             random_q32(one / 64),  random_q32(one / 128),
                             random_q32(one / 128), {random_q32(one / 64), random_q32(one / 64)},
                             IRIS_LENS_BENDS};
    }
    return s;
}

/* The model as camera.h states it. */
static void bend(double q[2], const iris_lens *lens, const double p[2])
{
    const double x = p[0] - real(lens->center.x), y = p[1] - real(lens->center.y), r2 = x * x + y * y;
    const double radial = r2 * (real(lens->k1) + r2 * (real(lens->k2) + r2 * real(lens->k3)));
    const double p1 = real(lens->p1), p2 = real(lens->p2);
    q[0] = p[0] + x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
    q[1] = p[1] + y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
}

/* A camera and a point that it sees, both in double precision. */
typedef struct {
    iris_sensor sensor;
    iris_vec3 world;
    double plane[2], pixel[2], depth;
    double direction[3]; /* from the camera, of length 1 */
} view;

static void random_view(view *v, int with_lens)
{
    const iris_sensor *s = &v->sensor;
    v->sensor = random_sensor(with_lens);
    const double z = real(random_from(1, 101)), x = z * real(random_q32(IRIS_Q32_ONE / 2)),
                 y = z * real(random_q32(IRIS_Q32_ONE / 2));
    const iris_q32 *m = s->pose.turn.m;
    double from[3], to[3] = {0, 0, 0}, q[2], length = 0;
    iris_q32 *const world[3] = {&v->world.x, &v->world.y, &v->world.z};
    const iris_q32 place[3] = {s->pose.place.x, s->pose.place.y, s->pose.place.z};
    for (int i = 0; i < 3; i++) {
        *world[i] =
            place[i] + (iris_q32)llround((real(m[i]) * x + real(m[3 + i]) * y + real(m[6 + i]) * z) / UNIT);
        from[i] = real(*world[i] - place[i]);
        length += from[i] * from[i];
    }
    for (int i = 0; i < 9; i++) {
        to[i / 3] += real(m[i]) * from[i % 3];
    }
    for (int i = 0; i < 3; i++) {
        v->direction[i] = from[i] / sqrt(length);
    }
    v->plane[0] = to[0] / to[2];
    v->plane[1] = to[1] / to[2];
    v->depth = to[2];
    bend(q, &s->lens, v->plane);
    v->pixel[0] =
        real(s->intrinsics.alpha_u) * q[0] + real(s->intrinsics.shear) * q[1] + real(s->intrinsics.u0);
    v->pixel[1] = real(s->intrinsics.alpha_v) * q[1] + real(s->intrinsics.v0);
}

/* Errors: the worst one, and the worst share of its bound. */
typedef struct {
    double most, share;
} errors;

static void note(errors *of, double error, double bound)
{
    of->most = fmax(of->most, error);
    of->share = fmax(of->share, error / bound);
}

static double larger_alpha(const iris_sensor *s)
{
    return fmax(real(s->intrinsics.alpha_u), real(s->intrinsics.alpha_v));
}

static void note_projection(errors *of, const view *v, int with_lens)
{
    iris_vec2 pixel = {0, 0};
    iris_q32 depth = 0;
    if (iris_sensor_project(&pixel, &depth, &v->sensor, v->world) != IRIS_OK) {
        of->share = INFINITY;
        return;
    }
    const double bound = larger_alpha(&v->sensor) * (1 / v->depth + 1) * 4 * UNIT * (with_lens ? 4 : 1);
    note(of, fmax(fabs(real(pixel.x) - v->pixel[0]), fabs(real(pixel.y) - v->pixel[1])), bound);
    of->share = fabs(real(depth) - v->depth) <= 3 * UNIT ? of->share : INFINITY;
}

static void note_ray(errors *of, const view *v)
{
    const iris_vec2 pixel = {(iris_q32)llround(v->pixel[0] / UNIT), (iris_q32)llround(v->pixel[1] / UNIT)};
    iris_line3 ray;
    if (iris_sensor_ray(&ray, &v->sensor, pixel) != IRIS_OK) {
        of->share = INFINITY;
        return;
    }
    const double off[3] = {real(ray.direction.x) - v->direction[0], real(ray.direction.y) - v->direction[1],
                           real(ray.direction.z) - v->direction[2]};
    note(of, sqrt(off[0] * off[0] + off[1] * off[1] + off[2] * off[2]), 64 * UNIT);
}

/* The polynomial, and its inverse. */
static void note_lens(errors *polynomial, errors *inverse, const view *v)
{
    const iris_vec2 p = {(iris_q32)llround(v->plane[0] / UNIT), (iris_q32)llround(v->plane[1] / UNIT)};
    const double at[2] = {real(p.x), real(p.y)};
    double truth[2];
    bend(truth, &v->sensor.lens, at);
    const iris_vec2 found = iris_lens_bend(&v->sensor.lens, p);
    const iris_vec2 seen = {(iris_q32)llround(truth[0] / UNIT), (iris_q32)llround(truth[1] / UNIT)};
    iris_vec2 back;
    note(polynomial, fmax(fabs(real(found.x) - truth[0]), fabs(real(found.y) - truth[1])), 8 * UNIT);
    if (iris_lens_straighten(&back, &v->sensor.lens, seen) != IRIS_OK) {
        inverse->share = INFINITY;
        return;
    }
    note(inverse, fmax(fabs(real(back.x) - at[0]), fabs(real(back.y) - at[1])), 32 * UNIT);
}

static void note_matrix(errors *of, iris_q32 m[12], const iris_sensor *s)
{
    const iris_intrinsics *in = &s->intrinsics;
    const double k[9] = {
        real(in->alpha_u), real(in->shear), real(in->u0), 0, real(in->alpha_v), real(in->v0), 0, 0, 1};
    const double t[3] = {real(s->pose.place.x), real(s->pose.place.y), real(s->pose.place.z)};
    iris_sensor_matrix(m, s);
    for (int row = 0; row < 3; row++) {
        double last = 0;
        for (int column = 0; column < 3; column++) {
            double a = 0;
            for (int i = 0; i < 3; i++) {
                a += k[3 * row + i] * real(s->pose.turn.m[3 * i + column]);
            }
            last -= a * t[column];
            note(of, fabs(real(m[4 * row + column]) - a), UNIT);
        }
        note(of, fabs(real(m[4 * row + 3]) - last), (1 + fabs(t[0]) + fabs(t[1]) + fabs(t[2])) * UNIT);
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The camera of a matrix whose determinant is positive: Gram and Schmidt's way from the last row up, and what is left of the
 * place. numbers: R (9), alpha_u, shear, u0, alpha_v, v0, and t (3). Returns the last row's length. */
static double decomposed(double numbers[17], const iris_q32 m[12], int sign)
{
    const double b[3] = {sign * real(m[3]), sign * real(m[7]), sign * real(m[11])};
    double row[3][3], *z = numbers + 6, *y = numbers + 3, *x = numbers;
    for (int i = 0; i < 9; i++) {
        row[i / 3][i % 3] = sign * real(m[4 * (i / 3) + i % 3]);
    }
    const double s = sqrt(dot(row[2], row[2]));
    for (int i = 0; i < 3; i++) {
        z[i] = row[2][i] / s;
    }
    const double v0 = dot(row[1], z) / s;
    for (int i = 0; i < 3; i++) {
        y[i] = row[1][i] / s - v0 * z[i];
    }
    const double alpha_v = sqrt(dot(y, y));
    for (int i = 0; i < 3; i++) {
        y[i] /= alpha_v;
    }
    const double u0 = dot(row[0], z) / s, shear = dot(row[0], y) / s;
    for (int i = 0; i < 3; i++) {
        x[i] = row[0][i] / s - u0 * z[i] - shear * y[i];
    }
    const double alpha_u = sqrt(dot(x, x));
    const double down = b[2] / s, along_y = (b[1] / s - v0 * down) / alpha_v;
    const double along_x = (b[0] / s - u0 * down - shear * along_y) / alpha_u;
    const double k[5] = {alpha_u, shear, u0, alpha_v, v0};
    for (int i = 0; i < 3; i++) {
        x[i] /= alpha_u;
    }
    for (int i = 0; i < 5; i++) {
        numbers[9 + i] = k[i];
    }
    for (int i = 0; i < 3; i++) {
        numbers[14 + i] = -(x[i] * along_x + y[i] * along_y + z[i] * down);
    }
    return s;
}

/* Of rotation, pixels, and place. m: of any scale and sign. */
static void note_camera(errors of[3], const iris_q32 m[12], int sign)
{
    double truth[17];
    const double s = decomposed(truth, m, sign), unit = UNIT / fmin(s, 1);
    const double longest = hypot(hypot(truth[9], truth[10]), hypot(truth[11], hypot(truth[12], truth[13])));
    const double q = longest / fmin(truth[9], truth[12]);
    iris_sensor found;
    if (iris_sensor_decompose(&found, m) != IRIS_OK) {
        of[0].share = INFINITY;
        return;
    }
    const iris_intrinsics *k = &found.intrinsics;
    const iris_q32 numbers[17] = {found.pose.turn.m[0],
                                  found.pose.turn.m[1],
                                  found.pose.turn.m[2],
                                  found.pose.turn.m[3],
                                  found.pose.turn.m[4],
                                  found.pose.turn.m[5],
                                  found.pose.turn.m[6],
                                  found.pose.turn.m[7],
                                  found.pose.turn.m[8],
                                  k->alpha_u,
                                  k->shear,
                                  k->u0,
                                  k->alpha_v,
                                  k->v0,
                                  found.pose.place.x,
                                  found.pose.place.y,
                                  found.pose.place.z};
    const double far = 1 + sqrt(dot(truth + 14, truth + 14));
    for (int i = 0; i < 17; i++) {
        const int kind = i < 9 ? 0 : i < 14 ? 1 : 2;
        const double bound[3] = {2 * q * unit, 2 * q * longest * unit, 8 * q * far * unit};
        note(&of[kind], fabs(real(numbers[i]) - truth[i]), bound[kind]);
    }
}

static double difference(const iris_mat3 *a, const iris_mat3 *b)
{
    double most = 0;
    for (int i = 0; i < 9; i++) {
        most = fmax(most, fabs(real(a->m[i] - b->m[i])));
    }
    return most;
}

/* What a rotation of a vector, a quaternion, and three angles is, and back. */
static void note_rotations(errors of[4], const iris_mat3 *r)
{
    iris_mat3 back;
    const iris_vec3 v = iris_rotation_to_vector(r);
    const double a[3] = {real(v.x), real(v.y), real(v.z)}, angle = sqrt(dot(a, a)), s = sin(angle),
                 c = cos(angle);
    iris_rotation_from_vector(&back, v);
    for (int i = 0; i < 9 && angle > 0; i++) {
        const int row = i / 3, column = i % 3;
        const double across =
            row == column ? c : (column == (row + 1) % 3 ? -s : s) * a[(6 - row - column) % 3] / angle;
        const double turned = across + (1 - c) * a[row] * a[column] / (angle * angle);
        note(&of[0], fabs(real(back.m[i]) - turned), 4 * UNIT);
        note(&of[1], fabs(real(r->m[i]) - turned), 8 * UNIT);
    }
    iris_rotation_from_quaternion(&back, iris_rotation_to_quaternion(r));
    note(&of[2], difference(r, &back), 8 * UNIT);
    const iris_angles angles = iris_rotation_to_angles(r);
    if (fabs(cos(real(angles.tilt))) > 1.0 / 64) {
        iris_rotation_from_angles(&back, angles);
        note(&of[3], difference(r, &back), 128 * UNIT);
    }
}

void score_camera(score *s)
{
    errors projection = {0, 0}, through = {0, 0}, ray = {0, 0}, polynomial = {0, 0}, inverse = {0, 0},
           matrix = {0, 0};
    errors camera[3] = {{0, 0}, {0, 0}, {0, 0}}, rotation[4] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    for (int i = 0; i < CAMERAS; i++) {
        view v;
        iris_q32 m[12];
        random_view(&v, i % 2);
        note_projection(i % 2 ? &through : &projection, &v, i % 2);
        switch (i % TURNS) {
        case 0:
        case 1:
            note_ray(&ray, &v);
            break;
        case 3:
            note_lens(&polynomial, &inverse, &v);
            break;
        case 4:
            note_matrix(&matrix, m, &v.sensor);
            for (int k = 0; k < 12 && i % 3; k++) { /* any scale, either sign */
                m[k] = i % 3 == 1 ? -m[k] / 8 : 5 * m[k];
            }
            note_camera(camera, m, i % 3 == 1 ? -1 : 1);
            break;
        case 6:
            note_rotations(rotation, &v.sensor.pose.turn);
            break;
        default:
            break;
        }
    }
    const struct {
        const char *what, *bound;
        const errors *of;
    } rows[] = {
        {"projection", "a (1 / Zc + 1) 2^-30 px", &projection},
        {"projection through a lens", "a (1 / Zc + 1) 2^-28 px", &through},
        {"ray", "2^-26", &ray},
        {"lens, the polynomial", "2^-29", &polynomial},
        {"lens, its inverse", "2^-27", &inverse},
        {"matrix of a camera", "2^-32 (1 + x + y + z)", &matrix},
        {"camera of a matrix: rotation", "2 q 2^-32", &camera[0]},
        {"camera of a matrix: pixels", "2 q p 2^-32", &camera[1]},
        {"camera of a matrix: place", "8 q (1 + t) 2^-32", &camera[2]},
        {"rotation of a vector", "4 2^-32", &rotation[0]},
        {"vector of a rotation", "8 2^-32", &rotation[1]},
        {"quaternion of a rotation, and back", "8 2^-32", &rotation[2]},
        {"angles of a rotation, and back", "128 2^-32", &rotation[3]},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char what[96];
        snprintf(what, sizeof what, "a million cameras: %s, of %s", rows[i].what, rows[i].bound);
        score_row(s, what, "at most 1", score_if(rows[i].of->share > 0 && rows[i].of->share <= 1),
                  "%.2f; %.1e at most", rows[i].of->share, rows[i].of->most);
    }
}
