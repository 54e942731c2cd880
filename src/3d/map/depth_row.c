#include "depth_row.h"

#define TILT_MAX    14563 /* 80 degrees */
#define AHEAD_LEAST 4096  /* a row that looks down more steeply is none */
#define BELOW_MAX   (64 * (int64_t)IRIS_Q16_ONE)

iris_status iris_depth_camera_check(const iris_depth_camera *c)
{
    const int32_t reach = IRIS_SCAN_REACH_MAX_MM, mount = reach / 4;
    const int sound = c->focal_q16 >= IRIS_Q16_ONE && c->tilt >= -TILT_MAX && c->tilt <= TILT_MAX &&
                      c->low_mm < c->high_mm && c->low_mm > -reach && c->high_mm < reach && c->near_mm > 0 &&
                      c->near_mm < c->far_mm && c->far_mm <= 65535 && c->height_mm >= 0 &&
                      c->height_mm <= reach && c->spread_q16 >= 0 && c->mount.x_mm > -mount &&
                      c->mount.x_mm < mount && c->mount.y_mm > -mount && c->mount.y_mm < mount;
    const int64_t product = ((int64_t)c->focal_q16 * c->baseline_q16) >> 32;
    const int has_depth = c->kind == IRIS_DEPTH_MM ||
                          (c->kind == IRIS_DEPTH_DISPARITY && product >= 1 && product < (int64_t)1 << 23);
    return sound && has_depth ? IRIS_OK : IRIS_ERR_ARG;
}

int iris_depth_row_of(iris_depth_row *row, const iris_depth_camera *camera, int32_t v)
{
    const iris_heading tilt = iris_heading_of(camera->tilt);
    const int64_t below = ((int64_t)v * IRIS_Q16_ONE - camera->v0_q16) * IRIS_Q16_ONE / camera->focal_q16;
    if (below > BELOW_MAX || below < -BELOW_MAX) {
        return 0;
    }
    row->ahead = (int32_t)((tilt.cosine >> 14) - iris_round_shift(below * tilt.sine, 30));
    row->down = (int32_t)((tilt.sine >> 14) + iris_round_shift(below * tilt.cosine, 30));
    return row->ahead >= AHEAD_LEAST;
}
