#include "explore.h"

#include <math.h>
#include <stdio.h>

#define PI    3.14159265358979323846
#define UNITS (65536 / (2 * PI))

#define W         132 /* cells */
#define H         100
#define CELL      50
#define LEFT      (-1760)
#define BOTTOM    (-1440)
#define SPEED     350.0 /* mm/s */
#define FRAME_S   0.2
#define STEPS     4 /* to a frame */
#define LOOKAHEAD 350.0

static double wrapped(double angle)
{
    return remainder(angle, 2 * PI);
}

/* --- driving --- */

/* Along the way by pure pursuit: `pass` is the point of the way that is driven to. Returns 1 when it was passed. */
static int drive(sim_pose *pose, int pass, double shift)
{
    const double *to = sim_way[pass % sim_way_points],
                 *from = sim_way[(pass + sim_way_points - 1) % sim_way_points];
    const double length = hypot(to[0] - from[0], to[1] - from[1]), dx = (to[0] - from[0]) / length,
                 dy = (to[1] - from[1]) / length;
    double along = (pose->x - from[0]) * dx + (pose->y - from[1]) * dy + LOOKAHEAD;
    along = along > length ? length : along;
    const double goal_x = from[0] + along * dx - shift * dy, goal_y = from[1] + along * dy + shift * dx;
    const double seconds = FRAME_S / STEPS,
                 turn = wrapped(atan2(goal_y - pose->y, goal_x - pose->x) - pose->heading);
    const double rate = fmax(-1.2, fmin(1.2, 2 * SPEED * sin(turn) / LOOKAHEAD));
    pose->heading = wrapped(pose->heading + rate * seconds);
    pose->x += SPEED * seconds * cos(pose->heading);
    pose->y += SPEED * seconds * sin(pose->heading);
    return hypot(goal_x - pose->x, goal_y - pose->y) < LOOKAHEAD / 2;
}

/* What wheels say of the way from one pose to the next: 3 % too much, a slow turn to one side, and noise. */
static iris_map_pose odometry(sim_random *random, sim_pose from, sim_pose to)
{
    const double dx = to.x - from.x, dy = to.y - from.y, c = cos(from.heading), s = sin(from.heading);
    const double ahead = 1.03 * (c * dx + s * dy) + 3 * sim_gauss(random),
                 left = c * dy - s * dx + 2 * sim_gauss(random);
    const double turn = wrapped(to.heading - from.heading) + (0.12 + 0.3 * sim_gauss(random)) * PI / 180;
    return (iris_map_pose){(int32_t)lround(ahead), (int32_t)lround(left),
                           iris_angle_wrap((int32_t)lround(turn * UNITS))};
}

static iris_map_pose map_pose(sim_pose pose)
{
    return (iris_map_pose){(int32_t)lround(pose.x), (int32_t)lround(pose.y),
                           iris_angle_wrap((int32_t)lround(pose.heading * UNITS))};
}

/* Once around and a little more. shift: to the left of the way. */
static void drive_lap(sim_lap *lap, sim_random *random, double shift)
{
    sim_pose pose = {sim_way[0][0], sim_way[0][1], 0};
    int pass = 1, step = 0;
    for (lap->frames = 0; lap->frames < SIM_LAP_MAX && pass <= sim_way_points + 1; step++) {
        if (step % STEPS == 0) {
            const int i = lap->frames++;
            lap->truth[i] = pose;
            lap->odometry[i] =
                i == 0 ? map_pose(pose)
                       : iris_map_pose_after(lap->odometry[i - 1], odometry(random, lap->truth[i - 1], pose));
            sim_depth_render(lap->disparity[i], random, pose);
        }
        pass += drive(&pose, pass, shift);
    }
}

/* --- the library's part --- */

static iris_scan scan_of(const uint16_t *disparity)
{
    static iris_beam beams[SIM_DEPTH_W];
    static IRIS_SCRATCH_BUFFER(working, IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(SIM_DEPTH_W));
    const iris_depth_camera camera = sim_depth_camera();
    const iris_image image = {(void *)(uintptr_t)disparity, 2 * SIM_DEPTH_W, SIM_DEPTH_W, SIM_DEPTH_H,
                              IRIS_GRAY_U16};
    iris_scan scan = {beams, 0, camera.mount.x_mm, camera.mount.y_mm};
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, working.memory, sizeof working.memory);
    (void)iris_scan_from_depth(beams, &scan.count, &image, &camera, &scratch);
    return scan;
}

