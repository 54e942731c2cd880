/* Where is what a camera sees? One camera on a robot knows places on the floor by how it is mounted; two know places
 * anywhere: where their rays meet. Here a ball is in the air, and a mark on the floor. */
#include <stdio.h>

#include "iris/3d/epipolar.h"
#include "iris/3d/mounting.h"
#include "iris/3d/triangulate.h"

#define MM(n)      ((iris_q32)(n)*IRIS_Q32_ONE)
#define DEGREES(n) ((n) * (IRIS_PI_Q32 / 180))

static double real(iris_q32 number)
{
    return (double)number / (double)IRIS_Q32_ONE;
}

static int is_near(iris_vec3 a, iris_vec3 b)
{
    return iris_vec3_length(iris_vec3_sub(a, b)) < IRIS_Q32_ONE / 10;
}

static void print(const char *what, iris_vec3 p)
{
    printf("%s: %.2f to the right, %.2f ahead, %.2f high\n", what, real(p.x), real(p.y), real(p.z));
}

/* 320 x 240, and 200 mm above the floor, 30 degrees down. The right one of two is 60 mm beside it, and turned 5 degrees to
 * the left about its own y axis, which is said by a quaternion, as orientation sensors do. */
static int mount(iris_sensor *left, iris_sensor *right)
{
    const iris_mounting mounting = {.height = MM(200), .tilt = DEGREES(30)};
    iris_quaternion turn = {.w = IRIS_Q32_ONE};
    iris_mat3 beside;
    *left = (iris_sensor){.intrinsics = {MM(300), MM(300), 0, MM(160), MM(120)},
                          .lens = {.k1 = -IRIS_Q32_ONE / 10}};
    if (iris_mounting_pose(&left->pose, &mounting)) {
        return 0;
    }
    *right = *left;
    iris_q32_sin_cos(&turn.y, &turn.w, DEGREES(5) / 2);
    iris_rotation_from_quaternion(&beside, turn);
    iris_mat3_multiply(&right->pose.turn, &beside, &left->pose.turn);
    right->pose.place.x += MM(60);
    turn = iris_rotation_to_quaternion(&right->pose.turn);
    printf("the right camera's turn: %.4f %+.4f i %+.4f j %+.4f k\n", real(turn.w), real(turn.x),
           real(turn.y), real(turn.z));
    return 1;
}

/* A pixel's place on the floor: where its ray goes through the plane z = 0. */
static int see_floor(const iris_sensor *camera)
{
    static const iris_plane ground = {.normal = {.z = IRIS_Q32_ONE}};
    static const iris_vec3 mark = {MM(-50), MM(400), 0};
    iris_vec2 pixel;
    iris_line3 ray;
    iris_vec3 place;
    iris_q32 away;
    if (iris_sensor_project(&pixel, NULL, camera, mark) || iris_sensor_ray(&ray, camera, pixel) ||
        iris_plane_meet(&place, &away, &ground, &ray) || away <= 0) { /* 0 and less: above the horizon */
        return 0;
    }
    printf("pixel %.2f, %.2f sees the floor %.1f mm away\n", real(pixel.x), real(pixel.y), real(away));
    print("the mark", place);
    return is_near(place, mark);
}

/* A ball's pixel in the left picture says on which line it is on the right one's picture plane; with its pixel there, rays
 * meet. */
static int see_ball(const iris_sensor *left, const iris_sensor *right)
{
    static const iris_vec3 ball = {MM(30), MM(500), MM(80)};
    iris_vec2 pixels[2];
    iris_line2 line;
    iris_q32 miss, wrong;
    iris_line3 rays[2];
    iris_triangulation made;
    if (iris_sensor_project(&pixels[0], NULL, left, ball) ||
        iris_sensor_project(&pixels[1], NULL, right, ball) ||
        iris_epipolar_line(&line, left, right, pixels[0]) ||
        iris_epipolar_miss(&miss, left, right, pixels[0], pixels[1])) {
        return 0;
    }
    const iris_vec2 beside = {pixels[1].x, pixels[1].y + MM(6)}; /* something else */
    if (iris_epipolar_miss(&wrong, left, right, pixels[0], beside)) {
        return 0;
    }
    printf("the ball is on %.4f x %+.4f y %+.4f = 0 in the right picture\n", real(line.a), real(line.b),
           real(line.c));
    printf("its pixel there misses that line by %.3f pixels, another one by %.3f\n", real(miss), real(wrong));
    if (iris_sensor_ray(&rays[0], left, pixels[0]) || iris_sensor_ray(&rays[1], right, pixels[1]) ||
        iris_triangulate(&made, rays, 2)) {
        return 0;
    }
    print("the ball", made.point);
    return is_near(made.point, ball) && miss < IRIS_Q32_ONE / 100 && wrong > MM(3);
}

int main(void)
{
    iris_sensor left, right;
    return !(mount(&left, &right) && see_floor(&left) && see_ball(&left, &right));
}
