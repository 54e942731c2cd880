#include "camera.h"

#include <math.h>

#define PI 3.14159265358979323846

/* Where image position (x, y) meets the floor. */
static sim_ground to_ground(const sim_camera *camera, double x, double y)
{
    double focal = SIM_W / 2.0 / tan(camera->fov_deg * PI / 360);
    double pitch = camera->pitch_deg * PI / 180;
    double right = (x - (SIM_W - 1) / 2.0) / focal;
    double down = (y - (SIM_H - 1) / 2.0) / focal;
    double drop = sin(pitch) + down * cos(pitch); /* of the ray, per unit along the optical axis */
    double reach = cos(pitch) - down * sin(pitch);
    double depth = camera->height_cm / drop;
    return (sim_ground){(float)(camera->forward_cm + depth * reach), (float)(-depth * right)};
}

void sim_camera_aim(sim_camera *camera)
{
    for (int y = 0; y < SIM_H; y++) {
        for (int x = 0; x < SIM_W; x++) {
            camera->ground[2 * y][x] = to_ground(camera, x, y - 0.25);
            camera->ground[2 * y + 1][x] = to_ground(camera, x, y + 0.25);
        }
        camera->blur[y] = camera->ground[2 * y][0].left - camera->ground[2 * y][1].left;
    }
}

void sim_camera_init(sim_camera *camera, uint32_t seed)
{
    camera->height_cm = 18;
    camera->forward_cm = 5;
    camera->pitch_deg = 42;
    camera->fov_deg = 62;
    camera->noise = 8;
    camera->blank = 0;
    sim_random_seed(&camera->random, seed + 77);
    for (int i = 0; i < 4096; i++) { /* Box-Muller */
        double u = (sim_random_next(&camera->random) + 1.0) / 4294967297.0;
        double v = sim_random_next(&camera->random) / 4294967296.0;
        camera->gauss[i] = (float)(sqrt(-2 * log(u)) * cos(2 * PI * v));
    }
    sim_camera_aim(camera);
}

static sim_pose place(sim_pose robot, sim_ground ground)
{
    double c = cos(robot.heading), s = sin(robot.heading);
    return (sim_pose){robot.x + c * ground.ahead - s * ground.left,
                      robot.y + s * ground.ahead + c * ground.left, robot.heading};
}

void sim_camera_render(uint8_t *gray, sim_camera *camera, const sim_floor *floor, sim_pose robot)
{
    double c = cos(robot.heading), s = sin(robot.heading);
    for (int y = 0; y < SIM_H; y++) {
        for (int x = 0; x < SIM_W; x++) {
            double sum = 0;
            for (int k = 0; k < 2 && !camera->blank; k++) {
                sim_ground g = camera->ground[2 * y + k][x];
                double u = robot.x + c * g.ahead - s * g.left, v = robot.y + s * g.ahead + c * g.left;
                sum += sim_floor_gray(floor, u, v, camera->blur[y]) / 2;
            }
            sum += camera->noise * camera->gauss[sim_random_next(&camera->random) >> 20];
            *gray++ = (uint8_t)(sum < 0 ? 0 : sum > 255 ? 255 : sum + 0.5);
        }
    }
}

sim_pose sim_camera_floor(const sim_camera *camera, sim_pose pose, double x, double y)
{
    return place(pose, to_ground(camera, x, y));
}

/* Where the picture shows a place on the floor, cm to the right of the robot's reference point and ahead of it. */
static void to_image(double *x, double *y, const sim_camera *camera, double right, double ahead)
{
    double focal = SIM_W / 2.0 / tan(camera->fov_deg * PI / 360);
    double pitch = camera->pitch_deg * PI / 180, away = ahead - camera->forward_cm;
    double depth = camera->height_cm * sin(pitch) + away * cos(pitch);
    *x = (SIM_W - 1) / 2.0 + focal * right / depth;
    *y = (SIM_H - 1) / 2.0 + focal * (camera->height_cm * cos(pitch) - away * sin(pitch)) / depth;
}

int sim_camera_marks(iris_floor *found, sim_camera *camera, int count)
{
    iris_floor_mark marks[64];
    iris_floor_quality quality;
    int columns = (count + 1) / 2;
    for (int i = 0; i < count; i++) { /* two rows of them, near and far */
        double x = SIM_W * (0.1 + 0.8 * (i % columns) / (columns - 1)), y = SIM_H * (i < columns ? 0.9 : 0.2);
        sim_ground at = to_ground(camera, x, y);
        double right = floor(-10 * at.left + 0.5), ahead = floor(10 * at.ahead + 0.5);
        to_image(&x, &y, camera, right / 10, ahead / 10);
        x += 0.3 * camera->gauss[sim_random_next(&camera->random) >> 20];
        y += 0.3 * camera->gauss[sim_random_next(&camera->random) >> 20];
        marks[i].image = (iris_place){(iris_q16)lround(x * 65536), (iris_q16)lround(y * 65536)};
        marks[i].floor = (iris_place){(iris_q16)lround(right * 65536), (iris_q16)lround(ahead * 65536)};
    }
    return iris_floor_fit(found, &quality, (iris_size){SIM_W, SIM_H}, marks, count) == IRIS_OK;
}

static int on_tape(const sim_camera *camera, const sim_track *track, sim_pose robot, double x, int y)
{
    sim_pose p = sim_camera_floor(camera, robot, x, y);
    return sim_track_tape(track, p.x, p.y) < 0;
}

int sim_camera_truth(double (*run)[2], int max, const sim_camera *camera, const sim_track *track,
                     sim_pose robot, int y)
{
    int count = 0, inside = 0;
    for (int x = 0; x <= SIM_W && count < max; x++) {
        int on = x < SIM_W && on_tape(camera, track, robot, x, y);
        if (on == inside) {
            continue;
        }
        double before = x - 1, behind = x; /* the edge is between them */
        for (int i = 0; i < 8 && x > 0 && x < SIM_W; i++) {
            double middle = (before + behind) / 2;
            int same = on_tape(camera, track, robot, middle, y) == inside;
            before = same ? middle : before;
            behind = same ? behind : middle;
        }
        if (on) { /* a column belongs to the tape when its middle does: an edge at e is column e + 0.5 or e -
                     0.5 */
            run[count][0] = x == 0 ? 0 : behind + 0.5;
        } else {
            run[count++][1] = x == SIM_W ? SIM_W - 1 : before - 0.5;
        }
        inside = on;
    }
    return count;
}