static int make_map(sim_exploration *e)
{
    static int8_t odds[W * H];
    static IRIS_SCRATCH_BUFFER(working, IRIS_GRID_FUSE_SCRATCH_BYTES(W, H));
    static const int32_t corner[2] = {LEFT, BOTTOM};
    int good = iris_grid_init(&e->grid, odds, sizeof odds, (iris_size){W, H}, CELL, corner) == IRIS_OK;
    for (int i = 0; i < e->lap[0].frames && good; i++) {
        const iris_scan scan = scan_of(e->lap[0].disparity[i]);
        iris_scratch scratch;
        (void)iris_scratch_init(&scratch, working.memory, sizeof working.memory);
        good = iris_grid_fuse(&e->grid, map_pose(e->lap[0].truth[i]), &scan, NULL, &scratch) == IRIS_OK;
    }
    return good;
}

/* The second lap. `counts`: by verdict. */
static int find_poses(sim_exploration *e, int counts[5])
{
    static uint8_t memory[IRIS_FIELD_BYTES(W, H)];
    static IRIS_SCRATCH_BUFFER(working, IRIS_FIELD_SCRATCH_BYTES(W, H));
    static IRIS_SCRATCH_BUFFER(matching, IRIS_LOCALIZE_SCRATCH_BYTES(SIM_DEPTH_W, 10, 20));
    sim_lap *lap = &e->lap[1];
    iris_localize_config config;
    iris_field field;
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, working.memory, sizeof working.memory);
    iris_localize_defaults(&config);
    int good = iris_field_init(&field, memory, sizeof memory, &e->grid, &scratch) == IRIS_OK;
    for (int i = 0; i < lap->frames && good; i++) {
        const iris_scan scan = scan_of(lap->disparity[i]);
        iris_location location;
        const iris_map_pose step = i == 0 ? (iris_map_pose){180, -210, 900} /* put down somewhere else */
                                          : iris_map_pose_step(lap->odometry[i - 1], lap->odometry[i]);
        const iris_map_pose predicted =
            iris_map_pose_after(i == 0 ? lap->odometry[0] : lap->found[i - 1], step);
        (void)iris_scratch_init(&scratch, matching.memory, sizeof matching.memory);
        good = iris_localize(&location, &field, predicted, &scan, &config, &scratch) == IRIS_OK;
        lap->found[i] = iris_location_is_of_use(&location, &config) ? location.pose : predicted;
        config.predicted_mm = 20; /* from now on odometry tells more than where to look */
        config.predicted_angle = 182;
        counts[location.verdict]++;
    }
    return good;
}

/* --- what came of it --- */

static int is_occupied_near(const iris_grid *grid, double x, double y, int reach)
{
    for (int i = 0; i < (2 * reach + 1) * (2 * reach + 1); i++) {
        const int32_t at_x = (int32_t)floor(x) + CELL * (i % (2 * reach + 1) - reach);
        const int32_t at_y = (int32_t)floor(y) + CELL * (i / (2 * reach + 1) - reach);
        if (iris_grid_at(grid, at_x, at_y) >= IRIS_ODDS_OCCUPIED) {
            return 1;
        }
    }
    return 0;
}

/* Marks the cells in which a wall was in the camera's view, up to 4 m ahead. */
static void mark_seen(uint8_t seen[W * H], const sim_lap *lap)
{
    for (int i = 0; i < lap->frames; i++) {
        for (int k = -180; k <= 180; k++) { /* of the width, 75 degrees */
            double at[2];
            const double ahead = sim_wall_ahead(at, lap->truth[i], k * tan(37 * PI / 180) / 180);
            const int x = (int)floor((at[0] - LEFT) / CELL), y = (int)floor((at[1] - BOTTOM) / CELL);
            if (ahead > 100 && ahead < 4000 && x >= 0 && x < W && y >= 0 && y < H) {
                seen[y * W + x] = 1;
            }
        }
    }
}

