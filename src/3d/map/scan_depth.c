/* The beams of a picture of depths: twice through it, for the nearest things in the way, and for their means. */
#include "../../foundation/views.h"
#include "depth_row.h"

#define SUPPORT 3 /* pixels that make a thing */
#define ALIKE   8 /* so many pixels above each other err alike */

/* One column of the level camera. */
typedef struct {
    int32_t nearest[SUPPORT]; /* millimeters ahead, of what is in the way */
    int32_t limit;            /* how far ahead a place of the nearest thing may be; 0: there is none */
    int32_t open;             /* how far floor was seen */
    uint32_t sum;             /* of those that make the mean */
    int32_t count;
} view_column;

typedef struct {
    const iris_depth_camera *camera;
    uint32_t product;
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
                                  .u0_q16 = iris_sat_s32(((int64_t)size.w - 1) * (IRIS_Q16_ONE / 2)),
                                  .v0_q16 = iris_sat_s32(((int64_t)size.h - 1) * (IRIS_Q16_ONE / 2)),
                                  .height_mm = 200,
                                  .low_mm = 50,
                                  .high_mm = 1000,
                                  .near_mm = 100,
                                  .far_mm = 5000};
    if (product > 0) {
        camera->spread_q16 = iris_sat_s32((int64_t)250000 * IRIS_Q16_ONE * IRIS_Q16_ONE / product);
    }
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
    const int32_t nearest = column->nearest[SUPPORT - 1];
    if (nearest == INT32_MAX) {
        return 0;
    }
    const int32_t spread = 4 * iris_depth_spread(l->camera, nearest);
    return nearest + (spread > nearest / 50 ? spread : nearest / 50);
}

static void look_again(const looking *l, view_column *column, int32_t ahead, int32_t height)
{
    const iris_depth_camera *c = l->camera;
    const int32_t nearest = column->nearest[SUPPORT - 1], before = (column->limit - nearest) / 2;
    if (column->limit > 0 && ahead >= nearest - before && ahead <= column->limit && ahead <= c->far_mm &&
        is_in_the_way(c, height)) {
        column->sum += (uint32_t)ahead;
        column->count++;
    }
}

static void look(const looking *l, const iris_image *depth,
                 void (*at)(const looking *, view_column *, int32_t, int32_t))
{
    const iris_depth_camera *c = l->camera;
    for (int32_t v = 0; v < depth->h; v++) {
        const uint16_t *pixels = iris_image_row(depth, v);
        iris_depth_row row;
        if (!iris_depth_row_of(&row, c, v)) {
            continue;
        }
        /* columns of the level camera, 16 fraction bits: of pixel 0, and from pixel to pixel */
        const int64_t step = (int64_t)IRIS_Q16_ONE * IRIS_Q16_ONE / row.ahead;
        int64_t place = c->u0_q16 - iris_round_shift(c->u0_q16 * step, 16) + IRIS_Q16_ONE / 2;
        for (int32_t u = 0; u < depth->w; u++, place += step) {
            const int64_t column = place >> 16;
            if (pixels[u] == 0 || column < 0 || column >= l->w) {
                continue;
            }
            const uint32_t z = iris_depth_of(l->product, pixels[u]);
            at(l, &l->columns[column], iris_depth_ahead(&row, z), iris_depth_height(&row, z, c));
        }
    }
}

/* The beam of column u. count: how many pixels saw its end; 0: nothing is there. */
static iris_beam beam_of(const looking *l, int32_t u, int32_t ahead, int32_t count)
{
    const iris_depth_camera *c = l->camera;
    const iris_heading turn = iris_heading_of(c->mount.heading);
    const int64_t most = IRIS_SCAN_REACH_MAX_MM / 2, spread = count > 0 ? iris_depth_spread(c, ahead) : 0;
    int64_t left = ((int64_t)c->u0_q16 - (int64_t)u * IRIS_Q16_ONE) * ahead / c->focal_q16;
    left = left > most ? most : left < -most ? -most : left;
    return (iris_beam){c->mount.x_mm + iris_heading_x(turn, ahead, (int32_t)left),
                       c->mount.y_mm + iris_heading_y(turn, ahead, (int32_t)left),
                       count <= ALIKE ? (int32_t)spread
                                      : (int32_t)iris_sqrt_u64((uint64_t)(spread * spread * ALIKE / count)),
                       count > 0};
}

iris_status iris_scan_from_depth(iris_beam *beams, int32_t *count, const iris_image *depth,
                                 const iris_depth_camera *camera, iris_scratch *scratch)
{
    if (!beams || !count || !depth || !camera || !scratch || iris_depth_camera_check(camera) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = iris_views_check_one(depth, IRIS_GRAY_U16);
    if (status != IRIS_OK) {
        return status;
    }
    const size_t mark = iris_scratch_mark(scratch);
    looking l = {camera, iris_depth_product(camera),
                 iris_scratch_take(scratch, IRIS_SCAN_FROM_DEPTH_SCRATCH_BYTES(depth->w)), depth->w};
    if (!l.columns) {
        return IRIS_ERR_SCRATCH;
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
                beam_of(&l, u, (int32_t)((c->sum + (uint32_t)c->count / 2u) / (uint32_t)c->count), c->count);
        } else if (c->open > 0) {
            beams[made++] = beam_of(&l, u, c->open, 0);
        }
    }
    *count = made;
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}
