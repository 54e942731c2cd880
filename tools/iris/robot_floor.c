#include "robot_floor.h"

#include <string.h>

#define SIDE         ROBOT_FLOOR_CELLS
#define CELLS        (SIDE * SIDE)
#define CLEAR_MM     30 /* what a way keeps clear of beside the robot itself */
#define QUIET_PERMIL 800
#define BUMP_ODDS    40 /* nearly as sure as it gets */

void robot_floor_init(robot_floor *floor, osiris_pose start)
{
    const int32_t half = SIDE / 2 * ROBOT_FLOOR_CELL_MM;
    const int32_t corner[2] = {start.x_mm - half, start.y_mm - half};
    memset(floor, 0, sizeof *floor);
    (void)iris_grid_init(&floor->grid, floor->odds, sizeof floor->odds, (iris_size){SIDE, SIDE},
                         ROBOT_FLOOR_CELL_MM, corner);
}

void robot_floor_take(robot_floor *floor, const robot_senses *senses)
{
    static uint8_t memory[IRIS_GRID_FUSE_SCRATCH_BYTES(SIDE, SIDE) + IRIS_SCRATCH_ALIGN];
    uint8_t *aligned =
        memory + (IRIS_SCRATCH_ALIGN - (uintptr_t)memory % IRIS_SCRATCH_ALIGN) % IRIS_SCRATCH_ALIGN;
    const iris_map_pose robot = {senses->pose.x_mm, senses->pose.y_mm, senses->pose.heading};
    for (int32_t i = 0; i < senses->plan->device_count; i++) {
        const osiris_device *d = &senses->plan->devices[i];
        const osiris_raw *r = &senses->readings[i];
        if (d->kind != OSIRIS_RANGE || r->validity == OSIRIS_NEVER || r->time_ms == floor->taken_ms[i]) {
            continue;
        }
        floor->taken_ms[i] = r->time_ms;
        const int hit = r->validity == OSIRIS_VALID;
        const int32_t reach = hit ? r->values[0] : (int32_t)((int64_t)d->most * QUIET_PERMIL / 1000);
        const osiris_pose way = {reach, 0, 0};
        const osiris_pose end = osiris_pose_after(d->place, way);
        const iris_beam beam = {end.x_mm, end.y_mm, hit ? d->deviation : 0, hit};
        const iris_scan scan = {&beam, 1, d->place.x_mm, d->place.y_mm};
        iris_scratch scratch;
        (void)iris_scratch_init(&scratch, aligned, IRIS_GRID_FUSE_SCRATCH_BYTES(SIDE, SIDE));
        (void)iris_grid_fuse(&floor->grid, robot, &scan, NULL, &scratch);
    }
}

/* The cell of a place, or -1. */
static int32_t cell_at(const robot_floor *floor, int32_t x_mm, int32_t y_mm)
{
    const int64_t x = (int64_t)x_mm - floor->grid.left_mm, y = (int64_t)y_mm - floor->grid.bottom_mm;
    const int64_t all = (int64_t)SIDE * ROBOT_FLOOR_CELL_MM;
    return x < 0 || y < 0 || x >= all || y >= all
               ? -1
               : (int32_t)(y / ROBOT_FLOOR_CELL_MM) * SIDE + (int32_t)(x / ROBOT_FLOOR_CELL_MM);
}

void robot_floor_bump(robot_floor *floor, const robot_senses *senses)
{
    const osiris_pose front = {robot_front_mm(senses) + ROBOT_FLOOR_CELL_MM / 2, 0, 0};
    const osiris_pose there = osiris_pose_after(senses->pose, front);
    const int32_t i = cell_at(floor, there.x_mm, there.y_mm);
    if (i >= 0) {
        floor->odds[i] = BUMP_ODDS;
    }
}

/* Cells where the robot's middle cannot be, but for where it is. */
static void block(robot_floor *floor, const robot_senses *senses)
{
    const int32_t reach =
        (robot_radius_mm(senses) + CLEAR_MM + ROBOT_FLOOR_CELL_MM - 1) / ROBOT_FLOOR_CELL_MM;
    memset(floor->blocked, 0, sizeof floor->blocked);
    for (int32_t i = 0; i < CELLS; i++) {
        if (floor->odds[i] < IRIS_ODDS_OCCUPIED) {
            continue;
        }
        const int32_t x = i % SIDE, y = i / SIDE;
        for (int32_t v = y - reach < 0 ? 0 : y - reach; v <= y + reach && v < SIDE; v++) {
            for (int32_t u = x - reach < 0 ? 0 : x - reach; u <= x + reach && u < SIDE; u++) {
                floor->blocked[v * SIDE + u] |= (u - x) * (u - x) + (v - y) * (v - y) <= reach * reach;
            }
        }
    }
    const int32_t here = cell_at(floor, senses->pose.x_mm, senses->pose.y_mm);
    for (int32_t i = 0; here >= 0 && i < CELLS; i++) { /* it is there: a way out must be found */
        const int32_t x = i % SIDE - here % SIDE, y = i / SIDE - here / SIDE;
        if (floor->blocked[i] && x * x + y * y <= 4 && floor->odds[i] < IRIS_ODDS_OCCUPIED) {
            floor->blocked[i] = 0;
        }
    }
}

