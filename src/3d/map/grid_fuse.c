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
    const int32_t whole = cell_mm + spread_mm, worth = (fusion->hit * cell_mm + whole / 2) / whole;
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

/* Where on the beam: `part` millimeters from the sensor, of its length. */
static void part_of(int32_t at[3], const fusing *f, const iris_beam *beam, int32_t part, int32_t length)
{
    const int64_t dx = beam->x_mm - f->scan->x_mm, dy = beam->y_mm - f->scan->y_mm;
    place_of(at, f, f->scan->x_mm + (int32_t)(dx * part / length),
             f->scan->y_mm + (int32_t)(dy * part / length));
}

static int32_t length_of(const fusing *f, const iris_beam *beam)
{
    return (int32_t)iris_hypot(beam->x_mm - f->scan->x_mm, beam->y_mm - f->scan->y_mm);
}

/* The cell that the beam met: the first one that is known to be occupied, of those that it may have met; else where it
 * ends. Else walls would grow backwards, where nobody sees that they end. */
static void met_by(int32_t at[3], const fusing *f, const iris_beam *beam)
{
    const int32_t length = length_of(f, beam), unsure = 2 * beam->spread_mm;
    int32_t from[3], to[3];
    iris_ray ray;
    if (length == 0 || unsure == 0) {
        place_of(to, f, beam->x_mm, beam->y_mm);
        iris_ray_start(&ray, to, to, f->grid->cell_mm);
    } else {
        part_of(from, f, beam, length > unsure ? length - unsure : 0, length);
        part_of(to, f, beam, length, length);
        iris_ray_start(&ray, from, to, f->grid->cell_mm);
    }
    do {
        at[0] = ray.at[0];
        at[1] = ray.at[1];
    } while (!(is_inside(f->grid, at[0], at[1]) &&
               f->grid->odds[(size_t)at[1] * (size_t)f->grid->w + (size_t)at[0]] >= IRIS_ODDS_OCCUPIED) &&
             iris_ray_next(&ray));
}

static void add_hit(const fusing *f, const iris_beam *beam)
{
    const int32_t worth = iris_fusion_hit(&f->fusion, beam->spread_mm, f->grid->cell_mm);
    int32_t at[3];
    if (worth > 0) {
        met_by(at, f, beam);
        if (is_inside(f->grid, at[0], at[1])) {
            add(f, at[0], at[1], worth);
        }
    }
}

/* How much of the beam is free: in millimeters from the sensor, of its length. */
static int32_t free_part(const iris_beam *beam, int32_t length)
{
    if (!beam->hit) {
        return length;
    }
    const int32_t unsure = 2 * beam->spread_mm;
    return length > unsure ? length - unsure : 0;
}

static void add_misses(const fusing *f, const iris_beam *beam)
{
    const int32_t length = length_of(f, beam);
    int32_t end[3];
    iris_ray ray;
    if (length == 0) {
        return;
    }
    part_of(end, f, beam, free_part(beam, length), length);
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
