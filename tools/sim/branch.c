#include "branch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera.h"
#include "iris/xt/junction_latch.h"
#include "iris/xt/line_mask.h"
#include "iris/xt/steer.h"
#include "robot.h"

#define PI 3.14159265358979323846

static const double STEM = 90, ARM = 110; /* cm of tape before the junction and behind it */
static const double FAR = 55;             /* cm from the junction where the branch is told */

/* Branches by degrees to the left of straight ahead, as iris_turn: straight, left, right. */
typedef struct {
    const char *name;
    int has[3];
    double degrees[3];
} junction_kind;

static const junction_kind kinds[] = {{"t", {0, 1, 1}, {0, 90, -90}},
                                      {"left", {1, 1, 0}, {0, 90, 0}},
                                      {"right", {1, 0, 1}, {0, 0, -90}},
                                      {"y", {0, 1, 1}, {0, 40, -40}},
                                      {"crossing", {1, 1, 1}, {0, 90, -90}}};

/* Robots: where the camera is, and how they turn. */
typedef struct {
    const char *name;
    double forward_cm;         /* of the lens in front of the axle */
    double axle_cm, top_speed; /* between the wheels; cm/s */
} robot_kind;

static const robot_kind robots[] = {{"demo", 5, 15, 60},   /* 92 degrees a second in search of a line */
                                    {"over", 0, 15, 60},   /* the camera is over the axle */
                                    {"ahead", 12, 15, 60}, /* the camera is far ahead of it */
                                    {"slow", 6, 20, 25}};  /* 29 degrees a second, on a circle of 10 cm */

static void add_piece(sim_track *track, double x, double y, double heading, double length, double before)
{
    sim_piece piece = {
        .start = {x, y, heading}, .s = track->length, .length = length, .before = before, .taped = 1};
    track->piece[track->count++] = piece;
    track->length += length;
}

static void lay(sim_track *track, const junction_kind *kind)
{
    memset(track, 0, sizeof *track);
    track->tape = 3;
    add_piece(track, 0, -STEM, PI / 2, STEM, 0);
    for (int i = 0; i < 3; i++) {
        if (kind->has[i]) {
            add_piece(track, 0, 0, PI / 2 + kind->degrees[i] * PI / 180, ARM, track->tape / 2);
        }
    }
    track->left = track->bottom = -ARM - 25;
    track->right = track->top = ARM + 25;
}

/* The library's side: from pixels to a command. */
typedef struct {
    iris_follow follow;
    iris_steer steer;
    iris_junction_latch latch;
    iris_image gray, mask;
    uint8_t pixels[SIM_W * SIM_H];
    uint32_t words[SIM_W / 32 * SIM_H];
} driver;

static IRIS_SCRATCH_BUFFER(follower, IRIS_FOLLOW_SCRATCH_BYTES(SIM_W, SIM_H));
static IRIS_SCRATCH_BUFFER(memory, IRIS_JUNCTION_SCRATCH_BYTES(SIM_W, SIM_H));

static int begin(driver *d, iris_turn turn)
{
    iris_scratch scratch;
    iris_size size = {SIM_W, SIM_H};
    iris_scratch_init(&scratch, follower.memory, sizeof follower.memory);
    return iris_image_wrap(&d->gray, d->pixels, sizeof d->pixels, size, 0, IRIS_GRAY8) == IRIS_OK &&
           iris_image_wrap(&d->mask, d->words, sizeof d->words, size, 0, IRIS_MASK1) == IRIS_OK &&
           iris_follow_init(&d->follow, size, NULL, &scratch) == IRIS_OK &&
           iris_steer_init(&d->steer, NULL) == IRIS_OK &&
           iris_junction_latch_init(&d->latch, size) == IRIS_OK &&
           iris_junction_latch_take(&d->latch, &turn, 1) == IRIS_OK;
}

static void look(iris_command *command, driver *d, uint32_t now_ms, int32_t elapsed_ms)
{
    iris_follow_result line;
    iris_junction found[IRIS_JUNCTIONS_MAX];
    int32_t count = 0;
    iris_scratch scratch;
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    iris_follow_frame(&line, &d->follow, &d->gray, now_ms);
    iris_line_mask(NULL, &d->mask, &d->gray, NULL, &scratch);
    iris_junctions_find(found, IRIS_JUNCTIONS_MAX, &count, &d->mask, NULL, &scratch);
    iris_junction_latch_update(&line, &d->latch, found, count, elapsed_ms);
    iris_steer_update(command, &d->steer, &line, elapsed_ms);
}

/* Drives until the robot is far from the junction, or for half a minute. */
static void drive(driver *d, sim_camera *camera, const sim_floor *floor, sim_robot *robot)
{
    enum { RATE = 30 };
    iris_command next = {.speed_permil = 0}, command = next;
    int near = 0;
    for (int frame = 0; frame < 30 * RATE; frame++) {
        double away = hypot(robot->pose.x, robot->pose.y);
        near |= away < STEM / 3;
        if (near && away > FAR) {
            return;
        }
        sim_camera_render(d->pixels, camera, floor, robot->pose);
        look(&next, d, (uint32_t)(frame * 1000 / RATE), frame == 0 ? 0 : 1000 / RATE);
        for (int k = 0; k < 8; k++) { /* one frame of latency */
            sim_robot_drive(robot, &command, 0.125 / RATE);
        }
        command = next;
    }
}

int sim_branch_drive(const char *kind, const char *take, const char *by, uint32_t seed)
{
    static const char *const turns[] = {"straight", "left", "right"};
    static sim_track track;
    static sim_camera camera;
    static driver d;
    const junction_kind *is = NULL;
    const robot_kind *driven = NULL;
    int turn = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        is = strcmp(kinds[i].name, kind) == 0 ? &kinds[i] : is;
    }
    for (size_t i = 0; i < sizeof robots / sizeof robots[0]; i++) {
        driven = strcmp(robots[i].name, by) == 0 ? &robots[i] : driven;
    }
    while (turn < 3 && strcmp(turns[turn], take) != 0) {
        turn++;
    }
    if (!is || !driven || turn == 3 || !is->has[turn]) {
        return -1;
    }
    sim_floor floor;
    sim_robot robot;
    lay(&track, is);
    sim_camera_init(&camera, seed);
    camera.forward_cm = driven->forward_cm;
    sim_camera_aim(&camera);
    if (!begin(&d, (iris_turn)turn) || !sim_floor_make(&floor, &track, seed)) {
        return 0;
    }
    sim_robot_init(&robot, sim_track_at(&track, 0));
    robot.axle_cm = driven->axle_cm;
    robot.top_speed = driven->top_speed;
    drive(&d, &camera, &floor, &robot);
    sim_floor_free(&floor);
    double arm = PI / 2 + is->degrees[turn] * PI / 180;
    double along = robot.pose.x * cos(arm) + robot.pose.y * sin(arm);
    double across = robot.pose.y * cos(arm) - robot.pose.x * sin(arm);
    int good = along > FAR - 10 && fabs(across) < robot.width_cm / 2;
    printf("%s, told %s, robot %s: %.0f cm along that branch, %.1f cm beside it\n", kind, take, by, along,
           across);
    return good;
}
