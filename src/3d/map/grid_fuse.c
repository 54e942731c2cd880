/* Scans become odds: hits first, then what the beams pass. */
#include <string.h>

#include "map_parts.h"

void iris_fusion_defaults(iris_fusion *fusion)
{
    if (fusion) {
        *fusion = (iris_fusion){14, 6, 64};
    }
}

iris_status iris_fusion_check(const iris_fusion *fusion)
{
    const int fits = fusion->hit >= 1 && fusion->hit <= 127 && fusion->miss >= 1 && fusion->miss <= 127 &&
                     fusion->limit >= 1 && fusion->limit <= 127;
    return fits ? IRIS_OK : IRIS_ERR_ARG;
}

int32_t iris_fusion_hit(const iris_fusion *fusion, int32_t spread_mm, int32_t cell_mm)
{
    if (spread_mm > 2 * cell_mm) {
        return 0;
    }
    const int32_t whole = cell_mm + 2 * spread_mm, worth = (fusion->hit * cell_mm + whole / 2) / whole;
    return worth > 1 ? worth : 1;
}

/* What fusing needs to know at each beam. */
typedef struct {
    const iris_grid *grid;
    const iris_scan *scan;
    iris_fusion fusion;
    iris_heading turn;
    int32_t robot[2]; /* from the grid's corner */
    int32_t sensor[3];
    uint32_t *marks;
} fusing;

static void place_of(int32_t at[3], const fusing *f, int32_t x, int32_t y)
{
    at[0] = f->robot[0] + iris_heading_x(f->turn, x, y);
    at[1] = f->robot[1] + iris_heading_y(f->turn, x, y);
    at[2] = 0;
}

static int is_inside(const iris_grid *grid, int32_t x, int32_t y)
{
    return x >= 0 && x < grid->w && y >= 0 && y < grid->h;
}

static void add(const fusing *f, int32_t x, int32_t y, int32_t gain)
{
    const size_t i = (size_t)y * (size_t)f->grid->w + (size_t)x;
    if (iris_mark(f->marks, i)) {
        f->grid->odds[i] = iris_fusion_add(&f->fusion, f->grid->odds[i], gain);
    }
}

static void add_hit(const fusing *f, const iris_beam *beam)
{
    const int32_t cell = f->grid->cell_mm, worth = iris_fusion_hit(&f->fusion, beam->spread_mm, cell);
    int32_t end[3];
    place_of(end, f, beam->x_mm, beam->y_mm);
    const int32_t x = iris_ray_floor(end[0], cell), y = iris_ray_floor(end[1], cell);
    if (worth > 0 && is_inside(f->grid, x, y)) {
        add(f, x, y, worth);
    }
}

/* How much of the beam is free: in millimeters from the sensor, of its length. */
static int32_t free_part(const fusing *f, const iris_beam *beam, int32_t length)
{
    if (!beam->hit) {
        return length;
    }
    const int sure = iris_fusion_hit(&f->fusion, beam->spread_mm, f->grid->cell_mm) > 0;
    const int32_t unsure = sure ? beam->spread_mm : 2 * beam->spread_mm;
    return length > unsure ? length - unsure : 0;
}

static void add_misses(const fusing *f, const iris_beam *beam)
{
    const int32_t dx = beam->x_mm - f->scan->x_mm, dy = beam->y_mm - f->scan->y_mm;
    const int32_t length = (int32_t)iris_hypot(dx, dy), part = free_part(f, beam, length);
    int32_t end[3];
    iris_ray ray;
    if (length == 0) {
        return;
    }
    place_of(end, f, f->scan->x_mm + (int32_t)((int64_t)dx * part / length),
             f->scan->y_mm + (int32_t)((int64_t)dy * part / length));
    iris_ray_start(&ray, f->sensor, end, f->grid->cell_mm);
    do {
        if (!is_inside(f->grid, ray.at[0], ray.at[1])) {
            return;
        }
        add(f, ray.at[0], ray.at[1], -f->fusion.miss);
    } while (iris_ray_next(&ray));
}

iris_status iris_scan_check(const iris_scan *scan)
{
    const int32_t most = IRIS_SCAN_REACH_MAX_MM;
    if (!scan || (!scan->beams && scan->count > 0) || scan->count < 0 || scan->count > IRIS_SCAN_BEAMS_MAX ||
        scan->x_mm <= -most || scan->x_mm >= most || scan->y_mm <= -most || scan->y_mm >= most) {
        return IRIS_ERR_ARG;
    }
    for (int32_t i = 0; i < scan->count; i++) {
        const iris_beam *beam = &scan->beams[i];
        if (beam->x_mm <= -most || beam->x_mm >= most || beam->y_mm <= -most || beam->y_mm >= most ||
            beam->spread_mm < 0 || beam->spread_mm > most) {
            return IRIS_ERR_ARG;
        }
    }
    return IRIS_OK;
}

iris_status iris_grid_fuse(const iris_grid *grid, iris_map_pose robot, const iris_scan *scan,
                           const iris_fusion *fusion, iris_scratch *scratch)
{
    fusing f = {.grid = grid, .scan = scan};
    iris_fusion_defaults(&f.fusion);
    f.fusion = fusion ? *fusion : f.fusion;
    iris_status status = scratch ? iris_grid_check(grid) : IRIS_ERR_ARG;
    status = status == IRIS_OK ? iris_scan_check(scan) : status;
    status = status == IRIS_OK ? iris_fusion_check(&f.fusion) : status;
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_place_fits(robot.x_mm) || !iris_place_fits(robot.y_mm)) {
        return IRIS_ERR_RANGE;
    }
    f.turn = iris_heading_of(robot.heading);
    f.robot[0] = robot.x_mm - grid->left_mm;
    f.robot[1] = robot.y_mm - grid->bottom_mm;
    place_of(f.sensor, &f, scan->x_mm, scan->y_mm);
    if (!is_inside(grid, iris_ray_floor(f.sensor[0], grid->cell_mm),
                   iris_ray_floor(f.sensor[1], grid->cell_mm))) {
        return IRIS_ERR_RANGE;
    }
    const size_t mark = iris_scratch_mark(scratch), bytes = IRIS_GRID_FUSE_SCRATCH_BYTES(grid->w, grid->h);
    f.marks = iris_scratch_take(scratch, bytes);
    if (!f.marks) {
        return IRIS_ERR_SCRATCH;
    }
    memset(f.marks, 0, bytes);
    for (int32_t i = 0; i < scan->count; i++) {
        if (scan->beams[i].hit) {
            add_hit(&f, &scan->beams[i]);
        }
    }
    for (int32_t i = 0; i < scan->count; i++) {
        add_misses(&f, &scan->beams[i]);
    }
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}