/* From the cells in the queue, whose steps are set, over all that is not blocked: breadth first. */
static void spread(robot_floor *floor, int32_t count)
{
    for (int32_t next = 0; next < count; next++) {
        const int32_t i = floor->queue[next], x = i % SIDE, y = i / SIDE;
        const int32_t around[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        for (int k = 0; k < 4; k++) {
            const int32_t u = x + around[k][0], v = y + around[k][1], j = v * SIDE + u;
            if (u >= 0 && v >= 0 && u < SIDE && v < SIDE && !floor->steps[j] && !floor->blocked[j] &&
                floor->steps[i] < UINT16_MAX) {
                floor->steps[j] = (uint16_t)(floor->steps[i] + 1);
                floor->queue[count++] = j;
            }
        }
    }
}

int robot_floor_plan_to(robot_floor *floor, const robot_senses *senses, int32_t x_mm, int32_t y_mm)
{
    const int32_t goal = cell_at(floor, x_mm, y_mm);
    if (goal < 0) {
        return 0;
    }
    block(floor, senses);
    memset(floor->steps, 0, sizeof floor->steps);
    const int32_t reach = (robot_radius_mm(senses) + CLEAR_MM) / ROBOT_FLOOR_CELL_MM + 3;
    int32_t count = 0;
    for (int32_t i = 0; i < CELLS; i++) { /* the goal itself may be a thing */
        const int32_t x = i % SIDE - goal % SIDE, y = i / SIDE - goal / SIDE;
        if (i == goal || (floor->blocked[goal] && x * x + y * y <= reach * reach && !floor->blocked[i])) {
            floor->steps[i] = 1;
            floor->queue[count++] = i;
        }
    }
    spread(floor, count);
    return 1;
}

/* A free cell beside one that nobody has seen. */
static int is_edge(const robot_floor *floor, int32_t i)
{
    const int32_t x = i % SIDE, y = i / SIDE;
    return x > 0 && y > 0 && x < SIDE - 1 && y < SIDE - 1 && floor->odds[i] < 0 && !floor->blocked[i] &&
           (!floor->odds[i - 1] || !floor->odds[i + 1] || !floor->odds[i - SIDE] || !floor->odds[i + SIDE]);
}

int robot_floor_plan_unknown(robot_floor *floor, const robot_senses *senses)
{
    const int32_t circle =
        2 * osiris_drive_radius_min(&senses->plan->drive); /* around it: it cannot just turn there */
    const int32_t body = robot_radius_mm(senses) + 3 * ROBOT_FLOOR_CELL_MM;
    const int32_t near = (body > circle ? body : circle) / ROBOT_FLOOR_CELL_MM;
    const int32_t here = cell_at(floor, senses->pose.x_mm, senses->pose.y_mm);
    if (here < 0) {
        return 0;
    }
    block(floor, senses);
    memset(floor->steps, 0, sizeof floor->steps);
    int32_t count = 0;
    for (int32_t i = 0; i < CELLS; i++) {
        const int32_t x = i % SIDE - here % SIDE, y = i / SIDE - here / SIDE;
        if (x * x + y * y > near * near && is_edge(floor, i)) {
            floor->steps[i] = 1;
            floor->queue[count++] = i;
        }
    }
    spread(floor, count);
    return floor->steps[here] != 0;
}

int robot_floor_ahead(const robot_floor *floor, osiris_pose *place, const robot_senses *senses,
                      int32_t reach_mm)
{
    int32_t i = cell_at(floor, senses->pose.x_mm, senses->pose.y_mm);
    if (i < 0 || !floor->steps[i]) {
        return 0;
    }
    for (int32_t way = 0; way < reach_mm && floor->steps[i] > 1; way += ROBOT_FLOOR_CELL_MM) {
        static const int32_t around[8] = {1 + SIDE, 1 - SIDE, -1 + SIDE, -1 - SIDE, 1, -1, SIDE, -SIDE};
        int32_t best = i;
        for (int k = 0; k < 8; k++) {
            const int32_t j = i + around[k];
            if (j >= 0 && j < CELLS && floor->steps[j] && floor->steps[j] < floor->steps[best]) {
                best = j;
            }
        }
        if (best == i) {
            break;
        }
        i = best;
    }
    place->x_mm = floor->grid.left_mm + i % SIDE * ROBOT_FLOOR_CELL_MM + ROBOT_FLOOR_CELL_MM / 2;
    place->y_mm = floor->grid.bottom_mm + i / SIDE * ROBOT_FLOOR_CELL_MM + ROBOT_FLOOR_CELL_MM / 2;
    place->heading = 0;
    return 1;
}
