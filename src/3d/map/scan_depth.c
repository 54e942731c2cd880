/* The beams of a picture of depths: twice through it, for the nearest things in the way, and for their means. */
#include "../../foundation/views.h"
#include "iris/3d/scan.h"
#include "map_parts.h"

#define TILT_MAX 14563 /* 80 degrees */
#define SUPPORT  3     /* pixels that make a thing */
#define AHEAD_LEAST                                                                                          \
    4096 /* of how far ahead a depth leads, 16 fraction bits: rows that look down too steeply are none */

/* One column of the level camera. */
typedef struct {
    int32_t nearest[SUPPORT]; /* millimeters ahead, of what is in the way */
    int32_t limit;            /* how far ahead a place of the nearest thing may be; 0: there is none */
    int32_t open;             /* how far floor was seen */
    uint32_t sum;             /* of those that make the mean */
    int32_t count;
} view_column;

/* What the pixels of a row have in common. 16 fraction bits. */
typedef struct {
    int32_t ahead; /* of a depth of 1 */
    int32_t down;
    int64_t first, step; /* columns of the level camera: of pixel 0, and from pixel to pixel */
} row_view;

typedef struct {
    const iris_depth_camera *camera;
    uint32_t product; /* focal times baseline, as disparities have it */
    view_column *columns;
    int32_t w;
} looking;

void iris_depth_camera_defaults(iris_depth_camera *camera, iris_size size, iris_q16 focal_q16,
                                iris_q16 baseline_q16)
{
    if (!camera) {
        return;
    }
    const int64_t product = ((int64_t)focal_q16 * baseline_q16) >> 16;
    *camera = (iris_depth_camera){.kind = IRIS_DEPTH_DISPARITY,
                                  .focal_q16 = focal_q16,
                                  .baseline_q16 = baseline_q16,
                                  .u0_q16 = (size.w - 1) * (IRIS_Q16_ONE / 2),
                                  .v0_q16 = (size.h - 1) * (IRIS_Q16_ONE / 2),
                                  .height_mm = 200,
                                  .low_mm = 50,
                                  .high_mm = 1000,
                                  .near_mm = 100,
                                  .far_mm = 5000};
    if (product > 0) {
        camera->spread_q16 = iris_sat_s32((int64_t)250000 * IRIS_Q16_ONE / product * IRIS_Q16_ONE);
    }
}

static int is_sound(const iris_depth_camera *c)
{
    const int32_t reach = IRIS_SCAN_REACH_MAX_MM, mount = reach / 4;
    const int sound = c->focal_q16 >= IRIS_Q16_ONE && c->tilt >= -TILT_MAX && c->tilt <= TILT_MAX &&
                      c->low_mm < c->high_mm && c->low_mm > -reach && c->high_mm < reach && c->near_mm > 0 &&
                      c->near_mm < c->far_mm && c->far_mm <= 65535 && c->height_mm >= 0 &&
                      c->height_mm <= reach && c->spread_q16 >= 0 && c->mount.x_mm > -mount &&
                      c->mount.x_mm < mount && c->mount.y_mm > -mount && c->mount.y_mm < mount;
    return sound && (c->kind == IRIS_DEPTH_MM || (c->kind == IRIS_DEPTH_DISPARITY && c->baseline_q16 > 0 &&
                                                  ((int64_t)c->focal_q16 * c->baseline_q16) >> 55 == 0));
}

/* 0: nothing of the row is ahead. */
static int view_row(row_view *row, const iris_depth_camera *c, int32_t v)
{
    const iris_heading tilt = iris_heading_of(c->tilt);
    const int64_t below = ((int64_t)v * IRIS_Q16_ONE - c->v0_q16) * IRIS_Q16_ONE / c->focal_q16;
    const int64_t ahead = (tilt.cosine >> 14) - iris_round_shift(below * tilt.sine, 30);
    if (ahead < AHEAD_LEAST || below > 64 * IRIS_Q16_ONE || below < -64 * IRIS_Q16_ONE) {
        return 0;
    }
    row->ahead = (int32_t)ahead;
    row->down = (int32_t)((tilt.sine >> 14) + iris_round_shift(below * tilt.cosine, 30));
    row->step = ((int64_t)IRIS_Q16_ONE * IRIS_Q16_ONE) / ahead;
    row->first = c->u0_q16 - iris_round_shift(c->u0_q16 * row->step, 16) + IRIS_Q16_ONE / 2;
    return 1;
}

/* How far ahead the pixel's place is, in millimeters; 0: there is none. *height: above the floor. */
static int32_t place_of(int32_t *height, const looking *l, const row_view *row, uint16_t pixel)
{
    if (pixel == 0) {
        return 0;
    }
    const uint32_t z = l->camera->kind == IRIS_DEPTH_MM ? pixel : (l->product + pixel / 2u) / pixel;
    *height = iris_sat_s32(l->camera->height_mm - iris_round_shift((int64_t)z * row->down, 16));
    return iris_sat_s32(iris_round_shift((int64_t)z * row->ahead, 16));
}