/* Walls that were in view, and the floor that is more than a cell away from walls. */
static void judge_map(const sim_exploration *e)
{
    static uint8_t seen[W * H];
    const iris_grid *grid = &e->grid;
    int walls = 0, found = 0, near = 0, open = 0, wrong = 0, known = 0;
    mark_seen(seen, &e->lap[0]);
    for (int i = 0; i < W * H; i++) {
        const double x = LEFT + CELL * (i % W + 0.5), y = BOTTOM + CELL * (i / W + 0.5);
        const int32_t odds = iris_grid_at(grid, (int32_t)x, (int32_t)y);
        if (seen[i]) {
            walls++;
            found += odds >= IRIS_ODDS_OCCUPIED;
            near += is_occupied_near(grid, x, y, 1);
        } else if (sim_is_free(x, y) && sim_wall_distance(x, y) > 1.5 * CELL) {
            open++;
            wrong += odds >= IRIS_ODDS_OCCUPIED;
            known += odds <= IRIS_ODDS_FREE;
        }
    }
    printf("map       %d wall cells seen: %.1f %% found, %.1f %% within a cell; %d free cells: %.2f %% "
           "wrong, %.1f "
           "%% known free\n",
           walls, 100.0 * found / walls, 100.0 * near / walls, open, 100.0 * wrong / open,
           100.0 * known / open);
}

static double error_of(double *degrees, iris_map_pose pose, sim_pose truth)
{
    *degrees = fabs(wrapped(pose.heading / UNITS - truth.heading)) * 180 / PI;
    return hypot(pose.x_mm - truth.x, pose.y_mm - truth.y);
}

/* Prints them; 1 when all of them are within a cell. */
static int judge_poses(const sim_lap *lap, const int counts[5])
{
    double most = 0, sum = 0, most_turn = 0, drift = 0, drift_turn = 0;
    for (int i = 0; i < lap->frames; i++) {
        double degrees;
        const double error = error_of(&degrees, lap->found[i], lap->truth[i]);
        most = fmax(most, error);
        most_turn = fmax(most_turn, degrees);
        sum += error;
        drift = fmax(drift, error_of(&degrees, lap->odometry[i], lap->truth[i]));
        drift_turn = fmax(drift_turn, degrees);
    }
    printf("odometry  alone: largest error %.0f mm, %.1f degrees\n", drift, drift_turn);
    printf("pose      largest error %.1f mm, mean %.1f mm, heading %.2f degrees; a cell is %d mm\n", most,
           sum / lap->frames, most_turn, CELL);
    printf(
        "frames    %d: %d found, %d ambiguous, %d at the edge, %d without a match, %d with too few beams\n",
        lap->frames, counts[IRIS_LOCALIZE_FOUND], counts[IRIS_LOCALIZE_AMBIGUOUS],
        counts[IRIS_LOCALIZE_AT_EDGE], counts[IRIS_LOCALIZE_NO_MATCH], counts[IRIS_LOCALIZE_TOO_FEW]);
    return most < CELL;
}

int sim_explore(uint32_t seed, const char *folder, const char *frames)
{
    static sim_exploration e;
    int counts[5] = {0};
    sim_random random;
    sim_random_seed(&random, seed);
    drive_lap(&e.lap[0], &random, 0);
    drive_lap(&e.lap[1], &random, 90);
    printf("course    a room of 6.2 x 4.6 m with walls, boxes, and a pillar; a lap is %d frames\n",
           e.lap[0].frames);
    printf("camera    %dx%d disparities, noise of %.2f pixels, 8 %% and 8 patches missing, 0.5 %% wrong\n",
           SIM_DEPTH_W, SIM_DEPTH_H, SIM_DISPARITY_NOISE);
    int good = make_map(&e);
    judge_map(&e);
    good = good && find_poses(&e, counts);
    good = judge_poses(&e.lap[1], counts) && good;
    if ((folder && !sim_explore_save(folder, &e)) || (frames && !sim_explore_frames(frames, &e))) {
        fprintf(stderr, "iris-demo: %s: cannot be written\n", folder ? folder : frames);
        return 1;
    }
    printf("%s\n", good ? "PASSED" : "FAILED: a pose was off by a cell or more");
    return good ? 0 : 1;
}
