/* Cameras in double precision: the model of camera.h, written down a second time. */
#ifndef IRIS_TEST_DOUBLE_CAMERA_H
#define IRIS_TEST_DOUBLE_CAMERA_H

#include "iris/3d/camera.h"
#include "random3d.h"

static inline iris_q32 whole(double a)
{
    return (iris_q32)llround(a * 4294967296.0);
}

/* Xc = R (X - t) */
static inline void double_into(double c[3], const iris_pose *pose, const double world[3])
{
    const double way[3] = {world[0] - real(pose->place.x), world[1] - real(pose->place.y),
                           world[2] - real(pose->place.z)};
    for (int i = 0; i < 3; i++) {
        c[i] = real(pose->turn.m[3 * i]) * way[0] + real(pose->turn.m[3 * i + 1]) * way[1] +
               real(pose->turn.m[3 * i + 2]) * way[2];
    }
}

/* Where a straight ray at p is seen; the lens bends, without a center of its own. */
static inline void double_bend(double seen[2], const iris_lens *l, const double p[2])
{
    const double x = p[0], y = p[1], r2 = x * x + y * y;
    const double radial = 1 + r2 * (real(l->k1) + r2 * (real(l->k2) + r2 * real(l->k3)));
    seen[0] = x * radial + 2 * real(l->p1) * x * y + real(l->p2) * (r2 + 2 * x * x);
    seen[1] = y * radial + real(l->p1) * (r2 + 2 * y * y) + 2 * real(l->p2) * x * y;
}

static inline void double_pixel(double pixel[2], const iris_intrinsics *k, const double p[2])
{
    pixel[0] = real(k->alpha_u) * p[0] + real(k->shear) * p[1] + real(k->u0);
    pixel[1] = real(k->alpha_v) * p[1] + real(k->v0);
}

/* The pixel of a point, and its depth. Not in front of the camera: 0. */
static inline double double_project(double pixel[2], const iris_sensor *s, const double world[3])
{
    double c[3], seen[2];
    double_into(c, &s->pose, world);
    if (c[2] <= 0) {
        return 0;
    }
    double_bend(seen, &s->lens, (const double[2]){c[0] / c[2], c[1] / c[2]});
    double_pixel(pixel, &s->intrinsics, seen);
    return c[2];
}

/* With a lens whose polynomial does not turn back within the picture: the direction, in the world, of what the pixel sees; z forward in the camera has length 1. */
static inline void double_ray(double d[3], const iris_sensor *s, const double pixel[2])
{
    const iris_intrinsics *k = &s->intrinsics;
    const double y = (pixel[1] - real(k->v0)) / real(k->alpha_v);
    const double wanted[2] = {(pixel[0] - real(k->u0) - real(k->shear) * y) / real(k->alpha_u), y};
    double p[2] = {wanted[0], wanted[1]}, seen[2];
    for (double off = 1; off > 1e-12;) {
        double_bend(seen, &s->lens, p);
        off = fabs(wanted[0] - seen[0]) + fabs(wanted[1] - seen[1]);
        p[0] += wanted[0] - seen[0];
        p[1] += wanted[1] - seen[1];
    }
    for (int i = 0; i < 3; i++) {
        d[i] =
            real(s->pose.turn.m[i]) * p[0] + real(s->pose.turn.m[3 + i]) * p[1] + real(s->pose.turn.m[6 + i]);
    }
}

/* Any number for one of the camera's. */
static inline void spoil(iris_sensor *s)
{
    iris_q32 *const numbers[] = {&s->intrinsics.alpha_u,
                                 &s->intrinsics.alpha_v,
                                 &s->intrinsics.shear,
                                 &s->intrinsics.u0,
                                 &s->intrinsics.v0,
                                 &s->lens.k1,
                                 &s->lens.k2,
                                 &s->lens.k3,
                                 &s->lens.p1,
                                 &s->lens.p2,
                                 &s->lens.center.x,
                                 &s->pose.place.x,
                                 &s->pose.place.y,
                                 &s->pose.place.z};
    *numbers[random_u64() % (sizeof numbers / sizeof numbers[0])] = any_q32();
    if (random_u64() % 2) {
        s->pose.turn.m[random_u64() % 9] = any_q32();
    }
    s->lens.direction = random_u64() % 2 ? IRIS_LENS_BENDS : IRIS_LENS_CORRECTS;
}

static inline double between(double low, double high)
{
    return low + (high - low) * ((double)(random_u64() >> 11) / 9007199254740992.0);
}

/* Two cameras that stand about side by side, in one world that is turned any way: the right one about `apart` to the
 * right, turned by up to `turned` radians about any axis against the left one. Pictures of w x h. */
static inline void random_pair(iris_sensor pair[2], double apart, double turned, int w, int h)
{
    iris_mat3 world, off;
    random_rotation(&world);
    for (int k = 0; k < 2; k++) {
        const double alpha = between(0.9, 1.4) * w;
        pair[k] = (iris_sensor){.intrinsics = {whole(alpha), whole(alpha * between(0.97, 1.03)),
                                               whole(between(-1, 1)), whole(w * between(0.45, 0.55)),
                                               whole(h * between(0.45, 0.55))},
                                .lens = {.k1 = whole(between(-0.25, 0.1)),
                                         .k2 = whole(between(0, 0.08)),
                                         .p1 = whole(between(-0.002, 0.002)),
                                         .p2 = whole(between(-0.002, 0.002))}};
        iris_rotation_about(&off, random_direction(), whole(between(0, turned / 2)));
        iris_mat3_multiply(&pair[k].pose.turn, &off, &world);
        const iris_vec3 place = {whole(k * apart), whole(between(-0.1, 0.1) * apart),
                                 whole(between(-0.1, 0.1) * apart)};
        pair[k].pose.place = iris_mat3_transposed_vector(&world, place);
    }
}

/* A point that both cameras see, `near` to `far` times their distance away. Returns 0 if the one that was tried is none. */
static inline int random_seen(double world[3], double pixels[2][2], const iris_sensor pair[2], double depth,
                              const int size[2])
{
    double d[3];
    const double pixel[2] = {between(0, size[0] - 1), between(0, size[1] - 1)};
    double_ray(d, &pair[0], pixel);
    world[0] = real(pair[0].pose.place.x) + depth * d[0];
    world[1] = real(pair[0].pose.place.y) + depth * d[1];
    world[2] = real(pair[0].pose.place.z) + depth * d[2];
    int seen = 1;
    for (int k = 0; k < 2; k++) {
        seen = seen && double_project(pixels[k], &pair[k], world) > 0 && pixels[k][0] >= 0 &&
               pixels[k][0] <= size[0] - 1 && pixels[k][1] >= 0 && pixels[k][1] <= size[1] - 1;
    }
    return seen;
}

#endif