static int is_in_the_way(const iris_depth_camera *c, int32_t height)
{
    return height >= c->low_mm && height <= c->high_mm;
}

/* A place ahead among the nearest ones. */
static void keep_nearest(view_column *column, int32_t ahead)
{
    for (int i = 0; i < SUPPORT; i++) {
        if (ahead < column->nearest[i]) {
            const int32_t other = column->nearest[i];
            column->nearest[i] = ahead;
            ahead = other;
        }
    }
}

static void look_first(const looking *l, view_column *column, int32_t ahead, int32_t height)
{
    const iris_depth_camera *c = l->camera;
    if (ahead < c->near_mm || height > c->high_mm) {
        return;
    }
    if (ahead > c->far_mm) {
        column->open = c->far_mm;
    } else if (is_in_the_way(c, height)) {
        keep_nearest(column, ahead);
    } else if (ahead > column->open) {
        column->open = ahead;
    }
}

static int32_t limit_of(const looking *l, const view_column *column)
{
    const int64_t nearest = column->nearest[SUPPORT - 1];
    if (nearest == INT32_MAX) {
        return 0;
    }
    const int64_t spread = iris_round_shift(nearest * nearest * 4 / 1000 * l->camera->spread_q16 / 1000, 16);
    return iris_sat_s32(nearest + (spread > nearest / 50 ? spread : nearest / 50));
}

static void look_again(const looking *l, view_column *column, int32_t ahead, int32_t height)
{
    const iris_depth_camera *c = l->camera;
    if (ahead >= c->near_mm && ahead <= c->far_mm && ahead <= column->limit && is_in_the_way(c, height)) {
        column->sum += (uint32_t)ahead;
        column->count++;
    }
}

static void look(const looking *l, const iris_image *depth,
                 void (*at)(const looking *, view_column *, int32_t, int32_t))
{
    for (int32_t v = 0; v < depth->h; v++) {
        const uint16_t *pixels = iris_image_row(depth, v);
        row_view row;
        if (!view_row(&row, l->camera, v)) {
            continue;
        }
        int64_t place = row.first;
        for (int32_t u = 0; u < depth->w; u++, place += row.step) {
            const int64_t at_column = place >> 16;
            int32_t height = 0;
            const int32_t ahead =
                at_column >= 0 && at_column < l->w ? place_of(&height, l, &row, pixels[u]) : 0;
            if (ahead > 0) {
                at(l, &l->columns[at_column], ahead, height);
            }
        }
    }
}

static iris_beam beam_of(const looking *l, int32_t u, int32_t ahead, int hit)
{
    const iris_depth_camera *c = l->camera;
    const iris_heading turn = iris_heading_of(c->mount.heading);
    const int64_t most = IRIS_SCAN_REACH_MAX_MM / 2;
    int64_t left = ((int64_t)c->u0_q16 - (int64_t)u * IRIS_Q16_ONE) * ahead / c->focal_q16;
    left = left > most ? most : left < -most ? -most : left;
    const int64_t spread = iris_round_shift((int64_t)ahead * ahead / 1000 * c->spread_q16 / 1000, 16);
    return (iris_beam){c->mount.x_mm + iris_heading_x(turn, ahead, (int32_t)left),
                       c->mount.y_mm + iris_heading_y(turn, ahead, (int32_t)left),
                       !hit            ? 0
                       : spread > most ? (int32_t)most
                                       : (int32_t)spread,
                       hit};
}

iris_status iris_scan_from_depth(iris_beam *beams, int32_t *count, const iris_image *depth,
                                 const iris_depth_camera *camera, iris_scratch *scratch)
{
    if (!beams || !count || !depth || !camera || !scratch || !is_sound(camera)) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = iris_views_check_one(depth, IRIS_GRAY_U16);
    if (status != IRIS_OK) {
        return status;
    }
    const size_t mark = iris_scratch_mark(scratch);
    looking l = {camera, 0, iris_scratch_take(scratch, IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(depth->w)),
                 depth->w};
    if (!l.columns) {
        return IRIS_ERR_SCRATCH;
    }
    if (camera->kind == IRIS_DEPTH_DISPARITY) {
        l.product = (uint32_t)(((int64_t)camera->focal_q16 * camera->baseline_q16) >> 24);
    }
    for (int32_t u = 0; u < l.w; u++) {
        l.columns[u] = (view_column){{INT32_MAX, INT32_MAX, INT32_MAX}, 0, 0, 0, 0};
    }
    look(&l, depth, look_first);
    for (int32_t u = 0; u < l.w; u++) {
        l.columns[u].limit = limit_of(&l, &l.columns[u]);
    }
    look(&l, depth, look_again);
    int32_t made = 0;
    for (int32_t u = 0; u < l.w; u++) {
        const view_column *c = &l.columns[u];
        if (c->count > 0) {
            beams[made++] =
                beam_of(&l, u, (int32_t)((c->sum + (uint32_t)c->count / 2u) / (uint32_t)c->count), 1);
        } else if (c->open > 0) {
            beams[made++] = beam_of(&l, u, c->open, 0);
        }
    }
    *count = made;
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}
