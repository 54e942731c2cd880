/* A map of a room by a sensor that turns and measures ranges, and the robot found on it again. All memory static. Here the
 * "sensor" is in a room of 4 x 3 m with a pillar. */
#include <stdio.h>
#include <stdlib.h>

#include "iris/3d/localize.h"

enum { W = 88, H = 68, CELL_MM = 50, RANGES = 180, WINDOW = 10, STEPS = 20 };

static int8_t odds[W * H];
static uint8_t nearness[IRIS_FIELD_BYTES(W, H)];
static IRIS_SCRATCH_BUFFER(memory, IRIS_FIELD_SCRATCH_BYTES(W, H) +
                                       IRIS_LOCALIZE_SCRATCH_BYTES(RANGES, WINDOW, STEPS));
static iris_beam beams[RANGES];

/* A range each 2 degrees, from straight ahead; the sensor is in the middle of the robot. */
static const iris_range_sensor sensor = {.step_q16 = 65536 / RANGES * 65536 + 65536 % RANGES * 65536 / RANGES,
                                         .least_mm = 50,
                                         .most_mm = 5000,
                                         .spread_mm = 10};

static int is_free(int x, int y)
{
    const int is_pillar = x > 2600 && x < 3000 && y > 1700 && y < 2000;
    return x > 0 && x < 4000 && y > 0 && y < 3000 && !is_pillar;
}

/* What the robot measures at `pose`: up to 10 mm wrong. */
static int measure(iris_scan *scan, iris_map_pose pose)
{
    static unsigned noise = 1;
    static int32_t ranges[RANGES];
    for (int i = 0; i < RANGES; i++) {
        const iris_angle bearing = iris_angle_wrap(pose.heading + i * 65536 / RANGES);
        const int64_t x = iris_cos_q30(bearing), y = iris_sin_q30(bearing);
        int r = 0;
        while (is_free(pose.x_mm + (int)(x * r / 1073741824), pose.y_mm + (int)(y * r / 1073741824))) {
            r += 2;
        }
        noise = noise * 1664525u + 1013904223u;
        ranges[i] = r + (int)(noise >> 24) % 21 - 10;
    }
    *scan = (iris_scan){.beams = beams};
    return iris_scan_from_ranges(beams, &scan->count, ranges, RANGES, &sensor) == IRIS_OK;
}

static iris_map_pose at(int x_mm, int y_mm, int degrees)
{
    const iris_map_pose pose = {x_mm, y_mm, iris_angle_from_degrees(degrees)};
    return pose;
}

/* Of 2 x 4 cells, beginning at (x, y): anything occupied, or anything free. */
static int letter(const iris_grid *grid, int x, int y)
{
    int most = 0, least = 0;
    for (int i = 0; i < 8; i++) {
        const int odd = iris_grid_at(grid, grid->left_mm + (x + i % 2) * CELL_MM,
                                     grid->bottom_mm + (y + i / 2) * CELL_MM);
        most = odd > most ? odd : most;
        least = odd < least ? odd : least;
    }
    return most >= IRIS_ODDS_OCCUPIED ? '#' : least <= IRIS_ODDS_FREE ? '.' : ' ';
}

static int map(const iris_grid *grid, iris_scratch *scratch)
{
    for (int i = 0; i < 6; i++) {
        const iris_map_pose pose = at(600 + 500 * i, 800 + 100 * i, 20 * i);
        iris_scan scan;
        if (!measure(&scan, pose) || iris_grid_fuse(grid, pose, &scan, NULL, scratch)) {
            return 0;
        }
    }
    for (int y = H - 4; y >= 0; y -= 4) { /* a letter for 2 x 4 cells */
        for (int x = 0; x < W; x += 2) {
            putchar(letter(grid, x, y));
        }
        putchar('\n');
    }
    return 1;
}

/* The robot is at `pose`, and its odometry is wrong by `drift`. */
static int find(const iris_field *field, iris_map_pose pose, iris_map_pose drift, iris_scratch *scratch)
{
    static const char *const verdicts[] = {"found", "too few beams", "no match", "ambiguous", "at the edge"};
    iris_scan scan;
    iris_location found;
    if (!measure(&scan, pose) ||
        iris_localize(&found, field, iris_map_pose_after(pose, drift), &scan, NULL, scratch)) {
        return 0;
    }
    const iris_map_pose off = iris_map_pose_step(pose, found.pose);
    printf("%s at %d, %d mm, %d degrees; off by %d, %d mm, %.2f degrees\n", verdicts[found.verdict],
           (int)found.pose.x_mm, (int)found.pose.y_mm, (int)iris_angle_to_degrees(found.pose.heading),
           (int)off.x_mm, (int)off.y_mm, off.heading * 360 / 65536.0);
    return found.verdict == IRIS_LOCALIZE_FOUND && abs(off.x_mm) < CELL_MM && abs(off.y_mm) < CELL_MM &&
           abs(off.heading) < 182; /* a degree */
}

int main(void)
{
    static const int32_t corner[2] = {-200, -200};
    iris_scratch scratch;
    iris_grid grid;
    iris_field field;
    return iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) ||
           iris_grid_init(&grid, odds, sizeof odds, (iris_size){W, H}, CELL_MM, corner) ||
           !map(&grid, &scratch) || iris_field_init(&field, nearness, sizeof nearness, &grid, &scratch) ||
           !find(&field, at(1500, 2200, 70), at(180, -120, 6), &scratch) ||
           !find(&field, at(3300, 1300, -100), at(-60, 210, -7), &scratch);
}
